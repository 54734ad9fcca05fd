// Makes rotation groups: small patches of the surface to which the elastic energy fits one rotation each.
//
// Groups do not depend on the handles, so their rotations survive every change of handles. They come from
// farthest-point sampling along edges: each new seed is the vertex farthest from all seeds so far. Distances are only
// updated where the new seed is nearer. A component gets its groups when two handles first meet in it: its share by
// area, and at least a quarter of the wished count. Cost: O(n log groups), and a scan of n / 256 blocks per group. A
// failed call changes nothing.
#pragma once
#include <cstdint>

#include "deform/constants.h"
#include "deform/rest.h"

namespace hf_inner::deform {

struct Groups {
  explicit Groups(Memory& memory)
      : group_of(&memory),
        seed(&memory),
        component(&memory),
        component_start(&memory),
        component_end(&memory),
        border_edge(&memory) {}
  Vector<std::int32_t> group_of;         // rotation group per vertex, -1 in components without groups
  Vector<std::int32_t> seed;             // first vertex of each group
  Vector<std::int32_t> component;        // per group
  Vector<std::int32_t> component_start;  // groups of component c: [component_start[c], component_end[c])
  Vector<std::int32_t> component_end;
  Vector<std::int32_t> border_edge;  // edges between two groups, ascending
  std::int32_t count() const noexcept { return static_cast<std::int32_t>(seed.size()); }
  bool has(std::int32_t c) const noexcept { return component_end[c] > component_start[c]; }

  // Returns a copy of `groups` (null: none yet) that also has groups for these components. Existing groups keep their
  // numbers.
  static std::shared_ptr<const Groups> with(std::shared_ptr<const Groups> groups, const surface::Core& core,
                                            const Rest& rest, Span<const std::int32_t> components, std::int32_t wished,
                                            Memory& memory);
};

}  // namespace hf_inner::deform

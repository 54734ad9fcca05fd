// Edge lengths that close every triangle: a >= b >= c, b + c - a >= 1e-8 a (and a never less than a thousandth of the
// mean edge). Triangles that do not close have their two shorter edges lengthened by half of what is missing each;
// their neighbours may then open, so this is repeated, all triangles at once, up to 64 rounds. What is still open then
// is closed by one length added to every edge (Sharp and Crane 2020, Section 4.5). Independent of the numbering. Cost:
// O(n) a round; one round on a mesh without thin triangles.
#pragma once
#include "mesh/topology.h"

namespace hf_inner {

struct MollifiedLengths {
  explicit MollifiedLengths(Memory& memory) : length(&memory), edge_of_side(&memory), changed(&memory) {}
  static MollifiedLengths make(const Mesh& mesh, const Topology& topology, Memory& memory, JobRunner* jobs = nullptr);

  Vector<double> length;              // by edge
  Vector<std::int32_t> edge_of_side;  // 3 t + k: the edge from corner k of triangle t to the next
  Vector<std::uint8_t> changed;       // by edge; empty: none was
  std::uint32_t thin_count = 0;       // triangles that did not close
};

}  // namespace hf_inner

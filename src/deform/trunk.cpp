#include "deform/trunk.h"

#include <algorithm>
#include <limits>

#include "base/index.h"
#include "deform/constants.h"

namespace hf_inner::deform {
namespace {

Index largest_component(const surface::Core& core) {
  Vector<double> area(at(core.mesh.component_count()), 0.0, core.memory.get());
  for (std::size_t v = 0; v < core.mesh.positions.size(); ++v) area[at(core.mesh.component[v])] += core.areas[v];
  return static_cast<Index>(std::max_element(area.begin(), area.end()) - area.begin());
}

// Takes the limb of a tip out of the trunk.
void remove_limb(const surface::Core& core, const Vector<double>& field, const field::Extremity& tip,
                 Vector<Index>& limb, Vector<std::uint8_t>& trunk) {
  const double fall = 0.5 * tip.length * tip.length;  // extremities.h
  const double level = field[at(tip.vertex)] - limb_share * fall;
  limb.assign(1, tip.vertex);
  trunk[at(tip.vertex)] = 0;
  for (std::size_t i = 0; i < limb.size(); ++i) {
    const Index v = limb[i];
    for (Index k = core.topology().neighbour_start[at(v)]; k < core.topology().neighbour_start[at(v) + 1]; ++k) {
      const Index u = core.topology().neighbour[at(k)];
      if (!trunk[at(u)] || field[at(u)] < level) continue;
      trunk[at(u)] = 0;
      limb.push_back(u);
    }
  }
}

}  // namespace

Trunk find_trunk(const surface::Core& core, const field::Extremities& tips, Span<const double> height) {
  const mesh::Mesh& mesh = core.mesh;
  const Index component = largest_component(core);
  Vector<std::uint8_t> trunk(mesh.positions.size(), 0, core.memory.get());
  for (std::size_t v = 0; v < trunk.size(); ++v) trunk[v] = mesh.component[v] == component;
  Vector<Index> limb(core.memory.get());
  for (const field::Extremity& tip : tips.points) {
    if (tip.component == component) remove_limb(core, tips.field, tip, limb, trunk);
  }
  return trunk_of(core, trunk, height);
}

Trunk trunk_of(const surface::Core& core, Span<const std::uint8_t> trunk, Span<const double> height) {
  const mesh::Mesh& mesh = core.mesh;
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < trunk.size(); ++v) {
    if (trunk[v]) lowest = std::min(lowest, height[v]);
  }
  Trunk out;
  Vec3 sum;
  double weights = 0;
  for (std::size_t v = 0; v < trunk.size(); ++v) {
    if (!trunk[v]) continue;
    const double weight = core.areas[v] * (height[v] - lowest + flat_trunk);
    sum = sum + weight * mesh.positions[v];
    weights += weight;
    out.area += core.areas[v];
  }
  out.found = weights > 0;
  if (out.found) out.middle = (1 / weights) * sum;
  return out;
}

}  // namespace hf_inner::deform

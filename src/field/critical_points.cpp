#include "field/critical_points.h"

#include <algorithm>
#include <cmath>

#include "base/index.h"

namespace hf_inner::field {
namespace {

struct VertexLink {
  Index below = 0, above = 0;              // neighbours
  Index edges_below = 0, edges_above = 0;  // edges between neighbours: both ends below or above
};

}  // namespace

CriticalPoints find_critical_points(const mesh::Mesh& mesh, const mesh::Topology& topology, Span<const double> field,
                                    Memory& memory) {
  const auto less = [&](Index a, Index b) {
    return field[at(a)] != field[at(b)] ? field[at(a)] < field[at(b)] : a < b;
  };
  const auto has_value = [&](Index v) { return !std::isnan(field[at(v)]); };
  CriticalPoints found(memory);
  Vector<VertexLink> links(at(mesh.vertex_count()), &memory);
  for (Index e = 0; e < topology.edge_count(); ++e) {
    const Index a = topology.first(e), b = topology.second(e);
    if (!has_value(a) || !has_value(b)) continue;
    const bool rises = less(a, b);
    ++links[at(rises ? b : a)].below;
    ++links[at(rises ? a : b)].above;
    --found.euler_characteristic;
  }
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const Index* v = mesh.triangle(t);
    if (!has_value(v[0]) || !has_value(v[1]) || !has_value(v[2])) continue;
    Index low = v[0], high = v[0];
    for (int k = 1; k < 3; ++k) {
      low = less(v[k], low) ? v[k] : low;
      high = less(high, v[k]) ? v[k] : high;
    }
    ++links[at(high)].edges_below;
    ++links[at(low)].edges_above;
    ++found.euler_characteristic;
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (!has_value(v)) continue;
    ++found.euler_characteristic;
    const VertexLink& link = links[at(v)];
    CriticalPoint point{v, CriticalKind::saddle, 1 - (link.below - link.edges_below)};
    if (link.below == 0) {
      point.kind = CriticalKind::minimum;
      ++found.minima;
    } else if (link.above == 0) {
      point.kind = CriticalKind::maximum;
      ++found.maxima;
    } else {
      if (point.index == 0 && link.above - link.edges_above == 1) continue;  // regular
      ++found.saddles;
    }
    found.index_sum += point.index;
    found.points.push_back(point);
  }
  return found;
}

}  // namespace hf_inner::field

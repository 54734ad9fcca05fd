#include "mesh/around_edge.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"

namespace hf_inner::mesh {
namespace {

// Angles that differ by less than this are one. It is above their rounding, which is 1e-16. Needles have more. More
// takes triangles that lie on one another in a bent surface for flat ones.
constexpr double same_angle = 1e-9;

// Whether the edge runs from the place that comes first, by x, y and z, to the other one.
bool runs_up(Vec3 from, Vec3 to) noexcept {
  if (from.x != to.x) return from.x < to.x;
  return from.y != to.y ? from.y < to.y : from.z <= to.z;
}

// A direction perpendicular to an axis of length 1.
Vec3 beside(Vec3 axis) noexcept {
  const double x = std::fabs(axis.x), y = std::fabs(axis.y), z = std::fabs(axis.z);
  return unit_vector(cross(axis, x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1}));
}

bool is_lower(const EdgeSide& a, const EdgeSide& b) noexcept {
  if (a.along != b.along) return a.along < b.along;
  return a.squared != b.squared ? a.squared < b.squared : a.apex < b.apex;
}

// Moves the side behind the widest gap between neighbours to the front. Angles then ascend from there.
void begin_behind_gap(Vector<EdgeSide>& sides) {
  constexpr double turn = 6.283185307179586;
  std::size_t first = 0;
  double widest = sides[0].angle + turn - sides.back().angle;
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const double gap = sides[i].angle - sides[i - 1].angle;
    if (gap > widest) {
      widest = gap;
      first = i;
    }
  }
  for (std::size_t i = 0; i < first; ++i) sides[i].angle += turn;
  std::rotate(sides.begin(), sides.begin() + static_cast<std::ptrdiff_t>(first), sides.end());
}

}  // namespace

void sort_around_edge(const Mesh& mesh, const Topology& topology, Index edge, Vector<EdgeSide>& sides) {
  const Vec3 ends[2] = {mesh.positions[at(topology.first(edge))], mesh.positions[at(topology.second(edge))]};
  const bool up = runs_up(ends[0], ends[1]);
  const Vec3 origin = ends[up ? 0 : 1], axis = unit_vector(ends[up ? 1 : 0] - origin), x = beside(axis),
             y = cross(axis, x);
  sides.clear();
  for (Index i = topology.edge_triangle_start[at(edge)]; i < topology.edge_triangle_start[at(edge) + 1]; ++i) {
    const Index apex = mesh.triangle(topology.triangle(i))[(topology.corner(i) % 3 + 2) % 3];
    const Vec3 p = mesh.positions[at(apex)] - origin;
    const double along = dot(p, axis);
    const Vec3 radius = p - along * axis;
    sides.push_back({i, apex, arc_tangent(dot(y, radius), dot(x, radius)), along, dot(radius, radius)});
  }
  std::sort(sides.begin(), sides.end(), [](const EdgeSide& a, const EdgeSide& b) {
    return a.angle != b.angle ? a.angle < b.angle : is_lower(a, b);
  });
  begin_behind_gap(sides);
  for (auto begin = sides.begin(); begin != sides.end();) {
    auto end = begin + 1;
    while (end != sides.end() && std::fabs(end->angle - (end - 1)->angle) < same_angle) ++end;
    std::sort(begin, end, is_lower);
    begin = end;
  }
  if (!up) std::reverse(sides.begin(), sides.end());
}

}  // namespace hf_inner::mesh

#include "mesh/orientation.h"

#include "base/index.h"

namespace hf_inner::mesh {
namespace {

// A component counts as closed if its area vectors cancel up to this share of its area. A larger number takes open
// ones too, whose volume says nothing. Half and double change no figure of the 28 shared rigs.
constexpr double closed_share = 1e-3;

}  // namespace

// The volume is measured from a corner of the component.
Vector<std::int8_t> component_sides(const Mesh& mesh, Memory& memory) {
  const std::size_t count = at(mesh.component_count());
  Vector<double> volume(count, 0.0, &memory), area(count, 0.0, &memory);
  Vector<Vec3> open(count, Vec3{}, &memory), origin(count, Vec3{}, &memory);
  Vector<std::uint8_t> seen(count, 0, &memory);
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const Index* v = mesh.triangle(t);
    const std::size_t c = at(mesh.component[at(v[0])]);
    const Vec3 a = mesh.positions[at(v[0])];
    if (!seen[c]) {
      seen[c] = 1;
      origin[c] = a;
    }
    const Vec3 vector = cross(mesh.positions[at(v[1])] - a, mesh.positions[at(v[2])] - a);
    volume[c] += dot(a - origin[c], vector);
    area[c] += norm(vector);
    open[c] = open[c] + vector;
  }
  Vector<std::int8_t> side(count, 1, &memory);
  for (std::size_t c = 0; c < count; ++c) {
    if (volume[c] < 0 && norm(open[c]) <= closed_share * area[c]) side[c] = -1;
  }
  return side;
}

Vector<double> component_openness(const Mesh& mesh, Memory& memory) {
  const std::size_t count = at(mesh.component_count());
  Vector<double> area(count, 0.0, &memory);
  Vector<Vec3> open(count, Vec3{}, &memory);
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const Index* v = mesh.triangle(t);
    const std::size_t c = at(mesh.component[at(v[0])]);
    const Vec3 a = mesh.positions[at(v[0])];
    const Vec3 vector = cross(mesh.positions[at(v[1])] - a, mesh.positions[at(v[2])] - a);
    area[c] += norm(vector);
    open[c] = open[c] + vector;
  }
  for (std::size_t c = 0; c < count; ++c) area[c] = area[c] > 0 ? norm(open[c]) / area[c] : 0;
  return area;
}

}  // namespace hf_inner::mesh

#include "detail/morph.h"

#include "base/index.h"

namespace hf_inner::detail {

Vector<Vec3> morphed_positions(const RegionSurface& surface, const RegionState& state, double weight, Memory& memory) {
  const RegionShape& shape = *state.shape;
  Vector<Vec3> positions(&memory);
  positions.reserve(at(shape.local_count()));
  for (std::size_t i = 0; i < shape.inside.size(); ++i)
    positions.push_back(surface.core->mesh.to_inner(morphed(surface.position(shape.inside[i]), state.base[i], weight)));
  for (const std::int32_t v : shape.rim) positions.push_back(surface.scaled_position(v));
  return positions;
}

double morphed_area(const RegionSurface& surface, const RegionState& state, double weight, Memory& memory) {
  const Vector<Vec3> p = morphed_positions(surface, state, weight, memory);
  const Vector<std::int32_t>& corner = state.shape->corners;
  double area = 0;
  for (std::size_t i = 0; i < corner.size(); i += 3) {
    const Vec3 a = p[at(corner[i])];
    area += 0.5 * norm(cross(p[at(corner[i + 1])] - a, p[at(corner[i + 2])] - a));
  }
  return area;
}

Vector<Vec3> local_normal_sums(const RegionState& state, Span<const Vec3> p, Memory& memory) {
  const RegionShape& shape = *state.shape;
  Vector<Vec3> sums(shape.inside.size(), &memory);
  sums.insert(sums.end(), state.outer_normal.begin(), state.outer_normal.end());
  const Vector<std::int32_t>& corner = shape.corners;
  for (std::size_t i = 0; i < corner.size(); i += 3) {
    const Vec3 a = p[at(corner[i])], n = cross(p[at(corner[i + 1])] - a, p[at(corner[i + 2])] - a);
    for (std::size_t k = 0; k < 3; ++k) sums[at(corner[i + k])] = sums[at(corner[i + k])] + n;
  }
  return sums;
}

Vec3 unit_normal(Vec3 sum) noexcept {
  const double length = norm(sum);
  return length > 0 ? (1 / length) * sum : Vec3{0, 0, 1};
}

}  // namespace hf_inner::detail

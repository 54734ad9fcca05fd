// See alignment.h.
#include "transfer/alignment.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "transfer/constants.h"

namespace hf_inner::transfer {
namespace {

std::size_t row_maximum(const double* row, std::size_t width) noexcept {
  return static_cast<std::size_t>(std::max_element(row, row + width) - row);
}

}  // namespace

Mat3 checked_axes(const double (&rows)[9], const char* side) {
  bool all_zero = true;
  for (const double x : rows) {
    if (!std::isfinite(x)) fail(HF_ERROR_NON_FINITE, HF_NO_INDEX, "the %s axes hold a number that is not finite", side);
    all_zero = all_zero && x == 0;
  }
  if (all_zero) return Mat3::Identity();
  Vec3 row[3];
  for (int i = 0; i < 3; ++i) row[i] = {rows[3 * i], rows[3 * i + 1], rows[3 * i + 2]};
  const Vec3 third = cross(row[0], row[1]) - row[2];
  bool good = norm(third) < axes_tolerance;
  for (const Vec3& r : row) good = good && std::abs(norm(r) - 1) < axes_tolerance;
  if (!good)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "the %s axes must be three orthogonal unit rows right, up, forward with right x up = forward, within %g", side,
         axes_tolerance);
  // Takes the rotation nearest to the caller's axes, so that they are exactly orthonormal.
  Mat3 axes;
  for (int i = 0; i < 3; ++i) {
    axes(i, 0) = row[i].x;
    axes(i, 1) = row[i].y;
    axes(i, 2) = row[i].z;
  }
  return deform::best_rotation(axes, deform::Quaternion()).toRotationMatrix();
}

double ground_height(const RestSide& side, double feet, double trunk) noexcept {
  const double limit = feet < trunk ? feet - stands : -no_height;
  double low = no_height;
  for (const Vec3& p : side.mesh->positions) {
    const double height = dot(p, side.up());
    if (height >= limit) low = std::min(low, height);
  }
  return low;
}

double leg_length(const RestSide& side, Span<const std::int32_t> foot_columns, double ground) noexcept {
  const std::size_t width = side.field.size() / side.area.size();
  const Vec3 up = side.up();
  double sum = 0;
  std::int32_t legs = 0;
  for (const std::int32_t column : foot_columns) {
    // A coarsely meshed leg may have no vertex in the first window of field values; the next window is wider.
    for (const FieldWindow& window : leg_windows) {
      double height = 0, area = 0;
      for (std::size_t v = 0; v < side.area.size(); ++v) {
        const double* row = side.field.data() + v * width;
        const double u = row[column];
        if (u <= window.low || u >= window.high || row_maximum(row, width) != static_cast<std::size_t>(column))
          continue;
        height += side.area[v] * (dot(side.mesh->positions[v], up) - ground);
        area += side.area[v];
      }
      if (!(area > 0)) continue;
      sum += height / area;
      ++legs;
      break;
    }
  }
  return legs == static_cast<std::int32_t>(foot_columns.size()) && legs > 0 ? sum / legs : 0.0;
}

bool limb_direction(const RestSide& side, std::int32_t column, Vec3 region_centroid, Vec3& direction,
                    FieldWindow window) noexcept {
  const std::size_t width = side.field.size() / side.area.size();
  Vec3 centroid;
  double area = 0;
  for (std::size_t v = 0; v < side.area.size(); ++v) {
    const double* row = side.field.data() + v * width;
    const double u = row[column];
    if (u <= window.low || u >= window.high || row_maximum(row, width) != static_cast<std::size_t>(column)) continue;
    centroid = centroid + side.area[v] * side.mesh->positions[v];
    area += side.area[v];
  }
  if (!(area > 0)) return false;
  direction = region_centroid - (1 / area) * centroid;
  return true;
}

deform::Quaternion minimal_rotation(Vec3 from, Vec3 to, Vec3 axis) noexcept {
  const Vec3 a = (1 / norm(from)) * from, b = (1 / norm(to)) * to;
  const Vec3 c = cross(a, b);
  const double w = 1 + dot(a, b);
  if (w > opposite) return deform::normalised({c, w});
  Vec3 turn = axis - dot(axis, a) * a;
  if (norm(turn) < opposite) turn = cross(a, std::abs(a.x) < steep_share ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
  turn = (1 / norm(turn)) * turn;
  return {turn, 0};
}

deform::Quaternion power(const deform::Quaternion& q, double w) noexcept {
  return deform::exponential(w * deform::logarithm(q));
}

}  // namespace hf_inner::transfer

// A plain vector of three numbers, with the basic operations.
#pragma once
#include <cmath>

namespace hf_inner {

// Arrays of it are arrays of doubles without padding, which
// kernels read as such. Larger algebra uses Eigen (base/algebra.h).
struct Vec3 {
  double x = 0, y = 0, z = 0;
};
inline Vec3 operator+(Vec3 a, Vec3 b) noexcept { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) noexcept { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(double s, Vec3 a) noexcept { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(Vec3 a, Vec3 b) noexcept { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(Vec3 a) noexcept { return std::sqrt(dot(a, a)); }
// Scales a to length 1. It divides by the largest coordinate first, so that no square leaves the range. 0 stays 0.
inline Vec3 unit_vector(Vec3 a) noexcept {
  const double most = std::fmax(std::fmax(std::fabs(a.x), std::fabs(a.y)), std::fabs(a.z));
  if (!(most > 0)) return {};
  const Vec3 b{a.x / most, a.y / most, a.z / most};
  return (1 / norm(b)) * b;
}

}  // namespace hf_inner

// Rotations and the one nearest to a matrix, for deform and transfer.
//
// best_rotation() is  R = argmax over SO(3) of tr(R' S):  the rotation of a shape match with S = sum w x p'
// (Kabsch 1976), the local step of as-rigid-as-possible energies, the mean of rotations. In quaternions the objective
// is a quadratic form q' N(S) q (Horn 1987), so its maximiser is an eigenvector of a symmetric 4 x 4 matrix. It is
// always a proper rotation, and its only local maximum is the global one. Where several rotations are equally good
// (S planar with a mirror image, collinear, zero), the one nearest to a given rotation is taken.
//
// Nothing here allocates or fails. Non-finite input gives the rotation it was to be near to.
#pragma once
#include <cmath>

#include "base/algebra.h"
#include "base/principal_axes.h"
#include "base/span.h"
#include "deform/constants.h"
#include "mesh/mesh.h"

namespace hf_inner {

inline hf_eigen::Vector3d to_eigen(Vec3 v) noexcept { return {v.x, v.y, v.z}; }
inline Vec3 to_vec3(const hf_eigen::Vector3d& v) noexcept { return {v.x(), v.y(), v.z()}; }
inline Vec3 operator*(const Mat3& a, Vec3 v) noexcept { return to_vec3(a * to_eigen(v)); }
// a += w x p'
inline void add_outer(Mat3& a, double w, Vec3 x, Vec3 p) noexcept {
  a.noalias() += to_eigen(w * x) * to_eigen(p).transpose();
}

// Eigen's unit quaternion with the identity as its default. q and -q are one rotation; a * b is first b, then a.
class Quaternion : public hf_eigen::Quaterniond {
  using Base = hf_eigen::Quaterniond;

 public:
  Quaternion() noexcept : Quaternion({}, 1) {}
  Quaternion(Vec3 vector, double scalar) noexcept : Base(scalar, vector.x, vector.y, vector.z) {}
  Quaternion(const Base& q) noexcept : Base(q) {}
  // of a rotation matrix, or of four coefficients x y z w
  template <class Derived>
  explicit Quaternion(const hf_eigen::MatrixBase<Derived>& matrix) noexcept : Base(matrix) {}
};
// Unit length whatever the length was; the identity for zero or non-finite input, which Eigen's normalized() keeps.
Quaternion normalised_far(const Quaternion& q) noexcept;  // where squares leave the range of a double
inline Quaternion normalised(const Quaternion& q) noexcept {
  const double square = q.squaredNorm();
  if (!(square > least_norm_square && square < largest_norm_square)) return normalised_far(q);
  return Quaternion((1.0 / std::sqrt(square)) * q.coeffs());
}
inline Vec3 rotate(const Quaternion& q, Vec3 v) noexcept { return to_vec3(q * to_eigen(v)); }

// Rotation vector (axis times angle) to quaternion, any angle, and back with angle 0 to pi.
Quaternion exponential(Vec3 rotation_vector) noexcept;
Vec3 logarithm(const Quaternion& q) noexcept;
// The rotation vector of `q` nearest to where a motion that stood at `previous` leads, among (angle + 2 pi k) axis.
// So a drag keeps turns beyond 180 degrees.
Vec3 continued_logarithm(const Quaternion& q, Vec3 previous) noexcept;

// argmax tr(R' S), nearest to `near` among equals. Exact for every S, degenerate ones included.
Quaternion best_rotation(const Mat3& s, const Quaternion& near) noexcept;
// The same maximiser by Newton steps from `near`; best_rotation() where they do not reach a certified maximum.
Quaternion best_rotation_from(const Mat3& s, const Quaternion& near) noexcept;

// x = R p + t
struct RigidMotion {
  Quaternion rotation;
  Vec3 translation;
};
inline Vec3 apply(const RigidMotion& motion, Vec3 p) noexcept {
  return rotate(motion.rotation, p) + motion.translation;
}
// Least squares: minimises sum_i weight_i |R rest_i + t - posed_i|^2; weights empty: all 1. Ties as in best_rotation.
RigidMotion fit_rigid(Span<const Vec3> rest, Span<const Vec3> posed, Span<const double> weights,
                      const Quaternion& near) noexcept;

}  // namespace hf_inner

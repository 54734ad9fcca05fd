// Rotations, and the rotation nearest to a matrix, for poses and transfer.
//
// best_rotation() returns  R = argmax over SO(3) of tr(R' S).  This is the rotation of a shape match with S = sum w x
// p' (Kabsch 1976), the local step of as-rigid-as-possible energies, and the mean of rotations. For a quaternion q the
// objective is the quadratic form q' N(S) q (Horn 1987), so the best q is an eigenvector of the symmetric 4 x 4 matrix
// N. It is always a proper rotation, and its only local maximum is the global one. If several rotations are equally
// good (S planar with a mirror image, collinear, zero), the function takes the one nearest to a given rotation.
//
// No function here allocates or fails. For non-finite input they return the given near rotation.
#pragma once
#include <cmath>

#include "base/algebra.h"
#include "base/principal_axes.h"
#include "base/span.h"
#include "deform/constants.h"
#include "mesh/mesh.h"

namespace hf_inner::deform {

inline hf_eigen::Vector3d to_eigen(Vec3 v) noexcept { return {v.x, v.y, v.z}; }
inline Vec3 to_vec3(const hf_eigen::Vector3d& v) noexcept { return {v.x(), v.y(), v.z()}; }
// Adds the outer product w x p' to the matrix a.
inline void add_outer(Mat3& a, double w, Vec3 x, Vec3 p) noexcept {
  a.noalias() += to_eigen(w * x) * to_eigen(p).transpose();
}

// Eigen's unit quaternion, with the identity as its default. q and -q are one rotation; a * b applies b first, then a.
class Quaternion : public hf_eigen::Quaterniond {
  using Base = hf_eigen::Quaterniond;

 public:
  Quaternion() noexcept : Quaternion({}, 1) {}
  Quaternion(Vec3 vector, double scalar) noexcept : Base(scalar, vector.x, vector.y, vector.z) {}
  Quaternion(const Base& q) noexcept : Base(q) {}
  // Makes a quaternion from a rotation matrix, or from four coefficients x y z w.
  template <class Derived>
  explicit Quaternion(const hf_eigen::MatrixBase<Derived>& matrix) noexcept : Base(matrix) {}
};
// Scales a quaternion of any length to unit length. Returns the identity for zero or non-finite input, which Eigen's
// normalized() would keep.
Quaternion normalised_far(const Quaternion& q) noexcept;  // for lengths whose squares leave the range of a double
inline Quaternion normalised(const Quaternion& q) noexcept {
  const double square = q.squaredNorm();
  if (!(square > least_norm_square && square < largest_norm_square)) return normalised_far(q);
  return Quaternion((1.0 / std::sqrt(square)) * q.coeffs());
}
inline Vec3 rotate(const Quaternion& q, Vec3 v) noexcept {
  const double* c = q.coeffs().data();
  const Vec3 axis = {c[0], c[1], c[2]}, half = cross(axis, v), whole = half + half;
  return v + c[3] * whole + cross(axis, whole);
}

// Returns the angle of the turn from one rotation to the other, from 0 to pi.
double angle_between(const Quaternion& a, const Quaternion& b) noexcept;

// Convert a rotation vector (axis times angle, any angle) to a quaternion, and back with an angle from 0 to pi.
Quaternion exponential(Vec3 rotation_vector) noexcept;
Vec3 logarithm(const Quaternion& q) noexcept;
// Returns a rotation vector of `q`, chosen among (angle + 2 pi k) axis for whole k. It is the one nearest to where a
// motion from `previous` leads. So a drag keeps turns beyond 180 degrees.
Vec3 continued_logarithm(const Quaternion& q, Vec3 previous) noexcept;

// Returns argmax tr(R' S). Among equally good rotations it takes the one nearest to `near`. It is exact for every S,
// also degenerate ones.
Quaternion best_rotation(const Mat3& s, const Quaternion& near) noexcept;
// Finds the same maximum by Newton steps from `near`. It calls best_rotation() if the steps reach no proven maximum.
Quaternion best_rotation_from(const Mat3& s, const Quaternion& near) noexcept;

// The rigid motion x = R p + t.
struct RigidMotion {
  Quaternion rotation;
  Vec3 translation;
};
inline Vec3 apply(const RigidMotion& motion, Vec3 p) noexcept {
  return rotate(motion.rotation, p) + motion.translation;
}
// Returns the rigid motion that minimises sum_i weight_i |R rest_i + t - posed_i|^2. weights: empty means all 1. near:
// decides between equally good rotations, as in best_rotation.
RigidMotion fit_rigid(Span<const Vec3> rest, Span<const Vec3> posed, Span<const double> weights,
                      const Quaternion& near) noexcept;

}  // namespace hf_inner::deform

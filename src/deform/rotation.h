// Rotations: quaternions, rotation vectors, and the rotation nearest to a matrix. Shared by deform and transfer.
//
// The central question is  R = argmax over SO(3) of tr(R' S):  the rotation of a shape match with S = sum w x p'
// (Kabsch 1976), the local step of as-rigid-as-possible energies, the mean of rotations. In quaternions the objective
// is a quadratic form q' N(S) q (Horn 1987), so its maximiser is an eigenvector of a symmetric 4 x 4 matrix: always a
// proper rotation, with no case for reflections, and its only local maximum is the global one. Where several rotations
// are equally good (S planar with a mirror image, collinear, zero) the one nearest to a given rotation is taken.
//
// Cost: about 0.3 us warm (Newton on the rotation vector), 1.2 us cold (Jacobi sweeps). Nothing here allocates or
// fails; non-finite input gives the rotation it was to be near to.
#pragma once
#include <cmath>
#include <cstdint>

#include "base/span.h"
#include "mesh/mesh.h"

namespace hf_inner {

// Row-major 3 x 3 matrix.
struct Mat3 {
  double m[3][3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  static Mat3 identity() noexcept;
};
Mat3 operator+(const Mat3& a, const Mat3& b) noexcept;
Mat3 operator*(double s, const Mat3& a) noexcept;
Mat3 operator*(const Mat3& a, const Mat3& b) noexcept;
Mat3 transpose(const Mat3& a) noexcept;
double determinant(const Mat3& a) noexcept;
double trace_of_product(const Mat3& a, const Mat3& b) noexcept;  // tr(a' b)
inline Vec3 operator*(const Mat3& a, Vec3 v) noexcept {
  return {a.m[0][0] * v.x + a.m[0][1] * v.y + a.m[0][2] * v.z, a.m[1][0] * v.x + a.m[1][1] * v.y + a.m[1][2] * v.z,
          a.m[2][0] * v.x + a.m[2][1] * v.y + a.m[2][2] * v.z};
}
// a += w x p'
inline void add_outer(Mat3& a, double w, Vec3 x, Vec3 p) noexcept {
  const Vec3 s = w * x;
  a.m[0][0] += s.x * p.x, a.m[0][1] += s.x * p.y, a.m[0][2] += s.x * p.z;
  a.m[1][0] += s.y * p.x, a.m[1][1] += s.y * p.y, a.m[1][2] += s.y * p.z;
  a.m[2][0] += s.z * p.x, a.m[2][1] += s.z * p.y, a.m[2][2] += s.z * p.z;
}

// Unit quaternion; q and -q are one rotation.
struct Quaternion {
  double x = 0, y = 0, z = 0, w = 1;
};
// First b, then a.
inline Quaternion operator*(const Quaternion& a, const Quaternion& b) noexcept {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
inline Quaternion conjugate(const Quaternion& q) noexcept { return {-q.x, -q.y, -q.z, q.w}; }
inline double dot(const Quaternion& a, const Quaternion& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}
// Unit length whatever the length was; the identity for zero or non-finite input.
Quaternion normalised_far(const Quaternion& q) noexcept;  // where squares leave the range of a double
inline Quaternion normalised(const Quaternion& q) noexcept {
  const double square = dot(q, q);
  if (!(square > 1e-200 && square < 1e200)) return normalised_far(q);
  const double s = 1.0 / std::sqrt(square);
  return {s * q.x, s * q.y, s * q.z, s * q.w};
}
inline Mat3 to_matrix(const Quaternion& q) noexcept {
  Mat3 r;
  const double xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z, ww = q.w * q.w;
  const double xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z, xw = q.x * q.w, yw = q.y * q.w, zw = q.z * q.w;
  r.m[0][0] = ww + xx - yy - zz, r.m[0][1] = 2 * (xy - zw), r.m[0][2] = 2 * (xz + yw);
  r.m[1][0] = 2 * (xy + zw), r.m[1][1] = ww - xx + yy - zz, r.m[1][2] = 2 * (yz - xw);
  r.m[2][0] = 2 * (xz - yw), r.m[2][1] = 2 * (yz + xw), r.m[2][2] = ww - xx - yy + zz;
  return r;
}
Quaternion to_quaternion(const Mat3& rotation) noexcept;
Vec3 rotate(const Quaternion& q, Vec3 v) noexcept;
// Angle of a b^-1, 0 to pi, accurate for small angles.
double angle_between(const Quaternion& a, const Quaternion& b) noexcept;

// Rotation vector (axis times angle) to quaternion, any angle, and back with angle 0 to pi.
Quaternion exponential(Vec3 rotation_vector) noexcept;
Vec3 logarithm(const Quaternion& q) noexcept;
// The rotation vector of `q` that continues a motion which stood at `previous` (a rotation vector, turns included): of
// the vectors (angle + 2 pi k) axis the one nearest to previous + the last turn. Keeps turns beyond 180 degrees while
// dragging.
Vec3 continued_logarithm(const Quaternion& q, Vec3 previous) noexcept;

// argmax tr(R' S), nearest to `near` among equals. Exact for every S, degenerate ones included.
Quaternion best_rotation(const Mat3& s, const Quaternion& near) noexcept;
// The same maximiser by Newton steps from `near`, with best_rotation() where they do not settle on a certified maximum.
Quaternion best_rotation_from(const Mat3& s, const Quaternion& near) noexcept;

// Eigenvectors of a symmetric matrix as columns, a rotation (cyclic Jacobi).
Mat3 principal_axes(Mat3 a) noexcept;

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

#include "deform/rotation.h"

#include <cmath>

#include "base/elementary.h"

namespace hf_inner::deform {
namespace {

constexpr double pi = 3.14159265358979323846;

using Vec4 = hf_eigen::Vector4d;

// The second-order expansion of an objective in a rotation vector u: tr(exp([u])' B) = tr B + u.a - u' H u / 2 +
// O(u^3).
struct Quadratic {
  Vec3 a;
  double h00, h11, h22, h01, h02, h12;
};

Quadratic expand(const Mat3& s, const Mat3& r) noexcept {
  const Mat3 b = s * r.transpose();
  Quadratic q;
  q.a = {b(2, 1) - b(1, 2), b(0, 2) - b(2, 0), b(1, 0) - b(0, 1)};
  q.h00 = b(1, 1) + b(2, 2);
  q.h11 = b(0, 0) + b(2, 2);
  q.h22 = b(0, 0) + b(1, 1);
  q.h01 = -0.5 * (b(0, 1) + b(1, 0));
  q.h02 = -0.5 * (b(0, 2) + b(2, 0));
  q.h12 = -0.5 * (b(1, 2) + b(2, 1));
  return q;
}

// Solves H u = a by L D L'. Returns false unless H is positive definite with a margin. It is written by hand: Eigen's
// LLT has no margin, and Eigen's LDLT pivots.
bool newton_step(const Quadratic& q, double floor, Vec3& u) noexcept {
  if (!(q.h00 > floor)) return false;
  const double l10 = q.h01 / q.h00, l20 = q.h02 / q.h00;
  const double d1 = q.h11 - l10 * q.h01;
  if (!(d1 > floor)) return false;
  const double e21 = q.h12 - l20 * q.h01, l21 = e21 / d1;
  const double d2 = q.h22 - l20 * q.h02 - l21 * e21;
  if (!(d2 > floor)) return false;
  const double y1 = q.a.y - l10 * q.a.x, y2 = q.a.z - l20 * q.a.x - l21 * y1;
  u.z = y2 / d2;
  u.y = y1 / d1 - l21 * u.z;
  u.x = q.a.x / q.h00 - l10 * u.y - l20 * u.z;
  return true;
}

}  // namespace

Quaternion normalised_far(const Quaternion& q) noexcept {
  const double largest = q.coeffs().cwiseAbs().maxCoeff();
  if (!(largest > 0) || !q.coeffs().allFinite()) return {};
  return Quaternion((q.coeffs() / largest).normalized());
}

double angle_between(const Quaternion& a, const Quaternion& b) noexcept {
  const Quaternion turn = a * b.conjugate();
  return 2 * arc_tangent(norm(to_vec3(turn.vec())), std::fabs(turn.w()));
}

Quaternion exponential(Vec3 v) noexcept {
  const double angle2 = dot(v, v), angle = std::sqrt(angle2);
  const double s = angle < small_angle ? 0.5 - angle2 / 48.0 : sine(0.5 * angle) / angle;
  return normalised({s * v, cosine(0.5 * angle)});
}

Vec3 logarithm(const Quaternion& q) noexcept {
  const Vec3 v = to_vec3(q.vec());
  // The vector and -q are the same rotation; the one with a positive scalar turns by at most half a turn.
  const double length = std::sqrt(dot(v, v)), angle = 2 * arc_tangent(length, std::fabs(q.w()));
  if (!(length > 0)) return {};
  return (std::signbit(q.w()) ? -angle / length : angle / length) * v;
}

Vec3 continued_logarithm(const Quaternion& q, Vec3 previous) noexcept {
  // The step from the previous rotation is at most half a turn. To first order, the motion is then at previous + step.
  const Vec3 step = logarithm(q * exponential(previous).conjugate());
  const Vec3 expected = previous + step;
  const double expected_angle = std::sqrt(dot(expected, expected));
  const Vec3 principal = logarithm(q);
  const double angle = std::sqrt(dot(principal, principal));
  if (expected_angle <= pi && angle < principal_turn) return principal;
  Vec3 nearest = principal;
  if (angle > least_axis_angle) {
    const double turns = std::round((dot(expected, principal) / angle - angle) / (2 * pi));
    nearest = ((angle + 2 * pi * turns) / angle) * principal;
  } else if (expected_angle > 0) {
    nearest = (2 * pi * std::round(expected_angle / (2 * pi)) / expected_angle) * expected;
  }
  // Close to a whole turn, the axis of q does not show the axis of the turns. The motion then continues along the old
  // axis.
  const Vec3 gap = nearest - expected;
  return dot(gap, gap) > farthest_gap2 && dot(step, step) < longest_step2 ? expected : nearest;
}

Quaternion best_rotation(const Mat3& matrix, const Quaternion& near) noexcept {
  const double largest = matrix.cwiseAbs().maxCoeff();
  if (!(largest > 0) || !matrix.allFinite()) return near;
  const Mat3 m = matrix / largest;
  // Horn's matrix for the order (x, y, z, w). Eigen reads its lower triangle.
  hf_eigen::Matrix4d n;
  n(0, 0) = m(0, 0) - m(1, 1) - m(2, 2);
  n(1, 1) = m(1, 1) - m(0, 0) - m(2, 2);
  n(2, 2) = m(2, 2) - m(0, 0) - m(1, 1);
  n(1, 0) = m(0, 1) + m(1, 0);
  n(2, 0) = m(0, 2) + m(2, 0);
  n(2, 1) = m(1, 2) + m(2, 1);
  n(3, 0) = m(2, 1) - m(1, 2);
  n(3, 1) = m(0, 2) - m(2, 0);
  n(3, 2) = m(1, 0) - m(0, 1);
  n(3, 3) = m.trace();
  const hf_eigen::SelfAdjointEigenSolver<hf_eigen::Matrix4d> eigen(n);
  const Vec4& value = eigen.eigenvalues();  // ascending
  // If several eigenvalues are equal, the result is the projection of `near` on their eigenvectors.
  Vec4 sum = Vec4::Zero();
  for (int i = 0; i < 4; ++i) {
    const Vec4 v = eigen.eigenvectors().col(i);
    if (value(3) - value(i) <= equal_eigenvalues) sum += near.coeffs().dot(v) * v;
  }
  if (!(sum.squaredNorm() > least_near_share)) sum = eigen.eigenvectors().col(3);
  const Quaternion q = normalised(Quaternion(sum));
  return q.dot(near) < 0 ? Quaternion(-q.coeffs()) : q;
}

Quaternion best_rotation_from(const Mat3& s, const Quaternion& near) noexcept {
  const double size = s.norm();
  if (!(size > 0) || !std::isfinite(size)) return best_rotation(s, near);
  const double floor = newton_floor * size;
  Quaternion q = near;
  for (int iteration = 0; iteration < newton_steps; ++iteration) {
    Vec3 u;
    if (!newton_step(expand(s, q.toRotationMatrix()), floor, u)) break;
    const double step2 = dot(u, u);
    if (step2 > longest_newton_step) break;
    // A turn by the angle 2 atan(|u| / 2) is as good as one by |u| and needs no sine. The error after a step u is of
    // order u^2.
    q = normalised(Quaternion(0.5 * u, 1) * q);
    if (step2 < settled_newton_step) return q;
  }
  return best_rotation(s, near);
}

RigidMotion fit_rigid(Span<const Vec3> rest, Span<const Vec3> posed, Span<const double> weights,
                      const Quaternion& near) noexcept {
  const std::size_t count = rest.size();
  double sum = 0;
  Vec3 rest_centre, posed_centre;
  for (std::size_t i = 0; i < count; ++i) {
    const double w = weights.empty() ? 1.0 : weights[i];
    sum += w;
    rest_centre = rest_centre + w * rest[i];
    posed_centre = posed_centre + w * posed[i];
  }
  if (!(sum > 0)) return {near, {}};
  rest_centre = (1.0 / sum) * rest_centre;
  posed_centre = (1.0 / sum) * posed_centre;
  Mat3 s;
  for (std::size_t i = 0; i < count; ++i)
    add_outer(s, weights.empty() ? 1.0 : weights[i], posed[i] - posed_centre, rest[i] - rest_centre);
  RigidMotion motion;
  motion.rotation = best_rotation(s, near);
  motion.translation = posed_centre - rotate(motion.rotation, rest_centre);
  return motion;
}

}  // namespace hf_inner::deform

#include "deform/rotation.h"

#include <cmath>

namespace hf_inner {
namespace {

constexpr double pi = 3.14159265358979323846;

// Symmetric 4 x 4 eigenproblem by cyclic Jacobi rotations; columns of v are eigenvectors, d eigenvalues.
void eigen_symmetric_4(double (&a)[4][4], double (&v)[4][4], double (&d)[4]) noexcept {
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) v[i][j] = i == j ? 1.0 : 0.0;
  }
  for (int sweep = 0; sweep < 30; ++sweep) {
    double off = 0, diagonal = 0;
    for (int i = 0; i < 4; ++i) {
      diagonal += a[i][i] * a[i][i];
      for (int j = i + 1; j < 4; ++j) off += a[i][j] * a[i][j];
    }
    if (!(off > 1e-34 * (diagonal + off))) break;
    for (int p = 0; p < 3; ++p) {
      for (int q = p + 1; q < 4; ++q) {
        if (a[p][q] == 0.0) continue;
        const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
        const double t = (theta >= 0 ? 1.0 : -1.0) / (std::fabs(theta) + std::sqrt(theta * theta + 1.0));
        const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
        for (int k = 0; k < 4; ++k) {
          const double x = a[k][p], y = a[k][q];
          a[k][p] = c * x - s * y, a[k][q] = s * x + c * y;
        }
        for (int k = 0; k < 4; ++k) {
          const double x = a[p][k], y = a[q][k];
          a[p][k] = c * x - s * y, a[q][k] = s * x + c * y;
        }
        for (int k = 0; k < 4; ++k) {
          const double x = v[k][p], y = v[k][q];
          v[k][p] = c * x - s * y, v[k][q] = s * x + c * y;
        }
      }
    }
  }
  for (int i = 0; i < 4; ++i) d[i] = a[i][i];
}

double largest_entry(const Mat3& s) noexcept {
  double largest = 0;
  for (const auto& row : s.m) {
    for (const double x : row) {
      if (!(std::fabs(x) <= 1.7e308)) return -1.0;  // NaN or infinity
      largest = std::fabs(x) > largest ? std::fabs(x) : largest;
    }
  }
  return largest;
}

// tr(exp([u])' B) = tr B + u.a - u' H u / 2 + O(u^3)
struct Quadratic {
  Vec3 a;
  double h00, h11, h22, h01, h02, h12;
};

Quadratic expand(const Mat3& s, const Mat3& r) noexcept {
  Mat3 b;  // S R'
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) b.m[i][j] = s.m[i][0] * r.m[j][0] + s.m[i][1] * r.m[j][1] + s.m[i][2] * r.m[j][2];
  }
  Quadratic q;
  q.a = {b.m[2][1] - b.m[1][2], b.m[0][2] - b.m[2][0], b.m[1][0] - b.m[0][1]};
  q.h00 = b.m[1][1] + b.m[2][2], q.h11 = b.m[0][0] + b.m[2][2], q.h22 = b.m[0][0] + b.m[1][1];
  q.h01 = -0.5 * (b.m[0][1] + b.m[1][0]), q.h02 = -0.5 * (b.m[0][2] + b.m[2][0]),
  q.h12 = -0.5 * (b.m[1][2] + b.m[2][1]);
  return q;
}

// Solves H u = a by Cholesky; false when H is not safely positive definite.
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

Mat3 Mat3::identity() noexcept {
  Mat3 a;
  a.m[0][0] = a.m[1][1] = a.m[2][2] = 1;
  return a;
}

Mat3 operator+(const Mat3& a, const Mat3& b) noexcept {
  Mat3 c;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) c.m[i][j] = a.m[i][j] + b.m[i][j];
  }
  return c;
}

Mat3 operator*(double s, const Mat3& a) noexcept {
  Mat3 c;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) c.m[i][j] = s * a.m[i][j];
  }
  return c;
}

Mat3 operator*(const Mat3& a, const Mat3& b) noexcept {
  Mat3 c;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) c.m[i][j] = a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j] + a.m[i][2] * b.m[2][j];
  }
  return c;
}

Mat3 transpose(const Mat3& a) noexcept {
  Mat3 c;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) c.m[i][j] = a.m[j][i];
  }
  return c;
}

double determinant(const Mat3& a) noexcept {
  const auto& m = a.m;
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

double trace_of_product(const Mat3& a, const Mat3& b) noexcept {
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) sum += a.m[i][j] * b.m[i][j];
  }
  return sum;
}

Quaternion normalised_far(const Quaternion& q) noexcept {
  const double largest =
      std::fmax(std::fmax(std::fabs(q.x), std::fabs(q.y)), std::fmax(std::fabs(q.z), std::fabs(q.w)));
  if (!(largest > 0) || !std::isfinite(q.x + q.y + q.z + q.w)) return {};
  const double x = q.x / largest, y = q.y / largest, z = q.z / largest, w = q.w / largest;
  const double s = 1.0 / std::sqrt(x * x + y * y + z * z + w * w);
  return {s * x, s * y, s * z, s * w};
}

Quaternion to_quaternion(const Mat3& r) noexcept {
  const auto& m = r.m;
  const double t = m[0][0] + m[1][1] + m[2][2];
  // the largest component first, so that no root is taken of a small difference
  if (t >= m[0][0] && t >= m[1][1] && t >= m[2][2])
    return normalised({m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1], 1 + t});
  if (m[0][0] >= m[1][1] && m[0][0] >= m[2][2])
    return normalised({1 + 2 * m[0][0] - t, m[0][1] + m[1][0], m[0][2] + m[2][0], m[2][1] - m[1][2]});
  if (m[1][1] >= m[2][2])
    return normalised({m[0][1] + m[1][0], 1 + 2 * m[1][1] - t, m[1][2] + m[2][1], m[0][2] - m[2][0]});
  return normalised({m[0][2] + m[2][0], m[1][2] + m[2][1], 1 + 2 * m[2][2] - t, m[1][0] - m[0][1]});
}

Vec3 rotate(const Quaternion& q, Vec3 v) noexcept {
  const Vec3 u{q.x, q.y, q.z};
  const Vec3 t = 2.0 * cross(u, v);
  return v + q.w * t + cross(u, t);
}

double angle_between(const Quaternion& a, const Quaternion& b) noexcept {
  const Quaternion d = a * conjugate(b);
  return 2.0 * std::atan2(std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z), std::fabs(d.w));
}

Quaternion exponential(Vec3 v) noexcept {
  const double angle2 = dot(v, v), angle = std::sqrt(angle2);
  const double s = angle < 1e-4 ? 0.5 - angle2 / 48.0 : std::sin(0.5 * angle) / angle;
  return normalised({s * v.x, s * v.y, s * v.z, std::cos(0.5 * angle)});
}

Vec3 logarithm(const Quaternion& q) noexcept {
  const double side = q.w < 0 ? -1.0 : 1.0;
  const Vec3 u{side * q.x, side * q.y, side * q.z};
  const double sine = std::sqrt(dot(u, u)), cosine = side * q.w;
  const double s = sine < 1e-7 ? 2.0 / cosine : 2.0 * std::atan2(sine, cosine) / sine;
  return s * u;
}

Vec3 continued_logarithm(const Quaternion& q, Vec3 previous) noexcept {
  // the step from where the motion stood, at most half a turn; what follows is where it leads to first order
  const Vec3 step = logarithm(q * conjugate(exponential(previous)));
  const Vec3 expected = previous + step;
  const double expected_angle = std::sqrt(dot(expected, expected));
  const Vec3 principal = logarithm(q);
  const double angle = std::sqrt(dot(principal, principal));
  if (expected_angle <= pi && angle < 0.9 * pi) return principal;
  Vec3 nearest = principal;
  if (angle > 1e-9) {
    const double turns = std::round((dot(expected, principal) / angle - angle) / (2 * pi));
    nearest = ((angle + 2 * pi * turns) / angle) * principal;
  } else if (expected_angle > 0) {
    nearest = (2 * pi * std::round(expected_angle / (2 * pi)) / expected_angle) * expected;
  }
  // close to a whole turn the axis of q says nothing about the axis of the turns: go on along the old one
  const Vec3 gap = nearest - expected;
  return dot(gap, gap) > 1.0 && dot(step, step) < 2.25 ? expected : nearest;
}

Quaternion best_rotation(const Mat3& matrix, const Quaternion& near) noexcept {
  const double largest = largest_entry(matrix);
  if (!(largest > 0)) return near;
  const Mat3 s = (1.0 / largest) * matrix;
  const auto& m = s.m;
  // Horn's matrix for the order (w, x, y, z)
  const double xw = m[2][1] - m[1][2], yw = m[0][2] - m[2][0], zw = m[1][0] - m[0][1];
  const double xy = m[0][1] + m[1][0], xz = m[0][2] + m[2][0], yz = m[1][2] + m[2][1];
  double n[4][4] = {{m[0][0] + m[1][1] + m[2][2], xw, yw, zw},
                    {xw, m[0][0] - m[1][1] - m[2][2], xy, xz},
                    {yw, xy, m[1][1] - m[0][0] - m[2][2], yz},
                    {zw, xz, yz, m[2][2] - m[0][0] - m[1][1]}};
  double v[4][4], d[4];
  eigen_symmetric_4(n, v, d);
  double top = d[0];
  int best = 0;
  for (int i = 1; i < 4; ++i) {
    if (d[i] > top) top = d[i], best = i;
  }
  // among equals the projection of `near` on their space
  Quaternion q{0, 0, 0, 0};
  for (int i = 0; i < 4; ++i) {
    if (top - d[i] > 1e-12) continue;
    const double share = near.w * v[0][i] + near.x * v[1][i] + near.y * v[2][i] + near.z * v[3][i];
    q.w += share * v[0][i], q.x += share * v[1][i], q.y += share * v[2][i], q.z += share * v[3][i];
  }
  if (!(dot(q, q) > 1e-20)) q = {v[1][best], v[2][best], v[3][best], v[0][best]};
  q = normalised(q);
  return dot(q, near) < 0 ? Quaternion{-q.x, -q.y, -q.z, -q.w} : q;
}

Quaternion best_rotation_from(const Mat3& s, const Quaternion& near) noexcept {
  const double size = std::sqrt(trace_of_product(s, s));
  if (!(size > 0) || !std::isfinite(size)) return best_rotation(s, near);
  const double floor = 1e-6 * size;
  Quaternion q = near;
  for (int iteration = 0; iteration < 6; ++iteration) {
    Vec3 u;
    if (!newton_step(expand(s, to_matrix(q)), floor, u)) break;
    const double step2 = dot(u, u);
    if (step2 > 1.0) break;
    // the turn by 2 atan(|u| / 2) is as good as one by |u| and needs no sine; the error after a step u is of order u^2
    q = normalised(Quaternion{0.5 * u.x, 0.5 * u.y, 0.5 * u.z, 1.0} * q);
    if (step2 < 1e-14) return q;
  }
  return best_rotation(s, near);
}

Mat3 principal_axes(Mat3 a) noexcept {
  Mat3 v = Mat3::identity();
  for (int sweep = 0; sweep < 12; ++sweep) {
    bool settled = true;
    for (int p = 0; p < 3; ++p) {
      const int q = (p + 1) % 3;
      if (!(std::fabs(a.m[p][q]) > 1e-16 * (std::fabs(a.m[p][p]) + std::fabs(a.m[q][q])))) continue;
      settled = false;
      // the smaller of the two angles: with the larger one rows are swapped for ever
      const double theta = 0.5 * (a.m[q][q] - a.m[p][p]) / a.m[p][q];
      const double t = (theta >= 0 ? 1.0 : -1.0) / (std::fabs(theta) + std::sqrt(theta * theta + 1.0));
      Mat3 turn = Mat3::identity();
      turn.m[p][p] = turn.m[q][q] = 1.0 / std::sqrt(t * t + 1.0);
      turn.m[p][q] = t * turn.m[p][p], turn.m[q][p] = -turn.m[p][q];
      a = transpose(turn) * a * turn, v = v * turn;
    }
    if (settled) break;
  }
  return v;
}

RigidMotion fit_rigid(Span<const Vec3> rest, Span<const Vec3> posed, Span<const double> weights,
                      const Quaternion& near) noexcept {
  const std::size_t count = rest.size();
  double sum = 0;
  Vec3 rest_centre, posed_centre;
  for (std::size_t i = 0; i < count; ++i) {
    const double w = weights.empty() ? 1.0 : weights[i];
    sum += w, rest_centre = rest_centre + w * rest[i], posed_centre = posed_centre + w * posed[i];
  }
  if (!(sum > 0)) return {near, {}};
  rest_centre = (1.0 / sum) * rest_centre, posed_centre = (1.0 / sum) * posed_centre;
  Mat3 s;
  for (std::size_t i = 0; i < count; ++i)
    add_outer(s, weights.empty() ? 1.0 : weights[i], posed[i] - posed_centre, rest[i] - rest_centre);
  RigidMotion motion;
  motion.rotation = best_rotation(s, near);
  motion.translation = posed_centre - rotate(motion.rotation, rest_centre);
  return motion;
}

}  // namespace hf_inner

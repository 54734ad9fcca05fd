// Rotations and linear maps of joints. Rest frames come as columns of Vec3, so these few products are written by hand.
#pragma once
#include <cmath>

#include "base/elementary.h"
#include "mesh/mesh.h"

namespace hf_inner::retarget {

// A rotation as a unit quaternion.
struct Turn {
  double x = 0, y = 0, z = 0, w = 1;
};

inline Turn operator*(Turn a, Turn b) noexcept {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
inline Turn inverse(Turn a) noexcept { return {-a.x, -a.y, -a.z, a.w}; }
inline double dot(Turn a, Turn b) noexcept { return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w; }
inline Vec3 operator*(Turn a, Vec3 v) noexcept {
  const Vec3 u{a.x, a.y, a.z};
  const Vec3 t = 2.0 * cross(u, v);
  return v + a.w * t + cross(u, t);
}
inline Turn unit_turn(Turn a) noexcept {
  const double s = 1 / std::sqrt(dot(a, a));
  return {s * a.x, s * a.y, s * a.z, s * a.w};
}
inline Turn turn_about(Vec3 unit_axis, double angle) noexcept {
  const double s = sine(0.5 * angle);
  return {s * unit_axis.x, s * unit_axis.y, s * unit_axis.z, cosine(0.5 * angle)};
}
// Returns the shortest turn from the direction of a to the direction of b. Opposite directions turn about any axis
// across them.
inline Turn shortest_turn(Vec3 a, Vec3 b) noexcept {
  a = unit_vector(a);
  b = unit_vector(b);
  if (!(norm(a) > 0) || !(norm(b) > 0)) return {};
  const double w = 1 + dot(a, b);
  if (w < 1e-12) {
    const Vec3 across = unit_vector(cross(a, std::fabs(a.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
    return {across.x, across.y, across.z, 0};
  }
  const Vec3 v = cross(a, b);
  return unit_turn({v.x, v.y, v.z, w});
}
// The turn a share of the way from a to b, the short way round.
inline Turn between(Turn a, Turn b, double share) noexcept {
  if (dot(a, b) < 0) b = {-b.x, -b.y, -b.z, -b.w};
  const Turn d = inverse(a) * b;
  const Vec3 v{d.x, d.y, d.z};
  const double s = norm(v);
  if (!(s > 0)) return a;
  return a * turn_about((1 / s) * v, 2 * share * arc_tangent(s, d.w));
}

// A linear map as the images of the three axes.
struct Linear {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
};
inline Vec3 operator*(const Linear& m, Vec3 v) noexcept {
  return {v.x * m.x.x + v.y * m.y.x + v.z * m.z.x, v.x * m.x.y + v.y * m.y.y + v.z * m.z.y,
          v.x * m.x.z + v.y * m.y.z + v.z * m.z.z};
}
inline Linear operator*(const Linear& a, const Linear& b) noexcept { return {a * b.x, a * b.y, a * b.z}; }
inline double determinant(const Linear& m) noexcept { return dot(cross(m.x, m.y), m.z); }
// Solves m v = b. The map must not be flat.
inline Vec3 solve(const Linear& m, Vec3 b) noexcept {
  const Vec3 yz = cross(m.y, m.z);
  const double d = 1 / dot(m.x, yz);
  return {d * dot(b, yz), d * dot(b, cross(m.z, m.x)), d * dot(b, cross(m.x, m.y))};
}
inline Linear linear_of(Turn q, Vec3 scale) noexcept {
  return {scale.x * Vec3{1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y + q.w * q.z), 2 * (q.x * q.z - q.w * q.y)},
          scale.y * Vec3{2 * (q.x * q.y - q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z + q.w * q.x)},
          scale.z * Vec3{2 * (q.x * q.z + q.w * q.y), 2 * (q.y * q.z - q.w * q.x), 1 - 2 * (q.x * q.x + q.y * q.y)}};
}
// The turn with three perpendicular unit columns of a right-handed frame.
inline Turn turn_of_frame(Vec3 x, Vec3 y, Vec3 z) noexcept {
  const double trace = x.x + y.y + z.z;
  Turn q;
  if (trace > 0)
    q = {y.z - z.y, z.x - x.z, x.y - y.x, 1 + trace};
  else if (x.x >= y.y && x.x >= z.z)
    q = {1 + x.x - y.y - z.z, x.y + y.x, z.x + x.z, y.z - z.y};
  else if (y.y >= z.z)
    q = {x.y + y.x, 1 + y.y - x.x - z.z, y.z + z.y, z.x - x.z};
  else
    q = {z.x + x.z, y.z + z.y, 1 + z.z - x.x - y.y, x.y - y.x};
  return unit_turn(q);
}
// The rotation of a linear map: its columns made perpendicular. A map that mirrors keeps x and y and turns z round, so
// that the turn from one pose of it to another is right.
inline Turn turn_of(const Linear& m) noexcept {
  Vec3 x = unit_vector(m.x);
  if (!(norm(x) > 0)) x = {1, 0, 0};
  Vec3 y = unit_vector(m.y - dot(m.y, x) * x);
  if (!(norm(y) > 0)) y = unit_vector(cross(std::fabs(x.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}, x));
  return turn_of_frame(x, y, cross(x, y));
}

}  // namespace hf_inner::retarget

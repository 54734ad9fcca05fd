#include "retarget/legs_bend.h"

#include <algorithm>
#include <cmath>

#include "base/algebra.h"
#include "retarget/constants.h"

namespace hf_inner::retarget {
namespace {

// A distance above the soft reach comes ever less near to the full one.
double reached(double distance, double length, double turned) noexcept {
  const double soft = std::max(soft_reach * length, turned), full = full_reach * length;
  if (distance <= soft) return distance;
  if (full <= soft) return soft;
  return soft + (full - soft) * (1 - exponential(-(distance - soft) / (full - soft)));
}

// Two bones: the triangle of hip, knee and ankle. The knee bends about the axis `hinge`, across the thigh and `side`.
// It stays on one side of the line from hip to ankle: hinge x line. If a long shin is folded up beyond the hip, that
// side is below the thigh and differs from `side`.
void bend_two(const Vec3* p, Vec3 goal, double distance, Vec3 side, Vector<Turn>& bends) noexcept {
  const Vec3 thigh = p[1] - p[0], shin = p[2] - p[1];
  const double a = norm(thigh), b = norm(shin);
  const Vec3 line = unit_vector(goal - p[0]);
  const double d = std::min(std::max(distance, std::fabs(a - b) + 1e-3 * std::min(a, b)), a + b);
  const Turn whole = shortest_turn(p[2] - p[0], goal - p[0]);
  const Vec3 turned = whole * thigh;
  Vec3 out = turned - dot(turned, line) * line;
  const Vec3 hinge = unit_vector(cross(turned, whole * side)), aside = cross(hinge, line), wanted = unit_vector(aside);
  const double least = knee_side * a, is = dot(out, wanted);
  const double clear = std::min(1.0, std::max(0.0, (norm(aside) - side_unseen) / (side_seen - side_unseen)));
  if (is < least) out = out + (clear * least * (1 - is / least) * (1 - is / least)) * wanted;
  out = unit_vector(out);
  const double c = std::min(1.0, std::max(-1.0, (a * a + d * d - b * b) / (2 * a * d)));
  const Vec3 knee = (a * c) * line + (a * std::sqrt(1 - c * c)) * out;
  bends[0] = shortest_turn(turned, knee) * whole;
  bends[1] = shortest_turn(whole * shin, d * line - knee) * whole;
}

// More bones: damped least squares from the pose given, so that the smallest turns are made.
void bend_more(const Vec3* p, std::size_t n, Vec3 goal, double length, Vector<Turn>& bends) noexcept {
  constexpr std::size_t most = 8;
  Vec3 q[most + 1];
  n = std::min(n, most);
  std::copy(p, p + n + 1, q);
  for (int step = 0; step < leg_steps; ++step) {
    const Vec3 miss = goal - q[n];
    Mat3 m;
    for (int i = 0; i < 3; ++i) m(i, i) = leg_damping * length * length;
    for (std::size_t k = 0; k < n; ++k) {
      const Vec3 r = q[n] - q[k];
      const double v[] = {r.x, r.y, r.z}, rr = dot(r, r);
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) m(i, j) += (i == j ? rr : 0) - v[i] * v[j];
      }
    }
    const Linear columns{{m(0, 0), m(1, 0), m(2, 0)}, {m(0, 1), m(1, 1), m(2, 1)}, {m(0, 2), m(1, 2), m(2, 2)}};
    const Vec3 pull = solve(columns, miss);
    Turn sum;
    Vec3 end = q[0], was = q[0];
    for (std::size_t k = 0; k < n; ++k) {
      const Vec3 w = cross(q[n] - was, pull);
      const double angle = norm(w);
      if (angle > 0) sum = turn_about((1 / angle) * w, std::min(0.5, angle)) * sum;
      bends[k] = unit_turn(sum * bends[k]);
      const Vec3 next = q[k + 1];
      end = end + sum * (next - was);
      was = next;
      if (k + 1 < n) q[k + 1] = end;
    }
    q[n] = end;
  }
}

}  // namespace

void bend_leg(const Vector<Vec3>& places, Vec3 shift, Vec3 goal, Vec3 knee, Vector<Turn>& bends) {
  const std::size_t n = bends.size();
  for (Turn& bend : bends) bend = {};
  const Vec3 back = goal - shift;  // the leg stays, the goal moves
  double length = 0;
  for (std::size_t k = 0; k < n; ++k) length += norm(places[k + 1] - places[k]);
  const Vec3 line = back - places[0];
  const double distance = norm(line);
  if (!(distance > 0) || !(length > 0)) return;
  const double d = reached(distance, length, norm(places[n] - places[0]));
  const Vec3 end = places[0] + (d / distance) * line;
  if (n == 2)
    bend_two(places.data(), end, d, knee, bends);
  else
    bend_more(places.data(), n, end, length, bends);
}

void turn_segments(const Segments& leg, const Vector<Turn>& bends, bool back, Stance& stance) noexcept {
  for (std::size_t j = 0, k = 0; j < leg.joints.size(); ++j) {
    while (k + 1 < leg.count() && j >= at(leg.starts[k + 1])) ++k;
    Turn& turn = stance.turn[at(leg.joints[j])];
    turn = unit_turn((back ? inverse(bends[k]) : bends[k]) * turn);
  }
}

}  // namespace hf_inner::retarget

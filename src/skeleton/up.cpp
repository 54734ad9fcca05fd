// Finds the up axis. It uses declarations, legs and head by their names, and the axis along which the body is upright.
#include <algorithm>
#include <cmath>

#include "skeleton/body.h"

namespace hf_inner::skeleton {
namespace {

struct Extent {
  double low = 1e300, high = -1e300;
  void add(double h) noexcept {
    low = std::min(low, h);
    high = std::max(high, h);
  }
  double size() const noexcept { return high - low; }
};

// Visits the points that have weight: the vertices, or the pivots of a body without vertices.
template <class Visit>
void for_mass(const Body& body, Visit visit) {
  for (std::size_t v = 0; v < body.points.size(); ++v) visit(body.points[v], body.owners[v]);
  if (!body.points.empty()) return;
  for (Index j = 0; j < body.count; ++j) {
    if (body.kept[at(j)]) visit(body.pivots[at(j)], j);
  }
}

Extent extent(const Body& body, Vec3 axis) {
  Extent out;
  for_mass(body, [&](Vec3 p, Index) { out.add(dot(p, axis)); });
  return out;
}

// The score of an up axis: the share of paired joints at the ground, their distance, and whether the middle of the body
// is over them.
double support(const Body& body, Vec3 up) {
  const Vec3 along = cross(body.left, up);
  const Extent height = extent(body, up), width = extent(body, body.left), length = extent(body, along);
  Extent feet_width, feet_length;
  std::size_t low = 0, feet = 0, all = 0;
  Vec3 sum;
  for_mass(body, [&](Vec3 p, Index owner) {
    sum = sum + p;
    ++all;
    if (dot(p, up) > height.low + standing * height.size()) return;
    ++low;
    if (owner < 0 || body.is_central(owner)) return;
    ++feet;
    feet_width.add(dot(p, body.left));
    feet_length.add(dot(p, along));
  });
  if (feet < 2) return 0;
  const double middle = dot((1.0 / static_cast<double>(all)) * sum, along), slack = 0.1 * length.size();
  const bool over = feet_length.low - slack <= middle && middle <= feet_length.high + slack;
  double roots = 0;
  std::size_t standing_limbs = 0;
  for (const Limb& limb : body.limbs) {
    if (std::min(body.lowest_below(limb.roots[0], up), body.lowest_below(limb.roots[1], up)) >
        height.low + standing * height.size())
      continue;
    roots += (dot(body.pivots[at(limb.carrier)], up) - height.low) / std::max(height.size(), 1e-12);
    ++standing_limbs;
  }
  if (standing_limbs > 0) roots /= static_cast<double>(standing_limbs);
  const double share = static_cast<double>(feet) / static_cast<double>(low),
               wide = feet_width.size() / std::max(width.size(), 1e-12);
  return share * (0.2 + (over ? 0.4 : 0.0) + 0.4 * std::min(1.0, wide)) * (0.3 + roots);
}

// The mean direction of limbs of a class, from their roots to the far ends of their joints.
Vec3 direction_of(const Body& body, NameClass named) {
  Vec3 sum;
  for (const Limb& limb : body.limbs) {
    if (limb.named != named) continue;
    for (const Index root : limb.roots) {
      Index far = root;
      double most = 0;
      for (const Index j : body.subtree(root)) {
        const double d = norm(body.means[at(j)] - body.pivots[at(root)]);
        if (d > most) {
          most = d;
          far = j;
        }
      }
      sum = sum + (body.means[at(far)] - body.pivots[at(root)]);
    }
  }
  return unit_vector(sum);
}

// Returns the direction from the root of the body to the joints that are named head.
Vec3 head_direction(const Body& body) {
  Vec3 sum;
  for (const Index j : body.tree) {
    if (body.names[at(j)].named == NameClass::head && body.is_central(j))
      sum = sum + (body.means[at(j)] - body.pivots[at(body.root)]);
  }
  return unit_vector(sum);
}

struct Evidence {
  Vec3 legs, head;  // of length 0: none
  // 0 or more for an axis.
  double of(Vec3 up) const noexcept { return std::max(0.0, -dot(legs, up)) + 0.5 * std::max(0.0, dot(head, up)); }
};

Vec3 best_axis(const Body& body, const Evidence& evidence, double& margin) {
  // Tools put +y or +z up. The others need better reasons.
  static constexpr Vec3 axes[] = {{0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}};
  double best = -1e300, next = -1e300;
  Vec3 up = axes[0];
  for (const Vec3& axis : axes) {
    if (std::fabs(dot(axis, body.left)) > 0.5) continue;
    const double score = support(body, axis) + evidence.of(axis) + (axis.y + axis.z > 0 ? customary_up : 0.0);
    if (score > best + 1e-9) {
      next = best;
      best = score;
      up = axis;
    } else
      next = std::max(next, score);
  }
  margin = best - std::max(next, 0.0);
  return up;
}

// A declared up holds unless named legs and a named head both point along another axis: a body that rests lying. Four
// legs that point along one axis decide alone, since the head is in front of such a body.
void take_declared_up(Body& body, const Evidence& evidence, Vec3 found) {
  const auto is_leg = [](const Limb& limb) { return limb.named == NameClass::leg; };
  const bool four = std::count_if(body.limbs.begin(), body.limbs.end(), is_leg) > 1;
  const bool lies = -dot(evidence.legs, found) > 1 - 2 * unsure &&
                    dot(evidence.head, found) > (four ? 0 : 1 - 2 * unsure) && evidence.of(body.up) < 3 * unsure;
  if (lies || std::fabs(dot(body.up, body.left)) > 0.5) {
    body.up = found;
    body.up_confidence = 0.6;
    body.say(lies ? "Legs and head say the body lies at rest: up is its own."
                  : "Up as declared lies across the plane of symmetry: it is not used.");
    return;
  }
  const bool legs_known = norm(evidence.legs) > 0;
  const double legs = -dot(evidence.legs, body.up);
  body.up_confidence = !legs_known ? 0.9 : legs > 0.5 ? 0.98 : 0.8;
  if (legs_known && legs <= 0.5) body.say("Legs point down by %.2f only.", legs);
}

}  // namespace

void find_up(Body& body) {
  const Evidence evidence{direction_of(body, NameClass::leg), head_direction(body)};
  double margin = 0;
  const Vec3 found = best_axis(body, evidence, margin);
  if (body.input.up) {
    take_declared_up(body, evidence, found);
  } else {
    body.up = found;
    body.up_confidence = std::min(0.95, 0.5 + margin);
    body.say("Up comes from the balance of the body%s: ahead of the next axis by %.2f.",
             norm(evidence.legs) > 0 ? " and from its legs" : "", margin);
  }
  if (-dot(evidence.legs, body.up) > 0.5) add_reason(body.up_why, "legs down");
  if (dot(evidence.head, body.up) > 0.5) add_reason(body.up_why, "head up");
  if (body.up_why.empty()) add_reason(body.up_why, body.input.up ? "as declared" : "as it stands");
  body.left = unit_vector(body.left - dot(body.left, body.up) * body.up);
  const Extent height = extent(body, body.up);
  body.ground = height.low;
  body.height = std::max(height.size(), 1e-12);
}

}  // namespace hf_inner::skeleton

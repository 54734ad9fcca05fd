// Finds the head: declared, named, or the end of the central chain that looks most like one.
#include <algorithm>
#include <cmath>

#include "skeleton/body.h"

namespace hf_inner::skeleton {
namespace {

bool is_solid(const Body& body, Index joint) {
  return body.is_central(joint) && body.names[at(joint)].named != NameClass::loose;
}

bool is_end(const Body& body, Index joint) {
  const auto children = body.children_of(joint);
  return std::none_of(children.begin(), children.end(), [&](Index c) { return is_solid(body, c); });
}

bool may_be_head(const Body& body, Index joint) {
  if (std::fabs(body.lateral(joint)) > 2 * central) return false;
  const NameClass c = body.names[at(joint)].named;
  return c == NameClass::none || c == NameClass::head || c == NameClass::trunk || c == NameClass::neck ||
         c == NameClass::jaw;
}

std::size_t limbs_at(const Body& body, Index joint, double longer_than) {
  return static_cast<std::size_t>(std::count_if(body.limbs.begin(), body.limbs.end(), [&](const Limb& l) {
    return l.carrier == joint && l.length > longer_than;
  }));
}

// A chain has two ends: its root is one if nothing else hangs on it.
bool root_is_end(const Body& body) {
  std::size_t central_children = 0;
  for (const Index c : body.children_of(body.root)) central_children += body.is_central(c);
  return central_children == 1 && limbs_at(body, body.root, -1) == 0;
}

Index named_head(const Body& body) {
  Index best = -1;
  for (const Index j : body.tree) {
    if (body.input.roles && body.input.roles[at(j)] == static_cast<std::int32_t>(Role::head)) return j;
    if (body.names[at(j)].named != NameClass::head || !body.is_central(j)) continue;
    if (best < 0 || body.owned_count(j) > body.owned_count(best)) best = j;
  }
  return best;
}

// Whether limbs of that name hang on a joint, or on joints below it. Names alone say that a limb is an arm: the head of
// a beetle carries feelers.
bool carries(const Body& body, Index joint, NameClass named) {
  return std::any_of(body.limbs.begin(), body.limbs.end(),
                     [&](const Limb& limb) { return limb.named == named && body.is_below(limb.carrier, joint); });
}

// Returns how much an end looks like a head: high over the limbs that stand, large, with pairs on it.
double likeness(const Body& body, Index end, Vec3 base) {
  Vec3 sum;
  double squares = 0;
  std::size_t count = 0;
  const auto add = [&](Vec3 p) {
    sum = sum + p;
    squares += dot(p, p);
    ++count;
  };
  if (end == body.root) {
    for (const std::uint32_t v : body.owned_by(end)) add(body.points[v]);
  } else {
    body.for_points_below(end, add);
  }
  if (count == 0) add(body.pivots[at(end)]);
  const double share = 1.0 / static_cast<double>(count);
  const Vec3 mean = share * sum;
  const double radius = std::sqrt(std::max(0.0, share * squares - dot(mean, mean)));
  const double vertices =
      static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(1, body.points.size()));
  return 0.5 * dot(mean - base, body.up) / body.height + 2 * radius +
         0.2 * static_cast<double>(limbs_at(body, end, -1)) + vertices;
}

// The joint that owns most on the way up from an end to where limbs or chains branch off.
Index heaviest_above(const Body& body, Index end) {
  double longest = 0;
  for (const Limb& limb : body.limbs) longest = std::max(longest, limb.length);
  Index n = end;
  const auto goes_on = [&](Index j) {
    return body.carriers[at(j)] >= 0 && limbs_at(body, j, 0.5 * longest) == 0 && body.children_of(j).size() < 2;
  };
  while (goes_on(n)) n = body.carriers[at(n)];
  return limbs_at(body, n, 0.5 * longest) == 0 && body.owned_count(n) > body.owned_count(end) ? n : end;
}

Vec3 base_of(const Body& body) {
  Vec3 sum;
  double count = 0;
  for (const Limb& limb : body.limbs) {
    if (limb.stands) {
      sum = sum + body.pivots[at(limb.carrier)];
      count += 1;
    }
  }
  return count > 0 ? (1 / count) * sum : body.pivots[at(body.root)];
}

}  // namespace

void find_head(Body& body) {
  body.head = named_head(body);
  if (body.head >= 0) return;
  const Vec3 base = base_of(body);
  // The joint that carries arms is the chest. The joint that carries legs is the hips, or else the head of a spider.
  for (const bool with_legs : {false, true}) {
    double best = -1e300;
    for (const Index j : body.tree) {
      const bool root = j == body.root;
      if (!may_be_head(body, j) || !is_solid(body, j) || !(root ? root_is_end(body) : is_end(body, j))) continue;
      if (!root && (carries(body, j, NameClass::arm) || (!with_legs && carries(body, j, NameClass::leg)))) continue;
      const double like = likeness(body, j, base);
      if (like > best) {
        best = like;
        body.head = j;
      }
    }
    if (body.head >= 0) break;
  }
  if (body.head >= 0) body.head = heaviest_above(body, body.head);
}

}  // namespace hf_inner::skeleton

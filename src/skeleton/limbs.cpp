// Limbs: paired subtrees on a central joint, and the path of each from its root to a foot, a hand or a tip.
#include <algorithm>
#include <cmath>

#include "skeleton/body.h"

namespace hf_inner::skeleton {
namespace {

// Finds the class that most joints of a limb have, or the class of its root if at least half as many have that one. A
// limb of which less than half hangs loose is no loose one: its hand holds a weapon.
class ClassCount {
 public:
  void add(NameClass c) noexcept {
    ++counts_[static_cast<std::size_t>(c)];
    ++all_;
  }
  // collar: the root has the name of a shoulder, which wings have too.
  NameClass most(NameClass root, bool collar = false) noexcept {
    counts_[0] = 0;
    std::size_t& loose = counts_[static_cast<std::size_t>(NameClass::loose)];
    if (2 * loose < all_) loose = 0;
    std::size_t best = 0;
    for (std::size_t c = 2; c < class_count; ++c) {  // 1: a limb with fingers is no finger
      if (counts_[c] > counts_[best]) best = c;
    }
    if (counts_[best] == 0) best = counts_[1] > 0 ? 1 : 0;
    const std::size_t r = static_cast<std::size_t>(root);
    if (collar && best == static_cast<std::size_t>(NameClass::wing)) return NameClass::wing;
    const bool strong = root == NameClass::leg || root == NameClass::arm || root == NameClass::wing;
    return static_cast<NameClass>(strong && 2 * counts_[r] >= counts_[best] ? r : best);
  }

 private:
  std::size_t counts_[class_count] = {}, all_ = 0;
};

bool reaches_ground(const Body& body, Index joint) {
  return body.lowest_below(joint, body.up) - body.ground < standing * body.height;
}

// A leg follows the ground: skirts, sleeves and straps fall away.
void follow_ground(const Body& body, Vector<Index>& path) {
  for (;;) {
    Index next = -1;
    std::size_t low = 0;
    for (const Index c : body.children_of(path.back())) {
      if (reaches_ground(body, c)) {
        next = c;
        ++low;
      }
    }
    if (low != 1) return;
    path.push_back(next);
  }
}

// From high above the ground to it.
bool comes_down(const Body& body, Index root) {
  return reaches_ground(body, root) && body.height_of(body.pivots[at(root)]) > 2 * standing * body.height;
}

// Gives the side with the shorter path the mates of the longer one, if they are a path.
void even_paths(const Body& body, Limb& limb) {
  const int longer = limb.paths[0].size() > limb.paths[1].size() ? 0 : 1;
  if (limb.paths[0].size() == limb.paths[1].size()) return;
  const Index more = limb.paths[longer][limb.paths[1 - longer].size()];
  // A hand holds something. Names say where the hand is; without names it is where both sides end.
  if (limb.named == NameClass::none && (limb.posed || body.names[at(more)].named == NameClass::loose)) {
    limb.paths[longer].resize(limb.paths[1 - longer].size());
    return;
  }
  Vector<Index> path(&body.memory);
  for (const Index j : limb.paths[longer]) {
    const Index mate = body.mates[at(j)];
    if (mate < 0 || body.places[at(mate)] < 0 || (!path.empty() && body.carriers[at(mate)] != path.back())) return;
    path.push_back(mate);
  }
  limb.paths[1 - longer] = path;
}

double way(const Body& body, Index from, Index to) {
  return norm(body.pivots[at(to)] - body.pivots[at(from)]) + body.reaches[at(to)];
}

// The one child of the joint's own class, if the limb branches.
Index child_of_class(const Body& body, Index joint) {
  const NameClass own = body.names[at(joint)].named;
  Index found = -1;
  if (own != NameClass::leg && own != NameClass::arm && own != NameClass::tail && own != NameClass::wing) return -1;
  for (const Index c : body.children_of(joint)) {
    if (body.names[at(c)].named != own) continue;
    if (found >= 0) return -1;
    found = c;
  }
  return found;
}

// The longest child, up to where the second one is half as long (a hand), or to a finger's name.
void follow_longest(const Body& body, Vector<Index>& path) {
  for (;;) {
    const Index j = path.back();
    Index longest = -1;
    double first = 0, second = 0;
    for (const Index c : body.children_of(j)) {
      const double length = way(body, j, c);
      if (longest < 0 || length > first) {
        second = first;
        first = length;
        longest = c;
      } else
        second = std::max(second, length);
    }
    if (longest < 0 || body.names[at(longest)].named == NameClass::digit) return;
    if (second > branching * first) longest = child_of_class(body, j);
    if (longest < 0) return;
    path.push_back(longest);
  }
}

NameClass class_of_subtrees(const Body& body, const Limb& limb) {
  ClassCount count;
  for (const Index root : limb.roots) {
    for (const Index j : body.subtree(root)) count.add(body.names[at(j)].named);
  }
  return count.most(NameClass::none);
}

NameClass class_of_paths(const Body& body, const Limb& limb) {
  ClassCount count;
  for (const auto& path : limb.paths) {
    for (const Index j : path) count.add(body.names[at(j)].named);
  }
  const JointName& root = body.names[at(limb.roots[0])];
  const NameClass found = count.most(root.named, root.collar);
  return found == NameClass::none ? limb.named : found;
}

// Whether the limb at j lies to the left of the limb at its mate. Hips of some rigs stand at one place: then all joints
// of the two limbs decide.
bool lies_left(const Body& body, Index j, Index mate) {
  const double apart = body.lateral(j) - body.lateral(mate);
  if (std::fabs(apart) > central) return apart > 0;
  const auto mean = [&](Index root) {
    double sum = 0, count = 0;
    for (const Index k : body.subtree(root)) {
      sum += body.lateral(k);
      count += 1;
    }
    return sum / count;
  };
  return mean(j) >= mean(mate);
}

// The joints down from a root, each the longest child of the one above.
Vector<Index> longest_way(const Body& body, Index root) {
  Vector<Index> out(1, root, &body.memory);
  for (;;) {
    Index longest = -1;
    for (const Index c : body.children_of(out.back())) {
      if (longest < 0 || way(body, out.back(), c) > way(body, out.back(), longest)) longest = c;
    }
    if (longest < 0) return out;
    out.push_back(longest);
  }
}

// How many joints of two ways down have bones of equal lengths between them.
std::size_t equal_joints(const Body& body, const Vector<Index>& a, const Vector<Index>& b) {
  std::size_t k = 1;
  for (; k < std::min(a.size(), b.size()); ++k) {
    const double x = norm(body.pivots[at(a[k])] - body.pivots[at(a[k - 1])]),
                 y = norm(body.pivots[at(b[k])] - body.pivots[at(b[k - 1])]);
    if (std::min(x, y) < equal_bones * std::max(x, y) - one_place) break;
  }
  return k;
}

// Arms without names that rest in different poses do not mirror each other. They are the two chains on both sides of a
// central joint whose bones have equal lengths. A body whose arms are named has no others.
void pair_posed_arms(Body& body) {
  const bool has_arms = std::any_of(body.limbs.begin(), body.limbs.end(), [](const Limb& limb) {
    return limb.named == NameClass::arm || limb.named == NameClass::wing;
  });
  if (!body.named || has_arms) return;
  for (const Index carrier : body.tree) {
    if (!body.is_central(carrier)) continue;
    Index roots[2] = {-1, -1};
    for (const Index c : body.children_of(carrier)) {
      const double side = body.lateral(body.mean_below(c));
      if (body.mates[at(c)] >= 0 || body.names[at(c)].named != NameClass::none || std::fabs(side) < 2 * central)
        continue;
      Index& root = roots[side > 0 ? 0 : 1];
      if (root < 0 || body.reaches[at(c)] > body.reaches[at(root)]) root = c;
    }
    if (roots[0] < 0 || roots[1] < 0) continue;
    Vector<Index> left = longest_way(body, roots[0]), right = longest_way(body, roots[1]);
    const std::size_t count = equal_joints(body, left, right);
    const double length = norm(body.pivots[at(left[count - 1])] - body.pivots[at(left[0])]);
    if (count < 3 || length < least_arm) continue;
    for (std::size_t k = 0; k < count; ++k) {
      if (body.mates[at(left[k])] >= 0 || body.mates[at(right[k])] >= 0) break;
      body.mates[at(left[k])] = right[k];
      body.mates[at(right[k])] = left[k];
    }
    Limb limb(body.memory);
    limb.roots[0] = roots[0];
    limb.roots[1] = roots[1];
    limb.carrier = carrier;
    limb.length = 0.5 * (body.reaches[at(roots[0])] + body.reaches[at(roots[1])]);
    limb.posed = true;
    body.limbs.push_back(std::move(limb));
    body.say("Two chains of equal bones in different poses are a pair.");
  }
}

}  // namespace

void find_limbs(Body& body) {
  Vector<std::uint8_t> seen(at(body.count), 0, &body.memory);
  for (const Index j : body.tree) {
    const Index mate = body.mates[at(j)], carrier = body.carriers[at(j)];
    if (mate < 0 || seen[at(j)] || body.places[at(mate)] < 0) continue;
    if (j == body.root || !body.is_central(carrier)) continue;
    seen[at(j)] = seen[at(mate)] = 1;
    Limb limb(body.memory);
    const bool j_is_left = lies_left(body, j, mate);
    limb.roots[0] = j_is_left ? j : mate;
    limb.roots[1] = j_is_left ? mate : j;
    limb.carrier = carrier;
    limb.named = class_of_subtrees(body, limb);
    limb.length = 0.5 * (body.reaches[at(j)] + body.reaches[at(mate)]);
    body.limbs.push_back(std::move(limb));
  }
  pair_posed_arms(body);
}

void follow_limbs(Body& body) {
  for (Limb& limb : body.limbs) {
    limb.low = 1e300;
    const bool on_ground = comes_down(body, limb.roots[0]) && comes_down(body, limb.roots[1]);
    for (int side = 0; side < 2; ++side) {
      const Index root = limb.roots[side];
      limb.paths[side].assign(1, root);
      if (on_ground) {
        follow_ground(body, limb.paths[side]);
      } else {
        follow_longest(body, limb.paths[side]);
      }
      limb.low = std::min(limb.low, (body.lowest_below(root, body.up) - body.ground) / body.height);
    }
    even_paths(body, limb);
    limb.named = class_of_paths(body, limb);
    const double root_height =
        body.height_of(0.5 * (body.pivots[at(limb.roots[0])] + body.pivots[at(limb.roots[1])])) / body.height;
    limb.stands = limb.low < standing && root_height > limb.low + standing;
  }
}

}  // namespace hf_inner::skeleton

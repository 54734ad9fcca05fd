// Makes one tree of the joints of the body. A loose piece (a foot below an IK control, a piece of a robot) is hung on
// the joint that its skin touches, or that is nearest.
#include <algorithm>
#include <cmath>

#include "base/progress.h"
#include "skeleton/body.h"

namespace hf_inner::skeleton {
namespace {

using Touch = std::pair<Index, Index>;

Touch touch(Index a, Index b) noexcept { return {std::min(a, b), std::max(a, b)}; }

// Owners of vertices that lie in one place.
void add_meeting(const Body& body, Vector<Touch>& touches) {
  struct Place {
    std::int64_t x, y, z;
    Index owner;
    bool operator<(const Place& o) const noexcept {
      return x != o.x ? x < o.x : y != o.y ? y < o.y : z != o.z ? z < o.z : owner < o.owner;
    }
  };
  constexpr double cells = 1e5;  // of the diagonal: rounding is far below
  Vector<Place> places(&body.memory);
  places.reserve(body.points.size());
  for (std::size_t v = 0; v < body.points.size(); ++v) {
    const Vec3 p = cells * body.points[v];
    if (body.owners[v] >= 0) places.push_back({std::llrint(p.x), std::llrint(p.y), std::llrint(p.z), body.owners[v]});
  }
  std::sort(places.begin(), places.end());
  for (std::size_t k = 1; k < places.size(); ++k) {
    const Place &a = places[k - 1], &b = places[k];
    if (a.x == b.x && a.y == b.y && a.z == b.z && a.owner != b.owner) touches.push_back(touch(a.owner, b.owner));
  }
}

// Pairs of joints whose vertices share an edge or a place, both ways round.
Vector<Touch> find_touches(const Body& body) {
  Vector<Touch> touches(&body.memory);
  for (std::size_t t = 0; t < body.input.triangle_count; ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Index a = body.owners[body.input.triangles[3 * t + c]],
                  b = body.owners[body.input.triangles[3 * t + (c + 1) % 3]];
      if (a >= 0 && b >= 0 && a != b) touches.push_back(touch(a, b));
    }
  }
  add_meeting(body, touches);
  std::sort(touches.begin(), touches.end());
  touches.erase(std::unique(touches.begin(), touches.end()), touches.end());
  const std::size_t count = touches.size();
  for (std::size_t k = 0; k < count; ++k) touches.push_back({touches[k].second, touches[k].first});
  std::sort(touches.begin(), touches.end());
  return touches;
}

// A way to hang a piece: better ones touch, hang on the middle, are near. A chain that begins in the place of a joint
// hangs on it: it touches twice.
struct Offer {
  int touches = -1, on_middle = 0;
  double distance = 1e300;
  Index joint = -1, carrier = -1;
  bool operator<(const Offer& o) const noexcept {  // worse
    return touches != o.touches       ? touches < o.touches
           : on_middle != o.on_middle ? on_middle < o.on_middle
                                      : distance > o.distance;
  }
};

class Adoption {
 public:
  explicit Adoption(Body& body)
      : body_(body),
        touches_(find_touches(body)),
        roots_(at(body.count), -1, &body.memory),
        todo_(&body.memory),
        next_(at(body.count), -1, &body.memory),
        last_(at(body.count), -1, &body.memory),
        offers_(at(body.count), Offer{}, &body.memory),
        bounds_(at(body.count), 1e300, &body.memory),
        done_(at(body.count), 0, &body.memory),
        touching_(at(body.count), -1, &body.memory) {
    for (const Index j : body.order) {
      if (!body.kept[at(j)]) continue;
      const Index p = body.carriers[at(j)], root = roots_[at(j)] = p < 0 ? j : roots_[at(p)];
      if (root == j)
        last_[at(j)] = j;
      else {
        next_[at(last_[at(root)])] = j;
        last_[at(root)] = j;
      }
      if (root == j && root != body.root) todo_.push_back(j);
    }
  }

  std::size_t run() {
    const std::size_t pieces = todo_.size();
    join(body_.root);
    hang_mates(body_.root);
    while (!todo_.empty()) {
      poll();
      Index best = todo_[0];
      for (const Index root : todo_) {
        if (offers_[at(best)] < offers_[at(root)]) best = root;
      }
      const Offer offer = offers_[at(best)];
      hang(best, offer.carrier < 0 ? body_.root : offer.carrier);
      hang_brothers(best, offer.carrier);
      hang_mates(best);
    }
    return pieces;
  }

 private:
  bool is_todo(Index root) const { return root >= 0 && roots_[at(root)] == root && !done_[at(root)]; }

  void hang(Index root, Index carrier) {
    body_.carriers[at(root)] = carrier;
    todo_.erase(std::find(todo_.begin(), todo_.end(), root));
    join(root);
  }

  // Whether the rules allow it: never across the plane, the middle never on a limb, a limb never on its like below one
  // helper.
  bool may_hang(Index joint, Index carrier) const {
    const double side = body_.lateral(joint), other = body_.lateral(carrier);
    const Index parent = body_.parents[at(joint)];
    if (side * other < 0 && std::min(std::fabs(side), std::fabs(other)) > central) return false;
    if (std::fabs(side) < central && !body_.is_central(carrier)) return false;
    const Index root = roots_[at(joint)], other_root = roots_[at(carrier)];
    return !(parent >= 0 && joint == root && parent == body_.parents[at(other_root)] && !body_.is_central(joint) &&
             !body_.is_central(other_root));
  }

  void join(Index piece) {
    for (Index j = piece; j >= 0; j = next_[at(j)]) done_[at(j)] = 1;
    for (Index j = piece; j >= 0; j = next_[at(j)]) {
      mark_touching(j);
      // copies, so that the loop over all that is left loads nothing twice
      const Box box = body_.boxes[at(j)];
      const Vec3* const pivots = body_.pivots.data();
      const double* const bounds = bounds_.data();
      const Index *const touching = touching_.data(), *const next = next_.data();
      for (const Index root : todo_) {
        for (Index i = root; i >= 0; i = next[at(i)]) {
          if (touching[at(i)] == j || begins_at(root, i, j) || box.square_distance(pivots[at(i)]) <= bounds[at(root)])
            offer(root, i, j);
        }
      }
    }
  }

  // Single pieces keep their pivots anywhere, often all in one place.
  bool begins_at(Index root, Index i, Index j) const {
    const Vec3 apart = body_.pivots[at(i)] - body_.pivots[at(j)];
    return i == root && dot(apart, apart) < one_place * one_place && next_[at(root)] >= 0;
  }

  void mark_touching(Index joint) {
    const auto first = std::lower_bound(touches_.begin(), touches_.end(), Touch{joint, -1});
    for (auto k = first; k != touches_.end() && k->first == joint; ++k) touching_[at(k->second)] = joint;
  }

  void offer(Index root, Index i, Index j) {
    Offer made;
    made.touches = begins_at(root, i, j) ? 2 : touching_[at(i)] == j;
    Offer& best = offers_[at(root)];
    if (made.touches < best.touches) return;
    made.on_middle = made.touches && body_.is_central(j);
    made.distance = body_.boxes[at(j)].distance(body_.pivots[at(i)]);
    if (!(best < made) || !may_hang(i, j)) return;
    if (!made.touches) made.distance += body_.boxes[at(i)].distance(body_.boxes[at(j)]);
    made.joint = i;
    made.carrier = j;
    if (!(best < made)) return;
    best = made;
    // a little more than the square, so that rounding drops nothing that counts
    bounds_[at(root)] = best.touches > 0 ? -1 : (1 + 1e-9) * best.distance * best.distance;
  }

  // Hangs all loose joints of one unowned parent on the same carrier, if all are on one side.
  void hang_brothers(Index root, Index carrier) {
    const Index p = body_.parents[at(root)];
    if (p < 0 || carrier < 0) return;
    Vector<Index> brothers(&body_.memory);
    for (const Index other : todo_) {
      if (body_.parents[at(other)] == p) brothers.push_back(other);
    }
    for (const Index other : brothers) {
      if (body_.lateral(root) * body_.lateral(other) <= 0 || std::fabs(body_.lateral(other)) <= central) return;
    }
    for (const Index other : brothers) hang(other, carrier);
  }

  // A pair goes to a pair: also where the bone above is part of the body on one side alone.
  void hang_mates(Index piece) {
    for (Index j = piece; j >= 0; j = next_[at(j)]) {
      const Index mate = body_.mates[at(j)], carrier = body_.carriers[at(j)];
      if (!is_todo(mate) || carrier < 0) continue;
      const Index other = body_.is_central(carrier) ? carrier : body_.mates[at(carrier)];
      if (other >= 0 && done_[at(other)]) hang(mate, other);
    }
  }

  Body& body_;
  const Vector<Touch> touches_;
  Vector<Index> roots_, todo_, next_, last_;  // pieces as lists of joints
  Vector<Offer> offers_;                      // the best for each piece that is left
  Vector<double> bounds_;                     // of each piece: squares of distances above it make no better offer
  Vector<std::uint8_t> done_;
  Vector<Index> touching_;  // the joint that was last found to touch one
};

double distance_to_line(Vec3 p, Vec3 a, Vec3 b, double& along) noexcept {
  const Vec3 d = b - a;
  along = dot(p - a, d) / std::max(dot(d, d), 1e-300);
  return norm(p - a - along * d);
}

// A leaf on the line to a sibling with children is a twist joint: it follows that bone. So does one in the place of a
// parent that owns nothing.
bool is_twist(const Body& body, Index joint, Index parent) {
  constexpr double on_line = 0.1;  // of the bone's length
  const Vec3 p = body.pivots[at(joint)], a = body.pivots[at(parent)];
  if (body.owned_count(parent) == 0 && norm(p - a) < one_place) return true;
  for (const Index brother : body.children_of(parent)) {
    if (brother == joint || body.children_of(brother).empty()) continue;
    const Vec3 b = body.pivots[at(brother)];
    if (norm(p - b) < one_place) continue;  // where the bone ends others begin: a head between shoulders
    double along = 0;
    const double off = distance_to_line(p, a, b, along), length = norm(b - a);
    if (length > central && off < on_line * length && along > -on_line && along < 1 + on_line) return true;
  }
  return false;
}

void list_children(Body& body) {
  const std::size_t n = at(body.count);
  body.child_starts.assign(n + 1, 0);
  body.children.clear();
  for (Index j = 0; j < body.count; ++j) {
    if (body.kinds[at(j)] == JointKind::body && body.carriers[at(j)] >= 0)
      ++body.child_starts[at(body.carriers[at(j)]) + 1];
  }
  for (std::size_t j = 0; j < n; ++j) body.child_starts[j + 1] += body.child_starts[j];
  body.children.resize(at(body.child_starts[n]));
  Vector<Index> next(body.child_starts.begin(), body.child_starts.end(), &body.memory);
  for (const Index j : body.order) {
    const Index p = body.carriers[at(j)];
    if (body.kinds[at(j)] == JointKind::body && p >= 0) body.children[at(next[at(p)]++)] = j;
  }
}

void take_out_twists(Body& body) {
  std::uint32_t twists = 0;
  Vector<Index> found(&body.memory);
  for (Index j = 0; j < body.count; ++j) {
    const Index p = body.carriers[at(j)];
    const bool leaf = body.kinds[at(j)] == JointKind::body && p >= 0 && body.children_of(j).empty();
    if (leaf && !(body.input.roles && body.input.roles[at(j)] >= 0) && is_twist(body, j, p)) found.push_back(j);
  }
  for (const Index j : found) {
    body.kinds[at(j)] = JointKind::twist;
    ++twists;
  }
  if (twists > 0) body.say("%u joints lie along a bone and follow it.", twists);
}

}  // namespace

void join_pieces(Body& body) {
  bool more = false;
  for (Index j = 0; j < body.count; ++j) more |= body.kept[at(j)] && body.carriers[at(j)] < 0 && j != body.root;
  if (!more) return;
  Adoption adoption(body);
  body.say("%zu loose parts were hung on the body by their skin.", adoption.run());
}

void build_tree(Body& body) {
  list_children(body);
  take_out_twists(body);
  list_children(body);
  const std::size_t n = at(body.count);
  body.places.assign(n, -1);
  body.reaches.assign(n, 0.0);
  Vector<Index> stack(&body.memory);
  if (body.root >= 0) stack.push_back(body.root);
  while (!stack.empty()) {
    const Index j = stack.back();
    stack.pop_back();
    body.places[at(j)] = static_cast<Index>(body.tree.size());
    body.tree.push_back(j);
    const auto children = body.children_of(j);
    for (std::size_t k = children.size(); k-- > 0;) stack.push_back(children[k]);
  }
  body.ends.assign(body.tree.size(), 0);
  for (std::size_t k = body.tree.size(); k-- > 0;) {
    const Index j = body.tree[k];
    body.ends[k] = static_cast<Index>(k + 1);
    double& reach = body.reaches[at(j)];
    for (const Index c : body.children_of(j)) {
      body.ends[k] = std::max(body.ends[k], body.ends[at(body.places[at(c)])]);
      reach = std::max(reach, norm(body.pivots[at(c)] - body.pivots[at(j)]) + body.reaches[at(c)]);
    }
    if (!body.children_of(j).empty()) continue;
    Vector<double> radii(&body.memory);
    for (const std::uint32_t v : body.owned_by(j)) radii.push_back(norm(body.points[v] - body.pivots[at(j)]));
    if (radii.empty()) continue;
    const auto far = radii.begin() + static_cast<std::ptrdiff_t>((radii.size() - 1) * 19 / 20);
    std::nth_element(radii.begin(), far, radii.end());
    reach = *far;
  }
}

}  // namespace hf_inner::skeleton

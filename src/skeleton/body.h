// Holds the joints and vertices of one character and the results so far, for the steps of know_character.
#pragma once
#include <algorithm>
#include <limits>

#include "base/algebra.h"
#include "base/compiler.h"
#include "base/index.h"
#include "base/memory.h"
#include "mesh/mesh.h"
#include "skeleton/character.h"
#include "skeleton/constants.h"
#include "skeleton/names.h"

namespace hf_inner::skeleton {

struct Box {
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  bool empty() const noexcept { return low.x > high.x; }
  void add(Vec3 p) noexcept;
  void add(const Box& other) noexcept;
  Vec3 middle() const noexcept { return 0.5 * (low + high); }
  double square_distance(Vec3 p) const noexcept {
    const auto gap = [](double below, double above) { return std::max(std::max(below, above), 0.0); };
    const Vec3 d{gap(low.x - p.x, p.x - high.x), gap(low.y - p.y, p.y - high.y), gap(low.z - p.z, p.z - high.z)};
    return dot(d, d);
  }
  double distance(Vec3 p) const noexcept { return distance(Box{p, p}); }
  double distance(const Box& other) const noexcept {
    const auto gap = [](double a_low, double a_high, double b_low, double b_high) {
      const double gap = a_low - b_high > b_low - a_high ? a_low - b_high : b_low - a_high;
      return gap > 0 ? gap : 0.0;
    };
    return norm(Vec3{gap(low.x, high.x, other.low.x, other.high.x), gap(low.y, high.y, other.low.y, other.high.y),
                     gap(low.z, high.z, other.low.z, other.high.z)});
  }
};

// A pair of subtrees that mirror each other and hang on a central joint.
struct Limb {
  explicit Limb(Memory& memory) : paths{Vector<Index>(&memory), Vector<Index>(&memory)} {}
  Index roots[2] = {-1, -1};
  Index carrier = -1;      // the joint both hang on, -1: none
  Vector<Index> paths[2];  // from the root to the foot, the hand or the tip
  NameClass named = NameClass::none;
  Role role = Role::other;
  double length = 0;  // mean over both sides
  double low = 0;     // height of its lowest vertex, as a share of the body's
  double place = 0;   // along forward
  bool stands = false;
  bool posed = false;  // found by the lengths of its bones: its sides rest in different poses
};

struct Body {
  Body(const CharacterInput& given, Memory& memory);

  const CharacterInput& input;
  Memory& memory;
  Index count = 0;
  Vec3 centre;
  double scale = 1;  // units of the model for the diagonal 1

  // The joints of the caller.
  Vector<Vec3> pivots;
  Vector<RestFrame> frames;
  Vector<std::uint8_t> flipped;  // its rest transform mirrors
  Vector<Index> parents, order;  // order: parents first
  Vector<Index> enter, leave;    // a is an ancestor of b: enter[a] <= enter[b] and leave[b] <= leave[a]
  Vector<JointName> names;
  bool named = false;  // the names say something

  // The vertices.
  Vector<Vec3> points;
  Vector<Index> owners;                       // of each vertex, -1: none
  Vector<std::uint32_t> owned_starts, owned;  // vertices of each joint
  Vector<Box> boxes;                          // of the vertices of each joint
  Vector<Vec3> means;                         // of the vertices of each joint; its pivot where it has none
  Vector<std::uint8_t> owns, kept;
  Vector<JointKind> kinds;

  // The body as one tree of the kept joints.
  Vector<Index> carriers, tree;  // tree: kept joints but twists, depth first
  Vector<Index> child_starts, children;
  Vector<Index> ends;      // the subtree of tree[k] is tree[k] to tree[ends[k] - 1]
  Vector<Index> places;    // of a joint in tree, -1: none
  Vector<double> reaches;  // longest way down from a joint
  Index root = -1;

  // Symmetry.
  Vec3 left{1, 0, 0}, up{0, 1, 0}, forward{0, 0, 1};
  double offset = 0;  // of the plane along left
  Vector<Index> mates;
  bool sides_named = false;     // left is known by names or declarations
  bool sides_doubtful = false;  // the rest transforms mirror: names may name the other side
  double mirror_score = 0, mirror_margin = 1;

  Vector<Limb> limbs;
  Index head = -1;
  double ground = 0, height = 1;  // along up
  double trunk = 1;               // cosine of hips to head against up

  double up_confidence = 0, forward_confidence = 0;
  Vector<Role> roles;
  Vector<Side> sides;
  Vector<std::uint32_t> numbers;
  Vector<char> why, up_why, forward_why;

  bool is_ancestor(Index a, Index b) const noexcept {
    return enter[at(a)] <= enter[at(b)] && leave[at(b)] <= leave[at(a)];
  }
  // The same in the tree, across helpers and loose parts.
  bool is_below(Index joint, Index above) const noexcept {
    return places[at(joint)] >= places[at(above)] && places[at(joint)] < ends[at(places[at(above)])];
  }
  bool is_central(Index joint) const noexcept { return mates[at(joint)] < 0; }
  double lateral(Vec3 p) const noexcept { return dot(p, left) - offset; }
  double lateral(Index joint) const noexcept { return lateral(means[at(joint)]); }
  double height_of(Vec3 p) const noexcept { return dot(p, up) - ground; }
  Span<const Index> children_of(Index joint) const noexcept {
    const std::size_t first = at(child_starts[at(joint)]), last = at(child_starts[at(joint) + 1]);
    return {children.data() + first, last - first};
  }
  Span<const std::uint32_t> owned_by(Index joint) const noexcept {
    return {owned.data() + owned_starts[at(joint)], owned_starts[at(joint) + 1] - owned_starts[at(joint)]};
  }
  // Whether a joint has no part in the skeleton: it is a root with at most one joint below it, such as a camera.
  bool is_stray(Index joint) const noexcept;
  // The joints below a joint of the tree and itself, parents first.
  Span<const Index> subtree(Index joint) const noexcept {
    const std::size_t first = at(places[at(joint)]);
    return {tree.data() + first, at(ends[first]) - first};
  }
  std::size_t owned_count(Index joint) const noexcept { return owned_starts[at(joint) + 1] - owned_starts[at(joint)]; }
  template <class Visit>
  void for_points_below(Index joint, Visit visit) const {
    for (const Index j : subtree(joint)) {
      for (const std::uint32_t v : owned_by(j)) visit(points[v]);
    }
  }
  // The lowest coordinate along an axis of what a subtree owns; of its pivots where it owns nothing.
  double lowest_below(Index joint, Vec3 axis) const noexcept;
  Vec3 mean_below(Index joint) const noexcept;
  // Where clips lead, along the ground as far as up is known: each of length 1, or 0 if it leads nowhere.
  Vec3 travel(std::uint32_t clip) const noexcept;
  // Adds a sentence.
  void say(const char* format, ...) HF_LIKE_PRINTF(2, 3);
};

// Adds words behind a comma.
void add_reason(Vector<char>& reasons, const char* words);

// The steps, in their order.
void read_joints(Body& body);                            // intake.cpp
void read_vertices(Body& body);                          // intake.cpp
void find_owners(Body& body);                            // owners.cpp
void read_names(Body& body);                             // names.cpp
void find_mirror(Body& body);                            // mirror.cpp
void join_pieces(Body& body);                            // pieces.cpp
void build_tree(Body& body);                             // pieces.cpp
void find_limbs(Body& body);                             // limbs.cpp
void find_up(Body& body);                                // up.cpp
void follow_limbs(Body& body);                           // limbs.cpp
void find_head(Body& body);                              // head.cpp
void find_forward(Body& body);                           // forward.cpp
void assign_roles(Body& body);                           // roles.cpp
void write_character(Body& body, Character& character);  // chains.cpp

}  // namespace hf_inner::skeleton

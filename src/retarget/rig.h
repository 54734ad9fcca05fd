// One skeleton as the retarget needs it: rest transforms, what hangs on what, limbs cut into segments, skin points.
#pragma once
#include "base/index.h"
#include "base/memory.h"
#include "retarget/constants.h"
#include "retarget/retarget.h"
#include "retarget/turns.h"

namespace hf_inner::retarget {

// The joints of a rig in the space of its model.
struct Stance {
  explicit Stance(Memory& memory) : linear(&memory), place(&memory), turn(&memory) {}
  void resize(std::size_t joints);
  Vector<Linear> linear;
  Vector<Vec3> place;
  Vector<Turn> turn;  // the rotation of linear
};

// A point that joints move.
struct SkinPoint {
  static constexpr std::size_t most = 4;
  Index joints[most] = {-1, -1, -1, -1};
  double weights[most] = {};
  Vec3 local[most];
  Vec3 at(const Stance& stance) const noexcept;
};

// The end of the last bone of a chain: a place that a joint moves. -1: not known.
struct Tip {
  Index joint = -1;
  Vec3 offset;  // at rest, in the space of the model
};

// A chain of joints and the places in it where its segments begin.
struct Segments {
  explicit Segments(Memory& memory) : joints(&memory), starts(&memory) {}
  Vector<Index> joints, starts;
  Index before = -1;  // the joint that carries the first
  Tip tip;
  std::size_t count() const noexcept { return starts.size(); }
  Index first(std::size_t segment) const noexcept { return joints[at(starts[segment])]; }
};

struct RigLeg {
  explicit RigLeg(Memory& memory) : segments(memory), sole(&memory) {}
  Segments segments;
  skeleton::Side side = skeleton::Side::middle;
  Index foot = -1, toe = -1;
  double length = 0;       // of the segments
  double sole_length = 0;  // the furthest point of the sole from the ankle, over the ground
  Vector<SkinPoint> sole;
};

struct Rig {
  Rig(const RetargetSide& side, const char* name, Memory& memory);

  const char* name;  // for messages
  Index count = 0;
  Vector<Index> parents, order;  // order: what a joint depends on comes first
  Vector<Index> carriers;
  Vector<std::uint8_t> linked;  // it is placed by its carrier, which is no ancestor of it
  Vector<std::uint8_t> moves;   // it moves with the mover
  Vector<Vec3> translations, scales;
  Vector<Turn> rotations;
  Vector<std::uint8_t> flipped;  // its rest transform mirrors
  Vector<Turn> posts;            // see local_turn
  Stance file_rest;              // in which the vertices are given
  Stance rest;
  Vector<Vec3> ends;  // by joint, at rest: where a bone ends of which only the vertices are known; 0: nowhere

  Turn axes;  // takes x to left, y to up, z to forward
  Vec3 up, forward, left;
  double ground = 0, height = 0;
  double leg_length = 0, hip_height = 0;
  Index mover = -1;           // carries trunk and legs
  Vector<Index> trunk, neck;  // from the mover, without it, to the head
  Vector<Index> second_rows;  // of the mover: where a second row of bones along the trunk begins, at or below it
  Index head = -1;
  Vector<RigLeg> legs;   // hindmost first, left before right
  bool upright = false;  // on two legs

  // Reads a pose. Throws Error with the joint.
  void read_pose(const double* trs, Stance& stance) const;
  // Places joints whose turns are given: turns[j] is wanted where wanted[j] is not 0; others keep their rest.
  void place(const Vector<std::uint8_t>& wanted, Vec3 mover_place, Stance& stance) const;
  // Returns the rotation of a joint relative to its parent, from the rotations of both.
  Turn local_turn(Index joint, const Stance& stance) const noexcept;
  // Where a tip is.
  Vec3 tip_place(const Tip& tip, const Stance& stance) const noexcept;
  double height_of(Vec3 p) const noexcept { return dot(p, up) - ground; }
  Vec3 level(Vec3 v) const noexcept { return v - dot(v, up) * up; }
  // The mean of the thighs' joints; the mover where there are no legs.
  Vec3 hip_place(const Stance& stance) const noexcept;
  bool is_below(Index joint, Index ancestor) const noexcept;  // by what carries it
  bool is_under(Index joint, Index ancestor) const noexcept;  // by parents
};

// rig.cpp, rig_limbs.cpp, rig_skin.cpp
void read_rest(Rig& rig, const RetargetSide& side, Memory& memory);
void find_order(Rig& rig, Memory& memory);
void find_trunk(Rig& rig, const skeleton::Character& character);
Segments cut_chain(const Rig& rig, const skeleton::Character& character, const skeleton::Chain& chain, Memory& memory);
void find_legs(Rig& rig, const skeleton::Character& character, Memory& memory);
void find_soles(Rig& rig, const RetargetSide& side, Memory& memory);
// Sets `ends`: twice the way from each joint to the middle of the vertices that it moves most. A leg without a foot
// ends where its ankle would be.
void find_ends(Rig& rig, const RetargetSide& side, Memory& memory);
// The outermost points that the joints marked in `part` own.
Vector<SkinPoint> outer_points(const Rig& rig, const RetargetSide& side, const Vector<std::uint8_t>& part,
                               Memory& memory);
const skeleton::Chain* find_chain(const skeleton::Character& character, skeleton::Role role, skeleton::Side side,
                                  std::uint32_t number);

}  // namespace hf_inner::retarget

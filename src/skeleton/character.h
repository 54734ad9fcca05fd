// Knows a character: where its up, forward and left are, and which joints are its spine, head, arms, legs, tail.
//
// know_character reads joints, vertices and what a file declares, as plain arrays. It uses these sources, the most
// trusted first. They are declarations, the sides and words of names, the tree of the joints with its mirror and the
// vertices that joints own, and the shape of the surface. Where two disagree it takes the better founded one, lowers
// the confidence and says so in a sentence.
//
// Steps: input (intake.cpp), owners and helpers (owners.cpp), names (names.cpp), plane of symmetry and pairs
// (mirror.cpp), one tree of loose pieces (pieces.cpp), limbs (limbs.cpp), up (up.cpp), forward (forward.cpp), roles
// (roles.cpp, parts.cpp), chains and lengths (chains.cpp). Inside, positions are shares of the diagonal of the bounding
// box, so that no unit matters.
//
// Cost: linear in vertices and triangles; mates are searched in a tree of joints. Loose pieces cost their square. Bad
// input throws Error with the index and leaves nothing behind. A body that is not understood gets a low confidence, no
// error.
#pragma once
#include <cstdint>

#include "base/memory.h"
#include "mesh/mesh.h"

namespace hf_inner::skeleton {

enum class Role : std::int32_t {
  other,
  spine,
  neck,
  head,
  jaw,
  shoulder,
  arm,
  hand,
  finger,
  leg,
  foot,
  toe,
  tail,
  wing,
  ear,
  eye,
  antenna,
  fin
};
constexpr std::int32_t role_count = 18;
const char* role_name(Role role) noexcept;

// Left and right are sides of the character, not of the person who looks at it.
enum class Side : std::int32_t { middle, left, right };

// body: it carries the body. helper: control, pole, target, root: it carries nothing. end: marks the tip of a chain.
// twist: it lies along a bone and follows it.
enum class JointKind : std::int32_t { body, helper, end, twist };

// Everything but joint_count, parents and one of matrices and trs may be null.
struct CharacterInput {
  std::uint32_t joint_count = 0;
  const char* const* names = nullptr;     // of each joint, UTF-8; entries may be null
  const std::int32_t* parents = nullptr;  // -1: none
  const double* matrices = nullptr;       // rest, relative to the parent: 16 numbers a joint, columns first
  const double* trs = nullptr;            // the same as translation, rotation x y z w, scale: 10 numbers a joint
  const double* inverse_binds = nullptr;  // 16 numbers a joint, columns first; all zero: the joint has none
  const std::uint8_t* bound =
      nullptr;  // 1: a skin names the joint; null: all. Others carry rigid meshes and children only

  std::uint32_t vertex_count = 0;
  const double* positions = nullptr;  // at rest, x y z
  std::uint32_t triangle_count = 0;
  const std::uint32_t* triangles = nullptr;
  // Joints and weights of vertex v: entries influence_starts[v] to influence_starts[v + 1].
  const std::uint32_t* influence_starts = nullptr;
  const std::uint32_t* influence_joints = nullptr;
  const double* influence_weights = nullptr;
  const std::int32_t* vertex_joints = nullptr;  // of vertices without influences: the joint or node they hang on, or -1

  // Declared by a file or a host. A declared axis is taken unless the body is plainly against it.
  const double* up = nullptr;           // 3 numbers
  const double* forward = nullptr;      // 3 numbers
  const std::int32_t* roles = nullptr;  // of each joint, as Role; -1: nothing declared
  const std::int32_t* sides = nullptr;  // of each joint with a declared role, as Side

  // Where clips of the character lead: from its place at the start to that at the end, x y z each, in the space of the
  // model. One that leads nowhere says nothing.
  std::uint32_t travel_count = 0;
  const double* travels = nullptr;
};

struct Chain {
  Role role = Role::other;
  Side side = Side::middle;
  std::uint32_t number = 0;  // counts the chains of its role and side: legs from the front, others as their joints come
  std::int32_t parent = -1;  // the chain it hangs on
  std::uint32_t first = 0, count = 0;  // its joints in Character::chain_joints, root to tip
  double length = 0;                   // along the joints, up to the first joint of the chain at its tip
  double low = 0;  // height over the ground of the lowest vertex of the chain and of all joints below it
};

// Where a joint rests in the space of the model: a rotation as columns, and a place.
struct RestFrame {
  Vec3 x, y, z, origin;
};

struct Character {
  explicit Character(Memory& memory)
      : chains(&memory),
        chain_joints(&memory),
        kinds(&memory),
        roles(&memory),
        sides(&memory),
        joint_chains(&memory),
        carriers(&memory),
        mates(&memory),
        frames(&memory),
        why(&memory),
        up_why(&memory),
        forward_why(&memory) {}

  Vec3 up, forward, left;  // left = up x forward
  Vec3 middle;             // a point of the plane of symmetry, on the ground
  double up_confidence = 0, forward_confidence = 0, left_confidence = 0;
  double role_confidence = 0;

  Vector<Chain> chains;
  Vector<std::uint32_t> chain_joints;
  // One entry for each joint.
  Vector<JointKind> kinds;
  Vector<Role> roles;  // of a twist joint, the part of the bone that it lies along
  Vector<Side> sides;
  Vector<std::int32_t> joint_chains;  // -1: none
  Vector<std::int32_t> carriers;      // the joint of the body that carries it: across helpers and between loose pieces
  Vector<std::int32_t> mates;         // its mirror image, or -1
  Vector<RestFrame> frames;

  // Lengths in units of the model; 0: there is none. Lengths of legs are measured on the hindmost pair that stands.
  double height = 0, ground = 0;  // along up; ground is under the feet: the lowest vertex of the body, without worn or
                                  // held parts
  double leg_length = 0;          // hip, knee, foot, and the height of the foot
  double hip_height = 0;          // of the thigh's joint over the ground
  double arm_length = 0;          // upper arm to hand

  // Cosine of the way from the hips to the head against up: 1 stands upright, 0 is level. 1 where one is not known.
  double trunk = 1;

  bool partial = false;  // the surface is of a part of the body, as a head in a file of clips, and does not count

  Vector<char> why;  // sentences, one a line
  // The reasons for the axes in a few words: "legs down, head up".
  Vector<char> up_why, forward_why;
};

Character know_character(const CharacterInput& input, Memory& memory);

}  // namespace hf_inner::skeleton

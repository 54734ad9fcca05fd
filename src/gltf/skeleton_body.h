// One of the two characters of a SkeletonPair: what its skeleton says, and its arms, legs, wings and fins as bones.
#ifndef HF_GLTF_SKELETON_BODY_H
#define HF_GLTF_SKELETON_BODY_H

#include <optional>
#include <string>
#include <vector>

#include "gltf/character_arrays.h"
#include "gltf/pose_numbers.h"
#include "gltf/skeleton_pair.h"
#include "retarget/retarget.h"
#include "skeleton/character.h"

namespace hf_gltf {

using hf_inner::skeleton::Chain;
using hf_inner::skeleton::Character;
using hf_inner::skeleton::CharacterInput;
using hf_inner::skeleton::Role;
using hf_inner::skeleton::Side;

// From here on the skeleton decides. Below, it is a guess.
inline constexpr double enough = 0.5;
// A trunk that rises by this cosine stands upright: 53 degrees.
inline constexpr double upright_trunk = 0.6;

inline bool is_understood(const Character& c) {
  return c.role_confidence >= enough && c.up_confidence >= enough && c.forward_confidence >= enough;
}

// A pose counts as standing if its joints are this near to the mirror images of their mates, a share of the height.
// Half would refuse bodies that shift their weight to one leg; double would take a stride for a stance.
inline constexpr double most_uneven = 0.08;
// How far arms and legs are from mirroring each other: the mean over their joints, a share of the height. Infinity: no
// joint of an arm or leg has a mate.
double unevenness(const Character& c);  // stance.cpp

inline glm::dvec3 vector_of(const hf_inner::Vec3& v) { return {v.x, v.y, v.z}; }
inline glm::dvec3 place_of(const std::vector<glm::dmat4>& globals, int node) {
  return glm::dvec3(globals[static_cast<size_t>(node)][3]);
}

// An arm, a leg, a wing or a fin as two bones: root, the joint nearest to half its length, and the end.
struct BodyLimb {
  Role role = Role::other;
  Side side = Side::middle;
  std::uint32_t number = 0;
  int nodes[3] = {-1, -1, -1};
  std::vector<int> path;       // from root to end
  std::vector<double> shares;  // of its length, from root to each
  bool off = false;            // its first joint is far from the vertices it moves, so a turn takes the limb off the
                               // body
};

struct SkeletonBody {
  const JointSide side;
  CharacterArrays arrays;
  CharacterInput input;
  std::optional<Character> character;
  std::vector<BodyLimb> limbs;
  size_t leg_pairs = 0;
  bool upright = false;
  std::string doubt;  // why it is not understood

  SkeletonBody(const JointSide& given, hf_inner::Memory& memory);
  hf_inner::retarget::RetargetSide retarget_side() const { return {input, *character, nullptr}; }
  Pose rest_of() const { return rest_of(side); }
  static Pose rest_of(const JointSide& side) { return side.rest ? *side.rest : rest_pose(side.model); }

  void look();
  void find_off();
  // Counts sides of the upper body where something stands out that may be an arm and that no role names.
  size_t unknown_arms() const;
  BodyLimb limb_of(const Chain& chain, const std::vector<glm::dmat4>& globals) const;
  // Left, up and forward as columns.
  glm::dmat3 axes() const {
    return {vector_of(character->left), vector_of(character->up), vector_of(character->forward)};
  }
  // From the middle of the legs' roots, or of the hips, to the middle of the arms' roots, or of the neck.
  glm::dvec3 trunk(const std::vector<glm::dmat4>& globals) const;
};

}  // namespace hf_gltf

#endif

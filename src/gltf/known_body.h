// Reads the body from the skeleton of a model: its axes, and the part of the body for each joint. The room skeleton
// finds it (skeleton/character.h); this library has a copy of that room inside.
#ifndef HF_GLTF_KNOWN_BODY_H
#define HF_GLTF_KNOWN_BODY_H

#include <string>
#include <vector>

#include "gltf/animate.h"
#include "gltf/regions.h"

namespace hf_gltf {

enum class BodyPart { other, trunk, head, ear, antenna, arm, hand, finger, leg, tail, wing, fin };

struct KnownNode {
  BodyPart part = BodyPart::other;
  int side = 0;   // 1: left, -1: right
  int limb = -1;  // the same for all nodes of one arm, leg, wing or fin
};

struct KnownBody {
  Axes axes;
  double up_confidence = 0, forward_confidence = 0, part_confidence = 0;
  std::string up_why, forward_why;  // a few words
  std::vector<std::string> why;     // sentences
  std::vector<KnownNode> nodes;     // as the model's; empty: there is no skeleton
  // of an upright body, along the joints to the ground; else how high the hind legs begin. 0: there are no legs.
  double leg_length = 0;
  bool partial = false;  // the surface is of a part of the body and does not count
  bool upright = false;  // the way from the hips to the head leads up
  bool knows_axes() const;
  bool knows_parts() const;
  // A body with fins and without legs swims: no ground is under it.
  bool swims() const;
};

// given: axes that the caller knows, or null. pose: the pose of the mesh's positions; null: the pose of the file.
KnownBody know_body(const Model& model, const FlatMesh& mesh, const Axes* given = nullptr, const Pose* pose = nullptr);

// The travel of the target's body for one length of the source's: the ratio of the lengths of their legs. 0: one of
// them has no known legs, or neither is upright. Each rig of a four-legged body puts its shoulders and hips at heights
// of its own, so the legs of the surfaces say more there.
double leg_scale(const KnownBody& source, const KnownBody& target);

}  // namespace hf_gltf

#endif

// Finds the places of a creature that a transfer needs: feet, head or nose, tail, hands, and two places on the trunk.
// It uses the skeleton where that was understood (known_body.h), and the shape.
//
// Feet are the ends of legs of the skeleton, if it has as many on the left as on the right. Else they are the pieces of
// the surface below 12 % of the height that stand on the ground. The limit is lower for shorter legs, and a piece may
// be farther off the ground if the model rests in mid-stride. A trunk, head, ear, antenna,
// tail, wing or fin of the skeleton is no foot. Each of these except the trunk is no hand. A body without feet (a fish,
// a snake) has its ends and fins. Wings and fins come from the skeleton first. The skeleton says where up and forward
// are. Without one up is +y, the side axis is the one with the best symmetry, and forward is where toes and head point
// (+z when in doubt, as in glTF). Head, tail and hands come from the skeleton first, else from the extremities of the
// surface that the caller gives (hf_surface_find_extremities). Ears come from the skeleton only. The trunk places lie
// where a line through the belly, or through the back of an upright body, leaves the body. Every landmark says how it
// was found and how reliable it is.
#ifndef HF_GLTF_LANDMARKS_H
#define HF_GLTF_LANDMARKS_H

#include <string>
#include <vector>

#include "gltf/known_body.h"
#include "gltf/regions.h"

namespace hf_gltf {

struct Landmark {
  std::string
      name;  // "nose", "front foot left", ...; left is the side of the axes' right (+x of a model that faces +z)
  Selector place;
  glm::dvec3 position{0, 0, 0};
  double confidence = 0;  // 0..1
  std::string found;      // how, for people
};

// Who said where up and forward are.
enum class AxesFrom { caller, skeleton, surface };

struct Landmarks {
  Axes axes;
  AxesFrom axes_from = AxesFrom::surface;
  KnownBody known;
  bool upright = false;  // a body that stands on two legs and is higher than long
  size_t leg_pairs = 0;
  std::vector<Landmark> list;
  const Landmark* get(const std::string& name) const;
};

struct Body {
  const Model& model;
  const FlatMesh& mesh;
  std::vector<uint32_t> tips;  // extremities of the surface, largest first; empty: names and the box are left to go by
  const Axes* axes = nullptr;  // null to find them
};

Landmarks find_landmarks(const Body& body);

// "+y", or three numbers.
std::string axis_name(const glm::dvec3& direction);
// How the axes were found, for people: "up +y from the skeleton, 0.98: legs down, head up; faces +z, ...".
std::string axes_sentence(const Landmarks& landmarks);

}  // namespace hf_gltf

#endif

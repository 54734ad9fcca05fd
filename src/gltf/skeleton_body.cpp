// See skeleton_body.h.
#include "gltf/skeleton_body.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "gltf/clip_binding.h"

namespace hf_gltf {
SkeletonBody::SkeletonBody(const JointSide& given, hf_inner::Memory& memory)
    : side(given), arrays(given.model, given.mesh, rest_of(given)), input(arrays.input<CharacterInput>()) {
  if (given.axes) {
    input.up = &given.axes->up.x;
    input.forward = &given.axes->forward.x;
  }
  try {
    character.emplace(know_character(input, memory));
  } catch (const hf_inner::Error& error) {
    doubt = given.model.name + ": " + error.what();
    return;
  }
  look();
}

void SkeletonBody::look() {
  const Character& c = *character;
  // A caller who says what joints are knows the body.
  if (!is_understood(c) && side.model.said.empty()) doubt = "the skeleton of " + side.model.name + " is not understood";
  size_t left = 0, right = 0;
  const std::vector<glm::dmat4> globals = global_matrices(side.model, rest_of());
  for (const Chain& chain : c.chains) {
    if (chain.role != Role::arm && chain.role != Role::leg) continue;
    if (chain.role == Role::leg) ++(chain.side == Side::left ? left : right);
    limbs.push_back(limb_of(chain, globals));
  }
  leg_pairs = std::min(left, right);
  upright = c.trunk > upright_trunk && leg_pairs <= 1;
}

BodyLimb SkeletonBody::limb_of(const Chain& chain, const std::vector<glm::dmat4>& globals) const {
  const Character& c = *character;
  BodyLimb out{chain.role, chain.side, chain.number, {-1, -1, -1}, {}, {}};
  std::vector<int> path;
  for (std::uint32_t k = 0; k < chain.count; ++k) path.push_back(static_cast<int>(c.chain_joints[chain.first + k]));
  const auto index = static_cast<std::int32_t>(&chain - c.chains.data());
  const Role end = chain.role == Role::arm ? Role::hand : Role::foot;
  bool ended = false;
  for (const Chain& next : c.chains) {
    if (ended || next.parent != index || next.role != end) continue;
    path.push_back(static_cast<int>(c.chain_joints[next.first]));
    ended = true;
  }
  out.nodes[0] = path[0];
  if (path.size() < 2) return out;
  // A limb without a hand or foot, of two joints: where its second bone ends is not known.
  if (!ended && path.size() == 2) {
    out.nodes[1] = path[1];
    return out;
  }
  std::vector<double> along(1, 0.0);
  for (size_t k = 1; k < path.size(); ++k)
    along.push_back(along.back() + glm::distance(place_of(globals, path[k]), place_of(globals, path[k - 1])));
  size_t middle = 0;
  for (size_t k = 1; k + 1 < path.size(); ++k)
    if (middle == 0 || std::abs(along[k] - along.back() / 2) < std::abs(along[middle] - along.back() / 2)) middle = k;
  if (middle > 0) out.nodes[1] = path[middle];
  out.nodes[2] = path.back();
  out.path = std::move(path);
  for (const double length : along) out.shares.push_back(along.back() > 0 ? length / along.back() : 0);
  return out;
}

glm::dvec3 SkeletonBody::trunk(const std::vector<glm::dmat4>& globals) const {
  glm::dvec3 low(0), high(0);
  double lows = 0, highs = 0;
  for (const BodyLimb& limb : limbs) {
    const glm::dvec3 place = place_of(globals, limb.nodes[0]);
    if (limb.role == Role::leg && limb.number + 1 >= leg_pairs) {
      low += place;
      lows += 1;
    }
    if (limb.role == Role::arm || (limb.role == Role::leg && leg_pairs > 1 && limb.number == 0)) {
      high += place;
      highs += 1;
    }
  }
  return lows > 0 && highs > 0 ? high / highs - low / lows : glm::dvec3(0);
}

}  // namespace hf_gltf

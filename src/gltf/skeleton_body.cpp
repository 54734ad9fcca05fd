// See skeleton_body.h.
#include "gltf/skeleton_body.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <map>

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

namespace {

// The joint or node that moves a vertex most; -1: none.
int owner_of(const CharacterArrays& arrays, size_t v) {
  int owner = arrays.vertex_joints[v];
  double most = 0;
  for (std::uint32_t k = arrays.starts[v]; k < arrays.starts[v + 1]; ++k) {
    if (!(arrays.weights[k] > most)) continue;
    most = arrays.weights[k];
    owner = static_cast<int>(arrays.joints[k]);
  }
  return owner;
}

}  // namespace

void SkeletonBody::look() {
  const Character& c = *character;
  // A caller who says what joints are knows the body.
  if (!is_understood(c) && side.model.said.empty()) doubt = "the skeleton of " + side.model.name + " is not understood";
  size_t left = 0, right = 0;
  const std::vector<glm::dmat4> globals = global_matrices(side.model, rest_of());
  for (const Chain& chain : c.chains) {
    if (chain.role != Role::arm && chain.role != Role::leg && chain.role != Role::wing && chain.role != Role::fin)
      continue;
    if (chain.role == Role::leg) ++(chain.side == Side::left ? left : right);
    limbs.push_back(limb_of(chain, globals));
  }
  find_off();
  leg_pairs = std::min(left, right);
  upright = c.trunk > upright_trunk && leg_pairs <= 1;
}

void SkeletonBody::find_off() {
  // Sizes of the limb: a turn about a point farther away throws it off the body. Half comes near to thighs that begin
  // above their skin, as in the fox of Khronos; double loses pieces whose joint is the middle of the model.
  constexpr double far = 0.5;
  std::map<int, size_t> limb_of_node;
  for (size_t k = 0; k < limbs.size(); ++k) {
    for (const int node : limbs[k].path) limb_of_node[node] = k;
    for (const int node : limbs[k].nodes) limb_of_node[node] = k;
  }
  std::vector<std::pair<glm::dvec3, glm::dvec3>> boxes(limbs.size(), {glm::dvec3(1e300), glm::dvec3(-1e300)});
  for (size_t v = 0; v + 1 < arrays.starts.size(); ++v) {
    const int owner = owner_of(arrays, v);
    const auto at = limb_of_node.find(owner);
    if (owner < 0 || at == limb_of_node.end()) continue;
    auto& [low, high] = boxes[at->second];
    const glm::dvec3 p = glm::make_vec3(arrays.positions.data() + 3 * v);
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  for (size_t k = 0; k < limbs.size(); ++k) {
    const auto& [low, high] = boxes[k];
    const glm::dvec3 joint = vector_of(character->frames[static_cast<size_t>(limbs[k].nodes[0])].origin);
    limbs[k].off =
        low.x <= high.x && glm::distance(joint, glm::clamp(joint, low, high)) > far * glm::distance(low, high);
  }
}

BodyLimb SkeletonBody::limb_of(const Chain& chain, const std::vector<glm::dmat4>& globals) const {
  const Character& c = *character;
  BodyLimb out{chain.role, chain.side, chain.number, {-1, -1, -1}, {}, {}, false};
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

namespace {

bool is_trunk(Role role) { return role == Role::spine || role == Role::neck || role == Role::shoulder; }

// A wing is as unknown as an arm that looks like one: where arms have no partner, nothing leads either.
bool is_unknown(Role role) { return role == Role::other || role == Role::wing; }

// For each node of unknown part below the trunk: the topmost such node above it. -1: its part is known, or it is below
// another part.
std::vector<int> unknown_parts(const Model& model, const Character& c) {
  std::vector<int> out(model.nodes.size(), -1);
  for (size_t n = 0; n < out.size(); ++n) {
    int top = -1, at = static_cast<int>(n);
    for (size_t steps = 0; at >= 0 && steps <= out.size() && is_unknown(c.roles[static_cast<size_t>(at)]); ++steps) {
      top = at;
      const std::int32_t carrier = c.carriers[static_cast<size_t>(at)];
      at = carrier >= 0 ? carrier : model.nodes[static_cast<size_t>(at)].parent;
    }
    if (at >= 0 && is_trunk(c.roles[static_cast<size_t>(at)])) out[n] = top;
  }
  return out;
}

}  // namespace

size_t SkeletonBody::unknown_arms() const {
  // Shares of the height. A part is as large as an arm may be: half takes a pouch for an arm, double loses the arm of a
  // robot. Its middle is beside the plane of symmetry: half takes a pack that hangs askew, double loses an arm that
  // hangs close. It begins above the hips by this share of the height above them: a skirt begins there, a shoulder at
  // .6.
  constexpr double large = 0.15, beside = 0.06, above_hips = 0.25;
  const Character& c = *character;
  const glm::dvec3 up = vector_of(c.up), left = vector_of(c.left), middle = vector_of(c.middle);
  const std::vector<int> parts = unknown_parts(side.model, c);
  struct Part {
    glm::dvec3 low{1e300}, high{-1e300};
    double sum = 0, count = 0, top = 0;
  };
  std::map<int, Part> found;
  for (size_t v = 0; v + 1 < arrays.starts.size(); ++v) {
    const int owner = owner_of(arrays, v);
    if (owner < 0 || parts[static_cast<size_t>(owner)] < 0) continue;
    const glm::dvec3 p = glm::make_vec3(arrays.positions.data() + 3 * v) - middle;
    Part& part = found[parts[static_cast<size_t>(owner)]];
    part.low = glm::min(part.low, p);
    part.high = glm::max(part.high, p);
    part.top = std::max(part.top, glm::dot(p, up));
    part.sum += glm::dot(p, left);
    part.count += 1;
  }
  bool sides[2] = {false, false};
  const double begins = c.hip_height + above_hips * (c.height - c.hip_height);
  for (const auto& [node, part] : found) {
    const double aside = part.sum / part.count;
    if (glm::distance(part.low, part.high) > large * c.height && std::abs(aside) > beside * c.height &&
        part.top > begins)
      sides[aside > 0 ? 0 : 1] = true;
  }
  return static_cast<size_t>(sides[0]) + static_cast<size_t>(sides[1]);
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

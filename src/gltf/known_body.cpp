#include "gltf/known_body.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "gltf/skeleton_body.h"

namespace hf_gltf {
namespace {

// A forward that is nearer to a coordinate axis is that axis: 20 degrees. A rest in mid-stride turns the hips.
constexpr double straight = 0.94;

glm::dvec3 straightened(const glm::dvec3& v) {
  for (int c = 0; c < 3; ++c) {
    if (std::abs(v[c]) < straight) continue;
    glm::dvec3 out(0);
    out[c] = v[c] > 0 ? 1 : -1;
    return out;
  }
  return v;
}

BodyPart part_of(Role role) {
  switch (role) {
    case Role::spine:
    case Role::neck:
    case Role::shoulder:
      return BodyPart::trunk;
    case Role::head:
    case Role::jaw:
    case Role::eye:
      return BodyPart::head;
    case Role::ear:
      return BodyPart::ear;
    case Role::antenna:
      return BodyPart::antenna;
    case Role::arm:
      return BodyPart::arm;
    case Role::hand:
      return BodyPart::hand;
    case Role::finger:
      return BodyPart::finger;
    case Role::leg:
    case Role::foot:
    case Role::toe:
      return BodyPart::leg;
    case Role::tail:
      return BodyPart::tail;
    case Role::wing:
      return BodyPart::wing;
    case Role::fin:
      return BodyPart::fin;
    default:
      return BodyPart::other;
  }
}

// The chain in which a limb begins: from toes over the foot to the leg, from fingers over the hand to the arm, from the
// feathers to the wing.
int limb_of_chain(const Character& character, int chain) {
  const auto part = [&](int c) { return part_of(character.chains[static_cast<size_t>(c)].role); };
  const auto is_leg = [&](int c) { return part(c) == BodyPart::leg; };
  const auto is_arm = [&](int c) {
    return part(c) == BodyPart::arm || part(c) == BodyPart::hand || part(c) == BodyPart::finger;
  };
  const bool leg = is_leg(chain), arm = is_arm(chain);
  const BodyPart own = part(chain);
  if (!leg && !arm && own != BodyPart::wing && own != BodyPart::fin) return -1;
  for (;;) {
    const int above = character.chains[static_cast<size_t>(chain)].parent;
    if (above < 0 || !(leg ? is_leg(above) : arm ? is_arm(above) : part(above) == own)) return chain;
    chain = above;
  }
}

KnownNode node_of(const Character& character, size_t joint) {
  KnownNode out;
  out.part = part_of(character.roles[joint]);
  out.side = character.sides[joint] == Side::left ? 1 : character.sides[joint] == Side::right ? -1 : 0;
  int carrier = static_cast<int>(joint);
  while (carrier >= 0 && character.joint_chains[static_cast<size_t>(carrier)] < 0)
    carrier = character.carriers[static_cast<size_t>(carrier)];
  if (carrier >= 0) out.limb = limb_of_chain(character, character.joint_chains[static_cast<size_t>(carrier)]);
  return out;
}

std::vector<std::string> lines_of(const hf_inner::Vector<char>& text) {
  std::vector<std::string> out;
  std::string line;
  for (const char c : text) {
    if (c != '\n') {
      line += c;
    } else {
      out.push_back(line);
      line.clear();
    }
  }
  return out;
}

// A mesh that hangs on a joint without a skin is of the same part. Things in hands are not.
void pass_to_meshes(const Model& model, const std::vector<uint8_t>& bound, std::vector<KnownNode>& nodes) {
  for (size_t n = 0; n < nodes.size(); ++n) {
    if (bound[n]) continue;
    int above = model.nodes[n].parent;
    while (above >= 0 && !bound[static_cast<size_t>(above)]) above = model.nodes[static_cast<size_t>(above)].parent;
    const BodyPart part = above < 0 ? BodyPart::other : nodes[static_cast<size_t>(above)].part;
    if (above >= 0 && part != BodyPart::hand && part != BodyPart::finger) nodes[n] = nodes[static_cast<size_t>(above)];
  }
}

void take(const Character& character, KnownBody& out) {
  out.axes.up = straightened(vector_of(character.up));
  const glm::dvec3 forward = vector_of(character.forward);
  out.axes.forward = straightened(glm::normalize(forward - glm::dot(forward, out.axes.up) * out.axes.up));
  out.axes.right = glm::cross(out.axes.up, out.axes.forward);
  out.up_confidence = character.up_confidence;
  out.forward_confidence = character.forward_confidence;
  out.part_confidence = character.role_confidence;
  out.up_why.assign(character.up_why.begin(), character.up_why.end());
  out.forward_why.assign(character.forward_why.begin(), character.forward_why.end());
  out.why = lines_of(character.why);
  out.partial = character.partial;
  const auto is_leg = [](const Chain& chain) { return chain.role == Role::leg && chain.side == Side::left; };
  out.upright =
      character.trunk > upright_trunk && std::count_if(character.chains.begin(), character.chains.end(), is_leg) == 1;
  // A body on four legs stands on bent ones as long as it lives. One that is upright may rest crouched and walk
  // straight.
  out.leg_length = out.upright ? character.leg_length : character.hip_height;
  for (size_t j = 0; j < character.roles.size(); ++j) out.nodes.push_back(node_of(character, j));
}

}  // namespace

bool KnownBody::knows_axes() const { return knows_parts() && up_confidence >= enough && forward_confidence >= enough; }

bool KnownBody::knows_parts() const { return !nodes.empty() && part_confidence >= enough; }

bool KnownBody::swims() const {
  const auto has = [&](BodyPart part) {
    return std::any_of(nodes.begin(), nodes.end(), [&](const KnownNode& node) { return node.part == part; });
  };
  return knows_parts() && has(BodyPart::fin) && !has(BodyPart::leg);
}

KnownBody know_body(const Model& model, const FlatMesh& mesh, const Axes* given, const Pose* pose) {
  KnownBody out;
  if (model.nodes.empty()) return out;
  const CharacterArrays arrays(model, mesh, pose ? *pose : rest_pose(model));
  auto input = arrays.input<hf_inner::skeleton::CharacterInput>();
  if (given) {
    input.up = &given->up.x;
    input.forward = &given->forward.x;
  }
  try {
    hf_inner::Memory memory;
    take(know_character(input, memory), out);
    pass_to_meshes(model, arrays.bound, out.nodes);
  } catch (const hf_inner::Error& error) {  // more joints than any character has
    out = KnownBody();
    out.why.push_back(error.what());
  }
  return out;
}

double leg_scale(const KnownBody& source, const KnownBody& target) {
  const bool known = source.knows_parts() && target.knows_parts() && source.leg_length > 0 && target.leg_length > 0;
  return known && (source.upright || target.upright) ? target.leg_length / source.leg_length : 0.0;
}

}  // namespace hf_gltf

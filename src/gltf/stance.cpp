// Compares the pose of the nodes with the bound pose and with the poses at both ends of clips.
#include "gltf/stance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "gltf/skeleton_body.h"

namespace hf_gltf {
namespace {

// A leg is in the air if its lowest vertex is higher than this share of the height. It is twice the height at which a
// limb still counts as standing.
constexpr double lifted = 0.12;
// A joint that is off by this share of the height turns a limb of half the height by two degrees. Bodies of the data
// lie on both sides: a robot off by 0.013 moves better as it stands, one in a frame of an idle clip, off by 0.03, moves
// better as bound.
constexpr double even_enough = 0.02;
// A file may hold hundreds of clips, and thousands of loose joints. Clips of one body begin alike, and joints of one
// skin are bound alike. More cost time.
constexpr size_t stance_clips = 8, most_roots = 8;
constexpr std::ptrdiff_t most_legs = 1 << 16;  // more than any body has

struct Look {
  bool understood = false;
  double uneven = std::numeric_limits<double>::infinity();
  std::ptrdiff_t lifted = 0;  // legs in the air
  glm::dvec3 up{0};
};

std::ptrdiff_t lifted_legs(const Character& c) {
  return std::count_if(c.chains.begin(), c.chains.end(),
                       [&](const Chain& chain) { return chain.role == Role::leg && chain.low > lifted * c.height; });
}

// Returns whether a body faces its declared direction, as far as its shape shows where it faces.
bool faces_as_said(hf_inner::skeleton::CharacterInput input, hf_inner::Memory& memory) {
  // The cosine of 45 degrees: farther off, another axis of the body is nearer. Half, 70 degrees, would accept a pose
  // that a clip turns aside. A cosine near 1 would refuse a body that a clip turns by a few degrees.
  constexpr double near = 0.7;
  const glm::dvec3 said(input.forward[0], input.forward[1], input.forward[2]);
  input.forward = nullptr;
  const Character c = know_character(input, memory);
  return c.forward_confidence < enough || glm::dot(vector_of(c.forward), said) >= near * glm::length(said);
}

// of_file: the pose is the pose of the file. Given axes and declarations of the file hold in that pose.
Look look_at(const Model& model, const FlatMesh& mesh, const Pose& pose, const Axes* axes, bool of_file) {
  const CharacterArrays arrays(model, mesh, pose);
  auto input = arrays.input<hf_inner::skeleton::CharacterInput>();
  if (axes) {
    input.up = &axes->up.x;
    input.forward = &axes->forward.x;
  }
  Look out;
  try {
    hf_inner::Memory memory;
    const Character c = know_character(input, memory);
    out.understood = is_understood(c) && (of_file || !input.forward || faces_as_said(input, memory));
    out.uneven = unevenness(c);
    out.lifted = lifted_legs(c);
    out.up = vector_of(c.up);
  } catch (const hf_inner::Error&) {  // more joints than any character has
  }
  return out;
}

glm::dquat axes_rotation(const glm::dmat4& m) {
  glm::dmat3 axes(m);
  for (int c = 0; c < 3; ++c) axes[c] = glm::normalize(axes[c]);
  if (glm::determinant(axes) < 0) axes = -axes;
  return glm::normalize(glm::quat_cast(axes));
}

// How far the joints of a skin are from where it was bound, once a transform moves these.
double apart(const Skin& skin, const std::vector<glm::dmat4>& globals, const glm::dmat4& moved) {
  double sum = 0;
  for (size_t k = 0; k < skin.joints.size(); ++k)
    sum += glm::distance(glm::dvec3(globals[static_cast<size_t>(skin.joints[k])][3]),
                         glm::dvec3((moved * glm::inverse(glm::dmat4(skin.inverse_bind[k])))[3]));
  return sum;
}

double size_of(const glm::dmat4& m) { return std::cbrt(std::abs(glm::determinant(glm::dmat3(m)))); }

// Returns the transform from the space in which a skin was bound to the world. A frame of the file says it: the node of
// the mesh, or the node above the joints. If no frame fits, joints without a parent in the skin rest where they were
// bound.
glm::dmat4 world_of(const Model& model, size_t index, const std::vector<glm::dmat4>& globals) {
  constexpr double same_size = 0.01, near = 3;  // a frame is off by axes or units if the joints come much farther away
  const Skin& skin = model.skins[index];
  std::vector<glm::dmat4> frames{glm::dmat4(1)}, roots;
  for (size_t n = 0; n < model.nodes.size(); ++n)
    if (model.nodes[n].skin == static_cast<int>(index) && frames.size() < most_roots) frames.push_back(globals[n]);
  std::vector<uint8_t> bound(model.nodes.size(), 0);
  for (const int joint : skin.joints) bound[static_cast<size_t>(joint)] = 1;
  for (size_t k = 0; k < skin.joints.size() && roots.size() < most_roots; ++k) {
    const auto joint = static_cast<size_t>(skin.joints[k]);
    const int parent = model.nodes[joint].parent;
    if (parent >= 0 && bound[static_cast<size_t>(parent)]) continue;
    roots.push_back(globals[joint] * glm::dmat4(skin.inverse_bind[k]));
    if (parent >= 0) frames.push_back(globals[static_cast<size_t>(parent)]);
  }
  const auto nearest = [&](const std::vector<glm::dmat4>& list) {
    return *std::min_element(list.begin(), list.end(), [&](const glm::dmat4& a, const glm::dmat4& b) {
      return apart(skin, globals, a) < apart(skin, globals, b);
    });
  };
  if (roots.empty()) return nearest(frames);
  const glm::dmat4 root = nearest(roots);
  frames.erase(std::remove_if(frames.begin(), frames.end(),
                              [&](const glm::dmat4& m) {
                                return std::abs(size_of(m) - size_of(root)) > same_size * size_of(root);
                              }),
               frames.end());
  if (frames.empty()) return root;
  const glm::dmat4 frame = nearest(frames);
  return apart(skin, globals, frame) <= near * apart(skin, globals, root) ? frame : root;
}

// Turns the joints to where their skins were bound; bones keep their lengths. None: the joints are there already, or
// the file does not say where they were bound.
std::optional<Pose> bound_pose(const Model& model, const Pose& rest) {
  const std::vector<glm::dmat4> globals = global_matrices(model, rest);
  std::vector<std::optional<glm::dquat>> wanted(model.nodes.size());
  for (size_t s = 0; s < model.skins.size(); ++s) {
    const Skin& skin = model.skins[s];
    const glm::dmat4 world = world_of(model, s, globals);
    for (size_t k = 0; k < skin.joints.size(); ++k) {
      const glm::dmat4 bind(skin.inverse_bind[k]);
      const double volume = glm::determinant(glm::dmat3(bind));
      if (!(std::abs(volume) > 0) || !std::isfinite(volume)) return {};
      auto& turn = wanted[static_cast<size_t>(skin.joints[k])];
      if (!turn) turn = axes_rotation(world * glm::inverse(bind));
    }
  }
  std::vector<double> numbers;
  append_trs(rest, numbers);
  const Pose parts = pose_of(rest, numbers);  // matrices are split
  Pose out = rest;
  bool turned = false;
  std::vector<int> all(model.nodes.size());
  for (size_t n = 0; n < all.size(); ++n) all[n] = static_cast<int>(n);
  std::vector<glm::dmat4> now(globals);
  for (const int node : with_parents(model, all)) {
    const auto n = static_cast<size_t>(node);
    const int parent = model.nodes[n].parent;
    const glm::dmat4 above = parent < 0 ? glm::dmat4(1) : now[static_cast<size_t>(parent)];
    if (wanted[n]) {
      // A mirrored parent turns the other way; such rigs keep the pose of their nodes.
      if (glm::determinant(glm::dmat3(above)) < 0) return {};
      out[n] = parts[n];
      out[n].rotation = glm::normalize(glm::inverse(axes_rotation(above)) * *wanted[n]);
      turned |= std::abs(glm::dot(out[n].rotation, parts[n].rotation)) < 1 - 1e-6;
    }
    now[n] = above * local_matrix(out[n]);
  }
  if (!turned) return {};
  return out;
}

double lowest(const std::vector<glm::dvec3>& positions, const glm::dvec3& up) {
  double low = std::numeric_limits<double>::infinity();
  for (const glm::dvec3& p : positions) low = std::min(low, glm::dot(p, up));
  return low;
}

// Shifts the topmost joints until the lowest vertex is as low as in the file. Straight legs under crouched hips end
// below the ground, and a clip that counts from there floats.
void set_on_ground(Pose& pose, const Model& model, const FlatMesh& mesh, const glm::dvec3& up) {
  const double raise = lowest(mesh.positions, up) - lowest(posed_positions(model, mesh, pose), up);
  const std::vector<glm::dmat4> globals = global_matrices(model, pose);
  std::vector<uint8_t> joint(model.nodes.size(), 0);
  for (const Skin& skin : model.skins)
    for (const int node : skin.joints) joint[static_cast<size_t>(node)] = 1;
  for (size_t n = 0; n < joint.size(); ++n) {
    const int parent = model.nodes[n].parent;
    if (!joint[n] || (parent >= 0 && joint[static_cast<size_t>(parent)])) continue;
    const glm::dmat3 above = parent < 0 ? glm::dmat3(1) : glm::dmat3(globals[static_cast<size_t>(parent)]);
    pose[n].translation += glm::inverse(above) * (raise * up);
  }
}

}  // namespace

double unevenness(const Character& c) {
  const glm::dvec3 left = vector_of(c.left);
  glm::dvec3 middle(0);
  double count = 0, sum = 0;
  const auto each_pair = [&](auto&& visit) {
    for (size_t j = 0; j < c.mates.size(); ++j) {
      const bool limb =
          c.roles[j] == Role::arm || c.roles[j] == Role::leg || c.roles[j] == Role::hand || c.roles[j] == Role::foot;
      if (limb && c.mates[j] > static_cast<std::int32_t>(j))
        visit(vector_of(c.frames[j].origin), vector_of(c.frames[static_cast<size_t>(c.mates[j])].origin));
    }
  };
  each_pair([&](const glm::dvec3& a, const glm::dvec3& b) {
    middle += 0.5 * (a + b);
    count += 1;
  });
  if (!(count > 0) || !(c.height > 0)) return std::numeric_limits<double>::infinity();
  const double offset = glm::dot(middle / count, left);
  each_pair([&](const glm::dvec3& a, const glm::dvec3& b) {
    sum += glm::distance(a - 2 * (glm::dot(a, left) - offset) * left, b);
  });
  return sum / count / c.height;
}

FlatMesh standing(FlatMesh mesh, const Model& model, const Pose& pose) {
  mesh.positions = posed_positions(model, mesh, pose);
  return mesh;
}

std::optional<Stance> find_stance(const Model& model, const FlatMesh& mesh, const Axes* axes) {
  if (model.skins.empty()) return {};
  const Pose rest = rest_pose(model);
  const Look own = look_at(model, mesh, rest, axes, true);
  const bool stands = own.understood && own.lifted == 0;
  if (stands && own.uneven <= even_enough) return {};
  std::optional<Stance> best;
  // A pose that is understood and more than twice as even is better. So is any that is understood where none was, or
  // that has more legs on the ground: a body that rears does not stand.
  double uneven = own.understood ? 0.5 * own.uneven : std::numeric_limits<double>::infinity();
  std::ptrdiff_t lifted_in_best = own.understood ? own.lifted : most_legs;
  const auto is_even = [&] { return best && uneven <= most_uneven; };
  const auto offer = [&](const Pose& pose, const std::string& from) {
    const Look look = look_at(model, standing(mesh, model, pose), pose, axes, false);
    const bool more = look.lifted < lifted_in_best;
    if (!look.understood || look.lifted > lifted_in_best || !(more || (look.uneven < uneven && !is_even()))) return;
    uneven = look.uneven;
    lifted_in_best = look.lifted;
    best = Stance{pose, !own.understood || look.lifted < own.lifted, from};
  };
  if (std::optional<Pose> bound = bound_pose(model, rest)) {
    if (stands) set_on_ground(*bound, model, mesh, own.up);
    offer(*bound, "as bound");
  }
  if (stands && own.uneven <= most_uneven) return best;
  // A clip that gets up ends standing.
  const size_t clips = std::min(model.animations.size(), stance_clips);
  for (size_t k = 0; k < 2 * clips && !(is_even() && lifted_in_best == 0); ++k) {
    const Animation& clip = model.animations[k % clips];
    const bool end = k >= clips;
    offer(sample(model, clip, end ? clip_duration(clip) : 0),
          std::string(end ? "as at the end of" : "as at the start of") + " the clip \"" + clip.name + "\"");
  }
  return best;
}

}  // namespace hf_gltf

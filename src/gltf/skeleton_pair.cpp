// See skeleton_pair.h.
#include "gltf/skeleton_pair.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "gltf/character_arrays.h"
#include "gltf/clip_binding.h"
#include "retarget/retarget.h"
#include "skeleton/character.h"

namespace hf_gltf {
namespace {

using hf_inner::Chain;
using hf_inner::Character;
using hf_inner::CharacterInput;
using hf_inner::Role;
using hf_inner::Side;

// What the skeleton says is taken from here on. Below, it is a guess.
constexpr double enough = 0.5;
// A trunk that rises by this cosine stands upright: 53 degrees.
constexpr double upright_trunk = 0.6;
constexpr double degree = 3.14159265358979323846 / 180;

glm::dvec3 vector_of(const hf_inner::Vec3& v) { return {v.x, v.y, v.z}; }

// 10 numbers a node: translation, rotation x y z w, scale.
void append_trs(const Pose& pose, std::vector<double>& out) {
  for (const NodePose& node : pose) {
    NodePose p = node;
    if (node.fixed) {
      Node whole;
      whole.matrix = node.matrix;
      split_matrix(whole);
      p.translation = whole.translation;
      p.rotation = glm::dquat(whole.rotation);
      p.scale = glm::dvec3(whole.scale);
    }
    const glm::dvec3 &t = p.translation, &s = p.scale;
    const glm::dquat& q = p.rotation;
    for (const double number : {t.x, t.y, t.z, q.x, q.y, q.z, q.w, s.x, s.y, s.z}) out.push_back(number);
  }
}

Pose pose_of(const Pose& rest, const std::vector<double>& trs) {
  Pose out = rest;
  for (size_t n = 0; n < out.size(); ++n) {
    const double* p = &trs[10 * n];
    out[n].fixed = false;
    out[n].translation = {p[0], p[1], p[2]};
    out[n].rotation = glm::dquat(p[6], p[3], p[4], p[5]);
    out[n].scale = {p[7], p[8], p[9]};
  }
  return out;
}

glm::dvec3 place_of(const std::vector<glm::dmat4>& globals, int node) {
  return glm::dvec3(globals[static_cast<size_t>(node)][3]);
}

// An arm or a leg as two bones: root, the joint nearest to half its length, and the end.
struct Limb {
  Role role = Role::other;
  Side side = Side::middle;
  std::uint32_t number = 0;
  int nodes[3] = {-1, -1, -1};
  std::vector<int> path;       // from root to end
  std::vector<double> shares;  // of its length, from root to each
};

struct Body {
  const JointSide side;
  CharacterArrays arrays;
  CharacterInput input;
  std::optional<Character> character;
  std::vector<Limb> limbs;
  std::vector<double> rest;  // 10 numbers a node, or empty
  size_t leg_pairs = 0;
  bool upright = false;
  std::string doubt;  // why it is not understood

  Body(const JointSide& given, hf_inner::Memory& memory)
      : side(given), arrays(given.model, given.mesh), input(arrays.input<CharacterInput>()) {
    if (given.axes) {
      input.up = &given.axes->up.x;
      input.forward = &given.axes->forward.x;
    }
    if (given.rest) append_trs(*given.rest, rest);
    try {
      character.emplace(know_character(input, memory));
    } catch (const hf_inner::Error& error) {
      doubt = given.model.name + ": " + error.what();
      return;
    }
    look();
  }
  hf_inner::RetargetSide retarget_side() const { return {input, *character, rest.empty() ? nullptr : rest.data()}; }
  Pose rest_of() const { return side.rest ? *side.rest : rest_pose(side.model); }

  void look() {
    const Character& c = *character;
    if (c.role_confidence < enough || c.up_confidence < enough || c.forward_confidence < enough)
      doubt = "the skeleton of " + side.model.name + " is not understood";
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

  Limb limb_of(const Chain& chain, const std::vector<glm::dmat4>& globals) const {
    const Character& c = *character;
    Limb out{chain.role, chain.side, chain.number, {-1, -1, -1}, {}, {}};
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

  // Left, up and forward as columns.
  glm::dmat3 axes() const {
    return {vector_of(character->left), vector_of(character->up), vector_of(character->forward)};
  }
  // From the middle of the legs' roots, or of the hips, to the middle of the arms' roots, or of the neck.
  glm::dvec3 trunk(const std::vector<glm::dmat4>& globals) const {
    glm::dvec3 low(0), high(0);
    double lows = 0, highs = 0;
    for (const Limb& limb : limbs) {
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
};

// The joint of a limb that stands for the middle one of its partner. Limbs whose joints lie at about the same shares
// are the same bones, though the joint nearest to the middle may be another in each.
int middle_of(const Limb& limb, const Limb& partner) {
  constexpr double same_share = 0.15;
  if (partner.nodes[1] < 0 || limb.path.empty() || limb.path.size() != partner.path.size()) return limb.nodes[1];
  for (size_t k = 0; k < limb.shares.size(); ++k)
    if (std::abs(limb.shares[k] - partner.shares[k]) > same_share) return limb.nodes[1];
  const auto at = std::find(partner.path.begin(), partner.path.end(), partner.nodes[1]) - partner.path.begin();
  return limb.path[static_cast<size_t>(at)];
}

const char* side_word(Side side) { return side == Side::left ? "left " : side == Side::right ? "right " : ""; }

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) / degree;
}

// The smallest rotation that takes one direction to another.
glm::dquat turn_between(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 x = glm::normalize(a), y = glm::normalize(b), axis = glm::cross(x, y);
  const double sine = glm::length(axis), cosine = glm::dot(x, y);
  if (sine < 1e-12) return cosine > 0 ? glm::dquat(1, 0, 0, 0) : glm::dquat(0, 0, 0, 1);
  return glm::angleAxis(std::atan2(sine, cosine), axis / sine);
}

}  // namespace

struct SkeletonPair::Inside {
  mutable hf_inner::Memory memory;
  Body source, target;
  std::string refusal;
  Inside(const JointSide& s, const JointSide& t) : source(s, memory), target(t, memory) {}

  bool understood() const {
    return source.character && target.character && source.doubt.empty() && target.doubt.empty();
  }
  size_t matched() const {
    size_t out = 0;
    for (const Limb& b : target.limbs) out += partner(b) != nullptr;
    return out;
  }
  const Limb* partner(const Limb& b) const {
    for (const Limb& a : source.limbs)
      if (a.role == b.role && a.side == b.side && a.number == b.number) return &a;
    return nullptr;
  }
};

SkeletonPair::SkeletonPair(const JointSide& source, const JointSide& target)
    : in_(std::make_unique<Inside>(source, target)) {
  const Body &a = in_->source, &b = in_->target;
  if (!in_->understood())
    in_->refusal = a.doubt.empty() ? b.doubt : a.doubt;
  else if (a.leg_pairs != b.leg_pairs)
    in_->refusal = source.model.name + " has " + std::to_string(2 * a.leg_pairs) + " legs and " + target.model.name +
                   " has " + std::to_string(2 * b.leg_pairs);
  else if (in_->matched() < 2)
    in_->refusal = "the skeletons have no pair of arms or legs in common";
}

SkeletonPair::~SkeletonPair() = default;
bool SkeletonPair::understood() const { return in_->understood(); }
const std::string& SkeletonPair::refusal() const { return in_->refusal; }
bool SkeletonPair::two_legged() const { return in_->source.leg_pairs <= 1 && in_->target.leg_pairs <= 1; }

std::string SkeletonPair::limbs_text() const {
  size_t legs = 0, arms = 0;
  for (const Limb& limb : in_->target.limbs)
    if (in_->partner(limb)) ++(limb.role == Role::leg ? legs : arms);
  return std::to_string(legs) + " legs and " + std::to_string(arms) + " arms";
}

int SkeletonPair::target_root() const {
  const Model& model = in_->target.side.model;
  int node = in_->target.limbs.empty() ? -1 : in_->target.limbs.front().nodes[0];
  while (node >= 0 && model.nodes[static_cast<size_t>(node)].parent >= 0)
    node = model.nodes[static_cast<size_t>(node)].parent;
  return node;
}

namespace {

// The straight way of the body along the ground, taken out of the poses.
glm::dvec3 take_travel(const Body& body, const std::vector<double>& times, std::vector<Pose>& poses) {
  const auto middle = [&](const Pose& pose) {
    const std::vector<glm::dmat4> globals = global_matrices(body.side.model, pose);
    glm::dvec3 sum(0);
    double count = 0;
    for (const Limb& limb : body.limbs) {
      if (limb.role != body.limbs.front().role) continue;
      sum += place_of(globals, limb.nodes[0]);
      count += 1;
    }
    return sum / std::max(count, 1.0);
  };
  if (body.limbs.empty() || poses.size() < 2 || !(times.back() > times.front())) return glm::dvec3(0);
  const glm::dvec3 up = vector_of(body.character->up);
  glm::dvec3 travel = middle(poses.back()) - middle(poses.front());
  travel -= glm::dot(travel, up) * up;
  for (size_t f = 0; f < poses.size(); ++f) {
    const glm::dvec3 part = (times[f] - times.front()) / (times.back() - times.front()) * travel;
    for (size_t n = 0; n < poses[f].size(); ++n) {
      if (body.side.model.nodes[n].parent >= 0) continue;
      poses[f][n].translation -= part;
      poses[f][n].matrix[3] -= glm::dvec4(part, 0);
    }
  }
  return travel;
}

}  // namespace

JointClip SkeletonPair::play(const Animation& clip, const std::vector<double>& times,
                             const JointOptions& options) const {
  const Body &source = in_->source, &target = in_->target;
  hf_inner::Memory& memory = in_->memory;
  JointClip out;
  out.times = times;
  for (const double time : times) out.source.push_back(sample(source.side.model, clip, time));
  const glm::dvec3 travel = options.in_place ? take_travel(source, times, out.source) : glm::dvec3(0);
  std::vector<double> poses;
  for (const Pose& pose : out.source) append_trs(pose, poses);

  hf_inner::RetargetOptions chosen;
  chosen.goals = options.ground;
  chosen.copy_same = options.scale == 0 && options.stride == 1;
  if (times.size() > 1 && options.ground)
    find_ground_velocity(source.retarget_side(), poses.data(), static_cast<std::uint32_t>(times.size()),
                         (times.back() - times.front()) / static_cast<double>(times.size() - 1), chosen.ground_velocity,
                         memory);
  chosen.scale = options.scale;
  if (options.stride != 1) {
    const hf_inner::Retarget found(source.retarget_side(), target.retarget_side(), chosen, memory);
    chosen.scale = options.stride * found.report().scale;
  }
  hf_inner::Retarget retarget(source.retarget_side(), target.retarget_side(), chosen, memory);
  const size_t count = source.side.model.nodes.size();
  const Pose rest = target.rest_of();
  std::vector<double> trs(10 * rest.size());
  double ms = 0;
  for (size_t f = 0; f < times.size(); ++f) {
    const auto start = std::chrono::steady_clock::now();
    retarget.frame(poses.data() + 10 * count * f, f == 0 ? 0 : times[f] - times[f - 1], trs.data());
    ms += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    out.target.push_back(pose_of(rest, trs));
  }
  const hf_inner::RetargetReport& report = retarget.report();
  out.same = report.same_skeleton;
  out.scale = report.scale;
  out.scale_from = report.same_skeleton ? "the same skeleton" : scale_source_name(report.scale_source);
  out.joints = report.matched_joints;
  for (const std::uint32_t j : report.unmatched_source) out.unmatched.push_back(source.side.model.nodes[j].name);
  out.drop = report.deepest_drop;
  out.frame_ms = ms / static_cast<double>(std::max<size_t>(times.size(), 1));
  out.travel = out.scale * (target.axes() * (glm::transpose(source.axes()) * travel));
  for (size_t f = 1; f < out.source.size() && !out.moves; ++f) {
    for (const Limb& limb : source.limbs) {
      for (const int node : limb.nodes) {
        if (node < 0) continue;
        const auto n = static_cast<size_t>(node);
        out.moves = out.moves || glm::distance(out.source[f][n].translation, out.source[0][n].translation) > 0 ||
                    std::abs(glm::dot(out.source[f][n].rotation, out.source[0][n].rotation)) < 1 - 1e-9;
      }
    }
  }
  return out;
}

PoseFit SkeletonPair::fit(const std::vector<Pose>& source, const std::vector<Pose>& target) const {
  PoseFit out;
  if (!in_->source.character || !in_->target.character) return out;
  const Body &a = in_->source, &b = in_->target;
  out.source_limbs = a.limbs.size();
  out.target_limbs = b.limbs.size();
  const glm::dmat3 across = b.axes() * glm::transpose(a.axes());
  const std::vector<glm::dmat4> a_rest = global_matrices(a.side.model, a.rest_of()),
                                b_rest = global_matrices(b.side.model, b.rest_of());
  // Where a bone of the target should point.
  const auto wanted = [&](const glm::dvec3& now, const glm::dvec3& was, const glm::dvec3& own) {
    return turn_between(across * was, across * now) * own;
  };
  // The retarget brings limbs together whose rests stand alike: then bones point the same way.
  struct Bone {
    size_t limb;
    bool alike;
    int a[2], b[2];
  };
  std::vector<Bone> bones;
  for (const Limb& limb : b.limbs) {
    const Limb* by = in_->partner(limb);
    if (!by) continue;
    out.limbs.push_back({std::string(side_word(limb.side)) + role_name(limb.role) +
                             (b.leg_pairs > 1 && limb.role == Role::leg ? " " + std::to_string(limb.number + 1) : ""),
                         0, 0});
    const size_t index = out.limbs.size() - 1;
    const bool alike = limb.role == Role::arm ? a.upright == b.upright : a.upright && b.upright;
    const auto both = [&](size_t k) { return limb.nodes[k] >= 0 && by->nodes[k] >= 0; };
    const int middle = middle_of(limb, *by);
    if (both(1)) bones.push_back({index, alike, {by->nodes[0], by->nodes[1]}, {limb.nodes[0], middle}});
    if (both(2) && both(1)) bones.push_back({index, alike, {by->nodes[1], by->nodes[2]}, {middle, limb.nodes[2]}});
    if (both(2) && !both(1))
      bones.push_back({index, alike, {by->nodes[0], by->nodes[2]}, {limb.nodes[0], limb.nodes[2]}});
  }
  const auto way = [](const std::vector<glm::dmat4>& globals, const int(&ends)[2]) {
    return place_of(globals, ends[1]) - place_of(globals, ends[0]);
  };
  const double frames = static_cast<double>(std::max<size_t>(source.size(), 1));
  for (size_t f = 0; f < source.size() && f < target.size(); ++f) {
    const std::vector<glm::dmat4> now_a = global_matrices(a.side.model, source[f]),
                                  now_b = global_matrices(b.side.model, target[f]);
    for (const Bone& bone : bones) {
      const glm::dvec3 from = way(now_a, bone.a), to = way(now_b, bone.b), was = way(a_rest, bone.a);
      if (!(glm::length(from) > 0) || !(glm::length(to) > 0) || !(glm::length(was) > 0)) continue;
      const double angle = angle_between(bone.alike ? across * from : wanted(from, was, way(b_rest, bone.b)), to);
      LimbFit& limb = out.limbs[bone.limb];
      const bool two =
          std::count_if(bones.begin(), bones.end(), [&](const Bone& o) { return o.limb == bone.limb; }) > 1;
      limb.mean += angle / frames / (two ? 2 : 1);
      limb.worst = std::max(limb.worst, angle);
    }
    const glm::dvec3 from = a.trunk(now_a), was = a.trunk(a_rest), own = b.trunk(b_rest), to = b.trunk(now_b);
    if (!(glm::length(from) > 0) || !(glm::length(was) > 0) || !(glm::length(own) > 0) || !(glm::length(to) > 0))
      continue;
    const double angle = angle_between(wanted(from, was, own), to);
    out.trunk_degrees += angle / frames;
    out.trunk_worst = std::max(out.trunk_worst, angle);
  }
  double sum = 0;
  for (size_t k = 0; k < out.limbs.size(); ++k) {
    if (std::none_of(bones.begin(), bones.end(), [&](const Bone& bone) { return bone.limb == k; })) continue;
    ++out.compared;
    sum += out.limbs[k].mean;
    out.worst = std::max(out.worst, out.limbs[k].worst);
  }
  if (out.compared > 0) out.degrees = sum / static_cast<double>(out.compared);
  return out;
}

namespace {

void add_key(Channel& channel, const glm::dvec3& v) {
  for (int c = 0; c < 3; ++c) channel.values.push_back(static_cast<float>(v[c]));
}

// The same rotation with the sign that lies nearer to the key before.
void add_key(Channel& channel, const glm::dquat& q) {
  double cosine = 1;
  if (const size_t at = channel.values.size(); at >= 4)
    cosine = channel.values[at - 4] * q.x + channel.values[at - 3] * q.y + channel.values[at - 2] * q.z +
             channel.values[at - 1] * q.w;
  const double sign = cosine < 0 ? -1 : 1;
  for (const double x : {q.x, q.y, q.z, q.w}) channel.values.push_back(static_cast<float>(sign * x));
}

}  // namespace

Animation clip_of_poses(const Model& model, const std::string& name, const std::vector<double>& times,
                        const std::vector<Pose>& poses) {
  // Below this a float does not tell two numbers apart.
  constexpr double equal = 1e-7;
  Animation out;
  out.name = name;
  std::vector<double> rest_trs;
  append_trs(rest_pose(model), rest_trs);
  const Pose rest = pose_of(rest_pose(model), rest_trs);
  for (size_t n = 0; n < model.nodes.size(); ++n) {
    Channel move, turn, grow;
    move.node = turn.node = grow.node = static_cast<int>(n);
    turn.path = Path::rotation;
    turn.width = 4;
    grow.path = Path::scale;
    bool moves = false, turns = false, grows = false;
    for (const Pose& pose : poses) {
      moves = moves || glm::distance(pose[n].translation, rest[n].translation) >
                           equal * (1e-3 + glm::length(rest[n].translation));
      turns = turns || std::abs(glm::dot(pose[n].rotation, rest[n].rotation)) < 1 - equal * equal ||
              glm::length(glm::dvec4(pose[n].rotation.x, pose[n].rotation.y, pose[n].rotation.z, pose[n].rotation.w) -
                          glm::dvec4(rest[n].rotation.x, rest[n].rotation.y, rest[n].rotation.z, rest[n].rotation.w)) >
                  equal;
      grows = grows || glm::distance(pose[n].scale, rest[n].scale) > 1e-6 * glm::length(rest[n].scale);
      add_key(move, pose[n].translation);
      add_key(turn, pose[n].rotation);
      add_key(grow, pose[n].scale);
    }
    for (auto& [used, channel] : {std::pair<bool, Channel*>(moves, &move), {turns, &turn}, {grows, &grow}}) {
      if (!used) continue;
      channel->times.assign(times.begin(), times.end());
      out.channels.push_back(std::move(*channel));
    }
  }
  return out;
}

}  // namespace hf_gltf

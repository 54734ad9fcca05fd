// Pairs two bodies by joints, plays clips of one on the other and measures how well the limbs agree.
#include "gltf/skeleton_pair.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include "gltf/clip_binding.h"
#include "gltf/riders.h"
#include "gltf/skeleton_body.h"

namespace hf_gltf {
namespace {

constexpr double degree = 3.14159265358979323846 / 180;

// The joint of a limb that stands for the middle one of its partner. Limbs whose joints lie at about the same shares
// are the same bones, though the joint nearest to the middle may be another in each.
int middle_of(const BodyLimb& limb, const BodyLimb& partner) {
  constexpr double same_share = 0.15;
  if (partner.nodes[1] < 0 || limb.path.empty() || limb.path.size() != partner.path.size()) return limb.nodes[1];
  for (size_t k = 0; k < limb.shares.size(); ++k)
    if (std::abs(limb.shares[k] - partner.shares[k]) > same_share) return limb.nodes[1];
  const auto at = std::find(partner.path.begin(), partner.path.end(), partner.nodes[1]) - partner.path.begin();
  return limb.path[static_cast<size_t>(at)];
}

const char* side_word(Side side) { return side == Side::left ? "left " : side == Side::right ? "right " : ""; }

// Returns the chain of a joint; null: the joint is in no chain.
const Chain* chain_of(const SkeletonBody& body, int node) {
  const std::int32_t chain = body.character->joint_chains[static_cast<size_t>(node)];
  return chain < 0 ? nullptr : &body.character->chains[static_cast<size_t>(chain)];
}

std::string chain_text(const Chain* chain) {
  if (!chain) return "no part of the body";
  return std::string(side_word(chain->side)) + role_name(chain->role) + " " + std::to_string(chain->number + 1);
}

// A chain that is named on both bodies must pair with itself: the same part, side and number on both.
void check_named(const SkeletonBody& a, const SkeletonBody& b) {
  if (!a.character || !b.character) return;
  const std::vector<SaidJoint>& others = b.side.model.said;
  for (const SaidJoint& from : a.side.model.said) {
    const auto to =
        std::find_if(others.begin(), others.end(), [&](const SaidJoint& j) { return j.chain == from.chain; });
    if (to == others.end() || from.part == role_name(Role::other)) continue;
    const Chain *one = chain_of(a, from.node), *two = chain_of(b, to->node);
    if (one && two && one->role == two->role && one->side == two->side && one->number == two->number) continue;
    throw std::runtime_error("chain \"" + from.chain + "\": on " + a.side.model.name + " it is " + chain_text(one) +
                             ", on " + b.side.model.name + " " + chain_text(two) +
                             ". Legs count from the front, other parts in the order of their joints. Name all chains "
                             "of this part, and call the other chains \"other\"");
  }
}

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

namespace {

Riders riders_of(const SkeletonBody& body) {
  std::vector<uint8_t> moves;
  for (const hf_inner::skeleton::JointKind kind : body.character->kinds)
    moves.push_back(kind != hf_inner::skeleton::JointKind::helper);
  return find_riders(body.side.model, body.side.mesh, body.rest_of(), moves);
}

// The nodes that a clip moves.
std::vector<uint8_t> moved_by_clip(const Model& model, const Animation& clip) {
  std::vector<uint8_t> out(model.nodes.size(), 0);
  for (const Channel& channel : clip.channels)
    if (channel.path != Path::weights) out[static_cast<size_t>(channel.node)] = 1;
  return out;
}

}  // namespace

struct SkeletonPair::Inside {
  mutable hf_inner::Memory memory;
  SkeletonBody source, target;
  std::string refusal;
  Riders riders;  // of the target
  Inside(const JointSide& s, const JointSide& t) : source(s, memory), target(t, memory) {
    if (target.character) riders = riders_of(target);
  }

  bool understood() const {
    return source.character && target.character && source.doubt.empty() && target.doubt.empty();
  }
  // Counts the limbs at the sides of the trunk whose part is not known. Each may be an arm that nothing leads. A body
  // without such limbs has no arm to lead.
  size_t unknown_limbs() const {
    const Character& c = *target.character;
    const auto chains = static_cast<size_t>(std::count_if(c.chains.begin(), c.chains.end(), [&](const Chain& chain) {
      if (chain.role != Role::other || chain.side == Side::middle || chain.parent < 0) return false;
      const Role on = c.chains[static_cast<size_t>(chain.parent)].role;
      return on == Role::spine || on == Role::neck;
    }));
    return std::max(chains, target.unknown_arms());
  }
  size_t matched() const {
    size_t out = 0;
    for (const BodyLimb& b : target.limbs) out += partner(b) != nullptr;
    return out;
  }
  const BodyLimb* partner(const BodyLimb& b) const {
    // As the retarget pairs them: the first arm, wing or fin with one of another kind where there is none of its own.
    Role role = b.role;
    if (role != Role::leg) {
      const Role by = hf_inner::retarget::flapping_partner(*source.character, *target.character, b.side, role);
      if (by != role && b.number > 0) return nullptr;
      role = by;
    }
    for (const BodyLimb& a : source.limbs)
      if (a.role == role && a.side == b.side && a.number == b.number) return &a;
    return nullptr;
  }
  // Arms and legs, and the wings and fins that lead or follow.
  std::pair<size_t, size_t> counted() const {
    std::pair<size_t, size_t> out(0, 0);
    std::vector<const BodyLimb*> leading;
    const auto walks = [](const BodyLimb& limb) { return limb.role == Role::arm || limb.role == Role::leg; };
    for (const BodyLimb& b : target.limbs) {
      const BodyLimb* by = partner(b);
      if (by) leading.push_back(by);
      out.second += by || walks(b);
    }
    for (const BodyLimb& a : source.limbs)
      out.first += walks(a) || std::find(leading.begin(), leading.end(), &a) != leading.end();
    return out;
  }
};

SkeletonPair::SkeletonPair(const JointSide& source, const JointSide& target)
    : in_(std::make_unique<Inside>(source, target)) {
  const SkeletonBody &a = in_->source, &b = in_->target;
  check_named(a, b);
  if (!in_->understood())
    in_->refusal = a.doubt.empty() ? b.doubt : a.doubt;
  else if (a.leg_pairs != b.leg_pairs && a.leg_pairs > 0 && b.leg_pairs > 0)  // what swims or flies has arms to give
    in_->refusal = source.model.name + " has " + std::to_string(2 * a.leg_pairs) + " legs and " + target.model.name +
                   " has " + std::to_string(2 * b.leg_pairs);
  else if (in_->matched() < 2)
    in_->refusal = "the skeletons have no pair of arms, legs, wings or fins in common";
}

SkeletonPair::~SkeletonPair() = default;
bool SkeletonPair::understood() const { return in_->understood(); }
const std::string& SkeletonPair::refusal() const { return in_->refusal; }
bool SkeletonPair::two_legged() const { return in_->source.leg_pairs <= 1 && in_->target.leg_pairs <= 1; }
bool SkeletonPair::four_legged() const { return in_->source.leg_pairs == 2 && in_->target.leg_pairs == 2; }

const std::vector<int>& SkeletonPair::left_behind() const { return in_->riders.unknown; }

double SkeletonPair::unevenness() const {
  double out = 0;
  for (const SkeletonBody* body : {&in_->source, &in_->target}) {
    const double share = body->character ? hf_gltf::unevenness(*body->character) / most_uneven : 0;
    if (std::isfinite(share)) out = std::max(out, share - 1);  // a body without pairs of limbs says nothing
  }
  return out;
}

std::string SkeletonPair::limbs_text() const {
  size_t legs = 0, arms = 0, others = 0;
  for (const BodyLimb& limb : in_->target.limbs)
    if (in_->partner(limb)) ++(limb.role == Role::leg ? legs : limb.role == Role::arm ? arms : others);
  const std::string walking = std::to_string(legs) + " legs and " + std::to_string(arms) + " arms",
                    flapping = std::to_string(others) + " wings or fins";
  return others == 0 ? walking : legs + arms == 0 ? flapping : walking + " and " + flapping;
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
glm::dvec3 take_travel(const SkeletonBody& body, const std::vector<double>& times, std::vector<Pose>& poses) {
  const auto middle = [&](const Pose& pose) {
    const std::vector<glm::dmat4> globals = global_matrices(body.side.model, pose);
    glm::dvec3 sum(0);
    double count = 0;
    for (const BodyLimb& limb : body.limbs) {
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
  const SkeletonBody &source = in_->source, &target = in_->target;
  hf_inner::Memory& memory = in_->memory;
  JointClip out;
  out.times = times;
  for (const double time : times) out.source.push_back(sample(source.side.model, clip, time));
  const glm::dvec3 travel = options.in_place ? take_travel(source, times, out.source) : glm::dvec3(0);
  std::vector<double> poses;
  for (const Pose& pose : out.source) append_trs(pose, poses);

  hf_inner::retarget::RetargetOptions chosen;
  chosen.goals = options.ground;
  chosen.foot_path = out.foot_path = options.foot_path;
  chosen.copy_same = options.scale == 0 && options.stride == 1;
  if (times.size() > 1 && options.ground)
    find_ground_velocity(source.retarget_side(), poses.data(), static_cast<std::uint32_t>(times.size()),
                         (times.back() - times.front()) / static_cast<double>(times.size() - 1), chosen.ground_velocity,
                         memory);
  chosen.scale = options.scale;
  if (options.stride != 1) {
    const hf_inner::retarget::Retarget found(source.retarget_side(), target.retarget_side(), chosen, memory);
    chosen.scale = options.stride * found.report().scale;
  }
  hf_inner::retarget::Retarget retarget(source.retarget_side(), target.retarget_side(), chosen, memory);
  const size_t count = source.side.model.nodes.size();
  const Pose rest = target.rest_of();
  std::vector<double> trs(10 * rest.size());
  Riders riders = in_->riders;
  if (retarget.report().same_skeleton) {  // nodes that the clip itself moves are copied
    const std::vector<uint8_t> moved = moved_by_clip(source.side.model, clip);
    std::vector<std::uint32_t> partners(rest.size(), HF_NO_INDEX);
    retarget.partners(partners.data());
    riders.known.erase(std::remove_if(riders.known.begin(), riders.known.end(),
                                      [&](const Rider& rider) {
                                        const std::uint32_t by = partners[static_cast<size_t>(rider.node)];
                                        return by != HF_NO_INDEX && moved[by] != 0;
                                      }),
                       riders.known.end());
  }
  for (const Rider& rider : riders.known) out.riders.push_back(rider.node);
  double ms = 0;
  for (size_t f = 0; f < times.size(); ++f) {
    const auto start = std::chrono::steady_clock::now();
    retarget.frame(poses.data() + 10 * count * f, f == 0 ? 0 : times[f] - times[f - 1], trs.data());
    ms += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    out.target.push_back(pose_of(rest, trs));
    place_riders(target.side.model, riders, out.target.back());
  }
  const hf_inner::retarget::RetargetReport& report = retarget.report();
  out.same = report.same_skeleton;
  out.scale = report.scale;
  out.scale_from = report.same_skeleton ? "the same skeleton" : scale_source_name(report.scale_source);
  out.joints = report.matched_joints;
  for (const std::uint32_t j : report.unmatched_source) out.unmatched.push_back(source.side.model.nodes[j].name);
  for (const std::uint32_t j : report.unmatched_target) out.staying.push_back(target.side.model.nodes[j].name);
  out.drop = report.deepest_drop;
  out.hover = report.hover;
  out.frame_ms = ms / static_cast<double>(std::max<size_t>(times.size(), 1));
  out.travel = out.scale * (target.axes() * (glm::transpose(source.axes()) * travel));
  for (size_t f = 1; f < out.source.size() && !out.moves; ++f) {
    for (const BodyLimb& limb : source.limbs) {
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

void add_riders(const Model& target, Model& bound, size_t clips) {
  const FlatMesh mesh = flatten(target);
  hf_inner::Memory memory;
  const SkeletonBody body({target, mesh}, memory);
  if (!body.character) return;
  const Riders all = riders_of(body);
  for (size_t c = 0; c < clips && !all.known.empty(); ++c) {
    const Animation& clip = bound.animations[c];
    const std::vector<uint8_t> moved = moved_by_clip(bound, clip);
    Riders riders;
    for (const Rider& rider : all.known)
      if (!moved[static_cast<size_t>(rider.node)]) riders.known.push_back(rider);
    const std::vector<double> times = key_times(clip);
    std::vector<Pose> poses;
    for (const double time : times) {
      poses.push_back(sample(bound, clip, time));
      std::vector<double> trs;
      append_trs(poses.back(), trs);
      poses.back() = pose_of(poses.back(), trs);
      place_riders(bound, riders, poses.back());
    }
    std::vector<int> nodes;
    for (const Rider& rider : riders.known) nodes.push_back(rider.node);
    for (Channel& channel : clip_of_poses(bound, clip.name, times, poses).channels) {
      if (std::find(nodes.begin(), nodes.end(), channel.node) == nodes.end()) continue;
      split_matrix(bound.nodes[static_cast<size_t>(channel.node)]);
      bound.animations[c].channels.push_back(std::move(channel));
    }
  }
}

PoseFit SkeletonPair::fit(const std::vector<Pose>& source, const std::vector<Pose>& target) const {
  PoseFit out;
  if (!in_->source.character || !in_->target.character) return out;
  const SkeletonBody &a = in_->source, &b = in_->target;
  std::tie(out.source_limbs, out.target_limbs) = in_->counted();
  for (const BodyLimb& limb : b.limbs) {
    const BodyLimb* by = in_->partner(limb);
    for (const BodyLimb* one : {&limb, by}) out.flaps |= by && (one->role == Role::wing || one->role == Role::fin);
  }
  const size_t matched = in_->matched(), most = std::max(out.source_limbs, out.target_limbs);
  const auto off = static_cast<size_t>(std::count_if(
      b.limbs.begin(), b.limbs.end(), [&](const BodyLimb& limb) { return limb.off && in_->partner(limb); }));
  const size_t lost = off + out.target_limbs - matched + std::min(out.source_limbs - matched, in_->unknown_limbs());
  if (most > 0) out.unmatched = std::min(1.0, static_cast<double>(lost) / static_cast<double>(most));
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
  for (const BodyLimb& limb : b.limbs) {
    const BodyLimb* by = in_->partner(limb);
    if (!by) continue;
    out.limbs.push_back({std::string(side_word(limb.side)) + role_name(limb.role) +
                             (b.leg_pairs > 1 && limb.role == Role::leg ? " " + std::to_string(limb.number + 1) : ""),
                         0, 0});
    const size_t index = out.limbs.size() - 1;
    // A fin has other joints than an arm, and arms of an upright body and of one that is not rest in their own bends:
    // the retarget brings their lines together, from root to tip.
    if (by->role != limb.role || (limb.role == Role::arm && a.upright != b.upright)) {
      if (limb.nodes[2] >= 0 && by->nodes[2] >= 0)
        bones.push_back({index, true, {by->nodes[0], by->nodes[2]}, {limb.nodes[0], limb.nodes[2]}});
      continue;
    }
    const bool alike = limb.role == Role::arm || (a.upright && b.upright);
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

}  // namespace hf_gltf

#include "deform/proposal_joints.h"

#include <algorithm>

#include "base/index.h"
#include "deform/constants.h"
#include "deform/handles.h"

namespace hf_inner::deform {
namespace {

// The joints from the roots outwards, of one depth the longest bone first. If two joints are at one place, the first is
// proposed. So the order must not depend on the list.
Vector<std::uint32_t> outwards(const JointList& joints, Memory& memory) {
  const std::size_t count = joints.parents.size();
  Vector<std::uint32_t> order(count, 0, &memory), depth(count, 0, &memory), path(&memory);
  Vector<double> bone(count, 0.0, &memory);
  for (std::uint32_t j = 0; j < count; ++j) {
    order[j] = j;
    const std::uint32_t parent = joints.parents[j];
    if (parent != no_joint) bone[j] = norm(joints.places[j] - joints.places[parent]);
    // up to a joint whose depth is known; a circle of parents ends where it began
    path.clear();
    for (std::uint32_t at_joint = j; at_joint != no_joint && depth[at_joint] == 0;
         at_joint = joints.parents[at_joint]) {
      depth[at_joint] = 1;
      path.push_back(at_joint);
    }
    const std::uint32_t above = joints.parents[path.empty() ? j : path.back()];
    std::uint32_t reached = above == no_joint ? 0 : depth[above];
    for (std::size_t k = path.size(); k-- > 0;) depth[path[k]] = ++reached;
  }
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (depth[a] != depth[b]) return depth[a] < depth[b];
    return bone[a] != bone[b] ? bone[a] > bone[b] : a < b;
  });
  return order;
}

void add_joint(const surface::Core& core, std::uint32_t number, Vec3 place, Vector<Candidate>& found) {
  const std::int32_t vertex = vertex_near(core, place);
  const double depth = norm(core.mesh.positions[at(vertex)] - place);
  if (depth > joint_reach) return;  // a helper away from the surface
  Candidate out;
  out.vertex = vertex;
  out.position = place;
  out.reason = HandleReason::joint;
  out.joint = number;
  out.radius = std::max(around_joint * depth, least_radius);
  out.length = depth;
  found.push_back(out);
}

}  // namespace

bool comes_first(const Candidate& a, const Candidate& b) noexcept {
  if (a.pinned != b.pinned) return a.pinned;
  if (a.length != b.length) return a.length > b.length;
  if (a.second != b.second) return b.second;
  if (a.vertex != b.vertex) return a.vertex < b.vertex;
  return a.reason != b.reason ? a.reason < b.reason : a.joint < b.joint;
}

JointList joint_list(const surface::Core& core, Span<const double> joints, Span<const std::uint32_t> parents) {
  JointList out(core.memory.get());
  for (std::uint32_t j = 0; j < parents.size(); ++j) {
    const double* p = joints.data() + 3 * std::size_t{j};
    out.places.push_back(core.mesh.to_inner({p[0], p[1], p[2]}));
    out.parents.push_back(parents[j]);
    out.numbers.push_back(j);
  }
  out.left_out.assign(parents.size(), 0);
  return out;
}

JointList joint_list(const surface::Core& core, const skeleton::KnownSkeleton& known, const MovedParts& parts) {
  JointList out(core.memory.get());
  const skeleton::Character& character = known.character;
  const std::size_t count = character.kinds.size();
  Vector<std::uint32_t> place(count, no_joint, core.memory.get());
  for (std::uint32_t j = 0; j < count; ++j) {
    if (character.kinds[j] != skeleton::JointKind::body) continue;
    place[j] = static_cast<std::uint32_t>(out.numbers.size());
    out.numbers.push_back(j);
  }
  for (const std::uint32_t j : out.numbers) {
    const std::int32_t carrier = character.carriers[j];
    out.places.push_back(core.mesh.to_inner(character.frames[j].origin));
    out.parents.push_back(carrier < 0 ? no_joint : place[at(carrier)]);
    const skeleton::Role role = parts.knows_roles() ? character.roles[j] : skeleton::Role::other;
    const bool inside = role == skeleton::Role::leg || role == skeleton::Role::arm ||
                        role == skeleton::Role::shoulder || role == skeleton::Role::neck;
    const std::int32_t part = parts.part_of_joint(j);
    out.left_out.push_back(inside || (part >= 0 && parts.vertices_of(at(part)).size() >= least_part));
  }
  return out;
}

void add_joints(const surface::Core& core, const JointList& joints, Vector<Candidate>& found) {
  const std::size_t count = joints.parents.size();
  Vector<std::uint32_t> children(count, 0, core.memory.get());
  for (const std::uint32_t parent : joints.parents) {
    if (parent != no_joint) ++children[parent];
  }
  for (const std::uint32_t j : outwards(joints, *core.memory)) {
    if (children[j] == 1 || joints.left_out[j]) continue;
    const Vec3 place = joints.places[j];
    const bool end = children[j] == 0;
    Candidate* near = nullptr;
    double least = end ? joint_reach : least_radius;
    for (Candidate& candidate : found) {
      if (candidate.part >= 0) continue;  // a head has its own joint
      const double d = norm(candidate.position - place);
      // joints inside the trunk belong to it
      if (candidate.reason == HandleReason::middle && d <= candidate.radius) least = std::max(least, candidate.radius);
      if (d <= least) {
        least = d;
        near = &candidate;
      }
    }
    if (!near) {
      add_joint(core, joints.numbers[j], place, found);
    } else if ((end || near->reason == HandleReason::middle) && near->joint == no_joint) {
      near->joint = joints.numbers[j];
    }
  }
}

}  // namespace hf_inner::deform

// Adds candidates for proposed handles from the joints of a skeleton.
//
// An end joint gives its number to a candidate near it. The first joint inside the trunk gives its number to the trunk.
// End joints without a candidate near them, and joints where the skeleton branches, become candidates. Their place is
// the joint itself, so that the region goes around the limb. The order of the joints does not matter. Cost: joints
// times candidates, and a pass over the vertices for each joint that becomes a candidate.
#pragma once
#include "deform/moved_parts.h"
#include "deform/proposals.h"

namespace hf_inner::deform {

// A place that may become a proposal. All lengths are in the unit of the inner mesh, whose box diagonal is 1.
struct Candidate {
  std::int32_t vertex = 0;
  HandleReason reason = HandleReason::tip;
  bool pinned = false;
  bool second = false;  // the end of a component that is nearer to its middle; both ends have one length
  std::uint32_t joint = no_joint;
  std::int32_t part = -1;  // of moved_parts.h: the region is this whole part; -1: none
  Vec3 position;
  double radius = 0, length = 0;
};

// Orders candidates: pinned ones first, then the longest.
bool comes_first(const Candidate& a, const Candidate& b) noexcept;

// The joints that may become candidates.
struct JointList {
  explicit JointList(Memory* memory) : places(memory), parents(memory), numbers(memory), left_out(memory) {}
  Vector<Vec3> places;            // in the unit of the inner mesh
  Vector<std::uint32_t> parents;  // by position in the list, or no_joint
  Vector<std::uint32_t> numbers;  // as the caller counts them
  Vector<std::uint8_t> left_out;  // 1: the joint counts as a parent, but becomes no candidate
};
// Lists the joints of the caller.
JointList joint_list(const surface::Core& core, Span<const double> joints, Span<const std::uint32_t> parents);
// Lists the joints that move the body. Joints of a head, a hand or a foot are left out, because the whole part is
// proposed. Where roles are known, joints of arms, legs, shoulders and necks are left out too.
JointList joint_list(const surface::Core& core, const skeleton::KnownSkeleton& known, const MovedParts& parts);

// Gives joints to the candidates in `found`, and appends the joints that become candidates.
void add_joints(const surface::Core& core, const JointList& joints, Vector<Candidate>& found);

}  // namespace hf_inner::deform

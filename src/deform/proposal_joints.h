// Candidates for proposed handles, and those that the joints of a skeleton give.
//
// End joints name the candidates near them, and the first joint in the trunk names the trunk. End joints without one,
// and joints where the skeleton branches, become candidates. Their place is the joint itself, so that the region goes
// around the limb. The order of the joints does not matter. Cost: joints times candidates, and a search over the
// vertices for each joint that becomes one.
#pragma once
#include "deform/moved_parts.h"
#include "deform/proposals.h"

namespace hf_inner {

// A place that may become a proposal. All lengths are in the unit of the inner mesh, whose box diagonal is 1.
struct Candidate {
  std::int32_t vertex = 0;
  HandleReason reason = HandleReason::tip;
  bool pinned = false;
  bool second = false;  // the end of a component that is nearer to its middle; both ends have one length
  std::uint32_t joint = no_joint;
  std::int32_t part = -1;  // its region is this part of moved_parts.h, or -1
  Vec3 position;
  double radius = 0, length = 0;
};

// What holds, then what protrudes most.
bool comes_first(const Candidate& a, const Candidate& b) noexcept;

// The joints that may become candidates.
struct JointList {
  explicit JointList(Memory* memory) : places(memory), parents(memory), numbers(memory), left_out(memory) {}
  Vector<Vec3> places;            // in the unit of the inner mesh
  Vector<std::uint32_t> parents;  // by position in the list, or no_joint
  Vector<std::uint32_t> numbers;  // as the caller counts them
  Vector<std::uint8_t> left_out;  // 1: it is the parent of others, but no candidate
};
// The joints as given.
JointList joint_list(const Core& core, Span<const double> joints, Span<const std::uint32_t> parents);
// The joints that move the body. Those of a head, a hand or a foot are left out: the part itself is proposed. So are
// knees, elbows, shoulders and necks, where roles are known.
JointList joint_list(const Core& core, const KnownSkeleton& known, const MovedParts& parts);

void add_joints(const Core& core, const JointList& joints, Vector<Candidate>& found);

}  // namespace hf_inner

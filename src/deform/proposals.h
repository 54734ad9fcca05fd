// Proposes handles for a surface: feet and a trunk that hold, tips to drag, ends of pieces, joints of a skeleton.
// Candidates are found in proposals.cpp, what a skeleton says about them in proposal_joints.h and moved_parts.h.
//
// Feet are minima of the height with a leg above them: the height rises by a share of the body on the way to a lower
// minimum (find_peaks). Tips are the extremities of field/extremities.h; those at a foot belong to the foot. A
// component without either gets its two ends. The trunk of the largest component holds. The trunk is the part outside
// all limbs, by the Poisson field of the tips. Its middle is in the chest of a biped, and between the legs of an
// animal. Places do not depend on the order of the vertices; they follow translation and scale.
//
// The regions of all proposals are disjoint: adding them as handles by position and radius does not overlap.
#pragma once
#include <cstdint>

#include "base/span.h"
#include "skeleton/known_skeleton.h"
#include "surface/core.h"

namespace hf_inner::deform {

// The values equal HF_HANDLE_REASON_*.
enum class HandleReason : std::int32_t { foot = 0, tip = 1, end = 2, joint = 3, middle = 4 };

struct HandleProposal {
  std::int32_t vertex = 0;  // inner, nearest to the position
  HandleReason reason = HandleReason::tip;
  bool pinned = false;
  std::uint32_t joint = 0xffffffffu;            // the joint that moves it, an end joint nearby, or none
  skeleton::Role role = skeleton::Role::other;  // of the joint, or of its parent
  skeleton::Side side = skeleton::Side::middle;
  Vec3 position;                  // in the unit of the caller's mesh
  double radius = 0, length = 0;  // same unit
  double following = 1;           // for a drag
};

struct Proposals {
  explicit Proposals(Memory* memory) : list(memory), region(memory) {}
  Vector<HandleProposal> list;
  Vector<std::int32_t> region;  // by inner vertex: its proposal by position in the list, or -1
};

struct ProposalOptions {
  Vec3 up{0, 1, 0};                                   // of length 1
  double least_length_share = 0;                      // share of the box diagonal
  std::size_t limit = 0;                              // most proposals
  Span<const double> joints;                          // [n][3], in the unit of the caller's mesh
  Span<const std::uint32_t> parents;                  // [n]; 0xffffffff for a root
  const skeleton::KnownSkeleton* skeleton = nullptr;  // instead of joints; its skin has the vertices of the mesh
};

// Returns pinned proposals first, then the others, each by length, the longest first. Throws as poisson_extremities
// does.
Proposals propose_handles(const surface::Core& core, const ProposalOptions& options);

}  // namespace hf_inner::deform

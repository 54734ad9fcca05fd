// Proposes handles for a surface: feet and a trunk that hold, tips to drag, ends of pieces, joints of a skeleton.
//
// Feet are minima of the height with a leg above them: the height rises by a share of the body on the way to a lower
// minimum (find_peaks). Tips are the extremities of field/extremities.h; those at a foot belong to the foot. A
// component without either gets its two ends. The trunk of the largest component holds: what is left when all limbs are
// taken away, by the Poisson field of the tips. Its middle is in the chest of a biped, and between the legs of an
// animal. Places do not depend on the order of the vertices; they follow translation and scale.
//
// The regions of all proposals are disjoint: adding them as handles by position and radius does not overlap.
#pragma once
#include <cstdint>

#include "base/span.h"
#include "engine/core.h"

namespace hf_inner {

// The values are those of HF_HANDLE_REASON_*.
enum class HandleReason : std::int32_t { foot = 0, tip = 1, end = 2, joint = 3, middle = 4 };

struct HandleProposal {
  std::int32_t vertex = 0;  // inner, nearest to the position
  HandleReason reason = HandleReason::tip;
  bool pinned = false;
  std::uint32_t joint = 0xffffffffu;  // end joint nearby, or none
  Vec3 position;                      // in the unit of the mesh as given
  double radius = 0, length = 0;      // same unit
};

struct ProposalOptions {
  Vec3 up{0, 1, 0};                   // of length 1
  double least_length_share = 0;      // share of the box diagonal
  std::size_t limit = 0;              // most proposals
  Span<const double> joints;          // [n][3], in the unit of the mesh as given
  Span<const std::uint32_t> parents;  // [n]; 0xffffffff for a root
};

// Returns pinned proposals first, then the others, each by length, the longest first. Throws as poisson_extremities
// does.
Vector<HandleProposal> propose_handles(const Core& core, const ProposalOptions& options);

}  // namespace hf_inner

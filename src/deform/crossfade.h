// Keeps a posed surface where it stands when handles are added in place, and lets it go as handles move.
//
// New handles have other fields, so their best pose differs from the pose before by 2e-3 to 7e-3 of the box. The
// difference D_v = old position - new position is added to the surface, times a share. The share is 1 where the handles
// stood then. It falls as they move away, to 0 over crossfade_reach, and as they come back to rest. After a rotation
// was freed it does not fall at rest, where the given rotation is part of the surface:
//     share = (1 - way / crossfade_reach)^2 min(1, rest way / rest way then)
// Both ways are the largest over all handles: the move of the centroid plus crossfade_turn times the angle. Cost: one
// product and sum per vertex. Allocates only when it is made.
#pragma once
#include "deform/handles.h"
#include "deform/rotation.h"

namespace hf_inner::deform {

struct Crossfade {
  Crossfade(std::size_t vertices, Memory& memory) : offset(memory, 3 * vertices), placed(&memory) {}
  Buffer<float> offset;        // three per vertex, in the unit of the mesh as given
  Vec3 low, high;              // a box that holds all offsets and 0
  Vector<RigidMotion> placed;  // the handles then: rotation, and move of the centroid in box diagonals
  double from_rest = 0;        // the largest way of a handle from rest then; 0: rest does not count
};

// Returns the largest way of a handle between two places.
double largest_way(Span<const RigidMotion> from, Span<const RigidMotion> to) noexcept;
// Returns the largest way of a handle from rest.
double way_from_rest(Span<const RigidMotion> placed) noexcept;
// Returns the share of the difference that the surface still gets. now: the handles, as Crossfade::placed.
double share_left(const Crossfade& crossfade, Span<const RigidMotion> now) noexcept;
// Adds share times D_v to the vertices.
void add_crossfade(const Crossfade& crossfade, double share, Vec3* positions, JobRunner& jobs);

}  // namespace hf_inner::deform

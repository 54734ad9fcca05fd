// Makes guides that hold poles: irregular vertices of quads at places that the caller chooses.
//
// A singularity of the crosses cannot be named, but it can be forced. The guides lie on a ring around the place, and
// their directions make a quarter turn along it. So the crosses inside have an index of 1/4 (three quads meet) or -1/4
// (five quads meet), whatever they are outside. Cost: O(n) per pole to find its place, then its neighbourhood.
#pragma once
#include "quads/field_quads.h"

namespace hf_inner {

struct QuadPole {
  Vec3 place;          // near the surface, inner units
  std::int32_t quads;  // how many meet there: 3 or 5
  Vec3 direction;      // of one side of the pole; its part along the surface counts; 0: any
};

// Appends the guides of the poles. radius: of the rings, inner units; an edge of the quads is a good one. A ring is a
// triangle wide at least. Throws HF_ERROR_INVALID_ARGUMENT (index = pole) where the surface has no normal.
void add_pole_guides(const Core& core, Span<const QuadPole> poles, double radius, Vector<QuadGuide>& out);

}  // namespace hf_inner

// Makes a quad mesh coarser by removing whole chords (Daniels, Silva, Shepherd and Cohen 2008).
//
// Removing a chord makes every edge that it crosses a point. That is the step from n to n - 1 of a whole length of the
// map, and it is taken only where the mesh stays valid, so no length becomes 0. The chord with the shortest edges goes
// first.
#pragma once
#include "quads/quad_complex.h"

namespace hf_inner::quads {

// A vertex of more quads than this is a hub. A chord whose edges end at a hub is checked from their other ends, so its
// cost depends on the faces there and not on the faces around the hub. Two hubs never become one. Less keeps more
// vertices apart, more walks longer around each. The largest vertex of 41 shared meshes has 44, so this changes none of
// them. A disc of 45,000 corners and no vertex inside has one of 25,000 quads: it takes 0.3 s, and did not end in 143 s
// without hubs.
constexpr std::int32_t hub_quads = 256;

// Removes chords until the mesh has at most `wanted` quads, or none can go. A chord that would leave less than `least`
// quads stays. Returns how many chords are gone. The mesh must be valid, and is valid after.
std::int32_t collapse_chords(QuadComplex& quads, std::int32_t wanted, std::int32_t least, Memory& memory,
                             std::int32_t hub = hub_quads);

}  // namespace hf_inner::quads

// The crosses that borders and creases hold.
#pragma once
#include "quads/cross_field.h"
#include "quads/face_cross.h"
#include "quads/sharp_corners.h"

namespace hf_inner::quads {

// The feature edges of a vertex agree if their crosses sum to more than this share of their number. Else the cross at
// the vertex is free. It matters at creases and borders only. At 0.25 aspects fall by 5 %, with 5 % more singularities.
// At 0.9 means change by at most 2 %.
constexpr double agreement = 0.5;

// Crosses at feature edges lie along them. Along borders they are evened out over `passes` edges: the fourth degree
// keeps right angles, and ragged borders get their mean direction. features: by half-edge.
Vector<HardCross> feature_crosses(const surface::Core& core, const remesh::FluxSurface& surface,
                                  const field::Connection& connection, const remesh::Table<std::uint8_t>& features,
                                  const SharpCorners& corners, std::int32_t passes);

}  // namespace hf_inner::quads

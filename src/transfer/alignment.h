// What differs between the two rest shapes: axes, size, and where a limb points.
//
// Axes: A = T' S with the rows right, up, forward of target and source; a rotation R of the source becomes A R A' on
// the target. Scale: the ratio of the legs' lengths, a leg being the mean height over the ground of the vertices with
// largest field of a foot pair between 0.4 and 0.6; without feet the ratio of the boxes' diagonals. Rest alignment, per
// limb: d = centroid of the region - centroid of the vertices with largest field h and 0.4 < u_h < 0.65, on both
// surfaces. Where A d_source and d_target differ by more than the limit (40 degrees), the minimal rotation D_h from the
// one to the other is applied before the motion, faded by w = clamp((max U - 0.35) / 0.2, 0, 1) as D_h^w. Limbs below a
// tenth of the box have no reliable direction and are left alone, trunk pairs too.
#pragma once
#include <cstdint>

#include "base/span.h"
#include "deform/rotation.h"
#include "mesh/mesh.h"

namespace hf_inner {

// One side's shape in field terms.
struct RestSide {
  const Mesh* mesh = nullptr;
  Span<const double> field;  // n x pair count
  Span<const double> area;
  Mat3 axes;  // rows right, up, forward
  Vec3 up() const noexcept { return {axes(1, 0), axes(1, 1), axes(1, 2)}; }
};

// Orthonormal axes of nine numbers; all zero: the identity. Throws HF_ERROR_INVALID_ARGUMENT when they are no
// right-handed frame within 1e-3.
Mat3 checked_axes(const double (&rows)[9], const char* side);

// Lowest point along up, inner coordinates.
double ground_height(const RestSide& side) noexcept;

// Mean leg length of the foot pairs (columns of the field), inner coordinates; 0 when no vertex lies in the window.
double leg_length(const RestSide& side, Span<const std::int32_t> foot_columns) noexcept;

// Direction of limb h (not normalised: its length is that of the outer limb). False when the window holds no vertex.
bool limb_direction(const RestSide& side, std::int32_t column, Vec3 region_centroid, Vec3& direction) noexcept;

// Minimal rotation taking the direction `from` to `to`; opposite directions turn about the axis nearest to `axis`.
Quaternion minimal_rotation(Vec3 from, Vec3 to, Vec3 axis) noexcept;

// q^w, w in [0, 1].
Quaternion power(const Quaternion& q, double w) noexcept;

}  // namespace hf_inner

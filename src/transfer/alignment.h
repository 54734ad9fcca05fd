// Compares the two rest shapes of a transfer: axes, size, and directions of limbs.
//
// Axes: A = T' S with the rows right, up, forward of target and source. A rotation R of the source becomes A R A' on
// the target. Scale: the ratio of the lengths of the legs, or of the boxes' diagonals without feet. The length of a leg
// is the mean height of the vertices whose largest field belongs to the foot and lies in leg_windows.
//
// Rest alignment works per limb. The direction d runs from the centroid of the vertices with field h in limb_window to
// the centroid of the region, on both surfaces. Where A d_source and d_target differ by more than the limit, D_h is the
// minimal rotation from one to the other. It is applied before the motion as D_h^w, where w fades it in along the limb.
// Short limbs and trunk pairs are left alone.
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

// Orthonormal axes of nine numbers; all zero: the identity. Throws HF_ERROR_INVALID_ARGUMENT unless they are a
// right-handed frame within axes_tolerance.
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

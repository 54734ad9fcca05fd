// Compares the two rest shapes of a transfer: their axes, their sizes, and the directions of their limbs.
//
// Axes: S and T hold the rows right, up, forward of source and target, and A = T' S. A rotation R of the source becomes
// A R A' on the target. Scale: the ratio of the leg lengths, or of the bounding boxes' diagonals if no pair is a foot.
// A leg consists of the vertices whose largest field is the foot's, with values in leg_windows. Its length is their
// mean height.
//
// Rest alignment works per limb h, on both surfaces. The direction d of a limb runs from the centroid of the vertices
// with field h in limb_window to the centroid of region h. If A d_source and d_target differ by more than the limit,
// D_h is the minimal rotation from d_target to A d_source. A cluster applies D_h^w before the motion, where w rises
// from 0 to 1 along the limb. Short limbs and trunk pairs get no alignment.
#pragma once
#include <cstdint>

#include "base/span.h"
#include "deform/rotation.h"
#include "mesh/mesh.h"
#include "transfer/constants.h"

namespace hf_inner::transfer {

// The rest shape of one side (source or target), with the fields of its paired regions.
struct RestSide {
  const mesh::Mesh* mesh = nullptr;
  Span<const double> field;  // vertex count x pair count
  Span<const double> area;
  Mat3 axes;  // rows right, up, forward
  Vec3 up() const noexcept { return {axes(1, 0), axes(1, 1), axes(1, 2)}; }
};

// Turns nine numbers into orthonormal axes; nine zeros mean the identity. Throws HF_ERROR_INVALID_ARGUMENT unless the
// rows are a right-handed frame within axes_tolerance.
Mat3 checked_axes(const double (&rows)[9], const char* side);

// Returns the height of the ground along up, in inner coordinates: of the lowest vertex. feet, trunk: heights of the
// lowest vertices of their regions, or no_height. The feet of a body are at the ground if they are below its trunk.
// Vertices far below the feet (a cape, a tail, scenery) are no ground.
double ground_height(const RestSide& side, double feet, double trunk) noexcept;

// Returns the mean leg length on one surface over the ground, in inner coordinates. foot_columns: columns of
// RestSide::field that belong to feet. If a leg has no vertex in any window, it returns 0.
double leg_length(const RestSide& side, Span<const std::int32_t> foot_columns, double ground) noexcept;

// Finds the rest direction of the limb at the region of field `column`; its length is the length of the outer part of
// the limb. Returns false when no vertex has a field value in the window.
bool limb_direction(const RestSide& side, std::int32_t column, Vec3 region_centroid, Vec3& direction,
                    FieldWindow window = limb_window) noexcept;

// Returns the minimal rotation that turns the direction `from` to `to`. For opposite directions it turns about the axis
// nearest to `axis`.
deform::Quaternion minimal_rotation(Vec3 from, Vec3 to, Vec3 axis) noexcept;

// Returns the rotation q^w, the part w of q. w: in [0, 1].
deform::Quaternion power(const deform::Quaternion& q, double w) noexcept;

}  // namespace hf_inner::transfer

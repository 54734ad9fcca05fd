// A pose as a skin for linear blend skinning: clusters as joints, each at the centroid of the surface it moves, so that
// its inverse bind matrix is a translation by minus that pivot.
//
// A joint is rigid, a free cluster affine and close to a rotation, and weights are cut: the joints' motions are those
// that bring the blend nearest to the posed surface,
//     min sum_v a_v |sum_c W_vc (R_c p_v + t_c) - x_v|^2,
// one joint after the other (weighted shape matching with weights a W^2, eight rounds), from the rotations nearest to
// the clusters; handles keep theirs. Weights: the 4 or 8 largest of a vertex, scaled to sum 1 and rounded to
// multiples of 2^-24 (the largest takes the remainder), so that they sum to 1 exactly in single precision in any order.
// Vertices that no handle reaches hang on one more joint, which never moves. Cost O(weights); the fit uses 20,000
// vertices at most.
#pragma once
#include "deform/blend.h"
#include "deform/pose.h"

namespace hf {

struct Skin {
  explicit Skin(Memory& memory) : pivot(&memory), rotation(&memory), place(&memory) {}
  Vector<Vec3> pivot;           // by joint, given frame
  Vector<Quaternion> rotation;  // of the last pose
  Vector<Vec3> place;           // of the pivot in the last pose
  bool rest_joint = false;      // the last joint holds what no handle reaches
};

// The joints of a pose that has handles; before the first deform() they stand at rest.
Skin make_skin(const Pose& pose, std::uint32_t weight_count, Memory& memory);
// Joints and weights of an inner vertex (-1: one without a triangle), `count` (4 or 8) of them, descending.
void skin_weights(const Pose& pose, std::int32_t vertex, std::uint32_t count, std::uint32_t* joints, float* weights);

}  // namespace hf

// A pose as a skin for linear blend skinning, with clusters as joints.
//
// Each joint lies at the centroid of the surface it moves, so its inverse bind matrix is a translation by minus that
// pivot. A free cluster is affine and weights are cut. The joints' motions bring the blend nearest to the posed
// surface:
//     min sum_v a_v |sum_c W_vc (R_c B_c diag(s_c) B_c' p_v + t_c) - x_v|^2,
// one joint after the other (weighted shape matching with weights a W^2), from the rotations nearest to the clusters.
// Handles keep theirs. B_c are the principal axes of the rest surface under the cluster, along which an engine's joint
// scale can stretch it. With s = 1 joints are rigid. Rotation and stretch of one joint are found in turn:
//     R = argmax tr(R' Y B s B'),   s_i = (B' R' Y B)_ii / (B' P B)_ii,
// with Y and P the moments of target and rest.
//
// Weights are the 4 or 8 largest of a vertex, scaled to sum 1 and rounded to multiples of 2^-24. The largest takes the
// remainder, so they sum to 1 exactly in single precision in any order. Vertices that no handle reaches belong to one
// more joint, which never moves. Cost: O(weights), and skin_rounds rounds over skin_vertices vertices at most.
#pragma once
#include "deform/blend.h"
#include "deform/pose.h"

namespace hf_inner {

struct Skin {
  explicit Skin(Memory& memory) : pivot(&memory), rotation(&memory), place(&memory), axes(&memory), stretch(&memory) {}
  Vector<Vec3> pivot;           // by joint, given frame
  Vector<Quaternion> rotation;  // of the last pose
  Vector<Vec3> place;           // of the pivot in the last pose
  Vector<Quaternion> axes;      // B, at rest
  Vector<Vec3> stretch;         // s along them in the last pose, 1 without
  bool rest_joint = false;      // the last joint holds what no handle reaches
};

// Where joint j takes a rest point of its own, both in the given frame.
Vec3 skinned(const Skin& skin, std::size_t j, Vec3 p) noexcept;

// The joints of a pose that has handles; at rest before the first deform(). `stretching`: joints may stretch along
// their axes.
Skin make_skin(const Pose& pose, std::uint32_t weight_count, bool stretching, Memory& memory);
// Joints and weights of an inner vertex (-1: one without a triangle), `count` (4 or 8) of them, descending.
void skin_weights(const Pose& pose, std::int32_t vertex, std::uint32_t count, std::uint32_t* joints, float* weights);

}  // namespace hf_inner

// Turns a pose into a skin for linear blend skinning, with clusters as joints.
//
// Each joint lies at the centroid of the surface it moves, so its inverse bind matrix is a translation by minus that
// pivot. A free cluster's transform is affine, and a skin has fewer weights. So the joints are fitted to bring the
// skinned surface nearest to the posed surface. They minimise sum_v a_v |sum_c W_vc (R_c B_c diag(s_c) B_c' p_v + t_c)
// - x_v|^2. a_v is the area of vertex v, W_vc its weight, p_v its rest and x_v its posed position. Joint c has rotation
// R_c, translation t_c and stretch s_c. B_c are the principal axes of the rest surface under the cluster, along which
// an engine's joint scale can stretch it. With s = 1 joints are rigid. The joints are fitted one after the other
// (weighted shape matching with weights a W^2), from the rotations nearest to the clusters. Handles keep their motions.
// Rotation and stretch of one joint are found in turn:
//     R = argmax tr(R' Y B s B'),   s_i = (B' R' Y B)_ii / (B' P B)_ii,
// where Y and P are the moments of target and rest.
//
// A vertex keeps its 4 or 8 largest weights, scaled to sum 1 and rounded to multiples of 2^-24. The largest takes the
// remainder, so they sum to exactly 1 in single precision in any order. Vertices that no handle reaches belong to one
// more joint, which never moves. Cost: O(weights), and skin_rounds rounds over at most skin_vertices vertices.
#pragma once
#include "deform/blend.h"
#include "deform/pose.h"

namespace hf_inner::deform {

struct Skin {
  explicit Skin(Memory& memory) : pivot(&memory), rotation(&memory), place(&memory), axes(&memory), stretch(&memory) {}
  Vector<Vec3> pivot;           // by joint, in the given frame
  Vector<Quaternion> rotation;  // of the last pose
  Vector<Vec3> place;           // where the pivot is in the last pose
  Vector<Quaternion> axes;      // axes of stretch at rest
  Vector<Vec3> stretch;         // scales along the axes in the last pose; 1 without stretching
  bool rest_joint = false;      // one more joint, the last, holds the vertices that no handle reaches
};

// Returns where joint j moves the rest point p. Both points are in the given frame.
Vec3 skinned(const Skin& skin, std::size_t j, Vec3 p) noexcept;

// Makes the joints of a pose that has handles. Before the first deform() they are at rest. stretching: joints may
// stretch along their axes.
Skin make_skin(const Pose& pose, std::uint32_t influence_count, bool stretching, Memory& memory);
// Writes the joints and weights of an inner vertex, largest first. vertex: -1 stands for a vertex without a triangle.
// count: 4 or 8.
void skin_weights(const Pose& pose, std::int32_t vertex, std::uint32_t count, std::uint32_t* joints, float* weights);

}  // namespace hf_inner::deform

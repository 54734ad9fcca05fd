// Bounds a posed surface by a box, from the transforms of clusters alone: for culling, where a shader has the vertices.
//
// The weights of a vertex are positive and sum to 1, so it is in the hull of the places to which its clusters move it.
// A cluster moves the rest box of its vertices to a parallelepiped, and the box around all of these holds the surface.
// On a coarse mesh, whose bands are narrower than its edges, the motions of single clusters can be far from the motion
// of the surface. Only their sums count there. So a mesh of few vertices is bounded by its vertices. Cost: a few
// products per cluster, or per vertex of a small mesh. Only cluster_boxes() allocates and can fail.
#pragma once
#include "deform/blend.h"

namespace hf_inner::deform {

struct BlendBox {
  Vec3 low, high;
  bool empty() const noexcept { return low.x > high.x; }
};

// Returns the rest box of the vertices of each cluster. The last box holds the vertices that no cluster moves, such as
// isolated ones. Unit: the scaled mesh. Some may be empty. Cost: one pass over the weights.
Vector<BlendBox> cluster_boxes(const mesh::Mesh& mesh, const ClusterWeights& weights, Memory& memory);

// Returns a box that holds the blended vertices, also as a shader computes them in floats. transforms: null for
// identities, or one per cluster.
BlendBox blended_box(const mesh::Mesh& mesh, const ClusterWeights& weights, const Vector<BlendBox>& boxes,
                     const Affine* transforms) noexcept;

}  // namespace hf_inner::deform

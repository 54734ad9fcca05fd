// Makes rows of blend weights with their gradients along the rest surface. A shader computes posed normals from them.
//
// Let w be the weights of a vertex p, A x = L x + t the transforms and g the gradients. The surface near p moves by the
// matrix J = sum w L + (A p) g^T. Two tangents u, v of the rest surface give the posed normal J u x J v. The gradient
// at a vertex is the mean of the linear gradients in its triangles, weighted by area. The normal then equals the sum of
// the area vectors of the triangles (vertex_normals), to first order in the difference of neighbouring transforms.
#pragma once
#include "deform/bands.h"

namespace hf_inner::deform {

// The entries of vertex v are start[v] .. start[v + 1]: first the entries of ClusterWeights, then entries of weight 0
// for clusters that only the neighbours have, as beside a handle.
struct GradedRows {
  explicit GradedRows(Memory& memory) : start(&memory), cluster(&memory), weight(&memory), gradient(&memory) {}
  Vector<std::int32_t> start;
  Vector<std::uint16_t> cluster;
  Vector<float> weight;
  Vector<Vec3> gradient;  // per unit of the scaled mesh; the gradients of a vertex sum to 0
};

// Cost: each entry is read once for each triangle at its vertex. Throws HF_ERROR_TOO_LARGE for more than 2^31 - 1
// entries.
GradedRows graded_rows(const mesh::Mesh& mesh, const ClusterWeights& weights, Memory& memory);

}  // namespace hf_inner::deform

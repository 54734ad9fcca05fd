// Rows of blend weights with their gradients along the rest surface: a shader gets posed normals from them.
//
// With the weights w, the transforms A x = L x + t and the gradients g of a vertex p, the surface near p moves by the
// matrix J = sum w L + (A p) g^T. Two tangents u, v of the rest surface give the posed normal J u x J v. The gradient
// of a vertex is the mean of the linear gradients in its triangles, by area. To first order in what the transforms of
// its neighbours differ, the normal is then that of vertex_normals: the sum of the triangles' area vectors.
#pragma once
#include "deform/bands.h"

namespace hf_inner {

// The entries of vertex v are start[v] .. start[v + 1]: those of ClusterWeights, then clusters of weight 0 that only
// the neighbours have, as beside a handle.
struct GradedRows {
  explicit GradedRows(Memory& memory) : start(&memory), cluster(&memory), weight(&memory), gradient(&memory) {}
  Vector<std::int32_t> start;
  Vector<std::uint16_t> cluster;
  Vector<float> weight;
  Vector<Vec3> gradient;  // per unit of the scaled mesh; those of a vertex sum to 0
};

// Cost: each entry is read once for each triangle at its vertex. Throws HF_ERROR_TOO_LARGE for more than 2^31 - 1
// entries.
GradedRows graded_rows(const Mesh& mesh, const ClusterWeights& weights, Memory& memory);

}  // namespace hf_inner

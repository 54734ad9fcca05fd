// The intrinsic Delaunay Laplacian at the cost of the edges that are not Delaunay.
//
// Most edges of most meshes are Delaunay as they stand, and there the operator is the cotangent one. So only patches
// are taken into an IntrinsicTriangulation: the triangles within two rings of an edge of negative weight. The edges
// around a patch are held; when flips inside leave one of them not Delaunay (its angle inside has grown), the patch
// grows there and starts again. Rows of vertices outside are those of the cotangent Laplacian to the bit, without
// negative rounding. The others are summed up from the faces of the patches and the triangles beside them. The
// Delaunay triangulation is unique up to edges of weight zero, so this is the operator of the whole triangulation.
//
// Where patches would hold a quarter of the mesh or more, or triangles need mollifying (intrinsic.h), everything is one
// patch. Cost: a pass over triangles and edges, in parallel, and O(p) for p triangles in patches.
#pragma once
#include "mesh/intrinsic.h"

namespace hf_inner {

struct DelaunayOperator {
  explicit DelaunayOperator(Memory& memory) : laplacian(memory), areas(&memory), changed(&memory) {}
  SymmetricMatrix laplacian;
  Vector<double> areas;              // by vertex, of the intrinsic triangles; empty unless asked for
  Vector<std::uint8_t> changed;      // by vertex, whether a triangle there was too thin to keep its weights; or empty
  std::int32_t patch_triangles = 0;  // triangles of the mesh that were taken into patches
};

// weights: cotangent weights by edge. On failure (std::bad_alloc) nothing exists. The same for any number of threads.
DelaunayOperator delaunay_operator(const Mesh& mesh, const Topology& topology, const Vector<double>& weights,
                                   bool with_areas, Memory& memory, JobRunner* jobs = nullptr);

}  // namespace hf_inner

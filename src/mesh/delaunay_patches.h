// Builds the intrinsic Delaunay Laplacian. The cost depends only on the number of edges that are not Delaunay.
//
// Most edges of most meshes are Delaunay already, and the cotangent Laplacian is right there. So only patches go into
// an IntrinsicTriangulation: the triangles within two rings of an edge of negative weight. Edges on the border of a
// patch cannot flip. If flips inside leave a border edge not Delaunay, the patch grows around that edge and starts
// again.
//
// A row of a vertex outside the patches is the row of the cotangent Laplacian, bit for bit, with rounding below zero
// cut off. The other rows are sums over the faces of the patches and the triangles beside them. The Delaunay
// triangulation is unique except for edges of weight zero, so this is the operator of the whole triangulation.
//
// The whole mesh becomes one patch in two cases: the patches would hold a quarter of it, or triangles need mollifying
// (intrinsic.h). Cost: a pass over triangles and edges, in parallel, and O(p) for p triangles in patches.
#pragma once
#include "mesh/intrinsic.h"

namespace hf_inner::mesh {

struct DelaunayOperator {
  explicit DelaunayOperator(Memory& memory) : laplacian(memory), areas(&memory), changed(&memory) {}
  SymmetricMatrix laplacian;
  Vector<double> areas;              // by vertex, of the intrinsic triangles; empty unless asked for
  Vector<std::uint8_t> changed;      // by vertex, whether a triangle there was too thin to keep its weights; or empty
  std::int32_t patch_triangles = 0;  // triangles of the mesh that were retriangulated
};

// Makes the Laplacian of the intrinsic Delaunay triangulation. weights: cotangent weights by edge. Throws
// std::bad_alloc. The result is the same for any number of threads.
DelaunayOperator delaunay_operator(const Mesh& mesh, const Topology& topology, const Vector<double>& weights,
                                   bool with_areas, Memory& memory, JobRunner* jobs = nullptr);

}  // namespace hf_inner::mesh

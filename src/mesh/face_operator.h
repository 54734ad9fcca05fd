// The Laplacian of a mesh whose faces have any number of corners. It does not depend on how a face is cut.
//
// Intrinsic Delaunay: a planar face has one intrinsic Delaunay triangulation, whatever its cut. A quad that is not
// planar has two cuts. The mean of the two Laplacians that take one cut and the other of every such quad is corrected
// by the polygon Laplacian (face_correction.h). No weight is negative, so fields keep within their site values.
// docs/surfaces.md compares it with the other operators.
//
// Cotangents: the polygon Laplacian of polygon_laplacian.h; clamped: the same with its weights raised; uniform: 1 for
// every side of a face.
#pragma once
#include "mesh/delaunay_patches.h"
#include "mesh/laplacian.h"

namespace hf_inner::mesh {

// Makes the Laplacian of a mesh with faces. weights: cotangent weights by edge of the cut. `areas` of the result is
// empty for kinds other than intrinsic_delaunay. Throws std::bad_alloc. The result is the same for any number of
// threads.
DelaunayOperator face_operator(const Mesh& mesh, const Topology& topology, const Vector<double>& weights,
                               OperatorKind kind, bool with_areas, Memory& memory, JobRunner* jobs = nullptr);

}  // namespace hf_inner::mesh

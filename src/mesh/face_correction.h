// Corrects the Laplacian of a mesh with faces by the polygon Laplacian of its faces, as far as weights stay positive.
//
// A cut makes fields over a quad too stiff, the point of the polygon Laplacian too soft. On squares two thirds of the
// second cancel the error of the first: harmonic fields are then exact to the sixth order. So K = D + sum_f c_f (B_f -
// M_f), with the matrix B_f of a face and its share M_f of D. Each c_f is the largest number up to two thirds with
// which no weight falls below 0: the faces at a weight may each use an equal part of it. Long or skewed faces get less,
// and faces that are not star-shaped none. Both matrices are exact for linear functions on flat faces, so K is too.
#pragma once
#include "base/jobs.h"
#include "base/symmetric_matrix.h"
#include "mesh/mesh.h"

namespace hf_inner::mesh {

// laplacian: D, without positive entries off its diagonal. The result is the same for any number of threads.
SymmetricMatrix corrected_by_polygons(const Mesh& mesh, const SymmetricMatrix& laplacian, Memory& memory,
                                      JobRunner* jobs);

// Weights of the six pairs 01 02 03 12 13 23 of a quad: of the cut by the diagonal 02, after a flip within the quad if
// that diagonal is not Delaunay.
void quad_weights(const Vec3 corners[4], double weights[6]) noexcept;

}  // namespace hf_inner::mesh

// The polygon Laplacian of Bunge, Herholz, Kazhdan and Botsch 2020, "Polygon Laplacian Made Simple".
//
// Every face of four corners and more gets a point: the one with the least sum of squared triangle areas to the sides.
// Its value is a weighted mean of the corners' values. The cotangent Laplacian of the triangles around the points acts
// on the means. Weights can be negative, at long quads for example: fields may leave the range of their sites. The
// corners of a face are all connected, so the cost is O(n^2) for n corners. Faces of many corners, and faces that name
// a vertex twice, count as the triangles of their cut.
#pragma once
#include "base/symmetric_matrix.h"
#include "mesh/mesh.h"

namespace hf_inner::mesh {

// The point of a face and the weights of its corners: of sum 1, and the smallest that give the point.
Vec3 face_point(Span<const Vec3> corners, Vector<double>& weights);

// Whether the corners of a face are connected with each other: from 4 corners to a limit, all different.
bool is_connected(Span<const std::int32_t> corners, Vector<std::int32_t>& scratch);

// The matrix P' S P of one face: S of the triangles from its sides to its point, whose value P makes.
class PolygonMatrix {
 public:
  explicit PolygonMatrix(Memory& memory) : value(&memory), spoke_(&memory), weight_(&memory) {}
  void make(Span<const Vec3> corners);

  Vector<double> value;  // [n][n], symmetric, without its diagonal: minus the weights
  bool is_star = false;  // the point sees every side from the inside, and no triangle is thin
 private:
  Vector<double> spoke_, weight_;
};

// Returns the Laplacian of a mesh with faces. The result is the same for any number of threads.
SymmetricMatrix polygon_laplacian(const Mesh& mesh, Memory& memory, JobRunner* jobs = nullptr);

// Raises every weight to at least 1e-3 of the median absolute weight, and updates the diagonal.
void clamp_weights(SymmetricMatrix& matrix, Memory& memory);

}  // namespace hf_inner::mesh

// Cuts a surface with crosses open to discs, and says how the two sides of every cut fit in a map to the plane.
//
// The crosses of all triangles are turned by quarters so that they agree across every edge of a spanning tree of the
// dual graph (combing). The other edges are the cut. Its dead ends at vertices without a singularity are taken back.
// The remaining cuts are seams: paths of cut edges between nodes. A node is a singularity, a border vertex, or a vertex
// where three or more seams meet. Let Z be a seamless map of the triangles to complex numbers. Across a seam with
// half-edge h, the map on the left is the map on the right, turned by quarters and moved:
//
//     Z_left = i^transition Z_right + t.
//
// All edges of a seam have one t. The t of the seams are not free: a turn around a node leads back. So (1 - i^k) z = T
// at a node, where i^k is the product of the turns, T a sum of the t, and z the map at the node. These equations are
// solved here, from the leaves of a spanning tree of the seams to its root. The free unknowns are the parameters: the
// map at the singularities, and one t per seam that is not in the tree (two per handle). The equation of the root gives
// the map at the root. The map at one vertex is held at 0, because maps can be moved. If all parameters are whole
// numbers, all t are whole numbers too.
#pragma once
#include "quads/face_cross.h"

namespace hf_inner::quads {

struct SeamTerm {
  std::int32_t parameter;
  std::complex<double> factor;
};
using SeamSum = Vector<SeamTerm>;  // by ascending parameter

struct Seams {
  explicit Seams(Memory& memory)
      : direction(memory),
        cut(memory),
        transition(memory),
        unit(memory),
        offset(memory),
        offsets(&memory),
        parameter(memory),
        fixed(&memory) {}
  // Throws HF_ERROR_UNSUPPORTED where no map can exist.
  static Seams make(const remesh::FluxSurface& surface, const FaceCross& crosses, Memory& memory);

  remesh::Table<std::complex<double>> direction;  // by real triangle: the combed direction in the frame of the triangle
  remesh::Table<std::uint8_t> cut;                // by half-edge
  remesh::Table<std::int8_t> transition;          // by half-edge: 0 .. 3, and 0 where it is not cut
  // The corner of a triangle at the tail of half-edge h has Z = i^unit z + offsets[offset], with z the map at the
  // vertex. offset is -1 for 0.
  remesh::Table<std::int8_t> unit;
  remesh::Table<std::int32_t> offset;
  Vector<SeamSum> offsets;
  // By vertex: free (z is an unknown that need not be whole), the number of the parameter that z is, or depends (z is
  // the sum fixed[..].sum).
  static constexpr std::int32_t free = -1, depends = -2;
  remesh::Table<std::int32_t> parameter;
  struct Fixed {
    std::int32_t vertex;
    SeamSum sum;
    bool whole;  // z must be a whole number
  };
  Vector<Fixed> fixed;
  std::int32_t parameter_count = 0, singularity_count = 0, cut_edges = 0;
};

// Returns i^k z.
inline std::complex<double> quarter_turned(std::complex<double> z, int k) noexcept {
  switch (k & 3) {
    case 1:
      return {-z.imag(), z.real()};
    case 2:
      return {-z.real(), -z.imag()};
    case 3:
      return {z.imag(), -z.real()};
    default:
      return z;
  }
}

}  // namespace hf_inner::quads

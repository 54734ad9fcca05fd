// A seamless map of a surface to the plane whose seams fit the grid of whole numbers (Bommes, Zimmer and Kobbelt 2009).
//
// The map Z = u + i v minimises the sum over triangles of area |grad u - x|^2 + |grad v - y|^2, with x and y the combed
// crosses over the edge length. That is a Poisson problem with two real unknowns for every vertex and every parameter
// of the seams (seams.h). One factor serves every edge length, because the edge length only scales the right-hand side.
// The parameters and the lines of features (features.h) are whole numbers in the result. They are rounded one after the
// other, the nearest to a whole number first. They come last in the order of the factor, so their part of the inverse
// costs little, and each rounding updates it (rank one). All together are sites on the factor (definite_system.h) in
// the end. Nothing is factorised again.
//
// The result is exact: coordinates are whole multiples of 1 / unit, and both sides of a seam fit to the bit. Vertices
// without a singularity get odd multiples, so that no vertex is on a line of halves.
#pragma once
#include "quads/definite_system.h"
#include "quads/features.h"

namespace hf_inner::quads {

// The map at an edge length. u, v: by half-edge, of the corner at its tail, in multiples of 1 / unit.
struct GridMap {
  explicit GridMap(Memory& memory) : u(memory), v(memory) {}
  remesh::Table<std::int64_t> u, v;
  int bits = 0;                  // unit = 2^bits
  std::int32_t turned_over = 0;  // triangles whose image is turned over or without area
  std::int32_t roundings = 0;
};

class GridMapper {
 public:
  // features: by half-edge. order: by inner vertex of the mesh, its place in an elimination order. All arguments must
  // outlive *this.
  GridMapper(const remesh::FluxSurface& surface, const FaceCross& crosses, const Seams& seams,
             const remesh::Table<std::uint8_t>& features, Span<const Index> order, Memory& memory, JobRunner& jobs);

  // Throws HF_ERROR_UNSUPPORTED if a singularity cannot lie on the grid or the map is too large.
  // untangled: turns triangles back that are turned over (untangle.h).
  GridMap make(double edge_length, bool untangled = true);
  // Frees the factor and its matrix, most of the memory. Do not call make, round and system after it.
  void release() noexcept;

  // The map before its vertices are rounded to multiples of 1 / unit: the unknowns of the factor.
  const SymmetricMatrix& matrix() const noexcept { return matrix_; }
  Span<const double> right() const noexcept { return right_; }
  const DefiniteSystem& system() const noexcept { return *system_; }
  // Equations of feature edges that whole numbers cannot meet.
  std::int32_t left_out() const noexcept { return left_out_; }
  // Rounds the parameters for an edge length and returns all unknowns; out_fixed: which were given, in order.
  Vector<double> round(double edge_length, Vector<Index>* out_fixed, Vector<double>* out_values);

 private:
  bool keep_longest(FeatureLines& lines, Vector<std::int32_t>& edges) const;
  void number(const remesh::Table<std::uint8_t>& features);
  void assemble();
  RealSum in_unknowns(RealSum sum) const;
  // A real variable as a sum of unknowns. Variables are vertices, and after them the offsets of the seams.
  Span<const RealTerm> expand(std::int32_t variable, int part, RealTerm& single) const;

  const remesh::FluxSurface& surface_;
  const FaceCross& crosses_;
  const Seams& seams_;
  Memory& memory_;
  JobRunner& jobs_;
  Span<const Index> order_;
  // By real variable, 2 variable + part: its unknown, or -1 - k if it is the sum sums_[k] of unknowns.
  remesh::Table<std::int32_t> unknown_;
  Vector<RealSum> sums_;
  remesh::Table<std::int32_t> of_parameter_, of_line_;  // the unknown of a real parameter and of a line
  std::int32_t free_count_ = 0;                         // unknowns that need not be whole; those that must follow
  std::int32_t left_out_ = 0;
  SymmetricMatrix matrix_;
  Vector<double> right_;
  Vector<double> inverse_;  // of the matrix, at the unknowns that must be whole; empty until it is needed
  std::optional<DefiniteSystem> system_;
  double made_length_ = 0;  // the edge length of made_, the unknowns of the last make
  Vector<double> made_;
};

}  // namespace hf_inner::quads

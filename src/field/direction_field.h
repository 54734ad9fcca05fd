// A smooth tangent direction field that can be edited, with its undo stack. It is the object behind hf_direction.
//
// A constraint is a vector at a vertex, projected on the tangent plane. Constraints can be added, removed, moved,
// turned and changed. DirectionSolver computes the field between them.
//
// Let n be the degree of the field. A vector of length r and angle phi in its vertex frame is the number r e^{i n phi}
// in the solver. The solution has n roots; the field returns the root whose angle is nearest to the x axis. If a
// constraint moves, its vector is carried along the shortest path of edges. Every edit changes a copy of the
// constraints. The copy replaces the original after the solver has accepted the change.
//
// The singularity index of a triangle is (1 / 2 pi)(sum of omega + n Omega) (Crane, Desbrun and Schroeder 2010, Section
// 5). Here omega_ij = arg(z_j / r_ij z_i), for each edge ij of the triangle. It is how much more the field z turns
// along the edge than the connection r_ij. Omega is the curvature of the triangle. Over a closed component, the indices
// divided by n sum to the Euler characteristic.
#pragma once
#include <memory>

#include "field/direction_solver.h"

namespace hf_inner::field {

struct DirectionConstraint {
  std::int32_t vertex = -1;                  // inner vertex; -1 marks an unused entry
  std::uint32_t given_vertex = HF_NO_INDEX;  // the vertex as the caller named it
  std::complex<double> vector;               // in the frame of the vertex
};

struct Singularity {
  std::int32_t triangle;  // of the inner mesh; of a face the first with a turn
  std::int32_t vertex;    // the corner where the field's vector is shortest
  std::int32_t index;     // turns of the field around it, times the degree
};

class DirectionField {
 public:
  DirectionField(std::shared_ptr<const surface::Core> core, std::int32_t degree, std::uint32_t site_limit);

  // Edits of the constraints. Each edit does everything or throws; the error index is the position in the list.
  void add(std::uint32_t count, const std::uint32_t* vertices, const double* vectors, std::uint32_t* out_sites);
  void remove(std::uint32_t count, const std::uint32_t* sites);
  void move(std::uint32_t count, const std::uint32_t* sites, const std::uint32_t* vertices);
  void set_vectors(std::uint32_t count, const std::uint32_t* sites, const double* vectors);
  void rotate(std::uint32_t count, const std::uint32_t* sites, const double* angles);

  // Makes a copy with the same constraints. Both share matrix, factor and the immutable parts of the solver.
  DirectionField(const DirectionField& other);
  DirectionField& operator=(const DirectionField&) = delete;

  std::uint32_t count() const noexcept { return count_; }
  Span<const DirectionConstraint> constraints() const noexcept { return constraints_; }
  const DirectionSolver& solver() const noexcept { return solver_; }

  // Computes the field of every welded vertex as a vector in space. Throws HF_ERROR_EMPTY.
  void solve(Vec3* out) const;
  // Sorted by triangle. The triangles that one face is cut into count as one.
  Vector<Singularity> singularities() const;

 private:
  void accept(Vector<DirectionConstraint>& next) noexcept;
  // Changes vectors: work(i, constraint) for every entry of the list. All or nothing.
  template <class Work>
  void update(std::uint32_t count, const std::uint32_t* sites, Work&& work);
  void check_site(const Vector<DirectionConstraint>& list, std::uint32_t position, std::uint32_t site) const;
  std::complex<double> projected(std::uint32_t position, std::int32_t vertex, const double* vector) const;
  void check_free(const Vector<DirectionConstraint>& list, std::uint32_t position, std::uint32_t own) const;
  Vector<std::complex<double>> solved() const;
  Memory& memory() const noexcept { return *solver_.core().memory; }

  DirectionSolver solver_;
  std::uint32_t site_limit_;
  Vector<DirectionConstraint> constraints_;  // by constraint number
  std::uint32_t count_ = 0;
};

}  // namespace hf_inner::field

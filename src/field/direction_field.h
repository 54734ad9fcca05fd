// A smooth tangent direction field under edit, with its undo stack: the object behind hf_direction.
//
// Constraints are vectors at vertices, projected on their tangent planes. They are added, removed, moved, turned and
// rewritten; the field between them is that of DirectionSolver.
//
// A vector v = |v| e^{i phi} in its frame stands in the solver as |v| e^{i n phi}, n the degree. The field answers with
// the root whose angle is nearest to that of the x axis. Moving a constraint carries its vector along the shortest path
// of edges. Every edit works on a copy of the constraints and swaps it in after the solver has taken the change.
//
// Singularities: a triangle ijk has the index I = (1 / 2 pi)(sum of omega + n Omega) (Crane, Desbrun and Schroeder
// 2010, Section 5). omega_ij = arg(z_j / r_ij z_i) is the turn of the field along an edge beyond that of the
// connection, Omega the curvature of the triangle. I / n sums to the Euler characteristic over a closed component.
#pragma once
#include <memory>

#include "base/history.h"
#include "field/direction_solver.h"

namespace hf_inner {

struct DirectionConstraint {
  std::int32_t vertex = -1;                  // inner vertex; -1 marks a free slot
  std::uint32_t given_vertex = HF_NO_INDEX;  // the vertex as the caller named it
  std::complex<double> vector;               // in the frame of the vertex
};

struct Singularity {
  std::int32_t triangle;  // of the inner mesh
  std::int32_t vertex;    // its corner of the shortest vector
  std::int32_t index;     // times the degree
};

class DirectionField {
 public:
  DirectionField(std::shared_ptr<const Core> core, std::int32_t degree, std::uint32_t site_limit);

  // Each all or nothing; throws with the position in the list as index.
  void add(std::uint32_t count, const std::uint32_t* vertices, const double* vectors, std::uint32_t* out_sites);
  void remove(std::uint32_t count, const std::uint32_t* sites);
  void move(std::uint32_t count, const std::uint32_t* sites, const std::uint32_t* vertices);
  void set_vectors(std::uint32_t count, const std::uint32_t* sites, const double* vectors);
  void rotate(std::uint32_t count, const std::uint32_t* sites, const double* angles);

  // Shares the system; with the constraints, without the undo stack.
  DirectionField(const DirectionField& other);
  DirectionField& operator=(const DirectionField&) = delete;
  // As ScalarField: undo goes back to the last record, redo returns; the same bits. Throw HF_ERROR_NO_RECORD.
  void record();
  void undo();
  void redo();

  std::uint32_t count() const noexcept { return count_; }
  Span<const DirectionConstraint> constraints() const noexcept { return constraints_; }
  const DirectionSolver& solver() const noexcept { return solver_; }

  // The field of every inner vertex as a vector in space. Throws HF_ERROR_NO_SITES.
  void solve(Vec3* out) const;
  Vector<Singularity> singularities() const;  // by triangle

 private:
  struct Record {
    Record(const DirectionField& field)
        : constraints(field.constraints_, &field.memory()), count(field.count_), state(field.solver_.snapshot()) {}
    Vector<DirectionConstraint> constraints;
    std::uint32_t count;
    std::shared_ptr<const ConstraintState> state;
  };
  void restore(Record& record);
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
  Vector<DirectionConstraint> constraints_;  // by slot
  std::uint32_t count_ = 0;
  History<Record> history_;
};

}  // namespace hf_inner

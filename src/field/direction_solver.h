// Solves the smoothest vector fields through constraints that can be edited. It has its own factor, of the connection
// Laplacian. The constraints go through the constraint system that scalar fields use (solve/constraint_system.h).
//
//     E(z) = sum over edges of w_ij |z_j - r_ij z_i|^2,   r_ij = exp(i n rotation_ij)      (Knoeppel et al. 2013)
//
// The field z minimises E. It has one complex unknown per vertex, which is two real unknowns. The degree of the field
// is n. The cotangent weights w_ij are raised to at least 1e-3 of their median. The matrix K of E is positive definite
// on curved surfaces. K is singular where every round trip brings a vector back unturned, such as on a flat patch or a
// cylinder. So one vertex of every component is pinned (its diagonal is raised). The constraint system removes the
// effect of the pinned unknowns from the solution, with their elimination paths. A constraint consists of two sites,
// one for each real unknown. A new value of a constraint costs a dense solve and a backward sweep.
#pragma once
#include "field/direction_system.h"
#include "solve/constraint_system.h"

namespace hf_inner::field {

struct DirectionCounters {
  std::uint32_t factorisations = 0, path_solves = 0, sweeps = 0;
  double bytes = 0;
};

class DirectionSolver {
 public:
  // degree: 1 for vectors, 2 for lines, 4 for crosses; at least 1. Throws what Factor::make throws.
  DirectionSolver(std::shared_ptr<const surface::Core> core, std::int32_t degree)
      : DirectionSolver(make_owner_in<DirectionSystem>(core->memory, core, degree)) {}
  // Makes a solver without constraints. Other solvers may share `system` (matrix and factor).
  explicit DirectionSolver(std::shared_ptr<const DirectionSystem> system)
      : system_(std::move(system)), constraints_(system_->pinned_operator()) {}
  // Makes a copy with the same constraints. Both share the factor, and also elimination paths and dense systems until
  // one is edited. The counters of the copy start at zero.
  DirectionSolver(const DirectionSolver& other) : DirectionSolver(other.system_) {
    constraints_.restore(other.constraints_.state());
  }
  DirectionSolver& operator=(const DirectionSolver&) = delete;

  // Removes some constraints and adds others at vertices. Each has a slot number, which may be in both lists. The edit
  // does everything or throws.
  struct Edit {
    Span<const Index> remove, add, vertices;
  };
  void edit(const Edit& edit);
  // Factorises again with the constrained vertices eliminated, so that each costs no dense solve. Throws
  // HF_ERROR_EMPTY if there are none.
  void rebase() { constraints_.rebase(*core().jobs); }
  // Computes z of every welded vertex, in its frame and raised to the degree. values: by constraint number, in the same
  // form. Vertices of components without a constraint get 0.
  void solve(Span<const std::complex<double>> values, std::complex<double>* field) const;

  const surface::Core& core() const noexcept { return *system_->core; }
  const DirectionSystem& system() const noexcept { return *system_; }
  const Connection& connection() const noexcept { return system_->connection; }
  const SymmetricMatrix& matrix() const noexcept { return system_->matrix; }
  Index degree() const noexcept { return system_->degree; }
  Index constraint_count(Index component) const noexcept { return constraints_.state().sites_of[at(component)] / 2; }
  bool eliminates() const noexcept { return constraints_.state().base != nullptr; }
  Index eliminated_count() const noexcept;  // constraints in the factor at present
  const factor::FactorStatistics& statistics() const noexcept { return system_->factor->statistics(); }
  double operator_ms() const noexcept { return system_->operator_ms; }
  DirectionCounters counters() const noexcept;

  // snapshot returns the present constraints; their paths and dense blocks are shared, not copied. restore goes back to
  // a snapshot bit for bit.
  std::shared_ptr<const solve::ConstraintState> snapshot() const { return constraints_.snapshot(); }
  void restore(const solve::ConstraintState& state) { constraints_.restore(state); }

 private:
  Memory& memory() const noexcept { return *core().memory; }

  std::shared_ptr<const DirectionSystem> system_;  // before the constraints, which read it
  // Site 2 s is the real part of constraint s, site 2 s + 1 the imaginary part.
  solve::ConstraintSystem constraints_;
};

}  // namespace hf_inner::field

// Smoothest vector fields under edit: the connection Laplacian on a factor of its own, constrained by the machine of
// fields (engine/constraint_system.h).
//
//     E(z) = sum over edges of w_ij |z_j - r_ij z_i|^2,   r_ij = exp(i n rotation_ij)      (Knoeppel et al. 2013)
//
// One complex unknown per vertex (two real ones), n the degree of the field, w the cotangent weights floored at 1e-3 of
// their median. K = the matrix of E is definite on curved surfaces and singular where every round trip comes back
// unturned (a flat patch, a cylinder). So one vertex of every component is pinned, and the machine takes the pins out
// of the answer by their paths. A constraint is two sites, one a real unknown. A new value costs a dense solve and a
// backward sweep.
#pragma once
#include "engine/constraint_system.h"
#include "field/direction_system.h"

namespace hf_inner {

struct DirectionCounters {
  std::uint32_t factorisations = 0, path_solves = 0, sweeps = 0;
  double bytes = 0;
};

class DirectionSolver {
 public:
  // degree >= 1: fields of vectors (1), lines (2), crosses (4). Throws what Factor::make does.
  DirectionSolver(std::shared_ptr<const Core> core, std::int32_t degree)
      : DirectionSolver(make_owner_in<DirectionSystem>(core->memory, core, degree)) {}
  // Without constraints, on a system that others may share.
  explicit DirectionSolver(std::shared_ptr<const DirectionSystem> system)
      : system_(std::move(system)), constraints_(system_->pinned_operator()) {}
  // Shares the system and, until they are edited, paths and dense blocks; with the same constraints, counts start
  // again.
  DirectionSolver(const DirectionSolver& other) : DirectionSolver(other.system_) {
    constraints_.restore(other.constraints_.state());
  }
  DirectionSolver& operator=(const DirectionSolver&) = delete;

  // Frees slots and puts constraints at vertices into slots; a slot may stand in both. All or nothing.
  struct Edit {
    Span<const Index> remove, add, vertices;
  };
  void edit(const Edit& edit);
  // Moves the constrained vertices into the factor. Throws HF_ERROR_NO_SITES without one.
  void rebase() { constraints_.rebase(*core().jobs); }
  // z of every inner vertex, in its frame, raised to the degree; values by slot, likewise. Vertices of components
  // without a constraint get 0.
  void solve(Span<const std::complex<double>> values, std::complex<double>* field) const;

  const Core& core() const noexcept { return *system_->core; }
  const DirectionSystem& system() const noexcept { return *system_; }
  const Connection& connection() const noexcept { return system_->connection; }
  const SymmetricMatrix& matrix() const noexcept { return system_->matrix; }
  Index degree() const noexcept { return system_->degree; }
  Index constraint_count(Index component) const noexcept { return constraints_.state().sites_of[at(component)] / 2; }
  bool eliminates() const noexcept { return constraints_.state().base != nullptr; }
  Index eliminated_count() const noexcept;  // constraints in the factor at present
  const FactorStatistics& statistics() const noexcept { return system_->factor->statistics(); }
  double operator_ms() const noexcept { return system_->operator_ms; }
  DirectionCounters counters() const noexcept;

  // The present constraints with their paths and dense blocks, all shared; restore gives the same bits.
  std::shared_ptr<const ConstraintState> snapshot() const { return constraints_.snapshot(); }
  void restore(const ConstraintState& state) { constraints_.restore(state); }

 private:
  Memory& memory() const noexcept { return *core().memory; }

  std::shared_ptr<const DirectionSystem> system_;  // before the constraints, which read it
  ConstraintSystem constraints_;                   // slot 2 s + part is a part of constraint s
};

}  // namespace hf_inner

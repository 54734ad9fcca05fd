#include "field/direction_solver.h"

#include <algorithm>

#include "base/error.h"

namespace hf_inner::field {

Index DirectionSolver::eliminated_count() const noexcept {
  Index parts = 0;
  for (const solve::ConstraintState::Entry& entry : constraints_.state().entries) parts += entry.eliminated >= 0;
  return parts / 2;
}

DirectionCounters DirectionSolver::counters() const noexcept {
  const solve::ConstraintCounts counts = constraints_.counts();
  DirectionCounters counters;
  // One of the system, and one per rebase (constraints taken into the factor).
  counters.factorisations = 1 + counts.rebases;
  counters.path_solves = counts.path_solves;
  counters.sweeps = counts.sweeps;
  counters.bytes = constraints_.row_bytes() + constraints_.base_bytes();
  return counters;
}

void DirectionSolver::edit(const Edit& edit) {
  Vector<Index> remove(&memory()), add(&memory());
  Vector<solve::Site> sites(&memory());
  for (const Index slot : edit.remove) {
    remove.push_back(2 * slot);
    remove.push_back(2 * slot + 1);
  }
  for (std::size_t i = 0; i < edit.add.size(); ++i) {
    for (Index part = 0; part < 2; ++part) {
      const Index v = edit.vertices[i];
      add.push_back(2 * edit.add[i] + part);
      sites.push_back(solve::Site::at_unknown(system_->unknown(v, part), core().mesh.component[at(v)]));
    }
  }
  try {
    constraints_.edit({remove, add, sites});
  } catch (const Error& error) {
    if (error.code() != HF_ERROR_CONFLICT) throw;
    fail(HF_ERROR_NOT_POSITIVE_DEFINITE, HF_NO_INDEX,
         "the constraints of a component depend on each other; the weights are degenerate");
  }
}

void DirectionSolver::solve(Span<const std::complex<double>> values, std::complex<double>* field) const {
  const std::size_t unknowns = at(system_->matrix.size());
  surface::Workspace z(core().workspaces, unknowns);
  solve::ConstraintSystem::Answer answer(memory());
  // A complex number is its real and imaginary part in order. They are the values of two sites.
  constraints_.sweep(reinterpret_cast<const double*>(values.data()), 1, 0, 1, answer, z.data());
  const Span<const Index> row = system_->factor->position();
  for (Index v = 0; v < core().size(); ++v) {
    const bool reached = constraint_count(core().mesh.component[at(v)]) > 0;
    const auto part = [&](Index p) { return z[at(row[at(system_->unknown(v, p))])]; };
    field[v] = reached ? std::complex<double>(part(0), part(1)) : 0.0;
  }
  for (const auto& entry : constraints_.state().entries) {
    if (!entry.used()) continue;
    const Index slot = static_cast<Index>(&entry - constraints_.state().entries.data()) / 2;
    field[system_->vertex_of(entry.site.vertex[0])] = values[at(slot)];
  }
}

}  // namespace hf_inner::field

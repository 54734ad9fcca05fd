#include "engine/screened_solver.h"

#include <algorithm>

namespace hf_inner {

std::shared_ptr<const Screening> Screening::make(std::shared_ptr<const Core> core, Span<const double> strength,
                                                 const double* target, Index channels) {
  const std::shared_ptr<Memory> memory = core->memory;
  const std::size_t n = at(core->size()), m = at(channels);
  const auto made =
      make_owner_in<Screening>(memory, ScreenedOperator::make(std::move(core), strength, ScreenedOptions{}), *memory);
  const ScreenedOperator& screened = *made->screened;
  for (Index c = 0; c < screened.core->mesh.component_count(); ++c) {
    made->reaches.push_back(screened.screened(c));
    made->reaches_any |= screened.screened(c);
  }
  made->field.allocate(*memory, n * m);
  screened.solve(channels, made->field.data(), m, [&](Index v, Index first, Index count, double* p) {
    if (target) std::copy_n(target + at(v) * m + at(first), at(count), p);
  });
  return made;
}

void ScreenedSolver::solve(const double* values, Index channels, double* field, double* flux) const {
  const std::size_t size = at(core().size()) * at(channels);
  Workspace own(core().workspaces, field ? 0 : size);
  if (!field) field = own.data();
  std::copy_n(screening_->field.data(), size, field);
  screening_->screened->add_sites(system_, values, channels, field, at(channels), flux);
  if (flux && system_.state().base) eliminated_flux(channels, field, flux);
}

// Computes the flux of each eliminated site e: lambda_e = (M (u - u_0))_e - (W lambda)_e, with M = K + A H and u_0 the
// field without sites.
void ScreenedSolver::eliminated_flux(Index channels, const double* field, double* flux) const {
  const std::size_t m = at(channels);
  const SymmetricMatrix& k = screening_->screened->matrix;
  const ConstraintState& state = system_.state();
  const double* plain = screening_->field.data();
  Vector<Index> slot_of_base(state.freed.size(), -1, core().memory.get());
  for (std::size_t slot = 0; slot < state.entries.size(); ++slot) {
    const auto& entry = state.entries[slot];
    if (!entry.used() || entry.eliminated < 0) continue;
    slot_of_base[at(entry.eliminated)] = static_cast<Index>(slot);
    const std::size_t e = at(entry.site.vertex[0]);
    std::fill_n(flux + slot * m, m, 0.0);
    for (Index i = k.column_start[e]; i < k.column_start[e + 1]; ++i) {
      const std::size_t w = at(k.row[at(i)]) * m;
      for (std::size_t q = 0; q < m; ++q) flux[slot * m + q] += k.value[at(i)] * (field[w + q] - plain[w + q]);
    }
  }
  for (std::size_t slot = 0; slot < state.entries.size(); ++slot) {
    const auto& entry = state.entries[slot];
    if (!entry.used() || entry.eliminated >= 0) continue;
    for (int c = 0; c < 3; ++c) {
      if (entry.site.vertex[c] < 0 || !state.base->eliminated(entry.site.vertex[c])) continue;
      const Index there = slot_of_base[at(state.base->index_of[at(entry.site.vertex[c])])];
      for (std::size_t q = 0; there >= 0 && q < m; ++q)
        flux[at(there) * m + q] -= entry.site.weight[c] * flux[slot * m + q];
    }
  }
}

void ScreenedSolver::solve_at(const double* values, Index channels, Span<const Index> vertices, double* out) const {
  // The field without sites is known, but the sites may reach every vertex.
  const std::size_t m = at(channels);
  Workspace field(core().workspaces, at(core().size()) * m);
  solve(values, channels, field.data(), nullptr);
  for (std::size_t i = 0; i < vertices.size(); ++i) std::copy_n(field.data() + at(vertices[i]) * m, m, out + i * m);
}

EngineCounters ScreenedSolver::counters() const noexcept {
  const ConstraintCounts counts = system_.counts();
  EngineCounters out;
  out.factorisations = 2 + counts.rebases;  // one of the core, one of the screening, and one per rebase
  out.path_solves = counts.path_solves, out.sweeps = counts.sweeps;
  out.rebases = counts.rebases, out.dense_edits = counts.dense_edits;
  out.bytes = system_.row_bytes() + system_.base_bytes() + screening_->screened->factor->statistics().bytes;
  out.rebase_advised = system_.row_bytes() > core().factor->statistics().bytes;
  out.dense_rows = static_cast<std::uint32_t>(system_.state().rows);
  for (const auto& entry : system_.state().entries) out.eliminated += entry.used() && entry.eliminated >= 0;
  out.last_route = system_.state().decision.route;
  out.dense_ms = system_.state().decision.dense_ms, out.rebase_ms = system_.state().decision.rebase_ms;
  return out;
}

}  // namespace hf_inner

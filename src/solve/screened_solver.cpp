#include "solve/screened_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "solve/corrections.h"

namespace hf_inner::solve {
namespace {

// A H of a vertex may be this multiple of the mean diagonal, which is what the stiffness of a site may be. The field
// follows p to about its inverse. A larger number leaves sites beside such vertices no digits.
constexpr double largest_mass = 1e12;

void check_sizes(const surface::Core& core, Span<const double> strength) {
  for (Index v = 0; v < core.size(); ++v) {
    if (core.areas[at(v)] * strength[at(v)] <= largest_mass * core.mean_diagonal[at(core.mesh.component[at(v)])])
      continue;
    const std::uint32_t vertex = static_cast<std::uint32_t>(core.mesh.given_of_inner[at(v)]);
    fail(HF_ERROR_TOO_LARGE, vertex,
         "the screening of vertex %u times its area is more than %g times the mean diagonal of K; make it smaller, or "
         "hold "
         "the vertex with a site",
         vertex, largest_mass);
  }
}

}  // namespace

std::shared_ptr<const Screening> Screening::make(std::shared_ptr<const surface::Core> core, Span<const double> strength,
                                                 const double* target, Index channels) {
  check_sizes(*core, strength);
  const std::shared_ptr<Memory> memory = core->memory;
  const std::size_t n = at(core->size()), m = at(channels);
  const auto made =
      make_owner_in<Screening>(memory, ScreenedOperator::make(std::move(core), strength, ScreenedOptions{}), *memory);
  const ScreenedOperator& screened = *made->screened;
  made->strength.assign(strength.begin(), strength.end());
  for (Index c = 0; c < screened.core->mesh.component_count(); ++c) {
    made->reaches.push_back(screened.screened(c));
    made->reaches_any |= screened.screened(c);
  }
  made->field.allocate(*memory, n * m);
  screened.solve(channels, made->field.data(), m, [&](Index v, Index first, Index count, double* p) {
    if (target) std::copy_n(target + at(v) * m + at(first), at(count), p);
  });
  if (target) {
    made->target.assign(target, target + n * m);
    if (screened.is_weak) made->correct_field(channels);
  }
  return made;
}

// Corrects the field without sites. Where A H is small beside K, rounding in the factor hides its last digits.
void Screening::correct_field(Index channels) {
  const surface::Core& core = *screened->core;
  const std::size_t n = at(core.size()), stride = at(channels);
  Vector<double> low(reaches.size(), core.memory.get()), unit(reaches.size(), core.memory.get());
  for (std::size_t c = 0; c < stride; ++c) {
    // The unit of changes is the range of the targets, or their size if the range is 0.
    low.assign(reaches.size(), HUGE_VAL);
    unit.assign(reaches.size(), -HUGE_VAL);
    for (std::size_t v = 0; v < n; ++v) {
      if (!(screened->mass[v] > 0)) continue;
      const std::size_t component = at(core.mesh.component[v]);
      low[component] = std::min(low[component], target[v * stride + c]);
      unit[component] = std::max(unit[component], target[v * stride + c]);
    }
    for (std::size_t i = 0; i < unit.size(); ++i)
      unit[i] = unit[i] > low[i] ? unit[i] - low[i] : std::max(std::fabs(low[i]), std::numeric_limits<double>::min());
    surface::Workspace u(core.workspaces, n), wish(core.workspaces, n), change(core.workspaces, n);
    for (std::size_t v = 0; v < n; ++v) {
      u[v] = field[v * stride + c];
      wish[v] = target[v * stride + c];
    }
    Corrections corrections;
    double largest = 0;
    do {
      screened->multiply(u.data(), wish.data(), 1, change.data());
      for (std::size_t v = 0; v < n; ++v) change[v] = reaches[at(core.mesh.component[v])] ? -change[v] : 0.0;
      screened->solve_right(1, change.data());
      largest = 0;
      for (std::size_t v = 0; v < n; ++v) {
        u[v] += change[v];
        largest = std::max(largest, std::fabs(change[v]) / unit[at(core.mesh.component[v])]);
      }
    } while (corrections.go_on(largest));
    for (std::size_t v = 0; v < n; ++v) field[v * stride + c] = u[v];
  }
}

bool ScreenedSolver::correct(const double* values, Index channels, const double* field, const double* flux,
                             double* change, double* flux_change) const {
  const std::size_t n = at(core().size()), slots = system_.state().entries.size(), stride = at(channels);
  Memory& memory = *core().memory;
  const Vector<double>& target = screening_->target;
  Vector<double> lambda(flux, flux + slots * stride, &memory), more(&memory);
  surface::Workspace u(core().workspaces, n * stride);
  std::copy_n(field, n * stride, u.data());
  for (Index first = 0; first < channels; first += ConstraintSystem::channel_block) {
    const Index count = std::min(ConstraintSystem::channel_block, channels - first);
    const std::size_t m = at(count);
    surface::Workspace own(core().workspaces, n * m), wish(core().workspaces, target.empty() ? 0 : n * m);
    for (std::size_t v = 0; !target.empty() && v < n; ++v)
      std::copy_n(target.data() + v * stride + at(first), m, wish.data() + v * m);
    screening_->screened->correct(
        system_, {count, values + at(first), stride, u.data() + at(first), stride, lambda.data() + at(first), stride},
        nullptr, target.empty() ? nullptr : wish.data(), own.data(), more);
    for (std::size_t v = 0; v < n; ++v) std::copy_n(own.data() + v * m, m, change + v * stride + at(first));
    for (std::size_t s = 0; s < slots; ++s) std::copy_n(more.data() + s * m, m, flux_change + s * stride + at(first));
  }
  return true;
}

void ScreenedSolver::solve(const double* values, Index channels, double* field, double* flux) const {
  const std::size_t size = at(core().size()) * at(channels);
  surface::Workspace own(core().workspaces, field ? 0 : size);
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
  surface::Workspace field(core().workspaces, at(core().size()) * m);
  solve(values, channels, field.data(), nullptr);
  for (std::size_t i = 0; i < vertices.size(); ++i) std::copy_n(field.data() + at(vertices[i]) * m, m, out + i * m);
}

EngineCounters ScreenedSolver::counters() const noexcept {
  const ConstraintCounts counts = system_.counts();
  EngineCounters out;
  out.factorisations = 2 + counts.rebases;  // one of the core, one of the screening, and one per rebase
  out.path_solves = counts.path_solves;
  out.sweeps = counts.sweeps;
  out.rebases = counts.rebases;
  out.dense_edits = counts.dense_edits;
  out.bytes = system_.row_bytes() + system_.base_bytes() + screening_->screened->factor->statistics().bytes;
  out.rebase_advised = system_.row_bytes() > core().factor->statistics().bytes;
  out.dense_rows = static_cast<std::uint32_t>(system_.state().rows);
  for (const auto& entry : system_.state().entries) out.eliminated += entry.used() && entry.eliminated >= 0;
  out.last_route = system_.state().decision.route;
  out.dense_ms = system_.state().decision.dense_ms;
  out.rebase_ms = system_.state().decision.rebase_ms;
  return out;
}

}  // namespace hf_inner::solve

#include "solve/green.h"

#include <algorithm>
#include <cmath>

namespace hf_inner::solve {
namespace {

// Number of matrix rows that one thread's job takes. Half this number costs more calls than it gains. Twice this number
// leaves threads idle on meshes of 50,000 vertices. On two threads and a torus of 102,400 vertices half and double
// solve one and eight channels in the same time within 3 %.
constexpr std::size_t piece = 16384;
PinnedOperator operator_of(const surface::Core& core) {
  PinnedOperator a;
  a.core = &core;
  a.factor = core.factor.get();
  a.pins = core.ground;
  a.pin_weight = core.mean_diagonal;
  a.memory = core.memory.get();
  a.jobs = core.jobs.get();
  return a;
}

}  // namespace

GreenSolver::GreenSolver(std::shared_ptr<const surface::Core> core, double crowded)
    : core_(std::move(core)), system_(operator_of(*core_)), crowded_(crowded) {}

GreenSolver::GreenSolver(const GreenSolver& other)
    : core_(other.core_), system_(other.system_), crowded_(other.crowded_), cloned_at_(other.system_.counts()) {}

std::shared_ptr<SiteSolver> GreenSolver::on(std::shared_ptr<const surface::Core> core,
                                            std::shared_ptr<const surface::VertexMap> map) const {
  if (core->root) return make(std::move(core));
  const auto made = make_owner_in<GreenSolver>(core->memory, core);
  if (!state().base && !state().groups.empty()) made->system_.know({system_.snapshot(), core_->factor, std::move(map)});
  return made;
}

EngineCounters GreenSolver::counters() const noexcept {
  const ConstraintCounts counts = system_.counts();
  EngineCounters counters;
  counters.factorisations = 1 + counts.rebases;  // one of the core, and one per rebase (sites taken into the factor)
  counters.path_solves = counts.path_solves;
  counters.sweeps = counts.sweeps;
  counters.bytes = system_.row_bytes() + system_.base_bytes();
  counters.rebase_advised = system_.row_bytes() > core_->factor->statistics().bytes;
  counters.rebases = counts.rebases;
  counters.dense_edits = counts.dense_edits;
  counters.dense_rows = static_cast<std::uint32_t>(state().rows);
  for (const auto& entry : state().entries) counters.eliminated += entry.used() && entry.eliminated >= 0;
  counters.last_route = state().decision.route;
  counters.dense_ms = state().decision.dense_ms;
  counters.rebase_ms = state().decision.rebase_ms;
  return counters;
}

void GreenSolver::succeed(const SiteSolver& predecessor) noexcept {
  const ConstraintCounts now = static_cast<const GreenSolver&>(predecessor).system_.counts();
  system_.add_counts({now.path_solves - cloned_at_.path_solves, now.sweeps - cloned_at_.sweeps,
                      now.rebases - cloned_at_.rebases, now.dense_edits - cloned_at_.dense_edits});
}

bool GreenSolver::is_refined() const noexcept {
  return core_->refinements > 0 || core_->is_long || system_.is_crowded(crowded_);
}

void GreenSolver::value_extent(const double* values, Index channels, Index first, Index count, Vector<double>& low,
                               Vector<double>& high) const {
  const std::size_t m = at(count), components = state().sites_of.size();
  low.assign(components * m, HUGE_VAL);
  high.assign(components * m, -HUGE_VAL);
  for (std::size_t slot = 0; slot < state().entries.size(); ++slot) {
    if (!state().entries[slot].used()) continue;
    const std::size_t c = at(state().entries[slot].site.component);
    for (std::size_t q = 0; q < m; ++q) {
      const double value = values[slot * at(channels) + at(first) + q];
      low[c * m + q] = std::min(low[c * m + q], value);
      high[c * m + q] = std::max(high[c * m + q], value);
    }
  }
}

void GreenSolver::solve_into(const double* values, Index channels, FieldSink& sink) const {
  const std::size_t rows = at(core_->unknown_count()), n = at(core_->size());
  if (state().base || is_refined()) return solve_copied(*this, *core_, values, channels, sink);
  const Span<const Index> position = system_.factor().position(), order = system_.factor().order();
  const bool one_component = state().sites_of.size() == 1;
  Answer answer(memory());
  for (Index first = 0; first < channels; first += channel_block) {
    const Index count = std::min(channel_block, channels - first);
    const std::size_t m = at(count);
    surface::Workspace z(core_->workspaces, rows * m);
    system_.sweep(values, channels, first, count, answer, z.data());
    for_ranges(*core_->jobs, rows, piece, [&](std::size_t begin, std::size_t end) {
      if (one_component && m == 1) {
        const double shift = answer.constant[0];
        for (std::size_t row = begin; row < end; ++row) z[row] += shift;
        return;
      }
      if (one_component && m == 8) {  // the loop length is known when compiled
        for (std::size_t row = begin; row < end; ++row) {
          for (std::size_t q = 0; q < 8; ++q) z[row * 8 + q] += answer.constant[q];
        }
        return;
      }
      if (one_component && reached(0)) {
        for (std::size_t row = begin; row < end; ++row) {
          for (std::size_t q = 0; q < m; ++q) z[row * m + q] += answer.constant[q];
        }
        return;
      }
      for (std::size_t row = begin; row < end; ++row) {
        if (at(order[row]) >= n) continue;  // its vertex went
        const std::size_t c = one_component ? 0 : at(core_->mesh.component[at(order[row])]);
        for (std::size_t q = 0; q < m; ++q) {
          double& u = z[row * m + q];
          u = reached(c) ? u + answer.constant[c * m + q] : 0.0;
        }
      }
    });
    copy_hard_values(values, channels, first, count, [&](Index v) { return &z[at(position[at(v)]) * m]; });
    sink.take(first, count, z.data(), position.data());
  }
}

void GreenSolver::write_field(const double* z, Index channels, Index first, Index count, const Answer& answer,
                              double* field) const {
  const std::size_t m = at(count), stride = at(channels);
  const Span<const Index> position = system_.factor().position();
  for_ranges(*core_->jobs, at(core_->size()), piece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const std::size_t c = at(core_->mesh.component[v]);
      const bool in_reach = reached(c);
      for (std::size_t q = 0; q < m; ++q)
        field[v * stride + at(first) + q] = in_reach ? z[at(position[v]) * m + q] + answer.constant[c * m + q] : 0.0;
    }
  });
}

void GreenSolver::solve(const double* values, Index channels, double* field, double* flux) const {
  const std::size_t rows = at(core_->unknown_count()), n = at(core_->size()), stride = at(channels);
  Answer answer(memory());
  // The flux of a site that the factor eliminates comes from the field. A refinement step starts from the field too.
  const bool needs_field = flux && !field && (state().base || is_refined());
  surface::Workspace own(core_->workspaces, needs_field ? n * stride : 0);
  if (needs_field) field = own.data();
  for (Index first = 0; first < channels; first += channel_block) {
    const Index count = std::min(channel_block, channels - first);
    const std::size_t m = at(count);
    const auto write_flux = [&] {
      for (std::size_t slot = 0; flux && slot < state().entries.size(); ++slot)
        std::copy_n(answer.slot.data() + slot * m, m, flux + slot * stride + at(first));
    };
    surface::Workspace z(core_->workspaces, field ? rows * m : 0);
    if (!field) {
      system_.find_centres(values, channels, first, count, answer);
      system_.solve_dense(values, channels, first, count, nullptr, answer);
      write_flux();
      continue;
    }
    system_.sweep(values, channels, first, count, answer, z.data());
    write_flux();
    write_field(z.data(), channels, first, count, answer, field);
    copy_hard_values(values, channels, first, count, [&](Index v) { return field + at(v) * stride + at(first); });
    if (!is_refined()) continue;
    refine_until_small(values, channels, first, count, z.data(), answer, field);
    write_flux();
  }
  if (field && state().base && flux) base_flux(channels, field, flux);
}

// Computes the flux of each eliminated site e: lambda_e = (K u)_e - (W lambda)_e.
void GreenSolver::base_flux(Index channels, const double* field, double* flux) const {
  const std::size_t m = at(channels);
  const SymmetricMatrix& k = core_->matrix();
  Vector<Index> slot_of_base(state().freed.size(), -1, &memory());
  for (std::size_t slot = 0; slot < state().entries.size(); ++slot) {
    const auto& entry = state().entries[slot];
    if (!entry.used() || entry.eliminated < 0) continue;
    slot_of_base[at(entry.eliminated)] = static_cast<Index>(slot);
    const std::size_t e = at(entry.site.vertex[0]);
    std::fill_n(flux + slot * m, m, 0.0);
    for (Index i = k.column_start[e]; i < k.column_start[e + 1]; ++i) {
      for (std::size_t q = 0; q < m; ++q)
        flux[slot * m + q] += k.value[at(i)] * (field[at(k.row[at(i)]) * m + q] - field[e * m + q]);
    }
  }
  for (std::size_t slot = 0; slot < state().entries.size(); ++slot) {
    const auto& entry = state().entries[slot];
    if (!entry.used() || entry.eliminated >= 0) continue;
    for (int c = 0; c < 3; ++c) {
      if (entry.site.vertex[c] < 0 || !state().base->eliminated(entry.site.vertex[c])) continue;
      const Index there = slot_of_base[at(state().base->index_of[at(entry.site.vertex[c])])];
      for (std::size_t q = 0; there >= 0 && q < m; ++q)
        flux[at(there) * m + q] -= entry.site.weight[c] * flux[slot * m + q];
    }
  }
}

void GreenSolver::solve_at(const double* values, Index channels, Span<const Index> vertices, double* out) const {
  const std::size_t n = at(core_->size()), stride = at(channels);
  if (state().base || is_refined()) {
    // Sites that the factor eliminates affect every vertex, and so do residuals. Such fields need a sweep over the
    // whole mesh.
    surface::Workspace field(core_->workspaces, n * stride);
    solve(values, channels, field.data(), nullptr);
    for (std::size_t i = 0; i < vertices.size(); ++i)
      std::copy_n(field.data() + at(vertices[i]) * stride, stride, out + i * stride);
    return;
  }
  const Span<const Index> position = core_->factor->position();
  Answer answer(memory());
  for (Index first = 0; first < channels; first += channel_block) {
    const Index count = std::min(channel_block, channels - first);
    const std::size_t m = at(count);
    system_.find_centres(values, channels, first, count, answer);
    system_.solve_dense(values, channels, first, count, nullptr, answer);
    surface::Workspace z(core_->zeroed_workspaces, at(core_->unknown_count()) * m);
    z.soil();
    system_.combine(answer, count, z.data());
    core_->factor->backward_at(vertices, z.data(), count);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const std::size_t c = at(core_->mesh.component[at(vertices[i])]);
      const double* y = z.data() + at(position[at(vertices[i])]) * m;
      for (std::size_t q = 0; q < m; ++q)
        out[i * stride + at(first) + q] = reached(c) ? y[q] + answer.constant[c * m + q] : 0.0;
    }
    core_->factor->clear_at(vertices, z.data(), count);
    for (const auto& group : state().groups) core_->factor->clear(*group.paths, count, z.data());
    z.clean();
  }
  // Hard sites among the requested vertices get their values exactly.
  Vector<std::pair<Index, std::size_t>> asked(&memory());
  for (std::size_t i = 0; i < vertices.size(); ++i) asked.push_back({vertices[i], i});
  std::sort(asked.begin(), asked.end());
  for (std::size_t slot = 0; slot < state().entries.size(); ++slot) {
    const auto& entry = state().entries[slot];
    if (!entry.used() || !entry.site.is_hard_vertex()) continue;
    const Index v = entry.site.vertex[0];
    for (auto it = std::lower_bound(asked.begin(), asked.end(), std::make_pair(v, std::size_t{0}));
         it != asked.end() && it->first == v; ++it) {
      std::copy_n(values + slot * stride, channels, out + it->second * stride);
    }
  }
}

}  // namespace hf_inner::solve

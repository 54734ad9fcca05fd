#include "base/index.h"
#include "engine/green_right.h"

#include <algorithm>
#include <cmath>

namespace hf_inner {
namespace {

constexpr std::size_t piece = 16384;  // rows a job takes

}  // namespace

GreenSolver::GreenSolver(std::shared_ptr<const Core> core)
    : core_(std::move(core)), state_(core_->mesh.component_count(), *core_->memory) {}

GreenSolver::GreenSolver(const GreenSolver& other)
    : core_(other.core_),
      state_(other.state_, *other.core_->memory),
      path_solves_(other.path_solves_.load()),
      sweeps_(other.sweeps_.load()),
      rebases_(other.rebases_.load()),
      dense_edits_(other.dense_edits_.load()),
      cloned_at_(other.counts()) {}

void GreenSolver::State::swap(State& other) noexcept {
  entries.swap(other.entries), base.swap(other.base), freed.swap(other.freed), groups.swap(other.groups),
      blocks.swap(other.blocks), sites_of.swap(other.sites_of);
  std::swap(rows, other.rows), std::swap(decision, other.decision);
}

EngineCounters GreenSolver::counters() const noexcept {
  EngineCounters counters;
  counters.factorisations = 1 + rebases_;  // that of the core, and those of rebases
  counters.path_solves = path_solves_, counters.sweeps = sweeps_;
  for (const Group& group : state_.groups) counters.bytes += group.paths->bytes();
  for (const auto& block : state_.blocks) counters.bytes += block ? block->bytes() : 0.0;
  counters.rebase_advised = counters.bytes > core_->factor->statistics().bytes;
  counters.rebases = rebases_, counters.dense_edits = dense_edits_;
  counters.dense_rows = static_cast<std::uint32_t>(state_.rows);
  for (const Entry& entry : state_.entries) counters.eliminated += entry.used() && entry.eliminated >= 0;
  counters.last_route = state_.decision.route;
  counters.dense_ms = state_.decision.dense_ms, counters.rebase_ms = state_.decision.rebase_ms;
  if (state_.base) counters.bytes += state_.base->factor->statistics().bytes;
  return counters;
}

void GreenSolver::succeed(const SiteSolver& predecessor) noexcept {
  const Counts now = static_cast<const GreenSolver&>(predecessor).counts();
  path_solves_ += now.paths - cloned_at_.paths, sweeps_ += now.sweeps - cloned_at_.sweeps;
  rebases_ += now.rebases - cloned_at_.rebases, dense_edits_ += now.dense_edits - cloned_at_.dense_edits;
}

// z <- g = G^-1 P (-K_FE s_E), centred values.
void GreenSolver::base_forward(const double* values, Index channels, Index first, Index count,
                               const Vector<double>& centre, double* z) const {
  const std::size_t m = at(count);
  const SymmetricMatrix& k = core_->laplacian;
  const Span<const Index> position = factor(state_).position();
  for (std::size_t slot = 0; slot < state_.entries.size(); ++slot) {
    const Entry& entry = state_.entries[slot];
    if (!entry.used() || entry.eliminated < 0) continue;
    const Index e = entry.site.vertex[0];
    const double* c = centre.data() + at(entry.site.component) * m;
    for (Index i = k.column_start[at(e)]; i < k.column_start[at(e) + 1]; ++i) {
      const Index v = k.row[at(i)];
      if (state_.base->eliminated(v)) continue;
      for (std::size_t q = 0; q < m; ++q)
        z[at(position[at(v)]) * m + q] -= k.value[at(i)] * (values[slot * at(channels) + at(first) + q] - c[q]);
    }
  }
  state_.base->factor->forward(z, count, *core_->jobs);
  ++sweeps_;
}

void GreenSolver::solve_dense(const double* values, Index channels, Index first, Index count, const double* z,
                              Right& right) const {
  const std::size_t m = at(count), stride = at(channels);
  const EliminatedBase* base = state_.base.get();
  right.slot.assign(state_.entries.size() * m, 0.0);
  right.freed.assign(state_.freed.size() * m, 0.0);
  right.constant.assign(right.centre.begin(), right.centre.end());
  const auto centred = [&](std::size_t slot, std::size_t q) {
    return values[slot * stride + at(first) + q] - right.centre[at(state_.entries[slot].site.component) * m + q];
  };

  // right-hand side: s of the sites, less what the eliminated sites do to their rows
  Vector<Index> slot_of_base(state_.freed.size(), -1, &memory());
  for (std::size_t slot = 0; slot < state_.entries.size(); ++slot) {
    const Entry& entry = state_.entries[slot];
    if (!entry.used()) continue;
    if (entry.eliminated >= 0) {
      slot_of_base[at(entry.eliminated)] = static_cast<Index>(slot);
    } else {
      for (std::size_t q = 0; q < m; ++q) right.slot[slot * m + q] = centred(slot, q);
    }
  }
  if (base) {
    subtract_projections(z, count, right);
    const auto value_at = [&](Index v) { return base->eliminated(v) ? slot_of_base[at(base->index_of[at(v)])] : -1; };
    for (std::size_t slot = 0; slot < state_.entries.size(); ++slot) {
      const Entry& entry = state_.entries[slot];
      if (!entry.used() || entry.eliminated >= 0) continue;
      for (int c = 0; c < 3; ++c) {
        const Index there = entry.site.vertex[c] < 0 ? -1 : value_at(entry.site.vertex[c]);
        for (std::size_t q = 0; there >= 0 && q < m; ++q)
          right.slot[slot * m + q] -= entry.site.weight[c] * centred(at(there), q);
      }
    }
    const SymmetricMatrix& k = core_->laplacian;
    for (std::size_t b = 0; b < state_.freed.size(); ++b) {
      if (state_.freed[b].path.group < 0) continue;
      const Index r = base->vertex[b];
      for (Index i = k.column_start[at(r)]; i < k.column_start[at(r) + 1]; ++i) {
        const Index there = value_at(k.row[at(i)]);
        for (std::size_t q = 0; there >= 0 && q < m; ++q)
          right.freed[b * m + q] += k.value[at(i)] * centred(at(there), q);
      }
    }
  }

  solve_rows(count, right);
}

// right -= Y'z, row by row.
void GreenSolver::subtract_projections(const double* z, Index count, Right& right) const {
  const std::size_t m = at(count);
  right.probe.resize(PathGroup::capacity * m);
  for (const Group& group : state_.groups) {
    if (group.live == 0) continue;
    factor(state_).project(*group.paths, z, count, right.probe.data());
    for (Index i = 0; i < group.paths->count(); ++i) {
      if (group.row[i] == nobody) continue;
      for (std::size_t q = 0; q < m; ++q) right.of(group.row[i], m)[q] -= right.probe[at(i) * m + q];
    }
  }
}

// right <- lambda, t and, added to the constants, a.
void GreenSolver::solve_rows(Index count, Right& right) const {
  const std::size_t m = at(count);
  for (std::size_t c = 0; c < state_.blocks.size(); ++c) {
    const DenseBlock* block = state_.blocks[c].get();
    if (!block) continue;
    const Span<const Index> rows = block->ids();
    right.x.resize(rows.size() * m);
    for (std::size_t i = 0; i < rows.size(); ++i) std::copy_n(right.of(rows[i], m), m, right.x.data() + i * m);
    block->solve(right.x.data(), count);
    for (std::size_t q = 0; q < m; ++q) {
      double shift = 0;
      if (floating(state_, c)) {
        if (!right.total.empty()) shift = right.total[c * m + q];
        for (std::size_t i = 0; i < rows.size(); ++i) shift += right.x[i * m + q];
        shift /= block->ones_sum();
        for (std::size_t i = 0; i < rows.size(); ++i) right.x[i * m + q] -= shift * block->ones()[i];
      }
      right.constant[c * m + q] += shift;
    }
    for (std::size_t i = 0; i < rows.size(); ++i) std::copy_n(right.x.data() + i * m, m, right.of(rows[i], m));
  }
}

void GreenSolver::combine(const Right& right, Index count, double* z) const {
  double own[PathGroup::capacity * channel_block];
  const std::size_t m = at(count);
  for (const Group& group : state_.groups) {
    if (group.live == 0) continue;
    for (Index i = 0; i < group.paths->count(); ++i) {
      if (group.row[i] == nobody) {
        std::fill_n(own + at(i) * m, m, 0.0);
      } else {
        std::copy_n(right.of(group.row[i], m), m, own + at(i) * m);
      }
    }
    factor(state_).combine(*group.paths, own, count, z);
  }
}

namespace {

// Mean site value of every component.
template <class Entries>
void find_centres(const Entries& entries, const Vector<Index>& sites_of, const double* values, Index channels,
                  Index first, Index count, Vector<double>& centre) {
  const std::size_t m = at(count);
  centre.assign(sites_of.size() * m, 0.0);
  for (std::size_t slot = 0; slot < entries.size(); ++slot) {
    if (!entries[slot].used()) continue;
    const std::size_t c = at(entries[slot].site.component);
    for (std::size_t q = 0; q < m; ++q)
      centre[c * m + q] += values[slot * at(channels) + at(first) + q] / static_cast<double>(sites_of[c]);
  }
}

}  // namespace

// z <- G^-T (g + Y_w lambda + Y_r t) for channels [first, first + count), and the rest of the answer in `right`.
void GreenSolver::sweep(const double* values, Index channels, Index first, Index count, Right& right,
                        double* z) const {
  const std::size_t size = at(core_->size()) * at(count);
  find_centres(state_.entries, state_.sites_of, values, channels, first, count, right.centre);
  core_->jobs->for_each(static_cast<std::uint32_t>((size + piece - 1) / piece), [&](std::uint32_t p) {
    std::fill(z + p * piece, z + std::min(size, (p + std::size_t{1}) * piece), 0.0);
  });
  if (state_.base) base_forward(values, channels, first, count, right.centre, z);
  solve_dense(values, channels, first, count, z, right);
  combine(right, count, z);
  factor(state_).backward(z, count, *core_->jobs);
  ++sweeps_;
}

// Points so crowded that the dense solve may leave fewer than ten digits get one step too.
GreenSolver::Index GreenSolver::refinements() const noexcept {
  constexpr double crowded = 1e-4;
  if (core_->refinements > 0) return core_->refinements;
  for (const auto& block : state_.blocks) {
    if (block && block->least_pivot() < crowded) return 1;
  }
  return 0;
}

void GreenSolver::solve_into(const double* values, Index channels, FieldSink& sink) const {
  const std::size_t n = at(core_->size()), stride = at(channels);
  if (state_.base || refinements() > 0) return solve_copied(*this, *core_, values, channels, sink);
  const Span<const Index> position = core_->factor->position(), order = core_->factor->order();
  const bool one_component = state_.sites_of.size() == 1;
  Right right(memory());
  for (Index first = 0; first < channels; first += channel_block) {
    const Index count = std::min(channel_block, channels - first);
    const std::size_t m = at(count);
    Workspace z(core_->workspaces, n * m);
    sweep(values, channels, first, count, right, z.data());
    core_->jobs->for_each(static_cast<std::uint32_t>((n + piece - 1) / piece), [&](std::uint32_t p) {
      const std::size_t begin = p * piece, end = std::min(n, begin + piece);
      if (one_component && m == 1) {
        const double shift = right.constant[0];
        for (std::size_t row = begin; row < end; ++row) z[row] += shift;
        return;
      }
      if (one_component && m == 8) {  // of a size known when compiled
        for (std::size_t row = begin; row < end; ++row) {
          for (std::size_t q = 0; q < 8; ++q) z[row * 8 + q] += right.constant[q];
        }
        return;
      }
      for (std::size_t row = begin; row < end; ++row) {
        const std::size_t c = one_component ? 0 : at(core_->mesh.component[at(order[row])]);
        for (std::size_t q = 0; q < m; ++q) {
          double& u = z[row * m + q];
          u = state_.sites_of[c] > 0 ? u + right.constant[c * m + q] : 0.0;
        }
      }
    });
    for (std::size_t slot = 0; slot < state_.entries.size(); ++slot) {
      const Entry& entry = state_.entries[slot];
      if (!entry.used() || !entry.site.is_vertex() || entry.site.compliance != 0) continue;
      std::copy_n(values + slot * stride + at(first), m, &z[at(position[at(entry.site.vertex[0])]) * m]);
    }
    sink.take(first, count, z.data(), position.data());
  }
}

void GreenSolver::solve(const double* values, Index channels, double* field, double* flux) const {
  const std::size_t n = at(core_->size()), stride = at(channels);
  Right right(memory());
  // the flux of an eliminated site is read off the field, and a refinement starts from it
  const bool needs_field = flux && !field && (state_.base || refinements() > 0);
  Workspace own(core_->workspaces, needs_field ? n * stride : 0);
  if (needs_field) field = own.data();
  for (Index first = 0; first < channels; first += channel_block) {
    const Index count = std::min(channel_block, channels - first);
    const std::size_t m = at(count);
    Workspace z(core_->workspaces, field ? n * m : 0);
    if (field) {
      sweep(values, channels, first, count, right, z.data());
    } else {
      find_centres(state_.entries, state_.sites_of, values, channels, first, count, right.centre);
      solve_dense(values, channels, first, count, nullptr, right);
    }
    const auto write_flux = [&] {
      for (std::size_t slot = 0; flux && slot < state_.entries.size(); ++slot)
        std::copy_n(right.slot.data() + slot * m, m, flux + slot * stride + at(first));
    };
    write_flux();
    if (!field) continue;

    const Span<const Index> position = core_->factor->position();
    core_->jobs->for_each(static_cast<std::uint32_t>((n + piece - 1) / piece), [&](std::uint32_t p) {
      const std::size_t end = std::min(n, (p + std::size_t{1}) * piece);
      for (std::size_t v = p * piece; v < end; ++v) {
        const std::size_t c = at(core_->mesh.component[v]);
        const bool reached = state_.sites_of[c] > 0;
        for (std::size_t q = 0; q < m; ++q)
          field[v * stride + at(first) + q] = reached ? z[at(position[v]) * m + q] + right.constant[c * m + q] : 0.0;
      }
    });
    for (std::size_t b = 0; b < state_.freed.size(); ++b) {
      if (state_.freed[b].path.group < 0) continue;
      const std::size_t v = at(state_.base->vertex[b]), c = at(core_->mesh.component[v]);
      for (std::size_t q = 0; q < m; ++q)
        field[v * stride + at(first) + q] = right.freed[b * m + q] + right.constant[c * m + q];
    }
    for (std::size_t slot = 0; slot < state_.entries.size(); ++slot) {
      const Entry& entry = state_.entries[slot];
      if (!entry.used() || !entry.site.is_vertex() || entry.site.compliance != 0) continue;
      std::copy_n(values + slot * stride + at(first), m, field + at(entry.site.vertex[0]) * stride + at(first));
    }
    for (Index step = 0; step < refinements(); ++step) {
      refine(values, channels, first, count, z.data(), right, field);
      write_flux();
    }
  }
  if (!field) return;
  if (state_.base && flux) base_flux(values, channels, field, flux);
}

// lambda_e = (K u)_e - (W lambda)_e of the eliminated sites.
void GreenSolver::base_flux(const double*, Index channels, const double* field, double* flux) const {
  const std::size_t m = at(channels);
  const SymmetricMatrix& k = core_->laplacian;
  Vector<Index> slot_of_base(state_.freed.size(), -1, &memory());
  for (std::size_t slot = 0; slot < state_.entries.size(); ++slot) {
    const Entry& entry = state_.entries[slot];
    if (!entry.used() || entry.eliminated < 0) continue;
    slot_of_base[at(entry.eliminated)] = static_cast<Index>(slot);
    const std::size_t e = at(entry.site.vertex[0]);
    std::fill_n(flux + slot * m, m, 0.0);
    for (Index i = k.column_start[e]; i < k.column_start[e + 1]; ++i) {
      for (std::size_t q = 0; q < m; ++q)
        flux[slot * m + q] += k.value[at(i)] * (field[at(k.row[at(i)]) * m + q] - field[e * m + q]);
    }
  }
  for (std::size_t slot = 0; slot < state_.entries.size(); ++slot) {
    const Entry& entry = state_.entries[slot];
    if (!entry.used() || entry.eliminated >= 0) continue;
    for (int c = 0; c < 3; ++c) {
      if (entry.site.vertex[c] < 0 || !state_.base->eliminated(entry.site.vertex[c])) continue;
      const Index there = slot_of_base[at(state_.base->index_of[at(entry.site.vertex[c])])];
      for (std::size_t q = 0; there >= 0 && q < m; ++q)
        flux[at(there) * m + q] -= entry.site.weight[c] * flux[slot * m + q];
    }
  }
}

void GreenSolver::solve_at(const double* values, Index channels, Span<const Index> vertices, double* out) const {
  const std::size_t n = at(core_->size()), stride = at(channels);
  if (state_.base || refinements() > 0) {
    // the eliminated sites reach everything, and so does a residual: their part needs a sweep over the mesh
    Workspace field(core_->workspaces, n * stride);
    solve(values, channels, field.data(), nullptr);
    for (std::size_t i = 0; i < vertices.size(); ++i)
      std::copy_n(field.data() + at(vertices[i]) * stride, stride, out + i * stride);
    return;
  }
  const Span<const Index> position = core_->factor->position();
  Right right(memory());
  for (Index first = 0; first < channels; first += channel_block) {
    const Index count = std::min(channel_block, channels - first);
    const std::size_t m = at(count);
    find_centres(state_.entries, state_.sites_of, values, channels, first, count, right.centre);
    solve_dense(values, channels, first, count, nullptr, right);
    Workspace z(core_->zeroed_workspaces, n * m);
    z.soil();
    combine(right, count, z.data());
    core_->factor->backward_at(vertices, z.data(), count);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const std::size_t c = at(core_->mesh.component[at(vertices[i])]);
      const double* y = z.data() + at(position[at(vertices[i])]) * m;
      for (std::size_t q = 0; q < m; ++q)
        out[i * stride + at(first) + q] = state_.sites_of[c] > 0 ? y[q] + right.constant[c * m + q] : 0.0;
    }
    core_->factor->clear_at(vertices, z.data(), count);
    for (const Group& used : state_.groups) core_->factor->clear(*used.paths, count, z.data());
    z.clean();
  }
  // hard sites among the vertices hold their values
  Vector<std::pair<Index, std::size_t>> asked(&memory());
  for (std::size_t i = 0; i < vertices.size(); ++i) asked.push_back({vertices[i], i});
  std::sort(asked.begin(), asked.end());
  for (std::size_t slot = 0; slot < state_.entries.size(); ++slot) {
    const Entry& entry = state_.entries[slot];
    if (!entry.used() || !entry.site.is_vertex() || entry.site.compliance != 0) continue;
    const Index v = entry.site.vertex[0];
    for (auto it = std::lower_bound(asked.begin(), asked.end(), std::make_pair(v, std::size_t{0}));
         it != asked.end() && it->first == v; ++it) {
      std::copy_n(values + slot * stride, channels, out + it->second * stride);
    }
  }
}

}  // namespace hf_inner

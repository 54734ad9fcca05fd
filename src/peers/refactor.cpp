#include "peers/refactor.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/index.h"
#include "peers/intake.h"
#include "solve/corrections.h"
#include "solve/dependence.h"

namespace hf_inner::peers {
RefactorSolver::RefactorSolver(std::shared_ptr<const surface::Core> core)
    : core_(std::move(core)), state_(*core_->memory) {
  require_formed(*core_);
  state_.count.assign(at(core_->mesh.component_count()), 0);
  state_.factor = core_->factor;
}

RefactorSolver::RefactorSolver(const RefactorSolver& other)
    : core_(other.core_),
      state_(other.state_, *other.core_->memory),
      factorisations_(other.factorisations_.load()),
      sweeps_(other.sweeps_.load()) {}

solve::EngineCounters RefactorSolver::counters() const noexcept {
  solve::EngineCounters counters;
  counters.factorisations = factorisations_;
  counters.sweeps = sweeps_;
  counters.bytes = state_.factor == core_->factor ? 0.0 : state_.factor->statistics().bytes;
  return counters;
}

void RefactorSolver::edit(const solve::SiteEdit& edit) {
  State next(state_, *core_->memory);
  for (const Index slot : edit.remove) {
    --next.count[at(next.sites[at(slot)].component)];
    next.sites[at(slot)] = solve::Site{};
  }
  for (std::size_t i = 0; i < edit.add.size(); ++i) {
    if (next.sites.size() <= at(edit.add[i])) next.sites.resize(at(edit.add[i]) + 1);
    next.sites[at(edit.add[i])] = edit.sites[i];
    ++next.count[at(edit.sites[i].component)];
  }
  factorise(next);
  ++factorisations_;
  std::swap(state_.sites, next.sites);
  std::swap(state_.count, next.count);
  std::swap(state_.floating, next.floating);
  std::swap(state_.points, next.points);
  std::swap(state_.dense, next.dense);
  std::swap(state_.factor, next.factor);
  std::swap(state_.path, next.path);
}

// Returns true if a hard site depends linearly on others although no pivot failed. Rounding can keep such a pivot
// positive.
bool RefactorSolver::crowded_out(const State& state, const solve::DenseBlock& block) const {
  if (block.least_pivot() >= solve::suspect_share) return false;
  Vector<solve::HardSite> sites(core_->memory.get());
  Vector<std::uint8_t> suspect(state.sites.size(), 0, core_->memory.get());
  for (Index i = 0; i < block.count(); ++i) {
    if (block.pivot_share(i) < solve::suspect_share) suspect[at(state.points[at(block.ids()[at(i)])])] = 1;
  }
  for (std::size_t slot = 0; slot < state.sites.size(); ++slot) {
    const solve::Site& site = state.sites[slot];
    if (site.component >= 0 && site.compliance == 0)
      sites.push_back({&site, static_cast<Index>(slot), suspect[slot] != 0});
  }
  return solve::dependent_site({sites.data(), sites.size()}, *core_->memory) >= 0;
}

void RefactorSolver::factorise(State& state) const {
  Memory& memory = *core_->memory;
  const std::size_t n = at(core_->size());
  SymmetricMatrix a(memory);
  a.column_start.assign(core_->matrix().column_start.begin(), core_->matrix().column_start.end());
  a.row.assign(core_->matrix().row.begin(), core_->matrix().row.end());
  a.value.assign(core_->matrix().value.begin(), core_->matrix().value.end());
  Vector<std::uint8_t> eliminated(n, 0, &memory);
  state.floating.assign(state.count.size(), 1);
  state.points.clear();
  for (std::size_t slot = 0; slot < state.sites.size(); ++slot) {
    const solve::Site& site = state.sites[slot];
    if (site.component < 0) continue;
    if (!site.is_vertex()) {
      state.points.push_back(static_cast<Index>(slot));
      continue;
    }
    state.floating[at(site.component)] = 0;
    if (site.compliance == 0) {
      eliminated[at(site.vertex[0])] = 1;
    } else {
      a.value[a.diagonal(site.vertex[0])] += core_->mean_diagonal[at(site.component)] / site.compliance;
    }
  }
  for (std::size_t c = 0; c < state.floating.size(); ++c) {
    if (state.floating[c]) a.value[a.diagonal(core_->ground[c])] += core_->mean_diagonal[c];
  }
  state.factor = core_->factor->refactor(a, eliminated, memory, *core_->jobs);

  // Computes the dense system of the point sites: the columns of A^-1 W_p, with A the factorised matrix and W_p the
  // weights of these sites. Eliminated rows are zero.
  state.dense.assign(state.count.size(), nullptr);
  state.path.reset();
  if (state.points.empty()) return;
  const auto path = make_shared_in<Vector<double>>(memory, state.points.size() * n, 0.0);
  Vector<std::shared_ptr<solve::DenseBlock>> open(state.count.size(), &memory);
  Vector<double> row(&memory);
  for (std::size_t i = 0; i < state.points.size(); ++i) {
    const solve::Site& site = state.sites[at(state.points[i])];
    double* x = path->data() + i * n;
    for (int k = 0; k < 3; ++k) {
      if (site.vertex[k] >= 0 && !eliminated[at(site.vertex[k])])
        x[at(core_->factor->position()[at(site.vertex[k])])] += site.weight[k];
    }
    state.factor->solve_in_order(x, 1, *core_->jobs);
    auto& block = open[at(site.component)];
    if (!block)
      block = make_shared_in<solve::DenseBlock>(memory, memory, std::size_t{state.floating[at(site.component)]});
    row.clear();
    for (std::size_t j = 0; j <= i; ++j) {
      const solve::Site& other = state.sites[at(state.points[j])];
      if (other.component != site.component) continue;
      double s = i == j ? site.compliance / core_->mean_diagonal[at(site.component)] : 0.0;
      for (int k = 0; k < 3; ++k) {
        if (other.vertex[k] >= 0 && !eliminated[at(other.vertex[k])])
          s += other.weight[k] * x[at(core_->factor->position()[at(other.vertex[k])])];
      }
      row.push_back(s);
    }
    block->append(static_cast<Index>(i), row.data());
  }
  for (std::size_t c = 0; c < open.size(); ++c) {
    if (open[c] && (open[c]->factorise(*core_->jobs) >= 0 || crowded_out(state, *open[c])))
      fail(HF_ERROR_CONFLICT, HF_NO_INDEX,
           "points in one triangle depend linearly on each other or on its corners; leave one out or make it soft");
    state.dense[c] = open[c];
  }
  state.path = path;
}

// u <- A^-1 right with the points bordered, both in factor order. points: the residual of each point, overwritten with
// its lambda. constant: by component. total: by component, the sum of the forces; null: 0.
void RefactorSolver::solve_system(const Vector<double>& right, Index channels, double* u, Vector<double>& points,
                                  Vector<double>& constant, const Vector<double>* total) const {
  const std::size_t n = at(core_->size()), m = at(channels);
  const Span<const Index> position = core_->factor->position();
  std::copy(right.begin(), right.end(), u);
  state_.factor->solve_in_order(u, channels, *core_->jobs);
  sweeps_ += 2;
  Vector<double> x(core_->memory.get());
  for (std::size_t component = 0; component < state_.dense.size(); ++component) {
    const solve::DenseBlock* block = state_.dense[component].get();
    if (!block) continue;
    const Span<const Index> members = block->ids();
    x.resize(members.size() * m);
    for (std::size_t i = 0; i < members.size(); ++i) {
      const solve::Site& site = state_.sites[at(state_.points[at(members[i])])];
      for (std::size_t c = 0; c < m; ++c) {
        double value = points[at(members[i]) * m + c];
        for (int q = 0; q < 3; ++q) {
          if (site.vertex[q] >= 0) value -= site.weight[q] * u[at(position[at(site.vertex[q])]) * m + c];
        }
        x[i * m + c] = value;
      }
    }
    // without a vertex site the component is pinned: its block has a border of constants
    block->solve_bordered(x.data(), channels, total ? &(*total)[component * m] : nullptr, &constant[component * m]);
    for (std::size_t i = 0; i < members.size(); ++i) {
      const double* y = state_.path->data() + at(members[i]) * n;
      std::copy_n(&x[i * m], m, &points[at(members[i]) * m]);
      for (std::size_t r = 0; r < n; ++r) {
        for (std::size_t c = 0; c < m; ++c) u[r * m + c] += y[r] * x[i * m + c];
      }
    }
  }
}

// A soft site far stiffer or softer than the mesh hides the numbers of K on its diagonal, and crowded points have small
// pivots.
bool RefactorSolver::loses_digits() const noexcept {
  const bool is_soft = std::any_of(state_.sites.begin(), state_.sites.end(), [](const solve::Site& site) {
    return site.component >= 0 && site.is_vertex() && site.compliance > 0;
  });
  return core_->is_long || is_soft || std::any_of(state_.dense.begin(), state_.dense.end(), [](const auto& block) {
           return block && block->least_pivot() < solve::crowded_share;
         });
}

double RefactorSolver::softness(const solve::Site& site) const noexcept {
  return site.compliance / core_->mean_diagonal[at(site.component)];
}

// lambda of the vertex sites that balances K u - right, less the force of the points there.
void RefactorSolver::write_vertex_flux(const double* u, Index channels, const double* right, const double* missed,
                                       double* flux) const {
  const std::size_t m = at(channels);
  const SymmetricMatrix& k = core_->matrix();
  for (std::size_t slot = 0; slot < state_.sites.size(); ++slot) {
    const solve::Site& site = state_.sites[slot];
    if (site.component < 0 || !site.is_vertex()) continue;
    const std::size_t v = at(site.vertex[0]);
    const double soft = softness(site);
    // K u loses the lambda of a site that is softer than the mesh around it, so that comes from the residual of the
    // site
    const bool is_softer = soft * k.value[k.diagonal(site.vertex[0])] > 1;
    for (std::size_t c = 0; c < m; ++c) {
      if (is_softer) {
        flux[slot * m + c] = (missed[slot * m + c] - u[v * m + c]) / soft;
        continue;
      }
      double sum = right ? -right[v * m + c] : 0.0;
      for (Index i = k.column_start[v]; i < k.column_start[v + 1]; ++i)
        sum += k.value[at(i)] * (u[at(k.row[at(i)]) * m + c] - u[v * m + c]);
      for (const Index p : state_.points) {
        const solve::Site& point = state_.sites[at(p)];
        for (int q = 0; q < 3; ++q) {
          if (point.vertex[q] == site.vertex[0]) sum -= point.weight[q] * flux[at(p) * m + c];
        }
      }
      flux[slot * m + c] = sum;
    }
  }
}

void RefactorSolver::solve(const double* values, Index channels, double* field, double* flux) const {
  Memory& memory = *core_->memory;
  const std::size_t n = at(core_->size()), m = at(channels);
  const Span<const Index> position = core_->factor->position();
  const SymmetricMatrix& k = core_->matrix();
  Vector<std::int8_t> fixed(n, 0, &memory);
  Vector<double> centre(state_.count.size() * m, 0.0, &memory);
  for (std::size_t slot = 0; slot < state_.sites.size(); ++slot) {
    const solve::Site& site = state_.sites[slot];
    if (site.component < 0) continue;
    for (std::size_t c = 0; c < m; ++c)
      centre[at(site.component) * m + c] += values[slot * m + c] / state_.count[at(site.component)];
  }
  const auto centred = [&](std::size_t slot, std::size_t c) {
    return values[slot * m + c] - centre[at(state_.sites[slot].component) * m + c];
  };

  Vector<double> right(n * m, 0.0, &memory), hard(n * m, 0.0, &memory), u(n * m, 0.0, &memory);
  for (std::size_t slot = 0; slot < state_.sites.size(); ++slot) {
    const solve::Site& site = state_.sites[slot];
    if (site.component < 0 || !site.is_vertex()) continue;
    const std::size_t v = at(site.vertex[0]);
    for (std::size_t c = 0; c < m; ++c) {
      if (site.compliance == 0) {
        fixed[v] = 1;
        hard[v * m + c] = centred(slot, c);
      } else {
        right[at(position[v]) * m + c] += core_->mean_diagonal[at(site.component)] / site.compliance * centred(slot, c);
      }
    }
  }
  for (std::size_t v = 0; v < n; ++v) {
    if (!fixed[v]) continue;
    for (Index i = k.column_start[v]; i < k.column_start[v + 1]; ++i) {
      const std::size_t w = at(k.row[at(i)]);
      if (fixed[w]) continue;
      for (std::size_t c = 0; c < m; ++c) right[at(position[w]) * m + c] -= k.value[at(i)] * hard[v * m + c];
    }
    for (std::size_t c = 0; c < m; ++c) right[at(position[v]) * m + c] = hard[v * m + c];
  }
  Vector<double> constant(state_.count.size() * m, 0.0, &memory), lambda(state_.points.size() * m, 0.0, &memory);
  for (std::size_t p = 0; p < state_.points.size(); ++p) {
    for (std::size_t c = 0; c < m; ++c) lambda[p * m + c] = centred(at(state_.points[p]), c);
  }
  solve_system(right, channels, u.data(), lambda, constant, nullptr);

  Vector<double> whole(&memory), own(&memory);
  double* out = field;
  if (!out) {
    whole.resize(n * m);
    out = whole.data();
  }
  for (std::size_t v = 0; v < n; ++v) {
    const std::size_t component = at(core_->mesh.component[v]);
    for (std::size_t c = 0; c < m; ++c) {
      out[v * m + c] = state_.count[component]
                           ? u[at(position[v]) * m + c] + constant[component * m + c] + centre[component * m + c]
                           : 0.0;
    }
  }
  const bool is_refined = loses_digits();
  if (is_refined && !flux) {
    own.resize(state_.sites.size() * m);
    flux = own.data();
  }
  const auto hold = [&] {
    for (std::size_t slot = 0; slot < state_.sites.size(); ++slot) {
      const solve::Site& site = state_.sites[slot];
      if (site.component >= 0 && site.is_hard_vertex()) std::copy_n(values + slot * m, m, out + at(site.vertex[0]) * m);
    }
  };
  if (flux) {
    for (std::size_t i = 0; i < state_.points.size(); ++i)
      std::copy_n(&lambda[i * m], m, flux + at(state_.points[i]) * m);
    write_vertex_flux(out, channels, nullptr, values, flux);
  }
  hold();
  if (!is_refined) return;
  Vector<double> change(n * m, &memory), flux_change(state_.sites.size() * m, &memory);
  Vector<double> range(centre.size(), 0.0, &memory);
  for (std::size_t slot = 0; slot < state_.sites.size(); ++slot) {
    for (std::size_t c = 0; state_.sites[slot].component >= 0 && c < m; ++c) {
      double& widest = range[at(state_.sites[slot].component) * m + c];
      widest = std::max(widest, std::fabs(centred(slot, c)));
    }
  }
  solve::Corrections corrections;
  double largest = 0;
  do {
    correct(values, channels, out, flux, change.data(), flux_change.data());
    largest = 0;
    for (std::size_t i = 0; i < n * m; ++i) {
      out[i] += change[i];
      const double widest = range[at(core_->mesh.component[i / m]) * m + i % m];
      if (widest > 0) largest = std::max(largest, std::fabs(change[i]) / widest);
    }
    for (std::size_t i = 0; i < flux_change.size(); ++i) flux[i] += flux_change[i];
    hold();
  } while (corrections.go_on(largest));
}

// right = W lambda - K u, and the residual of the sites: K du - W dlambda = right, w'du + D dlambda = missed.
bool RefactorSolver::correct(const double* values, Index channels, const double* field, const double* flux,
                             double* change, double* flux_change) const {
  Memory& memory = *core_->memory;
  const std::size_t n = at(core_->size()), m = at(channels);
  const Span<const Index> position = core_->factor->position();
  const SymmetricMatrix& k = core_->matrix();
  Vector<double> right(n * m, 0.0, &memory), missed(state_.sites.size() * m, 0.0, &memory), u(n * m, 0.0, &memory);
  for (std::size_t v = 0; v < n; ++v) {
    if (!state_.count[at(core_->mesh.component[v])]) continue;
    for (Index i = k.column_start[v]; i < k.column_start[v + 1]; ++i) {
      for (std::size_t c = 0; c < m; ++c)
        right[v * m + c] -= k.value[at(i)] * (field[at(k.row[at(i)]) * m + c] - field[v * m + c]);
    }
  }
  for (std::size_t slot = 0; slot < state_.sites.size(); ++slot) {
    const solve::Site& site = state_.sites[slot];
    for (std::size_t c = 0; site.component >= 0 && c < m; ++c) {
      double& g = missed[slot * m + c];
      g = values[slot * m + c];
      for (int q = 0; q < 3; ++q) {
        if (site.vertex[q] < 0) continue;
        g -= site.weight[q] * field[at(site.vertex[q]) * m + c];
        right[at(site.vertex[q]) * m + c] += site.weight[q] * flux[slot * m + c];
      }
      g = site.is_hard_vertex() ? 0.0 : g - softness(site) * flux[slot * m + c];
    }
  }
  Vector<double> force(n * m, &memory), total(state_.count.size() * m, 0.0, &memory);
  for (std::size_t v = 0; v < n; ++v) {
    std::copy_n(&right[v * m], m, &force[at(position[v]) * m]);
    for (std::size_t c = 0; c < m; ++c) total[at(core_->mesh.component[v]) * m + c] += right[v * m + c];
  }
  for (std::size_t slot = 0; slot < state_.sites.size(); ++slot) {
    const solve::Site& site = state_.sites[slot];
    for (std::size_t c = 0; site.component >= 0 && site.is_vertex() && c < m; ++c) {
      double& f = force[at(position[at(site.vertex[0])]) * m + c];
      f = site.compliance == 0 ? 0.0 : f + missed[slot * m + c] / softness(site);
    }
  }
  Vector<double> constant(state_.count.size() * m, 0.0, &memory), lambda(state_.points.size() * m, 0.0, &memory);
  for (std::size_t p = 0; p < state_.points.size(); ++p)
    std::copy_n(&missed[at(state_.points[p]) * m], m, &lambda[p * m]);
  solve_system(force, channels, u.data(), lambda, constant, &total);
  for (std::size_t v = 0; v < n; ++v) {
    const std::size_t component = at(core_->mesh.component[v]);
    for (std::size_t c = 0; c < m; ++c)
      change[v * m + c] = state_.count[component] ? u[at(position[v]) * m + c] + constant[component * m + c] : 0.0;
  }
  std::fill_n(flux_change, missed.size(), 0.0);
  for (std::size_t p = 0; p < state_.points.size(); ++p)
    std::copy_n(&lambda[p * m], m, flux_change + at(state_.points[p]) * m);
  write_vertex_flux(change, channels, right.data(), missed.data(), flux_change);
  return true;
}

void RefactorSolver::solve_at(const double* values, Index channels, Span<const Index> vertices, double* out) const {
  // This engine cannot solve at single vertices, so it solves the whole field.
  Vector<double> field(at(core_->size()) * at(channels), core_->memory.get());
  solve(values, channels, field.data(), nullptr);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    std::copy_n(field.data() + at(vertices[i]) * at(channels), channels, out + i * at(channels));
}

}  // namespace hf_inner::peers

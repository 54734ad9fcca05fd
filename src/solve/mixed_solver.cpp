#include "solve/mixed_solver.h"

#include <algorithm>
#include <cmath>

#include "base/index.h"
#include "base/progress.h"

namespace hf_inner::solve {
namespace {

constexpr std::size_t rows_piece = 16384;  // vertices of one thread's job: the figures of green.cpp hold
// Conjugate gradients end when the residual has fallen by this factor, and a correction of the field does the rest.
// Chosen on a torus of 50,000 vertices with a hub: 1e-7 saves an eighth of the sweeps and leaves 8e-12 of the range,
// 1e-8 leaves 1e-13.
constexpr double gradient_share = 1e-8;
// The crowded share of the inner engine (green.h). Corrections of the whole field make up for the digits it loses. At
// 1e-4, a step takes four sweeps instead of two with 1,000 sites on 50,000 vertices.
constexpr double inner_crowded_share = 1e-8;
// Steps of conjugate gradients. Sets of 7 to 8,000 sites took about 100 at most; a damaged factor uses them all.
constexpr int most_gradient_steps = 300;
// Lumped masses of the preconditioner count as at least this, the least mass of a vertex. Obtuse triangles can make
// them smaller, even negative. Half and double pass the 16 tests of this solver.
constexpr double least_lumped = 1e-4;

}  // namespace

// The arrays of a solve that are as large as the mesh, and the preconditioner.
struct MixedSolver::Block {
  Block(const surface::Core& core, std::size_t slots, Index count)
      : channels(count),
        m(at(count)),
        size(slots * at(count)),
        v(core.workspaces, at(core.size()) * at(count)),
        load(core.workspaces, at(core.size()) * at(count)),
        scale(slots, 1.0, core.memory.get()) {}
  Index channels;
  std::size_t m, size;  // size: of an array by slot and channel
  surface::Workspace v, load;
  Vector<double> scale;  // by slot: the lumped mass matrix
};

MixedSolver::MixedSolver(std::shared_ptr<const surface::Core> core)
    : core_(std::move(core)), inner_(core_->root, inner_crowded_share), sites_(core_->memory.get()) {}

MixedSolver::MixedSolver(const MixedSolver& other)
    : core_(other.core_), inner_(other.inner_), sites_(other.sites_, other.core_->memory.get()) {}

void MixedSolver::edit(const SiteEdit& edit) {
  Vector<Site> next(sites_, &memory()), inner(edit.sites.begin(), edit.sites.end(), &memory());
  for (const Index slot : edit.remove) next[at(slot)] = Site{};
  for (std::size_t i = 0; i < edit.add.size(); ++i) {
    if (next.size() <= at(edit.add[i])) next.resize(at(edit.add[i]) + 1);
    next[at(edit.add[i])] = edit.sites[i];
    Site& site = inner[i];
    site.compliance = std::sqrt(softness(site)) * core_->root->mean_diagonal[at(site.component)];
  }
  inner_.edit({edit.remove, edit.add, inner});
  sites_.swap(next);
}

void MixedSolver::multiply_mass(double* field, std::size_t channels) const {
  if (core_->inverse_mass.empty()) return;
  for_ranges(*core_->jobs, at(core_->size()), rows_piece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      for (std::size_t q = 0; q < channels; ++q) field[v * channels + q] /= core_->inverse_mass[v];
    }
  });
}

// The lumped mass matrix H'M 1 of the sites: minus the fluxes that the masses cause as a load.
void MixedSolver::find_scale(Block& block) const {
  std::fill_n(block.v.data(), at(core_->size()), 1.0);
  multiply_mass(block.v.data(), 1);
  Vector<double> flux(block.scale.size(), 0.0, &memory());
  inner_.respond(block.v.data(), nullptr, 1, nullptr, flux.data());
  each_site([&](std::size_t slot, const Site& site) {
    block.scale[slot] = std::max(std::fabs(flux[slot]), least_lumped) + (site.compliance > 0 ? 1.0 : 0.0);
  });
}

// Solves (H'M H + T D T) values = residual by conjugate gradients, for every component and channel on its own.
// residual is overwritten.
void MixedSolver::find_values(Block& block, Vector<double>& residual, Vector<double>& values) const {
  const std::size_t m = block.m, groups = at(core_->mesh.component_count()) * m;
  Vector<double> step(block.size, 0.0, &memory()), image(block.size, 0.0, &memory()), soft(block.size, 0.0, &memory());
  Vector<double> rate(groups, 0.0, &memory()), next(groups, 0.0, &memory()), goal(groups, 0.0, &memory());
  const auto sum = [&](const Vector<double>& a, const Vector<double>& b, bool scaled, Vector<double>& out) {
    std::fill(out.begin(), out.end(), 0.0);
    each_site([&](std::size_t slot, const Site& site) {
      for (std::size_t q = 0; q < m; ++q) {
        const double product = a[slot * m + q] * b[slot * m + q];
        out[at(site.component) * m + q] += scaled ? product / block.scale[slot] : product;
      }
    });
  };
  sum(residual, residual, true, rate);
  bool is_open = false;
  for (std::size_t g = 0; g < groups; ++g) {
    goal[g] = gradient_share * gradient_share * rate[g];
    is_open = is_open || rate[g] > goal[g];
  }
  each_site([&](std::size_t slot, const Site&) {
    for (std::size_t q = 0; q < m; ++q) step[slot * m + q] = residual[slot * m + q] / block.scale[slot];
  });
  for (int i = 0; is_open && i < most_gradient_steps; ++i) {
    poll();
    inner_.solve(step.data(), block.channels, block.load.data(), image.data());
    multiply_mass(block.load.data(), m);
    each_site([&](std::size_t slot, const Site& site) {
      for (std::size_t q = 0; q < m; ++q) soft[slot * m + q] = -softness(site) * image[slot * m + q];
    });
    inner_.respond(block.load.data(), soft.data(), block.channels, nullptr, image.data());
    sum(step, image, false, next);  // minus the energy of the step
    for (std::size_t g = 0; g < groups; ++g) next[g] = rate[g] > goal[g] && next[g] < 0 ? rate[g] / next[g] : 0.0;
    each_site([&](std::size_t slot, const Site& site) {
      for (std::size_t q = 0; q < m; ++q) {
        const double length = next[at(site.component) * m + q];
        values[slot * m + q] -= length * step[slot * m + q];
        residual[slot * m + q] -= length * image[slot * m + q];
      }
    });
    // A group without a step is done: small, or without an energy.
    for (std::size_t g = 0; g < groups; ++g) goal[g] = next[g] == 0 ? HUGE_VAL : goal[g];
    sum(residual, residual, true, next);
    is_open = false;
    for (std::size_t g = 0; g < groups; ++g) {
      const double ratio = next[g] > goal[g] ? next[g] / rate[g] : 0.0;
      rate[g] = next[g];
      next[g] = ratio;
      is_open = is_open || ratio > 0;
    }
    each_site([&](std::size_t slot, const Site& site) {
      for (std::size_t q = 0; q < m; ++q) {
        double& to = step[slot * m + q];
        to = next[at(site.component) * m + q] * to + residual[slot * m + q] / block.scale[slot];
      }
    });
  }
}

// Solves L v = W flux + right, L field = M v, W'field + D flux = gap. right: by vertex; null: 0.
void MixedSolver::solve_block(Block& block, const double* right, const double* gap, double* field,
                              Vector<double>& flux) const {
  const std::size_t m = block.m, n = at(core_->size()) * m;
  double *const v = block.v.data(), *const load = block.load.data();
  const Index channels = block.channels;
  Vector<double> missed(gap, gap + block.size, &memory()), residual(block.size, 0.0, &memory());
  Vector<double> more(block.size, 0.0, &memory()), values(block.size, 0.0, &memory());
  const auto soften = [&](const Vector<double>& by) {
    each_site([&](std::size_t slot, const Site& site) {
      for (std::size_t q = 0; q < m; ++q) missed[slot * m + q] = gap[slot * m + q] - softness(site) * by[slot * m + q];
    });
  };
  flux.assign(block.size, 0.0);
  if (right) {
    inner_.respond(right, nullptr, channels, v, flux.data());
    soften(flux);
  }
  inner_.solve(missed.data(), channels, nullptr, residual.data());
  if (right) {
    std::copy_n(v, n, load);
    multiply_mass(load, m);
    inner_.respond(load, nullptr, channels, nullptr, more.data());
    for (std::size_t i = 0; i < block.size; ++i) residual[i] += more[i];
  }
  find_values(block, residual, values);
  inner_.solve(values.data(), channels, load, more.data());
  for (std::size_t i = 0; right && i < n; ++i) load[i] += v[i];
  for (std::size_t i = 0; i < block.size; ++i) flux[i] += more[i];
  soften(flux);
  multiply_mass(load, m);
  inner_.respond(load, nullptr, channels, field, more.data());
  inner_.solve(missed.data(), channels, v, nullptr);
  for (std::size_t i = 0; i < n; ++i) field[i] += v[i];
}

void MixedSolver::find_residual(Block& block, const double* values, const double* field, const Vector<double>& flux,
                                double* right, Vector<double>& gap) const {
  const std::size_t m = block.m;
  surface::apply_operator(*core_, field, block.channels, right);
  for (std::size_t v = 0; v < at(core_->size()); ++v) {
    const bool in_reach = site_count(core_->mesh.component[v]) > 0;
    for (std::size_t q = 0; q < m; ++q) right[v * m + q] = in_reach ? -right[v * m + q] : 0.0;
  }
  gap.assign(block.size, 0.0);
  each_site([&](std::size_t slot, const Site& site) {
    for (std::size_t q = 0; q < m; ++q) {
      double& missed = gap[slot * m + q];
      missed = values[slot * m + q] - softness(site) * flux[slot * m + q];
      for (int c = 0; c < 3; ++c) {
        if (site.vertex[c] < 0) continue;
        missed -= site.weight[c] * field[at(site.vertex[c]) * m + q];
        right[at(site.vertex[c]) * m + q] += site.weight[c] * flux[slot * m + q];
      }
    }
  });
}

void MixedSolver::solve(const double* values, Index channels, double* field, double* flux) const {
  const std::size_t n = at(core_->size()), slots = at(slot_count()), stride = at(channels);
  Vector<double> low(&memory()), unit(&memory()), own(&memory()), gap(&memory());
  Vector<double> lambda(&memory()), change(&memory());
  for (Index first = 0; first < channels; first += ConstraintSystem::channel_block) {
    Block block(*core_, slots, std::min(ConstraintSystem::channel_block, channels - first));
    const std::size_t m = block.m;
    find_scale(block);
    own.assign(block.size, 0.0);
    each_site(
        [&](std::size_t slot, const Site&) { std::copy_n(values + slot * stride + at(first), m, &own[slot * m]); });
    inner_.value_extent(values, channels, first, block.channels, low, unit);
    for (std::size_t i = 0; i < unit.size(); ++i) {
      const double size = std::max(std::fabs(low[i]), std::fabs(unit[i]));
      unit[i] = unit[i] > low[i] ? unit[i] - low[i] : size > 0 ? size : 1.0;
    }
    surface::Workspace u(core_->workspaces, n * m), du(core_->workspaces, n * m), right(core_->workspaces, n * m);
    const auto hold = [&] {
      each_site([&](std::size_t slot, const Site& site) {
        if (site.is_hard_vertex()) std::copy_n(&own[slot * m], m, u.data() + at(site.vertex[0]) * m);
      });
    };
    solve_block(block, nullptr, own.data(), u.data(), lambda);
    hold();
    Corrections corrections;
    double largest = 0;
    do {
      find_residual(block, own.data(), u.data(), lambda, right.data(), gap);
      solve_block(block, right.data(), gap.data(), du.data(), change);
      largest = 0;
      for (std::size_t v = 0; v < n; ++v) {
        for (std::size_t q = 0; q < m; ++q) {
          u[v * m + q] += du[v * m + q];
          largest = std::max(largest, std::fabs(du[v * m + q]) / unit[at(core_->mesh.component[v]) * m + q]);
        }
      }
      for (std::size_t k = 0; k < block.size; ++k) lambda[k] += change[k];
      hold();
    } while (corrections.go_on(largest));
    for (std::size_t v = 0; field && v < n; ++v) std::copy_n(u.data() + v * m, m, field + v * stride + at(first));
    for (std::size_t s = 0; flux && s < slots; ++s) std::copy_n(&lambda[s * m], m, flux + s * stride + at(first));
  }
}

void MixedSolver::solve_at(const double* values, Index channels, Span<const Index> vertices, double* out) const {
  const std::size_t stride = at(channels);
  surface::Workspace field(core_->workspaces, at(core_->size()) * stride);
  solve(values, channels, field.data(), nullptr);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    std::copy_n(field.data() + at(vertices[i]) * stride, stride, out + i * stride);
}

bool MixedSolver::correct(const double* values, Index channels, const double* field, const double* flux, double* change,
                          double* flux_change) const {
  const std::size_t n = at(core_->size()), slots = at(slot_count()), stride = at(channels);
  Vector<double> own(&memory()), gap(&memory()), lambda(&memory()), more(&memory());
  for (Index first = 0; first < channels; first += ConstraintSystem::channel_block) {
    Block block(*core_, slots, std::min(ConstraintSystem::channel_block, channels - first));
    const std::size_t m = block.m;
    find_scale(block);
    own.assign(block.size, 0.0);
    lambda.assign(block.size, 0.0);
    each_site([&](std::size_t slot, const Site&) {
      std::copy_n(values + slot * stride + at(first), m, &own[slot * m]);
      std::copy_n(flux + slot * stride + at(first), m, &lambda[slot * m]);
    });
    surface::Workspace u(core_->workspaces, n * m), right(core_->workspaces, n * m);
    for (std::size_t v = 0; v < n; ++v) std::copy_n(field + v * stride + at(first), m, u.data() + v * m);
    find_residual(block, own.data(), u.data(), lambda, right.data(), gap);
    solve_block(block, right.data(), gap.data(), u.data(), more);
    each_site([&](std::size_t, const Site& site) {
      if (site.is_hard_vertex()) std::fill_n(u.data() + at(site.vertex[0]) * m, m, 0.0);
    });
    for (std::size_t v = 0; v < n; ++v) std::copy_n(u.data() + v * m, m, change + v * stride + at(first));
    for (std::size_t s = 0; s < slots; ++s) std::copy_n(&more[s * m], m, flux_change + s * stride + at(first));
  }
  return true;
}

}  // namespace hf_inner::solve

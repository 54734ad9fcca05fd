// One step of iterative refinement with the true operator K. Bi-harmonic operators need it, because their condition
// number is squared. u is the field and lambda the fluxes of the sites, with values s_i and weights w_i. The residuals
// r, g and the changes du, dlambda are
//
//     r_v = (W lambda)_v - sum_j K_vj (u_j - u_v),    g_i = s_i - w_i'u - D_i lambda_i
//     K du - W dlambda = r,    W'du + D dlambda = g
//
// The residual uses differences of u, so a large constant in u costs no digits. The change is solved as a field with an
// extra source y = G^-1 P r. The constant of each component is a:
//
//     S dlambda + a 1 = g - Y'y,   1'dlambda = -1'r,   du = P' G^-T (y + Y dlambda) + a
//
// A free value t_r of a rebase has the same equation in its row, with the right-hand side -r_r - Y_r'y.
// constraint_system.h explains the other letters. Cost: a product with K, a forward and a backward sweep.
#include <algorithm>
#include <cmath>

#include "base/index.h"
#include "solve/green.h"

namespace hf_inner::solve {
namespace {

constexpr std::size_t piece = 16384;  // matrix rows of one thread's job: the figures of green.cpp hold

}  // namespace

void GreenSolver::clear_answer(Index count, Answer& next) const {
  const std::size_t m = at(count);
  next.slot.assign(state().entries.size() * m, 0.0);
  next.freed.assign(state().freed.size() * m, 0.0);
  next.constant.assign(state().sites_of.size() * m, 0.0);
  next.total.assign(state().sites_of.size() * m, 0.0);
}

// Replaces the right-hand side z of the field, in the order of the factor, and the right-hand side of the sites in
// `next`, by their solution. The field still lacks the constant of each component. dense_only: leaves z useless, for
// half of the cost.
void GreenSolver::solve_right(double* z, Index count, Answer& next, const Step& step, bool dense_only) const {
  const std::size_t n = at(core_->size()), m = at(count);
  const Span<const Index> position = system_.factor().position();
  for (std::size_t v = n; v < position.size(); ++v) std::fill_n(z + at(position[v]) * m, m, 0.0);  // vertices that went
  const auto r = [&](Index v) { return z + at(position[at(v)]) * m; };
  // Vertices of eliminated sites are not in the factor. If the site still constrains the field, its vertex has no
  // equation. If the site was removed, the equation is a row of the dense system.
  for (std::size_t b = 0; b < state().freed.size(); ++b) {
    double* own = r(state().base->vertex[b]);
    if (state().freed[b].is_row()) {
      for (std::size_t q = 0; q < m; ++q) next.freed[b * m + q] = -own[q];
    }
    std::fill_n(own, m, 0.0);
  }
  for (std::size_t v = 0; v < n; ++v) {
    for (std::size_t q = 0; q < m; ++q) next.total[at(core_->mesh.component[v]) * m + q] += r(static_cast<Index>(v))[q];
  }

  if (step.single) {
    step.single->forward(z, count, step.scratch, *core_->jobs);
  } else {
    system_.factor().forward(z, count, *core_->jobs);
  }
  system_.subtract_projections(z, count, next);
  system_.solve_rows(count, next);
  system_.count_sweeps(1);
  if (dense_only) return;
  system_.combine(next, count, z);
  if (step.single) {
    step.single->backward(z, count, step.scratch, *core_->jobs);
  } else {
    system_.factor().backward(z, count, *core_->jobs);
  }
  system_.count_sweeps(1);
}

void GreenSolver::refine(const double* values, Index channels, Index first, Index count, double* z, Answer& answer,
                         double* field, Step& step) const {
  const std::size_t n = at(core_->size()), m = at(count), stride = at(channels), offset = at(first);
  const SymmetricMatrix& k = core_->matrix();
  const Span<const Index> position = system_.factor().position();
  const EliminatedBase* base = state().base.get();
  const auto u = [&](Index v) { return field + at(v) * stride + offset; };
  const auto r = [&](Index v) { return z + at(position[at(v)]) * m; };

  // Writes the part of the residual r that comes from the operator K and the field u: -sum_j K_vj (u_j - u_v). The rows
  // of r are in the order of the factor.
  for_ranges(*core_->jobs, n, piece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      double* own = r(static_cast<Index>(v));
      std::fill_n(own, m, 0.0);
      if (!reached(at(core_->mesh.component[v]))) continue;
      const double* here = u(static_cast<Index>(v));
      for (Index i = k.column_start[v]; i < k.column_start[v + 1]; ++i) {
        const double* there = u(k.row[at(i)]);
        for (std::size_t q = 0; q < m; ++q) own[q] -= k.value[at(i)] * (there[q] - here[q]);
      }
    }
  });
  // Adds the fluxes W lambda of the sites to the residual r of the field, and writes the residual g of the sites'
  // values into `next`.
  Answer next(memory());
  clear_answer(count, next);
  for (std::size_t slot = 0; slot < state().entries.size(); ++slot) {
    const auto& entry = state().entries[slot];
    if (!entry.used() || entry.eliminated >= 0) continue;
    const double soft = entry.site.compliance / core_->mean_diagonal[at(entry.site.component)];
    for (std::size_t q = 0; q < m; ++q)
      next.slot[slot * m + q] = values[slot * stride + offset + q] - soft * answer.slot[slot * m + q];
    for (int c = 0; c < 3; ++c) {
      if (entry.site.vertex[c] < 0) continue;
      for (std::size_t q = 0; q < m; ++q) {
        next.slot[slot * m + q] -= entry.site.weight[c] * u(entry.site.vertex[c])[q];
        r(entry.site.vertex[c])[q] += entry.site.weight[c] * answer.slot[slot * m + q];
      }
    }
  }
  solve_right(z, count, next, step, false);

  // into the field and the answer, or out
  double* const target = step.change ? step.change : field;
  const auto to = [&](Index v) { return target + at(v) * stride + offset; };
  Vector<double> largest((n + piece - 1) / piece, 0.0, &memory());
  for (std::size_t slot = 0; step.change && slot < state().entries.size(); ++slot)
    std::copy_n(next.slot.data() + slot * m, m, step.flux_change + slot * stride + offset);
  for (std::size_t i = 0; !step.change && i < answer.slot.size(); ++i) answer.slot[i] += next.slot[i];
  for (std::size_t i = 0; !step.change && i < answer.freed.size(); ++i) answer.freed[i] += next.freed[i];
  for_ranges(*core_->jobs, n, piece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const std::size_t c = at(core_->mesh.component[v]);
      double* own = to(static_cast<Index>(v));
      if (step.change) std::fill_n(own, m, 0.0);
      if (!reached(c) || (base && base->eliminated(static_cast<Index>(v)))) continue;
      const double* change = z + at(position[v]) * m;
      double most = 0;
      for (std::size_t q = 0; q < m; ++q) {
        const double more = change[q] + next.constant[c * m + q];
        own[q] += more;
        most = std::max(most, std::fabs(step.unit ? more / step.unit[c * m + q] : more));
      }
      largest[begin / piece] = std::max(largest[begin / piece], most);
    }
  });
  step.largest = *std::max_element(largest.begin(), largest.end());
  for (std::size_t b = 0; b < state().freed.size(); ++b) {
    if (!state().freed[b].is_row()) continue;
    for (std::size_t q = 0; q < m; ++q) to(base->vertex[b])[q] += next.freed[b * m + q];
  }
  // Hard vertex sites get their values bit for bit.
  if (!step.change) return copy_hard_values(values, channels, first, count, u);
  for (const auto& entry : state().entries) {
    if (entry.used() && entry.site.is_hard_vertex()) std::fill_n(to(entry.site.vertex[0]), m, 0.0);
  }
}

// Corrects a field until the next correction would be small, or none helps.
void GreenSolver::refine_until_small(const double* values, Index channels, Index first, Index count, double* z,
                                     Answer& answer, double* field) const {
  Vector<double> unit(&memory()), high(&memory());
  value_extent(values, channels, first, count, unit, high);
  for (std::size_t i = 0; i < unit.size(); ++i) {
    const double size = std::max(std::fabs(unit[i]), std::fabs(high[i]));
    unit[i] = high[i] > unit[i] ? high[i] - unit[i] : size > 0 ? size : 1.0;
  }
  Step step;
  step.unit = unit.data();
  Corrections corrections;
  do {
    refine(values, channels, first, count, z, answer, field, step);
  } while (corrections.go_on(step.largest));
}

void GreenSolver::respond(const double* load, const double* values, Index channels, double* field, double* flux) const {
  const std::size_t n = at(core_->size()), m = at(channels);
  const Span<const Index> position = system_.factor().position();
  const EliminatedBase* base = state().base.get();
  // The flux of a site that the factor eliminates comes from the field.
  const bool needs_field = !field && base;
  surface::Workspace z(core_->workspaces, at(core_->unknown_count()) * m),
      own(core_->workspaces, needs_field ? n * m : 0);
  if (needs_field) field = own.data();
  Answer next(memory());
  clear_answer(channels, next);
  for_ranges(*core_->jobs, n, piece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const bool in_reach = reached(at(core_->mesh.component[v]));
      for (std::size_t q = 0; q < m; ++q) z[at(position[v]) * m + q] = in_reach ? load[v * m + q] : 0.0;
    }
  });
  for (std::size_t slot = 0; values && slot < state().entries.size(); ++slot) {
    if (state().entries[slot].used() && state().entries[slot].eliminated < 0)
      std::copy_n(values + slot * m, m, &next.slot[slot * m]);
  }
  solve_right(z.data(), channels, next, Step(), !field);
  std::copy(next.slot.begin(), next.slot.end(), flux);
  if (!field) return;
  for_ranges(*core_->jobs, n, piece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const std::size_t c = at(core_->mesh.component[v]);
      const bool is_free = reached(c) && !(base && base->eliminated(static_cast<Index>(v)));
      for (std::size_t q = 0; q < m; ++q)
        field[v * m + q] = is_free ? z[at(position[v]) * m + q] + next.constant[c * m + q] : 0.0;
    }
  });
  for (std::size_t b = 0; b < state().freed.size(); ++b) {
    if (state().freed[b].is_row()) std::copy_n(&next.freed[b * m], m, field + at(base->vertex[b]) * m);
  }
  if (!base) return;
  base_flux(channels, field, flux);
  for (std::size_t slot = 0; slot < state().entries.size(); ++slot) {
    const auto& entry = state().entries[slot];
    if (!entry.used() || entry.eliminated < 0) continue;
    for (std::size_t q = 0; q < m; ++q) flux[slot * m + q] -= load[at(entry.site.vertex[0]) * m + q];
  }
}

bool GreenSolver::correct(const double* values, Index channels, const double* field, const double* flux, double* change,
                          double* flux_change) const {
  const std::size_t n = at(core_->size()), stride = at(channels);
  surface::Workspace copy(core_->workspaces, n * stride),
      z(core_->workspaces, at(core_->unknown_count()) * at(std::min(channels, channel_block)));
  std::copy_n(field, n * stride, copy.data());
  Answer answer(memory());
  for (Index first = 0; first < channels; first += channel_block) {
    const Index count = std::min(channel_block, channels - first);
    const std::size_t m = at(count);
    answer.slot.resize(state().entries.size() * m);
    for (std::size_t slot = 0; slot < state().entries.size(); ++slot)
      std::copy_n(flux + slot * stride + at(first), m, answer.slot.data() + slot * m);
    Step step;
    step.change = change;
    step.flux_change = flux_change;
    refine(values, channels, first, count, z.data(), answer, copy.data(), step);
  }
  return true;
}

}  // namespace hf_inner::solve

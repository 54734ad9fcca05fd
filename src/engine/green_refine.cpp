// One step of iterative refinement with the true operator, for operators whose condition is squared (bi-harmonic):
//
//     r_v = (W lambda)_v - sum_j K_vj (u_j - u_v),    g_i = s_i - w_i'u - D_i lambda_i
//     K du - W dlambda = r,    W'du + D dlambda = g
//
// The residual is formed in differences, which loses nothing to the constants that K annihilates. The correction takes
// the way of a field with y = G^-1 P r as an extra source: S dlambda + a 1 = g - Y'y, 1'dlambda = -1'r, du = P' G^-T (y +
// Y dlambda) + a. A free value t_r of a rebase obeys the same equation in its row: right-hand side -r_r - Y_r'y. Cost: a
// product with K, a forward and a backward sweep.
#include <algorithm>
#include <cmath>

#include "base/index.h"
#include "engine/green_right.h"

namespace hf_inner {
namespace {

constexpr std::size_t piece = 16384;

}  // namespace

void GreenSolver::refine(const double* values, Index channels, Index first, Index count, double* z, Right& right,
                         double* field, SingleSweeps* single) const {
  const std::size_t n = at(core_->size()), m = at(count), stride = at(channels), offset = at(first);
  const SymmetricMatrix& k = core_->laplacian;
  const Span<const Index> position = factor(state_).position();
  const EliminatedBase* base = state_.base.get();
  const auto u = [&](Index v) { return field + at(v) * stride + offset; };
  const auto r = [&](Index v) { return z + at(position[at(v)]) * m; };
  const auto reached = [&](std::size_t c) { return state_.sites_of[c] > 0; };

  // r by factor row
  core_->jobs->for_each(static_cast<std::uint32_t>((n + piece - 1) / piece), [&](std::uint32_t p) {
    const std::size_t end = std::min(n, (p + std::size_t{1}) * piece);
    for (std::size_t v = p * piece; v < end; ++v) {
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
  // W lambda, and g into `next`
  Right next(memory());
  next.slot.assign(state_.entries.size() * m, 0.0), next.freed.assign(state_.freed.size() * m, 0.0);
  next.constant.assign(state_.sites_of.size() * m, 0.0), next.total.assign(state_.sites_of.size() * m, 0.0);
  for (std::size_t slot = 0; slot < state_.entries.size(); ++slot) {
    const Entry& entry = state_.entries[slot];
    if (!entry.used() || entry.eliminated >= 0) continue;
    const double soft = entry.site.compliance / core_->mean_diagonal[at(entry.site.component)];
    for (std::size_t q = 0; q < m; ++q)
      next.slot[slot * m + q] = values[slot * stride + offset + q] - soft * right.slot[slot * m + q];
    for (int c = 0; c < 3; ++c) {
      if (entry.site.vertex[c] < 0) continue;
      for (std::size_t q = 0; q < m; ++q) {
        next.slot[slot * m + q] -= entry.site.weight[c] * u(entry.site.vertex[c])[q];
        r(entry.site.vertex[c])[q] += entry.site.weight[c] * right.slot[slot * m + q];
      }
    }
  }
  // eliminated vertices stand outside the factor: those in force have no equation, the freed ones a row of their own
  for (std::size_t b = 0; b < state_.freed.size(); ++b) {
    double* own = r(base->vertex[b]);
    if (state_.freed[b].path.group >= 0) {
      for (std::size_t q = 0; q < m; ++q) next.freed[b * m + q] = -own[q];
    }
    std::fill_n(own, m, 0.0);
  }
  for (std::size_t v = 0; v < n; ++v) {
    for (std::size_t q = 0; q < m; ++q)
      next.total[at(core_->mesh.component[v]) * m + q] += r(static_cast<Index>(v))[q];
  }

  if (single) {
    single->factor.forward(z, count, single->scratch, *core_->jobs);
  } else {
    factor(state_).forward(z, count, *core_->jobs);
  }
  subtract_projections(z, count, next);
  solve_rows(count, next);
  combine(next, count, z);
  if (single) {
    single->factor.backward(z, count, single->scratch, *core_->jobs);
  } else {
    factor(state_).backward(z, count, *core_->jobs);
  }
  sweeps_ += 2;

  Vector<double> largest((n + piece - 1) / piece, 0.0, &memory());
  for (std::size_t i = 0; i < right.slot.size(); ++i) right.slot[i] += next.slot[i];
  for (std::size_t i = 0; i < right.freed.size(); ++i) right.freed[i] += next.freed[i];
  core_->jobs->for_each(static_cast<std::uint32_t>((n + piece - 1) / piece), [&](std::uint32_t p) {
    const std::size_t end = std::min(n, (p + std::size_t{1}) * piece);
    for (std::size_t v = p * piece; v < end; ++v) {
      const std::size_t c = at(core_->mesh.component[v]);
      if (!reached(c) || (base && base->eliminated(static_cast<Index>(v)))) continue;
      double* own = u(static_cast<Index>(v));
      const double* change = z + at(position[v]) * m;
      double most = 0;
      for (std::size_t q = 0; q < m; ++q) {
        const double step = change[q] + next.constant[c * m + q];
        own[q] += step, most = std::max(most, std::fabs(step));
      }
      largest[p] = std::max(largest[p], most);
    }
  });
  if (single) single->largest = *std::max_element(largest.begin(), largest.end());
  for (std::size_t b = 0; b < state_.freed.size(); ++b) {
    if (state_.freed[b].path.group < 0) continue;
    for (std::size_t q = 0; q < m; ++q) u(base->vertex[b])[q] += next.freed[b * m + q];
  }
  // hard vertex sites hold their values to the bit
  for (std::size_t slot = 0; slot < state_.entries.size(); ++slot) {
    const Entry& entry = state_.entries[slot];
    if (!entry.used() || !entry.site.is_vertex() || entry.site.compliance != 0) continue;
    std::copy_n(values + slot * stride + offset, m, u(entry.site.vertex[0]));
  }
}

}  // namespace hf_inner

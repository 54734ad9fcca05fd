// Solves a ConstraintSystem: first the dense unknowns, then one backward sweep.
#include <algorithm>

#include "solve/constraint_system.h"

namespace hf_inner::solve {
namespace {

// Number of array entries that one thread's job sets to zero. Half this number makes more jobs than threads need. Twice
// this number leaves threads idle on small meshes. On two threads and a torus of 102,400 vertices half and double solve
// one channel in the same time within 3 %.
constexpr std::size_t clear_piece = 16384;

}  // namespace

// Computes the mean site value of every component if K maps constants to zero. Subtracting the mean saves the digits
// that a large common offset would cost.
void ConstraintSystem::find_centres(const double* values, Index channels, Index first, Index count,
                                    Answer& answer) const {
  const std::size_t m = at(count);
  answer.centre.assign(state_.sites_of.size() * m, 0.0);
  if (!operator_.keeps_constants()) return;
  for (std::size_t slot = 0; slot < state_.entries.size(); ++slot) {
    if (!state_.entries[slot].used()) continue;
    const std::size_t c = at(state_.entries[slot].site.component);
    for (std::size_t q = 0; q < m; ++q)
      answer.centre[c * m + q] += values[slot * at(channels) + at(first) + q] / static_cast<double>(state_.sites_of[c]);
  }
}

// Sets z to g = G^-1 P (-K_FE s_E): what the eliminated sites E contribute to the other vertices F. s_E are their
// values, less the mean. K is the operator, G its factor, P the ordering.
void ConstraintSystem::base_forward(const double* values, Index channels, Index first, Index count,
                                    const Answer& answer, double* z) const {
  const std::size_t m = at(count);
  const SymmetricMatrix& k = operator_.k();
  const Span<const Index> position = factor().position();
  for (std::size_t slot = 0; slot < state_.entries.size(); ++slot) {
    const auto& entry = state_.entries[slot];
    if (!entry.used() || entry.eliminated < 0) continue;
    const Index e = entry.site.vertex[0];
    const double* c = answer.centre.data() + at(entry.site.component) * m;
    for (Index i = k.column_start[at(e)]; i < k.column_start[at(e) + 1]; ++i) {
      const Index v = k.row[at(i)];
      if (state_.base->eliminated(v)) continue;
      for (std::size_t q = 0; q < m; ++q)
        z[at(position[at(v)]) * m + q] -= k.value[at(i)] * (values[slot * at(channels) + at(first) + q] - c[q]);
    }
  }
  factor().forward(z, count, *operator_.jobs);
  ++sweeps_;
}

// Adds what the values s_E of the eliminated sites E contribute to the dense right-hand side. It adds -W_E' s_E for
// other sites with weights W, and K_RE s_E for removed sites R, whose values are unknown.
void ConstraintSystem::add_base_terms(const double* values, Index channels, Index first, Index count,
                                      Answer& answer) const {
  const std::size_t m = at(count);
  const EliminatedBase& base = *state_.base;
  Vector<Index> slot_of_base(state_.freed.size(), -1, &memory());
  for (std::size_t slot = 0; slot < state_.entries.size(); ++slot) {
    const Index b = state_.entries[slot].eliminated;
    if (state_.entries[slot].used() && b >= 0) slot_of_base[at(b)] = static_cast<Index>(slot);
  }
  const auto slot_at = [&](Index unknown) {
    return unknown >= 0 && base.eliminated(unknown) ? slot_of_base[at(base.index_of[at(unknown)])] : -1;
  };
  const auto centred = [&](Index slot, std::size_t q) {
    return values[at(slot) * at(channels) + at(first) + q] -
           answer.centre[at(state_.entries[at(slot)].site.component) * m + q];
  };
  for (std::size_t slot = 0; slot < state_.entries.size(); ++slot) {
    const auto& entry = state_.entries[slot];
    if (!entry.used() || entry.eliminated >= 0) continue;
    for (int c = 0; c < 3; ++c) {
      const Index there = slot_at(entry.site.vertex[c]);
      for (std::size_t q = 0; there >= 0 && q < m; ++q)
        answer.slot[slot * m + q] -= entry.site.weight[c] * centred(there, q);
    }
  }
  const SymmetricMatrix& k = operator_.k();
  for (std::size_t b = 0; b < state_.freed.size(); ++b) {
    if (!state_.freed[b].is_row()) continue;
    const Index r = base.vertex[b];
    for (Index i = k.column_start[at(r)]; i < k.column_start[at(r) + 1]; ++i) {
      const Index there = slot_at(k.row[at(i)]);
      for (std::size_t q = 0; there >= 0 && q < m; ++q) answer.freed[b * m + q] += k.value[at(i)] * centred(there, q);
    }
  }
}

void ConstraintSystem::solve_dense(const double* values, Index channels, Index first, Index count, const double* z,
                                   Answer& answer) const {
  const std::size_t m = at(count), stride = at(channels);
  answer.slot.assign(state_.entries.size() * m, 0.0);
  answer.freed.assign(state_.freed.size() * m, 0.0);
  answer.constant.assign(answer.centre.begin(), answer.centre.end());
  for (std::size_t slot = 0; slot < state_.entries.size(); ++slot) {
    const auto& entry = state_.entries[slot];
    if (!entry.used() || entry.eliminated >= 0) continue;
    for (std::size_t q = 0; q < m; ++q)
      answer.slot[slot * m + q] =
          values[slot * stride + at(first) + q] - answer.centre[at(entry.site.component) * m + q];
  }
  if (state_.base) {
    subtract_projections(z, count, answer);
    add_base_terms(values, channels, first, count, answer);
  }
  solve_rows(count, answer);
}

void ConstraintSystem::sweep(const double* values, Index channels, Index first, Index count, Answer& answer,
                             double* z) const {
  const std::size_t m = at(count), size = at(operator_.size()) * m;
  find_centres(values, channels, first, count, answer);
  for_ranges(*operator_.jobs, size, clear_piece,
             [&](std::size_t begin, std::size_t end) { std::fill(z + begin, z + end, 0.0); });
  if (state_.base) base_forward(values, channels, first, count, answer, z);
  solve_dense(values, channels, first, count, z, answer);
  combine(answer, count, z);
  factor().backward(z, count, *operator_.jobs);
  ++sweeps_;
  for (std::size_t b = 0; b < state_.freed.size(); ++b) {
    if (!state_.freed[b].is_row()) continue;
    std::copy_n(&answer.freed[b * m], m, z + at(factor().position()[at(state_.base->vertex[b])]) * m);
  }
}

// Subtracts the products Y'z of the sites' elimination paths Y with z from `answer`, row by row.
void ConstraintSystem::subtract_projections(const double* z, Index count, Answer& answer) const {
  const std::size_t m = at(count);
  answer.x.resize(factor::PathGroup::capacity * m);
  for (const auto& group : state_.groups) {
    if (group.used == 0) continue;
    factor().project(*group.paths, z, count, answer.x.data());
    for (Index i = 0; i < group.paths->count(); ++i) {
      if (group.row[i] == ConstraintState::no_row) continue;
      for (std::size_t q = 0; q < m; ++q) answer.of(group.row[i], m)[q] -= answer.x[at(i) * m + q];
    }
  }
}

// Solves the dense system. Replaces `answer` by the fluxes lambda of the sites, and the unknown values t of sites that
// were removed. If K maps constants to zero, nu is added to the constants.
void ConstraintSystem::solve_rows(Index count, Answer& answer) const {
  const std::size_t m = at(count), border = operator_.border();
  const bool constants = operator_.keeps_constants();
  if (!constants) answer.nu.assign(state_.blocks.size() * border * m, 0.0);
  double nu[PinnedOperator::most_border * at(channel_block)];
  for (std::size_t c = 0; c < state_.blocks.size(); ++c) {
    const DenseBlock* block = state_.blocks[c].get();
    if (!block) continue;
    const Span<const Index> rows = block->ids();
    answer.x.resize(rows.size() * m);
    for (std::size_t i = 0; i < rows.size(); ++i) std::copy_n(answer.of(rows[i], m), m, answer.x.data() + i * m);
    block->solve_bordered(answer.x.data(), count, answer.total.empty() ? nullptr : &answer.total[c * m], nu);
    for (std::size_t i = 0; i < rows.size(); ++i) std::copy_n(answer.x.data() + i * m, m, answer.of(rows[i], m));
    if (block->border() == 0) continue;
    if (!constants) std::copy_n(nu, border * m, &answer.nu[c * border * m]);
    for (std::size_t q = 0; constants && q < m; ++q) answer.constant[c * m + q] += nu[q];
  }
}

void ConstraintSystem::combine(const Answer& answer, Index count, double* z) const {
  double own[factor::PathGroup::capacity * channel_block];
  const std::size_t m = at(count);
  for (const auto& group : state_.groups) {
    if (group.used == 0) continue;
    for (Index i = 0; i < group.paths->count(); ++i) {
      if (group.row[i] == ConstraintState::no_row) {
        std::fill_n(own + at(i) * m, m, 0.0);
      } else {
        std::copy_n(answer.of(group.row[i], m), m, own + at(i) * m);
      }
    }
    factor().combine(*group.paths, own, count, z);
  }
  for (std::size_t g = 0; operator_.paths && g < operator_.paths->groups.size(); ++g) {
    std::fill(std::begin(own), std::end(own), 0.0);
    for (std::size_t pin = 0; pin < operator_.paths->group.size(); ++pin) {
      if (at(operator_.paths->group[pin]) == g)
        std::copy_n(&answer.nu[pin * m], m, own + at(operator_.paths->column[pin]) * m);
    }
    factor().combine(*operator_.paths->groups[g], own, count, z);
  }
}

}  // namespace hf_inner::solve

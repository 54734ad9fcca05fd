#include "field/direction_solver.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/index.h"
#include "engine/site_cost.h"
#include "field/direction_columns.h"

namespace hf_inner {

void DirectionSolver::State::swap(State& other) noexcept {
  slots.swap(other.slots), groups.swap(other.groups), blocks.swap(other.blocks), count.swap(other.count);
  std::swap(rows, other.rows), eliminated.swap(other.eliminated);
}

DirectionSolver::DirectionSolver(std::shared_ptr<const DirectionSystem> system)
    : system_(std::move(system)), state_(system_->beta.size(), *system_->core->memory) {
  ++factorisations_;
}

DirectionSolver::DirectionSolver(const DirectionSolver& other)
    : system_(other.system_), state_(other.state_, other.memory()) {
  ++factorisations_;
}

std::shared_ptr<const DirectionSolver::State> DirectionSolver::snapshot() const {
  return make_shared_in<State>(memory(), state_, memory());
}

void DirectionSolver::restore(const State& state) {
  State next(state, memory());
  state_.swap(next);
}

DirectionCounters DirectionSolver::counters() const noexcept {
  DirectionCounters counters;
  counters.factorisations = factorisations_, counters.path_solves = path_solves_, counters.sweeps = sweeps_;
  for (const Group& group : state_.groups) counters.bytes += group.paths->bytes();
  for (const auto& block : state_.blocks) counters.bytes += block ? block->bytes() : 0.0;
  if (state_.eliminated) counters.bytes += state_.eliminated->statistics().bytes;
  return counters;
}

void DirectionSolver::edit(const Edit& edit) {
  State next(state_, memory());
  Vector<Index> leaving(edit.remove.begin(), edit.remove.end(), &memory());
  const bool was_eliminated = next.eliminated != nullptr;
  if (!was_eliminated) remove_rows(next, leaving);
  for (const Index slot : leaving) {
    --next.count[at(component(next.slots[at(slot)].vertex))];
    next.slots[at(slot)] = Slot{};
  }
  for (std::size_t i = 0; i < edit.add.size(); ++i) {
    if (next.slots.size() <= at(edit.add[i])) next.slots.resize(at(edit.add[i]) + 1);
    next.slots[at(edit.add[i])].vertex = edit.vertices[i];
    ++next.count[at(component(edit.vertices[i]))];
  }
  double rows = 0;
  for (const Slot& slot : next.slots) rows += slot.vertex >= 0 ? 2 : 0;
  const SiteCost cost(system_->factor->statistics());
  const double kept = was_eliminated ? 0.0 : static_cast<double>(next.rows);
  if (cost.dense_ns(kept, rows - kept) > 1.25 * cost.rebase_ns(0) ||
      (was_eliminated && cost.dense_ns(0, rows) > 0.5 * cost.rebase_ns(0))) {
    eliminate(next);
  } else if (was_eliminated) {
    State fresh(next.count.size(), memory());
    Vector<Index> all(&memory());
    fresh.slots.resize(next.slots.size());
    for (std::size_t s = 0; s < next.slots.size(); ++s) {
      fresh.slots[s].vertex = next.slots[s].vertex;
      if (next.slots[s].vertex >= 0) all.push_back(static_cast<Index>(s));
    }
    fresh.count.assign(next.count.begin(), next.count.end());
    next.swap(fresh);
    add_rows(next, all);
  } else {
    tidy_groups(next);
    add_rows(next, edit.add);
  }
  state_.swap(next);
}

void DirectionSolver::remove_rows(State& state, Span<const Index> slots) const {
  Vector<Index> rows(&memory());
  Vector<std::uint8_t> done(state.blocks.size(), 0, &memory());
  for (const Index first : slots) {
    const Index c = component(state.slots[at(first)].vertex);
    if (done[at(c)]) continue;
    done[at(c)] = 1, rows.clear();
    for (const Index slot : slots) {
      if (component(state.slots[at(slot)].vertex) == c) rows.push_back(2 * slot), rows.push_back(2 * slot + 1);
    }
    auto& block = state.blocks[at(c)];
    if (block->count() == static_cast<Index>(rows.size())) {
      block.reset();
      continue;
    }
    const auto copy = make_shared_in<DenseBlock>(memory(), *block);
    copy->remove(rows);
    if (copy->factorise(*core().jobs) >= 0)
      fail(HF_ERROR_NOT_POSITIVE_DEFINITE, HF_NO_INDEX,
           "the constraints of component %d lost their factor; the weights are degenerate", c);
    block = copy;
  }
  for (const Index slot : slots) {
    for (int part = 0; part < 2; ++part) {
      Group& group = state.groups[at(state.slots[at(slot)].group[part])];
      group.row[state.slots[at(slot)].column[part]] = -1, --group.live, --state.rows;
    }
  }
}

// Drops groups without a living row; where the dead outweigh the living, solves the sparse ones anew.
void DirectionSolver::tidy_groups(State& state) const {
  std::int64_t stored = 0;
  for (const Group& group : state.groups) stored += group.live > 0 ? group.paths->count() : 0;
  Vector<Index> moving(&memory());
  if (stored > 2 * std::int64_t{state.rows} + 64) {
    for (Group& group : state.groups) {
      if (group.live == 0 || 2 * group.live > group.paths->count()) continue;
      for (Index& row : group.row) {
        if (row >= 0) moving.push_back(row / 2);
      }
    }
    std::sort(moving.begin(), moving.end());
    moving.erase(std::unique(moving.begin(), moving.end()), moving.end());
    for (const Index slot : moving) {
      for (int part = 0; part < 2; ++part) {
        Group& group = state.groups[at(state.slots[at(slot)].group[part])];
        group.row[state.slots[at(slot)].column[part]] = -1, --group.live;
      }
    }
  }
  std::size_t kept = 0;
  for (std::size_t g = 0; g < state.groups.size(); ++g) {
    if (state.groups[g].live == 0) continue;
    for (const Index row : state.groups[g].row) {
      if (row >= 0) state.slots[at(row / 2)].group[row % 2] = static_cast<Index>(kept);
    }
    if (kept != g) state.groups[kept] = std::move(state.groups[g]);
    ++kept;
  }
  state.groups.resize(kept);
  if (!moving.empty()) add_paths(state, moving);
}

void DirectionSolver::add_paths(State& state, Span<const Index> slots) const {
  UnitColumns columns(memory());
  for (const Index slot : slots) {
    for (Index part = 0; part < 2; ++part) columns.append(unknown(state.slots[at(slot)].vertex, part));
  }
  Vector<std::shared_ptr<const PathGroup>> groups(&memory());
  Vector<Index> group(2 * slots.size(), &memory()), column(2 * slots.size(), &memory());
  system_->factor->solve_paths(columns.view(), memory(), *core().jobs, groups, group, column);
  const Index first = static_cast<Index>(state.groups.size());
  for (auto& paths : groups) {
    Group fresh;
    fresh.paths = std::move(paths);
    std::fill(std::begin(fresh.row), std::end(fresh.row), -1);
    state.groups.push_back(std::move(fresh));
  }
  for (std::size_t i = 0; i < group.size(); ++i) {
    Slot& slot = state.slots[at(slots[i / 2])];
    slot.group[i % 2] = first + group[i], slot.column[i % 2] = column[i];
    Group& owner = state.groups[at(first + group[i])];
    owner.row[column[i]] = 2 * slots[i / 2] + static_cast<Index>(i % 2), ++owner.live;
  }
  path_solves_ += static_cast<std::uint32_t>(group.size());
}

void DirectionSolver::add_rows(State& state, Span<const Index> slots) const {
  if (slots.empty()) return;
  const std::size_t first_fresh = state.groups.size();
  add_paths(state, slots);
  state.rows += 2 * static_cast<Index>(slots.size());

  // place of every row in its block: those there are, then the new ones in order; and its number in the batch
  struct Where {
    Index place = -1, batch = -1, component = -1;
  };
  Vector<Where> where(2 * state.slots.size(), &memory());
  Vector<Index> places(state.blocks.size(), 0, &memory());
  for (std::size_t c = 0; c < state.blocks.size(); ++c) {
    if (!state.blocks[c]) continue;
    for (const Index row : state.blocks[c]->ids()) where[at(row)] = {places[c]++, -1, static_cast<Index>(c)};
  }
  Vector<std::size_t> start(2 * slots.size() + 1, 0, &memory());
  for (std::size_t i = 0; i < 2 * slots.size(); ++i) {
    const Index c = component(state.slots[at(slots[i / 2])].vertex), place = places[at(c)]++;
    where[at(2 * slots[i / 2]) + i % 2] = {place, static_cast<Index>(i), c};
    start[i + 1] = start[i] + at(place) + 1;
  }
  Vector<double> values(start.back(), 0.0, &memory());
  core().jobs->for_each(static_cast<std::uint32_t>(state.groups.size() - first_fresh), [&](std::uint32_t piece) {
    const std::size_t a = first_fresh + piece;
    const Group& mine = state.groups[a];
    double tile[PathGroup::capacity * PathGroup::capacity];
    for (std::size_t b = 0; b < state.groups.size() + system_->ground_groups.size(); ++b) {
      const bool ground = b >= state.groups.size();
      const PathGroup& other = ground ? *system_->ground_groups[b - state.groups.size()] : *state.groups[b].paths;
      // pairs of new groups from the later one's side for both, so that S is symmetric to the bit
      const bool transposed = !ground && b > a;
      if (transposed) {
        system_->factor->gram(other, *mine.paths, tile, PathGroup::capacity);
      } else {
        system_->factor->gram(*mine.paths, other, tile, PathGroup::capacity);
      }
      for (Index i = 0; i < mine.paths->count(); ++i) {
        if (mine.row[i] < 0) continue;
        const Where& here = where[at(mine.row[i])];
        if (ground) {
          for (std::size_t part = 0; part < 2; ++part) {
            const std::size_t g = 2 * at(here.component) + part;
            if (at(system_->ground_group[g]) == b - state.groups.size())
              state.slots[at(mine.row[i] / 2)].ground[mine.row[i] % 2][part] =
                  tile[i * PathGroup::capacity + system_->ground_column[g]];
          }
          continue;
        }
        for (Index j = 0; j < other.count(); ++j) {
          if (state.groups[b].row[j] < 0) continue;
          const Where& there = where[at(state.groups[b].row[j])];
          if (here.batch < 0 || there.component != here.component || there.place > here.place) continue;
          values[start[at(here.batch)] + at(there.place)] =
              transposed ? tile[j * PathGroup::capacity + i] : tile[i * PathGroup::capacity + j];
        }
      }
    }
  });

  Vector<std::shared_ptr<DenseBlock>> open(state.blocks.size(), &memory());
  for (std::size_t i = 0; i < 2 * slots.size(); ++i) {
    const std::size_t c = at(component(state.slots[at(slots[i / 2])].vertex));
    if (!open[c])
      open[c] = state.blocks[c] ? make_shared_in<DenseBlock>(memory(), *state.blocks[c])
                                : make_shared_in<DenseBlock>(memory(), memory());
    open[c]->append(2 * slots[i / 2] + static_cast<Index>(i % 2), values.data() + start[i]);
  }
  for (std::size_t c = 0; c < open.size(); ++c) {
    if (!open[c]) continue;
    if (open[c]->factorise(*core().jobs) >= 0)
      fail(HF_ERROR_NOT_POSITIVE_DEFINITE, HF_NO_INDEX,
           "the constraints of component %zu depend on each other; the weights are degenerate", c);
    state.blocks[c] = open[c];
  }
}

// Every constrained vertex out of the matrix; components without one keep their ground.
void DirectionSolver::eliminate(State& state) const {
  state.groups.clear(), state.rows = 0;
  for (auto& block : state.blocks) block.reset();
  Vector<std::uint8_t> gone(at(system_->matrix.size()), 0, &memory());
  for (Slot& slot : state.slots) {
    if (slot.vertex < 0) continue;
    const Index vertex = slot.vertex;
    slot = Slot{};
    slot.vertex = vertex;
    for (Index part = 0; part < 2; ++part) gone[at(unknown(vertex, part))] = 1;
  }
  SymmetricMatrix a(memory());
  a.column_start.assign(system_->matrix.column_start.begin(), system_->matrix.column_start.end());
  a.row.assign(system_->matrix.row.begin(), system_->matrix.row.end()),
      a.value.assign(system_->matrix.value.begin(), system_->matrix.value.end());
  for (std::size_t c = 0; c < state.count.size(); ++c) {
    if (state.count[c] > 0) continue;
    for (Index part = 0; part < 2; ++part) {
      const Index u = unknown(core().ground[c], part);
      const auto begin = a.row.begin() + a.column_start[at(u)], end = a.row.begin() + a.column_start[at(u) + 1];
      a.value[static_cast<std::size_t>(std::lower_bound(begin, end, u) - a.row.begin())] += system_->beta[c];
    }
  }
  state.eliminated = system_->factor->refactor(a, gone, memory(), *core().jobs);
  ++factorisations_;
}

void DirectionSolver::solve_dense(Span<const std::complex<double>> values, double* z) const {
  const auto put = [&](Vector<double>& lambda, Index row, double x) { lambda[at(row)] = x; };
  Vector<double> lambda(2 * state_.slots.size(), 0.0, &memory()), x(&memory());
  Vector<double> nu(2 * state_.blocks.size(), 0.0, &memory());
  for (std::size_t c = 0; c < state_.blocks.size(); ++c) {
    const DenseBlock* block = state_.blocks[c].get();
    if (!block) continue;
    // S^-1 [s, N]
    const Span<const Index> rows = block->ids();
    x.resize(3 * rows.size());
    const auto ground = [&](Index row, std::size_t part) { return state_.slots[at(row / 2)].ground[row % 2][part]; };
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::complex<double> value = values[at(rows[i] / 2)];
      x[3 * i] = rows[i] % 2 ? value.imag() : value.real();
      x[3 * i + 1] = ground(rows[i], 0), x[3 * i + 2] = ground(rows[i], 1);
    }
    block->solve(x.data(), 3);
    double m[2][2], right[2] = {0, 0};
    for (std::size_t p = 0; p < 2; ++p) {
      for (std::size_t q = 0; q < 2; ++q) m[p][q] = -system_->ground_block[4 * c + 2 * p + q];
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (std::size_t p = 0; p < 2; ++p) {
        right[p] += ground(rows[i], p) * x[3 * i];
        for (std::size_t q = 0; q < 2; ++q) m[p][q] += ground(rows[i], p) * x[3 * i + 1 + q];
      }
    }
    // (N' S^-1 N - C) nu = N' S^-1 s, definite
    const double determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    nu[2 * c] = (m[1][1] * right[0] - m[0][1] * right[1]) / determinant;
    nu[2 * c + 1] = (m[0][0] * right[1] - m[1][0] * right[0]) / determinant;
    for (std::size_t i = 0; i < rows.size(); ++i)
      put(lambda, rows[i], x[3 * i] - x[3 * i + 1] * nu[2 * c] - x[3 * i + 2] * nu[2 * c + 1]);
  }
  double own[PathGroup::capacity];
  for (const Group& group : state_.groups) {
    if (group.live == 0) continue;
    for (Index i = 0; i < group.paths->count(); ++i) own[i] = group.row[i] < 0 ? 0.0 : lambda[at(group.row[i])];
    system_->factor->combine(*group.paths, own, 1, z);
  }
  for (std::size_t g = 0; g < system_->ground_groups.size(); ++g) {
    std::fill(std::begin(own), std::end(own), 0.0);
    for (std::size_t i = 0; i < nu.size(); ++i) {
      if (at(system_->ground_group[i]) == g) own[system_->ground_column[i]] = nu[i];
    }
    system_->factor->combine(*system_->ground_groups[g], own, 1, z);
  }
  system_->factor->backward(z, 1, *core().jobs);
  ++sweeps_;
}

void DirectionSolver::solve_eliminated(Span<const std::complex<double>> values, double* z) const {
  const Span<const Index> row = system_->factor->position();
  Vector<std::uint8_t> gone(at(system_->matrix.size()), 0, &memory());
  for (const Slot& slot : state_.slots) {
    if (slot.vertex >= 0) gone[at(unknown(slot.vertex, 0))] = gone[at(unknown(slot.vertex, 1))] = 1;
  }
  for (std::size_t s = 0; s < state_.slots.size(); ++s) {
    for (Index part = 0; state_.slots[s].vertex >= 0 && part < 2; ++part) {
      const Index u = unknown(state_.slots[s].vertex, part);
      const double value = part ? values[s].imag() : values[s].real();
      for (Index i = system_->matrix.column_start[at(u)]; i < system_->matrix.column_start[at(u) + 1]; ++i) {
        if (!gone[at(system_->matrix.row[at(i)])])
          z[at(row[at(system_->matrix.row[at(i)])])] -= system_->matrix.value[at(i)] * value;
      }
    }
  }
  state_.eliminated->forward(z, 1, *core().jobs);
  state_.eliminated->backward(z, 1, *core().jobs);
  sweeps_ += 2;
}

void DirectionSolver::solve(Span<const std::complex<double>> values, std::complex<double>* field) const {
  Workspace z(core().workspaces, at(system_->matrix.size()));
  std::fill_n(z.data(), at(system_->matrix.size()), 0.0);
  if (state_.eliminated) {
    solve_eliminated(values, z.data());
  } else {
    solve_dense(values, z.data());
  }
  const Span<const Index> row = system_->factor->position();
  for (Index v = 0; v < core().size(); ++v) {
    const bool reached = state_.count[at(component(v))] > 0;
    field[v] = reached ? std::complex<double>(z[at(row[at(unknown(v, 0))])], z[at(row[at(unknown(v, 1))])]) : 0.0;
  }
  for (std::size_t s = 0; s < state_.slots.size(); ++s) {
    if (state_.slots[s].vertex >= 0) field[state_.slots[s].vertex] = values[s];
  }
}

}  // namespace hf_inner

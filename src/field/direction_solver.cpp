#include "field/direction_solver.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/timer.h"
#include "engine/site_cost.h"

namespace hf {
namespace {

using Index = std::int32_t;
std::size_t at(Index i) noexcept { return static_cast<std::size_t>(i); }

struct Columns {
  explicit Columns(Memory& memory) : start(1, 0, &memory), row(&memory), value(&memory) {}
  void append(Index unknown) {
    row.push_back(unknown), value.push_back(1.0);
    start.push_back(static_cast<Index>(row.size()));
  }
  SparseColumns view() const noexcept { return {start, row, value}; }
  Vector<Index> start, row;
  Vector<double> value;
};

}  // namespace

void DirectionSolver::State::swap(State& other) noexcept {
  slots.swap(other.slots), groups.swap(other.groups), blocks.swap(other.blocks), count.swap(other.count);
  std::swap(rows, other.rows), eliminated.swap(other.eliminated);
}

DirectionSolver::DirectionSolver(std::shared_ptr<const Core> core, std::int32_t degree)
    : core_(std::move(core)),
      degree_(degree),
      connection_(Connection::make(core_->mesh, core_->topology, *core_->memory)),
      matrix_(*core_->memory),
      beta_(core_->memory.get()),
      ground_groups_(core_->memory.get()),
      ground_group_(core_->memory.get()),
      ground_column_(core_->memory.get()),
      ground_block_(core_->memory.get()),
      state_(at(core_->mesh.component_count()), *core_->memory) {
  Timer timer;
  make_matrix();
  operator_ms_ = timer.milliseconds();
  make_grounds();
}

Index DirectionSolver::unknown(Index vertex, Index part) const noexcept {
  return 2 * core_->factor->position()[at(vertex)] + part;
}

// Row and column pairs of the real 2 x 2 blocks: w I on the diagonal, -w R between neighbours, R the turn from column
// to row.
void DirectionSolver::make_matrix() {
  const Topology& topology = core_->topology;
  const std::size_t n = at(core_->size());
  const Vector<double> weights =
      edge_weights(core_->mesh, topology, OperatorKind::clamped, memory(), core_->jobs.get());
  const Span<const Index> position = core_->factor->position(), order = core_->factor->order();
  matrix_.column_start.resize(2 * n + 1);
  matrix_.column_start[0] = 0;
  for (std::size_t p = 0; p < n; ++p) {
    const std::size_t v = at(order[p]);
    const Index length = 2 * (topology.neighbour_start[v + 1] - topology.neighbour_start[v] + 1);
    for (std::size_t part = 0; part < 2; ++part)
      matrix_.column_start[2 * p + part + 1] = matrix_.column_start[2 * p + part] + length;
  }
  matrix_.row.resize(at(matrix_.column_start[2 * n])), matrix_.value.resize(matrix_.row.size());
  constexpr std::size_t piece = 8192;
  core_->jobs->for_each(static_cast<std::uint32_t>((n + piece - 1) / piece), [&](std::uint32_t strip) {
    struct Neighbour {
      Index position, vertex, edge;
    };
    Vector<Neighbour> ring(&memory());
    for (std::size_t p = strip * piece; p < std::min(n, (strip + std::size_t{1}) * piece); ++p) {
      const Index v = order[p];
      ring.assign(1, Neighbour{static_cast<Index>(p), v, -1});
      double sum = 0;
      for (Index i = topology.neighbour_start[at(v)]; i < topology.neighbour_start[at(v) + 1]; ++i) {
        const Index w = topology.neighbour[at(i)], e = topology.neighbour_edge[at(i)];
        ring.push_back({position[at(w)], w, e}), sum += weights[at(e)];
      }
      std::sort(ring.begin(), ring.end(),
                [](const Neighbour& a, const Neighbour& b) { return a.position < b.position; });
      Index to[2] = {matrix_.column_start[2 * p], matrix_.column_start[2 * p + 1]};
      for (const Neighbour& other : ring) {
        double block[2][2] = {{sum, 0}, {0, sum}};  // [row part][column part]
        if (other.edge >= 0) {
          const double w = weights[at(other.edge)],
                       turn = degree_ * connection_.turn(topology, other.edge, other.vertex);
          block[0][0] = block[1][1] = -w * std::cos(turn);
          block[1][0] = -w * std::sin(turn), block[0][1] = w * std::sin(turn);
        }
        for (std::size_t column = 0; column < 2; ++column) {
          for (std::size_t row = 0; row < 2; ++row) {
            matrix_.row[at(to[column])] = 2 * other.position + static_cast<Index>(row);
            matrix_.value[at(to[column]++)] = block[row][column];
          }
        }
      }
    }
  });
}

// Grounds, the factor of A, and the grounds' own paths with C.
void DirectionSolver::make_grounds() {
  const std::size_t components = core_->ground.size();
  beta_.assign(components, 0.0);
  Vector<double> count(components, 0.0, &memory());
  const auto diagonal = [&](const SymmetricMatrix& a, Index u) {
    const auto begin = a.row.begin() + a.column_start[at(u)], end = a.row.begin() + a.column_start[at(u) + 1];
    return static_cast<std::size_t>(std::lower_bound(begin, end, u) - a.row.begin());
  };
  for (Index v = 0; v < core_->size(); ++v)
    beta_[at(component(v))] += matrix_.value[diagonal(matrix_, unknown(v, 0))], count[at(component(v))] += 1;
  SymmetricMatrix a(memory());
  a.column_start.assign(matrix_.column_start.begin(), matrix_.column_start.end());
  a.row.assign(matrix_.row.begin(), matrix_.row.end()), a.value.assign(matrix_.value.begin(), matrix_.value.end());
  Columns columns(memory());
  for (std::size_t c = 0; c < components; ++c) {
    beta_[c] = beta_[c] > 0 ? beta_[c] / count[c] : 1.0;
    for (Index part = 0; part < 2; ++part) {
      a.value[diagonal(a, unknown(core_->ground[c], part))] += beta_[c];
      columns.append(unknown(core_->ground[c], part));
    }
  }
  FactorOptions options;
  options.ordering = Ordering::natural;  // the unknowns stand in the order of the surface's factor
  factor_ = Factor::make(a, {}, options, memory(), *core_->jobs);
  ++factorisations_;
  ground_group_.resize(2 * components), ground_column_.resize(2 * components);
  factor_->solve_paths(columns.view(), memory(), *core_->jobs, ground_groups_, ground_group_, ground_column_);
  ground_block_.assign(4 * components, 0.0);
  double tile[PathGroup::capacity * PathGroup::capacity];
  for (std::size_t c = 0; c < components; ++c) {
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t j = 0; j < 2; ++j) {
        const PathGroup &p = *ground_groups_[at(ground_group_[2 * c + i])],
                        &q = *ground_groups_[at(ground_group_[2 * c + j])];
        factor_->gram(p, q, tile, PathGroup::capacity);
        ground_block_[4 * c + 2 * i + j] =
            tile[ground_column_[2 * c + i] * PathGroup::capacity + ground_column_[2 * c + j]] -
            (i == j ? 1 / beta_[c] : 0.0);
      }
    }
  }
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
  const SiteCost cost(factor_->statistics());
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
    if (copy->factorise(*core_->jobs) >= 0)
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
  Columns columns(memory());
  for (const Index slot : slots) {
    for (Index part = 0; part < 2; ++part) columns.append(unknown(state.slots[at(slot)].vertex, part));
  }
  Vector<std::shared_ptr<const PathGroup>> groups(&memory());
  Vector<Index> group(2 * slots.size(), &memory()), column(2 * slots.size(), &memory());
  factor_->solve_paths(columns.view(), memory(), *core_->jobs, groups, group, column);
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
  core_->jobs->for_each(static_cast<std::uint32_t>(state.groups.size() - first_fresh), [&](std::uint32_t piece) {
    const std::size_t a = first_fresh + piece;
    const Group& mine = state.groups[a];
    double tile[PathGroup::capacity * PathGroup::capacity];
    for (std::size_t b = 0; b < state.groups.size() + ground_groups_.size(); ++b) {
      const bool ground = b >= state.groups.size();
      const PathGroup& other = ground ? *ground_groups_[b - state.groups.size()] : *state.groups[b].paths;
      // pairs of new groups from the later one's side for both, so that S is symmetric to the bit
      const bool transposed = !ground && b > a;
      if (transposed) {
        factor_->gram(other, *mine.paths, tile, PathGroup::capacity);
      } else {
        factor_->gram(*mine.paths, other, tile, PathGroup::capacity);
      }
      for (Index i = 0; i < mine.paths->count(); ++i) {
        if (mine.row[i] < 0) continue;
        const Where& here = where[at(mine.row[i])];
        if (ground) {
          for (std::size_t part = 0; part < 2; ++part) {
            const std::size_t g = 2 * at(here.component) + part;
            if (at(ground_group_[g]) == b - state.groups.size())
              state.slots[at(mine.row[i] / 2)].ground[mine.row[i] % 2][part] =
                  tile[i * PathGroup::capacity + ground_column_[g]];
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
    if (open[c]->factorise(*core_->jobs) >= 0)
      fail(HF_ERROR_NOT_POSITIVE_DEFINITE, HF_NO_INDEX,
           "the constraints of component %zu depend on each other; the weights are degenerate", c);
    state.blocks[c] = open[c];
  }
}

// Every constrained vertex out of the matrix; components without one keep their ground.
void DirectionSolver::eliminate(State& state) const {
  state.groups.clear(), state.rows = 0;
  for (auto& block : state.blocks) block.reset();
  Vector<std::uint8_t> gone(at(matrix_.size()), 0, &memory());
  for (Slot& slot : state.slots) {
    if (slot.vertex < 0) continue;
    const Index vertex = slot.vertex;
    slot = Slot{};
    slot.vertex = vertex;
    for (Index part = 0; part < 2; ++part) gone[at(unknown(vertex, part))] = 1;
  }
  SymmetricMatrix a(memory());
  a.column_start.assign(matrix_.column_start.begin(), matrix_.column_start.end());
  a.row.assign(matrix_.row.begin(), matrix_.row.end()), a.value.assign(matrix_.value.begin(), matrix_.value.end());
  for (std::size_t c = 0; c < state.count.size(); ++c) {
    if (state.count[c] > 0) continue;
    for (Index part = 0; part < 2; ++part) {
      const Index u = unknown(core_->ground[c], part);
      const auto begin = a.row.begin() + a.column_start[at(u)], end = a.row.begin() + a.column_start[at(u) + 1];
      a.value[static_cast<std::size_t>(std::lower_bound(begin, end, u) - a.row.begin())] += beta_[c];
    }
  }
  state.eliminated = factor_->refactor(a, gone, memory(), *core_->jobs);
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
      for (std::size_t q = 0; q < 2; ++q) m[p][q] = -ground_block_[4 * c + 2 * p + q];
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
    factor_->combine(*group.paths, own, 1, z);
  }
  for (std::size_t g = 0; g < ground_groups_.size(); ++g) {
    std::fill(std::begin(own), std::end(own), 0.0);
    for (std::size_t i = 0; i < nu.size(); ++i) {
      if (at(ground_group_[i]) == g) own[ground_column_[i]] = nu[i];
    }
    factor_->combine(*ground_groups_[g], own, 1, z);
  }
  factor_->backward(z, 1, *core_->jobs);
  ++sweeps_;
}

void DirectionSolver::solve_eliminated(Span<const std::complex<double>> values, double* z) const {
  const Span<const Index> row = factor_->position();
  Vector<std::uint8_t> gone(at(matrix_.size()), 0, &memory());
  for (const Slot& slot : state_.slots) {
    if (slot.vertex >= 0) gone[at(unknown(slot.vertex, 0))] = gone[at(unknown(slot.vertex, 1))] = 1;
  }
  for (std::size_t s = 0; s < state_.slots.size(); ++s) {
    for (Index part = 0; state_.slots[s].vertex >= 0 && part < 2; ++part) {
      const Index u = unknown(state_.slots[s].vertex, part);
      const double value = part ? values[s].imag() : values[s].real();
      for (Index i = matrix_.column_start[at(u)]; i < matrix_.column_start[at(u) + 1]; ++i) {
        if (!gone[at(matrix_.row[at(i)])]) z[at(row[at(matrix_.row[at(i)])])] -= matrix_.value[at(i)] * value;
      }
    }
  }
  state_.eliminated->forward(z, 1, *core_->jobs);
  state_.eliminated->backward(z, 1, *core_->jobs);
  sweeps_ += 2;
}

void DirectionSolver::solve(Span<const std::complex<double>> values, std::complex<double>* field) const {
  Workspace z(core_->workspaces, at(matrix_.size()));
  std::fill_n(z.data(), at(matrix_.size()), 0.0);
  if (state_.eliminated) {
    solve_eliminated(values, z.data());
  } else {
    solve_dense(values, z.data());
  }
  const Span<const Index> row = factor_->position();
  for (Index v = 0; v < core_->size(); ++v) {
    const bool reached = state_.count[at(component(v))] > 0;
    field[v] = reached ? std::complex<double>(z[at(row[at(unknown(v, 0))])], z[at(row[at(unknown(v, 1))])]) : 0.0;
  }
  for (std::size_t s = 0; s < state_.slots.size(); ++s) {
    if (state_.slots[s].vertex >= 0) field[state_.slots[s].vertex] = values[s];
  }
}

}  // namespace hf

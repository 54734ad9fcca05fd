#include "engine/green.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace hf {
namespace {

using Index = std::int32_t;
std::size_t at(Index i) noexcept { return static_cast<std::size_t>(i); }

// Channels solved in one sweep: wider rows would push the right-hand sides out of the cache.
constexpr Index channel_block = 8;

// Sparse columns of a list of sites.
struct Columns {
  Columns(Span<const Site> sites, Memory& memory) : start(&memory), row(&memory), value(&memory) {
    start.push_back(0);
    for (const Site& site : sites) {
      for (int k = 0; k < 3; ++k) {
        if (site.vertex[k] < 0 || site.weight[k] == 0) continue;
        row.push_back(site.vertex[k]), value.push_back(site.weight[k]);
      }
      start.push_back(static_cast<Index>(row.size()));
    }
  }
  SparseColumns view() const noexcept { return {start, row, value}; }
  Vector<Index> start, row;
  Vector<double> value;
};

}  // namespace

GreenSolver::GreenSolver(std::shared_ptr<const Core> core) : core_(std::move(core)), state_(*core_->memory) {
  state_.blocks.resize(at(core_->mesh.component_count()));
}

GreenSolver::GreenSolver(const GreenSolver& other) : core_(other.core_), state_(other.state_, *other.core_->memory), path_solves_(other.path_solves_.load()), sweeps_(other.sweeps_.load()) {}

EngineCounters GreenSolver::counters() const noexcept {
  EngineCounters counters;
  counters.factorisations = 1;  // that of the core
  counters.path_solves = path_solves_, counters.sweeps = sweeps_;
  for (const Group& group : state_.groups) counters.bytes += group.paths->bytes();
  for (const auto& block : state_.blocks) counters.bytes += block ? block->bytes() : 0.0;
  return counters;
}

Index GreenSolver::site_count(Index component) const noexcept {
  const auto& block = state_.blocks[at(component)];
  return block ? block->count() : 0;
}

void GreenSolver::edit(const SiteEdit& edit) {
  State next(state_, memory());
  remove_sites(next, edit.remove);
  if (!edit.add.empty()) {
    drop_empty_groups(next);
    repack(next);
    add_sites(next, edit);
  }
  std::swap(state_.entries, next.entries);
  std::swap(state_.groups, next.groups);
  std::swap(state_.blocks, next.blocks);
  state_.live = next.live;
}

void GreenSolver::remove_sites(State& state, Span<const Index> slots) const {
  Vector<Index> of_component(&memory());
  Vector<std::uint8_t> done(state.blocks.size(), 0, &memory());
  for (const Index slot : slots) {
    const Index component = state.entries[at(slot)].site.component;
    if (done[at(component)]) continue;
    done[at(component)] = 1;
    of_component.clear();
    for (const Index other : slots) {
      if (state.entries[at(other)].site.component == component) of_component.push_back(other);
    }
    auto& block = state.blocks[at(component)];
    if (block->count() == static_cast<Index>(of_component.size())) {
      block.reset();
      continue;
    }
    const auto copy = make_shared_in<DenseBlock>(memory(), *block);
    copy->remove(of_component);
    if (copy->factorise() >= 0) fail(HF_ERROR_NOT_POSITIVE_DEFINITE, HF_NO_INDEX, "the dense system of the sites lost definiteness; report it with the mesh");
    block = copy;
  }
  for (const Index slot : slots) {
    Entry& entry = state.entries[at(slot)];
    Group& group = state.groups[at(entry.group)];
    group.slot[entry.column] = -1, --group.live;
    entry.group = entry.column = -1;
    --state.live;
  }
}

void GreenSolver::drop_empty_groups(State& state) const {
  Index kept = 0;
  for (std::size_t g = 0; g < state.groups.size(); ++g) {
    if (state.groups[g].live == 0) continue;
    for (const Index slot : state.groups[g].slot) {
      if (slot >= 0) state.entries[at(slot)].group = kept;
    }
    if (at(kept) != g) state.groups[at(kept)] = std::move(state.groups[g]);
    ++kept;
  }
  state.groups.resize(at(kept));
}

// Solves the paths of the sites in `slots` and puts them into new groups.
void GreenSolver::add_paths(State& state, Span<const Index> slots, Vector<Index>& fresh_groups) const {
  Vector<Site> sites(&memory());
  sites.reserve(slots.size());
  for (const Index slot : slots) sites.push_back(state.entries[at(slot)].site);
  const Columns columns(sites, memory());
  Vector<std::shared_ptr<const PathGroup>> groups(&memory());
  Vector<Index> group(slots.size(), &memory()), column(slots.size(), &memory());
  core_->factor->solve_paths(columns.view(), memory(), *core_->jobs, groups, group, column);
  const Index first = static_cast<Index>(state.groups.size());
  for (auto& paths : groups) {
    fresh_groups.push_back(static_cast<Index>(state.groups.size()));
    Group fresh;
    fresh.paths = std::move(paths);
    std::fill(std::begin(fresh.slot), std::end(fresh.slot), -1);
    state.groups.push_back(std::move(fresh));
  }
  for (std::size_t i = 0; i < slots.size(); ++i) {
    Entry& entry = state.entries[at(slots[i])];
    entry.group = first + group[i], entry.column = column[i];
    Group& owner = state.groups[at(entry.group)];
    owner.slot[entry.column] = slots[i], ++owner.live;
  }
  path_solves_ += static_cast<std::uint32_t>(slots.size());
}

// Paths of sites that are gone still stand in their groups. When they outweigh the living, the sparse groups are solved anew.
void GreenSolver::repack(State& state) const {
  std::int64_t stored = 0;
  for (const Group& group : state.groups) stored += group.paths->count();
  if (stored <= 2 * std::int64_t{state.live} + 64) return;
  Vector<Index> moving(&memory()), fresh(&memory());
  for (Group& group : state.groups) {
    if (2 * group.live > group.paths->count()) continue;
    for (const Index slot : group.slot) {
      if (slot >= 0) moving.push_back(slot);
    }
    group.live = 0;
    std::fill(std::begin(group.slot), std::end(group.slot), -1);
  }
  if (!moving.empty()) add_paths(state, moving, fresh);
  drop_empty_groups(state);
}

void GreenSolver::add_sites(State& state, const SiteEdit& edit) const {
  Index slots = static_cast<Index>(state.entries.size());
  for (const Index slot : edit.add) slots = std::max(slots, slot + 1);
  state.entries.resize(at(slots));
  for (std::size_t i = 0; i < edit.add.size(); ++i) state.entries[at(edit.add[i])].site = edit.sites[i];
  Vector<Index> fresh(&memory());
  add_paths(state, edit.add, fresh);
  state.live += static_cast<Index>(edit.add.size());

  // row of every slot in its block: those there are, then the new ones in the order of the edit
  Vector<Index> row(at(slots), -1, &memory());
  Vector<Index> next_row(state.blocks.size(), 0, &memory());
  for (std::size_t c = 0; c < state.blocks.size(); ++c) {
    if (!state.blocks[c]) continue;
    for (const Index slot : state.blocks[c]->ids()) row[at(slot)] = next_row[c]++;
  }
  Vector<std::size_t> start(edit.add.size() + 1, 0, &memory());  // rows of S of the new sites, one after the other
  for (std::size_t i = 0; i < edit.add.size(); ++i) {
    const Index r = next_row[at(edit.sites[i].component)]++;
    row[at(edit.add[i])] = r;
    start[i + 1] = start[i] + at(r) + 1;
  }
  Vector<Index> position(at(slots), -1, &memory());  // in the batch
  for (std::size_t i = 0; i < edit.add.size(); ++i) position[at(edit.add[i])] = static_cast<Index>(i);
  Vector<double> rows(start.back(), 0.0, &memory());

  // Gram of every new group with every group up to itself; a piece writes only rows of its own new group
  const Index first_fresh = fresh.front();
  core_->jobs->for_each(static_cast<std::uint32_t>(fresh.size()), [&](std::uint32_t piece) {
    const Index a = fresh[piece];
    double tile[PathGroup::capacity * PathGroup::capacity];
    const auto scatter = [&](const Group& mine, const Group& other, bool transposed) {
      for (Index i = 0; i < mine.paths->count(); ++i) {
        const Index slot = mine.slot[i];
        if (slot < 0) continue;
        for (Index j = 0; j < other.paths->count(); ++j) {
          const Index peer = other.slot[j];
          if (peer < 0 || state.entries[at(peer)].site.component != state.entries[at(slot)].site.component || row[at(peer)] > row[at(slot)]) continue;
          rows[start[at(position[at(slot)])] + at(row[at(peer)])] = transposed ? tile[j * PathGroup::capacity + i] : tile[i * PathGroup::capacity + j];
        }
      }
    };
    const Group& mine = state.groups[at(a)];
    for (Index b = 0; b < static_cast<Index>(state.groups.size()); ++b) {
      const Group& other = state.groups[at(b)];
      // pairs of new groups are computed from the later one's side for both, so that S is symmetric to the bit
      if (b >= first_fresh && b > a) {
        core_->factor->gram(*other.paths, *mine.paths, tile, PathGroup::capacity);
        scatter(mine, other, true);
      } else {
        core_->factor->gram(*mine.paths, *other.paths, tile, PathGroup::capacity);
        scatter(mine, other, false);
      }
    }
  });

  Vector<std::uint8_t> copied(state.blocks.size(), 0, &memory());
  Vector<std::shared_ptr<DenseBlock>> open(state.blocks.size(), &memory());
  for (std::size_t i = 0; i < edit.add.size(); ++i) {
    const std::size_t c = at(edit.sites[i].component);
    if (!open[c]) open[c] = state.blocks[c] ? make_shared_in<DenseBlock>(memory(), *state.blocks[c]) : make_shared_in<DenseBlock>(memory(), memory());
    double* s = rows.data() + start[i];
    s[at(row[at(edit.add[i])])] += edit.sites[i].compliance / core_->mean_diagonal[c];
    open[c]->append(edit.add[i], s);
  }
  for (std::size_t c = 0; c < open.size(); ++c) {
    if (!open[c]) continue;
    const Index lost = open[c]->factorise();
    if (lost >= 0) {
      const Index slot = open[c]->ids()[at(lost)];
      const Index i = position[at(slot)];
      fail(HF_ERROR_CONFLICT, i >= 0 ? static_cast<std::uint32_t>(i) : HF_NO_INDEX,
           "site %d of the batch depends linearly on hard sites that are there (at most three independent points fit into one triangle); leave it out or make it soft", i);
    }
    state.blocks[c] = open[c];
  }
}

void GreenSolver::solve_dense(const double* values, Index channels, Index first, Index count, Vector<double>& lambda, Vector<double>& constant) const {
  const std::size_t m = at(count);
  lambda.assign(state_.entries.size() * m, 0.0);
  constant.assign(state_.blocks.size() * m, 0.0);
  Vector<double> x(&memory());
  for (std::size_t c = 0; c < state_.blocks.size(); ++c) {
    const DenseBlock* block = state_.blocks[c].get();
    if (!block) continue;
    const Span<const Index> slots = block->ids();
    double* a = constant.data() + c * m;
    // centre the values: a large common offset must not cost digits
    for (const Index slot : slots) {
      for (std::size_t k = 0; k < m; ++k) a[k] += values[at(slot) * at(channels) + at(first) + k] / static_cast<double>(slots.size());
    }
    x.resize(slots.size() * m);
    for (std::size_t i = 0; i < slots.size(); ++i) {
      for (std::size_t k = 0; k < m; ++k) x[i * m + k] = values[at(slots[i]) * at(channels) + at(first) + k] - a[k];
    }
    block->solve(x.data(), count);
    for (std::size_t k = 0; k < m; ++k) {
      double sum = 0;
      for (std::size_t i = 0; i < slots.size(); ++i) sum += x[i * m + k];
      const double shift = sum / block->ones_sum();
      for (std::size_t i = 0; i < slots.size(); ++i) lambda[at(slots[i]) * m + k] = x[i * m + k] - shift * block->ones()[i];
      a[k] += shift;
    }
  }
}

void GreenSolver::combine(const Vector<double>& lambda, Index channels, double* z) const {
  double own[PathGroup::capacity * channel_block];
  const std::size_t m = at(channels);
  for (const Group& group : state_.groups) {
    if (group.live == 0) continue;
    for (Index i = 0; i < group.paths->count(); ++i) {
      for (std::size_t k = 0; k < m; ++k) own[at(i) * m + k] = group.slot[i] < 0 ? 0.0 : lambda[at(group.slot[i]) * m + k];
    }
    core_->factor->combine(*group.paths, own, channels, z);
  }
}

void GreenSolver::solve(const double* values, Index channels, double* field, double* flux) const {
  const std::size_t n = at(core_->size());
  Vector<double> lambda(&memory()), constant(&memory());
  for (Index first = 0; first < channels; first += channel_block) {
    const Index count = std::min(channel_block, channels - first);
    const std::size_t m = at(count), stride = at(channels);
    solve_dense(values, channels, first, count, lambda, constant);
    if (flux) {
      for (std::size_t slot = 0; slot < state_.entries.size(); ++slot) {
        for (std::size_t k = 0; k < m; ++k) flux[slot * stride + at(first) + k] = lambda[slot * m + k];
      }
    }
    if (!field) continue;
    Workspace z(core_->workspaces, n * m);
    std::fill_n(z.data(), n * m, 0.0);
    combine(lambda, count, z.data());
    core_->factor->backward(z.data(), count, *core_->jobs);
    ++sweeps_;

    const Span<const Index> position = core_->factor->position();
    constexpr std::size_t piece = 16384;
    core_->jobs->for_each(static_cast<std::uint32_t>((n + piece - 1) / piece), [&](std::uint32_t p) {
      const std::size_t end = std::min(n, (p + std::size_t{1}) * piece);
      for (std::size_t v = p * piece; v < end; ++v) {
        const std::size_t c = at(core_->mesh.component[v]);
        const bool reached = state_.blocks[c] != nullptr;
        for (std::size_t k = 0; k < m; ++k) field[v * stride + at(first) + k] = reached ? z[at(position[v]) * m + k] + constant[c * m + k] : 0.0;
      }
    });
  }
  if (!field) return;
  for (std::size_t slot = 0; slot < state_.entries.size(); ++slot) {
    const Entry& entry = state_.entries[slot];
    if (entry.group < 0 || !entry.site.is_vertex() || entry.site.compliance != 0) continue;
    std::copy_n(values + slot * at(channels), channels, field + at(entry.site.vertex[0]) * at(channels));
  }
}

void GreenSolver::solve_at(const double* values, Index channels, Span<const Index> vertices, double* out) const {
  const std::size_t n = at(core_->size()), stride = at(channels);
  Vector<Site> sites(&memory());
  sites.reserve(vertices.size());
  for (const Index v : vertices) sites.push_back(Site::at_vertex(core_->mesh, v));
  const Columns columns(sites, memory());
  Vector<std::shared_ptr<const PathGroup>> groups(&memory());
  Vector<Index> group(vertices.size(), &memory()), column(vertices.size(), &memory());
  core_->factor->solve_paths(columns.view(), memory(), *core_->jobs, groups, group, column);
  path_solves_ += static_cast<std::uint32_t>(vertices.size());

  Vector<double> lambda(&memory()), constant(&memory());
  Vector<double> probe(groups.size() * PathGroup::capacity * channel_block, &memory());
  for (Index first = 0; first < channels; first += channel_block) {
    const Index count = std::min(channel_block, channels - first);
    const std::size_t m = at(count);
    solve_dense(values, channels, first, count, lambda, constant);
    Workspace z(core_->zeroed_workspaces, n * m);
    z.soil();
    combine(lambda, count, z.data());
    for (std::size_t g = 0; g < groups.size(); ++g) core_->factor->project(*groups[g], z.data(), count, probe.data() + g * PathGroup::capacity * m);
    for (const Group& used : state_.groups) core_->factor->clear(*used.paths, count, z.data());
    z.clean();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const std::size_t c = at(core_->mesh.component[at(vertices[i])]);
      const double* y = probe.data() + (at(group[i]) * PathGroup::capacity + at(column[i])) * m;
      for (std::size_t k = 0; k < m; ++k) out[i * stride + at(first) + k] = state_.blocks[c] ? y[k] + constant[c * m + k] : 0.0;
    }
  }
  // hard sites among the vertices hold their values
  for (std::size_t slot = 0; slot < state_.entries.size(); ++slot) {
    const Entry& entry = state_.entries[slot];
    if (entry.group < 0 || !entry.site.is_vertex() || entry.site.compliance != 0) continue;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (vertices[i] == entry.site.vertex[0]) std::copy_n(values + slot * stride, channels, out + i * stride);
    }
  }
}

}  // namespace hf

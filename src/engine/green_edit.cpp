// The edits of engine green: which rows leave the dense system, which come, and when the sites move into the factor or
// back.
#include <algorithm>

#include "base/error.h"
#include "base/index.h"
#include "engine/dependence.h"
#include "engine/green.h"
#include "engine/site_cost.h"
#include "engine/sparse_sites.h"

namespace hf_inner {
namespace {

// An edit cannot go on from the present layout: a component lost its last eliminated site, or signs came out mixed.
struct NeedsNewLayout {};

}  // namespace

void GreenSolver::edit(const SiteEdit& edit) {
  Decision decision = decide(edit);
  if (decision.route == EditRoute::dense) {
    State next(state_, memory());
    try {
      apply(next, edit);
      next.decision = decision;
      state_.swap(next);
      ++dense_edits_;
      return;
    } catch (const NeedsNewLayout&) {
      decision.route = EditRoute::fresh;
    }
  }
  State next = with_sites(edit);
  place_all(next, edit, decision.route == EditRoute::rebase);
  next.decision = decision;
  state_.swap(next);
}

void GreenSolver::rebase(JobRunner& jobs) {
  const SiteEdit nothing;
  State next = with_sites(nothing);
  bool hard = false;
  for (const Entry& entry : next.entries)
    hard = hard || (entry.used() && entry.site.is_vertex() && entry.site.compliance == 0);
  if (!hard) fail(HF_ERROR_NO_SITES, HF_NO_INDEX, "no hard site on a vertex: there is nothing to move into the factor");
  runner_ = &jobs;
  try {
    place_all(next, nothing, true);
  } catch (...) {
    runner_ = nullptr;
    throw;
  }
  runner_ = nullptr;
  next.decision.route = EditRoute::rebase;
  state_.swap(next);
}

// Compares going on with starting over, plainly or with the hard vertex sites eliminated.
GreenSolver::Decision GreenSolver::decide(const SiteEdit& edit) const {
  const SiteCost cost(core_->factor->statistics());
  double sites = 0, hard = 0, soft_removed = 0, freed = 0;
  for (const Entry& entry : state_.entries) {
    if (!entry.used()) continue;
    ++sites, hard += entry.site.is_vertex() && entry.site.compliance == 0;
  }
  for (const Index slot : edit.remove) {
    const Entry& entry = state_.entries[at(slot)];
    hard -= entry.site.is_vertex() && entry.site.compliance == 0;
    freed += entry.eliminated >= 0;
    soft_removed += entry.eliminated < 0;
  }
  for (const Site& site : edit.sites) hard += site.is_vertex() && site.compliance == 0;
  sites += static_cast<double>(edit.add.size()) - static_cast<double>(edit.remove.size());

  const double kept = std::max(0.0, static_cast<double>(state_.rows) - soft_removed);
  const double going_on = cost.dense_ns(kept, static_cast<double>(edit.add.size()) + freed);
  const double plain = cost.dense_ns(0, sites), rebase = cost.rebase_ns(sites - hard);
  const bool eliminate = hard > 0 && rebase < plain;
  Decision decision;
  decision.dense_ms = std::min(going_on, plain) / 1e6, decision.rebase_ms = hard > 0 ? rebase / 1e6 : 0;
  decision.route = !(going_on > 1.25 * std::min(plain, hard > 0 ? rebase : plain)) ? EditRoute::dense
                   : eliminate                                                     ? EditRoute::rebase
                                                                                   : EditRoute::fresh;
  return decision;
}

// The sites there will be, nothing placed yet.
GreenSolver::State GreenSolver::with_sites(const SiteEdit& edit) const {
  State next(core_->mesh.component_count(), memory());
  next.entries.assign(state_.entries.begin(), state_.entries.end());
  for (const Index slot : edit.remove) next.entries[at(slot)] = Entry{};
  for (std::size_t i = 0; i < edit.add.size(); ++i) {
    if (next.entries.size() <= at(edit.add[i])) next.entries.resize(at(edit.add[i]) + 1);
    next.entries[at(edit.add[i])] = Entry{};
    next.entries[at(edit.add[i])].site = edit.sites[i];
  }
  for (Entry& entry : next.entries) {
    entry.path = Path{}, entry.eliminated = -1;
    if (entry.used()) ++next.sites_of[at(entry.site.component)];
  }
  return next;
}

void GreenSolver::place_all(State& state, const SiteEdit& edit, bool eliminate) const {
  if (eliminate) {
    Vector<Index> vertices(&memory());
    for (Entry& entry : state.entries) {
      if (!entry.used() || !entry.site.is_vertex() || entry.site.compliance != 0) continue;
      entry.eliminated = static_cast<Index>(vertices.size());
      vertices.push_back(entry.site.vertex[0]);
    }
    state.base = EliminatedBase::make(*core_, vertices, jobs());
    state.freed.resize(vertices.size());
    ++rebases_;
  }
  Vector<Addition> additions(&memory());
  for (std::size_t slot = 0; slot < state.entries.size(); ++slot) {
    const Entry& entry = state.entries[slot];
    if (entry.used() && entry.eliminated < 0)
      additions.push_back({static_cast<Index>(slot), entry.site.component, true});
  }
  add_rows(state, additions, edit);
}

void GreenSolver::apply(State& state, const SiteEdit& edit) const {
  Vector<Addition> additions(&memory());
  if (!remove_sites(state, edit.remove, additions)) throw NeedsNewLayout{};
  Vector<Index> returning(&memory()), components(&memory());
  for (std::size_t i = 0; i < edit.add.size(); ++i) {
    const Site& site = edit.sites[i];
    if (state.entries.size() <= at(edit.add[i])) state.entries.resize(at(edit.add[i]) + 1);
    Entry& entry = state.entries[at(edit.add[i])];
    entry.site = site;
    ++state.sites_of[at(site.component)];
    const Index b =
        state.base && site.is_vertex() && site.compliance == 0 ? state.base->index_of[at(site.vertex[0])] : -1;
    if (b < 0) {
      additions.push_back({edit.add[i], site.component, true});
      continue;
    }
    // a hard site on an eliminated vertex: its value is given again
    entry.eliminated = b;
    const auto pending =
        std::find_if(additions.begin(), additions.end(), [&](const Addition& a) { return a.row == free_row(b); });
    if (pending != additions.end()) {
      additions.erase(pending);
    } else {
      returning.push_back(free_row(b)), components.push_back(site.component);
    }
  }
  remove_rows(state, returning, components);
  for (std::size_t c = 0; state.base && c < state.base->floating.size(); ++c) {
    if (state.base->floating[c]) continue;
    // an eliminated component needs a site in force there, or its free values hang in the air
    bool in_force = false;
    for (const Entry& entry : state.entries)
      in_force = in_force || (entry.used() && entry.eliminated >= 0 && at(entry.site.component) == c);
    if (!in_force) throw NeedsNewLayout{};
  }
  if (additions.empty()) return;
  drop_empty_groups(state);
  repack(state);
  add_rows(state, additions, edit);
}

// Removes the rows of sites; eliminated ones are freed, which appends a row each. False: a new layout is needed.
bool GreenSolver::remove_sites(State& state, Span<const Index> slots, Vector<Addition>& additions) const {
  Vector<Index> rows(&memory()), components(&memory());
  for (const Index slot : slots) {
    Entry& entry = state.entries[at(slot)];
    --state.sites_of[at(entry.site.component)];
    if (entry.eliminated >= 0) {
      additions.push_back({free_row(entry.eliminated), entry.site.component, false});
    } else {
      rows.push_back(slot), components.push_back(entry.site.component);
    }
  }
  remove_rows(state, rows, components);
  for (const Index slot : slots) state.entries[at(slot)] = Entry{};
  return true;
}

void GreenSolver::remove_rows(State& state, Span<const Index> rows, Span<const Index> components) const {
  Vector<Index> of_component(&memory());
  Vector<std::uint8_t> done(state.blocks.size(), 0, &memory());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Index component = components[r];
    if (done[at(component)]) continue;
    done[at(component)] = 1;
    of_component.clear();
    for (std::size_t q = r; q < rows.size(); ++q) {
      if (components[q] == component) of_component.push_back(rows[q]);
    }
    auto& block = state.blocks[at(component)];
    if (block->count() == static_cast<Index>(of_component.size())) {
      block.reset();
      continue;
    }
    const auto copy = make_shared_in<DenseBlock>(memory(), *block);
    copy->remove(of_component);
    if (copy->factorise(jobs()) >= 0) throw NeedsNewLayout{};
    block = copy;
  }
  for (const Index row : rows) {
    Path& path = path_of(state, row);
    Group& group = state.groups[at(path.group)];
    group.row[path.column] = nobody, --group.live;
    path = Path{};
    --state.rows;
  }
}

void GreenSolver::drop_empty_groups(State& state) const {
  Index kept = 0;
  for (std::size_t g = 0; g < state.groups.size(); ++g) {
    if (state.groups[g].live == 0) continue;
    for (const Index row : state.groups[g].row) {
      if (row != nobody) path_of(state, row).group = kept;
    }
    if (at(kept) != g) state.groups[at(kept)] = std::move(state.groups[g]);
    ++kept;
  }
  state.groups.resize(at(kept));
}

// Solves the paths of these rows and puts them into new groups at the end.
void GreenSolver::add_paths(State& state, Span<const Index> rows) const {
  SiteColumns columns(memory());
  for (const Index row : rows) {
    if (row >= 0) {
      columns.append(state.entries[at(row)].site, state.base.get());
    } else {
      columns.append_free(state.base->vertex[at(base_index(row))], core_->laplacian, *state.base);
    }
  }
  Vector<std::shared_ptr<const PathGroup>> groups(&memory());
  Vector<Index> group(rows.size(), &memory()), column(rows.size(), &memory());
  factor(state).solve_paths(columns.view(), memory(), jobs(), groups, group, column);
  const Index first = static_cast<Index>(state.groups.size());
  for (auto& paths : groups) {
    Group fresh;
    fresh.paths = std::move(paths);
    std::fill(std::begin(fresh.row), std::end(fresh.row), nobody);
    state.groups.push_back(std::move(fresh));
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Path path{first + group[i], column[i]};
    path_of(state, rows[i]) = path;
    Group& owner = state.groups[at(path.group)];
    owner.row[path.column] = rows[i], ++owner.live;
  }
  path_solves_ += static_cast<std::uint32_t>(rows.size());
}

// The slot of a hard site of the component that depends on others though its pivot was left with some rounding, or -1.
// Who came in this edit is named before who was there. Among eliminated sites the diagonal itself may be rounding (a
// point whose corners are eliminated has none), so pivots say nothing and every site that came is looked at.
GreenSolver::Index GreenSolver::crowded_out(const State& state, const SiteEdit& edit, const DenseBlock& block,
                                            Index component) const {
  constexpr double small = 1e-6;
  if (!state.base && block.least_pivot() >= small) return -1;
  Vector<HardSite> sites(&memory());
  Vector<Index> place(state.entries.size(), -1, &memory());
  const auto take = [&](Index slot) {
    const Site& site = state.entries[at(slot)].site;
    if (site.component != component || site.compliance != 0 || place[at(slot)] >= 0) return;
    place[at(slot)] = static_cast<Index>(sites.size());
    sites.push_back({&site, slot, false});
  };
  Vector<std::uint8_t> is_new(state.entries.size(), 0, &memory());
  for (const Index slot : edit.add) is_new[at(slot)] = 1;
  for (Index slot = 0; at(slot) < state.entries.size(); ++slot) {
    if (!is_new[at(slot)]) take(slot);
  }
  for (const Index slot : edit.add) take(slot);
  const auto suspect = [&](Index slot) {
    if (slot >= 0 && place[at(slot)] >= 0) sites[at(place[at(slot)])].suspect = true;
  };
  for (Index i = 0; i < block.count() && !state.base; ++i) {
    if (block.pivot_share(i) < small) suspect(block.ids()[at(i)]);
  }
  for (std::size_t i = 0; i < edit.add.size() && state.base; ++i) suspect(edit.add[i]);
  return dependent_site({sites.data(), sites.size()}, memory());
}

// Paths of rows that are gone still stand in their groups. When they outweigh the living, the sparse groups are solved
// anew.
void GreenSolver::repack(State& state) const {
  std::int64_t stored = 0;
  for (const Group& group : state.groups) stored += group.paths->count();
  if (stored <= 2 * std::int64_t{state.rows} + 64) return;
  Vector<Index> moving(&memory());
  for (Group& group : state.groups) {
    if (2 * group.live > group.paths->count()) continue;
    for (Index& row : group.row) {
      if (row != nobody) moving.push_back(row), row = nobody;
    }
    group.live = 0;
  }
  if (!moving.empty()) add_paths(state, moving);
  drop_empty_groups(state);
}

void GreenSolver::add_rows(State& state, Span<const Addition> additions, const SiteEdit& edit) const {
  if (additions.empty()) return;
  Vector<Index> rows(&memory());
  for (const Addition& addition : additions) rows.push_back(addition.row);
  const Index first_fresh = static_cast<Index>(state.groups.size());
  add_paths(state, rows);
  state.rows += static_cast<Index>(additions.size());

  // place of every row in its block: those there are, then the new ones in order; and its number in the batch
  struct Where {
    Index place = -1, batch = -1, component = -1;
  };
  Vector<Where> of_slot(state.entries.size(), &memory()), of_free(state.freed.size(), &memory());
  const auto where = [&](Index row) -> Where& { return row >= 0 ? of_slot[at(row)] : of_free[at(base_index(row))]; };
  Vector<Index> next_place(state.blocks.size(), 0, &memory());
  for (std::size_t c = 0; c < state.blocks.size(); ++c) {
    if (!state.blocks[c]) continue;
    for (const Index row : state.blocks[c]->ids()) where(row) = {next_place[c]++, -1, static_cast<Index>(c)};
  }
  Vector<std::size_t> start(additions.size() + 1, 0, &memory());  // the new rows of M, one after the other
  for (std::size_t i = 0; i < additions.size(); ++i) {
    const Index place = next_place[at(additions[i].component)]++;
    where(additions[i].row) = {place, static_cast<Index>(i), additions[i].component};
    start[i + 1] = start[i] + at(place) + 1;
  }
  Vector<double> values(start.back(), 0.0, &memory());

  // Gram of every new group with itself and every group before it: one piece a pair of groups, one entry a pair of rows
  struct Pair {
    Index a, b;
  };
  Vector<Pair> pairs(&memory());
  for (Index a = first_fresh; a < static_cast<Index>(state.groups.size()); ++a) {
    for (Index b = 0; b <= a; ++b) pairs.push_back({a, b});
  }
  jobs().for_each(static_cast<std::uint32_t>(pairs.size()), [&](std::uint32_t piece) {
    const Group& mine = state.groups[at(pairs[piece].a)];
    const Group& other = state.groups[at(pairs[piece].b)];
    double tile[PathGroup::capacity * PathGroup::capacity];
    factor(state).gram(*mine.paths, *other.paths, tile, PathGroup::capacity);
    const bool own = &mine == &other;
    for (Index i = 0; i < mine.paths->count(); ++i) {
      if (mine.row[i] == nobody) continue;
      const Where& x = where(mine.row[i]);
      for (Index j = 0; j < (own ? i + 1 : other.paths->count()); ++j) {
        if (other.row[j] == nobody) continue;
        const Where& y = where(other.row[j]);
        if (x.component != y.component) continue;
        const Where& later = x.place > y.place ? x : y;
        const Where& earlier = x.place > y.place ? y : x;
        values[start[at(later.batch)] + at(earlier.place)] = tile[i * PathGroup::capacity + j];
      }
    }
  });

  // what the eliminated vertices add: W_R between a site and a free value, -K_RR between free values; D on the diagonal
  // of soft sites
  const auto entry_of = [&](const Where& x, const Where& y) -> double* {
    if (x.component != y.component) return nullptr;
    const Where& later = x.place > y.place ? x : y;
    const Where& earlier = x.place > y.place ? y : x;
    return later.batch < 0 ? nullptr : &values[start[at(later.batch)] + at(earlier.place)];
  };
  for (const Addition& addition : additions) {
    const Where& here = where(addition.row);
    if (addition.row >= 0) {
      const Site& site = state.entries[at(addition.row)].site;
      *entry_of(here, here) += site.compliance / core_->mean_diagonal[at(site.component)];
    }
  }
  for (std::size_t b = 0; state.base && b < state.freed.size(); ++b) {
    const Where& free = of_free[b];
    if (free.place < 0) continue;
    const Index r = state.base->vertex[b];
    const SymmetricMatrix& k = core_->laplacian;
    for (Index i = k.column_start[at(r)]; i < k.column_start[at(r) + 1]; ++i) {
      const Index other = state.base->index_of[at(k.row[at(i)])];
      if (other < 0 || of_free[at(other)].place < 0 || of_free[at(other)].place > free.place) continue;
      if (double* m = entry_of(free, of_free[at(other)])) *m -= k.value[at(i)];
    }
    for (std::size_t slot = 0; slot < state.entries.size(); ++slot) {
      if (of_slot[slot].place < 0) continue;
      const Site& site = state.entries[slot].site;
      for (int c = 0; c < 3; ++c) {
        if (site.vertex[c] != r) continue;
        if (double* m = entry_of(free, of_slot[slot])) *m += site.weight[c];
      }
    }
  }

  Vector<std::shared_ptr<DenseBlock>> open(state.blocks.size(), &memory());
  for (std::size_t i = 0; i < additions.size(); ++i) {
    const std::size_t c = at(additions[i].component);
    if (!open[c])
      open[c] = state.blocks[c] ? make_shared_in<DenseBlock>(memory(), *state.blocks[c])
                                : make_shared_in<DenseBlock>(memory(), memory());
    open[c]->append(additions[i].row, values.data() + start[i], additions[i].positive);
  }
  for (std::size_t c = 0; c < open.size(); ++c) {
    if (!open[c]) continue;
    const Index lost = open[c]->factorise(jobs());
    // with eliminated sites about, the order of the rows may be at fault: a plain layout decides
    if (lost >= 0 && state.base) throw NeedsNewLayout{};
    const Index slot = lost >= 0 ? open[c]->ids()[at(lost)] : crowded_out(state, edit, *open[c], static_cast<Index>(c));
    if (slot >= 0) {
      const auto found = std::find(edit.add.begin(), edit.add.end(), slot);
      const std::uint32_t position =
          found == edit.add.end() ? HF_NO_INDEX : static_cast<std::uint32_t>(found - edit.add.begin());
      fail(HF_ERROR_CONFLICT, position,
           "site %u of the batch depends linearly on hard sites that are there (a triangle takes three independent "
           "points); leave it out or make it soft",
           position);
    }
    state.blocks[c] = open[c];
  }
}

}  // namespace hf_inner

#include "solve/constraint_system_edit.h"

#include <algorithm>

#include "base/error.h"
#include "solve/dependence.h"
#include "solve/sparse_sites.h"
#include "surface/vertex_map.h"

namespace hf_inner::solve {
namespace {

constexpr auto no_row = ConstraintState::no_row;

// Groups of elimination paths are packed again when they store more than stored_share times the paths in use plus
// stored_slack. Smaller numbers pack sooner, which solves paths again. Larger numbers keep unused paths in memory and
// in every sweep. Half and double of both change no bit where 150 of 300 sites leave eight shapes.
constexpr std::int64_t stored_share = 2, stored_slack = 2 * factor::PathGroup::capacity;

}  // namespace

// The new rows of an edit before they go into the dense blocks (one matrix M per component): their places there, and
// their entries of M.
struct ConstraintEdit::Batch {
  struct Where {
    Index place = -1, batch = -1, component = -1;  // batch: number among the new rows, or -1
  };
  Batch(const ConstraintState& state, Span<const Row> given, Memory& memory)
      : rows(given),
        of_slot(state.entries.size(), &memory),
        of_free(state.freed.size(), &memory),
        start(given.size() + 1, 0, &memory),
        values(&memory) {
    Vector<Index> next_place(state.blocks.size(), 0, &memory);
    for (std::size_t c = 0; c < state.blocks.size(); ++c) {
      if (!state.blocks[c]) continue;
      for (const Index row : state.blocks[c]->ids()) where(row) = {next_place[c]++, -1, static_cast<Index>(c)};
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Index place = next_place[at(rows[i].component)]++;
      where(rows[i].row) = {place, static_cast<Index>(i), rows[i].component};
      start[i + 1] = start[i] + at(place) + 1;
    }
    values.assign(start.back(), 0.0);
  }
  Where& where(Index row) noexcept {
    return row >= 0 ? of_slot[at(row)] : of_free[at(ConstraintState::base_index(row))];
  }
  // Returns the entry M(x, y) of the dense matrix for rows x and y, or null if both rows are old or lie in different
  // blocks.
  double* entry(const Where& x, const Where& y) noexcept {
    if (x.component != y.component) return nullptr;
    const Where& later = x.place > y.place ? x : y;
    const Where& earlier = x.place > y.place ? y : x;
    return later.batch < 0 ? nullptr : &values[start[at(later.batch)] + at(earlier.place)];
  }
  Span<const Row> rows;
  Vector<Where> of_slot, of_free;
  Vector<std::size_t> start;
  Vector<double> values;
};

void ConstraintEdit::start_over(Index end) {
  ConstraintState next(state_.blocks.size(), memory());
  next.entries.swap(state_.entries);
  for (const Index slot : edit_.remove) next.entries[at(slot)] = {};
  state_.swap(next);
  for (std::size_t i = 0; i < edit_.add.size(); ++i) state_.put(edit_.add[i], edit_.sites[i]);
  Vector<Index> unknowns(&memory()), components(&memory());
  Vector<Row> rows(&memory());
  for (std::size_t slot = 0; slot < state_.entries.size(); ++slot) {
    auto& entry = state_.entries[slot];
    entry.path = {};
    entry.eliminated = -1;
    if (!entry.used()) continue;
    ++state_.sites_of[at(entry.site.component)];
    if (static_cast<Index>(slot) < end && entry.site.is_hard_vertex()) {
      entry.eliminated = static_cast<Index>(unknowns.size());
      unknowns.push_back(entry.site.vertex[0]);
      components.push_back(entry.site.component);
    } else {
      rows.push_back({static_cast<Index>(slot), entry.site.component});
    }
  }
  if (!unknowns.empty()) {
    state_.base = EliminatedBase::make(operator_, unknowns, components, jobs_);
    state_.freed.resize(unknowns.size());
    ++factorisations_;
  }
  add_rows(rows);
}

void ConstraintEdit::go_on() {
  Vector<Row> coming(&memory());
  remove_sites(coming);
  place_sites(coming);
  check_bases();
  if (coming.empty()) return;
  drop_empty_groups();
  repack();
  add_rows(coming);
}

// Removes the dense rows of the removed sites. If a site was eliminated in the factor, its value becomes unknown
// (free), which adds a row.
void ConstraintEdit::remove_sites(Vector<Row>& coming) {
  Vector<Row> leaving(&memory());
  for (const Index slot : edit_.remove) {
    const auto& entry = state_.entries[at(slot)];
    --state_.sites_of[at(entry.site.component)];
    if (entry.eliminated >= 0) {
      coming.push_back({ConstraintState::free_row(entry.eliminated), entry.site.component});
    } else {
      leaving.push_back({slot, entry.site.component});
    }
  }
  remove_rows(leaving);
  for (const Index slot : edit_.remove) state_.entries[at(slot)] = {};
}

void ConstraintEdit::place_sites(Vector<Row>& coming) {
  Vector<Row> returning(&memory());
  for (std::size_t i = 0; i < edit_.add.size(); ++i) {
    const Site& site = edit_.sites[i];
    state_.put(edit_.add[i], site);
    ++state_.sites_of[at(site.component)];
    const Index b = state_.base && site.is_hard_vertex() ? state_.base->index_of[at(site.vertex[0])] : -1;
    if (b < 0) {
      coming.push_back({edit_.add[i], site.component});
      continue;
    }
    // The vertex of this hard site is eliminated in the factor, so its value is no longer unknown.
    state_.entries[at(edit_.add[i])].eliminated = b;
    const Index row = ConstraintState::free_row(b);
    const auto pending = std::find_if(coming.begin(), coming.end(), [&](const Row& r) { return r.row == row; });
    if (pending != coming.end()) {
      coming.erase(pending);
    } else {
      returning.push_back({row, site.component});
    }
  }
  remove_rows(returning);
}

// Throws NeedsNewLayout if the sites of all eliminated vertices of a component were removed: its system would be
// singular.
void ConstraintEdit::check_bases() const {
  if (!state_.base) return;
  Vector<std::uint8_t> in_force(state_.base->floating, &memory());
  for (const auto& entry : state_.entries) {
    if (entry.used() && entry.eliminated >= 0) in_force[at(entry.site.component)] = 1;
  }
  if (std::find(in_force.begin(), in_force.end(), 0) != in_force.end()) throw NeedsNewLayout{};
}

void ConstraintEdit::remove_rows(Span<const Row> rows) {
  Vector<Index> ids(&memory());
  Vector<std::uint8_t> done(state_.blocks.size(), 0, &memory());
  for (const Row& first : rows) {
    if (done[at(first.component)]) continue;
    done[at(first.component)] = 1;
    ids.clear();
    for (const Row& row : rows) {
      if (row.component == first.component) ids.push_back(row.row);
    }
    auto& block = state_.blocks[at(first.component)];
    if (block->count() == static_cast<Index>(ids.size())) {
      block.reset();
      continue;
    }
    const auto copy = make_shared_in<DenseBlock>(memory(), *block);
    copy->remove(ids);
    if (copy->factorise(jobs_) >= 0) throw NeedsNewLayout{};
    block = copy;
  }
  for (const Row& row : rows) {
    auto& path = state_.path_of(row.row);
    auto& group = state_.groups[at(path.group)];
    group.row[path.column] = no_row;
    --group.used;
    path = {};
    --state_.rows;
  }
}

void ConstraintEdit::drop_empty_groups() {
  Index kept = 0;
  for (std::size_t g = 0; g < state_.groups.size(); ++g) {
    if (state_.groups[g].used == 0) continue;
    for (const Index row : state_.groups[g].row) {
      if (row != no_row) state_.path_of(row).group = kept;
    }
    if (at(kept) != g) state_.groups[at(kept)] = std::move(state_.groups[g]);
    ++kept;
  }
  state_.groups.resize(at(kept));
}

// Solves elimination paths again when their groups mostly store paths of removed rows. Only sparsely used groups are
// packed.
void ConstraintEdit::repack() {
  std::int64_t stored = 0;
  for (const auto& group : state_.groups) stored += group.paths->count();
  if (stored <= stored_share * std::int64_t{state_.rows} + stored_slack) return;
  Vector<Index> moving(&memory());
  for (auto& group : state_.groups) {
    if (stored_share * group.used > group.paths->count()) continue;
    for (Index& row : group.row) {
      if (row != no_row) {
        moving.push_back(row);
        row = no_row;
      }
    }
    group.used = 0;
  }
  if (!moving.empty()) add_paths(moving);
  drop_empty_groups();
}

// Rows whose elimination paths are solved together, and these paths.
struct ConstraintEdit::Part {
  explicit Part(Memory& memory) : groups(&memory), group(&memory), column(&memory) {}
  Span<const Index> rows;
  Vector<std::shared_ptr<const factor::PathGroup>> groups;
  Vector<Index> group, column;  // by row
};

// Solves the elimination paths of these dense rows and puts them into new groups at the end. Sites of one part (site.h)
// get groups of their own.
void ConstraintEdit::add_paths(Span<const Index> rows) {
  const auto part_of = [&](Index row) { return row >= 0 ? state_.entries[at(row)].site.part : -1; };
  Vector<Part> parts(&memory());
  for (std::size_t first = 0, last = 0; first < rows.size(); first = last) {
    while (last < rows.size() && part_of(rows[last]) == part_of(rows[first])) ++last;
    parts.emplace_back(memory());
    parts.back().rows = rows.subspan(first, last - first);
  }
  jobs_.for_each(static_cast<std::uint32_t>(parts.size()), [&](std::uint32_t p) { solve_part(parts[p]); });
  for (Part& part : parts) take_part(part);
  path_solves_ += static_cast<std::uint32_t>(rows.size());
}

// Returns the column of a known group that is the path of a row, or -1.
Index ConstraintEdit::known_column(Index row, std::size_t group) const noexcept {
  if (row < 0 || at(row) >= known_.state->entries.size()) return -1;
  const auto &there = known_.state->entries[at(row)], &here = state_.entries[at(row)];
  const Site &a = there.site, &b = here.site;
  const auto is_same = [&](Index there_vertex, Index vertex) {
    return (known_.map && there_vertex >= 0 ? known_.map->to(there_vertex) : there_vertex) == vertex;
  };
  const bool same = there.used() && there.path.group == static_cast<Index>(group) && a.part == b.part &&
                    std::equal(a.vertex, a.vertex + 3, b.vertex, is_same) &&
                    std::equal(a.weight, a.weight + 3, b.weight);
  return same ? there.path.column : -1;
}

// Takes the paths that another system has, and leaves the other rows.
void ConstraintEdit::take_known_paths(Vector<Index>& left) {
  taken_first_ = taken_end_ = state_.groups.size();
  for (std::size_t g = 0; known_.state && g < known_.state->groups.size(); ++g) {
    const factor::PathGroup& paths = *known_.state->groups[g].paths;
    ConstraintState::Group taken;
    std::fill(std::begin(taken.row), std::end(taken.row), no_row);
    for (const Index row : left) {
      const Index column = known_column(row, g);
      if (column < 0) continue;
      taken.row[column] = row;
      ++taken.used;
    }
    if (stored_share * taken.used <= paths.count()) continue;  // most of its paths are of no use here
    SiteColumns columns(memory());
    for (Index c = 0; c < paths.count(); ++c) {
      if (taken.row[c] == no_row)
        columns.append_empty();
      else
        columns.append(state_.entries[at(taken.row[c])].site, nullptr);
    }
    taken.paths = factor().take_paths(*known_.factor, known_.state->groups[g].paths, columns.view(), memory());
    if (!taken.paths) return;
    const auto is_taken = [&](Index row) { return known_column(row, g) >= 0; };
    left.erase(std::remove_if(left.begin(), left.end(), is_taken), left.end());
    for (Index c = 0; c < paths.count(); ++c)
      if (taken.row[c] != no_row) state_.path_of(taken.row[c]) = {static_cast<Index>(state_.groups.size()), c};
    state_.groups.push_back(std::move(taken));
    taken_end_ = state_.groups.size();
  }
}

void ConstraintEdit::solve_part(Part& part) const {
  SiteColumns columns(memory());
  for (const Index row : part.rows) {
    if (row >= 0) {
      columns.append(state_.entries[at(row)].site, state_.base.get());
    } else {
      columns.append_free(state_.base->vertex[at(ConstraintState::base_index(row))], operator_.k(), *state_.base);
    }
  }
  part.group.resize(part.rows.size());
  part.column.resize(part.rows.size());
  factor().solve_paths(columns.view(), memory(), jobs_, part.groups, part.group, part.column);
}

void ConstraintEdit::take_part(Part& part) {
  const Index first = static_cast<Index>(state_.groups.size());
  for (auto& paths : part.groups) {
    ConstraintState::Group fresh;
    fresh.paths = std::move(paths);
    std::fill(std::begin(fresh.row), std::end(fresh.row), no_row);
    state_.groups.push_back(std::move(fresh));
  }
  for (std::size_t i = 0; i < part.rows.size(); ++i) {
    const Index row = part.rows[i], group = first + part.group[i], column = part.column[i];
    state_.path_of(row) = {group, column};
    auto& owner = state_.groups[at(group)];
    owner.row[column] = row;
    ++owner.used;
  }
}

void ConstraintEdit::add_rows(Span<const Row> rows) {
  if (rows.empty()) return;
  Vector<Index> ids(&memory());
  for (const Row& row : rows) ids.push_back(row.row);
  const std::size_t first_group = state_.groups.size();
  if (!state_.base) take_known_paths(ids);
  add_paths(ids);
  state_.rows += static_cast<Index>(rows.size());
  if (operator_.paths) project_pins(first_group);
  Batch batch(state_, rows, memory());
  take_gram(first_group, batch);
  take_couplings(batch);
  append_rows(batch);
}

// Computes the rows of the border N = Y'Y_g (products with the paths of pinned vertices) for the sites of the path
// groups from first_group on.
void ConstraintEdit::project_pins(std::size_t first_group) {
  const PinPaths& pins = *operator_.paths;
  const std::size_t border = operator_.border();
  jobs_.for_each(static_cast<std::uint32_t>(state_.groups.size() - first_group), [&](std::uint32_t fresh) {
    const auto& group = state_.groups[first_group + fresh];
    double tile[factor::PathGroup::capacity * factor::PathGroup::capacity];
    for (std::size_t b = 0; b < pins.groups.size(); ++b) {
      factor().gram(*group.paths, *pins.groups[b], tile, factor::PathGroup::capacity);
      for (Index i = 0; i < group.paths->count(); ++i) {
        if (group.row[i] < 0) continue;
        auto& entry = state_.entries[at(group.row[i])];
        for (std::size_t p = 0; p < border; ++p) {
          const std::size_t pin = at(entry.site.component) * border + p;
          if (at(pins.group[pin]) == b) entry.border[p] = tile[i * factor::PathGroup::capacity + pins.column[pin]];
        }
      }
    }
  });
}

// Where the rows of the known sites are in their dense blocks, by slot. Empty where the products of known paths are
// not products of the factor that all edits share: that factor is edited itself, or some sites are soft.
Vector<Index> ConstraintEdit::known_places() const {
  Vector<Index> place(&memory());
  if (taken_end_ == taken_first_ || known_.state->base || &known_.factor->path_base() != known_.factor.get())
    return place;
  for (const auto& entry : known_.state->entries)
    if (entry.used() && entry.site.compliance != 0) return place;
  place.assign(known_.state->entries.size(), -1);
  for (const auto& block : known_.state->blocks) {
    if (!block) continue;
    const Span<const Index> ids = block->ids();
    for (std::size_t i = 0; i < ids.size(); ++i) place[at(ids[i])] = static_cast<Index>(i);
  }
  return place;
}

// The products of known paths with the factor before the edit are entries of the known dense blocks.
void ConstraintEdit::take_known_gram(const ConstraintState::Group& mine, const ConstraintState::Group& other,
                                     Span<const Index> place, double* gram) const {
  const auto component = [&](Index row) { return known_.state->entries[at(row)].site.component; };
  for (Index i = 0; i < mine.paths->count(); ++i) {
    if (mine.row[i] == no_row) continue;
    const DenseBlock& block = *known_.state->blocks[at(component(mine.row[i]))];
    for (Index j = 0; j < other.paths->count(); ++j) {
      const bool together = other.row[j] != no_row && component(other.row[j]) == component(mine.row[i]);
      gram[i * factor::PathGroup::capacity + j] =
          together ? block.entry(place[at(mine.row[i])], place[at(other.row[j])]) : 0.0;
    }
  }
  factor().add_edit_products(*mine.paths, *other.paths, gram, factor::PathGroup::capacity);
}

// Computes the products of the elimination paths of each new group with its own paths and the paths of all earlier
// groups. One job handles a pair of groups, and each pair of rows gives one entry of M.
void ConstraintEdit::take_gram(std::size_t first_group, Batch& batch) const {
  struct Pair {
    std::size_t a, b;
  };
  // Paths of different components have no row in common, so groups without a row in a touched component are left out.
  Vector<std::uint8_t> touched(state_.blocks.size(), 0, &memory());
  for (const Row& row : batch.rows) touched[at(row.component)] = 1;
  Vector<std::size_t> near(&memory());
  Vector<Pair> pairs(&memory());
  for (std::size_t g = 0; g < state_.groups.size(); ++g) {
    const auto& group = state_.groups[g];
    if (std::any_of(std::begin(group.row), std::end(group.row),
                    [&](Index row) { return row != no_row && touched[at(batch.where(row).component)]; }))
      near.push_back(g);
    if (g < first_group) continue;
    for (const std::size_t b : near) pairs.push_back({g, b});
  }
  const Vector<Index> place = known_places();
  const auto is_known = [&](std::size_t g) { return !place.empty() && g >= taken_first_ && g < taken_end_; };
  jobs_.for_each(static_cast<std::uint32_t>(pairs.size()), [&](std::uint32_t piece) {
    const auto& mine = state_.groups[pairs[piece].a];
    const auto& other = state_.groups[pairs[piece].b];
    double tile[factor::PathGroup::capacity * factor::PathGroup::capacity];
    if (is_known(pairs[piece].a) && is_known(pairs[piece].b))
      take_known_gram(mine, other, place, tile);
    else
      factor().gram(*mine.paths, *other.paths, tile, factor::PathGroup::capacity);
    const bool own = &mine == &other;
    for (Index i = 0; i < mine.paths->count(); ++i) {
      if (mine.row[i] == no_row) continue;
      const Batch::Where& x = batch.where(mine.row[i]);
      for (Index j = 0; j < (own ? i + 1 : other.paths->count()); ++j) {
        if (other.row[j] == no_row) continue;
        if (double* m = batch.entry(x, batch.where(other.row[j]))) *m = tile[i * factor::PathGroup::capacity + j];
      }
    }
  });
}

// Adds those terms of the dense matrix M that are no products of paths: the softness D of soft sites on the diagonal,
// the weights W_R between a site and an unknown value of a removed site, and -K_RR between two such values.
void ConstraintEdit::take_couplings(Batch& batch) const {
  for (const Row& row : batch.rows) {
    if (row.row < 0) continue;
    const Site& site = state_.entries[at(row.row)].site;
    const Batch::Where& here = batch.where(row.row);
    *batch.entry(here, here) += site.compliance / operator_.pin_weight[at(site.component)];
  }
  if (!state_.base) return;
  const auto free_at = [&](Index unknown) -> const Batch::Where* {
    const Index b = unknown < 0 ? -1 : state_.base->index_of[at(unknown)];
    return b < 0 || batch.of_free[at(b)].place < 0 ? nullptr : &batch.of_free[at(b)];
  };
  const SymmetricMatrix& k = operator_.k();
  for (const Index r : state_.base->vertex) {
    const Batch::Where* here = free_at(r);
    if (!here) continue;
    for (Index i = k.column_start[at(r)]; i < k.column_start[at(r) + 1]; ++i) {
      const Batch::Where* there = free_at(k.row[at(i)]);
      if (!there || there->place > here->place) continue;
      if (double* m = batch.entry(*here, *there)) *m -= k.value[at(i)];
    }
  }
  for (std::size_t slot = 0; slot < state_.entries.size(); ++slot) {
    if (batch.of_slot[slot].place < 0) continue;
    const Site& site = state_.entries[slot].site;
    for (int c = 0; c < 3; ++c) {
      const Batch::Where* free = free_at(site.vertex[c]);
      double* m = free ? batch.entry(*free, batch.of_slot[slot]) : nullptr;
      if (m) *m += site.weight[c];
    }
  }
}

std::shared_ptr<DenseBlock> ConstraintEdit::block_to_edit(std::size_t component) const {
  const auto& present = state_.blocks[component];
  if (present) return make_shared_in<DenseBlock>(memory(), *present);
  const std::size_t border = operator_.border();
  return make_shared_in<DenseBlock>(memory(), memory(), state_.floating(component) ? border : std::size_t{0},
                                    operator_.paths ? &operator_.paths->corner[component * border * border] : nullptr);
}

void ConstraintEdit::append_rows(const Batch& batch) {
  Vector<std::shared_ptr<DenseBlock>> blocks(state_.blocks.size(), &memory());
  for (std::size_t i = 0; i < batch.rows.size(); ++i) {
    const Index row = batch.rows[i].row;
    auto& block = blocks[at(batch.rows[i].component)];
    if (!block) block = block_to_edit(at(batch.rows[i].component));
    block->append(row, batch.values.data() + batch.start[i], row >= 0,
                  operator_.paths && row >= 0 ? state_.entries[at(row)].border : nullptr);
  }
  for (std::size_t c = 0; c < blocks.size(); ++c) {
    if (!blocks[c]) continue;
    const Index failed = blocks[c]->factorise(jobs_);
    // A pivot failed after sites were eliminated in the factor. The order of the dense rows may be the reason, so try a
    // new order. Vertices are independent, so without a base rounding is the reason: a base has no rows of them.
    if (failed >= 0 && (state_.base || (!last_ && are_vertices(static_cast<Index>(c))))) throw NeedsNewLayout{};
    refuse_dependent(*blocks[c], static_cast<Index>(c), failed);
    state_.blocks[c] = blocks[c];
  }
}

// Whether all sites of a component are hard ones at vertices.
bool ConstraintEdit::are_vertices(Index component) const {
  return std::all_of(state_.entries.begin(), state_.entries.end(), [&](const ConstraintState::Entry& entry) {
    return !entry.used() || entry.site.component != component || entry.site.is_hard_vertex();
  });
}

void ConstraintEdit::refuse_dependent(const DenseBlock& block, Index component, Index failed) const {
  const Index slot = failed >= 0 ? block.ids()[at(failed)] : dependent_slot(block, component);
  if (slot < 0) return;
  const auto found = std::find(edit_.add.begin(), edit_.add.end(), slot);
  const std::uint32_t position =
      found == edit_.add.end() ? HF_NO_INDEX : static_cast<std::uint32_t>(found - edit_.add.begin());
  fail(HF_ERROR_CONFLICT, position,
       "site %u of the batch depends linearly on hard sites that are there (a triangle takes three independent "
       "points); leave it out or make it soft",
       position);
}

// Returns the slot of a hard site of the component that depends linearly on others, or -1. It reports sites of this
// edit before older sites. After a rebase a diagonal entry may be mere rounding, and so may its pivot. So every new
// site is then examined.
Index ConstraintEdit::dependent_slot(const DenseBlock& block, Index component) const {
  if (!state_.base && block.least_pivot() >= suspect_share) return -1;
  Vector<HardSite> sites(&memory());
  Vector<Index> place(state_.entries.size(), -1, &memory());
  const auto take = [&](Index slot) {
    const Site& site = state_.entries[at(slot)].site;
    if (site.component != component || site.compliance != 0 || place[at(slot)] >= 0) return;
    place[at(slot)] = static_cast<Index>(sites.size());
    sites.push_back({&site, slot, false});
  };
  Vector<std::uint8_t> is_new(state_.entries.size(), 0, &memory());
  for (const Index slot : edit_.add) is_new[at(slot)] = 1;
  for (Index slot = 0; at(slot) < state_.entries.size(); ++slot) {
    if (!is_new[at(slot)]) take(slot);
  }
  for (const Index slot : edit_.add) take(slot);
  const auto suspect = [&](Index slot) {
    if (slot >= 0 && place[at(slot)] >= 0) sites[at(place[at(slot)])].suspect = true;
  };
  for (Index i = 0; i < block.count() && !state_.base; ++i) {
    if (block.pivot_share(i) < suspect_share) suspect(block.ids()[at(i)]);
  }
  for (std::size_t i = 0; i < edit_.add.size() && state_.base; ++i) suspect(edit_.add[i]);
  return dependent_site({sites.data(), sites.size()}, memory());
}

}  // namespace hf_inner::solve

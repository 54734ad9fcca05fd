#include "solve/constraint_system.h"

#include <algorithm>

#include "base/error.h"
#include "factor/site_cost.h"
#include "solve/constraint_system_edit.h"

namespace hf_inner::solve {
namespace {

// An edit rebuilds the dense system of the sites (starts over) only if continuing costs this many times as much, as
// predicted. The predicted costs are accurate to about 25 %. Continuing also keeps the elimination paths, which
// starting over solves again. With 1, edits of similar cost in both ways would alternate between them.
constexpr double restart_margin = 1.25;
// After sites went into the factor, later edits factorise some dense rows (of mixed signs) again and again. Their cost
// counts this many times. Chosen on 800 random edits of 1,000 vectors on 20,000 vertices. Half takes a fifth longer in
// all. Double takes as long, with more rebases.
constexpr double expected_repeats = 8;
// Where the sites alone decide, later sites stay rows until these would cost this share of a rebase. A smaller number
// rebases more often when sites come a part at a time. A larger number costs more when all come at once. On a torus of
// 84,000 vertices, a ring of hundreds of sites more takes as long with 0.25 to 2, within 8 %.
constexpr double later_share = 0.5;

}  // namespace

void ConstraintState::swap(ConstraintState& other) noexcept {
  entries.swap(other.entries);
  base.swap(other.base);
  freed.swap(other.freed);
  groups.swap(other.groups);
  blocks.swap(other.blocks);
  sites_of.swap(other.sites_of);
  std::swap(rows, other.rows);
  std::swap(decision, other.decision);
}

void ConstraintState::put(Index slot, const Site& site) {
  if (entries.size() <= at(slot)) entries.resize(at(slot) + 1);
  entries[at(slot)] = Entry{};
  entries[at(slot)].site = site;
}

ConstraintSystem::ConstraintSystem(const ConstraintSystem& other)
    : operator_(other.operator_),
      state_(other.state_, other.memory()),
      path_solves_(other.path_solves_),
      rebases_(other.rebases_),
      dense_edits_(other.dense_edits_),
      sweeps_(other.sweeps_.load()) {}

std::shared_ptr<const ConstraintState> ConstraintSystem::snapshot() const {
  return make_shared_in<ConstraintState>(memory(), state_, memory());
}

void ConstraintSystem::restore(const ConstraintState& state) {
  ConstraintState next(state, memory());
  state_.swap(next);
}

ConstraintCounts ConstraintSystem::counts() const noexcept { return {path_solves_, sweeps_, rebases_, dense_edits_}; }

void ConstraintSystem::add_counts(const ConstraintCounts& more) noexcept {
  path_solves_ += more.path_solves;
  sweeps_ += more.sweeps;
  rebases_ += more.rebases;
  dense_edits_ += more.dense_edits;
}

bool ConstraintSystem::is_crowded(double share) const noexcept {
  return std::any_of(state_.blocks.begin(), state_.blocks.end(),
                     [&](const auto& block) { return block && block->least_pivot() < share; });
}

double ConstraintSystem::row_bytes() const noexcept {
  double sum = 0;
  for (const auto& group : state_.groups) sum += group.paths->bytes();
  for (const auto& block : state_.blocks) sum += block ? block->bytes() : 0.0;
  return sum;
}

double ConstraintSystem::base_bytes() const noexcept {
  return state_.base ? state_.base->factor->statistics().bytes : 0.0;
}

// Returns the cost of the dense rows (with signs of both kinds) that the edit factorises again: those from the first
// removed row on.
double ConstraintSystem::again_ns(const SiteEdit& edit, const factor::SiteCost& cost) const {
  if (!state_.base) return 0;
  Vector<std::uint8_t> leaves(state_.entries.size(), 0, &memory()), returns(state_.freed.size(), 0, &memory());
  for (const Index slot : edit.remove) leaves[at(slot)] = 1;
  for (const Site& site : edit.sites) {
    const Index b = site.is_hard_vertex() ? state_.base->index_of[at(site.vertex[0])] : -1;
    if (b >= 0) returns[at(b)] = 1;
  }
  double sum = 0;
  for (const auto& block : state_.blocks) {
    if (!block || !block->has_negative()) continue;
    const Span<const Index> ids = block->ids();
    const auto first = std::find_if(ids.begin(), ids.end(), [&](Index id) {
      return (id >= 0 ? leaves[at(id)] : returns[at(ConstraintState::base_index(id))]) != 0;
    });
    sum += cost.signed_ns(static_cast<double>(first - ids.begin()), static_cast<double>(ids.size()));
  }
  return sum;
}

// Where the sites alone decide: the slots below the result are those that a factor has taken in if the sites come a
// part at a time. A rebase takes in all that are there when the rows would cost restart_margin times as much. Later
// rebases come at later_share. So one more site is mostly one more row, and all at once cost at most later_share more.
Index ConstraintSystem::first_row(const SiteEdit& edit, const factor::SiteCost& cost) const {
  Vector<std::uint8_t> leaves(state_.entries.size(), 0, &memory());
  for (const Index slot : edit.remove) leaves[at(slot)] = 1;
  Index end = 0, part = -1, slot_end = 0;
  double soft = 0, hard = 0;  // rows that no factor took in
  const auto close = [&] {
    const double rebase = cost.rebase_ns(soft);
    if (hard > 0 && cost.dense_ns(0, soft + hard) - (end > 0 ? cost.dense_ns(0, soft) : 0.0) >
                        (end > 0 ? later_share : restart_margin) * rebase) {
      end = slot_end;
      hard = 0;
    }
  };
  const auto take = [&](Index slot, const Site& site) {
    if (site.part != part) close();
    (site.is_hard_vertex() ? hard : soft) += 1;
    part = site.part;
    slot_end = slot + 1;
  };
  for (std::size_t slot = 0; slot < state_.entries.size(); ++slot) {
    if (state_.entries[slot].used() && !leaves[slot]) take(static_cast<Index>(slot), state_.entries[slot].site);
  }
  for (std::size_t i = 0; i < edit.add.size(); ++i) take(edit.add[i], edit.sites[i]);
  close();
  return end;
}

// True if the present factor has taken in the hard vertex sites of slots below end and no others, and the edit leaves
// them there.
bool ConstraintSystem::has_base(const SiteEdit& edit, Index end) const {
  if (!state_.base) return false;
  Index next = 0;
  for (std::size_t slot = 0; slot < state_.entries.size(); ++slot) {
    const auto& entry = state_.entries[slot];
    const bool inside = entry.used() && static_cast<Index>(slot) < end && entry.site.is_hard_vertex();
    if (entry.eliminated != (inside ? next++ : -1)) return false;
  }
  const auto below = [&](Index slot) { return slot < end; };
  return at(next) == state_.base->vertex.size() && !std::any_of(edit.remove.begin(), edit.remove.end(), below) &&
         !std::any_of(edit.add.begin(), edit.add.end(), below);
}

// Compares the cost of editing the present rows of the dense system with the cost of building it again. Building it
// again may keep the hard vertex sites as rows, or eliminate them in the factor.
ConstraintState::Decision ConstraintSystem::decide(const SiteEdit& edit) const {
  const factor::SiteCost cost(operator_.factor->statistics());
  double sites = 0, hard = 0, rows_removed = 0, freed = 0;
  for (const auto& entry : state_.entries) {
    if (!entry.used()) continue;
    ++sites;
    hard += entry.site.is_hard_vertex();
  }
  for (const Index slot : edit.remove) {
    const auto& entry = state_.entries[at(slot)];
    hard -= entry.site.is_hard_vertex();
    freed += entry.eliminated >= 0;
    rows_removed += entry.eliminated < 0;
  }
  for (const Site& site : edit.sites) hard += site.is_hard_vertex();
  sites += static_cast<double>(edit.add.size()) - static_cast<double>(edit.remove.size());

  const double kept = std::max(0.0, static_cast<double>(state_.rows) - rows_removed), again = again_ns(edit, cost);
  const double going_on = cost.dense_ns(kept, static_cast<double>(edit.add.size()) + freed) + again;
  const double plain = cost.dense_ns(0, sites), rebase = cost.rebase_ns(sites - hard);
  ConstraintState::Decision decision;
  decision.eliminate = hard > 0 && rebase < plain;
  decision.dense_ms = std::min(going_on, plain) / 1e6;
  decision.rebase_ms = hard > 0 ? rebase / 1e6 : 0;
  const double expected = going_on + (expected_repeats - 1) * again;
  if (edit.history_free) {  // the sites alone decide, as if they were all new
    decision.end = first_row(edit, cost);
    decision.eliminate = decision.end > 0;
    const bool keeps_base = decision.eliminate ? has_base(edit, decision.end) : !state_.base;
    decision.route = keeps_base ? EditRoute::dense : decision.eliminate ? EditRoute::rebase : EditRoute::fresh;
  } else if (!(expected > restart_margin * (decision.eliminate ? rebase : plain))) {
    decision.route = EditRoute::dense;
  } else {
    decision.route = decision.eliminate ? EditRoute::rebase : EditRoute::fresh;
  }
  return decision;
}

// Tries one route (way to carry out an edit). Returns false if the edit needs a new order of the dense rows, or a base.
// last: no other route follows, so `fresh` gives a result or refuses the edit.
bool ConstraintSystem::try_route(EditRoute route, const SiteEdit& edit, JobRunner& jobs,
                                 const ConstraintState::Decision& decision, bool last) {
  ConstraintState next(state_, memory());
  ConstraintEdit change(operator_, jobs, edit, next, known_, last);
  try {
    if (route == EditRoute::dense) {
      change.go_on();
    } else {
      change.start_over(route == EditRoute::rebase ? decision.end : 0);
    }
  } catch (const ConstraintEdit::NeedsNewLayout&) {
    return false;
  }
  path_solves_ += change.path_solves();
  rebases_ += change.factorisations();
  next.decision = decision;
  next.decision.route = route;
  state_.swap(next);
  known_ = {};
  return true;
}

void ConstraintSystem::edit(const SiteEdit& edit) {
  const ConstraintState::Decision decision = decide(edit);
  JobRunner& jobs = *operator_.jobs;
  if (try_route(decision.route, edit, jobs, decision)) {
    dense_edits_ += decision.route == EditRoute::dense;
    return;
  }
  ConstraintState::Decision whole = decision;
  whole.end = ConstraintState::index_end;
  const bool again = decision.route == EditRoute::dense && decision.eliminate;
  if (again && try_route(EditRoute::rebase, edit, jobs, decision)) return;
  if (decision.route != EditRoute::fresh && try_route(EditRoute::fresh, edit, jobs, decision)) return;
  if (!try_route(EditRoute::rebase, edit, jobs, whole)) try_route(EditRoute::fresh, edit, jobs, decision, true);
}

void ConstraintSystem::rebase(JobRunner& jobs) {
  const bool hard = std::any_of(state_.entries.begin(), state_.entries.end(), [](const ConstraintState::Entry& entry) {
    return entry.used() && entry.site.is_hard_vertex();
  });
  if (!hard) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "no hard site on a vertex: there is nothing to move into the factor");
  if (!try_route(EditRoute::rebase, SiteEdit{}, jobs, {}))
    fail(HF_ERROR_CONFLICT, HF_NO_INDEX, "the sites that are no hard vertices depend too closely on those that are");
}

}  // namespace hf_inner::solve

// Engine green: factor once, never touch the factor again. With W = [w_1 .. w_k] and A = P(K + sum_c beta_c e_gc
// e_gc')P' = GG':
//
//     y_i = G^-1 P w_i          sparse, along elimination-tree paths
//     S   = Y'Y + D             k x k, one block per component; D = diag(1 / alpha_i), 0 for hard sites
//     [ S  B ] [lambda]   [ s ]
//     [ B' 0 ] [  a   ] = [ 0 ]  B_ic = 1 if site i lies in component c
//     u = P' G^-T (Y lambda) + sum_c a_c 1_c
//
// K annihilates constants and B'lambda = 0 makes A^-1 W lambda vanish at the ground, so the ground leaves no trace: K u
// = W lambda and W'u + D lambda = s hold exactly. Insert: path solves and rows of S. Remove: rows of S. Field: one
// backward sweep.
//
// Very many sites: a rebase (eliminated_base.h) takes the hard vertex sites E into the factor. Sites that come later
// are rows as above; a site r of E that goes leaves a free value t_r, with the column y_r = G^-1 P (-K_Fr) and the
// equation (K u)_r = (W lambda)_r, a negative row of the same system:
//
//     [ Y_w'Y_w + D     Y_w'Y_r + W_R   ] [lambda]   [ s - Y_w'g - W_E' s_E       ]
//     [ (...)'          Y_r'Y_r - K_RR  ] [  t   ] = [ K_RE s_E - Y_r'g           ],   g = G^-1 P (-K_FE s_E)
//     u_F = P' G^-T (g + Y_w lambda + Y_r t),   u_E = s_E,   u_R = t
//
// Which way an edit goes is decided by site_cost.h and counted.
#pragma once
#include <atomic>

#include "engine/dense_block.h"
#include "engine/eliminated_base.h"
#include "engine/site_solver.h"

namespace hf_inner {

class GreenSolver final : public SiteSolver {
 public:
  explicit GreenSolver(std::shared_ptr<const Core> core);
  GreenSolver(const GreenSolver& other);

  void edit(const SiteEdit& edit) override;
  void solve(const double* values, std::int32_t channels, double* field, double* flux) const override;
  void solve_into(const double* values, std::int32_t channels, FieldSink& sink) const override;
  void solve_at(const double* values, std::int32_t channels, Span<const std::int32_t> vertices,
                double* out) const override;
  void solve_preview(const double* values, std::int32_t channels, std::int32_t corrections, double* field,
                     PreviewInfo& info) const override;
  std::shared_ptr<SiteSolver> clone() const override { return make_owner_in<GreenSolver>(core_->memory, *this); }
  void rebase(JobRunner& jobs) override;
  void succeed(const SiteSolver& predecessor) noexcept override;
  EngineKind kind() const noexcept override { return EngineKind::green; }
  EngineCounters counters() const noexcept override;
  std::int32_t site_count(std::int32_t component) const noexcept override {
    return state_.sites_of[static_cast<std::size_t>(component)];
  }
  std::int32_t slot_count() const noexcept override { return static_cast<std::int32_t>(state_.entries.size()); }

 private:
  using Index = std::int32_t;
  Index refinements() const noexcept;  // steps with the true operator that a field takes
  // A row of the dense system is named by the slot of its site, or, for the free value of base index b, by -2 - b.
  static constexpr Index nobody = -1;
  // Channels solved in one sweep: wider rows would push the right-hand sides out of the cache.
  static constexpr Index channel_block = 8;
  static Index free_row(Index base_index) noexcept { return -2 - base_index; }
  static Index base_index(Index row) noexcept { return -2 - row; }

  // Where the path of a row lies.
  struct Path {
    Index group = -1, column = -1;
  };
  // Paths of up to PathGroup::capacity rows; row[column] = nobody once it is gone.
  struct Group {
    std::shared_ptr<const PathGroup> paths;
    Index row[PathGroup::capacity];
    Index live = 0;
  };
  struct Entry {
    Site site;              // component -1: the slot is free
    Path path;              // of a row
    Index eliminated = -1;  // base index of a site in the factor
    bool used() const noexcept { return site.component >= 0; }
  };
  struct Free {
    Path path;  // group -1: the base site is in force
  };
  // What the cost model said of an edit.
  struct Decision {
    EditRoute route = EditRoute::none;
    double dense_ms = 0, rebase_ms = 0;
  };
  struct State {
    State(Index components, Memory& memory)
        : entries(&memory),
          freed(&memory),
          groups(&memory),
          blocks(static_cast<std::size_t>(components), &memory),
          sites_of(static_cast<std::size_t>(components), 0, &memory) {}
    State(const State& other, Memory& memory)
        : entries(other.entries, &memory),
          base(other.base),
          freed(other.freed, &memory),
          groups(other.groups, &memory),
          blocks(other.blocks, &memory),
          sites_of(other.sites_of, &memory),
          rows(other.rows),
          decision(other.decision) {}
    State(State&&) = default;
    void swap(State& other) noexcept;
    Vector<Entry> entries;                       // by slot
    std::shared_ptr<const EliminatedBase> base;  // null: the core's own factor
    Vector<Free> freed;                          // by base index
    Vector<Group> groups;
    Vector<std::shared_ptr<const DenseBlock>> blocks;  // by component; null without a row
    Vector<Index> sites_of;                            // sites by component
    Index rows = 0;                                    // of all blocks
    Decision decision;                                 // of the edit that led here
  };
  struct Addition {
    Index row;  // slot or free_row
    Index component;
    bool positive;
  };

  // edits, in green_edit.cpp: all work on a state that is not yet the present one
  void apply(State& state, const SiteEdit& edit) const;
  bool remove_sites(State& state, Span<const Index> slots, Vector<Addition>& additions) const;
  void remove_rows(State& state, Span<const Index> rows, Span<const Index> components) const;
  void add_rows(State& state, Span<const Addition> additions, const SiteEdit& edit) const;
  void add_paths(State& state, Span<const Index> rows) const;
  Index crowded_out(const State& state, const SiteEdit& edit, const DenseBlock& block, Index component) const;
  void drop_empty_groups(State& state) const;
  void repack(State& state) const;
  void place_all(State& state, const SiteEdit& edit, bool eliminate) const;
  State with_sites(const SiteEdit& edit) const;
  Decision decide(const SiteEdit& edit) const;

  // solving, in green.cpp
  struct Right;
  void sweep(const double* values, Index channels, Index first, Index count, Right& right, double* z) const;
  void base_forward(const double* values, Index channels, Index first, Index count, const Vector<double>& centre,
                    double* z) const;
  void solve_dense(const double* values, Index channels, Index first, Index count, const double* z, Right& right) const;
  void subtract_projections(const double* z, Index count, Right& right) const;
  void solve_rows(Index count, Right& right) const;
  void combine(const Right& right, Index count, double* z) const;
  // in green_refine.cpp
  struct SingleSweeps;
  void refine(const double* values, Index channels, Index first, Index count, double* z, Right& right, double* field,
              SingleSweeps* single = nullptr) const;
  // in green_preview.cpp
  double centre_and_range(const double* values, Index channels, Index first, Index count, Vector<double>& centre) const;
  void base_flux(const double* values, Index channels, const double* field, double* flux) const;

  const Factor& factor(const State& state) const noexcept { return state.base ? *state.base->factor : *core_->factor; }
  Path& path_of(State& state, Index row) const noexcept {
    return row >= 0 ? state.entries[static_cast<std::size_t>(row)].path
                    : state.freed[static_cast<std::size_t>(base_index(row))].path;
  }
  bool floating(const State& state, std::size_t component) const noexcept {
    return !state.base || state.base->floating[component];
  }
  Memory& memory() const noexcept { return *core_->memory; }
  JobRunner& jobs() const noexcept { return runner_ ? *runner_ : *core_->jobs; }

  std::shared_ptr<const Core> core_;
  JobRunner* runner_ = nullptr;  // during a rebase: the threads it was given
  State state_;
  struct Counts {
    std::uint32_t paths = 0, sweeps = 0, rebases = 0, dense_edits = 0;
  };
  Counts counts() const noexcept { return {path_solves_, sweeps_, rebases_, dense_edits_}; }
  mutable std::atomic<std::uint32_t> path_solves_{0}, sweeps_{0}, rebases_{0}, dense_edits_{0};
  Counts cloned_at_;  // counts of the engine this one was cloned from, at that time
};

}  // namespace hf_inner

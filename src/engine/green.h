// Engine green: factor once, never touch the factor again. With W = [w_1 .. w_k] and A = P(K + sum_c beta_c e_gc e_gc')P' = GG':
//
//     y_i = G^-1 P w_i          sparse, along elimination-tree paths
//     S   = Y'Y + D             k x k, one block per component; D = diag(1 / alpha_i), 0 for hard sites
//     [ S  B ] [lambda]   [ s ]
//     [ B' 0 ] [  a   ] = [ 0 ]  B_ic = 1 if site i lies in component c
//     u = P' G^-T (Y lambda) + sum_c a_c 1_c
//
// K annihilates constants and B'lambda = 0 makes A^-1 W lambda vanish at the ground, so the ground leaves no trace: K u = W lambda and
// W'u + D lambda = s hold exactly. Insert: path solves and rows of S. Remove: rows of S. Field: one backward sweep.
#pragma once
#include <atomic>

#include "engine/dense_block.h"
#include "engine/site_solver.h"

namespace hf {

class GreenSolver final : public SiteSolver {
 public:
  explicit GreenSolver(std::shared_ptr<const Core> core);
  GreenSolver(const GreenSolver& other);

  void edit(const SiteEdit& edit) override;
  void solve(const double* values, std::int32_t channels, double* field, double* flux) const override;
  void solve_at(const double* values, std::int32_t channels, Span<const std::int32_t> vertices, double* out) const override;
  std::shared_ptr<SiteSolver> clone() const override { return make_owner_in<GreenSolver>(core_->memory, *this); }
  EngineKind kind() const noexcept override { return EngineKind::green; }
  EngineCounters counters() const noexcept override;
  std::int32_t site_count(std::int32_t component) const noexcept override;
  std::int32_t slot_count() const noexcept override { return static_cast<std::int32_t>(state_.entries.size()); }

 private:
  // Paths of up to PathGroup::capacity sites; slot[column] = -1 once the site is gone.
  struct Group {
    std::shared_ptr<const PathGroup> paths;
    std::int32_t slot[PathGroup::capacity];
    std::int32_t live = 0;
  };
  struct Entry {
    Site site;
    std::int32_t group = -1, column = -1;  // -1: the slot is free
  };
  struct State {
    explicit State(Memory& memory) : entries(&memory), groups(&memory), blocks(&memory) {}
    State(const State& other, Memory& memory) : entries(other.entries, &memory), groups(other.groups, &memory), blocks(other.blocks, &memory), live(other.live) {}
    Vector<Entry> entries;  // by slot
    Vector<Group> groups;
    Vector<std::shared_ptr<const DenseBlock>> blocks;  // by component; null without a site
    std::int32_t live = 0;
  };
  void remove_sites(State& state, Span<const std::int32_t> slots) const;
  void add_paths(State& state, Span<const std::int32_t> slots, Vector<std::int32_t>& fresh_groups) const;
  void add_sites(State& state, const SiteEdit& edit) const;
  void drop_empty_groups(State& state) const;
  void repack(State& state) const;
  // lambda by slot and the constant of every component, for channels [first, first + count) of `channels`
  void solve_dense(const double* values, std::int32_t channels, std::int32_t first, std::int32_t count, Vector<double>& lambda, Vector<double>& constant) const;
  void combine(const Vector<double>& lambda, std::int32_t channels, double* z) const;

  Memory& memory() const noexcept { return *core_->memory; }

  std::shared_ptr<const Core> core_;
  State state_;
  mutable std::atomic<std::uint32_t> path_solves_{0}, sweeps_{0};
};

}  // namespace hf

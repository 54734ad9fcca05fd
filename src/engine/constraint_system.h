// A few changing constraints on an operator that is factorised once: the machine of fields and direction fields.
//
// With W = [w_1 .. w_k], A = K + sum_c beta_c E_c E_c' (pinned_operator.h) and P A P' = GG':
//
//     y_i = G^-1 P w_i          sparse, along elimination-tree paths
//     S   = Y'Y + D             k x k, one block per component; D = diag(1 / alpha_i), 0 for hard sites
//     [ S  N ] [lambda]   [ s ]
//     [ N' C ] [  nu  ] = [ 0 ]
//
// Where K maps constants to zero, N_ic = 1 if site i lies in component c, C = 0, and the answer is
//     u = P' G^-T (Y lambda) + sum_c nu_c 1_c.
// Elsewhere N = Y'Y_g and C = Y_g'Y_g - I / beta, with the paths Y_g of the pins, and the answer is
//     u = P' G^-T (Y lambda + Y_g nu).
// Both ways pinning a vertex does not change the solution: K u = W lambda and W'u + D lambda = s hold exactly. Insert:
// path solves and rows of S. Remove: rows of S. Solve: one backward sweep.
//
// Very many sites: a rebase (eliminated_base.h) takes the hard vertex sites E into the factor. Later sites are rows as
// above. Removing a site r of E frees the value t_r. Its column is y_r = G^-1 P (-K_Fr). Its equation
// (K u)_r = (W lambda)_r is a negative row of the same system:
//
//     [ Y_w'Y_w + D     Y_w'Y_r + W_R   ] [lambda]   [ s - Y_w'g - W_E' s_E       ]
//     [ (...)'          Y_r'Y_r - K_RR  ] [  t   ] = [ K_RE s_E - Y_r'g           ],   g = G^-1 P (-K_FE s_E)
//
//     u_F = P' G^-T (g + Y_w lambda + Y_r t),   u_E = s_E,   u_R = t
//
// site_cost.h decides how an edit is made; the choice is counted. Edits are all or nothing. Const functions may run at
// the same time on one system. The owner of the operator outlives the system.
#pragma once
#include <atomic>

#include "engine/constraint_system_state.h"

namespace hf_inner {

struct SiteCost;

struct ConstraintCounts {
  std::uint32_t path_solves = 0, sweeps = 0, rebases = 0, dense_edits = 0;
};

class ConstraintSystem {
 public:
  // Channels solved in one sweep: wider rows would push the right-hand sides out of the cache.
  static constexpr Index channel_block = 8;

  explicit ConstraintSystem(const PinnedOperator& a) : operator_(a), state_(a.component_count(), *a.memory) {}
  ConstraintSystem(const ConstraintSystem& other);  // with its constraints and its counts
  ConstraintSystem& operator=(const ConstraintSystem&) = delete;

  // Throws HF_ERROR_CONFLICT (index = position in edit.add) when a new site depends linearly on the hard sites there.
  void edit(const SiteEdit& edit);
  // Moves the hard vertex sites there are into the factor, on these threads. Throws HF_ERROR_NO_SITES without one.
  void rebase(JobRunner& jobs);

  const ConstraintState& state() const noexcept { return state_; }
  const PinnedOperator& pinned_operator() const noexcept { return operator_; }
  // Shares paths and dense blocks; restore gives the same bits.
  std::shared_ptr<const ConstraintState> snapshot() const;
  void restore(const ConstraintState& state);

  ConstraintCounts counts() const noexcept;
  void add_counts(const ConstraintCounts& more) noexcept;
  double row_bytes() const noexcept;   // of paths and blocks
  double base_bytes() const noexcept;  // of the factor of a rebase
  // The factor that paths and sweeps of the present state use.
  const Factor& factor() const noexcept { return state_.base ? *state_.base->factor : *operator_.factor; }

  // The unknowns of the dense system during a solve of m channels.
  struct Answer {
    explicit Answer(Memory& memory)
        : slot(&memory), freed(&memory), centre(&memory), constant(&memory), nu(&memory), total(&memory), x(&memory) {}
    double* of(Index row, std::size_t m) noexcept {
      return row >= 0 ? slot.data() + at(row) * m : freed.data() + at(ConstraintState::base_index(row)) * m;
    }
    const double* of(Index row, std::size_t m) const noexcept { return const_cast<Answer*>(this)->of(row, m); }
    Vector<double> slot;      // lambda
    Vector<double> freed;     // t, by base index
    Vector<double> centre;    // mean site value by component: a large common offset must not cost digits
    Vector<double> constant;  // centre + nu by component; zeros where K does not keep constants
    Vector<double> nu;        // by component and pin, where pins have paths
    Vector<double> total;     // by component, for a refinement: 1'lambda = -total; empty: 0
    Vector<double> x;         // scratch
  };
  // All of these take channels [first, first + count) of values[slot * channels + c].
  //
  // z <- P u without the constants, freed values included; count numbers an unknown in the factor's order.
  void sweep(const double* values, Index channels, Index first, Index count, Answer& answer, double* z) const;
  // The mean site value of every component and channel. A solve subtracts it first, so that a large common offset costs
  // no digits. It is zero where constants are not in the kernel of K (direction fields).
  void find_centres(const double* values, Index channels, Index first, Index count, Answer& answer) const;
  // The answer of the dense system; centres come first. z: g of the eliminated sites; null without a base.
  void solve_dense(const double* values, Index channels, Index first, Index count, const double* z,
                   Answer& answer) const;
  // The parts of a solve with right-hand sides of its own (green_refine.cpp): answer -= Y'z; answer <- lambda, t, nu;
  // z += Y lambda + Y_g nu.
  void subtract_projections(const double* z, Index count, Answer& answer) const;
  void solve_rows(Index count, Answer& answer) const;
  void combine(const Answer& answer, Index count, double* z) const;
  void count_sweeps(std::uint32_t more) const noexcept { sweeps_ += more; }

 private:
  ConstraintState::Decision decide(const SiteEdit& edit) const;
  double again_ns(const SiteEdit& edit, const SiteCost& cost) const;
  bool try_route(EditRoute route, const SiteEdit& edit, JobRunner& jobs, const ConstraintState::Decision& decision);
  void base_forward(const double* values, Index channels, Index first, Index count, const Answer& answer,
                    double* z) const;
  void add_base_terms(const double* values, Index channels, Index first, Index count, Answer& answer) const;
  Memory& memory() const noexcept { return *operator_.memory; }

  PinnedOperator operator_;
  ConstraintState state_;
  std::uint32_t path_solves_ = 0, rebases_ = 0, dense_edits_ = 0;
  mutable std::atomic<std::uint32_t> sweeps_{0};
};

}  // namespace hf_inner

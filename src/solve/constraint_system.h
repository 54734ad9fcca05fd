// Solves an operator K under a few changing constraints, with one factorisation. Scalar fields and direction fields use
// it.
//
// Site i is a constraint w_i' u = s_i on the field u. The matrix W has one column w_i per site, s holds the values, and
// lambda holds the flux into each site. A soft site has the stiffness alpha_i. One vertex of every component c is
// pinned: A = K + sum_c beta_c E_c E_c' (pinned_operator.h). The ordering is the permutation P, and the Cholesky factor
// is G: P A P' = G G'. A solve has these equations:
//
//     y_i = G^-1 P w_i          sparse: it follows the elimination path of the site
//     S   = Y'Y + D             k x k, one block per component; D = diag(1 / alpha_i), 0 for hard sites
//     [ S  N ] [lambda]   [ s ]
//     [ N' C ] [  nu  ] = [ 0 ].
//
// The matrix S is a Schur complement. The border N, C removes the effect of the pins. If K maps constants to zero, N_ic
// = 1 if site i lies in component c, C = 0, and the field is
//     u = P' G^-T (Y lambda) + sum_c nu_c 1_c.
// Otherwise N = Y'Y_g and C = Y_g'Y_g - I / beta, with the elimination paths Y_g of the pins, and the field is
//     u = P' G^-T (Y lambda + Y_g nu).
// In both cases pinning does not change the solution: K u = W lambda and W'u + D lambda = s hold exactly. To insert
// sites, solve their paths and append rows to S. To remove sites, remove rows of S. A solve takes one backward sweep.
//
// If there are very many sites, a rebase (eliminated_base.h) takes a set E of hard vertex sites out of the matrix. F
// are the other vertices. Later sites become rows as above. If a site r of E is removed, its value t_r becomes unknown.
// The column of r is y_r = G^-1 P (-K_Fr). Its equation (K u)_r = (W lambda)_r is a row of negative sign in the same
// system. R is the set of all removed sites of E. The dense system then is:
//
//     [ Y_w'Y_w + D     Y_w'Y_r + W_R   ] [lambda]   [ s - Y_w'g - W_E' s_E       ]
//     [ (...)'          Y_r'Y_r - K_RR  ] [  t   ] = [ K_RE s_E - Y_r'g           ],   g = G^-1 P (-K_FE s_E)
//
//     u_F = P' G^-T (g + Y_w lambda + Y_r t),   u_E = s_E,   u_R = t.
//
// A cost model (site_cost.h) decides how an edit is made, and counters record the choice. An edit does everything or
// throws and changes nothing. Const functions may run at the same time on one system. The operator's owner must outlive
// the system.
#pragma once
#include <atomic>

#include "solve/constraint_system_state.h"

namespace hf_inner::factor {
struct SiteCost;
}

namespace hf_inner::solve {

struct ConstraintCounts {
  std::uint32_t path_solves = 0, sweeps = 0, rebases = 0, dense_edits = 0;
};

class ConstraintSystem {
 public:
  // Number of channels that one sweep solves: trades reads of the factor for scratch memory of so many numbers per
  // vertex. On a torus of 102,400 vertices 8 and 40 channels take 1.8 and 1.5 times as long with half. With double, 40
  // channels take 0.85 of the time and twice the scratch memory.
  static constexpr Index channel_block = 8;

  explicit ConstraintSystem(const PinnedOperator& a) : operator_(a), state_(a.component_count(), *a.memory) {}
  ConstraintSystem(const ConstraintSystem& other);  // with its constraints and its counts
  ConstraintSystem& operator=(const ConstraintSystem&) = delete;

  // Throws HF_ERROR_CONFLICT (index = position in edit.add) if a new site depends linearly on the present hard sites.
  void edit(const SiteEdit& edit);
  // Factorises again with the present hard vertex sites eliminated, using the threads of `jobs`. Throws
  // HF_ERROR_EMPTY if there are none.
  void rebase(JobRunner& jobs);

  const ConstraintState& state() const noexcept { return state_; }
  const PinnedOperator& pinned_operator() const noexcept { return operator_; }
  // snapshot returns the present constraints; it shares their elimination paths and dense systems. restore goes back to
  // them bit for bit.
  std::shared_ptr<const ConstraintState> snapshot() const;
  void restore(const ConstraintState& state);

  // The next edit takes the paths of sites that another system of the same kind has under the same slots.
  void know(KnownPaths known) noexcept { known_ = std::move(known); }

  ConstraintCounts counts() const noexcept;
  void add_counts(const ConstraintCounts& more) noexcept;
  // True if a dense block has a pivot below this share of its diagonal: fields may then lose digits.
  bool is_crowded(double share) const noexcept;
  double row_bytes() const noexcept;   // bytes of elimination paths and dense blocks
  double base_bytes() const noexcept;  // bytes of the factor with sites eliminated
  // Returns the factor that paths and sweeps of the present state use.
  const factor::Factor& factor() const noexcept { return state_.base ? *state_.base->factor : *operator_.factor; }

  // The unknowns of the dense system, during a solve of m channels.
  struct Answer {
    explicit Answer(Memory& memory)
        : slot(&memory), freed(&memory), centre(&memory), constant(&memory), nu(&memory), total(&memory), x(&memory) {}
    double* of(Index row, std::size_t m) noexcept {
      return row >= 0 ? slot.data() + at(row) * m : freed.data() + at(ConstraintState::base_index(row)) * m;
    }
    const double* of(Index row, std::size_t m) const noexcept { return const_cast<Answer*>(this)->of(row, m); }
    // lambda: the flux into each site, by slot.
    Vector<double> slot;
    // t: the values of eliminated sites that were removed.
    Vector<double> freed;
    // The mean site value of every component. It is subtracted, so that a large common offset costs no digits.
    Vector<double> centre;
    // centre + nu by component. It is zero where K does not keep constants.
    Vector<double> constant;
    // By pinned unknown, where K does not keep constants.
    Vector<double> nu;
    // By component, for a refinement: minus the sum of its fluxes. Empty stands for zeros.
    Vector<double> total;
    Vector<double> x;  // scratch
  };
  // Each of the functions below takes the channels first .. first + count - 1 of values[slot * channels + c].
  //
  // The function sweep computes z: the field u in the order of the factor, without the constant of each component. It
  // includes the values t of removed eliminated sites. It has `count` numbers per unknown.
  void sweep(const double* values, Index channels, Index first, Index count, Answer& answer, double* z) const;
  // Computes the mean site value of every component and channel. A solve first subtracts this mean, so that a large
  // common offset costs no digits. The mean is zero for direction fields, where K does not map constants to zero.
  void find_centres(const double* values, Index channels, Index first, Index count, Answer& answer) const;
  // Solves the dense system of the sites for `answer`; call find_centres first. The array z holds the vector g of the
  // top of this file, which comes from the values of eliminated sites. It is null if the factor eliminates none.
  void solve_dense(const double* values, Index channels, Index first, Index count, const double* z,
                   Answer& answer) const;
  // Three steps of a solve, for callers with a right-hand side of their own (green_refine.cpp). The top of this file
  // explains the letters. The first step, subtract_projections, computes answer -= Y'z. The second, solve_rows,
  // replaces `answer` by the dense unknowns lambda, t and nu. The third, combine, computes z += Y lambda + Y_g nu.
  void subtract_projections(const double* z, Index count, Answer& answer) const;
  void solve_rows(Index count, Answer& answer) const;
  void combine(const Answer& answer, Index count, double* z) const;
  void count_sweeps(std::uint32_t more) const noexcept { sweeps_ += more; }

 private:
  ConstraintState::Decision decide(const SiteEdit& edit) const;
  Index first_row(const SiteEdit& edit, const factor::SiteCost& cost) const;
  bool has_base(const SiteEdit& edit, Index end) const;
  double again_ns(const SiteEdit& edit, const factor::SiteCost& cost) const;
  bool try_route(EditRoute route, const SiteEdit& edit, JobRunner& jobs, const ConstraintState::Decision& decision,
                 bool last = false);
  void base_forward(const double* values, Index channels, Index first, Index count, const Answer& answer,
                    double* z) const;
  void add_base_terms(const double* values, Index channels, Index first, Index count, Answer& answer) const;
  Memory& memory() const noexcept { return *operator_.memory; }

  PinnedOperator operator_;
  ConstraintState state_;
  KnownPaths known_;
  std::uint32_t path_solves_ = 0, rebases_ = 0, dense_edits_ = 0;
  mutable std::atomic<std::uint32_t> sweeps_{0};
};

}  // namespace hf_inner::solve

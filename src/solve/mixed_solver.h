// Solves bi-harmonic fields with the factor of the Laplacian alone, where K = L M^-1 L must not be formed.
//
// A vertex with d neighbours makes K a dense block of d x d entries, and K squares the condition number of L. The mixed
// formulation (Ciarlet and Raviart 1974) has a second field v = M^-1 L u instead:
//
//     L v = W lambda,   L u = M v,   W'u + D lambda = s
//
// W are the weights of the sites, lambda their fluxes and s their values. D_i is 1 / alpha_i, or 0 for hard sites. Both
// equations have the form of a harmonic field, so the inner engine is a GreenSolver on L with the same sites. Its soft
// sites have E_i = sqrt(D_i), because soft sites can depend on each other. With values c at its sites, its field is v =
// H c and its fluxes are lambda = T c. The load M v with the values s - D lambda gives it the field u. It also gives
// the fluxes T (s - D T c) - H'M H c, which must be 0:
//
//     (H'M H + T D T) c = T s
//
// The matrix is symmetric and positive definite. It is the mass matrix of the harmonic fields of the sites, so its
// condition number is small. Conjugate gradients take 5 to 100 steps to eight digits. A step costs one field and the
// fluxes of one load on the inner engine: two sweeps. The preconditioner is the lumped mass matrix H'M 1. A field takes
// corrections with the true K, applied as two products with L, until the last one is small.
//
// Edits cost as much as for a harmonic field. Memory: the harmonic factor and a few fields.
#pragma once
#include "solve/green.h"

namespace hf_inner::solve {

class MixedSolver final : public SiteSolver {
 public:
  explicit MixedSolver(std::shared_ptr<const surface::Core> core);  // of a core with a root
  MixedSolver(const MixedSolver& other);

  void edit(const SiteEdit& edit) override;
  void solve(const double* values, std::int32_t channels, double* field, double* flux) const override;
  void solve_into(const double* values, std::int32_t channels, FieldSink& sink) const override {
    solve_copied(*this, *core_, values, channels, sink);
  }
  void solve_at(const double* values, std::int32_t channels, Span<const std::int32_t> vertices,
                double* out) const override;
  bool correct(const double* values, std::int32_t channels, const double* field, const double* flux, double* change,
               double* flux_change) const override;
  std::shared_ptr<SiteSolver> on(std::shared_ptr<const surface::Core> core,
                                 std::shared_ptr<const surface::VertexMap>) const override {
    return make(std::move(core));
  }
  std::shared_ptr<SiteSolver> clone() const override { return make_owner_in<MixedSolver>(core_->memory, *this); }
  void rebase(JobRunner& jobs) override { inner_.rebase(jobs); }
  void succeed(const SiteSolver& predecessor) noexcept override {
    inner_.succeed(static_cast<const MixedSolver&>(predecessor).inner_);
  }
  EngineCounters counters() const noexcept override { return inner_.counters(); }
  std::int32_t site_count(std::int32_t component) const noexcept override { return inner_.site_count(component); }
  std::int32_t slot_count() const noexcept override { return inner_.slot_count(); }

 private:
  // All arrays below are of a block of m channels: by vertex and channel, or by slot and channel.
  struct Block;
  void solve_block(Block& block, const double* right, const double* gap, double* field, Vector<double>& flux) const;
  void find_values(Block& block, Vector<double>& residual, Vector<double>& values) const;
  void find_scale(Block& block) const;
  // right = W flux - K field, and gap: what the sites miss.
  void find_residual(Block& block, const double* values, const double* field, const Vector<double>& flux, double* right,
                     Vector<double>& gap) const;
  template <class Work>
  void each_site(Work&& work) const {
    for (std::size_t slot = 0; slot < sites_.size(); ++slot)
      if (sites_[slot].component >= 0) work(slot, sites_[slot]);
  }
  double softness(const Site& site) const noexcept {
    return site.compliance / core_->mean_diagonal[at(site.component)];
  }
  // field = M field
  void multiply_mass(double* field, std::size_t channels) const;
  Memory& memory() const noexcept { return *core_->memory; }

  std::shared_ptr<const surface::Core> core_;
  GreenSolver inner_;
  Vector<Site> sites_;  // by slot; component -1: not in use
};

}  // namespace hf_inner::solve

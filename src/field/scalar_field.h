// A harmonic field that can be edited: its set of sites and its engine. It is the object behind hf_solver.
//
// Every edit works on a copy of the site set, and replaces the original after the engine has accepted the change. So an
// exception leaves everything as it was. Copies share the immutable parts of the engine (elimination paths, dense
// blocks), so a copy costs its sites, and a host keeps copies for undo.
#pragma once
#include <memory>
#include <mutex>
#include <optional>

#include "base/jobs.h"
#include "solve/screened_solver.h"
#include "solve/site_set.h"

namespace hf_inner::field {

struct FieldEdit {
  std::uint32_t remove_count = 0;
  const std::uint32_t* remove_sites = nullptr;
  std::uint32_t move_count = 0;
  const std::uint32_t* move_sites = nullptr;
  mesh::Places move_to;
  std::uint32_t set_count = 0;
  const std::uint32_t* set_sites = nullptr;
  const double* set_values = nullptr;
  mesh::Places add;
  solve::SiteSet::Holds add_holds;
};

class ScalarField {
 public:
  // engine: one without sites on the same core; null: the engine of hosts.
  ScalarField(std::shared_ptr<const surface::Core> core, std::int32_t channels, std::uint32_t site_limit,
              std::shared_ptr<solve::SiteSolver> engine = nullptr);
  ScalarField(const ScalarField& other);  // shares the core and the immutable parts of the engine

  // out_sites: null, or room for add.count numbers. The numbers are written only on success.
  void edit(const FieldEdit& edit, std::uint32_t* out_sites);
  // Moves the sites to another core of the same geometry. Throws HF_ERROR_UNSUPPORTED (baselines) and what SiteSolver
  // and Screening::make throw.
  void move_to(std::shared_ptr<const surface::Core> core);
  // Screens the field: (K + A H) u = A H p + W lambda. strength: H by inner vertex; empty: no screening. target: p,
  // [vertex][channels]; null: 0. Throws HF_ERROR_UNSUPPORTED (baselines, bi-harmonic fields, graphs) and
  // what Screening::make throws.
  void set_screening(Span<const double> strength, const double* target);

  // Factorises with the present hard sites eliminated, on the calling thread, and keeps the result. The next edit
  // brings the result up to date and replaces the engine with it. This is the only function that may run during any
  // other call on the same object. Throws HF_ERROR_BUSY if another thread is in this function, and what
  // SiteSolver::rebase throws.
  void prepare_rebase();

  const surface::Core& core() const noexcept { return *core_; }
  const std::shared_ptr<const surface::Core>& shared_core() const noexcept { return core_; }
  const solve::SiteSet& sites() const noexcept { return sites_; }
  const solve::SiteSolver& engine() const noexcept { return *engine_; }
  bool is_screened() const noexcept { return screening_ != nullptr; }
  const solve::Screening* screening() const noexcept { return screening_.get(); }  // null: none

  // Throws HF_ERROR_EMPTY if the field has neither a site nor screening.
  void require_sites() const;
  // Solve functions; they throw HF_ERROR_EMPTY if the field has neither a site nor screening. field: welded vertex *
  // channels + c.
  void solve(double* field) const;
  void solve_into(solve::FieldSink& sink) const;
  solve::PreviewInfo solve_preview(std::int32_t corrections, double* field) const;
  void solve_at(Span<const std::int32_t> vertices, double* out) const;
  // Computes the flux of each site. out: slot of the site * channels + c; all 0 without sites. field: null, or receives
  // the field as solve does. Without sites it is not written.
  void flux(Vector<double>& out, double* field = nullptr) const;
  // The same in the caller's unit of weights. A site gets the fluxes of all its slots.
  void site_flux(Vector<double>& out) const;

 private:
  struct Prepared {
    explicit Prepared(const ScalarField& field)
        : core(field.core_),
          sites(field.sites_, *core->memory),
          engine(field.engine_->clone()),
          screening(field.screening_) {}
    std::shared_ptr<const surface::Core> core;
    solve::SiteSet sites;
    std::shared_ptr<solve::SiteSolver> engine;
    std::shared_ptr<const solve::Screening> screening;
  };
  bool adopt(const solve::SiteSet& next) noexcept;
  void take_engine(std::shared_ptr<solve::SiteSolver> engine);
  Memory& memory() const noexcept { return *core_->memory; }

  std::shared_ptr<const surface::Core> core_;
  std::uint32_t site_limit_;
  solve::SiteSet sites_;
  std::shared_ptr<solve::SiteSolver> engine_;
  std::shared_ptr<const solve::Screening> screening_;  // null: none
  std::mutex guard_;                                   // guards sites_, engine_ and prepared_ while prepare_rebase runs
  AtomicFlag preparing_{0};
  std::optional<Prepared> prepared_;  // a rebased engine and the sites it was made for
};

}  // namespace hf_inner::field

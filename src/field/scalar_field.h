// A harmonic field under edit: the site set, its engine and the undo stack. The object behind hf_solver.
//
// Every edit works on a copy of the site set and swaps it in after the engine has taken the change, so an exception
// leaves everything as it was. Records share the engine's immutable parts (paths, dense blocks), so undo restores the
// same bits.
#pragma once
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>

#include "base/history.h"
#include "engine/site_set.h"

namespace hf_inner {

struct FieldEdit {
  std::uint32_t remove_count = 0;
  const std::uint32_t* remove_sites = nullptr;
  std::uint32_t move_count = 0;
  const std::uint32_t* move_sites = nullptr;
  Places move_to;
  std::uint32_t set_count = 0;
  const std::uint32_t* set_sites = nullptr;
  const double* set_values = nullptr;
  Places add;
  const double* add_values = nullptr;
  const double* add_stiffness = nullptr;
};

class ScalarField {
 public:
  ScalarField(std::shared_ptr<const Core> core, EngineKind engine, double penalty, std::int32_t channels,
              std::uint32_t site_limit);
  ScalarField(const ScalarField& other);  // shares the core; without the undo stack

  // out_sites: null, or add.count numbers; written only on success.
  void edit(const FieldEdit& edit, std::uint32_t* out_sites);
  void record();
  void undo();
  void redo();

  // Factorises with the present hard sites eliminated, on the calling thread, and keeps the result for the next edit,
  // which brings it up to date and swaps it in. The one function that may run beside any other of the same object.
  // Throws HF_ERROR_BUSY when another thread does the same, and as SiteSolver::rebase.
  void prepare_rebase();

  const Core& core() const noexcept { return *core_; }
  const std::shared_ptr<const Core>& shared_core() const noexcept { return core_; }
  const SiteSet& sites() const noexcept { return sites_; }
  const SiteSolver& engine() const noexcept { return *engine_; }

  // Throws HF_ERROR_NO_SITES when there is none. field: inner vertex * channels + c.
  void solve(double* field) const;
  void solve_into(FieldSink& sink) const;
  PreviewInfo solve_preview(std::int32_t corrections, double* field) const;
  void solve_at(Span<const std::int32_t> vertices, double* out) const;
  // out: slot * channels + c; without sites all 0. field: null, or that of solve too, not written without sites.
  void flux(Vector<double>& out, double* field = nullptr) const;

 private:
  struct Record {
    Record(const SiteSet& set, std::shared_ptr<SiteSolver> solver, Memory& memory)
        : sites(set, memory), engine(std::move(solver)) {}
    SiteSet sites;
    std::shared_ptr<SiteSolver> engine;  // null: the engine has no cheap copy and follows by an edit
  };
  bool adopt(const SiteSet& next) noexcept;
  Record present() const;
  void require_sites() const;
  void restore(Record& record);
  Memory& memory() const noexcept { return *core_->memory; }

  std::shared_ptr<const Core> core_;
  std::uint32_t site_limit_;
  SiteSet sites_;
  std::shared_ptr<SiteSolver> engine_;
  History<Record> history_;
  std::mutex guard_;  // sites_, engine_ and prepared_, between prepare_rebase and the functions that change them
  std::atomic<bool> preparing_{false};
  std::optional<Record> prepared_;  // a rebased engine and the sites it was made for
};

}  // namespace hf_inner

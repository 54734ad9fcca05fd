// The engine green on a screened operator: solves (K + A H) u = A H p + W lambda with W'u + D lambda = s.
//
// The operator and the field without sites depend on H and p alone. Copies of the engine and its records share them.
#pragma once
#include "solve/screened.h"
#include "solve/site_solver.h"

namespace hf_inner::solve {

// The screening of a solver and the field that it gives without sites. Immutable.
struct Screening {
  Screening(std::shared_ptr<const ScreenedOperator> made, Memory& memory)
      : screened(std::move(made)), reaches(&memory), strength(&memory), target(&memory) {}
  // strength: H by inner vertex, in 1 / (inner unit)^2, at least 0. target: p, [vertex][channels]; null: 0. Throws
  // HF_ERROR_TOO_LARGE (index = vertex as given), and HF_ERROR_NOT_POSITIVE_DEFINITE if H of a component is so small
  // that rounding hides it.
  static std::shared_ptr<const Screening> make(std::shared_ptr<const surface::Core> core, Span<const double> strength,
                                               const double* target, Index channels);
  std::shared_ptr<const ScreenedOperator> screened;  // first member: its memory outlives the rest
  Vector<std::uint8_t> reaches;                      // by component: 1 if some H in it is above 0
  bool reaches_any = false;
  Vector<double> strength;  // H, as given to make
  Vector<double> target;    // p, [vertex][channels]; empty: 0
  Buffer<double> field;     // [vertex][channels] without sites; 0 on components without screening

 private:
  void correct_field(Index channels);
};

class ScreenedSolver final : public SiteSolver {
 public:
  explicit ScreenedSolver(std::shared_ptr<const Screening> screening)
      : screening_(std::move(screening)), system_(screening_->screened->view()) {}

  void edit(const SiteEdit& edit) override { system_.edit(edit); }
  void solve(const double* values, std::int32_t channels, double* field, double* flux) const override;
  void solve_into(const double* values, std::int32_t channels, FieldSink& sink) const override {
    solve_copied(*this, core(), values, channels, sink);
  }
  void solve_at(const double* values, std::int32_t channels, Span<const std::int32_t> vertices,
                double* out) const override;
  bool correct(const double* values, std::int32_t channels, const double* field, const double* flux, double* change,
               double* flux_change) const override;
  std::shared_ptr<SiteSolver> on(std::shared_ptr<const surface::Core> core,
                                 std::shared_ptr<const surface::VertexMap>) const override {
    return make(std::move(core));
  }
  std::shared_ptr<SiteSolver> clone() const override { return make_owner_in<ScreenedSolver>(core().memory, *this); }
  void rebase(JobRunner& jobs) override { system_.rebase(jobs); }
  bool takes_screening() const noexcept override { return true; }
  EngineCounters counters() const noexcept override;
  // The sites of a component; screening counts as one more.
  std::int32_t site_count(std::int32_t component) const noexcept override {
    return system_.state().sites_of[at(component)] + screening_->reaches[at(component)];
  }
  std::int32_t slot_count() const noexcept override {
    return static_cast<std::int32_t>(system_.state().entries.size());
  }

 private:
  void eliminated_flux(Index channels, const double* field, double* flux) const;
  const surface::Core& core() const noexcept { return *screening_->screened->core; }

  std::shared_ptr<const Screening> screening_;  // before the system, which reads its operator
  ConstraintSystem system_;
};

}  // namespace hf_inner::solve

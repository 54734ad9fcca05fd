// The engine green: it factorises once, and edits of sites do not change the factor. The constraint system
// (constraint_system.h) does the edits. Here it has the operator K of a surface, which maps constants to zero. This
// class adds channels, refinement, partial fields, previews and fluxes.
#pragma once
#include "engine/constraint_system.h"
#include "engine/site_solver.h"

namespace hf_inner {

class GreenSolver final : public SiteSolver {
 public:
  explicit GreenSolver(std::shared_ptr<const Core> core);
  GreenSolver(const GreenSolver& other);

  void edit(const SiteEdit& edit) override { system_.edit(edit); }
  void solve(const double* values, std::int32_t channels, double* field, double* flux) const override;
  void solve_into(const double* values, std::int32_t channels, FieldSink& sink) const override;
  void solve_at(const double* values, std::int32_t channels, Span<const std::int32_t> vertices,
                double* out) const override;
  void solve_preview(const double* values, std::int32_t channels, std::int32_t corrections, double* field,
                     PreviewInfo& info) const override;
  std::shared_ptr<SiteSolver> clone() const override { return make_owner_in<GreenSolver>(core_->memory, *this); }
  void rebase(JobRunner& jobs) override { system_.rebase(jobs); }
  void succeed(const SiteSolver& predecessor) noexcept override;
  EngineKind kind() const noexcept override { return EngineKind::green; }
  EngineCounters counters() const noexcept override;
  std::int32_t site_count(std::int32_t component) const noexcept override { return state().sites_of[at(component)]; }
  std::int32_t slot_count() const noexcept override { return static_cast<std::int32_t>(state().entries.size()); }

 private:
  using Answer = ConstraintSystem::Answer;
  static constexpr Index channel_block = ConstraintSystem::channel_block;
  Index refinements() const noexcept;  // steps with the true operator that a field takes
  bool reached(std::size_t component) const noexcept { return state().sites_of[component] > 0; }
  // Copies channels first .. first + count - 1 of the hard vertex sites into the field, bit for bit. row_of(vertex)
  // returns where the row of the vertex is.
  template <class RowOf>
  void copy_hard_values(const double* values, Index channels, Index first, Index count, RowOf&& row_of) const;
  // Writes the field by vertex. It is the result z of the sweep, in the order of the factor, plus the constant of each
  // component.
  void write_field(const double* z, Index channels, Index first, Index count, const Answer& answer,
                   double* field) const;
  void base_flux(Index channels, const double* field, double* flux) const;
  // The following functions are in green_refine.cpp.
  struct SingleSweeps;
  void refine(const double* values, Index channels, Index first, Index count, double* z, Answer& answer, double* field,
              SingleSweeps* single = nullptr) const;
  // The following function is in green_preview.cpp.
  double value_range(const double* values, Index channels, Index first, Index count) const;

  const ConstraintState& state() const noexcept { return system_.state(); }
  Memory& memory() const noexcept { return *core_->memory; }

  std::shared_ptr<const Core> core_;  // before the system, which reads it
  ConstraintSystem system_;
  ConstraintCounts cloned_at_;  // counts of the engine this one was cloned from, at that time
};

// Data for a refinement whose sweeps run in single precision.
struct GreenSolver::SingleSweeps {
  const PreviewFactor& factor;
  float* scratch;  // room for the right-hand sides
  double largest;  // written: the largest change of a value
};

template <class RowOf>
void GreenSolver::copy_hard_values(const double* values, Index channels, Index first, Index count,
                                   RowOf&& row_of) const {
  for (std::size_t slot = 0; slot < state().entries.size(); ++slot) {
    const auto& entry = state().entries[slot];
    if (!entry.used() || !entry.site.is_hard_vertex()) continue;
    const double* from = values + slot * at(channels) + at(first);
    double* to = row_of(entry.site.vertex[0]);
    for (std::size_t q = 0; q < at(count); ++q) to[q] = from[q];
  }
}

}  // namespace hf_inner

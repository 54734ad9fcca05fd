// The engine green: it factorises once, and edits of sites do not change the factor. The constraint system
// (constraint_system.h) does the edits. Here it has the operator K of a surface, which maps constants to zero. This
// class adds channels, refinement, partial fields, previews and fluxes.
#pragma once
#include "solve/constraint_system.h"
#include "solve/corrections.h"
#include "solve/site_solver.h"

namespace hf_inner::solve {

class GreenSolver final : public SiteSolver {
 public:
  // crowded: a field is refined if the dense system of its sites has a pivot below this share of its diagonal.
  explicit GreenSolver(std::shared_ptr<const surface::Core> core, double crowded = crowded_share);
  GreenSolver(const GreenSolver& other);

  void edit(const SiteEdit& edit) override { system_.edit(edit); }
  void solve(const double* values, std::int32_t channels, double* field, double* flux) const override;
  void solve_into(const double* values, std::int32_t channels, FieldSink& sink) const override;
  void solve_at(const double* values, std::int32_t channels, Span<const std::int32_t> vertices,
                double* out) const override;
  void solve_preview(const double* values, std::int32_t channels, std::int32_t corrections, double* field,
                     PreviewInfo& info) const override;
  bool correct(const double* values, std::int32_t channels, const double* field, const double* flux, double* change,
               double* flux_change) const override;
  std::shared_ptr<SiteSolver> on(std::shared_ptr<const surface::Core> core,
                                 std::shared_ptr<const surface::VertexMap> map) const override;
  std::shared_ptr<SiteSolver> clone() const override { return make_owner_in<GreenSolver>(core_->memory, *this); }
  void respond(const double* load, const double* values, std::int32_t channels, double* field,
               double* flux) const override;
  // Smallest and largest site value by component and channel; low above high where there is none.
  void value_extent(const double* values, Index channels, Index first, Index count, Vector<double>& low,
                    Vector<double>& high) const;
  void rebase(JobRunner& jobs) override { system_.rebase(jobs); }
  void succeed(const SiteSolver& predecessor) noexcept override;
  bool takes_screening() const noexcept override { return true; }
  EngineCounters counters() const noexcept override;
  std::int32_t site_count(std::int32_t component) const noexcept override { return state().sites_of[at(component)]; }
  std::int32_t slot_count() const noexcept override { return static_cast<std::int32_t>(state().entries.size()); }

 private:
  using Answer = ConstraintSystem::Answer;
  static constexpr Index channel_block = ConstraintSystem::channel_block;
  // True if the field takes corrections with the true operator.
  bool is_refined() const noexcept;
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
  // in green_refine.cpp
  struct Step;
  void refine(const double* values, Index channels, Index first, Index count, double* z, Answer& answer, double* field,
              Step& step) const;
  void refine_until_small(const double* values, Index channels, Index first, Index count, double* z, Answer& answer,
                          double* field) const;
  void clear_answer(Index count, Answer& next) const;
  void solve_right(double* z, Index count, Answer& next, const Step& step, bool dense_only) const;
  // in green_preview.cpp
  double value_range(const double* values, Index channels, Index first, Index count) const;

  const ConstraintState& state() const noexcept { return system_.state(); }
  Memory& memory() const noexcept { return *core_->memory; }

  std::shared_ptr<const surface::Core> core_;  // before the system, which reads it
  ConstraintSystem system_;
  double crowded_;
  ConstraintCounts cloned_at_;  // counts of the engine this one was cloned from, at that time
};

// The options of a refinement, and its results.
struct GreenSolver::Step {
  // If it is set, the sweeps run in single precision with this factor, and `scratch` holds their right-hand sides.
  const factor::PreviewFactor* single = nullptr;
  float* scratch = nullptr;
  // The unit in which changes are measured, by component and channel. Null stands for 1.
  const double* unit = nullptr;
  // If it is set, the change goes here, in the layout of the field. Field and answer then stay as they are.
  double* change = nullptr;
  // Goes with `change`: receives the change of the flux, by slot.
  double* flux_change = nullptr;
  // Receives the largest change of a value.
  double largest = 0;
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

}  // namespace hf_inner::solve

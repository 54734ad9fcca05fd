// Harmonic fields whose constraints change: one interface, three engines.
//
//     K u = W lambda,   w_i' u + lambda_i / alpha_i = s_i     (alpha = infinity: a hard site)
//
// A Site is a linear functional w on the vertices (a vertex, or three barycentric weights). Sites stand in slots that
// the caller (SiteSet, a pose) chooses. Edits are all or nothing: on an exception the engine is as before.
#pragma once
#include <cstdint>
#include <memory>

#include "engine/core.h"
#include "engine/site.h"

namespace hf_inner {

enum class EngineKind : std::int32_t { green = 0, updown = 1, refactor = 2 };

struct EngineCounters {
  std::uint32_t factorisations = 0, path_solves = 0, sweeps = 0;
  std::uint32_t rebases = 0, dense_edits = 0;
  std::uint32_t dense_rows = 0, eliminated = 0;  // sites at present
  EditRoute last_route = EditRoute::none;
  double dense_ms = 0, rebase_ms = 0;  // what the cost model said at the last edit: rows, or a rebase
  bool rebase_advised = false;         // a field reads more of the sites' paths than of the factor
  double bytes = 0;
};

// Accuracy of a preview.
struct PreviewInfo {
  bool exact = false;             // solve gave the answer, without single precision
  std::int32_t corrections = 0;   // made
  double value_range = 0;         // widest range of the site values of a component and channel
  double largest_correction = 0;  // largest change of a value by the last correction
  double error_estimate = 0;      // largest error of the field; 0 when exact
  double bytes = 0;               // size of the single-precision copy
};

// Takes channels [first, first + count) of a field where they lie: inner vertex v at z[row[v] * count], or at z[v *
// count] when row is null.
class FieldSink {
 public:
  virtual ~FieldSink() = default;
  virtual void take(std::int32_t first, std::int32_t count, const double* z, const std::int32_t* row) = 0;
};

class SiteSolver {
 public:
  // penalty: weight of hard sites relative to the mean diagonal, for updown only.
  static std::shared_ptr<SiteSolver> make(EngineKind kind, std::shared_ptr<const Core> core, double penalty);
  virtual ~SiteSolver() = default;

  // All or nothing. Throws HF_ERROR_CONFLICT (index = position in edit.add) when a new site depends linearly on the
  // hard sites there are.
  virtual void edit(const SiteEdit& edit) = 0;

  // The field of every inner vertex: field[vertex * channels + c]. values[slot * channels + c] for every slot in use.
  // Vertices of components without a site get 0. Hard vertex sites hold their values exactly. flux: null, or
  // slot_count() rows, written for free slots too. Const functions may run at the same time on one engine.
  virtual void solve(const double* values, std::int32_t channels, double* field, double* flux) const = 0;

  // The same field, given to the sink without a copy in between.
  virtual void solve_into(const double* values, std::int32_t channels, FieldSink& sink) const = 0;

  // The field at chosen inner vertices: for engine green at the cost of their elimination paths.
  virtual void solve_at(const double* values, std::int32_t channels, Span<const std::int32_t> vertices,
                        double* out) const = 0;

  // The field by a single-precision factor and so many corrections in double; engines that have none give the field.
  virtual void solve_preview(const double* values, std::int32_t channels, std::int32_t corrections, double* field,
                             PreviewInfo& info) const {
    (void)corrections;
    solve(values, channels, field, nullptr);
    info = PreviewInfo{};
    info.exact = true;
  }

  // One step of refinement from a field and a flux of this layout, as a change of both: about their error, if the
  // factor is right. False, and nothing written: the engine has none.
  virtual bool correct(const double* values, std::int32_t channels, const double* field, const double* flux,
                       double* change, double* flux_change) const {
    (void)values, (void)channels, (void)field, (void)flux, (void)change, (void)flux_change;
    return false;
  }

  // A copy that shares what is immutable.
  virtual std::shared_ptr<SiteSolver> clone() const = 0;

  // Moves the present hard vertex sites into the factor, on these threads. Throws HF_ERROR_UNSUPPORTED (engines other
  // than green), HF_ERROR_NO_SITES (none is hard). All or nothing.
  virtual void rebase(JobRunner& jobs);
  // Takes over the counts that `predecessor`, of which this is a clone, has made since.
  virtual void succeed(const SiteSolver& predecessor) noexcept { (void)predecessor; }

  virtual EngineKind kind() const noexcept = 0;
  virtual EngineCounters counters() const noexcept = 0;
  // Sites of a component at present.
  virtual std::int32_t site_count(std::int32_t component) const noexcept = 0;
  virtual std::int32_t slot_count() const noexcept = 0;  // 1 + the largest slot ever used
};

// solve_into by way of solve, for engines that have nothing better.
inline void solve_copied(const SiteSolver& solver, const Core& core, const double* values, std::int32_t channels,
                         FieldSink& sink) {
  Workspace field(core.workspaces, static_cast<std::size_t>(core.size()) * static_cast<std::size_t>(channels));
  solver.solve(values, channels, field.data(), nullptr);
  sink.take(0, channels, field.data(), nullptr);
}

}  // namespace hf_inner

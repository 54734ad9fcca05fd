// The interface of the engines that solve harmonic fields u under changing constraints. Green (green.h) is the one of
// hosts. The room peers has the baselines it is compared with.
//
//     K u = W lambda,   w_i' u + lambda_i / alpha_i = s_i     (alpha_i = infinity: a hard site)
//
// Site i has the weights w_i, which are the columns of W, the stiffness alpha_i and the value s_i. lambda_i is the flux
// into it. A Site is a vertex, or a point with three barycentric weights. The caller (SiteSet or a pose) chooses the
// slot, which is the number of a site. An edit does everything or throws and changes nothing.
#pragma once
#include <cstdint>
#include <memory>

#include "solve/site.h"
#include "surface/core.h"

namespace hf_inner::surface {
class VertexMap;
}

namespace hf_inner::solve {

// Channels of one field; hf/solver.h states it. The rows of writers have this width.
constexpr std::uint32_t most_channels = 64;

// Tolerance of a certificate unless the caller gives one. Fields of exact engines stay well below it.
constexpr double exact_tolerance = 1e-8;

struct EngineCounters {
  std::uint32_t factorisations = 0;  // the core's own is the first
  std::uint32_t path_solves = 0, sweeps = 0;
  std::uint32_t rebases = 0, dense_edits = 0;
  std::uint32_t dense_rows = 0, eliminated = 0;  // sites as dense rows, and sites eliminated in the factor
  EditRoute last_route = EditRoute::none;
  double dense_ms = 0, rebase_ms = 0;  // predicted cost of the last edit: with dense rows, or with a new factor
  bool rebase_advised = false;         // a solve reads more bytes of elimination paths than of the factor
  double bytes = 0;
};

// The accuracy of a preview.
struct PreviewInfo {
  bool exact = false;             // the exact field, without single precision
  std::int32_t corrections = 0;   // corrections made
  double value_range = 0;         // widest range of the site values of a component and channel
  double largest_correction = 0;  // largest change of a value by the last correction
  double error_estimate = 0;      // largest error of the field; 0 when exact
  double bytes = 0;               // size of the single-precision copy
};

// Receives a block of channels of a field from the engine. The channels are first .. first + count - 1. Welded vertex v
// is at z[row[v] * count], or at z[v * count] if row is null.
class FieldSink {
 public:
  virtual ~FieldSink() = default;
  virtual void take(std::int32_t first, std::int32_t count, const double* z, const std::int32_t* row) = 0;
};

class SiteSolver {
 public:
  // Makes the engine of hosts: green, or the mixed solver (mixed_solver.h) on a core with a root.
  static std::shared_ptr<SiteSolver> make(std::shared_ptr<const surface::Core> core);
  virtual ~SiteSolver() = default;

  // Applies an edit completely, or throws and changes nothing. Throws HF_ERROR_CONFLICT (index = position in edit.add)
  // if a new site depends linearly on the present hard sites.
  virtual void edit(const SiteEdit& edit) = 0;

  // Solves for the field of every welded vertex: field[vertex * channels + c]. values: values[slot * channels + c] for
  // every slot in use. Vertices of components without a site get 0. Hard vertex sites get their values exactly. flux:
  // null, or room for slot_count() rows; free slots get a row too. Const functions may run at the same time on one
  // engine.
  virtual void solve(const double* values, std::int32_t channels, double* field, double* flux) const = 0;

  // Solves for the same field and passes it to the sink without an extra copy.
  virtual void solve_into(const double* values, std::int32_t channels, FieldSink& sink) const = 0;

  // Solves for the field at chosen welded vertices. The engine green needs only the elimination paths of these
  // vertices.
  virtual void solve_at(const double* values, std::int32_t channels, Span<const std::int32_t> vertices,
                        double* out) const = 0;

  // Solves with a single-precision factor, and makes `corrections` corrections in double. An engine without such a
  // factor gives the exact field.
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

  // Solves K u = load + W lambda with W'u + D lambda = values by two sweeps, without corrections. load is by vertex.
  // values are by slot, 0 at hard vertex sites; null means all 0. There are at most ConstraintSystem::channel_block
  // channels. field must not be load. If it is null, one sweep gives the flux alone. The engine green has it; others
  // throw HF_ERROR_UNSUPPORTED.
  virtual void respond(const double* load, const double* values, std::int32_t channels, double* field,
                       double* flux) const;

  // An engine of hosts returns an engine without sites on another core. Baselines return null. map: from the vertices
  // of this core to the vertices of the other core. Without a map both cores have the same vertices.
  virtual std::shared_ptr<SiteSolver> on(std::shared_ptr<const surface::Core> core,
                                         std::shared_ptr<const surface::VertexMap> map = nullptr) const {
    (void)core, (void)map;
    return nullptr;
  }
  // Returns a copy that shares all immutable parts.
  virtual std::shared_ptr<SiteSolver> clone() const = 0;

  // Factorises again with the present hard vertex sites eliminated, using the threads of `jobs`. Throws
  // HF_ERROR_UNSUPPORTED (engines other than green) or HF_ERROR_EMPTY (no site is hard). If it throws, nothing
  // changes.
  virtual void rebase(JobRunner& jobs);
  // Adds the counts that `predecessor` has made since this engine was cloned from it.
  virtual void succeed(const SiteSolver& predecessor) noexcept { (void)predecessor; }

  // Whether its field can be screened (screened_solver.h).
  virtual bool takes_screening() const noexcept { return false; }
  // How exactly a field of this engine meets its equations: the tolerance of a certificate unless the caller gives one.
  virtual double tolerance() const noexcept { return exact_tolerance; }
  virtual EngineCounters counters() const noexcept = 0;
  // Returns the present number of sites of a component.
  virtual std::int32_t site_count(std::int32_t component) const noexcept = 0;
  virtual std::int32_t slot_count() const noexcept = 0;  // 1 + the largest site number ever used
};

// Implements solve_into by solve, for engines without a faster way.
inline void solve_copied(const SiteSolver& solver, const surface::Core& core, const double* values,
                         std::int32_t channels, FieldSink& sink) {
  surface::Workspace field(core.workspaces, static_cast<std::size_t>(core.size()) * static_cast<std::size_t>(channels));
  solver.solve(values, channels, field.data(), nullptr);
  sink.take(0, channels, field.data(), nullptr);
}

}  // namespace hf_inner::solve

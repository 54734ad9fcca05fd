// Harmonic fields whose constraints change: one interface, three engines.
//
//     K u = W lambda,   w_i' u + lambda_i / alpha_i = s_i     (alpha = infinity: a hard site)
//
// A Site is a linear functional w on the vertices (a vertex, or three barycentric weights). Sites live in slots; the
// caller (SiteSet, a pose) decides the slots. Edits are all or nothing: on an exception the engine is as before.
#pragma once
#include <cstdint>
#include <memory>

#include "engine/core.h"

namespace hf {

struct Site {
  std::int32_t vertex[3] = {-1, -1, -1};  // inner vertices; unused corners are -1
  double weight[3] = {0, 0, 0};
  double compliance = 0;  // 1 / alpha; 0 = hard
  std::int32_t component = -1;
  bool is_vertex() const noexcept { return vertex[1] < 0; }
  static Site at_vertex(const Mesh& mesh, std::int32_t vertex, double compliance = 0) noexcept {
    Site site;
    site.vertex[0] = vertex, site.weight[0] = 1, site.compliance = compliance;
    site.component = mesh.component[static_cast<std::size_t>(vertex)];
    return site;
  }
};

enum class EngineKind : std::int32_t { green = 0, updown = 1, refactor = 2 };

struct EngineCounters {
  std::uint32_t factorisations = 0, path_solves = 0, sweeps = 0;
  double bytes = 0;
};

// Slots to leave and slots to fill. A slot may stand in both: a move.
struct SiteEdit {
  Span<const std::int32_t> remove;
  Span<const std::int32_t> add;
  Span<const Site> sites;  // for `add`, in its order
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
  // Vertices of components without a site get 0. Hard vertex sites hold their values exactly. flux: null, or like
  // values. Const functions may run at the same time on one engine.
  virtual void solve(const double* values, std::int32_t channels, double* field, double* flux) const = 0;

  // The field at chosen inner vertices, at the cost of their elimination paths.
  virtual void solve_at(const double* values, std::int32_t channels, Span<const std::int32_t> vertices,
                        double* out) const = 0;

  // A copy that shares what is immutable.
  virtual std::shared_ptr<SiteSolver> clone() const = 0;

  virtual EngineKind kind() const noexcept = 0;
  virtual EngineCounters counters() const noexcept = 0;
  // Sites of a component at present.
  virtual std::int32_t site_count(std::int32_t component) const noexcept = 0;
  virtual std::int32_t slot_count() const noexcept = 0;  // 1 + the largest slot ever used
};

}  // namespace hf

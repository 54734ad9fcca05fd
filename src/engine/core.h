// Geometry, operator and factor: what all fields of one kind on one surface share. Immutable once made, so any number
// of threads may read it; only the workspace pools inside have a lock.
#pragma once
#include <cstdint>
#include <memory>

#include "base/jobs.h"
#include "base/memory.h"
#include "engine/geometry.h"
#include "engine/preview_cache.h"
#include "factor/factor.h"

namespace hf_inner {

struct CoreOptions {
  OperatorKind operator_kind = OperatorKind::intrinsic_delaunay;
  FieldKind field_kind = FieldKind::harmonic;
  Ordering ordering = Ordering::nested_dissection;
  bool need_factor = true;                // the engines updown and refactor keep their own
  Span<const std::uint8_t> saved_factor;  // not empty: the factor is loaded from these bytes instead of made
  bool borrow_factor = false;             // its numbers are read in place: the bytes outlive the core
  Progress* progress = nullptr;
};

struct CoreTimes {
  double weld_ms = 0, operator_ms = 0;
};

struct Core {
  explicit Core(std::shared_ptr<const Geometry> shape);
  // The operator K on a geometry and its grounded factor A = K + sum_c beta_c e_gc e_gc' (beta_c = mean diagonal of
  // component c, g_c its first vertex). options.operator_kind must be the geometry's. Progress: 0.15 to 1.
  static std::shared_ptr<const Core> make(std::shared_ptr<const Geometry> shape, const CoreOptions& options);
  // Both in one call.
  static std::shared_ptr<const Core> make(const MeshInput& input, const CoreOptions& options,
                                          std::shared_ptr<Memory> memory, std::shared_ptr<JobRunner> jobs);

  std::int32_t size() const noexcept { return mesh.vertex_count(); }

  std::shared_ptr<Memory> memory;  // first member: outlives what is allocated from it
  std::shared_ptr<const Geometry> geometry;
  std::shared_ptr<JobRunner> jobs;
  const Mesh& mesh;  // these four: the geometry's
  const Topology& topology;
  const Vector<double>& areas;
  const Vector<double>& weights;
  FieldKind field_kind = FieldKind::harmonic;
  SymmetricMatrix laplacian;     // K: L, or bi-harmonic
  Vector<std::int32_t> ground;   // per component
  Vector<double> mean_diagonal;  // per component
  // Corrections with the true operator, in difference form, that a field takes after its sweep: 0 for second-order
  // operators, 1 for bi-harmonic ones, whose condition is squared.
  std::int32_t refinements = 0;
  // Rounding in the factor shows in the fields of a long shape (Factor::commute_time). They take corrections until the
  // last one is small (green_refine.cpp).
  bool is_long = false;
  // 0, or the weights of some components were limited because they did not factor (lost_components.h). Then it is the
  // hash of A before that, plus one. A saved factor stores it, so loading knows early that weights must be limited.
  std::uint64_t confined_hash = 0;
  // Vertices with a weight that a rule set, and the first of them. A rule sets the weights of triangles that are too
  // thin for their own, and weights that spread over more digits than there are.
  std::uint32_t changed_count = 0;
  std::int32_t first_changed = -1;
  Ordering ordering = Ordering::nested_dissection;
  std::shared_ptr<const Factor> factor;  // of A; null when the options asked for none
  CoreTimes times;
  mutable PreviewCache preview;  // the factor in single precision
  WorkspacePool& workspaces;     // the geometry's
  WorkspacePool& zeroed_workspaces;
};

// The grounded matrix A.
SymmetricMatrix grounded(const Core& core);
// Its hash, by which a saved factor knows its mesh: pattern and numbers of K, grounds and their weights.
std::uint64_t grounded_hash(const Core& core);
// Coordinates of the inner vertices as the ordering takes them.
Vector<float> ordering_coordinates(const Mesh& mesh, Memory& memory);

}  // namespace hf_inner

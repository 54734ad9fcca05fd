// What all solvers, clones, poses and transfers of one surface share: mesh, operator, factor. Immutable once made, so
// any number of threads may read it; only the workspace pool inside has a lock.
#pragma once
#include <cstdint>
#include <memory>
#include <mutex>

#include "base/jobs.h"
#include "base/memory.h"
#include "engine/preview_cache.h"
#include "factor/factor.h"
#include "mesh/laplacian.h"
#include "mesh/mesh.h"
#include "mesh/topology.h"

namespace hf_inner {

// Large scratch arrays that are used again and again: first touch of fresh memory costs more than a sweep.
class WorkspacePool {
 public:
  // zeroed: buffers of this pool are all zero when taken, and must be all zero when given back.
  explicit WorkspacePool(Memory& memory, bool zeroed = false) : memory_(memory), zeroed_(zeroed), free_(&memory) {}
  // Moves a buffer of at least `size` doubles out of the pool, or makes one.
  Buffer<double> take(std::size_t size);
  // Puts it back; never throws (the buffer is released when the pool cannot grow).
  void give(Buffer<double>&& buffer) noexcept;

 private:
  Memory& memory_;
  const bool zeroed_;
  std::mutex mutex_;
  Vector<Buffer<double>> free_;
};

// A buffer of the pool for one scope.
class Workspace {
 public:
  Workspace(WorkspacePool& pool, std::size_t size) : pool_(pool), buffer_(pool.take(size)) {}
  ~Workspace() {
    if (!dropped_) pool_.give(std::move(buffer_));
  }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;
  double* data() noexcept { return buffer_.data(); }
  double& operator[](std::size_t i) noexcept { return buffer_[i]; }
  // Of a zeroed pool: the buffer is in use and must not go back unless clean() is called.
  void soil() noexcept { dropped_ = true; }
  void clean() noexcept { dropped_ = false; }

 private:
  bool dropped_ = false;
  WorkspacePool& pool_;
  Buffer<double> buffer_;
};

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
  Core(std::shared_ptr<Memory> owner, std::shared_ptr<JobRunner> runner);
  // Intake, operator, grounded factor A = K + sum_c beta_c e_gc e_gc' (beta_c = mean diagonal of component c, g_c its
  // first vertex).
  static std::shared_ptr<const Core> make(const MeshInput& input, const CoreOptions& options,
                                          std::shared_ptr<Memory> memory, std::shared_ptr<JobRunner> jobs);

  std::int32_t size() const noexcept { return mesh.vertex_count(); }

  std::shared_ptr<Memory> memory;  // first member: outlives what is allocated from it
  std::shared_ptr<JobRunner> jobs;
  Mesh mesh;
  Topology topology;
  Vector<double> areas;          // per vertex, a third of the triangles around it
  Vector<double> weights;        // per edge of the mesh, of the Laplacian L
  SymmetricMatrix laplacian;     // K: L, or bi-harmonic
  Vector<std::int32_t> ground;   // per component
  Vector<double> mean_diagonal;  // per component
  // Corrections with the true operator, in difference form, that a field takes after its sweep: 0 for second-order
  // operators, 1 for bi-harmonic ones, whose condition is squared.
  std::int32_t refinements = 0;
  // Where components had to be confined (lost_components.h): one more than the hash of A before, by which bytes of a
  // saved factor tell that before the components are looked for; else 0.
  std::uint64_t confined_hash = 0;
  Ordering ordering = Ordering::nested_dissection;
  std::shared_ptr<const Factor> factor;  // of A; null when the options asked for none
  CoreTimes times;
  mutable PreviewCache preview;  // the factor in single precision
  mutable WorkspacePool workspaces;
  mutable WorkspacePool zeroed_workspaces;
};

// The grounded matrix A.
SymmetricMatrix grounded(const Core& core);
// Its hash, by which a saved factor knows its mesh: pattern and numbers of K, grounds and their weights.
std::uint64_t grounded_hash(const Core& core);
// Coordinates of the inner vertices as the ordering takes them.
Vector<float> ordering_coordinates(const Mesh& mesh, Memory& memory);

}  // namespace hf_inner

// Factors a symmetric positive definite sparse matrix, P A P' = G G' (Cholesky). The factor is immutable:
//   factorise   fill-reducing ordering, symbolic analysis, numeric supernodal factorisation;
//   sweeps      z <- G^-1 z (forward), z <- G^-T z (backward), m right-hand sides at once;
//   paths       Y = G^-1 P W for sparse columns of W (sites): non-zero only along elimination-tree paths;
//   Gram        Y_a' Y_b;   combine: z += Y lambda.
// Everything is double, deterministic, and the same bits for any number of threads.
#pragma once
#include <cstdint>
#include <memory>

#include "base/jobs.h"
#include "base/memory.h"
#include "base/progress.h"
#include "base/span.h"
#include "factor/matrix.h"

namespace hf_inner {

enum class Ordering : std::int32_t {
  nested_dissection = 0,  // our own multilevel nested dissection on graph and geometry
  minimum_degree = 1,     // approximate, of the whole matrix
  metis = 2,              // METIS through CHOLMOD; only in builds with HF_WITH_GPL (CHOLMOD), its rand() use isolated
  natural = 3,
};

// A pivot below this share of its diagonal entry is rounding noise: the matrix is singular to working precision.
constexpr double default_lost_share = 0x1p-46;

struct FactorOptions {
  Ordering ordering = Ordering::nested_dissection;
  double lost_share = default_lost_share;  // larger: pivots fail that keep fewer digits than wished
  Progress* progress = nullptr;            // reported between 0 and 1
};

struct FactorStatistics {
  double ordering_ms = 0, symbolic_ms = 0, numeric_ms = 0;
  double entries = 0;                      // non-zeros of G
  double stored_entries = 0;               // with the relaxation zeros
  double flops = 0;                        // sum of squared column counts
  double bytes = 0;                        // of the stored factor with its index lists
  double path_entries = 0, path_rows = 0;  // of the elimination path of an unknown, in the mean
  std::int32_t supernodes = 0;
  bool loaded = false;    // from bytes, not made here: the three times above are 0
  bool borrowed = false;  // the numbers are the caller's, read in place
  double load_ms = 0;
};

// A batch of sparse columns w_1 .. w_k in the caller's numbering: column i holds entries [start[i], start[i+1]).
struct SparseColumns {
  Span<const std::int32_t> start;  // k + 1
  Span<const std::int32_t> row;
  Span<const double> value;
  std::int32_t count() const noexcept { return start.empty() ? 0 : static_cast<std::int32_t>(start.size()) - 1; }
};

// Columns y_i = G^-1 P w_i of one group of at most PathGroup::capacity sites, immutable once made. Shared by clones.
class PathGroup;

class Factor {
 public:
  // Orders, analyses and factorises. Throws HF_ERROR_NOT_POSITIVE_DEFINITE (index = the column in the caller's
  // numbering) when a pivot fails, HF_ERROR_NON_FINITE for NaN or infinity, HF_ERROR_TOO_LARGE, std::bad_alloc, or
  // HF_ERROR_CANCELLED.
  static std::shared_ptr<const Factor> make(const SymmetricMatrix& matrix, Coordinates coordinates,
                                            const FactorOptions& options, Memory& memory, JobRunner& jobs);

  virtual ~Factor() = default;
  virtual std::int32_t size() const noexcept = 0;
  virtual const FactorStatistics& statistics() const noexcept = 0;

  // How many roundings of the matrix a solution adds up: the largest, over subtrees of the elimination tree, of the sum
  // of the subtree's diagonal over its last pivot. That is the commute time of a random walk, for a Laplacian: about 15
  // an unknown on a surface as wide as long, the square of the length on a chain. component: by unknown; diagonal: the
  // mean by component, at which every unknown counts. Cost: one number of every supernode.
  virtual double commute_time(Span<const std::int32_t> component, Span<const double> diagonal) const = 0;

  // position[i] = row of unknown i in factor order (P), inverse order the other way round.
  virtual Span<const std::int32_t> position() const noexcept = 0;
  virtual Span<const std::int32_t> order() const noexcept = 0;

  // In place on z[row * channels + channel], rows in factor order.
  virtual void forward(double* z, std::int32_t channels, JobRunner& jobs) const = 0;
  virtual void backward(double* z, std::int32_t channels, JobRunner& jobs) const = 0;

  // Both, z <- (G G')^-1 z: A^-1 with rows in factor order.
  void solve_in_order(double* z, std::int32_t channels, JobRunner& jobs) const {
    forward(z, channels, jobs), backward(z, channels, jobs);
  }
  // x <- A^-1 right in the caller's numbering, number * channels + channel; right may be x. scratch: as many numbers.
  void solve(const double* right, double* x, std::int32_t channels, double* scratch, JobRunner& jobs) const;

  // The backward sweep as far as these unknowns (caller's numbering) need it: over their elimination paths. Their rows
  // of z get the bits that backward() gives; the other rows of the paths hold numbers of their own. Cost: one read of
  // the factor's entries on the union of the paths.
  virtual void backward_at(Span<const std::int32_t> unknowns, double* z, std::int32_t channels) const = 0;
  // z = 0 on those paths.
  virtual void clear_at(Span<const std::int32_t> unknowns, double* z, std::int32_t channels) const = 0;

  // Numeric refactorisation with the same pattern. `eliminated` (per unknown, caller's numbering, may be empty): rows
  // and columns set to the identity, pattern kept: the rebase. Shares symbolic analysis and ordering with *this.
  virtual std::shared_ptr<const Factor> refactor(const SymmetricMatrix& matrix, Span<const std::uint8_t> eliminated,
                                                 Memory& memory, JobRunner& jobs) const = 0;

  // Paths of a batch, cut into groups; out_group[i], out_column[i] tell where column i went. Cost: sum of path entries.
  virtual void solve_paths(const SparseColumns& columns, Memory& memory, JobRunner& jobs,
                           Vector<std::shared_ptr<const PathGroup>>& out_groups, Span<std::int32_t> out_group,
                           Span<std::int32_t> out_column) const = 0;

  // gram[i * ld + j] = y_i(a)' y_j(b), i < a.count(), j < b.count().
  virtual void gram(const PathGroup& a, const PathGroup& b, double* gram, std::int32_t ld) const = 0;

  // z[row * channels + c] += sum_i Y[row, i] lambda[i * channels + c], lambda of the group's own columns.
  virtual void combine(const PathGroup& group, const double* lambda, std::int32_t channels, double* z) const = 0;

  // z[row, .] = 0 on every row the group touches: undoes combine at the cost of the paths, not of n (partial
  // evaluation).
  virtual void clear(const PathGroup& group, std::int32_t channels, double* z) const = 0;

  // out[i * channels + c] = y_i' z[., c]: the transpose of combine.
  virtual void project(const PathGroup& group, const double* z, std::int32_t channels, double* out) const = 0;
};

class PathGroup {
 public:
  // Sites of a group. 32, 64 and 128 take equal time on one thread; on two, 180 sites take 14.6 ms, with 64 20.1 ms.
  static constexpr std::int32_t capacity = 32;
  virtual ~PathGroup() = default;
  virtual std::int32_t count() const noexcept = 0;
  virtual double bytes() const noexcept = 0;
};

}  // namespace hf_inner

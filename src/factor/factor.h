// Factors a symmetric positive definite sparse matrix, P A P' = G G' (Cholesky). The factor is immutable. It provides:
// - factorise: fill-reducing ordering, symbolic analysis, numeric supernodal factorisation.
// - sweeps: z <- G^-1 z (forward) and z <- G^-T z (backward), for several right-hand sides at once.
// - paths: Y = G^-1 P W for sparse columns of W (sites). Y is non-zero only along elimination paths.
// - products with paths: the Gram matrix Y_a' Y_b, and combine: z += Y lambda.
//
// All numbers are double. Any number of threads gives the same bits.
#pragma once
#include <cstdint>
#include <memory>

#include "base/jobs.h"
#include "base/memory.h"
#include "base/progress.h"
#include "base/span.h"
#include "factor/matrix.h"

namespace hf_inner::factor {

enum class Ordering : std::int32_t {
  nested_dissection = 0,  // our own multilevel nested dissection on graph and geometry
  minimum_degree = 1,     // approximate, of the whole matrix
  metis = 2,              // METIS through CHOLMOD; only in builds with HF_WITH_GPL (CHOLMOD), its rand() use isolated
  natural = 3,
};

// A pivot below this share of its diagonal entry is only rounding noise: the matrix is singular to working precision.
constexpr double default_lost_share = 0x1p-46;

struct FactorOptions {
  Ordering ordering = Ordering::nested_dissection;
  double lost_share = default_lost_share;  // larger: pivots fail that keep fewer digits than wished
  double flop_limit = 0;                   // refuse a matrix whose factorisation takes more; 0 = none
};

struct FactorStatistics {
  double ordering_ms = 0, symbolic_ms = 0, numeric_ms = 0;
  double entries = 0;                      // non-zeros of G
  double stored_entries = 0;               // entries stored, with the zeros of relaxed supernodes
  double flops = 0;                        // sum of squared column counts
  double bytes = 0;                        // of the stored factor with its index lists
  double path_entries = 0, path_rows = 0;  // means over the elimination paths of all unknowns
  std::int32_t supernodes = 0;
  bool loaded = false;    // loaded from bytes: the three times above are 0
  bool borrowed = false;  // the numbers are the caller's and are read in place
  double load_ms = 0;
  double rounding = 0;  // of an edited factor: about the relative error of a solution (edited_factor.h)
};

// A batch of sparse columns w_1 .. w_k, the weights of sites, in the caller's numbering. Column i has the entries
// [start[i], start[i+1]).
struct SparseColumns {
  Span<const std::int32_t> start;  // k + 1
  Span<const std::int32_t> row;
  Span<const double> value;
  std::int32_t count() const noexcept { return start.empty() ? 0 : static_cast<std::int32_t>(start.size()) - 1; }
};

// The elimination paths y_i = G^-1 P w_i of at most PathGroup::capacity sites, with w_i the weights of site i. A group
// never changes, and clones share it.
class PathGroup;

// Sparse vectors in factor order. Vector i has the entries [start[i], start[i+1]).
struct SparseVectors {
  explicit SparseVectors(Memory& memory) : start(&memory), row(&memory), value(&memory) {}
  Vector<std::int32_t> start, row;
  Vector<double> value;
};

class Factor {
 public:
  // Orders, analyses and factorises. Throws HF_ERROR_NOT_POSITIVE_DEFINITE when a pivot fails (index: the column in the
  // caller's numbering), HF_ERROR_NON_FINITE for NaN or infinity, HF_ERROR_TOO_LARGE, std::bad_alloc, or
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

  // position()[i] is the row of unknown i in factor order (the permutation P). order() is the inverse of it.
  virtual Span<const std::int32_t> position() const noexcept = 0;
  virtual Span<const std::int32_t> order() const noexcept = 0;

  // The forward and the backward sweep work in place on z[row * channels + channel], with rows in factor order.
  virtual void forward(double* z, std::int32_t channels, JobRunner& jobs) const = 0;
  virtual void backward(double* z, std::int32_t channels, JobRunner& jobs) const = 0;

  // Runs both sweeps: z <- (G G')^-1 z. This multiplies by the inverse of the matrix, with rows in factor order.
  void solve_in_order(double* z, std::int32_t channels, JobRunner& jobs) const {
    forward(z, channels, jobs);
    backward(z, channels, jobs);
  }
  // Computes x <- A^-1 right in the caller's numbering, at number * channels + channel. right may be x. scratch: as
  // many numbers as x.
  void solve(const double* right, double* x, std::int32_t channels, double* scratch, JobRunner& jobs) const;

  // Runs the backward sweep only over the elimination paths of these unknowns (caller's numbering). Their rows of z get
  // the same bits as from backward(). The other rows of the paths hold intermediate values. Cost: one read of the
  // factor's entries on the union of the paths.
  virtual void backward_at(Span<const std::int32_t> unknowns, double* z, std::int32_t channels) const = 0;
  // Sets z to 0 on the elimination paths of these unknowns.
  virtual void clear_at(Span<const std::int32_t> unknowns, double* z, std::int32_t channels) const = 0;

  // Factorises a matrix of the same size again. It shares symbolic analysis and ordering with *this if the pattern is
  // the same. A matrix of another pattern is analysed in the ordering of *this, and the order of the result may differ
  // from that (position). `eliminated`
  // (per unknown, caller's numbering, may be empty) marks rows and columns that are replaced by the identity, while the
  // pattern stays. The engine calls this a rebase.
  virtual std::shared_ptr<const Factor> refactor(const SymmetricMatrix& matrix, Span<const std::uint8_t> eliminated,
                                                 Memory& memory, JobRunner& jobs) const = 0;

  // The same for a matrix of any size and pattern, in this order of its unknowns.
  virtual std::shared_ptr<const Factor> refactor_in_order(const SymmetricMatrix& matrix, Span<const std::int32_t> order,
                                                          Span<const std::uint8_t> eliminated, Memory& memory,
                                                          JobRunner& jobs) const = 0;

  // Solves the elimination paths of a batch of columns and stores them in groups. The path of column i is column
  // out_column[i] of group out_group[i]. Cost: the sum of the paths' lengths.
  virtual void solve_paths(const SparseColumns& columns, Memory& memory, JobRunner& jobs,
                           Vector<std::shared_ptr<const PathGroup>>& out_groups, Span<std::int32_t> out_group,
                           Span<std::int32_t> out_column) const = 0;

  // Turns a group of elimination paths of another factor into paths of this one, without solving them: both are edits
  // of one factor, or one is the edit of the other (edited_factor.h). Else it returns null. columns: the weights of
  // the group's sites, empty where a path is not in use.
  std::shared_ptr<const PathGroup> take_paths(const Factor& from, std::shared_ptr<const PathGroup> group,
                                              const SparseColumns& columns, Memory& memory) const {
    if (&from.path_base() != &path_base()) return nullptr;
    return own_paths(from.base_paths(std::move(group)), columns, memory);
  }
  // The factor that this one is an edit of, or this one.
  virtual const Factor& path_base() const noexcept { return *this; }

  // Writes the rows of G that belong to these unknowns (caller's numbering). Row j as a column is G^-1 P A e_j. Returns
  // false, and writes nothing, if the factor has no sparse rows. Cost: the entries of the rows.
  virtual bool rows_of(Span<const std::int32_t> unknowns, SparseVectors& out) const = 0;

  // Computes products of elimination paths: gram[i * ld + j] = y_i(a)' y_j(b) for i < a.count() and j < b.count().
  virtual void gram(const PathGroup& a, const PathGroup& b, double* gram, std::int32_t ld) const = 0;

  // Adds to products of paths of path_base() what this edit adds: gram() is both. Rows without a use may hold anything.
  virtual void add_edit_products(const PathGroup& a, const PathGroup& b, double* gram, std::int32_t ld) const {
    (void)a, (void)b, (void)gram, (void)ld;
  }

  // Adds z[row * channels + c] += sum_i Y[row, i] lambda[i * channels + c]. Y are the group's elimination paths, lambda
  // their factors.
  virtual void combine(const PathGroup& group, const double* lambda, std::int32_t channels, double* z) const = 0;

  // Sets z to 0 on every row that the group's paths touch, which undoes combine. It costs as much as the paths, not
  // O(n).
  virtual void clear(const PathGroup& group, std::int32_t channels, double* z) const = 0;

  // Multiplies z by the group's elimination paths: out[i * channels + c] = y_i' z[., c], the transpose of combine.
  virtual void project(const PathGroup& group, const double* z, std::int32_t channels, double* out) const = 0;

 protected:
  // The paths of path_base() that a group is made of, and the other way round.
  virtual std::shared_ptr<const PathGroup> base_paths(std::shared_ptr<const PathGroup> group) const { return group; }
  virtual std::shared_ptr<const PathGroup> own_paths(std::shared_ptr<const PathGroup> base,
                                                     const SparseColumns& columns, Memory& memory) const {
    (void)columns, (void)memory;
    return base;
  }
  // The same of a factor inside this one.
  static std::shared_ptr<const PathGroup> base_paths_of(const Factor& factor, std::shared_ptr<const PathGroup> group) {
    return factor.base_paths(std::move(group));
  }
  static std::shared_ptr<const PathGroup> own_paths_of(const Factor& factor, std::shared_ptr<const PathGroup> base,
                                                       const SparseColumns& columns, Memory& memory) {
    return factor.own_paths(std::move(base), columns, memory);
  }
};

class PathGroup {
 public:
  // At most this many sites have their elimination paths in one group. 32, 64 and 128 take the same time on one thread.
  // On two threads, 180 sites take 14.6 ms with 32, and 20.1 ms with 64.
  static constexpr std::int32_t capacity = 32;
  virtual ~PathGroup() = default;
  virtual std::int32_t count() const noexcept = 0;
  virtual double bytes() const noexcept = 0;
};

}  // namespace hf_inner::factor

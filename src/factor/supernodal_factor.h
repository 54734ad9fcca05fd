// The factor itself: symbolic analysis and plan, which all factors of one pattern share, and the numbers.
#pragma once
#include <cstdint>
#include <memory>

#include "factor/factor.h"
#include "factor/kernels.h"
#include "factor/plan.h"
#include "factor/symbolic.h"

namespace hf_inner::factor {

struct Analysis {
  Symbolic symbolic;
  Plan plan;
  Ordering ordering = Ordering::nested_dissection;  // the one that the caller chose
  std::uint64_t pattern_hash = 0;                   // of the matrix: refactor takes the same pattern only
  bool loaded = false;                              // loaded from bytes: the hash cannot be trusted
};

// One supernode on the elimination paths of a group of sites: a row of `lanes` numbers for each of
// its columns, for the sites [low, low + used).
struct PathBlock {
  std::int32_t supernode;
  std::int32_t low, used, lanes;
  std::int64_t at;  // where its numbers begin in `values`
};

class PathBlocks final : public PathGroup {
 public:
  std::int32_t count() const noexcept override { return sites; }
  double bytes() const noexcept override {
    return 8.0 * static_cast<double>(values.size()) + static_cast<double>(blocks.size() * sizeof(PathBlock));
  }
  std::int32_t sites = 0;
  Buffer<PathBlock> blocks;  // by supernode, ascending
  Buffer<double> values;
};

class SupernodalFactor final : public Factor {
 public:
  SupernodalFactor(std::shared_ptr<const Analysis> analysis, Memory& memory);

  std::int32_t size() const noexcept override { return symbolic().size; }
  const FactorStatistics& statistics() const noexcept override { return statistics_; }
  double commute_time(Span<const std::int32_t> component, Span<const double> diagonal) const override;
  Span<const std::int32_t> position() const noexcept override {
    return {symbolic().position.data(), symbolic().position.size()};
  }
  Span<const std::int32_t> order() const noexcept override {
    return {symbolic().order.data(), symbolic().order.size()};
  }

  void forward(double* z, std::int32_t channels, JobRunner& jobs) const override;
  void backward(double* z, std::int32_t channels, JobRunner& jobs) const override;
  void backward_at(Span<const std::int32_t> unknowns, double* z, std::int32_t channels) const override;
  void clear_at(Span<const std::int32_t> unknowns, double* z, std::int32_t channels) const override;
  std::shared_ptr<const Factor> refactor(const SymmetricMatrix& matrix, Span<const std::uint8_t> eliminated,
                                         Memory& memory, JobRunner& jobs) const override;
  std::shared_ptr<const Factor> refactor_in_order(const SymmetricMatrix& matrix, Span<const std::int32_t> order,
                                                  Span<const std::uint8_t> eliminated, Memory& memory,
                                                  JobRunner& jobs) const override;
  void solve_paths(const SparseColumns& columns, Memory& memory, JobRunner& jobs,
                   Vector<std::shared_ptr<const PathGroup>>& out_groups, Span<std::int32_t> out_group,
                   Span<std::int32_t> out_column) const override;
  bool rows_of(Span<const std::int32_t> unknowns, SparseVectors& out) const override;
  void gram(const PathGroup& a, const PathGroup& b, double* gram, std::int32_t ld) const override;
  void combine(const PathGroup& group, const double* lambda, std::int32_t channels, double* z) const override;
  void clear(const PathGroup& group, std::int32_t channels, double* z) const override;
  void project(const PathGroup& group, const double* z, std::int32_t channels, double* out) const override;

  // Returns the supernodes on the elimination paths of these unknowns, ascending.
  Vector<std::int32_t> path_union(Span<const std::int32_t> unknowns) const;
  const Symbolic& symbolic() const noexcept { return analysis_->symbolic; }
  const Plan& plan() const noexcept { return analysis_->plan; }
  const Kernels& kernels() const noexcept { return *kernels_; }
  const double* triangle(std::int32_t s) const noexcept { return values_.data() + symbolic().value_start[s]; }
  const double* below(std::int32_t s) const noexcept {
    const std::int64_t width = symbolic().columns(s);
    return triangle(s) + width * (width + 1) / 2;
  }
  Buffer<double>& values() noexcept { return values_; }
  const Buffer<double>& values() const noexcept { return values_; }
  const std::shared_ptr<const Analysis>& analysis() const noexcept { return analysis_; }
  // Factorises the matrix into values(), which it allocates.
  void compute(const SymmetricMatrix& matrix, Span<const std::uint8_t> eliminated, double lost_share, JobRunner& jobs);
  void set_timings(double ordering_ms, double symbolic_ms) noexcept {
    statistics_.ordering_ms = ordering_ms;
    statistics_.symbolic_ms = symbolic_ms;
  }
  void set_loaded(bool borrowed, double load_ms) noexcept {
    statistics_.loaded = true;
    statistics_.borrowed = borrowed;
    statistics_.load_ms = load_ms;
  }
  // Sets another set of kernels, for tests that compare them.
  void use_kernels(const Kernels& kernels) noexcept { kernels_ = &kernels; }

 private:
  void measure_paths();

  Memory& memory_;
  std::shared_ptr<const Analysis> analysis_;
  const Kernels* kernels_;
  Buffer<double> values_;
  FactorStatistics statistics_;
};

std::uint64_t hash_pattern(const SymmetricMatrix& matrix) noexcept;

}  // namespace hf_inner::factor

#include "factor/factor.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/elementary.h"
#include "base/error.h"
#include "factor/numeric.h"
#include "factor/ordering.h"
#include "factor/supernodal_factor.h"
#include "factor/work_limit.h"

namespace hf_inner::factor {
namespace {

class Stopwatch {
 public:
  double lap_ms() noexcept {
    const auto now = std::chrono::steady_clock::now();
    const double ms = std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
    return ms;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

// Checks the index lists of a matrix: their bounds, the order of the rows, and that every column has a diagonal.
void require_well_formed(const SymmetricMatrix& matrix) {
  if (matrix.row.size() > static_cast<std::size_t>(INT32_MAX) || matrix.row.size() != matrix.value.size()) {
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "the matrix has %zu entries; the limit is 2^31 - 1", matrix.row.size());
  }
  const std::int32_t n = matrix.size();
  const std::int32_t* start = matrix.column_start.data();
  const bool ends = n == 0 || (start[0] == 0 && static_cast<std::size_t>(start[n]) == matrix.row.size());
  if (!ends) fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "the columns of the matrix do not span its entries");
  for (std::int32_t j = 0; j < n; ++j) {
    bool diagonal = false, ascending = start[j] <= start[j + 1];
    std::int32_t previous = -1;
    for (std::int32_t e = start[j]; ascending && e < start[j + 1]; ++e) {
      const std::int32_t row = matrix.row[e];
      ascending = row > previous && row < n;
      diagonal |= row == j;
      previous = row;
    }
    if (!ascending || !diagonal) {
      fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(j),
           "column %d of the matrix: rows must ascend, lie in range and hold the diagonal", j);
    }
  }
}

// Checks that every entry of the matrix has its place in the factor. Only loaded factors need it, because their pattern
// hash may be forged.
void require_inside(const SymmetricMatrix& matrix, const Symbolic& symbolic, Memory& memory) {
  Buffer<std::int32_t> owner(memory, static_cast<std::size_t>(symbolic.size));
  std::fill(owner.begin(), owner.end(), -1);
  for (std::int32_t s = 0; s < symbolic.supernodes; ++s) {
    for (std::int32_t j = symbolic.first[s]; j < symbolic.first[s + 1]; ++j) owner[j] = s;
    for (std::int32_t k = 0; k < symbolic.below(s); ++k) owner[symbolic.row_list(s)[k]] = s;
    for (std::int32_t j = symbolic.first[s]; j < symbolic.first[s + 1]; ++j) {
      const std::int32_t unknown = symbolic.order[j];
      for (std::int32_t e = matrix.column_start[unknown]; e < matrix.column_start[unknown + 1]; ++e) {
        const std::int32_t other = symbolic.position[matrix.row[e]];
        if (other < j || owner[other] == s) continue;
        fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(unknown),
             "the loaded factor has no place for column %d of this matrix: it belongs to another mesh", unknown);
      }
    }
  }
}

// A factor of n unknowns with more than this many n log n entries is compared with one ordered by minimum degree. The
// test meshes torus, creature and scan reach 0.63, 0.47 and 0.34 times n log n.
constexpr double suspicious_fill = 1.2;
// Flops that cost as much as one entry of the factor, to compare two orderings. 50 flops take the time of three sweeps
// over an entry (torus with 304,000 vertices: 27 GF/s, 9 ms per sweep).
constexpr double flops_per_entry = 50;
// Reported progress after the ordering and after the symbolic analysis. The ordering takes about half of a first
// factorisation, the analysis a tenth.
constexpr float progress_ordered = 0.45f, progress_analysed = 0.55f;

// log2(e) turns a natural logarithm into one to the base 2.
constexpr double bits_of_e = 1.4426950408889634;

// Tells whether the factor has more than log2(n) times the matrix's entries, up to a constant.
bool suspicious(const SymmetricMatrix& matrix, const Symbolic& symbolic) {
  const double lower = 0.5 * (static_cast<double>(matrix.row.size()) + matrix.size());
  return symbolic.entries > suspicious_fill * lower * logarithm(2.0 + matrix.size()) * bits_of_e;
}

// The pattern of the factor under `order`, which it releases, or under minimum degree where that is better.
std::shared_ptr<Analysis> make_analysis(const SymmetricMatrix& matrix, const FactorOptions& options,
                                        Buffer<std::int32_t>& order, Memory& memory) {
  std::shared_ptr<Analysis> analysis = make_shared_in<Analysis>(memory);
  analyse(matrix, Span<const std::int32_t>(order.data(), order.size()), memory, analysis->symbolic);
  if (options.ordering == Ordering::nested_dissection && suspicious(matrix, analysis->symbolic)) {
    // This graph separates badly, so the better of two orderings is taken.
    order_by_minimum_degree(matrix, memory, order);
    const FillEstimate other = estimate_fill(matrix, Span<const std::int32_t>(order.data(), order.size()), memory);
    if (other.entries + other.flops / flops_per_entry <
        analysis->symbolic.entries + analysis->symbolic.flops / flops_per_entry) {
      analysis = make_shared_in<Analysis>(memory);
      analyse(matrix, Span<const std::int32_t>(order.data(), order.size()), memory, analysis->symbolic);
    }
  }
  order.release();
  make_plan(analysis->symbolic, memory, analysis->plan);
  analysis->pattern_hash = hash_pattern(matrix);
  analysis->ordering = options.ordering;
  return analysis;
}

// The pattern of the factor of a matrix with another pattern, in the order of a present factor.
std::shared_ptr<const Analysis> analysis_in_order(const SymmetricMatrix& matrix, Span<const std::int32_t> order,
                                                  Ordering ordering, Memory& memory) {
  require_well_formed(matrix);
  const std::shared_ptr<Analysis> analysis = make_shared_in<Analysis>(memory);
  analyse(matrix, order, memory, analysis->symbolic);
  make_plan(analysis->symbolic, memory, analysis->plan);
  analysis->pattern_hash = hash_pattern(matrix);
  analysis->ordering = ordering;
  return analysis;
}

// Refuses a factorisation before it begins: its flops and bytes are known once the pattern is.
void require_within_limits(const Analysis& analysis, double flop_limit, const Memory& memory) {
  const Symbolic& symbolic = analysis.symbolic;
  require_work(symbolic.flops, flop_limit);
  constexpr double mebibyte = 1048576.0;
  const double needed =
      8.0 * (symbolic.stored_entries + static_cast<double>(analysis.plan.shared_size + analysis.plan.in_task.panel));
  const double room = static_cast<double>(memory.room());
  if (needed > room) {
    fail(HF_ERROR_OUT_OF_MEMORY, HF_NO_INDEX,
         "the factor needs %.0f MiB more, and memory_limit_mb leaves %.0f MiB; the object is as it was before the call",
         std::ceil(needed / mebibyte), std::floor(room / mebibyte));
  }
}

}  // namespace

std::uint64_t hash_pattern(const SymmetricMatrix& matrix) noexcept {
  std::uint64_t hash = 1469598103934665603ull ^ matrix.row.size();
  const auto mix = [&](std::uint64_t word) {
    hash = (hash ^ word) * 0x9E3779B97F4A7C15ull;
    hash ^= hash >> 29;
  };
  for (const std::int32_t start : matrix.column_start) mix(static_cast<std::uint32_t>(start));
  const std::size_t count = matrix.row.size();
  const std::int32_t* row = matrix.row.data();
  std::size_t e = 0;
  for (; e + 2 <= count; e += 2)
    mix(static_cast<std::uint64_t>(static_cast<std::uint32_t>(row[e])) << 32 | static_cast<std::uint32_t>(row[e + 1]));
  if (e < count) mix(static_cast<std::uint32_t>(row[e]));
  return hash;
}

SupernodalFactor::SupernodalFactor(std::shared_ptr<const Analysis> analysis, Memory& memory)
    : memory_(memory), analysis_(std::move(analysis)), kernels_(&choose_kernels()) {
  statistics_.entries = symbolic().entries;
  statistics_.stored_entries = symbolic().stored_entries;
  statistics_.flops = symbolic().flops;
  statistics_.supernodes = symbolic().supernodes;
  statistics_.bytes = 8.0 * symbolic().stored_entries + symbolic().index_bytes() + plan().bytes();
  measure_paths();
}

// Measures the mean length of the elimination paths. A path is the path of the parent supernode plus
// the supernode's own columns.
void SupernodalFactor::measure_paths() {
  const Symbolic& pattern = symbolic();
  struct Path {
    double entries, rows;
  };
  Buffer<Path> path(memory_, static_cast<std::size_t>(pattern.supernodes));
  Path total{0, 0};
  for (std::int32_t s = pattern.supernodes - 1; s >= 0; --s) {
    const double columns = pattern.columns(s);
    const Path above = pattern.parent[s] >= 0 ? path[static_cast<std::size_t>(pattern.parent[s])] : Path{0, 0};
    path[static_cast<std::size_t>(s)] = {above.entries + columns * (0.5 * columns + pattern.below(s)),
                                         above.rows + columns};
    total.entries += columns * path[static_cast<std::size_t>(s)].entries;
    total.rows += columns * path[static_cast<std::size_t>(s)].rows;
  }
  if (pattern.size == 0) return;
  statistics_.path_entries = total.entries / pattern.size;
  statistics_.path_rows = total.rows / pattern.size;
}

double SupernodalFactor::commute_time(Span<const std::int32_t> component, Span<const double> diagonal) const {
  const Symbolic& pattern = symbolic();
  double longest = 0;
  for (std::int32_t s = 0; s < pattern.supernodes; ++s) {
    const std::int64_t width = pattern.columns(s);
    const double inverse = triangle(s)[width * (width + 1) / 2 - 1];  // the diagonal is stored inverted
    const double mean =
        diagonal[static_cast<std::size_t>(component[static_cast<std::size_t>(pattern.order[pattern.first[s]])])];
    const double unknowns = pattern.first[s + 1] - pattern.first[pattern.subtree[s]];
    longest = std::max(longest, unknowns * mean * inverse * inverse);
  }
  return longest;
}

void SupernodalFactor::compute(const SymmetricMatrix& matrix, Span<const std::uint8_t> eliminated, double lost_share,
                               JobRunner& jobs) {
  Stopwatch watch;
  values_.allocate(memory_, static_cast<std::size_t>(symbolic().stored_entries) + value_slack);
  factorise(symbolic(), plan(), kernels(), matrix, eliminated, lost_share, values_.data(), memory_, jobs);
  statistics_.numeric_ms = watch.lap_ms();
}

std::shared_ptr<const Factor> Factor::make(const SymmetricMatrix& matrix, Coordinates coordinates,
                                           const FactorOptions& options, Memory& memory, JobRunner& jobs) {
  require_well_formed(matrix);
  require_finite(matrix);
  if (!coordinates.empty() && coordinates.size() != 3 * static_cast<std::size_t>(matrix.size())) {
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "%zu coordinates for %d unknowns: three each, or none",
         coordinates.size(), matrix.size());
  }
  report(0.0f);
  Stopwatch watch;
  if (options.ordering == Ordering::nested_dissection)
    refuse_soup(matrix, options.flop_limit, minimum_degree_times, memory);
  Buffer<std::int32_t> order;
  {
    const ProgressRange range(0.0f, progress_ordered);
    make_order(matrix, coordinates, options.ordering, memory, jobs, order);
  }
  const double ordering_ms = watch.lap_ms();
  report(progress_ordered);
  std::shared_ptr<Analysis> analysis = make_analysis(matrix, options, order, memory);
  require_within_limits(*analysis, options.flop_limit, memory);
  const double symbolic_ms = watch.lap_ms();
  report(progress_analysed);
  const ProgressRange range(progress_analysed, 1.0f);
  std::shared_ptr<SupernodalFactor> factor = make_shared_in<SupernodalFactor>(memory, std::move(analysis), memory);
  factor->set_timings(ordering_ms, symbolic_ms);
  factor->compute(matrix, {}, options.lost_share, jobs);
  report(1.0f);
  return factor;
}

std::shared_ptr<const Factor> SupernodalFactor::refactor(const SymmetricMatrix& matrix,
                                                         Span<const std::uint8_t> eliminated, Memory& memory,
                                                         JobRunner& jobs) const {
  if (matrix.size() != size())
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "refactor takes a matrix of the same size; make a new factor instead");
  if (!eliminated.empty() && eliminated.size() != static_cast<std::size_t>(size())) {
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "%zu elimination marks for %d unknowns", eliminated.size(), size());
  }
  require_finite(matrix);
  std::shared_ptr<const Analysis> analysis = analysis_;
  if (hash_pattern(matrix) != analysis->pattern_hash) {
    const Buffer<std::int32_t>& order = analysis_->symbolic.order;
    analysis = analysis_in_order(matrix, {order.data(), order.size()}, analysis_->ordering, memory);
  } else if (analysis->loaded) {
    require_well_formed(matrix);
    require_inside(matrix, symbolic(), memory);
  }
  std::shared_ptr<SupernodalFactor> factor = make_shared_in<SupernodalFactor>(memory, std::move(analysis), memory);
  factor->kernels_ = kernels_;
  factor->compute(matrix, eliminated, default_lost_share, jobs);
  return factor;
}

std::shared_ptr<const Factor> SupernodalFactor::refactor_in_order(const SymmetricMatrix& matrix,
                                                                  Span<const std::int32_t> order,
                                                                  Span<const std::uint8_t> eliminated, Memory& memory,
                                                                  JobRunner& jobs) const {
  require_finite(matrix);
  std::shared_ptr<const Analysis> analysis = analysis_in_order(matrix, order, analysis_->ordering, memory);
  std::shared_ptr<SupernodalFactor> factor = make_shared_in<SupernodalFactor>(memory, std::move(analysis), memory);
  factor->kernels_ = kernels_;
  factor->compute(matrix, eliminated, default_lost_share, jobs);
  return factor;
}

void Factor::solve(const double* right, double* x, std::int32_t channels, double* scratch, JobRunner& jobs) const {
  const std::size_t m = static_cast<std::size_t>(channels);
  const Span<const std::int32_t> row = position();
  for (std::size_t i = 0; i < row.size(); ++i)
    std::copy_n(right + i * m, m, scratch + static_cast<std::size_t>(row[i]) * m);
  solve_in_order(scratch, channels, jobs);
  for (std::size_t i = 0; i < row.size(); ++i)
    std::copy_n(scratch + static_cast<std::size_t>(row[i]) * m, m, x + i * m);
}

}  // namespace hf_inner::factor

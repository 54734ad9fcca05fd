// Forward and backward sweeps over the stored factor.
//
// The backward sweep, z <- G^-T z, takes the supernodes from last to first. Each subtracts the contribution of its rows
// below, then solves its triangle. First the top supernodes run wave by wave, then all tasks at once; no two jobs write
// the same row. The forward sweep, z <- G^-1 z, takes the supernodes from first to last. A task collects its
// contributions to rows above itself in its own buffer. The buffers are added in the order of the tasks. Cost: one read
// of the factor per call for up to 8 channels.
#include <algorithm>
#include <cmath>
#include <mutex>

#include "factor/preview.h"
#include "factor/supernodal_factor.h"

namespace hf_inner::factor {
namespace {

// The sizes of jobs below trade even loads for the cost of a job. On a torus of 102,400 vertices and two threads, half
// and double of each (for even_share 1 and 2.6) change fields of one channel by at most 3 %. Previews, and fields of
// eight channels, change by at most 6 %, the noise. Medians of 80 solves in turns. No result depends on them.

// One thread's job sums this many columns of a supernode that is split.
constexpr std::int32_t piece_columns = 96;
// Each of several independent supernodes is one thread's job if the largest is at most this many
// times its fair share.
constexpr double even_share = 1.3;
// Independent supernodes with fewer entries in all are never split: some 20 microseconds at 0.6 ns
// per entry, less than a batch of jobs costs.
constexpr double small_wave_entries = 30000;
// One thread's job multiplies this many rows below a supernode's triangle.
constexpr std::int32_t piece_rows = 128;
// A supernode with fewer entries is never split over threads: some 25 microseconds, less than a
// batch of jobs costs.
constexpr double least_cut = 40000;
// One job converts this many numbers of the factor.
constexpr std::size_t preview_step = std::size_t{1} << 18;
// One job converts this many numbers of a right-hand side.
constexpr std::size_t convert_step = std::size_t{1} << 15;
// Largest power of two whose inverse is a normal double too.
constexpr int largest_exponent = 1000;

// One backward sweep on double or single-precision numbers.
template <class T>
struct BackwardPass {
  const Symbolic& symbolic;
  const Plan& plan;
  const Kernels& kernels;
  const T* values;
  T* z;
  std::int32_t channels;

  bool narrow(std::int32_t s) const noexcept { return symbolic.columns(s) <= narrow_columns; }
  void rows(std::int32_t s, std::int32_t begin, std::int32_t end) const noexcept {
    const std::int64_t width = symbolic.columns(s);
    const T* below = values + symbolic.value_start[s] + width * (width + 1) / 2;
    if constexpr (sizeof(T) == sizeof(double)) {
      kernels.backward_rows(below, symbolic.row_list(s), symbolic.below(s), symbolic.columns(s), begin, end, z,
                            symbolic.first[s], channels);
    } else {
      kernels.backward_rows_f32(below, symbolic.row_list(s), symbolic.below(s), symbolic.columns(s), begin, end, z,
                                symbolic.first[s], channels);
    }
  }
  void triangle(std::int32_t s) const noexcept {
    T* own = z + static_cast<std::int64_t>(symbolic.first[s]) * channels;
    if constexpr (sizeof(T) == sizeof(double)) {
      kernels.backward_triangle(values + symbolic.value_start[s], symbolic.columns(s), own, channels);
    } else {
      kernels.backward_triangle_f32(values + symbolic.value_start[s], symbolic.columns(s), own, channels);
    }
  }
  void whole(std::int32_t s) const noexcept {
    if (narrow(s)) {
      const T* own = values + symbolic.value_start[s];
      if constexpr (sizeof(T) == sizeof(double)) {
        kernels.backward_narrow(own, symbolic.row_list(s), symbolic.below(s), symbolic.columns(s), z, symbolic.first[s],
                                channels);
      } else {
        kernels.backward_narrow_f32(own, symbolic.row_list(s), symbolic.below(s), symbolic.columns(s), z,
                                    symbolic.first[s], channels);
      }
      return;
    }
    if (symbolic.below(s) > 0) rows(s, 0, symbolic.columns(s));
    triangle(s);
  }

  // Runs the backward sweep on one wave (independent supernodes) as jobs. Each job is a whole supernode if there are
  // many or small ones. Otherwise the jobs are pieces of their columns first, and their triangles after.
  void wave(std::int32_t begin, std::int32_t end, JobRunner& jobs) const {
    const std::int32_t* top = plan.top.data();
    const auto pieces_of = [&](std::int32_t s) { return (symbolic.columns(s) + piece_columns - 1) / piece_columns; };
    double total = 0, largest = 0;
    std::int32_t pieces = 0;
    for (std::int32_t k = begin; k < end; ++k) {
      const double width = symbolic.columns(top[k]);
      const double entries = width * (0.5 * width + symbolic.below(top[k]));
      total += entries;
      largest = std::max(largest, entries);
      pieces += pieces_of(top[k]);
    }
    const std::uint32_t count = static_cast<std::uint32_t>(end - begin);
    if (largest * jobs.thread_count() <= even_share * total || total < small_wave_entries) {
      jobs.for_each(count, [&](std::uint32_t k) { whole(top[begin + static_cast<std::int32_t>(k)]); });
      return;
    }
    jobs.for_each(static_cast<std::uint32_t>(pieces), [&](std::uint32_t piece) {
      std::int32_t left = static_cast<std::int32_t>(piece), k = begin;
      for (; left >= pieces_of(top[k]); ++k) left -= pieces_of(top[k]);
      const std::int32_t s = top[k], from = left * piece_columns;
      if (symbolic.below(s) > 0 && !narrow(s)) rows(s, from, std::min(symbolic.columns(s), from + piece_columns));
    });
    jobs.for_each(count, [&](std::uint32_t k) {
      const std::int32_t s = top[begin + static_cast<std::int32_t>(k)];
      narrow(s) ? whole(s) : triangle(s);
    });
  }

  void run(JobRunner& jobs) const {
    if (jobs.thread_count() == 1) {
      for (std::int32_t s = symbolic.supernodes - 1; s >= 0; --s) whole(s);
      return;
    }
    for (std::int32_t w = plan.waves - 1; w >= 0; --w) wave(plan.wave_start[w], plan.wave_start[w + 1], jobs);
    jobs.for_each(static_cast<std::uint32_t>(plan.tasks), [&](std::uint32_t k) {
      const std::int32_t task = plan.task_order[k];
      for (std::int32_t r = plan.task_start[task + 1] - 1; r >= plan.task_start[task]; --r) {
        const std::int32_t root = plan.task_root[r];
        for (std::int32_t s = root; s >= symbolic.subtree[root]; --s) whole(s);
      }
    });
  }
};

// The scratch memory of one thread in a forward sweep.
template <class T>
struct ForwardScratch {
  ForwardScratch(Memory& memory, std::int32_t unknowns, std::int32_t below, std::int32_t channels)
      : place_of(memory, unknowns), product(memory, static_cast<std::size_t>(below) * channels + widest_vector) {}
  Buffer<std::int32_t> place_of;  // by row outside the task's subtrees: its place in the task's buffer
  Buffer<T> product;
};

// One forward sweep on double or single-precision numbers.
template <class T>
class ForwardPass {
 public:
  ForwardPass(const Symbolic& symbolic, const Plan& plan, const Kernels& kernels, const T* values, T* z,
              std::int32_t channels, Memory& memory)
      : symbolic_(symbolic),
        plan_(plan),
        kernels_(kernels),
        values_(values),
        z_(z),
        channels_(channels),
        memory_(memory),
        free_(&memory) {
    for (std::int32_t s = 0; s < symbolic.supernodes; ++s) longest_ = std::max(longest_, symbolic.below(s));
    start_.allocate(memory, plan.task_root.size() + 1);
    std::int64_t total = 0;
    for (std::size_t r = 0; r < plan.task_root.size(); ++r) {
      start_[r] = total;
      total += symbolic.below(plan.task_root[r]);
    }
    start_[plan.task_root.size()] = total;
    above_.allocate(memory, static_cast<std::size_t>(total * channels));
  }

  void run(JobRunner& jobs) {
    jobs.for_each(static_cast<std::uint32_t>(plan_.tasks), [&](std::uint32_t k) {
      std::shared_ptr<Scratch> scratch = take();
      const std::int32_t task = plan_.task_order[k];
      for (std::int32_t r = plan_.task_start[task]; r < plan_.task_start[task + 1]; ++r) run_subtree(r, *scratch);
      give_back(std::move(scratch));
    });
    for (std::size_t r = 0; r < plan_.task_root.size(); ++r) {
      const std::int32_t root = plan_.task_root[r];
      subtract(symbolic_.row_list(root), symbolic_.below(root), above_.data() + start_[r] * channels_);
    }
    std::shared_ptr<Scratch> scratch = take();
    const std::int32_t top_count = static_cast<std::int32_t>(plan_.top.size());
    for (std::int32_t k = 0; k < top_count; ++k) {
      const std::int32_t s = plan_.top[k];
      solve(s, scratch->product.data(), jobs);
      subtract(symbolic_.row_list(s), symbolic_.below(s), scratch->product.data());
    }
  }

 private:
  using Scratch = ForwardScratch<T>;

  const T* triangle(std::int32_t s) const noexcept { return values_ + symbolic_.value_start[s]; }
  const T* below(std::int32_t s) const noexcept {
    const std::int64_t width = symbolic_.columns(s);
    return triangle(s) + width * (width + 1) / 2;
  }

  void run_subtree(std::int32_t r, Scratch& scratch) noexcept {
    const std::int32_t root = plan_.task_root[r];
    const std::int32_t last = symbolic_.first[root + 1];
    T* above = above_.data() + start_[r] * channels_;
    std::fill(above, above + static_cast<std::int64_t>(symbolic_.below(root)) * channels_, T{0});
    for (std::int32_t k = 0; k < symbolic_.below(root); ++k) scratch.place_of[symbolic_.row_list(root)[k]] = k;
    for (std::int32_t s = symbolic_.subtree[root]; s <= root; ++s) {
      solve(s, scratch.product.data());
      const std::int32_t* rows = symbolic_.row_list(s);
      const std::int32_t count = symbolic_.below(s);
      std::int32_t inside = 0;
      while (inside < count && rows[inside] < last) ++inside;
      subtract(rows, inside, scratch.product.data());
      for (std::int32_t k = inside; k < count; ++k) {
        T* target = above + static_cast<std::int64_t>(scratch.place_of[rows[k]]) * channels_;
        for (std::int32_t c = 0; c < channels_; ++c)
          target[c] += scratch.product[static_cast<std::size_t>(k) * channels_ + c];
      }
    }
  }

  void solve_triangle(std::int32_t s, T* z) const noexcept {
    if constexpr (sizeof(T) == sizeof(double)) {
      kernels_.forward_triangle(triangle(s), symbolic_.columns(s), z, channels_);
    } else {
      kernels_.forward_triangle_f32(triangle(s), symbolic_.columns(s), z, channels_);
    }
  }
  void multiply_rows(std::int32_t s, std::int32_t begin, std::int32_t end, const T* z, T* product) const noexcept {
    const T* first = below(s) + static_cast<std::int64_t>(begin) * symbolic_.columns(s);
    product += static_cast<std::int64_t>(begin) * channels_;
    if constexpr (sizeof(T) == sizeof(double)) {
      kernels_.forward_rows(first, end - begin, symbolic_.columns(s), z, product, channels_);
    } else {
      kernels_.forward_rows_f32(first, end - begin, symbolic_.columns(s), z, product, channels_);
    }
  }

  void solve(std::int32_t s, T* product) const noexcept {
    T* z = z_ + static_cast<std::int64_t>(symbolic_.first[s]) * channels_;
    // Its triangle is stored inverted, so its rows come first.
    const bool narrow = symbolic_.columns(s) <= narrow_columns;
    if (!narrow) solve_triangle(s, z);
    multiply_rows(s, 0, symbolic_.below(s), z, product);
    if (narrow) solve_triangle(s, z);
  }

  // Does the forward step of one supernode like the function above, with the rows of a large one
  // split over the threads.
  void solve(std::int32_t s, T* product, JobRunner& jobs) const {
    const std::int32_t columns = symbolic_.columns(s), rows = symbolic_.below(s);
    if (jobs.thread_count() == 1 || static_cast<double>(columns) * rows < least_cut || rows <= piece_rows ||
        columns <= narrow_columns)
      return solve(s, product);
    T* z = z_ + static_cast<std::int64_t>(symbolic_.first[s]) * channels_;
    solve_triangle(s, z);
    jobs.for_each(static_cast<std::uint32_t>((rows + piece_rows - 1) / piece_rows), [&](std::uint32_t piece) {
      const std::int32_t begin = static_cast<std::int32_t>(piece) * piece_rows;
      multiply_rows(s, begin, std::min(rows, begin + piece_rows), z, product);
    });
  }

  void subtract(const std::int32_t* rows, std::int32_t count, const T* product) const noexcept {
    for (std::int32_t k = 0; k < count; ++k) {
      T* target = z_ + static_cast<std::int64_t>(rows[k]) * channels_;
      for (std::int32_t c = 0; c < channels_; ++c) target[c] -= product[static_cast<std::int64_t>(k) * channels_ + c];
    }
  }

  std::shared_ptr<Scratch> take() {
    {
      std::lock_guard<std::mutex> lock(mutex_);
      if (!free_.empty()) {
        std::shared_ptr<Scratch> taken = free_.back();
        free_.pop_back();
        return taken;
      }
      ++made_;
      free_.reserve(made_);
    }
    return make_shared_in<Scratch>(memory_, memory_, symbolic_.size, longest_, channels_);
  }
  void give_back(std::shared_ptr<Scratch> scratch) noexcept {
    std::lock_guard<std::mutex> lock(mutex_);
    free_.push_back(std::move(scratch));
  }

  const Symbolic& symbolic_;
  const Plan& plan_;
  const Kernels& kernels_;
  const T* values_;
  T* z_;
  std::int32_t channels_;
  Memory& memory_;
  std::int32_t longest_ = 0;
  Buffer<std::int64_t> start_;
  Buffer<T> above_;
  std::mutex mutex_;
  Vector<std::shared_ptr<Scratch>> free_;
  std::size_t made_ = 0;
};

}  // namespace

void SupernodalFactor::backward(double* z, std::int32_t channels, JobRunner& jobs) const {
  BackwardPass<double>{symbolic(), plan(), kernels(), values_.data(), z, channels}.run(jobs);
}

Vector<std::int32_t> SupernodalFactor::path_union(Span<const std::int32_t> unknowns) const {
  const Symbolic& pattern = symbolic();
  Vector<std::int32_t> nodes(&memory_);
  for (const std::int32_t unknown : unknowns) nodes.push_back(pattern.supernode[pattern.position[unknown]]);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  // Follows the elimination path of every unknown up to the first marked supernode.
  Vector<std::uint8_t> marked(static_cast<std::size_t>(pattern.supernodes), 0, &memory_);
  for (const std::int32_t s : nodes) marked[static_cast<std::size_t>(s)] = 1;
  const std::size_t starts = nodes.size();
  for (std::size_t i = 0; i < starts; ++i) {
    for (std::int32_t s = pattern.parent[nodes[i]]; s >= 0 && !marked[static_cast<std::size_t>(s)];
         s = pattern.parent[s]) {
      marked[static_cast<std::size_t>(s)] = 1;
      nodes.push_back(s);
    }
  }
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

void SupernodalFactor::backward_at(Span<const std::int32_t> unknowns, double* z, std::int32_t channels) const {
  const BackwardPass<double> pass{symbolic(), plan(), kernels(), values_.data(), z, channels};
  const Vector<std::int32_t> nodes = path_union(unknowns);
  for (auto s = nodes.rbegin(); s != nodes.rend(); ++s) pass.whole(*s);
}

void SupernodalFactor::clear_at(Span<const std::int32_t> unknowns, double* z, std::int32_t channels) const {
  for (const std::int32_t s : path_union(unknowns)) {
    const std::int64_t first = symbolic().first[s], last = symbolic().first[s + 1];
    std::fill(z + first * channels, z + last * channels, 0.0);
  }
}

void SupernodalFactor::forward(double* z, std::int32_t channels, JobRunner& jobs) const {
  ForwardPass<double>(symbolic(), plan(), kernels(), values_.data(), z, channels, memory_).run(jobs);
}

PreviewFactor::PreviewFactor(std::shared_ptr<const Analysis> analysis, const Kernels& kernels,
                             const Buffer<double>& values, Memory& memory, JobRunner& jobs)
    : memory_(memory), analysis_(std::move(analysis)), kernels_(&kernels), values_(memory, values.size()) {
  jobs.for_each(static_cast<std::uint32_t>((values.size() + preview_step - 1) / preview_step),
                [&](std::uint32_t piece) {
                  const std::size_t begin = piece * preview_step, end = std::min(values.size(), begin + preview_step);
                  for (std::size_t k = begin; k < end; ++k) values_[k] = static_cast<float>(values[k]);
                });
}

std::shared_ptr<const PreviewFactor> PreviewFactor::make(const Factor& factor, Memory& memory, JobRunner& jobs) {
  const SupernodalFactor& full = static_cast<const SupernodalFactor&>(factor);
  return make_shared_in<PreviewFactor>(memory, full.analysis(), full.kernels(), full.values(), memory, jobs);
}

void PreviewFactor::forward(float* z, std::int32_t channels, JobRunner& jobs) const {
  ForwardPass<float>(analysis_->symbolic, analysis_->plan, *kernels_, values_.data(), z, channels, memory_).run(jobs);
}

void PreviewFactor::backward(float* z, std::int32_t channels, JobRunner& jobs) const {
  BackwardPass<float>{analysis_->symbolic, analysis_->plan, *kernels_, values_.data(), z, channels}.run(jobs);
}

namespace {

// Returns a power of two near the largest magnitude, or 1 if all numbers are zero. Dividing by it is exact. Single
// precision then neither overflows nor meets its subnormal numbers.
double scale_of(const double* z, std::size_t count, Memory& memory, JobRunner& jobs) {
  const std::size_t pieces = (count + convert_step - 1) / convert_step;
  Buffer<double> largest(memory, pieces);
  jobs.for_each(static_cast<std::uint32_t>(pieces), [&](std::uint32_t piece) {
    double most = 0;
    for (std::size_t i = piece * convert_step; i < std::min(count, (piece + 1) * convert_step); ++i)
      most = std::max(most, std::fabs(z[i]));
    largest[piece] = most;
  });
  double most = 0;
  for (const double value : largest) most = std::max(most, value);
  int exponent = 0;
  if (!(most > 0) || !std::isfinite(most)) return 1;
  std::frexp(most, &exponent);
  return std::ldexp(1.0, std::min(std::max(exponent, -largest_exponent), largest_exponent));
}

template <class Sweep>
void in_single(double* z, std::size_t count, float* scratch, Memory& memory, JobRunner& jobs, Sweep&& sweep) {
  const double scale = scale_of(z, count, memory, jobs), inverse = 1 / scale;
  const std::uint32_t pieces = static_cast<std::uint32_t>((count + convert_step - 1) / convert_step);
  jobs.for_each(pieces, [&](std::uint32_t piece) {
    for (std::size_t i = piece * convert_step; i < std::min(count, (piece + 1) * convert_step); ++i)
      scratch[i] = static_cast<float>(z[i] * inverse);
  });
  sweep();
  jobs.for_each(pieces, [&](std::uint32_t piece) {
    for (std::size_t i = piece * convert_step; i < std::min(count, (piece + 1) * convert_step); ++i)
      z[i] = static_cast<double>(scratch[i]) * scale;
  });
}

}  // namespace

void PreviewFactor::forward(double* z, std::int32_t channels, float* scratch, JobRunner& jobs) const {
  in_single(z, size() * static_cast<std::size_t>(channels), scratch, memory_, jobs,
            [&] { forward(scratch, channels, jobs); });
}

void PreviewFactor::backward(double* z, std::int32_t channels, float* scratch, JobRunner& jobs) const {
  in_single(z, size() * static_cast<std::size_t>(channels), scratch, memory_, jobs,
            [&] { backward(scratch, channels, jobs); });
}

std::size_t PreviewFactor::size() const noexcept { return static_cast<std::size_t>(analysis_->symbolic.size); }

}  // namespace hf_inner::factor

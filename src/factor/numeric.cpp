#include "factor/numeric.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include "base/compiler.h"
#include "base/error.h"

namespace hf_inner::factor {
namespace {

// The sizes of jobs and distances below trade even loads for the cost of a job or of a cache miss. With half and with
// twice each value, a factorisation takes the same time within 10 %, the noise (3,000 to 304,000 vertices, two
// threads).

// The assembly of a front asks for matrix entries this many columns ahead. No result depends on it. Fewer wait for
// memory, more leave the cache again. On one thread half and double take the same time within the noise of 10 % (torus
// of 90,000 vertices).
constexpr std::int32_t assembly_ahead = 16;
// Fronts (dense matrices of supernodes) of one wave do not depend on each other. Each is one thread's job if the
// largest front is at most this many times its fair share. Otherwise each is split over the threads. On one thread 1.06
// and 2.5 take the same time within the noise of 10 % (torus of 90,000 vertices).
constexpr double even_fronts = 1.25;
// Fronts (dense matrices) of a wave (independent supernodes) with fewer flops in all are never split: 0.07 ms at 27
// GF/s, the cost of about two batches of jobs. On one thread half and double take the same time within the noise of 10
// % (torus of 90,000 vertices).
constexpr double small_wave_flops = 2e6;
// The number of tiles (8 rows of a front) per thread's job, chosen by the cost of a tile in each step. No result
// depends on it. On two threads and a torus of 102,400 vertices half and double of each change the factorisation by at
// most 4 %, the noise.
constexpr std::int32_t copy_tiles = 32, solve_tiles_step = 6, update_tiles_step = 4, store_tiles_step = 16;
// Columns of a front that are factored before all threads solve the rows below them. No result depends on it. Fewer
// make more passes over the rows below, more leave threads idle. On one thread half and double take the same time
// within the noise of 10 % (torus of 90,000 vertices).
constexpr std::int32_t column_block = 64;
// A front (dense matrix of a supernode) that takes more flops is computed in pieces, on one thread too. A cancel is
// heeded between pieces; 2.5e8 flops take 10 ms at 27 GF/s. Twice the value doubles the wait, half of it calls more
// kernels.
constexpr double long_front_flops = 2.5e8;
// Reported progress when all fronts are done.
constexpr double progress_of_fronts = 0.99;

// All memory that one thread needs to factor fronts (dense matrices of supernodes). It is reused from front to front.
struct Workspace {
  Workspace(Memory& memory, std::int32_t unknowns, const Plan::Sizes& sizes)
      : place_of(memory, unknowns),
        panel(memory, static_cast<std::size_t>(sizes.panel)),
        floor(memory, static_cast<std::size_t>(sizes.columns) + widest_vector),
        place(memory, static_cast<std::size_t>(sizes.child_rows)),
        run(memory, static_cast<std::size_t>(sizes.child_rows) + 2 * static_cast<std::size_t>(sizes.children)),
        children(memory, static_cast<std::size_t>(sizes.children)) {
    for (int side = 0; side < 2; ++side) stack[side].allocate(memory, static_cast<std::size_t>(sizes.stack[side]));
  }
  // By row of the matrix: its row in the present front (dense matrix of a supernode). Only entries of the front's rows
  // are valid.
  Buffer<std::int32_t> place_of;
  Buffer<double> panel, floor, stack[2];
  std::int64_t stack_top[2] = {0, 0};
  Buffer<std::int32_t> place, run;
  Buffer<ChildView> children;
  std::int32_t child_count = 0;
};

// Scratch memory for the running threads. Their number is the largest number of threads that ran at once.
class WorkspacePool {
 public:
  WorkspacePool(Memory& memory, std::int32_t unknowns, const Plan::Sizes& sizes)
      : memory_(memory), unknowns_(unknowns), sizes_(sizes), all_(&memory), free_(&memory) {}
  std::shared_ptr<Workspace> take() {
    {
      std::lock_guard<std::mutex> lock(mutex_);
      if (!free_.empty()) {
        std::shared_ptr<Workspace> taken = free_.back();
        free_.pop_back();
        return taken;
      }
    }
    std::shared_ptr<Workspace> made = make_shared_in<Workspace>(memory_, memory_, unknowns_, sizes_);
    std::lock_guard<std::mutex> lock(mutex_);
    all_.push_back(made);
    free_.reserve(all_.size());
    return made;
  }
  void give_back(std::shared_ptr<Workspace> workspace) noexcept {
    std::lock_guard<std::mutex> lock(mutex_);
    free_.push_back(std::move(workspace));  // within the reserved capacity
  }

 private:
  Memory& memory_;
  std::int32_t unknowns_;
  Plan::Sizes sizes_;
  std::mutex mutex_;
  Vector<std::shared_ptr<Workspace>> all_, free_;
};

class Factorisation {
 public:
  Factorisation(const Symbolic& symbolic, const Plan& plan, const Kernels& kernels, const SymmetricMatrix& matrix,
                Span<const std::uint8_t> eliminated, double lost_share, double* values, Memory& memory, JobRunner& jobs)
      : symbolic_(symbolic),
        plan_(plan),
        kernels_(kernels),
        matrix_(matrix),
        eliminated_(eliminated),
        lost_share_(lost_share),
        values_(values),
        memory_(memory),
        jobs_(jobs),
        shared_(memory, static_cast<std::size_t>(plan.shared_size)),
        update_(memory, static_cast<std::size_t>(symbolic.supernodes)) {}

  void run() {
    {
      WorkspacePool pool(memory_, symbolic_.size, plan_.in_task);
      jobs_.for_each(static_cast<std::uint32_t>(plan_.tasks), [&](std::uint32_t k) {
        std::shared_ptr<Workspace> workspace = pool.take();
        run_task(plan_.task_order[k], *workspace);
        pool.give_back(std::move(workspace));
      });
    }
    throw_if_lost();
    WorkspacePool pool(memory_, symbolic_.size, plan_.in_top);
    for (std::int32_t wave = 0; wave < plan_.waves; ++wave) {
      run_wave(wave, pool);
      throw_if_lost();
    }
  }

 private:
  FrontView open_front(std::int32_t s, Workspace& workspace, double* update) const noexcept {
    FrontView front;
    front.columns = symbolic_.columns(s);
    front.below = symbolic_.below(s);
    front.triangle_tiles = (front.columns + 7) / 8;
    front.below_tiles = (front.below + 7) / 8;
    front.panel = workspace.panel.data();
    front.update = update;
    return front;
  }

  // Sets up the front (dense matrix) of supernode s: the places of its rows, the places of its child supernodes' rows,
  // and its columns of the matrix.
  void assemble(std::int32_t s, const FrontView& front, Workspace& workspace) const noexcept {
    std::int32_t* place_of = workspace.place_of.data();
    const std::int32_t first = symbolic_.first[s];
    const std::int32_t* rows = symbolic_.row_list(s);
    for (std::int32_t j = 0; j < front.columns; ++j) place_of[first + j] = j;
    const std::int32_t offset = 8 * front.triangle_tiles;
    for (std::int32_t k = 0; k < front.below; ++k) place_of[rows[k]] = offset + k;
    std::int32_t* place = workspace.place.data();
    std::int32_t* run = workspace.run.data();
    std::int32_t count = 0;
    for (std::int32_t c = plan_.child[s]; c >= 0; c = plan_.sibling[c]) {
      const std::int32_t size = symbolic_.below(c);
      const std::int32_t* child_rows = symbolic_.row_list(c);
      std::int32_t into_panel = 0, runs = 0, expected = -1;
      for (std::int32_t i = 0; i < size; ++i) {
        place[i] = place_of[child_rows[i]];
        if (place[i] != expected) run[runs++] = i;
        expected = place[i] + 1;
        into_panel += place[i] < front.columns;
      }
      run[runs++] = size;
      workspace.children[count++] = {update_[c], (size + 7) / 8, size, into_panel, place, run};
      place += size;
      run += runs;
    }
    workspace.child_count = count;
    load_columns(s, front, workspace);
  }

  void load_columns(std::int32_t s, const FrontView& front, Workspace& workspace) const noexcept {
    const std::int32_t* start = matrix_.column_start.data();
    const std::int32_t* row = matrix_.row.data();
    const double* value = matrix_.value.data();
    const std::int32_t* position = symbolic_.position.data();
    const std::int32_t* order = symbolic_.order.data();
    const std::int32_t first = symbolic_.first[s];
    for (std::int32_t j = 0; j < front.columns; ++j) {
      const std::int32_t column = first + j;
      if (column + assembly_ahead < symbolic_.size) {
        const std::int32_t ahead = start[order[column + assembly_ahead]];
        HF_PREFETCH(row + ahead);
        HF_PREFETCH(value + ahead);
      }
      const std::int32_t unknown = order[column];
      double* target = front.panel + 8 * static_cast<std::int64_t>(j);
      const std::int64_t stride = 8 * static_cast<std::int64_t>(front.columns);
      const bool identity = !eliminated_.empty() && eliminated_[unknown];
      workspace.floor[j] = 0;
      for (std::int32_t e = start[unknown]; e < start[unknown + 1]; ++e) {
        const std::int32_t other = position[row[e]];
        if (other < column) continue;
        double entry = value[e];
        if (!eliminated_.empty() && (identity || eliminated_[row[e]])) entry = other == column ? 1.0 : 0.0;
        const std::int32_t place = workspace.place_of[other];
        target[(place >> 3) * stride + (place & 7)] = entry;
        if (other == column) workspace.floor[j] = std::max(0.0, entry * lost_share_);
      }
    }
  }

  void lose(std::int32_t column) noexcept {
    std::int32_t present = lost_.load(std::memory_order_relaxed);
    while (column < present && !lost_.compare_exchange_weak(present, column, std::memory_order_relaxed)) {
    }
  }

  void throw_if_lost() const {
    const std::int32_t column = lost_.load(std::memory_order_relaxed);
    if (column == INT32_MAX) return;
    const std::int32_t unknown = symbolic_.order[column];
    fail(HF_ERROR_NOT_POSITIVE_DEFINITE, static_cast<std::uint32_t>(unknown),
         "the matrix is not positive definite: the pivot of column %d failed; every component needs a pinned vertex "
         "and non-degenerate weights",
         unknown);
  }

  // Reports that a front of that many flops is done. Jobs call it.
  void report_done(double flops) {
    double done = done_.load(std::memory_order_relaxed);
    while (!done_.compare_exchange_weak(done, done + flops, std::memory_order_relaxed)) {
    }
    // The padding of supernodes counts in `flops` and not in the sum, so the ratio may pass 1.
    report(static_cast<float>(progress_of_fronts * std::min(1.0, (done + flops) / symbolic_.flops)));
  }

  // Computes the front (dense matrix) of supernode s, from the assembly to the stored columns.
  void run_front(std::int32_t s, Workspace& workspace, double* update) {
    if (symbolic_.work[s] > long_front_flops) return run_front_in_pieces(s, workspace, update);
    run_short_front(s, workspace, update);
    report_done(symbolic_.work[s]);
  }

  // The same on one thread and without asking for a cancel.
  void run_short_front(std::int32_t s, Workspace& workspace, double* update) noexcept {
    const FrontView front = open_front(s, workspace, update);
    const std::int32_t tiles = front.triangle_tiles + front.below_tiles;
    update_[s] = update;
    std::fill(front.panel, front.panel + 8 * static_cast<std::int64_t>(tiles) * front.columns, 0.0);
    assemble(s, front, workspace);
    for (std::int32_t c = 0; c < workspace.child_count; ++c)
      kernels_.extend_add(front, workspace.children[c], 0, workspace.children[c].into_panel);
    for (std::int32_t begin = 0; begin < front.columns; begin += column_block) {
      const std::int32_t end = std::min(front.columns, begin + column_block);
      const std::int32_t lost = kernels_.factor_triangle(front, begin, end, workspace.floor.data());
      if (lost >= 0) {
        lose(symbolic_.first[s] + lost);
        std::fill(update, update + update_size(front.below), 0.0);
        return;
      }
      kernels_.solve_tiles(front, begin, end, (end + 7) / 8, tiles);
    }
    kernels_.form_update(front, 0, front.below_tiles);
    for (std::int32_t c = 0; c < workspace.child_count; ++c) {
      kernels_.extend_add(front, workspace.children[c], workspace.children[c].into_panel, workspace.children[c].size);
    }
    if (front.columns <= narrow_columns) {
      kernels_.invert_triangle(front);
      kernels_.multiply_inverse(front, front.triangle_tiles, tiles);
    }
    kernels_.store_tiles(front, values_ + symbolic_.value_start[s], 0, tiles);
  }

  void run_task(std::int32_t task, Workspace& workspace) {
    for (std::int32_t r = plan_.task_start[task]; r < plan_.task_start[task + 1]; ++r) {
      const std::int32_t root = plan_.task_root[r];
      workspace.stack_top[0] = workspace.stack_top[1] = 0;
      for (std::int32_t s = symbolic_.subtree[root]; s <= root; ++s) {
        const int side = plan_.parity[s];
        double* update = s == root ? shared_.data() + plan_.shared_update[s]
                                   : workspace.stack[side].data() + workspace.stack_top[side];
        if (s != root) workspace.stack_top[side] += update_size(symbolic_.below(s));
        run_front(s, workspace, update);
        for (std::int32_t c = plan_.child[s]; c >= 0; c = plan_.sibling[c])
          workspace.stack_top[side ^ 1] -= update_size(symbolic_.below(c));
      }
    }
  }

  // Factors one wave (supernodes that do not depend on each other). If whole fronts share the threads evenly, each
  // front is a job. Otherwise the fronts run one after the other, each split over the threads.
  void run_wave(std::int32_t wave, WorkspacePool& pool) {
    const std::int32_t begin = plan_.wave_start[wave], end = plan_.wave_start[wave + 1];
    double total = 0, largest = 0;
    for (std::int32_t k = begin; k < end; ++k) {
      total += symbolic_.work[plan_.top[k]];
      largest = std::max(largest, symbolic_.work[plan_.top[k]]);
    }
    const bool whole =
        jobs_.thread_count() == 1 || largest * jobs_.thread_count() <= even_fronts * total || total < small_wave_flops;
    const auto update_of = [&](std::int32_t s) { return shared_.data() + plan_.shared_update[s]; };
    if (whole) {
      jobs_.for_each(static_cast<std::uint32_t>(end - begin), [&](std::uint32_t k) {
        std::shared_ptr<Workspace> workspace = pool.take();
        const std::int32_t s = plan_.top[begin + static_cast<std::int32_t>(k)];
        run_front(s, *workspace, update_of(s));
        pool.give_back(std::move(workspace));
      });
      return;
    }
    std::shared_ptr<Workspace> workspace = pool.take();
    for (std::int32_t k = begin; k < end; ++k) run_front_in_pieces(plan_.top[k], *workspace, update_of(plan_.top[k]));
    pool.give_back(std::move(workspace));
  }

  // Cuts [begin, end) into steps and calls piece(first, last) for each, as thread jobs.
  template <class Piece>
  void in_pieces(std::int32_t begin, std::int32_t end, std::int32_t step, Piece&& piece) {
    if (begin >= end) return;
    jobs_.for_each(static_cast<std::uint32_t>((end - begin + step - 1) / step), [&](std::uint32_t k) {
      const std::int32_t at = begin + static_cast<std::int32_t>(k) * step;
      piece(at, std::min(end, at + step));
    });
  }

  // Computes the same front as run_front, with every step split over the threads. Each number comes from the same
  // operations in the same order.
  void run_front_in_pieces(std::int32_t s, Workspace& workspace, double* update) {
    const FrontView front = open_front(s, workspace, update);
    const std::int32_t tiles = front.triangle_tiles + front.below_tiles;
    update_[s] = update;
    const std::int64_t tile_size = 8 * static_cast<std::int64_t>(front.columns);
    in_pieces(0, tiles, copy_tiles, [&](std::int32_t begin, std::int32_t end) {
      std::fill(front.panel + begin * tile_size, front.panel + end * tile_size, 0.0);
    });
    assemble(s, front, workspace);
    for (std::int32_t c = 0; c < workspace.child_count; ++c) {
      in_pieces(0, workspace.children[c].into_panel, copy_tiles, [&](std::int32_t begin, std::int32_t end) {
        kernels_.extend_add(front, workspace.children[c], begin, end);
      });
    }
    for (std::int32_t begin = 0; begin < front.columns; begin += column_block) {
      const std::int32_t end = std::min(front.columns, begin + column_block);
      const std::int32_t lost = kernels_.factor_triangle(front, begin, end, workspace.floor.data());
      if (lost >= 0) {
        lose(symbolic_.first[s] + lost);
        return;
      }
      in_pieces((end + 7) / 8, tiles, solve_tiles_step,
                [&](std::int32_t from, std::int32_t to) { kernels_.solve_tiles(front, begin, end, from, to); });
    }
    in_pieces(0, front.below_tiles, update_tiles_step,
              [&](std::int32_t begin, std::int32_t end) { kernels_.form_update(front, begin, end); });
    for (std::int32_t c = 0; c < workspace.child_count; ++c) {
      const ChildView& child = workspace.children[c];
      in_pieces(child.into_panel, child.size, copy_tiles,
                [&](std::int32_t begin, std::int32_t end) { kernels_.extend_add(front, child, begin, end); });
    }
    if (front.columns <= narrow_columns) {
      kernels_.invert_triangle(front);
      in_pieces(front.triangle_tiles, tiles, copy_tiles,
                [&](std::int32_t begin, std::int32_t end) { kernels_.multiply_inverse(front, begin, end); });
    }
    in_pieces(0, tiles, store_tiles_step, [&](std::int32_t begin, std::int32_t end) {
      kernels_.store_tiles(front, values_ + symbolic_.value_start[s], begin, end);
    });
    report_done(symbolic_.work[s]);
  }

  const Symbolic& symbolic_;
  const Plan& plan_;
  const Kernels& kernels_;
  const SymmetricMatrix& matrix_;
  Span<const std::uint8_t> eliminated_;
  double lost_share_;
  double* values_;
  Memory& memory_;
  JobRunner& jobs_;
  Buffer<double> shared_;
  Buffer<double*> update_;
  std::atomic<std::int32_t> lost_{INT32_MAX};
  std::atomic<double> done_{0};  // flops of finished fronts
};

}  // namespace

void factorise(const Symbolic& symbolic, const Plan& plan, const Kernels& kernels, const SymmetricMatrix& matrix,
               Span<const std::uint8_t> eliminated, double lost_share, double* values, Memory& memory,
               JobRunner& jobs) {
  Factorisation(symbolic, plan, kernels, matrix, eliminated, lost_share, values, memory, jobs).run();
  const std::size_t stored = static_cast<std::size_t>(symbolic.stored_entries);
  std::fill(values + stored, values + stored + value_slack, 0.0);
}

bool all_finite(const double* values, std::size_t count) noexcept {
  // Sums x - x over all numbers, which is zero only if every x is finite. Eight independent sums avoid branches.
  double sum[8] = {};
  std::size_t k = 0;
  for (; k + 8 <= count; k += 8) {
    for (std::size_t c = 0; c < 8; ++c) sum[c] += values[k + c] - values[k + c];
  }
  for (; k < count; ++k) sum[0] += values[k] - values[k];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]) + (sum[4] + sum[5]) + (sum[6] + sum[7]) == 0;
}

void require_finite(const SymmetricMatrix& matrix) {
  if (all_finite(matrix.value.data(), matrix.value.size())) return;
  for (std::int32_t column = 0; column < matrix.size(); ++column) {
    for (std::int32_t e = matrix.column_start[column]; e < matrix.column_start[column + 1]; ++e) {
      if (std::isfinite(matrix.value[e])) continue;
      fail(HF_ERROR_NON_FINITE, static_cast<std::uint32_t>(column),
           "column %d of the matrix holds NaN or infinity: check the positions around vertex %d", column, column);
    }
  }
}

}  // namespace hf_inner::factor

#include "factor/plan.h"

#include <algorithm>

#include "base/stable_sort.h"

namespace hf_inner::factor {
namespace {

// A subtree of supernodes with at most this share of the flops is one task (job of one thread). Four threads get eight
// tasks each, so that none waits long. With half and twice the value, factorisations take the same time within 10 %.
constexpr double task_share = 1.0 / 32.0;
// Smaller subtrees of supernodes are grouped up to this share of the flops, so that a task costs more than its start.
// With half the value, fields on two threads take up to 1.2 times as long; with twice the value, the same time.
constexpr double group_share = 1.0 / 64.0;
// A factorisation with fewer flops is one task (job of one thread): 0.15 ms at 27 GF/s, the cost of a few batches of
// jobs. With half the value, 3,000 vertices take 0.6 times as long on two threads, but fields get other bits.
constexpr double whole_work = 4e6;

void link_children(const Symbolic& symbolic, Memory& memory, Plan& plan) {
  const std::int32_t count = symbolic.supernodes;
  plan.child.allocate(memory, count);
  plan.sibling.allocate(memory, count);
  plan.parity.allocate(memory, count);
  std::fill(plan.child.begin(), plan.child.end(), -1);
  for (std::int32_t s = count - 1; s >= 0; --s) {
    const std::int32_t parent = symbolic.parent[s];
    plan.sibling[s] = parent < 0 ? -1 : plan.child[parent];
    if (parent >= 0) plan.child[parent] = s;
    plan.parity[s] = parent < 0 ? 0 : static_cast<std::uint8_t>(plan.parity[parent] ^ 1);
  }
}

// Computes the share of flops and of stored numbers in every subtree.
void sum_shares(const Symbolic& symbolic, double* share) {
  double work = 0;
  for (std::int32_t s = 0; s < symbolic.supernodes; ++s) work += symbolic.work[s];
  for (std::int32_t s = 0; s < symbolic.supernodes; ++s) {
    const double width = symbolic.columns(s);
    const double entries = width * (width + 1) / 2 + width * symbolic.below(s);
    share[s] = 0.5 * (symbolic.work[s] / work + entries / symbolic.stored_entries);
  }
  for (std::int32_t s = 0; s < symbolic.supernodes; ++s) {
    if (symbolic.parent[s] >= 0) share[symbolic.parent[s]] += share[s];
  }
}

void group_tasks(const Symbolic& symbolic, const double* share, Memory& memory, Plan& plan) {
  Vector<std::int32_t> roots(&memory), starts(&memory), top(&memory);
  double work = 0;
  for (std::int32_t s = 0; s < symbolic.supernodes; ++s) work += symbolic.work[s];
  const double limit = work <= whole_work ? 2.0 : task_share;
  double grouped = 2 * group_share;
  Vector<double> task_share_sum(&memory);
  for (std::int32_t s = 0; s < symbolic.supernodes; ++s) {
    if (share[s] > limit) {
      top.push_back(s);
      continue;
    }
    const std::int32_t parent = symbolic.parent[s];
    if (parent >= 0 && share[parent] <= limit) continue;
    if (starts.empty() || (limit < 1.0 && grouped + share[s] > group_share)) {
      starts.push_back(static_cast<std::int32_t>(roots.size()));
      task_share_sum.push_back(0);
      grouped = 0;
    }
    grouped += share[s];
    task_share_sum.back() += share[s];
    roots.push_back(s);
  }
  plan.tasks = static_cast<std::int32_t>(starts.size());
  starts.push_back(static_cast<std::int32_t>(roots.size()));
  plan.task_root.allocate(memory, roots.size());
  std::copy(roots.begin(), roots.end(), plan.task_root.begin());
  plan.task_start.allocate(memory, starts.size());
  std::copy(starts.begin(), starts.end(), plan.task_start.begin());
  plan.task_order.allocate(memory, plan.tasks);
  for (std::int32_t t = 0; t < plan.tasks; ++t) plan.task_order[t] = t;
  stable_sort(
      plan.task_order.data(), plan.task_order.size(),
      [&](std::int32_t a, std::int32_t b) { return task_share_sum[a] > task_share_sum[b]; }, memory);
  // Subtrees of supernodes are tasks, one job each. The supernodes above them run in waves. A wave holds the supernodes
  // of equal height above the tasks.
  Vector<std::int32_t> height(symbolic.supernodes, -1, &memory);
  for (const std::int32_t s : top) {
    std::int32_t h = 0;
    for (std::int32_t c = plan.child[s]; c >= 0; c = plan.sibling[c]) h = std::max(h, height[c] + 1);
    height[s] = h;
    plan.waves = std::max(plan.waves, h + 1);
  }
  plan.top.allocate(memory, top.size());
  std::copy(top.begin(), top.end(), plan.top.begin());
  stable_sort(
      plan.top.data(), plan.top.size(), [&](std::int32_t a, std::int32_t b) { return height[a] < height[b]; }, memory);
  plan.wave_start.allocate(memory, static_cast<std::size_t>(plan.waves) + 1);
  std::int32_t k = 0;
  for (std::int32_t w = 0; w < plan.waves; ++w) {
    plan.wave_start[w] = k;
    while (k < static_cast<std::int32_t>(top.size()) && height[plan.top[k]] == w) ++k;
  }
  plan.wave_start[plan.waves] = k;
}

void grow(const Symbolic& symbolic, const Plan& plan, std::int32_t s, Plan::Sizes& sizes) {
  sizes.panel = std::max(sizes.panel, panel_size(symbolic.columns(s), symbolic.below(s)));
  sizes.columns = std::max(sizes.columns, symbolic.columns(s));
  std::int32_t children = 0;
  std::int64_t rows = 0;
  for (std::int32_t c = plan.child[s]; c >= 0; c = plan.sibling[c]) {
    ++children;
    rows += (symbolic.below(c) + 7) / 8 * 8;
  }
  sizes.children = std::max(sizes.children, children);
  sizes.child_rows = std::max(sizes.child_rows, rows);
}

// Measures how large a task's two stacks of update matrices become, by going through its supernodes in advance.
void measure_tasks(const Symbolic& symbolic, Plan& plan) {
  for (std::size_t r = 0; r < plan.task_root.size(); ++r) {
    const std::int32_t root = plan.task_root[r];
    std::int64_t top[2] = {0, 0};
    for (std::int32_t s = symbolic.subtree[root]; s <= root; ++s) {
      grow(symbolic, plan, s, plan.in_task);
      const int side = plan.parity[s];
      if (s != root) top[side] += update_size(symbolic.below(s));
      plan.in_task.stack[side] = std::max(plan.in_task.stack[side], top[side]);
      for (std::int32_t c = plan.child[s]; c >= 0; c = plan.sibling[c]) top[side ^ 1] -= update_size(symbolic.below(c));
    }
  }
}

// Finds first-fit places for the update matrices (Schur complements) that are read after their own task or wave. Roots
// of task subtrees get their places first. A supernode of a wave gets its place while its children's matrices are still
// in use.
void place_shared(const Symbolic& symbolic, Memory& memory, Plan& plan) {
  struct Gap {
    std::int64_t begin, end;
  };
  Vector<Gap> gaps(&memory);
  gaps.push_back({0, INT64_MAX});
  const auto take = [&](std::int32_t s) {
    const std::int64_t size = update_size(symbolic.below(s));
    plan.shared_update[s] = 0;
    if (size == 0) return;
    for (std::size_t g = 0; g < gaps.size(); ++g) {
      if (gaps[g].end - gaps[g].begin < size) continue;
      plan.shared_update[s] = gaps[g].begin;
      gaps[g].begin += size;
      plan.shared_size = std::max(plan.shared_size, gaps[g].begin);
      if (gaps[g].begin == gaps[g].end) gaps.erase(gaps.begin() + static_cast<std::ptrdiff_t>(g));
      return;
    }
  };
  const auto give_back = [&](std::int32_t s) {
    const std::int64_t begin = plan.shared_update[s], end = begin + update_size(symbolic.below(s));
    if (begin == end) return;
    std::size_t g = 0;
    while (g < gaps.size() && gaps[g].begin < end) ++g;
    gaps.insert(gaps.begin() + static_cast<std::ptrdiff_t>(g), {begin, end});
    if (g + 1 < gaps.size() && gaps[g + 1].begin == end) {
      gaps[g].end = gaps[g + 1].end;
      gaps.erase(gaps.begin() + static_cast<std::ptrdiff_t>(g) + 1);
    }
    if (g > 0 && gaps[g - 1].end == begin) {
      gaps[g - 1].end = gaps[g].end;
      gaps.erase(gaps.begin() + static_cast<std::ptrdiff_t>(g));
    }
  };
  plan.shared_update.allocate(memory, symbolic.supernodes);
  std::fill(plan.shared_update.begin(), plan.shared_update.end(), -1);
  for (const std::int32_t root : plan.task_root) take(root);
  for (std::int32_t w = 0; w < plan.waves; ++w) {
    for (std::int32_t k = plan.wave_start[w]; k < plan.wave_start[w + 1]; ++k) take(plan.top[k]);
    for (std::int32_t k = plan.wave_start[w]; k < plan.wave_start[w + 1]; ++k) {
      for (std::int32_t c = plan.child[plan.top[k]]; c >= 0; c = plan.sibling[c]) give_back(c);
    }
  }
}

}  // namespace

double Plan::bytes() const noexcept {
  return 4.0 * static_cast<double>(task_root.size() + task_start.size() + task_order.size() + top.size() +
                                   wave_start.size() + child.size() + sibling.size()) +
         static_cast<double>(parity.size()) + 8.0 * static_cast<double>(shared_update.size());
}

void make_plan(const Symbolic& symbolic, Memory& memory, Plan& out) {
  link_children(symbolic, memory, out);
  Buffer<double> share(memory, symbolic.supernodes);
  sum_shares(symbolic, share.data());
  group_tasks(symbolic, share.data(), memory, out);
  measure_tasks(symbolic, out);
  for (const std::int32_t s : out.top) grow(symbolic, out, s, out.in_top);
  place_shared(symbolic, memory, out);
}

}  // namespace hf_inner::factor

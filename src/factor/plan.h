// Splits the work on a factor into jobs. The split depends only on the pattern, never on the number of threads, so
// every sum is formed in the same order.
//
// A task is a group of complete subtrees of the supernode tree, a small share of all work. Tasks run in any order. The
// supernodes above the tasks, called the top, run in waves of equal height. A wave only needs the waves before it.
#pragma once
#include <cstdint>

#include "base/memory.h"
#include "factor/symbolic.h"

namespace hf_inner::factor {

struct Plan {
  // The tasks.
  Buffer<std::int32_t> task_root;   // roots of complete subtrees of supernodes, ascending
  Buffer<std::int32_t> task_start;  // tasks + 1: task t owns roots [task_start[t], task_start[t + 1])
  Buffer<std::int32_t> task_order;  // tasks (groups of subtrees) by falling work
  std::int32_t tasks = 0;
  // The top: all supernodes above the tasks, which are groups of subtrees.
  Buffer<std::int32_t> top;         // supernodes above the tasks, by height (wave by wave), ascending inside a wave
  Buffer<std::int32_t> wave_start;  // place in `top` where each wave begins; waves + 1 entries
  std::int32_t waves = 0;
  // The supernode tree.
  Buffer<std::int32_t> child, sibling;  // first child and next sibling of a supernode, ascending; -1 at the end
  // By supernode: which of the two stacks takes its update matrix (depth in the tree, lowest bit).
  Buffer<std::uint8_t> parity;
  // The memory that a factorisation needs, in doubles.
  struct Sizes {
    std::int64_t panel = 0, stack[2] = {0, 0};
    std::int32_t children = 0, columns = 0;
    std::int64_t child_rows = 0;
  };
  Sizes in_task, in_top;
  Buffer<std::int64_t>
      shared_update;  // per supernode: place of the update matrix of task roots and top supernodes, or -1
  std::int64_t shared_size = 0;

  double bytes() const noexcept;
};

// These two functions return the number of doubles in a front's panel and in its update matrix.
inline std::int64_t panel_size(std::int64_t columns, std::int64_t below) noexcept {
  return 8 * ((columns + 7) / 8 + (below + 7) / 8) * columns;
}
inline std::int64_t update_size(std::int64_t below) noexcept {
  const std::int64_t tiles = (below + 7) / 8;
  return 32 * tiles * (tiles + 1);
}

void make_plan(const Symbolic& symbolic, Memory& memory, Plan& out);

}  // namespace hf_inner::factor

#include "factor/elimination_tree.h"

#include <algorithm>

#include "base/compiler.h"
#include "base/progress.h"

namespace hf_inner::factor {
namespace {

// A walk over permuted columns asks for memory this many columns ahead: about the time of one cache miss. Half and
// twice the value take the same time within 5 %. No result depends on it.
constexpr std::int32_t columns_ahead = 12;

// Computes the elimination tree by Liu's algorithm. For row i it walks from every neighbour k < i up to the present
// root. The walk compresses the path of ancestors, so that they point to i.
void link_tree(const SymmetricMatrix& matrix, const std::int32_t* order, const std::int32_t* position, std::int32_t n,
               std::int32_t* parent, std::int32_t* ancestor) {
  const std::int32_t* start = matrix.column_start.data();
  const std::int32_t* row = matrix.row.data();
  Poller poller;
  for (std::int32_t i = 0; i < n; ++i) {
    poller.due();
    if (i + columns_ahead < n) HF_PREFETCH(row + start[order[i + columns_ahead]]);
    parent[i] = -1;
    ancestor[i] = -1;
    const std::int32_t unknown = order[i];
    for (std::int32_t e = start[unknown]; e < start[unknown + 1]; ++e) {
      std::int32_t k = position[row[e]];
      if (k >= i) continue;
      while (ancestor[k] != -1 && ancestor[k] != i) {
        const std::int32_t next = ancestor[k];
        ancestor[k] = i;
        k = next;
      }
      if (ancestor[k] == -1) {
        ancestor[k] = i;
        parent[k] = i;
      }
    }
  }
}

// Computes a postorder without recursion: post[k] is the node visited k-th. Children are visited in ascending order.
void make_postorder(const std::int32_t* parent, std::int32_t n, std::int32_t* post, std::int32_t* head,
                    std::int32_t* next) {
  std::fill(head, head + n, -1);
  for (std::int32_t j = n - 1; j >= 0; --j) {
    if (parent[j] < 0) continue;
    next[j] = head[parent[j]];
    head[parent[j]] = j;
  }
  std::int32_t k = 0;
  for (std::int32_t root = 0; root < n; ++root) {
    if (parent[root] >= 0) continue;
    // Goes down to the first leaf, emits it, and continues with the next sibling or the parent.
    std::int32_t j = root;
    for (;;) {
      while (head[j] >= 0) {
        const std::int32_t child = head[j];
        head[j] = next[child];
        j = child;
      }
      post[k++] = j;
      if (j == root) break;
      j = parent[j];
    }
  }
}

// Lists the neighbours with a smaller label for every row, in postordered labels.
void make_lower(const SymmetricMatrix& matrix, Memory& memory, const std::int32_t* position, EliminationTree& tree) {
  const std::int32_t n = matrix.size();
  const std::int32_t* start = matrix.column_start.data();
  const std::int32_t* row = matrix.row.data();
  tree.lower_start.allocate(memory, static_cast<std::size_t>(n) + 1);
  tree.lower.allocate(memory, std::max<std::size_t>(1, matrix.row.size() / 2 + 1));
  std::int32_t* lower_start = tree.lower_start.data();
  std::int32_t* lower = tree.lower.data();
  std::int32_t k = 0;
  Poller poller;
  for (std::int32_t i = 0; i < n; ++i) {
    poller.due();
    if (i + columns_ahead < n) HF_PREFETCH(row + start[tree.label[i + columns_ahead]]);
    lower_start[i] = k;
    const std::int32_t unknown = tree.label[i];
    for (std::int32_t e = start[unknown]; e < start[unknown + 1]; ++e) {
      const std::int32_t j = position[row[e]];
      if (j < i) lower[k++] = j;
    }
  }
  lower_start[n] = k;
}

// Counts the non-zeros of every column. The columns with a non-zero in row i form a subtree of the elimination tree,
// the row subtree of i. j is a leaf of the subtree of row i when no descendant of j is in it yet. Then the least common
// ancestor of j and the previous leaf is subtracted once. Labels are postordered, so the descendants of j are
// [first[j], j].
void count_columns(EliminationTree& tree, std::int32_t n, Memory& memory) {
  Buffer<std::int32_t> work(memory, static_cast<std::size_t>(n) * 4 + 4);
  std::int32_t* first = work.data();
  std::int32_t* previous_leaf = first + n;
  std::int32_t* set = previous_leaf + n;
  std::int32_t* upper_start = set + n;  // n + 1
  const std::int32_t* parent = tree.parent.data();
  const std::int32_t* lower_start = tree.lower_start.data();
  const std::int32_t* lower = tree.lower.data();
  std::int32_t* count = tree.count.data();
  // The transpose lists, for every column, the rows below in ascending order.
  const std::int32_t total = lower_start[n];
  Buffer<std::int32_t> upper(memory, static_cast<std::size_t>(total) + 1);
  std::fill(upper_start, upper_start + n + 1, 0);
  for (std::int32_t e = 0; e < total; ++e) ++upper_start[lower[e] + 1];
  for (std::int32_t j = 0; j < n; ++j) upper_start[j + 1] += upper_start[j];
  for (std::int32_t j = 0; j < n; ++j) set[j] = upper_start[j];
  poll();
  for (std::int32_t i = 0; i < n; ++i) {
    for (std::int32_t e = lower_start[i]; e < lower_start[i + 1]; ++e) upper[set[lower[e]]++] = i;
  }
  for (std::int32_t j = 0; j < n; ++j) first[j] = -1;
  for (std::int32_t j = 0; j < n; ++j) {
    if (first[j] < 0) {
      first[j] = j;
      count[j] = 1;
    }  // j is a leaf of the tree
    else
      count[j] = 0;
    if (parent[j] >= 0 && first[parent[j]] < 0) first[parent[j]] = first[j];
    previous_leaf[j] = -1;
    set[j] = j;
  }
  Poller poller;
  for (std::int32_t j = 0; j < n; ++j) {
    poller.due();
    if (parent[j] >= 0) --count[parent[j]];
    for (std::int32_t e = upper_start[j]; e < upper_start[j + 1]; ++e) {
      const std::int32_t i = upper[e];
      const std::int32_t leaf = previous_leaf[i];
      if (leaf >= first[j]) continue;  // j is no leaf of row subtree i
      ++count[j];
      if (leaf >= 0) {
        std::int32_t root = leaf;
        while (set[root] != root) root = set[root];
        for (std::int32_t k = leaf; k != root;) {
          const std::int32_t next = set[k];
          set[k] = root;
          k = next;
        }
        --count[root];
      }
      previous_leaf[i] = j;
    }
    if (parent[j] >= 0) set[j] = parent[j];
  }
  for (std::int32_t j = 0; j < n; ++j) {
    if (parent[j] >= 0) count[parent[j]] += count[j];
  }
}

}  // namespace

void make_elimination_tree(const SymmetricMatrix& matrix, Span<const std::int32_t> order, Memory& memory,
                           EliminationTree& out) {
  const std::int32_t n = matrix.size();
  const std::size_t size = static_cast<std::size_t>(n);
  Buffer<std::int32_t> work(memory, size * 5 + 1);
  std::int32_t* position = work.data();
  std::int32_t* parent = position + n;
  std::int32_t* post = parent + n;
  std::int32_t* head = post + n;
  std::int32_t* next = head + n;
  for (std::int32_t k = 0; k < n; ++k) position[order[k]] = k;
  link_tree(matrix, order.data(), position, n, parent, head);
  make_postorder(parent, n, post, head, next);
  out.label.allocate(memory, size);
  out.parent.allocate(memory, size);
  out.count.allocate(memory, size);
  for (std::int32_t k = 0; k < n; ++k) {
    out.label[k] = order[post[k]];
    head[post[k]] = k;
  }
  for (std::int32_t k = 0; k < n; ++k) {
    out.parent[k] = parent[post[k]] < 0 ? -1 : head[parent[post[k]]];
    position[out.label[k]] = k;
  }
  make_lower(matrix, memory, position, out);
  count_columns(out, n, memory);
}

}  // namespace hf_inner::factor

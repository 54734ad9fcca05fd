#include "factor/symbolic.h"

#include <algorithm>
#include <utility>

#include "base/progress.h"
#include "factor/elimination_tree.h"

namespace hf_inner::factor {
namespace {

// Rows whose lists are made between two looks at a cancel: 0.1 ms on a torus of 304,000 vertices. No result depends on
// it.
constexpr std::uint32_t rows_per_poll = 1024;

// The supernodes (blocks of columns with equal rows) while they merge. The index is the fundamental supernode, in
// postorder.
struct Merging {
  Merging(Memory& memory, std::int32_t count)
      : first(memory, static_cast<std::size_t>(count) + 1),
        parent(memory, count),
        into(memory, count),
        width(memory, count),
        below(memory, count),
        head(memory, count),
        next(memory, count) {}
  Buffer<std::int32_t> first;       // columns [first[s], first[s + 1]) in tree labels
  Buffer<std::int32_t> parent;      // supernode tree
  Buffer<std::int32_t> into;        // the supernode that it joined, or -1
  Buffer<std::int32_t> width;       // its columns and the columns of all supernodes that joined it
  Buffer<std::int32_t> below;       // number of rows below its triangle
  Buffer<std::int32_t> head, next;  // lists of the present children
};

// Finds chains of columns whose non-zeros nest exactly. Column j + 1 is then the parent of j in the elimination tree,
// and has one non-zero less.
std::int32_t find_fundamental(const EliminationTree& tree, std::int32_t n, std::int32_t* supernode,
                              std::int32_t* first) {
  std::int32_t count = 0;
  for (std::int32_t j = 0; j < n; ++j) {
    const bool joins = j > 0 && tree.parent[j - 1] == j && tree.count[j - 1] == tree.count[j] + 1;
    if (!joins) first[count++] = j;
    supernode[j] = count - 1;
  }
  first[count] = n;
  return count;
}

// Tries to merge the child supernodes of f into f, those that add the fewest stored zeros first. A child that joins
// passes its own children on to f.
void merge_children(Merging& m, std::int32_t f, Vector<std::pair<std::int64_t, std::int32_t>>& trial) {
  const auto zeros = [&](std::int32_t c) {
    return static_cast<std::int64_t>(m.width[c]) * (m.width[f] + m.below[f] - m.below[c]);
  };
  trial.clear();
  for (std::int32_t c = m.head[f]; c >= 0; c = m.next[c]) trial.emplace_back(zeros(c), c);
  std::sort(trial.begin(), trial.end());
  for (const auto& [unused, c] : trial) {
    if (zeros(c) > Symbolic::relaxation + m.below[c] / 2) continue;
    m.into[c] = f;
    m.width[f] += m.width[c];
  }
  // Rebuilds the list of child supernodes: those that stayed, and the children of those that joined.
  std::int32_t kept = -1;
  for (const auto& [unused, c] : trial) {
    if (m.into[c] < 0) {
      m.next[c] = kept;
      kept = c;
      continue;
    }
    for (std::int32_t g = m.head[c]; g >= 0;) {
      const std::int32_t following = m.next[g];
      m.parent[g] = f;
      m.next[g] = kept;
      kept = g;
      g = following;
    }
  }
  m.head[f] = kept;
}

// Numbers the tree of merged supernodes in postorder. Fills the final position of every tree label (old position), and
// the arrays of `out` that describe columns.
void number_supernodes(const Merging& m, std::int32_t fundamental, Memory& memory, Symbolic& out,
                       std::int32_t* final_of) {
  const std::size_t count = static_cast<std::size_t>(fundamental);
  Buffer<std::int32_t> work(memory, count * 5 + 1);
  std::int32_t* child_head = work.data();
  std::int32_t* child_next = child_head + count;
  std::int32_t* member_head = child_next + count;
  std::int32_t* member_next = member_head + count;
  std::int32_t* number = member_next + count;
  std::fill(child_head, child_head + 4 * count, -1);
  std::int32_t supernodes = 0;
  for (std::int32_t s = fundamental - 1; s >= 0; --s) {
    if (m.into[s] >= 0) {
      // Finds the merged supernode to which supernode s finally belongs, and adds s to it. Members come in ascending
      // order.
      std::int32_t root = m.into[s];
      while (m.into[root] >= 0) root = m.into[root];
      member_next[s] = member_head[root];
      member_head[root] = s;
    } else {
      ++supernodes;
      if (m.parent[s] >= 0) {
        child_next[s] = child_head[m.parent[s]];
        child_head[m.parent[s]] = s;
      }
    }
  }
  out.supernodes = supernodes;
  out.first.allocate(memory, static_cast<std::size_t>(supernodes) + 1);
  out.parent.allocate(memory, supernodes);
  out.subtree.allocate(memory, supernodes);
  out.row_start.allocate(memory, static_cast<std::size_t>(supernodes) + 1);
  std::int32_t k = 0, column = 0;
  out.row_start[0] = 0;
  for (std::int32_t root = 0; root < fundamental; ++root) {
    if (m.into[root] >= 0 || m.parent[root] >= 0) continue;
    std::int32_t s = root;
    for (;;) {
      while (child_head[s] >= 0) {
        const std::int32_t child = child_head[s];
        child_head[s] = child_next[child];
        s = child;
      }
      number[s] = k;
      out.first[k] = column;
      for (std::int32_t member = member_head[s]; member >= 0; member = member_next[member]) {
        for (std::int32_t j = m.first[member]; j < m.first[member + 1]; ++j) final_of[j] = column++;
      }
      for (std::int32_t j = m.first[s]; j < m.first[s + 1]; ++j) final_of[j] = column++;
      out.row_start[k + 1] = out.row_start[k] + m.below[s];
      ++k;
      if (s == root) break;
      s = m.parent[s];
    }
  }
  out.first[supernodes] = column;
  for (std::int32_t s = 0; s < fundamental; ++s) {
    if (m.into[s] < 0) out.parent[number[s]] = m.parent[s] < 0 ? -1 : number[m.parent[s]];
  }
  for (std::int32_t s = 0; s < supernodes; ++s) out.subtree[s] = s;
  for (std::int32_t s = 0; s < supernodes; ++s) {
    if (out.parent[s] >= 0) out.subtree[out.parent[s]] = std::min(out.subtree[out.parent[s]], out.subtree[s]);
  }
}

// Makes the row lists of the supernodes. For every row, in ascending order, it walks from the supernode of each smaller
// neighbour up to the row's own supernode. So the lists are ascending. `label_at` maps final rows to tree labels.
void make_row_lists(const EliminationTree& tree, const std::int32_t* final_of, const std::int32_t* label_at,
                    Memory& memory, Symbolic& out) {
  const std::int32_t n = out.size;
  out.rows.allocate(memory, static_cast<std::size_t>(out.row_start[out.supernodes]) + Symbolic::row_slack);
  Buffer<std::int32_t> seen(memory, out.supernodes);
  Buffer<std::int64_t> fill(memory, out.supernodes);
  std::fill(seen.begin(), seen.end(), -1);
  std::copy(out.row_start.data(), out.row_start.data() + out.supernodes, fill.begin());
  std::int32_t* rows = out.rows.data();
  Poller poller(rows_per_poll);
  for (std::int32_t i = 0; i < n; ++i) {
    poller.due();
    const std::int32_t label = label_at[i];
    const std::int32_t own = out.supernode[i];
    seen[own] = i;
    for (std::int32_t e = tree.lower_start[label]; e < tree.lower_start[label + 1]; ++e) {
      for (std::int32_t s = out.supernode[final_of[tree.lower[e]]]; seen[s] != i; s = out.parent[s]) {
        seen[s] = i;
        rows[fill[s]++] = i;
      }
    }
  }
  for (int k = 0; k < Symbolic::row_slack; ++k) rows[out.row_start[out.supernodes] + k] = 0;
}

}  // namespace

double Symbolic::index_bytes() const noexcept {
  return 4.0 * static_cast<double>(position.size() + order.size() + supernode.size() + first.size() + parent.size() +
                                   subtree.size() + rows.size()) +
         8.0 * static_cast<double>(row_start.size() + value_start.size() + work.size());
}

std::int64_t place_values(Symbolic& out) noexcept {
  std::int64_t next = 0;
  for (std::int32_t s = out.supernodes - 1; s >= 0; --s) {
    const std::int64_t width = out.columns(s), below = out.below(s);
    out.value_start[s] = next;
    next += width * (width + 1) / 2 + width * below;
    double work = 0;
    for (std::int64_t j = 0; j < width; ++j) work += static_cast<double>((width - j + below) * (width - j + below));
    out.work[s] = work;
  }
  out.stored_entries = static_cast<double>(next);
  return next;
}

void analyse(const SymmetricMatrix& matrix, Span<const std::int32_t> order, Memory& memory, Symbolic& out) {
  const std::int32_t n = matrix.size();
  const std::size_t size = static_cast<std::size_t>(n);
  EliminationTree tree;
  make_elimination_tree(matrix, order, memory, tree);
  out.size = n;
  out.position.allocate(memory, size);
  out.order.allocate(memory, size);
  out.supernode.allocate(memory, size);
  Buffer<std::int32_t> final_of(memory, size);
  Buffer<std::int32_t> label_at(memory, size);
  {
    Buffer<std::int32_t> first(memory, size + 1);
    const std::int32_t fundamental = find_fundamental(tree, n, out.supernode.data(), first.data());
    Merging merging(memory, fundamental);
    std::copy(first.data(), first.data() + fundamental + 1, merging.first.data());
    for (std::int32_t s = 0; s < fundamental; ++s) {
      const std::int32_t last = merging.first[s + 1] - 1;
      const std::int32_t up = tree.parent[last];
      merging.parent[s] = up < 0 ? -1 : out.supernode[up];
      merging.into[s] = -1;
      merging.head[s] = -1;
      merging.next[s] = -1;
      merging.width[s] = last + 1 - merging.first[s];
      merging.below[s] = tree.count[last] - 1;
    }
    Vector<std::pair<std::int64_t, std::int32_t>> trial(&memory);
    poll();
    for (std::int32_t s = 0; s < fundamental; ++s) {
      merge_children(merging, s, trial);
      const std::int32_t up = merging.parent[s];
      if (up >= 0) {
        merging.next[s] = merging.head[up];
        merging.head[up] = s;
      }
    }
    number_supernodes(merging, fundamental, memory, out, final_of.data());
  }
  for (std::int32_t j = 0; j < n; ++j) {
    const double count = tree.count[j];
    out.entries += count;
    out.flops += count * count;
    label_at[final_of[j]] = j;
    out.order[final_of[j]] = tree.label[j];
    out.position[tree.label[j]] = final_of[j];
  }
  for (std::int32_t s = 0; s < out.supernodes; ++s) {
    for (std::int32_t j = out.first[s]; j < out.first[s + 1]; ++j) out.supernode[j] = s;
  }
  poll();
  make_row_lists(tree, final_of.data(), label_at.data(), memory, out);
  out.value_start.allocate(memory, out.supernodes);
  out.work.allocate(memory, out.supernodes);
  place_values(out);
}

FillEstimate estimate_fill(const SymmetricMatrix& matrix, Span<const std::int32_t> order, Memory& memory) {
  EliminationTree tree;
  make_elimination_tree(matrix, order, memory, tree);
  FillEstimate estimate;
  for (std::int32_t j = 0; j < matrix.size(); ++j) {
    const double count = tree.count[j];
    estimate.entries += count;
    estimate.flops += count * count;
  }
  return estimate;
}

}  // namespace hf_inner::factor

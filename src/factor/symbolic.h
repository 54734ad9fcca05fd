// Symbolic analysis of a sparse Cholesky factorisation P A P' = G G'.
//
// It computes the elimination tree (Liu 1990, "The role of elimination trees in sparse factorization"), a postorder,
// and column counts from the skeleton matrix (Gilbert, Ng & Peyton 1994). Then it finds relaxed supernodes (Ashcraft &
// Grimes 1989) and the row list of every supernode. Cost: O(|A| alpha(n)) for tree and counts of a matrix with |A|
// entries, O(sum of row lists) for the lists; serial. A failed call changes nothing.
//
// Relaxation: a child c joins its parent f when it adds few zeros: nc_c (nc_f + m_f - m_c) <= tau + m_c / 2. nc are
// columns and m rows below a supernode; tau is `relaxation`. The right side is the cost of one more supernode with its
// own row list. Children that add the fewest zeros are merged first.
#pragma once
#include <cstdint>

#include "base/memory.h"
#include "base/span.h"
#include "factor/matrix.h"

namespace hf_inner::factor {

struct Symbolic {
  // Merging two supernodes may store this many zeros. On a torus with 304,000 vertices, 16 stores 15.4 million numbers
  // and a backward sweep takes 9.1 ms. With 0 the sweep takes 9.5 ms, with 48 it takes 11.8 ms.
  static constexpr std::int32_t relaxation = 16;
  // Zeros behind the row lists, so that whole vectors of 16 can be read.
  static constexpr std::int32_t row_slack = 16;

  std::int32_t size = 0;
  std::int32_t supernodes = 0;
  // The non-zeros of G, without the zeros that relaxation adds.
  double entries = 0;
  // The numbers that are stored, with those zeros: packed triangles and row blocks.
  double stored_entries = 0;
  // The sum of the squared column counts.
  double flops = 0;

  // position[unknown] is the row of an unknown in the order of the factor. order[row] is the unknown of a row.
  Buffer<std::int32_t> position, order;
  // supernode[column] is the supernode that a column belongs to. Supernode s has the columns first[s] to
  // first[s + 1] - 1.
  Buffer<std::int32_t> supernode, first;
  // parent[s] is the parent of s in the tree of supernodes, or -1 for a root. The tree is in postorder.
  Buffer<std::int32_t> parent;
  // The subtree of s is the supernodes subtree[s] to s.
  Buffer<std::int32_t> subtree;
  // The rows below the triangle of s begin at rows[row_start[s]], ascending.
  Buffer<std::int64_t> row_start;
  Buffer<std::int32_t> rows;
  // value_start[s] is where the numbers of s begin. The last supernode is stored first.
  Buffer<std::int64_t> value_start;
  // The flops of each supernode, without its subtree.
  Buffer<double> work;

  std::int32_t columns(std::int32_t s) const noexcept { return first[s + 1] - first[s]; }
  std::int32_t below(std::int32_t s) const noexcept {
    return static_cast<std::int32_t>(row_start[s + 1] - row_start[s]);
  }
  const std::int32_t* row_list(std::int32_t s) const noexcept { return rows.data() + row_start[s]; }
  // Returns the bytes of the index lists above.
  double index_bytes() const noexcept;
};

// Analyses the pattern of `matrix` under `order` (order[k]: unknown eliminated k-th). The final order differs from it
// by a postorder of the elimination tree, which changes neither fill nor flops.
void analyse(const SymmetricMatrix& matrix, Span<const std::int32_t> order, Memory& memory, Symbolic& out);

// Fills value_start, work and stored_entries from the other parts. Returns how many numbers the supernodes take.
std::int64_t place_values(Symbolic& out) noexcept;

// Estimates the non-zeros and flops of a factor under an ordering. It only computes tree and counts, so it is a cheap
// way to compare orderings.
struct FillEstimate {
  double entries = 0, flops = 0;
};
FillEstimate estimate_fill(const SymmetricMatrix& matrix, Span<const std::int32_t> order, Memory& memory);

}  // namespace hf_inner::factor

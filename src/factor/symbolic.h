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

namespace hf_inner {

struct Symbolic {
  // Merging two supernodes (blocks of columns) may store this many zeros. On a torus with 304,000 vertices, 0, 16 and
  // 48 store 14.4, 15.4 and 16.4 million numbers; a backward sweep takes 9.5, 9.1 and 11.8 ms.
  static constexpr std::int32_t relaxation = 16;
  // Zeros behind the row lists, so that whole vectors of 16 can be read.
  static constexpr std::int32_t row_slack = 16;

  std::int32_t size = 0;
  std::int32_t supernodes = 0;
  double entries = 0;         // non-zeros of G, without the zeros that relaxation adds
  double stored_entries = 0;  // packed triangles and row blocks, with those zeros
  double flops = 0;           // sum of squared column counts

  Buffer<std::int32_t> position;     // position[unknown] = row in factor order
  Buffer<std::int32_t> order;        // order[row] = unknown
  Buffer<std::int32_t> supernode;    // supernode of a column
  Buffer<std::int32_t> first;        // supernode s has the columns [first[s], first[s + 1])
  Buffer<std::int32_t> parent;       // supernode tree in postorder, -1 for a root
  Buffer<std::int32_t> subtree;      // first supernode of the subtree of s: the subtree is [subtree[s], s]
  Buffer<std::int64_t> row_start;    // where the row list of each supernode begins in `rows`
  Buffer<std::int32_t> rows;         // rows below the triangles, supernode by supernode, ascending
  Buffer<std::int64_t> value_start;  // where the numbers of s begin; the supernodes are stored last to first
  Buffer<double> work;               // flops of each supernode, without its subtree

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

// Estimates the non-zeros and flops of a factor under an ordering. It only computes tree and counts, so it is a cheap
// way to compare orderings.
struct FillEstimate {
  double entries = 0, flops = 0;
};
FillEstimate estimate_fill(const SymmetricMatrix& matrix, Span<const std::int32_t> order, Memory& memory);

}  // namespace hf_inner

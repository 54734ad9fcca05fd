// Finds the nearest of many rows of numbers: a tree of medians (k-d tree) for the coordinates of two surfaces.
//
// The search is exact; among rows of one distance it takes the smallest number. The tree costs O(n log n), a search
// about O(log n) where the rows lie on a surface.
#pragma once
#include <cstdint>

#include "base/memory.h"
#include "base/span.h"

namespace hf_inner::transfer {

class NearestRows {
 public:
  // rows: count x width numbers, kept by the caller.
  NearestRows(Span<const double> rows, std::size_t width, Memory& memory);
  std::int32_t find(const double* row) const noexcept;

 private:
  struct Node {
    std::int32_t first = 0, last = 0;    // rows in order_
    std::int32_t left = -1, right = -1;  // -1: a leaf
    std::int32_t axis = 0;
    double split = 0;
  };
  std::int32_t build(std::int32_t first, std::int32_t last);
  void search(std::int32_t node, const double* row, std::int32_t& best, double& distance) const noexcept;
  Span<const double> rows_;
  std::size_t width_;
  Vector<std::int32_t> order_;
  Vector<Node> nodes_;
};

}  // namespace hf_inner::transfer

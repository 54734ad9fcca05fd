// Finds the triangles near a point or a box, in one tree of boxes for each piece of a mesh.
//
// A block holds the boxes of four triangles or of four blocks, in single precision and a little wider, so that
// compilers test four together. The caller tests the triangles in double precision, so no result depends on this
// rounding. The triangles of a piece are in the order of a space-filling curve (Morton). Cost: O(n log n) to build, and
// less than cuts at medians. It is immutable, so any number of threads may search it.
#pragma once
#include <algorithm>
#include <cstring>

#include "base/compiler.h"
#include "base/index.h"
#include "base/span.h"
#include "mesh/box_tree.h"

namespace hf_inner::mesh {

class PieceTree {
 public:
  // piece: by triangle, below piece_count. Positions are inner ones, of size 1 about.
  PieceTree(Span<const ItemBox> boxes, Span<const Index> piece, Index piece_count, Memory& memory);

  // The triangles of a piece: neighbours in this order are neighbours in space.
  Span<const Index> items(Index piece) const noexcept {
    return {order_.data() + start_[at(piece)], at(start_[at(piece) + 1] - start_[at(piece)])};
  }
  const ItemBox& box(Index piece) const noexcept { return box_[at(piece)]; }
  // Tells whether the box of a triangle of a piece is nearer to a box than the square root of `squared`, or little
  // farther.
  bool is_near(Index piece, const ItemBox& box, double squared) const noexcept;
  // Visits the triangles of a piece whose boxes are nearer to p than the square root of reach(), and some that are
  // little farther. item(triangle) may lower what reach() returns; below 0 it ends the search.
  template <class Reach, class Item>
  void near(Index piece, const Vec3& p, Reach&& reach, Item&& item) const;

 private:
  static constexpr Index width = 4;
  HF_VECTOR(Four, float, 4);
  struct Block {
    Four low[3], high[3];  // by axis; a missing child is far away
    Index first;           // of its children: in order_ at level 0, else in block_
    Index level;
  };
  // Rounding loses a part of 2^-24 in each sum: a search goes this much farther.
  static constexpr float slack = 1 + 1e-6f;
  static constexpr float wider = 2.5e-7f;
  // Each of 11 levels (2^31 triangles are 4^15.5) leaves three blocks to visit.
  static constexpr std::size_t depth = 64;

  static void put(Block& block, Index child, const ItemBox& box) noexcept;
  // More than the squared distance of any two inner points; missing children are farther.
  static constexpr double everything = 16;
  static float reach_of(double squared) noexcept { return static_cast<float>(std::min(squared, everything)) * slack; }
  // Writes four copies of each coordinate.
  static HF_ALWAYS_INLINE void spread(const Vec3& p, Four* out) noexcept {
    const float xyz[3] = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    for (int k = 0; k < 3; ++k) out[k] = Four{} + xyz[k];
  }
  // Returns the squared distances of a box from the four boxes of a block.
  static HF_ALWAYS_INLINE Four squared_to_four(const Block& block, const Four* low, const Four* high) noexcept {
    const Four none = {};
    Four sum = none;
    for (int k = 0; k < 3; ++k) {
      const Four below = block.low[k] - high[k], above = low[k] - block.high[k];
      Four gap = HF_LARGER(below, above);
      gap = HF_LARGER(gap, none);
      sum += gap * gap;
    }
    return sum;
  }

  Vector<Index> order_, start_, root_;  // start_, root_: by piece
  Vector<ItemBox> box_;                 // by piece
  Vector<Block> block_;
};

template <class Reach, class Item>
void PieceTree::near(Index piece, const Vec3& p, Reach&& reach, Item&& item) const {
  struct Open {
    Index block;
    float squared;
  };
  Four point[3];
  spread(p, point);
  Open stack[depth];
  std::size_t open = 0;
  stack[open++] = {root_[at(piece)], 0};
  while (open > 0) {
    const Open next = stack[--open];
    float bound = reach_of(reach());
    if (next.squared > bound) continue;
    const Block& block = block_[at(next.block)];
    const Four four = squared_to_four(block, point, point);
    float squared[width];
    std::memcpy(squared, &four, sizeof squared);
    if (block.level == 0) {
      for (Index i = 0; i < width; ++i) {
        if (squared[i] <= bound) {
          item(order_[at(block.first + i)]);
          bound = reach_of(reach());
        }
      }
      continue;
    }
    // The nearest child comes first.
    const std::size_t bottom = open;
    for (Index i = 0; i < width; ++i) {
      if (!(squared[i] <= bound)) continue;
      std::size_t place = open++;
      for (; place > bottom && stack[place - 1].squared < squared[i]; --place) stack[place] = stack[place - 1];
      stack[place] = {block.first + i, squared[i]};
    }
  }
}

}  // namespace hf_inner::mesh

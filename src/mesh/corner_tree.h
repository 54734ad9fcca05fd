// Some corners of one face by place, so that those inside a triangle of corners are found without looking at all.
//
// A k-d tree (Bentley 1975) over all corners. Each node counts the corners below it that are in; corners come and go. A
// search leaves out three kinds of nodes: empty ones, nodes outside the triangle's box, and nodes beyond one of its
// sides. Cost: O(n log n) to make, O(log n) for a corner that comes or goes. A search costs O(log n) plus the corners
// near the triangle.
#pragma once
#include <algorithm>
#include <cmath>

#include "base/index.h"
#include "base/memory.h"
#include "base/span.h"
#include "mesh/mesh.h"

namespace hf_inner::mesh {

class CornerTree {
 public:
  explicit CornerTree(Memory& memory) : place_(&memory), order_(&memory), leaf_(&memory), nodes_(&memory) {}

  // normal: of the plane, of any length above 0. No corner is in.
  void make(Span<const Vec3> points, Vec3 normal);

  void put_in(Index corner) noexcept { count(corner, 1); }
  void take_out(Index corner) noexcept { count(corner, -1); }

  // Returns a corner for which accept(corner) holds, or -1. It tries every corner inside the triangle a b c that is in.
  // It also tries some outside, and some that are not in.
  template <class Accept>
  Index find(Index a, Index b, Index c, Accept&& accept) const noexcept {
    if (nodes_[1].count == 0) return -1;
    const Triangle triangle(place_[at(a)], place_[at(b)], place_[at(c)], margin_);
    std::size_t open[most_depth];  // two children at most are open on every level
    std::size_t depth = 0;
    open[depth++] = 1;
    while (depth > 0) {
      const std::size_t node = open[--depth];
      if (nodes_[node].count == 0 || triangle.misses(nodes_[node])) continue;
      if (node < leaves_) {
        open[depth++] = 2 * node + 1;
        open[depth++] = 2 * node;
        continue;
      }
      for (std::size_t i = first_of(node - leaves_); i < first_of(node - leaves_ + 1); ++i) {
        if (accept(order_[i])) return order_[i];
      }
    }
    return -1;
  }

 private:
  static constexpr std::size_t most_depth = 64;
  struct Place {
    double x, y;
  };
  struct Node {
    Place low, high;  // of all corners below it
    Index count = 0;  // of those that are in
  };
  class Triangle {
   public:
    Triangle(Place a, Place b, Place c, double margin) noexcept;
    // True if no place of the node's box is inside.
    bool misses(const Node& node) const noexcept {
      if (node.low.x > high_.x || node.high.x < low_.x || node.low.y > high_.y || node.high.y < low_.y) return true;
      for (const Side& s : side_) {
        if (s.x * (s.x > 0 ? node.high.x : node.low.x) + s.y * (s.y > 0 ? node.high.y : node.low.y) < s.least)
          return true;
      }
      return false;
    }

   private:
    struct Side {
      double x, y, least;  // inside: x * place.x + y * place.y >= least
    };
    Place low_, high_;
    Side side_[3];
  };

  // The position in order_ where a leaf begins.
  std::size_t first_of(std::size_t leaf) const noexcept { return leaf * place_.size() / leaves_; }
  void split(std::size_t node, std::size_t first_leaf, std::size_t last_leaf);
  void count(Index corner, Index change) noexcept {
    for (std::size_t node = leaves_ + at(leaf_[at(corner)]); node > 0; node /= 2) nodes_[node].count += change;
  }

  Vector<Place> place_;
  Vector<Index> order_;  // corners, leaf by leaf
  Vector<Index> leaf_;   // of every corner
  Vector<Node> nodes_;   // node i above 2 i and 2 i + 1; leaves from leaves_ on
  std::size_t leaves_ = 1;
  double margin_ = 0;  // more than rounding moves a corner
};

}  // namespace hf_inner::mesh

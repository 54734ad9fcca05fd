// Tells whether two sets of points come within a tolerance of each other.
//
// Distances are computed on differences scaled by a power of two that brings the tolerance near 1, so that no tolerance
// overflows or underflows. Comparing all pairs with Nearness::near gives the same answers, to the last bit.
#pragma once
#include <algorithm>
#include <cmath>

#include "base/index.h"
#include "base/memory.h"
#include "base/progress.h"
#include "mesh/mesh.h"

namespace hf_inner::mesh {

class Nearness {
 public:
  explicit Nearness(double tolerance) noexcept {
    int exponent = 0;
    std::frexp(tolerance, &exponent);
    constexpr int most = 1000;  // so that the scale is a number too
    scale_ = std::ldexp(1.0, -std::clamp(exponent, -most, most));
    tolerance_ = scale_ * tolerance;
    square_ = tolerance_ * tolerance_;
  }
  Vec3 scaled(Vec3 difference) const noexcept { return scale_ * difference; }
  double scaled(double difference) const noexcept { return scale_ * difference; }
  double tolerance() const noexcept { return tolerance_; }  // scaled
  // d: a scaled difference.
  bool near(Vec3 d) const noexcept { return !(dot(d, d) > square_); }

 private:
  double scale_, tolerance_, square_;
};

// A tree of boxes over some points. It reorders them. Long calls poll.
class PointTree {
 public:
  PointTree(Vector<Vec3>& points, Nearness nearness, Memory& memory)
      : points_(points), nearness_(nearness), nodes_(&memory), frames_(&memory) {}

  // Makes the nodes of the points [first, last); returns their root. At least one point.
  Index add(Index first, Index last);
  // Whether a point of one node is near a point of the other.
  bool near(Index a, Index b) { return near(nodes_[at(a)], nodes_[at(b)]); }
  // The same for ranges of points, each pair compared.
  bool near(Index a_first, Index a_last, Index b_first, Index b_last);

 private:
  struct Node {
    Vec3 low, high;
    Index first, last;         // its points
    Index child = Mesh::none;  // the first of two; none for a leaf
    Index frame = Mesh::none;  // once it was needed
  };
  // A box along the principal axes of a node's points: scaled, from the node's low corner.
  struct Frame {
    Vec3 axis[3];
    double low[3], high[3];
  };

  Index make_node(Index first, Index last);
  void split(Index node);
  void add_frame(Node& node);
  bool near(Node& a, Node& b);
  bool half_near(Node& split, Node& whole);
  bool apart_along_centres(Node& a, Node& b);
  double farthest(Node& node, Vec3 origin, Vec3 along);
  Vec3 gap(const Node& a, const Node& b) const noexcept;
  Vec3 span(const Node& a, const Node& b) const noexcept;

  Vector<Vec3>& points_;
  const Nearness nearness_;
  Vector<Node> nodes_;
  Vector<Frame> frames_;
  Poller poller_;
};

}  // namespace hf_inner::mesh

#include "mesh/near_points.h"

#include <limits>

#include "base/algebra.h"

namespace hf_inner::mesh {
namespace {

// Points of a leaf: larger leaves compare more pairs, smaller ones take memory. 4 takes up to 30 % more of both; 16
// takes up to 30 % more time and a quarter less memory.
constexpr Index leaf_points = 8;
// Rounding of projections, in tolerances: ten times the bound of its error. Half is safe too; sets that keep a distance
// this close to the tolerance are compared point by point.
constexpr double projection_slack = 1e-13;

Vec3 largest(Vec3 a, Vec3 b) noexcept { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }
Vec3 smallest(Vec3 a, Vec3 b) noexcept { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }

}  // namespace

Index PointTree::add(Index first, Index last) {
  const Index root = make_node(first, last);
  split(root);
  return root;
}

Index PointTree::make_node(Index first, Index last) {
  poll();
  Node node{points_[at(first)], points_[at(first)], first, last};
  for (Index i = first + 1; i < last; ++i) {
    node.low = smallest(node.low, points_[at(i)]);
    node.high = largest(node.high, points_[at(i)]);
  }
  nodes_.push_back(node);
  return static_cast<Index>(nodes_.size()) - 1;
}

// Halves the points along the widest side, so the depth is logarithmic.
void PointTree::split(Index node) {
  const Node whole = nodes_[at(node)];
  if (whole.last - whole.first <= leaf_points) return;
  const Vec3 width = whole.high - whole.low;
  double Vec3::*const axis = width.x >= width.y && width.x >= width.z ? &Vec3::x
                             : width.y >= width.z                     ? &Vec3::y
                                                                      : &Vec3::z;
  const Index middle = whole.first + (whole.last - whole.first) / 2;
  std::nth_element(points_.begin() + whole.first, points_.begin() + middle, points_.begin() + whole.last,
                   [&](const Vec3& p, const Vec3& q) {
                     poller_.due();
                     return p.*axis < q.*axis;
                   });
  const Index child = make_node(whole.first, middle);
  make_node(middle, whole.last);
  nodes_[at(node)].child = child;
  split(child);
  split(child + 1);
}

void PointTree::add_frame(Node& node) {
  poll();
  Vec3 mean;
  Mat3 moments;
  for (Index i = node.first; i < node.last; ++i) {
    const Vec3 d = nearness_.scaled(points_[at(i)] - node.low);
    mean = mean + d;
    moments(0, 0) += d.x * d.x;
    moments(1, 0) += d.y * d.x;
    moments(1, 1) += d.y * d.y;
    moments(2, 0) += d.z * d.x;
    moments(2, 1) += d.z * d.y;
    moments(2, 2) += d.z * d.z;
  }
  const hf_eigen::Vector3d m(mean.x, mean.y, mean.z);
  moments -= m * m.transpose() / static_cast<double>(node.last - node.first);
  const hf_eigen::SelfAdjointEigenSolver<Mat3> principal(moments);  // reads the lower triangle
  Frame frame;
  for (int k = 0; k < 3; ++k) {
    const auto axis = principal.eigenvectors().col(k);
    frame.axis[k] = {axis(0), axis(1), axis(2)};
    frame.low[k] = std::numeric_limits<double>::infinity();
    frame.high[k] = -frame.low[k];
  }
  for (Index i = node.first; i < node.last; ++i) {
    const Vec3 d = nearness_.scaled(points_[at(i)] - node.low);
    for (int k = 0; k < 3; ++k) {
      const double height = dot(frame.axis[k], d);
      frame.low[k] = std::min(frame.low[k], height);
      frame.high[k] = std::max(frame.high[k], height);
    }
  }
  node.frame = static_cast<Index>(frames_.size());
  frames_.push_back(frame);
}

// The smallest difference of two points of the nodes, scaled, on every axis. Rounding is monotone, so no computed
// difference is smaller.
Vec3 PointTree::gap(const Node& a, const Node& b) const noexcept {
  return nearness_.scaled(largest(largest(b.low - a.high, a.low - b.high), {0, 0, 0}));
}

// The largest difference.
Vec3 PointTree::span(const Node& a, const Node& b) const noexcept {
  return nearness_.scaled(largest(b.high - a.low, a.high - b.low));
}

// An upper bound of the heights of the points above the origin, up to rounding. Exact for leaves; else by the frame.
double PointTree::farthest(Node& node, Vec3 origin, Vec3 along) {
  double height = -std::numeric_limits<double>::infinity();
  if (node.child == Mesh::none) {
    for (Index i = node.first; i < node.last; ++i)
      height = std::max(height, dot(along, nearness_.scaled(points_[at(i)] - origin)));
    return height;
  }
  if (node.frame == Mesh::none) add_frame(node);
  const Frame& frame = frames_[at(node.frame)];
  height = dot(along, nearness_.scaled(node.low - origin));
  for (int k = 0; k < 3; ++k) {
    const double slope = dot(along, frame.axis[k]);
    height += slope * (slope > 0 ? frame.high[k] : frame.low[k]);
  }
  return height;
}

// Whether a plane across the line of the centres keeps the nodes a tolerance apart. The boxes of slanted or bent sheets
// overlap where the sheets themselves do not.
bool PointTree::apart_along_centres(Node& a, Node& b) {
  const Vec3 origin = a.low;
  const Vec3 along = nearness_.scaled((b.low - a.low) + (b.high - a.high));
  const double low = -farthest(b, origin, {-along.x, -along.y, -along.z}), high = farthest(a, origin, along);
  return low - high > (1 + projection_slack) * nearness_.tolerance() * norm(along);
}

bool PointTree::near(Index a_first, Index a_last, Index b_first, Index b_last) {
  for (Index i = a_first; i < a_last; ++i) {
    poller_.due();
    for (Index j = b_first; j < b_last; ++j) {
      if (nearness_.near(nearness_.scaled(points_[at(j)] - points_[at(i)]))) return true;
    }
  }
  return false;
}

bool PointTree::near(Node& a, Node& b) {
  poller_.due();
  if (!nearness_.near(gap(a, b))) return false;
  if (nearness_.near(span(a, b))) return true;
  if (a.child == Mesh::none && b.child == Mesh::none) return near(a.first, a.last, b.first, b.last);
  if (apart_along_centres(a, b)) return false;
  const Vec3 wide_a = nearness_.scaled(a.high - a.low), wide_b = nearness_.scaled(b.high - b.low);
  return dot(wide_a, wide_a) >= dot(wide_b, wide_b) ? half_near(a, b) : half_near(b, a);
}

// Splits the first of two nodes. The caller gives the wider one first, so it has several points.
bool PointTree::half_near(Node& split, Node& whole) {
  if (split.child == Mesh::none) {
    for (Index i = split.first; i < split.last; ++i) {
      Node point{points_[at(i)], points_[at(i)], i, i + 1};
      if (near(point, whole)) return true;
    }
    return false;
  }
  Node &first = nodes_[at(split.child)], &second = nodes_[at(split.child + 1)];
  const Vec3 first_gap = gap(first, whole), second_gap = gap(second, whole);
  if (dot(second_gap, second_gap) < dot(first_gap, first_gap)) return near(second, whole) || near(first, whole);
  return near(first, whole) || near(second, whole);
}

}  // namespace hf_inner::mesh

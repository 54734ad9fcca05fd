#include "skeleton/mirror.h"

#include <algorithm>
#include <cmath>

namespace hf_inner {
namespace {

double coordinate(Vec3 p, int axis) noexcept { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

void split(Vec3* first, Vec3* last, int axis) {
  if (last - first < 2) return;
  Vec3* const middle = first + (last - first) / 2;
  std::nth_element(first, middle, last, [&](Vec3 a, Vec3 b) { return coordinate(a, axis) < coordinate(b, axis); });
  split(first, middle, (axis + 1) % 3);
  split(middle + 1, last, (axis + 1) % 3);
}

void nearest_square(const Vec3* first, const Vec3* last, int axis, Vec3 p, double& best) {
  if (first == last) return;
  const Vec3* const middle = first + (last - first) / 2;
  best = std::min(best, dot(p - *middle, p - *middle));
  const double side = coordinate(p, axis) - coordinate(*middle, axis);
  const int next = (axis + 1) % 3;
  if (side < 0) {
    nearest_square(first, middle, next, p, best);
    if (side * side < best) nearest_square(middle + 1, last, next, p, best);
  } else {
    nearest_square(middle + 1, last, next, p, best);
    if (side * side < best) nearest_square(first, middle, next, p, best);
  }
}

Vec3 reflected(Vec3 p, const Plane& plane) noexcept {
  return p - (2 * (dot(p, plane.left) - plane.offset)) * plane.left;
}

}  // namespace

MirrorSearch::MirrorSearch(const Body& body, Index main, const Vector<Vec3>& pivots, const Vector<Vec3>& means)
    : body_(body),
      main_(main),
      pivots_(pivots),
      means_(means),
      joints_(&body.memory),
      sorted_(&body.memory),
      cloud_(&body.memory) {
  for (const Index j : body.order) {
    if (body.kept[at(j)]) joints_.push_back(j);
  }
  const std::size_t step = body.points.size() / skin_targets + 1;
  for (std::size_t v = 0; v < body.points.size(); v += step) cloud_.push_back(body.points[v]);
  split(cloud_.data(), cloud_.data() + cloud_.size(), 0);
}

void MirrorSearch::sort_along(Vec3 left) {
  Box box;
  for (const Index j : joints_) box.add(means_[at(j)]);
  double longest = -1;
  for (const Vec3 axis : {Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 0, 0}}) {
    const Vec3 along = unit_vector(axis - dot(axis, left) * left);
    const double extent = dot(box.high - box.low, {std::fabs(axis.x), std::fabs(axis.y), std::fabs(axis.z)}) *
                          std::fabs(dot(along, axis));
    if (norm(along) > 0 && extent > longest) {
      longest = extent;
      across_ = along;
    }
  }
  sorted_.clear();
  for (const Index j : joints_) sorted_.push_back({dot(means_[at(j)], across_), j, means_[at(j)]});
  std::sort(sorted_.begin(), sorted_.end(),
            [](const Place& a, const Place& b) { return a.along != b.along ? a.along < b.along : a.joint < b.joint; });
}

// The joint whose pivot and mean are nearest to the given ones, if it is near enough. No joint mirrors its own
// ancestor: a fish is not symmetric from head to tail.
Index MirrorSearch::nearest(Vec3 pivot, Vec3 mean, Index self) const {
  const double s = dot(mean, across_);
  double least = 2 * mirrored;
  Index best = -1;
  const auto first = std::lower_bound(sorted_.begin(), sorted_.end(), s - least,
                                      [](const Place& p, double along) { return p.along < along; });
  for (auto k = first; k != sorted_.end() && k->along <= s + least; ++k) {
    const Vec3 apart = k->mean - mean;
    if (dot(apart, apart) > least * least) continue;
    const Index j = k->joint;
    const double d = norm(apart) + norm(pivots_[at(j)] - pivot);
    if (d > least || (d == least && best >= 0 && best < j)) continue;
    if (j != self && (body_.is_ancestor(j, self) || body_.is_ancestor(self, j))) continue;
    least = d;
    best = j;
  }
  return best;
}

// Joints off the plane that find each other, less those that do not, as a share.
double MirrorSearch::count_pairs(Plane& plane, bool all) {
  const std::size_t step = all || joints_.size() < 4 * plane_voters ? 1 : joints_.size() / plane_voters;
  plane.mates.assign(at(body_.count), -1);
  std::ptrdiff_t paired = 0, off = 0, asked = 0;
  for (std::size_t k = 0; k < joints_.size(); k += step, ++asked) {
    const Index j = joints_[k];
    if (std::fabs(dot(means_[at(j)], plane.left) - plane.offset) <= central) continue;
    ++off;
    const Index mate = nearest(reflected(pivots_[at(j)], plane), reflected(means_[at(j)], plane), j);
    if (mate < 0 || mate == j) continue;
    if (nearest(reflected(pivots_[at(mate)], plane), reflected(means_[at(mate)], plane), mate) != j) continue;
    plane.mates[at(j)] = mate;
    ++paired;
  }
  return static_cast<double>(2 * paired - off) / static_cast<double>(std::max<std::ptrdiff_t>(1, asked));
}

double MirrorSearch::skin_distance(const Plane& plane) {
  if (cloud_.empty()) return 0;
  const std::size_t step = body_.points.size() / skin_samples + 1;
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t v = 0; v < body_.points.size(); v += step, ++count) {
    double best = 1e300;
    nearest_square(cloud_.data(), cloud_.data() + cloud_.size(), 0, reflected(body_.points[v], plane), best);
    sum += std::sqrt(best);
  }
  return sum / static_cast<double>(count);
}

Plane MirrorSearch::look(Vec3 left, bool with_skin, bool all) {
  sort_along(left);
  Vector<double> along(&body_.memory);
  for (const Index j : joints_) along.push_back(dot(pivots_[at(j)], left));
  const auto middle = along.begin() + static_cast<std::ptrdiff_t>(along.size() / 2);
  std::nth_element(along.begin(), middle, along.end());
  Plane best(body_.memory);
  const double offsets[] = {*middle, 0.0, dot(pivots_[at(main_)], left)};  // 0: the middle of the box
  for (std::size_t k = 0; k < 3; ++k) {
    const double offset = offsets[k];
    if (std::any_of(offsets, offsets + k, [&](double o) { return std::fabs(o - offset) < one_place; })) continue;
    Plane plane(body_.memory);
    plane.left = left;
    plane.offset = offset;
    plane.score = count_pairs(plane, all);
    if (best.mates.empty() || plane.score > best.score) best = std::move(plane);
  }
  // Skin that does not lie on itself counts four times its mean distance, a share of the diagonal.
  if (with_skin) best.score -= 4 * skin_distance(best);
  return best;
}

}  // namespace hf_inner

#include "skeleton/mirror.h"

#include <algorithm>
#include <cmath>

namespace hf_inner::skeleton {
namespace {

double coordinate(Vec3 p, int axis) noexcept { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

Vec3 place_of(Vec3 p) noexcept { return p; }
template <class Place>
Vec3 place_of(const Place& p) noexcept {
  return p.mean;
}

template <class T>
void split(T* first, T* last, int axis) {
  if (last - first < 2) return;
  T* const middle = first + (last - first) / 2;
  std::nth_element(first, middle, last, [&](const T& a, const T& b) {
    return coordinate(place_of(a), axis) < coordinate(place_of(b), axis);
  });
  split(first, middle, (axis + 1) % 3);
  split(middle + 1, last, (axis + 1) % 3);
}

// Visits what may lie within a reach of a place, nearer halves first. The reach may shrink on the way.
template <class T, class Visit>
void visit_near(const T* first, const T* last, int axis, Vec3 p, const double& reach, const Visit& visit) {
  if (first == last) return;
  const T* const middle = first + (last - first) / 2;
  visit(*middle);
  const double side = coordinate(p, axis) - coordinate(place_of(*middle), axis);
  const int next = (axis + 1) % 3;
  const bool low_first = side < 0;
  if (low_first) {
    visit_near(first, middle, next, p, reach, visit);
  } else {
    visit_near(middle + 1, last, next, p, reach, visit);
  }
  if (std::fabs(side) > reach) return;
  if (low_first) {
    visit_near(middle + 1, last, next, p, reach, visit);
  } else {
    visit_near(first, middle, next, p, reach, visit);
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
      places_(&body.memory),
      cloud_(&body.memory) {
  for (const Index j : body.order) {
    if (body.kept[at(j)]) joints_.push_back(j);
  }
  for (const Index j : joints_) places_.push_back({means[at(j)], j});
  split(places_.data(), places_.data() + places_.size(), 0);
  const std::size_t step = body.points.size() / skin_targets + 1;
  for (std::size_t v = 0; v < body.points.size(); v += step) cloud_.push_back(body.points[v]);
  split(cloud_.data(), cloud_.data() + cloud_.size(), 0);
}

// The joint whose pivot and mean are nearest to the given ones, if it is near enough. No joint mirrors its own
// ancestor: a fish is not symmetric from head to tail. guess: a joint that is near, or -1.
Index MirrorSearch::nearest(Vec3 pivot, Vec3 mean, Index self, Index guess) const {
  double least = 2 * mirrored;
  Index best = -1;
  if (guess >= 0) {
    const double d = norm(means_[at(guess)] - mean) + norm(pivots_[at(guess)] - pivot);
    if (d <= least) {
      least = d;
      best = guess;
    }
  }
  visit_near(places_.data(), places_.data() + places_.size(), 0, mean, least, [&](const Place& place) {
    const Vec3 apart = place.mean - mean;
    if (dot(apart, apart) > least * least) return;
    const Index j = place.joint;
    const double d = norm(apart) + norm(pivots_[at(j)] - pivot);
    if (d > least || (d == least && best >= 0 && best < j)) return;
    if (j != self && (body_.is_ancestor(j, self) || body_.is_ancestor(self, j))) return;
    least = d;
    best = j;
  });
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
    const Index mate = nearest(reflected(pivots_[at(j)], plane), reflected(means_[at(j)], plane), j, -1);
    if (mate < 0 || mate == j) continue;
    if (nearest(reflected(pivots_[at(mate)], plane), reflected(means_[at(mate)], plane), mate, j) != j) continue;
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
    const Vec3 p = reflected(body_.points[v], plane);
    double square = 1e300, reach = 1e150;
    visit_near(cloud_.data(), cloud_.data() + cloud_.size(), 0, p, reach, [&](Vec3 q) {
      if (dot(p - q, p - q) >= square) return;
      square = dot(p - q, p - q);
      reach = std::sqrt(square);
    });
    sum += reach;
  }
  return sum / static_cast<double>(count);
}

Plane MirrorSearch::look(Vec3 left, bool with_skin, bool all) {
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
    plane.score = count_pairs(plane, false);
    if (best.mates.empty() || plane.score > best.score) best = std::move(plane);
  }
  // joints that stand for all have chosen the offset
  if (all) best.score = count_pairs(best, true);
  // Skin that does not lie on itself counts four times its mean distance, a share of the diagonal.
  if (with_skin) best.score -= 4 * skin_distance(best);
  return best;
}

}  // namespace hf_inner::skeleton

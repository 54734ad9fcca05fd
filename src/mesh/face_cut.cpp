#include "mesh/face_cut.h"

#include <algorithm>
#include <limits>

#include "base/index.h"

namespace hf_inner::mesh {
namespace {

constexpr double no_ear = std::numeric_limits<double>::max(), cut_off = std::numeric_limits<double>::infinity();
// Costs of cuts that differ by less than this share are equal, and the vertex numbers decide. A larger share would take
// a worse diagonal, a smaller one would let rounding decide. Among 7,402 quads of sheets and a double torus, 2,400 have
// costs within 6e-15. No other difference is below 2e-7. So half and double give the same cuts.
constexpr double equal_costs = 1e-9;
// A triangle of the cut must have at least this share of its face's area, on the face's side. It keeps rounding from
// choosing triangles without area; at 0 a corner on a straight side may become one. On 52 generated sheets, ladders and
// pentagons, half, double and 1e-6 change no field; 1e-3 changes five by at most 5e-6 of their range.
constexpr double least_area_share = 1e-9;
// A quad with a corner farther than this share of its diameter from its mean plane is not planar: both cuts count. The
// weights of the two cuts differ by the square of it. Half and double change the class of up to 120 faces of a double
// torus whose coordinates have six digits, and so weights by some 1e-12.
constexpr double planar_bend = 1e-6;
// In a face of fewer corners the search tests all reflex corners. In a larger face a tree gives the ones near the ear.
// More is slower for large faces, fewer for small ones. A corner of a random star of 128 costs 0.69 us with the tree
// and 0.95 without. In a star of 64 it costs 0.60 and 0.54. The cuts are the same.
constexpr std::size_t least_in_tree = 128;
// Divides by lengths of points at one place.
constexpr double least_cross = 1e-300;

// The sum of the cotangents of a triangle: smallest for an equilateral one.
double roundness_cost(Vec3 a, Vec3 b, Vec3 c) noexcept {
  const Vec3 x = b - a, y = c - b, z = a - c;
  const double area2 = norm(cross(x, y)), squares = dot(x, x) + dot(y, y) + dot(z, z);
  return area2 > 0 ? squares / (2 * area2) : no_ear;
}

double cotangent_at(Vec3 corner, Vec3 a, Vec3 b) noexcept {
  const Vec3 x = a - corner, y = b - corner;
  return dot(x, y) / std::max(norm(cross(x, y)), least_cross);
}

}  // namespace

void FaceCutter::cut(Span<const Index> vertices, Span<const Vec3> positions) {
  triangles.clear();
  second_cut = false;
  bend = 0;
  if (vertices.size() == 3) {
    for (Index k = 0; k < 3; ++k) triangles.push_back(k);
    return;
  }
  put_in_order(vertices, positions);
  measure();
  if (vertices.size() == 4)
    cut_quad();
  else
    cut_ears();
}

// The same corners with another start or the other orientation, or mirrored, go through the same arithmetic from here.
void FaceCutter::put_in_order(Span<const Index> vertices, Span<const Vec3> positions) {
  const std::size_t n = vertices.size();
  std::size_t first = 0;
  const auto before = [&](std::size_t i) { return vertices[(i + n - 1) % n]; };
  const auto after = [&](std::size_t i) { return vertices[(i + 1) % n]; };
  const auto lower = [&](std::size_t i) { return std::min(before(i), after(i)); };
  for (std::size_t i = 1; i < n; ++i) {
    if (vertices[i] < vertices[first] || (vertices[i] == vertices[first] && lower(i) < lower(first))) first = i;
  }
  reversed_ = before(first) < after(first);
  order_.resize(n);
  point_.resize(n);
  key_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t corner = reversed_ ? (first + n - i) % n : (first + i) % n;
    order_[i] = static_cast<Index>(corner);
    point_[i] = positions[corner];
    key_[i] = vertices[corner];
  }
}

// Newell's normal, and the bend of the face about its mean plane.
void FaceCutter::measure() {
  const std::size_t n = point_.size();
  normal_ = Vec3();
  Vec3 sum;
  for (std::size_t i = 1; i + 1 < n; ++i) normal_ = normal_ + cross(point_[i] - point_[0], point_[i + 1] - point_[0]);
  for (const Vec3& p : point_) sum = sum + (p - point_[0]);
  square_ = dot(normal_, normal_);
  const Vec3 centre = point_[0] + (1.0 / static_cast<double>(n)) * sum;
  double height = 0, radius = 0;
  for (const Vec3& p : point_) {
    height = std::max(height, std::fabs(dot(p - centre, normal_)));
    radius = std::max(radius, dot(p - centre, p - centre));
  }
  if (square_ > 0 && radius > 0) bend = height / (2 * std::sqrt(square_ * radius));
}

// Twice the area of a triangle of corners as the face's normal sees it, times the length of the normal.
double FaceCutter::side(Index a, Index b, Index c) const noexcept {
  return dot(normal_, cross(point_[at(b)] - point_[at(a)], point_[at(c)] - point_[at(a)]));
}

void FaceCutter::add(Index a, Index b, Index c) {
  if (reversed_) std::swap(a, c);
  for (const Index i : {a, b, c}) triangles.push_back(order_[at(i)]);
}

// The canonical order puts the lowest number at corner 0, so that the diagonal 0-2 wins a tie.
void FaceCutter::cut_quad() {
  const double least = least_area_share * square_;
  const bool first_valid = std::min(side(0, 1, 2), side(0, 2, 3)) > least;
  const bool other_valid = std::min(side(1, 2, 3), side(1, 3, 0)) > least;
  const double first = cotangent_at(point_[1], point_[0], point_[2]) + cotangent_at(point_[3], point_[2], point_[0]);
  const double other = cotangent_at(point_[0], point_[3], point_[1]) + cotangent_at(point_[2], point_[1], point_[3]);
  const double tie = equal_costs * (1 + std::fabs(first) + std::fabs(other));
  const bool take_other = other_valid && (!first_valid || other > first + tie);
  second_cut = first_valid && other_valid && bend > planar_bend;
  if (take_other) {
    add(1, 2, 3);
    add(3, 0, 1);
  } else {
    add(0, 1, 2);
    add(2, 3, 0);
  }
}

// Returns a reflex corner inside the triangle a b c, or -1. Copies of its corners do not count: the two sides of a
// bridge to a hole meet there.
Index FaceCutter::reflex_inside(Index a, Index b, Index c) const noexcept {
  const Vec3 p = point_[at(a)], q = point_[at(b)], r = point_[at(c)];
  const Vec3 pq = q - p, qr = r - q, rp = p - r;
  const Index keys[3] = {key_[at(a)], key_[at(b)], key_[at(c)]};
  const auto inside = [&](Vec3 point, Index key) {
    return dot(normal_, cross(pq, point - p)) >= 0 && dot(normal_, cross(qr, point - q)) >= 0 &&
           dot(normal_, cross(rp, point - r)) >= 0 && std::find(keys, keys + 3, key) == keys + 3;
  };
  if (in_tree_)
    return tree_.find(a, b, c, [&](Index i) { return ears_[at(i)].reflex >= 0 && inside(point_[at(i)], key_[at(i)]); });
  for (const Reflex& it : reflex_) {
    if (inside(it.point, it.key)) return it.corner;
  }
  return -1;
}

void FaceCutter::set_reflex(Index corner, bool reflex) noexcept {
  Index& place = ears_[at(corner)].reflex;
  if ((place >= 0) == reflex) return;
  if (in_tree_) reflex ? tree_.put_in(corner) : tree_.take_out(corner);
  if (reflex) {
    place = static_cast<Index>(reflex_.size());
    reflex_.push_back({point_[at(corner)], key_[at(corner)], corner});  // within its capacity
    return;
  }
  reflex_[at(place)] = reflex_.back();
  ears_[at(reflex_.back().corner)].reflex = place;
  reflex_.pop_back();
  place = -1;
}

void FaceCutter::set_blocker(Index corner, Index blocker) noexcept {
  Ear& ear = ears_[at(corner)];
  if (ear.blocker == blocker) return;
  if (ear.blocker >= 0) {
    (ear.former >= 0 ? ears_[at(ear.former)].next : ears_[at(ear.blocker)].blocked) = ear.next;
    if (ear.next >= 0) ears_[at(ear.next)].former = ear.former;
  }
  ear.blocker = blocker;
  ear.former = -1;
  ear.next = -1;
  if (blocker < 0) return;
  ear.next = ears_[at(blocker)].blocked;
  if (ear.next >= 0) ears_[at(ear.next)].former = corner;
  ears_[at(blocker)].blocked = corner;
}

void FaceCutter::set_cost(Index corner, double cost) noexcept {
  std::size_t node = leaves_ + at(corner);
  costs_[node].cost = cost;
  for (node /= 2; node > 0; node /= 2) {
    const Cost &left = costs_[2 * node], &right = costs_[2 * node + 1];
    costs_[node] = right.cost < (1 - equal_costs) * left.cost ? right : left;
  }
}

void FaceCutter::find_ear(Index corner) noexcept {
  const Index a = ears_[at(corner)].before, c = ears_[at(corner)].after;
  const double area = side(a, corner, c);
  const bool was_reflex = ears_[at(corner)].reflex >= 0;
  set_reflex(corner, !(area > 0));
  double cost = no_ear;
  Index blocker = -1;
  if (key_[at(a)] != key_[at(c)] && area > least_area_share * square_) {
    blocker = reflex_inside(a, corner, c);
    if (blocker < 0) cost = std::min(no_ear, roundness_cost(point_[at(a)], point_[at(corner)], point_[at(c)]));
  }
  set_cost(corner, cost);
  set_blocker(corner, blocker);
  if (was_reflex && area > 0) free_from(corner);
}

// Tests the ears again that a corner blocked, which is reflex no longer.
void FaceCutter::free_from(Index blocker) noexcept {
  while (ears_[at(blocker)].blocked >= 0) {
    const Index ear = ears_[at(blocker)].blocked;
    set_blocker(ear, -1);
    find_ear(ear);
  }
}

void FaceCutter::cut_ears() {
  const Index n = static_cast<Index>(point_.size());
  ears_.assign(at(n), Ear());
  reflex_.clear();
  reflex_.reserve(at(n));
  in_tree_ = at(n) >= least_in_tree && square_ > 0 && std::isfinite(square_);
  if (in_tree_) tree_.make(point_, normal_);
  for (leaves_ = 1; leaves_ < at(n);) leaves_ *= 2;
  costs_.assign(2 * leaves_, {cut_off, -1});
  for (Index i = 0; i < n; ++i) {
    Ear& ear = ears_[at(i)];
    ear.before = (i + n - 1) % n;
    ear.after = (i + 1) % n;
    costs_[leaves_ + at(i)].corner = i;
    set_reflex(i, !(side(ear.before, i, ear.after) > 0));
  }
  for (Index i = 0; i < n; ++i) find_ear(i);
  for (Index left = n; left > 3; --left) {
    const Index best = costs_[1].corner;
    const Ear ear = ears_[at(best)];
    add(ear.before, best, ear.after);
    ears_[at(ear.before)].after = ear.after;
    ears_[at(ear.after)].before = ear.before;
    set_cost(best, cut_off);
    set_blocker(best, -1);
    set_reflex(best, false);  // no longer a corner
    find_ear(ear.before);
    find_ear(ear.after);
    free_from(best);
  }
  const Index last = costs_[1].corner;
  add(ears_[at(last)].before, last, ears_[at(last)].after);
}

}  // namespace hf_inner::mesh

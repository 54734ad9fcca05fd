#include "mesh/triangle_division.h"

#include <algorithm>
#include <cmath>

#include "base/progress.h"

namespace hf_inner::mesh {
namespace {

// A side is flipped if the angles opposite sum to more than pi by this sine. Without it, rounding flips sides to and
// fro where four points lie on a circle. Half and double give the same triangles on the shared meshes.
constexpr double least_flip_gain = 1e-9;

}  // namespace

void TriangleDivision::begin(Vec3 a, Vec3 b, Vec3 c) {
  triangles_.clear();
  points_.assign({{GridPoint::grid, 0}, {0, GridPoint::grid}, {0, 0}});
  const Vec3 p = a - c, q = b - c;
  const double length = norm(q);
  const double along = length > 0 ? dot(p, q) / length : 0.0;
  corner_[0] = {along, -std::sqrt(std::max(0.0, dot(p, p) - along * along))};
  corner_[1] = {length, 0};
  plane_.assign({corner_[0], corner_[1], {0, 0}});
  at_.assign(3, 0);
  here_ = 0;
  triangles_.push_back({{0, 1, 2}, {none, none, none}, {false, false, false}});
}

// Twice the area of three points in steps of the grid; above 0 if they turn as the triangle does.
std::int64_t TriangleDivision::turn(Index p, Index q, Index r) const noexcept {
  const GridPoint &x = points_[at(p)], &y = points_[at(q)], &z = points_[at(r)];
  return (y.a - x.a) * (z.b - x.b) - (y.b - x.b) * (z.a - x.a);
}

int TriangleDivision::corner_of(Index t, Index p) const noexcept {
  const Index* const v = triangles_[at(t)].v;
  return v[0] == p ? 0 : v[1] == p ? 1 : 2;
}

TriangleDivision::Side TriangleDivision::twin(Side side) const noexcept {
  const Piece& piece = triangles_[at(side.triangle)];
  const Index other = piece.beyond[side.k];
  return {other, other == none ? none : corner_of(other, piece.v[next(side.k)])};
}

// The side that runs from p to q or from q to p; none in `triangle`: there is none.
TriangleDivision::Side TriangleDivision::side_between(Index p, Index q) const noexcept {
  const Index start = at_[at(p)];
  for (const bool onwards : {true, false}) {
    Index t = start;
    do {
      const Piece& piece = triangles_[at(t)];
      const int k = corner_of(t, p);
      if (piece.v[next(k)] == q) return {t, k};
      if (piece.v[last(k)] == q) return {t, last(k)};
      t = piece.beyond[onwards ? last(k) : k];
    } while (t != start && t != none);
    if (t == start) break;
  }
  return {none, none};
}

// The side opposite `from` by which the line to another point leaves the triangles at `from`. passes: it passes a
// point.
TriangleDivision::Side TriangleDivision::first_crossed(Index from, Index to, bool& passes) const noexcept {
  const Index start = at_[at(from)];
  for (const bool onwards : {true, false}) {
    Index t = start;
    do {
      const Piece& piece = triangles_[at(t)];
      const int k = corner_of(t, from);
      const std::int64_t right = turn(from, piece.v[next(k)], to), left = turn(from, piece.v[last(k)], to);
      if (right >= 0 && left <= 0) {
        passes = right == 0 || left == 0;
        return {t, next(k)};
      }
      t = piece.beyond[onwards ? last(k) : k];
    } while (t != start && t != none);
    if (t == start) break;
  }
  passes = true;
  return {none, none};
}

// Finds the triangle that has a point, by a walk from the one before.
Index TriangleDivision::locate(Index p) {
  Index t = here_;
  for (std::size_t steps = 0; steps <= triangles_.size(); ++steps) {
    const Piece& piece = triangles_[at(t)];
    int k = 0;
    while (k < 3 && turn(piece.v[k], piece.v[next(k)], p) >= 0) ++k;
    if (k == 3) return t;
    t = piece.beyond[k];
    if (t == none) break;
  }
  // a walk through triangles that are not Delaunay can go in a circle
  for (t = 0;; ++t) {
    const Index* const v = triangles_[at(t)].v;
    if (turn(v[0], v[1], p) >= 0 && turn(v[1], v[2], p) >= 0 && turn(v[2], v[0], p) >= 0) return t;
  }
}

void TriangleDivision::put(Index t, Index p, Index q, Index r) {
  if (at(t) == triangles_.size()) triangles_.emplace_back();
  triangles_[at(t)] = {{p, q, r}, {none, none, none}, {false, false, false}};
  for (const Index v : {p, q, r}) at_[at(v)] = t;
}

void TriangleDivision::link(Side one, Side other, bool fixed) noexcept {
  if (one.triangle != none) {
    triangles_[at(one.triangle)].beyond[one.k] = other.triangle;
    triangles_[at(one.triangle)].fixed[one.k] = fixed;
  }
  if (other.triangle != none) {
    triangles_[at(other.triangle)].beyond[other.k] = one.triangle;
    triangles_[at(other.triangle)].fixed[other.k] = fixed;
  }
}

void TriangleDivision::split_inside(Index t, Index p) {
  const Piece old = triangles_[at(t)];
  const Index count = static_cast<Index>(triangles_.size());
  const Side twins[3] = {twin({t, 0}), twin({t, 1}), twin({t, 2})};
  const Index made[3] = {t, count, count + 1};
  for (int k = 0; k < 3; ++k) put(made[k], old.v[k], old.v[next(k)], p);
  for (int k = 0; k < 3; ++k) {
    link({made[k], 0}, twins[k], old.fixed[k]);
    link({made[k], 1}, {made[next(k)], 2}, false);
    queue_.push_back({old.v[k], old.v[next(k)]});
  }
}

void TriangleDivision::split_side(Side side, Index p) {
  const Side other = twin(side);
  const Index count = static_cast<Index>(triangles_.size());
  // by side of the old edge: the part at its start and the part at its end
  Index parts[2][2] = {{side.triangle, count}, {other.triangle, other.triangle == none ? none : count + 1}};
  for (int s = 0; s < 2; ++s) {
    const Side here = s == 0 ? side : other;
    if (here.triangle == none) continue;
    const Piece old = triangles_[at(here.triangle)];
    const int k = here.k;
    const Index a = old.v[k], b = old.v[next(k)], c = old.v[last(k)];
    const Side at_b = twin({here.triangle, next(k)}), at_c = twin({here.triangle, last(k)});
    put(parts[s][0], a, p, c);
    put(parts[s][1], p, b, c);
    link({parts[s][0], 2}, at_c, old.fixed[last(k)]);
    link({parts[s][1], 1}, at_b, old.fixed[next(k)]);
    link({parts[s][0], 1}, {parts[s][1], 2}, false);
    queue_.push_back({c, a});
    queue_.push_back({b, c});
  }
  if (other.triangle == none) return;
  link({parts[0][0], 0}, {parts[1][1], 0}, false);
  link({parts[0][1], 0}, {parts[1][0], 0}, false);
}

Index TriangleDivision::add(GridPoint point) {
  const Index p = static_cast<Index>(points_.size());
  points_.push_back(point);
  const double share = 1.0 / static_cast<double>(GridPoint::grid);
  const double a = share * static_cast<double>(point.a), b = share * static_cast<double>(point.b);
  plane_.push_back({a * corner_[0].x + b * corner_[1].x, a * corner_[0].y});
  at_.push_back(none);
  const Index t = locate(p);
  const Index* const v = triangles_[at(t)].v;
  int k = 0;
  while (k < 3 && turn(v[k], v[next(k)], p) != 0) ++k;
  queue_.clear();
  if (k < 3)
    split_side({t, k}, p);
  else
    split_inside(t, p);
  here_ = at_[at(p)];
  make_delaunay();
  return p;
}

// Replaces a side by the other diagonal of its two triangles.
void TriangleDivision::flip(Side side) noexcept {
  const Side other = twin(side);
  const Piece one = triangles_[at(side.triangle)], two = triangles_[at(other.triangle)];
  const int k = side.k, l = other.k;
  const Index a = one.v[k], b = one.v[next(k)], c = one.v[last(k)], d = two.v[last(l)];
  const Side bc = twin({side.triangle, next(k)}), ca = twin({side.triangle, last(k)});
  const Side ad = twin({other.triangle, next(l)}), db = twin({other.triangle, last(l)});
  triangles_[at(side.triangle)] = {{c, a, d}, {none, none, none}, {false, false, false}};
  triangles_[at(other.triangle)] = {{d, b, c}, {none, none, none}, {false, false, false}};
  for (const Index v : {c, a, d}) at_[at(v)] = side.triangle;
  at_[at(b)] = other.triangle;
  link({side.triangle, 0}, ca, one.fixed[last(k)]);
  link({side.triangle, 1}, ad, two.fixed[next(l)]);
  link({other.triangle, 0}, db, two.fixed[last(l)]);
  link({other.triangle, 1}, bc, one.fixed[next(k)]);
  link({side.triangle, 2}, {other.triangle, 2}, false);
}

bool TriangleDivision::is_flippable(Side side) const noexcept {
  const Side other = twin(side);
  if (other.triangle == none || triangles_[at(side.triangle)].fixed[side.k]) return false;
  const Index* const v = triangles_[at(side.triangle)].v;
  const Index a = v[side.k], b = v[next(side.k)], c = v[last(side.k)];
  const Index d = triangles_[at(other.triangle)].v[last(other.k)];
  return turn(c, a, d) > 0 && turn(d, b, c) > 0;
}

// The angles opposite the side sum to more than pi.
bool TriangleDivision::is_better_flipped(Side side) const noexcept {
  const Side other = twin(side);
  const Index* const v = triangles_[at(side.triangle)].v;
  const Place a = plane_[at(v[side.k])], b = plane_[at(v[next(side.k)])], c = plane_[at(v[last(side.k)])],
              d = plane_[at(triangles_[at(other.triangle)].v[last(other.k)])];
  const double ax = a.x - c.x, ay = a.y - c.y, bx = b.x - c.x, by = b.y - c.y;
  const double px = b.x - d.x, py = b.y - d.y, qx = a.x - d.x, qy = a.y - d.y;
  const double cos_c = ax * bx + ay * by, sin_c = ax * by - ay * bx, cos_d = px * qx + py * qy,
               sin_d = px * qy - py * qx;
  const double size =
      std::sqrt((ax * ax + ay * ay) * (bx * bx + by * by)) * std::sqrt((px * px + py * py) * (qx * qx + qy * qy));
  return sin_c * cos_d + cos_c * sin_d < -least_flip_gain * size;
}

// Lawson's algorithm. Each flip raises the smallest angle, so it ends; the bound is for rounding.
void TriangleDivision::make_delaunay() {
  const std::size_t most = 64 + 8 * triangles_.size();
  Poller poller;
  for (std::size_t flips = 0; !queue_.empty() && flips < most;) {
    poller.due();
    const Pair pair = queue_.back();
    queue_.pop_back();
    const Side side = side_between(pair.p, pair.q);
    if (side.triangle == none || !is_flippable(side) || !is_better_flipped(side)) continue;
    const Piece &one = triangles_[at(side.triangle)], &two = triangles_[at(twin(side).triangle)];
    const Index a = one.v[side.k], b = one.v[next(side.k)], c = one.v[last(side.k)], d = two.v[last(twin(side).k)];
    flip(side);
    ++flips;
    for (const Pair rim : {Pair{a, c}, Pair{c, b}, Pair{b, d}, Pair{d, a}}) queue_.push_back(rim);
  }
  queue_.clear();
}

// Flips the sides that the line crosses until none is left (Sloan 1993).
bool TriangleDivision::join(Index from, Index to) {
  const auto fix = [&](Side side) { link(side, twin(side), true); };
  Side side = side_between(from, to);
  if (side.triangle != none) {
    fix(side);
    return true;
  }
  bool passes = false;
  side = first_crossed(from, to, passes);
  crossed_.clear();
  for (Poller poller; !passes;) {
    poller.due();
    const Piece& piece = triangles_[at(side.triangle)];
    if (piece.fixed[side.k]) return false;
    crossed_.push_back({piece.v[side.k], piece.v[next(side.k)]});
    const Side other = twin(side);
    const Index apex = triangles_[at(other.triangle)].v[last(other.k)];
    if (apex == to) break;
    const std::int64_t where = turn(from, to, apex);
    passes = where == 0;
    // the side from the apex to the corner on the other side of the line
    side = {other.triangle, where > 0 ? next(other.k) : last(other.k)};
  }
  if (passes) return false;
  queue_.clear();
  Poller poller;
  for (std::size_t head = 0; head < crossed_.size(); ++head) {
    poller.due();
    const Pair pair = crossed_[head];
    const Side here = side_between(pair.p, pair.q);
    if (!is_flippable(here)) {
      crossed_.push_back(pair);
      continue;
    }
    flip(here);
    const Index* const v = triangles_[at(here.triangle)].v;  // the new side runs from its last corner to the first
    const std::int64_t first = turn(from, to, v[2]), second = turn(from, to, v[0]);
    if (v[0] != from && v[0] != to && v[2] != from && v[2] != to && (first > 0) != (second > 0))
      crossed_.push_back({v[2], v[0]});
    else
      queue_.push_back({v[2], v[0]});
  }
  fix(side_between(from, to));
  make_delaunay();
  return true;
}

}  // namespace hf_inner::mesh

#include "mesh/exact_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/elementary.h"
#include "base/index.h"
#include "base/progress.h"

namespace hf_inner {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double pi = 3.14159265358979323846;
// Distances that differ by less than this share of the box diagonal count as equal. A window is dropped only where
// another path is shorter by more, so rounding cannot drop both of two equal paths.
constexpr double equal_distance = 1e-13;
// A ray that misses a corner by this share of the edge still reaches it.
constexpr double corner_rounding = 1e-12;
// Windows of less than this share of their edge are dropped.
constexpr double least_window = 1e-13;
// A vertex whose angles sum to more than 2 pi by this is a pseudo-source.
constexpr double saddle_rounding = 1e-11;
// The wedge behind a pseudo-source is wider by this angle on both sides.
constexpr double shadow_rounding = 1e-7;
// Width of a step of the queue in mean edges. Smaller steps sort better, larger ones touch fewer lists.
constexpr double queue_step = 0.25;
constexpr std::size_t queue_steps = 4096;
constexpr double least_step = 1e-6;  // in box diagonals, for meshes without lengths
// Reports of progress, each after this many vertices.
constexpr std::size_t report_every = 1024;

}  // namespace

TriangleSides::TriangleSides(const Mesh& given, const Topology& edges, Memory& memory)
    : mesh(given),
      topology(edges),
      edge(given.corners.size(), &memory),
      twin(given.corners.size(), border, &memory),
      frame(given.corners.size(), &memory),
      angle(given.positions.size(), 0.0, &memory) {
  for (Index e = 0; e < edges.edge_count(); ++e) {
    const Index first = edges.first(e), begin = edges.edge_triangle_start[at(e)],
                count = edges.edge_triangle_start[at(e) + 1] - begin;
    Index sides[2] = {-1, -1};
    for (Index i = 0; i < count; ++i) {
      const Index t = edges.edge_triangle[at(begin + i)];
      const Index* v = mesh.triangle(t);
      for (Index k = 0; k < 3; ++k) {
        const Index a = v[k], b = v[(k + 1) % 3];
        if (std::min(a, b) != first || std::max(a, b) != edges.second(e)) continue;
        edge[at(3 * t + k)] = e;
        if (count > 2) twin[at(3 * t + k)] = several;
        if (i < 2) sides[i] = 3 * t + k;
      }
    }
    if (count == 2) twin[at(sides[0])] = sides[1], twin[at(sides[1])] = sides[0];
    if (count != 2) angle[at(first)] = angle[at(edges.second(e))] = infinite;
    mean_length += norm(mesh.positions[at(first)] - mesh.positions[at(edges.second(e))]);
  }
  mean_length /= std::max(1, edges.edge_count());
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const Index* v = mesh.triangle(t);
    for (Index k = 0; k < 3; ++k) {
      const Vec3 a = mesh.positions[at(v[k])], ab = mesh.positions[at(v[(k + 1) % 3])] - a,
                 ac = mesh.positions[at(v[(k + 2) % 3])] - a;
      const double length = norm(ab), scale = length > 0 ? 1 / length : 0.0;
      const double x = scale * dot(ab, ac), y = scale * norm(cross(ab, ac));
      frame[at(3 * t + k)] = {length, x, y};
      angle[at(v[k])] += arc_tangent(y, x);
    }
  }
}

double TriangleSides::opposite_angle(Index side) const noexcept {
  const Frame& f = frame[at(side)];
  // the corner lies at (x, y), the ends of the side at 0 and length
  return arc_tangent(f.length * f.y, f.x * (f.x - f.length) + f.y * f.y);
}

Index TriangleSides::side_between(Index v, Index w) const noexcept {
  const Index e = topology.edge_between(v, w);
  const Index t = topology.edge_triangle[at(topology.edge_triangle_start[at(e)])];
  for (Index s = 3 * t; s < 3 * t + 2; ++s) {
    if (edge[at(s)] == e) return s;
  }
  return 3 * t + 2;
}

namespace {

struct Window {
  double begin, end;  // on the side it enters, from the side's start
  double x, y;        // the pseudo-source lies at (x, -y)
  double sigma;       // distance of the pseudo-source
  Index side;         // it enters the triangle of this side; for a vertex: -1 - vertex
  Index from;         // pseudo-source; -1: the source point
  Index after;        // in its list
};

class Propagation {
 public:
  Propagation(const TriangleSides& sides, Memory& memory)
      : sides_(sides),
        mesh_(sides.mesh),
        windows_(&memory),
        lists_(queue_steps + 1, Mesh::none, &memory),
        best_(sides.frame.size(), Best{infinite, 0}, &memory),
        result_(memory) {
    const std::size_t n = mesh_.positions.size();
    result_.distance.assign(n, infinite), result_.end.assign(n, PathEnd());
    step_ = queue_step * std::max(sides.mean_length, least_step);
  }

  ExactDistance run(Span<const Index> sources) {
    for (const Index s : sources) {
      result_.distance[at(s)] = 0, result_.end[at(s)].side = PathEnd::at_source;
      push_vertex(s);
    }
    while (live_ > 0) {
      Index i = lists_[step_now_];
      if (i == Mesh::none) {
        advance();
        continue;
      }
      lists_[step_now_] = windows_[at(i)].after;
      const Window w = windows_[at(i)];
      windows_[at(i)].after = free_, free_ = i, --live_;
      poller_.due();
      if (w.side < 0)
        visit_vertex(-1 - w.side, w.sigma);
      else
        cross_triangle(w);
    }
    return std::move(result_);
  }

 private:
  struct Best {
    double distance, crossing;
  };
  double distance(Index v) const noexcept { return result_.distance[at(v)]; }

  // The lists hold steps of the queue from base_. The last list holds what lies beyond.
  void advance() {
    if (++step_now_ < queue_steps) return;
    Index i = lists_[queue_steps];
    std::fill(lists_.begin(), lists_.end(), Mesh::none);
    base_ += step_ * queue_steps, step_now_ = 0;
    while (i != Mesh::none) {
      const Index after = windows_[at(i)].after;
      put(i, key(windows_[at(i)]));
      i = after;
    }
  }
  static double key(const Window& w) noexcept {
    if (w.side < 0) return w.sigma;
    const double x = std::min(std::max(w.x, w.begin), w.end) - w.x;
    return w.sigma + std::sqrt(x * x + w.y * w.y);
  }
  void put(Index i, double key) {
    const double place = (key - base_) / step_;
    const std::size_t step = place < static_cast<double>(queue_steps)
                                 ? std::max(step_now_, static_cast<std::size_t>(std::max(0.0, place)))
                                 : queue_steps;
    windows_[at(i)].after = lists_[step], lists_[step] = i;
  }
  void push(const Window& w, double key) {
    Index i = free_;
    if (i != Mesh::none) {
      free_ = windows_[at(i)].after, windows_[at(i)] = w;
    } else {
      i = static_cast<Index>(windows_.size());
      windows_.push_back(w);
    }
    put(i, key);
    ++live_, ++result_.window_count;
  }
  void push_vertex(Index v) {
    Window w{};
    w.side = -1 - v, w.sigma = distance(v);
    push(w, w.sigma);
  }

  void reach(Index v, double d, const PathEnd& end) {
    if (!(d < distance(v))) return;
    result_.distance[at(v)] = d, result_.end[at(v)] = end;
    push_vertex(v);
  }

  void visit_vertex(Index v, double d) {
    if (d != distance(v)) return;  // a shorter path was found later
    if (++visited_ % report_every == 0)
      report(std::min(1.0f, static_cast<float>(visited_) / static_cast<float>(mesh_.positions.size())));
    const Topology& topology = sides_.topology;
    for (Index i = topology.neighbour_start[at(v)]; i < topology.neighbour_start[at(v) + 1]; ++i) {
      const Index w = topology.neighbour[at(i)];
      reach(w, d + norm(mesh_.positions[at(w)] - mesh_.positions[at(v)]), {PathEnd::along_edge, v, 0, 0});
    }
    const PathEnd end = result_.end[at(v)];
    if (end.side == PathEnd::at_source || sides_.angle[at(v)] == infinite) {
      for_corners(v, [&](Index side) {
        const Index opposite = TriangleSides::next(side);
        const TriangleSides::Frame& f = sides_.frame[at(opposite)];
        emit(opposite, 0, f.length, f.x, f.y, d, v);
      });
    } else if (sides_.angle[at(v)] > 2 * pi + saddle_rounding) {
      shadow(v, d, end);
    }
  }

  // Calls visit(side) for every side that starts at the vertex.
  template <class Visit>
  void for_corners(Index v, Visit&& visit) {
    const Topology& topology = sides_.topology;
    for (Index i = topology.neighbour_start[at(v)]; i < topology.neighbour_start[at(v) + 1]; ++i) {
      const Index e = topology.neighbour_edge[at(i)];
      for (Index k = topology.edge_triangle_start[at(e)]; k < topology.edge_triangle_start[at(e) + 1]; ++k) {
        const Index t = topology.edge_triangle[at(k)];
        for (Index s = 3 * t; s < 3 * t + 3; ++s) {
          if (mesh_.corners[at(s)] == v && sides_.edge[at(s)] == e) visit(s);
        }
      }
    }
  }

  // Emits windows from a pseudo-source, in the directions at an angle of at least pi to both sides of the path to it.
  void shadow(Index v, double d, const PathEnd& end) {
    const double total = sides_.angle[at(v)];
    Index side = end.side;  // by which the walk around the vertex leaves a triangle
    double turned = 0;      // from the path to that side
    if (side == PathEnd::along_edge) {
      side = sides_.side_between(v, end.from);
    } else {
      const TriangleSides::Frame& f = sides_.frame[at(side)];
      // the angle at the corner between the pseudo-source and the end of side k + 1, which leads to the corner
      const double ax = f.length - f.x, ay = -f.y, bx = end.x - f.x, by = -end.y - f.y;
      turned = arc_tangent(std::fabs(ax * by - ay * bx), ax * bx + ay * by);
      side = TriangleSides::next(side);
    }
    const double first = pi - shadow_rounding, last = total - pi + shadow_rounding;
    while (turned < last) {
      const Index entry = sides_.twin[at(side)];
      if (entry < 0) return;  // never: the angles of such vertices are infinite
      const bool starts = mesh_.corners[at(entry)] == v;
      const Index leave = starts ? TriangleSides::last(entry) : TriangleSides::next(entry);
      const Index opposite = starts ? TriangleSides::next(entry) : TriangleSides::last(entry);
      const TriangleSides::Frame& f = sides_.frame[at(opposite)];
      // from the start of `opposite` if the walk comes from there
      const bool from_start = starts;
      const double px = from_start ? f.x : f.length - f.x;
      const double corner = sides_.opposite_angle(opposite);
      if (turned + corner > first) {
        const auto place = [&](double angle) {
          const double c = cosine(angle), s = sine(angle);
          const double dx = -px * c + f.y * s, down = f.y * c + px * s;  // direction (dx, -down)
          return down > 0 ? std::min(f.length, px + dx * f.y / down) : f.length;
        };
        const double begin = turned < first ? std::max(0.0, place(first - turned)) : 0.0;
        const double stop = turned + corner > last ? place(last - turned) : f.length;
        if (from_start)
          emit(opposite, begin, stop, f.x, f.y, d, v);
        else
          emit(opposite, f.length - stop, f.length - begin, f.x, f.y, d, v);
      }
      turned += corner, side = leave;
    }
  }

  // Calls visit(side) for every side of another triangle on the edge of this one.
  template <class Visit>
  void for_twins(Index side, Visit&& visit) const {
    const Index other = sides_.twin[at(side)];
    if (other >= 0) return visit(other);
    if (other == TriangleSides::border) return;
    const Topology& topology = sides_.topology;
    const Index e = sides_.edge[at(side)];
    for (Index i = topology.edge_triangle_start[at(e)]; i < topology.edge_triangle_start[at(e) + 1]; ++i) {
      const Index t = topology.edge_triangle[at(i)];
      for (Index s = 3 * t; s < 3 * t + 3; ++s) {
        if (sides_.edge[at(s)] == e && s != side) visit(s);
      }
    }
  }

  // A window leaves a triangle through a side. Coordinates are those of that side; (x, y) is the pseudo-source, on the
  // side of the triangle.
  void emit(Index side, double begin, double end, double x, double y, double sigma, Index from) {
    const double length = sides_.frame[at(side)].length;
    if (!(end - begin > least_window * length)) return;
    const Index start = mesh_.corners[at(side)];
    for_twins(side, [&](Index twin) {
      Window w{begin, end, x, y, sigma, twin, from, Mesh::none};
      if (mesh_.corners[at(twin)] != start) w.begin = length - end, w.end = length - begin, w.x = length - x;
      push(w, key(w));
    });
  }

  void cross_triangle(const Window& w) {
    const Index s = w.side, right = TriangleSides::next(s), left = TriangleSides::last(s);
    const TriangleSides::Frame& f = sides_.frame[at(s)];
    const Index v0 = mesh_.corners[at(s)], v1 = mesh_.corners[at(right)], c = mesh_.corners[at(left)];
    // The source at (x, -y) sees the corner through the side at `crossing`.
    const double straight = w.sigma + length_of(f.x - w.x, f.y + w.y);
    const double crossing = f.y + w.y > 0 ? w.x + (f.x - w.x) * w.y / (f.y + w.y) : w.x;
    // the vertices of the side may have shorter distances now than when the window was made
    if (distance(v0) + w.end < w.sigma + length_of(w.end - w.x, w.y) - equal_distance) return;
    if (distance(v1) + (f.length - w.begin) < w.sigma + length_of(w.begin - w.x, w.y) - equal_distance) return;
    const double rounding = corner_rounding * f.length;
    double left_end = std::min(w.end, crossing), right_begin = std::max(w.begin, crossing);
    Best& best = best_[at(s)];
    if (straight < best.distance) {
      if (crossing >= w.begin - rounding && crossing <= w.end + rounding) {
        best = {straight, crossing};
        reach(c, straight, {s, w.from, w.x, w.y});
      }
    } else {
      if (best.crossing < crossing)
        left_end = std::min(left_end, best.crossing);
      else
        right_begin = std::max(right_begin, best.crossing);
    }
    if (left_end > w.begin) child(w, f, left_end >= crossing, w.begin, left_end, left, v0, v1, c, false);
    if (w.end > right_begin)
      child(w, f, right_begin <= crossing, f.length - w.end, f.length - right_begin, right, v1, v0, c, true);
  }

  static double length_of(double x, double y) noexcept { return std::sqrt(x * x + y * y); }

  // The part of a window that crosses the edge from `near` to the corner c. Coordinates run from `near` along the side.
  void child(const Window& w, const TriangleSides::Frame& f, bool to_corner, double begin, double end, Index side,
             Index near, Index far, Index c, bool mirrored) {
    const double length = sides_.frame[at(side)].length;
    if (!(length > 0)) return;
    const double px = mirrored ? f.length - f.x : f.x, sx = mirrored ? f.length - w.x : w.x;
    const double ex = px / length, ey = f.y / length;
    const double h = ex * w.y + ey * sx;  // distance of the source from the edge
    if (!(h > 0)) return;
    const double a = ex * sx - ey * w.y;  // its foot, from `near`
    const auto meet = [&](double b) {
      const double below = w.y * ex - (b - sx) * ey;
      return below > 0 ? std::min(length, b * w.y / below) : length;
    };
    const double u0 = begin > 0 ? meet(begin) : 0.0, u1 = to_corner ? length : meet(end);
    if (!(u1 - u0 > least_window * length)) return;
    const double to_u0 = w.sigma + length_of(u0 - a, h), to_u1 = w.sigma + length_of(u1 - a, h);
    if (distance(near) + u1 < to_u1 - equal_distance) return;
    if (distance(c) + (length - u0) < to_u0 - equal_distance) return;
    const double fx = f.length - u0 * ex, fy = u0 * ey;
    if (distance(far) + length_of(fx, fy) < to_u0 - equal_distance) return;
    const bool from_near = mesh_.corners[at(side)] == near;
    if (from_near)
      emit(side, u0, u1, a, h, w.sigma, w.from);
    else
      emit(side, length - u1, length - u0, length - a, h, w.sigma, w.from);
  }

  const TriangleSides& sides_;
  const Mesh& mesh_;
  Vector<Window> windows_;
  Index free_ = Mesh::none;  // first of the records that no window uses
  Vector<Index> lists_;
  Vector<Best> best_;
  ExactDistance result_;
  double step_ = 1, base_ = 0;
  std::size_t step_now_ = 0, live_ = 0, visited_ = 0;
  Poller poller_;
};

}  // namespace

ExactDistance exact_distance(const TriangleSides& sides, Span<const Index> sources, Memory& memory) {
  return Propagation(sides, memory).run(sources);
}

}  // namespace hf_inner

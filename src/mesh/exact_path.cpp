#include "mesh/exact_path.h"

#include <algorithm>
#include <cmath>

#include "base/index.h"
#include "base/progress.h"
#include "mesh/edge_paths.h"

namespace hf_inner::mesh {
namespace {

// A pseudo-source is found where a corner lies within this share of the path from the place that unfolding gives. A
// smaller share loses paths to rounding, a larger one could take a wrong corner. Half and double pass the 81 tests of
// the mesh.
constexpr double place_rounding = 1e-7;
// A line that crosses more sides than this times the number of sides of the mesh goes in circles by rounding, and is
// lost. A straight line crosses each at most once, so more only costs time.
constexpr std::size_t most_rounds_of_line = 4;
// Guards a division: a line along a side is off it by 0 on both ends. With 0 the 81 tests of the mesh pass too.
constexpr double least_off_side = 1e-300;

class PathTracer {
 public:
  PathTracer(const TriangleSides& sides, const GeodesicPoint& from, const ExactDistance& found, SurfacePath& path)
      : sides_(sides), from_(from), found_(found), path_(path) {}

  // Appends the path from a vertex back to the source, without the vertex.
  void to_source(Index v) {
    for (std::size_t steps = 0; steps <= found_.end.size(); ++steps) {
      poll();
      const PathEnd& end = found_.end[at(v)];
      if (end.side == PathEnd::at_source) return;
      if (end.side == PathEnd::along_edge) {
        v = end.from;
      } else {
        const TriangleSides::Frame& f = sides_.frame[at(end.side)];
        if (!straight(end, f.x, f.y)) return by_edges(v);
        if (end.from < 0) return;
        v = end.from;
      }
      path_.points.push_back({v, v, 0});
    }
  }

  // Appends the places where the straight line from (x, y) in the frame of a side to the pseudo-source crosses edges.
  // Returns false if it loses the pseudo-source.
  bool straight(const PathEnd& end, double x, double y) {
    if (!(end.y > 0)) return true;  // inside this triangle
    const std::size_t before = path_.points.size();
    const double length = std::sqrt((x - end.x) * (x - end.x) + (y + end.y) * (y + end.y));
    const double share = y + end.y > 0 ? y / (y + end.y) : 0.0;
    if (leave({end.side, x + share * (end.x - x), end.x, end.y}, end.from, place_rounding * length)) return true;
    path_.points.resize(before);
    return false;
  }

 private:
  // A line leaves a triangle by a side at `at`, towards a place at (x, y) beyond the side, both in the side's frame.
  struct Line {
    Index side;
    double at, x, y;
  };

  bool leave(Line line, Index from, double rounding) {
    for (std::size_t steps = 0; steps < most_rounds_of_line * sides_.frame.size(); ++steps) {
      const double length = sides_.frame[hf_inner::at(line.side)].length;
      line.at = std::min(std::max(line.at, 0.0), length);
      const Index a = sides_.start(line.side), b = sides_.start(TriangleSides::next(line.side));
      path_.points.push_back({a, b, length > 0 ? line.at / length : 0.0});
      const Index twin = sides_.twin[hf_inner::at(line.side)];
      if (twin == TriangleSides::border) return false;
      if (twin == TriangleSides::several) return leave_by_several(line, from, rounding);
      const Step step = enter(line, twin, from, rounding);
      if (step != Step::on) return step == Step::found;
    }
    return false;
  }

  // More than one triangle lies beyond: the line is found in one of them.
  bool leave_by_several(const Line& line, Index from, double rounding) {
    const Index e = sides_.edge[at(line.side)];
    const Topology& topology = sides_.topology;
    const std::size_t before = path_.points.size();
    for (Index i = topology.edge_triangle_start[at(e)]; i < topology.edge_triangle_start[at(e) + 1]; ++i) {
      const Index t = topology.triangle(i);
      for (Index s = 3 * t; s < 3 * t + 3; ++s) {
        if (sides_.edge[at(s)] != e || s == line.side) continue;
        Line next = line;
        const Step step = enter(next, s, from, rounding);
        if (step == Step::found || (step == Step::on && leave(next, from, rounding))) return true;
        path_.points.resize(before);
      }
    }
    return false;
  }

  enum class Step { found, lost, on };

  // Carries the line through the triangle of a side, to the side by which it leaves.
  Step enter(Line& line, Index side, Index from, double rounding) const {
    const TriangleSides::Frame& f = sides_.frame[at(side)];
    if (sides_.start(side) != sides_.start(line.side)) {
      line.at = f.length - line.at;
      line.x = f.length - line.x;
    }
    const Index right = TriangleSides::next(side), left = TriangleSides::last(side);
    if (from >= 0) {
      const auto lies = [&](Index v, double x, double y) {
        return v == from && std::fabs(line.x - x) + std::fabs(line.y - y) <= rounding;
      };
      if (lies(sides_.start(left), f.x, f.y) || lies(sides_.start(side), 0, 0) ||
          lies(sides_.start(right), f.length, 0))
        return Step::found;
    } else {
      for (const GeodesicPoint::Place& place : from_.places) {
        if (place.triangle != side / 3) continue;
        const Index k = side % 3;
        const double next = place.weight[(k + 1) % 3], opposite = place.weight[(k + 2) % 3];
        if (std::fabs(line.x - next * f.length - opposite * f.x) + std::fabs(line.y - opposite * f.y) <= rounding)
          return Step::found;
      }
    }
    const double dx = line.x - line.at, dy = line.y, cx = f.x - line.at, cy = f.y;
    const bool to_left = dx * cy - dy * cx < 0;  // of the opposite corner
    const Index out = to_left ? left : right;
    // in the frame of the side by which the line leaves: from its start, along the unit vector (ux, uy)
    const double length = sides_.frame[at(out)].length;
    if (!(length > 0)) return Step::lost;
    const double ox = to_left ? f.x : f.length, oy = to_left ? f.y : 0.0;
    const double ux = ((to_left ? 0.0 : f.x) - ox) / length, uy = ((to_left ? 0.0 : f.y) - oy) / length;
    const double beyond = uy * (line.x - ox) - ux * (line.y - oy);  // the place lies this far to the right of the side
    const double behind = ux * (0 - oy) - uy * (line.at - ox);      // the line comes from this far to its left
    if (!(beyond > -rounding) || !(beyond + behind > 0)) return Step::lost;
    const double along_place = ux * (line.x - ox) + uy * (line.y - oy), along_entry = ux * (line.at - ox) - uy * oy;
    const double share = std::max(0.0, behind) / (std::max(0.0, behind) + std::max(0.0, beyond) + least_off_side);
    line = {out, along_entry + share * (along_place - along_entry), along_place, beyond};
    return Step::on;
  }

  // Follows edges, each time to the neighbour with the shortest way: the end of a path whose line got lost.
  void by_edges(Index v) {
    const Topology& topology = sides_.topology;
    for (std::size_t steps = 0; steps < found_.end.size() && found_.distance[at(v)] > 0; ++steps) {
      double best = 0;
      Index next = Mesh::none;
      for (Index i = topology.neighbour_start[at(v)]; i < topology.neighbour_start[at(v) + 1]; ++i) {
        const Index w = topology.neighbour[at(i)];
        const double way = found_.distance[at(w)] + norm(sides_.mesh.positions[at(w)] - sides_.mesh.positions[at(v)]);
        if (found_.distance[at(w)] < found_.distance[at(v)] && (next == Mesh::none || way < best)) {
          best = way;
          next = w;
        }
      }
      if (next == Mesh::none) return;
      path_.points.push_back({next, next, 0});
      v = next;
    }
  }

  const TriangleSides& sides_;
  const GeodesicPoint& from_;
  const ExactDistance& found_;
  SurfacePath& path_;
};

PathPoint end_point(const GeodesicPoint& point, const TriangleSides& sides) {
  if (point.vertex >= 0) return {point.vertex, point.vertex, 0};
  const GeodesicPoint::Place& place = point.places[0];
  for (Index k = 0; k < 3; ++k) {
    const Index s = 3 * place.triangle + k;
    if (place.weight[(k + 2) % 3] == 0)
      return {sides.start(s), sides.start(TriangleSides::next(s)), place.weight[(k + 1) % 3]};
  }
  return {Mesh::none, Mesh::none, 0};
}

PathPoint at_near_vertex(const PathPoint& point) noexcept {
  if (point.t <= place_tolerance) return {point.a, point.a, 0};
  if (point.t >= 1 - place_tolerance) return {point.b, point.b, 0};
  return point;
}

// Tells whether a point lies on the edge or at the vertex of another one.
bool lies_on(const PathPoint& point, const PathPoint& other) noexcept {
  const auto has = [&](Index v) { return v != Mesh::none && (v == other.a || v == other.b); };
  return has(point.a) && has(point.b);
}

// Moves crossings within rounding of a vertex to it. Takes out crossings of an edge that the point before or after lies
// on: a straight line meets an edge once, and crosses it again by rounding only. The neighbours of such a crossing
// share a triangle, so the path stays on the surface and gets no longer.
void take_out_rounding(SurfacePath& path) {
  const std::size_t last = path.points.size() - 1;
  std::size_t count = 1;
  for (std::size_t i = 1; i <= last; ++i) {
    const PathPoint point = i < last ? at_near_vertex(path.points[i]) : path.points[i];
    while (count > 1 && lies_on(point, path.points[count - 1])) --count;
    if (i == last || !lies_on(path.points[count - 1], point)) path.points[count++] = point;
  }
  const PathPoint &begin = path.points[0], &end = path.points[count - 1];
  const bool nowhere = count == 2 && path.length == 0 && begin.a == end.a && begin.b == end.b;
  path.points.resize(nowhere ? 1 : count);
}

// Returns the length of a path by edges from near one point to near another.
double length_by_edges(const TriangleSides& sides, const GeodesicPoint& from, const GeodesicPoint& to, Memory& memory) {
  Vector<Index> way(&memory);
  const auto corner = [&](const GeodesicPoint& point) {
    return point.vertex >= 0 ? point.vertex : sides.mesh.triangle(point.places[0].triangle)[0];
  };
  const auto to_corner = [&](const GeodesicPoint& point) {
    return norm(point.position(sides.mesh) - sides.mesh.positions[at(corner(point))]);
  };
  const double edges = EdgePaths(sides.mesh, sides.topology, memory).append(corner(from), corner(to), way);
  return to_corner(from) + edges + to_corner(to);
}

}  // namespace

Vec3 position_of(const Mesh& mesh, const PathPoint& point) noexcept {
  return mesh.to_given((1 - point.t) * mesh.positions[at(point.a)] + point.t * mesh.positions[at(point.b)]);
}

SurfacePath shortest_path(const TriangleSides& sides, const GeodesicPoint& from, const GeodesicPoint& to,
                          Memory& memory, double at_most) {
  ExactTask task;
  task.from = &from;
  task.to = &to;
  task.at_most = at_most > 0 ? at_most : length_by_edges(sides, from, to, memory);
  const ExactDistance found = exact_distance(sides, task, memory);
  SurfacePath path(memory);
  path.length = to.vertex >= 0 ? found.distance[at(to.vertex)] : found.to_distance;
  if (std::isinf(path.length)) path.length = -1;
  if (path.length < 0) return path;
  path.points.push_back(end_point(to, sides));
  PathTracer tracer(sides, from, found, path);
  if (to.vertex >= 0) {
    tracer.to_source(to.vertex);
  } else {
    const PathEnd& end = found.to_end;
    Index v = end.from;
    if (end.side >= 0) {
      const GeodesicPoint::Place& place = to.places[at(found.to_place)];
      const TriangleSides::Frame& f = sides.frame[at(end.side)];
      const Index k = end.side % 3;
      const double next = place.weight[(k + 1) % 3], opposite = place.weight[(k + 2) % 3];
      if (!tracer.straight(end, next * f.length + opposite * f.x, opposite * f.y)) v = sides.start(end.side);
    }
    if (v >= 0) {
      path.points.push_back({v, v, 0});
      tracer.to_source(v);
    }
  }
  if (from.vertex < 0) path.points.push_back(end_point(from, sides));
  std::reverse(path.points.begin(), path.points.end());
  take_out_rounding(path);
  return path;
}

}  // namespace hf_inner::mesh

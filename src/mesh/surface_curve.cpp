#include "mesh/surface_curve.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/index.h"
#include "base/progress.h"
#include "mesh/edge_paths.h"

namespace hf_inner::mesh {
namespace {

bool has(const Index* corners, Index v) noexcept { return corners[0] == v || corners[1] == v || corners[2] == v; }

Vec3 position_in(const Mesh& mesh, const CurvePoint& point) noexcept {
  Vec3 sum;
  for (int k = 0; k < 3; ++k) {
    if (point.weight[k] > 0) sum = sum + point.weight[k] * mesh.positions[at(point.corner[k])];
  }
  return sum;
}

// Returns the point with the weights that count as 0 taken out.
CurvePoint snapped(CurvePoint point) noexcept {
  double sum = 0;
  for (double& w : point.weight) sum += w = w > place_tolerance ? w : 0;
  for (double& w : point.weight) w /= sum;
  return point;
}

// The place of a point: a vertex, a place on an edge, or inside its triangle.
PathPoint place_of(const CurvePoint& point) noexcept {
  Index support[3], count = 0;
  for (Index k = 0; k < 3; ++k) {
    if (point.weight[k] > 0) support[count++] = k;
  }
  if (count == 3) return {Mesh::none, Mesh::none, 0};
  const Index a = point.corner[support[0]], b = point.corner[support[count - 1]];
  return {a, b, count == 1 ? 0 : point.weight[support[1]]};
}

// Builds a curve place by place, and finds the exact path between two points in the ellipsoid that holds it.
class CurveTracer {
 public:
  CurveTracer(const Mesh& mesh, const Topology& topology, Span<const CurvePoint> points, const CurveOptions& options,
              SurfaceCurve& curve, Memory& memory)
      : mesh_(mesh),
        topology_(topology),
        points_(points),
        options_(options),
        curve_(curve),
        memory_(memory),
        edges_(mesh_, topology_, memory),
        way_(&memory),
        local_(mesh.positions.size(), Mesh::none, &memory),
        taken_(at(mesh_.triangle_count()), 0, &memory),
        vertices_(&memory),
        triangles_(&memory) {}

  void trace() {
    const std::size_t count = points_.size();
    for (std::size_t i = 0; i < count; ++i) {
      point_ = static_cast<Index>(i);
      const CurvePoint from = snapped(points_[i]), to = snapped(points_[(i + 1) % count]);
      put(place_of(from));
      poll();
      if (!options_.closed && i + 1 == count) break;
      if (in_one_triangle(from, to)) continue;
      const ProgressRange range(static_cast<float>(i) / static_cast<float>(count),
                                static_cast<float>(i + 1) / static_cast<float>(count));
      const std::size_t before = curve_.place.size();
      if (exact(from, to) && holds_together(before - 1, to)) continue;
      // A path that rounding loses is replaced by the one along edges.
      curve_.place.resize(before);
      curve_.point_of.resize(before);
      for (const Index v : way_) put({v, v, 0});
    }
    while (options_.closed && curve_.place.size() > 1 && equal(curve_.place.front(), curve_.place.back())) {
      curve_.place.pop_back();
      curve_.point_of.pop_back();
    }
    const std::size_t size = curve_.place.size();
    for (std::size_t i = 0; size > 1 && i + !options_.closed < size; ++i)
      curve_.triangle.push_back(triangle_between(i, (i + 1) % size));
  }

 private:
  static bool equal(const PathPoint& p, const PathPoint& q) noexcept {
    if (p.a == Mesh::none || q.a == Mesh::none) return false;
    if (p.a == p.b || q.a == q.b) return p.a == q.a && p.b == q.b;
    return (p.a == q.a && p.b == q.b && std::fabs(p.t - q.t) <= place_tolerance) ||
           (p.a == q.b && p.b == q.a && std::fabs(p.t + q.t - 1) <= place_tolerance);
  }
  void put(const PathPoint& place) {
    if (!curve_.place.empty() && equal(curve_.place.back(), place)) {
      curve_.point_of.back() = point_;
    } else {
      if (curve_.place.size() == options_.most_places)
        fail(HF_ERROR_TOO_LARGE, static_cast<std::uint32_t>(point_),
             "the line has more than %zu points and crossings of edges after point %d; raise the limit, or cut less",
             options_.most_places, point_);
      curve_.place.push_back(place);
      curve_.point_of.push_back(point_);
    }
  }

  // Tells whether a triangle has both points.
  bool in_one_triangle(const CurvePoint& p, const CurvePoint& q) const {
    CurvePoint both = p;
    for (int k = 0, c = 0; k < 3; ++k) {
      if (q.weight[k] == 0 || (p.weight[0] > 0 && p.corner[0] == q.corner[k])) continue;
      if ((p.weight[1] > 0 && p.corner[1] == q.corner[k]) || (p.weight[2] > 0 && p.corner[2] == q.corner[k])) continue;
      while (c < 3 && both.weight[c] > 0) ++c;
      if (c == 3) return false;
      both.corner[c] = q.corner[k];
      both.weight[c] = 1;
    }
    return is_on_triangle(mesh_, topology_, both);
  }

  bool exact(const CurvePoint& from, const CurvePoint& to) {
    const Vec3 p = position_in(mesh_, from), q = position_in(mesh_, to);
    const Index first = nearest_corner(from), last = nearest_corner(to);
    way_.clear();
    const double length =
        norm(mesh_.positions[at(first)] - p) + edges_.append(first, last, way_) + norm(mesh_.positions[at(last)] - q);
    way_.push_back(last);
    gather(first, p, q, length);
    Mesh part(memory_);
    for (const Index v : vertices_) part.positions.push_back(mesh_.positions[at(v)]);
    for (const Index t : triangles_) {
      for (int k = 0; k < 3; ++k) part.corners.push_back(local_[at(mesh_.triangle(t)[k])]);
    }
    const bool found = path_in(part, from, to, length);
    for (const Index v : vertices_) local_[at(v)] = Mesh::none;
    for (const Index t : triangles_) taken_[at(t)] = 0;
    return found;
  }

  // Gathers the triangles around `first` that a path of this length from p to q can reach.
  void gather(Index first, Vec3 p, Vec3 q, double length) {
    vertices_.assign(1, first);
    local_[at(first)] = 0;
    triangles_.clear();
    Poller poller;
    for (std::size_t head = 0; head < vertices_.size(); ++head) {
      const Index v = vertices_[head];
      for (Index i = topology_.neighbour_start[at(v)]; i < topology_.neighbour_start[at(v) + 1]; ++i) {
        const Index e = topology_.neighbour_edge[at(i)];
        for (Index j = topology_.edge_triangle_start[at(e)]; j < topology_.edge_triangle_start[at(e) + 1]; ++j) {
          const Index t = topology_.triangle(j);
          poller.due();
          if (taken_[at(t)] || !reaches(t, p, q, length)) continue;
          taken_[at(t)] = 1;
          triangles_.push_back(t);
          for (int k = 0; k < 3; ++k) {
            Index& number = local_[at(mesh_.triangle(t)[k])];
            if (number == Mesh::none) {
              number = static_cast<Index>(vertices_.size());
              vertices_.push_back(mesh_.triangle(t)[k]);
            }
          }
        }
      }
    }
  }

  // A triangle that lies in a ball around its centroid outside the ellipsoid holds no place of the path.
  bool reaches(Index t, Vec3 p, Vec3 q, double length) const noexcept {
    const Index* v = mesh_.triangle(t);
    const Vec3 a = mesh_.positions[at(v[0])], b = mesh_.positions[at(v[1])], c = mesh_.positions[at(v[2])];
    const Vec3 centre = (1.0 / 3) * (a + b + c);
    const double radius = std::max(norm(a - centre), std::max(norm(b - centre), norm(c - centre)));
    return norm(centre - p) + norm(centre - q) - 2 * radius <= length * (1 + place_tolerance);
  }

  bool path_in(const Mesh& part, const CurvePoint& from, const CurvePoint& to, double length) {
    const Topology topology = Topology::make(part, memory_);
    const TriangleSides sides(part, topology, memory_);
    const auto here = [&](const CurvePoint& point) {
      Index corners[3];
      for (int k = 0; k < 3; ++k) corners[k] = point.weight[k] > 0 ? local_[at(point.corner[k])] : Mesh::none;
      return GeodesicPoint(sides, corners, point.weight, memory_);
    };
    const GeodesicPoint begin = here(from), end = here(to);
    if (!begin.found() || !end.found()) return false;
    const SurfacePath path = shortest_path(sides, begin, end, memory_, length);
    for (std::size_t i = 1; i + 1 < path.points.size(); ++i) {
      const PathPoint& point = path.points[i];
      put({vertices_[at(point.a)], vertices_[at(point.b)], point.t});
    }
    return !path.points.empty();
  }

  // Tells whether each two places in a row, from number `first` on, and the point after them share a triangle.
  bool holds_together(std::size_t first, const CurvePoint& next) {
    const PathPoint place = place_of(next);
    curve_.place.push_back(place);
    curve_.point_of.push_back((point_ + 1) % static_cast<Index>(points_.size()));
    bool holds = true;
    for (std::size_t i = first; i + 1 < curve_.place.size(); ++i) {
      holds = holds && (equal(curve_.place[i], curve_.place[i + 1]) || triangle_between(i, i + 1) != Mesh::none);
    }
    curve_.place.pop_back();
    curve_.point_of.pop_back();
    return holds;
  }

  // A triangle that has two places: the one of lowest number, so that a way back takes the same. None: Mesh::none.
  Index triangle_between(std::size_t i, std::size_t j) const {
    const PathPoint &p = curve_.place[i], &q = curve_.place[j];
    const auto holds = [&](Index t, std::size_t number) {
      const PathPoint& place = curve_.place[number];
      return place.a == Mesh::none ? inside(number) == t
                                   : has(mesh_.triangle(t), place.a) && has(mesh_.triangle(t), place.b);
    };
    if (p.a == Mesh::none || q.a == Mesh::none) {
      const Index t = inside(p.a == Mesh::none ? i : j);
      return holds(t, i) && holds(t, j) ? t : Mesh::none;
    }
    const Index e = p.a != p.b   ? topology_.edge_between(p.a, p.b)
                    : q.a != q.b ? topology_.edge_between(q.a, q.b)
                                 : topology_.edge_between(p.a, q.a);
    if (e == Mesh::none) return Mesh::none;
    for (Index k = topology_.edge_triangle_start[at(e)]; k < topology_.edge_triangle_start[at(e) + 1]; ++k) {
      const Index t = topology_.triangle(k);
      if (holds(t, i) && holds(t, j)) return t;
    }
    return Mesh::none;
  }

  // The triangle of a point inside one.
  Index inside(std::size_t place) const {
    return triangle_of(mesh_, topology_, points_[at(curve_.point_of[place])].corner);
  }

  const Mesh& mesh_;
  const Topology& topology_;
  Span<const CurvePoint> points_;
  const CurveOptions options_;
  SurfaceCurve& curve_;
  Memory& memory_;
  EdgePaths edges_;
  Vector<Index> way_;    // the path along edges between the present two points
  Vector<Index> local_;  // by vertex: its number in the present part
  Vector<std::uint8_t> taken_;
  Vector<Index> vertices_, triangles_;  // of the present part
  Index point_ = 0;
};

}  // namespace

Index triangle_of(const Mesh& mesh, const Topology& topology, const Index corners[3]) {
  const Index e = topology.edge_between(corners[0], corners[1]);
  if (e == Mesh::none) return Mesh::none;
  for (Index i = topology.edge_triangle_start[at(e)]; i < topology.edge_triangle_start[at(e) + 1]; ++i) {
    const Index t = topology.triangle(i);
    if (has(mesh.triangle(t), corners[2])) return t;
  }
  return Mesh::none;
}

bool is_on_triangle(const Mesh& mesh, const Topology& topology, const CurvePoint& point) {
  Index support[3] = {Mesh::none, Mesh::none, Mesh::none}, count = 0;
  for (int k = 0; k < 3; ++k) {
    if (point.weight[k] > 0) support[count++] = point.corner[k];
  }
  if (count == 2) return topology.edge_between(support[0], support[1]) != Mesh::none;
  return count == 1 || triangle_of(mesh, topology, support) != Mesh::none;
}

Index nearest_corner(const CurvePoint& point) noexcept {
  return point.corner[std::max_element(point.weight, point.weight + 3) - point.weight];
}

void require_one_component(const Mesh& mesh, Span<const CurvePoint> points) {
  const auto component = [&](const CurvePoint& point) { return mesh.component[at(nearest_corner(point))]; };
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (component(points[i]) != component(points[0]))
      fail(HF_ERROR_INVALID_ARGUMENT, i, "point %u of the curve is in another component than point 0", i);
  }
}

SurfaceCurve surface_curve(const Mesh& mesh, const Topology& topology, Span<const CurvePoint> points,
                           const CurveOptions& options, Memory& memory) {
  SurfaceCurve curve(memory);
  CurveTracer(mesh, topology, points, options, curve, memory).trace();
  return curve;
}

}  // namespace hf_inner::mesh

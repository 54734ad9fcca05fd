#include "mesh/cut_line.h"

#include <algorithm>

#include "base/error.h"
#include "base/index.h"

namespace hf_inner::mesh {
namespace {

// Moves a point near edges onto them: weights below the share become 0, except the largest one.
CurvePoint snapped(CurvePoint point, double share) noexcept {
  double sum = 0;
  const auto largest = std::max_element(point.weight, point.weight + 3) - point.weight;
  for (int k = 0; k < 3; ++k) {
    double& w = point.weight[k];
    if (k != largest && w < share) {
      w = 0;
      point.corner[k] = Mesh::none;
    }
    sum += w;
  }
  for (double& w : point.weight) w /= sum;
  return point;
}

std::int64_t steps(double weight) noexcept {
  const std::int64_t whole = static_cast<std::int64_t>(weight * static_cast<double>(GridPoint::grid) + 0.5);
  return std::min(std::max(whole, std::int64_t{1}), GridPoint::grid - 1);
}

// The place of a given point.
LinePoint line_point(const Mesh& mesh, const Topology& topology, const CurvePoint& point) {
  LinePoint out{};
  Index support[3], count = 0;
  for (Index k = 0; k < 3; ++k)
    if (point.weight[k] > 0) support[count++] = k;
  if (count == 1) {
    out.vertex = point.corner[support[0]];
  } else if (count == 2) {
    out.edge = topology.edge_between(point.corner[support[0]], point.corner[support[1]]);
    const bool forward = topology.second(out.edge) == point.corner[support[1]];
    out.in = {steps(point.weight[support[forward ? 1 : 0]]), 0};
  } else {
    out.triangle = triangle_of(mesh, topology, point.corner);
    std::int64_t weight[2];
    for (int k = 0; k < 2; ++k) {
      const Index v = mesh.triangle(out.triangle)[k];
      weight[k] = steps(point.weight[std::find(point.corner, point.corner + 2, v) - point.corner]);
    }
    out.in = {weight[0], weight[1]};
  }
  out.given = true;
  return out;
}

class LineMaker {
 public:
  LineMaker(const Mesh& mesh, const Topology& topology, Span<const CurvePoint> points, const SurfaceCurve& curve,
            double snap_share, CutLine& line)
      : mesh_(mesh), topology_(topology), points_(points), curve_(curve), share_(snap_share), line_(line) {}

  void make() {
    for (std::size_t i = 0; i < curve_.place.size(); ++i) put(point(i));
    Vector<LinePoint>& points = line_.points;
    while (line_.closed && points.size() > 1 && joins(points.back(), points.front())) points.pop_back();
  }

 private:
  LinePoint point(std::size_t i) const {
    const PathPoint& place = curve_.place[i];
    const Index segment = curve_.point_of[i];
    LinePoint out{};
    if (i == 0 || segment != curve_.point_of[i - 1]) {
      out = line_point(mesh_, topology_, points_[at(segment)]);
    } else if (place.a == place.b || place.t < share_ || place.t > 1 - share_) {
      out.vertex = place.a == place.b || place.t < share_ ? place.a : place.b;
    } else {
      out.edge = topology_.edge_between(place.a, place.b);
      const std::int64_t whole = steps(place.t);
      out.in = {place.a == topology_.first(out.edge) ? whole : GridPoint::grid - whole, 0};
    }
    out.segment = segment;
    return out;
  }

  // Tells whether a crossing lies on an edge that `other` lies on too. The points before and after it then share a
  // triangle, and the line needs no crossing there.
  bool is_beside(const LinePoint& point, const LinePoint& other) const noexcept {
    if (point.given || point.edge == Mesh::none) return false;
    return other.edge == point.edge || (other.vertex != Mesh::none && (topology_.first(point.edge) == other.vertex ||
                                                                       topology_.second(point.edge) == other.vertex));
  }
  // Tells whether a point need not follow another.
  bool joins(const LinePoint& point, const LinePoint& before) const noexcept {
    return is_same(point, before) || is_beside(point, before);
  }

  void put(const LinePoint& point) {
    Vector<LinePoint>& points = line_.points;
    while (points.size() > 1 && is_beside(points.back(), point)) points.pop_back();
    if (points.empty() || !joins(point, points.back())) {
      points.push_back(point);
    } else if (is_same(point, points.back())) {
      points.back().segment = point.segment;
      points.back().given |= point.given;
    }
  }

  const Mesh& mesh_;
  const Topology& topology_;
  Span<const CurvePoint> points_;
  const SurfaceCurve& curve_;
  const double share_;
  CutLine& line_;
};

}  // namespace

CutLine cut_line(const Mesh& mesh, const Topology& topology, Span<const CurvePoint> points, const CutOptions& options,
                 Memory& memory) {
  Vector<CurvePoint> near(&memory);
  for (const CurvePoint& point : points) near.push_back(snapped(point, options.snap_share));
  CutLine line(memory);
  line.closed =
      near.size() > 1 && is_same(line_point(mesh, topology, near.front()), line_point(mesh, topology, near.back()));
  if (line.closed) near.pop_back();
  CurveOptions how;
  how.closed = line.closed;
  how.most_places = options.most_points;
  const SurfaceCurve curve = surface_curve(mesh, topology, near, how, memory);
  LineMaker(mesh, topology, near, curve, options.snap_share, line).make();
  if (line.points.size() < 2)
    fail(HF_ERROR_EMPTY, HF_NO_INDEX, "the line has no length: all its points are one, within the snap share");
  return line;
}

}  // namespace hf_inner::mesh

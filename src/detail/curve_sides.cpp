#include "detail/curve_sides.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/index.h"
#include "base/progress.h"
#include "detail/constants.h"

namespace hf_inner::detail {
namespace {

constexpr Index unseen = -0x7fffffff;

// Returns the corner of a triangle that is neither of two others.
Index third(const Index* corners, Index a, Index b) noexcept {
  for (int k = 0; k < 2; ++k) {
    if (corners[k] != a && corners[k] != b) return corners[k];
  }
  return corners[2];
}

class CurveSides {
 public:
  CurveSides(const surface::Core& core, Span<const mesh::CurvePoint> points, const mesh::SurfaceCurve& curve,
             Memory& memory)
      : core_(core),
        mesh_(core.geometry->unlinked().mesh),
        topology_(core.geometry->unlinked().topology()),
        points_(points),
        curve_(curve),
        memory_(memory),
        on_(at(core.size()), 0, &memory),
        vertices_(&memory),
        sum_(at(topology_.edge_count()), 0, &memory),
        crossing_(&memory),
        winding_(at(core.size()), unseen, &memory) {
    for (const mesh::PathPoint& place : curve.place) {
      if (place.a == mesh::Mesh::none || place.a != place.b) continue;
      on_[at(place.a)] = 1;
      vertices_.push_back(place.a);
    }
  }

  Vector<Index> side(CurveSide side, Index seed) {
    check_visits();
    for (std::size_t i = 0; i < curve_.triangle.size(); ++i) pass(i);
    wind();
    check_seed_of(side, seed);
    double area[2] = {0, 0};
    const Vector<double> areas = mesh::vertex_areas(core_.mesh, memory_);
    bool any[2] = {false, false};
    for (Index v = 0; v < core_.size(); ++v) {
      if (!off(v)) continue;
      area[class_of(v)] += areas[at(v)];
      any[class_of(v)] = true;
    }
    if (any[0] && any[1] && oriented_) check_crossing(area[0] < area[1] ? 1 : 0);
    int chosen = area[0] < area[1] ? 1 : 0;
    if (!any[0] || !any[1]) {
      const bool whole = curve_.place.size() == vertices_.size() && along_borders(core_, vertices_, on_);
      if (!whole)
        fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
             "the curve goes round no vertex; give points that lie farther apart, or a finer mesh");
      chosen = any[0] ? 0 : 1;  // a curve along a border has only one side
    } else if (side == CurveSide::seed) {
      chosen = class_of(seed);
    } else if (side == CurveSide::smaller) {
      chosen = 1 - chosen;
    }
    Vector<std::uint8_t> in(at(core_.size()), 0, &memory_);
    for (Index v = 0; v < core_.size(); ++v) in[at(v)] = off(v) && class_of(v) == chosen;
    return with_pockets(in);
  }

 private:
  bool off(Index v) const noexcept { return winding_[at(v)] != unseen && !on_[at(v)]; }
  int class_of(Index v) const noexcept { return winding_[at(v)] & 1; }

  void check_seed_of(CurveSide side, Index seed) const {
    if (side == CurveSide::seed) check_seed(core_, seed, on_[at(seed)] != 0, winding_[at(seed)] == unseen);
  }

  // Bounds the walks around a vertex.
  void check_visits() {
    Vector<Index> sorted(vertices_, &memory_);
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = at(most_visits); i < sorted.size(); ++i) {
      if (sorted[i] != sorted[i - at(most_visits)]) continue;
      Index last = 0;
      for (std::size_t k = 0; k < curve_.place.size(); ++k) {
        if (curve_.place[k].a == sorted[i] && curve_.place[k].b == sorted[i]) last = curve_.point_of[k];
      }
      const Index given = mesh_.given_of_inner[at(sorted[i])];
      fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(last),
           "the curve passes vertex %d more than %d times, after point %d again; give points that do not lead back to "
           "it",
           given, most_visits, last);
    }
  }

  // Counts the edges that the curve crosses at a place: its edge, or the edges on one side of its vertex.
  void pass(std::size_t i) {
    const mesh::PathPoint& place = curve_.place[i];
    const Index from = curve_.triangle[i == 0 ? curve_.triangle.size() - 1 : i - 1], to = curve_.triangle[i];
    if (from == to || place.a == mesh::Mesh::none) return;
    if (place.a != place.b) return cross(topology_.edge_between(place.a, place.b), from, i);
    const Index* v = mesh_.triangle(from);
    for (int k = 0; k < 3; ++k) {
      if (v[k] != place.a && walk(place.a, from, to, v[k], i)) return;
    }
    const Index given = mesh_.given_of_inner[at(place.a)], point = curve_.point_of[i];
    fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(point),
         "the curve passes vertex %d after point %d, where the triangles are not one fan; lead it past the vertex, or "
         "along edges (HF_CURVE_EDGES)",
         given, point);
  }

  // Returns the triangle beyond an edge, or Mesh::none where it does not have two.
  Index beyond(Index e, Index triangle) const noexcept {
    const Index begin = topology_.edge_triangle_start[at(e)];
    if (topology_.edge_triangle_start[at(e) + 1] - begin != 2) return mesh::Mesh::none;
    const Index first = topology_.triangle(begin);
    return first == triangle ? topology_.triangle(begin + 1) : first;
  }

  // Walks around v from one triangle to another, first over the edge to w. Returns false, and counts nothing, if that
  // way does not lead there.
  bool walk(Index v, Index from, Index to, Index w, std::size_t place) {
    const std::size_t before = crossing_.size();
    for (Index t = from; t != to;) {
      const Index e = topology_.edge_between(v, w), next = beyond(e, t);
      if (next == mesh::Mesh::none || next == from) {
        for (; crossing_.size() > before; crossing_.pop_back())
          sum_[at(crossing_.back().edge)] -= crossing_.back().sign;
        return false;
      }
      cross(e, t, place);
      t = next;
      w = third(mesh_.triangle(t), v, w);
    }
    return true;
  }

  void cross(Index e, Index from, std::size_t place) {
    const Index* v = mesh_.triangle(from);
    Index sign = -1;
    for (int k = 0; k < 3; ++k) sign = v[k] == topology_.first(e) && v[(k + 1) % 3] == topology_.second(e) ? 1 : sign;
    sum_[at(e)] += sign;
    crossing_.push_back({e, sign, static_cast<Index>(place)});
  }

  // Finds the winding number of every vertex of the component.
  void wind() {
    Poller poller;
    Index start = mesh::Mesh::none;
    for (int k = 0; k < 3; ++k) start = points_[0].weight[k] > 0 ? points_[0].corner[k] : start;
    Vector<Index> queue(1, start, &memory_);
    winding_[at(start)] = 0;
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const Index v = queue[head];
      for (Index i = topology_.neighbour_start[at(v)]; i < topology_.neighbour_start[at(v) + 1]; ++i) {
        poller.due();
        const Index w = topology_.neighbour[at(i)], e = topology_.neighbour_edge[at(i)];
        const Index there = winding_[at(v)] + (topology_.first(e) == v ? sum_[at(e)] : -sum_[at(e)]);
        if (winding_[at(w)] == unseen) {
          winding_[at(w)] = there;
          queue.push_back(w);
        } else if (winding_[at(w)] != there) {
          oriented_ = false;
          if ((winding_[at(w)] ^ there) & 1)
            fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
                 "the curve does not separate the surface; add points so that the paths between them run where the "
                 "curve is to be, or lead it along edges (HF_CURVE_EDGES)");
        }
      }
    }
  }

  // larger: the class of the vertices on the larger side.
  void check_crossing(int larger) {
    Index low = 0, high = 0, usual = unseen;
    for (Index v = 0; v < core_.size(); ++v) {
      if (!off(v)) continue;
      if (usual == unseen) low = high = winding_[at(v)];
      low = std::min(low, winding_[at(v)]);
      high = std::max(high, winding_[at(v)]);
      if (usual == unseen || class_of(v) == larger) usual = winding_[at(v)];
    }
    if (high - low <= 1) return;
    const Index worst = high - usual >= usual - low ? high : low;
    const Index place = std::min(first_crossing(), first_visit_crossing());
    Index point = place < static_cast<Index>(curve_.place.size()) ? curve_.point_of[at(place)] : last_beside(worst);
    fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(point),
         "the curve crosses itself after point %d; give the points in the order in which they lie round the region",
         point);
  }

  struct Plane {
    double x, y;
  };
  static double left(Plane p, Plane q, Plane r) noexcept {
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  }
  // A place in the plane of a triangle, by the weights of its second and third corner.
  Plane in_plane(Index triangle, std::size_t place) const {
    const mesh::PathPoint& p = curve_.place[place];
    const Index* v = mesh_.triangle(triangle);
    double w[3] = {0, 0, 0};
    for (int k = 0; k < 3; ++k) {
      if (p.a == mesh::Mesh::none) {
        const mesh::CurvePoint& point = points_[at(curve_.point_of[place])];
        for (int c = 0; c < 3; ++c) w[k] += point.corner[c] == v[k] ? point.weight[c] : 0;
      } else {
        w[k] = p.a == v[k] ? 1 - p.t : p.b == v[k] ? p.t : 0;
      }
    }
    return {w[1], w[2]};
  }

  // Finds the first line that crosses an earlier one inside a triangle: the number of the place where it begins, or the
  // number of places.
  Index first_crossing() const {
    const Index size = static_cast<Index>(curve_.place.size());
    Vector<Index> lines(&memory_);
    for (Index i = 0; i < static_cast<Index>(curve_.triangle.size()); ++i) lines.push_back(i);
    std::sort(lines.begin(), lines.end(), [&](Index a, Index b) {
      return curve_.triangle[at(a)] != curve_.triangle[at(b)] ? curve_.triangle[at(a)] < curve_.triangle[at(b)] : a < b;
    });
    Index first = size;
    std::size_t compared = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      for (std::size_t j = i + 1; j < lines.size() && lines[j] < first; ++j) {
        if (curve_.triangle[at(lines[j])] != curve_.triangle[at(lines[i])] || ++compared > most_compared) break;
        if (lines_cross(at(lines[i]), at(lines[j]))) first = lines[j];
      }
    }
    return first;
  }
  bool lines_cross(std::size_t i, std::size_t j) const {
    const std::size_t size = curve_.place.size();
    return side_of(i, j) * side_of(i, (j + 1) % size) < 0 && side_of(j, i) * side_of(j, (i + 1) % size) < 0;
  }
  // Above 0 if a place in the triangle of a line lies to the left of it.
  double side_of(std::size_t line, std::size_t place) const {
    const Index t = curve_.triangle[line];
    const mesh::PathPoint &a = curve_.place[line], &b = curve_.place[(line + 1) % curve_.place.size()],
                          &p = curve_.place[place];
    const Plane from = in_plane(t, line), to = in_plane(t, (line + 1) % curve_.place.size());
    const bool along = a.a != mesh::Mesh::none && a.a == a.b && b.a == b.b && p.a != p.b &&
                       ((p.a == a.a && p.b == b.a) || (p.a == b.a && p.b == a.a));
    if (!along) return left(from, to, in_plane(t, place));
    // A line along an edge runs beside it in its triangle: places of the edge lie on the other side.
    const Index* v = mesh_.triangle(t);
    const Index far = third(v, a.a, b.a);
    return -left(from, to, {far == v[1] ? 1.0 : 0.0, far == v[2] ? 1.0 : 0.0});
  }

  // Finds the first visit of a vertex, or of a place on an edge, that crosses an earlier one.
  Index first_visit_crossing() const {
    const Index size = static_cast<Index>(curve_.place.size());
    Vector<Index> visits(&memory_);
    for (Index i = 0; i < size; ++i) {
      if (curve_.place[at(i)].a != mesh::Mesh::none) visits.push_back(i);
    }
    // The edge of a place, and the share of it from its lower vertex.
    const auto low = [&](Index i) { return std::min(curve_.place[at(i)].a, curve_.place[at(i)].b); };
    const auto high = [&](Index i) { return std::max(curve_.place[at(i)].a, curve_.place[at(i)].b); };
    const auto share = [&](Index i) {
      return curve_.place[at(i)].a == low(i) ? curve_.place[at(i)].t : 1 - curve_.place[at(i)].t;
    };
    std::sort(visits.begin(), visits.end(), [&](Index a, Index b) {
      return low(a) != low(b) ? low(a) < low(b) : high(a) != high(b) ? high(a) < high(b) : share(a) < share(b);
    });
    Index first = size;
    for (std::size_t i = 0; i < visits.size(); ++i) {
      for (std::size_t j = i + 1; j < visits.size() && j - i <= at(most_visits); ++j) {
        const Index a = std::min(visits[i], visits[j]), b = std::max(visits[i], visits[j]);
        if (low(a) != low(b) || high(a) != high(b) || std::fabs(share(a) - share(b)) > mesh::place_tolerance) break;
        if (b < first && (low(a) == high(a) ? visits_cross(a, b) : edge_visits_cross(a, b))) first = b;
      }
    }
    return first;
  }
  // At a place on an edge, do two lines change sides?
  bool edge_visits_cross(Index i, Index j) const {
    const std::size_t size = curve_.place.size();
    const auto before = [&](Index k) { return k == 0 ? size - 1 : at(k) - 1; };
    const auto after = [&](Index k) { return (at(k) + 1) % size; };
    const Index here = curve_.triangle[before(i)], there = curve_.triangle[at(i)];
    const bool same = curve_.triangle[before(j)] == here && curve_.triangle[at(j)] == there;
    const bool against = curve_.triangle[before(j)] == there && curve_.triangle[at(j)] == here;
    if (here == there || same == against) return false;
    const double begin =
        left(in_plane(here, at(i)), in_plane(here, before(i)), in_plane(here, same ? before(j) : after(j)));
    const double end =
        left(in_plane(there, at(i)), in_plane(there, after(i)), in_plane(there, same ? after(j) : before(j)));
    return begin * end > 0;
  }
  // Around the vertex of two visits, do their lines take turns?
  bool visits_cross(Index i, Index j) const {
    const std::size_t size = curve_.place.size();
    const auto before = [&](Index k) { return k == 0 ? size - 1 : at(k) - 1; };
    const Index v = curve_.place[at(i)].a;
    const Vector<Index> fan = fan_of(v, curve_.triangle[at(i)]);
    // The direction of a line from the vertex, counted in neighbours on the way round it.
    const auto turn = [&](std::size_t line, std::size_t end) {
      const mesh::PathPoint& place = curve_.place[end];
      Index p = place.a, q = place.b;
      double t = place.t;
      if (p == mesh::Mesh::none) {
        const Index* corners = mesh_.triangle(curve_.triangle[line]);
        p = corners[0] == v ? corners[1] : corners[0];
        q = third(corners, v, p);
        t = 0.5;
      }
      double begin = static_cast<double>(std::find(fan.begin(), fan.end(), p) - fan.begin());
      double past = static_cast<double>(std::find(fan.begin(), fan.end(), q) - fan.begin());
      if (std::fabs(past - begin) > 1.5) (past < begin ? past : begin) += static_cast<double>(fan.size());
      return begin + t * (past - begin);
    };
    const double begin = turn(before(i), before(i)), end = turn(at(i), (at(i) + 1) % size);
    const double a = turn(before(j), before(j)), b = turn(at(j), (at(j) + 1) % size);
    if (begin == end || a == b || a == begin || a == end || b == begin || b == end) return false;
    const auto between = [&](double t) { return (t > begin) != (t > end); };
    return between(a) != between(b);
  }
  // Returns the neighbours of v in order, in the fan that holds a triangle.
  Vector<Index> fan_of(Index v, Index triangle) const {
    Vector<Index> fan(&memory_), back(&memory_);
    const Index* corners = mesh_.triangle(triangle);
    const Index first = corners[0] == v ? corners[1] : corners[0];
    fan.push_back(first);
    for (Index t = triangle, w = first; t != mesh::Mesh::none;) {
      w = third(mesh_.triangle(t), v, w);
      if (w == first) return fan;
      fan.push_back(w);
      t = beyond(topology_.edge_between(v, w), t);
    }
    Index t = beyond(topology_.edge_between(v, first), triangle);  // the other way round, up to a border
    for (Index w = first; t != mesh::Mesh::none; t = beyond(topology_.edge_between(v, w), t)) {
      back.push_back(w = third(mesh_.triangle(t), v, w));
    }
    std::reverse(back.begin(), back.end());
    back.insert(back.end(), fan.begin(), fan.end());
    return back;
  }

  // Finds the last place where the curve passes a vertex of this winding number.
  Index last_beside(Index winding) const {
    Index place = 0;
    for (const Crossing& crossing : crossing_) {
      for (const Index v : {topology_.first(crossing.edge), topology_.second(crossing.edge)}) {
        if (off(v) && winding_[at(v)] == winding) place = std::max(place, crossing.place);
      }
    }
    return curve_.point_of[at(place)];
  }

  // Returns the region with the single vertices that it nearly surrounds.
  Vector<Index> with_pockets(Vector<std::uint8_t>& in) const {
    Vector<Index> joined(&memory_), inside(&memory_);
    const auto outside = [&](Index v, Index& last) {
      Index count = 0;
      for (Index i = topology_.neighbour_start[at(v)]; i < topology_.neighbour_start[at(v) + 1]; ++i) {
        const Index e = topology_.neighbour_edge[at(i)];
        // A border counts as the world outside.
        if (topology_.edge_triangle_start[at(e) + 1] - topology_.edge_triangle_start[at(e)] != 2) count += 2;
        if (!in[at(topology_.neighbour[at(i)])]) {
          ++count;
          last = topology_.neighbour[at(i)];
        }
      }
      return count;
    };
    for (Index v = 0; v < core_.size(); ++v) {
      Index beyond = mesh::Mesh::none, other = mesh::Mesh::none;
      if (!in[at(v)] && winding_[at(v)] != unseen && outside(v, beyond) == 1 && outside(beyond, other) > 1)
        joined.push_back(v);
    }
    for (const Index v : joined) in[at(v)] = 1;
    for (Index v = 0; v < core_.size(); ++v) {
      if (in[at(v)]) inside.push_back(v);
    }
    return inside;
  }

  struct Crossing {
    Index edge, sign, place;
  };
  const surface::Core& core_;
  const mesh::Mesh& mesh_;
  const mesh::Topology& topology_;
  Span<const mesh::CurvePoint> points_;
  const mesh::SurfaceCurve& curve_;
  Memory& memory_;
  Vector<std::uint8_t> on_;  // by vertex
  Vector<Index> vertices_;   // that the curve passes, in order
  Vector<Index> sum_;        // by edge
  Vector<Crossing> crossing_;
  Vector<Index> winding_;  // by vertex
  bool oriented_ = true;
};

}  // namespace

Vector<std::int32_t> surface_curve_side(const surface::Core& core, Span<const mesh::CurvePoint> points,
                                        const mesh::SurfaceCurve& curve, CurveSide side, std::int32_t seed,
                                        Memory& memory) {
  return CurveSides(core, points, curve, memory).side(side, seed);
}

}  // namespace hf_inner::detail

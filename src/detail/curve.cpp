#include "detail/curve.h"

#include <algorithm>

#include "base/error.h"
#include "base/index.h"

namespace hf_inner {
namespace {

constexpr Index none = -1, on_curve = -2;

// Finds shortest paths along edges (Dijkstra's algorithm). All paths share the same arrays.
class Paths {
 public:
  Paths(const Core& core, Memory& memory)
      : core_(core),
        before_(at(core.size()), none, &memory),
        done_(at(core.size()), 0, &memory),
        touched_(&memory),
        heap_(&memory) {}

  // Appends the vertices of the shortest path from `from` to `to`; `to` itself is left out.
  void append(Index from, Index to, Vector<Index>& out) {
    if (from == to) return;
    const Topology& topology = core_.geometry->unlinked().topology;
    const Vector<Vec3>& position = core_.mesh.positions;
    // The search runs backwards, so that `before` leads from the start to the end.
    heap_.assign(1, {0.0, to, none});
    while (true) {
      std::pop_heap(heap_.begin(), heap_.end());
      const Reached here = heap_.back();
      heap_.pop_back();
      if (done_[at(here.vertex)]) continue;
      done_[at(here.vertex)] = 1, before_[at(here.vertex)] = here.before, touched_.push_back(here.vertex);
      if (here.vertex == from) break;
      for (Index i = topology.neighbour_start[at(here.vertex)]; i < topology.neighbour_start[at(here.vertex) + 1];
           ++i) {
        const Index next = topology.neighbour[at(i)];
        if (done_[at(next)]) continue;
        heap_.push_back({here.distance + norm(position[at(next)] - position[at(here.vertex)]), next, here.vertex});
        std::push_heap(heap_.begin(), heap_.end());
      }
    }
    for (Index v = from; v != to; v = before_[at(v)]) out.push_back(v);
    for (const Index v : touched_) done_[at(v)] = 0;
    touched_.clear();
  }

 private:
  struct Reached {
    double distance;
    Index vertex, before;
    bool operator<(const Reached& o) const noexcept {  // the nearest on top of the heap
      return distance != o.distance ? distance > o.distance
             : vertex != o.vertex   ? vertex > o.vertex
                                    : before > o.before;
    }
  };
  const Core& core_;
  Vector<Index> before_;
  Vector<std::uint8_t> done_;
  Vector<Index> touched_;
  Vector<Reached> heap_;
};

// The edge-connected pieces that remain of one component when the curve's vertices are taken out.
struct Pieces {
  explicit Pieces(Memory& memory) : piece(&memory), area(&memory) {}
  Vector<Index> piece;  // number of the piece, by vertex; none in other components
  Vector<double> area;  // by piece
};

Pieces cut(const Core& core, Span<const Index> curve, Memory& memory) {
  const Topology& topology = core.geometry->unlinked().topology;
  Pieces pieces(memory);
  pieces.piece.assign(at(core.size()), none);
  for (const Index v : curve) pieces.piece[at(v)] = on_curve;
  const Vector<double> areas = vertex_areas(core.mesh, memory);
  const Vector<Index>& piece_of = core.geometry->unlinked().mesh.component;
  const Index component = piece_of[at(curve[0])];
  Vector<Index> queue(&memory);
  for (Index start = 0; start < core.size(); ++start) {
    if (pieces.piece[at(start)] != none || piece_of[at(start)] != component) continue;
    const Index number = static_cast<Index>(pieces.area.size());
    double area = 0;
    queue.clear(), queue.push_back(start), pieces.piece[at(start)] = number;
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const Index v = queue[head];
      area += areas[at(v)];
      for (Index i = topology.neighbour_start[at(v)]; i < topology.neighbour_start[at(v) + 1]; ++i) {
        const Index other = topology.neighbour[at(i)];
        if (pieces.piece[at(other)] != none) continue;
        pieces.piece[at(other)] = number, queue.push_back(other);
      }
    }
    pieces.area.push_back(area);
  }
  return pieces;
}

// Tells whether the curve consists of whole borders of the surface.
bool along_borders(const Core& core, Span<const Index> curve, const Pieces& pieces) {
  const Topology& topology = core.geometry->unlinked().topology;
  return std::all_of(curve.begin(), curve.end(), [&](Index v) {
    bool at_border = false;
    for (Index i = topology.neighbour_start[at(v)]; i < topology.neighbour_start[at(v) + 1]; ++i) {
      const std::size_t e = at(topology.neighbour_edge[at(i)]);
      if (topology.edge_triangle_start[e + 1] - topology.edge_triangle_start[e] != 1) continue;
      if (pieces.piece[at(topology.neighbour[at(i)])] != on_curve) return false;
      at_border = true;
    }
    return at_border;
  });
}

}  // namespace

std::int32_t nearest_corner(const Mesh& mesh, std::uint32_t triangle, const double* barycentrics,
                            std::uint32_t position) {
  return nearest_corner(place_in_triangle(mesh, triangle, barycentrics, position));
}

std::int32_t nearest_corner(const SurfacePlace& place) noexcept {
  return place.vertex[std::max_element(place.weight, place.weight + 3) - place.weight];
}

void require_one_component(const Mesh& mesh, Span<const std::int32_t> points) {
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (mesh.component[at(points[i])] != mesh.component[at(points[0])])
      fail(HF_ERROR_INVALID_ARGUMENT, i, "point %u of the curve is in another component than point 0", i);
  }
}

ClosedCurve closed_curve(const Core& core, Span<const std::int32_t> points, Memory& memory) {
  ClosedCurve curve(memory);
  Paths paths(core, memory);
  for (std::size_t i = 0; i < points.size(); ++i) {
    paths.append(points[i], points[(i + 1) % points.size()], curve.vertices);
    curve.point_of.resize(curve.vertices.size(), static_cast<Index>(i));
  }
  if (curve.vertices.empty()) curve.vertices.push_back(points[0]), curve.point_of.push_back(0);
  return curve;
}

Vector<std::int32_t> curve_side(const Core& core, Span<const std::int32_t> curve, CurveSide side, std::int32_t seed,
                                Memory& memory) {
  const Pieces pieces = cut(core, curve, memory);
  if (pieces.area.size() < (along_borders(core, curve, pieces) ? 1u : 2u))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "the curve does not separate the surface: its %zu vertices leave %zu piece%s; add points so that the paths "
         "between them run where the curve is to be",
         curve.size(), pieces.area.size(), pieces.area.size() == 1 ? "" : "s");
  Index chosen = static_cast<Index>(std::max_element(pieces.area.begin(), pieces.area.end()) - pieces.area.begin());
  if (side == CurveSide::seed) {
    chosen = pieces.piece[at(seed)];
    const Index given = core.mesh.given_of_inner[at(seed)];
    if (chosen == on_curve)
      fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(given), "seed vertex %d lies on the curve", given);
    if (chosen == none)
      fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(given),
           "seed vertex %d is in another component than the curve", given);
  }
  // A curve along a border has only one side.
  const bool others = side == CurveSide::smaller && pieces.area.size() > 1;
  Vector<Index> inside(&memory);
  for (Index v = 0; v < core.size(); ++v) {
    const Index piece = pieces.piece[at(v)];
    if (piece >= 0 && (piece == chosen) != others) inside.push_back(v);
  }
  return inside;
}

}  // namespace hf_inner

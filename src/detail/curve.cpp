#include "detail/curve.h"

#include <algorithm>

#include "base/error.h"
#include "base/index.h"
#include "mesh/edge_paths.h"

namespace hf_inner::detail {
namespace {

constexpr Index none = -1, on_curve = -2;

// The edge-connected pieces that remain of one component when the curve's vertices are taken out.
struct Pieces {
  explicit Pieces(Memory& memory) : piece(&memory), area(&memory) {}
  Vector<Index> piece;  // number of the piece, by vertex; none in other components
  Vector<double> area;  // by piece
};

Pieces cut(const surface::Core& core, Span<const Index> curve, Memory& memory) {
  const mesh::Topology& topology = core.geometry->unlinked().topology();
  Pieces pieces(memory);
  pieces.piece.assign(at(core.size()), none);
  for (const Index v : curve) pieces.piece[at(v)] = on_curve;
  const Vector<double> areas = mesh::vertex_areas(core.mesh, memory);
  const SharedVector<Index>& piece_of = core.geometry->unlinked().mesh.component;
  const Index component = piece_of[at(curve[0])];
  Vector<Index> queue(&memory);
  for (Index start = 0; start < core.size(); ++start) {
    if (pieces.piece[at(start)] != none || piece_of[at(start)] != component) continue;
    const Index number = static_cast<Index>(pieces.area.size());
    double area = 0;
    queue.clear();
    queue.push_back(start);
    pieces.piece[at(start)] = number;
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const Index v = queue[head];
      area += areas[at(v)];
      for (Index i = topology.neighbour_start[at(v)]; i < topology.neighbour_start[at(v) + 1]; ++i) {
        const Index other = topology.neighbour[at(i)];
        if (pieces.piece[at(other)] != none) continue;
        pieces.piece[at(other)] = number;
        queue.push_back(other);
      }
    }
    pieces.area.push_back(area);
  }
  return pieces;
}

}  // namespace

ClosedCurve closed_curve(const surface::Core& core, Span<const std::int32_t> points, Memory& memory) {
  ClosedCurve curve(memory);
  mesh::EdgePaths paths(core.mesh, core.geometry->unlinked().topology(), memory);
  for (std::size_t i = 0; i < points.size(); ++i) {
    paths.append(points[i], points[(i + 1) % points.size()], curve.vertices);
    curve.point_of.resize(curve.vertices.size(), static_cast<Index>(i));
  }
  if (curve.vertices.empty()) {
    curve.vertices.push_back(points[0]);
    curve.point_of.push_back(0);
  }
  return curve;
}

bool along_borders(const surface::Core& core, Span<const std::int32_t> curve, Span<const std::uint8_t> on) {
  const mesh::Topology& topology = core.geometry->unlinked().topology();
  return std::all_of(curve.begin(), curve.end(), [&](Index v) {
    bool at_border = false;
    for (Index i = topology.neighbour_start[at(v)]; i < topology.neighbour_start[at(v) + 1]; ++i) {
      const std::size_t e = at(topology.neighbour_edge[at(i)]);
      if (topology.edge_triangle_start[e + 1] - topology.edge_triangle_start[e] != 1) continue;
      if (!on[at(topology.neighbour[at(i)])]) return false;
      at_border = true;
    }
    return at_border;
  });
}

void check_seed(const surface::Core& core, std::int32_t seed, bool on, bool elsewhere) {
  const Index given = core.mesh.given_of_inner[at(seed)];
  if (on) fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(given), "seed vertex %d lies on the curve", given);
  if (elsewhere)
    fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(given),
         "seed vertex %d is in another component than the curve", given);
}

Vector<std::int32_t> curve_side(const surface::Core& core, Span<const std::int32_t> curve, CurveSide side,
                                std::int32_t seed, Memory& memory) {
  const Pieces pieces = cut(core, curve, memory);
  Vector<std::uint8_t> on(at(core.size()), 0, &memory);
  for (const Index v : curve) on[at(v)] = 1;
  if (pieces.area.size() < (along_borders(core, curve, on) ? 1u : 2u))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "the curve does not separate the surface: its %zu vertices leave %zu piece%s; add points so that the paths "
         "between them run where the curve is to be",
         curve.size(), pieces.area.size(), pieces.area.size() == 1 ? "" : "s");
  Index chosen = static_cast<Index>(std::max_element(pieces.area.begin(), pieces.area.end()) - pieces.area.begin());
  if (side == CurveSide::seed) {
    chosen = pieces.piece[at(seed)];
    check_seed(core, seed, chosen == on_curve, chosen == none);
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

}  // namespace hf_inner::detail

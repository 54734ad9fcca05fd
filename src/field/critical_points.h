// Finds the critical points of a piecewise linear field on a triangle mesh, with their index (Banchoff 1970).
//
// Vertices are ordered by (value, number), so no two are equal. The lower link of a vertex v is the part of the ring
// around v that is below v in this order. The index of v is 1 - chi(lower link), where chi is the number of vertices
// minus the number of edges. In the interior of a manifold, a minimum has index +1, because its lower link is empty. A
// maximum has +1, because its lower link is the whole ring. A regular vertex has 0 (one arc), and a saddle has -k (k +
// 1 arcs).
//
// Each vertex, edge and triangle is counted once, at its highest vertex. So the indices of a component sum to its Euler
// characteristic, also with borders and non-manifold edges. A maximum on a border has index 0. A saddle on a border can
// have a lower link of one arc; the part of the ring above the vertex then shows the saddle. Cost: one pass over edges
// and triangles.
#pragma once
#include "base/span.h"
#include "mesh/topology.h"

namespace hf_inner::field {

enum class CriticalKind : std::int32_t { minimum = 0, maximum = 1, saddle = 2 };

struct CriticalPoint {
  std::int32_t vertex;  // inner
  CriticalKind kind;
  std::int32_t index;
};

struct CriticalPoints {
  explicit CriticalPoints(Memory& memory) : points(&memory) {}
  Vector<CriticalPoint> points;  // by vertex
  std::uint32_t minima = 0, maxima = 0, saddles = 0;
  std::int32_t index_sum = 0;
  std::int32_t euler_characteristic = 0;  // of the part of the mesh that has values
};

// field: one value per welded vertex. NaN means no value; such a vertex and its edges and triangles are left out.
CriticalPoints find_critical_points(const mesh::Mesh& mesh, const mesh::Topology& topology, Span<const double> field,
                                    Memory& memory);

}  // namespace hf_inner::field

// Critical points of a piecewise linear field on a triangle mesh, with their index (Banchoff 1970).
//
// Vertices are totally ordered by (u, number), so that equal values are told apart. The lower link of v is the part of
// the ring around v below it; index(v) = 1 - chi(lower link), chi = its vertices minus its edges. Inside a manifold:
//     minimum +1 (empty), maximum +1 (the whole ring), regular 0 (one arc), saddle of k + 1 arcs -k.
//
// Each simplex is counted at its highest vertex. So the indices of a component sum to its Euler characteristic on any
// complex, with borders (a maximum on a border has index 0) and non-manifold edges. The upper link gives the index of
// -u, which finds saddles on borders whose lower link is one arc.
// Cost: one pass over edges and triangles.
#pragma once
#include "base/span.h"
#include "mesh/topology.h"

namespace hf_inner {

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

// field: one value per inner vertex; NaN = none: the vertex and what touches it is left out.
CriticalPoints find_critical_points(const Mesh& mesh, const Topology& topology, Span<const double> field,
                                    Memory& memory);

}  // namespace hf_inner

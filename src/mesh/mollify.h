// Edge lengths that close every triangle.
//
// For a >= b >= c: b + c - a >= mollify_closing a, where a counts as no less than mollify_floor of the mean edge.
// Triangles that do not close have their two shorter edges lengthened by half of the missing length each. Their
// neighbours may open by this, so it is repeated for all triangles at once. After the last round, one length added to
// every edge closes the rest (Sharp and Crane 2020, Section 4.5). The result does not depend on the numbering. Cost:
// O(n) a round; one round on a mesh without thin triangles.
#pragma once
#include "mesh/topology.h"

namespace hf_inner {

// Opening that closes a triangle, in longest edges: a flat one gets cotangents of 3,500.
constexpr double mollify_closing = 1e-8;
// Least longest edge, in mean edges, so that triangles of one point get a size.
constexpr double mollify_floor = 1e-3;

struct MollifiedLengths {
  explicit MollifiedLengths(Memory& memory) : length(&memory), edge_of_side(&memory), changed(&memory) {}
  static MollifiedLengths make(const Mesh& mesh, const Topology& topology, Memory& memory, JobRunner* jobs = nullptr);

  Vector<double> length;              // by edge
  Vector<std::int32_t> edge_of_side;  // 3 t + k: the edge from corner k of triangle t to the next
  Vector<std::uint8_t> changed;       // by edge; empty: none was
  std::uint32_t thin_count = 0;       // triangles that did not close
};

}  // namespace hf_inner

// Rings of nodes on the level loops of a flux field and the lines between them: the combinatorial quad mesh.
//
// Rings. Along every arc the mean distance between loops is s(c) = integral of L(c) / F dc (L the length of the loop, F
// the flux, since the mean slope on a loop is F / L). Rings stand edge_length apart in s, half as far from a saddle,
// 0.8 from a site, on the border itself at an apex. There is one at least on every arc.
//
// Nodes. A ring's nodes are where lines cross it. Lines come up from the ring below by the exact flux maps; at a source
// they start evenly in the flux. Rules that keep the mesh valid and even, in both kinds:
//   a ring has at least 4 nodes (6 beside a site), an even number of them; what is missing is put in, two at a time in
//   one gap, the odd one in the gap that faces the saddle;
//   a ring above a saddle has at least two lines from below: missing ones are traced down from it.
// Kind uniform adds pairs of nodes in gaps wider than `widest` and ends pairs of neighbouring lines where three gaps
// together are narrower than `narrowest` edge lengths. Because nodes come and go in pairs, every face has an even
// number of corners.
//
// A node: next and previous on its ring (higher values on the left), up and down along its line, -1 where it has none.
#pragma once
#include "base/progress.h"
#include "remesh/arcs.h"

namespace hf_inner {

struct RingOptions {
  double edge_length = 0;  // inner units
  bool uniform = false;
};

struct RingNode {
  std::int32_t ring = -1;
  FluxPoint point;
  double place = 0;  // along the ring, 0 to its length
  std::int32_t next = -1, previous = -1, up = -1, down = -1;
};

struct Ring {
  std::int32_t arc = -1, threshold = 0, seed = -1;
  double value = 0, length = 0;
  std::int32_t node = -1, count = 0;  // one of its nodes, and how many
  bool border = false;
};

// A point of the surface in a triangle: weights of its corners.
struct SurfacePoint {
  std::int32_t triangle = -1;
  double weight[3] = {0, 0, 0};
};

struct RingMesh {
  explicit RingMesh(Memory& memory) : rings(memory), nodes(memory), ring_start(memory), location(memory) {}
  Table<Ring> rings;  // of arc a: ring_start[a] .. ring_start[a + 1], from below
  Table<RingNode> nodes;
  Table<std::int32_t> ring_start;
  Table<SurfacePoint> location;  // of nodes
};

// lines_at: by vertex of the surface, how many lines start at a source (0: as many as the ring's length takes).
RingMesh make_rings(const FluxField& field, const ArcGraph& graph, const Table<double>& lines_at,
                    const RingOptions& options, Memory& memory, Progress* progress);

}  // namespace hf_inner

// Places rings of nodes on the level loops of a flux field, and lines between the rings: the combinatorial quad mesh.
//
// Rings. Along every arc the mean distance between loops is s(c) = integral of L(c) / F dc, where c is the field's
// value, L the length of the loop and F the flux. (The mean slope on a loop is F / L.) Rings are edge_length apart in
// s. They are ring_at_saddle from a saddle, ring_at_site from a site, and on the border itself at an apex. Every arc
// has at least one ring.
//
// Nodes. The nodes of a ring are the points where lines cross it. Lines come up from the ring below by the exact flux
// maps. At a source they start evenly spaced in the flux. Two rules keep the mesh valid and even, in both kinds:
// - A ring has an even number of nodes, 4 or more (6 beside a site). Missing nodes are added two at a time in one gap.
//   An odd one is added in the gap adjacent to the saddle.
// - A ring above a saddle has at least two lines from below. Missing lines are traced down from the ring.
//
// Kind uniform adds pairs of nodes in wide gaps (widest_gap_length). It ends pairs of neighbouring lines where three
// gaps together are narrow (narrowest_gaps_length). Nodes are added and removed in pairs, so every face has an even
// number of corners.
//
// A node has a next and a previous node on its ring, with higher values on the left. It has an up and a down node along
// its line. A missing node is -1.
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
  double place = 0;  // place along the ring, from 0 to its length
  std::int32_t next = -1, previous = -1, up = -1, down = -1;
};

struct Ring {
  std::int32_t arc = -1, threshold = 0, seed = -1;
  double value = 0, length = 0;
  std::int32_t node = -1, count = 0;  // one of its nodes, and the number of nodes
  bool border = false;
};

// A point of the surface in a triangle, with the barycentric weights of its corners.
struct SurfacePoint {
  std::int32_t triangle = -1;
  double weight[3] = {0, 0, 0};
};

struct RingMesh {
  explicit RingMesh(Memory& memory) : rings(memory), nodes(memory), ring_start(memory), location(memory) {}
  Table<Ring> rings;  // rings of nodes on arc a: ring_start[a] .. ring_start[a + 1], from below
  Table<RingNode> nodes;
  Table<std::int32_t> ring_start;
  Table<SurfacePoint> location;  // by node
};

// Makes the rings of nodes and the lines between them. lines_at: by vertex of the surface, the number of lines that
// start there if it is a source. If RingOptions::uniform is false, lines start only at sources, as many as lines_at
// says. If it is true, the length of the ring around a source sets the number.
RingMesh make_rings(const FluxField& field, const ArcGraph& graph, const Table<double>& lines_at,
                    const RingOptions& options, Memory& memory);

}  // namespace hf_inner

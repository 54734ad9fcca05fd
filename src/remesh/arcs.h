// The Reeb graph of a flux field: its level loops, grouped into arcs.
//
// Critical vertices are the sites and the saddles. Between two of them the loop of a level neither splits nor joins.
// All loops of one such family form an arc, which is an annulus on the surface. Every other (regular) vertex belongs to
// exactly one arc. If the surface is cut along the last loop of every arc below a critical vertex and the first loop of
// every arc above it, the piece around that vertex contains no other critical vertex. The piece is a disc at a site and
// a star of sectors at a saddle, on any genus. Rings on arcs therefore cut a surface into pieces of known topology.
//
// A loop is a threshold on ranks (vertices sorted by value): it crosses an edge if the tail's rank is below the
// threshold and the head's is not. So a loop exists between any two vertices, even if their values are equal.
//
// Cost: O(n log n) for n vertices, because every vertex passes through one heap once.
#pragma once
#include "remesh/flux_field.h"

namespace hf_inner {

struct Arc {
  std::int32_t lower = -1, upper = -1;  // critical vertices
  std::int32_t seed = -1;               // an uphill half-edge that crosses its first loop
  std::int32_t first = 0, last = 0;     // its regular vertices in ArcGraph::vertices, by rank
  double flux = 0;
};

// A closed level line of an arc: its threshold on ranks (vertices sorted by value), and a half-edge that it crosses.
struct Loop {
  std::int32_t threshold = 0, seed = -1;
};

struct ArcGraph {
  ArcGraph(const FluxField& field, Memory& memory);

  Table<std::int32_t> critical;              // critical vertices, by rank
  Table<Arc> arcs;                           // families of level loops, by rank of their lower ends
  Table<std::int32_t> vertices;              // the regular vertices, arc by arc
  Table<std::int32_t> up_start, up_arc;      // arcs that start at critical[i]: up_arc[up_start[i] .. up_start[i + 1])
  Table<std::int32_t> down_start, down_arc;  // arcs that end at critical[i], in the same way

  // Returns the level loop of an arc that has `below` of the arc's vertices below it.
  Loop loop(const FluxField& field, const Arc& arc, std::int32_t below) const;
};

// Lists the uphill half-edges that a level loop crosses, in order. Each step passes through the triangle to the right
// of the last half-edge. Higher values lie to the left of the walk.
void walk_loop(const FluxField& field, Loop loop, Table<std::int32_t>& out);

}  // namespace hf_inner

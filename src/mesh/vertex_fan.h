// Parts the triangles at one vertex along edges: cuts give the parts copies of the vertex.
#pragma once
#include "base/index.h"
#include "base/memory.h"
#include "base/span.h"

namespace hf_inner::mesh {

// A triangle at a vertex, with its next corners around it.
struct Wing {
  Index vertex, triangle, corner, next, last;
};

// A wing, by its position, of a part that takes a copy.
struct FanPart {
  Index part, wing;
  bool operator<(const FanPart& o) const noexcept { return part != o.part ? part < o.part : wing < o.wing; }
};

// Two neighbours that a cut runs between, the smaller one first.
struct CutEdge {
  Index first, second;
  bool operator<(const CutEdge& o) const noexcept { return first != o.first ? first < o.first : second < o.second; }
};

// Returns the wings that take copies of their vertex: by part, then by wing. Wings with a common edge that is not cut
// are one part. The lowest wing stands for its part, and the lowest part of an edge-connected fan keeps the vertex.
// wings: all at one vertex. cut: sorted.
Vector<FanPart> fan_parts(Span<const Wing> wings, Span<const CutEdge> cut, Memory& memory);

}  // namespace hf_inner::mesh

// The difference between the links of an edited surface and of the surface before all edits, as edges of the operator.
#pragma once
#include "base/index.h"
#include "base/memory.h"
#include "mesh/links.h"

namespace hf_inner::surface {

// One end of an edge whose weight differs. Between two pieces links are all there is, so an entry of weight 0 vanishes.
// Inside a piece the mesh may have an edge too.
struct LinkEnd {
  Index vertex, other;
  double before, after;  // the weights of all links of the edge
  bool crosses;          // between two pieces
};

struct LinkChange {
  explicit LinkChange(Memory& memory) : ends(&memory) {}
  // links: those before (null: none) and those after, of one mesh.
  static std::shared_ptr<const LinkChange> make(const mesh::Links* before, const mesh::Links& after,
                                                mesh::OperatorKind operator_kind, Memory& memory);
  // Returns the ends at a vertex, by ascending `other`.
  Span<const LinkEnd> at_vertex(Index v) const noexcept;
  Vector<LinkEnd> ends;  // by vertex and other; every edge has two
};

// Returns links without those at the positions `removed`, and with `added` ones. links: null for none. Light pieces and
// contacts stay. Throws std::bad_alloc.
std::shared_ptr<const mesh::Links> edited_links(const mesh::Mesh& mesh, const mesh::Links* links,
                                                Span<const std::uint8_t> removed, Span<const mesh::Link> added,
                                                Memory& memory);
// Whether two lists hold the same links in the same order.
bool same_links(const mesh::Links* a, const mesh::Links* b) noexcept;

}  // namespace hf_inner::surface

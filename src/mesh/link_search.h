// Finds links between the pieces of a mesh.
//
// A spanning tree over the pieces by smallest distance connects everything within reach. Pieces that touch link both
// ways, in the tree or not. Where two pieces link, up to links_a_side points of each side, spread over the contact, go
// to the nearest points of the other side's triangles. A light piece links at every vertex that is near a piece below.
// Cost: one search in a tree of boxes for every vertex near another piece's box.
#pragma once
#include "mesh/contact_search.h"

namespace hf_inner::mesh {

// More pieces than these are refused: every pair of boxes that are near costs a search. Half would refuse a tree of
// 20,000 loose leaves; double lets a mistake run longer. links_test reaches it with single triangles.
constexpr Index most_linked_pieces = 20000;

// contacts: of the same mesh and skin. Appends links to out.links and marks light pieces in out.light. out.piece: by
// vertex.
void search_links(const Mesh& mesh, Span<const double> areas, const LinkOptions& options, const ContactSearch& contacts,
                  Memory& memory, JobRunner* jobs, Links& out);

}  // namespace hf_inner::mesh

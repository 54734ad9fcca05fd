// Finds the vertices that touch a linked piece, and measures how far a deformation takes them off it.
//
// Links do not tell: their ends may slide along each other, and pieces may open between two links.
#pragma once
#include "mesh/contact_search.h"

namespace hf_inner::mesh {

// Lists all vertices that touch a piece linked to their own, in out.touching. With a skeleton it leaves out contacts of
// joints that are neither the same nor parent and child: a hand at rest on a hip. Cost: a search in a tree of boxes for
// every vertex near the other piece's box.
void find_touching(const ContactSearch& contacts, Memory& memory, JobRunner* jobs, Links& out);

// Copies the vertices that touch a piece still linked in `out`.
void keep_touching(const Links& from, const Mesh& mesh, Memory& memory, Links& out);

struct Opening {
  double worst = 0;           // in the unit of the caller's mesh
  Index vertex = Mesh::none;  // none: nothing opened
};

// Returns the widest opening. A vertex has opened by its distance from the piece that it touched, or by the distance of
// the point that it touched from its own piece if that is less, minus its distance at rest. So what slides opens
// nothing: the vertices that it uncovers are far from it, but it is near their piece. posed:
// positions by vertex as given, in the unit of the mesh. Throws HF_ERROR_NON_FINITE or HF_ERROR_TOO_LARGE (index:
// vertex as given). Cost: a search in a tree of boxes for vertices that left the point that they touched by more than
// the result.
Opening measure_opening(const Mesh& mesh, const Links& links, const ConstRows& posed, Memory& memory);

}  // namespace hf_inner::mesh

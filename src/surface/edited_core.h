// A surface whose stiffness, links or triangles were edited: its operator, and its factor beside the factor of the
// surface before.
//
// The stiffness s of a vertex is a number by which the host multiplies the weights of its edges: an edge ij counts
// 2 s_i s_j / (s_i + s_j) times. A stiff region has nearly constant fields, so poses move it as one. The operator stays
// a Laplacian: a field keeps to the range of its sites, and K of ones is 0.
//
// Links add edges and take edges away (link_change.h). They can join components and part them. Every component has one
// pinned vertex, whose diagonal is raised (core.h), so the pins change with the components. The factor needs all this
// as a change D of a few rows (edited_factor.h): ends of links, neighbours of stiffened vertices, and pins.
//
// Exchanged triangles change the rows around them (patch_rows.h). New vertices are new unknowns beside the factor, and
// vertices that went are cut off from the others (extended_factor.h). After patches over a large part of the surface
// the whole operator is made again.
#pragma once
#include "surface/core.h"

namespace hf_inner::surface {

// Multiplies the edges of a Laplacian by the stiffness of their ends, and sums the diagonals of changed rows again.
void stiffen(SymmetricMatrix& laplacian, const Vector<double>& stiffness, Memory& memory);

// Holds the stiffness, the links and the triangles of an edited surface.
struct SurfaceEdit {
  SurfaceEdit(std::shared_ptr<const Vector<double>> all = nullptr, std::shared_ptr<const Geometry> linked = nullptr)
      : stiffness(std::move(all)), geometry(std::move(linked)) {}
  std::shared_ptr<const Vector<double>> stiffness;  // by vertex of the geometry; null: 1 everywhere
  std::shared_ptr<const Geometry> geometry;         // with other links or triangles; null: those there are
};

// Returns a core with this stiffness, these links and triangles. A harmonic core shares the factor of `from`, or
// factorises again with the same ordering where sharing costs more than `most` times as much; tests raise it. Other
// kinds of field are made anew. Throws HF_ERROR_NOT_POSITIVE_DEFINITE, HF_ERROR_CANCELLED or std::bad_alloc.
std::shared_ptr<const Core> edit_core(std::shared_ptr<const Core> from, SurfaceEdit edit, double most = 1);

}  // namespace hf_inner::surface

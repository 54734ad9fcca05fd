// The difference between the factorised matrices of two cores of one family, as a change of a few rows
// (edited_factor.h).
#pragma once
#include "engine/core.h"
#include "engine/patch_rows.h"
#include "factor/edited_factor.h"

namespace hf_inner {

// The unknowns of a factor that two cores share (extended_factor.h): the vertices of `to`, then those of `from` that
// went.
struct Unknowns {
  // Whether the two number their vertices alike. Then the unknowns are the vertices.
  static bool are_same(const Core& from, const Core& to) noexcept {
    return from.mesh.given_of_inner.data() == to.mesh.given_of_inner.data();
  }
  Unknowns(const Core& from, const Core& to);
  VertexMap map;
  Vector<Index> of_before;   // by vertex of `from`
  Vector<Index> unknown_of;  // by unknown: the vertex of `from`, or from.size() + j for the j-th new vertex
  Vector<Index> fresh;       // the new vertices
  double scale = 1;          // s of extended_factor.h
};

// unknowns: null where the two number their vertices alike. The rows in which the matrices differ are listed, and which
// of them lie inside. A ground vertex and the end of an edited link count as the rim. Rows of vertices that went lose
// their entries to the others.
MatrixChange core_difference(const Core& from, const Core& to, const Unknowns* unknowns);

}  // namespace hf_inner

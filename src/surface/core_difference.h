// The difference between the factorised matrices of two cores of one family, as a change of a few rows
// (edited_factor.h).
#pragma once
#include "factor/edited_factor.h"
#include "surface/core.h"
#include "surface/patch_rows.h"

namespace hf_inner::surface {

// The unknowns of a factor that two cores share (extended_factor.h): the vertices of `to`, then the vertices of
// `from` that went.
struct Unknowns {
  // Whether the two number their vertices alike. Then the unknowns are the vertices.
  static bool are_same(const Core& from, const Core& to) noexcept { return from.mesh.shares(to.mesh); }
  Unknowns(const Core& from, const Core& to);
  // The unknown that a vertex of `from` is.
  Index of_before(Index u) const noexcept {
    const Index v = map.to(u);
    if (v != mesh::Mesh::none) return v;
    return map.after_count() +
           static_cast<Index>(std::lower_bound(map.went().begin(), map.went().end(), u) - map.went().begin());
  }
  // The vertex of `from` that an unknown is, or map.before_count() + j for the j-th new vertex.
  Index vertex_before(Index x) const noexcept {
    if (x >= map.after_count()) return map.went()[at(x - map.after_count())];
    const Index u = map.from(x);
    if (u != mesh::Mesh::none) return u;
    return map.before_count() +
           static_cast<Index>(std::lower_bound(map.fresh().begin(), map.fresh().end(), x) - map.fresh().begin());
  }
  Index count() const noexcept { return map.after_count() + static_cast<Index>(map.went().size()); }

  VertexMap map;
  double scale = 1;  // s of extended_factor.h
};

// unknowns: null where the two number their vertices alike. The rows in which the matrices differ are listed, and which
// of them lie inside. A ground vertex and the end of an edited link count as the rim. Rows of vertices that went lose
// their entries to the others.
factor::MatrixChange core_difference(const Core& from, const Core& to, const Unknowns* unknowns);

}  // namespace hf_inner::surface

// The first vertex of every piece of a mesh, and the sum and the number of its diagonals of K without stiffness.
// Components that edits join and part get their pinned vertex and their unit of it.
#pragma once
#include <cmath>

#include "base/index.h"
#include "base/memory.h"
#include "mesh/mesh.h"

namespace hf_inner::surface {

struct PieceDiagonals {
  explicit PieceDiagonals(Memory& memory) : first(&memory), sum(&memory), count(&memory) {}
  PieceDiagonals(const PieceDiagonals& other, Memory& memory)
      : first(other.first, &memory), sum(other.sum, &memory), count(other.count, &memory) {}
  // mesh: without links.
  template <class DiagonalOf>
  void sum_up(const mesh::Mesh& mesh, DiagonalOf&& diagonal_of) {
    first.assign(at(mesh.component_count()), mesh::Mesh::none);
    sum.assign(first.size(), 0.0);
    count.assign(first.size(), 0.0);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const std::size_t piece = at(mesh.component[at(v)]);
      if (first[piece] == mesh::Mesh::none) first[piece] = v;
      sum[piece] += std::fabs(diagonal_of(v));
      count[piece] += 1;
    }
  }
  Vector<Index> first;
  Vector<double> sum, count;
};

}  // namespace hf_inner::surface

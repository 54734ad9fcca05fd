// Sets of numbers that are united one by one (union-find with path halving). The lowest number stands for its set, so
// the result does not depend on the order of unions.
#pragma once
#include <numeric>

#include "base/index.h"
#include "base/memory.h"

namespace hf_inner::mesh {

struct UnionFind {
  explicit UnionFind(std::size_t count, Memory& memory) : parent(count, &memory) {
    std::iota(parent.begin(), parent.end(), 0);
  }
  Index find(Index v) noexcept {
    while (parent[at(v)] != v) v = parent[at(v)] = parent[at(parent[at(v)])];
    return v;
  }
  // Returns false if both are in one set already.
  bool unite(Index a, Index b) noexcept {
    a = find(a);
    b = find(b);
    if (a < b) parent[at(b)] = a;
    if (b < a) parent[at(a)] = b;
    return a != b;
  }
  Vector<Index> parent;
};

}  // namespace hf_inner::mesh

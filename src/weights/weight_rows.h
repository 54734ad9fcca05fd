// Weights of some vertices of a surface, as rows of bones and shares. A vertex without weights has an empty row.
#pragma once
#include "base/index.h"
#include "base/memory.h"
#include "mesh/mesh.h"
#include "weights/prune.h"

namespace hf_inner::weights {

struct WeightRows {
  explicit WeightRows(Memory& memory) : start(1, 0, &memory), shares(&memory) {}
  Span<const Share> of(Index v) const noexcept {
    return {shares.data() + start[at(v)], at(start[at(v) + 1] - start[at(v)])};
  }
  bool has(Index v) const noexcept { return start[at(v)] < start[at(v) + 1]; }
  std::size_t count() const noexcept { return start.size() - 1; }
  // Adds a share to the row of the next vertex. A bone named twice counts once, with both shares.
  void add(Index bone, double share) {
    for (std::size_t i = at(start.back()); i < shares.size(); ++i) {
      if (shares[i].bone == bone) {
        shares[i].weight += share;
        return;
      }
    }
    shares.push_back({bone, share});
  }
  // Ends the row, scaled to the sum 1. A row whose sum is not above 0 becomes empty.
  void close() {
    const std::size_t first = at(start.back());
    double sum = 0;
    for (std::size_t i = first; i < shares.size(); ++i) sum += shares[i].weight;
    if (!(sum > 0)) shares.resize(first);
    for (std::size_t i = first; i < shares.size(); ++i) shares[i].weight /= sum;
    start.push_back(static_cast<Index>(shares.size()));
  }
  Vector<Index> start;  // by vertex, one more
  Vector<Share> shares;
};

}  // namespace hf_inner::weights

// Turns the smooth weights of a vertex into the few that a renderer takes.
#pragma once
#include "base/index.h"
#include "base/memory.h"

namespace hf_inner::weights {

constexpr std::int32_t most_influences = 8;

struct Share {
  Index bone;
  double weight;
};

// Writes the `count` largest weights of a vertex, descending, with the sum of exactly 1. Unused places get the first
// bone and weight 0. small_drop: small weights are dropped first. locked: weights that do not change, in units of
// weight_units. The others share the rest. `shares` is scratch and has no locked bone.
void write_influences(Vector<Share>& shares, const Vector<Share>& locked, bool small_drop, std::int32_t count,
                      std::uint32_t* joints, float* weights);

}  // namespace hf_inner::weights

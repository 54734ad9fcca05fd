// A long call that reliability_cancel watches and cancels (cancel.cpp).
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "surfaces.h"

namespace reliability {

struct Case {
  std::string name;
  // Makes the call with that progress, destroys what it made, and returns the code.
  std::function<hf_result(hf_progress)> call;
  // Of all a caller can see of what the call was given; empty when the call is given no object.
  std::function<std::uint64_t()> state;
  // Makes what the call works on with that progress; empty when nothing depends on it.
  std::function<void(hf_progress)> prepare = {};
};

inline std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) {
  hash = (hash ^ word) * 0x9E3779B97F4A7C15ull;
  return hash ^ hash >> 29;
}

inline std::uint64_t memory_of(hf_surface surface) {
  hf_surface_statistics statistics = desc<hf_surface_statistics>();
  must(hf_surface_get_statistics(surface, &statistics), "hf_surface_get_statistics");
  return static_cast<std::uint64_t>(statistics.memory_bytes);
}

// Skin weights: made, for other bones, pinned on discs, carried and mirrored (cancel_weights.cpp).
void add_weights_cases(hf_surface surface, const Mesh& mesh, std::vector<Case>& cases);

}  // namespace reliability

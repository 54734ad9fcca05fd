// Plays bytes as one small mesh and calls that make shapes of it: quads, regions and detail, transfers, skin weights,
// links. Checks every result against what the headers promise. The same bytes give the same calls.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace shapes {

enum Kind { quads_call, region_call, transfer_call, weights_call, links_call, kind_count };

struct Outcome {
  bool passed = true;
  std::string failure;                         // one line
  std::array<unsigned, kind_count> calls{};    // by Kind
  std::array<unsigned, kind_count> results{};  // those that gave a result, and were not refused
};

// Faults of the library are in the outcome. Only failures of the harness itself throw (no memory).
Outcome play(const std::uint8_t* bytes, std::size_t size);

}  // namespace shapes

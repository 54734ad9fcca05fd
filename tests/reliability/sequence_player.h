// Bytes played as a sequence of API calls on one small surface, every code and every state compared with the model.
// The first bytes choose surface, operator, engine and channels; then one byte per call and the bytes it needs; absent
// bytes read as 0. Deterministic: the same bytes give the same calls.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace sequences {

struct Outcome {
  bool passed = true;
  std::string failure;               // one line: what was expected and what came
  std::array<double, 3> worst{};     // largest error over the scale of the values, by engine HF_ENGINE_*
  std::array<unsigned, 32> calls{};  // by kind of call
  std::array<unsigned, 2> edits{};   // that were refused, and that were done
};

// Never throws on what the library does; failures of the harness itself (no memory) propagate.
Outcome play(const std::uint8_t* bytes, std::size_t size);

// Limits on the error of a field over the scale of its values. The baseline takes no refinement step where points crowd
// in one triangle; the penalty engine is held against the penalty system itself, whose condition is 1e8 times worse.
constexpr double exact_tolerance = 1e-9, baseline_tolerance = 1e-7, penalty_tolerance = 1e-6;

}  // namespace sequences

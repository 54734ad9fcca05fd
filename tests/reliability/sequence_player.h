// Plays bytes as a sequence of API calls on one small surface, and compares every code and state with the model. The
// first bytes choose surface, operator, engine and channels. Then come one byte per call and the bytes of its
// arguments; missing bytes read as 0. The same bytes give the same calls.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace sequences {

constexpr std::size_t first_surface_call = 19;  // calls from this kind on use the surface itself

struct Outcome {
  bool passed = true;
  std::string failure;               // one line: the expected and the actual result
  std::array<double, 3> worst{};     // largest error over the scale of the values, by engine ENGINE_*
  std::array<unsigned, 32> calls{};  // by kind of call
  std::array<unsigned, 2> edits{};   // refused, and done
};

// Faults of the library are in the outcome. Only failures of the harness itself throw (no memory).
Outcome play(const std::uint8_t* bytes, std::size_t size);

// Limits on the error of a field over the scale of its values. ENGINE_REFACTOR does not refine where points crowd in
// one triangle. ENGINE_UPDOWN is compared with the penalty system, whose condition number is 1e8 times larger.
constexpr double exact_tolerance = 1e-9, baseline_tolerance = 1e-7, penalty_tolerance = 1e-6;

}  // namespace sequences

// The long forms of tests: with HF_FULL_TESTS in the environment, as tests/run --full sets it.
#pragma once
#include <cstdlib>
#include <vector>

namespace hf_test {

inline bool is_full() { return std::getenv("HF_FULL_TESTS") != nullptr; }

// The quick form takes the first cases. The long form takes the rest too.
template <class T>
std::vector<T> quick_and_full(std::vector<T> cases, const std::vector<T>& rest) {
  if (is_full()) cases.insert(cases.end(), rest.begin(), rest.end());
  return cases;
}

}  // namespace hf_test

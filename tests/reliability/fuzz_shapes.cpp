// libFuzzer's entry to calls that make shapes. Any bytes are a mesh and calls (shape_player.h).
#include <cstdio>
#include <cstdlib>

#include "shape_player.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const shapes::Outcome outcome = shapes::play(bytes, size);
  if (outcome.passed) return 0;
  std::fprintf(stderr, "%s\n", outcome.failure.c_str());
  std::abort();
}

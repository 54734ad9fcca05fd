// libFuzzer's entry to sequences of API calls. Any bytes are a sequence (sequence_player.h).
#include <cstdio>
#include <cstdlib>

#include "sequence_player.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const sequences::Outcome outcome = sequences::play(bytes, size);
  if (outcome.passed) return 0;
  std::fprintf(stderr, "%s\n", outcome.failure.c_str());
  std::abort();
}

// libFuzzer's entry to glTF: plays a file's bytes (gltf_player.h). Besides libFuzzer's mutations it uses those of
// gltf_mutate.h, which correct the lengths of a container. At the end it prints how many files gave a field.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "gltf_mutate.h"
#include "gltf_player.h"

namespace {

struct Tally {
  unsigned long solved = 0;
  ~Tally() { std::fprintf(stderr, "stat::number_of_solved_units: %lu\n", solved); }
} tally;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const hostile::Outcome outcome = hostile::play_gltf({bytes, bytes + size});
  tally.solved += outcome.solved;
  if (outcome.ending != hostile::Ending::wrong) return 0;
  std::fprintf(stderr, "%s\n", outcome.what.c_str());
  std::abort();
}

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* bytes, std::size_t size, std::size_t most);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* bytes, std::size_t size, std::size_t most, unsigned seed);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* bytes, std::size_t size, std::size_t most, unsigned seed) {
  if (seed % 4 == 0) return LLVMFuzzerMutate(bytes, size, most);
  static const std::vector<hostile::File> seeds = hostile::made_seeds();
  hostile::Random random(seed);
  const hostile::File& from = seeds[random() % seeds.size()];
  // inputs too short for a container, and one in eight others, start from a valid file
  const bool fresh = size < 20 || seed % 8 == 1;
  const hostile::File file = hostile::mutate(fresh ? from : hostile::File(bytes, bytes + size), from, random);
  const std::size_t kept = std::min(file.size(), most);
  if (kept > 0) std::memcpy(bytes, file.data(), kept);
  return kept;
}

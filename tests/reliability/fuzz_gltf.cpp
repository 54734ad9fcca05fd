// libFuzzer's entry to glTF: a file's bytes to mesh, solver and field (gltf_player.h). The library's own mutations are
// mixed in, so that the text of a container is changed with its lengths made right.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "gltf_mutate.h"
#include "gltf_player.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const hostile::Outcome outcome = hostile::play_gltf({bytes, bytes + size});
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
  const hostile::File file = hostile::mutate(size > 0 ? hostile::File(bytes, bytes + size) : from, from, random);
  const std::size_t kept = std::min(file.size(), most);
  if (kept > 0) std::memcpy(bytes, file.data(), kept);
  return kept;
}

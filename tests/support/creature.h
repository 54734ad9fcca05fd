// The creatures and the cactus of samples/assets for tests. One takes up to a second to make, so each is made once for
// all programs of tests: it is kept in a file of the build folder. A build of samples/assets removes the files.
#ifndef HF_TESTS_SUPPORT_CREATURE_H
#define HF_TESTS_SUPPORT_CREATURE_H

#include <cstdint>
#include <string>

#include "assets/creature.h"

namespace hf_test {

const samples::Creature& creature(const std::string& name, std::uint32_t vertices);
const samples::ShapeMesh& cactus(std::uint32_t vertices);
// Written as it is kept, and read again.
samples::Creature read_back(samples::Creature creature);

}  // namespace hf_test

#endif

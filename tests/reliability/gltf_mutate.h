// Damage done to files: bytes, lengths, the words of the JSON text with the container's lengths made right again, and
// the numbers of the binary chunk. Deterministic for one state of the generator.
#pragma once
#include <cstdint>
#include <random>
#include <vector>

namespace hostile {

using File = std::vector<std::uint8_t>;
using Random = std::mt19937_64;

// Small sound files of every kind the reader knows: skinned, animated, sparse, seams, islands, text, several nodes.
std::vector<File> made_seeds();
// Files below `most` bytes of the optional shared data; none without it.
std::vector<File> shared_seeds(std::size_t most);

// One to six changes. other: a second file to take words from.
File mutate(const File& file, const File& other, Random& random);

}  // namespace hostile

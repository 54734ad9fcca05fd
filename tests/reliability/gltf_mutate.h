// Damages files: bytes, lengths, words of the JSON text, and numbers of the binary chunk. After a change of the text
// the container's lengths are corrected. One state of the generator gives one result.
#pragma once
#include <cstdint>
#include <random>
#include <vector>

namespace hostile {

using File = std::vector<std::uint8_t>;
using Random = std::mt19937_64;

// Small valid files with every feature of the reader: skinned, animated, sparse, seams, islands, text, several nodes.
std::vector<File> made_seeds();
// Files below `most` bytes of the optional shared data; none without it.
std::vector<File> shared_seeds(std::size_t most);

// Makes one to six changes. other: a second file, whose words may be inserted.
File mutate(const File& file, const File& other, Random& random);

}  // namespace hostile

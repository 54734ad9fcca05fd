// Uses a file's bytes as a program would: reads, flattens, poses, solves, picks and writes. Every failure must be a
// sentence, every result finite.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hostile {

enum class Ending {
  used,     // read, and solved where it has a surface
  refused,  // by the reader, in a sentence
  wrong     // anything else; what: why
};

struct Outcome {
  Ending ending = Ending::used;
  bool solved = false;  // the library made a field
  std::string what;
};

Outcome play_gltf(const std::vector<std::uint8_t>& bytes);
Outcome play_file(const std::filesystem::path& file);  // .gltf, .glb, .obj, .off, .ply

// Seconds since the process started, of this thread's processor time.
double processor_seconds();
// Largest memory of the process so far, MiB.
double peak_memory();

}  // namespace hostile

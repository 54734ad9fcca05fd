// Reads .fbx, .dae and .bvh by way of assimp, where the build has it (HF_WITH_ASSIMP).
//
// assimp reads a scene. foreign_scene.cpp makes a model of it, and the writer makes a GLB of the model. The reader of
// glTF reads the GLB with all of its checks. Nodes, surfaces, skins, shape keys, clips and base colours survive.
// Lengths come out in metres and y points up, by the unit and the axes of the file.
//
// A file may be hostile, and assimp does not bound its memory and time. So assimp runs in a process of its own, with
// limits of both. Whatever happens there, the caller gets the GLB or an error.
#ifndef HF_GLTF_FOREIGN_FILE_H
#define HF_GLTF_FOREIGN_FILE_H

#include <cstdint>
#include <string>
#include <vector>

#include "gltf/file_kind.h"

namespace hf_gltf {

// Whether the kind is one of these and this build reads it.
bool reads_foreign(FileKind kind);

struct ForeignLimits {
  // Memory that the process may take: free_bytes, and bytes_per_byte for each byte of the file. assimp makes a token of
  // each number of a text; half would refuse large texts.
  uint64_t free_bytes = 1ull << 30, bytes_per_byte = 32;
  uint32_t seconds = 120;  // of processor time
  uint64_t max_glb_bytes = 128ull << 20;
};

// The bytes of a GLB. warnings: receives a sentence for each loss. Throws std::runtime_error that names `name`.
std::vector<uint8_t> foreign_glb(const std::vector<uint8_t>& bytes, FileKind kind, const std::string& name,
                                 std::vector<std::string>& warnings, const ForeignLimits& limits = {});

// The same in this process, for files that are trusted.
std::string foreign_glb_here(const std::vector<uint8_t>& bytes, FileKind kind, const std::string& name,
                             std::vector<std::string>& warnings);

}  // namespace hf_gltf

#endif

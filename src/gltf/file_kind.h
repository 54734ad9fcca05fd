// Finds the kind of a file by its first bytes. Only where they do not tell, the ending of its name decides.
#ifndef HF_GLTF_FILE_KIND_H
#define HF_GLTF_FILE_KIND_H

#include <cstdint>
#include <filesystem>
#include <string>

namespace hf_gltf {

enum class FileKind { unknown, gltf, obj, off, ply, stl, fbx, dae, bvh, usd, blend };

// bytes: the first `count` of a file of `size` bytes, 512 are enough. name: for the ending, in any case.
FileKind kind_of(const uint8_t* bytes, size_t count, uint64_t size, const std::string& name);
// The same for a file. FileKind::unknown for one that cannot be read.
FileKind kind_of_file(const std::filesystem::path& file);

// "glTF", "OBJ", ...
const char* name_of(FileKind kind);
// Whether the file is a model with nodes, which read_gltf() reads: glTF, and FBX, COLLADA and BVH where this build has
// assimp.
bool is_model(FileKind kind);
// The endings of models that this build reads: ".gltf, .glb and .vrm". word: "and" or "or".
std::string model_endings(const std::string& word);
// A clause for formats that this build does not read: how to get one that it reads. "" for the others.
std::string advice_on(FileKind kind);
// The message where `name` should be a model and is not: "a.obj is OBJ; a model is needed here ...".
std::string not_gltf(const std::string& name, FileKind kind);

}  // namespace hf_gltf

#endif

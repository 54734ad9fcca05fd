// glTF 2.0 out: .glb (one binary chunk) or .gltf (one text file with the buffer embedded), chosen by the extension. A
// .vrm is a .glb; only a model that was read with the extension VRM or VRMC_vrm is written as one.
//
// Written: scenes, node hierarchy, meshes with all attributes of the model, lines, points, vertex colours, skins,
// morph targets, animations, and the looks carried through. Image bytes are embedded. An image whose bytes were not
// read keeps its URI. Cameras, instances, attributes, channels, extras and extensions that were carried past the reader
// come back. Floats are written as floats, joints as bytes or shorts, indices as shorts or ints. The output has no
// errors under the Khronos validator; tests/unit/gltf checks that.
//
// The model is checked first (index ranges, array lengths, finite numbers, increasing key times): a fault is a
// std::runtime_error naming the element and the file is not touched. The file appears under its name only when
// complete.
#ifndef HF_GLTF_GLTF_WRITE_H
#define HF_GLTF_GLTF_WRITE_H

#include <filesystem>
#include <string>

#include "gltf/model.h"

namespace hf_gltf {

void write_gltf(const Model& model, const std::filesystem::path& file);

// Whether a model is written as .glb under this name. Throws std::runtime_error if the name is neither .glb, .gltf nor
// .vrm.
bool is_binary_name(const std::filesystem::path& file);

// The bytes of the file, binary or text.
std::string gltf_bytes(const Model& model, bool binary);

// Number of images that the file holds or names.
size_t image_count(const Model& model);

// Throws std::runtime_error naming the first element that cannot be written.
void check_model(const Model& model);

}  // namespace hf_gltf

#endif

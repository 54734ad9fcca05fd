// Inner header of gltf_read.cpp: everything that can be checked about a glTF file before tinygltf sees it.
//
// open_container() takes a file apart (GLB header and chunks, or plain text), bounds the JSON text and parses it.
// check_document() checks the tree: types, counts, every index, every byte range of buffer views and accessors (sparse
// ones too) in 64-bit arithmetic that cannot overflow because every operand is bounded first, the node graph (one
// parent, no cycle, bounded depth), required extensions. What is not used is removed, so that the text handed on holds
// nothing unchecked but the materials' own values.
//
// Cost: linear in the text. Failure: std::runtime_error naming file and element.
#ifndef HF_SAMPLES_COMMON_GLTF_CHECK_H
#define HF_SAMPLES_COMMON_GLTF_CHECK_H

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/gltf_read.h"

namespace samples {

struct GltfContainer {
  nlohmann::json document;
  bool has_binary_chunk = false;
  size_t binary_offset = 0, binary_size = 0;  // in the file's bytes
};

GltfContainer open_container(const std::vector<uint8_t>& bytes, const std::string& name, const ReadLimits& limits,
                             std::vector<std::string>& warnings);

void check_document(nlohmann::json& document, const std::string& name, const ReadLimits& limits,
                    std::vector<std::string>& warnings);

// Names of the extensions used inside the materials, textures and images of the document.
std::vector<std::string> look_extensions(const nlohmann::json& document);

}  // namespace samples

#endif

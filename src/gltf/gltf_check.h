// Inner header of gltf_read.cpp: everything that can be checked about a glTF file before tinygltf sees it.
//
// open_container() takes a file apart: a GLB header with chunks, or plain text. It bounds the JSON text and parses it.
// check_document() checks the tree:
// - types, counts and every index;
// - every byte range of buffer views and accessors, sparse ones too. All operands are bounded first, so the 64-bit
//   arithmetic cannot overflow;
// - the node graph: one parent, no cycle, bounded depth;
// - required extensions.
// Extras and extensions are taken out and carried past the parser. Unused entries are removed. So the text that is
// handed on holds nothing unchecked but the materials' own values. Compressed views and primitives are checked here
// (gltf_check_compressed.cpp) and decoded by gltf_decompress.cpp.
//
// Cost: linear in the text. Failure: std::runtime_error naming file and element.
#ifndef HF_GLTF_GLTF_CHECK_H
#define HF_GLTF_GLTF_CHECK_H

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gltf/gltf_carried.h"
#include "gltf/gltf_read.h"

namespace hf_gltf {

struct GltfContainer {
  nlohmann::json document;
  bool has_binary_chunk = false;
  size_t binary_offset = 0, binary_size = 0;  // in the file's bytes
};

GltfContainer open_container(const std::vector<uint8_t>& bytes, const std::string& name, const ReadLimits& limits,
                             std::vector<std::string>& warnings);

// carried: the parts that are written again without being read.
void check_document(nlohmann::json& document, const std::string& name, const ReadLimits& limits,
                    CarriedDocument& carried, std::vector<std::string>& warnings);

}  // namespace hf_gltf

#endif

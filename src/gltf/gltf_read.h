// Reads glTF 2.0 files, .gltf and .glb, that may be damaged or hostile.
//
// Each step checks the data that the next one trusts: 1. The size of the file. The header and chunks of a GLB. The
// depth and length of the JSON text. Then the JSON.
// 2. Every index, count, offset, stride and type in use, and the node graph (gltf_check.h).
// 3. The buffers. They are read only from below the file's own folder.
// 4. tinygltf gets the checked text and opens no file: its callbacks serve the bytes read before.
// 5. The values (gltf_accessor.h): indices, joints, weights, key times, NaN.
//
// Draco and meshopt compressed geometry is decoded between 3 and 4 (gltf_decompress.h), where the build has the
// libraries.
//
// It reads node hierarchies, triangles with strips and fans, lines, points, normals, tangents, texture coordinates and
// COLOR_0. It reads any number of sets of joints and weights and keeps the eight heaviest joints of a vertex. It reads
// morph targets, skins and animations, also from sparse accessors and with KHR_mesh_quantization. It carries through
// scenes, cameras, instances (EXT_mesh_gpu_instancing), other attributes, channels of KHR_animation_pointer, extras,
// and extensions that name no accessor. It mends skin weights. It skips clips, meshes and skins without elements, and
// keys before 0 s. It reports mended parts and parts that it does not keep. It refuses required extensions that it does
// not know, by name.
//
// The cost is linear in the size of the file. On failure it throws std::runtime_error with a sentence that names the
// file and the element, and keeps nothing.
#ifndef HF_GLTF_GLTF_READ_H
#define HF_GLTF_GLTF_READ_H

#include <cstdint>
#include <filesystem>

#include "gltf/model.h"

namespace hf_gltf {

// Limits that are checked before memory is allocated. The defaults keep the reader below 512 MB for any file.
struct ReadLimits {
  // Bytes of the file, and of each file that it names.
  uint64_t max_file_bytes = 128ull << 20;
  // Bytes of all buffers and images together.
  uint64_t max_total_bytes = 128ull << 20;
  // Bytes of the JSON text with its embedded buffers; brackets and commas in it; how deep brackets nest.
  uint64_t max_json_bytes = 48ull << 20;
  uint64_t max_json_values = 600000;
  uint32_t max_json_depth = 64;
  // How deep nodes nest.
  uint32_t max_node_depth = 1024;
  // Bytes of all accessors as floats. An accessor that is used twice counts twice.
  uint64_t max_decoded_bytes = 128ull << 20;
  // A file can use the same bytes again and again. So the decoded bytes may also not exceed free_decoded_bytes plus
  // decoded_per_byte for each byte of the file and its buffers. A byte that is used once decodes to 16 at most (strips
  // of 8-bit indices).
  uint64_t free_decoded_bytes = 16ull << 20, decoded_per_byte = 16;
  // Bytes of compressed geometry, decoded: at most free_decoded_bytes plus this for each byte of the file. A byte of a
  // constant column decodes to 64 bytes.
  uint64_t decompressed_per_byte = 64;
  // Bytes a decoder may use beside its output.
  uint64_t max_decompress_bytes = 128ull << 20;
  // Morph weights of all nodes together.
  uint64_t max_morph_weights = 1 << 20;
  // Entries of one list. Three bytes of text can ask for a node of 0.7 KB or a material of 3 KB. max_looks is for
  // materials, textures, images, samplers and scenes.
  uint64_t max_nodes = 1 << 17;
  uint64_t max_looks = 1 << 14;

  uint64_t decoded_limit(uint64_t stored_bytes) const {
    const uint64_t own = stored_bytes > max_decoded_bytes ? max_decoded_bytes : stored_bytes;
    const uint64_t shared = free_decoded_bytes + decoded_per_byte * own;
    return shared < max_decoded_bytes ? shared : max_decoded_bytes;
  }
};

Model read_gltf(const std::filesystem::path& file, const ReadLimits& limits = {});

// Reads a model from bytes in memory. Messages call it `name`. URIs are resolved below the folder of `location`; if it
// is empty, they are refused.
Model read_gltf_bytes(std::vector<uint8_t> bytes, const std::string& name, const std::filesystem::path& location = {},
                      const ReadLimits& limits = {});

}  // namespace hf_gltf

#endif

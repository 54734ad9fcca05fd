// glTF 2.0 in: .gltf and .glb, from friends and from enemies.
//
// Order of work: size of the file -> GLB header and chunks -> depth and value count of the JSON text -> JSON -> every
// index, count, offset, stride and type of the parts used, with the node graph (gltf_check.h) -> buffers, read only
// from below the file's own folder -> tinygltf -> the values themselves (gltf_accessor.h): indices, joints, weights,
// key times, NaN. tinygltf sees a text that is already checked and opens no file: its file callbacks serve our bytes,
// its image callback keeps the bytes as they are.
//
// Read: node hierarchies, TRS and matrices, triangles with strips and fans, normals, tangents, any number of texture
// coordinate sets, COLOR_0, JOINTS_n/WEIGHTS_n up to 8, morph targets, skins, animations (STEP, LINEAR, CUBICSPLINE),
// sparse accessors, KHR_mesh_quantization. Skipped with a warning: points, cameras, lights, extra scenes, animation of
// things that are not nodes. Refused with the name: required extensions that change the geometry's encoding and any
// that is not known here.
//
// Cost: linear in the file. Failure: std::runtime_error, one sentence that names file and element; nothing is kept.
#ifndef HF_SAMPLES_COMMON_GLTF_READ_H
#define HF_SAMPLES_COMMON_GLTF_READ_H

#include <cstdint>
#include <filesystem>

#include "common/model.h"

namespace samples {

// Checked before allocation. The defaults keep the reader below 512 MB whatever the file says.
struct ReadLimits {
  uint64_t max_file_bytes = 128ull << 20;     // the file, and every file it names, each
  uint64_t max_total_bytes = 128ull << 20;    // all buffers and images together
  uint64_t max_json_bytes = 48ull << 20;      // text, embedded buffers included
  uint64_t max_json_values = 600000;          // brackets and commas in the text
  uint32_t max_json_depth = 64;               // nesting of the text
  uint32_t max_node_depth = 1024;             // nesting of the hierarchy
  uint64_t max_decoded_bytes = 128ull << 20;  // all accessors as floats; an accessor used twice counts twice
  // What a file may ask for again and again (accessors and images on the same bytes, zeros, morph weights of many
  // nodes) is bounded by its own size too: the free bytes and so many for each byte of the file and its buffers. A byte
  // that is used once decodes to 16 at most (strips of u8 indices).
  uint64_t free_decoded_bytes = 16ull << 20, decoded_per_byte = 16;
  uint64_t max_morph_weights = 1 << 20;  // of all nodes together
  // Elements of one list: a material takes 3 KB in memory, a node 0.7 KB, and 3 bytes of text.
  uint64_t max_nodes = 1 << 17, max_looks = 1 << 14;  // looks: materials, textures, images, samplers, scenes

  uint64_t decoded_limit(uint64_t stored_bytes) const {
    const uint64_t own = stored_bytes > max_decoded_bytes ? max_decoded_bytes : stored_bytes;
    const uint64_t shared = free_decoded_bytes + decoded_per_byte * own;
    return shared < max_decoded_bytes ? shared : max_decoded_bytes;
  }
};

Model read_gltf(const std::filesystem::path& file, const ReadLimits& limits = {});

// The same from bytes in memory. name stands in for the file in messages; URIs are resolved below the folder of
// `location`, and refused when it is empty.
Model read_gltf_bytes(std::vector<uint8_t> bytes, const std::string& name, const std::filesystem::path& location = {},
                      const ReadLimits& limits = {});

}  // namespace samples

#endif

// Inner header of the glTF reader: compressed geometry, decoded by the libraries of its own formats.
//
// KHR_draco_mesh_compression needs Draco, EXT_meshopt_compression needs meshoptimizer. Both are optional in CMake. The
// reader checks every size in the JSON first. A Draco header must agree with the accessors of its primitive before the
// decoder runs, and the bytes of its attributes are bounded before they are allocated. Decoded bytes are charged like
// bytes of the file.
#ifndef HF_GLTF_GLTF_DECOMPRESS_H
#define HF_GLTF_GLTF_DECOMPRESS_H

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hf_gltf {

// A sentence that names the package, where this build cannot decode the extension; empty where it can.
std::string missing_decoder(const std::string& extension);

// The buffers of the reader, as decompress() uses them.
struct BufferStore {
  // Bytes of a buffer of the document, already loaded.
  std::function<const std::vector<uint8_t>&(size_t)> bytes_of;
  // Charges bytes that are about to be decoded.
  std::function<void(uint64_t, const std::string&)> charge;
  // Appends a buffer to the document and returns its number.
  std::function<size_t(std::vector<uint8_t>)> add;
  uint64_t memory_limit = 0;  // bytes a decoder may use beside its output
};

// Decodes every compressed view and primitive of a checked document. The views and accessors then name new buffers.
// Throws std::runtime_error: the element and the fault, without the name of the file.
void decompress(nlohmann::json& document, const BufferStore& store);

// ---- one stream each; the functions throw std::runtime_error with the end of a sentence ----

bool has_meshopt();
struct MeshoptView {
  size_t count = 0, stride = 0;
  std::string mode, filter;  // as the extension names them; checked
};
// out: count * stride bytes.
void decode_meshopt(const MeshoptView& view, const uint8_t* data, size_t size, std::vector<uint8_t>& out);

bool has_draco();
struct DracoAttribute {
  uint32_t id = 0;                   // in the stream
  int component_type = 0;            // of the accessor
  size_t components = 0, bytes = 0;  // bytes: of one component
  std::vector<uint8_t> data;         // out: the rows of the accessor
};
// The primitive's accessors ask for point_count rows and index_count indices of triangles; a strip has at most as many
// triangles. `indices` receives 32-bit indices.
void decode_draco(const uint8_t* data, size_t size, size_t point_count, size_t index_count, bool strip,
                  uint64_t memory_limit, std::vector<DracoAttribute>& attributes, std::vector<uint8_t>& indices);

}  // namespace hf_gltf

#endif

// open_container() of gltf_check.h.
#include <cstring>
#include <stdexcept>

#include "gltf/file_kind.h"
#include "gltf/gltf_check.h"
#include "gltf/json_file.h"

namespace hf_gltf {
namespace {

using nlohmann::json;

uint32_t read_u32(const std::vector<uint8_t>& bytes, size_t at) {
  return static_cast<uint32_t>(bytes[at]) | static_cast<uint32_t>(bytes[at + 1]) << 8 |
         static_cast<uint32_t>(bytes[at + 2]) << 16 | static_cast<uint32_t>(bytes[at + 3]) << 24;
}

}  // namespace

GltfContainer open_container(const std::vector<uint8_t>& bytes, const std::string& name, const ReadLimits& limits,
                             std::vector<std::string>& warnings) {
  const auto fail = [&](const std::string& message) { throw std::runtime_error(name + ": " + message + "."); };
  GltfContainer container;
  size_t text_offset = 0;
  uint64_t text_size = bytes.size();
  if (bytes.empty()) fail("the file is empty");
  if (bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0) {
    if (bytes.size() < 20) fail("the GLB header is cut off after " + std::to_string(bytes.size()) + " bytes");
    const uint32_t version = read_u32(bytes, 4);
    const uint64_t length = read_u32(bytes, 8);
    if (version != 2) fail("the GLB header says version " + std::to_string(version) + "; only 2 is read");
    if (length > bytes.size()) {
      fail("the GLB header says " + std::to_string(length) + " bytes, but the file has " +
           std::to_string(bytes.size()) + ": it is cut off or damaged");
    }
    if (length < bytes.size()) {
      if (length < 20) fail("the GLB header says " + std::to_string(length) + " bytes, less than the header itself");
      warnings.push_back(std::to_string(bytes.size() - length) + " bytes behind the end of the GLB are ignored");
    }
    uint64_t at = 12;
    for (int chunk = 0; at < length; ++chunk) {
      if (length - at < 8) fail("GLB chunk " + std::to_string(chunk) + " is cut off in its header");
      const uint64_t size = read_u32(bytes, static_cast<size_t>(at));
      const uint32_t type = read_u32(bytes, static_cast<size_t>(at) + 4);
      at += 8;
      if (size > length - at) {
        fail("GLB chunk " + std::to_string(chunk) + " says " + std::to_string(size) + " bytes where " +
             std::to_string(length - at) + " are left");
      }
      if (chunk == 0) {
        if (type != 0x4E4F534A) fail("the first GLB chunk is not the JSON chunk");
        text_offset = static_cast<size_t>(at);
        text_size = size;
      } else if (chunk == 1 && type == 0x004E4942) {
        container.has_binary_chunk = true;
        container.binary_offset = static_cast<size_t>(at);
        container.binary_size = static_cast<size_t>(size);
      }
      at += size;
    }
  } else if (bytes.size() >= 3 && std::memcmp(bytes.data(), "\xef\xbb\xbf", 3) == 0) {
    warnings.push_back("the byte order mark before the JSON is ignored");
    text_offset = 3;
    text_size -= 3;
  }
  const FileKind kind = kind_of(bytes.data(), bytes.size(), bytes.size(), name);
  if (kind != FileKind::gltf && kind != FileKind::unknown) throw std::runtime_error(not_gltf(name, kind));
  if (text_size > limits.max_json_bytes) {
    fail("the JSON has " + std::to_string(text_size) + " bytes, above the limit of " +
         std::to_string(limits.max_json_bytes));
  }
  container.document =
      parse_json(reinterpret_cast<const char*>(bytes.data()) + text_offset, static_cast<size_t>(text_size), name,
                 limits.max_json_depth, static_cast<size_t>(limits.max_json_values));
  return container;
}

}  // namespace hf_gltf

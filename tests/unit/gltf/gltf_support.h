// What the tests of samples/common share: glTF files made by hand in memory, temporary folders, the shared data.
#ifndef HF_TESTS_SAMPLES_GLTF_SUPPORT_H
#define HF_TESTS_SAMPLES_GLTF_SUPPORT_H

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gltf/gltf_read.h"

namespace samples_test {

using nlohmann::json;

// A document and one buffer, packed as .glb on demand. Numbers are written in the machine's (little endian) order.
struct GlbBuilder {
  json document = {{"asset", {{"version", "2.0"}}}};
  std::vector<uint8_t> binary;
  std::vector<json> extra_buffers;  // behind the binary chunk

  template <typename T>
  int view(const std::vector<T>& values, int stride = 0) {
    while (binary.size() % 4 != 0) binary.push_back(0);
    json o = {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", values.size() * sizeof(T)}};
    if (stride != 0) o["byteStride"] = stride;
    const auto* bytes = reinterpret_cast<const uint8_t*>(values.data());
    binary.insert(binary.end(), bytes, bytes + values.size() * sizeof(T));
    document["bufferViews"].push_back(o);
    return static_cast<int>(document["bufferViews"].size()) - 1;
  }

  int accessor(int view, size_t count, const char* type, int component, bool normalized = false) {
    json o = {{"count", count}, {"type", type}, {"componentType", component}};
    if (view >= 0) o["bufferView"] = view;
    if (normalized) o["normalized"] = true;
    document["accessors"].push_back(o);
    return static_cast<int>(document["accessors"].size()) - 1;
  }

  int floats(const std::vector<float>& values, const char* type) {
    const size_t width = std::strcmp(type, "SCALAR") == 0 ? 1
                         : std::strcmp(type, "MAT4") == 0 ? 16
                                                          : static_cast<size_t>(type[3] - '0');
    return accessor(view(values), values.size() / width, type, 5126);
  }

  // A mesh with one primitive on one node; returns the primitive.
  json& triangle_mesh(json attributes) {
    document["meshes"].push_back({{"primitives", {{{"attributes", std::move(attributes)}}}}});
    document["nodes"].push_back({{"mesh", document["meshes"].size() - 1}});
    return document["meshes"].back()["primitives"][0];
  }

  std::vector<uint8_t> glb() const {
    json o = document;
    std::vector<uint8_t> data = binary;
    if (!data.empty()) o["buffers"] = {{{"byteLength", data.size()}}};
    for (const json& buffer : extra_buffers) o["buffers"].push_back(buffer);
    while (data.size() % 4 != 0) data.push_back(0);
    std::string text = o.dump();
    while (text.size() % 4 != 0) text += ' ';
    std::vector<uint8_t> out;
    const auto u32 = [&](size_t value) {
      for (int i = 0; i < 4; ++i) out.push_back(static_cast<uint8_t>(value >> (8 * i)));
    };
    u32(0x46546C67);  // "glTF"
    u32(2);
    u32(12 + 8 + text.size() + (data.empty() ? 0 : 8 + data.size()));
    u32(text.size());
    u32(0x4E4F534A);
    out.insert(out.end(), text.begin(), text.end());
    if (!data.empty()) {
      u32(data.size());
      u32(0x004E4942);
      out.insert(out.end(), data.begin(), data.end());
    }
    return out;
  }

  hf_gltf::Model read() const { return hf_gltf::read_gltf_bytes(glb(), "test.glb"); }
};

inline const std::vector<float>& unit_triangle() {
  static const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  return positions;
}

// Message of the exception, or "" when there was none.
template <typename Function>
std::string message_of(Function function) {
  try {
    function();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

// Removed with everything in it at the end of the scope.
struct TemporaryFolder {
  std::filesystem::path path;
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "hf_samples_XXXXXX").string();
    if (!mkdtemp(name.data())) std::abort();
    path = name;
  }
  ~TemporaryFolder() {
    std::error_code error;
    std::filesystem::remove_all(path, error);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
};

inline void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

// Empty when the optional data is not there.
inline std::filesystem::path shared_data() {
  const char* given = std::getenv("HF_SHARED_DATA");
  const std::filesystem::path folder = given ? given : HF_SOURCE_DIR "/../shared/data";
  return std::filesystem::is_directory(folder) ? folder : std::filesystem::path();
}

// The glTF files of HF_GLTF_FOLDER and its folders: samples without errors of their own, such as Khronos'.
// None without it.
inline std::vector<std::filesystem::path> given_models() {
  std::vector<std::filesystem::path> out;
  const char* folder = std::getenv("HF_GLTF_FOLDER");
  if (!folder) return out;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const auto kind = entry.path().extension();
    if (kind == ".glb" || kind == ".gltf") out.push_back(entry.path());
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace samples_test

#define HF_NEED_SHARED_DATA() \
  if (samples_test::shared_data().empty()) GTEST_SKIP() << "the optional shared data is not there (HF_SHARED_DATA)"

#endif

// See file_kind.h.
#include "gltf/file_kind.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <string_view>

#include "gltf/foreign_file.h"

namespace hf_gltf {
namespace {

constexpr size_t head_bytes = 512;  // comments before the first element of a text are shorter
constexpr uint64_t stl_header = 84, stl_triangle = 50;

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool begins(std::string_view text, std::string_view with) { return text.substr(0, with.size()) == with; }

struct Ending {
  const char* text;
  FileKind kind;
};
constexpr Ending endings[] = {{".glb", FileKind::gltf}, {".gltf", FileKind::gltf}, {".vrm", FileKind::gltf},
                              {".obj", FileKind::obj},  {".off", FileKind::off},   {".ply", FileKind::ply},
                              {".stl", FileKind::stl},  {".fbx", FileKind::fbx},   {".dae", FileKind::dae},
                              {".bvh", FileKind::bvh},  {".usd", FileKind::usd},   {".usda", FileKind::usd},
                              {".usdc", FileKind::usd}, {".usdz", FileKind::usd},  {".blend", FileKind::blend}};

FileKind by_ending(const std::string& name) {
  std::string text = name.substr(std::min(name.rfind('.'), name.size()));
  std::transform(text.begin(), text.end(), text.begin(), lower);
  for (const Ending& ending : endings)
    if (text == ending.text) return ending.kind;
  return FileKind::unknown;
}

// Whether the length fits the number of triangles in the header.
bool is_binary_stl(const uint8_t* bytes, size_t count, uint64_t size) {
  if (count < stl_header) return false;
  const uint64_t triangles = static_cast<uint64_t>(bytes[80]) | static_cast<uint64_t>(bytes[81]) << 8 |
                             static_cast<uint64_t>(bytes[82]) << 16 | static_cast<uint64_t>(bytes[83]) << 24;
  return triangles > 0 && size == stl_header + stl_triangle * triangles;
}

// The first word of a line that is neither empty nor a comment.
std::string_view first_word(std::string_view text) {
  while (!text.empty()) {
    const size_t start = text.find_first_not_of(" \t\r\n");
    if (start == std::string_view::npos) return {};
    text.remove_prefix(start);
    if (text.front() != '#') return text.substr(0, text.find_first_of(" \t\r\n"));
    text.remove_prefix(std::min(text.find('\n'), text.size()));
  }
  return {};
}

FileKind by_bytes(const uint8_t* bytes, size_t count, uint64_t size) {
  std::string_view text(reinterpret_cast<const char*>(bytes), count);
  if (begins(text, "glTF")) return FileKind::gltf;
  if (begins(text, "Kaydara FBX Binary") || begins(text, "; FBX")) return FileKind::fbx;
  if (begins(text, "BLENDER")) return FileKind::blend;
  if (begins(text, "PXR-USDC") || begins(text, "#usda")) return FileKind::usd;
  if (is_binary_stl(bytes, count, size)) return FileKind::stl;
  if (begins(text, "\xef\xbb\xbf")) text.remove_prefix(3);
  if (text.find("<COLLADA") != std::string_view::npos) return FileKind::dae;
  const std::string_view word = first_word(text);
  if (begins(word, "{")) return FileKind::gltf;
  if (word == "ply") return FileKind::ply;
  if (word == "HIERARCHY") return FileKind::bvh;
  if (word == "solid" && text.find("facet") != std::string_view::npos) return FileKind::stl;
  for (const char* keyword : {"OFF", "COFF", "NOFF", "CNOFF", "STOFF"})
    if (word == keyword) return FileKind::off;
  for (const char* keyword : {"v", "vn", "vt", "mtllib", "usemtl", "o", "g"})
    if (word == keyword) return FileKind::obj;
  return FileKind::unknown;
}

}  // namespace

FileKind kind_of(const uint8_t* bytes, size_t count, uint64_t size, const std::string& name) {
  const FileKind kind = by_bytes(bytes, std::min(count, head_bytes), size);
  return kind != FileKind::unknown ? kind : by_ending(name);
}

FileKind kind_of_file(const std::filesystem::path& file) {
  uint8_t bytes[head_bytes];
  std::error_code error;
  const uint64_t size = std::filesystem::is_regular_file(file, error) ? std::filesystem::file_size(file, error) : 0;
  std::ifstream in(file, std::ios::binary);
  if (size == 0 || error || !in) return by_ending(file.string());
  in.read(reinterpret_cast<char*>(bytes), static_cast<std::streamsize>(sizeof bytes));
  return kind_of(bytes, static_cast<size_t>(in.gcount()), size, file.string());
}

const char* name_of(FileKind kind) {
  constexpr const char* names[] = {
      "of no known format", "glTF", "OBJ", "OFF", "PLY", "STL", "FBX", "COLLADA", "BVH", "USD", "a Blender file"};
  return names[static_cast<size_t>(kind)];
}

bool is_model(FileKind kind) { return kind == FileKind::gltf || reads_foreign(kind); }

std::string model_endings(const std::string& word) {
  return reads_foreign(FileKind::fbx) ? ".gltf, .glb, .vrm, .fbx, .dae " + word + " .bvh"
                                      : ".gltf, .glb " + word + " .vrm";
}

std::string advice_on(FileKind kind) {
  const std::string by_blender = "open it in Blender (File > Import) and export it as glTF 2.0 (.glb)";
  switch (kind) {
    case FileKind::fbx:
    case FileKind::dae:
    case FileKind::bvh:
      if (reads_foreign(kind)) return "";
      return std::string("this build has no reader of ") + name_of(kind) +
             "; build with HF_WITH_ASSIMP=ON (Debian: libassimp-dev), or " + by_blender;
    case FileKind::usd:
      return by_blender;
    case FileKind::blend:
      return "export it from Blender as glTF 2.0 (.glb)";
    default:
      return "";
  }
}

std::string not_gltf(const std::string& name, FileKind kind) {
  const std::string advice = advice_on(kind);
  return name + " is " + name_of(kind) + "; a model is needed here (" + model_endings("or") + ")" +
         (advice.empty() ? "" : ": " + advice);
}

}  // namespace hf_gltf

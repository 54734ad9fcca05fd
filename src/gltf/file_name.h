// Names of files in UTF-8. On Windows, std::filesystem::path takes a std::string for text in the user's code page, or
// each of its bytes for a letter. So every name that comes from a command line or a file becomes a path here.
#ifndef HF_GLTF_FILE_NAME_H
#define HF_GLTF_FILE_NAME_H

#include <filesystem>
#include <string>

namespace hf_gltf {

inline std::filesystem::path file_named(const std::string& utf8) {
#ifdef __cpp_char8_t
  return std::filesystem::path(std::u8string(utf8.begin(), utf8.end()));
#else
  return std::filesystem::u8path(utf8);
#endif
}

// The ending in lower case, such as ".glb".
inline std::string ending_of(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return ending;
}

}  // namespace hf_gltf

#endif

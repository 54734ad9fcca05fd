// Files as bytes, for readers that must not trust their input. Writing: file_write.h.
//
// Reading checks that the name is a regular file and its size against a limit before anything is allocated. Names that
// come out of another file (a buffer's URI) are resolved below that file's own folder and nowhere else.
#ifndef HF_GLTF_FILE_BYTES_H
#define HF_GLTF_FILE_BYTES_H

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hf_gltf {

// Throws std::runtime_error naming the file when it cannot be read or is larger than max_bytes.
std::vector<uint8_t> read_bytes(const std::filesystem::path& file, uint64_t max_bytes);

// The file a relative URI names, below the folder of `file`: percent-decoded, or as it stands where no such file is.
// Absolute names, schemes, backslashes, "..", control characters and symbolic links that lead out of the folder are
// refused. Returns an empty path and a sentence in `reason` when refused or when there is no such regular file.
std::filesystem::path resolve_below(const std::filesystem::path& file, const std::string& uri, std::string& reason);

// The bytes of "data:<type>;base64,<text>". False when it is not such a URI or the text is not base64.
bool decode_data_uri(const std::string& uri, std::vector<uint8_t>& bytes, std::string& mime_type);

// "image/png" and so on from the first bytes; empty when unknown.
std::string image_mime_type(const std::vector<uint8_t>& bytes);

// Where a text begins: behind the byte order mark of UTF-8, if it has one. Throws std::runtime_error naming `name` for
// UTF-16, with a mark or without.
size_t text_begin(std::string_view text, const std::string& name);

// Text out of an untrusted file made fit for a message: what is not printable ASCII becomes '?'.
std::string printable(std::string text);

}  // namespace hf_gltf

#endif

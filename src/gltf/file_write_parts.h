// Shared by the parts of file_write; not for callers.
#ifndef HF_GLTF_FILE_WRITE_PARTS_H
#define HF_GLTF_FILE_WRITE_PARTS_H

#include <filesystem>
#include <string>

namespace hf_gltf {

// Throws the error of write_bytes: the file as the caller named it, and the reason without a full stop.
[[noreturn]] void refuse_file(const std::filesystem::path& file, const std::string& reason);

std::filesystem::path folder_of(const std::filesystem::path& file);

// A name for the new file: short, so that it fits where the target's name fits.
std::string random_name();

// Where `file` leads: through symbolic links to a name that is none; nothing need be there yet.
std::filesystem::path follow_links(const std::filesystem::path& file);

// Refuses a link that the system itself would not follow.
void check_link(const std::filesystem::path& file, const std::filesystem::path& link);

}  // namespace hf_gltf

#endif

// Writes a file whole or not at all; every program of samples writes through it.
//
// The bytes go to a new file with a random name in the folder of the target, which then takes the target's place. A
// reader sees the old bytes or the new ones. After an error or a full disk the old file stands as it was and the new
// one is removed. After a signal that ends the program too, if the program asked for it (remove_unfinished_on_signals).
//
// Symbolic links are followed to their target, which is created when it is not there. The permissions of a replaced
// file are kept, and owner and group where the system allows; the bits setuid and setgid are dropped. Only the given
// name of a file with several hard links changes. Device nodes, pipes and this process' own descriptors (/dev/stdout)
// are written through, from their present position. File and folder are synced before the call returns.
#ifndef HF_GLTF_FILE_WRITE_H
#define HF_GLTF_FILE_WRITE_H

#include <cstddef>
#include <filesystem>
#include <string>

namespace hf_gltf {

// Throws std::runtime_error that names the file and the reason. Thread-safe; threads write one after the other.
void write_bytes(const std::filesystem::path& file, const void* data, size_t size);
inline void write_bytes(const std::filesystem::path& file, const std::string& text) {
  write_bytes(file, text.data(), text.size());
}

// For programs, once at their start: a signal that ends the program while it writes removes the new file first. The
// handlers stand while a file is written. A library may not change the signals of its host, so hf_gltf_model_save alone
// changes none.
void remove_unfinished_on_signals();

}  // namespace hf_gltf

#endif

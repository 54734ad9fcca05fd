// See file_write.h. Names and links, the same on every system.
#include "gltf/file_write.h"

#include <random>
#include <stdexcept>

#include "gltf/file_write_parts.h"

namespace hf_gltf {
namespace fs = std::filesystem;
namespace {

// Links followed in a row: as many as Linux follows. Fewer refuse names that a plain open takes.
constexpr int max_links = 40;

}  // namespace

void refuse_file(const fs::path& file, const std::string& reason) {
  throw std::runtime_error(file.string() + ": cannot be written: " + reason + ".");
}

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

std::string random_name() {
  constexpr char digits[] = "0123456789abcdefghijklmnopqrstuvwxyz";
  constexpr size_t length = 16;  // 36^16 names: a stranger cannot guess one, two writers do not meet
  std::random_device source;
  std::uniform_int_distribution<size_t> digit(0, sizeof digits - 2);
  std::string name = ".hf-";
  for (size_t i = 0; i < length; ++i) name += digits[digit(source)];
  return name;
}

fs::path follow_links(const fs::path& file) {
  fs::path at = file;
  for (int i = 0; i <= max_links; ++i) {
    if (at.filename().empty()) refuse_file(file, "the name ends with a folder; add the name of a file");
    std::error_code error;
    const fs::file_status status = fs::symlink_status(at, error);
    if (status.type() != fs::file_type::symlink) return at;
    check_link(file, at);
    const fs::path next = fs::read_symlink(at, error);
    if (error) refuse_file(file, at.string() + ": the link cannot be read: " + error.message());
    at = next.is_absolute() ? next : folder_of(at) / next;
  }
  refuse_file(file, "more than " + std::to_string(max_links) + " links, or links in a circle");
}

}  // namespace hf_gltf

// See file_bytes.h.
#include "gltf/file_bytes.h"

#include "gltf/file_name.h"

#ifdef _WIN32
#ifndef NOMINMAX
#define NOMINMAX
#endif
#include <windows.h>
#else
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>

namespace hf_gltf {
namespace fs = std::filesystem;
namespace {

// A regular file that is read; closed on every way out.
#ifdef _WIN32
class Reading {
 public:
  explicit Reading(const fs::path& file)
      : handle_(::CreateFileW(file.c_str(), GENERIC_READ, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                              nullptr, OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr)) {}
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;
  ~Reading() {
    if (is_open()) ::CloseHandle(handle_);
  }
  bool is_open() const { return handle_ != INVALID_HANDLE_VALUE; }
  bool find_size(uint64_t& size) const {
    LARGE_INTEGER bytes;
    if (::GetFileType(handle_) != FILE_TYPE_DISK || !::GetFileSizeEx(handle_, &bytes)) return false;
    size = static_cast<uint64_t>(bytes.QuadPart);
    return true;
  }
  // The number of bytes read, 0 at the end, or -1.
  int64_t read(uint8_t* to, size_t most) {
    DWORD got = 0;
    return ::ReadFile(handle_, to, static_cast<DWORD>(std::min(most, size_t{1} << 30)), &got, nullptr) ? got : -1;
  }
  static std::string message() { return std::system_category().message(static_cast<int>(::GetLastError())); }

 private:
  HANDLE handle_;
};
#else
class Reading {
 public:
  explicit Reading(const fs::path& file)
      : number_(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {}
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;
  ~Reading() {
    if (number_ >= 0) ::close(number_);
  }
  bool is_open() const { return number_ >= 0; }
  bool find_size(uint64_t& size) const {
    struct stat status {};
    if (::fstat(number_, &status) != 0 || !S_ISREG(status.st_mode)) return false;
    size = static_cast<uint64_t>(status.st_size);
    return true;
  }
  // The number of bytes read, 0 at the end, or -1.
  int64_t read(uint8_t* to, size_t most) {
    for (;;) {
      const ssize_t got = ::read(number_, to, most);
      if (got >= 0 || errno != EINTR) return got;
    }
  }
  static std::string message() { return std::strerror(errno); }

 private:
  int number_;
};
#endif

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

bool percent_decode(const std::string& text, std::string& out) {
  out.clear();
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      out += text[i];
      continue;
    }
    if (i + 2 >= text.size() || hex_digit(text[i + 1]) < 0 || hex_digit(text[i + 2]) < 0) return false;
    out += static_cast<char>(hex_digit(text[i + 1]) * 16 + hex_digit(text[i + 2]));
    i += 2;
  }
  return true;
}

// One sentence on the fault of a decoded relative name, or empty.
std::string name_fault(const std::string& name) {
  if (name.empty()) return "the name is empty";
  if (name.size() > 1024) return "the name is longer than 1024 bytes";
  for (const char c : name) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) return "the name holds a control character";
    if (c == '\\') return "the name holds a backslash";
  }
  if (name.front() == '/') return "the name is absolute";
  if (name.find(':') != std::string::npos) return "the name holds a scheme or a drive";
  for (const fs::path& part : file_named(name)) {
    if (part == "..") return "the name leads out of the folder (..)";
  }
  return "";
}

bool is_below(const fs::path& folder, const fs::path& file) {
  const auto ends = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return ends.first == folder.end() && ends.second != file.end();
}

}  // namespace

std::vector<uint8_t> read_bytes(const fs::path& file, uint64_t max_bytes) {
  const std::string name = file.string();
  Reading in(file);
  if (!in.is_open()) throw std::runtime_error(name + ": cannot be opened: " + Reading::message() + ".");
  uint64_t size = 0;
  if (!in.find_size(size)) throw std::runtime_error(name + ": is not a regular file.");
  if (size > max_bytes) {
    throw std::runtime_error(name + ": has " + std::to_string(size) + " bytes, above the limit of " +
                             std::to_string(max_bytes) + "; raise the limit if the file is to be trusted.");
  }
  std::vector<uint8_t> bytes(static_cast<size_t>(size));
  size_t done = 0;
  while (done < bytes.size()) {
    const int64_t got = in.read(bytes.data() + done, bytes.size() - done);
    if (got < 0) throw std::runtime_error(name + ": reading failed: " + Reading::message() + ".");
    if (got == 0) break;
    done += static_cast<size_t>(got);
  }
  bytes.resize(done);
  return bytes;
}

namespace {

fs::path resolve_name(const fs::path& file, const std::string& name, std::string& reason) {
  reason = name_fault(name);
  if (!reason.empty()) return {};
  std::error_code error;
  const fs::path folder = fs::canonical(file.has_parent_path() ? file.parent_path() : fs::path("."), error);
  if (error) {
    reason = "the folder cannot be resolved";
    return {};
  }
  const fs::path target = fs::canonical(folder / file_named(name), error);
  if (error) {
    reason = "there is no such file next to it";
    return {};
  }
  if (!is_below(folder, target)) {
    reason = "a symbolic link leads out of the folder";
    return {};
  }
  if (!fs::is_regular_file(target, error)) {
    reason = "it is not a regular file";
    return {};
  }
  return target;
}

}  // namespace

fs::path resolve_below(const fs::path& file, const std::string& uri, std::string& reason) {
  std::string name;
  const bool decoded = percent_decode(uri, name);
  fs::path target = decoded ? resolve_name(file, name, reason) : fs::path();
  if (!decoded) reason = "the percent-encoding is broken, and no file with the undecoded name is next to it";
  if (!target.empty() || (decoded && name == uri)) return target;
  // some exporters write the file's name as it is
  std::string ignored;
  return resolve_name(file, uri, ignored);
}

bool decode_data_uri(const std::string& uri, std::vector<uint8_t>& bytes, std::string& mime_type) {
  if (uri.compare(0, 5, "data:") != 0) return false;
  const size_t comma = uri.find(',');
  if (comma == std::string::npos) return false;
  const std::string head = uri.substr(5, comma - 5);
  constexpr char marker[] = ";base64";
  constexpr size_t marker_size = sizeof(marker) - 1;
  if (head.size() < marker_size || head.compare(head.size() - marker_size, marker_size, marker) != 0) return false;
  mime_type = head.substr(0, head.find(';'));

  size_t end = uri.size();
  while (end > comma + 1 && uri[end - 1] == '=' && uri.size() - end < 2) --end;
  const size_t count = end - comma - 1;
  if (count % 4 == 1) return false;
  bytes.clear();
  bytes.reserve(count / 4 * 3 + 2);
  uint32_t bits = 0;
  int held = 0;
  for (size_t i = comma + 1; i < end; ++i) {
    const char c = uri[i];
    uint32_t value = 0;
    if (c >= 'A' && c <= 'Z') {
      value = static_cast<uint32_t>(c - 'A');
    } else if (c >= 'a' && c <= 'z') {
      value = static_cast<uint32_t>(c - 'a') + 26;
    } else if (c >= '0' && c <= '9') {
      value = static_cast<uint32_t>(c - '0') + 52;
    } else if (c == '+' || c == '-') {
      value = 62;
    } else if (c == '/' || c == '_') {
      value = 63;
    } else {
      return false;
    }
    bits = (bits << 6 | value) & 0xffffffu;
    held += 6;
    if (held >= 8) {
      held -= 8;
      bytes.push_back(static_cast<uint8_t>(bits >> held));
    }
  }
  return true;
}

std::string image_mime_type(const std::vector<uint8_t>& bytes) {
  const auto starts = [&](size_t at, const char* text, size_t size) {
    return bytes.size() >= at + size && std::memcmp(bytes.data() + at, text, size) == 0;
  };
  if (starts(0, "\x89PNG\r\n\x1a\n", 8)) return "image/png";
  if (starts(0, "\xff\xd8\xff", 3)) return "image/jpeg";
  if (starts(0, "RIFF", 4) && starts(8, "WEBP", 4)) return "image/webp";
  if (starts(0, "\xabKTX 20\xbb\r\n\x1a\n", 12)) return "image/ktx2";
  return "";
}

size_t text_begin(std::string_view text, const std::string& name) {
  const std::string_view mark = text.substr(0, 2);
  const bool half = mark.size() == 2 && (mark[0] == 0) != (mark[1] == 0);
  if (half || mark == "\xff\xfe" || mark == "\xfe\xff")
    throw std::runtime_error(name + ": the text is UTF-16; save it as UTF-8.");
  return text.substr(0, 3) == "\xef\xbb\xbf" ? 3 : 0;
}

std::string printable(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f) c = '?';
  }
  return text;
}

}  // namespace hf_gltf

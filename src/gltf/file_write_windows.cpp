// See file_write.h. Windows: the new file is marked for deletion until it is whole, so that no end of the process
// leaves it behind; ReplaceFile keeps attributes and access lists of the replaced file.
#ifdef _WIN32
#ifndef NOMINMAX
#define NOMINMAX
#endif
#include <windows.h>

#include <algorithm>
#include <stdexcept>
#include <system_error>

#include "gltf/file_write.h"
#include "gltf/file_write_parts.h"

namespace hf_gltf {
namespace fs = std::filesystem;
namespace {

// The most one WriteFile is given: its size is a DWORD.
constexpr size_t write_step = size_t{1} << 30;

std::string system_reason(DWORD code) { return std::system_category().message(static_cast<int>(code)); }

// Closes on every way out.
class OpenFile {
 public:
  explicit OpenFile(HANDLE handle) : handle_(handle) {}
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() { close(); }
  HANDLE handle() const { return handle_; }
  bool is_open() const { return handle_ != INVALID_HANDLE_VALUE; }
  bool close() {
    const bool closed = !is_open() || ::CloseHandle(handle_);
    handle_ = INVALID_HANDLE_VALUE;
    return closed;
  }

 private:
  HANDLE handle_;
};

bool write_all(HANDLE file, const void* data, size_t size) {
  const auto* bytes = static_cast<const char*>(data);
  for (size_t done = 0; done < size;) {
    DWORD put = 0;
    const auto step = static_cast<DWORD>(std::min(size - done, write_step));
    if (!::WriteFile(file, bytes + done, step, &put, nullptr)) return false;
    if (put == 0) return ::SetLastError(ERROR_WRITE_FAULT), false;
    done += put;
  }
  return true;
}

bool mark_for_deletion(HANDLE file, bool on) {
  FILE_DISPOSITION_INFO mark{};
  mark.DeleteFile = on ? TRUE : FALSE;
  return ::SetFileInformationByHandle(file, FileDispositionInfo, &mark, sizeof mark) != 0;
}

// The present file opened for writing. The system then tells whether writing is allowed, and the kind of the file.
HANDLE open_present(const fs::path& file) {
  return ::CreateFileW(file.c_str(), GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr,
                       OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr);
}

bool move_into_place(const fs::path& made, const fs::path& target, bool present) {
  if (present && ::ReplaceFileW(target.c_str(), made.c_str(), nullptr, REPLACEFILE_WRITE_THROUGH, nullptr, nullptr))
    return true;
  // a file system without ReplaceFile, or nothing to replace; the old file is there until the move has happened
  if (present && ::GetLastError() != ERROR_NOT_SUPPORTED && ::GetLastError() != ERROR_INVALID_FUNCTION) return false;
  const DWORD flags = MOVEFILE_WRITE_THROUGH | (present ? MOVEFILE_REPLACE_EXISTING : 0);
  return ::MoveFileExW(made.c_str(), target.c_str(), flags) != 0;
}

void replace(const fs::path& file, const fs::path& target, bool present, const void* data, size_t size) {
  fs::path made;
  HANDLE handle = INVALID_HANDLE_VALUE;
  for (int tries = 0; tries < 100 && handle == INVALID_HANDLE_VALUE; ++tries) {
    made = folder_of(target) / random_name();
    handle =
        ::CreateFileW(made.c_str(), GENERIC_WRITE | DELETE, 0, nullptr, CREATE_NEW, FILE_ATTRIBUTE_NORMAL, nullptr);
    if (handle == INVALID_HANDLE_VALUE && ::GetLastError() != ERROR_FILE_EXISTS) break;
  }
  OpenFile out(handle);
  if (!out.is_open()) refuse_file(file, "its folder takes no new file: " + system_reason(::GetLastError()));
  const bool marked = mark_for_deletion(out.handle(), true);
  if (!write_all(out.handle(), data, size) || !::FlushFileBuffers(out.handle()) ||
      (marked && !mark_for_deletion(out.handle(), false))) {
    const DWORD code = ::GetLastError();
    mark_for_deletion(out.handle(), true);
    out.close();
    if (!marked) ::DeleteFileW(made.c_str());
    refuse_file(file, system_reason(code));
  }
  if (!out.close() || !move_into_place(made, target, present)) {
    const DWORD code = ::GetLastError();
    ::DeleteFileW(made.c_str());
    refuse_file(file, system_reason(code));
  }
}

}  // namespace

void check_link(const fs::path&, const fs::path&) {}  // making a link needs a right of its own here

void remove_unfinished_on_signals() {}  // Windows has none: the system removes the new file with the process

void write_bytes(const fs::path& file, const void* data, size_t size) {
  if (file.empty()) throw std::runtime_error("a file cannot be written: its name is empty.");
  std::error_code error;
  if (fs::is_directory(file, error)) refuse_file(file, "it is a folder");
  OpenFile present(open_present(file));
  if (present.is_open() && ::GetFileType(present.handle()) != FILE_TYPE_DISK) {  // NUL, CON, a pipe
    if (!write_all(present.handle(), data, size)) refuse_file(file, system_reason(::GetLastError()));
    return;
  }
  const DWORD code = ::GetLastError();
  if (!present.is_open() && code != ERROR_FILE_NOT_FOUND && code != ERROR_PATH_NOT_FOUND)
    refuse_file(file, system_reason(code));
  const bool is_present = present.is_open();
  present.close();  // ReplaceFile wants it closed
  replace(file, follow_links(file), is_present, data, size);
}

}  // namespace hf_gltf
#endif

// What the tests of the file writer share: folders listed, calls in a child process and as another user.
#ifndef HF_TESTS_SAMPLES_FILE_WRITE_SUPPORT_H
#define HF_TESTS_SAMPLES_FILE_WRITE_SUPPORT_H

#include <grp.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "gltf/file_write.h"
#include "unit/gltf/gltf_support.h"

namespace file_write_test {

namespace fs = std::filesystem;
using hf_gltf::remove_unfinished_on_signals;
using hf_gltf::write_bytes;
using samples_test::message_of;
using samples_test::TemporaryFolder;
using samples_test::write_text;

constexpr uid_t other_user = 65534;

inline std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline mode_t mode_of(const fs::path& file) {
  struct stat status {};
  return ::stat(file.c_str(), &status) == 0 ? status.st_mode & 07777 : 0;
}

// Names in a folder, sorted.
inline std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

inline bool has_unfinished(const fs::path& folder) {
  const auto names = names_in(folder);
  return std::any_of(names.begin(), names.end(), [](const std::string& name) { return name.rfind(".hf-", 0) == 0; });
}

using Names = std::vector<std::string>;

// Message of a refused write of "new", or "".
inline std::string refusal(const fs::path& file) {
  return message_of([&] { write_bytes(file, "new"); });
}

inline bool says(const std::string& message, const std::string& part) { return message.find(part) != message.npos; }

// Starts a child that calls a function and ends with its result as the exit code; 99 after an exception.
inline pid_t start_child(const std::function<int()>& function) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  int code = 99;
  try {
    code = function();
  } catch (...) {
  }
  ::_exit(code);
}

inline int wait_for(pid_t child) {
  int status = 0;
  return ::waitpid(child, &status, 0) == child ? status : -1;
}

// Exit code of a child that calls a function, 128 when a signal ended it.
inline int in_child(const std::function<int()>& function) {
  const int status = wait_for(start_child(function));
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

// As in_child, without the rights of root.
inline int as_other_user(const std::function<int()>& function) {
  return in_child([&] {
    if (::geteuid() == 0 && (::setgroups(0, nullptr) != 0 || ::setgid(other_user) != 0 || ::setuid(other_user) != 0)) {
      return 98;
    }
    return function();
  });
}

// A folder that the user of as_other_user may enter and write.
struct SharedFolder : TemporaryFolder {
  SharedFolder() {
    ::chmod(path.c_str(), 0755);
    if (::geteuid() == 0 && ::chown(path.c_str(), other_user, other_user) != 0) std::abort();
  }
  fs::path file(const std::string& name, mode_t mode) const {
    write_text(path / name, "old");
    if (::geteuid() == 0 && ::chown((path / name).c_str(), other_user, other_user) != 0) std::abort();
    ::chmod((path / name).c_str(), mode);
    return path / name;
  }
};

}  // namespace file_write_test

#endif

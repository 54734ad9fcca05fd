// Programs run as a user runs them.
#ifndef HF_TESTS_SUPPORT_PROGRAM_SUPPORT_H
#define HF_TESTS_SUPPORT_PROGRAM_SUPPORT_H

#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <string>

namespace hf_test {

inline std::string quoted(const std::filesystem::path& path) { return "\"" + path.string() + "\""; }

// Runs a command. output: all it says, on both streams. Returns its exit code, 128 when a signal ended it, -1 when it
// could not be started.
inline int run(const std::string& command, std::string& output) {
  output.clear();
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (!pipe) return -1;
  char buffer[4096];
  while (const std::size_t got = fread(buffer, 1, sizeof buffer, pipe)) output.append(buffer, got);
  const int status = pclose(pipe);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

}  // namespace hf_test

#endif

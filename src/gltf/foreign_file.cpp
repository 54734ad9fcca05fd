// Runs assimp in a process of its own (foreign_file.h). foreign_scene.cpp makes a model of the scene that assimp reads.
#include "gltf/foreign_file.h"

#ifdef HF_GLTF_ASSIMP
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <new>
#endif
#include <stdexcept>

#include "gltf/file_bytes.h"

namespace hf_gltf {

#ifndef HF_GLTF_ASSIMP

bool reads_foreign(FileKind) { return false; }

std::vector<uint8_t> foreign_glb(const std::vector<uint8_t>&, FileKind kind, const std::string& name,
                                 std::vector<std::string>&, const ForeignLimits&) {
  throw std::runtime_error(not_gltf(name, kind));
}

std::string foreign_glb_here(const std::vector<uint8_t>&, FileKind kind, const std::string& name,
                             std::vector<std::string>&) {
  throw std::runtime_error(not_gltf(name, kind));
}

#else

namespace {

// A sanitizer's own memory is beyond any limit.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool can_limit_memory = false;
#else
constexpr bool can_limit_memory = true;
#endif
// The first byte that the process writes.
constexpr char made = 'm', refused = 'r', out_of_memory = 'o';

// Bytes of address space this process has; 0 where the system does not say.
uint64_t own_space() {
  uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
}

// The hard limit is one above the soft limit: at the soft limit of time a signal says which limit it was.
void lower_limit(decltype(RLIMIT_AS) which, uint64_t value) {
  rlimit limit{};
  if (getrlimit(which, &limit) != 0) return;
  limit.rlim_max = std::min<rlim_t>(limit.rlim_max, static_cast<rlim_t>(value + 1));
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, static_cast<rlim_t>(value));
  setrlimit(which, &limit);
}

// Writes all of it, or as much as the other end takes.
void write_all(int to, const std::string& text) {
  for (size_t done = 0; done < text.size();) {
    const ssize_t wrote = ::write(to, text.data() + done, text.size() - done);
    if (wrote < 0 && errno != EINTR) return;
    if (wrote > 0) done += static_cast<size_t>(wrote);
  }
}

// Runs in the process. Writes one byte, then either warnings, a zero and the GLB, or a sentence.
[[noreturn]] void work(int to, const std::vector<uint8_t>& bytes, FileKind kind, const std::string& name,
                       uint64_t space, uint32_t seconds) {
  lower_limit(RLIMIT_CORE, 0);
  lower_limit(RLIMIT_CPU, seconds);
  if (can_limit_memory) lower_limit(RLIMIT_AS, space);
  for (const int caught : {SIGXCPU, SIGSEGV, SIGABRT, SIGBUS, SIGFPE}) std::signal(caught, SIG_DFL);
  try {
    std::vector<std::string> warnings;
    const std::string glb = foreign_glb_here(bytes, kind, name, warnings);
    std::string head(1, made);
    for (const std::string& warning : warnings) head += printable(warning) + '\n';
    write_all(to, head + '\0');
    write_all(to, glb);
  } catch (const std::bad_alloc&) {
    write_all(to, std::string(1, out_of_memory));
  } catch (const std::exception& error) {
    write_all(to, refused + std::string(error.what()));
  } catch (...) {
    write_all(to, refused + name + ": assimp fails on it; " + advice_on(FileKind::usd));
  }
  _exit(0);
}

// Returns the bytes that the process wrote. Ends the process if there are more than the limit.
std::string read_all(int from, pid_t process, uint64_t limit) {
  std::string out, block(size_t{1} << 16, '\0');
  for (;;) {
    const ssize_t got = ::read(from, block.data(), block.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return out;
    out.append(block, 0, static_cast<size_t>(got));
    if (out.size() <= limit) continue;
    kill(process, SIGKILL);
    return out;
  }
}

}  // namespace

bool reads_foreign(FileKind kind) { return kind == FileKind::fbx || kind == FileKind::dae || kind == FileKind::bvh; }

std::vector<uint8_t> foreign_glb(const std::vector<uint8_t>& bytes, FileKind kind, const std::string& name,
                                 std::vector<std::string>& warnings, const ForeignLimits& limits) {
  const auto fail = [&](const std::string& message) { throw std::runtime_error(name + ": " + message); };
  const std::string way_on = "; " + advice_on(FileKind::usd);  // Blender reads the same formats
  const uint64_t memory = limits.free_bytes + limits.bytes_per_byte * bytes.size();
  const uint64_t space = own_space() + memory;
  int ends[2];
  if (pipe(ends) != 0) fail("no pipe can be opened to read it; close other files and try again");
  for (const int end : ends) fcntl(end, F_SETFD, FD_CLOEXEC);  // a program that the host starts must not hold it open
  const pid_t process = fork();
  if (process == 0) {
    close(ends[0]);
    work(ends[1], bytes, kind, name, space, limits.seconds);
  }
  close(ends[1]);
  std::string text;
  int status = 0;
  if (process > 0) {
    text = read_all(ends[0], process, limits.max_glb_bytes);
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
  }
  close(ends[0]);
  if (process < 0) fail("no process can be started to read it; end other processes and try again");
  if (text.size() > limits.max_glb_bytes)
    fail("is more than " + std::to_string(limits.max_glb_bytes) + " bytes as glTF; split it into several files");
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
    fail("takes more than " + std::to_string(limits.seconds) + " s to read and may be damaged" + way_on);
  if (text.substr(0, 1) == std::string(1, out_of_memory))
    fail("takes more than " + std::to_string(memory >> 20) + " MB to read and may be damaged" + way_on);
  if (text.substr(0, 1) == std::string(1, refused)) throw std::runtime_error(text.substr(1));
  const size_t glb = text.find('\0');
  if (text.empty() || WIFSIGNALED(status) || glb == std::string::npos)
    fail("assimp fails on it; it may be damaged" + way_on);
  for (size_t at = 1; at < glb;) {
    const size_t end = text.find('\n', at);
    warnings.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return {text.begin() + static_cast<std::ptrdiff_t>(glb) + 1, text.end()};
}

#endif

}  // namespace hf_gltf

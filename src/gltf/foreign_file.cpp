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
#include <cstdlib>
#include <cstring>
#include <exception>
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
// How the process ended, behind all else that it writes. The status of the process is not asked: a host that ignores
// SIGCHLD, or waits for all children, gets it first.
constexpr size_t word_length = 4;
constexpr char made[] = "made", refused[] = "said", out_of_memory[] = "full", late[] = "late";
// A process that waits takes no processor time, so a clock stops it too. A busy machine may run it a tenth of the time.
constexpr uint32_t most_waiting = 10;

// Bytes of address space this process has; 0 where the system does not say.
uint64_t own_space() {
  uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
}

// The hard limit stands one above: at the soft one of time the process can still say so.
void lower_limit(decltype(RLIMIT_AS) which, uint64_t value) {
  rlimit limit{};
  if (getrlimit(which, &limit) != 0) return;
  limit.rlim_max = std::min<rlim_t>(limit.rlim_max, static_cast<rlim_t>(value + 1));
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, static_cast<rlim_t>(value));
  setrlimit(which, &limit);
}

// All of it, or as much as the other end takes.
void write_all(int to, const char* text, size_t size) noexcept {
  while (size > 0) {
    const ssize_t wrote = ::write(to, text, size);
    if (wrote < 0 && errno != EINTR) return;
    if (wrote <= 0) continue;
    text += wrote;
    size -= static_cast<size_t>(wrote);
  }
}

int late_to = -1;  // of the process

extern "C" void say_late(int) {
  write_all(late_to, late, word_length);
  _exit(0);
}

// The host's handlers are not for the process: for signals, for lack of memory, for the end.
void leave_handlers() {
  for (int number = 1; number < NSIG; ++number) {
    struct sigaction now {};
    if (sigaction(number, nullptr, &now) == 0 && now.sa_handler != SIG_IGN) std::signal(number, SIG_DFL);
  }
  std::set_new_handler(nullptr);
  std::set_terminate(std::abort);
}

// At the end of its time the process says so, also where the host blocks or ignores signals.
void limit_time(int to, uint32_t seconds) {
  late_to = to;
  for (const int number : {SIGXCPU, SIGALRM}) std::signal(number, say_late);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  lower_limit(RLIMIT_CPU, seconds);
  alarm(most_waiting * seconds);
}

// The process: the warnings, a zero and the GLB, or a sentence. Then how it ended.
[[noreturn]] void work(int to, const std::vector<uint8_t>& bytes, FileKind kind, const std::string& name,
                       uint64_t space, uint32_t seconds) noexcept {
  leave_handlers();
  limit_time(to, seconds);
  lower_limit(RLIMIT_CORE, 0);
  if (can_limit_memory) lower_limit(RLIMIT_AS, space);
  const char* end = nullptr;
  try {
    std::vector<std::string> warnings;
    const std::string glb = foreign_glb_here(bytes, kind, name, warnings);
    std::string head;
    for (const std::string& warning : warnings) head += printable(warning) + '\n';
    write_all(to, head.c_str(), head.size() + 1);
    write_all(to, glb.data(), glb.size());
    end = made;
  } catch (const std::bad_alloc&) {
    end = out_of_memory;
  } catch (const std::exception& error) {
    write_all(to, error.what(), std::strlen(error.what()));
    end = refused;
  } catch (...) {
  }
  if (end) write_all(to, end, word_length);
  _exit(0);  // exit() would run the host's handlers for its end, and write the host's buffers a second time
}

// Both ends are closed in programs that the host starts. Elsewhere than on Linux one that starts just now keeps them.
bool open_pipe(int ends[2]) {
#ifdef __linux__
  return pipe2(ends, O_CLOEXEC) == 0;
#else
  if (pipe(ends) != 0) return false;
  for (int k = 0; k < 2; ++k) fcntl(ends[k], F_SETFD, FD_CLOEXEC);
  return true;
#endif
}

// The reading end and the process that writes. Closed before the wait: a process that still writes ends then.
struct Child {
  int from;
  pid_t process = -1;
  ~Child() {
    close(from);
    while (process > 0 && waitpid(process, nullptr, 0) < 0 && errno == EINTR) continue;
  }
};

// The output of the process, up to a little more than a limit.
std::string read_all(int from, uint64_t limit) {
  std::string out;
  char block[1 << 16];
  while (out.size() <= limit) {
    const ssize_t got = ::read(from, block, sizeof block);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    out.append(block, static_cast<size_t>(got));
  }
  return out;
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
  if (!open_pipe(ends)) fail("no pipe can be opened to read it; close other files and try again");
  std::string text;
  {
    Child writer{ends[0]};
    writer.process = fork();
    if (writer.process == 0) {
      close(ends[0]);
      work(ends[1], bytes, kind, name, space, limits.seconds);
    }
    close(ends[1]);
    if (writer.process < 0) fail("no process can be started to read it; end other processes and try again");
    text = read_all(ends[0], limits.max_glb_bytes);
  }
  if (text.size() > limits.max_glb_bytes)
    fail("is more than " + std::to_string(limits.max_glb_bytes) + " bytes as glTF; split it into several files");
  const size_t size = text.size() - std::min(text.size(), word_length);
  const std::string end = text.substr(size);
  text.resize(size);
  if (end == late) fail("takes more than " + std::to_string(limits.seconds) + " s to read and may be damaged" + way_on);
  if (end == out_of_memory)
    fail("takes more than " + std::to_string(memory >> 20) + " MB to read and may be damaged" + way_on);
  if (end == refused) throw std::runtime_error(text);
  const size_t glb = text.find('\0');
  if (end != made || glb == std::string::npos) fail("assimp fails on it; it may be damaged" + way_on);
  for (size_t at = 0; at < glb;) {
    const size_t next = text.find('\n', at);
    warnings.push_back(text.substr(at, next - at));
    at = next + 1;
  }
  return {text.begin() + static_cast<std::ptrdiff_t>(glb) + 1, text.end()};
}

#endif

}  // namespace hf_gltf

// See file_write.h. POSIX: openat, renameat, and handlers that remove the new file when a signal ends the program.
#ifndef _WIN32
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <mutex>
#include <stdexcept>

#include "gltf/file_write.h"
#include "gltf/file_write_parts.h"

namespace hf_gltf {
namespace fs = std::filesystem;
namespace {

// The most one write() is given: Linux takes no more than 2 GB - 4 KB at once.
constexpr size_t write_step = size_t{1} << 30;

std::string system_reason() { return std::strerror(errno); }

// Closes on every way out. Numbers 0 to 2 are moved away: printf must not reach the file when stdout is closed.
class OpenFile {
 public:
  explicit OpenFile(int number) : number_(number) {
    if (number_ < 0 || number_ > 2) return;
    const int moved = ::fcntl(number_, F_DUPFD_CLOEXEC, 3), reason = errno;
    ::close(number_);
    number_ = moved;
    errno = reason;
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() { close(); }
  int number() const { return number_; }
  bool close() {
    const int closed = number_ < 0 ? 0 : ::close(number_);
    number_ = -1;
    return closed == 0 || errno == EINTR;  // after EINTR the descriptor is closed
  }

 private:
  int number_;
};

bool write_all(int descriptor, const void* data, size_t size) {
  const auto* bytes = static_cast<const char*>(data);
  for (size_t done = 0; done < size;) {
    const ssize_t put = ::write(descriptor, bytes + done, std::min(size - done, write_step));
    if (put < 0 && errno == EINTR) continue;
    if (put == 0) errno = EIO;
    if (put <= 0) return false;
    done += static_cast<size_t>(put);
  }
  return true;
}

// True as well where the file system has no sync.
bool sync(int descriptor) {
  while (::fsync(descriptor) != 0) {
    if (errno == EINVAL || errno == ENOSYS || errno == ENOTSUP || errno == EBADF) return true;
    if (errno != EINTR) return false;
  }
  return true;
}

// The descriptor of this process that a name like /dev/stdout or /dev/fd/3 stands for, or -1.
int own_descriptor(const fs::path& file) {
  std::error_code error;
  fs::path at = file;
  for (int hops = 0; hops < 8; ++hops) {  // /dev/stdout is one link away from the numbers
    const std::string number = at.filename().string();
    const bool digits = !number.empty() && number.size() < 7 && number.find_first_not_of("0123456789") == number.npos;
    if (digits && fs::equivalent(folder_of(at), "/dev/fd", error)) return std::stoi(number);
    const fs::path next = fs::read_symlink(at, error);
    if (error) return -1;
    at = next.is_absolute() ? next : folder_of(at) / next;
  }
  return -1;
}

void write_through(const fs::path& file, int descriptor, const void* data, size_t size) {
  const OpenFile out(descriptor);
  if (out.number() < 0) refuse_file(file, system_reason());
  if (!write_all(out.number(), data, size) || !sync(out.number())) refuse_file(file, system_reason());
}

// ---- the new file, and its removal by a signal ----

constexpr int ending_signals[] = {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGXFSZ};

std::atomic<bool> takes_signals;     // the program called remove_unfinished_on_signals
std::mutex one_writer;               // guards the variables below; the handler reads them only while a new file exists
std::atomic<int> unfinished_folder;  // descriptor + 1 of the folder that holds unfinished_name; 0: there is none
char unfinished_name[64];
std::atomic<bool> is_interrupted;  // a signal removed the new file, and its earlier handler returned
struct sigaction earlier_action[std::size(ending_signals)];
bool is_replaced[std::size(ending_signals)];

// Removes the new file and passes the signal to its earlier handler.
extern "C" void hf_gltf_remove_unfinished(int signal) {
  const int reason = errno, folder = unfinished_folder.load();
  if (folder) ::unlinkat(folder - 1, unfinished_name, 0);
  is_interrupted = true;
  for (size_t i = 0; i < std::size(ending_signals); ++i) {
    if (ending_signals[i] == signal) ::sigaction(signal, &earlier_action[i], nullptr);
  }
  errno = reason;
  ::raise(signal);  // held back until this handler returns
}

// Handlers as long as a new file stands. A file that grows beyond the limit of the process is an error, no signal.
class SignalGuard {
 public:
  SignalGuard() {
    is_interrupted = false;
    std::fill(std::begin(is_replaced), std::end(is_replaced), false);
    if (!takes_signals) return;
    struct sigaction action {};
    sigfillset(&action.sa_mask);
    for (size_t i = 0; i < std::size(ending_signals); ++i) {
      action.sa_handler = ending_signals[i] == SIGXFSZ ? SIG_IGN : hf_gltf_remove_unfinished;
      is_replaced[i] = ::sigaction(ending_signals[i], nullptr, &earlier_action[i]) == 0 &&
                       earlier_action[i].sa_handler != SIG_IGN && ::sigaction(ending_signals[i], &action, nullptr) == 0;
    }
  }
  ~SignalGuard() {
    for (size_t i = 0; i < std::size(ending_signals); ++i) {
      if (is_replaced[i]) ::sigaction(ending_signals[i], &earlier_action[i], nullptr);
    }
  }
};

// Holds signals back in this thread while a file and the note of it change together.
class SignalPause {
 public:
  SignalPause() {
    sigset_t all;
    sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalPause() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_;
};

// A file under a random name in a folder: put() gives it its name, otherwise it is removed.
class NewFile {
 public:
  NewFile(const fs::path& file, int folder, mode_t mode) : folder_(folder), out_(create(folder, mode)) {
    if (out_.number() < 0) refuse_file(file, "its folder takes no new file: " + system_reason());
  }
  ~NewFile() {
    if (unfinished_folder.load()) ::unlinkat(folder_, unfinished_name, 0);
    unfinished_folder = 0;
  }
  int number() const { return out_.number(); }
  bool put(const std::string& name) {
    if (!out_.close()) return false;
    const SignalPause pause;
    if (::renameat(folder_, unfinished_name, folder_, name.c_str()) != 0) return false;
    unfinished_folder = 0;
    return true;
  }

 private:
  static int create(int folder, mode_t mode) {
    for (int tries = 0; tries < 100; ++tries) {
      const std::string name = random_name();
      const SignalPause pause;
      unfinished_name[name.copy(unfinished_name, sizeof unfinished_name - 1)] = '\0';
      const int out = ::openat(folder, unfinished_name, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
      if (out >= 0) unfinished_folder = folder + 1;
      if (out >= 0 || errno != EEXIST) return out;
    }
    return -1;
  }

  int folder_;
  OpenFile out_;
};

int open_folder(const fs::path& folder) {
  const int flags = O_DIRECTORY | O_CLOEXEC;
  int number = ::open(folder.c_str(), O_RDONLY | flags);
#ifdef O_PATH
  if (number < 0 && errno == EACCES) number = ::open(folder.c_str(), O_PATH | flags);  // may not be listed: not synced
#endif
  return number;
}

// Permissions, owner and group of the file that is replaced. A group that cannot be kept gets what others have.
bool keep_rights(int descriptor, const struct stat& old) {
  mode_t mode = old.st_mode & 0777;
  struct stat made {};
  if (::fstat(descriptor, &made) != 0) return false;
  const bool same = made.st_uid == old.st_uid && made.st_gid == old.st_gid;
  if (!same && ::fchown(descriptor, old.st_uid, old.st_gid) != 0 &&
      ::fchown(descriptor, static_cast<uid_t>(-1), old.st_gid) != 0) {
    mode = (mode & 0707) | (mode & 07) << 3;
  }
  return ::fchmod(descriptor, mode) == 0;
}

// Asks the system whether the present file may be written, and what its rights are. False: there is none.
bool find_present(const fs::path& file, const fs::path& target, struct stat& old) {
  const OpenFile present(::open(target.c_str(), O_WRONLY | O_NONBLOCK | O_NOFOLLOW | O_NOCTTY | O_CLOEXEC));
  if (present.number() < 0 && errno == ENOENT) return false;
  if (present.number() < 0 || ::fstat(present.number(), &old) != 0) refuse_file(file, system_reason());
  if (!S_ISREG(old.st_mode)) refuse_file(file, "it changed during the call");
  return true;
}

void replace(const fs::path& file, const fs::path& target, const void* data, size_t size) {
  struct stat old {};
  const bool present = find_present(file, target, old);
  const OpenFile folder(open_folder(folder_of(target)));
  if (folder.number() < 0) refuse_file(file, "its folder " + folder_of(target).string() + ": " + system_reason());

  const std::lock_guard<std::mutex> lock(one_writer);
  const SignalGuard guard;
  NewFile out(file, folder.number(), present ? 0600 : 0666);  // a new file's rights, reduced by the umask
  if (!write_all(out.number(), data, size) || (present && !keep_rights(out.number(), old)) || !sync(out.number()) ||
      !out.put(target.filename().string())) {
    refuse_file(file, is_interrupted ? "a signal interrupted it" : system_reason());
  }
  if (!sync(folder.number())) refuse_file(file, "it is in place, but its folder cannot be synced: " + system_reason());
}

}  // namespace

// Linux refuses links of other users in shared folders (fs.protected_symlinks); here also where it does not.
void check_link(const fs::path& file, const fs::path& link) {
  struct stat at {
  }, folder{};
  if (::lstat(link.c_str(), &at) != 0 || ::stat(folder_of(link).c_str(), &folder) != 0) return;
  const bool shared = (folder.st_mode & S_ISVTX) && (folder.st_mode & S_IWOTH);
  if (shared && at.st_uid != ::geteuid() && at.st_uid != folder.st_uid) {
    refuse_file(file, link.string() + " is a link of another user in a shared folder");
  }
}

void remove_unfinished_on_signals() { takes_signals = true; }

void write_bytes(const fs::path& file, const void* data, size_t size) {
  if (file.empty()) throw std::runtime_error("a file cannot be written: its name is empty.");
  const int own = own_descriptor(file);
  if (own >= 0) {
    std::fflush(nullptr);  // so earlier prints come first
    return write_through(file, ::fcntl(own, F_DUPFD_CLOEXEC, 3), data, size);
  }
  struct stat status {};
  if (::stat(file.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) refuse_file(file, "it is a folder");
    if (!S_ISREG(status.st_mode)) {
      return write_through(file, ::open(file.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC), data, size);
    }
  } else if (errno != ENOENT && errno != ELOOP) {
    refuse_file(file, system_reason());
  }
  replace(file, follow_links(file), data, size);
}

}  // namespace hf_gltf
#endif

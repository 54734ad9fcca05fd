// The file writer when the disk is full, a signal comes, descriptors run out, or several write at once.
#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <thread>

#include "unit/gltf/file_write_support.h"

namespace {

using namespace file_write_test;

std::string synced;  // "f" for a file, "d" for a folder, in the order of the calls

}  // namespace

// Stands for the C library's fsync in this program.
extern "C" int fsync(int descriptor) {
  struct stat status {};
  if (::fstat(descriptor, &status) == 0) synced += S_ISDIR(status.st_mode) ? 'd' : 'f';
  return static_cast<int>(::syscall(SYS_fsync, descriptor));
}

namespace {

TEST(FileWriteFaults, TheFileIsSyncedAndThenItsFolder) {
  TemporaryFolder folder;
  synced.clear();
  write_bytes(folder.path / "file", std::string("new"));
  EXPECT_EQ(synced, "fd");
}

const std::string& long_text() {
  static const std::string text(size_t{96} << 20, 'n');  // takes long enough to be interrupted
  return text;
}

// Signals a child as soon as its new file stands. False when it never did.
bool signal_during_write(pid_t child, const fs::path& folder, int signal) {
  for (int i = 0; i < 100000; ++i) {
    if (has_unfinished(folder)) return ::kill(child, signal) == 0;
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
  return false;
}

class FileWriteSignal : public testing::TestWithParam<int> {};

TEST_P(FileWriteSignal, AnInterruptLeavesTheOldFileAlone) {
  TemporaryFolder folder;
  const fs::path file = folder.path / "file";
  write_text(file, "old");
  const pid_t child = start_child([&] {
    ::signal(GetParam(), SIG_DFL);
    remove_unfinished_on_signals();
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    write_bytes(file, long_text());
    return 0;
  });
  ASSERT_TRUE(signal_during_write(child, folder.path, GetParam()));
  const int status = wait_for(child);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == GetParam()) << status;
  EXPECT_EQ(text_of(file), "old");
  EXPECT_EQ(names_in(folder.path), Names{"file"});
}

INSTANTIATE_TEST_SUITE_P(Ends, FileWriteSignal, testing::Values(SIGINT, SIGTERM, SIGHUP, SIGQUIT),
                         [](const auto& info) { return "signal" + std::to_string(info.param); });

volatile std::sig_atomic_t handled = 0;

TEST(FileWriteFaults, AHandlerOfTheProgramIsCalledAndStays) {
  TemporaryFolder folder;
  const fs::path file = folder.path / "file";
  write_text(file, "old");
  const pid_t child = start_child([&] {
    ::signal(SIGINT, [](int) { handled = handled + 1; });
    remove_unfinished_on_signals();
    const std::string message = message_of([&] { write_bytes(file, long_text()); });
    ::raise(SIGINT);
    return handled == 2 && says(message, file.string() + ": cannot be written: a signal interrupted it") ? 0 : 1;
  });
  ASSERT_TRUE(signal_during_write(child, folder.path, SIGINT));
  EXPECT_EQ(wait_for(child), 0);
  EXPECT_EQ(text_of(file), "old");
  EXPECT_EQ(names_in(folder.path), Names{"file"});
}

TEST(FileWriteFaults, AnIgnoredSignalStaysIgnored) {
  TemporaryFolder folder;
  const fs::path file = folder.path / "file";
  const pid_t child = start_child([&] {
    ::signal(SIGHUP, SIG_IGN);
    remove_unfinished_on_signals();
    write_bytes(file, long_text());
    return ::signal(SIGHUP, SIG_DFL) == SIG_IGN ? 0 : 1;
  });
  ASSERT_TRUE(signal_during_write(child, folder.path, SIGHUP));
  EXPECT_EQ(wait_for(child), 0);
  EXPECT_EQ(fs::file_size(file), long_text().size());
}

TEST(FileWriteFaults, AHostThatDidNotAskKeepsItsHandlersDuringAWrite) {
  TemporaryFolder folder;
  const pid_t child = start_child([&] {
    ::signal(SIGINT, [](int) { handled = handled + 1; });
    write_bytes(folder.path / "file", long_text());
    return handled == 1 ? 0 : 1;
  });
  ASSERT_TRUE(signal_during_write(child, folder.path, SIGINT));
  EXPECT_EQ(wait_for(child), 0);
  EXPECT_EQ(fs::file_size(folder.path / "file"), long_text().size());
}

// Compared with before, since a program in the background of a shell is started with interrupts ignored.
TEST(FileWriteFaults, SignalsAreAsBeforeAfterEveryWrite) {
  const int signals[] = {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGXFSZ};
  std::vector<void (*)(int)> before;
  for (const int signal : signals) {
    struct sigaction now {};
    ASSERT_EQ(::sigaction(signal, nullptr, &now), 0);
    before.push_back(now.sa_handler);
  }
  TemporaryFolder folder;
  write_bytes(folder.path / "file", "new");
  EXPECT_FALSE(refusal(folder.path / "missing" / "file").empty());
  for (std::size_t i = 0; i < std::size(signals); ++i) {
    struct sigaction now {};
    ASSERT_EQ(::sigaction(signals[i], nullptr, &now), 0);
    EXPECT_EQ(now.sa_handler, before[i]) << signals[i];
  }
  sigset_t held;
  ASSERT_EQ(::pthread_sigmask(SIG_SETMASK, nullptr, &held), 0);
  EXPECT_EQ(sigismember(&held, SIGINT), 0);
}

TEST(FileWriteFaults, ALimitOnTheSizeLeavesTheOldFileAlone) {
  TemporaryFolder folder;
  const fs::path file = folder.path / "file";
  write_text(file, "old");
  EXPECT_EQ(in_child([&] {
              const rlimit limit{10000, 10000};
              ::setrlimit(RLIMIT_FSIZE, &limit);
              remove_unfinished_on_signals();
              const std::string message = message_of([&] { write_bytes(file, std::string(20000, 'n')); });
              return says(message, file.string() + ": cannot be written: File too large") ? 0 : 1;
            }),
            0);
  EXPECT_EQ(text_of(file), "old");
  EXPECT_EQ(names_in(folder.path), Names{"file"});
}

TEST(FileWriteFaults, AFullDiskLeavesTheOldFileAlone) {
  TemporaryFolder folder;
  const int code = in_child([&] {
    // a small disk of its own; the rest of the machine does not see it
    if (::unshare(CLONE_NEWNS) != 0 || ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        ::mount("hf", folder.path.c_str(), "tmpfs", 0, "size=64k") != 0) {
      return 77;
    }
    const fs::path file = folder.path / "file";
    write_bytes(file, "old");
    const std::string message = message_of([&] { write_bytes(file, std::string(100000, 'n')); });
    if (!says(message, file.string() + ": cannot be written: No space left")) return 1;
    if (text_of(file) != "old" || names_in(folder.path) != Names{"file"}) return 2;
    write_bytes(file, std::string(30000, 'n'));  // what the failed write took is free again
    return 0;
  });
  if (code == 77) GTEST_SKIP() << "a small disk needs the right to mount";
  EXPECT_EQ(code, 0);
}

TEST(FileWriteFaults, NoDescriptorLeftIsAnError) {
  TemporaryFolder folder;
  const fs::path file = folder.path / "file";
  write_text(file, "old");
  const auto with_free = [&](rlim_t free) {
    return in_child([&] {
      const int lowest = ::dup(0);
      const rlimit limit{static_cast<rlim_t>(lowest) + free, static_cast<rlim_t>(lowest) + free};
      ::close(lowest);
      ::setrlimit(RLIMIT_NOFILE, &limit);
      return says(refusal(file), file.string() + ": cannot be written") ? 0 : 1;
    });
  };
  EXPECT_EQ(with_free(0), 0);
  EXPECT_EQ(with_free(1), 0);
  EXPECT_EQ(text_of(file), "old");
  EXPECT_EQ(names_in(folder.path), Names{"file"});
}

TEST(FileWriteFaults, NoDescriptorStaysOpen) {
  if (!fs::exists("/proc/self/fd")) GTEST_SKIP() << "no /proc here";
  TemporaryFolder folder;
  const size_t before = names_in("/proc/self/fd").size();
  for (int i = 0; i < 20; ++i) {
    write_bytes(folder.path / "file", "new");
    EXPECT_FALSE(refusal(folder.path).empty());
    EXPECT_FALSE(refusal(folder.path / "missing" / "file").empty());
    write_bytes("/dev/null", "new");
  }
  EXPECT_EQ(names_in("/proc/self/fd").size(), before);
}

TEST(FileWriteFaults, AClosedStandardOutputDoesNotReachTheFile) {
  TemporaryFolder folder;
  const fs::path file = folder.path / "file";
  constexpr int most_looks = 10;
  // while it writes, the file must not stand behind descriptor 1; on a busy machine a child may be done before a look
  bool stood = false;
  for (int attempt = 0; attempt < 20 && !stood; ++attempt) {
    const pid_t child = start_child([&] {
      for (const int number : {0, 1, 2}) ::close(number);
      write_bytes(file, long_text());
      return 0;
    });
    for (int i = 0; i < 100000 && !stood; ++i) stood = has_unfinished(folder.path);
    std::error_code error;
    // the child may be stopped between opening the file and moving it to a higher descriptor: only what stays counts
    for (const int number : {0, 1, 2}) {
      const std::string at = "/proc/" + std::to_string(child) + "/fd/" + std::to_string(number);
      int seen = 0;
      for (int look = 0; look < most_looks && !fs::read_symlink(at, error).empty(); ++look) {
        ++seen;
        ::usleep(20);
      }
      EXPECT_LT(seen, most_looks) << "the file stays behind descriptor " << number;
    }
    EXPECT_EQ(wait_for(child), 0);
  }
  EXPECT_TRUE(stood);
}

TEST(FileWriteFaults, WritersAtTheSameTimeLeaveOneWholeFile) {
  TemporaryFolder folder;
  const fs::path file = folder.path / "file";
  const auto write_often = [&](char letter) {
    for (int i = 0; i < 20; ++i) write_bytes(file, std::string(50000, letter));
    return 0;
  };
  std::vector<pid_t> children;
  for (const char letter : {'a', 'b', 'c'}) children.push_back(start_child([&] { return write_often(letter); }));
  std::vector<std::thread> threads;
  for (const char letter : {'d', 'e'}) threads.emplace_back([&, letter] { write_often(letter); });
  for (std::thread& thread : threads) thread.join();
  for (const pid_t child : children) EXPECT_EQ(wait_for(child), 0);
  const std::string text = text_of(file);
  EXPECT_EQ(text, std::string(50000, text.at(0)));
  EXPECT_EQ(names_in(folder.path), Names{"file"});
}

TEST(FileWriteFaults, AReaderSeesTheOldBytesOrTheNew) {
  TemporaryFolder folder;
  const fs::path file = folder.path / "file";
  write_bytes(file, std::string(40000, 'a'));
  std::atomic<bool> done{false};
  int seen = 0;
  std::thread reader([&] {
    while (!done) {
      const std::string text = text_of(file);
      const bool whole = text.size() == 40000 && text == std::string(40000, text[0]);
      EXPECT_TRUE(whole);
      seen += whole;
    }
  });
  for (int i = 0; i < 60; ++i) write_bytes(file, std::string(40000, i % 2 ? 'a' : 'b'));
  done = true;
  reader.join();
  EXPECT_GT(seen, 0);
}

}  // namespace

// The file writer: rights, names, links and devices.
#include "gltf/file_write.h"

#include <fcntl.h>

#include <cstdio>
#include <thread>

#include "common/mesh_file.h"
#include "unit/gltf/file_write_support.h"

namespace {

using namespace file_write_test;

TEST(FileWrite, NoOtherCodeOfTheProgramsWritesFiles) {
  const fs::path root = HF_SOURCE_DIR;
  std::vector<fs::path> files;
  for (const char* folder : {"samples", "src/gltf"})
    for (const auto& entry : fs::recursive_directory_iterator(root / folder))
      if (entry.is_regular_file()) files.push_back(entry.path());
  ASSERT_GT(files.size(), 200u);
  for (const fs::path& file : files) {
    const std::string name = fs::relative(file, root).generic_string();
    // examples are programs of one file in C, to be read
    if (name.rfind("samples/examples/", 0) == 0 || name.rfind("src/gltf/file_write", 0) == 0) continue;
    const std::string text = text_of(file);
    for (const char* call : {"ofstream", "fopen(", "fs::rename(", "filesystem::rename(", "O_CREAT", "O_WRONLY"}) {
      EXPECT_FALSE(says(text, call)) << name << " calls " << call << "; file_write.h writes files";
    }
  }
}

// ---- rights ----

TEST(FileWrite, ANewFileGetsWhatTheUmaskLeaves) {
  TemporaryFolder folder;
  for (const mode_t mask : {0022u, 0077u, 0002u}) {
    const fs::path file = folder.path / std::to_string(mask);
    const mode_t before = ::umask(mask);
    write_bytes(file, "new");
    ::umask(before);
    EXPECT_EQ(mode_of(file), 0666 & ~mask);
    EXPECT_EQ(text_of(file), "new");
  }
  EXPECT_EQ(names_in(folder.path).size(), 3u);
}

TEST(FileWrite, AReplacedFileKeepsItsPermissions) {
  TemporaryFolder folder;
  const fs::path file = folder.path / "file";
  write_text(file, "old");
  for (const mode_t mode : {0640u, 0751u, 0604u, 0666u}) {
    ::chmod(file.c_str(), mode);
    write_bytes(file, "new");
    EXPECT_EQ(mode_of(file), mode);
  }
  EXPECT_EQ(text_of(file), "new");
}

TEST(FileWrite, SetuidAndSetgidAreDropped) {
  TemporaryFolder folder;
  const fs::path file = folder.path / "file";
  write_text(file, "old");
  ASSERT_EQ(::chmod(file.c_str(), 06755), 0);
  write_bytes(file, "new");
  EXPECT_EQ(mode_of(file), 0755u);
}

TEST(FileWrite, OwnerAndGroupOfAReplacedFileStay) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root may write the files of another user";
  SharedFolder folder;
  const fs::path file = folder.file("file", 0640);
  write_bytes(file, "new");
  struct stat status {};
  ASSERT_EQ(::stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_uid, other_user);
  EXPECT_EQ(status.st_gid, other_user);
  EXPECT_EQ(mode_of(file), 0640u);
}

TEST(FileWrite, AGroupThatCannotBeKeptGetsWhatOthersHave) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can make a file of a group that it is not in";
  SharedFolder folder;
  const fs::path file = folder.path / "file";
  write_text(file, "old");
  ::chmod(file.c_str(), 0676);
  EXPECT_EQ(as_other_user([&] { return refusal(file).empty() ? 0 : 1; }), 0);
  EXPECT_EQ(mode_of(file), 0666u);
  EXPECT_EQ(text_of(file), "new");
}

TEST(FileWrite, AReadOnlyFileIsRefused) {
  SharedFolder folder;
  const fs::path file = folder.file("file", 0444);
  EXPECT_EQ(as_other_user([&] { return says(refusal(file), file.string() + ": cannot be written") ? 0 : 1; }), 0);
  EXPECT_EQ(text_of(file), "old");
  EXPECT_EQ(names_in(folder.path), Names{"file"});
}

TEST(FileWrite, AReadOnlyFolderIsRefused) {
  SharedFolder folder;
  const fs::path file = folder.file("file", 0644);
  ::chmod(folder.path.c_str(), 0555);
  EXPECT_EQ(as_other_user([&] { return says(refusal(file), "its folder takes no new file") ? 0 : 1; }), 0);
  EXPECT_EQ(as_other_user([&] { return says(refusal(folder.path / "other"), "takes no new file") ? 0 : 1; }), 0);
  ::chmod(folder.path.c_str(), 0755);
  EXPECT_EQ(text_of(file), "old");
  EXPECT_EQ(names_in(folder.path), Names{"file"});
}

TEST(FileWrite, AFolderThatMayNotBeListedIsWritten) {
  SharedFolder folder;
  ::chmod(folder.path.c_str(), 0300);
  EXPECT_EQ(as_other_user([&] { return refusal(folder.path / "file").empty() ? 0 : 1; }), 0);
  ::chmod(folder.path.c_str(), 0755);
  EXPECT_EQ(text_of(folder.path / "file"), "new");
}

// ---- names ----

TEST(FileWrite, AMissingFolderIsNamed) {
  TemporaryFolder folder;
  const std::string message = refusal(folder.path / "missing" / "file");
  EXPECT_TRUE(says(message, (folder.path / "missing" / "file").string() + ": cannot be written")) << message;
  EXPECT_TRUE(says(message, "its folder " + (folder.path / "missing").string())) << message;
  EXPECT_TRUE(names_in(folder.path).empty());
}

TEST(FileWrite, AFolderAsTargetIsRefused) {
  TemporaryFolder folder;
  fs::create_directory(folder.path / "inner");
  for (const std::string name : {"inner", "inner/", ".", "none/"}) {
    const std::string message = refusal((folder.path / name).string());
    EXPECT_TRUE(says(message, "folder")) << name << " " << message;
  }
  EXPECT_EQ(names_in(folder.path), Names{"inner"});
}

TEST(FileWrite, AFileInPlaceOfAFolderIsRefused) {
  TemporaryFolder folder;
  write_text(folder.path / "file", "old");
  const std::string message = refusal(folder.path / "file" / "name");
  EXPECT_TRUE(says(message, "name: cannot be written")) << message;
  EXPECT_EQ(text_of(folder.path / "file"), "old");
}

TEST(FileWrite, TheLongestNameIsWritten) {
  TemporaryFolder folder;
  const fs::path file = folder.path / std::string(255, 'n');
  write_bytes(file, "old");
  write_bytes(file, "new");
  EXPECT_EQ(text_of(file), "new");
  EXPECT_EQ(names_in(folder.path).size(), 1u);
}

TEST(FileWrite, ANameTooLongIsRefused) {
  TemporaryFolder folder;
  EXPECT_TRUE(says(refusal(folder.path / std::string(256, 'n')), "nnn: cannot be written"));
  EXPECT_TRUE(
      says(refusal(folder.path / (std::string(2500, '/') + std::string(2500, '/') + "n")), "cannot be written"));
  EXPECT_TRUE(names_in(folder.path).empty());
}

TEST(FileWrite, UmlautsBlanksAndNewlinesStandInNames) {
  TemporaryFolder folder;
  for (const std::string name : {"Bären füße.txt", " ", "a\nb", "-rf", "日本", "\xff\xfe", "~", "a:b", "..."}) {
    write_bytes(folder.path / name, name);
    EXPECT_EQ(text_of(folder.path / name), name);
  }
  EXPECT_EQ(names_in(folder.path).size(), 9u);
}

TEST(FileWrite, ANameWithoutAFolderIsWrittenHere) {
  TemporaryFolder folder;
  EXPECT_EQ(in_child([&] { return ::chdir(folder.path.c_str()) == 0 && refusal("file").empty() ? 0 : 1; }), 0);
  EXPECT_EQ(text_of(folder.path / "file"), "new");
}

TEST(FileWrite, AnEmptyNameIsRefused) { EXPECT_TRUE(says(refusal(""), "its name is empty")); }

TEST(FileWrite, AnEmptyFileIsWritten) {
  TemporaryFolder folder;
  write_text(folder.path / "file", "old");
  write_bytes(folder.path / "file", nullptr, 0);
  EXPECT_TRUE(fs::is_empty(folder.path / "file"));
}

TEST(FileWrite, InputAndOutputMayBeOneFile) {
  TemporaryFolder folder;
  const fs::path file = folder.path / "mesh.obj";
  write_text(file, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  samples::write_mesh_file(samples::read_mesh_file(file), file);
  EXPECT_EQ(samples::read_mesh_file(file).triangles, (std::vector<uint32_t>{0, 1, 2}));
}

// ---- links ----

TEST(FileWrite, ALinkIsFollowedToItsTarget) {
  TemporaryFolder folder;
  fs::create_directory(folder.path / "inner");
  write_text(folder.path / "inner" / "target", "old");
  ::chmod((folder.path / "inner" / "target").c_str(), 0600);
  fs::create_symlink("inner/target", folder.path / "link");
  write_bytes(folder.path / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder.path / "link"));
  EXPECT_EQ(text_of(folder.path / "inner" / "target"), "new");
  EXPECT_EQ(mode_of(folder.path / "inner" / "target"), 0600u);
  EXPECT_EQ(names_in(folder.path / "inner"), Names{"target"});
}

TEST(FileWrite, AChainOfLinksIsFollowed) {
  TemporaryFolder folder;
  fs::create_directory(folder.path / "inner");
  fs::create_directory_symlink("inner", folder.path / "way");
  write_text(folder.path / "target", "old");
  fs::create_symlink("../target", folder.path / "inner" / "3");
  fs::create_symlink(folder.path / "way" / "3", folder.path / "2");
  fs::create_symlink("way/../2", folder.path / "1");
  write_bytes(folder.path / "1", "new");
  EXPECT_EQ(text_of(folder.path / "target"), "new");
  EXPECT_TRUE(fs::is_symlink(folder.path / "1") && fs::is_symlink(folder.path / "inner" / "3"));
}

TEST(FileWrite, LinksInACircleAreRefused) {
  TemporaryFolder folder;
  fs::create_symlink("b", folder.path / "a");
  fs::create_symlink("a", folder.path / "b");
  EXPECT_TRUE(says(refusal(folder.path / "a"), "links in a circle"));
  EXPECT_EQ(names_in(folder.path), (Names{"a", "b"}));
}

TEST(FileWrite, ADanglingLinkCreatesItsTarget) {
  TemporaryFolder folder;
  fs::create_symlink("target", folder.path / "link");
  write_bytes(folder.path / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder.path / "link"));
  EXPECT_EQ(text_of(folder.path / "target"), "new");
}

TEST(FileWrite, ADanglingLinkIntoAMissingFolderIsRefused) {
  TemporaryFolder folder;
  fs::create_symlink("missing/target", folder.path / "link");
  EXPECT_TRUE(says(refusal(folder.path / "link"), "link: cannot be written: its folder"));
  EXPECT_TRUE(fs::is_symlink(folder.path / "link"));
}

TEST(FileWrite, ALinkOfAnotherUserInASharedFolderIsRefused) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can make a link of another user";
  TemporaryFolder folder;
  ::chmod(folder.path.c_str(), 01777);
  fs::create_symlink("target", folder.path / "link");
  ASSERT_EQ(::lchown((folder.path / "link").c_str(), other_user, other_user), 0);
  EXPECT_TRUE(says(refusal(folder.path / "link"), "of another user"));
  EXPECT_EQ(names_in(folder.path), Names{"link"});
}

TEST(FileWrite, OnlyTheGivenNameOfAHardLinkChanges) {
  TemporaryFolder folder;
  write_text(folder.path / "a", "old");
  fs::create_hard_link(folder.path / "a", folder.path / "b");
  write_bytes(folder.path / "a", "new");
  EXPECT_EQ(text_of(folder.path / "a"), "new");
  EXPECT_EQ(text_of(folder.path / "b"), "old");
}

// ---- devices ----

TEST(FileWrite, TheNullDeviceStaysADevice) {
  write_bytes("/dev/null", "new");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(FileWrite, AFullDeviceIsAnError) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  EXPECT_TRUE(says(refusal("/dev/full"), "/dev/full: cannot be written: No space left"));
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST(FileWrite, APipeIsWrittenThrough) {
  TemporaryFolder folder;
  const fs::path pipe = folder.path / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::string got;
  std::thread reader([&] { got = text_of(pipe); });
  write_bytes(pipe, std::string(300000, 'x'));
  reader.join();
  EXPECT_EQ(got, std::string(300000, 'x'));
  EXPECT_TRUE(fs::is_fifo(pipe));
}

// A child whose standard output is a descriptor prints, writes /dev/stdout, and prints again.
int print_write_print(int standard_output, const char* name) {
  return in_child([&] {
    ::dup2(standard_output, 1);
    std::printf("before\n");
    write_bytes(name, "bytes\n");
    std::printf("after\n");
    return std::fflush(stdout);
  });
}

TEST(FileWrite, StandardOutputIsWrittenWhereItStands) {
  TemporaryFolder folder;
  const fs::path file = folder.path / "file";
  for (const char* name : {"/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"}) {
    if (!fs::exists(name)) continue;
    const int out = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    EXPECT_EQ(print_write_print(out, name), 0);
    ::close(out);
    EXPECT_EQ(text_of(file), "before\nbytes\nafter\n") << name;
  }
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  EXPECT_EQ(print_write_print(ends[1], "/dev/stdout"), 0);
  ::close(ends[1]);
  char got[64] = {};
  EXPECT_EQ(::read(ends[0], got, sizeof got), 19);
  EXPECT_STREQ(got, "before\nbytes\nafter\n");
  ::close(ends[0]);
}

TEST(FileWrite, AClosedDescriptorIsAnError) {
  EXPECT_EQ(in_child([] {
              ::close(1);
              return says(refusal("/dev/fd/1"), "/dev/fd/1: cannot be written") ? 0 : 1;
            }),
            0);
}

}  // namespace

// Hostile files: each is read or refused with a sentence, in a second, below 512 MB, without a crash.
//
// Every file of the optional corpus is tried in a process of its own, so that a crash names its file and time and
// memory are the file's own. What was read goes on to flatten, pose, scatter and write, as a program would do. The
// second half damages a model made here: truncated at every length, bytes flipped, numbers in the JSON replaced.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <random>

#include "common/mesh_file.h"
#include "gltf/animate.h"
#include "gltf/gltf_write.h"
#include "gltf/skin_write.h"
#include "gltf_support.h"
#include "sound_file.h"

namespace {

using namespace samples;
using namespace hf_gltf;
using namespace samples_test;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

// All that a program does with a model. Every failure must be a sentence.
void use(Model model) {
  const FlatMesh mesh = flatten(model);
  for (const Animation& animation : model.animations) {
    for (const double t : {0.0, 0.3 * clip_duration(animation), 1e9}) posed_positions(model, mesh, animation, t);
  }
  welded_normals(mesh, mesh.positions);
  welded_normals(mesh, mesh.positions, true);
  const std::string bytes = gltf_bytes(model, true);
  read_gltf_bytes({bytes.begin(), bytes.end()}, "again.glb");
  gltf_bytes(bake(model, mesh, mesh.positions), true);
  scatter(model, mesh, mesh.positions);
}

// 0: read and used; 1: refused with a sentence; 2: refused without one.
int outcome_of(const std::function<void()>& work) {
  try {
    work();
    return 0;
  } catch (const std::runtime_error& error) {
    return std::strlen(error.what()) > 10 ? 1 : 2;
  }
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

TEST(Hostile, TheCorpusIsReadOrRefusedInTimeAndMemory) {
  HF_NEED_SHARED_DATA();
  const auto folder = shared_data() / "hostile";
  size_t files = 0, read = 0, refused = 0;
  double slowest = 0;
  long largest = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    const std::string extension = lower(entry.path().extension().string());
    const bool gltf = extension == ".gltf" || extension == ".glb";
    if (!gltf && extension != ".obj" && extension != ".off" && extension != ".ply") continue;
    ++files;
    const auto start = std::chrono::steady_clock::now();
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      int result = 3;
      try {
        result = outcome_of([&] {
          if (gltf) {
            use(read_gltf(entry.path()));
          } else {
            const FlatMesh mesh = to_flat_mesh(read_mesh_file(entry.path()));
            welded_normals(mesh, mesh.positions);
          }
        });
      } catch (...) {
        // anything else than a std::runtime_error
      }
      _exit(result);
    }
    int status = 0;
    rusage usage{};
    ASSERT_EQ(wait4(child, &status, 0, &usage), child);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    ASSERT_TRUE(WIFEXITED(status)) << entry.path() << " ended by signal " << WTERMSIG(status);
    EXPECT_LE(WEXITSTATUS(status), 1) << entry.path();
    EXPECT_LE(seconds, sanitized ? 10.0 : 1.0) << entry.path();
    if (!sanitized) {
      EXPECT_LE(usage.ru_maxrss, 512 * 1024) << entry.path();
    }
    slowest = std::max(slowest, seconds);
    largest = std::max(largest, usage.ru_maxrss);
    ++(WEXITSTATUS(status) == 0 ? read : refused);
  }
  std::printf("%zu files: %zu read, %zu refused; slowest %.3f s, largest %ld MB\n", files, read, refused, slowest,
              largest / 1024);
  EXPECT_GT(files, 600u);
  EXPECT_GT(read, 100u);
  EXPECT_GT(refused, 100u);
}

// What the validator's own corpus says is free of errors must be readable, but for what this reader names in words.
TEST(Hostile, ValidFilesOfTheValidatorCorpusAreRead) {
  HF_NEED_SHARED_DATA();
  const auto folder = shared_data() / "hostile" / "gltf-validator";
  size_t valid = 0, read = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().string();
    const std::string suffix = ".report.json";
    if (name.size() < suffix.size() || name.compare(name.size() - suffix.size(), suffix.size(), suffix) != 0) continue;
    const std::filesystem::path file = name.substr(0, name.size() - suffix.size());
    if (!std::filesystem::is_regular_file(file)) continue;
    std::ifstream in(entry.path());
    const json report = json::parse(in, nullptr, false);
    if (report.is_discarded() || report["issues"].value("numErrors", 1) != 0) continue;
    ++valid;
    const std::string message = message_of([&] { read_gltf(file); });
    if (message.empty()) {
      ++read;
    } else {
      std::printf("valid but refused: %s\n", message.c_str());
    }
  }
  std::printf("%zu of %zu valid files read\n", read, valid);
  EXPECT_GT(valid, 50u);
  EXPECT_GE(read * 10, valid * 9);
}

struct Tally {
  size_t read = 0, refused = 0;
  void count(const std::vector<uint8_t>& bytes) {
    const int outcome = outcome_of([&] { use(read_gltf_bytes(bytes, "damaged.glb")); });
    ASSERT_LE(outcome, 1);
    ++(outcome == 0 ? read : refused);
  }
};

TEST(Hostile, EveryTruncationIsRefused) {
  const std::vector<uint8_t> good = sound_file();
  Tally tally;
  tally.count(good);
  ASSERT_EQ(tally.read, 1u);
  for (size_t length = 0; length < good.size(); ++length) {
    tally.count({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length)});
  }
  EXPECT_EQ(tally.read, 1u);
}

TEST(Hostile, FlippedBytesAreReadOrRefused) {
  const std::vector<uint8_t> good = sound_file();
  std::mt19937 random(11);
  Tally tally;
  for (size_t at = 0; at < good.size(); ++at) {
    std::vector<uint8_t> bad = good;
    bad[at] = static_cast<uint8_t>(bad[at] ^ (1u << (random() % 8)));
    tally.count(bad);
  }
  for (int round = 0; round < 3000; ++round) {
    std::vector<uint8_t> bad = good;
    for (int n = 0; n < 4; ++n) bad[random() % bad.size()] = static_cast<uint8_t>(random());
    tally.count(bad);
  }
  EXPECT_GT(tally.read, 100u);
  EXPECT_GT(tally.refused, 100u);
}

// Walks to the n-th number, string or container of the tree and puts something else in its place.
bool replace_nth(json& value, size_t& n, const json& other) {
  if (n == 0) {
    value = other;
    return true;
  }
  --n;
  if (value.is_structured()) {
    for (auto& child : value) {
      if (replace_nth(child, n, other)) return true;
    }
  }
  return false;
}

TEST(Hostile, EveryValueOfTheJsonReplacedByNonsenseIsReadOrRefused) {
  const std::vector<uint8_t> good = sound_file();
  const size_t text_size = good[12] | static_cast<size_t>(good[13]) << 8 | static_cast<size_t>(good[14]) << 16;
  const json document = json::parse(good.begin() + 20, good.begin() + 20 + static_cast<std::ptrdiff_t>(text_size));
  GlbBuilder b;
  b.binary.assign(good.begin() + 28 + static_cast<std::ptrdiff_t>(text_size), good.end());
  const std::vector<json> nonsense = {nullptr,
                                      true,
                                      -1,
                                      0,
                                      1,
                                      2,
                                      3,
                                      255,
                                      65535,
                                      4294967295u,
                                      9007199254740993u,
                                      18446744073709551615u,
                                      1e308,
                                      -0.5,
                                      1.5,
                                      "",
                                      "x",
                                      "POSITION",
                                      "VEC3",
                                      json::array(),
                                      json::array({json::array()}),
                                      json::object(),
                                      {{"index", 7}},
                                      json::array({0, 0, 0, 0})};
  Tally tally;
  for (const json& other : nonsense) {
    for (size_t n = 0;; ++n) {
      b.document = document;
      size_t left = n;
      if (!replace_nth(b.document, left, other)) break;
      std::vector<uint8_t> bytes;
      if (b.document.is_object()) {
        bytes = b.glb();
      } else {
        const std::string text = b.document.dump();
        bytes.assign(text.begin(), text.end());
      }
      tally.count(bytes);
    }
  }
  std::printf("%zu read, %zu refused\n", tally.read, tally.refused);
  EXPECT_GT(tally.read, 100u);
  EXPECT_GT(tally.refused, 100u);
}

TEST(Hostile, DamagedMeshFilesAreReadOrRefused) {
  SurfaceMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5}};
  mesh.triangles = {0, 1, 2, 0, 2, 3};
  mesh.colors.assign(4, glm::vec4(0.5f, 0.25f, 1, 1));
  mesh.corners.texcoords = {{0, 0}, {1, 0.5}};
  mesh.corners.texcoord_of = {0, 1, 1, 1, 0, 0};
  mesh.corners.normals = {{0, 0, 1}, {0, 1, 0}};
  mesh.corners.normal_of = {0, 0, 0, 1, 1, 1};
  mesh.corners.material_names = {"a", "b"};
  mesh.corners.material_of = {0, 1};
  TemporaryFolder folder;
  std::mt19937 random(17);
  size_t read = 0, refused = 0;
  for (const char* extension : {".obj", ".off", ".ply"}) {
    const auto file = folder.path / (std::string("mesh") + extension);
    write_mesh_file(mesh, file);
    std::ifstream in(file, std::ios::binary);
    const std::string good((std::istreambuf_iterator<char>(in)), {});
    for (int round = 0; round < 4000; ++round) {
      std::vector<uint8_t> bad(good.begin(), good.end());
      for (size_t n = 0; n < 1 + static_cast<size_t>(round) % 4; ++n) {
        bad[random() % bad.size()] =
            static_cast<uint8_t>(round % 2 == 0 ? random() : "0123456789-+.e/ \n"[random() % 17]);
      }
      if (round % 8 == 0) bad.resize(random() % bad.size());
      const int outcome = outcome_of([&] {
        const FlatMesh flat = to_flat_mesh(read_mesh_bytes(bad, extension, "bad"));
        welded_normals(flat, flat.positions);
        gltf_bytes(to_model(read_mesh_bytes(bad, extension, "bad", {}, true), "bad"), true);
      });
      ASSERT_LE(outcome, 1);
      ++(outcome == 0 ? read : refused);
    }
  }
  EXPECT_GT(read, 100u);
  EXPECT_GT(refused, 100u);
}

}  // namespace

// Many transfers in one call, and clips of files without a surface, as a user of hf_transfer meets them.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "gltf/animate.h"
#include "unit/samples/transfer_program_support.h"

namespace {

using namespace transfer_program;

std::vector<json> lines_of(const std::string& said) {
  std::vector<json> out;
  std::istringstream stream(said);
  for (std::string line; std::getline(stream, line);)
    if (!line.empty() && line.front() == '{') out.push_back(json::parse(line));
  std::sort(out.begin(), out.end(), [](const json& a, const json& b) { return a["line"] < b["line"]; });
  return out;
}

// The horse's clips without its surface, as animation libraries come.
hf_gltf::Model skeleton_only() {
  hf_gltf::Model out = hf_gltf::read_gltf(creature("horse"));
  out.meshes.clear();
  for (hf_gltf::Node& node : out.nodes) node.mesh = -1;
  return out;
}

double furthest(const hf_gltf::Model& a, const hf_gltf::Animation& of_a, const hf_gltf::Model& b,
                const hf_gltf::Animation& of_b) {
  const hf_gltf::FlatMesh mesh_a = hf_gltf::flatten(a), mesh_b = hf_gltf::flatten(b);
  double out = 0;
  for (const double time : hf_gltf::frame_times(of_a, 10)) {
    const auto p = hf_gltf::posed_positions(a, mesh_a, of_a, time), q = hf_gltf::posed_positions(b, mesh_b, of_b, time);
    for (size_t v = 0; v < p.size(); ++v) out = std::max(out, glm::distance(p[v], q[v]));
  }
  return out;
}

TEST(TransferBatch, EachLineIsATransferAndAWrongOneStopsNoOther) {
  const fs::path list = folder() / "with blanks.txt", first = folder() / "first one.glb";
  fs::remove(first);
  std::ofstream(list) << "# the horse on the bull\n"
                      << both() << " -o " << quoted(first) << " --pairs " << quoted(pairs("horse_to_bull.json"))
                      << "\n\n"
                      << "absent.glb " << quoted(creature("bull")) << " -o never.glb\n"
                      << both() << " --wrong\n"
                      << both() << " -o " << quoted(folder() / "third.glb") << " --pairs "
                      << quoted(pairs("horse_to_bull.json")) << " --as morph\n";
  std::string said;
  EXPECT_EQ(transfer("--batch " + quoted(list) + " --jobs 2", said), 1) << said;
  const std::vector<json> lines = lines_of(said);
  ASSERT_EQ(lines.size(), 4u) << said;
  EXPECT_EQ(lines[0]["line"], 2);
  EXPECT_EQ(lines[0]["exit"], 0) << lines[0];
  EXPECT_EQ(lines[0]["report"]["clips"][0]["name"], "walk");
  EXPECT_EQ(hf_gltf::read_gltf(first).animations.front().name, "walk (2)");  // the bull has a walk
  EXPECT_EQ(lines[1]["exit"], 1);
  EXPECT_NE(lines[1]["error"].get<std::string>().find("absent.glb"), std::string::npos);
  EXPECT_NE(lines[2]["error"].get<std::string>().find("--wrong"), std::string::npos) << lines[2];
  EXPECT_EQ(lines[3]["report"]["written_as"], "morph");
  // what a line gives is what the same words give alone
  const fs::path alone = folder() / "alone.glb";
  ASSERT_EQ(transfer(both() + " -o " + quoted(alone) + " --pairs " + quoted(pairs("horse_to_bull.json")), said), 0);
  std::ifstream a(first, std::ios::binary), b(alone, std::ios::binary);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(a), {}), std::string(std::istreambuf_iterator<char>(b), {}));
}

TEST(TransferBatch, AWrongListIsNamed) {
  std::string said;
  const fs::path list = folder() / "bad.txt";
  const auto refused = [&](const std::string& text, const std::string& expected) {
    std::ofstream(list) << text;
    EXPECT_EQ(transfer("--batch " + quoted(list), said), 1) << text;
    EXPECT_NE(said.find(expected), std::string::npos) << text << ": " << said;
  };
  refused("", "no line");
  refused("# nothing\n", "no line");
  refused("\xef\xbb\xbf# a byte order mark\n", "no line");
  refused("\xff\xfe# UTF-16\n", "save it as UTF-8");
  refused("a.glb \"b.glb\n", "line 1: a quote is not closed");
  refused("a.glb b.glb\n--batch other.txt\n", "line 2: a list cannot contain --batch");
  EXPECT_EQ(transfer("--batch absent.txt", said), 1);
  EXPECT_NE(said.find("absent.txt"), std::string::npos);
  EXPECT_EQ(transfer("--batch " + quoted(list) + " a.glb", said), 1);
}

// Two workers on this machine; the program of one line kills the worker that started it, once.
TEST(TransferBatch, OnAClusterALineWhoseWorkerDiesRunsAgainElsewhere) {
  std::string python;
  for (const char* candidate : {"python3", "/usr/bin/python3"})
    if (python.empty() && works(std::string(candidate) + " -c \"import distributed\"")) python = candidate;
  if (python.empty()) GTEST_SKIP() << "no python3 with dask.distributed (Debian: python3-distributed)";
  const fs::path list = folder() / "cluster.txt", killed = folder() / "killed.txt", program = folder() / "killing.sh",
                 alone = folder() / "not_on_a_cluster.glb";
  fs::remove(killed);
  std::ofstream(program) << "#!/bin/sh\n"
                         << "case \"$*\" in *deadly*) if [ ! -e " << quoted(killed) << " ]; then\n"
                         << "  echo $PPID > " << quoted(killed) << "; kill -9 $PPID; exit 1\nfi;; esac\n"
                         << "exec " << quoted(HF_TRANSFER_PROGRAM) << " \"$@\"\n";
  fs::permissions(program, fs::perms::owner_all);
  const std::string words = " --pairs " + quoted(pairs("horse_to_bull.json"));
  std::ofstream lines_file(list);
  for (const char* name : {"first", "deadly", "third"}) {
    fs::remove(folder() / (std::string(name) + "_line.glb"));
    lines_file << both() << words << " -o " << quoted(folder() / (std::string(name) + "_line.glb")) << "\n";
  }
  lines_file << "absent.glb " << quoted(creature("bull")) << " -o never.glb\n";
  lines_file.close();
  std::string said;
  EXPECT_EQ(run(python + " " + quoted(fs::path(HF_SOURCE_DIR) / "samples/transfer/batch_dask.py") + " " + quoted(list) +
                    " --program " + quoted(program) + " --workers 2",
                said),
            1)
      << said;
  const std::vector<json> lines = lines_of(said);
  ASSERT_EQ(lines.size(), 4u) << said;
  ASSERT_TRUE(fs::exists(killed)) << "no worker was killed: no test";
  int dead = 0;
  std::ifstream(killed) >> dead;
  ASSERT_EQ(transfer(both() + words + " -o " + quoted(alone), said), 0) << said;
  const auto bytes = [](const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(lines[i]["exit"], 0) << lines[i];
    EXPECT_EQ(lines[i]["report"]["clips"][0]["name"], "walk");
    if (i == 1) {
      EXPECT_NE(lines[i]["worker"], dead) << lines[i];
    }
  }
  EXPECT_EQ(lines[3]["exit"], 1);
  EXPECT_NE(lines[3]["error"].get<std::string>().find("absent.glb"), std::string::npos) << lines[3];
  for (const char* name : {"first_line.glb", "deadly_line.glb", "third_line.glb"})
    EXPECT_TRUE(bytes(folder() / name) == bytes(alone)) << name;
}

TEST(TransferClips, ClipsWithoutASurfaceGoToAModelOfTheirSkeleton) {
  const fs::path clips = folder() / "library.glb", out = folder() / "from_library.glb";
  hf_gltf::Model library = skeleton_only();
  ASSERT_FALSE(library.animations.empty());
  library.animations.front().name = "library walk";
  hf_gltf::write_gltf(library, clips);
  std::string said;
  ASSERT_EQ(transfer(quoted(clips) + " " + quoted(creature("horse")) + " -o " + quoted(out), said), 0) << said;
  const hf_gltf::Model made = hf_gltf::read_gltf(out), horse = hf_gltf::read_gltf(creature("horse"));
  ASSERT_EQ(made.animations.size(), horse.animations.size() + 1);
  EXPECT_EQ(made.animations.front().name, "library walk");
  EXPECT_LT(furthest(made, made.animations.front(), horse, horse.animations.front()), 1e-6);
  // a skeleton of twice the size gives the same motion: translations count from its own rest pose
  for (hf_gltf::Node& node : library.nodes) node.translation *= 2.0f;
  for (hf_gltf::Channel& channel : library.animations.front().channels)
    if (channel.path == hf_gltf::Path::translation)
      for (float& x : channel.values) x *= 2.0f;
  hf_gltf::write_gltf(library, clips);
  ASSERT_EQ(transfer(quoted(clips) + " " + quoted(creature("horse")) + " -o " + quoted(out), said), 0) << said;
  const hf_gltf::Model again = hf_gltf::read_gltf(out);
  EXPECT_LT(furthest(again, again.animations.front(), horse, horse.animations.front()), 1e-4);
  // another skeleton is refused with the numbers, and a sheet needs a surface
  for (hf_gltf::Node& node : library.nodes) node.name += "_other";
  hf_gltf::write_gltf(library, clips);
  EXPECT_EQ(transfer(quoted(clips) + " " + quoted(creature("horse")) + " -o " + quoted(out), said), 1);
  EXPECT_NE(said.find("the skeletons differ"), std::string::npos) << said;
  EXPECT_EQ(transfer(quoted(clips) + " " + quoted(creature("horse")) + " -o " + quoted(out) + " --sheet a.png", said),
            1);
  EXPECT_NE(said.find("no surface"), std::string::npos) << said;
}

TEST(TransferClips, ALibraryMovesAModelThatAnotherBodyFollows) {
  const fs::path clips = folder() / "library_of_horse.glb", out = folder() / "bull_from_library.glb",
                 direct = folder() / "bull_direct.glb";
  hf_gltf::write_gltf(skeleton_only(), clips);
  std::string said;
  const std::string list = " --pairs " + quoted(pairs("horse_to_bull.json")) + " -o ";
  ASSERT_EQ(transfer(both() + list + quoted(direct), said), 0) << said;
  ASSERT_EQ(transfer(both() + " --clips " + quoted(clips) + list + quoted(out), said), 0) << said;
  const hf_gltf::Model a = hf_gltf::read_gltf(direct), b = hf_gltf::read_gltf(out);
  EXPECT_LT(furthest(a, a.animations.front(), b, b.animations.front()), 1e-6);
}

}  // namespace

// The optional shared glTF assets: counts against their README, rest poses, animation, round trips.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "gltf/animate.h"
#include "gltf/gltf_decompress.h"
#include "gltf/gltf_write.h"
#include "gltf_support.h"

namespace {

using namespace hf_gltf;
using namespace samples_test;

struct Row {
  std::string name;
  size_t vertices = 0, triangles = 0, raw = 0, welded = 0, welded_vertices = 0, joints = 0, clips = 0;
};

// | gltf/q_Horse.glb | quadruped rig A | 4400 | 2182 | 1109 -> 1 | 1093 | yes | closed | 50 | 13 | ...
std::vector<Row> read_table() {
  std::ifstream readme(shared_data() / "README.md");
  std::string line;
  std::vector<Row> rows;
  while (std::getline(readme, line)) {
    if (line.compare(0, 7, "| gltf/") != 0) continue;
    std::vector<std::string> cells;
    std::stringstream in(line);
    for (std::string cell; std::getline(in, cell, '|');) cells.push_back(cell);
    Row row;
    row.name = cells.at(1).substr(6, cells[1].size() - 7);
    if (cells.size() < 11) continue;  // a later table of the README, which counts nothing
    if (cells.at(3).find('-') == std::string::npos) {
      row.vertices = std::stoul(cells[3]);
      row.triangles = std::stoul(cells.at(4));
      const size_t arrow = cells.at(5).find("->");
      row.raw = std::stoul(cells[5]);
      row.welded = std::stoul(cells[5].substr(arrow + 2));
      row.welded_vertices = std::stoul(cells.at(6));
      if (cells.at(9).find('-') == std::string::npos) row.joints = std::stoul(cells[9]);
      row.clips = std::stoul(cells.at(10));
    }
    rows.push_back(row);
  }
  return rows;
}

// Positions as stored, without nodes and joints.
std::vector<glm::dvec3> stored_positions(const Model& model, const FlatMesh& mesh) {
  std::vector<glm::dvec3> out;
  for (const FlatPart& part : mesh.parts) {
    for (const glm::vec3& p :
         model.meshes[static_cast<size_t>(part.mesh)].primitives[static_cast<size_t>(part.primitive)].positions) {
      out.emplace_back(p);
    }
  }
  return out;
}

struct Counts {
  size_t raw, welded, vertices;
  bool operator==(const Counts& o) const { return welded == o.welded && vertices == o.vertices; }
};

// Of triangles with three different corners after welding.
Counts count(const FlatMesh& mesh, const std::vector<uint32_t>& welded, uint32_t welded_count) {
  std::vector<uint32_t> corners;
  std::vector<char> used(welded_count, 0);
  for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const uint32_t* v = &mesh.triangles[t];
    const uint32_t a = welded[v[0]], b = welded[v[1]], c = welded[v[2]];
    if (a == b || b == c || c == a) continue;
    corners.insert(corners.end(), v, v + 3);
    used[a] = used[b] = used[c] = 1;
  }
  return {count_components(corners, nullptr, mesh.vertex_count()), count_components(corners, &welded, welded_count),
          static_cast<size_t>(std::count(used.begin(), used.end(), 1))};
}

// The table welds what is stored. At rest the counts are the same, but where two vertices stored at one place follow
// different joints and the rest pose of the nodes is not the pose the mesh was bound in: there they come apart.
TEST(Assets, EveryFileHasTheListedVerticesSeamsJointsAndClips) {
  HF_NEED_SHARED_DATA();
  size_t files = 0, apart = 0;
  for (const Row& row : read_table()) {
    SCOPED_TRACE(row.name);
    const auto file = shared_data() / "gltf" / row.name;
    if (row.name == "pirate.glb") continue;  // its counts are not listed
    const Model model = read_gltf(file);
    const FlatMesh mesh = flatten(model);
    ++files;
    EXPECT_EQ(mesh.vertex_count(), row.vertices);
    EXPECT_EQ(mesh.triangle_count(), row.triangles);
    const Counts listed{row.raw, row.welded, row.welded_vertices};
    const Counts rest = count(mesh, mesh.welded, mesh.welded_count);
    // the table counts pieces as stored with or without the triangles that welding makes degenerate
    const size_t raw = count_components(mesh.triangles, nullptr, mesh.vertex_count());
    EXPECT_TRUE(raw == row.raw || rest.raw == row.raw) << raw << ", " << rest.raw << "; listed " << row.raw;
    if (!(rest == listed)) {
      ++apart;
      std::vector<uint32_t> welded;
      const uint32_t welded_count = weld_positions(stored_positions(model, mesh), welded);
      const Counts stored = count(mesh, welded, welded_count);
      EXPECT_TRUE(stored == listed) << "rest " << rest.raw << " -> " << rest.welded << ", " << rest.vertices
                                    << "; stored " << stored.raw << " -> " << stored.welded << ", " << stored.vertices;
      EXPECT_EQ(rest.welded, listed.welded);
      EXPECT_GT(mesh.welded_count, welded_count);
    }
    if (row.vertices == 0) continue;
    size_t joints = 0;
    for (const Skin& skin : model.skins) joints = std::max(joints, skin.joints.size());
    EXPECT_EQ(joints, row.joints);
    EXPECT_EQ(model.animations.size(), row.clips);
  }
  EXPECT_GE(files, 30u);
  EXPECT_LE(apart, 2u);  // Alpaca and Triceratops
}

double diagonal(const std::vector<glm::dvec3>& p) {
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::dvec3& v : p) {
    low = glm::min(low, v);
    high = glm::max(high, v);
  }
  return glm::distance(low, high);
}

// A limb torn off or a scale applied twice would show as a size or a seam out of proportion.
TEST(Assets, EveryClipKeepsTheBodyInProportion) {
  HF_NEED_SHARED_DATA();
  for (const Row& row : read_table()) {
    if (row.vertices == 0 || row.clips == 0 || row.joints == 0) continue;
    SCOPED_TRACE(row.name);
    const Model model = read_gltf(shared_data() / "gltf" / row.name);
    const FlatMesh mesh = flatten(model);
    const double rest = diagonal(mesh.positions);
    EXPECT_GT(rest, 0.1);
    EXPECT_LT(rest, 1000);
    for (const Animation& animation : model.animations) {
      for (const double part : {0.0, 0.25, 0.5, 1.0}) {
        const auto posed = posed_positions(model, mesh, animation, part * clip_duration(animation));
        for (const glm::dvec3& p : posed) ASSERT_TRUE(std::isfinite(p.x + p.y + p.z));
        const double size = diagonal(posed);
        EXPECT_GT(size, 0.3 * rest) << animation.name;
        EXPECT_LT(size, 3.0 * rest) << animation.name;
        // copies of a vertex stay together wherever the rig binds them alike
        double seam = 0;
        std::vector<uint32_t> first(mesh.welded_count, UINT32_MAX);
        for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
          uint32_t& f = first[mesh.welded[v]];
          if (f == UINT32_MAX) f = v;
          seam = std::max(seam, glm::distance(posed[v], posed[f]));
        }
        EXPECT_LT(seam, 0.05 * rest) << animation.name;
      }
    }
  }
}

void moves_the_same(const Model& model) {
  const FlatMesh mesh = flatten(model);
  const double size = diagonal(mesh.positions);
  for (const bool binary : {true, false}) {
    const std::string bytes = gltf_bytes(model, binary);
    const Model back = read_gltf_bytes({bytes.begin(), bytes.end()}, "back");
    const FlatMesh again = flatten(back);
    EXPECT_EQ(again.triangles, mesh.triangles);
    EXPECT_EQ(again.welded_count, mesh.welded_count);
    ASSERT_EQ(back.animations.size(), model.animations.size());
    for (size_t a = 0; a < model.animations.size(); ++a) {
      const double t = 0.37 * clip_duration(model.animations[a]);
      const auto p = posed_positions(model, mesh, model.animations[a], t);
      const auto q = posed_positions(back, again, back.animations[a], t);
      for (size_t v = 0; v < p.size(); ++v) ASSERT_LT(glm::distance(p[v], q[v]), 1e-5 * size);
    }
  }
}

TEST(Assets, WrittenAndReadAgainTheyMoveTheSame) {
  HF_NEED_SHARED_DATA();
  for (const auto& entry : std::filesystem::directory_iterator(shared_data() / "gltf")) {
    if (entry.path().filename() == "pirate.glb" && !has_meshopt()) continue;
    SCOPED_TRACE(entry.path().filename());
    moves_the_same(read_gltf(entry.path()));
  }
}

TEST(Assets, GivenModelsMoveTheSameOrAreRefusedInASentence) {
  if (given_models().empty()) GTEST_SKIP() << "no folder of models is given (HF_GLTF_FOLDER)";
  size_t refused = 0;
  for (const std::filesystem::path& file : given_models()) {
    SCOPED_TRACE(file);
    try {
      moves_the_same(read_gltf(file));
    } catch (const std::runtime_error& error) {
      std::printf("refused: %s\n", error.what());
      ++refused;
    }
  }
  std::printf("%zu models, %zu of them refused\n", given_models().size(), refused);
}

TEST(Assets, TheMeshoptCompressedPirateIsReadOrItsPackageNamed) {
  HF_NEED_SHARED_DATA();
  const auto file = shared_data() / "gltf" / "pirate.glb";
  if (!has_meshopt()) {
    EXPECT_NE(message_of([&] { read_gltf(file); }).find("libmeshoptimizer-dev"), std::string::npos);
    return;
  }
  const FlatMesh mesh = flatten(read_gltf(file));
  EXPECT_GT(mesh.triangle_count(), 1000u);
  EXPECT_LT(mesh.welded_count, mesh.vertex_count());
}

TEST(Assets, TheSparseCubeMovesAsItsMorphTargetSays) {
  HF_NEED_SHARED_DATA();
  const Model model = read_gltf(shared_data() / "gltf" / "singleBlendshapeCube_sparse.glb");
  const Primitive& primitive = model.meshes.at(0).primitives.at(0);
  ASSERT_EQ(primitive.targets.size(), 1u);
  size_t moved = 0;
  for (const glm::vec3& d : primitive.targets[0].positions) moved += d != glm::vec3(0);
  EXPECT_GT(moved, 0u);
  EXPECT_LT(moved, primitive.positions.size());
}

}  // namespace

// Surfaces far from 0: files hold positions as floats, so a node stands there and the positions are small.
#include <gtest/gtest.h>

#include "common/mesh_file.h"
#include "gltf/animate.h"
#include "gltf/gltf_read.h"
#include "gltf/gltf_write.h"
#include "gltf/skin_write.h"
#include "gltf_support.h"

namespace samples {
namespace {

// A rock of some 20 units, with all digits of a double.
SurfaceMesh rock(const glm::dvec3& at) {
  SurfaceMesh mesh;
  constexpr uint32_t rows = 12, columns = 17;
  for (uint32_t r = 0; r < rows; ++r)
    for (uint32_t c = 0; c < columns; ++c) {
      const double a = 0.37 * r, b = 0.41 * c;
      mesh.positions.push_back(at +
                               glm::dvec3(10 * std::cos(a) + std::sin(b), 9 * std::sin(a + b), 8 * std::cos(b) / 3));
      if (r + 1 == rows || c + 1 == columns) continue;
      const uint32_t v = r * columns + c;
      mesh.triangles.insert(mesh.triangles.end(), {v, v + 1, v + columns, v + 1, v + columns + 1, v + columns});
    }
  return mesh;
}

double farthest(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  double out = a.size() == b.size() ? 0 : 1e300;
  for (size_t v = 0; v < a.size() && v < b.size(); ++v) out = std::max(out, glm::distance(a[v], b[v]));
  return out;
}

const glm::dvec3 on_earth(-2487001.29, -4684680.17, 3529644.7);

TEST(FarFromZero, AFileKeepsTheDigitsOfASurface) {
  const samples_test::TemporaryFolder folder;
  const SurfaceMesh mesh = rock(on_earth);
  for (const char* name : {"rock.glb", "rock.gltf"}) {
    write_mesh_file(mesh, folder.path / name);
    const SurfaceMesh back = read_mesh_file(folder.path / name);
    EXPECT_LT(farthest(back.positions, mesh.positions), 1e-6) << name;
    const Model model = read_gltf(folder.path / name);
    for (const glm::vec3& p : model.meshes[0].primitives[0].positions) EXPECT_LT(glm::length(p), 30) << name;
  }
}

TEST(FarFromZero, AFileNearZeroOrOfFloatsHasNoOffset) {
  SurfaceMesh mesh = rock({0.1, 20, 0.3});
  EXPECT_EQ(make_model("near", mesh.positions, mesh.triangles).nodes[0].translation, glm::dvec3(0));
  mesh = rock(on_earth);
  for (glm::dvec3& p : mesh.positions) p = float_rounded(p);
  const Model floats = make_model("floats", mesh.positions, mesh.triangles);
  EXPECT_EQ(floats.nodes[0].translation, glm::dvec3(0));
  EXPECT_EQ(flatten(floats).positions, mesh.positions);
}

// A file of another program: the node has its place with all digits, as a translation or in a matrix.
TEST(FarFromZero, APlaceOfANodeIsReadAndWrittenInDouble) {
  const SurfaceMesh mesh = rock(glm::dvec3(0));
  Model model = make_model("rock", mesh.positions, mesh.triangles);
  for (const bool matrix : {false, true}) {
    model.nodes[0].translation = on_earth;
    if (matrix) {
      model.nodes[0].matrix = glm::dmat4(1);
      (*model.nodes[0].matrix)[3] = glm::dvec4(on_earth, 1);
    }
    const std::string bytes = gltf_bytes(model, true);
    const Model back = read_gltf_bytes({bytes.begin(), bytes.end()}, "back.glb");
    EXPECT_EQ(flatten(back).positions, flatten(model).positions) << matrix;
    EXPECT_LT(farthest(flatten(back).positions, rock(on_earth).positions), 1e-6) << matrix;
  }
}

TEST(FarFromZero, NewPlacesStillModelsAndLinesKeepTheirDigits) {
  const SurfaceMesh mesh = rock(on_earth), moved = rock(on_earth + glm::dvec3(3, 2, 1));
  Model model = make_model("rock", mesh.positions, mesh.triangles);
  const FlatMesh flat = flatten(model);
  EXPECT_LT(farthest(flatten(bake(model, flat, moved.positions)).positions, moved.positions), 1e-6);
  add_lines(model, "lines", {mesh.positions[0], mesh.positions[1]}, glm::vec4(1));
  const glm::dvec3 end = model.nodes[1].translation + glm::dvec3(model.meshes[1].primitives[0].positions[1]);
  EXPECT_LT(glm::distance(end, mesh.positions[1]), 1e-6);
  scatter(model, flat, moved.positions);
  EXPECT_LT(farthest(flatten(model).positions, moved.positions), 1e-6);
}

// One joint turns a half of the rock about a place on it.
TEST(FarFromZero, ANewSkinKeepsTheDigitsOfItsClip) {
  const SurfaceMesh mesh = rock(on_earth);
  const Model model = make_model("rock", mesh.positions, mesh.triangles);
  const FlatMesh flat = flatten(model);
  SkinDescription skin;
  skin.joints = {{"still", mesh.positions[0]}, {"turns", mesh.positions[100]}};
  skin.influences_per_vertex = 1;
  for (size_t v = 0; v < flat.positions.size(); ++v) {
    skin.vertex_joints.push_back(v < 90 ? 0 : 1);
    skin.vertex_weights.push_back(1);
  }
  const glm::dquat turn = glm::angleAxis(0.7, glm::dvec3(0.6, 0, 0.8));
  SkinClip clip;
  clip.times = {0, 1};
  for (const double share : {0.0, 1.0}) {
    const glm::dquat now = share > 0 ? turn : glm::dquat(1, 0, 0, 0);
    clip.rotations.insert(clip.rotations.end(), {glm::dquat(1, 0, 0, 0), now});
    clip.translations.insert(clip.translations.end(), {glm::dvec3(0), mesh.positions[100] - now * mesh.positions[100]});
  }
  skin.clips = {clip};
  const std::string bytes = gltf_bytes(skin_model(model, flat, skin), true);
  const Model back = read_gltf_bytes({bytes.begin(), bytes.end()}, "back.glb");
  const FlatMesh again = flatten(back);
  EXPECT_LT(farthest(again.positions, mesh.positions), 1e-5);
  std::vector<glm::dvec3> wanted = mesh.positions;
  for (size_t v = 90; v < wanted.size(); ++v)
    wanted[v] = mesh.positions[100] + turn * (wanted[v] - mesh.positions[100]);
  EXPECT_LT(farthest(posed_positions(back, again, back.animations[0], 1), wanted), 1e-5);
}

}  // namespace
}  // namespace samples

// hf_convert run as a user runs it: what arrives in each format, and what the line says of it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "common/mesh_file.h"
#include "gltf/file_bytes.h"
#include "gltf/flat_mesh.h"
#include "gltf/gltf_read.h"
#include "gltf/gltf_write.h"
#include "support/program_support.h"
#include "unit/gltf/gltf_support.h"

namespace {

namespace fs = std::filesystem;
using namespace samples;
using samples_test::TemporaryFolder;

class ConvertProgram : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path / name).string(); }
  int convert(const std::string& in, const std::string& out) {
    return hf_test::run(
        hf_test::quoted(HF_CONVERT_PROGRAM) + " " + hf_test::quoted(path(in)) + " " + hf_test::quoted(path(out)),
        said_);
  }
  void expect_said(const std::string& words) { EXPECT_NE(said_.find(words), std::string::npos) << said_; }

  // A square of two groups with a lid: a quad and two triangles.
  void write_obj() {
    std::ofstream(path("a.obj")) << "mtllib a.mtl\n"
                                    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.1 0.2 1\nv 9 9 9\nvt 0 0\n"
                                    "g floor\nusemtl grey\nf 1/1 2/1 3/1 4/1\ng lid\nf 1 2 5\nf 2 3 5\n";
  }

  const TemporaryFolder folder_;
  std::string said_;
};

TEST_F(ConvertProgram, EveryFormatHoldsTheTrianglesInTheirOrder) {
  write_obj();
  const SurfaceMesh from = read_mesh_file(path("a.obj"));
  for (const char* name : {"a.ply", "a.off", "b.obj", "a.stl", "a.glb", "a.GLTF"}) {
    ASSERT_EQ(convert("a.obj", name), 0) << said_;
    EXPECT_EQ(std::count(said_.begin(), said_.end(), '\n'), 1) << said_;
    const SurfaceMesh to = read_mesh_file(path(name));
    ASSERT_EQ(to.triangles.size(), from.triangles.size()) << name;
    for (size_t i = 0; i < from.triangles.size(); ++i)
      EXPECT_EQ(glm::vec3(to.positions[to.triangles[i]]), glm::vec3(from.positions[from.triangles[i]])) << name;
  }
}

TEST_F(ConvertProgram, SaysWhatAFormatKeepsAndLoses) {
  write_obj();
  ASSERT_EQ(convert("a.obj", "a.ply"), 0);
  expect_said("a.ply: kept 6 vertices, 3 faces, 1 polygon, ");
  expect_said("lost 2 groups, 1 texture coordinate, 1 material\n");
  ASSERT_EQ(convert("a.obj", "a.stl"), 0);
  expect_said(
      "lost 6 vertices (only their corners stay), 1 polygon (cut into triangles), 2 groups, 1 texture coordinate, 1 "
      "material, 1 isolated vertex, digits of positions beyond float");
  ASSERT_EQ(convert("a.ply", "b.ply"), 0);
  expect_said("lost nothing");
  std::ofstream(path("c.ply")) << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                                  "property float z\nproperty float quality\nelement face 1\n"
                                  "property list uchar int vertex_indices\nelement tail 1\nproperty int n\nend_header\n"
                                  "0 0 0 7\n1 0 0 7\n0 1 0 7\n3 0 1 2\n4\n";
  ASSERT_EQ(convert("c.ply", "c.off"), 0);
  expect_said("lost \"quality\" of vertex, \"n\" of tail");
  std::ofstream(path("d.off")) << "STOFF\n3 1 0\n0 0 0 0 0\n1 0 0 0 0\n0 1 0 0 0\n3 0 1 2 255 0 0\n";
  ASSERT_EQ(convert("d.off", "d.obj"), 0);
  expect_said("lost texture coordinates, colours of faces");
}

Model bone_model() {
  Model model = make_model("bone", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2});
  model.nodes.emplace_back();
  model.nodes.back().name = "bone";
  model.scene_roots.push_back(1);
  Skin skin;
  skin.joints = {1};
  skin.inverse_bind.emplace_back(1.0f);
  model.skins.push_back(skin);
  model.nodes[0].skin = 0;
  Influences one;
  one.weights[0] = 1;
  model.meshes[0].primitives[0].influences.assign(3, one);
  Channel turn;
  turn.node = 1;
  turn.times = {0, 1};
  turn.values = {0, 0, 0, 0, 2, 0};
  Animation clip;
  clip.name = "up";
  clip.channels.push_back(turn);
  model.animations.push_back(clip);
  return model;
}

TEST_F(ConvertProgram, AModelKeepsItsSkinAndClips) {
  write_gltf(bone_model(), path("a.glb"));
  ASSERT_EQ(convert("a.glb", "b.gltf"), 0) << said_;
  expect_said("1 skin, 1 joint, 1 clip");
  expect_said("lost nothing");
  ASSERT_EQ(convert("b.gltf", "c.glb"), 0) << said_;
  EXPECT_EQ(read_bytes(path("a.glb"), 1 << 20), read_bytes(path("c.glb"), 1 << 20));
  ASSERT_EQ(convert("a.glb", "a.obj"), 0) << said_;
  expect_said("lost 2 nodes, 1 skin, 1 joint, 1 clip");
}

TEST_F(ConvertProgram, AMeshOfTwoNodesCountsTwiceWhereItIsWrittenTwice) {
  Model model = make_model("twin", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2});
  model.nodes.push_back(model.nodes[0]);
  model.nodes[1].translation = {0, 0, 3};
  model.scene_roots.push_back(1);
  write_gltf(model, path("a.glb"));
  ASSERT_EQ(convert("a.glb", "b.glb"), 0) << said_;
  expect_said("kept 3 vertices, 1 triangle, 3 normals");
  ASSERT_EQ(convert("a.glb", "b.ply"), 0) << said_;
  expect_said("kept 6 vertices, 2 triangles, 6 normals; lost 2 nodes");
  ASSERT_EQ(convert("a.glb", "b.stl"), 0) << said_;
  expect_said("kept 2 triangles; lost 6 vertices (only their corners stay), 6 normals, 2 nodes");
}

TEST_F(ConvertProgram, NamesImagesAndNormalsOfCorners) {
  const std::string pixel =
      "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg==";
  write_gltf(make_model("plain", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2}), path("plain.gltf"));
  const std::vector<uint8_t> bytes = read_bytes(path("plain.gltf"), 1 << 20);
  std::string text(bytes.begin(), bytes.end());
  text.insert(text.find('{') + 1, "\"images\":[{\"uri\":\"data:image/png;base64," + pixel + "\"}],");
  std::ofstream(path("seen.gltf")) << text;
  ASSERT_EQ(convert("seen.gltf", "seen.glb"), 0) << said_;
  expect_said("1 image");
  ASSERT_EQ(convert("seen.gltf", "seen.obj"), 0) << said_;
  expect_said("1 image");
  std::ofstream(path("n.obj")) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n";
  ASSERT_EQ(convert("n.obj", "n.glb"), 0) << said_;
  expect_said("3 normals; lost nothing");
}

// A roof of two faces that meet at an edge: its vertices have two normals and two texture coordinates.
const char roof[] =
    "v 0 0 0\nv 0 0 1\nv -1 -1 0\nv 1 -1 0\nvt 0 0\nvt 1 0\nvt 0 0.25\nvt 0 0\nvn -1 1 0\nvn 1 1 0\n"
    "f 1/1/1 3/2/1 2/3/1\nf 2/2/2 4/1/2 1/3/2\n";

TEST_F(ConvertProgram, CornersOfAnObjBecomeVerticesOfTheirOwnInGltf) {
  std::ofstream(path("a.obj")) << roof;
  ASSERT_EQ(convert("a.obj", "a.glb"), 0) << said_;
  expect_said("2 normals of corners, 4 texture coordinates; lost nothing");
  const Model model = read_gltf(path("a.glb"));
  const Primitive& part = model.meshes[0].primitives[0];
  ASSERT_EQ(part.positions.size(), 6u) << "four vertices, and copies of two behind them";
  ASSERT_EQ(part.texcoords.size(), 1u);
  EXPECT_EQ(part.indices, (std::vector<uint32_t>{0, 2, 1, 4, 3, 5}));
  EXPECT_EQ(part.texcoords[0][1], glm::vec2(0, 0.75f)) << "glTF counts down";
  EXPECT_EQ(part.texcoords[0][4], glm::vec2(1, 1));
  EXPECT_GT(part.normals[4].x, 0.7f);
  EXPECT_LT(part.normals[1].x, -0.7f);
  const FlatMesh flat = flatten(model);
  EXPECT_EQ(flat.welded_count, 4u) << "the surface stays one";
  EXPECT_EQ(read_mesh_file(path("a.obj")).positions.size(), 4u) << "other programs number the vertices of the file";
  // back, and once more the same
  ASSERT_EQ(convert("a.obj", "b.obj"), 0) << said_;
  expect_said("lost nothing");
  const std::vector<uint8_t> bytes = read_bytes(path("b.obj"), 1 << 20);
  EXPECT_EQ(std::string(bytes.begin(), bytes.end()), roof);
  ASSERT_EQ(convert("a.glb", "c.obj"), 0) << said_;
  expect_said("6 normals, 1 set of texture coordinates; lost 1 node\n");
  ASSERT_EQ(convert("c.obj", "c.glb"), 0) << said_;
  const Model back = read_gltf(path("c.glb"));
  EXPECT_EQ(back.meshes[0].primitives[0].texcoords, part.texcoords);
  EXPECT_EQ(back.meshes[0].primitives[0].normals, part.normals);
}

TEST_F(ConvertProgram, AQuadKeepsTheTextureCoordinatesOfItsCorners) {
  std::ofstream(path("a.obj")) << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt nan 1\n"
                                  "f 1/1 2/2 3/3 4/4\nf 4 3 2\n";
  ASSERT_EQ(convert("a.obj", "a.glb"), 0) << said_;
  expect_said("warning: 1 corners have a texture coordinate or normal that is zero or not finite");
  const Model model = read_gltf(path("a.glb"));
  const Primitive& part = model.meshes[0].primitives[0];
  ASSERT_EQ(part.indices.size(), 9u);
  ASSERT_EQ(part.texcoords.size(), 1u);
  for (size_t i = 0; i < 6; ++i) {
    const uint32_t v = part.indices[i];
    const glm::vec3& p = part.positions[v];
    if (v == 3) continue;
    EXPECT_EQ(part.texcoords[0][v], glm::vec2(p.x, 1 - p.y));
  }
}

TEST_F(ConvertProgram, MaterialsOfAnObjCarryTheirColourAndImage) {
  const std::string pixel =
      "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg==";
  std::vector<uint8_t> image;
  std::string type;
  ASSERT_TRUE(decode_data_uri("data:image/png;base64," + pixel, image, type));
  std::ofstream(path("skin of a cat.png"), std::ios::binary)
      .write(reinterpret_cast<const char*>(image.data()), static_cast<std::streamsize>(image.size()));
  std::ofstream(path("a.mtl")) << "newmtl red\nKd 1 0.25 0\nd 0.5\nPr 0.75\nnewmtl cat\nKd 0 0 0\n"
                                  "map_Kd skin of a cat.png\nnewmtl other\nmap_Kd ../out.png\n";
  std::ofstream(path("a.obj")) << "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 9 9 9\nvt 0 0\n"
                                  "usemtl cat\nf 1/1 2/1 3/1\nusemtl red\nf 1 3 4\nusemtl cat\nf 4/1 3/1 2/1\n";
  const auto expect_looks = [](const Model& model) {
    ASSERT_EQ(model.materials.size(), 2u);
    EXPECT_EQ(model.materials[0].name, "cat");
    EXPECT_EQ(model.materials[0].base_color, glm::vec4(1)) << "the image has the colour";
    EXPECT_EQ(model.materials[1].base_color, glm::vec4(1, 0.25f, 0, 0.5f));
    EXPECT_EQ(model.materials[1].roughness, 0.75f);
    EXPECT_EQ(model.materials[1].metallic, 0);
    const std::vector<Primitive>& parts = model.meshes[0].primitives;
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_EQ(parts[0].material, 0);
    EXPECT_EQ(parts[0].indices.size(), 6u);
    EXPECT_EQ(parts[1].material, 1);
    EXPECT_EQ(image_count(model), 1u);
  };
  ASSERT_EQ(convert("a.obj", "a.glb"), 0) << said_;
  expect_said("2 materials, 1 isolated vertex, 1 image; lost nothing");
  expect_looks(read_gltf(path("a.glb")));
  ASSERT_EQ(convert("a.glb", "b.obj"), 0) << said_;
  expect_said("2 materials, 1 image, ");
  EXPECT_EQ(read_bytes(path("b_0.png"), 1 << 20), image);
  ASSERT_EQ(convert("b.obj", "b.glb"), 0) << said_;
  expect_looks(read_gltf(path("b.glb")));
  // names in files lead nowhere else, and what is not there is said
  std::ofstream(path("a.mtl")) << "newmtl cat\nmap_Kd ../out.png\n";
  ASSERT_EQ(convert("a.obj", "c.glb"), 0) << said_;
  expect_said("warning: the image ../out.png is not read: ");
  expect_said("warning: materials that no .mtl file describes: 1");
}

// JSON holds no byte of Latin-1.
TEST_F(ConvertProgram, NamesOfMaterialsInLatin1AreRead) {
  std::ofstream(path("a.mtl")) << "newmtl m\xfc\nKd 0.5 0 0\n";
  std::ofstream(path("a.obj")) << "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\xfc\nf 1 2 3\n";
  ASSERT_EQ(convert("a.obj", "a.glb"), 0) << said_;
  const Model model = read_gltf(path("a.glb"));
  ASSERT_EQ(model.materials.size(), 1u);
  EXPECT_EQ(model.materials[0].name, "m\xc3\xbc");
  EXPECT_EQ(model.materials[0].base_color.r, 0.5f);
}

// It wrote a .glb of 132 bytes and said that nothing was lost.
TEST_F(ConvertProgram, RefusesAFileWithoutASurface) {
  for (const char* text : {"", "# nothing\n", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "v 0 0 0\nf 1 1\n"}) {
    std::ofstream(path("a.obj")) << text;
    EXPECT_EQ(convert("a.obj", "a.glb"), 1) << text;
    expect_said(text[0] == 'v' ? "a.obj has no face, so" : "a.obj has no vertex, so");
    EXPECT_FALSE(fs::exists(path("a.glb")));
  }
  std::ofstream(path("points.off")) << "OFF\n1 0 0\n1 2 3\n";
  EXPECT_EQ(convert("points.off", "points.ply"), 0) << "a cloud of points stays one";
  EXPECT_EQ(convert("points.off", "points.stl"), 1);
}

TEST_F(ConvertProgram, AnAvatarStaysOneAndNothingElseBecomesOne) {
  Model model = bone_model();
  write_gltf(model, path("plain.glb"));
  EXPECT_EQ(convert("plain.glb", "plain.vrm"), 1);
  expect_said("plain.vrm: the model has no humanoid map");
  EXPECT_FALSE(fs::exists(path("plain.vrm")));
  for (const std::string extension : {R"({"VRM":{"humanoid":{"humanBones":[{"bone":"hips","node":1}]}}})",
                                      R"({"VRMC_vrm":{"humanoid":{"humanBones":{"hips":{"node":1}}}}})"}) {
    model.carried.extensions = extension;
    write_gltf(model, path("a.vrm"));
    ASSERT_EQ(convert("a.vrm", "b.vrm"), 0) << said_;
    EXPECT_EQ(read_gltf(path("b.vrm")).carried.extensions, extension);
  }
}

TEST_F(ConvertProgram, RefusesWhatItDoesNotWriteOrRead) {
  write_obj();
  EXPECT_EQ(convert("a.obj", "a.fbx"), 1);
  expect_said("a.fbx: the format is not written; .gltf");
  EXPECT_EQ(convert("none.obj", "a.ply"), 1);
  expect_said("none.obj");
  EXPECT_FALSE(fs::exists(path("a.ply")));
  Model joints = bone_model();
  joints.meshes.clear();
  joints.nodes[0].mesh = joints.nodes[0].skin = -1;
  write_gltf(joints, path("joints.glb"));
  EXPECT_EQ(convert("joints.glb", "joints.stl"), 1);
  expect_said("joints.glb has no triangles");
  EXPECT_EQ(hf_test::run(hf_test::quoted(HF_CONVERT_PROGRAM) + " " + path("a.obj"), said_), 1);
  expect_said("name a file to write");
}

}  // namespace

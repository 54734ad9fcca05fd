// Kinds of files by their content, .stl, and what is said about formats that are not read.
#include "gltf/file_kind.h"

#include <gtest/gtest.h>

#include <cstring>

#include "common/mesh_file.h"
#include "gltf/foreign_file.h"
#include "gltf_support.h"

namespace samples {
namespace {

using samples_test::message_of;

FileKind kind(const std::string& text, const std::string& name = "a.dat") {
  return kind_of(reinterpret_cast<const uint8_t*>(text.data()), text.size(), text.size(), name);
}

SurfaceMesh read(const std::string& text, const std::string& extension) {
  return read_mesh_bytes({text.begin(), text.end()}, extension, "a" + extension);
}

// A box of 12 triangles, some corners at -0.
const float corners[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
const uint32_t box[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                             {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};

std::string binary_stl(const char* header, size_t triangles = 12) {
  std::string out(80, ' ');
  out.replace(0, std::strlen(header), header);
  const auto put = [&](const void* bytes, size_t count) { out.append(static_cast<const char*>(bytes), count); };
  const auto count = static_cast<uint32_t>(triangles);
  put(&count, 4);
  for (const auto& triangle : box) {
    const float normal[3] = {0, 0, 0};
    put(normal, 12);
    for (const uint32_t v : triangle)
      for (const float x : corners[v]) {
        const float signed_zero = x == 0 && v % 2 ? -0.0f : x;
        put(&signed_zero, 4);
      }
    out.append(2, '\0');
  }
  return out;
}

std::string text_stl() {
  std::string out = "solid a box\n";
  for (const auto& triangle : box) {
    out += " facet normal 0 0 0\n  outer loop\n";
    for (const uint32_t v : triangle) {
      out += "   vertex";
      for (const float x : corners[v]) out += " " + std::to_string(x);
      out += "\n";
    }
    out += "  endloop\n endfacet\n";
  }
  return out + "endsolid a box\n";
}

TEST(FileKinds, TheFirstBytesTellAndTheEndingWhereTheyDoNot) {
  EXPECT_EQ(kind("glTF....", "a.vrm"), FileKind::gltf);
  EXPECT_EQ(kind("\xef\xbb\xbf {\"asset\"", "a.obj"), FileKind::gltf);
  EXPECT_EQ(kind("# made by hand\n\nv 0 0 0\n", "a.glb"), FileKind::obj);
  EXPECT_EQ(kind("ply\nformat ascii 1.0\n", "a.obj"), FileKind::ply);
  EXPECT_EQ(kind("COFF\n3 1 0\n"), FileKind::off);
  EXPECT_EQ(kind("3 1 0\n0 0 0\n", "a.OFF"), FileKind::off);
  EXPECT_EQ(kind(text_stl(), "a.obj"), FileKind::stl);
  EXPECT_EQ(kind(binary_stl("solid, and yet binary"), "a"), FileKind::stl);
  EXPECT_EQ(kind("Kaydara FBX Binary  ", "a.glb"), FileKind::fbx);
  EXPECT_EQ(kind("; FBX 7.3.0 project file\n"), FileKind::fbx);
  EXPECT_EQ(kind("HIERARCHY\nROOT Hips\n"), FileKind::bvh);
  EXPECT_EQ(kind("<?xml version=\"1.0\"?>\n<COLLADA xmlns"), FileKind::dae);
  EXPECT_EQ(kind("", "a.Vrm"), FileKind::gltf);
  EXPECT_EQ(kind("what is this", "a"), FileKind::unknown);
}

TEST(FileKinds, WhatShouldBeGltfAndIsNotIsNamed) {
  const auto gltf = [](const std::string& text, const char* name) {
    return message_of([&] { read_gltf_bytes({text.begin(), text.end()}, name); });
  };
  EXPECT_EQ(gltf("v 0 0 0\nv 1 0 0\n", "a.obj"), "a.obj is OBJ; a model is needed here (" + model_endings("or") + ")");
  const std::string by_blender = "open it in Blender (File > Import) and export it as glTF 2.0 (.glb)";
  EXPECT_EQ(gltf("#usda 1.0\n", "a.usda"),
            "a.usda is USD; a model is needed here (" + model_endings("or") + "): " + by_blender);
  EXPECT_EQ(message_of([] { read("BLENDER", ".blend"); }),
            "a.blend is a Blender file, which is not read; .obj, .off, .ply, .stl, " + model_endings("and") +
                " are: export it from Blender as glTF 2.0 (.glb)");
  EXPECT_EQ(message_of([] { read("what is this", ".xyz"); }),
            "a.xyz is of no known format; .obj, .off, .ply, .stl, " + model_endings("and") + " are read");
  EXPECT_EQ(model_endings("and"),
            reads_foreign(FileKind::fbx) ? ".gltf, .glb, .vrm, .fbx, .dae and .bvh" : ".gltf, .glb and .vrm");
  // FBX, COLLADA and BVH are models where the build has assimp
  for (const FileKind kind : {FileKind::fbx, FileKind::dae, FileKind::bvh})
    EXPECT_EQ(is_model(kind), reads_foreign(kind));
  EXPECT_TRUE(is_model(FileKind::gltf));
  EXPECT_FALSE(is_model(FileKind::usd));
  const std::string said = gltf("Kaydara FBX Binary  ", "a.fbx");
  if (reads_foreign(FileKind::fbx))
    EXPECT_EQ(said.find("a.fbx: is not accepted by assimp: "), 0u) << said;
  else
    EXPECT_EQ(said,
              "a.fbx is FBX; a model is needed here (.gltf, .glb or .vrm): this build has no reader of FBX; build "
              "with HF_WITH_ASSIMP=ON (Debian: libassimp-dev), or " +
                  by_blender);
  EXPECT_NE(said.find(by_blender), std::string::npos);
}

// The content is read whatever the ending says.
TEST(FileKinds, AFileWithAWrongEndingIsRead) {
  const samples_test::TemporaryFolder folder;
  SurfaceMesh mesh = read(text_stl(), ".stl");
  write_mesh_file(mesh, folder.path / "a.glb");
  write_mesh_file(mesh, folder.path / "a.ply");
  for (const char* name : {"b.vrm", "b.obj"}) {
    std::filesystem::copy_file(folder.path / "a.glb", folder.path / name);
    EXPECT_EQ(read_mesh_file(folder.path / name).triangles, mesh.triangles) << name;
  }
  std::filesystem::rename(folder.path / "a.ply", folder.path / "c.off");
  EXPECT_EQ(read_mesh_file(folder.path / "c.off").positions, mesh.positions);
}

TEST(FileKinds, StlIsReadAndItsCornersAreJoined) {
  for (const std::string& text : {binary_stl("a box"), binary_stl("solid a box"), text_stl()}) {
    const SurfaceMesh mesh = read(text, ".stl");
    ASSERT_EQ(mesh.positions.size(), 8u);
    ASSERT_EQ(mesh.triangles.size(), 36u);
    for (size_t i = 0; i < 36; ++i)
      for (int c = 0; c < 3; ++c)
        EXPECT_EQ(mesh.positions[mesh.triangles[i]][c], static_cast<double>(corners[box[i / 3][i % 3]][c]));
    EXPECT_EQ(mesh.triangles[0], 0u);
  }
}

TEST(FileKinds, ADamagedStlIsRefused) {
  EXPECT_NE(message_of([] { read(binary_stl("a box", 13), ".stl"); }).find("says 13 triangles, but the file holds 12"),
            std::string::npos);
  EXPECT_NE(message_of([] { read(binary_stl("a box", 0xFFFFFFFF), ".stl"); }).find("cut off"), std::string::npos);
  EXPECT_NE(message_of([] { read("short", ".stl"); }).find("84 bytes"), std::string::npos);
  const std::string text = text_stl();
  EXPECT_NE(message_of([&] { read(text.substr(0, text.find("endloop")), ".stl"); }).find("cut off"), std::string::npos);
  for (const char* bad : {"solid\nfacet\nvertex 0 0 0\n", "solid\nfacet\nouter loop\nvertex 0 nothing 0\n",
                          "solid\nfacet\nendloop\n", "solid\nfacet\nwhat\n"})
    EXPECT_THROW(read(bad, ".stl"), std::runtime_error) << bad;
  std::string infinite = binary_stl("a box");
  const float huge = std::numeric_limits<float>::infinity();
  std::memcpy(infinite.data() + 84 + 12, &huge, 4);
  EXPECT_THROW(read(infinite, ".stl"), std::runtime_error);
}

TEST(FileKinds, AGltfWithoutIndicesIsRead) {
  samples_test::GlbBuilder b;
  b.triangle_mesh({{"POSITION", b.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0}, "VEC3")}});
  const Model model = read_gltf_bytes(b.glb(), "a.glb");
  EXPECT_EQ(model.meshes[0].primitives[0].indices, (std::vector<uint32_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(flatten(model).welded_count, 4u);
}

// Strips in a .ply: every second triangle is turned round, and -1 begins a new strip.
TEST(FileKinds, APlyOfStripsIsRead) {
  for (const char* list : {"list int int vertex_indices", "list uchar int vertex_index"}) {
    const SurfaceMesh mesh =
        read(std::string("ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
                         "property float z\nelement tristrips 1\nproperty ") +
                 list + "\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 2 0\n8 0 1 2 3 -1 1 4 3\n",
             ".ply");
    EXPECT_EQ(mesh.triangles, (std::vector<uint32_t>{0, 1, 2, 1, 3, 2, 1, 4, 3})) << list;
  }
}

}  // namespace
}  // namespace samples

// hf_detail run as a user runs it: weights on a bumpy plane, detail onto another, its picture, and what bad input is
// answered.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "assets/shapes.h"
#include "common/mesh_file.h"
#include "support/program_support.h"
#include "unit/gltf/gltf_support.h"

namespace {

namespace fs = std::filesystem;
using namespace samples;
using namespace hf_gltf;
using samples_test::TemporaryFolder;

int run(const std::string& arguments, std::string& output) {
  return hf_test::run(hf_test::quoted(HF_DETAIL_PROGRAM) + " " + arguments, output);
}

SurfaceMesh mesh_of(const ShapeMesh& shape) {
  SurfaceMesh mesh;
  for (size_t i = 0; i < shape.positions.size(); i += 3)
    mesh.positions.push_back({shape.positions[i], shape.positions[i + 1], shape.positions[i + 2]});
  mesh.triangles = shape.triangles;
  return mesh;
}

bool inside(const glm::dvec3& p) { return std::fabs(p.x) < 0.45 && std::fabs(p.z) < 0.45; }

double highest(const SurfaceMesh& mesh) {
  double most = 0;
  for (const glm::dvec3& p : mesh.positions)
    if (inside(p)) most = std::max(most, std::fabs(p.y));
  return most;
}

TEST(DetailProgram, MorphsAndCarriesDetail) {
  const TemporaryFolder folder;
  const auto path = [&](const char* name) { return (folder.path / name).string(); };
  const SurfaceMesh bumpy = mesh_of(bumpy_plane(61, 61)), flat = mesh_of(plane(53, 53));
  write_mesh_file(bumpy, path("bumpy.ply"));
  write_mesh_file(flat, path("flat.obj"));
  std::ofstream(path("square.json")) << R"({"points": [{"near": [-0.5, 0, -0.5]}, {"near": [0.5, 0, -0.5]},
    {"near": [0.5, 0, 0.5]}, {"near": [-0.5, 0, 0.5]}]})";
  const std::string curve = " --curve \"" + path("square.json") + "\"";
  const std::string in = "\"" + path("bumpy.ply") + "\"" + curve, out = " -o \"" + path("out.ply") + "\"";
  std::string text;

  ASSERT_EQ(run(in + " --membrane --weight 0" + out, text), 0) << text;
  const SurfaceMesh same = read_mesh_file(path("out.ply"));
  ASSERT_EQ(same.positions.size(), bumpy.positions.size());
  for (size_t v = 0; v < same.positions.size(); ++v)
    for (int c = 0; c < 3; ++c)
      EXPECT_EQ(static_cast<float>(same.positions[v][c]), static_cast<float>(bumpy.positions[v][c]));
  EXPECT_NE(text.find("membrane"), std::string::npos) << text;

  ASSERT_EQ(run(in + " --membrane --weight -1 --grow 2" + out, text), 0) << text;
  EXPECT_NE(text.find("0 factorisations"), std::string::npos) << text;
  EXPECT_GT(highest(read_mesh_file(path("out.ply"))), 1.3 * highest(bumpy));

  ASSERT_EQ(run(in + " --weight 1 -o \"" + path("out.glb") + "\" --sheet \"" + path("sheet.png") + "\"", text), 0)
      << text;
  EXPECT_NE(text.find("thin plate"), std::string::npos) << text;
  EXPECT_GT(fs::file_size(path("sheet.png")), 10000u);
  EXPECT_EQ(read_mesh_file(path("out.glb")).positions.size(), bumpy.positions.size());

  ASSERT_EQ(run(in + " --weight 1 --onto \"" + path("flat.obj") + "\" --onto-curve \"" + path("square.json") + "\"" +
                    out + " --sheet \"" + path("sheet.png") + "\"",
                text),
            0)
      << text;
  const SurfaceMesh carried = read_mesh_file(path("out.ply"));
  ASSERT_EQ(carried.positions.size(), flat.positions.size());
  EXPECT_GT(highest(carried), 0.3 * highest(bumpy));
  for (const glm::dvec3& p : carried.positions) {
    if (std::fabs(p.x) > 0.55 || std::fabs(p.z) > 0.55) {
      EXPECT_EQ(p.y, 0);
    }
  }
}

TEST(DetailProgram, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  const auto path = [&](const char* name) { return (folder.path / name).string(); };
  write_mesh_file(mesh_of(bumpy_plane(21, 21)), path("mesh.obj"));
  const std::string in = "\"" + path("mesh.obj") + "\" --curve \"" + path("curve.json") + "\" --weight 1";
  std::string text;
  const auto refused = [&](const char* json, const char* word) {
    std::ofstream(path("curve.json")) << json;
    EXPECT_EQ(run(in, text), 1) << text;
    EXPECT_NE(text.find(word), std::string::npos) << text;
  };
  refused(R"({"points": [{"vertex": 1}, {"vertex": 99999}, {"vertex": 3}]})", "points[1].vertex");
  refused(R"({"points": [{"vertex": 1}, {"vertex": 3}, {"vertex": 2}]})", "goes round no vertex");
  refused(R"({"points": [{"vertex": 1}, {"vertex": 3}, {"vertex": 2}], "edges": true})", "does not separate");
  refused(R"({"points": [{"vertex": 1}, {"vertex": 3}]})", "3 points or more");
  refused(R"({"points": [{"near": [0, 0]}]})", "points[0].near");
  refused(R"({"points": [], "sides": "smaller"})", "sides");
  refused(R"({"points": [{"vertex": 1}, {"triangle": 3, "barycentrics": [1, 0, 0]}, {"vertex": 9}]})", "everywhere");
  EXPECT_EQ(run("\"" + path("mesh.obj") + "\" --weight 1", text), 1);
  EXPECT_NE(text.find("no curve"), std::string::npos) << text;
  EXPECT_EQ(run(in + " --weight much", text), 1);
  EXPECT_EQ(run(in + " --onto x.obj", text), 1);
  EXPECT_EQ(run(in + " --bogus", text), 1);
  EXPECT_NE(text.find("--bogus"), std::string::npos) << text;
  EXPECT_EQ(run("--help", text), 0);
  EXPECT_NE(text.find("--membrane"), std::string::npos) << text;
}

}  // namespace

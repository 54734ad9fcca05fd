// hf_quads run as a user runs it: its figures, its polygons read back, its picture, and what bad input is answered.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "assets/shapes.h"
#include "common/mesh_file.h"
#include "gltf_support.h"
#include "support/program_support.h"

namespace {

namespace fs = std::filesystem;
using namespace samples;
using samples_test::TemporaryFolder;

int run(const std::string& arguments, std::string& output) {
  return hf_test::run(hf_test::quoted(HF_QUADS_PROGRAM) + " " + arguments, output);
}

TEST(QuadsProgram, WritesQuadsAndSaysWhatTheyAreWorth) {
  const TemporaryFolder folder;
  const ShapeMesh cactus = samples::cactus(1500);
  SurfaceMesh mesh;
  for (size_t i = 0; i < cactus.positions.size(); i += 3)
    mesh.positions.push_back({cactus.positions[i], cactus.positions[i + 1], cactus.positions[i + 2]});
  mesh.triangles = cactus.triangles;
  const std::string in = (folder.path / "cactus.obj").string(), out = (folder.path / "quads.obj").string(),
                    png = (folder.path / "quads.png").string(), sites = (folder.path / "sites.json").string();
  write_mesh_file(mesh, in);
  std::string text;
  for (const char* kind : {"--pure", "--uniform"}) {
    ASSERT_EQ(run("\"" + in + "\" --edge 4% " + kind + " -o \"" + out + "\" --sheet \"" + png + "\"", text), 0) << text;
    for (const char* word : {"Euler characteristic 2 (surface 2)", "repeated corners: none", "100.00 % now", "valence",
                             "aspect", "angle off", "Hausdorff"})
      EXPECT_NE(text.find(word), std::string::npos) << word << "\n" << text;
    const SurfaceMesh back = read_mesh_file(out);
    ASSERT_FALSE(back.face_sizes.empty());
    for (const uint32_t size : back.face_sizes) EXPECT_EQ(size, 4u);
    EXPECT_EQ(back.positions.size(), back.face_sizes.size() + 2);  // closed quads of genus 0
    EXPECT_GT(fs::file_size(png), 10000u);
  }
  std::ofstream(sites) << "{\"sites\": [{\"vertex\": 3}, {\"vertex\": 900}]}";
  EXPECT_EQ(run("\"" + in + "\" --edge 5% --sites \"" + sites + "\"", text), 0) << text;
  EXPECT_NE(text.find("sites       2, saddles 0"), std::string::npos) << text;
  std::ofstream(sites) << "{\"sites\": [{\"vertex\": 99999}]}";
  EXPECT_EQ(run("\"" + in + "\" --sites \"" + sites + "\"", text), 1);
  EXPECT_NE(text.find("sites[0].vertex"), std::string::npos) << text;
  EXPECT_EQ(run("\"" + in + "\" --edge -1", text), 1);
  EXPECT_EQ(run("\"" + in + "\" --bogus", text), 1);
  EXPECT_NE(text.find("--bogus"), std::string::npos) << text;
  EXPECT_EQ(run("", text), 1);
}

}  // namespace

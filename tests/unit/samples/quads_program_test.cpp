// hf_quads run as a user runs it: its figures, its polygons read back, its picture, and what bad input is answered.
#include <gtest/gtest.h>

#include <cmath>
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

std::string line_of(const std::string& text, const std::string& begin) {
  const size_t at = text.find("\n" + begin);
  return at == std::string::npos ? "" : text.substr(at + 1, text.find('\n', at + 1) - at);
}

// Two squares, and a third that stands across both.
TEST(QuadsProgram, CountsFacesThatCross) {
  const TemporaryFolder folder;
  const std::string file = (folder.path / "cross.obj").string();
  std::ofstream(file) << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\n"
                         "v .5 .5 -1\nv 1.5 .4 -1\nv 1.5 .5 1\nv .5 .4 1\nv 5 5 5\nv 6 5 5\nv 5 6 5\n"
                         "f 1 2 3 4\nf 2 5 6 3\nf 7 8 9 10\nf 11 12 13\n";
  std::string text;
  ASSERT_EQ(run("\"" + file + "\" --measure \"" + file + "\"", text), 0) << text;
  EXPECT_NE(text.find("crossing    3 faces"), std::string::npos) << text;
}

// A disc without a vertex inside: its triangles are long and thin, and each place lies in the boxes of thousands.
TEST(QuadsProgram, SaysWhatItDoesNotMeasure) {
  const TemporaryFolder folder;
  const std::string file = (folder.path / "disc.off").string(), out = (folder.path / "quads.obj").string();
  const int corners = 6000;
  {
    std::ofstream disc(file);
    disc << "OFF\n" << corners << " " << corners - 2 << " 0\n";
    for (int i = 0; i < corners; ++i)
      disc << std::cos(6.283185307179586 * i / corners) << " " << std::sin(6.283185307179586 * i / corners) << " 0\n";
    for (int i = 1; i + 1 < corners; ++i) disc << "3 0 " << i << " " << i + 1 << "\n";
  }
  std::string text;
  ASSERT_EQ(run("\"" + file + "\" --field -o \"" + out + "\"", text), 0) << text;
  EXPECT_NE(text.find("Euler characteristic 1 (surface 1), directed edges once: yes"), std::string::npos) << text;
  EXPECT_NE(text.find("crossing    not counted"), std::string::npos) << text;
  EXPECT_NE(text.find("Hausdorff   not measured"), std::string::npos) << text;
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
  std::string text, again;
  for (const char* kind : {"--pure", "--uniform"}) {
    ASSERT_EQ(run("\"" + in + "\" --edge 4% " + kind + " -o \"" + out + "\" --sheet \"" + png + "\"", text), 0) << text;
    for (const char* word : {"Euler characteristic 2 (surface 2)", "repeated corners: none", "100.00 % of the faces", "valence",
                             "crossing    0 faces", "aspect", "angle off", "Hausdorff"})
      EXPECT_NE(text.find(word), std::string::npos) << word << "\n" << text;
    const SurfaceMesh back = read_mesh_file(out);
    ASSERT_FALSE(back.face_sizes.empty());
    for (const uint32_t size : back.face_sizes) EXPECT_EQ(size, 4u);
    EXPECT_EQ(back.positions.size(), back.face_sizes.size() + 2);  // closed quads of genus 0
    EXPECT_GT(fs::file_size(png), 10000u);
    ASSERT_EQ(run("\"" + in + "\" --measure \"" + out + "\"", again), 0) << again;
    for (const char* line : {"valence", "irregular", "aspect", "angle off", "Hausdorff"})
      EXPECT_EQ(line_of(again, line), line_of(text, line)) << line;
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

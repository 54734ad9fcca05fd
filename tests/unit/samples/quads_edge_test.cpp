// hf_quads and the edge length a user asks for: what it costs, and whether it is met.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "support/program_support.h"
#include "unit/gltf/gltf_support.h"

namespace {

using samples_test::TemporaryFolder;

int run(const std::string& arguments, std::string& output) {
  return hf_test::run(hf_test::quoted(HF_QUADS_PROGRAM) + " " + arguments, output);
}

std::string line_of(const std::string& text, const std::string& begin) {
  const size_t at = text.find("\n" + begin);
  return at == std::string::npos ? "" : text.substr(at + 1, text.find('\n', at + 1) - at);
}

std::string write_cube(const TemporaryFolder& folder) {
  std::ofstream(folder.path / "cube.obj") << "v 0 0 0\nv 0 0 1\nv 0 1 0\nv 0 1 1\nv 1 0 0\nv 1 0 1\nv 1 1 0\nv 1 1 1\n"
                                             "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n";
  return (folder.path / "cube.obj").string();
}

// What a short edge length costs follows from the quads it asks for, not from the twelve triangles of the file.
TEST(QuadsProgram, AnEdgeLengthMayAskForManyQuadsOfASmallFile) {
  const TemporaryFolder folder;
  const std::string file = "\"" + write_cube(folder) + "\"";
  std::string text;
  ASSERT_EQ(run(file + " --edge 1% --relax 0", text), 0) << text;
  EXPECT_EQ(line_of(text, "warning"), "");
  EXPECT_NE(text.find(" 20184 faces"), std::string::npos) << text;
  EXPECT_EQ(run(file + " --edge 0.001", text), 1);
  EXPECT_NE(text.find("-limit N raises it"), std::string::npos) << text;
  EXPECT_EQ(run(file + " --edge 1e-300", text), 1);
  EXPECT_NE(text.find("edge_length is 1e-300"), std::string::npos) << text;
}

// A cube has quads in squares: 6 are nearest to 10, 30 are near enough.
TEST(QuadsProgram, SaysWhenACountIsMissed) {
  const TemporaryFolder folder;
  const std::string file = "\"" + write_cube(folder) + "\"";
  std::string text;
  ASSERT_EQ(run(file + " --faces 10", text), 0) << text;
  EXPECT_NE(line_of(text, "warning").find("6 faces where 10 are asked for"), std::string::npos) << text;
  ASSERT_EQ(run(file + " --faces 30", text), 0) << text;
  EXPECT_EQ(line_of(text, "warning"), "");
}

// A star of five points: about 400 quads of this length cover it.
TEST(QuadsProgram, SaysWhenAnEdgeLengthIsMissed) {
  const TemporaryFolder folder;
  {
    std::ofstream star(folder.path / "star.obj");
    for (int i = 0; i < 10; ++i) {
      const double angle = 0.3141592653589793 * (2 * i + 5), radius = i % 2 == 0 ? 1 : 0.4;
      star << "v " << radius * std::cos(angle) << " " << radius * std::sin(angle) << " 0\n";
    }
    star << "f 1 2 3 4 5 6 7 8 9 10\n";
  }
  std::string text;
  ASSERT_EQ(run("\"" + (folder.path / "star.obj").string() + "\" --edge 0.0542", text), 0) << text;
  const double faces = std::stod(line_of(text, "quads").substr(line_of(text, "quads").find("vertices, ") + 10));
  EXPECT_TRUE(faces > 200 || line_of(text, "warning").find("gives about 400") != std::string::npos) << text;
}

}  // namespace

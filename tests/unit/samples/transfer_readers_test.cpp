// Files of hf_transfer played by other programs: three.js, VTK and Blender, and Godot in the long form (its import
// takes ten seconds). Posed vertices at three times, at keys and between them, against our own reading of the same
// file. Each is skipped with a message where the program is absent.
#include <gtest/gtest.h>

#include <algorithm>

#include "gltf/animate.h"
#include "support/full.h"
#include "unit/samples/transfer_program_support.h"

namespace {

using namespace transfer_program;

fs::path script(const std::string& name) { return fs::path(HF_SOURCE_DIR) / "tests/unit/samples" / name; }

// The files: a new skin, the target's own, morph targets. Made once.
fs::path written(const std::string& kind) {
  static std::set<std::string> made;
  const fs::path out = folder() / ("played_" + kind + ".glb");
  if (!made.insert(kind).second) return out;
  std::string said;
  EXPECT_EQ(transfer(both() + " --pairs " + quoted(pairs("horse_to_bull.json")) + " --fps 30 --as " + kind + " -o " +
                         quoted(out),
                     said),
            0)
      << said;
  return out;
}

const std::vector<double> times = {0.0, 0.25, 0.5333333333333333};
const char* const times_text = "0,0.25,0.5333333333333333";

// Vertices in the reader's order against ours; the reader may leave copies of a vertex out, but not move any.
void compare(const fs::path& file, const fs::path& answer, const std::string& who, double bound) {
  const hf_gltf::Model model = hf_gltf::read_gltf(file);
  const hf_gltf::FlatMesh mesh = hf_gltf::flatten(model);
  const nlohmann::json frames = nlohmann::json::parse(std::ifstream(answer))["frames"];
  ASSERT_EQ(frames.size(), times.size());
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::dvec3& p : mesh.positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  double worst = 0;
  for (size_t f = 0; f < times.size(); ++f) {
    const std::vector<glm::dvec3> expected = hf_gltf::posed_positions(model, mesh, model.animations[0], times[f]);
    const std::vector<double> got = frames[f].get<std::vector<double>>();
    ASSERT_EQ(got.size(), 3 * expected.size()) << who;
    for (size_t v = 0; v < expected.size(); ++v)
      worst = std::max(worst, glm::distance(expected[v], glm::dvec3(got[3 * v], got[3 * v + 1], got[3 * v + 2])));
  }
  worst /= glm::length(high - low);
  std::printf("%s: posed vertices within %.1e of the box, %s\n", who.c_str(), worst, file.filename().string().c_str());
  EXPECT_LT(worst, bound) << who;
}

TEST(TransferReaders, ThreePosesTheVerticesAsWeDo) {
  std::string searched;
  const fs::path modules = node_modules("three", searched);
  if (modules.empty()) GTEST_SKIP() << searched;
  for (const char* kind : {"skin", "own-skin", "morph"}) {
    const fs::path answer = folder() / "three.json", file = written(kind);
    std::string said;
    ASSERT_EQ(run("node " + quoted(script("read_three.mjs")) + " " + quoted(modules) + " " + quoted(file) + " " +
                      times_text + " " + quoted(answer),
                  said),
              0)
        << said;
    compare(file, answer, "three.js", 1e-4);
  }
}

TEST(TransferReaders, VtkPosesTheVerticesAsWeDo) {
  std::string python;
  for (const char* candidate : {"python3", "/usr/bin/python3"})
    if (python.empty() && works(std::string(candidate) + " -c \"from vtkmodules.vtkIOGeometry import vtkGLTFReader\""))
      python = candidate;
  if (python.empty()) GTEST_SKIP() << "no python3 with VTK 9 (Debian: python3-vtk9)";
  // VTK's reader takes the joints of a skin; morph weights it reads as well
  for (const char* kind : {"skin", "own-skin"}) {
    const fs::path answer = folder() / "vtk.json", file = written(kind);
    std::string said;
    ASSERT_EQ(
        run(python + " " + quoted(script("read_vtk.py")) + " " + quoted(file) + " " + times_text + " " + quoted(answer),
            said),
        0)
        << said;
    compare(file, answer, "vtkGLTFReader", 1e-4);
  }
}

TEST(TransferReaders, BlenderPosesTheVerticesAsWeDo) {
  if (!works("blender --version")) GTEST_SKIP() << "no blender on the path";
  for (const char* kind : {"skin", "own-skin", "morph"}) {
    const fs::path answer = folder() / "blender.json", file = written(kind);
    std::string said;
    ASSERT_EQ(run("blender -b --factory-startup --python-exit-code 3 --python " + quoted(script("read_blender.py")) +
                      " -- " + quoted(file) + " " + times_text + " " + quoted(answer),
                  said),
              0)
        << said;
    compare(file, answer, "Blender", 1e-4);
  }
}

void check_godot(const std::string& kind) {
  const fs::path project = folder() / "godot", file = written(kind);
  fs::remove_all(project);
  fs::create_directories(project);
  fs::copy_file(file, project / "creature.glb");
  fs::copy_file(script("read_godot.gd"), project / "read_godot.gd");
  const hf_gltf::Model model = hf_gltf::read_gltf(file);
  // Godot leaves brackets out of names: a second walk is "walk (2)" in the file
  std::string clip = model.animations.front().name;
  clip.erase(std::remove_if(clip.begin(), clip.end(), [](char c) { return c == '(' || c == ')'; }), clip.end());
  std::ofstream(project / "clip.txt") << clip;
  std::ofstream(project / "times.txt") << "0,0.26666666,0.53333333";
  std::ofstream(project / "project.godot") << "config_version=4\n[application]\nconfig/name=\"posed\"\n";
  // the importer samples clips again: as often as they have keys, and without leaving any out
  std::ofstream(project / "creature.glb.import")
      << "[remap]\nimporter=\"scene\"\ntype=\"PackedScene\"\n[deps]\nsource_file=\"res://creature.glb\"\n[params]\n"
         "nodes/root_type=\"Spatial\"\nnodes/root_name=\"Scene "
         "Root\"\nnodes/root_scale=1.0\nnodes/custom_script=\"\"\nnodes/storage=0\n"
         "materials/location=1\nmaterials/storage=1\nmaterials/keep_on_reimport=true\nmeshes/compress=true\nmeshes/"
         "ensure_tangents=true\n"
         "meshes/storage=0\nmeshes/light_baking=0\nmeshes/lightmap_texel_size=0.1\nskins/use_named_skins=true\n"
         "external_files/store_in_subdir=false\nanimation/import=true\nanimation/fps=30\nanimation/filter_script=\"\"\n"
         "animation/storage=false\nanimation/keep_custom_tracks=false\nanimation/optimizer/enabled=false\nanimation/"
         "clips/amount=0\n";
  const std::string settings = "HOME=" + quoted(project) + " LANG=en_US.UTF-8 ";
  std::string said;
  // the editor imports and does not always end by itself
  run(settings + "timeout 12 godot3-server --path " + quoted(project) + " -e --quit", said);
  ASSERT_EQ(run(settings + "timeout 60 godot3-server --path " + quoted(project) + " -s read_godot.gd", said), 0)
      << said;
  const hf_gltf::FlatMesh mesh = hf_gltf::flatten(model);
  const nlohmann::json frames = nlohmann::json::parse(std::ifstream(project / "posed.json"))["frames"];
  double worst = 0;
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::dvec3& p : mesh.positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const double at[] = {0, 8.0 / 30, 16.0 / 30};
  ASSERT_EQ(frames.size(), 3u);
  for (size_t f = 0; f < 3; ++f) {
    const std::vector<glm::dvec3> expected = hf_gltf::posed_positions(model, mesh, model.animations[0], at[f]);
    const std::vector<double> got = frames[f].get<std::vector<double>>();
    ASSERT_EQ(got.size(), 3 * expected.size());
    for (size_t v = 0; v < expected.size(); ++v)
      worst = std::max(worst, glm::distance(expected[v], glm::dvec3(got[3 * v], got[3 * v + 1], got[3 * v + 2])));
  }
  std::printf("Godot: posed vertices within %.1e of the box, %s\n", worst / glm::length(high - low),
              file.filename().string().c_str());
  EXPECT_LT(worst / glm::length(high - low), 2e-4);
}

TEST(TransferReaders, GodotPosesTheVerticesAsWeDo) {
  if (!hf_test::is_full()) GTEST_SKIP() << "the import takes ten seconds; set HF_FULL_TESTS to run it";
  if (!works("command -v godot3-server")) GTEST_SKIP() << "no godot3-server on the path";
  for (const char* kind : {"skin", "own-skin"}) check_godot(kind);
}

}  // namespace

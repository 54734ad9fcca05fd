// .fbx, .dae and .bvh by way of assimp: places that are known, what is said of what is lost, files that are hostile.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

#include "common/mesh_file.h"
#include "foreign_files.h"
#include "gltf/animate.h"
#include "gltf/foreign_file.h"
#include "gltf_support.h"

namespace samples {
namespace {

using samples_test::bvh_text;
using samples_test::dae_text;
using samples_test::fbx_text;
using samples_test::FbxFile;
using samples_test::message_of;

#define HF_NEED_ASSIMP() \
  if (!reads_foreign(FileKind::fbx)) GTEST_SKIP() << "this build has no assimp (Debian: libassimp-dev)"

Model read(const std::string& text, const std::string& name) {
  return read_gltf_bytes({text.begin(), text.end()}, name);
}

std::vector<glm::dvec3> posed(const Model& model, double time) {
  return posed_positions(model, flatten(model), model.animations.at(0), time);
}

// Whether some vertex is there.
void expect_place(const std::vector<glm::dvec3>& places, const glm::dvec3& wanted) {
  double nearest = 1e300;
  for (const glm::dvec3& place : places) nearest = std::min(nearest, glm::length(place - wanted));
  EXPECT_LT(nearest, 1e-6 * (1 + glm::length(wanted))) << wanted.x << " " << wanted.y << " " << wanted.z;
}

// The strip of the file, bent by an angle about z.
std::vector<glm::dvec3> bent(double degrees) {
  const double c = std::cos(glm::radians(degrees)), s = std::sin(glm::radians(degrees));
  std::vector<glm::dvec3> out = {{0, 0, 0}, {0.1, 0, 0}, {0.2, 0, 0}};
  for (const double x : {0.1, 0.0}) out.emplace_back(c * x - s * 0.5, 0.5 + s * x + c * 0.5, 0);
  return out;
}

TEST(ForeignFiles, ASkinOfAnFbxFileFollowsItsClipInMetres) {
  HF_NEED_ASSIMP();
  const Model model = read(fbx_text(), "strip.fbx");
  EXPECT_TRUE(model.warnings.empty()) << model.warnings.front();
  ASSERT_EQ(model.animations.size(), 1u);
  EXPECT_EQ(model.animations[0].name, "bend");
  EXPECT_NEAR(clip_duration(model.animations[0]), 1, 1e-6);
  ASSERT_EQ(model.skins.size(), 1u);
  for (const double time : {0.0, 0.25, 0.5, 1.0})
    for (const glm::dvec3& place : bent(90 * time)) expect_place(posed(model, time), place);
  // two materials, one mesh
  ASSERT_EQ(model.meshes.size(), 1u);
  ASSERT_EQ(model.meshes[0].primitives.size(), 2u);
  const int red = model.meshes[0].primitives[0].material;
  ASSERT_GE(red, 0);
  EXPECT_EQ(model.materials[static_cast<size_t>(red)].base_color, glm::vec4(1, 0.25, 0, 1));
}

TEST(ForeignFiles, CornersThatAgreeAreOneVertexAndTexturesStandUpright) {
  HF_NEED_ASSIMP();
  const Model model = read(fbx_text(), "strip.fbx");
  const Primitive& quad = model.meshes.at(0).primitives.at(0);
  ASSERT_EQ(quad.indices.size(), 6u);
  ASSERT_EQ(quad.positions.size(), 4u);
  ASSERT_EQ(quad.texcoords.size(), 1u);
  for (size_t v = 0; v < 4; ++v) {
    const glm::vec3& p = quad.positions[v];
    EXPECT_LT(glm::length(quad.texcoords[0][v] - glm::vec2(p.x / 0.2f, 1 - p.y)), 1e-6f);
  }
}

TEST(ForeignFiles, AShapeKeyOfAnFbxFileIsKeptAtRest) {
  HF_NEED_ASSIMP();
  std::string text = fbx_text();
  text.insert(text.find("  Deformer: 10"), R"(  Geometry: 40, "Geometry::Smile", "Shape" {
    Version: 100
    Indexes: *1 { a: 2 }
    Vertices: *3 { a: 0,10,0 }
    Normals: *3 { a: 0,0,0 }
  }
  Deformer: 41, "Deformer::Keys", "BlendShape" { Version: 100 }
  Deformer: 42, "SubDeformer::Smile", "BlendShapeChannel" {
    Version: 100
    DeformPercent: 0
    FullWeights: *1 { a: 100 }
  }
)");
  text.insert(text.rfind("}"), "  C: \"OO\",41,1\n  C: \"OO\",42,41\n  C: \"OO\",40,42\n");
  const Model model = read(text, "a.fbx");
  const MeshData& mesh = model.meshes.at(0);
  ASSERT_EQ(mesh.weights, std::vector<float>{0});
  const Primitive& quad = mesh.primitives.at(0);
  ASSERT_EQ(quad.targets.size(), 1u);
  for (size_t v = 0; v < quad.positions.size(); ++v) {
    const bool moved = quad.positions[v].x > 0 && quad.positions[v].y > 0;
    EXPECT_LT(glm::length(quad.targets[0].positions[v] - glm::vec3(0, moved ? 0.1f : 0, 0)), 1e-6f);
  }
}

TEST(ForeignFiles, AClipThatBeginsBeforeZeroIsKeptWhole) {
  HF_NEED_ASSIMP();
  std::string text = fbx_text();
  const std::string times = "0,23093079000,46186158000";
  text.replace(text.find(times), times.size(), "-46186158000,0,46186158000");
  const Model model = read(text, "a.fbx");
  for (const double time : {0.0, 1.0, 2.0})
    for (const glm::dvec3& place : bent(45 * time)) expect_place(posed(model, time), place);
}

TEST(ForeignFiles, AnFbxFileSavedInThePoseOfAClipRestsInTheShapeItIsStoredIn) {
  HF_NEED_ASSIMP();
  const Model model = read(fbx_text(), "strip.fbx");
  for (const glm::dvec3& place : bent(0)) expect_place(flatten(model).positions, place);
  EXPECT_EQ(model.nodes[2].name, "Upper");
  EXPECT_NEAR(model.nodes[2].rotation.w, 1, 1e-6);
}

TEST(ForeignFiles, UnitsAndAxesOfAnFbxFileAreApplied) {
  HF_NEED_ASSIMP();
  FbxFile file;
  file.unit = "100";
  for (const glm::dvec3& place : bent(90)) expect_place(posed(read(fbx_text(file), "a.fbx"), 1), 100.0 * place);
  // z up and -y to the front: x y z becomes x z -y
  FbxFile z_up;
  z_up.axes[1] = "2";
  z_up.axes[2] = "1";
  z_up.signs[2] = "-1";
  for (const glm::dvec3& p : bent(90)) expect_place(posed(read(fbx_text(z_up), "a.fbx"), 1), {p.x, p.z, -p.y});
  z_up.signs[2] = "1";
  const Model mirrored = read(fbx_text(z_up), "a.fbx");
  ASSERT_EQ(mirrored.warnings.size(), 1u);
  EXPECT_NE(mirrored.warnings[0].find("not right-handed"), std::string::npos);
}

// The file with one more property of the upper bone.
std::string with_property(const char* name, const char* value) {
  std::string text = fbx_text();
  const std::string property = std::string("P: \"") + name + "\", \"Vector3D\", \"Vector\", \"\"," + value + "\n";
  text.insert(text.find("P: \"Lcl Translation\""), property);
  return text;
}

TEST(ForeignFiles, TheOrientationOfAJointOfAnFbxFileStandsBeforeItsCurve) {
  HF_NEED_ASSIMP();
  const Model model = read(with_property("PreRotation", "90,0,0"), "a.fbx");
  // bent in the plane, then turned about x by 90 degrees
  for (const glm::dvec3& place : bent(90))
    expect_place(posed(model, 1), {place.x, place.y > 0 ? 0.5 : 0, std::max(place.y - 0.5, 0.0)});
}

TEST(ForeignFiles, AJointThatAClipDoesNotMoveStandsAsItWasSaved) {
  HF_NEED_ASSIMP();
  std::string text = fbx_text();
  text.replace(text.find("C: \"OP\",22,4"), 12, "C: \"OP\",22,3");
  const Model model = read(text, "a.fbx");
  const auto places = posed(model, 1);
  // the lower bone turns the strip on its side, the upper one is at 30 degrees still
  const double c = std::cos(glm::radians(30.0)), s = 0.5;
  expect_place(places, {-0.5 - 0.5 * c, -0.5 * s, 0});
  expect_place(places, {-0.5 - 0.5 * c - 0.1 * s, -0.5 * s + 0.1 * c, 0});
}

TEST(ForeignFiles, ACurveOfNoNodeIsSaid) {
  HF_NEED_ASSIMP();
  const Model model = read(with_property("RotationPivot", "0,1,0"), "pivot.fbx");
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_NE(model.warnings[0].find("curves are left out: they move a pivot"), std::string::npos);
}

TEST(ForeignFiles, ASkinOfAColladaFileFollowsItsClipInMetres) {
  HF_NEED_ASSIMP();
  const Model model = read(dae_text(), "strip.dae");
  ASSERT_EQ(model.animations.size(), 1u);
  for (const glm::dvec3& place : {glm::dvec3(0, 1, 0), glm::dvec3(0.1, 0, 0)}) expect_place(posed(model, 0), place);
  // the upper bone takes (10, 0, 50) to (-50, 0, 10) + (0, 0, 50), z up
  for (const glm::dvec3& place : {glm::dvec3(-0.5, 0.6, 0), glm::dvec3(-0.5, 0.5, 0), glm::dvec3(0.1, 0, 0)})
    expect_place(posed(model, 1), place);
}

TEST(ForeignFiles, ABvhFileGivesJointsAndAClip) {
  HF_NEED_ASSIMP();
  const Model model = read(bvh_text(), "steps.bvh");
  EXPECT_TRUE(model.meshes.empty());
  ASSERT_EQ(model.animations.size(), 1u);
  EXPECT_NEAR(clip_duration(model.animations[0]), 1, 1e-6);
  const auto joint = [&](size_t node, double time) {
    return glm::dvec3(global_matrices(model, sample(model, model.animations[0], time))[node][3]);
  };
  ASSERT_EQ(model.nodes.size(), 3u);
  EXPECT_EQ(model.nodes[1].name, "Knee");
  EXPECT_LT(glm::length(joint(2, 0) - glm::dvec3(0, 0, 0)), 1e-5);
  EXPECT_LT(glm::length(joint(1, 1) - glm::dvec3(2, 10, 0)), 1e-5);
  // the hips turn z on x, the knee -y on -z
  EXPECT_LT(glm::length(joint(2, 1) - glm::dvec3(2 - 10, 10, 0)), 1e-5);
  const double half = std::sqrt(0.5);
  EXPECT_LT(glm::length(joint(2, 0.5) - glm::dvec3(1 - 5, 10 - 10 * half, -5)), 1e-5);
}

TEST(ForeignFiles, ProgramsThatNeedNoJointsReadTheSurface) {
  HF_NEED_ASSIMP();
  const samples_test::TemporaryFolder folder;
  samples_test::write_text(folder.path / "strip.obj", fbx_text());  // the content tells
  const SurfaceMesh mesh = read_mesh_file(folder.path / "strip.obj");
  EXPECT_EQ(mesh.triangles.size(), 9u);
  for (const glm::dvec3& place : bent(0)) expect_place(mesh.positions, place);
}

TEST(ForeignFiles, TexturesThatAreNotKeptAreSaid) {
  HF_NEED_ASSIMP();
  std::string text = fbx_text();
  text.insert(text.find("  Deformer: 10"), "  Texture: 30, \"Texture::T\", \"\" { FileName: \"skin.png\" }\n");
  text.insert(text.rfind("}"), "  C: \"OP\",30,7, \"DiffuseColor\"\n");
  const Model model = read(text, "a.fbx");
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_EQ(model.warnings[0], "textures of 1 materials are left out; glTF exported from Blender keeps them");
}

TEST(ForeignFiles, InThisProcessTheSameBytesAreMade) {
  HF_NEED_ASSIMP();
  const std::string text = fbx_text();
  std::vector<std::string> warnings;
  const std::vector<uint8_t> bytes(text.begin(), text.end());
  const std::string here = foreign_glb_here(bytes, FileKind::fbx, "a.fbx", warnings);
  EXPECT_EQ(std::vector<uint8_t>(here.begin(), here.end()), foreign_glb(bytes, FileKind::fbx, "a.fbx", warnings));
  for (const auto& [other, kind] : {std::pair(dae_text(), FileKind::dae), std::pair(bvh_text(), FileKind::bvh)})
    EXPECT_FALSE(foreign_glb_here({other.begin(), other.end()}, kind, "a", warnings).empty());
}

// A key at so late a time that assimp comes to no end.
std::string endless_text() {
  FbxFile turning;
  turning.last = "1e30";
  return fbx_text(turning);
}

// A host may ignore the end of processes, or wait for them itself, and its threads may block signals.
TEST(ForeignFiles, AreReadInAHostThatKeepsSignalsForItself) {
  HF_NEED_ASSIMP();
  const std::string strip = fbx_text(), endless = endless_text();
  std::vector<std::string> warnings;
  ForeignLimits limits;
  limits.seconds = 1;
  const auto read_both = [&] {
    EXPECT_FALSE(foreign_glb({strip.begin(), strip.end()}, FileKind::fbx, "strip", warnings, limits).empty());
    return message_of([&] { foreign_glb({endless.begin(), endless.end()}, FileKind::fbx, "bad", warnings, limits); });
  };
  const std::string usual = read_both();
  EXPECT_EQ(usual.find("bad: takes more than 1 s to read"), 0u) << usual;
  const auto handler = std::signal(SIGCHLD, SIG_IGN);
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  const std::string kept = read_both();
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  std::signal(SIGCHLD, handler);
  EXPECT_EQ(kept, usual);
}

TEST(ForeignFiles, NoProcessAndNoFileStaysBehind) {
  HF_NEED_ASSIMP();
  const std::string strip = fbx_text();
  std::vector<std::string> warnings;
  ForeignLimits small;
  small.max_glb_bytes = 100;
  const int first = dup(0);
  close(first);
  EXPECT_NE(message_of([&] { foreign_glb({strip.begin(), strip.end()}, FileKind::fbx, "a", warnings, small); }), "");
  foreign_glb({strip.begin(), strip.end()}, FileKind::fbx, "a", warnings);
  const int next = dup(0);
  close(next);
  EXPECT_EQ(next, first);
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

// Each takes all memory, all time or all of the stack inside assimp.
TEST(ForeignFiles, AHostileFileEndsWithASentence) {
  HF_NEED_ASSIMP();
  std::vector<std::string> warnings;
  ForeignLimits limits;
  limits.seconds = 1;
  const auto said = [&](const std::string& text, FileKind kind) {
    return message_of([&] { foreign_glb({text.begin(), text.end()}, kind, "bad", warnings, limits); });
  };
  std::string deep = "; FBX 7.3.0 project file\n";
  for (int i = 0; i < 300000; ++i) deep += "a: {\n";
  EXPECT_EQ(said(deep, FileKind::fbx).find("bad: "), 0u);
  EXPECT_NE(said(endless_text(), FileKind::fbx), "");
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_NE(said(bvh_text("100000000"), FileKind::bvh).find("bad: takes more than 1024 MB"), std::string::npos);
#endif
  const std::string strip = fbx_text();
  for (size_t length = 100; length < strip.size(); length += 97) said(strip.substr(0, length), FileKind::fbx);
  EXPECT_NE(said("HIERARCHY\nROOT", FileKind::bvh).find("bad: is not accepted by assimp: "), std::string::npos);
  limits.max_glb_bytes = 100;
  EXPECT_NE(said(strip, FileKind::fbx).find("is more than 100 bytes as glTF"), std::string::npos);
}

}  // namespace
}  // namespace samples

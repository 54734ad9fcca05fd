// What write_gltf() puts out has no errors under the Khronos validator.
//
// Needs node and the npm package gltf-validator, looked for in HF_NODE_MODULES, <build>/npm/node_modules and
// <build>/node_modules; without them the test is skipped and says so.
#include <gtest/gtest.h>

#include <cstdio>

#include "common/mesh_file.h"
#include "compressed_files.h"
#include "gltf/gltf_decompress.h"
#include "gltf/gltf_write.h"
#include "gltf/skin_write.h"

namespace {

using namespace samples;
using namespace hf_gltf;
using namespace samples_test;

std::filesystem::path validator_modules() {
  std::vector<std::filesystem::path> places;
  if (const char* given = std::getenv("HF_NODE_MODULES")) places.emplace_back(given);
  places.emplace_back(HF_BUILD_DIR "/npm/node_modules");
  places.emplace_back(HF_BUILD_DIR "/node_modules");
  for (const auto& place : places) {
    if (std::filesystem::is_directory(place / "gltf-validator")) return place;
  }
  return {};
}

// Runs the script over a folder; its output, and whether it found no error.
bool validate(const std::filesystem::path& modules, const std::filesystem::path& folder, std::string& output) {
  const std::string command = "node \"" HF_SOURCE_DIR "/tests/unit/gltf/validate.mjs\" \"" + modules.string() +
                              "\" \"" + folder.string() + "\" 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) return false;
  char buffer[4096];
  while (size_t got = fread(buffer, 1, sizeof(buffer), pipe)) output.append(buffer, got);
  return pclose(pipe) == 0;
}

// A tube of rings with two joints, weights, a morph target, colours, lines, and a clip of every interpolation.
Model tube() {
  std::vector<glm::dvec3> positions;
  std::vector<uint32_t> triangles;
  const uint32_t around = 12, along = 8;
  for (uint32_t i = 0; i <= along; ++i) {
    for (uint32_t j = 0; j < around; ++j) {
      const double angle = 2 * 3.14159265358979 * j / around;
      positions.emplace_back(std::cos(angle), 0.5 * i, std::sin(angle));
      if (i == along) continue;
      const uint32_t a = i * around + j, b = i * around + (j + 1) % around;
      triangles.insert(triangles.end(), {a, a + around, b, b, a + around, b + around});
    }
  }
  Model model = make_model("tube", positions, triangles);
  Primitive& primitive = model.meshes[0].primitives[0];
  primitive.targets.resize(2);
  for (const glm::vec3& p : primitive.positions) {
    Influences o;
    o.joints = {0, 1};
    o.weights = {1 - p.y / 4, p.y / 4};
    primitive.influences.push_back(o);
    primitive.targets[0].positions.emplace_back(0.1f * p.x, 0.0f, 0.1f * p.z);
    primitive.colors.emplace_back(p.y / 4, 0.0f, 1.0f, 1.0f);
  }
  model.meshes[0].weights = {0, 0.5f};
  model.meshes[0].target_names = {"thick", "nothing"};
  model.nodes.resize(4);
  model.nodes[1].children = {2};
  model.nodes[2].parent = 1;
  model.nodes[2].translation = {0, 2, 0};
  model.nodes[0].skin = 0;
  model.scene_roots = {0, 1, 3};
  Skin skin;
  skin.joints = {1, 2};
  skin.inverse_bind = {glm::mat4(1), glm::mat4(1)};
  skin.inverse_bind[1][3].y = -2;
  model.skins.push_back(skin);
  for (const Interpolation mode : {Interpolation::step, Interpolation::linear, Interpolation::cubic_spline}) {
    Animation animation;
    animation.name = "clip";
    const size_t groups = mode == Interpolation::cubic_spline ? 3 : 1;
    for (const Path path : {Path::translation, Path::rotation, Path::scale, Path::weights}) {
      Channel channel;
      channel.node = path == Path::weights ? 0 : 2;
      channel.path = path;
      channel.interpolation = mode;
      channel.width = path == Path::rotation ? 4 : path == Path::weights ? 2 : 3;
      channel.times = {0, 1, 1.5f};
      for (size_t k = 0; k < 3 * groups; ++k) {
        for (size_t c = 0; c < channel.width; ++c) {
          channel.values.push_back(path == Path::rotation ? (c == 3 ? 1.0f : 0.0f) : 1.0f);
        }
      }
      animation.channels.push_back(channel);
    }
    model.animations.push_back(animation);
  }
  add_lines(model, "iso", {{0, 0, 0}, {0, 4, 0}}, {1, 0, 0, 1});
  return model;
}

Model computed_skin() {
  const Model source = tube();
  const FlatMesh mesh = flatten(source);
  SkinDescription skin;
  skin.influences_per_vertex = 8;
  SkinClip clip;
  clip.name = "wave";
  clip.times = {0, 0.5, 1};
  for (int j = 0; j < 20; ++j) skin.joints.push_back({"", {0.1 * j, 0.2 * j, 0}});
  for (int i = 0; i < 60; ++i) {
    clip.rotations.push_back(glm::angleAxis(0.1 * i, glm::normalize(glm::dvec3(1, i, 2))));
    clip.translations.emplace_back(0.01 * i, 0, 0);
  }
  for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    for (uint32_t k = 0; k < 8; ++k) {
      skin.vertex_joints.push_back((v + 2 * k) % 20);
      skin.vertex_weights.push_back(k == 7 ? 0.0f : 0.3f + static_cast<float>(v % 7));
    }
  }
  skin.clips.push_back(clip);
  return skin_model(source, mesh, skin);
}

// Two scenes, a camera, a light, instances, variants, extras, a collapsed and a mirrored node.
Model carried() {
  GlbBuilder b;
  json& primitive = b.triangle_mesh({{"POSITION", b.floats(unit_triangle(), "VEC3")}});
  primitive["material"] = 0;
  primitive["extensions"] = {{"KHR_materials_variants", {{"mappings", {{{"material", 0}, {"variants", {0}}}}}}}};
  b.document["materials"] = {{{"name", "m"}}};
  b.document["extensions"] = {{"KHR_materials_variants", {{"variants", {{{"name", "dusk"}}}}}},
                              {"KHR_lights_punctual", {{"lights", {{{"type", "point"}}}}}}};
  b.document["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
  json& nodes = b.document["nodes"];
  nodes.push_back({{"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  nodes.push_back({{"mesh", 0}, {"scale", {-1, 2, 1}}, {"extras", {{"id", 7}}}});
  nodes.push_back({{"mesh", 0}, {"scale", {0, 0, 0}}});
  nodes[0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", b.floats({0, 0, 0, 1, 2, 3}, "VEC3")}, {"SCALE", b.floats({1, 1, 1, 2, 2, 2}, "VEC3")}};
  b.document["extensionsUsed"] = {"KHR_materials_variants", "KHR_lights_punctual", "EXT_mesh_gpu_instancing"};
  b.document["scenes"] = {{{"nodes", {0, 1}}}, {{"nodes", {2, 3, 1}}, {"name", "\xe9\xa6\xac"}}};
  b.document["scene"] = 1;
  b.document["asset"]["copyright"] = "somebody";
  return b.read();
}

TEST(Validator, WrittenFilesHaveNoErrors) {
  const auto modules = validator_modules();
  if (modules.empty()) GTEST_SKIP() << "npm's gltf-validator is not there (HF_NODE_MODULES)";
  TemporaryFolder folder;
  const auto write = [&](const Model& model, const std::string& name) {
    write_gltf(model, folder.path / (name + ".glb"));
    write_gltf(model, folder.path / (name + ".gltf"));
  };
  write(tube(), "tube");
  write(computed_skin(), "skin");
  const FlatMesh mesh = flatten(tube());
  write(bake(tube(), mesh, mesh.positions), "still");
  Model scattered = tube();
  scatter(scattered, mesh, mesh.positions);
  write(scattered, "scattered");
  write(carried(), "carried");
#ifdef HF_GLTF_DRACO
  write(read_gltf_bytes(draco_file(true), "edgebreaker"), "edgebreaker");
  write(read_gltf_bytes(draco_file(false), "sequential"), "sequential");
#endif
#ifdef HF_GLTF_MESHOPT
  write(read_gltf_bytes(meshopt_file(), "meshopt"), "meshopt");
#endif
  write_mesh_file(to_surface_mesh(mesh), folder.path / "surface.glb");
  if (!shared_data().empty()) {
    for (const auto& entry : std::filesystem::directory_iterator(shared_data() / "gltf")) {
      if (entry.path().filename() == "pirate.glb" && !has_meshopt()) continue;
      write(read_gltf(entry.path()), entry.path().stem().string());
    }
  }
  for (const std::filesystem::path& file : given_models()) {
    const std::string name = file.parent_path().filename().string() + "_" + file.stem().string();
    try {
      write(read_gltf(file), name + (file.extension() == ".glb" ? "_glb" : ""));
    } catch (const std::runtime_error&) {  // gltf_assets_test.cpp prints these
    }
  }
  std::string output;
  EXPECT_TRUE(validate(modules, folder.path, output)) << output;
  std::printf("%s", output.c_str());
}

// The check itself must be able to fail.
TEST(Validator, AFileWithAnErrorIsFound) {
  const auto modules = validator_modules();
  if (modules.empty()) GTEST_SKIP() << "npm's gltf-validator is not there (HF_NODE_MODULES)";
  TemporaryFolder folder;
  write_text(folder.path / "bad.gltf", R"({"asset":{"version":"2.0"},"nodes":[{"mesh":3}]})");
  std::string output;
  EXPECT_FALSE(validate(modules, folder.path, output)) << output;
}

}  // namespace

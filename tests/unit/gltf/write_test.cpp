// Writing glTF: what is written reads back the same; what cannot be written is refused and leaves no file.
#include "gltf/gltf_write.h"

#include <gtest/gtest.h>

#include <random>

#include "gltf/animate.h"
#include "gltf/file_bytes.h"
#include "gltf_support.h"

namespace {

using namespace hf_gltf;
using namespace samples_test;

Model read_back(const Model& model, bool binary) {
  const std::string bytes = gltf_bytes(model, binary);
  return read_gltf_bytes({bytes.begin(), bytes.end()}, binary ? "back.glb" : "back.gltf");
}

// Everything at once: hierarchy, two primitives, skin with 8 influences, morph targets, all interpolations and paths.
Model full_model() {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> number(-1, 1);
  const auto vec = [&] { return glm::vec3(number(random), number(random), number(random)); };
  Model model;
  model.nodes.resize(6);
  model.nodes[0].name = "root";
  model.nodes[0].children = {1, 5};
  model.nodes[0].matrix = glm::mat4(2);
  (*model.nodes[0].matrix)[3] = glm::vec4(1, 2, 3, 1);
  for (int j = 1; j <= 3; ++j) {
    Node& node = model.nodes[static_cast<size_t>(j)];
    node.parent = j - 1;
    if (j < 3) node.children = {j + 1};
    node.translation = vec();
    node.rotation = glm::normalize(glm::quat(1, number(random), number(random), number(random)));
    node.scale = glm::vec3(1.5f) + vec();
  }
  model.nodes[4].name = "body";
  model.nodes[4].mesh = 0;
  model.nodes[4].skin = 0;
  model.nodes[4].weights = {0.25f, 0.5f};
  model.nodes[5].parent = 0;
  model.nodes[5].name = "still";
  model.nodes[5].mesh = 1;
  model.scene_roots = {0, 4};
  Skin skin;
  skin.joints = {1, 2, 3};
  skin.skeleton = 1;
  for (int j = 0; j < 3; ++j) {
    glm::mat4 matrix = glm::mat4_cast(glm::normalize(glm::quat(1, number(random), number(random), number(random))));
    matrix[3] = glm::vec4(vec(), 1);
    skin.inverse_bind.push_back(matrix);
  }
  model.skins.push_back(skin);
  model.meshes.resize(2);
  model.meshes[0].target_names = {"smile", "frown"};
  model.meshes[0].weights = {0, 1};
  for (int p = 0; p < 3; ++p) {
    Primitive primitive;
    primitive.texcoords.resize(2);
    primitive.targets.resize(p < 2 ? 2 : 0);
    for (int v = 0; v < 9; ++v) {
      primitive.positions.push_back(vec());
      primitive.normals.push_back(glm::normalize(vec()));
      primitive.tangents.emplace_back(glm::normalize(vec()), v % 2 == 0 ? 1.0f : -1.0f);
      primitive.colors.emplace_back(0.1f * static_cast<float>(v), 0.5f, 0.25f, 1.0f);
      for (auto& set : primitive.texcoords) set.emplace_back(number(random), number(random));
      for (auto& target : primitive.targets) {
        target.positions.push_back(vec());
        target.normals.push_back(vec());
      }
      Influences o;
      o.joints = {0, 1, 2};
      o.weights = {0.5f, 0.25f, 0.25f};
      if (p < 2) primitive.influences.push_back(o);
      primitive.indices.push_back(static_cast<uint32_t>(8 - v));
    }
    primitive.material = p == 0 ? 0 : -1;
    model.meshes[p < 2 ? 0 : 1].primitives.push_back(primitive);
  }
  Material material;
  material.name = "red";
  material.base_color = {1, 0, 0, 0.5f};
  material.double_sided = true;
  model.materials.push_back(material);
  Animation animation;
  animation.name = "move";
  for (const Interpolation mode : {Interpolation::step, Interpolation::linear, Interpolation::cubic_spline}) {
    const int node = 1 + static_cast<int>(mode);
    const size_t groups = mode == Interpolation::cubic_spline ? 3 : 1;
    for (const Path path : {Path::translation, Path::rotation, Path::scale}) {
      Channel channel;
      channel.node = node;
      channel.path = path;
      channel.interpolation = mode;
      channel.width = path == Path::rotation ? 4 : 3;
      channel.times = {0, 0.5f, 2};
      for (size_t k = 0; k < 3 * groups; ++k) {
        glm::vec4 value(vec(), number(random) + 2);
        if (path == Path::rotation) value = glm::normalize(value);
        for (size_t c = 0; c < channel.width; ++c) channel.values.push_back(value[static_cast<int>(c)]);
      }
      animation.channels.push_back(channel);
    }
  }
  Channel weights;
  weights.node = 4;
  weights.path = Path::weights;
  weights.width = 2;
  weights.times = {0, 1};
  weights.values = {0, 1, 1, 0};
  animation.channels.push_back(weights);
  model.animations.push_back(animation);
  return model;
}

void expect_same(const Model& a, const Model& b) {
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  EXPECT_EQ(a.scene_roots, b.scene_roots);
  for (size_t n = 0; n < a.nodes.size(); ++n) {
    EXPECT_EQ(a.nodes[n].parent, b.nodes[n].parent);
    EXPECT_EQ(a.nodes[n].children, b.nodes[n].children);
    EXPECT_EQ(a.nodes[n].translation, b.nodes[n].translation);
    EXPECT_LT(glm::length(a.nodes[n].rotation - b.nodes[n].rotation), 1e-7f);
    EXPECT_EQ(a.nodes[n].scale, b.nodes[n].scale);
    EXPECT_EQ(a.nodes[n].matrix.has_value(), b.nodes[n].matrix.has_value());
    if (a.nodes[n].matrix) {
      EXPECT_EQ(*a.nodes[n].matrix, *b.nodes[n].matrix);
    }
    EXPECT_EQ(a.nodes[n].mesh, b.nodes[n].mesh);
    EXPECT_EQ(a.nodes[n].skin, b.nodes[n].skin);
    EXPECT_EQ(a.nodes[n].weights, b.nodes[n].weights);
  }
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  for (size_t m = 0; m < a.meshes.size(); ++m) {
    EXPECT_EQ(a.meshes[m].target_names, b.meshes[m].target_names);
    EXPECT_EQ(a.meshes[m].weights, b.meshes[m].weights);
    ASSERT_EQ(a.meshes[m].primitives.size(), b.meshes[m].primitives.size());
    for (size_t i = 0; i < a.meshes[m].primitives.size(); ++i) {
      const Primitive &p = a.meshes[m].primitives[i], &q = b.meshes[m].primitives[i];
      EXPECT_EQ(p.positions, q.positions);
      EXPECT_EQ(p.colors, q.colors);
      EXPECT_EQ(p.texcoords, q.texcoords);
      EXPECT_EQ(p.indices, q.indices);
      EXPECT_EQ(p.material, q.material);
      EXPECT_EQ(p.topology, q.topology);
      ASSERT_EQ(p.normals.size(), q.normals.size());
      for (size_t v = 0; v < p.normals.size(); ++v) EXPECT_LT(glm::distance(p.normals[v], q.normals[v]), 1e-6f);
      ASSERT_EQ(p.tangents.size(), q.tangents.size());
      for (size_t v = 0; v < p.tangents.size(); ++v) EXPECT_LT(glm::distance(p.tangents[v], q.tangents[v]), 1e-6f);
      ASSERT_EQ(p.targets.size(), q.targets.size());
      for (size_t t = 0; t < p.targets.size(); ++t) {
        EXPECT_EQ(p.targets[t].positions, q.targets[t].positions);
        EXPECT_EQ(p.targets[t].normals, q.targets[t].normals);
      }
      ASSERT_EQ(p.influences.size(), q.influences.size());
      for (size_t v = 0; v < p.influences.size(); ++v) {
        EXPECT_EQ(p.influences[v].joints, q.influences[v].joints);
        EXPECT_EQ(p.influences[v].weights, q.influences[v].weights);
      }
    }
  }
  ASSERT_EQ(a.skins.size(), b.skins.size());
  for (size_t s = 0; s < a.skins.size(); ++s) {
    EXPECT_EQ(a.skins[s].joints, b.skins[s].joints);
    EXPECT_EQ(a.skins[s].inverse_bind, b.skins[s].inverse_bind);
    EXPECT_EQ(a.skins[s].skeleton, b.skins[s].skeleton);
  }
  ASSERT_EQ(a.animations.size(), b.animations.size());
  for (size_t i = 0; i < a.animations.size(); ++i) {
    ASSERT_EQ(a.animations[i].channels.size(), b.animations[i].channels.size());
    for (size_t c = 0; c < a.animations[i].channels.size(); ++c) {
      const Channel &p = a.animations[i].channels[c], &q = b.animations[i].channels[c];
      EXPECT_EQ(p.node, q.node);
      EXPECT_EQ(p.path, q.path);
      EXPECT_EQ(p.interpolation, q.interpolation);
      EXPECT_EQ(p.times, q.times);
      ASSERT_EQ(p.values.size(), q.values.size());
      for (size_t k = 0; k < p.values.size(); ++k) EXPECT_NEAR(p.values[k], q.values[k], 1e-6f);
    }
  }
}

TEST(GltfWrite, WhatIsWrittenReadsBackTheSameInBothForms) {
  const Model model = full_model();
  for (const bool binary : {true, false}) {
    const Model back = read_back(model, binary);
    expect_same(model, back);
    EXPECT_TRUE(back.warnings.empty());
    EXPECT_EQ(back.materials.at(0).base_color, model.materials[0].base_color);
    EXPECT_TRUE(back.materials.at(0).double_sided);
    // and once more, now with the looks carried through
    expect_same(back, read_back(back, binary));
  }
}

TEST(GltfWrite, EightInfluencesTakeTwoSetsAndManyJointsShorts) {
  Model model = make_model("m", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2});
  Skin skin;
  for (int j = 0; j < 300; ++j) {
    Node joint;
    joint.parent = j == 0 ? -1 : 1;
    if (j > 0) model.nodes[1].children.push_back(static_cast<int>(model.nodes.size()));
    skin.joints.push_back(static_cast<int>(model.nodes.size()));
    skin.inverse_bind.emplace_back(1);
    model.nodes.push_back(joint);
  }
  model.skins.push_back(skin);
  model.nodes[0].skin = 0;
  model.scene_roots = {0, 1};
  for (uint16_t v = 0; v < 3; ++v) {
    Influences o;
    for (uint16_t k = 0; k < 8; ++k) {
      o.joints[k] = static_cast<uint16_t>(290 + k);
      o.weights[k] = 0.125f;
    }
    model.meshes[0].primitives[0].influences.push_back(o);
  }
  const Model back = read_back(model, true);
  EXPECT_EQ(back.meshes[0].primitives[0].influences[2].joints, model.meshes[0].primitives[0].influences[2].joints);
  EXPECT_EQ(back.meshes[0].primitives[0].influences[2].weights[7], 0.125f);
}

TEST(GltfWrite, LinesAndColoursAreKept) {
  Model model = make_model("m", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2});
  add_lines(model, "iso", {{0, 0, 0}, {1, 1, 1}, {1, 1, 1}, {2, 2, 2}}, {0, 0, 0, 1});
  set_colors(model, flatten(model), {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}});
  const Model back = read_back(model, true);
  ASSERT_EQ(back.meshes.size(), 2u);
  EXPECT_EQ(back.meshes[1].primitives[0].topology, Topology::lines);
  EXPECT_EQ(back.meshes[1].primitives[0].positions.size(), 4u);
  EXPECT_EQ(back.meshes[0].primitives[0].colors[1], glm::vec4(0, 1, 0, 1));
  EXPECT_EQ(flatten(back).vertex_count(), 3u);  // lines are no surface
}

TEST(GltfWrite, MaterialsTexturesAndImagesAreCarriedThrough) {
  GlbBuilder b;
  json attributes = {{"POSITION", b.floats(unit_triangle(), "VEC3")},
                     {"TEXCOORD_0", b.floats({0, 0, 1, 0, 0, 1}, "VEC2")}};
  b.triangle_mesh(attributes)["material"] = 0;
  const std::vector<uint8_t> picture = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 1, 2, 3};
  b.document["images"] = {{{"bufferView", b.view(picture)}, {"mimeType", "image/png"}, {"name", "skin"}},
                          {{"uri", "elsewhere.png"}}};
  b.document["samplers"] = {{{"magFilter", 9728}, {"wrapS", 33071}}};
  b.document["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 1}}};
  b.document["extensionsUsed"] = {"KHR_texture_transform", "KHR_materials_clearcoat", "EXT_not_about_looks"};
  b.document["extensionsRequired"] = {"KHR_texture_transform"};
  b.document["materials"] = {
      {{"name", "fur"},
       {"pbrMetallicRoughness",
        {{"baseColorTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0.25}}}}}}}},
         {"metallicFactor", 0.25}}},
       {"emissiveTexture", {{"index", 1}}},
       {"alphaMode", "MASK"},
       {"alphaCutoff", 0.75},
       {"extensions", {{"KHR_materials_clearcoat", {{"clearcoatFactor", 0.5}}}}},
       {"extras", {{"note", "kept"}}}}};
  const std::string bytes = gltf_bytes(b.read(), false);
  const json out = json::parse(bytes);
  const json& material = out["materials"][0];
  EXPECT_EQ(material["name"], "fur");
  EXPECT_EQ(material["alphaMode"], "MASK");
  EXPECT_EQ(material["alphaCutoff"], 0.75);
  EXPECT_EQ(material["pbrMetallicRoughness"]["metallicFactor"], 0.25);
  EXPECT_EQ(material["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"]["offset"][1],
            0.25);
  EXPECT_EQ(material["extensions"]["KHR_materials_clearcoat"]["clearcoatFactor"], 0.5);
  EXPECT_EQ(material["extras"]["note"], "kept");
  EXPECT_EQ(out["images"][1]["uri"], "elsewhere.png");
  EXPECT_EQ(out["samplers"][0]["magFilter"], 9728);
  EXPECT_EQ(out["extensionsRequired"], json({"KHR_texture_transform"}));
  EXPECT_EQ(out["extensionsUsed"], json({"KHR_materials_clearcoat", "KHR_texture_transform"}));
  std::vector<uint8_t> data;
  std::string type;
  ASSERT_TRUE(decode_data_uri(out["buffers"][0]["uri"], data, type));
  const json& view = out["bufferViews"][out["images"][0]["bufferView"].get<size_t>()];
  const auto first = data.begin() + view.value("byteOffset", 0);
  EXPECT_TRUE(std::equal(picture.begin(), picture.end(), first));
  EXPECT_EQ(view["byteLength"], picture.size());
}

TEST(GltfWrite, FaultyModelsAreRefusedByNameAndLeaveTheOldFile) {
  TemporaryFolder folder;
  const auto file = folder.path / "model.glb";
  write_text(file, "old");
  const auto refuses = [&](const std::function<void(Model&)>& damage, const std::string& expected) {
    Model model = full_model();
    damage(model);
    const std::string message = message_of([&] { write_gltf(model, file); });
    EXPECT_NE(message.find(expected), std::string::npos) << message;
  };
  refuses([](Model& m) { m.meshes[0].primitives[1].positions[4].y = NAN; }, "mesh 0, primitive 1");
  refuses([](Model& m) { m.meshes[1].primitives[0].indices[0] = 9; }, "vertex 9 of 9");
  refuses([](Model& m) { m.meshes[0].primitives[0].normals.pop_back(); }, "normals");
  refuses([](Model& m) { m.meshes[0].primitives[0].influences[3].joints[1] = 3; }, "joints its skin lacks");
  refuses([](Model& m) { m.meshes[0].primitives[0].influences[3].weights = {}; }, "no weight at vertex 3");
  refuses([](Model& m) { m.animations[0].channels[2].times[1] = 0; }, "animation 0, channel 2");
  refuses([](Model& m) { m.animations[0].channels[1].values[0] = 9; }, "unit length");
  refuses([](Model& m) { m.nodes[0].parent = 3; }, "");
  refuses([](Model& m) { m.nodes[2].skin = 7; }, "node 2");
  refuses([](Model& m) { m.skins[0].joints[1] = 1; }, "twice");
  refuses([](Model& m) { m.meshes[0].primitives[0].material = 5; }, "material");
  EXPECT_NE(message_of([&] { write_gltf(full_model(), folder.path / "model.fbx"); }), "");
  EXPECT_EQ(read_bytes(file, 100), (std::vector<uint8_t>{'o', 'l', 'd'}));
  size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path)) ++files;
  EXPECT_EQ(files, 1u);  // no temporary file is left
  write_gltf(full_model(), file);
  EXPECT_GT(std::filesystem::file_size(file), 1000u);
}

TEST(GltfWrite, AFolderThatDoesNotExistIsAClearError) {
  EXPECT_NE(message_of([] { write_gltf(full_model(), "no/such/folder/model.glb"); }).find("folder"), std::string::npos);
}

}  // namespace

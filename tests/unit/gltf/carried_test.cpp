// What the reader does not use comes back: scenes, cameras, instances, extras, extensions, KTX2 images, names.
#include <gtest/gtest.h>

#include <algorithm>

#include "gltf/animate.h"
#include "gltf/file_bytes.h"
#include "gltf/flat_mesh.h"
#include "gltf/gltf_write.h"
#include "gltf_support.h"

namespace {

using namespace hf_gltf;
using namespace samples_test;

json round_trip(const GlbBuilder& b, std::vector<std::string>* warnings = nullptr) {
  const Model model = b.read();
  if (warnings) *warnings = model.warnings;
  // twice: what is written is read the same
  const std::string bytes = gltf_bytes(model, true);
  const Model again = read_gltf_bytes({bytes.begin(), bytes.end()}, "again.glb");
  EXPECT_EQ(gltf_bytes(again, true), bytes);
  return json::parse(gltf_bytes(again, false));
}

GlbBuilder one_triangle() {
  GlbBuilder b;
  b.triangle_mesh({{"POSITION", b.floats(unit_triangle(), "VEC3")}});
  return b;
}

TEST(Carried, EverySceneComesBackWithItsNameAndTheOneShown) {
  GlbBuilder b = one_triangle();
  b.document["nodes"].push_back({{"mesh", 0}, {"translation", {5, 0, 0}}});
  b.document["scenes"] = {{{"name", "stage"}, {"nodes", {0}}},
                          {{"name", "both"}, {"nodes", {1, 0}}, {"extras", {{"fog", true}}}},
                          {{"name", "nothing"}}};
  b.document["scene"] = 1;
  const Model model = b.read();
  EXPECT_EQ(model.shown_scene, 1u);
  EXPECT_EQ(flatten(model).vertex_count(), 6u);
  const json out = round_trip(b);
  ASSERT_EQ(out["scenes"].size(), 3u);
  EXPECT_EQ(out["scene"], 1);
  EXPECT_EQ(out["scenes"][0]["nodes"], json({0}));
  EXPECT_EQ(out["scenes"][1]["nodes"], json({1, 0}));
  EXPECT_EQ(out["scenes"][1]["extras"]["fog"], true);
  EXPECT_EQ(out["scenes"][2]["name"], "nothing");
}

TEST(Carried, ASceneOfAFileWithoutNodesIsAnObject) {
  GlbBuilder b;
  b.document["scenes"] = {json::object()};
  b.document["scene"] = 0;
  const json out = round_trip(b);
  ASSERT_EQ(out["scenes"].size(), 1u);
  EXPECT_TRUE(out["scenes"][0].is_object());
}

TEST(Carried, ExtrasAndExtensionsOfEveryElementComeBack) {
  GlbBuilder b = one_triangle();
  const json extras = {{"id", 12345678901ull}, {"list", {1, nullptr, "x", 0.5}}, {"none", nullptr}};
  b.document["extras"] = extras;
  b.document["asset"]["copyright"] = "somebody";
  b.document["asset"]["extras"] = extras;
  b.document["extensions"] = {{"KHR_lights_punctual", {{"lights", {{{"type", "point"}}}}}}};
  b.document["nodes"][0]["extras"] = extras;
  b.document["nodes"][0]["extensions"] = {{"KHR_lights_punctual", {{"light", 0}}}, {"VENDOR_empty", json::object()}};
  b.document["nodes"].push_back({{"extras", 7}});
  b.document["nodes"].push_back({{"extras", "text"}});
  b.document["meshes"][0]["extras"] = {{"targetNames", json::array()}, {"more", 1}};
  json& primitive = b.document["meshes"][0]["primitives"][0];
  primitive["extras"] = extras;
  primitive["material"] = 0;
  primitive["extensions"] = {{"KHR_materials_variants", {{"mappings", {{{"material", 0}, {"variants", {0}}}}}}}};
  b.document["extensions"]["KHR_materials_variants"] = {{"variants", {{{"name", "dusk"}}}}};
  b.document["materials"] = {{{"name", "m"}, {"extras", extras}}};
  b.document["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_variants", "VENDOR_empty", "VENDOR_unused"};
  std::vector<std::string> warnings;
  const json out = round_trip(b, &warnings);
  EXPECT_TRUE(warnings.empty()) << warnings[0];
  EXPECT_EQ(out["extras"], extras);
  EXPECT_EQ(out["asset"]["copyright"], "somebody");
  EXPECT_EQ(out["asset"]["extras"], extras);
  EXPECT_EQ(out["nodes"][0]["extras"], extras);
  EXPECT_EQ(out["nodes"][0]["extensions"], b.document["nodes"][0]["extensions"]);
  EXPECT_EQ(out["nodes"][1]["extras"], 7);
  EXPECT_EQ(out["nodes"][2]["extras"], "text");
  EXPECT_EQ(out["meshes"][0]["extras"]["more"], 1);
  EXPECT_EQ(out["meshes"][0]["primitives"][0]["extras"], extras);
  EXPECT_EQ(out["meshes"][0]["primitives"][0]["extensions"], primitive["extensions"]);
  EXPECT_EQ(out["extensions"], b.document["extensions"]);
  EXPECT_EQ(out["extensionsUsed"], json({"KHR_lights_punctual", "KHR_materials_variants", "VENDOR_empty"}));
}

TEST(Carried, ChannelsThatMoveNoNodeComeBackBitForBit) {
  GlbBuilder b = one_triangle();
  b.document["materials"] = {{{"name", "m"}}};
  const int times = b.floats({0, 1, 3}, "SCALAR"), colors = b.floats({1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1}, "VEC4");
  const int shown = b.accessor(b.view(std::vector<uint8_t>{1, 0, 1}), 3, "SCALAR", 5121);
  const int back = b.floats({0, 2, 1}, "SCALAR");
  const auto pointer = [](const char* to) {
    return json{{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", to}}}}}};
  };
  const json color = pointer("/materials/0/pbrMetallicRoughness/baseColorFactor");
  const json seen = pointer("/nodes/0/extensions/KHR_node_visibility/visible");
  b.document["animations"] = {{{"name", "dusk"},
                               {"samplers",
                                {{{"input", times}, {"output", colors}},
                                 {{"input", times}, {"output", shown}, {"interpolation", "STEP"}},
                                 {{"input", back}, {"output", shown}}}},
                               {"channels",
                                {{{"sampler", 0}, {"target", color}},
                                 {{"sampler", 1}, {"target", seen}},
                                 {{"sampler", 2}, {"target", seen}},
                                 {{"sampler", 0}, {"target", {{"path", "rotation"}}}}}}}};
  std::vector<std::string> warnings;
  const json out = round_trip(b, &warnings);
  ASSERT_EQ(warnings.size(), 2u);  // the keys that go back, the target that is none
  ASSERT_EQ(out["animations"].size(), 1u);
  const json& animation = out["animations"][0];
  EXPECT_EQ(animation["name"], "dusk");
  ASSERT_EQ(animation["channels"].size(), 2u);
  EXPECT_EQ(animation["channels"][0]["target"], color);
  EXPECT_EQ(animation["channels"][1]["target"], seen);
  const json& sampler = animation["samplers"][animation["channels"][1]["sampler"].get<size_t>()];
  EXPECT_EQ(sampler["interpolation"], "STEP");
  const json& accessor = out["accessors"][sampler["output"].get<size_t>()];
  EXPECT_EQ(accessor["componentType"], 5121);
  std::vector<uint8_t> data;
  std::string type;
  ASSERT_TRUE(decode_data_uri(out["buffers"][0]["uri"], data, type));
  const size_t first = out["bufferViews"][accessor["bufferView"].get<size_t>()].value("byteOffset", size_t{0});
  EXPECT_EQ(std::vector<uint8_t>(data.begin() + static_cast<std::ptrdiff_t>(first),
                                 data.begin() + static_cast<std::ptrdiff_t>(first) + 3),
            (std::vector<uint8_t>{1, 0, 1}));
  EXPECT_EQ(out["extensionsUsed"], json({"KHR_animation_pointer"}));
}

TEST(Carried, AttributesThatNoProgramReadsComeBack) {
  GlbBuilder b;
  const auto shorts = [&](const std::vector<uint16_t>& values, const char* type, size_t count) {
    return b.accessor(b.view(values), count, type, 5123, true);
  };
  const int ids = b.accessor(b.view(std::vector<uint8_t>{7, 8, 9}), 3, "SCALAR", 5121);
  const int color = b.floats({1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3");
  b.triangle_mesh({{"POSITION", b.floats(unit_triangle(), "VEC3")},
                   {"COLOR_0", color},
                   {"COLOR_1", shorts({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, "VEC4", 3)},
                   {"TEXCOORD_1", b.floats({0, 0, 1, 0, 0, 1}, "VEC2")},
                   {"_FEATURE_ID_0", ids},
                   {"_WIDE", b.accessor(b.view(std::vector<uint32_t>{1, 2, 3}), 3, "SCALAR", 5125)}});
  std::vector<std::string> warnings;
  const json out = round_trip(b, &warnings);
  // a set without the one before, and a type that glTF does not allow there
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[0].find("TEXCOORD_1"), std::string::npos);
  EXPECT_NE(warnings[1].find("_WIDE"), std::string::npos);
  const json& attributes = out["meshes"][0]["primitives"][0]["attributes"];
  EXPECT_EQ(attributes.size(), 4u);
  const Model model = b.read();
  const auto& carried = model.meshes[0].primitives[0].carried_attributes;
  ASSERT_EQ(carried.size(), 2u);
  EXPECT_EQ(carried[1].second.bytes, (std::vector<uint8_t>{7, 8, 9}));
  // glTF wants a byte for each vertex on four of them
  const json& view =
      out["bufferViews"][out["accessors"][attributes["_FEATURE_ID_0"].get<size_t>()]["bufferView"].get<size_t>()];
  EXPECT_EQ(view["byteStride"], 4);
  // and a still copy has them too
  const FlatMesh mesh = flatten(model);
  EXPECT_EQ(bake(model, mesh, mesh.positions).meshes[0].primitives[0].carried_attributes.size(), 2u);
}

TEST(Carried, PointsComeBackAndAreNoSurface) {
  GlbBuilder b = one_triangle();
  b.triangle_mesh({{"POSITION", b.floats({0, 0, 0, 1, 2, 3}, "VEC3")}})["mode"] = 0;
  const Model model = b.read();
  EXPECT_TRUE(model.warnings.empty());
  EXPECT_EQ(flatten(model).vertex_count(), 3u);
  const json out = round_trip(b);
  ASSERT_EQ(out["meshes"].size(), 2u);
  EXPECT_EQ(out["meshes"][1]["primitives"][0]["mode"], 0);
  EXPECT_EQ(out["accessors"][out["meshes"][1]["primitives"][0]["attributes"]["POSITION"].get<size_t>()]["count"], 2);
}

TEST(Carried, TangentsOfMorphTargetsComeBackWhereThereAreTangents) {
  GlbBuilder b;
  const int moved = b.floats({0, 0, 0, 0, 0, 1, 0, 0, 0}, "VEC3");
  json& primitive = b.triangle_mesh({{"POSITION", b.floats(unit_triangle(), "VEC3")},
                                     {"NORMAL", b.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")},
                                     {"TANGENT", b.floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4")}});
  primitive["targets"] = {{{"POSITION", moved}, {"TANGENT", moved}}};
  EXPECT_TRUE(b.read().warnings.empty());
  EXPECT_TRUE(round_trip(b)["meshes"][0]["primitives"][0]["targets"][0].contains("TANGENT"));
  primitive["attributes"].erase("TANGENT");
  EXPECT_EQ(b.read().warnings.size(), 1u);
  EXPECT_FALSE(round_trip(b)["meshes"][0]["primitives"][0]["targets"][0].contains("TANGENT"));
}

// A node that mirrors turns the side of a tangent: n x t of the picture is that of the mirrored surface.
TEST(Carried, TangentsOfAStillCopyLieInTheScene) {
  for (const float side : {1.0f, -1.0f}) {
    GlbBuilder b;
    b.triangle_mesh({{"POSITION", b.floats(unit_triangle(), "VEC3")},
                     {"NORMAL", b.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")},
                     {"TANGENT", b.floats({0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1}, "VEC4")}});
    b.document["nodes"][0]["rotation"] = {0, 0, 0.70710678, 0.70710678};  // x to y, y to -x
    b.document["nodes"][0]["scale"] = {side * 1e-5, 1e-5, 1e-5};
    const Model model = b.read();
    const FlatMesh mesh = flatten(model);
    const Primitive still = bake(model, mesh, mesh.positions).meshes[0].primitives[0];
    ASSERT_EQ(still.tangents.size(), 3u);
    EXPECT_LT(glm::distance(still.tangents[1], glm::vec4(-1, 0, 0, side)), 1e-5f);
    // the picture's second direction: the node's matrix times n x t = -x
    const glm::vec3 second = glm::cross(still.normals[1], glm::vec3(still.tangents[1])) * still.tangents[1].w;
    EXPECT_LT(glm::distance(second, glm::vec3(0, -side, 0)), 1e-5f);
  }
}

TEST(Carried, TablesThatNameViewsAreDroppedByName) {
  GlbBuilder b = one_triangle();
  b.document["extensions"] = {
      {"EXT_structural_metadata",
       {{"schema", json::object()}, {"propertyTables", {{{"properties", {{"a", {{"values", 0}}}}}}}}}}};
  std::vector<std::string> warnings;
  EXPECT_FALSE(round_trip(b, &warnings).contains("extensions"));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("EXT_structural_metadata"), std::string::npos);
}

// Accessors and views get new numbers, so such an extension would name others.
TEST(Carried, AnExtensionThatNamesAnAccessorIsDroppedByName) {
  GlbBuilder b = one_triangle();
  b.document["nodes"][0]["extensions"] = {{"VENDOR_data", {{"inner", {{"accessor", 0}}}}}, {"VENDOR_kept", {{"a", 1}}}};
  std::vector<std::string> warnings;
  const json out = round_trip(b, &warnings);
  EXPECT_EQ(out["nodes"][0]["extensions"], json({{"VENDOR_kept", {{"a", 1}}}}));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("VENDOR_data"), std::string::npos);
}

TEST(Carried, CamerasComeBackOnTheirNodes) {
  GlbBuilder b = one_triangle();
  b.document["cameras"] = {
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"zfar", 10}, {"znear", 0.5}}}},
      {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}, {"name", "eye"}}};
  b.document["nodes"].push_back({{"camera", 1}});
  const json out = round_trip(b);
  EXPECT_EQ(out["cameras"], b.document["cameras"]);
  EXPECT_EQ(out["nodes"][1]["camera"], 1);
  b.document["nodes"][1]["camera"] = 2;
  EXPECT_NE(message_of([&] { b.read(); }).find("camera"), std::string::npos);
}

TEST(Carried, InstancesComeBackAndAreSaid) {
  GlbBuilder b = one_triangle();
  const int places = b.floats({0, 0, 0, 1, 2, 3}, "VEC3");
  const int turns = b.accessor(b.view(std::vector<int16_t>{0, 0, 0, 32767, 0, 0, 32767, 0}), 2, "VEC4", 5122, true);
  b.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", places},
                                                                                   {"ROTATION", turns}};
  b.document["extensionsUsed"] = b.document["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  const Model model = b.read();
  ASSERT_TRUE(model.nodes[0].instances.has_value());
  EXPECT_EQ(model.nodes[0].instances->translations[1], glm::vec3(1, 2, 3));
  EXPECT_EQ(model.nodes[0].instances->rotations[1], glm::vec4(0, 0, 1, 0));
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_NE(model.warnings[0].find("2 times"), std::string::npos);
  const json out = round_trip(b);
  EXPECT_EQ(out["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"].size(), 2u);
  EXPECT_EQ(out["extensionsRequired"], json({"EXT_mesh_gpu_instancing"}));
  b.document["accessors"][static_cast<size_t>(places)]["count"] = 1;
  EXPECT_NE(message_of([&] { b.read(); }).find("different lengths"), std::string::npos);
}

TEST(Carried, Ktx2ImagesPassThroughByteForByte) {
  GlbBuilder b = one_triangle();
  std::vector<uint8_t> ktx = {0xab, 'K', 'T', 'X', ' ', '2', '0', 0xbb, '\r', '\n', 0x1a, '\n'};
  for (int i = 0; i < 100; ++i) ktx.push_back(static_cast<uint8_t>(i * 37));
  b.document["images"] = {{{"bufferView", b.view(ktx)}, {"mimeType", "image/ktx2"}}};
  b.document["textures"] = {{{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}};
  b.document["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  b.document["extensionsUsed"] = b.document["extensionsRequired"] = {"KHR_texture_basisu"};
  const json out = round_trip(b);
  EXPECT_EQ(out["textures"][0]["extensions"], b.document["textures"][0]["extensions"]);
  EXPECT_FALSE(out["textures"][0].contains("source"));
  EXPECT_EQ(out["images"][0]["mimeType"], "image/ktx2");
  EXPECT_EQ(out["extensionsRequired"], json({"KHR_texture_basisu"}));
  std::vector<uint8_t> data;
  std::string type;
  ASSERT_TRUE(decode_data_uri(out["buffers"][0]["uri"], data, type));
  const json& view = out["bufferViews"][out["images"][0]["bufferView"].get<size_t>()];
  ASSERT_EQ(view["byteLength"], ktx.size());
  EXPECT_TRUE(std::equal(ktx.begin(), ktx.end(), data.begin() + view.value("byteOffset", 0)));
}

TEST(Carried, NamesComeBackInAnyScript) {
  GlbBuilder b = one_triangle();
  const std::vector<std::string> names = {"Pferd \xc3\xa4\xc3\xb6\xc3\xbc\xc3\x9f", "\xe9\xa6\xac",
                                          "\xd8\xad\xd8\xb5\xd8\xa7\xd9\x86", "\xf0\x9f\x90\x8e",
                                          "quote \" back \\ line\n"};
  for (const std::string& name : names) b.document["nodes"].push_back({{"name", name}});
  b.document["meshes"][0]["name"] = names[1];
  b.document["scenes"] = {{{"name", names[2]}, {"nodes", {0}}}};
  b.document["nodes"][0]["extras"] = {{names[3], names[2]}};
  const json out = round_trip(b);
  for (size_t i = 0; i < names.size(); ++i) EXPECT_EQ(out["nodes"][i + 1]["name"], names[i]);
  EXPECT_EQ(out["meshes"][0]["name"], names[1]);
  EXPECT_EQ(out["scenes"][0]["name"], names[2]);
  EXPECT_EQ(out["nodes"][0]["extras"], b.document["nodes"][0]["extras"]);
}

TEST(Carried, ANodeThatTurnsZUpIsSaid) {
  GlbBuilder b = one_triangle();
  EXPECT_TRUE(b.read().notes.empty());
  b.document["nodes"][0]["rotation"] = {-0.70710678, 0, 0, 0.70710678};
  const Model model = b.read();
  ASSERT_EQ(model.notes.size(), 1u);
  EXPECT_NE(model.notes[0].find("Z up"), std::string::npos);
  EXPECT_NEAR(flatten(model).positions[2].z, -1, 1e-6);  // y of the file goes back, z up
}

// A matrix with a scale of 0 has no rotation of its own; an animated node needs one.
TEST(Carried, AnAnimatedNodeOfAScaleOfZeroIsTakenApart) {
  for (const std::vector<float>& scale : {std::vector<float>{2, 0, 3}, {0, 0, 3}, {0, 0, 0}, {-2, 1, 1}, {-2, 0, -1}}) {
    GlbBuilder b = one_triangle();
    const glm::mat3 turn = glm::mat3_cast(glm::normalize(glm::quat(0.5f, 0.1f, 0.7f, -0.3f)));
    json matrix = json::array();
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 4; ++r) matrix.push_back(r < 3 ? turn[c][r] * scale[static_cast<size_t>(c)] : 0.0f);
    }
    for (const float t : {1.0f, 2.0f, 3.0f, 1.0f}) matrix.push_back(t);
    b.document["nodes"][0]["matrix"] = matrix;
    const FlatMesh still = flatten(b.read());
    const int times = b.floats({0, 1}, "SCALAR"), values = b.floats({1, 2, 3, 1, 2, 3}, "VEC3");
    b.document["animations"] = {{{"samplers", {{{"input", times}, {"output", values}}}},
                                 {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
    const FlatMesh moved = flatten(b.read());
    for (size_t v = 0; v < 3; ++v) EXPECT_LT(glm::distance(still.positions[v], moved.positions[v]), 1e-5) << v;
  }
}

}  // namespace

// Sizes at both ends. Those that multiply are refused with file, count and limit, before memory is taken; lists without
// elements, which converters write, are skipped with a sentence.
#include <gtest/gtest.h>

#include <string>

#include "gltf/animate.h"
#include "gltf/flat_mesh.h"
#include "gltf/gltf_read.h"
#include "gltf/gltf_write.h"
#include "gltf_support.h"

namespace {

using namespace hf_gltf;
using samples_test::message_of;

std::string times(size_t count, const std::string& element) {
  std::string out;
  for (size_t i = 0; i < count; ++i) out += (i ? "," : "") + element;
  return out;
}

// A file without buffers: one triangle of zeros on some nodes.
std::string zeros(size_t count, const std::string& nodes, const std::string& more = "") {
  return R"({"asset":{"version":"2.0"},"accessors":[{"componentType":5126,"type":"VEC3","count":)" +
         std::to_string(count) + R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[)" + nodes +
         "]" + more + "}";
}

Model read(const std::string& text, const ReadLimits& limits = {}) {
  return read_gltf_bytes({text.begin(), text.end()}, "the file", {}, limits);
}

void expect_refused(const std::string& message, const std::string& count, const std::string& limit) {
  EXPECT_NE(message.find("the file"), std::string::npos) << message;
  EXPECT_NE(message.find(count), std::string::npos) << message;
  EXPECT_NE(message.find(limit), std::string::npos) << message;
}

TEST(GltfLimits, ListsOfNodesAndLooks) {
  ReadLimits limits;
  limits.max_nodes = 3;
  limits.max_looks = 4;
  EXPECT_NO_THROW(read(zeros(3, times(3, "{}"), R"(,"materials":[{},{},{},{}])"), limits));
  expect_refused(message_of([&] { read(zeros(3, times(7, "{}")), limits); }), "nodes has 7", "limit of 3");
  for (const char* list : {"materials", "textures", "images", "samplers", "scenes"}) {
    const std::string more = std::string(",\"") + list + "\":[" + times(9, "{}") + "]";
    expect_refused(message_of([&] { read(zeros(3, "{}", more), limits); }), std::string(list) + " has 9", "limit of 4");
  }
}

// A hundred bytes may ask for 16 MB of zeros, not for 128.
TEST(GltfLimits, DecodedBytesFollowTheSizeOfTheFile) {
  EXPECT_EQ(read(zeros(300000, R"({"mesh":0})")).meshes[0].primitives[0].positions.size(), 300000u);
  expect_refused(message_of([&] { read(zeros(3000000, R"({"mesh":0})")); }), "meshes[0].primitives[0] takes",
                 "limit of 16");
  ReadLimits trusted;
  trusted.free_decoded_bytes = trusted.max_decoded_bytes;
  EXPECT_NO_THROW(read(zeros(3000000, R"({"mesh":0})"), trusted));
}

TEST(GltfLimits, ImagesOnTheSameBytes) {
  const std::string text = R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":3,"uri":"data:;base64,AAAA"}],)"
                           R"("bufferViews":[{"buffer":0,"byteLength":3}],"images":[)" +
                           times(5, R"({"bufferView":0,"mimeType":"image/png"})") + "]}";
  EXPECT_NO_THROW(read(text));
  ReadLimits limits;
  limits.free_decoded_bytes = 14;
  limits.decoded_per_byte = 0;
  expect_refused(message_of([&] { read(text, limits); }), "images[4] takes what images copy from views to 15",
                 "limit of 14");
}

TEST(GltfLimits, MorphWeightsOfAllNodes) {
  const std::string mesh = R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])";
  std::string text = zeros(3, times(4, R"({"mesh":0})"));
  const std::string morphed =
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"targets":[)" + times(5, R"({"POSITION":0})") + "]}]}]";
  text.replace(text.find(mesh), mesh.size(), morphed);
  EXPECT_NO_THROW(read(text));
  ReadLimits limits;
  limits.max_morph_weights = 19;
  expect_refused(message_of([&] { read(text, limits); }), "nodes[3] takes the morph weights of all nodes to 20",
                 "limit of 19");
}

TEST(GltfLimits, NodesThatShareAMesh) {
  const Model model = read(zeros(30, times(20, R"({"mesh":0})")));
  EXPECT_EQ(flatten(model).vertex_count(), 600u);
  FlattenOptions options;
  options.free_vertices = 400;
  expect_refused(message_of([&] { flatten(model, options); }), "node 17 takes", "above the limit of 520 for 30 stored");
  options.max_copies = 20;
  options.free_vertices = 0;
  EXPECT_EQ(flatten(model, options).vertex_count(), 600u);
}

// Buffers without bytes are skipped where no view names them, whatever the number of either.
TEST(GltfLimits, BuffersWithoutBytes) {
  const auto text = [](size_t viewed) {
    return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":3,"uri":"data:;base64,AAAA"},)" +
           times(2000, R"({"byteLength":1})") + R"(],"bufferViews":[)" + times(2000, R"({"buffer":0,"byteLength":1})") +
           R"(,{"buffer":)" + std::to_string(viewed) + R"(,"byteLength":1}]})";
  };
  EXPECT_NO_THROW(read(text(0)));
  expect_refused(message_of([&] { read(text(1234)); }), "buffers[1234]", "no uri");
}

// How many primitives lack how many targets is bounded too.
TEST(GltfLimits, TargetsThatPrimitivesLack) {
  const std::string mesh = R"({"attributes":{"POSITION":0}})";
  std::string text = zeros(3, R"({"mesh":0})");
  text.replace(text.find(mesh), mesh.size(),
               times(2000, mesh) + R"(,{"attributes":{"POSITION":0},"targets":[)" + times(20000, "{}") + "]}");
  expect_refused(message_of([&] { read(text); }), "meshes[0] takes", "limit");
}

Model again(const Model& model) {
  const std::string written = gltf_bytes(model, true);
  Model out = read_gltf_bytes({written.begin(), written.end()}, "again");
  EXPECT_TRUE(out.warnings.empty());
  return out;
}

bool warns(const Model& model, const std::string& sentence) {
  for (const std::string& warning : model.warnings)
    if (warning.find(sentence) != std::string::npos) return true;
  return false;
}

const char* const moving = R"({"name":"walk","extras":{"id":7},"samplers":[{"input":1,"output":0}],)"
                           R"("channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}]})";

// The triangle of zeros(), times for its three elements, three accessors without elements, two clips.
std::string with_empties(const std::string& clip, const std::string& nodes = R"({"mesh":0})") {
  std::string text = zeros(3, nodes, R"(,"animations":[)" + clip + "," + moving + "]");
  const size_t end = text.find("}],\"meshes\"") + 1;
  const std::string buffer = R"("buffers":[{"byteLength":12,"uri":"data:;base64,AAAAAAAAgD8AAABA"}],)"
                             R"("bufferViews":[{"buffer":0,"byteLength":12}],)";
  text.insert(end, R"(,{"componentType":5126,"type":"SCALAR","count":3,"bufferView":0})"
                   R"(,{"componentType":5126,"type":"VEC3","count":0,"bufferView":0,"byteOffset":500})"
                   R"(,{"componentType":5126,"type":"SCALAR","count":0})"
                   R"(,{"componentType":5125,"type":"SCALAR","count":0,"sparse":{"count":0}})");
  return text.insert(1, buffer);
}

TEST(GltfEmpty, AClipThatMovesNothingIsSkipped) {
  for (const char* clip :
       {R"({"channels":[],"name":"Take 001","samplers":[]})", "{}", R"({"channels":[]})",
        R"({"channels":[],"samplers":[{"input":77,"output":-1}]})",
        R"({"samplers":[{"input":1,"output":0}],"channels":[{"sampler":0,"target":{"path":"scale"}}]})",
        R"({"samplers":[{"input":3,"output":2}],"channels":[{"sampler":0,"target":{"node":0,"path":"scale"}}]})"}) {
    const Model model = read(with_empties(clip));
    EXPECT_TRUE(warns(model, "animations[0] moves nothing and is skipped")) << clip;
    ASSERT_EQ(model.animations.size(), 1u) << clip;
    EXPECT_EQ(model.animations[0].name, "walk");
    EXPECT_EQ(model.animations[0].carried.extras, R"({"id":7})");
    const Model back = again(model);
    ASSERT_EQ(back.animations.size(), 1u);
    EXPECT_EQ(back.animations[0].carried.extras, R"({"id":7})");
  }
  EXPECT_NE(message_of([] { read(with_empties(R"({"channels":[{"sampler":0,"target":{}}]})")); }).find("samplers"),
            std::string::npos);
}

TEST(GltfEmpty, AMeshWithoutPrimitivesShowsNothing) {
  for (const char* mesh : {R"({"primitives":[]})", R"({"name":"a"})", R"({"primitives":[],"weights":[1]})",
                           R"({"primitives":[{"attributes":{"POSITION":2}}]})"}) {
    std::string text = with_empties("{}", R"({"mesh":0},{"mesh":1,"name":"none"})");
    text.insert(text.find("],\"nodes\""), std::string(",") + mesh);
    const Model model = read(text);
    EXPECT_TRUE(warns(model, "meshes[1]")) << mesh;
    ASSERT_EQ(model.meshes.size(), 2u);
    EXPECT_TRUE(model.meshes[1].primitives.empty());
    EXPECT_EQ(flatten(model).vertex_count(), 3u);
    const Model back = again(model);
    EXPECT_EQ(back.meshes.size(), 1u);
    EXPECT_EQ(back.nodes[1].mesh, -1);
  }
}

TEST(GltfEmpty, AnAccessorWithoutElementsIsReadWhereItFits) {
  const auto primitive = [](const std::string& json, const std::string& more = "") {
    std::string text = with_empties("{}");
    const std::string plain = R"({"attributes":{"POSITION":0}})";
    text.replace(text.find(plain), plain.size(), json);
    return text.insert(text.size() - 1, more);
  };
  const Model model = read(primitive(R"({"attributes":{"POSITION":0},"indices":4,"targets":[{"POSITION":2}]})"));
  EXPECT_TRUE(warns(model, "meshes[0].primitives[0] has no POSITION, or no elements, and is skipped"));
  EXPECT_TRUE(again(model).meshes.empty());
  EXPECT_NE(message_of([&] { read(primitive(R"({"attributes":{"POSITION":0,"NORMAL":2}})")); }).find("0 elements"),
            std::string::npos);
  EXPECT_NE(
      message_of([&] {
        read(primitive(R"({"attributes":{"POSITION":0}})", R"(,"skins":[{"joints":[0],"inverseBindMatrices":2}])"));
      }).find("0 matrices"),
      std::string::npos);
  // keys of what moves no node
  const Model pointed = read(with_empties(
      R"({"samplers":[{"input":3,"output":0}],"channels":[{"sampler":0,"target":{"path":"pointer","extensions":)"
      R"({"KHR_animation_pointer":{"pointer":"/materials/0/x"}}}}]})"));
  EXPECT_TRUE(warns(pointed, "keys that do not fit"));
}

TEST(GltfEmpty, BuffersAndViewsWithoutBytesAreRead) {
  for (const char* buffer : {R"({"byteLength":0})", R"({"byteLength":0,"uri":"data:;base64,"})"}) {
    const std::string text = std::string(R"({"asset":{"version":"2.0"},"buffers":[)") + buffer +
                             R"(],"bufferViews":[{"buffer":0,"byteLength":0,"byteOffset":9}])";
    EXPECT_NO_THROW(read(text + "}")) << buffer;
    EXPECT_NE(
        message_of([&] { read(text + R"(,"images":[{"bufferView":0,"mimeType":"image/png"}]})"); }).find("images[0]"),
        std::string::npos);
    EXPECT_NE(message_of([&] {
                read(text + R"(,"accessors":[{"componentType":5126,"type":"VEC3","count":1,"bufferView":0}]})");
              }).find("needs 12 bytes"),
              std::string::npos);
  }
}

TEST(GltfEmpty, ASkinWithoutJointsIsSkippedAndTheOthersMoveUp) {
  const Model model = read(zeros(3, R"({"mesh":0,"skin":0},{"skin":1},{"mesh":0,"skin":2})",
                                 R"(,"skins":[{"joints":[]},{"joints":[0],"name":"a"},{"joints":[1],"name":"b"}])"));
  EXPECT_TRUE(warns(model, "skins[0] has no joints and is skipped"));
  ASSERT_EQ(model.skins.size(), 2u);
  EXPECT_EQ(model.nodes[0].skin, -1);
  EXPECT_EQ(model.skins[static_cast<size_t>(model.nodes[1].skin)].name, "a");
  EXPECT_EQ(model.skins[static_cast<size_t>(model.nodes[2].skin)].name, "b");
  again(model);
}

// As Blender reads them: a target that a primitive lacks does not move it.
TEST(GltfEmpty, PrimitivesWithUnlikeMorphTargetsMoveByTheirOwn) {
  samples_test::GlbBuilder b;
  const int at = b.floats(samples_test::unit_triangle(), "VEC3"), by = b.floats({1, 2, 3, 4, 5, 6, 7, 8, 9}, "VEC3");
  b.triangle_mesh({{"POSITION", at}});
  auto& primitives = b.document["meshes"][0]["primitives"];
  primitives.push_back({{"attributes", {{"POSITION", at}}}, {"targets", {{{"POSITION", by}}, {{"POSITION", at}}}}});
  b.document["meshes"][0]["weights"] = {0.5, 0};
  const int keys = b.floats({0, 1}, "SCALAR"), values = b.floats({0, 0, 1, 2}, "SCALAR");
  b.document["animations"] = {{{"samplers", {{{"input", keys}, {"output", values}}}},
                               {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}}};
  const Model model = b.read();
  EXPECT_TRUE(warns(model, "different numbers of morph targets"));
  for (const Model& o : {model, again(model)}) {
    const FlatMesh mesh = flatten(o);
    const std::vector<glm::dvec3> moved = posed_positions(o, mesh, o.animations.at(0), 1);
    ASSERT_EQ(moved.size(), 6u);
    for (size_t v = 0; v < 3; ++v) {
      const glm::dvec3 place(o.meshes[0].primitives[0].positions[v]), way(3 * v + 1, 3 * v + 2, 3 * v + 3);
      EXPECT_EQ(moved[v], place);
      EXPECT_EQ(moved[3 + v], place + way + 2.0 * place);
    }
  }
}

// A small primitive of a large skin computes the joints it names only: the same bits.
TEST(GltfLimits, AFewVerticesOfALargeSkin) {
  Model model;
  model.name = "the file";
  model.nodes.resize(101);
  for (int j = 0; j < 100; ++j) {
    Node& node = model.nodes[static_cast<size_t>(j)];
    node.rotation = glm::angleAxis(0.1f * static_cast<float>(j), glm::normalize(glm::vec3(1, 2, 3)));
    node.translation = {0.3f * static_cast<float>(j), 1, 0};
  }
  Skin large, small;
  for (int j = 0; j < 100; ++j) large.joints.push_back(j);
  large.inverse_bind.assign(100, glm::mat4(2));
  small.joints = {7, 93};
  small.inverse_bind.assign(2, glm::mat4(2));
  model.skins = {large, small};
  Primitive primitive;
  primitive.positions = {{1, 2, 3}};
  Influences influences;
  influences.joints[0] = 7;
  influences.joints[1] = 93;
  influences.weights[0] = 0.25f;
  influences.weights[1] = 0.75f;
  primitive.influences = {influences};
  const auto globals = global_matrices(model, rest_pose(model));
  model.nodes[100].skin = 0;
  const glm::dmat4 few = vertex_matrices(model, globals, 100, primitive)[0];
  model.nodes[100].skin = 1;
  primitive.influences[0].joints[0] = 0;
  primitive.influences[0].joints[1] = 1;
  EXPECT_EQ(few, vertex_matrices(model, globals, 100, primitive)[0]);
  primitive.influences[0].joints[0] = 100;
  model.nodes[100].skin = 0;
  EXPECT_THROW(vertex_matrices(model, globals, 100, primitive), std::runtime_error);
}

// The writer keeps a skin's skeleton where it is above all joints, itself included, and drops it elsewhere.
TEST(GltfLimits, SkeletonsAboveTheirJoints) {
  const std::string text =
      zeros(3, R"({"children":[1,2]},{"children":[3]},{"mesh":0},{"name":"tip"},{"name":"apart"})",
            R"(,"skins":[{"skeleton":0,"joints":[0,1,3]},{"skeleton":1,"joints":[3]},{"skeleton":1,"joints":[3,2]},)"
            R"({"skeleton":4,"joints":[3]},{"skeleton":3,"joints":[3]},{"skeleton":3,"joints":[1]}])");
  const std::string written = gltf_bytes(read(text), true);
  const Model again = read_gltf_bytes({written.begin(), written.end()}, "the file");
  std::vector<int> skeletons;
  for (const Skin& skin : again.skins) skeletons.push_back(skin.skeleton);
  EXPECT_EQ(skeletons, (std::vector<int>{0, 1, -1, -1, 3, -1}));
}

}  // namespace

// Reading glTF: decoding of every stored form, and the faults that must be refused by name.
#include <gtest/gtest.h>

#include "gltf_support.h"

namespace {

using namespace hf_gltf;
using namespace samples_test;

const Primitive& only_primitive(const Model& model) { return model.meshes.at(0).primitives.at(0); }

TEST(GltfRead, PositionsAndIndicesComeBackAsStored) {
  GlbBuilder b;
  json& primitive = b.triangle_mesh({{"POSITION", b.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3")}});
  const int indices = b.accessor(b.view(std::vector<uint16_t>{0, 1, 2, 2, 1, 3}), 6, "SCALAR", 5123);
  primitive["indices"] = indices;
  const Model model = b.read();
  EXPECT_EQ(only_primitive(model).positions.size(), 4u);
  EXPECT_EQ(only_primitive(model).positions[3], glm::vec3(1, 1, 0));
  EXPECT_EQ(only_primitive(model).indices, (std::vector<uint32_t>{0, 1, 2, 2, 1, 3}));
}

TEST(GltfRead, InterleavedAttributesAreTakenApartByTheirStride) {
  GlbBuilder b;
  const int view = b.view(std::vector<float>{0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0}, 24);
  const int positions = b.accessor(view, 3, "VEC3", 5126), normals = b.accessor(view, 3, "VEC3", 5126);
  b.document["accessors"][static_cast<size_t>(normals)]["byteOffset"] = 12;
  b.triangle_mesh({{"POSITION", positions}, {"NORMAL", normals}});
  const Model model = b.read();
  EXPECT_EQ(only_primitive(model).positions[2], glm::vec3(0, 1, 0));
  EXPECT_EQ(only_primitive(model).normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(only_primitive(model).normals[2], glm::vec3(1, 0, 0));
}

TEST(GltfRead, SparseValuesReplaceThoseOfTheViewAndOfZeros) {
  for (const bool with_view : {true, false}) {
    GlbBuilder b;
    const int view = with_view ? b.view(std::vector<float>{1, 1, 1, 2, 2, 2, 3, 3, 3}) : -1;
    const int positions = b.accessor(view, 3, "VEC3", 5126);
    const int indices = b.view(std::vector<uint16_t>{0, 2}), values = b.view(std::vector<float>{7, 8, 9, 4, 5, 6});
    b.document["accessors"][static_cast<size_t>(positions)]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
        {"values", {{"bufferView", values}}}};
    b.triangle_mesh({{"POSITION", positions}});
    const Model model = b.read();
    EXPECT_EQ(only_primitive(model).positions[0], glm::vec3(7, 8, 9));
    EXPECT_EQ(only_primitive(model).positions[1], with_view ? glm::vec3(2) : glm::vec3(0));
    EXPECT_EQ(only_primitive(model).positions[2], glm::vec3(4, 5, 6));
  }
}

TEST(GltfRead, SparseIndicesMustLieInsideAndIncrease) {
  const std::vector<std::vector<uint16_t>> cases = {{0, 3}, {2, 1}, {1, 1}};
  for (const auto& wrong : cases) {
    GlbBuilder b;
    const int positions = b.accessor(b.view(unit_triangle()), 3, "VEC3", 5126);
    const int indices = b.view(wrong), values = b.view(std::vector<float>(6, 1));
    b.document["accessors"][static_cast<size_t>(positions)]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
        {"values", {{"bufferView", values}}}};
    b.triangle_mesh({{"POSITION", positions}});
    EXPECT_NE(message_of([&] { b.read(); }).find("sparse"), std::string::npos);
  }
}

TEST(GltfRead, QuantisedAttributesDecodeByTheSpecificationsFormulas) {
  GlbBuilder b;
  b.document["extensionsUsed"] = b.document["extensionsRequired"] = {"KHR_mesh_quantization"};
  // i16 as they are, four of them per vertex for the alignment
  const int positions =
      b.accessor(b.view(std::vector<int16_t>{-5, 0, 3, 0, 100, 0, 0, 0, 0, 32767, -32768, 0}, 8), 3, "VEC3", 5122);
  const int normals =
      b.accessor(b.view(std::vector<int8_t>{127, 0, -127, 0, 0, 127, 0, 0, -128, 0, 0, 0}, 4), 3, "VEC3", 5120, true);
  const int texcoords = b.accessor(b.view(std::vector<uint16_t>{0, 65535, 13107, 0, 0, 0}), 3, "VEC2", 5123, true);
  const int colors =
      b.accessor(b.view(std::vector<uint8_t>{255, 0, 51, 255, 0, 0, 0, 0, 1, 2, 3, 4}), 3, "VEC4", 5121, true);
  b.triangle_mesh({{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", texcoords}, {"COLOR_0", colors}});
  const Model model = b.read();
  const Primitive& p = only_primitive(model);
  EXPECT_EQ(p.positions[0], glm::vec3(-5, 0, 3));
  EXPECT_EQ(p.positions[2], glm::vec3(0, 32767, -32768));
  EXPECT_EQ(p.normals[0], glm::vec3(1, 0, -1));
  EXPECT_EQ(p.normals[2].x, -1.0f);  // -128 is clamped
  EXPECT_EQ(p.texcoords.at(0)[0], glm::vec2(0, 1));
  EXPECT_FLOAT_EQ(p.texcoords.at(0)[1].x, 0.2f);
  EXPECT_FLOAT_EQ(p.colors[0].z, 0.2f);
  EXPECT_FLOAT_EQ(p.colors[2].w, 4 / 255.0f);
}

TEST(GltfRead, IntegerPositionsWithoutTheExtensionAreRefusedByItsName) {
  GlbBuilder b;
  b.triangle_mesh({{"POSITION", b.accessor(b.view(std::vector<int16_t>(12, 0), 8), 3, "VEC3", 5122)}});
  EXPECT_NE(message_of([&] { b.read(); }).find("KHR_mesh_quantization"), std::string::npos);
}

TEST(GltfRead, StripsAndFansBecomeTheTrianglesTheSpecificationLists) {
  const std::vector<float> five = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0};
  const auto read = [&](int mode) {
    GlbBuilder b;
    b.triangle_mesh({{"POSITION", b.floats(five, "VEC3")}})["mode"] = mode;
    return only_primitive(b.read()).indices;
  };
  EXPECT_EQ(read(5), (std::vector<uint32_t>{0, 1, 2, 1, 3, 2, 2, 3, 4}));
  EXPECT_EQ(read(6), (std::vector<uint32_t>{1, 2, 0, 2, 3, 0, 3, 4, 0}));
  EXPECT_EQ(read(3), (std::vector<uint32_t>{0, 1, 1, 2, 2, 3, 3, 4}));
  EXPECT_EQ(read(2), (std::vector<uint32_t>{0, 1, 1, 2, 2, 3, 3, 4, 4, 0}));
}

// Two joints and a triangle; the weights are what the test varies.
struct SkinnedTriangle : GlbBuilder {
  SkinnedTriangle(const std::vector<uint8_t>& joints, const std::vector<float>& weights) {
    triangle_mesh({{"POSITION", floats(unit_triangle(), "VEC3")},
                   {"JOINTS_0", accessor(view(joints), 3, "VEC4", 5121)},
                   {"WEIGHTS_0", floats(weights, "VEC4")}});
    document["nodes"][0]["skin"] = 0;
    document["nodes"].push_back({{"name", "a"}});
    document["nodes"].push_back({{"name", "b"}});
    document["skins"] = {{{"joints", {1, 2}}}};
  }
};

TEST(GltfRead, WeightsAreNormalisedAndEmptySlotsCleared) {
  SkinnedTriangle b({0, 1, 9, 0, 1, 0, 0, 0, 1, 0, 0, 0}, {1, 3, 0, 0, 0.5f, 0.5f, 0, 0, 0, 0, 0, 0});
  const Model model = b.read();
  const auto& influences = only_primitive(model).influences;
  EXPECT_FLOAT_EQ(influences[0].weights[0], 0.25f);
  EXPECT_FLOAT_EQ(influences[0].weights[1], 0.75f);
  EXPECT_EQ(influences[0].joints[2], 0);      // joint 9 had weight 0
  EXPECT_EQ(influences[2].weights[0], 1.0f);  // no weight at all: follows joint 0
  ASSERT_EQ(model.warnings.size(), 1u);       // one sentence
  EXPECT_NE(model.warnings[0].find("1 vertices had weights that did not sum to 1"), std::string::npos);
  EXPECT_NE(model.warnings[0].find("1 vertices without weights follow joint 0"), std::string::npos);
}

TEST(GltfRead, JointsBeyondTheSkinAreRefusedWithTheVertex) {
  SkinnedTriangle joint({0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  const std::string message = message_of([&] { joint.read(); });
  EXPECT_NE(message.find("joint 2"), std::string::npos);
  EXPECT_NE(message.find("vertex 1"), std::string::npos);
}

TEST(GltfRead, WeightsThatAreNotFiniteOrNegativeCountAsZeroAndAreSaidInOneSentence) {
  SkinnedTriangle b({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, {NAN, 0.5f, 0, 0, 2, -1, 0, 0, INFINITY, 0, 0, 0});
  const Model model = b.read();
  const auto& influences = only_primitive(model).influences;
  EXPECT_EQ(influences[0].weights[0], 0.0f);
  EXPECT_EQ(influences[0].weights[1], 1.0f);
  EXPECT_EQ(influences[1].weights[0], 1.0f);
  EXPECT_EQ(influences[2].weights[0], 1.0f);  // nothing is left: follows joint 0
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_NE(model.warnings[0].find("3 weights that are negative or not finite count as 0"), std::string::npos);
}

TEST(GltfRead, OfTwelveWeightsTheEightHeaviestAreKept) {
  GlbBuilder b;
  json attributes = {{"POSITION", b.floats(unit_triangle(), "VEC3")}};
  for (int set = 0; set < 3; ++set) {
    std::vector<uint8_t> joints;
    std::vector<float> weights;
    for (int v = 0; v < 3; ++v) {
      for (int k = 0; k < 4; ++k) {
        joints.push_back(static_cast<uint8_t>(set * 4 + k));
        weights.push_back(static_cast<float>(set * 4 + k + 1) / 78.0f);
      }
    }
    attributes["JOINTS_" + std::to_string(set)] = b.accessor(b.view(joints), 3, "VEC4", 5121);
    attributes["WEIGHTS_" + std::to_string(set)] = b.floats(weights, "VEC4");
  }
  b.triangle_mesh(attributes);
  const Model model = b.read();
  const Influences& o = only_primitive(model).influences[0];
  for (int joint = 4; joint < 12; ++joint) {
    const auto at = std::find(o.joints.begin(), o.joints.end(), joint);
    ASSERT_NE(at, o.joints.end()) << joint;
    EXPECT_FLOAT_EQ(o.weights[static_cast<size_t>(at - o.joints.begin())], static_cast<float>(joint + 1) / 68.0f);
  }
}

TEST(GltfRead, RequiredExtensionsThatCannotBeDecodedAreNamed) {
  for (const char* name : {"VENDOR_unheard_of", "KHR_animation_pointer"}) {
    GlbBuilder b;
    b.document["extensionsUsed"] = b.document["extensionsRequired"] = {name};
    EXPECT_NE(message_of([&] { b.read(); }).find(name), std::string::npos);
  }
}

TEST(GltfRead, RangesBeyondViewsAndBuffersAreRefusedWithoutOverflow) {
  const auto refuses = [](const std::function<void(GlbBuilder&)>& damage, const std::string& expected) {
    GlbBuilder b;
    b.triangle_mesh({{"POSITION", b.floats(unit_triangle(), "VEC3")}});
    damage(b);
    const std::string message = message_of([&] { b.read(); });
    EXPECT_NE(message.find(expected), std::string::npos) << message;
  };
  const double huge = 9007199254740992.0;  // 2^53
  refuses([](GlbBuilder& b) { b.document["accessors"][0]["count"] = 4; }, "accessors[0]");
  refuses([](GlbBuilder& b) { b.document["accessors"][0]["count"] = 4294967297ull; }, "accessors[0].count");
  refuses([](GlbBuilder& b) { b.document["accessors"][0]["count"] = -1; }, "accessors[0].count");
  refuses([](GlbBuilder& b) { b.document["accessors"][0]["count"] = 1.5; }, "accessors[0].count");
  refuses([&](GlbBuilder& b) { b.document["accessors"][0]["byteOffset"] = huge; }, "accessors[0]");
  refuses([](GlbBuilder& b) { b.document["accessors"][0]["componentType"] = 5130; }, "componentType");
  refuses([](GlbBuilder& b) { b.document["accessors"][0]["type"] = "VEC5"; }, "type");
  refuses([](GlbBuilder& b) { b.document["accessors"][0]["bufferView"] = 1; }, "bufferView");
  refuses([&](GlbBuilder& b) { b.document["bufferViews"][0]["byteOffset"] = huge; }, "bufferViews[0]");
  refuses([](GlbBuilder& b) { b.document["bufferViews"][0]["byteOffset"] = 4; }, "bufferViews[0]");
  refuses([](GlbBuilder& b) { b.document["bufferViews"][0]["byteLength"] = 37; }, "bufferViews[0]");
  refuses([](GlbBuilder& b) { b.document["bufferViews"][0]["byteStride"] = 4; }, "stride");
  refuses([](GlbBuilder& b) { b.document["bufferViews"][0]["buffer"] = 7; }, "buffer");
  refuses([](GlbBuilder& b) { b.document["nodes"][0]["mesh"] = 5; }, "nodes[0].mesh");
  refuses([](GlbBuilder& b) { b.document["meshes"][0]["primitives"][0]["indices"] = 99; }, "indices");
}

TEST(GltfRead, IndicesBeyondTheVerticesAreRefusedWithTheElement) {
  GlbBuilder b;
  const int positions = b.floats(unit_triangle(), "VEC3");
  const int indices = b.accessor(b.view(std::vector<uint32_t>{0, 1, 3}), 3, "SCALAR", 5125);
  b.triangle_mesh({{"POSITION", positions}})["indices"] = indices;
  const std::string message = message_of([&] { b.read(); });
  EXPECT_NE(message.find("vertex 3 of 3"), std::string::npos) << message;
}

TEST(GltfRead, NodeCyclesSecondParentsAndDepthAreRefused) {
  GlbBuilder cycle;
  cycle.document["nodes"] = {{{"children", {1}}}, {{"children", {2}}}, {{"children", {0}}}};
  EXPECT_NE(message_of([&] { cycle.read(); }).find("cycle"), std::string::npos);
  GlbBuilder self;
  self.document["nodes"] = {{{"children", {0}}}};
  EXPECT_NE(message_of([&] { self.read(); }).find("own child"), std::string::npos);
  GlbBuilder two;
  two.document["nodes"] = {{{"children", {2}}}, {{"children", {2}}}, json::object()};
  EXPECT_NE(message_of([&] { two.read(); }).find("two parents"), std::string::npos);
  GlbBuilder deep;
  for (int n = 0; n < 3000; ++n) {
    deep.document["nodes"].push_back(n < 2999 ? json{{"children", {n + 1}}} : json::object());
  }
  EXPECT_NE(message_of([&] { deep.read(); }).find("deeper"), std::string::npos);
}

TEST(GltfRead, AnimationsWithWrongTimesOrCountsAreRefused) {
  const auto read = [](const std::vector<float>& times, const std::vector<float>& values, const char* mode) {
    GlbBuilder b;
    b.document["nodes"] = {{{"name", "a"}}};
    const int input = b.floats(times, "SCALAR"), output = b.floats(values, "VEC3");
    b.document["animations"] = {{{"samplers", {{{"input", input}, {"output", output}, {"interpolation", mode}}}},
                                 {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
    return b.read();
  };
  const std::vector<float> two = {0, 0, 0, 1, 1, 1};
  EXPECT_EQ(read({0, 1}, two, "LINEAR").animations.at(0).channels.size(), 1u);
  EXPECT_NE(message_of([&] { read({1, 0}, two, "LINEAR"); }).find("decrease"), std::string::npos);
  EXPECT_NE(message_of([&] { read({NAN, 0}, two, "LINEAR"); }).find("NaN"), std::string::npos);
  EXPECT_NE(message_of([&] { read({0, 1, 2}, two, "LINEAR"); }).find("3 keys"), std::string::npos);
  EXPECT_NE(message_of([&] { read({0, 1}, two, "CUBICSPLINE"); }).find("ask for 6"), std::string::npos);
  EXPECT_NE(message_of([&] { read({0, 1}, two, "SMOOTH"); }).find("SMOOTH"), std::string::npos);
  // keys at one time: the last counts
  const Model repeated = read({0, 1, 1}, {0, 0, 0, 1, 1, 1, 2, 2, 2}, "LINEAR");
  EXPECT_EQ(repeated.animations[0].channels[0].times, (std::vector<float>{0, 1}));
  EXPECT_EQ(repeated.animations[0].channels[0].values.back(), 2.0f);
  EXPECT_EQ(repeated.warnings.size(), 1u);
}

TEST(GltfRead, DamageOfTheGlbEnvelopeIsRefused) {
  GlbBuilder b;
  b.triangle_mesh({{"POSITION", b.floats(unit_triangle(), "VEC3")}});
  const std::vector<uint8_t> good = b.glb();
  EXPECT_NO_THROW(read_gltf_bytes(good, "good.glb"));
  for (const size_t length : {0, 1, 4, 11, 12, 19, 20, 40}) {
    const std::vector<uint8_t> cut(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length));
    EXPECT_THROW(read_gltf_bytes(cut, "cut.glb"), std::runtime_error) << length;
  }
  for (size_t at = 4; at < 20; ++at) {
    std::vector<uint8_t> bad = good;
    bad[at] = static_cast<uint8_t>(bad[at] ^ 0xff);
    EXPECT_THROW(read_gltf_bytes(bad, "bad.glb"), std::runtime_error) << at;
  }
}

TEST(GltfRead, DeepAndCrowdedJsonIsRefusedBeforeItIsParsed) {
  const auto read = [](const std::string& text) {
    return message_of([&] { read_gltf_bytes({text.begin(), text.end()}, "x.gltf"); });
  };
  EXPECT_NE(read(std::string(200000, '[')).find("deeper"), std::string::npos);
  EXPECT_NE(read("{\"a\":" + std::string(2000000, ',') + "}").find("more than"), std::string::npos);
  EXPECT_NE(read("{\"asset\":{\"version\":\"2.0\"").find("open"), std::string::npos);
  EXPECT_NE(read("{\"asset\":{\"version\":\"1.0\"}}").find("convert"), std::string::npos);
}

TEST(GltfRead, BuffersAreReadFromTheFilesOwnFolderOnly) {
  TemporaryFolder folder;
  const auto inside = folder.path / "model";
  std::filesystem::create_directories(inside / "sub");
  const std::string data(36, '\0');
  write_text(folder.path / "secret.bin", data);
  write_text(inside / "sub" / "good.bin", data);
  write_text(inside / "with space.bin", data);
  std::filesystem::create_symlink(folder.path / "secret.bin", inside / "link.bin");
  std::filesystem::create_symlink(folder.path, inside / "linked");
  const auto read = [&](const std::string& uri) {
    const json document = {{"asset", {{"version", "2.0"}}},
                           {"buffers", {{{"byteLength", 36}, {"uri", uri}}}},
                           {"bufferViews", {{{"buffer", 0}, {"byteLength", 36}}}}};
    write_text(inside / "model.gltf", document.dump());
    return message_of([&] { read_gltf(inside / "model.gltf"); });
  };
  EXPECT_EQ(read("sub/good.bin"), "");
  EXPECT_EQ(read("./sub/good.bin"), "");
  EXPECT_EQ(read("with%20space.bin"), "");
  const std::string absolute = (folder.path / "secret.bin").string();
  for (const std::string& uri :
       {std::string("../secret.bin"), std::string("sub/../../secret.bin"), std::string("%2e%2e/secret.bin"),
        std::string("%2e%2e%2fsecret.bin"), std::string("..%2Fsecret.bin"), std::string("..\\secret.bin"),
        std::string("link.bin"), std::string("linked/secret.bin"), absolute, "file://" + absolute,
        std::string("http://example.com/x.bin"), std::string("/dev/zero"), std::string("sub"), std::string(""),
        std::string("good%00.bin"), std::string("bad%zz.bin"), std::string("missing.bin")}) {
    EXPECT_NE(read(uri).find("not read"), std::string::npos) << uri;
  }
  // from bytes without a folder nothing is read at all
  const std::string text =
      json{{"asset", {{"version", "2.0"}}}, {"buffers", {{{"byteLength", 1}, {"uri", "a.bin"}}}}}.dump();
  EXPECT_NE(message_of([&] {
              read_gltf_bytes({text.begin(), text.end()}, "x.gltf");
            }).find("not read"),
            std::string::npos);
}

TEST(GltfRead, ANameThatIsNotPercentEncodedIsTakenAsItStands) {
  TemporaryFolder folder;
  const auto inside = folder.path / "model";
  std::filesystem::create_directories(inside / "%2e%2e");
  write_text(folder.path / "secret.bin", "abcd");
  std::filesystem::create_symlink(folder.path / "secret.bin", inside / "link%20.bin");
  for (const char* name : {"example 10%.bin", "big%20ball.bin", "%2e%2e/a.bin", "both 1.bin", "both%201.bin"})
    write_text(inside / name, name);
  const auto read = [&](const std::string& uri, size_t bytes) {
    write_text(inside / "model.gltf",
               json{{"asset", {{"version", "2.0"}}}, {"buffers", {{{"byteLength", bytes}, {"uri", uri}}}}}.dump());
    return message_of([&] { read_gltf(inside / "model.gltf"); });
  };
  for (const char* name : {"example 10%.bin", "big%20ball.bin", "%2e%2e/a.bin"})
    EXPECT_EQ(read(name, std::strlen(name)), "") << name;
  // decoded first: "both 1.bin" has ten bytes, "both%201.bin" twelve
  EXPECT_NE(read("both%201.bin", 12).find("should have 12 bytes but has 10"), std::string::npos);
  for (const char* name : {"%2e%2e/secret.bin", "link%20.bin", "missing%20.bin", "missing%.bin"})
    EXPECT_NE(read(name, 4).find("not read"), std::string::npos) << name;
}

TEST(GltfRead, MissingAndOddImagesDoNotStopTheReader) {
  GlbBuilder b;
  b.triangle_mesh({{"POSITION", b.floats(unit_triangle(), "VEC3")}});
  b.document["images"] = {{{"uri", "../../etc/passwd"}},
                          {{"uri", "missing.png"}},
                          {{"uri", "data:image/webp;base64,AAAA"}},
                          {{"uri", "data:nonsense"}},
                          {{"bufferView", b.view(std::vector<uint8_t>{1, 2, 3, 4})}, {"mimeType", "image/png"}}};
  b.document["textures"] = {{{"source", 4}}};
  b.document["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  const Model model = b.read();
  EXPECT_EQ(model.warnings.size(), 3u);
  EXPECT_EQ(model.materials.size(), 1u);
}

TEST(GltfRead, LimitsHoldBeforeAllocation) {
  GlbBuilder b;
  // four bytes per element promised by an accessor without a view
  const int many = b.accessor(-1, 30000000, "VEC3", 5126);
  b.triangle_mesh({{"POSITION", many}});
  EXPECT_NE(message_of([&] { b.read(); }).find("limit"), std::string::npos);
  ReadLimits small;
  small.max_file_bytes = 100;
  EXPECT_NE(message_of([&] { read_gltf_bytes(b.glb(), "x.glb", {}, small); }).find("limit"), std::string::npos);
  // one small accessor used ten thousand times
  GlbBuilder again;
  const int positions = again.accessor(-1, 100000, "VEC3", 5126);
  json primitives = json::array();
  for (int i = 0; i < 10000; ++i) primitives.push_back({{"attributes", {{"POSITION", positions}}}});
  again.document["meshes"] = {{{"primitives", primitives}}};
  EXPECT_NE(message_of([&] { again.read(); }).find("limit"), std::string::npos);
}

}  // namespace

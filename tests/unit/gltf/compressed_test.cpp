// Draco and meshopt compressed glTF: what the libraries' encoders wrote comes back; what is damaged is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "compressed_files.h"
#include "gltf/flat_mesh.h"
#include "gltf/gltf_decompress.h"
#include "gltf/gltf_write.h"

namespace {

using namespace hf_gltf;
using namespace samples_test;

const Primitive& first_primitive(const Model& model) { return model.meshes.at(0).primitives.at(0); }

// The corners of every triangle, ordered so that neither the order of vertices nor of triangles counts.
std::vector<std::array<std::array<float, 3>, 3>> corners(const std::vector<glm::vec3>& positions,
                                                         const std::vector<uint32_t>& indices, float grid) {
  std::vector<std::array<std::array<float, 3>, 3>> out;
  for (size_t t = 0; t < indices.size(); t += 3) {
    std::array<std::array<float, 3>, 3> triangle;
    for (size_t c = 0; c < 3; ++c) {
      for (int k = 0; k < 3; ++k) triangle[c][static_cast<size_t>(k)] = std::round(positions[indices[t + c]][k] / grid);
    }
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    out.push_back(triangle);
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<glm::vec3> points_of(const Sheet& sheet) {
  std::vector<glm::vec3> out;
  for (size_t v = 0; v < sheet.vertex_count(); ++v)
    out.emplace_back(sheet.positions[3 * v], sheet.positions[3 * v + 1], sheet.positions[3 * v + 2]);
  return out;
}

void expect_sheet(const Model& model, const Sheet& sheet) {
  const Primitive& o = first_primitive(model);
  ASSERT_EQ(o.positions.size(), sheet.vertex_count());
  const std::vector<uint32_t> indices(sheet.indices.begin(), sheet.indices.end());
  // a coordinate is a multiple of a quarter; quantisation is far below
  EXPECT_EQ(corners(o.positions, o.indices, 0.25f), corners(points_of(sheet), indices, 0.25f));
}

// Damages a file in every way that reaches a decoder: all are read or refused with a sentence.
void expect_read_or_refused(const std::vector<uint8_t>& good, size_t first_byte) {
  std::mt19937 random(11);
  size_t read = 0, refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::vector<uint8_t> bytes = good;
    const size_t count = 1 + random() % 4;
    for (size_t k = 0; k < count; ++k) {
      const size_t at = first_byte + random() % (bytes.size() - first_byte);
      bytes[at] =
          random() % 2 ? static_cast<uint8_t>(random()) : static_cast<uint8_t>(bytes[at] ^ (1u << random() % 8));
    }
    const std::string message = message_of([&] {
      flatten(read_gltf_bytes(bytes, "damaged.glb"));
      ++read;
    });
    refused += !message.empty();
    ASSERT_TRUE(message.empty() || message.compare(0, 11, "damaged.glb") == 0) << message;
  }
  EXPECT_EQ(read + refused, 3000u);
  EXPECT_GT(refused, 100u);
}

size_t binary_start(const std::vector<uint8_t>& glb) {
  uint32_t text = 0;
  std::memcpy(&text, glb.data() + 12, 4);
  return 28 + text;
}

#ifdef HF_GLTF_DRACO
TEST(Draco, BothMethodsDecodeToTheSheetWithItsJointsAndWeights) {
  const Sheet sheet = make_sheet(6);
  for (const bool edgebreaker : {true, false}) {
    SCOPED_TRACE(edgebreaker);
    const Model model = draco_builder(sheet, encode_draco(sheet, edgebreaker)).read();
    expect_sheet(model, sheet);
    const Primitive& o = first_primitive(model);
    ASSERT_EQ(o.influences.size(), sheet.vertex_count());
    for (size_t v = 0; v < o.positions.size(); ++v) {
      EXPECT_EQ(o.influences[v].joints[1], o.influences[v].weights[1] > 0 ? 1 : o.influences[v].joints[1]);
      EXPECT_NEAR(o.influences[v].weights[1], o.positions[v].x / 8, 1e-3f);
    }
    // what is written again needs no decoder
    const json out = json::parse(gltf_bytes(model, false));
    EXPECT_FALSE(out.contains("extensionsRequired"));
  }
}

TEST(Draco, TheUncompressedFormBesideItCounts) {
  const Sheet sheet = make_sheet(3);
  GlbBuilder b = draco_builder(sheet, encode_draco(sheet, true));
  const auto put = [&](size_t accessor, int view) { b.document["accessors"][accessor]["bufferView"] = view; };
  std::vector<float> lifted = sheet.positions, weights(4 * sheet.vertex_count(), 0.25f);
  for (size_t i = 2; i < lifted.size(); i += 3) lifted[i] += 100;
  put(0, b.view(lifted));
  put(1, b.view(std::vector<uint8_t>(4 * sheet.vertex_count(), 0)));
  put(2, b.view(weights));
  put(3, b.view(sheet.indices));
  EXPECT_GT(first_primitive(b.read()).positions[0].z, 99.0f);
}

TEST(Draco, CountsOfTheStreamMustAgreeWithTheAccessorsBeforeItIsDecoded) {
  const Sheet sheet = make_sheet(6);
  for (const bool edgebreaker : {true, false}) {
    const DracoStream stream = encode_draco(sheet, edgebreaker);
    GlbBuilder more = draco_builder(sheet, stream);
    for (const size_t a : {0, 1, 2}) more.document["accessors"][a]["count"] = 37;
    EXPECT_NE(message_of([&] { more.read(); }).find("36 vertices, where the accessors have 37"), std::string::npos);
    GlbBuilder fewer = draco_builder(sheet, stream);
    fewer.document["accessors"][3]["count"] = 147;
    EXPECT_NE(message_of([&] { fewer.read(); }).find("50 triangles"), std::string::npos);
    GlbBuilder uneven = draco_builder(sheet, stream);
    uneven.document["accessors"][1]["count"] = 35;
    EXPECT_NE(message_of([&] { uneven.read(); }).find("different lengths"), std::string::npos);
    GlbBuilder wide = draco_builder(sheet, stream);
    wide.document["accessors"][0]["type"] = "VEC2";
    EXPECT_NE(message_of([&] { wide.read(); }).find("3 components"), std::string::npos);
  }
}

// A header that claims a billion triangles: the accessors would have to claim them too, and these are bounded.
TEST(Draco, AStreamThatClaimsABillionTrianglesIsRefusedByTheLimits) {
  const Sheet sheet = make_sheet(6);
  DracoStream stream = encode_draco(sheet, true);
  // behind the header of 11 bytes and the byte of the method: vertices, triangles
  const std::vector<uint8_t> huge = {0x80, 0x80, 0x80, 0x80, 0x04};
  stream.bytes.erase(stream.bytes.begin() + 12, stream.bytes.begin() + 14);
  stream.bytes.insert(stream.bytes.begin() + 12, huge.begin(), huge.end());
  stream.bytes.insert(stream.bytes.begin() + 12, huge.begin(), huge.end());
  GlbBuilder b = draco_builder(sheet, stream);
  EXPECT_NE(message_of([&] { b.read(); }).find("triangles, where the accessor"), std::string::npos);
  b.document["accessors"][3]["count"] = 3000000;
  for (const size_t a : {0, 1, 2}) b.document["accessors"][a]["count"] = 1000000;
  EXPECT_NE(message_of([&] { b.read(); }).find("limit"), std::string::npos);
}

TEST(Draco, DamagedStreamsAreReadOrRefused) {
  for (const bool edgebreaker : {true, false}) {
    const std::vector<uint8_t> good = draco_file(edgebreaker);
    expect_read_or_refused(good, binary_start(good));
  }
}

TEST(Draco, BrokenReferencesAreRefusedByName) {
  const Sheet sheet = make_sheet(3);
  const DracoStream stream = encode_draco(sheet, true);
  const auto refuses = [&](const std::function<void(json&, json&)>& damage, const std::string& expected) {
    GlbBuilder b = draco_builder(sheet, stream);
    json& primitive = b.document["meshes"][0]["primitives"][0];
    damage(primitive, primitive["extensions"]["KHR_draco_mesh_compression"]);
    const std::string message = message_of([&] { b.read(); });
    EXPECT_NE(message.find(expected), std::string::npos) << message;
  };
  refuses([](json&, json& o) { o["bufferView"] = 9; }, "KHR_draco_mesh_compression.bufferView");
  refuses([](json&, json& o) { o["attributes"]["NORMAL"] = 5; }, "names NORMAL");
  refuses([](json&, json& o) { o["attributes"]["POSITION"] = 77; }, "no attribute 77");
  refuses([](json&, json& o) { o["attributes"]["POSITION"] = -1; }, "attributes.POSITION");
  refuses([](json& p, json&) { p.erase("indices"); }, "no indices");
  refuses([](json& p, json&) { p["mode"] = 1; }, "holds no triangles");
}
#endif

#ifdef HF_GLTF_MESHOPT
TEST(Meshopt, TheSheetComesBackExactly) {
  const Sheet sheet = make_sheet(6);
  const Model model = read_gltf_bytes(meshopt_glb(meshopt_builder(sheet)), "test.glb");
  expect_sheet(model, sheet);
  EXPECT_EQ(first_primitive(model).positions, points_of(sheet));
  EXPECT_TRUE(model.warnings.empty());
}

TEST(Meshopt, EveryFilterDecodesToWhatWasEncoded) {
  const Sheet sheet = make_sheet(4);
  const size_t n = sheet.vertex_count();
  GlbBuilder b = meshopt_builder(sheet);
  std::vector<float> normals, quaternions;
  for (size_t v = 0; v < n; ++v) {
    const glm::vec3 d = glm::normalize(glm::vec3(float(v) - 7, float(v % 3) - 1.5f, 2));
    normals.insert(normals.end(), {d.x, d.y, d.z, 0});
    const glm::vec4 q = glm::normalize(glm::vec4(float(v), 1, 2, 3 - float(v % 5)));
    quaternions.insert(quaternions.end(), {q.x, q.y, q.z, q.w});
  }
  std::vector<int8_t> octahedral(4 * n);
  meshopt_encodeFilterOct(octahedral.data(), n, 4, 8, normals.data());
  const int normal_view = meshopt_view(b, encode_rows(octahedral.data(), n, 4), n, 4, "ATTRIBUTES", "OCTAHEDRAL");
  b.document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = b.accessor(normal_view, n, "VEC3", 5120, true);
  std::vector<int16_t> turned(4 * n);
  meshopt_encodeFilterQuat(turned.data(), n, 8, 12, quaternions.data());
  const int turn_view = meshopt_view(b, encode_rows(turned.data(), n, 8), n, 8, "ATTRIBUTES", "QUATERNION");
  std::vector<uint32_t> exponents(3 * n);
  meshopt_encodeFilterExp(exponents.data(), n, 12, 15, sheet.positions.data());
  const int place_view = meshopt_view(b, encode_rows(exponents.data(), n, 12), n, 12, "ATTRIBUTES", "EXPONENTIAL");
  std::vector<float> times;
  for (size_t v = 0; v < n; ++v) times.push_back(float(v));
  const int time = b.floats(times, "SCALAR");
  b.document["animations"] = {{{"samplers",
                                {{{"input", time}, {"output", b.accessor(turn_view, n, "VEC4", 5122, true)}},
                                 {{"input", time}, {"output", b.accessor(place_view, n, "VEC3", 5126)}}}},
                               {"channels",
                                {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}},
                                 {{"sampler", 1}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
  b.document["extensionsUsed"] = {"KHR_mesh_quantization"};  // normals are bytes
  const Model model = read_gltf_bytes(meshopt_glb(b), "test.glb");
  ASSERT_EQ(model.meshes.size(), 1u);
  const Primitive& o = first_primitive(model);
  ASSERT_EQ(o.normals.size(), n);
  for (size_t v = 0; v < n; ++v) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(o.normals[v][c], normals[4 * v + static_cast<size_t>(c)], 0.02f);
  }
  const Channel &rotation = model.animations.at(0).channels.at(0), &translation = model.animations[0].channels.at(1);
  for (size_t v = 0; v < n; ++v) {
    float dot = 0;
    for (size_t c = 0; c < 4; ++c) dot += rotation.values[4 * v + c] * quaternions[4 * v + c];
    EXPECT_GT(std::abs(dot), 0.999f);
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(translation.values[3 * v + c], sheet.positions[3 * v + c], 1e-3f);
  }
}

TEST(Meshopt, SizesThatDoNotBelongTogetherAreRefusedBeforeDecoding) {
  const auto refuses = [&](const std::function<void(json&)>& damage, const std::string& expected) {
    GlbBuilder b = meshopt_builder(make_sheet(6));
    damage(b.document["bufferViews"]);
    const std::string message = message_of([&] { read_gltf_bytes(meshopt_glb(b), "test.glb"); });
    EXPECT_NE(message.find(expected), std::string::npos) << message;
  };
  const auto of = [](json& views, size_t i) -> json& { return views[i]["extensions"]["EXT_meshopt_compression"]; };
  refuses([&](json& v) { of(v, 0)["byteStride"] = 10; }, "holds 36 elements of 10 bytes");
  refuses([&](json& v) { of(v, 0)["count"] = 35; }, "holds 35 elements");
  refuses([&](json& v) { of(v, 0)["byteLength"] = 100000; }, "beyond buffer 0");
  refuses([&](json& v) { of(v, 0)["filter"] = "OCTAHEDRAL"; }, "do not belong to mode ATTRIBUTES");
  refuses([&](json& v) { of(v, 1)["mode"] = "ATTRIBUTES"; }, "do not belong to mode ATTRIBUTES");
  refuses([&](json& v) { of(v, 0)["mode"] = "NEWER"; }, "\"NEWER\"");
  refuses([&](json& v) { of(v, 0)["filter"] = "COLOR"; }, "\"COLOR\"");
  refuses([&](json& v) { of(v, 0)["byteLength"] = 20; }, "not a stream");
  refuses([&](json& v) { v[0].erase("extensions"); }, "buffer without bytes");
}

// The same stream of a constant column, used by view after view.
TEST(Meshopt, WhatStreamsDecodeToIsBoundedByTheSizeOfTheFile) {
  constexpr size_t n = 40000, views = 40;
  const std::vector<uint8_t> rows(n * 256, 0);
  const std::vector<uint8_t> stream = encode_rows(rows.data(), n, 256);
  GlbBuilder b;
  for (size_t i = 0; i < views; ++i) meshopt_view(b, i == 0 ? stream : std::vector<uint8_t>{0}, n, 256, "ATTRIBUTES");
  for (json& view : b.document["bufferViews"]) {
    view["extensions"]["EXT_meshopt_compression"]["byteOffset"] = 0;
    view["extensions"]["EXT_meshopt_compression"]["byteLength"] = stream.size();
  }
  const std::string message = message_of([&] { read_gltf_bytes(meshopt_glb(b), "test.glb"); });
  EXPECT_NE(message.find("limit"), std::string::npos) << message;
}

TEST(Meshopt, DamagedStreamsAreReadOrRefused) {
  const std::vector<uint8_t> good = meshopt_file();
  expect_read_or_refused(good, binary_start(good));
}
#endif

// A build without the libraries says which package is missing.
TEST(Compressed, AMissingDecoderIsNamedByItsPackage) {
  for (const auto& [extension, has, package] :
       {std::tuple("KHR_draco_mesh_compression", has_draco(), "libdraco-dev"),
        std::tuple("EXT_meshopt_compression", has_meshopt(), "libmeshoptimizer-dev")}) {
    GlbBuilder b;
    b.document["extensionsUsed"] = b.document["extensionsRequired"] = {extension};
    const std::string message = message_of([&] { b.read(); });
    EXPECT_EQ(message.find(package) != std::string::npos, !has) << message;
    EXPECT_EQ(missing_decoder(extension).empty(), has);
  }
}

}  // namespace

// Files with Draco and meshopt compressed geometry, made by the libraries' own encoders where the build has them.
#ifndef HF_TESTS_SAMPLES_COMPRESSED_FILES_H
#define HF_TESTS_SAMPLES_COMPRESSED_FILES_H

#include "support/draco_encode.h"
#include "unit/gltf/gltf_support.h"
#ifdef HF_GLTF_MESHOPT
#include <meshoptimizer.h>
#endif

namespace samples_test {

#ifdef HF_GLTF_DRACO
// One primitive of two joints.
inline GlbBuilder draco_builder(const Sheet& sheet, const DracoStream& stream) {
  GlbBuilder b;
  const size_t n = sheet.vertex_count();
  json& primitive = b.triangle_mesh({{"POSITION", b.accessor(-1, n, "VEC3", 5126)},
                                     {"JOINTS_0", b.accessor(-1, n, "VEC4", 5121)},
                                     {"WEIGHTS_0", b.accessor(-1, n, "VEC4", 5126)}});
  primitive["indices"] = b.accessor(-1, sheet.indices.size(), "SCALAR", 5123);
  primitive["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", b.view(stream.bytes)},
      {"attributes", {{"POSITION", stream.position}, {"JOINTS_0", stream.joints}, {"WEIGHTS_0", stream.weights}}}};
  b.document["nodes"][0]["skin"] = 0;
  b.document["nodes"].push_back({{"name", "a"}, {"children", {2}}});
  b.document["nodes"].push_back({{"name", "b"}});
  b.document["skins"] = {{{"joints", {1, 2}}}};
  b.document["extensionsUsed"] = b.document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  return b;
}
inline std::vector<uint8_t> draco_file(bool edgebreaker) {
  const Sheet sheet = make_sheet(6);
  return draco_builder(sheet, encode_draco(sheet, edgebreaker)).glb();
}
#endif

#ifdef HF_GLTF_MESHOPT
// A view of `count` elements whose bytes are a meshopt stream. The second buffer stands for the uncompressed bytes.
inline int meshopt_view(GlbBuilder& b, const std::vector<uint8_t>& stream, size_t count, size_t stride,
                        const char* mode, const char* filter = "NONE") {
  const int stored = b.view(stream);
  json& view = b.document["bufferViews"][static_cast<size_t>(stored)];
  const json from = view;
  view = {{"buffer", 1}, {"byteOffset", 0}, {"byteLength", count * stride}};
  if (std::strcmp(mode, "ATTRIBUTES") == 0) view["byteStride"] = stride;
  view["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                   {"byteOffset", from["byteOffset"]},
                                                   {"byteLength", stream.size()},
                                                   {"byteStride", stride},
                                                   {"count", count},
                                                   {"mode", mode},
                                                   {"filter", filter}};
  return stored;
}

inline std::vector<uint8_t> encode_rows(const void* rows, size_t count, size_t stride) {
  std::vector<uint8_t> out(meshopt_encodeVertexBufferBound(count, stride));
  out.resize(meshopt_encodeVertexBuffer(out.data(), out.size(), rows, count, stride));
  return out;
}

inline std::vector<uint8_t> encode_triangles(const std::vector<uint16_t>& indices, size_t vertex_count) {
  std::vector<uint8_t> out(meshopt_encodeIndexBufferBound(indices.size(), vertex_count));
  out.resize(meshopt_encodeIndexBuffer(out.data(), out.size(), indices.data(), indices.size()));
  return out;
}

// The document's own list of buffers: builders write one.
inline std::vector<uint8_t> meshopt_glb(const GlbBuilder& b) {
  GlbBuilder out = b;
  out.document["extensionsUsed"].push_back("EXT_meshopt_compression");
  out.document["extensionsRequired"].push_back("EXT_meshopt_compression");
  uint64_t fallback = 4;
  for (const json& view : out.document["bufferViews"]) {
    if (view["buffer"] == 1) fallback = std::max(fallback, view["byteLength"].get<uint64_t>());
  }
  out.extra_buffers.push_back(
      {{"byteLength", fallback}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
  return out.glb();
}

inline GlbBuilder meshopt_builder(const Sheet& sheet) {
  GlbBuilder b;
  const size_t n = sheet.vertex_count();
  const int positions = meshopt_view(b, encode_rows(sheet.positions.data(), n, 12), n, 12, "ATTRIBUTES");
  const int indices = meshopt_view(b, encode_triangles(sheet.indices, n), sheet.indices.size(), 2, "TRIANGLES");
  b.triangle_mesh({{"POSITION", b.accessor(positions, n, "VEC3", 5126)}})["indices"] =
      b.accessor(indices, sheet.indices.size(), "SCALAR", 5123);
  return b;
}
inline std::vector<uint8_t> meshopt_file() { return meshopt_glb(meshopt_builder(make_sheet(6))); }
#endif

}  // namespace samples_test

#endif

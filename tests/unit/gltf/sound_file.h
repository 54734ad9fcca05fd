// A small file with something to do for every part of the reader; what hostile files are made from.
#ifndef HF_TESTS_SAMPLES_SOUND_FILE_H
#define HF_TESTS_SAMPLES_SOUND_FILE_H

#include "gltf_support.h"

namespace samples_test {

// A skinned, animated model with a sparse accessor: every part of the reader has something to do.
inline std::vector<uint8_t> sound_file() {
  GlbBuilder b;
  std::vector<float> positions, weights;
  std::vector<uint8_t> joints;
  std::vector<uint16_t> indices;
  for (uint16_t v = 0; v < 12; ++v) {
    positions.insert(positions.end(), {static_cast<float>(v % 3), static_cast<float>(v / 3), 0.5f});
    weights.insert(weights.end(), {0.5f, 0.5f, 0, 0});
    joints.insert(joints.end(), {0, 1, 0, 0});
  }
  for (uint16_t v = 0; v < 9; ++v) {
    if (v % 3 == 2) continue;
    for (const int i : {0, 1, 3, 1, 4, 3}) indices.push_back(static_cast<uint16_t>(v + i));
  }
  const int target = b.accessor(-1, 12, "VEC3", 5126);
  const int sparse_indices = b.view(std::vector<uint16_t>{1, 5, 7}),
            sparse_values = b.view(std::vector<float>(9, 0.25f));
  b.document["accessors"][static_cast<size_t>(target)]["sparse"] = {
      {"count", 3},
      {"indices", {{"bufferView", sparse_indices}, {"componentType", 5123}}},
      {"values", {{"bufferView", sparse_values}}}};
  json attributes = {{"POSITION", b.floats(positions, "VEC3")},
                     {"JOINTS_0", b.accessor(b.view(joints), 12, "VEC4", 5121)},
                     {"WEIGHTS_0", b.floats(weights, "VEC4")}};
  const int index_accessor = b.accessor(b.view(indices), indices.size(), "SCALAR", 5123);
  json& primitive = b.triangle_mesh(attributes);
  primitive["indices"] = index_accessor;
  primitive["targets"] = {{{"POSITION", target}}};
  std::vector<float> matrices;
  for (int m = 0; m < 2; ++m) {
    for (int i = 0; i < 16; ++i) matrices.push_back(i % 5 == 0 ? 1.0f : 0.0f);
  }
  b.document["nodes"][0]["skin"] = 0;
  b.document["nodes"].push_back({{"children", {2}}, {"translation", {0, 1, 0}}});
  b.document["nodes"].push_back({{"rotation", {0, 0, 0, 1}}});
  b.document["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", b.floats(matrices, "MAT4")}}};
  const int times = b.floats({0, 0.5f, 1}, "SCALAR");
  const int turns = b.floats({0, 0, 0, 1, 0, 0, 0.6f, 0.8f, 0, 0, 0, 1}, "VEC4");
  const int morphs = b.floats({0, 1, 0}, "SCALAR");
  b.document["animations"] = {
      {{"samplers", {{{"input", times}, {"output", turns}}, {{"input", times}, {"output", morphs}}}},
       {"channels",
        {{{"sampler", 0}, {"target", {{"node", 2}, {"path", "rotation"}}}},
         {{"sampler", 1}, {"target", {{"node", 0}, {"path", "weights"}}}}}}}};
  b.document["scenes"] = {{{"nodes", {0, 1}}}};
  b.document["images"] = {{{"bufferView", b.view(std::vector<uint8_t>{9, 9, 9})}, {"mimeType", "image/png"}}};
  b.document["textures"] = {{{"source", 0}}};
  b.document["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  return b.glb();
}

}  // namespace samples_test

#endif

// See foreign_mesh.h.
#ifdef HF_GLTF_ASSIMP
#include "gltf/foreign_mesh.h"

#include <algorithm>
#include <string>
#include <unordered_map>

namespace hf_gltf {
namespace {

glm::vec3 shape_key(const aiMesh& mesh, size_t target, unsigned v) {
  const aiAnimMesh& moved = *mesh.mAnimMeshes[target];
  return moved.mVertices && v < moved.mNumVertices ? vec(moved.mVertices[v] - mesh.mVertices[v]) : glm::vec3(0);
}

// Returns the eight heaviest joints of every vertex. A vertex without joints stays with the node, which becomes a
// joint.
std::vector<Influences> influences_of(const ForeignMesh& from, Skin& skin) {
  const aiMesh& mesh = from.mesh;
  std::unordered_map<int, size_t> slots;
  for (size_t j = 0; j < skin.joints.size(); ++j) slots.emplace(skin.joints[j], j);
  std::vector<std::vector<std::pair<float, size_t>>> all(mesh.mNumVertices);
  for (unsigned b = 0; b < mesh.mNumBones; ++b) {
    const aiBone& bone = *mesh.mBones[b];
    const auto slot = slots.find(from.node_named(bone.mName.C_Str()));
    if (slot == slots.end()) continue;
    for (unsigned w = 0; w < bone.mNumWeights; ++w) {
      const aiVertexWeight& weight = bone.mWeights[w];
      if (weight.mVertexId < mesh.mNumVertices && weight.mWeight > 0)
        all[weight.mVertexId].emplace_back(weight.mWeight, slot->second);
    }
  }
  std::vector<Influences> out(mesh.mNumVertices);
  for (size_t v = 0; v < all.size(); ++v) {
    std::vector<std::pair<float, size_t>>& of = all[v];
    if (of.empty()) {
      const auto [slot, is_new] = slots.emplace(from.node, skin.joints.size());
      if (is_new) {
        skin.joints.push_back(from.node);
        skin.inverse_bind.emplace_back(1);
      }
      of.emplace_back(1.0f, slot->second);
    }
    std::stable_sort(of.begin(), of.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    of.resize(std::min(of.size(), out[v].weights.size()));
    for (size_t k = 0; k < of.size(); ++k) {
      out[v].weights[k] = of[k].first;  // the writer makes their sum 1
      out[v].joints[k] = static_cast<uint16_t>(of[k].second);
    }
  }
  return out;
}

}  // namespace

// Keeps triangles only. assimp gives every corner a vertex; vertices that agree in all bits become one.
Primitive foreign_primitive(ForeignMesh& from, Skin& skin) {
  const aiMesh& mesh = from.mesh;
  std::vector<Influences> influences;
  if (mesh.mNumBones > 0) influences = influences_of(from, skin);
  Primitive out;
  out.texcoords.resize(mesh.HasTextureCoords(0) ? 1 : 0);
  out.targets.resize(mesh.mNumAnimMeshes);
  std::unordered_map<std::string, uint32_t> seen;
  std::string key;
  const auto put = [&](const auto& value) { key.append(reinterpret_cast<const char*>(&value), sizeof value); };
  const auto vertex = [&](unsigned v) {
    key.clear();
    put(mesh.mVertices[v]);
    if (mesh.HasNormals()) put(mesh.mNormals[v]);
    if (mesh.HasTextureCoords(0)) put(mesh.mTextureCoords[0][v]);
    if (mesh.HasVertexColors(0)) put(mesh.mColors[0][v]);
    if (!influences.empty()) put(influences[v]);
    for (size_t t = 0; t < out.targets.size(); ++t) put(shape_key(mesh, t, v));
    const auto [found, is_new] = seen.emplace(key, static_cast<uint32_t>(out.positions.size()));
    if (!is_new) return found->second;
    out.positions.push_back(vec(mesh.mVertices[v]) * from.unit);
    if (mesh.HasNormals()) out.normals.push_back(vec(mesh.mNormals[v]));
    if (mesh.HasTextureCoords(0))
      out.texcoords[0].emplace_back(mesh.mTextureCoords[0][v].x, 1 - mesh.mTextureCoords[0][v].y);
    if (mesh.HasVertexColors(0)) {
      const aiColor4D& c = mesh.mColors[0][v];
      out.colors.emplace_back(c.r, c.g, c.b, c.a);
    }
    if (!influences.empty()) out.influences.push_back(influences[v]);
    for (size_t t = 0; t < out.targets.size(); ++t)
      out.targets[t].positions.push_back(shape_key(mesh, t, v) * from.unit);
    return found->second;
  };
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    const bool whole = face.mNumIndices == 3 &&
                       std::all_of(face.mIndices, face.mIndices + 3, [&](unsigned v) { return v < mesh.mNumVertices; });
    from.lost_faces += !whole;
    for (unsigned c = 0; whole && c < 3; ++c) out.indices.push_back(vertex(face.mIndices[c]));
  }
  return out;
}

}  // namespace hf_gltf
#endif

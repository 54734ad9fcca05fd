#include "common/rigid_parts.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "gltf/model.h"

namespace samples {
namespace {

// A weight above it is all of a vertex; files round weights to 8 bits.
constexpr float all = 0.995f;

// The piece of every vertex by its first vertex. Vertices at one place are one, as in the library.
std::vector<uint32_t> pieces_of(const FlatMesh& mesh) {
  std::vector<uint32_t> root(mesh.positions.size());
  for (uint32_t v = 0; v < root.size(); ++v) root[v] = v;
  const auto find = [&](uint32_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  const auto join = [&](uint32_t a, uint32_t b) {
    a = find(a);
    b = find(b);
    root[std::max(a, b)] = std::min(a, b);
  };
  std::map<std::array<double, 3>, uint32_t> at;
  for (uint32_t v = 0; v < root.size(); ++v) {
    const glm::dvec3& p = mesh.positions[v];
    join(v, at.try_emplace({p.x, p.y, p.z}, v).first->second);
  }
  for (size_t c = 0; c + 2 < mesh.triangles.size(); c += 3) {
    join(mesh.triangles[c], mesh.triangles[c + 1]);
    join(mesh.triangles[c], mesh.triangles[c + 2]);
  }
  for (uint32_t v = 0; v < root.size(); ++v) root[v] = find(v);
  return root;
}

}  // namespace

std::vector<uint32_t> rigid_parts(const FlatMesh& mesh, const Model& model, const ModelLinks& skin) {
  std::vector<uint32_t> part(mesh.positions.size(), HF_NO_INDEX);
  if (skin.joints.empty()) return part;
  const std::vector<uint32_t> piece = pieces_of(mesh);
  const size_t width = skin.joints.size() / part.size();
  constexpr int none = -1, several = -2;
  std::vector<int> joint(part.size(), none);
  std::vector<size_t> size(part.size(), 0);
  uint32_t largest = 0;
  for (uint32_t v = 0; v < part.size(); ++v) {
    int own = several;
    for (size_t k = v * width; k < (v + 1) * width; ++k) {
      if (skin.weights[k] >= all) own = skin.joints[k];
    }
    int& of_piece = joint[piece[v]];
    of_piece = of_piece == none || of_piece == own ? own : several;
    if (++size[piece[v]] > size[largest]) largest = piece[v];
  }
  // by joint: the pieces that it or a joint below it moves
  std::vector<std::set<uint32_t>> moved(model.nodes.size());
  for (uint32_t v = 0; v < part.size(); ++v) {
    for (size_t k = v * width; k < (v + 1) * width; ++k) {
      if (skin.weights[k] <= 0) continue;
      for (int node = skin.joints[k]; node >= 0 && moved[static_cast<size_t>(node)].insert(piece[v]).second;)
        node = model.nodes[static_cast<size_t>(node)].parent;
    }
  }
  for (uint32_t v = 0; v < part.size(); ++v) {
    const int own = joint[piece[v]];
    if (own >= 0 && piece[v] != largest && moved[static_cast<size_t>(own)].size() == 1) part[v] = piece[v];
  }
  return part;
}

std::vector<uint32_t> rigid_vertices(const FlatMesh& mesh, const std::vector<uint32_t>& parts) {
  const std::set<uint32_t> used(mesh.triangles.begin(), mesh.triangles.end());
  std::map<uint32_t, uint32_t> vertex_of;
  for (const uint32_t v : used) {
    if (parts[v] != HF_NO_INDEX) vertex_of.try_emplace(parts[v], v);
  }
  std::vector<uint32_t> out;
  for (const auto& [part, v] : vertex_of) out.push_back(v);
  return out;
}

}  // namespace samples

// Welding, components and shared normals of a flat mesh. See flat_mesh.h.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <unordered_map>

#include "gltf/flat_mesh.h"

namespace hf_gltf {
namespace {

struct Bits {
  uint64_t x, y, z;
  bool operator==(const Bits& o) const { return x == o.x && y == o.y && z == o.z; }
};

struct BitsHash {
  size_t operator()(const Bits& k) const {
    uint64_t h = k.x * 0x9E3779B97F4A7C15ull;
    h = (h ^ (h >> 32) ^ k.y) * 0xC2B2AE3D27D4EB4Full;
    h = (h ^ (h >> 29) ^ k.z) * 0x165667B19E3779F9ull;
    return static_cast<size_t>(h ^ (h >> 32));
  }
};

uint64_t bits_of(double value) {
  value += 0.0;  // -0 becomes 0
  uint64_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits;
}

// Union-find with path halving; the smaller number is the representative.
struct Forest {
  explicit Forest(uint32_t count) : parent(count) { std::iota(parent.begin(), parent.end(), 0u); }
  uint32_t root(uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }
  void join(uint32_t a, uint32_t b) {
    a = root(a);
    b = root(b);
    if (a != b) parent[std::max(a, b)] = std::min(a, b);
  }
  std::vector<uint32_t> parent;
};

uint32_t weld_near(const std::vector<glm::dvec3>& positions, std::vector<uint32_t>& welded, double tolerance) {
  const auto count = static_cast<uint32_t>(positions.size());
  const auto cell_of = [&](const glm::dvec3& p) { return glm::floor(p / tolerance); };
  const auto key_of = [](const glm::dvec3& cell) { return Bits{bits_of(cell.x), bits_of(cell.y), bits_of(cell.z)}; };
  std::unordered_map<Bits, std::vector<uint32_t>, BitsHash> cells;
  Forest forest(count);
  for (uint32_t v = 0; v < count; ++v) {
    const glm::dvec3 cell = cell_of(positions[v]);
    for (int n = 0; n < 27; ++n) {
      const glm::dvec3 step(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
      const auto found = cells.find(key_of(cell + step));
      if (found == cells.end()) continue;
      for (const uint32_t other : found->second) {
        if (glm::distance(positions[v], positions[other]) <= tolerance) forest.join(v, other);
      }
    }
    cells[key_of(cell)].push_back(v);
  }
  uint32_t next = 0;
  std::vector<uint32_t> number(count, UINT32_MAX);
  for (uint32_t v = 0; v < count; ++v) {
    uint32_t& n = number[forest.root(v)];
    if (n == UINT32_MAX) n = next++;
    welded[v] = n;
  }
  return next;
}

// Group of every vertex for shared normals: the welded vertex, split where stored normals differ.
uint32_t crease_groups(const FlatMesh& mesh, std::vector<uint32_t>& groups) {
  constexpr float same = 0.999f;  // cosine, 2.6 degrees
  std::vector<std::vector<uint32_t>> representatives(mesh.welded_count);
  groups.resize(mesh.positions.size());
  uint32_t count = 0;
  for (uint32_t v = 0; v < mesh.positions.size(); ++v) {
    auto& list = representatives[mesh.welded[v]];
    const auto found = std::find_if(list.begin(), list.end(), [&](uint32_t other) {
      return mesh.normals[v] == mesh.normals[other] || glm::dot(mesh.normals[v], mesh.normals[other]) > same;
    });
    groups[v] = found == list.end() ? count++ : groups[*found];
    if (found == list.end()) list.push_back(v);
  }
  return count;
}

}  // namespace

uint32_t weld_positions(const std::vector<glm::dvec3>& positions, std::vector<uint32_t>& welded, double tolerance) {
  welded.resize(positions.size());
  if (tolerance > 0) return weld_near(positions, welded, tolerance);
  std::unordered_map<Bits, uint32_t, BitsHash> known;
  known.reserve(positions.size());
  for (size_t v = 0; v < positions.size(); ++v) {
    const Bits key{bits_of(positions[v].x), bits_of(positions[v].y), bits_of(positions[v].z)};
    welded[v] = known.emplace(key, static_cast<uint32_t>(known.size())).first->second;
  }
  return static_cast<uint32_t>(known.size());
}

void FlatMesh::weld() {
  welded_count = weld_positions(positions, welded);
  std::vector<char> used(welded_count, 0);
  for (size_t t = 0; t + 2 < triangles.size(); t += 3) {
    const uint32_t a = welded[triangles[t]], b = welded[triangles[t + 1]], c = welded[triangles[t + 2]];
    if (a != b && b != c && c != a) used[a] = used[b] = used[c] = 1;
  }
  const bool any = std::find(used.begin(), used.end(), 1) != used.end();
  loose.assign(positions.size(), 0);
  for (size_t v = 0; any && v < loose.size(); ++v) loose[v] = !used[welded[v]];
}

std::vector<uint8_t> loose_vertices(const std::vector<glm::dvec3>& positions, const std::vector<uint32_t>& triangles) {
  FlatMesh mesh;
  mesh.positions = positions;
  mesh.triangles = triangles;
  mesh.weld();
  return std::move(mesh.loose);
}

SurfaceBox::SurfaceBox(const std::vector<glm::dvec3>& positions, const std::vector<uint8_t>& loose)
    : low(std::numeric_limits<double>::infinity()), high(-std::numeric_limits<double>::infinity()) {
  for (size_t v = 0; v < positions.size(); ++v) {
    if (!loose[v]) {
      low = glm::min(low, positions[v]);
      high = glm::max(high, positions[v]);
    }
  }
}

uint32_t count_components(const std::vector<uint32_t>& triangles, const std::vector<uint32_t>* numbers,
                          uint32_t count) {
  Forest forest(count);
  std::vector<char> used(count, 0);
  const auto number = [&](uint32_t v) { return numbers ? (*numbers)[v] : v; };
  for (size_t t = 0; t + 2 < triangles.size(); t += 3) {
    const uint32_t a = number(triangles[t]), b = number(triangles[t + 1]), c = number(triangles[t + 2]);
    used[a] = used[b] = used[c] = 1;
    forest.join(a, b);
    forest.join(b, c);
  }
  uint32_t components = 0;
  for (uint32_t v = 0; v < count; ++v) components += used[v] && forest.root(v) == v;
  return components;
}

std::vector<glm::vec3> welded_normals(const FlatMesh& mesh, const std::vector<glm::dvec3>& positions, bool creases) {
  if (positions.size() != mesh.positions.size()) {
    throw std::runtime_error("normals need one position per vertex: " + std::to_string(mesh.positions.size()) +
                             ", not " + std::to_string(positions.size()) + ".");
  }
  std::vector<uint32_t> split;
  uint32_t count = mesh.welded_count;
  if (creases && mesh.normals.size() == mesh.positions.size()) count = crease_groups(mesh, split);
  const std::vector<uint32_t>& groups = split.empty() ? mesh.welded : split;
  std::vector<glm::dvec3> sums(count, glm::dvec3(0));
  for (size_t t = 0; t + 2 < mesh.triangles.size(); t += 3) {
    const uint32_t a = mesh.triangles[t], b = mesh.triangles[t + 1], c = mesh.triangles[t + 2];
    const glm::dvec3 area = glm::cross(positions[b] - positions[a], positions[c] - positions[a]);
    // a vertex met twice by a degenerate triangle adds zero twice
    for (const uint32_t v : {a, b, c}) sums[groups[v]] += area;
  }
  std::vector<glm::vec3> normals(positions.size(), glm::vec3(0));
  for (size_t v = 0; v < normals.size(); ++v) {
    const glm::dvec3& sum = sums[groups[v]];
    const double length = glm::length(sum);
    if (length > 0 && std::isfinite(length)) normals[v] = glm::vec3(sum / length);
  }
  return normals;
}

}  // namespace hf_gltf

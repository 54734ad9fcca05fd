// See corner_split.h.
#include "common/corner_split.h"

#include <array>
#include <map>
#include <numeric>

#include "common/face_triangles.h"

namespace samples {
namespace {

// By index: the first index with the same value.
template <typename Vector>
std::vector<uint32_t> first_equal(const std::vector<Vector>& values) {
  std::map<std::array<double, 3>, uint32_t> found;
  std::vector<uint32_t> out(values.size());
  for (uint32_t i = 0; i < values.size(); ++i) {
    std::array<double, 3> key{};
    for (int c = 0; c < Vector::length(); ++c) key[static_cast<size_t>(c)] = static_cast<double>(values[i][c]) + 0.0;
    // a number that is none would not be found again
    const bool is_number = key[0] + key[1] + key[2] == key[0] + key[1] + key[2];
    out[i] = is_number ? found.emplace(key, i).first->second : i;
  }
  return out;
}

class Splitter {
 public:
  explicit Splitter(const SurfaceMesh& mesh)
      : mesh_(mesh), texcoords_(first_equal(mesh.corners.texcoords)), normals_(first_equal(mesh.corners.normals)) {}

  SplitMesh run() {
    out_.positions = mesh_.positions;
    out_.origins.resize(mesh_.positions.size());
    std::iota(out_.origins.begin(), out_.origins.end(), 0u);
    said_.assign(mesh_.positions.size(), nothing);
    const std::vector<uint32_t>& vertices = mesh_.face_sizes.empty() ? mesh_.triangles : mesh_.face_vertices;
    std::vector<uint32_t> corners(vertices.size());
    for (size_t c = 0; c < vertices.size(); ++c) corners[c] = vertex_of(vertices[c], c);
    cut(corners);
    fill();
    return std::move(out_);
  }

 private:
  using Said = std::array<uint32_t, 2>;  // texture coordinate and normal
  static constexpr Said nothing = {Corners::none - 1, Corners::none - 1};

  uint32_t vertex_of(uint32_t vertex, size_t corner) {
    const auto value = [&](const std::vector<uint32_t>& of, const std::vector<uint32_t>& first) {
      return of.empty() || of[corner] == Corners::none ? Corners::none : first[of[corner]];
    };
    const Said said = {value(mesh_.corners.texcoord_of, texcoords_), value(mesh_.corners.normal_of, normals_)};
    if (said_[vertex] == nothing) said_[vertex] = said;
    if (said_[vertex] == said) return vertex;
    const auto [at, is_new] =
        copies_.try_emplace({vertex, said[0], said[1]}, static_cast<uint32_t>(out_.positions.size()));
    if (is_new) {
      out_.positions.push_back(mesh_.positions[vertex]);
      out_.origins.push_back(vertex);
      said_.push_back(said);
    }
    return at->second;
  }

  void cut(const std::vector<uint32_t>& corners) {
    const std::vector<uint32_t>& material_of = mesh_.corners.material_of;
    FaceTriangles cutter;
    size_t first = 0;
    for (size_t f = 0; f < mesh_.face_count(); ++f) {
      const uint32_t size = mesh_.face_sizes.empty() ? 3 : mesh_.face_sizes[f];
      cutter.append(out_.positions, corners.data() + first, size, out_.triangles);
      if (!material_of.empty()) out_.materials.resize(out_.triangles.size() / 3, material_of[f]);
      first += size;
    }
  }

  void fill() {
    const Corners& from = mesh_.corners;
    if (!from.texcoord_of.empty()) out_.texcoords.assign(said_.size(), glm::vec2(0));
    if (!from.normal_of.empty()) out_.normals.assign(said_.size(), glm::vec3(0));
    for (size_t v = 0; v < said_.size(); ++v) {
      if (said_[v] == nothing) continue;
      if (said_[v][0] != Corners::none) {
        const glm::dvec2& uv = from.texcoords[said_[v][0]];
        out_.texcoords[v] = glm::vec2(glm::dvec2(uv.x, 1 - uv.y));
      }
      if (said_[v][1] != Corners::none) out_.normals[v] = from.normals[said_[v][1]];
    }
  }

  const SurfaceMesh& mesh_;
  const std::vector<uint32_t> texcoords_, normals_;
  SplitMesh out_;
  std::vector<Said> said_;  // by vertex of the result
  std::map<std::array<uint32_t, 3>, uint32_t> copies_;
};

}  // namespace

SplitMesh split_corners(const SurfaceMesh& mesh) { return Splitter(mesh).run(); }

}  // namespace samples

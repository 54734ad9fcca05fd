#include "quads/crossings.h"

#include <algorithm>
#include <cmath>

#include "quads/surface_distance.h"

namespace samples {
namespace {

// A pair whose boxes meet takes as long as ten others.
constexpr uint64_t meeting_pair = 10;

// At most this many pairs are tried for the first triangles in order. Real meshes of 70,000 to 400,000 triangles have 2
// to 4 times n^1.5 in all. A disc of 45,000 corners and no vertex inside has n^2. 30,000,000 take about 0.1 s.
uint64_t most_pairs(size_t first, size_t triangles) {
  return 30000000 + static_cast<uint64_t>(8 * static_cast<double>(first) * std::sqrt(static_cast<double>(triangles)));
}

struct Piece {
  glm::dvec3 corner[3], low, high;
  uint32_t face;
};

double volume(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  return dot(cross(b - a, c - a), d - a);
}

// Both ends on different sides of the triangle, and all three edges of it passed on the same side.
bool passes(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3* t) {
  const double from = volume(t[0], t[1], t[2], p), to = volume(t[0], t[1], t[2], q);
  if (!((from < 0 && to > 0) || (from > 0 && to < 0))) return false;
  const double a = volume(p, q, t[0], t[1]), b = volume(p, q, t[1], t[2]), c = volume(p, q, t[2], t[0]);
  return (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
}

bool cross_each_other(const Piece& a, const Piece& b) {
  for (int k = 0; k < 3; ++k) {
    if (passes(a.corner[k], a.corner[(k + 1) % 3], b.corner) || passes(b.corner[k], b.corner[(k + 1) % 3], a.corner))
      return true;
  }
  return false;
}

bool boxes_meet(const Piece& a, const Piece& b) {
  for (int k = 0; k < 3; ++k) {
    if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
  }
  return true;
}

}  // namespace

std::optional<uint32_t> count_crossing_faces(const SurfaceMesh& mesh) {
  std::vector<Piece> pieces;
  std::vector<size_t> start{0};
  const std::vector<uint32_t>& corners = mesh.face_sizes.empty() ? mesh.triangles : mesh.face_vertices;
  FaceTriangles cut;
  std::vector<uint32_t> triangles;
  size_t first = 0;
  for (uint32_t f = 0; f < mesh.face_count(); ++f) {
    const uint32_t size = mesh.face_sizes.empty() ? 3 : mesh.face_sizes[f];
    triangles.clear();
    append_measured(cut, mesh.positions, corners.data() + first, size, triangles);
    for (size_t t = 0; t < triangles.size(); t += 3) {
      Piece piece;
      for (int k = 0; k < 3; ++k) piece.corner[k] = mesh.positions[triangles[t + static_cast<size_t>(k)]];
      piece.low = glm::min(piece.corner[0], glm::min(piece.corner[1], piece.corner[2]));
      piece.high = glm::max(piece.corner[0], glm::max(piece.corner[1], piece.corner[2]));
      piece.face = f;
      pieces.push_back(piece);
    }
    first += size;
    start.push_back(first);
  }
  const auto share_a_vertex = [&](uint32_t f, uint32_t g) {
    for (size_t i = start[f]; i < start[f + 1]; ++i)
      for (size_t j = start[g]; j < start[g + 1]; ++j)
        if (mesh.positions[corners[i]] == mesh.positions[corners[j]]) return true;
    return false;
  };
  std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.low.x < b.low.x; });
  std::vector<bool> crosses(mesh.face_count(), false);
  uint64_t pairs = 0;
  for (size_t i = 0; i < pieces.size(); ++i) {
    const uint64_t most = most_pairs(i, pieces.size());
    for (size_t j = i + 1; j < pieces.size() && pieces[j].low.x <= pieces[i].high.x; ++j) {
      if (++pairs > most) return std::nullopt;
      const Piece &a = pieces[i], &b = pieces[j];
      if (a.face == b.face || !boxes_meet(a, b) || (crosses[a.face] && crosses[b.face])) continue;
      pairs += meeting_pair;
      if (!share_a_vertex(a.face, b.face) && cross_each_other(a, b)) crosses[a.face] = crosses[b.face] = true;
    }
  }
  return static_cast<uint32_t>(std::count(crosses.begin(), crosses.end(), true));
}

}  // namespace samples

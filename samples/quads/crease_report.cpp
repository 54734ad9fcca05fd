#include "quads/crease_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "quads/surface_distance.h"

namespace samples {
namespace {

constexpr double degree = 0.017453292519943295769;
// A crease counts as released where it is farther than this from the edges of quads, in their lengths. Docs say what
// creases of the shared meshes keep to.
constexpr double kept_distance = 0.1;
// Points of each crease edge that are measured.
constexpr int samples_of_edge = 4;

using CornerKey = std::array<double, 3>;

// The triangles at an edge of the welded surface, one of each direction at most.
struct Sides {
  glm::dvec3 a, b, normal[2];
  uint32_t count = 0;
};

}  // namespace

CreaseReport measure_creases(const SurfaceMesh& surface, double degrees, const SurfaceMesh& quads, double edge_length) {
  std::map<CornerKey, uint32_t> number;
  std::vector<uint32_t> welded;
  for (const glm::dvec3& p : surface.positions)
    welded.push_back(number.emplace(CornerKey{p.x, p.y, p.z}, static_cast<uint32_t>(number.size())).first->second);
  std::map<std::pair<uint32_t, uint32_t>, Sides> edges;
  for (size_t t = 0; t + 2 < surface.triangles.size(); t += 3) {
    const uint32_t* c = &surface.triangles[t];
    const glm::dvec3 a = surface.positions[c[0]];
    const glm::dvec3 normal = cross(surface.positions[c[1]] - a, surface.positions[c[2]] - a);
    for (int k = 0; k < 3; ++k) {
      const uint32_t from = c[k], to = c[(k + 1) % 3];
      Sides& edge = edges[std::minmax(welded[from], welded[to])];
      edge.a = surface.positions[from];
      edge.b = surface.positions[to];
      if (edge.count < 2) edge.normal[edge.count] = normal;
      ++edge.count;
    }
  }
  SharedSoup lines;  // every edge of a quad as a triangle without area
  lines.positions = &quads.positions;
  size_t first = 0;
  for (const uint32_t size : quads.face_sizes) {
    for (uint32_t k = 0; k < size; ++k) {
      const uint32_t a = quads.face_vertices[first + k], b = quads.face_vertices[first + (k + 1) % size];
      lines.triangles.insert(lines.triangles.end(), {a, b, b});
    }
    first += size;
  }
  CreaseReport out;
  if (lines.triangles.empty()) return out;
  const NearestPoint nearest(lines);
  for (const auto& [ends, edge] : edges) {
    const glm::dvec3 &p = edge.normal[0], &q = edge.normal[1];
    if (edge.count != 2 || std::atan2(length(cross(p, q)), dot(p, q)) <= degrees * degree) continue;
    double far = 0;
    for (int i = 0; i < samples_of_edge; ++i) {
      const glm::dvec3 point = edge.a + ((i + 0.5) / samples_of_edge) * (edge.b - edge.a);
      const double distance = nearest.distance(point) / edge_length;
      far = std::max(far, distance);
      if (distance > out.farthest) {
        out.farthest = distance;
        out.place = point;
      }
    }
    ++out.edges;
    out.released += far > kept_distance;
  }
  return out;
}

}  // namespace samples

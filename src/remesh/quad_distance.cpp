#include "remesh/quad_distance.h"

#include <algorithm>
#include <cmath>

namespace hf {
namespace {

constexpr std::int32_t most_samples = 60000, most_spread = 30000;
constexpr std::int32_t report_step = 20000;  // samples between two reports

// How many corners of a quad are no convex ones in the plane of its mean normal, and the last of them.
std::int32_t reflex_corners(const QuadMesh& mesh, const std::int32_t* c, std::int32_t& last) {
  const Vec3 normal = cross(mesh.position[c[2]] - mesh.position[c[0]], mesh.position[c[3]] - mesh.position[c[1]]);
  std::int32_t count = 0;
  for (std::int32_t k = 0; k < 4; ++k) {
    const Vec3 p = mesh.position[c[k]];
    const Vec3 turn = cross(mesh.position[c[(k + 1) % 4]] - p, mesh.position[c[(k + 3) % 4]] - p);
    if (dot(turn, normal) <= 0) last = k, ++count;
  }
  return count;
}

// The triangles of the quads: fans from their first corners; of quads so twisted that no diagonal is inside, both
// pairs.
struct Soup {
  explicit Soup(Memory& memory) : corners(memory), face(memory) {}
  Table<std::int32_t> corners, face;
  void make(const QuadMesh& mesh) {
    auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t f) {
      corners.push_back(a), corners.push_back(b), corners.push_back(c), face.push_back(f);
    };
    for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
      const std::int32_t* c = mesh.corner.data() + mesh.face_start[f];
      for (std::int32_t k = 2; k < mesh.size(f); ++k) add(c[0], c[k - 1], c[k], f);
      std::int32_t last = 0;
      if (mesh.size(f) == 4 && reflex_corners(mesh, c, last) > 1) add(c[1], c[2], c[3], f), add(c[3], c[0], c[1], f);
    }
  }
};

}  // namespace

QuadDistance::QuadDistance(const FluxSurface& surface, double spacing, Memory& memory)
    : surface_(&surface),
      spacing_(spacing),
      memory_(&memory),
      corners_([&] {
        Table<std::int32_t> corners(memory);
        for (std::int32_t h = 0; h < 3 * surface.real_triangles; ++h) corners.push_back(surface.tail[h]);
        return corners;
      }()),
      tree_(surface.position, corners_, memory) {}

void QuadDistance::turn_quads(QuadMesh& mesh) const {
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    if (mesh.size(f) != 4) continue;
    std::int32_t* c = mesh.corner.data() + mesh.face_start[f];
    std::int32_t reflex = 0;
    if (reflex_corners(mesh, c, reflex) == 1) {
      std::rotate(c, c + reflex, c + 4);
      continue;
    }
    auto miss = [&](std::int32_t k) {
      const Vec3 a = mesh.position[c[k]], b = mesh.position[c[k + 2]];
      return std::max(tree_.find(0.5 * (a + b)).squared,
                      std::max(tree_.find(0.25 * a + 0.75 * b).squared, tree_.find(0.75 * a + 0.25 * b).squared));
    };
    if (miss(1) < miss(0)) std::rotate(c, c + 1, c + 4);
  }
}

double QuadDistance::measure(const QuadMesh& mesh, double tolerance, Vector<QuadMiss>* out_misses,
                             Progress* progress) const {
  const FluxSurface& s = *surface_;
  Soup soup(*memory_);
  soup.make(mesh);
  const NearestTriangle quads(mesh.position, soup.corners, *memory_);
  double worst = 0;
  std::int32_t looked = 0, hint = -1;  // neighbours in number are neighbours on the surface
  auto take = [&](Vec3 p, std::int32_t vertex, std::int32_t face, const NearestTriangle::Found& found) {
    const double distance = std::sqrt(found.squared);
    worst = std::max(worst, distance);
    if (out_misses && distance > tolerance) out_misses->push_back({distance, p, vertex, face});
    if (progress && ++looked % report_step == 0) progress->report(0.5f);
  };
  auto to_quads = [&](Vec3 p, std::int32_t vertex) {
    const NearestTriangle::Found found = quads.find(p, hint);
    hint = found.triangle;
    take(p, vertex, soup.face[found.triangle], found);
  };
  // points of a triangle but its corners
  auto spread = [&](Vec3 a, Vec3 b, Vec3 c, std::int32_t least, auto&& visit) {
    const double longest = std::max(norm(b - a), std::max(norm(c - b), norm(a - c)));
    const std::int32_t n = std::max(least, static_cast<std::int32_t>(std::min(std::ceil(longest / spacing_), 8.0)));
    for (std::int32_t j = 0; j < n; ++j)
      for (std::int32_t k = j == 0 ? 1 : 0; j + k <= n && k < n; ++k)
        visit((1.0 / n) *
              (static_cast<double>(j) * b + static_cast<double>(k) * c + static_cast<double>(n - j - k) * a));
  };
  const std::int32_t step = 1 + s.first_apex / most_samples;
  for (std::int32_t v = 0; v < s.first_apex; v += step) to_quads(s.position[v], v);
  for (std::int32_t t = 0; t < s.real_triangles && s.real_triangles <= most_spread; ++t) {
    const std::int32_t* c = corners_.data() + 3 * t;
    spread(s.position[c[0]], s.position[c[1]], s.position[c[2]], 1,
           [&](const Vec3& p) { to_quads(p, QuadMiss::of_surface); });
  }
  hint = -1;
  for (std::int32_t i = 0; i < soup.face.size(); ++i) {
    const std::int32_t* c = soup.corners.data() + 3 * i;
    spread(mesh.position[c[0]], mesh.position[c[1]], mesh.position[c[2]], 2, [&](const Vec3& p) {
      const NearestTriangle::Found found = tree_.find(p, hint);
      hint = found.triangle;
      take(p, QuadMiss::of_quads, soup.face[i], found);
    });
  }
  if (out_misses) {
    std::sort(out_misses->begin(), out_misses->end(), [](const QuadMiss& a, const QuadMiss& b) {
      return a.distance != b.distance ? a.distance > b.distance
             : a.face != b.face       ? a.face < b.face
                                      : a.vertex < b.vertex;
    });
  }
  return worst;
}

}  // namespace hf

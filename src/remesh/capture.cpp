#include "remesh/capture.h"

#include <algorithm>
#include <cmath>

namespace hf {
namespace {

Vec3 face_normal(const FluxSurface& s, std::int32_t t) {
  const Vec3 a = s.position[s.tail[3 * t]];
  return cross(s.position[s.tail[3 * t + 1]] - a, s.position[s.tail[3 * t + 2]] - a);
}

// The triangles of the quads; a quad gives two, along its shorter diagonal.
struct Soup {
  explicit Soup(Memory& memory) : corners(memory), face(memory) {}
  Table<std::int32_t> corners, face;
  void make(const QuadMesh& mesh) {
    corners.clear(), face.clear();
    auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t f) {
      corners.push_back(a), corners.push_back(b), corners.push_back(c), face.push_back(f);
    };
    for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
      const std::int32_t* c = mesh.corner.data() + mesh.face_start[f];
      const bool turned = mesh.size(f) == 4 && norm(mesh.position[c[3]] - mesh.position[c[1]]) <
                                                   norm(mesh.position[c[2]] - mesh.position[c[0]]);
      if (turned) {
        add(c[0], c[1], c[3], f), add(c[1], c[2], c[3], f);
      } else {
        for (std::int32_t k = 2; k < mesh.size(f); ++k) add(c[0], c[k - 1], c[k], f);
      }
    }
  }
};

struct Miss {
  double distance;
  std::int32_t vertex, face;
};

}  // namespace

QuadDistance::QuadDistance(const FluxSurface& surface, Memory& memory)
    : surface_(&surface),
      memory_(&memory),
      corners_([&] {
        Table<std::int32_t> corners(memory);
        for (std::int32_t h = 0; h < 3 * surface.real_triangles; ++h) corners.push_back(surface.tail[h]);
        return corners;
      }()),
      tree_(surface.position, corners_, memory) {}

double QuadDistance::largest(const QuadMesh& mesh) const {
  constexpr std::int32_t most_samples = 40000;
  Soup soup(*memory_);
  soup.make(mesh);
  const NearestTriangle quads(mesh.position, soup.corners, *memory_);
  double worst = 0;
  const std::int32_t step = 1 + surface_->first_apex / most_samples;
  for (std::int32_t v = 0; v < surface_->first_apex; v += step)
    worst = std::max(worst, quads.find(surface_->position[v]).squared);
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    const std::int32_t size = mesh.size(f), *c = mesh.corner.data() + mesh.face_start[f];
    Vec3 middle;
    for (std::int32_t k = 0; k < size; ++k) {
      const Vec3 a = mesh.position[c[k]], b = mesh.position[c[(k + 1) % size]];
      middle = middle + (1.0 / size) * a;
      if (c[k] < c[(k + 1) % size]) worst = std::max(worst, tree_.find(0.5 * (a + b)).squared);
    }
    worst = std::max(worst, tree_.find(middle).squared);
  }
  return std::sqrt(worst);
}

std::int32_t capture_features(const FluxSurface& s, QuadMesh& mesh, const CaptureOptions& options, Memory& memory) {
  Soup soup(memory);
  Vector<Miss> misses(&memory);
  Table<std::int32_t> fan_start(memory), fan(memory);  // faces around a vertex
  fan_start.assign(mesh.position.size() + 1, 0);
  for (const std::int32_t v : mesh.corner) ++fan_start[v + 1];
  for (std::int32_t v = 0; v < mesh.position.size(); ++v) fan_start[v + 1] += fan_start[v];
  fan.assign(mesh.corner.size(), 0);
  {
    Table<std::int32_t> fill = fan_start;
    for (std::int32_t f = 0; f < mesh.face_count(); ++f)
      for (std::int32_t k = mesh.face_start[f]; k < mesh.face_start[f + 1]; ++k) fan[fill[mesh.corner[k]]++] = f;
  }
  // corners around a vertex that are turned over, as seen from the surface at each
  auto turned_over = [&](std::int32_t v) {
    std::int32_t count = 0;
    for (std::int32_t i = fan_start[v]; i < fan_start[v + 1]; ++i) {
      const std::int32_t f = fan[i], size = mesh.size(f), *c = mesh.corner.data() + mesh.face_start[f];
      for (std::int32_t k = 0; k < size; ++k) {
        const Vec3 p = mesh.position[c[k]], x = mesh.position[c[(k + 1) % size]] - p,
                   y = mesh.position[c[(k + size - 1) % size]] - p;
        count += dot(cross(x, y), face_normal(s, mesh.location[c[k]].triangle)) <= 0;
      }
    }
    return count;
  };

  std::int32_t drawn = 0;
  for (std::int32_t round = 0; round < options.rounds; ++round) {
    soup.make(mesh);
    const NearestTriangle nearest(mesh.position, soup.corners, memory);
    misses.clear();
    for (std::int32_t v = 0; v < s.first_apex; ++v) {
      const NearestTriangle::Found found = nearest.find(s.position[v]);
      const double distance = std::sqrt(found.squared);
      if (distance > options.tolerance) misses.push_back({distance, v, soup.face[found.triangle]});
    }
    std::sort(misses.begin(), misses.end(), [](const Miss& a, const Miss& b) {
      return a.distance != b.distance ? a.distance > b.distance : a.vertex < b.vertex;
    });
    std::int32_t moved = 0;
    Table<Vec3> taken(memory);
    for (const Miss& miss : misses) {
      const Vec3 p = s.position[miss.vertex];
      bool close = false;
      for (const Vec3& q : taken) close |= norm(p - q) < options.edge_length;
      if (close) continue;
      std::int32_t best = -1;
      for (std::int32_t k = mesh.face_start[miss.face]; k < mesh.face_start[miss.face + 1]; ++k) {
        const std::int32_t v = mesh.corner[k];
        if (mesh.pinned[v] || mesh.border[v]) continue;
        if (best < 0 || norm(mesh.position[v] - p) < norm(mesh.position[best] - p)) best = v;
      }
      if (best < 0) continue;
      const SurfacePoint old_location = mesh.location[best];
      const Vec3 old_position = mesh.position[best];
      const std::int32_t before = turned_over(best);
      std::int32_t h = s.out[miss.vertex];
      while (!s.is_real(h)) h = s.turn_left(h);
      SurfacePoint at;
      at.triangle = h / 3, at.weight[h % 3] = 1;
      mesh.location[best] = at, mesh.position[best] = p;
      if (turned_over(best) > before) {
        mesh.location[best] = old_location, mesh.position[best] = old_position;
        continue;
      }
      mesh.pinned[best] = 1, taken.push_back(p), ++moved;
    }
    drawn += moved;
    if (moved == 0) break;
    RelaxOptions relax;
    relax.rounds = options.relax_rounds, relax.edge_length = options.edge_length;
    relax_quads(s, mesh, relax, memory);
  }
  return drawn;
}

}  // namespace hf

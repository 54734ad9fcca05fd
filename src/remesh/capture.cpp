#include "remesh/capture.h"

#include <algorithm>
#include <cmath>

#include "remesh/constants.h"

namespace hf_inner {
namespace {

Vec3 face_normal(const FluxSurface& s, std::int32_t t) {
  const Vec3 a = s.position[s.tail[3 * t]];
  return cross(s.position[s.tail[3 * t + 1]] - a, s.position[s.tail[3 * t + 2]] - a);
}

}  // namespace

std::int32_t capture_features(const FluxSurface& s, const QuadDistance& distance, QuadMesh& mesh,
                              const CaptureOptions& options, Memory& memory) {
  Vector<QuadMiss> misses(&memory);
  const VertexFans fans(mesh, memory);
  // Counts the corners around a vertex that are turned over against the normal of the surface there.
  auto turned_over = [&](std::int32_t v) {
    std::int32_t count = 0;
    for (std::int32_t i = fans.start[v]; i < fans.start[v + 1]; ++i) {
      const std::int32_t f = fans.face[i], size = mesh.size(f), *c = mesh.corner.data() + mesh.face_start[f];
      for (std::int32_t k = 0; k < size; ++k) {
        const Vec3 p = mesh.position[c[k]], x = mesh.position[c[(k + 1) % size]] - p,
                   y = mesh.position[c[(k + size - 1) % size]] - p;
        count += dot(cross(x, y), face_normal(s, mesh.location[c[k]].triangle)) <= 0;
      }
    }
    return count;
  };

  std::int32_t snapped = 0;
  for (std::int32_t round = 0; round < capture_rounds; ++round) {
    report(static_cast<float>(round) / static_cast<float>(capture_rounds));
    misses.clear();
    distance.turn_quads(mesh);
    distance.measure(mesh, capture_tolerance, &misses);
    std::int32_t moved = 0;
    Table<Vec3> taken(memory);
    Table<std::uint8_t> moving(mesh.position.size(), 0, memory);
    for (const QuadMiss& miss : misses) {
      if (miss.vertex < 0) continue;
      const Vec3 p = s.position[miss.vertex];
      bool near = false;
      for (const Vec3& q : taken) near |= norm(p - q) < options.edge_length;
      if (near) continue;
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
      mesh.pinned[best] = QuadMesh::snapped, taken.push_back(p), moving[best] = 1, ++moved;
    }
    snapped += moved;
    if (moved == 0) break;
    RelaxOptions relax;
    grow_marks(mesh, capture_rings, moving);
    relax.rounds = capture_relax_rounds, relax.edge_length = options.edge_length, relax.moving = &moving;
    relax_quads(s, mesh, relax, memory);
  }
  return snapped;
}

}  // namespace hf_inner

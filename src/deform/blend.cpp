#include "deform/blend.h"

namespace hf {

Vec3 blend_vertex(const Mesh& mesh, const ClusterWeights& weights, const Affine* transforms, std::int32_t v) noexcept {
  const Vec3 p = mesh.positions[v];
  const std::int32_t first = weights.start[v], last = weights.start[v + 1];
  if (first == last) return p;
  Vec3 x;
  for (std::int32_t k = first; k < last; ++k) {
    const auto& a = transforms[weights.cluster[k]].a;
    const double w = weights.weight[k];
    x.x += w * (a[0][0] * p.x + a[0][1] * p.y + a[0][2] * p.z + a[0][3]);
    x.y += w * (a[1][0] * p.x + a[1][1] * p.y + a[1][2] * p.z + a[1][3]);
    x.z += w * (a[2][0] * p.x + a[2][1] * p.y + a[2][2] * p.z + a[2][3]);
  }
  return x;
}

void blend(const Mesh& mesh, const ClusterWeights& weights, const Affine* transforms, Vec3 offset, double scale, Vec3* positions, JobRunner& jobs) {
  for_vertex_pieces(jobs, mesh.vertex_count(), [&](std::int32_t first, std::int32_t last) {
    for (std::int32_t v = first; v < last; ++v) positions[v] = offset + scale * blend_vertex(mesh, weights, transforms, v);
  });
}

}  // namespace hf

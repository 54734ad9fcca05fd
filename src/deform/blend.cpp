#include "deform/blend.h"

namespace hf {
namespace {

Vec3 apply(const Affine& affine, Vec3 p) noexcept {
  const auto& a = affine.a;
  return {a[0][0] * p.x + a[0][1] * p.y + a[0][2] * p.z + a[0][3],
          a[1][0] * p.x + a[1][1] * p.y + a[1][2] * p.z + a[1][3],
          a[2][0] * p.x + a[2][1] * p.y + a[2][2] * p.z + a[2][3]};
}

}  // namespace

Vec3 blend_vertex(const Mesh& mesh, const ClusterWeights& weights, const Affine* transforms, std::int32_t v) noexcept {
  const Vec3 p = mesh.positions[v];
  const std::int32_t first = weights.start[v], last = weights.start[v + 1];
  if (first == last) return p;
  if (last - first == 1) return apply(transforms[weights.cluster[first]], p);  // its weight is 1
  // the blended transform first: twelve independent sums
  double sum[12] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  for (std::int32_t k = first; k < last; ++k) {
    const double* a = &transforms[weights.cluster[k]].a[0][0];
    const double w = weights.weight[k];
    for (int i = 0; i < 12; ++i) sum[i] += w * a[i];
  }
  return {sum[0] * p.x + sum[1] * p.y + sum[2] * p.z + sum[3], sum[4] * p.x + sum[5] * p.y + sum[6] * p.z + sum[7],
          sum[8] * p.x + sum[9] * p.y + sum[10] * p.z + sum[11]};
}

void blend(const Mesh& mesh, const ClusterWeights& weights, const Affine* transforms, Vec3 offset, double scale,
           Vec3* positions, JobRunner& jobs) {
  for_vertex_pieces(jobs, mesh.vertex_count(), [&](std::int32_t first, std::int32_t last) {
    for (std::int32_t v = first; v < last; ++v)
      positions[v] = offset + scale * blend_vertex(mesh, weights, transforms, v);
  });
}

}  // namespace hf

#include "deform/blend.h"

#include "deform/blend_avx2.h"

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
  // the blended transform first: twelve independent sums, in the order of blend_avx2.cpp
  double sum[12];
  for (int i = 0; i < 12; ++i) sum[i] = weights.weight[first] * (&transforms[weights.cluster[first]].a[0][0])[i];
  for (std::int32_t k = first + 1; k < last; ++k) {
    const double* a = &transforms[weights.cluster[k]].a[0][0];
    const double w = weights.weight[k];
    for (int i = 0; i < 12; ++i) sum[i] += w * a[i];
  }
  return {sum[0] * p.x + sum[1] * p.y + sum[2] * p.z + sum[3], sum[4] * p.x + sum[5] * p.y + sum[6] * p.z + sum[7],
          sum[8] * p.x + sum[9] * p.y + sum[10] * p.z + sum[11]};
}

void blend(const Mesh& mesh, const ClusterWeights& weights, const Affine* transforms, Vec3 offset, double scale,
           Vec3* positions, JobRunner& jobs) {
#ifdef HF_BLEND_AVX2
  if (__builtin_cpu_supports("avx2")) {
    static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Affine) == 12 * sizeof(double));
    const BlendRows rows{weights.start.data(),
                         weights.cluster.data(),
                         weights.weight.data(),
                         &transforms[0].a[0][0],
                         &mesh.positions.data()->x,
                         {offset.x, offset.y, offset.z},
                         scale,
                         &positions->x};
    for_vertex_pieces(jobs, mesh.vertex_count(),
                      [&](std::int32_t first, std::int32_t last) { blend_rows_avx2(rows, first, last); });
    return;
  }
#endif
  for_vertex_pieces(jobs, mesh.vertex_count(), [&](std::int32_t first, std::int32_t last) {
    for (std::int32_t v = first; v < last; ++v)
      positions[v] = offset + scale * blend_vertex(mesh, weights, transforms, v);
  });
}

}  // namespace hf

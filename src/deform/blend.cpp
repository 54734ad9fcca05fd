#include "deform/blend.h"

#include <algorithm>

#include "base/compiler.h"
#include "deform/blend_rows.h"

namespace hf_inner::deform {

Quaternion blended_rotation(const ClusterWeights& weights, const Vector<Quaternion>& by_cluster,
                            std::int32_t v) noexcept {
  const std::int32_t row = weights.start[v], end = weights.start[v + 1];
  Quaternion sum({}, row == end ? 1.0 : 0.0);
  for (std::int32_t k = row; k < end; ++k) {
    const Quaternion& q = by_cluster[weights.cluster[k]];
    const double w = q.dot(sum) < 0 ? -weights.weight[k] : weights.weight[k];
    sum.coeffs() += w * q.coeffs();
  }
  return normalised(sum);
}

Vec3 blend_vertex(const mesh::Mesh& mesh, const ClusterWeights& weights, const Affine* transforms,
                  std::int32_t v) noexcept {
  const Vec3 p = mesh.positions[v];
  const std::int32_t first = weights.start[v], last = weights.start[v + 1];
  if (first == last) return p;
  // The weighted sum of the transforms comes first. Its twelve sums run in the same order as in the loops for AVX2 and
  // AVX-512.
  double sum[12];
  const double own = weights.weight[first];
  for (int i = 0; i < 12; ++i) sum[i] = own * (&transforms[weights.cluster[first]].a[0][0])[i];
  for (std::int32_t k = first + 1; k < last; ++k) {
    const double* a = &transforms[weights.cluster[k]].a[0][0];
    const double w = weights.weight[k];
    for (int i = 0; i < 12; ++i) sum[i] += w * a[i];
  }
  return {sum[0] * p.x + sum[1] * p.y + sum[2] * p.z + sum[3], sum[4] * p.x + sum[5] * p.y + sum[6] * p.z + sum[7],
          sum[8] * p.x + sum[9] * p.y + sum[10] * p.z + sum[11]};
}

namespace {

void set_columns(const Affine* transforms, std::size_t count, double* columns) noexcept {
  for (std::size_t c = 0; c < count; ++c) {
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 3; ++i) columns[16 * c + 4 * j + i] = transforms[c].a[i][j];
      columns[16 * c + 4 * j + 3] = 0;
    }
  }
}

}  // namespace

void blend(const mesh::Mesh& mesh, const ClusterWeights& weights, const Affine* transforms, double* columns,
           Vec3 offset, double scale, Vec3* positions, float* packed, JobRunner& jobs) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  set_columns(transforms, static_cast<std::size_t>(weights.cluster_count), columns);
  const BlendRows rows{weights.start.data(),
                       weights.cluster.data(),
                       weights.weight.data(),
                       columns,
                       &mesh.positions.data()->x,
                       {offset.x, offset.y, offset.z},
                       scale,
                       &positions->x,
                       weights.block_start.empty() ? nullptr : weights.block_start.data(),
                       weights.block_cluster.data(),
                       weights.block_weight.data()};
  void (*loop)(const BlendRows&, std::int32_t, std::int32_t) noexcept = nullptr;
#ifdef HF_DEFORM_AVX2
  if (HF_PROCESSOR_HAS("avx2")) loop = &blend_rows_avx2;
#ifdef HF_DEFORM_AVX512
  if (HF_PROCESSOR_HAS("avx512f")) loop = &blend_rows_avx512;
#endif
#endif
#ifdef HF_DEFORM_NEON
  loop = &blend_rows_neon;
#endif
  for_vertex_pieces(jobs, mesh.vertex_count(), [&](std::int32_t first, std::int32_t last) {
    for (std::int32_t begin = first; begin < last; begin += packed_at_once) {
      const std::int32_t end = std::min(last, begin + packed_at_once);
      if (loop) {
        loop(rows, begin, end);
      } else {
        for (std::int32_t v = begin; v < end; ++v)
          positions[v] = offset + scale * blend_vertex(mesh, weights, transforms, v);
      }
      if (!packed) continue;
      const double* from = &positions->x;
      for (std::size_t i = 3 * static_cast<std::size_t>(begin); i < 3 * static_cast<std::size_t>(end); ++i)
        packed[i] = static_cast<float>(from[i]);
    }
  });
}

Affine to_affine(const RigidMotion& motion) noexcept {
  Affine affine;
  const Mat3 r = motion.rotation.toRotationMatrix();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) affine.a[i][j] = r(i, j);
  }
  affine.a[0][3] = motion.translation.x;
  affine.a[1][3] = motion.translation.y;
  affine.a[2][3] = motion.translation.z;
  return affine;
}

}  // namespace hf_inner::deform

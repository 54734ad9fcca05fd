#include "deform/normals.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "base/compiler.h"
#include "deform/constants.h"
#include "deform/normals_avx2.h"

namespace hf_inner::deform {

void add_border_normals_plain(const NormalRows& rows, const std::int32_t* corners, std::int32_t count,
                              std::int32_t first, std::int32_t last) noexcept {
  for (std::int32_t i = 0; i < count; ++i) {
    const std::int32_t* corner = corners + 3 * static_cast<std::size_t>(i);
    const double* p[3];
    for (int k = 0; k < 3; ++k) p[k] = rows.positions + 3 * static_cast<std::size_t>(corner[k]);
    double a[3], b[3];
    for (int c = 0; c < 3; ++c) {
      a[c] = rows.unit * (p[1][c] - p[0][c]);
      b[c] = rows.unit * (p[2][c] - p[0][c]);
    }
    const float n[3] = {static_cast<float>(a[1] * b[2] - a[2] * b[1]), static_cast<float>(a[2] * b[0] - a[0] * b[2]),
                        static_cast<float>(a[0] * b[1] - a[1] * b[0])};
    for (int k = 0; k < 3; ++k) {
      if (corner[k] < first || corner[k] >= last) continue;
      float* sum = rows.sums + 4 * static_cast<std::size_t>(corner[k]);
      for (int c = 0; c < 3; ++c) sum[c] += n[c];
    }
  }
}

namespace {

void add_inner_normals(const NormalRows& rows, const std::int32_t* corners, std::int32_t count) noexcept {
  add_border_normals_plain(rows, corners, count, 0, std::numeric_limits<std::int32_t>::max());
}

// Adds to the vertices [first, last) twice the area vectors of the faces around them.
void add_face_normals(const NormalRows& rows, const mesh::Faces& faces, const Rest& rest, std::int32_t first,
                      std::int32_t last) noexcept {
  for (std::int32_t v = first; v < last; ++v) {
    float* const sum = rows.sums + 4 * static_cast<std::size_t>(v);
    for (std::int32_t i = rest.face_start[v]; i < rest.face_start[v + 1]; ++i) {
      const Span<const std::int32_t> corner = faces.corners_of(rest.face[i]);
      const auto side = [&](std::size_t k) {
        const double *p = rows.positions + 3 * static_cast<std::size_t>(corner[k]),
                     *q = rows.positions + 3 * static_cast<std::size_t>(corner[0]);
        return Vec3{rows.unit * (p[0] - q[0]), rows.unit * (p[1] - q[1]), rows.unit * (p[2] - q[2])};
      };
      Vec3 normal, before = side(1);
      for (std::size_t k = 2; k < corner.size(); ++k) {
        const Vec3 next = side(k);
        normal = normal + cross(before, next);
        before = next;
      }
      sum[0] += static_cast<float>(normal.x);
      sum[1] += static_cast<float>(normal.y);
      sum[2] += static_cast<float>(normal.z);
    }
  }
}

void normalise(const NormalRows& rows, std::int32_t first, std::int32_t last) noexcept {
  for (std::int32_t v = first; v < last; ++v) {
    const float* sum = rows.sums + 4 * static_cast<std::size_t>(v);
    float* normal = rows.normals + 3 * static_cast<std::size_t>(v);
    const float x = sum[0], y = sum[1], z = sum[2], square = x * x + y * y + z * z;
    if (square > shortest_sum * shortest_sum && square < longest_sum * longest_sum) {
      const float s = 1.0f / std::sqrt(square);
      normal[0] = s * x;
      normal[1] = s * y;
      normal[2] = s * z;
      continue;
    }
    const double dx = x, dy = y, dz = z, length = std::sqrt(dx * dx + dy * dy + dz * dz);
    const bool directed = length > least_normal_sum && std::isfinite(length);
    const double s = directed ? 1.0 / length : 0.0;
    normal[0] = static_cast<float>(s * dx);
    normal[1] = static_cast<float>(s * dy);
    normal[2] = directed ? static_cast<float>(s * dz) : 1.0f;
    if (!directed) normal[0] = normal[1] = 0;
  }
}

}  // namespace

void vertex_normals(const mesh::Mesh& mesh, const Rest& rest, const Vec3* positions, NormalSum* sums, Normal* normals,
                    JobRunner& jobs) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(NormalSum) == 4 * sizeof(float));
  static_assert(sizeof(Normal) == 3 * sizeof(float));
  const NormalRows rows{&positions->x, 1.0 / mesh.scale, sums->component, &normals->x};
  auto* add_inner = &add_inner_normals;
  auto* add_border = &add_border_normals_plain;
#ifdef HF_DEFORM_AVX2
  if (HF_PROCESSOR_HAS("avx2")) {
    add_inner = &add_inner_normals_avx2;
    add_border = &add_border_normals_avx2;
  }
#endif
#ifdef HF_DEFORM_NEON
  add_inner = &add_inner_normals_neon;
  add_border = &add_border_normals_neon;
#endif
  for_vertex_pieces(jobs, mesh.vertex_count(), [&](std::int32_t first, std::int32_t last) {
    const std::int32_t piece = first / vertex_piece, begin = rest.piece_start[piece], border = rest.piece_border[piece],
                       end = rest.piece_start[piece + 1];
    const std::int32_t* corners = rest.piece_corner.data();
    std::memset(static_cast<void*>(sums + first), 0, static_cast<std::size_t>(last - first) * sizeof(NormalSum));
    if (!mesh.faces.empty()) {
      add_face_normals(rows, mesh.faces, rest, first, last);
      normalise(rows, first, last);
      return;
    }
    add_inner(rows, corners + 3 * static_cast<std::size_t>(begin), border - begin);
    add_border(rows, corners + 3 * static_cast<std::size_t>(border), end - border, first, last);
    normalise(rows, first, last);
  });
}

}  // namespace hf_inner::deform

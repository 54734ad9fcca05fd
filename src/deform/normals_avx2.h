// The arrays that the loops of normals.cpp, normals_avx2.cpp and normals_neon.cpp share.
#pragma once
#include <cstddef>
#include <cstdint>

namespace hf_inner::deform {

struct NormalRows {
  const double* positions;  // 3 per vertex
  double unit;              // 1 / the mesh's scale
  float* sums;              // 4 per vertex
  float* normals;           // 3 per vertex
};

// Add the normals of `count` triangles, three corners each, to the sums of their corners. The border functions only add
// to the vertices [first, last). The plain ones run where there are no lanes.
void add_border_normals_plain(const NormalRows& rows, const std::int32_t* corners, std::int32_t count,
                              std::int32_t first, std::int32_t last) noexcept;
void add_inner_normals_avx2(const NormalRows& rows, const std::int32_t* corners, std::int32_t count) noexcept;
void add_border_normals_avx2(const NormalRows& rows, const std::int32_t* corners, std::int32_t count,
                             std::int32_t first, std::int32_t last) noexcept;
void add_inner_normals_neon(const NormalRows& rows, const std::int32_t* corners, std::int32_t count) noexcept;
void add_border_normals_neon(const NormalRows& rows, const std::int32_t* corners, std::int32_t count,
                             std::int32_t first, std::int32_t last) noexcept;

}  // namespace hf_inner::deform

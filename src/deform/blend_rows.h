// The arrays of a blend, as the loops of blend.cpp and of blend_avx2.cpp, blend_avx512.cpp and blend_neon.cpp read
// them.
#pragma once
#include <cstddef>
#include <cstdint>

namespace hf_inner::deform {

struct BlendRows {
  const std::int32_t* start;  // by vertex
  const std::uint16_t* cluster;
  const float* weight;
  const double* columns;  // 16 per cluster: the four columns of its transform, padded
  const double* rest;     // 3 per vertex
  double offset[3];
  double scale;
  double* positions;  // 3 per vertex
  // The same weights by block of eight vertices (ClusterWeights). Null: there are no blocks.
  const std::int32_t* block_start;
  const std::uint16_t* block_cluster;
  const float* block_weight;
};

// These loops need a `first` that is a multiple of eight.
void blend_rows_avx2(const BlendRows& rows, std::int32_t first, std::int32_t last) noexcept;
void blend_rows_avx512(const BlendRows& rows, std::int32_t first, std::int32_t last) noexcept;
void blend_rows_neon(const BlendRows& rows, std::int32_t first, std::int32_t last) noexcept;

}  // namespace hf_inner::deform

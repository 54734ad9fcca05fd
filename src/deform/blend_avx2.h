// The arrays of a blend, for the loops of blend.cpp and blend_avx2.cpp.
#pragma once
#include <cstddef>
#include <cstdint>

namespace hf {

struct BlendRows {
  const std::int32_t* start;  // by vertex
  const std::int32_t* cluster;
  const double* weight;
  const double* transforms;  // 12 per cluster, row-major
  const double* rest;        // 3 per vertex
  double offset[3];
  double scale;
  double* positions;  // 3 per vertex
};

void blend_rows_avx2(const BlendRows& rows, std::int32_t first, std::int32_t last) noexcept;

}  // namespace hf

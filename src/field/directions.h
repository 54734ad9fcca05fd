// Computes the unit direction of falling heat on every triangle, weighted and summed over the channels.
//
// An average distance (Crane, Weischedel and Wardetzky 2013) spends most of its time in this loop. So the loop is also
// compiled for four and for eight lanes. The compiler never fuses a multiplication and an addition, and the channels
// are always summed in the same order, so all versions give the same bits.
#pragma once
#include <cstdint>

namespace hf_inner::field {

// A triangle of non-zero area in its own plane. The corners are (0, 0), (along, 0) and (px, py).
struct TriangleFrame {
  double along, px, py;
  std::int32_t row[3];  // rows of the three corners in `heat`
  std::int32_t component;
};

struct DirectionSums {
  const TriangleFrame* frame;
  const double* heat;     // [row][channel]
  const double* weight;   // [component][channel]
  std::int32_t channels;  // 1 to 8
  double* sums;           // two numbers per triangle: the sums are added
};

void add_directions(const DirectionSums& job, std::int64_t begin, std::int64_t end) noexcept;

}  // namespace hf_inner::field

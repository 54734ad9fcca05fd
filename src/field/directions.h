// Unit directions of the falling heat on every triangle, weighted and summed over the channels.
//
// This is most of the time of an average distance (Crane, Weischedel and Wardetzky 2013), so the loop is compiled for
// four and for eight lanes too. Nothing is contracted and the channels are summed in one order: the bits are the same.
#pragma once
#include <cstdint>

namespace hf_inner {

// A triangle with area in its plane, the first edge along x: corners (0, 0), (along, 0), (px, py).
struct TriangleFrame {
  double along, px, py;
  std::int32_t row[3];  // of the corners in the heat
  std::int32_t component;
};

struct DirectionSums {
  const TriangleFrame* frame;
  const double* heat;     // [row][channel]
  const double* weight;   // [component][channel]
  std::int32_t channels;  // 1 to 8
  double* sums;           // two numbers a triangle: the sums are added
};

void add_directions(const DirectionSums& job, std::int64_t begin, std::int64_t end) noexcept;

}  // namespace hf_inner

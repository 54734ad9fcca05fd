// Unit directions of the heat's fall on every triangle, weighted and summed over the channels (Crane, Weischedel &
// Wardetzky 2013): most of the time of an average distance, so the loop is compiled for four lanes too. Nothing is
// contracted and the channels are summed in order: the bits are the same.
#pragma once
#include <cstdint>

namespace hf {

// A triangle in its plane, the first edge along x: corners (0, 0), (along, 0), (px, py).
struct TriangleFrame {
  double along, px, py;  // py = 0: without area, left out
};

struct DirectionSums {
  const TriangleFrame* frame;
  const std::int32_t* triangle;   // three vertices each
  const std::int32_t* position;   // row of a vertex
  const std::int32_t* component;  // of a vertex
  const double* heat;             // [row][channel]
  const double* weight;           // [component][channel]
  std::int32_t channels;          // at most 8
  double* sums;                   // two numbers a triangle: the sums are added
};

void add_directions(const DirectionSums& job, std::int64_t begin, std::int64_t end) noexcept;

}  // namespace hf

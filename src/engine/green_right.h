// The dense unknowns of engine green on their way through a solve; shared by green.cpp and green_refine.cpp.
#pragma once
#include "base/index.h"
#include "engine/green.h"

namespace hf_inner {

// The answer of the dense system: lambda or t by row, and the constant of every component.
struct GreenSolver::Right {
  using Index = std::int32_t;
  explicit Right(Memory& memory)
      : slot(&memory), freed(&memory), centre(&memory), constant(&memory), x(&memory), probe(&memory), total(&memory) {}
  const double* of(Index row, std::size_t m) const noexcept {
    return row >= 0 ? slot.data() + at(row) * m : freed.data() + at(base_index(row)) * m;
  }
  double* of(Index row, std::size_t m) noexcept {
    return row >= 0 ? slot.data() + at(row) * m : freed.data() + at(base_index(row)) * m;
  }
  Vector<double> slot, freed;
  Vector<double> centre;    // mean site value of every component: a large common offset must not cost digits
  Vector<double> constant;  // centre + a
  Vector<double> x, probe;
  Vector<double> total;  // sources by component, for a refinement: 1'lambda = -total; empty: 0
};

// For a refinement in single precision.
struct GreenSolver::SingleSweeps {
  const PreviewFactor& factor;
  float* scratch;    // room for the right-hand sides
  double largest;    // written: the largest change of a value
};

}  // namespace hf_inner

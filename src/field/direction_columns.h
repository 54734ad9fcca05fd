// Unit right-hand sides of a direction system, one an unknown.
#pragma once
#include "base/memory.h"
#include "factor/factor.h"

namespace hf_inner {

struct UnitColumns {
  explicit UnitColumns(Memory& memory) : start(1, 0, &memory), row(&memory), value(&memory) {}
  void append(std::int32_t unknown) {
    row.push_back(unknown), value.push_back(1.0);
    start.push_back(static_cast<std::int32_t>(row.size()));
  }
  SparseColumns view() const noexcept { return {start, row, value}; }
  Vector<std::int32_t> start, row;
  Vector<double> value;
};

}  // namespace hf_inner

// Sparse columns of sites and of free values, in the format of the factor's path solves.
#pragma once
#include "solve/eliminated_base.h"
#include "solve/site.h"

namespace hf_inner::solve {

struct SiteColumns {
  explicit SiteColumns(Memory& memory) : start(&memory), row(&memory), value(&memory) { start.push_back(0); }
  // Appends the weights w of a site as a sparse column. Vertices that the factor eliminates are left out.
  void append(const Site& site, const EliminatedBase* base) {
    for (int k = 0; k < 3; ++k) {
      if (site.vertex[k] < 0 || site.weight[k] == 0 || (base && base->eliminated(site.vertex[k]))) continue;
      row.push_back(site.vertex[k]);
      value.push_back(site.weight[k]);
    }
    start.push_back(static_cast<std::int32_t>(row.size()));
  }
  void append_empty() { start.push_back(static_cast<std::int32_t>(row.size())); }
  // Appends the column -K_Fr of an eliminated vertex r whose value is unknown, because its site was removed. F are the
  // vertices that are not eliminated.
  void append_free(std::int32_t r, const SymmetricMatrix& k, const EliminatedBase& base) {
    for (std::int32_t i = k.column_start[static_cast<std::size_t>(r)];
         i < k.column_start[static_cast<std::size_t>(r) + 1]; ++i) {
      const std::int32_t v = k.row[static_cast<std::size_t>(i)];
      if (!base.eliminated(v)) {
        row.push_back(v);
        value.push_back(-k.value[static_cast<std::size_t>(i)]);
      }
    }
    start.push_back(static_cast<std::int32_t>(row.size()));
  }
  factor::SparseColumns view() const noexcept { return {start, row, value}; }
  Vector<std::int32_t> start, row;
  Vector<double> value;
};

}  // namespace hf_inner::solve

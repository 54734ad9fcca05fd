// Finds the rim of a region: the vertices that separate the region from the rest when they are sites.
//
// A vertex with a mesh neighbour outside belongs to the rim. The matrix K can couple more vertices: an intrinsic
// operator has edges of its own, and a bi-harmonic operator couples vertices within two edges. So the couplings of K
// count as well.
#pragma once
#include "surface/core.h"

namespace hf_inner::surface {

// Returns true if K couples v with a vertex that is not inside.
template <class Inside>
bool couples_outward(const Core& core, std::int32_t v, Inside&& inside) {
  const SymmetricMatrix& k = core.matrix();
  for (std::int32_t i = k.column_start[static_cast<std::size_t>(v)];
       i < k.column_start[static_cast<std::size_t>(v) + 1]; ++i) {
    if (k.value[static_cast<std::size_t>(i)] != 0 && !inside(k.row[static_cast<std::size_t>(i)])) return true;
  }
  return false;
}

}  // namespace hf_inner::surface

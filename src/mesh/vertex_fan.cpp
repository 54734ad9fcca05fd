#include "mesh/vertex_fan.h"

#include <algorithm>

#include "mesh/union_find.h"

namespace hf_inner::mesh {

Vector<FanPart> fan_parts(Span<const Wing> wings, Span<const CutEdge> cut, Memory& memory) {
  struct Side {
    Index other, wing;
    bool operator<(const Side& o) const noexcept { return other != o.other ? other < o.other : wing < o.wing; }
  };
  const auto is_cut = [&](Index a, Index b) {
    return std::binary_search(cut.begin(), cut.end(), CutEdge{std::min(a, b), std::max(a, b)});
  };
  Vector<Side> sides(&memory);
  for (std::size_t w = 0; w < wings.size(); ++w) {
    sides.push_back({wings[w].next, static_cast<Index>(w)});
    sides.push_back({wings[w].last, static_cast<Index>(w)});
  }
  std::sort(sides.begin(), sides.end());
  UnionFind fans(wings.size(), memory), parts(wings.size(), memory);
  for (std::size_t i = 1; i < sides.size(); ++i) {
    if (sides[i].other != sides[i - 1].other) continue;
    fans.unite(sides[i].wing, sides[i - 1].wing);
    if (!is_cut(wings[0].vertex, sides[i].other)) parts.unite(sides[i].wing, sides[i - 1].wing);
  }
  Vector<FanPart> out(&memory);
  for (std::size_t w = 0; w < wings.size(); ++w) {
    const Index part = parts.find(static_cast<Index>(w));
    if (fans.find(part) != part) out.push_back({part, static_cast<Index>(w)});
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace hf_inner::mesh

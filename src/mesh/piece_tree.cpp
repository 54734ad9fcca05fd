#include "mesh/piece_tree.h"

#include <algorithm>
#include <cstdint>

#include "base/progress.h"

namespace hf_inner::mesh {
namespace {

constexpr float far_away = 1e18f;  // its square is finite
// Cells of the curve along the longest side of a piece: 2^10 fill 30 bits. No result depends on it.
constexpr double curve_cells = 1024;

// Puts two zeros before each of ten bits.
std::uint32_t spread_bits(std::uint32_t x) noexcept {
  x = (x | x << 16) & 0x030000ffu;
  x = (x | x << 8) & 0x0300f00fu;
  x = (x | x << 4) & 0x030c30c3u;
  return (x | x << 2) & 0x09249249u;
}

}  // namespace

void PieceTree::put(Block& block, Index child, const ItemBox& box) noexcept {
  const double low[3] = {box.low.x, box.low.y, box.low.z}, high[3] = {box.high.x, box.high.y, box.high.z};
  for (int k = 0; k < 3; ++k) {
    block.low[k][child] = static_cast<float>(low[k]) - wider;
    block.high[k][child] = static_cast<float>(high[k]) + wider;
  }
}

PieceTree::PieceTree(Span<const ItemBox> boxes, Span<const Index> piece, Index piece_count, Memory& memory)
    : order_(boxes.size(), &memory),
      start_(at(piece_count) + 1, 0, &memory),
      root_(&memory),
      box_(at(piece_count), &memory),
      block_(&memory) {
  for (std::size_t t = 0; t < boxes.size(); ++t) {
    ItemBox& box = box_[at(piece[t])];
    if (start_[at(piece[t]) + 1]++ == 0) box = boxes[t];
    box.take(boxes[t]);
  }
  for (std::size_t p = 0; p < box_.size(); ++p) start_[p + 1] += start_[p];
  struct Entry {
    std::uint32_t code;
    Index item;
    bool operator<(const Entry& o) const noexcept { return code != o.code ? code < o.code : item < o.item; }
  };
  Vector<Entry> entries(boxes.size(), &memory);
  Vector<Index> next(start_.begin(), start_.end() - 1, &memory);
  for (std::size_t t = 0; t < boxes.size(); ++t) {
    const ItemBox& all = box_[at(piece[t])];
    const Vec3 size = all.high - all.low;
    const double longest = std::max({size.x, size.y, size.z}), cell = longest > 0 ? curve_cells / longest : 0;
    const Vec3 place = 0.5 * cell * ((boxes[t].low - all.low) + (boxes[t].high - all.low));
    const auto bits = [](double x) { return spread_bits(static_cast<std::uint32_t>(std::min(x, curve_cells - 1))); };
    entries[at(next[at(piece[t])]++)] = {bits(place.x) | bits(place.y) << 1 | bits(place.z) << 2,
                                         static_cast<Index>(t)};
  }
  block_.reserve(boxes.size() / 2 + 2 * box_.size());
  Vector<ItemBox> around(&memory);  // by block of the level below, then of this one
  for (std::size_t p = 0; p < box_.size(); ++p) {
    const Index first = start_[p], last = start_[p + 1];
    std::sort(entries.begin() + first, entries.begin() + last);
    around.clear();
    for (Index i = first; i < last; ++i) {
      order_[at(i)] = entries[at(i)].item;
      around.push_back(boxes[at(order_[at(i)])]);
    }
    // Each level stands behind the one below.
    Index below = first;
    for (Index level = 0; !around.empty(); ++level) {
      const Index here = static_cast<Index>(block_.size());
      std::size_t count = 0;
      for (std::size_t i = 0; i < around.size(); i += width, ++count) {
        Block block;
        block.first = below + static_cast<Index>(i);
        block.level = level;
        ItemBox box = around[i];
        for (Index child = 0; child < width; ++child) {
          const std::size_t c = i + at(child);
          if (c < around.size()) {
            put(block, child, around[c]);
            box.take(around[c]);
          }
          for (int k = 0; k < 3 && c >= around.size(); ++k) {
            block.low[k][child] = far_away;
            block.high[k][child] = -far_away;
          }
        }
        block_.push_back(block);
        around[count] = box;
      }
      if (count == 1) break;
      around.resize(count);
      below = here;
    }
    root_.push_back(static_cast<Index>(block_.size()) - 1);
    poll();
  }
}

bool PieceTree::is_near(Index piece, const ItemBox& box, double squared) const noexcept {
  Four low[3], high[3];
  spread(box.low, low);
  spread(box.high, high);
  const float reach = reach_of(squared);
  Index stack[depth];
  std::size_t open = 0;
  stack[open++] = root_[at(piece)];
  while (open > 0) {
    const Block& block = block_[at(stack[--open])];
    const Four four = squared_to_four(block, low, high);
    float gap[width];
    std::memcpy(gap, &four, sizeof gap);
    for (Index i = 0; i < width; ++i) {
      if (!(gap[i] <= reach)) continue;
      if (block.level == 0) return true;
      stack[open++] = block.first + i;
    }
  }
  return false;
}

}  // namespace hf_inner::mesh

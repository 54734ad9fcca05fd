#include "mesh/vertex_order.h"

#include <algorithm>

#include "base/index.h"

namespace hf_inner::mesh {
namespace {

// Vertices that lie together: the pieces in which loops over vertices run (deform/rest.h). No result of a mesh that
// keeps its order depends on it.
constexpr std::size_t near_vertices = 4096;
// A mesh with less vertices keeps its order: its arrays stay in the cache anyway. Half and double leave the shared
// meshes as they are.
constexpr std::size_t fewest_to_order = 3 * near_vertices;
// The order is good if this share of the triangles has its corners in one piece. Scans and meshes by quick programs
// have 0.13 to 0.6, grids of up to 1,000 columns and the others 0.76 and more. The curve gives 0.92.
constexpr double local_share = 0.7;
// Bits of a coordinate along the curve. Vertices of one cell, 2.4e-4 of the box wide, keep their order: more bits take
// longer, less leave more of the old order.
constexpr int curve_bits = 12;
// One thread's job computes this many keys. No result depends on it.
constexpr std::size_t key_piece = 16384;

}  // namespace

std::uint64_t hilbert_key(Vec3 p) noexcept {
  constexpr std::uint32_t top = 1u << (curve_bits - 1), cells = 1u << curve_bits;
  const auto cell = [](double x) {
    return static_cast<std::uint32_t>(std::clamp((x + 0.5) * cells, 0.0, static_cast<double>(cells - 1)));
  };
  std::uint32_t x[3] = {cell(p.x), cell(p.y), cell(p.z)};
  // From the coarsest bit to the finest: the bits below are mirrored or swapped as the curve turns in this cell.
  for (std::uint32_t bit = top; bit > 1; bit >>= 1) {
    const std::uint32_t below = bit - 1;
    for (std::uint32_t& axis : x) {
      const std::uint32_t swapped = axis & bit ? 0 : (x[0] ^ axis) & below;
      x[0] ^= axis & bit ? below : swapped;
      axis ^= swapped;
    }
  }
  // The Gray code of the three coordinates.
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t mirrored = 0;
  for (std::uint32_t bit = top; bit > 1; bit >>= 1) {
    if (x[2] & bit) mirrored ^= bit - 1;
  }
  std::uint64_t key = 0;
  for (int bit = curve_bits - 1; bit >= 0; --bit) {
    for (const std::uint32_t axis : x) key = 2 * key + (((axis ^ mirrored) >> bit) & 1);
  }
  return key;
}

bool is_local(Span<const Index> corners, std::size_t count) noexcept {
  if (count < fewest_to_order) return true;
  const auto piece = [&](std::size_t corner) { return at(corners[corner]) / near_vertices; };
  std::size_t near = 0;
  for (std::size_t k = 0; k + 2 < corners.size(); k += 3) near += piece(k) == piece(k + 1) && piece(k) == piece(k + 2);
  return 3 * static_cast<double>(near) >= local_share * static_cast<double>(corners.size());
}

Vector<Index> curve_order(Span<const Vec3> positions, JobRunner* jobs, Memory& memory) {
  struct Entry {
    std::uint64_t key;
    Index vertex;
  };
  Vector<Entry> entries(positions.size(), Entry{}, &memory), sorted(entries, &memory);
  for_each(jobs, static_cast<std::uint32_t>((positions.size() + key_piece - 1) / key_piece), [&](std::uint32_t p) {
    for (std::size_t i = p * key_piece; i < std::min(positions.size(), (p + std::size_t{1}) * key_piece); ++i)
      entries[i] = {hilbert_key(positions[i]), static_cast<Index>(i)};
  });
  // Radix sort, a coordinate's worth of bits at a time, from the lowest.
  for (int shift = 0; shift < 3 * curve_bits; shift += curve_bits) {
    poll();
    const auto digit = [&](const Entry& entry) { return (entry.key >> shift) & ((1u << curve_bits) - 1); };
    Vector<std::size_t> next((1u << curve_bits) + 1, 0, &memory);
    for (const Entry& entry : entries) ++next[digit(entry) + 1];
    for (std::size_t k = 1; k < next.size(); ++k) next[k] += next[k - 1];
    for (const Entry& entry : entries) sorted[next[digit(entry)]++] = entry;
    entries.swap(sorted);
  }
  Vector<Index> order(&memory);
  order.reserve(entries.size());
  for (const Entry& entry : entries) order.push_back(entry.vertex);
  return order;
}

}  // namespace hf_inner::mesh

#include "mesh/weld.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "base/error.h"

namespace hf_inner {
namespace {

using Index = std::int32_t;

// The hash table of positions starts with this many entries. It doubles until it has two per vertex.
constexpr std::size_t first_slots = 64;
// After this many probes per vertex, sorting replaces the hash table of positions. A half-full table needs about 1.5
// probes per vertex. Positions that are constructed to collide need up to n probes per vertex.
constexpr std::uint64_t steps_per_vertex = 16, spare_steps = 1024;
// Largest number of a grid cell, which fits 64 bits. Larger coordinates share the last cell.
constexpr std::int64_t largest_cell = 4000000000000000000;

Vec3 position(const MeshInput& input, std::size_t v) noexcept {
  // adding zero turns -0 into +0, so both have the same bits
  return {input.positions.get(v, 0) + 0.0, input.positions.get(v, 1) + 0.0, input.positions.get(v, 2) + 0.0};
}

std::uint64_t mixed(Vec3 p) noexcept {
  const auto bits = [](double x) {
    std::uint64_t b;
    std::memcpy(&b, &x, sizeof b);
    return b;
  };
  std::uint64_t h = bits(p.x) * 0x9e3779b97f4a7c15u;
  h = ((h ^ (h >> 29)) + bits(p.y)) * 0xbf58476d1ce4e5b9u;
  h = ((h ^ (h >> 32)) + bits(p.z)) * 0x94d049bb133111ebu;
  return h ^ (h >> 31);
}

// Puts the vertices into a hash table with open addressing, in ascending order. The first vertex at a place represents
// the later ones. Returns false if too many places have the same hash, which happens only with constructed positions.
bool weld_by_hash(const MeshInput& input, Vector<Index>& representative, Memory& memory) {
  std::size_t size = first_slots;
  while (size < std::size_t{2} * input.vertex_count) size *= 2;
  Vector<Index> table(size, -1, &memory);
  std::uint64_t steps = 0;
  const std::uint64_t most = steps_per_vertex * input.vertex_count + spare_steps;
  for (std::uint32_t v = 0; v < input.vertex_count; ++v) {
    const Vec3 p = position(input, v);
    std::size_t slot = static_cast<std::size_t>(mixed(p)) & (size - 1);
    for (;; slot = (slot + 1) & (size - 1)) {
      if (++steps > most) return false;
      Index& first = table[slot];
      if (first < 0) {
        first = static_cast<Index>(v);
        break;
      }
      const Vec3 q = position(input, static_cast<std::size_t>(first));
      if (p.x == q.x && p.y == q.y && p.z == q.z) break;
    }
    representative[v] = table[slot];
  }
  return true;
}

Vector<Index> weld_exact(const MeshInput& input, Memory& memory) {
  {
    Vector<Index> found(input.vertex_count, &memory);
    if (weld_by_hash(input, found, memory)) return found;
  }
  struct Entry {
    Vec3 p;
    Index v;
  };
  Vector<Entry> entries(input.vertex_count, &memory);
  for (std::uint32_t v = 0; v < input.vertex_count; ++v) entries[v] = {position(input, v), static_cast<Index>(v)};
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    if (a.p.x != b.p.x) return a.p.x < b.p.x;
    if (a.p.y != b.p.y) return a.p.y < b.p.y;
    if (a.p.z != b.p.z) return a.p.z < b.p.z;
    return a.v < b.v;
  });
  Vector<Index> representative(input.vertex_count, &memory);
  for (std::size_t i = 0, first = 0; i < entries.size(); ++i) {
    const Vec3 &a = entries[i].p, &b = entries[first].p;
    if (a.x != b.x || a.y != b.y || a.z != b.z) first = i;
    representative[static_cast<std::size_t>(entries[i].v)] = entries[first].v;
  }
  return representative;
}

struct Cell {
  std::int64_t x, y, z;
  bool operator<(const Cell& o) const noexcept { return x != o.x ? x < o.x : y != o.y ? y < o.y : z < o.z; }
  bool operator==(const Cell& o) const noexcept { return x == o.x && y == o.y && z == o.z; }
};

Vector<Index> weld_tolerance(const MeshInput& input, Memory& memory) {
  const double tolerance = input.weld_tolerance;
  if (!(tolerance > 0) || !std::isfinite(tolerance))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "weld_tolerance must be a finite number above 0, in the unit of the positions");
  Vec3 low = position(input, 0);
  for (std::uint32_t v = 1; v < input.vertex_count; ++v) {
    const Vec3 p = position(input, v);
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
  }
  struct Entry {
    Cell cell;
    Index v;
    bool operator<(const Entry& o) const noexcept { return cell == o.cell ? v < o.v : cell < o.cell; }
  };
  Vector<Entry> entries(input.vertex_count, &memory);
  const auto coordinate = [&](double x, double origin) {
    const double cell = std::floor((x - origin) / tolerance);
    return cell < static_cast<double>(largest_cell) ? static_cast<std::int64_t>(cell) : largest_cell;
  };
  for (std::uint32_t v = 0; v < input.vertex_count; ++v) {
    const Vec3 p = position(input, v);
    entries[v] = {{coordinate(p.x, low.x), coordinate(p.y, low.y), coordinate(p.z, low.z)}, static_cast<Index>(v)};
  }
  std::sort(entries.begin(), entries.end());
  Vector<Index> parent(input.vertex_count, &memory);
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&](Index v) {
    while (parent[static_cast<std::size_t>(v)] != v)
      v = parent[static_cast<std::size_t>(v)] = parent[static_cast<std::size_t>(parent[static_cast<std::size_t>(v)])];
    return v;
  };
  // Visits half of the 27 cells around each vertex, so that each pair of cells is compared once.
  for (const Entry& entry : entries) {
    const Vec3 p = position(input, static_cast<std::size_t>(entry.v));
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dz = -1; dz <= 1; ++dz) {
          const Cell cell{entry.cell.x + dx, entry.cell.y + dy, entry.cell.z + dz};
          if (cell < entry.cell) continue;
          for (auto it = std::lower_bound(entries.begin(), entries.end(), Entry{cell, 0});
               it != entries.end() && it->cell == cell; ++it) {
            const Vec3 d = position(input, static_cast<std::size_t>(it->v)) - p;
            if (dot(d, d) > tolerance * tolerance) continue;
            const Index a = find(entry.v), b = find(it->v);
            if (a != b) parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
          }
        }
      }
    }
  }
  for (std::uint32_t v = 0; v < input.vertex_count; ++v) parent[v] = find(static_cast<Index>(v));
  return parent;
}

}  // namespace

Vector<Index> weld(const MeshInput& input, Memory& memory) {
  switch (input.weld) {
    case Weld::none: {
      Vector<Index> identity(input.vertex_count, &memory);
      std::iota(identity.begin(), identity.end(), 0);
      return identity;
    }
    case Weld::tolerance:
      return weld_tolerance(input, memory);
    case Weld::exact:
      break;
  }
  return weld_exact(input, memory);
}

}  // namespace hf_inner

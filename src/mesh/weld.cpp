#include "mesh/weld.h"

#include <algorithm>
#include <cstring>
#include <numeric>

#include "base/index.h"
#include "base/progress.h"

namespace hf_inner::mesh {
namespace {

// The hash table of positions starts with this many entries. It doubles until it has two per vertex. A larger number
// costs memory for small meshes, a smaller one copies: the table of 100,000 vertices doubles twelve times. No result
// depends on it.
constexpr std::size_t first_slots = 64;
// After this many probes per vertex, sorting replaces the hash table of positions. A half-full table needs about 1.5
// probes per vertex. Positions that are constructed to collide need up to n probes per vertex. Fewer sort meshes of
// some collisions, more let made ones take longer; no result depends on it.
constexpr std::uint64_t steps_per_vertex = 16, spare_steps = 1024;

Vec3 position(const MeshInput& input, std::size_t v) noexcept {
  // adding zero turns -0 into +0, so both have the same bits
  return {input.positions.get(v, 0) + 0.0, input.positions.get(v, 1) + 0.0, input.positions.get(v, 2) + 0.0};
}

// Mixes the bits of a position. The multipliers come from SplitMix64 (Steele, Lea and Flood 2014); Stafford found the
// last two. Each bit of the input changes each bit of the hash with probability near one half.
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
  Poller poller;
  const std::uint64_t most = steps_per_vertex * input.vertex_count + spare_steps;
  for (std::uint32_t v = 0; v < input.vertex_count; ++v) {
    const Vec3 p = position(input, v);
    std::size_t slot = static_cast<std::size_t>(mixed(p)) & (size - 1);
    poller.due();
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

}  // namespace

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
  Poller poller;
  std::sort(entries.begin(), entries.end(), [&](const Entry& a, const Entry& b) {
    poller.due();
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

}  // namespace hf_inner::mesh

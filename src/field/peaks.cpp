#include "field/peaks.h"

#include <algorithm>

#include "mesh/mesh.h"

namespace hf {
namespace {
using Index = std::int32_t;
std::size_t at(Index i) noexcept { return static_cast<std::size_t>(i); }
}  // namespace

Vector<Peak> find_peaks(const Topology& topology, Span<const double> field, Memory& memory) {
  const auto less = [&](Index a, Index b) {
    return field[at(a)] != field[at(b)] ? field[at(a)] < field[at(b)] : a < b;
  };
  const std::size_t n = field.size();
  // the highest neighbour above each vertex, then the peak that leads to
  Vector<Index> up(n, Mesh::none, &memory);
  for (std::size_t v = 0; v < n; ++v) {
    Index best = static_cast<Index>(v);
    for (Index i = topology.neighbour_start[v]; i < topology.neighbour_start[v + 1]; ++i) {
      const Index w = topology.neighbour[at(i)];
      if (less(best, w)) best = w;
    }
    if (best != static_cast<Index>(v)) up[v] = best;
  }
  Vector<Peak> peaks(&memory);
  Vector<Index> basin(n, Mesh::none, &memory);  // position in peaks
  for (std::size_t v = 0; v < n; ++v) {
    if (up[v] != Mesh::none) continue;
    basin[v] = static_cast<Index>(peaks.size());
    peaks.push_back({static_cast<Index>(v), Mesh::none});
  }
  for (std::size_t v = 0; v < n; ++v) {
    Index top = static_cast<Index>(v);
    while (basin[at(top)] == Mesh::none) top = up[at(top)];
    for (Index w = static_cast<Index>(v); basin[at(w)] == Mesh::none; w = up[at(w)]) basin[at(w)] = basin[at(top)];
  }

  struct Pass {
    Index vertex, a, b;  // the lower end of an edge between two basins
  };
  Vector<Pass> passes(&memory);
  for (Index e = 0; e < topology.edge_count(); ++e) {
    const Index v = topology.first(e), w = topology.second(e);
    if (basin[at(v)] != basin[at(w)]) passes.push_back({less(v, w) ? v : w, basin[at(v)], basin[at(w)]});
  }
  std::sort(passes.begin(), passes.end(), [&](const Pass& p, const Pass& q) {
    if (p.vertex != q.vertex) return less(q.vertex, p.vertex);
    return p.a != q.a ? p.a < q.a : p.b < q.b;
  });
  Vector<Index> parent(peaks.size(), &memory);  // the root of a set is its highest peak
  for (std::size_t i = 0; i < peaks.size(); ++i) parent[i] = static_cast<Index>(i);
  const auto find = [&](Index i) {
    while (parent[at(i)] != i) i = parent[at(i)] = parent[at(parent[at(i)])];
    return i;
  };
  for (const Pass& pass : passes) {
    Index a = find(pass.a), b = find(pass.b);
    if (a == b) continue;
    if (less(peaks[at(a)].vertex, peaks[at(b)].vertex)) std::swap(a, b);
    parent[at(b)] = a;
    peaks[at(b)].saddle = pass.vertex;
  }
  return peaks;
}

}  // namespace hf

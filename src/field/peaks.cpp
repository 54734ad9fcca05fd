#include "field/peaks.h"

#include <algorithm>

#include "base/index.h"
#include "mesh/mesh.h"

namespace hf_inner::field {

Vector<Peak> find_peaks(const mesh::Topology& topology, Span<const double> field, Memory& memory) {
  const auto less = [&](Index a, Index b) {
    return field[at(a)] != field[at(b)] ? field[at(a)] < field[at(b)] : a < b;
  };
  const std::size_t n = field.size();
  const Index* edge = topology.edges.data();
  const std::size_t edge_ends = topology.edges.size();
  // basin[v] is one higher neighbour of v, or v itself if there is none. The loop has no branch, because the processor
  // could not predict it.
  Vector<Index> basin(n, &memory);
  for (std::size_t v = 0; v < n; ++v) basin[v] = static_cast<Index>(v);
  for (std::size_t i = 0; i < edge_ends; i += 2) {
    const Index v = edge[i], w = edge[i + 1];  // v < w
    const Index swap = (v ^ w) & -static_cast<Index>(field[at(w)] >= field[at(v)]);
    basin[at(w ^ swap)] = v ^ swap;
  }
  Vector<Peak> peaks(&memory);
  for (std::size_t v = 0; v < n; ++v) {
    if (basin[v] == static_cast<Index>(v)) peaks.push_back({static_cast<Index>(v), mesh::Mesh::none});
  }
  // Finds the local maximum (peak) above each vertex. Every round at least halves the remaining path.
  for (Index changed = 1; changed != 0;) {
    changed = 0;
    for (std::size_t v = 0; v < n; ++v) {
      const Index next = basin[v], beyond = basin[at(next)];
      basin[v] = beyond;
      changed |= next ^ beyond;
    }
  }

  // Lists the edges between the basins (vertices below one peak) of different peaks.
  Vector<Index> between(edge_ends / 2 + 1, &memory);
  std::size_t count = 0;
  for (std::size_t i = 0; i < edge_ends; i += 2) {
    between[count] = static_cast<Index>(i / 2);
    count += basin[at(edge[i])] != basin[at(edge[i + 1])];
  }
  struct Pass {
    double height;
    Index vertex, a, b;  // positions in peaks
  };
  Vector<Index> number(n, &memory);
  for (std::size_t i = 0; i < peaks.size(); ++i) number[at(peaks[i].vertex)] = static_cast<Index>(i);
  Vector<Pass> passes(&memory);
  passes.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Index v = topology.first(between[i]), w = topology.second(between[i]), lower = less(v, w) ? v : w;
    passes.push_back({field[at(lower)], lower, number[at(basin[at(v)])], number[at(basin[at(w)])]});
  }
  std::sort(passes.begin(), passes.end(), [](const Pass& p, const Pass& q) {
    if (p.vertex != q.vertex) return p.height != q.height ? p.height > q.height : p.vertex > q.vertex;
    return p.a != q.a ? p.a < q.a : p.b < q.b;
  });
  Vector<Index> parent(peaks.size(), &memory);  // union-find of joined peaks; the root of a set is its highest peak
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

}  // namespace hf_inner::field

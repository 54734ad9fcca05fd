#include "quads/opposite_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/progress.h"
#include "quads/numbers.h"

namespace hf_inner::quads {
namespace {

// Pairs farther apart than so many edge lengths stay. More leaves out more of the curvature. At a smooth_radius of 2.8,
// 34 of 40 meshes have at most 1.2 times the singularities of Instant Meshes with 4. With 6 it is 36. Looking for pairs
// two or three times gives no more.
constexpr double farthest = 6;
// The wish is left out this far around the two, in edge lengths, besides half of their distance. With 0.5 they are 35,
// with 2 34.
constexpr double margin = 1;

// Every vertex near a singularity belongs to the nearest one, along edges.
struct Nearest {
  explicit Nearest(Index vertices, Memory& memory)
      : of(at(vertices), none, &memory), distance(at(vertices), HUGE_VAL, &memory) {}
  Vector<Index> of;
  Vector<double> distance;
};

Nearest find_nearest(const surface::Core& core, const remesh::Table<std::int32_t>& index, double reach,
                     Memory& memory) {
  struct Reached {
    double distance;
    Index vertex, of;
    bool operator<(const Reached& o) const noexcept {  // the nearest on top of the heap
      return distance != o.distance ? distance > o.distance : vertex != o.vertex ? vertex > o.vertex : of > o.of;
    }
  };
  Nearest out(core.size(), memory);
  Vector<Reached> heap(&memory);
  for (Index v = 0; v < core.size(); ++v) {
    if (index[v] != 0) heap.push_back({0, v, v});
  }
  std::make_heap(heap.begin(), heap.end());
  const mesh::Topology& topology = core.topology();
  Poller poller;
  while (!heap.empty()) {
    poller.due();
    std::pop_heap(heap.begin(), heap.end());
    const Reached here = heap.back();
    heap.pop_back();
    if (out.of[at(here.vertex)] != none) continue;
    out.of[at(here.vertex)] = here.of;
    out.distance[at(here.vertex)] = here.distance;
    for (Index i = topology.neighbour_start[at(here.vertex)]; i < topology.neighbour_start[at(here.vertex) + 1]; ++i) {
      const Index next = topology.neighbour[at(i)];
      const double distance =
          here.distance + norm(core.mesh.positions[at(next)] - core.mesh.positions[at(here.vertex)]);
      if (out.of[at(next)] != none || distance > reach) continue;
      heap.push_back({distance, next, here.of});
      std::push_heap(heap.begin(), heap.end());
    }
  }
  return out;
}

struct Pair {
  double distance;
  Index a, b;  // vertices, a < b
};

// Opposite singularities, the nearest first, each in one pair at most.
Vector<Pair> find_pairs(const surface::Core& core, const Nearest& nearest, const remesh::Table<std::int32_t>& index,
                        double far, Memory& memory) {
  Vector<Pair> all(&memory), out(&memory);
  const mesh::Topology& topology = core.topology();
  for (Index e = 0; e < topology.edge_count(); ++e) {
    const Index p = topology.first(e), q = topology.second(e), a = nearest.of[at(p)], b = nearest.of[at(q)];
    if (a == none || b == none || index[a] + index[b] != 0 || a == b) continue;
    const double distance = nearest.distance[at(p)] + nearest.distance[at(q)] +
                            norm(core.mesh.positions[at(q)] - core.mesh.positions[at(p)]);
    if (distance <= far) all.push_back({distance, std::min(a, b), std::max(a, b)});
  }
  std::sort(all.begin(), all.end(), [](const Pair& x, const Pair& y) {
    return x.distance != y.distance ? x.distance < y.distance : x.a != y.a ? x.a < y.a : x.b < y.b;
  });
  remesh::Table<std::uint8_t> taken(core.size(), 0, memory);
  for (const Pair& pair : all) {
    if (taken[pair.a] || taken[pair.b]) continue;
    taken[pair.a] = taken[pair.b] = 1;
    out.push_back(pair);
  }
  return out;
}

}  // namespace

void leave_out_pairs(const remesh::FluxSurface& surface, const field::DirectionMatrix& system, CrossSmoother& smoother,
                     Span<const HardCross> hard, const remesh::Table<std::uint8_t>& features,
                     const SharpCorners& corners, double edge_length, Vector<Complex>& wish) {
  const surface::Core& core = *system.core;
  Memory& memory = *core.memory;
  const auto find_index = [&](float from, float to) {
    const ProgressRange range(from, to);
    const Vector<Complex> crosses = smoother.smooth(wish, hard);
    const FaceCross faces =
        FaceCross::make(surface, system.connection, crosses, features, corners, remesh::Table<Complex>(memory), memory);
    remesh::Table<std::int32_t> out(core.size(), 0, memory);  // a vertex of the mesh can be several of the surface
    for (std::int32_t v = 0; v < surface.first_apex; ++v) out[surface.mesh_vertex[v]] += faces.index[v];
    return out;
  };
  const remesh::Table<std::int32_t> before = find_index(0.0f, 0.5f);
  const double far = farthest * edge_length, beyond = margin * edge_length;
  const Nearest nearest = find_nearest(core, before, far / 2 + beyond, memory);
  const Vector<Pair> pairs = find_pairs(core, nearest, before, far, memory);
  if (pairs.empty()) return;
  remesh::Table<Index> pair_of(core.size(), none, memory);  // by singularity
  for (std::size_t i = 0; i < pairs.size(); ++i) pair_of[pairs[i].a] = pair_of[pairs[i].b] = static_cast<Index>(i);
  const Vector<Complex> old(wish.begin(), wish.end(), &memory);
  remesh::Table<Index> left_out(core.size(), none, memory);  // by vertex: the pair for which its wish is left out
  for (Index v = 0; v < core.size(); ++v) {
    const Index s = nearest.of[at(v)], i = s == none ? none : pair_of[s];
    if (i == none || nearest.distance[at(v)] > pairs[at(i)].distance / 2 + beyond) continue;
    left_out[v] = i;
    wish[at(v)] = 0;
  }
  const remesh::Table<std::int32_t> after = find_index(0.5f, 1.0f);
  remesh::Table<std::int32_t> gain(static_cast<std::int32_t>(pairs.size()), 0, memory);
  for (Index v = 0; v < core.size(); ++v) {
    if (left_out[v] != none) gain[left_out[v]] += std::abs(before[v]) - std::abs(after[v]);
  }
  for (Index v = 0; v < core.size(); ++v) {
    if (left_out[v] != none && gain[left_out[v]] <= 0) wish[at(v)] = old[at(v)];
  }
}

}  // namespace hf_inner::quads

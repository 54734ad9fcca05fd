#include "mesh/geodesic_disc.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "base/index.h"
#include "mesh/unfold.h"

namespace hf_inner::mesh {
namespace {

// A vertex of a geodesic disc may lie this far beyond its radius, in mean edge lengths. It makes discs of one radius
// act alike on coarse and fine meshes. With half, a disc of finite_radius_test has 18 vertices instead of more than 20.
// At twice the value the share of a disc changes by 3 % from a coarse mesh to a fine one; the test allows 2 %.
constexpr double beyond = 0.3;
// Distances are computed this far beyond the disc's radius, in mean edge lengths. Those behind obtuse corners need it.
// A larger number takes longer. Half and double pass the nine tests of discs.
constexpr double search_further = 2;
// A vertex is visited again if its distance falls by at least this share. The number exceeds rounding errors, which
// could otherwise keep the loop running for ever. Half and double pass the nine tests of discs.
constexpr double least_gain = 1e-13;

// A front that spreads from vertex to vertex; distances only decrease. It visits a vertex again when it finds a shorter
// path. This happens behind an obtuse corner: the front may reach the vertex before the edge that the shorter path
// crosses.
class Front {
 public:
  Front(const Mesh& mesh, const Topology& topology, Memory& memory)
      : mesh_(mesh), topology_(topology), distance_(&memory), heap_(&memory) {}

  void offer(Index v, double distance) {
    const auto [it, fresh] = distance_.try_emplace(v, distance);
    if (!fresh && !(distance < it->second * (1 - least_gain))) return;
    it->second = distance;
    heap_.push_back({distance, v});
    std::push_heap(heap_.begin(), heap_.end(), later);
  }

  // Computes distances outwards from the source, as long as within(v, distance) returns true.
  template <class Within>
  void run(Within&& within) {
    while (!heap_.empty()) {
      std::pop_heap(heap_.begin(), heap_.end(), later);
      const auto [distance, v] = heap_.back();
      heap_.pop_back();
      if (distance > distance_.at(v) || !within(v, distance)) continue;
      spread(v, distance);
    }
  }
  const std::pmr::unordered_map<Index, double>& distances() const noexcept { return distance_; }
  // Returns the distance of a vertex, or infinity if no path has reached it.
  double distance(Index v) const {
    const auto found = distance_.find(v);
    return found == distance_.end() ? std::numeric_limits<double>::infinity() : found->second;
  }

 private:
  using Entry = std::pair<double, Index>;
  static bool later(const Entry& a, const Entry& b) noexcept { return a > b; }
  double length(Index a, Index b) const noexcept { return norm(mesh_.positions[at(a)] - mesh_.positions[at(b)]); }

  void spread(Index v, double own) {
    for (Index i = topology_.neighbour_start[at(v)]; i < topology_.neighbour_start[at(v) + 1]; ++i) {
      const Index w = topology_.neighbour[at(i)], e = topology_.neighbour_edge[at(i)];
      const double edge = length(v, w);
      offer(w, own + edge);
      const double other = distance(w);
      // a straight path through the edge v w may reach the third corner
      for (Index k = topology_.edge_triangle_start[at(e)]; k < topology_.edge_triangle_start[at(e) + 1]; ++k) {
        const Index* corner = mesh_.triangle(topology_.triangle(k));
        Index third = Mesh::none;
        for (int c = 0; c < 3; ++c) {
          if (corner[c] != v && corner[c] != w) third = corner[c];
        }
        offer(third, distance_across(own, other, edge, length(v, third), length(w, third)));
      }
    }
  }

  const Mesh& mesh_;
  const Topology& topology_;
  std::pmr::unordered_map<Index, double> distance_;
  Vector<Entry> heap_;
};

}  // namespace

Vector<DiscVertex> geodesic_disc(const Mesh& mesh, const Topology& topology, const Index vertex[3],
                                 const double weight[3], double radius, Memory& memory) {
  Front front(mesh, topology, memory);
  Vec3 source;
  for (int k = 0; k < 3; ++k) {
    if (vertex[k] >= 0) source = source + weight[k] * mesh.positions[at(vertex[k])];
  }
  for (int k = 0; k < 3; ++k) {
    if (vertex[k] >= 0) front.offer(vertex[k], norm(mesh.positions[at(vertex[k])] - source));
  }
  const auto mean_edge = [&](Index v) {
    double sum = 0;
    const Index begin = topology.neighbour_start[at(v)], end = topology.neighbour_start[at(v) + 1];
    for (Index i = begin; i < end; ++i)
      sum += norm(mesh.positions[at(topology.neighbour[at(i)])] - mesh.positions[at(v)]);
    return end > begin ? sum / (end - begin) : 0.0;
  };
  // Distances are computed up to two mean edges beyond the radius, because those behind obtuse corners need it.
  front.run([&](Index v, double distance) { return distance <= radius + search_further * mean_edge(v); });
  Vector<DiscVertex> disc(&memory);
  const auto inside = [&](Index v) { return front.distance(v) <= radius + beyond * mean_edge(v); };
  for (const auto& [v, distance] : front.distances()) {
    if (inside(v)) disc.push_back({v, distance, false});
  }
  std::sort(disc.begin(), disc.end(), [](const DiscVertex& a, const DiscVertex& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.vertex < b.vertex;
  });
  for (DiscVertex& entry : disc) {
    for (Index i = topology.neighbour_start[at(entry.vertex)]; i < topology.neighbour_start[at(entry.vertex) + 1]; ++i)
      entry.rim = entry.rim || !inside(topology.neighbour[at(i)]);
  }
  return disc;
}

}  // namespace hf_inner::mesh

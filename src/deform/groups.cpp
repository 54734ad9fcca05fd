#include "deform/groups.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hf {
namespace {

struct Front {
  double distance;
  std::int32_t vertex;
  bool operator<(const Front& other) const noexcept {  // std heaps keep the largest on top
    return distance != other.distance ? distance > other.distance : vertex > other.vertex;
  }
};

// Spreads group `group` from its seed over the vertices that are nearer to it than to their present group.
class Spreading {
 public:
  Spreading(const Core& core, Memory& memory)
      : core_(core), distance_(core.size(), std::numeric_limits<double>::infinity(), &memory), heap_(&memory) {}

  void add(std::int32_t group, std::int32_t seed, Vector<std::int32_t>& group_of) {
    const Topology& topology = core_.topology;
    distance_[seed] = 0, group_of[seed] = group;
    heap_.assign(1, Front{0.0, seed});
    while (!heap_.empty()) {
      std::pop_heap(heap_.begin(), heap_.end());
      const Front front = heap_.back();
      heap_.pop_back();
      if (front.distance > distance_[front.vertex]) continue;
      for (std::int32_t k = topology.neighbour_start[front.vertex]; k < topology.neighbour_start[front.vertex + 1];
           ++k) {
        const std::int32_t u = topology.neighbour[k];
        const double distance = front.distance + norm(core_.mesh.positions[u] - core_.mesh.positions[front.vertex]);
        if (!(distance < distance_[u])) continue;
        distance_[u] = distance, group_of[u] = group;
        heap_.push_back({distance, u});
        std::push_heap(heap_.begin(), heap_.end());
      }
    }
  }

  std::int32_t farthest(Span<const std::int32_t> vertices) const noexcept {
    std::int32_t best = vertices[0];
    for (const std::int32_t v : vertices) {
      if (distance_[v] > distance_[best]) best = v;
    }
    return best;
  }
  double distance(std::int32_t v) const noexcept { return distance_[v]; }

 private:
  const Core& core_;
  Vector<double> distance_;
  Vector<Front> heap_;
};

}  // namespace

std::shared_ptr<const Groups> Groups::with(std::shared_ptr<const Groups> groups, const Core& core, const Rest& rest,
                                           Span<const std::int32_t> components, std::int32_t wished, Memory& memory) {
  bool complete = groups != nullptr;
  for (const std::int32_t c : components) complete = complete && groups->has(c);
  if (complete) return groups;

  auto grown = make_shared_in<Groups>(memory, memory);
  if (groups) {
    grown->group_of = groups->group_of, grown->seed = groups->seed, grown->component = groups->component;
    grown->component_start = groups->component_start, grown->component_end = groups->component_end;
  } else {
    grown->group_of.assign(core.size(), -1);
    grown->component_start.assign(core.mesh.component_count(), 0);
    grown->component_end.assign(core.mesh.component_count(), 0);
  }
  double total_area = 0;
  for (const double area : rest.component_area) total_area += area;
  Spreading spreading(core, memory);
  for (const std::int32_t c : components) {
    if (grown->has(c)) continue;
    const Span<const std::int32_t> vertices = rest.vertices_of(c);
    const double share = total_area > 0 ? rest.component_area[c] / total_area : 1.0;
    const std::int32_t quota = std::max((wished + 3) / 4, static_cast<std::int32_t>(std::lround(share * wished)));
    grown->component_start[c] = grown->count();
    for (std::int32_t k = 0; k < quota; ++k) {
      const std::int32_t seed = spreading.farthest(vertices);
      if (k > 0 && !(spreading.distance(seed) > 0)) break;  // every vertex is a seed or coincides with one
      spreading.add(grown->count(), seed, grown->group_of);
      grown->seed.push_back(seed), grown->component.push_back(c);
    }
    grown->component_end[c] = grown->count();
  }
  return grown;
}

}  // namespace hf

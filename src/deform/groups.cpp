#include "deform/groups.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hf {
namespace {

struct Front {
  double distance;
  std::int32_t vertex;
};

// Spreads group `group` from its seed over the vertices that are nearer to it than to their present group. The
// distances are the fixed point d[u] = min over neighbours v of d[v] + |uv|, which does not depend on the order in
// which vertices are relaxed; so no heap is needed: a front of all vertices below a limit, which rises by a mean edge
// (Meyer and Sanders 2003, delta-stepping on one thread).
class Spreading {
 public:
  Spreading(const Core& core, Memory& memory)
      : topology_(core.topology),
        length_(core.topology.neighbour.size(), &memory),
        distance_(core.size(), std::numeric_limits<double>::infinity(), &memory),
        place_(core.size(), 0, &memory),
        near_(&memory),
        far_(&memory),
        best_(&memory),
        stale_(&memory) {
    Vector<double> of_edge(topology_.edge_count(), &memory);
    for (std::int32_t e = 0; e < topology_.edge_count(); ++e)
      of_edge[e] = norm(core.mesh.positions[topology_.second(e)] - core.mesh.positions[topology_.first(e)]);
    for (std::size_t k = 0; k < length_.size(); ++k) length_[k] = of_edge[topology_.neighbour_edge[k]];
  }

  // The vertices of the component that groups are made in next.
  void enter(Span<const std::int32_t> vertices) {
    vertices_ = vertices;
    double total = 0;
    std::size_t ends = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      place_[vertices[i]] = static_cast<std::int32_t>(i);
      const std::int32_t first = topology_.neighbour_start[vertices[i]],
                         last = topology_.neighbour_start[vertices[i] + 1];
      for (std::int32_t k = first; k < last; ++k) total += length_[k];
      ends += static_cast<std::size_t>(last - first);
    }
    step_ = ends > 0 ? total / static_cast<double>(ends) : 0.0;
    const std::size_t blocks = (vertices.size() + block - 1) / block;
    best_.assign(blocks, 0), stale_.assign(blocks, 1);
  }

  void add(std::int32_t group, std::int32_t seed, Vector<std::int32_t>& group_of) {
    const auto reach = [&](std::int32_t v, double distance) {
      distance_[v] = distance, group_of[v] = group, stale_[place_[v] / block] = 1;
    };
    reach(seed, 0.0);
    near_.assign(1, Front{0.0, seed});
    for (double limit = step_;;) {
      while (!near_.empty()) {
        const Front front = near_.back();
        near_.pop_back();
        if (front.distance > distance_[front.vertex]) continue;  // came nearer since
        for (std::int32_t k = topology_.neighbour_start[front.vertex]; k < topology_.neighbour_start[front.vertex + 1];
             ++k) {
          const std::int32_t u = topology_.neighbour[k];
          const double distance = front.distance + length_[k];
          if (!(distance < distance_[u])) continue;
          reach(u, distance);
          (distance < limit ? near_ : far_).push_back({distance, u});
        }
      }
      if (far_.empty()) return;
      double nearest = far_[0].distance;
      for (const Front& front : far_) nearest = std::min(nearest, front.distance);
      limit = nearest + step_;
      std::size_t kept = 0;
      for (const Front& front : far_) {
        if (front.distance > distance_[front.vertex]) continue;
        if (front.distance < limit || front.distance == nearest)
          near_.push_back(front);
        else
          far_[kept++] = front;
      }
      far_.resize(kept);
    }
  }

  // The first of the farthest vertices. Only blocks that have changed since are looked through.
  std::int32_t farthest() noexcept {
    std::int32_t found = vertices_[0];
    for (std::size_t b = 0; b < best_.size(); ++b) {
      if (stale_[b]) {
        const std::size_t last = std::min((b + 1) * block, vertices_.size());
        best_[b] = vertices_[b * block];
        for (std::size_t i = b * block; i < last; ++i) {
          if (distance_[vertices_[i]] > distance_[best_[b]]) best_[b] = vertices_[i];
        }
        stale_[b] = 0;
      }
      if (distance_[best_[b]] > distance_[found]) found = best_[b];
    }
    return found;
  }
  double distance(std::int32_t v) const noexcept { return distance_[v]; }

 private:
  static constexpr std::size_t block = 256;
  const Topology& topology_;
  Vector<double> length_;  // of the edges, by neighbour
  Vector<double> distance_;
  Vector<std::int32_t> place_;  // in vertices_
  Vector<Front> near_, far_;
  Span<const std::int32_t> vertices_;
  Vector<std::int32_t> best_;   // per block of vertices_ the farthest
  Vector<std::uint8_t> stale_;  // per block
  double step_ = 0;
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
    spreading.enter(vertices);
    for (std::int32_t k = 0; k < quota; ++k) {
      const std::int32_t seed = spreading.farthest();
      if (k > 0 && !(spreading.distance(seed) > 0)) break;  // every vertex is a seed or coincides with one
      spreading.add(grown->count(), seed, grown->group_of);
      grown->seed.push_back(seed), grown->component.push_back(c);
    }
    grown->component_end[c] = grown->count();
  }
  return grown;
}

}  // namespace hf

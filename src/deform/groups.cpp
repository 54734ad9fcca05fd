#include "deform/groups.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hf_inner::deform {
namespace {

struct Front {
  double distance;
  std::int32_t vertex;
};

// Spreads a new rotation group from its first vertex (seed) over the vertices that are nearer to it than to their
// present group.
//
// The distances are the fixed point d[u] = min over neighbours v of d[v] + |uv|. This does not depend on the order in
// which vertices are visited, so no heap is needed. The front, the list of vertices to visit, holds all vertices below
// a limit, and the limit rises by a mean edge length (delta-stepping, Meyer and Sanders 2003, on one thread).
class Spreading {
 public:
  Spreading(const surface::Core& core, Memory& memory)
      : start_(core.topology().neighbour_start.data()),
        arc_(memory, core.topology().neighbour.size()),
        node_(memory, core.size()),
        near_(&memory),
        far_(&memory),
        best_(&memory),
        stale_(&memory) {
    const mesh::Topology& topology = core.topology();
    Buffer<double> length(memory, topology.edge_count());
    for (std::int32_t e = 0; e < topology.edge_count(); ++e)
      length[e] = norm(core.mesh.positions[topology.second(e)] - core.mesh.positions[topology.first(e)]);
    for (std::size_t k = 0; k < arc_.size(); ++k) arc_[k] = {length[topology.neighbour_edge[k]], topology.neighbour[k]};
    std::fill(node_.begin(), node_.end(), Node{std::numeric_limits<double>::infinity(), -1, 0});
  }

  // Sets the component in which the next rotation groups are made. vertices: its vertices.
  void enter(Span<const std::int32_t> vertices) {
    vertices_ = vertices;
    double total = 0;
    std::size_t ends = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      node_[vertices[i]].block = static_cast<std::int32_t>(i / block);
      const std::int32_t first = start_[vertices[i]], last = start_[vertices[i] + 1];
      for (std::int32_t k = first; k < last; ++k) total += arc_[k].length;
      ends += static_cast<std::size_t>(last - first);
    }
    step_ = ends > 0 ? total / static_cast<double>(ends) : 0.0;
    const std::size_t blocks = (vertices.size() + block - 1) / block;
    best_.assign(blocks, 0);
    stale_.assign(blocks, 1);
  }

  void add(std::int32_t group, std::int32_t seed) {
    const auto reach = [&](Node& node, double distance) {
      node.distance = distance;
      node.group = group;
      stale_[node.block] = 1;
    };
    reach(node_[seed], 0.0);
    near_.assign(1, Front{0.0, seed});
    for (double limit = step_;;) {
      while (!near_.empty()) {
        const Front front = near_.back();
        near_.pop_back();
        if (front.distance > node_[front.vertex].distance) continue;  // a shorter path was found since
        for (std::int32_t k = start_[front.vertex]; k < start_[front.vertex + 1]; ++k) {
          Node& node = node_[arc_[k].vertex];
          const double distance = front.distance + arc_[k].length;
          if (!(distance < node.distance)) continue;
          reach(node, distance);
          (distance < limit ? near_ : far_).push_back({distance, arc_[k].vertex});
        }
      }
      if (far_.empty()) return;
      double nearest = far_[0].distance;
      for (const Front& front : far_) nearest = std::min(nearest, front.distance);
      limit = nearest + step_;
      std::size_t kept = 0;
      for (const Front& front : far_) {
        if (front.distance > node_[front.vertex].distance) continue;
        if (front.distance < limit || front.distance == nearest)
          near_.push_back(front);
        else
          far_[kept++] = front;
      }
      far_.resize(kept);
    }
  }

  // Returns the first of the farthest vertices. It only searches blocks of vertices that have changed since the last
  // call.
  std::int32_t farthest() noexcept {
    std::int32_t found = vertices_[0];
    for (std::size_t b = 0; b < best_.size(); ++b) {
      if (stale_[b]) {
        const std::size_t last = std::min((b + 1) * block, vertices_.size());
        best_[b] = vertices_[b * block];
        for (std::size_t i = b * block; i < last; ++i) {
          if (distance(vertices_[i]) > distance(best_[b])) best_[b] = vertices_[i];
        }
        stale_[b] = 0;
      }
      if (distance(best_[b]) > distance(found)) found = best_[b];
    }
    return found;
  }
  double distance(std::int32_t v) const noexcept { return node_[v].distance; }
  std::int32_t group(std::int32_t v) const noexcept { return node_[v].group; }

 private:
  static constexpr std::size_t block = farthest_block;
  struct Arc {
    double length;
    std::int32_t vertex;
  };
  struct Node {
    double distance;
    std::int32_t group, block;  // block: number of a run of farthest_block vertices
  };
  const std::int32_t* start_;  // neighbours of vertex v: arc_[start_[v] .. start_[v + 1])
  Buffer<Arc> arc_;
  Buffer<Node> node_;
  Vector<Front> near_, far_;
  Span<const std::int32_t> vertices_;
  Vector<std::int32_t> best_;   // by block of vertices_: its farthest vertex
  Vector<std::uint8_t> stale_;  // by block of vertices_: 1 if a distance in it has changed
  double step_ = 0;
};

}  // namespace

std::shared_ptr<const Groups> Groups::with(std::shared_ptr<const Groups> groups, const surface::Core& core,
                                           const Rest& rest, Span<const std::int32_t> components, std::int32_t wished,
                                           Memory& memory) {
  bool complete = groups != nullptr;
  for (const std::int32_t c : components) complete = complete && groups->has(c);
  if (complete) return groups;

  auto grown = make_shared_in<Groups>(memory, memory);
  if (groups) {
    grown->group_of = groups->group_of;
    grown->seed = groups->seed;
    grown->component = groups->component;
    grown->component_start = groups->component_start;
    grown->component_end = groups->component_end;
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
    const std::int32_t quota = std::max((wished + least_group_share - 1) / least_group_share,
                                        static_cast<std::int32_t>(std::lround(share * wished)));
    grown->component_start[c] = grown->count();
    spreading.enter(vertices);
    for (std::int32_t k = 0; k < quota; ++k) {
      const std::int32_t seed = spreading.farthest();
      if (k > 0 && !(spreading.distance(seed) > 0)) break;  // every vertex is a seed or coincides with one
      spreading.add(grown->count(), seed);
      grown->seed.push_back(seed);
      grown->component.push_back(c);
    }
    grown->component_end[c] = grown->count();
    for (const std::int32_t v : vertices) grown->group_of[v] = spreading.group(v);
  }
  for (std::int32_t e = 0; e < core.topology().edge_count(); ++e) {
    if (grown->group_of[core.topology().first(e)] != grown->group_of[core.topology().second(e)])
      grown->border_edge.push_back(e);
  }
  return grown;
}

}  // namespace hf_inner::deform

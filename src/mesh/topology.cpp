#include "mesh/topology.h"

#include <algorithm>

#include "base/progress.h"

namespace hf_inner {
namespace {

// Number of vertices that one thread's job takes. Half and twice the value take the same time within 10 %, the
// noise of the measurement (two threads). No result depends on this number.
constexpr std::size_t bucket_piece = 16384;

}  // namespace

Topology Topology::make(const Mesh& mesh, Memory& memory, JobRunner* jobs) {
  using Index = std::int32_t;
  const auto at = [](Index i) { return static_cast<std::size_t>(i); };
  Topology topology(memory);
  const std::size_t n = mesh.positions.size(), corner_count = mesh.corners.size();

  // Half-edges are put into buckets by their smaller vertex, then sorted by their larger vertex.
  struct Half {
    Index second, side;  // the side as in edge_side
  };
  Vector<Index> start(n + 1, 0, &memory);
  for (std::size_t c = 0; c < corner_count; ++c) {
    const std::size_t t = c / 3, k = c % 3;
    ++start[at(std::min(mesh.corners[c], mesh.corners[3 * t + (k + 1) % 3])) + 1];
  }
  for (std::size_t v = 0; v < n; ++v) start[v + 1] += start[v];
  poll();
  Vector<Half> halves(corner_count, &memory);
  Vector<Index> cursor(start.begin(), start.end() - 1, &memory);
  for (std::size_t c = 0; c < corner_count; ++c) {
    const std::size_t t = c / 3, k = c % 3;
    const Index a = mesh.corners[c], b = mesh.corners[3 * t + (k + 1) % 3];
    halves[at(cursor[at(std::min(a, b))]++)] = {std::max(a, b), static_cast<Index>(2 * c + (a < b))};
  }
  poll();
  topology.edges.reserve(corner_count);
  topology.edge_triangle_start.reserve(corner_count / 2);
  topology.edge_side.resize(corner_count);
  const auto sort_bucket = [&](std::size_t v) {
    std::sort(halves.begin() + start[v], halves.begin() + start[v + 1], [](const Half& a, const Half& b) {
      return a.second != b.second ? a.second < b.second : a.side < b.side;
    });
  };
  for_each(jobs, static_cast<std::uint32_t>((n + bucket_piece - 1) / bucket_piece), [&](std::uint32_t p) {
    for (std::size_t v = p * bucket_piece; v < std::min(n, (p + std::size_t{1}) * bucket_piece); ++v) sort_bucket(v);
  });
  for (std::size_t v = 0; v < n; ++v) {
    const auto begin = halves.begin() + start[v], end = halves.begin() + start[v + 1];
    for (auto half = begin; half != end; ++half) {
      if (half == begin || half->second != (half - 1)->second) {
        topology.edge_triangle_start.push_back(static_cast<Index>(half - halves.begin()));
        topology.edges.push_back(static_cast<Index>(v));
        topology.edges.push_back(half->second);
      }
      topology.edge_side[static_cast<std::size_t>(half - halves.begin())] = half->side;
    }
  }
  topology.edge_triangle_start.push_back(static_cast<Index>(corner_count));
  poll();
  topology.fill_neighbours(n, memory);
  return topology;
}

// Edges are ordered by (first, second), so both passes fill every row in ascending order.
void Topology::fill_neighbours(std::size_t vertex_count, Memory& memory) {
  neighbour_start.assign(vertex_count + 1, 0);
  for (const std::int32_t v : edges) ++neighbour_start[static_cast<std::size_t>(v) + 1];
  for (std::size_t v = 0; v < vertex_count; ++v) neighbour_start[v + 1] += neighbour_start[v];
  neighbour.resize(edges.size());
  neighbour_edge.resize(edges.size());
  Vector<std::int32_t> cursor(neighbour_start.begin(), neighbour_start.end() - 1, &memory);
  const auto add = [&](std::int32_t from, std::int32_t to, std::int32_t edge) {
    const std::size_t slot = static_cast<std::size_t>(cursor[static_cast<std::size_t>(from)]++);
    neighbour[slot] = to, neighbour_edge[slot] = edge;
  };
  for (std::int32_t e = 0; e < edge_count(); ++e) add(second(e), first(e), e);
  poll();
  for (std::int32_t e = 0; e < edge_count(); ++e) add(first(e), second(e), e);
}

std::int32_t Topology::edge_between(std::int32_t a, std::int32_t b) const noexcept {
  const std::size_t v = static_cast<std::size_t>(a);
  const auto begin = neighbour.begin() + neighbour_start[v], end = neighbour.begin() + neighbour_start[v + 1];
  const auto found = std::lower_bound(begin, end, b);
  if (found == end || *found != b) return Mesh::none;
  return neighbour_edge[static_cast<std::size_t>(found - neighbour.begin())];
}

void count_edges(const Topology& topology, MeshReport& report) noexcept {
  const auto at = [](std::int32_t i) { return static_cast<std::size_t>(i); };
  report.boundary_edge_count = report.non_manifold_edge_count = report.flipped_edge_count = 0;
  for (std::int32_t e = 0; e < topology.edge_count(); ++e) {
    const std::int32_t begin = topology.edge_triangle_start[at(e)], end = topology.edge_triangle_start[at(e) + 1];
    report.boundary_edge_count += end - begin == 1;
    report.non_manifold_edge_count += end - begin > 2;
    std::int32_t forward = 0;
    for (std::int32_t i = begin; i < end; ++i) forward += topology.forward(i);
    report.flipped_edge_count += forward > 1 || end - begin - forward > 1;
  }
}

}  // namespace hf_inner

#include "mesh/topology.h"

#include <algorithm>
#include <utility>

#include "base/index.h"
#include "base/progress.h"

namespace hf_inner::mesh {
namespace {

// Number of vertices that one thread's job takes. Half and twice the value take the same time within 10 %, the
// noise of the measurement (two threads). No result depends on this number.
constexpr std::size_t bucket_piece = 16384;
// Fewer items are put into rows by one thread: starting another takes longer. On two threads 21,000 vertices need 1.1
// ms; half and double change it by at most 0.1. At most so many threads work, because every part has a counter for each
// row: four take 16 bytes per vertex. More were not measured. No result depends on these numbers.
constexpr std::size_t least_part = 65536, most_parts = 4;

// Puts the items 0 .. count into rows. Row r gets the slots start[r] .. start[r + 1], which hold its items in ascending
// order. row_of(i) is the row of an item, put(slot, i) stores it. Each thread counts and puts one part of the items.
template <class RowOf, class Put>
void put_into_rows(std::size_t rows, std::size_t count, Vector<Index>& start, Memory& memory, JobRunner* jobs,
                   RowOf&& row_of, Put&& put) {
  const std::size_t threads = jobs ? jobs->thread_count() : 1;
  const std::size_t parts = std::max<std::size_t>(1, std::min({threads, most_parts, count / least_part}));
  Vector<Index> cursor(parts * rows, 0, &memory);
  const auto for_parts = [&](auto&& use) {
    for_each(jobs, static_cast<std::uint32_t>(parts), [&](std::uint32_t p) {
      Index* const own = cursor.data() + p * rows;
      for (std::size_t i = count * p / parts; i < count * (p + 1) / parts; ++i) use(own[row_of(i)], i);
    });
    poll();
  };
  for_parts([](Index& place, std::size_t) { ++place; });
  start.resize(rows + 1);
  Index next = 0;
  for (std::size_t r = 0; r < rows; ++r) {
    start[r] = next;
    for (std::size_t p = 0; p < parts; ++p) next += std::exchange(cursor[p * rows + r], next);
  }
  start[rows] = next;
  for_parts([&](Index& place, std::size_t i) { put(at(place++), i); });
}

}  // namespace

Topology Topology::make(const Mesh& mesh, Memory& memory, JobRunner* jobs) {
  Topology topology(memory);
  const std::size_t n = mesh.positions.size(), corner_count = mesh.corners.size();

  // Half-edges are put into buckets by their smaller vertex, then sorted by their larger vertex.
  struct Half {
    Index second, side;  // the side as in edge_side
  };
  const auto next_corner = [&](std::size_t c) { return mesh.corners[c % 3 == 2 ? c - 2 : c + 1]; };
  Vector<Index> start(&memory);
  Buffer<Half> halves(memory, corner_count);
  put_into_rows(
      n, corner_count, start, memory, jobs,
      [&](std::size_t c) { return at(std::min(mesh.corners[c], next_corner(c))); },
      [&](std::size_t slot, std::size_t c) {
        const Index a = mesh.corners[c], b = next_corner(c);
        halves[slot] = {std::max(a, b), static_cast<Index>(2 * c + (a < b))};
      });
  // use(half, first, is_new): is_new marks the first half-edge of an edge
  const auto for_halves = [&](std::size_t piece, auto&& use) {
    for (std::size_t v = piece * bucket_piece; v < std::min(n, (piece + 1) * bucket_piece); ++v) {
      for (Index h = start[v]; h < start[v + 1]; ++h)
        use(h, static_cast<Index>(v), h == start[v] || halves[at(h)].second != halves[at(h) - 1].second);
    }
  };
  const std::size_t pieces = (n + bucket_piece - 1) / bucket_piece;
  Vector<Index> edge_start(pieces + 1, 0, &memory);  // by piece
  for_each(jobs, static_cast<std::uint32_t>(pieces), [&](std::uint32_t p) {
    for (std::size_t v = p * bucket_piece; v < std::min(n, (p + std::size_t{1}) * bucket_piece); ++v) {
      std::sort(halves.data() + start[v], halves.data() + start[v + 1], [](const Half& a, const Half& b) {
        return a.second != b.second ? a.second < b.second : a.side < b.side;
      });
    }
    for_halves(p, [&](Index, Index, bool is_new) { edge_start[p + 1] += is_new; });
  });
  for (std::size_t p = 0; p < pieces; ++p) edge_start[p + 1] += edge_start[p];
  topology.edges.resize(2 * at(edge_start[pieces]));
  topology.edge_triangle_start.resize(at(edge_start[pieces]) + 1);
  topology.edge_side.resize(corner_count);
  for_each(jobs, static_cast<std::uint32_t>(pieces), [&](std::uint32_t p) {
    std::size_t e = at(edge_start[p]);
    for_halves(p, [&](Index h, Index v, bool is_new) {
      if (is_new) {
        topology.edge_triangle_start[e] = h;
        topology.edges[2 * e] = v;
        topology.edges[2 * e + 1] = halves[at(h)].second;
        ++e;
      }
      topology.edge_side[at(h)] = halves[at(h)].side;
    });
  });
  topology.edge_triangle_start.back() = static_cast<Index>(corner_count);
  poll();
  topology.fill_neighbours(n, memory, jobs);
  return topology;
}

// Edges are ordered by (first, second). So a row gets its smaller neighbours first, then the larger ones, all
// ascending.
void Topology::fill_neighbours(std::size_t vertex_count, Memory& memory, JobRunner* jobs) {
  const std::size_t count = edges.size() / 2;
  neighbour.resize(2 * count);
  neighbour_edge.resize(2 * count);
  put_into_rows(
      vertex_count, 2 * count, neighbour_start, memory, jobs,
      [&](std::size_t i) { return at(edges[i < count ? 2 * i + 1 : 2 * (i - count)]); },
      [&](std::size_t slot, std::size_t i) {
        const std::size_t e = i < count ? i : i - count;
        neighbour[slot] = edges[i < count ? 2 * e : 2 * e + 1];
        neighbour_edge[slot] = static_cast<Index>(e);
      });
}

std::int32_t Topology::edge_between(std::int32_t a, std::int32_t b) const noexcept {
  const std::size_t v = static_cast<std::size_t>(a);
  const auto begin = neighbour.begin() + neighbour_start[v], end = neighbour.begin() + neighbour_start[v + 1];
  const auto found = std::lower_bound(begin, end, b);
  if (found == end || *found != b) return Mesh::none;
  return neighbour_edge[static_cast<std::size_t>(found - neighbour.begin())];
}

void count_edges(const Topology& topology, MeshReport& report) noexcept {
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

void Topology::triangles_at(Index v, Vector<Index>& out) const {
  for (Index i = neighbour_start[at(v)]; i < neighbour_start[at(v) + 1]; ++i) {
    const std::size_t e = at(neighbour_edge[at(i)]);
    for (Index s = edge_triangle_start[e]; s < edge_triangle_start[e + 1]; ++s) out.push_back(triangle(s));
  }
}

}  // namespace hf_inner::mesh

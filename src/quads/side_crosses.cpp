#include "quads/side_crosses.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/elementary.h"
#include "quads/numbers.h"

namespace hf_inner::quads {
namespace {

// Crosses shorter than this cancel out. In a round patch of radius 1 they do so within 0.56.
constexpr double cancelled = 0.1;
// A shorter wish says nothing (least_wish of cross_field.cpp): on a flat patch it is rounding.
constexpr double no_wish = 1e-3;

// The cross along a half-edge in its triangle, turned by `turn`, in the frame of a vertex at one of its ends.
Complex cross_along(const remesh::FluxSurface& s, const field::Connection& connection, std::int32_t h, double turn,
                    Index vertex) {
  const Vec3 a = s.position[s.tail[h]], along = unit_vector(s.position[s.head(h)] - a),
             normal = unit_vector(cross(along, s.position[s.tail[remesh::FluxSurface::previous(h)]] - a));
  const Vec3 direction = cosine(turn) * along + sine(turn) * cross(normal, along);
  // A triangle may be turned over against the mesh.
  const Vec3 own = connection.normal[at(vertex)], facing = dot(own, normal) < 0 ? -1.0 * normal : normal;
  Complex z = unit_of(connection.to_frame(vertex, field::carry(direction, facing, own)), 0);
  z *= z;
  return z * z;
}

}  // namespace

SideCrosses SideCrosses::find(const remesh::FluxSurface& surface, const field::Connection& connection,
                              const remesh::Table<std::uint8_t>& features, const SharpCorners& corners,
                              Vector<HardCross>& hard, Memory& memory) {
  SideCrosses out(memory);
  if (corners.empty()) return out;
  const std::int32_t halves = 3 * surface.real_triangles;
  remesh::Table<std::uint8_t> has_sides(surface.vertex_count(), 0, memory);
  for (std::int32_t h = 0; h < halves; ++h) {
    if (!corners.tooth[h]) continue;
    has_sides[surface.tail[h]] = has_sides[surface.head(h)] = 1;
  }
  out.of_corner.assign(surface.half_count(), Complex(0, 0));
  for (std::int32_t first = 0; first < halves; ++first) {
    const std::int32_t v = surface.tail[first];
    if (!features[first] || !has_sides[v]) continue;
    std::int32_t last = first;
    while (!features[remesh::FluxSurface::previous(last)]) last = surface.turn_left(last);
    last = remesh::FluxSurface::previous(last);
    const Index vertex = surface.mesh_vertex[v];
    const Complex cross = unit_of(cross_along(surface, connection, first, corners.turn[first], vertex) +
                                      cross_along(surface, connection, last, corners.turn[last], vertex),
                                  0);
    for (std::int32_t h = first;; h = surface.turn_left(h)) {
      out.of_corner[h] = cross;
      if (remesh::FluxSurface::previous(h) == last) break;
    }
  }
  remesh::Table<Complex> held(static_cast<std::int32_t>(connection.normal.size()), Complex(0, 0), memory);
  for (const HardCross& h : hard) held[h.vertex] = h.cross;
  for (std::int32_t h = 0; h < halves; ++h) {
    if (out.of_corner[h] == 0.0) continue;
    const Index v = surface.mesh_vertex[surface.tail[h]];
    if (held[v] == 0.0) hard.push_back({v, held[v] = out.of_corner[h]});
    if (features[h]) {
      out.turned.push_back(v);
    } else {
      out.seen.push_back({v, surface.mesh_vertex[surface.head(h)], out.of_corner[h] - held[v]});
    }
  }
  std::sort(hard.begin(), hard.end(), [](const HardCross& a, const HardCross& b) { return a.vertex < b.vertex; });
  return out;
}

void leave_out_near(const mesh::Mesh& mesh, const mesh::Topology& topology, Span<const Index> vertices, double far,
                    Vector<Complex>& wish) {
  struct Reached {
    double distance;
    Index vertex;
    bool operator<(const Reached& o) const noexcept { return distance > o.distance; }  // the nearest on top of the heap
  };
  Vector<double> distance(wish.size(), HUGE_VAL, wish.get_allocator());
  Vector<Reached> heap(wish.get_allocator());
  const auto reach = [&](Index v, double here) {
    if (here > far || here >= distance[at(v)]) return;
    distance[at(v)] = here;
    wish[at(v)] = 0;
    heap.push_back({here, v});
    std::push_heap(heap.begin(), heap.end());
  };
  for (const Index v : vertices) reach(v, 0);
  while (!heap.empty()) {
    std::pop_heap(heap.begin(), heap.end());
    const Reached here = heap.back();
    heap.pop_back();
    if (here.distance > distance[at(here.vertex)]) continue;  // reached on a shorter way since
    for (Index i = topology.neighbour_start[at(here.vertex)]; i < topology.neighbour_start[at(here.vertex) + 1]; ++i) {
      const Index next = topology.neighbour[at(i)];
      reach(next, here.distance + norm(mesh.positions[at(next)] - mesh.positions[at(here.vertex)]));
    }
  }
}

bool part_turns(const remesh::FluxSurface& surface, const mesh::Topology& topology, const field::Connection& connection,
                Span<const Complex> wish, Span<const Complex> crosses, const remesh::Table<std::int32_t>& index,
                Vector<HardCross>& hard, Memory& memory) {
  constexpr std::int32_t most_turns = 2;
  const std::size_t before = hard.size();
  Vector<Index> patch(&memory);
  remesh::Table<std::uint8_t> reached(static_cast<std::int32_t>(wish.size()), 0, memory);
  remesh::Table<std::int32_t> turns_of(reached.size(), 0, memory);
  for (std::int32_t v = 0; v < surface.first_apex; ++v) turns_of[surface.mesh_vertex[v]] += index[v];
  const auto reach = [&](Index v) {
    if (reached[v] || field::length_of(wish[at(v)]) >= no_wish || field::length_of(crosses[at(v)]) >= cancelled) return;
    reached[v] = 1;
    patch.push_back(v);
  };
  for (Index v = 0; v < reached.size(); ++v) {
    patch.clear();
    reach(v);
    std::int32_t turns = 0;
    for (std::size_t next = 0; next < patch.size(); ++next) {
      const Index w = patch[next];
      turns += turns_of[w];
      for (Index i = topology.neighbour_start[at(w)]; i < topology.neighbour_start[at(w) + 1]; ++i)
        reach(topology.neighbour[at(i)]);
    }
    if (std::abs(turns) <= most_turns) continue;
    const Vec3 direction = connection.to_space(v, 1), normal = connection.normal[at(v)];
    for (const Index w : patch) {
      Complex z = unit_of(connection.to_frame(w, field::carry(direction, normal, connection.normal[at(w)])), 1);
      z *= z;
      hard.push_back({w, z * z});
    }
  }
  return hard.size() > before;
}

}  // namespace hf_inner::quads

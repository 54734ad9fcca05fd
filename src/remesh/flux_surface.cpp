#include "remesh/flux_surface.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/progress.h"

namespace hf_inner::remesh {
namespace {

constexpr std::int32_t none = -1;
// Divides by squares of lengths of points at one place.
constexpr double least_square = 1e-300;
// Triangles at one edge that are compared with each other; the rest get borders. It bounds the time, which grows with
// the cube of their number: 51,200 triangles, 64 at every edge, take 0.06 s more than 32 at every edge.
constexpr std::int32_t most_parted = 64;
// Where more than this share of the edges between triangles has three or more of them, there is no surface to make
// quads of. Four of 76 shared models have such edges, 0.8 % of them at most; 160,000 triangles at random have 10 %.
constexpr double most_parted_share = 0.05;

std::uint32_t given(const mesh::Mesh& mesh, std::int32_t v) {
  return static_cast<std::uint32_t>(mesh.given_of_inner[static_cast<std::size_t>(v)]);
}

// Finds the two half-edges of every edge, or one at a border. Edges are compared by their vertices in the Mesh. Three
// triangles and more at an edge are parted: those that agree in orientation and lie flattest are joined first, one that
// is left over gets a border.
struct Pairs {
  Pairs(const mesh::Mesh& mesh, Memory& memory) : twin(3 * mesh.triangle_count(), none, memory) {
    struct Side {
      std::int32_t a, b, half;
    };
    Vector<Side> sides(&memory);
    sides.reserve(static_cast<std::size_t>(twin.size()));
    for (std::int32_t h = 0; h < twin.size(); ++h) {
      const std::int32_t a = mesh.corners[static_cast<std::size_t>(h)],
                         b = mesh.corners[static_cast<std::size_t>(FluxSurface::next(h))];
      sides.push_back({std::min(a, b), std::max(a, b), h});
    }
    std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
      return x.a != y.a ? x.a < y.a : x.b != y.b ? x.b < y.b : x.half < y.half;
    });
    std::size_t edges = 0, parted = 0;
    std::int32_t first_parted = none;
    for (std::size_t i = 0; i < sides.size();) {
      std::size_t j = i;
      while (j < sides.size() && sides[j].a == sides[i].a && sides[j].b == sides[i].b) ++j;
      if (j - i == 2) join(sides[i].half, sides[i + 1].half);
      if (j - i > 2) {
        if (++parted == 1) first_parted = sides[i].a;
        Table<std::int32_t> halves(memory);
        for (std::size_t k = i; k < j; ++k) halves.push_back(sides[k].half);
        part(mesh, halves, memory);
      }
      edges += j - i > 1;
      i = j;
    }
    if (static_cast<double>(parted) > most_parted_share * static_cast<double>(edges))
      fail(HF_ERROR_UNSUPPORTED, given(mesh, first_parted),
           "%zu of %zu edges between triangles join three or more, the first at vertex %u: this is no surface", parted,
           edges, given(mesh, first_parted));
  }
  Table<std::int32_t> twin;

 private:
  void join(std::int32_t g, std::int32_t h) {
    twin[g] = h;
    twin[h] = g;
  }

  void part(const mesh::Mesh& mesh, const Table<std::int32_t>& halves, Memory& memory) {
    // The direction in which each triangle leaves the edge, and which way it runs along it.
    const auto vertex = [&](std::int32_t h) { return mesh.corners[static_cast<std::size_t>(h)]; };
    const auto place = [&](std::int32_t v) { return mesh.positions[static_cast<std::size_t>(v)]; };
    Table<Vec3> away(memory);
    for (const std::int32_t h : halves) {
      const Vec3 a = place(vertex(h)), edge = place(vertex(FluxSurface::next(h))) - a,
                 side = place(vertex(FluxSurface::previous(h))) - a;
      const Vec3 across = side - (dot(side, edge) / std::max(dot(edge, edge), least_square)) * edge;
      away.push_back((1 / std::sqrt(std::max(dot(across, across), least_square))) * across);
    }
    const std::int32_t count = std::min(halves.size(), most_parted);
    while (true) {
      std::int32_t first = none, second = none;
      double least = HUGE_VAL;  // the cosine between the two: -1 if they are flat; 4 more if they disagree
      for (std::int32_t i = 0; i < count; ++i) {
        for (std::int32_t j = i + 1; j < count; ++j) {
          if (twin[halves[i]] != none || twin[halves[j]] != none) continue;
          const double bend = dot(away[i], away[j]) + (vertex(halves[i]) == vertex(halves[j]) ? 4 : 0);
          if (bend < least) {
            least = bend;
            first = i;
            second = j;
          }
        }
      }
      if (first == none) return;
      join(halves[first], halves[second]);
    }
  }
};

// Finds which triangles must be turned over, so that all triangles of a component agree with its first one. Where they
// cannot, as once around a Moebius band, the edge is parted: it gets a border on both sides. Neighbours that agree as
// they are go first, so an edge is parted where two disagree.
Table<std::uint8_t> orient(const mesh::Mesh& mesh, Pairs& pairs, Memory& memory) {
  constexpr std::uint8_t unseen = 2;  // a third value, beside the answers 0 and 1
  Table<std::uint8_t> turned(mesh.triangle_count(), unseen, memory);
  Table<std::int32_t> agreeing(memory), others(memory);  // half-edges to cross
  // If both half-edges start at one vertex, the two triangles are oriented against each other.
  const auto disagree = [&](std::int32_t h) {
    return mesh.corners[static_cast<std::size_t>(h)] == mesh.corners[static_cast<std::size_t>(pairs.twin[h])];
  };
  const auto see = [&](std::int32_t t, std::uint8_t is_turned) {
    turned[t] = is_turned;
    for (std::int32_t h = 3 * t; h < 3 * t + 3; ++h) {
      if (pairs.twin[h] != none) (disagree(h) ? others : agreeing).push_back(h);
    }
  };
  std::int32_t edges = 0, parted = 0, first_parted = none;
  for (std::int32_t start = 0; start < mesh.triangle_count(); ++start) {
    if (turned[start] != unseen) continue;
    see(start, 0);
    while (!agreeing.empty() || !others.empty()) {
      Table<std::int32_t>& list = agreeing.empty() ? others : agreeing;
      const std::int32_t h = list.back(), other = pairs.twin[h];
      list.pop_back();
      if (other == none) continue;  // parted since
      const std::uint8_t wanted = static_cast<std::uint8_t>(turned[h / 3] ^ (disagree(h) ? 1 : 0));
      edges += h < other;
      if (turned[other / 3] == unseen) {
        see(other / 3, wanted);
      } else if (turned[other / 3] != wanted) {
        if (++parted == 1) first_parted = mesh.corners[static_cast<std::size_t>(h)];
        pairs.twin[h] = pairs.twin[other] = none;
      }
    }
  }
  if (parted > most_parted_share * edges)
    fail(HF_ERROR_UNSUPPORTED, given(mesh, first_parted),
         "the surface at vertex %u cannot be oriented; %d of %d edges would be parted", given(mesh, first_parted),
         parted, edges);
  return turned;
}

}  // namespace

FluxSurface FluxSurface::make(const mesh::Mesh& mesh, const mesh::Topology& topology, Memory& memory) {
  FluxSurface s(memory);
  Pairs pairs(mesh, memory);
  const Table<std::uint8_t> turned = orient(mesh, pairs, memory);
  s.real_triangles = mesh.triangle_count();
  const std::int32_t real_halves = 3 * s.real_triangles;

  // Puts the corners in their new order. A turned triangle (a, b, c) becomes (a, c, b), and its side k becomes side 2 -
  // k.
  s.tail.assign(real_halves, none);
  s.twin.assign(real_halves, none);
  Table<std::int32_t> corner(real_halves, none, memory);
  auto moved = [&](std::int32_t h) { return turned[h / 3] ? 3 * (h / 3) + 2 - h % 3 : h; };
  for (std::int32_t t = 0; t < s.real_triangles; ++t) {
    const std::int32_t* c = mesh.triangle(t);
    corner[3 * t] = c[0];
    corner[3 * t + 1] = c[turned[t] ? 2 : 1];
    corner[3 * t + 2] = c[turned[t] ? 1 : 2];
    for (std::int32_t h = 3 * t; h < 3 * t + 3; ++h)
      if (pairs.twin[h] != none) s.twin[moved(h)] = moved(pairs.twin[h]);
  }

  poll();
  // Makes one vertex per fan: the triangle corners that are reached by turning about the vertex.
  for (std::int32_t h = 0; h < real_halves; ++h) {
    if (s.tail[h] != none) continue;
    std::int32_t first = h;  // goes back to the right end of the fan, or once around
    while (s.twin[first] != none) {
      first = next(s.twin[first]);
      if (first == h) break;
    }
    const std::int32_t v = s.out.push_back(first);
    s.mesh_vertex.push_back(corner[h]);
    s.position.push_back(mesh.positions[static_cast<std::size_t>(corner[h])]);
    for (std::int32_t g = first;;) {
      s.tail[g] = v;
      g = s.twin[previous(g)];
      if (g == none || g == first) break;
    }
  }
  s.first_apex = s.out.size();

  poll();
  // Computes the edge weights.
  const Vector<double> weights = mesh::edge_weights(mesh, topology, mesh::OperatorKind::clamped, memory);
  s.weight.assign(real_halves, 0);
  for (std::int32_t h = 0; h < real_halves; ++h) {
    const std::int32_t a = std::min(corner[h], corner[next(h)]), b = std::max(corner[h], corner[next(h)]);
    const auto begin = topology.neighbour.begin() + topology.neighbour_start[static_cast<std::size_t>(a)],
               end = topology.neighbour.begin() + topology.neighbour_start[static_cast<std::size_t>(a) + 1];
    const auto found = std::lower_bound(begin, end, b) - topology.neighbour.begin();
    s.weight[h] = weights[static_cast<std::size_t>(topology.neighbour_edge[static_cast<std::size_t>(found)])];
  }

  // Closes every border by a fan of triangles from an additional vertex, the apex. The border half-edge a -> b gets the
  // triangle (b, a, apex).
  std::int32_t edges = 0, border_edges = 0;
  for (std::int32_t h = 0; h < real_halves; ++h) {
    edges += s.twin[h] == none ? 2 : 1;
    border_edges += s.twin[h] == none;
  }
  s.euler_characteristic = s.first_apex - edges / 2 + s.real_triangles;
  for (std::int32_t start = 0; start < real_halves; ++start) {
    if (s.twin[start] != none) continue;
    const std::int32_t apex = s.out.push_back(none);
    s.mesh_vertex.push_back(none);
    Vec3 middle_point;
    double count = 0;
    std::int32_t last = none, first = none;
    for (std::int32_t h = start;;) {
      const std::int32_t a = s.tail[h], b = s.head(h), fresh = s.tail.size();
      s.tail.push_back(b);
      s.tail.push_back(a);
      s.tail.push_back(apex);
      s.twin.push_back(h);
      s.twin.push_back(none);
      s.twin.push_back(none);
      s.weight.push_back(s.weight[h]);
      s.weight.push_back(0);
      s.weight.push_back(0);
      s.twin[h] = fresh;
      // The edge a -> apex of this triangle is the edge apex -> b of the triangle before it on the border.
      if (last != none) {
        s.twin[last + 2] = fresh + 1;
        s.twin[fresh + 1] = last + 2;
      }
      if (first == none) first = fresh;
      last = fresh;
      middle_point = middle_point + s.position[a];
      count += 1;
      // The next border half-edge leaves b. It is found by turning about b through its fan.
      std::int32_t g = next(h);
      while (s.twin[g] != none && s.twin[g] < real_halves) g = next(s.twin[g]);
      if (g == start || s.twin[g] != none) break;
      h = g;
    }
    s.twin[last + 2] = first + 1;
    s.twin[first + 1] = last + 2;
    s.out[apex] = last + 2;
    s.position.push_back((1.0 / count) * middle_point);
  }

  // Finds the components.
  s.component.assign(s.vertex_count(), none);
  Table<std::int32_t> stack(memory);
  for (std::int32_t v = 0; v < s.vertex_count(); ++v) {
    if (s.component[v] != none) continue;
    const std::int32_t c = s.component_count++;
    s.component[v] = c;
    stack.push_back(v);
    while (!stack.empty()) {
      const std::int32_t w = stack.back();
      stack.pop_back();
      const std::int32_t begin = s.out[w];
      for (std::int32_t g = begin;;) {
        const std::int32_t other = s.head(g);
        if (s.component[other] == none) {
          s.component[other] = c;
          stack.push_back(other);
        }
        g = s.turn_left(g);
        if (g == begin) break;
      }
    }
  }
  return s;
}

}  // namespace hf_inner::remesh

#include "quads/quad_complex.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/progress.h"
#include "quads/numbers.h"
#include "remesh/relax.h"

namespace hf_inner::quads {
namespace {

// Quads of a component with less than this share of its area have lost most of it: a rod that is thinner than the lines
// are apart becomes two quads. A model of 21 parts at 3,000 quads has 1.07 % of the box as its largest distance.
// Without this it is 2.2 %, with 0.4 to 0.7 at most 1.1 %. With 0.8 it takes twice as long.
constexpr double least_area = 0.6;

}  // namespace

void QuadComplex::split_fans(Memory& memory) {
  remesh::QuadMesh old = std::move(vertices);
  vertices = remesh::QuadMesh(memory);
  remesh::Table<std::int32_t> fresh(tail.size(), none, memory);
  for (std::int32_t start = 0; start < tail.size(); ++start) {
    if (fresh[start] != none) continue;
    const std::int32_t v = tail[start];
    // The fan starts at its border, if it has one.
    std::int32_t first = start;
    bool border = false;
    while (true) {
      const std::int32_t g = twin[first];
      if (g == none) {
        border = true;
        break;
      }
      first = next(g);
      if (first == start) break;
    }
    const std::int32_t number =
        vertices.add_vertex(old.location[v], old.position[v], old.pinned[v], border, old.scale[v]);
    for (std::int32_t h = first; h != none;) {
      fresh[h] = number;
      h = twin[previous(h)];
      if (h == first) break;
    }
  }
  tail = std::move(fresh);
}

void QuadComplex::remove(const remesh::Table<std::uint8_t>& dead, Memory& memory) {
  remesh::Table<std::int32_t> place(quad_count(), none, memory);
  std::int32_t count = 0;
  for (std::int32_t f = 0; f < quad_count(); ++f) {
    if (!dead[f]) place[f] = count++;
  }
  for (std::int32_t f = 0; f < quad_count(); ++f) {
    if (dead[f]) continue;
    for (std::int32_t k = 0; k < 4; ++k) {
      const std::int32_t from = 4 * f + k, to = 4 * place[f] + k, g = twin[from];
      tail[to] = tail[from];
      feature[to] = feature[from];
      twin[to] = g == none ? none : 4 * place[g / 4] + g % 4;
    }
  }
  tail.resize(4 * count, 0);
  feature.resize(4 * count, 0);
  twin.resize(4 * count, none);
}

void QuadComplex::append(const QuadComplex& other, const remesh::Table<std::uint8_t>& take, Memory& memory) {
  remesh::Table<std::int32_t> place(other.quad_count(), none, memory),
      vertex(other.vertices.position.size(), none, memory);
  std::int32_t count = quad_count();
  for (std::int32_t f = 0; f < other.quad_count(); ++f) {
    if (take[f]) place[f] = count++;
  }
  const remesh::QuadMesh& from = other.vertices;
  for (std::int32_t h = 0; h < other.tail.size(); ++h) {
    if (place[h / 4] == none) continue;
    const std::int32_t v = other.tail[h], g = other.twin[h];
    if (vertex[v] == none)
      vertex[v] =
          vertices.add_vertex(from.location[v], from.position[v], from.pinned[v], from.border[v] != 0, from.scale[v]);
    tail.push_back(vertex[v]);
    feature.push_back(other.feature[h]);
    twin.push_back(g == none ? none : 4 * place[g / 4] + g % 4);
  }
}

remesh::QuadMesh QuadComplex::mesh(Memory& memory) const {
  remesh::QuadMesh out(memory);
  remesh::Table<std::int32_t> fresh(vertices.position.size(), none, memory);
  for (std::int32_t h = 0; h < tail.size(); ++h) {
    const std::int32_t v = tail[h];
    if (fresh[v] == none)
      fresh[v] = out.add_vertex(vertices.location[v], vertices.position[v], vertices.pinned[v], vertices.border[v] != 0,
                                vertices.scale[v]);
    out.corner.push_back(fresh[v]);
  }
  return out;
}

double QuadComplex::area(std::int32_t f) const noexcept {
  const auto p = [&](std::int32_t k) { return vertices.position[tail[4 * f + k]]; };
  return 0.5 * (norm(cross(p(1) - p(0), p(2) - p(0))) + norm(cross(p(2) - p(0), p(3) - p(0))));
}

remesh::Table<std::int32_t> components_of(const remesh::FluxSurface& surface, const QuadComplex& quads,
                                          Memory& memory) {
  remesh::Table<std::int32_t> out(quads.quad_count(), 0, memory);
  for (std::int32_t f = 0; f < out.size(); ++f)
    out[f] = surface.component[surface.tail[3 * quads.vertices.location[quads.tail[4 * f]].triangle]];
  return out;
}

Vector<QuadEdge> edges_of(const QuadComplex& quads, Memory& memory) {
  Vector<QuadEdge> out(&memory);
  for (std::int32_t h = 0; h < quads.twin.size(); ++h) {
    if (quads.twin[h] != none && quads.twin[h] < h) continue;
    const std::int32_t a = quads.tail[h], b = quads.head(h);
    out.push_back({std::min(a, b), std::max(a, b), h});
  }
  std::sort(out.begin(), out.end(), [](const QuadEdge& x, const QuadEdge& y) {
    return x.a != y.a ? x.a < y.a : x.b != y.b ? x.b < y.b : x.half < y.half;
  });
  return out;
}

remesh::Table<std::uint8_t> find_sound(const remesh::FluxSurface& surface, const QuadComplex& quads,
                                       const remesh::Table<std::int32_t>& component, const remesh::Table<double>& areas,
                                       Memory& memory) {
  // By component: the Euler characteristic of the surface less the characteristic of the quads, and the pieces of the
  // quads.
  remesh::Table<std::int32_t> euler(surface.component_count, 0, memory), pieces(surface.component_count, 0, memory);
  for (std::int32_t v = 0; v < surface.first_apex; ++v) ++euler[surface.component[v]];
  for (std::int32_t h = 0; h < 3 * surface.real_triangles; ++h) {
    std::int32_t& e = euler[surface.component[surface.tail[h]]];
    e += h % 3 == 0;
    e -= !surface.is_real(surface.twin[h]) || h < surface.twin[h];
  }
  remesh::Table<double> area(areas.size(), 0.0, memory);  // of the quads, by component
  for (std::int32_t f = 0; f < quads.quad_count(); ++f) area[component[f]] += quads.area(f);
  remesh::Table<std::uint8_t> seen(quads.vertices.position.size(), 0, memory);
  remesh::Table<std::uint8_t> reached(quads.quad_count(), 0, memory);
  remesh::Table<std::int32_t> stack(memory);
  for (std::int32_t start = 0; start < quads.quad_count(); ++start) {
    if (reached[start]) continue;
    ++pieces[component[start]];
    reached[start] = 1;
    stack.push_back(start);
    while (!stack.empty()) {
      const std::int32_t f = stack.back();
      stack.pop_back();
      --euler[component[f]];
      for (std::int32_t h = 4 * f; h < 4 * f + 4; ++h) {
        const std::int32_t g = quads.twin[h];
        euler[component[f]] += g == none || h < g;
        if (!seen[quads.tail[h]]) {
          seen[quads.tail[h]] = 1;
          --euler[component[f]];
        }
        if (g != none && !reached[g / 4]) {
          reached[g / 4] = 1;
          stack.push_back(g / 4);
        }
      }
    }
  }
  remesh::Table<std::uint8_t> out(surface.component_count, 0, memory);
  for (std::int32_t c = 0; c < out.size(); ++c)
    out[c] = euler[c] == 0 && pieces[c] == 1 && area[c] >= least_area * areas[c];
  const Vector<QuadEdge> edges = edges_of(quads, memory);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (edges[i].a == edges[i].b || (i > 0 && same(edges[i - 1], edges[i]))) out[component[edges[i].half / 4]] = 0;
  }
  for (std::int32_t f = 0; f < quads.quad_count(); ++f) {
    const std::int32_t* v = &quads.tail[4 * f];
    if (v[0] == v[2] || v[1] == v[3]) out[component[f]] = 0;
  }
  return out;
}

QuadComplex split_triangles(const remesh::FluxSurface& surface, const remesh::Table<std::uint8_t>& features,
                            const remesh::Table<std::uint8_t>& take, Memory& memory) {
  QuadComplex out(memory);
  remesh::Table<std::int32_t> place(surface.real_triangles, none, memory);
  std::int32_t count = 0;
  for (std::int32_t t = 0; t < surface.real_triangles; ++t) {
    if (take[surface.component[surface.tail[3 * t]]]) place[t] = count++;
  }
  out.twin.assign(12 * count, none);
  out.feature.assign(12 * count, 0);
  out.tail.reserve(12 * count);
  // Triangles share the points of their corners and sides. Fans that only touch are parted at the end.
  remesh::Table<std::int32_t> at_corner(surface.vertex_count(), none, memory),
      at_side(3 * surface.real_triangles, none, memory);
  remesh::Table<std::uint8_t> held(surface.vertex_count(), 0, memory);
  for (std::int32_t h = 0; h < 3 * surface.real_triangles; ++h) {
    if (features[h]) held[surface.tail[h]] = held[surface.tail[remesh::FluxSurface::next(h)]] = 1;
  }
  for (std::int32_t t = 0; t < surface.real_triangles; ++t) {
    if (place[t] == none) continue;
    std::int32_t centre = none;
    for (std::int32_t k = 0; k < 3; ++k) {
      const std::int32_t h = 3 * t + k, before = (k + 2) % 3, q = 3 * place[t] + k, g = surface.twin[h];
      const auto add = [&](std::int32_t& vertex, double at_k, double at_next, double at_last, bool on_feature) {
        if (vertex == none) {
          remesh::SurfacePoint point;
          point.triangle = t;
          point.weight[k] = at_k;
          point.weight[(k + 1) % 3] = at_next;
          point.weight[before] = at_last;
          vertex = out.vertices.add_vertex(point, remesh::position_of(surface, point),
                                           on_feature ? remesh::QuadMesh::feature : remesh::QuadMesh::free, false, 1);
        }
        out.tail.push_back(vertex);
      };
      const auto side = [&](std::int32_t half) -> std::int32_t& {
        const std::int32_t other = surface.twin[half];
        return at_side[surface.is_real(other) ? std::min(half, other) : half];
      };
      // The corner k, the middle of side k, the middle of the triangle, the middle of the side before.
      add(at_corner[surface.tail[h]], 1, 0, 0, held[surface.tail[h]] != 0);
      add(side(h), 0.5, 0.5, 0, features[h] != 0);
      add(centre, 1.0 / 3, 1.0 / 3, 1.0 / 3, false);
      add(side(3 * t + before), 0.5, 0, 0.5, features[3 * t + before] != 0);
      out.feature[4 * q] = features[h];
      out.feature[4 * q + 3] = features[3 * t + before];
      out.join(4 * q + 1, 4 * (3 * place[t] + (k + 1) % 3) + 2);
      if (surface.is_real(g)) out.join(4 * q, 4 * (3 * place[g / 3] + (g % 3 + 1) % 3) + 3);
    }
  }
  out.split_fans(memory);
  return out;
}

}  // namespace hf_inner::quads

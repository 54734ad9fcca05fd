#include "quads/face_cross.h"

#include <cmath>

#include "base/progress.h"
#include "quads/numbers.h"

namespace hf_inner::quads {
namespace {

// Feature edges of one triangle whose directions sum to less than this, as crosses, say nothing about it. At 0.25, 3 of
// 15 runs change, by 1 % on average. At 1 a single edge counts or not by rounding: there are 5 % more irregular
// vertices, and 60 corners turned over instead of 44.
constexpr double least_agreement = 0.5;

// The whole number nearest to a measured index that fits the turns around the vertex: index + turns is a multiple of 4.
// Angles of triangles without area are noise, and the nearest whole number would not fit the seams.
std::int32_t nearest_index(double measured, int turns) noexcept {
  return 4 * static_cast<std::int32_t>(std::lround((measured + turns) / 4)) - turns;
}

}  // namespace

remesh::Table<std::uint8_t> find_features(const remesh::FluxSurface& surface, double crease, Memory& memory) {
  remesh::Table<std::uint8_t> out(surface.half_count(), 0, memory);
  remesh::Table<Vec3> normal(surface.real_triangles, Vec3{}, memory);
  for (std::int32_t t = 0; t < surface.real_triangles; ++t) {
    const Vec3 a = surface.position[surface.tail[3 * t]];
    normal[t] = cross(surface.position[surface.tail[3 * t + 1]] - a, surface.position[surface.tail[3 * t + 2]] - a);
  }
  for (std::int32_t h = 0; h < 3 * surface.real_triangles; ++h) {
    const std::int32_t g = surface.twin[h];
    if (!surface.is_real(g)) {
      out[h] = 1;
    } else if (h < g && crease < half_turn) {
      const Vec3 p = normal[h / 3], q = normal[g / 3];
      out[h] = out[g] = arc_tangent(norm(cross(p, q)), dot(p, q)) > crease;
    }
  }
  return out;
}

void keep_edges(const remesh::FluxSurface& surface, const mesh::Topology& topology, Span<const std::int32_t> edges,
                remesh::Table<std::uint8_t>& features, Memory& memory) {
  if (edges.empty()) return;
  remesh::Table<std::uint8_t> kept(topology.edge_count(), 0, memory);
  for (const std::int32_t e : edges) kept[e] = 1;
  for (std::int32_t h = 0; h < 3 * surface.real_triangles; ++h) {
    features[h] |=
        kept[topology.edge_between(surface.mesh_vertex[surface.tail[h]], surface.mesh_vertex[surface.head(h)])];
  }
}

FaceCross FaceCross::make(const remesh::FluxSurface& surface, const field::Connection& connection,
                          Span<const Complex> crosses, const remesh::Table<std::uint8_t>& features,
                          const SharpCorners& corners, const remesh::Table<Complex>& of_corner, Memory& memory) {
  FaceCross out(memory);
  const std::int32_t triangles = surface.real_triangles, halves = surface.half_count();
  out.edge.assign(halves, Complex(0, 0));
  out.direction.assign(triangles, Complex(1, 0));
  out.turn.assign(halves, 0);
  out.index.assign(surface.vertex_count(), 0);
  Poller poller;
  for (std::int32_t t = 0; t < triangles; ++t) {
    poller.due();
    Vec3 p[3];
    for (int k = 0; k < 3; ++k) p[k] = surface.position[surface.tail[3 * t + k]];
    const Vec3 x = unit_vector(p[1] - p[0]), normal = unit_vector(cross(p[1] - p[0], p[2] - p[0])),
               y = cross(normal, x);
    Complex sum = 0;
    for (int k = 0; k < 3; ++k) {
      const Vec3 side = p[(k + 1) % 3] - p[k];
      out.edge[3 * t + k] = Complex(dot(side, x), dot(side, y));
      const std::int32_t v = surface.mesh_vertex[surface.tail[3 * t + k]];
      const std::size_t i = static_cast<std::size_t>(v);
      const Complex own = of_corner.empty() || of_corner[3 * t + k] == 0.0 ? crosses[i] : of_corner[3 * t + k];
      const double size = field::length_of(own);
      if (!(size > 0)) continue;
      const Vec3 space = connection.to_space(v, field::at_angle(1.0, field::angle_of(own) / 4));
      // A triangle may be turned over against the mesh.
      const Vec3 facing = dot(connection.normal[i], normal) < 0 ? -1.0 * normal : normal;
      const Vec3 carried = field::carry(space, connection.normal[i], facing);
      Complex d = unit_of(Complex(dot(carried, x), dot(carried, y)), 1);
      d *= d;
      d *= d;
      sum += size * d;
    }
    Complex along = 0;
    const auto add_along = [&](std::int32_t h, double turn) {
      Complex d = unit_of(out.edge[h], 1) * field::at_angle(1.0, turn);
      d *= d;
      d *= d;
      along += d;
    };
    for (std::int32_t h = 3 * t; h < 3 * t + 3; ++h) {
      const double turn = corners.empty() ? 0 : corners.turn[h];
      if (features[h] && (surface.is_real(surface.twin[h]) || turn != 0)) add_along(h, turn);
    }
    if (!corners.empty() && along == 0.0 && corners.inside[t].half != none)
      add_along(corners.inside[t].half, corners.inside[t].turn);
    if (field::length_of(along) > least_agreement) sum = along;
    out.direction[t] = field::at_angle(1.0, field::angle_of(sum) / 4);
  }
  remesh::Table<double> rest(halves, 0.0, memory);
  for (std::int32_t h = 0; h < 3 * triangles; ++h) {
    const std::int32_t g = surface.twin[h];
    if (!surface.is_real(g) || g < h) continue;
    const Complex mine = out.direction[h / 3] * std::conj(unit_of(out.edge[h], 1)),
                  other = out.direction[g / 3] * std::conj(unit_of(-out.edge[g], 1));
    const double angle = field::angle_of(mine * std::conj(other)), quarters = std::nearbyint(angle / (half_turn / 2));
    out.turn[h] = static_cast<std::int8_t>(quarters);
    out.turn[g] = static_cast<std::int8_t>(-quarters);
    rest[h] = angle - quarters * (half_turn / 2);
    rest[g] = -rest[h];
  }
  for (std::int32_t v = 0; v < surface.first_apex; ++v) {
    poller.due();
    double sum = 2 * half_turn;
    int turns = 0;
    bool closed = true;
    const std::int32_t begin = surface.out[v];
    for (std::int32_t h = begin;;) {
      closed &= surface.is_real(h);
      if (!closed) break;
      sum += rest[h] - corner_angle(surface, h);
      turns += out.turn[h];
      h = surface.turn_left(h);
      if (h == begin) break;
    }
    if (closed) out.index[v] = nearest_index(sum / (half_turn / 2), turns);
  }
  return out;
}

}  // namespace hf_inner::quads

#include <algorithm>
#include <cmath>

#include "mesh/nearest_triangle.h"
#include "quads/numbers.h"
#include "quads/quad_complex.h"

namespace hf_inner::quads {
namespace {

// The fewest quads must have this share of the area: a box in a ball has 0.64. One quad over the wrist of a hand has
// 0.02, and drew the hand back into it. 0.1 to 0.3 change two of six coarse models of many parts, by 4 % at most.
constexpr double least_share = 0.4;

// If vertices are equally far up to rounding, the first one counts. So a moved ball keeps its box.
constexpr double same_length = 1 + 1e-9;

// A corner whose sine is at most this is no corner: the outline is a triangle. Less leaves quads that are triangles,
// more makes three quads of blunt ones. 0.17 is 10 degrees. Half and double change nothing on b9, which has a dozen.
constexpr double flat_corner = 0.17;
// The other three corners must have this share of the area. Less takes bent outlines for triangles, whose sides the
// three quads do not follow. 0.95 changes nothing on b9, 0.8 makes one more triangle.
constexpr double straight_share = 0.9;

// The vertices and triangles of one component, and a half-edge of its border.
struct Part {
  explicit Part(Memory& memory) : triangles(memory), vertices(memory) {}
  remesh::Table<std::int32_t> triangles, vertices;
  std::int32_t border = none, borders = 0, euler = 0;
};

class Maker {
 public:
  Maker(const remesh::FluxSurface& surface, QuadComplex& out, Memory& memory)
      : s_(surface), out_(out), memory_(memory) {}

  // A box whose corners lie on the surface: along the direction to the farthest vertex, along the direction to the
  // vertex farthest from this line, and across both.
  void box(const Part& part) {
    Vec3 centre{};
    for (const std::int32_t v : part.vertices) centre = centre + 1.0 / part.vertices.size() * s_.position[v];
    Vec3 axis[3];
    for (int k = 0; k < 2; ++k) {
      double most = -1;
      for (const std::int32_t v : part.vertices) {
        Vec3 way = s_.position[v] - centre;
        for (int j = 0; j < k; ++j) way = way - dot(way, axis[j]) * axis[j];
        if (norm(way) > same_length * most) {
          most = norm(way);
          axis[k] = way;
        }
      }
      axis[k] = unit_vector(axis[k]);
    }
    axis[2] = cross(axis[0], axis[1]);
    double size[3] = {0, 0, 0};
    for (const std::int32_t v : part.vertices) {
      for (int k = 0; k < 3; ++k) size[k] = std::max(size[k], std::fabs(dot(s_.position[v] - centre, axis[k])));
    }
    std::int32_t corner[8];
    for (int i = 0; i < 8; ++i) {
      Vec3 p = centre;
      for (int k = 0; k < 3; ++k) p = p + (i >> k & 1 ? 1.0 : -1.0) * corner_share * size[k] * axis[k];
      corner[i] = add_vertex(nearest(part, p), false);
    }
    // Bit k of a corner's number is its side along axis k. The axes are right-handed, so the sides are seen from
    // outside counter-clockwise; a component that faces inwards gets them turned.
    static constexpr int sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                        {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    double volume = 0;
    for (const std::int32_t t : part.triangles) {
      const auto p = [&](std::int32_t k) { return s_.position[s_.tail[3 * t + k]] - centre; };
      volume += dot(p(0), cross(p(1), p(2)));
    }
    const std::int32_t first = out_.tail.size();
    for (const auto& side : sides) {
      for (int k = 0; k < 4; ++k) add_half(corner[side[volume < 0 ? 3 - k : k]], false);
    }
    for (std::int32_t h = first; h < out_.tail.size(); ++h) {
      for (std::int32_t g = first; g < h; ++g) {
        if (out_.tail[g] == out_.head(h) && out_.tail[h] == out_.head(g)) out_.join(h, g);
      }
    }
  }

  // One quad with its corners on the border. The first is farthest from the middle, the third is farthest from the
  // first. The others are farthest from the line between both, one on either side.
  void disc(const Part& part) {
    remesh::Table<std::int32_t> loop(memory_);  // half-edges of the border
    for (std::int32_t h = part.border; loop.empty() || h != part.border;) {
      loop.push_back(h);
      h = remesh::FluxSurface::next(h);
      while (s_.is_real(s_.twin[h])) h = remesh::FluxSurface::next(s_.twin[h]);
    }
    const std::int32_t count = loop.size();
    const auto position = [&](std::int32_t i) { return s_.position[s_.tail[loop[i % count]]]; };
    Vec3 centre{};
    for (std::int32_t i = 0; i < count; ++i) centre = centre + 1.0 / count * position(i);
    std::int32_t from = 0, to = 0;
    for (std::int32_t i = 1; i < count; ++i) {
      if (norm(position(i) - centre) > norm(position(from) - centre)) from = i;
    }
    for (std::int32_t i = 0; i < count; ++i) {
      if (norm(position(i) - position(from)) > norm(position(to) - position(from))) to = i;
    }
    const Vec3 line = unit_vector(position(to) - position(from));
    const auto farthest = [&](std::int32_t begin, std::int32_t end) {  // between two places of the loop
      remesh::SurfacePoint best = at_tail(loop[begin % count], 0.5);
      double most = -1;
      for (std::int32_t i = begin + 1; i < end; ++i) {
        const Vec3 way = position(i) - position(from);
        const double away = norm(way - dot(way, line) * line);
        if (away > most) {
          most = away;
          best = at_tail(loop[i % count], 0);
        }
      }
      return best;
    };
    if (to < from) to += count;
    const remesh::SurfacePoint corner[4] = {at_tail(loop[from], 0), farthest(from, to), at_tail(loop[to % count], 0),
                                            farthest(to, from + count)};
    Vec3 p[4];
    for (int k = 0; k < 4; ++k) p[k] = remesh::position_of(s_, corner[k]);
    const Vec3 normal = cross(p[2] - p[0], p[3] - p[1]);
    for (int k = 0; k < 4; ++k) {
      const Vec3 x = p[(k + 1) % 4] - p[k], y = p[(k + 3) % 4] - p[k];
      const bool flat = dot(cross(x, y), normal) <= flat_corner * norm(normal) * norm(x) * norm(y);
      if (flat && 0.5 * norm(cross(p[(k + 2) % 4] - p[(k + 1) % 4], p[(k + 3) % 4] - p[(k + 1) % 4])) >
                      straight_share * area_of(part))
        return triangle(part, loop, corner, k);
    }
    for (const remesh::SurfacePoint& point : corner) add_half(add_vertex(point, true), true);
  }

 private:
  // Three quads around a point in the middle. The outline has three corners; corner `flat` of the four is none.
  void triangle(const Part& part, const remesh::Table<std::int32_t>& loop, const remesh::SurfacePoint (&corner)[4],
                int flat) {
    std::int32_t tip[3], side[3];  // side k is between tips k and k + 1
    Vec3 middle{};
    for (int k = 0; k < 3; ++k) {
      const remesh::SurfacePoint& point = corner[(flat + 1 + k) % 4];
      tip[k] = add_vertex(point, true);
      middle = middle + (1.0 / 3) * remesh::position_of(s_, point);
    }
    for (int k = 0; k < 3; ++k) {
      side[k] = add_vertex(halfway(loop, corner[(flat + 1 + k) % 4], corner[(flat + 1 + (k + 1) % 3) % 4]), true);
    }
    const std::int32_t centre = add_vertex(nearest(part, middle), false), first = out_.tail.size();
    for (int k = 0; k < 3; ++k) {
      add_half(tip[k], true);
      add_half(side[k], false);
      add_half(centre, false);
      add_half(side[(k + 2) % 3], true);
    }
    for (int k = 0; k < 3; ++k) out_.join(first + 4 * k + 1, first + 4 * ((k + 1) % 3) + 2);
  }
  // The point of the border loop halfway from one point to another one.
  remesh::SurfacePoint halfway(const remesh::Table<std::int32_t>& loop, const remesh::SurfacePoint& from,
                               const remesh::SurfacePoint& to) const {
    const Vec3 p = remesh::position_of(s_, from), q = remesh::position_of(s_, to);
    const Vec3 middle = 0.5 * (p + q), way = q - p;
    remesh::SurfacePoint best;
    double least = HUGE_VAL;
    for (const std::int32_t h : loop) {
      // Where the plane halfway between the two cuts the edge.
      const double a = dot(s_.position[s_.tail[h]] - middle, way), b = dot(s_.position[s_.head(h)] - middle, way);
      if ((a < 0) == (b < 0)) continue;
      const remesh::SurfacePoint place = at_tail(h, a / (a - b));
      const double away = norm(remesh::position_of(s_, place) - middle);
      if (away < least) {
        least = away;
        best = place;
      }
    }
    return best;
  }
  static constexpr double corner_share = 0.6;  // 1 / sqrt(3) on a sphere
  static remesh::SurfacePoint at_tail(std::int32_t h, double share) {
    remesh::SurfacePoint point;
    point.triangle = h / 3;
    point.weight[h % 3] = 1 - share;
    point.weight[(h % 3 + 1) % 3] = share;
    return point;
  }
  double area_of(const Part& part) const {
    double area = 0;
    for (const std::int32_t t : part.triangles) {
      const Vec3 p = s_.position[s_.tail[3 * t]];
      area += 0.5 * norm(cross(s_.position[s_.tail[3 * t + 1]] - p, s_.position[s_.tail[3 * t + 2]] - p));
    }
    return area;
  }
  remesh::SurfacePoint nearest(const Part& part, Vec3 p) const {
    remesh::SurfacePoint point;
    double best = HUGE_VAL, weight[3];
    for (const std::int32_t t : part.triangles) {
      const auto corner = [&](std::int32_t k) { return s_.position[s_.tail[3 * t + k]]; };
      const double squared = mesh::squared_to_triangle(p, corner(0), corner(1), corner(2), weight);
      if (squared < best) {
        best = squared;
        point.triangle = t;
        std::copy(weight, weight + 3, point.weight);
      }
    }
    return point;
  }
  std::int32_t add_vertex(const remesh::SurfacePoint& point, bool border) {
    return out_.vertices.add_vertex(point, remesh::position_of(s_, point),
                                    border ? remesh::QuadMesh::feature : remesh::QuadMesh::free, border, 1);
  }
  void add_half(std::int32_t v, bool border) {
    out_.tail.push_back(v);
    out_.twin.push_back(none);
    out_.feature.push_back(border);
  }

  const remesh::FluxSurface& s_;
  QuadComplex& out_;
  Memory& memory_;
};

}  // namespace

QuadComplex least_quads(const remesh::FluxSurface& surface, const remesh::Table<double>& areas,
                        remesh::Table<std::uint8_t>& take, Memory& memory) {
  QuadComplex out(memory);
  if (std::find(take.begin(), take.end(), 1) == take.end()) return out;
  Vector<Part> parts(&memory);
  parts.reserve(static_cast<std::size_t>(take.size()));
  for (std::int32_t c = 0; c < take.size(); ++c) parts.emplace_back(memory);
  const auto part_of = [&](std::int32_t v) -> Part& { return parts[static_cast<std::size_t>(surface.component[v])]; };
  for (std::int32_t v = 0; v < surface.first_apex; ++v) {
    if (take[surface.component[v]]) part_of(v).vertices.push_back(v);
  }
  for (std::int32_t v = surface.first_apex; v < surface.vertex_count(); ++v) ++part_of(v).borders;
  for (std::int32_t h = 0; h < 3 * surface.real_triangles; ++h) {
    Part& part = part_of(surface.tail[h]);
    if (!take[surface.component[surface.tail[h]]]) continue;
    const bool border = !surface.is_real(surface.twin[h]);
    part.euler -= border || h < surface.twin[h];
    if (border) part.border = h;
    if (h % 3 == 0) {
      part.triangles.push_back(h / 3);
      ++part.euler;
    }
  }
  Maker maker(surface, out, memory);
  for (std::int32_t c = 0; c < take.size(); ++c) {
    const Part& part = parts[static_cast<std::size_t>(c)];
    const std::int32_t euler = part.euler + part.vertices.size();
    const std::int32_t first = out.tail.size();
    if (take[c] && euler == 2 && part.borders == 0) {
      maker.box(part);
    } else if (take[c] && euler == 1 && part.borders == 1) {
      maker.disc(part);
    }
    double area = 0;
    for (std::int32_t f = first / 4; f < out.quad_count(); ++f) area += out.area(f);
    take[c] = area > least_share * areas[c];
    if (!take[c]) {
      out.tail.resize(first, none);
      out.twin.resize(first, none);
      out.feature.resize(first, 0);
    }
  }
  return out;
}

}  // namespace hf_inner::quads

// Exact distances against closed forms and against all edge sequences of small meshes, and the errors of fronts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/index.h"
#include "base/progress.h"
#include "mesh/exact_path.h"
#include "mesh/front_distance.h"
#include "support/dirty_meshes.h"
#include "support/meshes.h"

namespace {

using hf_inner::at;
using hf_inner::Index;
using hf_test::PlainMesh;

constexpr double infinite = std::numeric_limits<double>::infinity();

// A mesh that keeps the numbers of its vertices, with its tables.
struct Shape {
  explicit Shape(const PlainMesh& plain)
      : mesh(make(plain, memory)),
        topology(hf_inner::mesh::Topology::make(mesh, memory)),
        sides(mesh, topology, memory) {}
  static hf_inner::mesh::Mesh make(const PlainMesh& plain, hf_inner::Memory& memory) {
    hf_inner::mesh::MeshInput input;
    input.vertex_count = plain.vertex_count();
    input.triangle_count = plain.triangle_count();
    input.positions = hf_inner::ConstRows(plain.positions.data(), 3 * sizeof(double));
    input.triangles = hf_inner::IndexRows(plain.triangles.data(), 3);
    input.weld = hf_inner::mesh::Weld::none;
    return hf_inner::mesh::Mesh::make(input, memory);
  }
  // By vertex as given, in the unit of the mesh; infinite for isolated vertices.
  std::vector<double> distance(const std::vector<Index>& given) {
    std::vector<Index> sources;
    for (const Index s : given) sources.push_back(mesh.inner_of_given[at(s)]);
    return by_given(hf_inner::mesh::exact_distance(sides, sources, memory).distance);
  }
  std::vector<double> front(Index source) {
    hf_inner::Vector<double> d(mesh.positions.size(), &memory);
    const Index s = mesh.inner_of_given[at(source)];
    hf_inner::mesh::FrontDistance(mesh, topology, memory).distance(hf_inner::Span<const Index>(&s, 1), d.data());
    return by_given(d);
  }
  std::vector<double> by_given(const hf_inner::Vector<double>& d) const {
    std::vector<double> out(mesh.inner_of_given.size(), infinite);
    for (std::size_t v = 0; v < out.size(); ++v) {
      if (mesh.inner_of_given[v] >= 0) out[v] = mesh.scale * d[at(mesh.inner_of_given[v])];
    }
    return out;
  }
  hf_inner::Memory memory;
  hf_inner::mesh::Mesh mesh;
  hf_inner::mesh::Topology topology;
  hf_inner::mesh::TriangleSides sides;
};

struct Point2 {
  double x, y;
};
double cross2(Point2 a, Point2 b) { return a.x * b.y - a.y * b.x; }

// Shortest paths over all sequences of triangles: every straight segment between two vertices is found by unfolding
// every sequence that visits no triangle twice, then the segments are joined (Floyd 1962). For tiny meshes.
class AllSequences {
 public:
  explicit AllSequences(const PlainMesh& mesh) : mesh_(mesh), used_(mesh.triangle_count(), false) {
    const std::size_t n = mesh.vertex_count();
    direct.assign(n, std::vector<double>(n, infinite));
    for (source_ = 0; source_ < n; ++source_) {
      direct[source_][source_] = 0;
      for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
        for (int k = 0; k < 3; ++k) {
          if (corner(t, k) != source_) continue;
          const std::uint32_t a = corner(t, k + 1), b = corner(t, k + 2);
          const double sa = length(source_, a), sb = length(source_, b), ab = length(a, b);
          offer(a, sa);
          offer(b, sb);
          const double x = (sa * sa + sb * sb - ab * ab) / (2 * sa);
          const Point2 pa{sa, 0}, pb{x, std::sqrt(std::max(0.0, sb * sb - x * x))};
          used_[t] = true;
          beyond(t, a, b, pa, pb, pa, pb);
          used_[t] = false;
        }
      }
    }
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) direct[i][j] = std::min(direct[i][j], direct[i][k] + direct[k][j]);
      }
    }
  }
  std::vector<std::vector<double>> direct;

 private:
  std::uint32_t corner(std::uint32_t t, int k) const {
    return mesh_.triangles[3 * t + static_cast<std::uint32_t>(k % 3)];
  }
  double length(std::uint32_t a, std::uint32_t b) const {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += std::pow(mesh_.positions[3 * a + k] - mesh_.positions[3 * b + k], 2);
    return std::sqrt(sum);
  }
  void offer(std::uint32_t v, double d) { direct[source_][v] = std::min(direct[source_][v], d); }

  // The rays from the origin between `right` and `left` cross the edge from pa to pb out of a triangle.
  void beyond(std::uint32_t from, std::uint32_t a, std::uint32_t b, Point2 pa, Point2 pb, Point2 right, Point2 left) {
    if (!(cross2(right, left) > 1e-14)) return;
    for (std::uint32_t t = 0; t < mesh_.triangle_count(); ++t) {
      if (t == from || used_[t]) continue;
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t c = corner(t, k), u = corner(t, k + 1), v = corner(t, k + 2);
        if (!((u == a && v == b) || (u == b && v == a))) continue;
        const double ab = length(a, b), ac = length(a, c), bc = length(b, c);
        const double x = (ab * ab + ac * ac - bc * bc) / (2 * ab), y = std::sqrt(std::max(0.0, ac * ac - x * x));
        const Point2 e{(pb.x - pa.x) / ab, (pb.y - pa.y) / ab};
        // a lies to the right of the rays and b to the left, so the far side is to the right of the edge a b
        const Point2 pc{pa.x + x * e.x + y * e.y, pa.y + x * e.y - y * e.x};
        if (cross2(right, pc) >= -1e-14 && cross2(pc, left) >= -1e-14) offer(c, std::hypot(pc.x, pc.y));
        used_[t] = true;
        beyond(t, a, c, pa, pc, right, cross2(pc, left) > 0 ? pc : left);
        beyond(t, c, b, pc, pb, cross2(right, pc) > 0 ? pc : right, left);
        used_[t] = false;
      }
    }
  }

  const PlainMesh& mesh_;
  std::vector<bool> used_;
  std::uint32_t source_ = 0;
};

PlainMesh with_random_places(PlainMesh mesh, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  for (double& x : mesh.positions) x = number(random);
  return mesh;
}

void expect_as_all_sequences(const PlainMesh& mesh, const char* name, std::uint32_t seed) {
  const AllSequences oracle(mesh);
  Shape shape(mesh);
  for (std::uint32_t s = 0; s < mesh.vertex_count(); ++s) {
    const auto d = shape.distance({static_cast<Index>(s)});
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
      EXPECT_NEAR(d[v], oracle.direct[s][v], 1e-9) << name << ", seed " << seed << ", from " << s << " to " << v;
  }
}

TEST(ExactDistance, is_the_shortest_over_all_edge_sequences_of_tiny_meshes) {
  PlainMesh octahedron, pages, open = hf_test::grid(2, 2), soup, hourglass, card;
  octahedron.positions.resize(18);
  octahedron.triangles = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1, 5, 2, 1, 5, 3, 2, 5, 4, 3, 5, 1, 4};
  pages.positions.resize(24);  // three pages of two triangles on one spine, one of them turned over
  pages.triangles = {0, 1, 2, 1, 3, 2, 1, 0, 4, 1, 4, 5, 0, 1, 6, 1, 7, 6};
  soup.positions.resize(18);  // every edge of the first triangle has three triangles
  soup.triangles = {0, 1, 2, 0, 1, 3, 0, 1, 4, 1, 2, 3, 1, 2, 5, 2, 0, 4, 2, 0, 5, 3, 4, 5};
  hourglass.positions.resize(21);  // two tetrahedra that share a vertex
  hourglass.triangles = {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2, 0, 4, 5, 0, 5, 6, 0, 6, 4, 4, 6, 5};
  card.positions.resize(18);  // two quads, each twice and cut along its other diagonal the second time
  card.triangles = {0, 1, 3, 1, 4, 3, 1, 2, 4, 2, 5, 4, 0, 4, 1, 0, 3, 4, 1, 5, 2, 1, 4, 5};
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    expect_as_all_sequences(with_random_places(card, seed), "card", seed);
    expect_as_all_sequences(with_random_places(octahedron, seed), "octahedron", seed);
    expect_as_all_sequences(with_random_places(pages, seed), "pages", seed);
    expect_as_all_sequences(with_random_places(open, seed), "grid", seed);
    expect_as_all_sequences(with_random_places(soup, seed), "soup", seed);
    expect_as_all_sequences(with_random_places(hourglass, seed), "hourglass", seed);
  }
}

TEST(ExactDistance, is_the_straight_line_in_a_convex_plane_with_slivers) {
  for (const double squeeze : {1.0, 1e-3, 1e-6}) {
    PlainMesh mesh = hf_test::grid(30, 20, 1, 0.3, 5);
    for (std::size_t i = 1; i < mesh.positions.size(); i += 3) mesh.positions[i] *= squeeze;
    Shape shape(mesh);
    for (const Index s : {0, 17, 300, 650}) {
      const auto d = shape.distance({s});
      for (std::size_t v = 0; v < d.size(); ++v)
        EXPECT_NEAR(d[v],
                    std::hypot(mesh.positions[3 * v] - mesh.positions[3 * at(s)],
                               mesh.positions[3 * v + 1] - mesh.positions[3 * at(s) + 1]),
                    1e-10)
            << squeeze;
    }
  }
}

TEST(ExactDistance, of_several_sources_is_the_least_of_each) {
  Shape shape(hf_test::torus(30, 20));
  const auto a = shape.distance({3}), b = shape.distance({311}), c = shape.distance({500}),
             d = shape.distance({3, 311, 500});
  for (std::size_t v = 0; v < d.size(); ++v) EXPECT_NEAR(d[v], std::min({a[v], b[v], c[v]}), 1e-12);
}

// A cone of total angle `angle`: rings around an apex. Its shortest path is the straight line in the unfolded sector,
// or goes through the apex where the angle between is more than pi.
TEST(ExactDistance, on_cones_is_that_of_the_unfolded_sector) {
  for (const double angle : {1.0, 3.0, 5.5, 7.5, 12.0}) {
    const int around = 24, rings = 6;
    PlainMesh mesh;
    mesh.positions = {0, 0, 0};
    // a zigzag in height gives the wanted angle per sector, also above 2 pi
    const double sector = angle / around, chord = 2 * std::sin(sector / 2), flat = 2 * 3.14159265358979323846 / around;
    // unit vectors at radius 1 with alternating heights +-z and equal chords: find z by bisection
    double low = 0, high = 0.999, base = 0;
    if (angle <= 6.28) {
      base = std::sqrt(1 - std::pow(chord / (2 * std::sin(flat / 2)), 2));  // an ordinary cone: constant height
      low = high = 0;
    }
    for (int i = 0; i < 100 && angle > 6.28; ++i) {
      const double z = (low + high) / 2, r = std::sqrt(1 - z * z);
      (std::hypot(2 * r * std::sin(flat / 2), 2 * z) < chord ? low : high) = z;
    }
    for (int ring = 1; ring <= rings; ++ring) {
      for (int i = 0; i < around; ++i) {
        const double z = angle <= 6.28 ? base : (i % 2 ? low : -low), r = std::sqrt(1 - z * z);
        mesh.positions.insert(mesh.positions.end(),
                              {ring * r * std::cos(flat * i), ring * r * std::sin(flat * i), ring * z});
      }
    }
    const auto id = [&](int ring, int i) { return static_cast<std::uint32_t>(1 + (ring - 1) * around + i % around); };
    for (int i = 0; i < around; ++i) {
      mesh.triangles.insert(mesh.triangles.end(), {0, id(1, i), id(1, i + 1)});
      for (int ring = 1; ring < rings; ++ring)
        mesh.triangles.insert(mesh.triangles.end(), {id(ring, i), id(ring + 1, i), id(ring + 1, i + 1), id(ring, i),
                                                     id(ring + 1, i + 1), id(ring, i + 1)});
    }
    Shape shape(mesh);
    // from a vertex in the middle; the rim is a polygon that cuts no straight line between vertices two rings inside
    const auto d = shape.distance({static_cast<Index>(id(3, 0))});
    for (int ring = 1; ring <= 3; ++ring) {
      for (int i = 0; i < around; ++i) {
        const double between = sector * std::min(i, around - i), a = 3, b = ring;
        const double straight = std::sqrt(a * a + b * b - 2 * a * b * std::cos(between));
        EXPECT_NEAR(d[id(ring, i)], between < 3.14159265358979 ? straight : a + b, 1e-9)
            << angle << " " << ring << " " << i;
      }
    }
    EXPECT_NEAR(d[0], 3, 1e-12);
  }
}

TEST(ExactDistance, from_a_corner_of_a_cube_is_that_of_its_unfoldings) {
  const std::uint32_t n = 7;
  PlainMesh mesh;
  std::vector<std::uint32_t> number((n + 1) * (n + 1) * (n + 1), 0);
  const auto id = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    std::uint32_t& v = number[(z * (n + 1) + y) * (n + 1) + x];
    if (v == 0) {
      for (const std::uint32_t c : {x, y, z}) mesh.positions.push_back(static_cast<double>(c) / n);
      v = mesh.vertex_count();
    }
    return v - 1;
  };
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      for (const std::uint32_t s : {0u, n}) {
        const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
          mesh.triangles.insert(mesh.triangles.end(), {a, b, c, a, c, d});
        };
        quad(id(s, i, j), id(s, i + 1, j), id(s, i + 1, j + 1), id(s, i, j + 1));
        quad(id(i, s, j), id(i + 1, s, j), id(i + 1, s, j + 1), id(i, s, j + 1));
        quad(id(i, j, s), id(i + 1, j, s), id(i + 1, j + 1, s), id(i, j + 1, s));
      }
    }
  }
  Shape shape(mesh);
  const auto d = shape.distance({static_cast<Index>(id(0, 0, 0))});
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    double p[3];
    std::copy_n(&mesh.positions[3 * v], 3, p);
    std::sort(p, p + 3);
    const double a = p[0], b = p[1], c = p[2];
    // with a coordinate 0 on a face of the corner: straight; else on a far face c = 1: over one of two edges
    const double expected = a == 0 ? std::hypot(b, c) : std::min(std::hypot(c + a, b), std::hypot(c + b, a));
    EXPECT_NEAR(d[v], expected, 1e-12) << a << " " << b << " " << c;
  }
}

TEST(ExactDistance, bends_around_a_hole_and_ends_at_pieces) {
  PlainMesh mesh = hf_test::grid(20, 20);
  // cut x in [8, 12], y in [0, 15] out of the grid; the vertices inside become isolated
  std::vector<std::uint32_t> kept;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    double x = 0, y = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      x += mesh.positions[3 * mesh.triangles[t + k]] / 3;
      y += mesh.positions[3 * mesh.triangles[t + k] + 1] / 3;
    }
    if (!(x > 8 && x < 12 && y < 15)) kept.insert(kept.end(), &mesh.triangles[t], &mesh.triangles[t] + 3);
  }
  mesh.triangles = kept;
  const std::uint32_t first = mesh.vertex_count();
  hf_test::append(mesh, hf_test::grid(2, 2), 40);
  const auto d = Shape(mesh).distance({0});
  EXPECT_NEAR(d[20], 2 * std::hypot(8.0, 15.0) + 4, 1e-12);
  for (std::size_t v = first; v < d.size(); ++v) EXPECT_TRUE(std::isinf(d[v]));
}

TEST(ExactDistance, is_symmetric_and_below_every_detour) {
  PlainMesh mesh = hf_test::torus(24, 16, 0.3, 3);
  hf_test::append(mesh, hf_test::grid(3, 3), 20);
  for (const auto& [name, dirty] : hf_test::dirty_meshes()) {
    if (dirty.vertex_count() > 3000) continue;
    Shape shape(dirty);
    std::vector<std::vector<double>> d;
    std::vector<Index> sources;
    for (Index s = 0; s < static_cast<Index>(dirty.vertex_count());
         s += std::max(1, static_cast<Index>(dirty.vertex_count()) / 6)) {
      if (shape.mesh.inner_of_given[at(s)] < 0) continue;
      sources.push_back(s);
      d.push_back(shape.distance({s}));
    }
    for (std::size_t i = 0; i < sources.size(); ++i) {
      for (std::size_t j = 0; j < sources.size(); ++j) {
        const double ij = d[i][at(sources[j])];
        if (std::isinf(ij)) {
          EXPECT_TRUE(std::isinf(d[j][at(sources[i])])) << name;
          continue;
        }
        EXPECT_NEAR(ij, d[j][at(sources[i])], 1e-9 * shape.mesh.scale)
            << name << " " << sources[i] << " " << sources[j];
        for (std::size_t v = 0; v < d[i].size(); ++v)
          EXPECT_LE(d[i][v], ij + d[j][v] + 1e-9 * shape.mesh.scale) << name;
      }
    }
  }
}

TEST(ExactDistance, is_cancelled_with_nothing_left_allocated) {
  Shape shape(hf_test::torus(100, 60));
  const std::uint64_t before = shape.memory.live_bytes();
  hf_inner::Progress progress;
  progress.cancel();
  const hf_inner::CallProgress call(&progress);
  EXPECT_THROW(shape.distance({0}), hf_inner::Error);
  EXPECT_THROW(shape.front(0), hf_inner::Error);
  EXPECT_EQ(shape.memory.live_bytes(), before);
}

// The place of a point of a path; ends inside a triangle are given.
hf_inner::Vec3 place_of(const hf_inner::mesh::Mesh& mesh, const hf_inner::mesh::PathPoint& p, hf_inner::Vec3 inside) {
  if (p.a < 0) return inside;
  return (1 - p.t) * mesh.positions[at(p.a)] + p.t * mesh.positions[at(p.b)];
}

struct RandomPoint {
  Index corners[3];
  double weights[3];
  hf_inner::Vec3 place;
};

RandomPoint random_point(const hf_inner::mesh::Mesh& mesh, std::mt19937& random, int kind) {
  RandomPoint p;
  const Index t = static_cast<Index>(random() % static_cast<unsigned>(mesh.triangle_count()));
  std::copy_n(mesh.triangle(t), 3, p.corners);
  std::rotate(p.corners, p.corners + random() % 3, p.corners + 3);
  const double a = 0.05 + 0.4 * (random() % 1000) / 1000, b = 0.05 + 0.4 * (random() % 1000) / 1000;
  const double weights[3][3] = {{1, 0, 0}, {a, 0, 1 - a}, {a, b, 1 - a - b}};
  std::copy_n(weights[kind], 3, p.weights);
  for (std::size_t k = 0; k < 3; ++k) p.place = p.place + p.weights[k] * mesh.positions[at(p.corners[k])];
  for (std::size_t k = 0; k < 3; ++k) p.corners[k] = p.weights[k] > 0 ? p.corners[k] : -1;
  return p;
}

// Every part of a path lies in one triangle, and its length is the distance: so no shorter path was missed, and no
// part left the surface.
TEST(ShortestPath, has_the_length_of_the_distance_and_stays_on_the_surface) {
  std::mt19937 random(4);
  std::vector<std::pair<std::string, PlainMesh>> meshes = hf_test::dirty_meshes();
  meshes.push_back({"torus", hf_test::torus(40, 30)});
  meshes.push_back({"grid", hf_test::grid(12, 12)});
  meshes.push_back({"slivers", hf_test::sheared_patch(20, 15, 20)});
  int bent = 0, several = 0;
  for (const auto& [name, plain] : meshes) {
    Shape shape(plain);
    for (int round = 0; round < 45; ++round) {
      const RandomPoint a = random_point(shape.mesh, random, round % 3),
                        b = random_point(shape.mesh, random, round / 3 % 3);
      const hf_inner::mesh::GeodesicPoint from(shape.sides, a.corners, a.weights, shape.memory),
          to(shape.sides, b.corners, b.weights, shape.memory);
      ASSERT_TRUE(from.found() && to.found());
      const auto path = hf_inner::mesh::shortest_path(shape.sides, from, to, shape.memory);
      const auto back = hf_inner::mesh::shortest_path(shape.sides, to, from, shape.memory);
      EXPECT_NEAR(path.length, back.length, 1e-10) << name << " " << round;
      if (path.points.empty()) {
        EXPECT_TRUE(back.points.empty());
        continue;
      }
      double sum = 0;
      for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
        const auto& p = path.points[i];
        const auto& q = path.points[i + 1];
        sum += norm(place_of(shape.mesh, p, i == 0 ? a.place : b.place) -
                    place_of(shape.mesh, q, i == 0 && q.a < 0 && path.points.size() > 2 ? a.place : b.place));
        bent += i > 0 && p.a == p.b;
        if (p.a < 0 || q.a < 0) continue;
        bool together = p.a == q.a && p.b == q.b;
        for (Index t = 0; t < shape.mesh.triangle_count() && !together; ++t) {
          const Index* v = shape.mesh.triangle(t);
          const auto has = [&](Index w) { return std::find(v, v + 3, w) != v + 3; };
          together = has(p.a) && has(p.b) && has(q.a) && has(q.b);
        }
        EXPECT_TRUE(together) << name << " " << round << " " << i;
      }
      several += path.points.size() > 3;
      EXPECT_NEAR(sum, path.length, 1e-9) << name << " " << round << ", " << path.points.size() << " points";
      if (from.vertex >= 0 && to.vertex >= 0) {
        EXPECT_NEAR(
            path.length,
            hf_inner::mesh::exact_distance(shape.sides, hf_inner::Span<const Index>(&from.vertex, 1), shape.memory)
                .distance[at(to.vertex)],
            1e-12);
      }
    }
  }
  EXPECT_GT(bent, 10);
  EXPECT_GT(several, 100);
}

// In a plane the map is the plane, turned: all distances between mapped vertices are those of the vertices.
TEST(LogMap, of_a_convex_plane_is_the_plane_itself) {
  std::mt19937 random(9);
  const PlainMesh plain = hf_test::turned_over(hf_test::grid(14, 11, 1, 0.3, 5), 3);  // also triangles upside down
  Shape shape(plain);
  for (int round = 0; round < 30; ++round) {
    const RandomPoint p = random_point(shape.mesh, random, round % 3);
    const hf_inner::mesh::GeodesicPoint from(shape.sides, p.corners, p.weights, shape.memory);
    hf_inner::mesh::ExactTask task;
    task.from = &from;
    task.directions = true;
    const auto found = hf_inner::mesh::exact_distance(shape.sides, task, shape.memory);
    EXPECT_LE(found.fan_angle, 6.28318530717959);
    std::vector<Point2> map;
    for (std::size_t v = 0; v < found.distance.size(); ++v)
      map.push_back(
          {found.distance[v] * std::cos(found.direction[v]), found.distance[v] * std::sin(found.direction[v])});
    for (std::size_t v = 0; v < map.size(); ++v) {
      EXPECT_NEAR(found.distance[v], norm(shape.mesh.positions[v] - p.place), 1e-12);
      const std::size_t w = (v * 37 + 11) % map.size();
      EXPECT_NEAR(std::hypot(map[v].x - map[w].x, map[v].y - map[w].y),
                  norm(shape.mesh.positions[v] - shape.mesh.positions[w]), 1e-10)
          << "round " << round << ", " << v << " and " << w;
    }
  }
}

// The direction in which the path to a vertex leaves is that of the first part of the traced path.
TEST(LogMap, has_the_directions_of_the_shortest_paths) {
  std::mt19937 random(11);
  Shape shape(hf_test::torus(30, 24, 0.3));
  for (int round = 0; round < 6; ++round) {
    const RandomPoint p = random_point(shape.mesh, random, 2);
    const hf_inner::mesh::GeodesicPoint from(shape.sides, p.corners, p.weights, shape.memory);
    hf_inner::mesh::ExactTask task;
    task.from = &from;
    task.directions = true;
    const auto found = hf_inner::mesh::exact_distance(shape.sides, task, shape.memory);
    const Index* corner = shape.mesh.triangle(found.first_triangle);
    const hf_inner::Vec3 o = shape.mesh.positions[at(corner[0])];
    const hf_inner::Vec3 x = unit_vector(shape.mesh.positions[at(corner[1])] - o);
    const hf_inner::Vec3 n = unit_vector(cross(x, shape.mesh.positions[at(corner[2])] - o)), y = cross(n, x);
    for (Index v = 0; v < shape.mesh.vertex_count(); v += 7) {
      const double one[3] = {1, 0, 0};
      const Index at_vertex[3] = {v, -1, -1};
      const hf_inner::mesh::GeodesicPoint to(shape.sides, at_vertex, one, shape.memory);
      const auto path = hf_inner::mesh::shortest_path(shape.sides, from, to, shape.memory);
      const hf_inner::Vec3 first = place_of(shape.mesh, path.points[1], p.place) - p.place;
      EXPECT_NEAR(std::cos(found.direction[at(v)]), dot(first, x) / norm(first), 1e-7) << v;
      EXPECT_NEAR(std::sin(found.direction[at(v)]), dot(first, y) / norm(first), 1e-7) << v;
    }
  }
}

TEST(FrontDistance, is_off_by_at_most_one_per_cent_and_three_at_worst) {
  std::vector<std::pair<std::string, PlainMesh>> meshes = {{"torus", hf_test::torus(80, 60)},
                                                           {"plane", hf_test::grid(40, 40, 1, 0.3)},
                                                           {"slivers", hf_test::sheared_patch(40, 30, 8)}};
  for (const auto& [name, mesh] : meshes) {
    Shape shape(mesh);
    const auto exact = shape.distance({7}), d = shape.front(7);
    double sum = 0, worst = 0, diameter = 0;
    for (std::size_t v = 0; v < d.size(); ++v) {
      diameter = std::max(diameter, exact[v]);
      sum += std::fabs(d[v] - exact[v]);
      worst = std::max(worst, std::fabs(d[v] - exact[v]));
    }
    EXPECT_LT(sum / static_cast<double>(d.size()), 0.01 * diameter) << name;
    EXPECT_LT(worst, 0.03 * diameter) << name;
    EXPECT_LT(worst, 0.015 * diameter) << name;
  }
}

}  // namespace

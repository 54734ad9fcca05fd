// The points of shortest paths: each vertex once, each crossing once, neighbours in one triangle.
#include "mesh/exact_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "base/index.h"
#include "support/creature.h"
#include "support/dirty_meshes.h"
#include "support/meshes.h"
#include "unit/field/analysis_support.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::mesh;
using hf_test::PlainMesh;

// A mesh with its tables. Lengths are in box diagonals.
struct Shape {
  explicit Shape(const PlainMesh& plain)
      : core(hf_test::make_core(plain)),
        mesh(core->geometry->unlinked().mesh),
        topology(core->geometry->unlinked().topology()),
        sides(mesh, topology, memory) {}
  GeodesicPoint point(const Index* corners, const double* weights) const {
    return GeodesicPoint(sides, corners, weights, memory);
  }
  GeodesicPoint vertex(Index given) const {
    const Index corners[3] = {mesh.inner_of_given[at(given)], Mesh::none, Mesh::none};
    const double weights[3] = {1, 0, 0};
    return point(corners, weights);
  }
  bool in_one_triangle(const PathPoint& p, const PathPoint& q) const {
    for (Index t = 0; t < mesh.triangle_count(); ++t) {
      const Index* corners = mesh.triangle(t);
      const auto has = [&](Index v) { return v == Mesh::none || std::find(corners, corners + 3, v) != corners + 3; };
      if (has(p.a) && has(p.b) && has(q.a) && has(q.b)) return true;
    }
    return false;
  }
  // Expects of a path what mesh/exact_path.h says. Returns the number of vertices that it passes.
  int check(const GeodesicPoint& from, const GeodesicPoint& to, const std::string& name) const {
    const SurfacePath path = shortest_path(sides, from, to, memory);
    const auto place = [&](std::size_t i) {
      const PathPoint& p = path.points[i];
      if (p.a == Mesh::none) return (i == 0 ? from : to).position(mesh);
      return (1 - p.t) * mesh.positions[at(p.a)] + p.t * mesh.positions[at(p.b)];
    };
    int passed = 0;
    double sum = 0;
    EXPECT_FALSE(path.points.empty()) << name;
    for (std::size_t i = 0; i < path.points.size(); ++i) {
      const PathPoint& p = path.points[i];
      const bool inner = i > 0 && i + 1 < path.points.size();
      if (p.a == p.b)
        EXPECT_EQ(p.t, 0) << name;
      else
        EXPECT_TRUE(p.t > 1e-9 && p.t < 1 - 1e-9) << name << ": " << p.t;
      EXPECT_TRUE(!inner || p.a != Mesh::none) << name;
      passed += inner && p.a == p.b;
      if (i == 0) continue;
      sum += norm(place(i) - place(i - 1));
      EXPECT_GT(norm(place(i) - place(i - 1)), 1e-9) << name << ", segment " << i << " of " << path.points.size();
      EXPECT_TRUE(in_one_triangle(path.points[i - 1], p)) << name << ", segment " << i;
    }
    EXPECT_NEAR(sum, path.length, 1e-13) << name;
    EXPECT_LT(norm(place(0) - from.position(mesh)), 1e-12) << name;
    EXPECT_LT(norm(place(path.points.size() - 1) - to.position(mesh)), 1e-12) << name;
    return passed;
  }
  std::shared_ptr<const surface::Core> core;
  const Mesh& mesh;
  const Topology& topology;
  mutable Memory memory;
  TriangleSides sides;
};

// A square of n x n squares, all with the diagonal in the direction (1, 1).
PlainMesh lattice(std::uint32_t n) {
  PlainMesh mesh = hf_test::grid(n, n);
  mesh.triangles.clear();
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, c = a + n + 1;
      mesh.triangles.insert(mesh.triangles.end(), {a, a + 1, c + 1, a, c + 1, c});
    }
  }
  return mesh;
}

// The number of places where the straight line over (x, y) from a lattice point meets lines of the lattice, as reduced
// fractions of its way.
std::size_t lattice_places(int x, int y) {
  std::set<std::pair<int, int>> places = {{0, 1}, {1, 1}};
  for (const int lines : {std::abs(x), std::abs(y), std::abs(y - x)}) {
    for (int k = 1; k < lines; ++k) places.insert({k / std::gcd(k, lines), lines / std::gcd(k, lines)});
  }
  return places.size();
}

TEST(ShortestPath, on_a_lattice_has_one_point_at_each_place_where_it_meets_a_line) {
  const Shape shape(lattice(8));
  std::mt19937 random(1);
  int passed = 0;
  for (int round = 0; round < 300; ++round) {
    const Index from = static_cast<Index>(round == 0 ? 0 : random() % 81), to = round == 0 ? 76 : random() % 81;
    if (from == to) continue;
    const std::string name = std::to_string(from) + " to " + std::to_string(to);
    passed += shape.check(shape.vertex(from), shape.vertex(to), name);
    const SurfacePath path = shortest_path(shape.sides, shape.vertex(from), shape.vertex(to), shape.memory);
    EXPECT_EQ(path.points.size(), lattice_places(to % 9 - from % 9, to / 9 - from / 9)) << name;
  }
  EXPECT_GT(passed, 200);
}

TEST(ShortestPath, passes_a_vertex_in_one_point) {
  // grids whose places are rounded, one with long paths over short edges, a ball and a creature
  PlainMesh thirds = lattice(60), cut = hf_test::grid(24, 24, 0.1);
  for (double& x : thirds.positions) x = 7.7 + x / 3;
  const std::pair<const char*, PlainMesh> meshes[] = {{"thirds", thirds},
                                                      {"grid", cut},
                                                      {"ball", hf_test::sphere(16)},
                                                      {"cactus", hf_test::from_shape(hf_test::cactus(3000))}};
  std::mt19937 random(2);
  for (const auto& [name, plain] : meshes) {
    const Shape shape(plain);
    int passed = 0;
    for (int round = 0; round < 40; ++round) {
      // a corner, the middle of an edge or of a triangle
      const double weights[3][3] = {{1, 0, 0}, {0.5, 0.5, 0}, {0.25, 0.25, 0.5}};
      const auto draw = [&](int kind) {
        const Index t = static_cast<Index>(random() % static_cast<std::uint32_t>(shape.mesh.triangle_count()));
        return shape.point(shape.mesh.triangle(t), weights[kind]);
      };
      const GeodesicPoint from = draw(round % 3), to = draw(round / 3 % 3);
      passed += shape.check(from, to, name + (", round " + std::to_string(round)));
    }
    // no shortest path passes a vertex of a ball: its angles sum to less than 2 pi
    if (name == std::string("ball"))
      EXPECT_EQ(passed, 0);
    else
      EXPECT_GT(passed, 5) << name;
  }
}

// A ray that hits an edge gives weights with rounding: no point of a path lies beside the first or the last.
TEST(ShortestPath, starts_on_the_edge_or_at_the_vertex_that_a_ray_hits) {
  const Shape shape(lattice(8));
  const Index last = shape.mesh.triangle_count() - 1;
  for (const double rounding : {0.0, 1e-18, 1e-16, 3e-15}) {
    const double edge[3] = {0.5, 0.5 - rounding, rounding}, vertex[3] = {rounding, 1 - 2 * rounding, rounding};
    for (Index k = 0; k < 3; ++k) {
      for (const auto& weights : {edge, vertex}) {
        double turned[3];
        std::rotate_copy(weights, weights + k, weights + 3, turned);
        const GeodesicPoint hit = shape.point(shape.mesh.triangle(last / 2), turned);
        EXPECT_EQ(hit.vertex >= 0, weights == vertex);
        for (const Index v : {0, 8, 72, 80}) {
          shape.check(hit, shape.vertex(v), "from a hit");
          shape.check(shape.vertex(v), hit, "to a hit");
        }
      }
    }
  }
}

TEST(ShortestPath, of_a_point_to_itself_is_one_point) {
  const Shape shape(lattice(8));
  for (const auto& weights : {std::array<double, 3>{1, 0, 0}, {0.25, 0.75, 0}, {0.25, 0.25, 0.5}}) {
    const GeodesicPoint point = shape.point(shape.mesh.triangle(40), weights.data());
    const SurfacePath path = shortest_path(shape.sides, point, point, shape.memory);
    EXPECT_EQ(path.points.size(), 1u);
    EXPECT_EQ(path.length, 0);
  }
}

}  // namespace

// A triangle divided along lines: exact areas, every line an edge, crossings seen, corners as round as lines allow.
#include "mesh/triangle_division.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>
#include <vector>

namespace {

using namespace hf_inner;
using namespace hf_inner::mesh;
constexpr std::int64_t grid = GridPoint::grid;

std::int64_t turn(const GridPoint& p, const GridPoint& q, const GridPoint& r) {
  return (q.a - p.a) * (r.b - p.b) - (q.b - p.b) * (r.a - p.a);
}

struct Division {
  Memory memory;
  TriangleDivision made{memory};
  std::vector<GridPoint> points = {{grid, 0}, {0, grid}, {0, 0}};
  explicit Division(Vec3 c = {0.3, 0.8, 0}) { made.begin({0, 0, 0}, {1, 0, 0}, c); }
  Index add(GridPoint p) {
    points.push_back(p);
    return made.add(p);
  }
  bool has_edge(Index p, Index q) const {
    for (std::size_t t = 0; t < made.triangle_count(); ++t) {
      const Index* const v = made.corners(t);
      for (int k = 0; k < 3; ++k)
        if ((v[k] == p && v[(k + 1) % 3] == q) || (v[k] == q && v[(k + 1) % 3] == p)) return true;
    }
    return false;
  }
  // Every part turns as the whole does, the areas sum to the whole, and an edge has one triangle on each side.
  void check() const {
    std::int64_t sum = 0;
    std::map<std::pair<Index, Index>, int> edges;
    for (std::size_t t = 0; t < made.triangle_count(); ++t) {
      const Index* const v = made.corners(t);
      const std::int64_t area = turn(points[at(v[0])], points[at(v[1])], points[at(v[2])]);
      ASSERT_GT(area, 0);
      sum += area;
      for (int k = 0; k < 3; ++k) ++edges[{v[k], v[(k + 1) % 3]}];
    }
    EXPECT_EQ(sum, grid * grid);
    for (const auto& edge : edges) EXPECT_EQ(edge.second, 1);
    std::set<Index> used;
    for (const auto& edge : edges) used.insert(edge.first.first);
    EXPECT_EQ(used.size(), points.size());
  }
};

bool cross(const GridPoint& p, const GridPoint& q, const GridPoint& r, const GridPoint& s) {
  const auto sign = [](std::int64_t x) { return x > 0 ? 1 : x < 0 ? -1 : 0; };
  return sign(turn(p, q, r)) * sign(turn(p, q, s)) < 0 && sign(turn(r, s, p)) * sign(turn(r, s, q)) < 0;
}

TEST(TriangleDivision, LinesBecomeEdgesUnlessTheyCross) {
  std::mt19937 random(5);
  int joined = 0, refused = 0;
  for (int round = 0; round < 400; ++round) {
    // slivers too: the plane in which parts are made round does not matter for what is exact
    Division division(round % 4 == 0 ? Vec3{0.5, 1e-7, 0} : Vec3{0.3, 0.8, 0});
    const int steps = round % 3 == 0 ? 6 : 1 << 20;  // few places: many on one line
    const std::int64_t unit = grid / steps;
    std::set<std::pair<std::int64_t, std::int64_t>> taken = {{grid, 0}, {0, grid}, {0, 0}};
    const int count = 3 + static_cast<int>(random() % 20);
    for (int i = 0; i < count; ++i) {
      const std::int64_t a = static_cast<std::int64_t>(random() % static_cast<unsigned>(steps + 1)) * unit;
      const std::int64_t b = static_cast<std::int64_t>(random() % static_cast<unsigned>(steps + 1)) * unit;
      const GridPoint p{a, i % 4 == 0 ? 0 : i % 4 == 1 ? grid - a : b};
      if (p.a + p.b > grid || p.a < 0 || !taken.insert({p.a, p.b}).second) continue;
      division.add(p);
    }
    division.check();
    const auto n = static_cast<Index>(division.points.size());
    std::vector<std::pair<Index, Index>> lines;
    for (int i = 0; i < 12; ++i) {
      const Index p = static_cast<Index>(random() % static_cast<unsigned>(n)),
                  q = static_cast<Index>(random() % static_cast<unsigned>(n));
      if (p == q) continue;
      const GridPoint &x = division.points[at(p)], &y = division.points[at(q)];
      bool free = true;
      for (const auto& line : lines)
        free = free && !cross(x, y, division.points[at(line.first)], division.points[at(line.second)]);
      for (const GridPoint& z : division.points) {
        const bool between = (z.a - x.a) * (z.a - y.a) <= 0 && (z.b - x.b) * (z.b - y.b) <= 0;
        free = free && (z == x || z == y || turn(x, y, z) != 0 || !between);
      }
      ASSERT_EQ(division.made.join(p, q), free) << round << ", " << i;
      if (!free) {
        ++refused;
        continue;
      }
      ++joined;
      lines.push_back({p, q});
      division.check();
      for (const auto& line : lines) ASSERT_TRUE(division.has_edge(line.first, line.second)) << round << ", " << i;
    }
  }
  EXPECT_GT(joined, 1000);
  EXPECT_GT(refused, 300);
}

TEST(TriangleDivision, PartsAreDelaunayWhereNoLineIs) {
  std::mt19937 random(7);
  Division division;
  for (int i = 0; i < 200; ++i) {
    const std::int64_t a = static_cast<std::int64_t>(random() % grid), b = static_cast<std::int64_t>(random() % grid);
    if (a + b < grid) division.add({a, b});
  }
  division.check();
  const auto place = [&](Index v) {
    const GridPoint& p = division.points[at(v)];
    const double a = static_cast<double>(p.a) / grid, b = static_cast<double>(p.b) / grid;
    return Vec3{b + (1 - a - b) * 0.3, (1 - a - b) * 0.8, 0};
  };
  std::map<std::pair<Index, Index>, double> opposite;
  for (std::size_t t = 0; t < division.made.triangle_count(); ++t) {
    const Index* const v = division.made.corners(t);
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = place(v[k]) - place(v[(k + 2) % 3]), q = place(v[(k + 1) % 3]) - place(v[(k + 2) % 3]);
      opposite[std::minmax(v[k], v[(k + 1) % 3])] += std::acos(dot(p, q) / (norm(p) * norm(q)));
    }
  }
  for (const auto& edge : opposite) EXPECT_LE(edge.second, 3.14159265358979 + 1e-6);
}

// The oldest triangle is where the search begins; a thousand points in a row lie far from it.
TEST(TriangleDivision, ManyPointsOnOneLineAndBesideIt) {
  Division division;
  for (int i = 1; i < 1000; ++i) division.add({grid / 4 + i * (grid / 4000), grid / 3 - i * (grid / 5000)});
  for (Index i = 3; i < 1001; ++i) ASSERT_TRUE(division.made.join(i, i + 1));
  division.check();
}

}  // namespace

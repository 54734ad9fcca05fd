// Closed curves through triangles: their paths, and the two sides that they tell apart.
#include <random>

#include "detail/curve_sides.h"
#include "detail_support.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::detail;
using namespace hf_test;

using Points = std::vector<mesh::CurvePoint>;

mesh::SurfaceCurve curve_of(const surface::Core& core, const Points& points) {
  const surface::Geometry& shape = core.geometry->unlinked();
  return mesh::surface_curve(shape.mesh, shape.topology(), points, {}, *core.memory);
}

Numbers side_of(const surface::Core& core, const Points& points, CurveSide side = CurveSide::smaller,
                std::int32_t seed = -1) {
  const mesh::SurfaceCurve curve = curve_of(core, points);
  return numbers(surface_curve_side(core, points, curve, side, seed, *core.memory));
}

Points at_vertices(const Numbers& vertices) {
  Points points;
  for (const std::int32_t v : vertices) points.push_back(mesh::at_vertex(v));
  return points;
}

Vec3 position(const surface::Core& core, const mesh::SurfaceCurve& curve, const Points& points, std::size_t i) {
  const mesh::PathPoint& place = curve.place[i];
  Vec3 p;
  if (place.a == mesh::Mesh::none) {
    const mesh::CurvePoint& point = points[static_cast<std::size_t>(curve.point_of[i])];
    for (int k = 0; k < 3; ++k)
      p = p + point.weight[k] * core.mesh.positions[static_cast<std::size_t>(point.corner[k])];
    return p;
  }
  return (1 - place.t) * core.mesh.positions[static_cast<std::size_t>(place.a)] +
         place.t * core.mesh.positions[static_cast<std::size_t>(place.b)];
}

// A random point of a triangle: inside it, on an edge, or at a corner.
mesh::CurvePoint draw(const surface::Core& core, std::mt19937& random) {
  const auto below = [&](std::int32_t n) {
    return static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(n));
  };
  const std::int32_t* v = core.mesh.triangle(below(core.mesh.triangle_count()));
  mesh::CurvePoint point{{v[0], v[1], v[2]}, {1, 0, 0}};
  const std::int32_t kind = below(4);
  if (kind > 0) {
    double sum = 0;
    for (double& w : point.weight) sum += w = 1 + below(8);
    if (kind == 1) {
      sum -= point.weight[2];
      point.weight[2] = 0;
    }
    for (double& w : point.weight) w /= sum;
  }
  return point;
}

// Every two places in a row lie in the triangle that is named, no two are one, and each path is as long as the exact
// distance.
TEST(SurfaceCurve, PathsAreShortestAndRunThroughTheirTriangles) {
  for (const PlainMesh& mesh : {torus(28, 18), plain(samples::sphere(3)), grid(12, 9)}) {
    const auto core = make_core(mesh);
    const mesh::Topology& topology = core->geometry->unlinked().topology();
    const mesh::TriangleSides sides(core->mesh, topology, *core->memory);
    std::mt19937 random(3);
    for (int round = 0; round < 60; ++round) {
      Points points;
      for (int i = 0; i < 4; ++i) points.push_back(draw(*core, random));
      const mesh::SurfaceCurve curve = curve_of(*core, points);
      std::vector<double> length(points.size());
      for (std::size_t i = 0; i < curve.place.size(); ++i) {
        const std::size_t next = (i + 1) % curve.place.size();
        const double line = norm(position(*core, curve, points, next) - position(*core, curve, points, i));
        EXPECT_GT(line, 1e-9) << round << ", " << i;
        length[static_cast<std::size_t>(curve.point_of[i])] += line;
        const std::int32_t* v = core->mesh.triangle(curve.triangle[i]);
        for (const std::size_t p : {i, next}) {
          for (const std::int32_t corner : {curve.place[p].a, curve.place[p].b})
            EXPECT_TRUE(corner == mesh::Mesh::none || corner == v[0] || corner == v[1] || corner == v[2]);
        }
      }
      for (std::size_t i = 0; i < points.size(); ++i) {
        const mesh::CurvePoint &a = points[i], &b = points[(i + 1) % points.size()];
        const mesh::GeodesicPoint from(sides, a.corner, a.weight, *core->memory),
            to(sides, b.corner, b.weight, *core->memory);
        EXPECT_NEAR(length[i], mesh::shortest_path(sides, from, to, *core->memory).length, 1e-7) << round << ", " << i;
      }
    }
  }
}

// In a plane, the paths are straight lines, and how often they run round a vertex is known without any mesh. Triangles
// may be turned.
TEST(SurfaceCurve, SidesAreThoseOfWindingNumbersInThePlane) {
  int refused = 0, taken = 0, empty = 0;
  std::mt19937 random(11);
  for (const bool turned : {false, true}) {
    PlainMesh plane = grid(20, 20);
    if (turned) {
      for (std::size_t t = 0; t < plane.triangles.size() / 3; ++t)
        if (random() % 2) std::swap(plane.triangles[3 * t], plane.triangles[3 * t + 1]);
    }
    const auto core = make_core(plane);
    for (int round = 0; round < 1500; ++round) {
      Points points;
      for (std::uint32_t i = 0, count = 3 + random() % 4; i < count; ++i) points.push_back(draw(*core, random));
      std::vector<Vec3> corner;
      for (const mesh::CurvePoint& point : points) {
        Vec3 p;
        for (int k = 0; k < 3; ++k)
          p = p + point.weight[k] * core->mesh.positions[static_cast<std::size_t>(point.corner[k])];
        corner.push_back(p);
      }
      // The winding number of every vertex off the lines.
      std::vector<int> winding(static_cast<std::size_t>(core->size()));
      std::vector<bool> on(winding.size());
      int low = 99, high = -99;
      for (std::size_t v = 0; v < winding.size(); ++v) {
        const Vec3 q = core->mesh.positions[v];
        for (std::size_t i = 0; i < corner.size(); ++i) {
          const Vec3 a = corner[i] - q, b = corner[(i + 1) % corner.size()] - q, d = b - a;
          const double left = a.x * b.y - a.y * b.x;
          on[v] = on[v] || (std::fabs(left) <= 1e-9 * norm(d) && dot(a, b) <= 1e-18) || norm(a) < 1e-9;
          if ((a.y > 0) != (b.y > 0) && (left > 0) == (b.y > a.y)) winding[v] += b.y > a.y ? 1 : -1;
        }
        if (!on[v]) {
          low = std::min(low, winding[v]);
          high = std::max(high, winding[v]);
        }
      }
      try {
        const Numbers inside = side_of(*core, points);
        ++taken;
        EXPECT_TRUE(turned || high - low == 1) << round << ": " << low << " to " << high;
        std::vector<bool> in(winding.size());
        for (const std::int32_t v : inside) in[static_cast<std::size_t>(v)] = true;
        std::size_t differ[2] = {0, 0};
        for (std::size_t v = 0; v < winding.size(); ++v) {
          for (int k = 0; k < 2; ++k) differ[k] += !on[v] && in[v] != ((winding[v] & 1) == k);
        }
        const int k = differ[0] < differ[1] ? 0 : 1;
        for (std::size_t v = 0; v < winding.size(); ++v) {
          if (on[v] || in[v] == ((winding[v] & 1) == k)) continue;
          // A vertex that the region nearly surrounds joined it.
          int outside = 0;
          for (std::int32_t i = core->topology().neighbour_start[v]; i < core->topology().neighbour_start[v + 1]; ++i)
            outside += !in[static_cast<std::size_t>(core->topology().neighbour[static_cast<std::size_t>(i)])];
          EXPECT_TRUE(in[v] && outside <= 1) << round << ": vertex " << v;
        }
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), HF_ERROR_INVALID_ARGUMENT);
        const bool none = high == low;
        empty += none;
        refused += !none;
        EXPECT_TRUE(none || (!turned && high - low > 1)) << round << ": " << error.what();
        EXPECT_TRUE(none || error.index() < points.size()) << error.what();
      }
    }
  }
  EXPECT_GT(refused, 300);
  EXPECT_GT(taken, 300);
  EXPECT_GT(empty, 3);
}

// A curve that touches itself along lines and at vertices, or runs out and back, crosses nothing.
TEST(SurfaceCurve, MayTouchItself) {
  const auto core = make_core(grid(20, 20));
  const auto at = [](std::int32_t i, std::int32_t j) { return 21 * j + i; };
  const Points touch =
      at_vertices({at(10, 10), at(10, 15), at(5, 15), at(5, 10), at(10, 10), at(10, 5), at(15, 5), at(15, 10)});
  EXPECT_EQ(side_of(*core, touch).size(), 32u);
  const Points cross =
      at_vertices({at(10, 10), at(10, 15), at(5, 15), at(5, 10), at(10, 10), at(15, 10), at(15, 5), at(10, 5)});
  EXPECT_EQ(index_of_failure(HF_ERROR_INVALID_ARGUMENT, [&] { side_of(*core, cross); }), 4u);
  const Points eight = at_vertices({at(5, 5), at(12, 12), at(12, 5), at(5, 12)});
  EXPECT_EQ(index_of_failure(HF_ERROR_INVALID_ARGUMENT, [&] { side_of(*core, eight); }), 2u);
  // an eight whose lines cross in the middle of an edge, and one inside a triangle
  const Points middle = at_vertices({at(5, 7), at(11, 10), at(11, 7), at(5, 10)});
  EXPECT_EQ(index_of_failure(HF_ERROR_INVALID_ARGUMENT, [&] { side_of(*core, middle); }), 2u);
  const Points skew = at_vertices({at(5, 5), at(12, 13), at(13, 4), at(5, 12)});
  EXPECT_EQ(index_of_failure(HF_ERROR_INVALID_ARGUMENT, [&] { side_of(*core, skew); }), 2u);
  // out from the corner of a square and back, at a slope that meets no vertex
  const Numbers square = side_of(*core, at_vertices({at(5, 5), at(12, 5), at(12, 12), at(5, 12)}));
  EXPECT_EQ(square.size(), 36u);
  EXPECT_EQ(side_of(*core, at_vertices({at(5, 5), at(12, 5), at(12, 12), at(19, 15), at(12, 12), at(5, 12)})), square);
  // along one line twice, between two squares
  const Points dumb_bell = at_vertices({at(2, 2), at(6, 2), at(6, 4), at(12, 7), at(12, 2), at(18, 2), at(18, 12),
                                        at(12, 12), at(12, 7), at(6, 4), at(6, 8), at(2, 8)});
  EXPECT_EQ(side_of(*core, dumb_bell).size(), 3u * 5u + 5u * 9u);
}

TEST(SurfaceCurve, MayUseBorders) {
  const auto core = make_core(grid(20, 20));
  const auto at = [](std::int32_t i, std::int32_t j) { return 21 * j + i; };
  EXPECT_EQ(side_of(*core, at_vertices({at(0, 0), at(10, 0), at(10, 20), at(0, 20)})).size(), 9u * 19u);
  for (const CurveSide which : {CurveSide::smaller, CurveSide::larger})
    EXPECT_EQ(side_of(*core, at_vertices({at(0, 0), at(20, 0), at(20, 20), at(0, 20)}), which).size(), 19u * 19u);
  // a triangle whose one side is half of an edge at the border
  const Points corner = {
      mesh::at_vertex(at(0, 0)), mesh::at_vertex(at(5, 0)), {{at(0, 4), at(0, 5), mesh::Mesh::none}, {0.5, 0.5, 0}}};
  EXPECT_EQ(side_of(*core, corner).size(), 6u);
  index_of_failure(HF_ERROR_INVALID_ARGUMENT, [&] { side_of(*core, at_vertices({at(1, 0), at(3, 0), at(2, 0)})); });
}

TEST(SurfaceCurve, EnclosesTheSideThatIsAskedFor) {
  const auto core = make_core(torus(28, 18));
  std::mt19937 random(9);
  // a circle round a vertex
  const std::int32_t middle = 4;
  const Vec3 centre = core->mesh.positions[middle];
  Points points;
  for (int i = 0; i < 9; ++i) {
    const double angle = 2 * 3.14159265358979 * i / 9, r = 0.12;
    std::int32_t best = 0;
    double least = 1e9;
    for (std::int32_t t = 0; t < core->mesh.triangle_count(); ++t) {
      Vec3 c;
      for (int k = 0; k < 3; ++k)
        c = c + (1.0 / 3) * core->mesh.positions[static_cast<std::size_t>(core->mesh.triangle(t)[k])];
      const Vec3 d = c - centre;
      const double off = std::fabs(d.y - r * std::cos(angle)) + std::fabs(d.z - r * std::sin(angle)) + std::fabs(d.x);
      if (off < least) {
        least = off;
        best = t;
      }
    }
    const std::int32_t* v = core->mesh.triangle(best);
    points.push_back({{v[0], v[1], v[2]}, {1.0 / 3, 1.0 / 3, 1.0 / 3}});
  }
  const Numbers inner = side_of(*core, points), outer = side_of(*core, points, CurveSide::larger);
  EXPECT_GT(inner.size(), 10u);
  EXPECT_TRUE(std::binary_search(inner.begin(), inner.end(), middle));
  EXPECT_EQ(inner.size() + outer.size(), static_cast<std::size_t>(core->size()));
  EXPECT_EQ(side_of(*core, points, CurveSide::seed, middle), inner);
  EXPECT_EQ(side_of(*core, points, CurveSide::seed, outer[0]), outer);
}

TEST(SurfaceCurve, SeedsOnItOrElsewhereAreNamed) {
  PlainMesh mesh = grid(20, 20);
  append(mesh, grid(2, 2), 50);
  const auto core = make_core(mesh);
  const auto at = [](std::int32_t i, std::int32_t j) { return 21 * j + i; };
  const Points square = at_vertices({at(5, 5), at(12, 5), at(12, 12), at(5, 12)});
  const auto with_seed = [&](std::int32_t seed) {
    return index_of_failure(HF_ERROR_INVALID_ARGUMENT, [&] { side_of(*core, square, CurveSide::seed, seed); });
  };
  EXPECT_EQ(with_seed(at(8, 5)), static_cast<std::uint32_t>(at(8, 5)));
  EXPECT_EQ(with_seed(445), 445u);
}

// A vertex where two fans touch: the walk around it does not lead from one to the other.
TEST(SurfaceCurve, VerticesThatAreNotOneFanAreNamed) {
  PlainMesh mesh;
  mesh.positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, -1, 0, 0, -1, -1, 0, 0, -1, 0};
  mesh.triangles = {0, 1, 2, 0, 2, 3, 0, 4, 5, 0, 5, 6};
  const auto core = make_core(mesh);
  const Points points = at_vertices({2, 5, 0});
  EXPECT_EQ(index_of_failure(HF_ERROR_INVALID_ARGUMENT, [&] { side_of(*core, points); }), 0u);
}

}  // namespace

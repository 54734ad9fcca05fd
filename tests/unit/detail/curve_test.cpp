// Closed curves: shortest paths between their points, and the side that is meant.
#include "detail/curve_crossing.h"
#include "detail_support.h"
#include "mesh/places.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::detail;
using namespace hf_test;

// A grid of 21 x 21 vertices, one unit apart.
std::int32_t place(std::int32_t i, std::int32_t j) { return 21 * j + i; }

// The curve through points, which must not cross itself.
Numbers curve_on(const surface::Core& core, const Numbers& points) {
  const ClosedCurve curve = closed_curve(core, {points.data(), points.size()}, *core.memory);
  require_no_crossing(core, curve, *core.memory);
  return numbers(curve.vertices);
}

struct Sheet {
  Sheet() : surface(surface_of(make_core(grid(20, 20)))) {}
  Numbers curve(const Numbers& points) const { return curve_on(*surface->core, points); }
  Numbers side(const Numbers& points, CurveSide which, std::int32_t seed = -1) const {
    const Numbers line = curve(points);
    return numbers(curve_side(*surface->core, {line.data(), line.size()}, which, seed, *surface->core->memory));
  }
  std::shared_ptr<const RegionSurface> surface;
};

const Numbers square{place(5, 5), place(12, 5), place(12, 12), place(5, 12)};

TEST(Curve, RunsAlongShortestPaths) {
  const Sheet sheet;
  const Numbers curve = sheet.curve(square);
  EXPECT_EQ(curve.size(), 28u);  // straight sides of 7 edges
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const std::int32_t a = curve[i], b = curve[(i + 1) % curve.size()];
    EXPECT_EQ(std::abs(a % 21 - b % 21) + std::abs(a / 21 - b / 21), 1) << i;
    EXPECT_TRUE(a % 21 == 5 || a % 21 == 12 || a / 21 == 5 || a / 21 == 12);
  }
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(curve[7 * k], square[k]);
}

// Against Floyd's distances on a bumpy mesh.
TEST(Curve, PathsAreAsShortAsCanBe) {
  const auto core = make_core(torus(9, 7));
  const std::size_t n = 63;
  std::vector<std::vector<double>> d(n, std::vector<double>(n, 1e300));
  const auto edge = [&](std::size_t a, std::size_t b) {
    return norm(core->mesh.positions[a] - core->mesh.positions[b]);
  };
  for (std::int32_t e = 0; e < core->topology().edge_count(); ++e) {
    const std::size_t a = static_cast<std::size_t>(core->topology().first(e)),
                      b = static_cast<std::size_t>(core->topology().second(e));
    d[a][b] = d[b][a] = edge(a, b);
  }
  for (std::size_t v = 0; v < n; ++v) d[v][v] = 0;
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) d[a][b] = std::min(d[a][b], d[a][k] + d[k][b]);
  for (const Numbers& points : {Numbers{0, 20, 41}, Numbers{3, 55, 8, 30, 17}, Numbers{62, 1, 33}}) {
    const Numbers curve = curve_on(*core, points);
    double length = 0, least = 0;
    for (std::size_t i = 0; i < curve.size(); ++i)
      length += edge(static_cast<std::size_t>(curve[i]), static_cast<std::size_t>(curve[(i + 1) % curve.size()]));
    for (std::size_t i = 0; i < points.size(); ++i)
      least += d[static_cast<std::size_t>(points[i])][static_cast<std::size_t>(points[(i + 1) % points.size()])];
    EXPECT_NEAR(length, least, 1e-12);
  }
}

TEST(Curve, EnclosesTheSideThatIsAskedFor) {
  const Sheet sheet;
  const Numbers inner = sheet.side(square, CurveSide::smaller);
  EXPECT_EQ(inner.size(), 36u);
  for (const std::int32_t v : inner) EXPECT_TRUE(v % 21 > 5 && v % 21 < 12 && v / 21 > 5 && v / 21 < 12);
  EXPECT_EQ(sheet.side(square, CurveSide::larger).size(), 441u - 36u - 28u);
  EXPECT_EQ(sheet.side(square, CurveSide::seed, place(8, 8)), inner);
  EXPECT_EQ(sheet.side(square, CurveSide::seed, place(0, 0)), sheet.side(square, CurveSide::larger));
}

// A curve through a border cuts as well, and one that is a border has one side only.
TEST(Curve, MayUseBorders) {
  const Sheet sheet;
  const Numbers half{place(0, 0), place(10, 0), place(10, 20), place(0, 20)};
  EXPECT_EQ(sheet.side(half, CurveSide::smaller).size(), 9u * 19u);
  const Numbers border{place(0, 0), place(20, 0), place(20, 20), place(0, 20)};
  for (const CurveSide which : {CurveSide::smaller, CurveSide::larger})
    EXPECT_EQ(sheet.side(border, which).size(), 19u * 19u);
  const Numbers part{place(1, 0), place(3, 0), place(2, 0)};
  index_of_failure(HF_ERROR_INVALID_ARGUMENT, [&] { sheet.side(part, CurveSide::smaller); });
}

TEST(Curve, ThatDoesNotSeparateIsRefused) {
  const Sheet sheet;
  for (const Numbers& points :
       {Numbers{place(3, 3), place(9, 3), place(6, 3)}, Numbers{place(3, 3), place(3, 3), place(3, 3)}})
    index_of_failure(HF_ERROR_INVALID_ARGUMENT, [&] { sheet.side(points, CurveSide::smaller); });
  // a meridian of a torus
  const auto surface = surface_of(make_core(torus(12, 9, 0)));
  Region region(surface);
  const Numbers meridian{0, 3, 6};
  std::vector<mesh::CurvePoint> points;
  for (const std::int32_t v : meridian) points.push_back(mesh::at_vertex(v));
  for (const CurveKind kind : {CurveKind::straight, CurveKind::edges}) {
    RegionEdit edit;
    edit.curve = points;
    edit.kind = kind;
    index_of_failure(HF_ERROR_INVALID_ARGUMENT, [&] { region.edit(edit); });
  }
  EXPECT_TRUE(region.state()->shape->inside.empty());
}

TEST(Curve, ThatCrossesItselfIsRefusedWithThePointBeforeTheCrossing) {
  const Sheet sheet;
  // an eight: the path after point 2 crosses the path after point 0
  const Numbers eight{place(5, 5), place(12, 12), place(12, 5), place(5, 12)};
  EXPECT_EQ(index_of_failure(HF_ERROR_INVALID_ARGUMENT, [&] { sheet.curve(eight); }), 2u);
  // two loops through one vertex: both left round, they touch; one left and one right round, they cross
  const Numbers touch{place(10, 10), place(10, 15), place(5, 15), place(5, 10),
                      place(10, 10), place(10, 5),  place(15, 5), place(15, 10)};
  EXPECT_EQ(sheet.side(touch, CurveSide::seed, place(7, 12)).size(), 16u);
  const Numbers cross{place(10, 10), place(10, 15), place(5, 15), place(5, 10),
                      place(10, 10), place(15, 10), place(15, 5), place(10, 5)};
  EXPECT_EQ(index_of_failure(HF_ERROR_INVALID_ARGUMENT, [&] { sheet.curve(cross); }), 4u);
  // a star of nine loops through one vertex
  Numbers star;
  for (std::int32_t i = 0; i < 9; ++i)
    star.insert(star.end(), {place(10, 10), place(2 * i + 1, 3), place(2 * i + 2, 3)});
  index_of_failure(HF_ERROR_INVALID_ARGUMENT, [&] { sheet.curve(star); });
}

// How often the curve runs round the middle of each triangle of a grid in the plane.
std::pair<int, int> windings(const PlainMesh& plane, const Numbers& curve) {
  std::pair<int, int> range{0, 0};
  for (std::size_t t = 0; t < plane.triangles.size() / 3; ++t) {
    double x = 0, y = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      x += plane.triangles[3 * t + k] % 21 / 3.0;
      y += plane.triangles[3 * t + k] / 21 / 3.0;
    }
    int turns = 0;
    for (std::size_t i = 0; i < curve.size(); ++i) {
      const double ax = curve[i] % 21, ay = curve[i] / 21;
      const double bx = curve[(i + 1) % curve.size()] % 21, by = curve[(i + 1) % curve.size()] / 21;
      if ((ay > y) == (by > y)) continue;
      if (ax + (y - ay) / (by - ay) * (bx - ax) > x) turns += by > ay ? 1 : -1;
    }
    range.first = std::min(range.first, turns);
    range.second = std::max(range.second, turns);
  }
  return range;
}

// In the plane, a closed curve crosses itself exactly if its winding numbers are not only 0 and 1 or 0 and -1: the four
// sides of a crossing have three of them. No side of this test knows of fans and runs. Triangles may be turned.
TEST(Curve, CrossesItselfExactlyWhereWindingNumbersSaySo) {
  PlainMesh plane = grid(20, 20);
  std::uint32_t state = 7;
  const auto draw = [&state](std::uint32_t below) {
    state = state * 1664525u + 1013904223u;
    return static_cast<std::int32_t>((state >> 8) % below);
  };
  int refused = 0, taken = 0;
  for (const bool turned : {false, true}) {
    if (turned) {
      for (std::size_t t = 0; t < plane.triangles.size() / 3; ++t)
        if (draw(2)) std::swap(plane.triangles[3 * t], plane.triangles[3 * t + 1]);
    }
    const auto core = make_core(plane);
    for (int round = 0; round < 1000; ++round) {
      // few places, so that paths share vertices and borders
      const std::int32_t wide = round % 2 ? 21 : 6;
      Numbers points(static_cast<std::size_t>(3 + draw(5)));
      for (std::int32_t& p : points)
        p = place(draw(static_cast<std::uint32_t>(wide)), draw(static_cast<std::uint32_t>(wide)));
      const ClosedCurve curve = closed_curve(*core, {points.data(), points.size()}, *core->memory);
      // where three strands meet, the sides of a crossing can have no width
      Numbers sorted = numbers(curve.vertices);
      std::sort(sorted.begin(), sorted.end());
      bool thrice = false;
      for (std::size_t i = 2; i < sorted.size(); ++i) thrice |= sorted[i] == sorted[i - 2];
      if (thrice) continue;
      const auto range = windings(plane, numbers(curve.vertices));
      const bool crosses = range.second - range.first > 1;
      try {
        require_no_crossing(*core, curve, *core->memory);
        ++taken;
        EXPECT_FALSE(crosses) << "round " << round << ", turned " << turned;
      } catch (const Error& error) {
        EXPECT_LT(error.index(), points.size());
        ++refused;
        EXPECT_TRUE(crosses) << "round " << round << ", turned " << turned << ": " << error.what();
      }
    }
  }
  EXPECT_GT(refused, 300);
  EXPECT_GT(taken, 300);
}

TEST(Curve, SeedsOnItOrElsewhereAreNamed) {
  PlainMesh mesh = grid(20, 20);
  append(mesh, grid(2, 2), 50);
  const auto core = make_core(mesh);
  const Numbers curve = curve_on(*core, square);
  const auto with_seed = [&](std::int32_t seed) {
    return index_of_failure(HF_ERROR_INVALID_ARGUMENT, [&] {
      curve_side(*core, {curve.data(), curve.size()}, CurveSide::seed, seed, *core->memory);
    });
  };
  EXPECT_EQ(with_seed(place(8, 5)), static_cast<std::uint32_t>(place(8, 5)));
  EXPECT_EQ(with_seed(445), 445u);
}

template <class Work>
void expect_error(hf_result code, std::uint32_t index, Work&& work) {
  try {
    work();
    ADD_FAILURE() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code);
    EXPECT_EQ(error.index(), index);
  }
}

TEST(Curve, APointStandsForTheCornerOfItsLargestWeight) {
  const double weights[3][3] = {{0.5, 0.3, 0.2}, {0.2, 0.5, 0.3}, {0.3, 0.2, 0.5}};
  const std::int32_t corners[3] = {4, 6, 9};
  for (int k = 0; k < 3; ++k)
    EXPECT_EQ(mesh::nearest_corner(mesh::CurvePoint{{4, 6, 9}, {weights[k][0], weights[k][1], weights[k][2]}}),
              corners[k]);
}

TEST(Curve, PointsOfTwoComponentsAreRefused) {
  PlainMesh two = grid(4, 4);
  append(two, grid(4, 4), 10);
  const auto core = make_core(two);
  const std::int32_t second = core->mesh.inner_of_given[25];
  const auto points = [](const Numbers& vertices) {
    std::vector<mesh::CurvePoint> list;
    for (const std::int32_t v : vertices) list.push_back(mesh::at_vertex(v));
    return list;
  };
  mesh::require_one_component(core->mesh, points({0, 1, 2}));
  expect_error(HF_ERROR_INVALID_ARGUMENT, 2, [&] { mesh::require_one_component(core->mesh, points({0, 1, second})); });
}

TEST(Region, PositionsAreTheCallersOrTheMeshs) {
  const PlainMesh mesh = grid(3, 3);
  const auto core = make_core(mesh);
  const auto rest = positions_of(*core, {});
  std::vector<double> moved = mesh.positions;
  for (double& x : moved) x += 5;
  const auto given = positions_of(*core, ConstRows(moved.data(), 3 * sizeof(double)));
  ASSERT_EQ(rest.size(), 16u);
  for (std::size_t v = 0; v < rest.size(); ++v) {
    EXPECT_NEAR(rest[v].x, mesh.positions[3 * v], 1e-12);
    EXPECT_EQ(given[v].y, moved[3 * v + 1]);
  }
  moved[3 * 9 + 2] = std::nan("");
  expect_error(HF_ERROR_NON_FINITE, 9, [&] { positions_of(*core, ConstRows(moved.data(), 3 * sizeof(double))); });
}

}  // namespace

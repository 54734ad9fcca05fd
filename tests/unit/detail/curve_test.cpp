// Closed curves: shortest paths between their points, and the side that is meant.
#include "detail_support.h"

namespace {

using namespace hf_inner;
using namespace hf_test;

// A grid of 21 x 21 vertices, one unit apart.
std::int32_t place(std::int32_t i, std::int32_t j) { return 21 * j + i; }

struct Sheet {
  Sheet() : surface(surface_of(make_core(grid(20, 20)))) {}
  Numbers curve(const Numbers& points) const {
    return numbers(closed_curve(*surface->core, {points.data(), points.size()}, *surface->core->memory));
  }
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
  for (std::int32_t e = 0; e < core->topology.edge_count(); ++e) {
    const std::size_t a = static_cast<std::size_t>(core->topology.first(e)),
                      b = static_cast<std::size_t>(core->topology.second(e));
    d[a][b] = d[b][a] = edge(a, b);
  }
  for (std::size_t v = 0; v < n; ++v) d[v][v] = 0;
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) d[a][b] = std::min(d[a][b], d[a][k] + d[k][b]);
  for (const Numbers& points : {Numbers{0, 20, 41}, Numbers{3, 55, 8, 30, 17}, Numbers{62, 1, 33}}) {
    const Numbers curve = numbers(closed_curve(*core, {points.data(), points.size()}, *core->memory));
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
  RegionEdit edit;
  edit.curve = {meridian.data(), meridian.size()};
  index_of_failure(HF_ERROR_INVALID_ARGUMENT, [&] { region.edit(edit); });
  EXPECT_TRUE(region.state()->shape->inside.empty());
}

TEST(Curve, SeedsOnItOrElsewhereAreNamed) {
  PlainMesh mesh = grid(20, 20);
  append(mesh, grid(2, 2), 50);
  const auto core = make_core(mesh);
  const Numbers curve = numbers(closed_curve(*core, {square.data(), square.size()}, *core->memory));
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
  const Sheet sheet;
  const Mesh& mesh = sheet.surface->core->mesh;
  const double weights[3][3] = {{0.5, 0.3, 0.2}, {0.2, 0.5, 0.3}, {0.3, 0.2, 0.5}};
  for (int k = 0; k < 3; ++k)
    EXPECT_EQ(nearest_corner(mesh, 7, weights[k], 0), mesh.triangle(mesh.triangle_of_given[7])[k]);
  const double rounded[3] = {0.2f, 0.3f, 0.5f};  // floats do not sum to 1 exactly
  EXPECT_EQ(nearest_corner(mesh, 7, rounded, 0), mesh.triangle(mesh.triangle_of_given[7])[2]);
}

TEST(Curve, BadPointsAreRefusedWithTheirPosition) {
  const Sheet sheet;
  const Mesh& mesh = sheet.surface->core->mesh;
  const auto refused = [&](hf_result code, std::uint32_t triangle, double a, double b, double c) {
    const double weights[3] = {a, b, c};
    expect_error(code, 5, [&] { nearest_corner(mesh, triangle, weights, 5); });
  };
  refused(HF_ERROR_OUT_OF_RANGE, mesh.report.triangle_count, 1, 0, 0);
  refused(HF_ERROR_NON_FINITE, 0, 1, std::nan(""), 0);
  refused(HF_ERROR_INVALID_ARGUMENT, 0, 1.5, -0.5, 0);
  refused(HF_ERROR_INVALID_ARGUMENT, 0, 0.5, 0.5, 1e-5);
}

TEST(Curve, PointsOfTwoComponentsAreRefused) {
  PlainMesh two = grid(4, 4);
  append(two, grid(4, 4), 10);
  const auto core = make_core(two);
  const std::int32_t second = core->mesh.inner_of_given[25];
  const Numbers one{0, 1, 2}, mixed{0, 1, second};
  require_one_component(core->mesh, {one.data(), one.size()});
  expect_error(HF_ERROR_INVALID_ARGUMENT, 2, [&] { require_one_component(core->mesh, {mixed.data(), mixed.size()}); });
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

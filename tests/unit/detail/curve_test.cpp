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

}  // namespace

// Iso-lines and levels: no gaps, whatever the values; strips as even as promised.
#include "field/isolines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "analysis_support.h"
#include "base/error.h"
#include "field/certificate.h"
#include "field/levels.h"
#include "support/engines.h"
#include "support/full.h"

namespace {

using hf_inner::field::Isolines;
using hf_test::PlainMesh;

hf_inner::Memory& memory() {
  static hf_inner::Memory instance;
  return instance;
}

// What is on the mesh, for the checks.
struct Surface {
  explicit Surface(PlainMesh given) : plain(std::move(given)), core(hf_test::make_core(plain, 1, without_factor())) {
    for (int t = 0; t < core->mesh.triangle_count(); ++t) {
      const int* v = core->mesh.triangle(t);
      std::array<int, 3> corners{v[0], v[1], v[2]};
      std::sort(corners.begin(), corners.end());
      triangles.insert(corners);
      for (int k = 0; k < 3; ++k) edges.insert({v[k], v[(k + 1) % 3]});
    }
    for (int e = 0; e < core->topology().edge_count(); ++e) {
      const auto& start = core->topology().edge_triangle_start;
      const std::size_t i = static_cast<std::size_t>(e);
      if (start[i + 1] - start[i] == 1) border.insert({core->topology().first(e), core->topology().second(e)});
    }
  }
  static hf_inner::surface::CoreOptions without_factor() {
    hf_inner::surface::CoreOptions options;
    options.need_factor = false;
    return options;
  }
  // The ends of the edge that p is on; twice the vertex where it is at one.
  static std::array<int, 2> support(const Isolines::Point& p) { return {p.t == 1 ? p.b : p.a, p.t == 0 ? p.a : p.b}; }
  // Whether a straight step from p to q stays inside one triangle.
  bool step(const Isolines::Point& p, const Isolines::Point& q) const {
    const auto [a, b] = support(p);
    const auto [c, d] = support(q);
    std::array<int, 4> all{a, b, c, d};
    std::sort(all.begin(), all.end());
    const auto count = std::unique(all.begin(), all.end()) - all.begin();
    if (count == 3) return triangles.count({all[0], all[1], all[2]}) > 0;
    return count == 2 && (edges.count({all[0], all[1]}) || edges.count({all[1], all[0]}));
  }
  bool on_border(const Isolines::Point& p) const {
    const auto [a, b] = support(p);
    return std::any_of(border.begin(), border.end(), [a = a, b = b](const auto& e) {
      return (a == e.first || a == e.second) && (b == e.first || b == e.second);
    });
  }
  hf_inner::Vec3 place(const Isolines::Point& p) const {
    return (1 - p.t) * core->mesh.positions[static_cast<std::size_t>(p.a)] +
           p.t * core->mesh.positions[static_cast<std::size_t>(p.b)];
  }
  // Length of { u = c }, triangle by triangle, u = c counting as above.
  double length(const std::vector<double>& u, double c) const {
    double sum = 0;
    for (int t = 0; t < core->mesh.triangle_count(); ++t) {
      const int* v = core->mesh.triangle(t);
      hf_inner::Vec3 ends[3];
      int count = 0;
      for (int k = 0; k < 3; ++k) {
        const std::size_t a = static_cast<std::size_t>(v[k]), b = static_cast<std::size_t>(v[(k + 1) % 3]);
        if ((u[a] >= c) == (u[b] >= c)) continue;
        const double s = (c - u[a]) / (u[b] - u[a]);
        ends[count++] = (1 - s) * core->mesh.positions[a] + s * core->mesh.positions[b];
      }
      if (count == 2) sum += norm(ends[0] - ends[1]);
    }
    return sum;
  }

  PlainMesh plain;
  std::shared_ptr<const hf_inner::surface::Core> core;
  std::set<std::array<int, 3>> triangles;  // corners, ascending
  std::set<std::pair<int, int>> edges, border;
};

Isolines trace(const Surface& s, const std::vector<double>& field, const std::vector<double>& levels) {
  return hf_inner::field::trace_isolines(s.core->mesh, s.core->topology(), field, levels, memory());
}

// Every line is closed or ends at borders, steps inside triangles, and nothing is missing. Returns the lines seen.
std::size_t check_lines(const Surface& s, const std::vector<double>& u, const std::vector<double>& levels,
                        bool exact_length) {
  const Isolines lines = trace(s, u, levels);
  std::vector<double> length(levels.size(), 0.0);
  for (std::uint32_t l = 0; l < lines.line_count(); ++l) {
    const std::uint32_t begin = lines.start[l], end = lines.start[l + 1];
    const std::uint32_t steps = end - begin - (lines.closed[l] ? 0 : 1);
    for (std::uint32_t i = 0; i < steps; ++i) {
      const auto &p = lines.points[begin + i], &q = lines.points[begin + (i + 1) % (end - begin)];
      if (!s.step(p, q)) {
        ADD_FAILURE() << "level " << levels[lines.level[l]] << ": step " << i << " leaves the triangles";
        return 0;
      }
      length[lines.level[l]] += norm(s.place(p) - s.place(q));
    }
    if (!lines.closed[l] && !(s.on_border(lines.points[begin]) && s.on_border(lines.points[end - 1]))) {
      ADD_FAILURE() << "level " << levels[lines.level[l]] << ": an open line ends inside";
      return 0;
    }
  }
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const double whole = s.length(u, levels[k]);
    if (exact_length ? std::fabs(length[k] - whole) > 1e-12 * (1 + whole) : length[k] > whole + 1e-9) {
      ADD_FAILURE() << "level " << levels[k] << ": length " << length[k] << " of " << whole;
      return 0;
    }
  }
  return lines.line_count();
}

std::vector<double> levels_among(const std::vector<double>& field, std::size_t count, std::uint32_t seed) {
  std::mt19937_64 random(seed);
  std::vector<double> levels;
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint64_t r = random();
    levels.push_back(k % 2 ? field[r % field.size()] : static_cast<double>(r >> 11) * 0x1p-53);
  }
  return levels;
}

TEST(Isolines, have_no_gaps_at_random_levels_half_of_them_vertex_values) {
  const Surface surfaces[] = {Surface(hf_test::torus(14, 9)), Surface(hf_test::grid(12, 10, 1, 0.3, 4)),
                              Surface(hf_test::from_shape(samples::sphere(4)))};
  std::size_t lines = 0;
  const std::uint32_t parts = hf_test::is_full() ? 34 : 8;
  for (const Surface& s : surfaces) {
    for (std::uint32_t part = 0; part < parts; ++part) {
      // smooth fields have long lines, random ones many short ones
      const std::vector<double> noise = hf_test::random_field(s.plain, part);
      const std::vector<double> u = hf_test::field_of(s.plain, [&](double x, double y, double z) {
        return part % 2 ? 0.5 + 0.2 * std::sin(x + part) + 0.2 * y * 0.3 + 0.1 * std::cos(3 * z) : 0.0;
      });
      lines += check_lines(s, part % 2 ? u : noise, levels_among(part % 2 ? u : noise, 1000, part), true);
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(lines, 3000u * parts);
}

TEST(Isolines, have_no_gaps_on_flat_areas_and_at_repeated_values) {
  const Surface surfaces[] = {Surface(hf_test::torus(14, 9)), Surface(hf_test::grid(12, 10, 1, 0.3, 4))};
  for (const Surface& s : surfaces) {
    for (std::uint32_t part = 0; part < 200; ++part) {
      std::vector<double> u = hf_test::random_field(s.plain, part);
      for (double& value : u) value = std::floor(value * (2 + part % 5));
      check_lines(s, u, {0, 0.5, 1, 1.5, 2, 3, 4, 5}, false);
      if (HasFailure()) return;
    }
  }
}

TEST(Isolines, of_a_height_on_a_sphere_are_one_circle_each_with_higher_values_on_the_left) {
  const Surface s(hf_test::from_shape(samples::sphere(12)));
  const auto u = hf_test::field_of(s.plain, [](double, double y, double) { return y; });
  const std::vector<double> levels{-0.5, 0.0, 0.7};
  const Isolines lines = trace(s, u, levels);
  ASSERT_EQ(lines.line_count(), 3u);
  for (std::uint32_t l = 0; l < 3; ++l) {
    EXPECT_EQ(lines.level[l], l);
    EXPECT_TRUE(lines.closed[l]);
    double turn = 0;
    for (std::uint32_t i = lines.start[l]; i < lines.start[l + 1]; ++i) {
      const hf_inner::Vec3 p = s.core->mesh.to_given(s.place(lines.points[i]));
      const hf_inner::Vec3 q =
          s.core->mesh.to_given(s.place(lines.points[i + 1 < lines.start[l + 1] ? i + 1 : lines.start[l]]));
      EXPECT_NEAR(p.y, levels[l], 1e-12);
      EXPECT_NEAR(norm(p), 1, 0.01);
      turn += std::atan2(p.z * q.x - p.x * q.z, p.x * q.x + p.z * q.z);  // about +y
    }
    EXPECT_NEAR(turn, 8 * std::atan(1.0), 1e-9);  // counter-clockwise from above: up is on the left
  }
}

TEST(Isolines, end_where_the_field_has_no_value_and_at_odd_non_manifold_triangles) {
  // three pages on one edge: the field rises across each of them
  PlainMesh pages;
  pages.positions = {0, 0, 0, 0, 0, 1, 1, 0, 0, -1, 1, 0, -1, -1, 0};
  pages.triangles = {0, 1, 2, 1, 0, 3, 0, 1, 4};
  const Surface s(pages);
  const Isolines lines = trace(s, {0, 1, 0.2, 0.1, 0.3}, {0.5});
  ASSERT_EQ(lines.line_count(), 2u);  // two pages are one line, the third its own
  std::size_t points = 0;
  for (std::uint32_t l = 0; l < 2; ++l) points += lines.start[l + 1] - lines.start[l];
  EXPECT_EQ(points, 5u);

  const Surface flat(hf_test::grid(6, 6));
  auto u = hf_test::field_of(flat.plain, [](double x, double, double) { return x; });
  u[24] = std::numeric_limits<double>::quiet_NaN();  // in the middle
  const Isolines cut = trace(flat, u, {2.5});
  ASSERT_EQ(cut.line_count(), 2u);
  for (const auto& p : cut.points) EXPECT_TRUE(p.a != 24 && p.b != 24);
}

TEST(Isolines, join_the_same_pages_of_an_edge_in_every_order_of_the_faces) {
  PlainMesh pages;  // four pages on one edge, at uneven angles; the field rises across each
  pages.positions = {0, 0, 0, 0, 0, 1, 1, 0.1, 0, 0.2, 1, 0, -1, 0.3, 0, -0.3, -1, 0};
  const std::vector<std::array<std::uint32_t, 3>> page = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {1, 0, 5}};
  const std::vector<double> field = {0, 1, 0.2, 0.1, 0.3, 0.25};
  std::set<std::set<std::set<std::int32_t>>> joined;  // by order: the vertices at each of the two lines
  std::vector<std::size_t> order = {0, 1, 2, 3};
  do {
    pages.triangles.clear();
    for (const std::size_t i : order) pages.triangles.insert(pages.triangles.end(), page[i].begin(), page[i].end());
    const Isolines lines = trace(Surface(pages), field, {0.5});
    ASSERT_EQ(lines.line_count(), 2u);
    std::set<std::set<std::int32_t>> pairs;
    for (std::uint32_t l = 0; l < 2; ++l) {
      std::set<std::int32_t> ends;
      for (std::uint32_t i = lines.start[l]; i < lines.start[l + 1]; ++i)
        ends.insert({lines.points[i].a, lines.points[i].b});
      pairs.insert(ends);
    }
    joined.insert(pairs);
  } while (std::next_permutation(order.begin(), order.end()));
  EXPECT_EQ(joined.size(), 1u);
}

TEST(Isolines, come_in_the_order_of_the_list_and_repeats_give_repeats) {
  const Surface s(hf_test::grid(8, 8));
  const auto u = hf_test::field_of(s.plain, [](double x, double, double) { return x; });
  const Isolines lines = trace(s, u, {6.5, 1.5, 6.5, 99, 0, 8});
  ASSERT_EQ(lines.line_count(), 4u);  // 0 is the minimum: nothing lies below
  const std::uint32_t order[] = {0, 1, 2, 5};
  for (std::uint32_t l = 0; l < 4; ++l) EXPECT_EQ(lines.level[l], order[l]);
}

// ---- levels

std::vector<double> space(const Surface& s, const std::vector<double>& u, hf_inner::field::LevelSpacing spacing,
                          std::size_t count) {
  std::vector<double> levels(count);
  hf_inner::field::space_levels(s.core->mesh, u, spacing, levels, memory());
  return levels;
}

// Area of { u < c } by cutting every triangle.
double area_below(const Surface& s, const std::vector<double>& u, double c) {
  double sum = 0;
  for (int t = 0; t < s.core->mesh.triangle_count(); ++t) {
    const int* v = s.core->mesh.triangle(t);
    std::vector<hf_inner::Vec3> kept;
    for (int k = 0; k < 3; ++k) {
      const std::size_t a = static_cast<std::size_t>(v[k]), b = static_cast<std::size_t>(v[(k + 1) % 3]);
      const hf_inner::Vec3 p = s.core->mesh.positions[a], q = s.core->mesh.positions[b];
      if (u[a] < c) kept.push_back(p);
      if ((u[a] < c) != (u[b] < c)) kept.push_back(p + ((c - u[a]) / (u[b] - u[a])) * (q - p));
    }
    for (std::size_t i = 2; i < kept.size(); ++i) sum += 0.5 * norm(cross(kept[i - 1] - kept[0], kept[i] - kept[0]));
  }
  return sum;
}

TEST(Levels, of_equal_area_cut_the_surface_into_strips_of_the_same_area) {
  const Surface s(hf_test::torus(40, 20));
  for (std::uint32_t seed = 0; seed < 3; ++seed) {
    const auto u = seed ? hf_test::random_field(s.plain, seed)
                        : hf_test::field_of(s.plain, [](double x, double y, double) { return std::exp(x) + y; });
    const auto levels = space(s, u, hf_inner::field::LevelSpacing::area, 9);
    const double whole = area_below(s, u, 1e300);
    for (std::size_t k = 0; k < 9; ++k)
      EXPECT_NEAR(area_below(s, u, levels[k]), whole * static_cast<double>(k + 1) / 10, 1e-12 * whole);
  }
}

TEST(Levels, of_equal_value_divide_the_range) {
  const Surface s(hf_test::grid(5, 5));
  const auto u = hf_test::field_of(s.plain, [](double x, double, double) { return 3 + 2 * x; });
  const auto levels = space(s, u, hf_inner::field::LevelSpacing::value, 4);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(levels[k], 3 + 2 * static_cast<double>(k + 1), 1e-13);
}

TEST(Levels, of_equal_length_are_evenly_spaced_rings_whatever_the_values) {
  const Surface tube(hf_test::tube(24, 60, 5));
  for (const double power : {1.0, 4.0, 0.25}) {
    const auto u =
        hf_test::field_of(tube.plain, [&](double, double, double z) { return std::pow(z / 5 + 1e-3, power); });
    const auto levels = space(tube, u, hf_inner::field::LevelSpacing::length, 9);
    // the field is linear between the rings: compare with the height at which it takes the level
    for (std::size_t k = 0; k < 9; ++k) {
      std::uint32_t ring = 0;
      while (u[24 * (ring + 1)] < levels[k]) ++ring;
      const double low = u[24 * ring], high = u[24 * (ring + 1)];
      const double z = 5 * (ring + (levels[k] - low) / (high - low)) / 60;
      EXPECT_NEAR(z, 0.5 * static_cast<double>(k + 1), 0.02) << "power " << power;
    }
  }
  const Surface ball(hf_test::from_shape(samples::sphere(40)));
  const auto height = hf_test::field_of(ball.plain, [](double, double y, double) { return y; });
  const auto levels = space(ball, height, hf_inner::field::LevelSpacing::length, 7);
  const double pi = 4 * std::atan(1.0);
  for (std::size_t k = 0; k < 7; ++k) EXPECT_NEAR(std::acos(-levels[k]), pi * static_cast<double>(k + 1) / 8, 0.01);
}

TEST(Levels, of_equal_length_pass_over_what_is_constant) {
  // other components at the ends of the range, one of them with rounding errors on it: no lines there, no levels either
  const Surface tube(hf_test::tube(24, 60, 5));
  auto u = hf_test::field_of(tube.plain, [](double, double, double z) { return z; });
  const auto alone = space(tube, u, hf_inner::field::LevelSpacing::length, 9);
  PlainMesh more = tube.plain;
  for (const double value : {0.0, 5.0, 2.0}) {
    const PlainMesh ball = hf_test::from_shape(samples::sphere(30));
    append(more, ball, 40 + 4 * value);
    for (std::uint32_t v = 0; v < ball.vertex_count(); ++v)
      u.push_back(std::min(5.0, std::max(0.0, value + 1e-15 * (v % 7))));
  }
  const auto levels = space(Surface(more), u, hf_inner::field::LevelSpacing::length, 9);
  for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(levels[k], alone[k], 0.02);
}

TEST(Levels, of_a_constant_field_are_refused) {
  const Surface s(hf_test::grid(3, 3));
  EXPECT_THROW(space(s, std::vector<double>(16, 2.0), hf_inner::field::LevelSpacing::area, 3), hf_inner::Error);
  EXPECT_THROW(space(s, std::vector<double>(16, std::nan("")), hf_inner::field::LevelSpacing::value, 3),
               hf_inner::Error);
}

TEST(Isolines, PointsLieOnTheirEdgesInTheUnitOfTheMesh) {
  const Surface surface(hf_test::grid(4, 4, 3.0));
  const hf_inner::mesh::Mesh& mesh = surface.core->mesh;
  const std::int32_t a = mesh.inner_of_given[1], b = mesh.inner_of_given[2];
  for (const double t : {0.0, 0.25, 1.0}) {
    const hf_inner::Vec3 p = hf_inner::field::position_of(mesh, hf_inner::field::Isolines::Point{a, b, t});
    EXPECT_NEAR(p.x, 3 + 3 * t, 1e-12);
    EXPECT_NEAR(p.y, 0, 1e-12);
  }
}

TEST(Certificate, ToleranceIsTheOneAskedForOrTheEngines) {
  using hf_inner::field::certificate_tolerance;
  const auto core = hf_test::make_core(hf_test::torus(12, 8));
  const auto green = hf_inner::solve::SiteSolver::make(core);
  EXPECT_EQ(certificate_tolerance(0.25, *green), 0.25);
  EXPECT_EQ(certificate_tolerance(0, *green), 1e-8);
#ifdef HF_WITH_GPL
  const auto updown = hf_inner::peers::make_updown_solver(core, 1e8);
  EXPECT_EQ(certificate_tolerance(0.25, *updown), 0.25);
  EXPECT_EQ(certificate_tolerance(0, *updown), 1e-5);
#endif
  for (const double bad : {-1.0, HUGE_VAL, std::nan("")})
    EXPECT_THROW(certificate_tolerance(bad, *green), hf_inner::Error);
}

}  // namespace

// Nested dissection: quality against minimum degree and METIS, and graphs that leave it nothing to go by.
#include "factor/ordering.h"

#if defined(HF_WITH_GPL)
#include <amd.h>
#endif
#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <set>

#include "base/error.h"
#include "factor/factor.h"
#include "factor/leaf_order.h"
#include "factor/separator.h"
#include "factor/symbolic.h"
#include "unit/factor/matrices.h"

namespace {

using hf_test::Assembly;

class OrderingTest : public testing::Test {
 protected:
  hf_inner::Buffer<std::int32_t> order(const hf_inner::SymmetricMatrix& a, hf_inner::factor::Ordering kind,
                                       const std::vector<float>& points = {}, hf_inner::JobRunner* jobs = nullptr) {
    hf_inner::Buffer<std::int32_t> result;
    hf_inner::factor::make_order(a, {points.data(), points.size()}, kind, memory, jobs ? *jobs : one, result);
    std::vector<char> seen(static_cast<std::size_t>(a.size()), 0);
    EXPECT_EQ(result.size(), seen.size());
    for (const std::int32_t v : result) {
      EXPECT_TRUE(v >= 0 && v < a.size());
      EXPECT_FALSE(seen[static_cast<std::size_t>(v)]++) << "unknown " << v << " twice";
    }
    return result;
  }
  hf_inner::factor::FillEstimate fill(const hf_inner::SymmetricMatrix& a, hf_inner::factor::Ordering kind,
                                      const std::vector<float>& points = {}) {
    const hf_inner::Buffer<std::int32_t> result = order(a, kind, points);
    return hf_inner::factor::estimate_fill(a, {result.data(), result.size()}, memory);
  }
  // dissection is a permutation, the same for 1, 2 and 5 threads, and its fill is at most `factor` times minimum
  // degree's
  void expect_sound(const hf_inner::SymmetricMatrix& a, const std::vector<float>& points, double factor,
                    const char* what) {
    hf_inner::JobRunner two(2), five(5);
    const auto x = order(a, hf_inner::factor::Ordering::nested_dissection, points),
               y = order(a, hf_inner::factor::Ordering::nested_dissection, points, &two),
               z = order(a, hf_inner::factor::Ordering::nested_dissection, points, &five);
    EXPECT_TRUE(std::equal(x.begin(), x.end(), y.begin())) << what;
    EXPECT_TRUE(std::equal(x.begin(), x.end(), z.begin())) << what;
    const double own = hf_inner::factor::estimate_fill(a, {x.data(), x.size()}, memory).entries,
                 degree = fill(a, hf_inner::factor::Ordering::minimum_degree).entries;
    EXPECT_LE(own, factor * degree) << what << ": " << own << " against " << degree;
  }
  hf_inner::Memory memory;
  hf_inner::JobRunner one{1};
};

std::vector<float> floats(const std::vector<double>& x) { return {x.begin(), x.end()}; }

TEST_F(OrderingTest, fill_estimate_counts_the_entries_of_dense_elimination) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const hf_inner::SymmetricMatrix a = hf_test::random_matrix(memory, 40, 0.1, seed);
    const auto p = order(a, hf_inner::factor::Ordering::nested_dissection);
    std::vector<std::set<std::int32_t>> graph(40);
    for (std::int32_t j = 0; j < 40; ++j) {
      for (std::int32_t e = a.column_start[j]; e < a.column_start[j + 1]; ++e) {
        if (a.row[e] != j) graph[static_cast<std::size_t>(j)].insert(a.row[e]);
      }
    }
    double entries = 0, flops = 0;
    for (const std::int32_t v : p) {
      const std::set<std::int32_t> ring = graph[static_cast<std::size_t>(v)];
      const double count = static_cast<double>(ring.size()) + 1;
      entries += count;
      flops += count * count;
      for (const std::int32_t u : ring) {
        for (const std::int32_t w : ring) {
          if (u != w) graph[static_cast<std::size_t>(u)].insert(w);
        }
        graph[static_cast<std::size_t>(u)].erase(v);
      }
    }
    const hf_inner::factor::FillEstimate estimate = hf_inner::factor::estimate_fill(a, {p.data(), p.size()}, memory);
    EXPECT_EQ(estimate.entries, entries);
    EXPECT_EQ(estimate.flops, flops);
  }
}

// Exact minimum degree by sets: the fill that the approximation is measured by.
double exact_minimum_degree_entries(const hf_inner::SymmetricMatrix& a) {
  std::vector<std::set<std::int32_t>> graph(static_cast<std::size_t>(a.size()));
  for (std::int32_t j = 0; j < a.size(); ++j) {
    for (std::int32_t e = a.column_start[j]; e < a.column_start[j + 1]; ++e) {
      if (a.row[e] != j) graph[static_cast<std::size_t>(j)].insert(a.row[e]);
    }
  }
  std::set<std::size_t> left;
  for (std::size_t v = 0; v < graph.size(); ++v) left.insert(v);
  double entries = 0;
  while (!left.empty()) {
    std::size_t least = *left.begin();
    for (const std::size_t v : left) {
      if (graph[v].size() < graph[least].size()) least = v;
    }
    entries += static_cast<double>(graph[least].size()) + 1;
    for (const std::int32_t u : graph[least]) {
      std::set<std::int32_t>& ring = graph[static_cast<std::size_t>(u)];
      ring.insert(graph[least].begin(), graph[least].end());
      ring.erase(u);
      ring.erase(static_cast<std::int32_t>(least));
    }
    left.erase(least);
  }
  return entries;
}

TEST_F(OrderingTest, minimum_degree_fills_about_as_much_as_with_exact_degrees) {
  double own = 0, exact = 0;
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    const std::int32_t size = 20 + static_cast<std::int32_t>(seed) * 4;
    const hf_inner::SymmetricMatrix a = hf_test::random_matrix(memory, size, 4.0 / size, seed);
    own += fill(a, hf_inner::factor::Ordering::minimum_degree).entries;
    exact += exact_minimum_degree_entries(a);
  }
  EXPECT_LE(own, 1.03 * exact);
  const hf_inner::SymmetricMatrix grid = hf_test::grid_laplacian(memory, 24, 22);
  EXPECT_LE(fill(grid, hf_inner::factor::Ordering::minimum_degree).entries, 1.1 * exact_minimum_degree_entries(grid));
}

TEST_F(OrderingTest, minimum_degree_takes_graphs_of_every_shape) {
  // without fill: a path, a star (its centre is dense and comes last), islands, nothing at all
  EXPECT_EQ(fill(hf_test::grid_laplacian(memory, 5000, 1), hf_inner::factor::Ordering::minimum_degree).entries,
            2 * 5000 - 1);
  Assembly star(200000);
  for (std::int32_t k = 1; k < 200000; ++k) star.add_edge(0, k, 1.0);
  EXPECT_EQ(fill(star.build(memory), hf_inner::factor::Ordering::minimum_degree).entries, 2 * 200000 - 1);
  EXPECT_EQ(fill(Assembly(300).build(memory), hf_inner::factor::Ordering::minimum_degree).entries, 300);
  EXPECT_EQ(fill(Assembly(0).build(memory), hf_inner::factor::Ordering::minimum_degree).entries, 0);
  EXPECT_EQ(fill(hf_test::random_matrix(memory, 60, 1.0, 1), hf_inner::factor::Ordering::minimum_degree).entries,
            60 * 61 / 2);
  // hubs next to a tenth of all others
  Assembly hubs(20000);
  std::mt19937 random(3);
  const auto any = [&] { return static_cast<std::int32_t>(random() % 20000); };
  for (std::int32_t v = 0; v + 1 < 20000; ++v) hubs.add_edge(v, v + 1, 1.0);
  for (std::int32_t k = 0; k < 40000; ++k) hubs.add_edge(k % 20, 20 + any() % 19980, 1.0);
  order(hubs.build(memory), hf_inner::factor::Ordering::minimum_degree);
}

#if defined(HF_WITH_GPL)
TEST_F(OrderingTest, minimum_degree_fills_as_much_as_amd) {
  const hf_test::TriangleMesh mesh = hf_test::torus(200, 210, 0.25);
  const hf_inner::SymmetricMatrix a = hf_test::cotangent_matrix(memory, mesh), k = hf_test::squared(memory, a, 1.0),
                                  expander = hf_test::random_matrix(memory, 1500, 0.02, 1);
  for (const hf_inner::SymmetricMatrix* matrix : {&a, &k, &expander}) {
    std::vector<std::int32_t> amd(static_cast<std::size_t>(matrix->size()));
    ASSERT_GE(amd_order(matrix->size(), matrix->column_start.data(), matrix->row.data(), amd.data(), nullptr, nullptr),
              0);
    const double theirs = hf_inner::factor::estimate_fill(*matrix, {amd.data(), amd.size()}, memory).entries;
    EXPECT_LE(fill(*matrix, hf_inner::factor::Ordering::minimum_degree).entries, 1.02 * theirs) << matrix->size();
  }
}
#endif

TEST_F(OrderingTest, surfaces_fill_less_than_minimum_degree_and_about_as_much_as_metis) {
  const hf_test::TriangleMesh mesh = hf_test::torus(200, 210, 0.25);
  const hf_inner::SymmetricMatrix a = hf_test::cotangent_matrix(memory, mesh);
  expect_sound(a, floats(mesh.points), 0.95, "torus");
  const hf_inner::SymmetricMatrix k = hf_test::squared(memory, a, 1.0);
  expect_sound(k, floats(mesh.points), 1.0, "torus, two rings");
#if defined(HF_WITH_GPL)
  const hf_inner::factor::FillEstimate own =
                                           fill(a, hf_inner::factor::Ordering::nested_dissection, floats(mesh.points)),
                                       metis = fill(a, hf_inner::factor::Ordering::metis);
  EXPECT_LE(own.entries, 1.12 * metis.entries);
  EXPECT_LE(own.flops, 1.25 * metis.flops);
#endif
}

TEST_F(OrderingTest, no_coordinates_and_worthless_coordinates_are_no_catastrophe) {
  const hf_test::TriangleMesh mesh = hf_test::torus(120, 100, 0.25);
  const hf_inner::SymmetricMatrix a = hf_test::cotangent_matrix(memory, mesh);
  const std::size_t count = mesh.points.size();
  expect_sound(a, {}, 1.35, "no coordinates");
  expect_sound(a, std::vector<float>(count, 3.0f), 1.35, "all points equal");
  expect_sound(a, std::vector<float>(count, 1e38f), 1.35, "huge equal points");
  std::vector<float> random_points(count), line(count, 0.0f), bad(count, std::numeric_limits<float>::quiet_NaN());
  std::mt19937 random(1);
  for (float& x : random_points) x = static_cast<float>(random());
  for (std::size_t i = 0; i < count; i += 3) line[i] = static_cast<float>(mesh.points[i]);
  expect_sound(a, line, 1.35, "points on a line");
  expect_sound(a, bad, 1.35, "points not a number");
  expect_sound(a, random_points, 4.0, "points at random");  // caught by the guard of Factor::make
}

TEST_F(OrderingTest, islands_strips_stars_and_cliques_are_ordered) {
  Assembly islands(6000);
  for (std::int32_t c = 0; c < 1000; ++c) {
    for (std::int32_t k = 0; k < 6; ++k) islands.add_edge(6 * c + k, 6 * c + (k + 1) % 6, 1.0);
    islands.add(6 * c, 6 * c, 1.0);
  }
  expect_sound(islands.build(memory), {}, 1.35, "islands");
  Assembly points(3000);
  for (std::int32_t k = 0; k < 3000; ++k) points.add(k, k, 1.0);
  expect_sound(points.build(memory), {}, 1.0, "isolated unknowns");
  // in one dimension there is next to no fill, and balance costs a little of it
  expect_sound(hf_test::grid_laplacian(memory, 5000, 3), hf_test::grid_points(5000, 3), 1.75, "strip");
  expect_sound(hf_test::grid_laplacian(memory, 5000, 1), {}, 1.75, "path");
  expect_sound(hf_test::arrow_matrix(memory, 3000), {}, 1.35, "star");
  expect_sound(hf_test::random_matrix(memory, 500, 1.0, 1), {}, 1.0, "clique");
  expect_sound(hf_test::random_matrix(memory, 1500, 0.02, 1), {}, 1.35, "expander");
  // two components far apart in size, interleaved in space
  Assembly mixed(10100);
  for (std::int32_t k = 0; k + 1 < 10000; ++k) {
    if (k % 100 != 99) mixed.add_edge(k, k + 1, 1.0);
    if (k + 100 < 10000) mixed.add_edge(k, k + 100, 1.0);
  }
  for (std::int32_t k = 10000; k + 1 < 10100; ++k) mixed.add_edge(k, k + 1, 1.0);
  mixed.add(0, 0, 1.0);
  mixed.add(10000, 10000, 1.0);
  std::vector<float> place = hf_test::grid_points(100, 100);
  for (std::int32_t k = 0; k < 100; ++k)
    place.insert(place.end(), {static_cast<float>(k), static_cast<float>(k), 0.0f});
  expect_sound(mixed.build(memory), place, 1.35, "two components");
}

TEST_F(OrderingTest, a_graph_that_separates_badly_falls_back_on_minimum_degree) {
  const hf_test::TriangleMesh mesh = hf_test::torus(120, 100, 0.25);
  const hf_inner::SymmetricMatrix a = hf_test::cotangent_matrix(memory, mesh);
  std::vector<float> points(mesh.points.size());
  std::mt19937 random(1);
  for (float& x : points) x = static_cast<float>(random());
  hf_inner::factor::FactorOptions options;
  const auto guarded = hf_inner::factor::Factor::make(a, {points.data(), points.size()}, options, memory, one);
  EXPECT_LE(guarded->statistics().entries, 1.5 * fill(a, hf_inner::factor::Ordering::minimum_degree).entries);
}

#if defined(HF_WITH_GPL)
TEST_F(OrderingTest, metis_leaves_the_hosts_random_numbers_alone) {
  const hf_inner::SymmetricMatrix a = hf_test::grid_laplacian(memory, 60, 60);
  std::srand(42);
  std::vector<int> expected;
  for (int k = 0; k < 20; ++k) expected.push_back(std::rand());
  std::srand(42);
  for (int k = 0; k < 20; ++k) {
    EXPECT_EQ(std::rand(), expected[static_cast<std::size_t>(k)]);
    if (k % 5 == 2) order(a, hf_inner::factor::Ordering::metis);
  }
}
#endif

TEST_F(OrderingTest, the_minimum_separator_is_minimum) {
  // random small graphs: left and right ends fixed, the separator compared with exhaustive search
  std::mt19937 random(5);
  hf_inner::factor::SeparatorSearch search(memory);
  for (int round = 0; round < 300; ++round) {
    const std::int32_t n = 6 + static_cast<std::int32_t>(random() % 9);
    std::vector<std::vector<std::int32_t>> ring(static_cast<std::size_t>(n));
    for (std::int32_t i = 0; i < n; ++i) {
      for (std::int32_t j = 0; j < i; ++j) {
        const bool ends = (i == n - 1 && j == 0);
        if (!ends && random() % 100 < 35) {
          ring[static_cast<std::size_t>(i)].push_back(j);
          ring[static_cast<std::size_t>(j)].push_back(i);
        }
      }
    }
    std::vector<std::int32_t> start{0}, neighbour;
    for (auto& r : ring) {
      neighbour.insert(neighbour.end(), r.begin(), r.end());
      start.push_back(static_cast<std::int32_t>(neighbour.size()));
    }
    std::vector<std::uint8_t> side(static_cast<std::size_t>(n), hf_inner::factor::side_between);
    side.front() = hf_inner::factor::side_left;
    side.back() = hf_inner::factor::side_right;
    const hf_inner::factor::Cut cut = search.refine({n, start.data(), neighbour.data(), nullptr, nullptr}, side.data());
    std::int32_t best = n;
    for (std::uint32_t set = 0; set < 1u << (n - 2); ++set) {
      if (__builtin_popcount(set) >= best) continue;
      std::vector<char> seen(static_cast<std::size_t>(n), 0);
      std::vector<std::int32_t> stack{0};
      seen[0] = 1;
      while (!stack.empty()) {
        const std::int32_t v = stack.back();
        stack.pop_back();
        for (const std::int32_t u : ring[static_cast<std::size_t>(v)]) {
          if (seen[static_cast<std::size_t>(u)] || (u > 0 && u < n - 1 && (set >> (u - 1) & 1))) continue;
          seen[static_cast<std::size_t>(u)] = 1;
          stack.push_back(u);
        }
      }
      if (!seen[static_cast<std::size_t>(n - 1)]) best = __builtin_popcount(set);
    }
    ASSERT_EQ(cut.separator, best) << "round " << round;
    std::int32_t between = 0;
    for (std::int32_t v = 0; v < n; ++v) {
      between += side[static_cast<std::size_t>(v)] == hf_inner::factor::side_between;
      for (const std::int32_t u : ring[static_cast<std::size_t>(v)]) {
        ASSERT_FALSE(side[static_cast<std::size_t>(v)] == hf_inner::factor::side_left &&
                     side[static_cast<std::size_t>(u)] == hf_inner::factor::side_right)
            << "round " << round;
      }
    }
    ASSERT_EQ(between, cut.separator);
  }
}

// A grid graph whose places are flat, on a line, in one place, tiny, huge or no numbers is still cut in two.
TEST_F(OrderingTest, graphs_are_bisected_wherever_their_places_lie) {
  constexpr std::int32_t side_length = 18, n = side_length * side_length;
  std::vector<std::int32_t> start{0}, neighbour;
  for (std::int32_t v = 0; v < n; ++v) {
    const std::int32_t x = v % side_length, y = v / side_length;
    if (x > 0) neighbour.push_back(v - 1);
    if (x + 1 < side_length) neighbour.push_back(v + 1);
    if (y > 0) neighbour.push_back(v - side_length);
    if (y + 1 < side_length) neighbour.push_back(v + side_length);
    start.push_back(static_cast<std::int32_t>(neighbour.size()));
  }
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  const std::array<float, 3> scales[] = {{1, 1, 0},      {1, 0, 0},         {0, 0, 0},         {1e-30f, 1e-30f, 0},
                                         {1e-45f, 0, 0}, {1e36f, 1e36f, 0}, {1e36f, 1e-6f, 0}, {nan, nan, nan},
                                         {1, nan, 0},    {infinity, 1, 0}};
  hf_inner::factor::SeparatorSearch search(memory);
  for (const auto& scale : scales) {
    for (const bool thorough : {false, true}) {
      std::vector<float> point;
      for (std::int32_t v = 0; v < n; ++v) {
        const float x = static_cast<float>(v % side_length), y = static_cast<float>(v / side_length);
        point.insert(point.end(), {scale[0] * x, scale[1] * y, scale[2]});
      }
      std::vector<std::uint8_t> side(static_cast<std::size_t>(n), hf_inner::factor::side_between);
      const hf_inner::factor::GraphView graph{n, start.data(), neighbour.data(), point.data(), nullptr};
      const hf_inner::factor::Cut cut = search.bisect(graph, side.data(), thorough);
      EXPECT_TRUE(cut.usable()) << scale[0] << " " << scale[1];
      EXPECT_LE(cut.separator, side_length) << scale[0] << " " << scale[1];
      for (std::int32_t v = 0; v < n; ++v) {
        for (std::int32_t e = start[static_cast<std::size_t>(v)]; e < start[static_cast<std::size_t>(v) + 1]; ++e) {
          const std::int32_t u = neighbour[static_cast<std::size_t>(e)];
          ASSERT_FALSE(side[static_cast<std::size_t>(v)] == hf_inner::factor::side_left &&
                       side[static_cast<std::size_t>(u)] == hf_inner::factor::side_right);
        }
      }
    }
  }
}

}  // namespace

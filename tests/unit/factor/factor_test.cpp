// The factor against dense Cholesky and against residuals.
#include "factor/factor.h"

#include <gtest/gtest.h>

#include <cstring>
#include <Eigen/Dense>
#include <limits>
#include <thread>

#include "base/error.h"
#include "factor/supernodal_factor.h"
#include "support/dense.h"
#include "unit/factor/matrices.h"

namespace {

using hf_test::Assembly;

Eigen::MatrixXd dense(const hf_inner::SymmetricMatrix& a) {
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(a.size(), a.size());
  for (std::int32_t j = 0; j < a.size(); ++j) {
    for (std::int32_t e = a.column_start[j]; e < a.column_start[j + 1]; ++e) full(a.row[e], j) = a.value[e];
  }
  return full;
}

std::vector<double> random_vector(std::size_t size, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<double> x(size);
  for (double& v : x) v = unit(random);
  return x;
}

class Fixture : public testing::Test {
 protected:
  std::shared_ptr<const hf_inner::factor::Factor> make(
      const hf_inner::SymmetricMatrix& a,
      hf_inner::factor::Ordering ordering = hf_inner::factor::Ordering::minimum_degree,
      const std::vector<float>& points = {}) {
    hf_inner::factor::FactorOptions options;
    options.ordering = ordering;
    return hf_inner::factor::Factor::make(a, hf_inner::Span<const float>(points.data(), points.size()), options, memory,
                                          one);
  }
  std::vector<double> solve(const hf_inner::factor::Factor& factor, const std::vector<double>& b,
                            std::int32_t channels = 1, hf_inner::JobRunner* jobs = nullptr) {
    std::vector<double> z(b.size()), x(b.size());
    for (std::int32_t k = 0; k < factor.size(); ++k) {
      for (std::int32_t c = 0; c < channels; ++c) z[k * channels + c] = b[factor.order()[k] * channels + c];
    }
    factor.forward(z.data(), channels, jobs ? *jobs : one);
    factor.backward(z.data(), channels, jobs ? *jobs : one);
    for (std::int32_t k = 0; k < factor.size(); ++k) {
      for (std::int32_t c = 0; c < channels; ++c) x[factor.order()[k] * channels + c] = z[k * channels + c];
    }
    return x;
  }
  // sweeps and P against the dense factor: G^-1 and G^-T column by column
  void expect_factor_of(const hf_inner::SymmetricMatrix& a, hf_inner::factor::Ordering ordering) {
    const auto factor = make(a, ordering);
    const std::int32_t n = a.size();
    ASSERT_EQ(factor->size(), n);
    std::vector<char> seen(static_cast<std::size_t>(n), 0);
    Eigen::MatrixXd permuted(n, n);
    const Eigen::MatrixXd full = dense(a);
    for (std::int32_t k = 0; k < n; ++k) {
      const std::int32_t unknown = factor->order()[k];
      ASSERT_EQ(factor->position()[unknown], k);
      ASSERT_FALSE(seen[static_cast<std::size_t>(unknown)]++);
      for (std::int32_t l = 0; l < n; ++l) permuted(k, l) = full(unknown, factor->order()[l]);
    }
    Eigen::MatrixXd lower(n, n);
    hf_test::dense_cholesky(permuted.data(), n, lower.data());
    for (const std::int32_t channels : {1, 2, 3, 4, 5, 8, 11}) {
      std::vector<double> z = random_vector(static_cast<std::size_t>(n) * channels, 3);
      Eigen::MatrixXd right(n, channels);
      for (std::int32_t k = 0; k < n; ++k) {
        for (std::int32_t c = 0; c < channels; ++c) right(k, c) = z[k * channels + c];
      }
      std::vector<double> w = z;
      Eigen::MatrixXd forward = right, backward = right;
      hf_test::lower_solve(lower.data(), n, false, forward.data(), channels);
      hf_test::lower_solve(lower.data(), n, true, backward.data(), channels);
      factor->forward(z.data(), channels, one);
      factor->backward(w.data(), channels, one);
      // rounding of both: on the squared grid the two differ by 0.5 to 1.1e-12, by the order of elimination
      const double scale = 3e-12 * (1 + forward.cwiseAbs().maxCoeff() + backward.cwiseAbs().maxCoeff());
      for (std::int32_t k = 0; k < n; ++k) {
        for (std::int32_t c = 0; c < channels; ++c) {
          ASSERT_NEAR(z[k * channels + c], forward(k, c), scale)
              << "forward row " << k << " channel " << c << " of " << channels << " n " << n;
          ASSERT_NEAR(w[k * channels + c], backward(k, c), scale)
              << "backward row " << k << " channel " << c << " of " << channels << " n " << n;
        }
      }
    }
  }
  void expect_residual(const hf_inner::SymmetricMatrix& a, const hf_inner::factor::Factor& factor, double bound) {
    const std::vector<double> b = random_vector(static_cast<std::size_t>(a.size()), 5);
    const std::vector<double> x = solve(factor, b);
    const std::vector<double> ax = hf_test::multiply(a, x);
    double worst = 0, size = 0, diagonal = 0;
    for (std::size_t i = 0; i < b.size(); ++i) {
      worst = std::max(worst, std::abs(ax[i] - b[i]));
      size = std::max(size, std::abs(x[i]));
    }
    for (std::int32_t j = 0; j < a.size(); ++j) {
      for (std::int32_t e = a.column_start[j]; e < a.column_start[j + 1]; ++e)
        diagonal = std::max(diagonal, std::abs(a.value[e]));
    }
    EXPECT_LT(worst / (size * diagonal), bound);
  }

  hf_inner::Memory memory;
  hf_inner::JobRunner one{1};
  hf_inner::JobRunner two{2};
};

using FactorTest = Fixture;

TEST_F(FactorTest, sweeps_equal_dense_cholesky_on_random_patterns) {
  for (std::int32_t n = 1; n <= 60; n += (n < 20 ? 1 : 7)) {
    for (const double density : {0.0, 0.05, 0.2, 0.6, 1.0}) {
      for (const auto ordering : {hf_inner::factor::Ordering::minimum_degree, hf_inner::factor::Ordering::natural,
                                  hf_inner::factor::Ordering::nested_dissection}) {
        expect_factor_of(hf_test::random_matrix(memory, n, density, static_cast<std::uint32_t>(n)), ordering);
        if (HasFatalFailure()) return;
      }
    }
  }
}

TEST_F(FactorTest, sweeps_equal_dense_cholesky_on_grids_arrows_and_dense_blocks) {
  expect_factor_of(hf_test::grid_laplacian(memory, 20, 17), hf_inner::factor::Ordering::minimum_degree);
  expect_factor_of(hf_test::grid_laplacian(memory, 20, 17), hf_inner::factor::Ordering::natural);
  expect_factor_of(hf_test::grid_laplacian(memory, 300, 1), hf_inner::factor::Ordering::nested_dissection);
  expect_factor_of(hf_test::arrow_matrix(memory, 100), hf_inner::factor::Ordering::natural);
  expect_factor_of(hf_test::arrow_matrix(memory, 100), hf_inner::factor::Ordering::minimum_degree);
  expect_factor_of(hf_test::random_matrix(memory, 300, 1.0, 1),
                   hf_inner::factor::Ordering::natural);  // one supernode wider than a chunk
  expect_factor_of(hf_test::random_matrix(memory, 600, 0.5, 2), hf_inner::factor::Ordering::minimum_degree);
  expect_factor_of(hf_test::squared(memory, hf_test::grid_laplacian(memory, 16, 16), 1.0),
                   hf_inner::factor::Ordering::minimum_degree);
}

TEST_F(FactorTest, several_components_and_single_unknowns_are_solved) {
  Assembly a(70);
  for (std::int32_t c = 0; c < 10; ++c) {
    for (std::int32_t k = 0; k + 1 < 5; ++k) a.add_edge(c * 5 + k, c * 5 + k + 1, 1.0 + k);
    a.add(c * 5, c * 5, 1.0);
  }
  for (std::int32_t k = 50; k < 70; ++k) a.add(k, k, k);
  expect_factor_of(a.build(memory), hf_inner::factor::Ordering::minimum_degree);
  Assembly b(70);
  for (std::int32_t k = 0; k < 70; ++k) b.add(k, k, 1.0 + k);
  expect_factor_of(b.build(memory), hf_inner::factor::Ordering::nested_dissection);
}

TEST_F(FactorTest, commute_time_is_the_sum_of_the_diagonal_over_the_last_pivot) {
  for (const std::int32_t n : {1, 2, 7, 40}) {  // complete graphs: one supernode
    Assembly a(n);
    for (std::int32_t i = 0; i < n; ++i) {
      for (std::int32_t j = i + 1; j < n; ++j) a.add_edge(i, j, 1.0);
    }
    const double ground = 0.5, mean = 2.5;
    a.add(0, 0, ground);
    const auto factor = make(a.build(memory), hf_inner::factor::Ordering::natural);
    const double last = factor->order()[n - 1] == 0 ? ground : 1 / (2.0 / n + 1 / ground);  // conductance to the ground
    const std::vector<std::int32_t> component(static_cast<std::size_t>(n), 0);
    EXPECT_NEAR(factor->commute_time(component, {&mean, 1}) * last / (n * mean), 1, 1e-12) << n;
  }
}

TEST_F(FactorTest, unknowns_with_the_same_neighbours_are_ordered_as_one) {
  for (const std::int32_t side : {8, 20}) {
    double single = 0;
    for (const std::int32_t copies : {1, 2, 3}) {  // of each vertex of a grid, all joined
      Assembly a(side * side * copies);
      for (std::int32_t v = 0; v < side * side; ++v) {
        for (const std::int32_t u : {v, v % side + 1 < side ? v + 1 : -1, v + side < side * side ? v + side : -1}) {
          for (std::int32_t i = 0; u >= 0 && i < copies; ++i) {
            for (std::int32_t j = u == v ? i + 1 : 0; j < copies; ++j) a.add_edge(v * copies + i, u * copies + j, 1.0);
          }
        }
      }
      a.add(0, 0, 1.0);
      const double entries = make(a.build(memory))->statistics().entries;
      if (copies == 1) single = entries - side * side;
      EXPECT_EQ(entries, single * copies * copies + side * side * copies * (copies + 1) / 2) << side << " " << copies;
    }
  }
}

TEST_F(FactorTest, empty_matrix_is_a_factor_of_size_zero) {
  hf_inner::SymmetricMatrix a(memory);
  a.column_start.push_back(0);
  const auto factor = make(a);
  EXPECT_EQ(factor->size(), 0);
  factor->backward(nullptr, 1, two);
  factor->forward(nullptr, 1, two);
}

TEST_F(FactorTest, residual_of_a_large_grid_and_torus_is_rounding) {
  const hf_inner::SymmetricMatrix grid = hf_test::grid_laplacian(memory, 200, 150);
  for (const auto ordering :
       {hf_inner::factor::Ordering::minimum_degree, hf_inner::factor::Ordering::nested_dissection}) {
    expect_residual(grid, *make(grid, ordering, hf_test::grid_points(200, 150)), 1e-14);
  }
  const hf_inner::SymmetricMatrix ring = hf_test::cotangent_matrix(memory, hf_test::torus(120, 60, 0.25));
  expect_residual(ring, *make(ring), 1e-14);
  expect_residual(hf_test::squared(memory, ring, 1.0), *make(hf_test::squared(memory, ring, 1.0)), 1e-13);
}

TEST_F(FactorTest, factor_and_sweeps_are_the_same_bits_for_any_number_of_threads) {
  const hf_inner::SymmetricMatrix a = hf_test::cotangent_matrix(memory, hf_test::torus(200, 100, 0.25));
  for (const auto ordering :
       {hf_inner::factor::Ordering::minimum_degree, hf_inner::factor::Ordering::nested_dissection}) {
    hf_inner::factor::FactorOptions options;
    options.ordering = ordering;
    hf_inner::JobRunner five(5);
    const auto f1 = hf_inner::factor::Factor::make(a, {}, options, memory, one);
    for (hf_inner::JobRunner* jobs : {&two, &five}) {
      const auto f2 = hf_inner::factor::Factor::make(a, {}, options, memory, *jobs);
      const auto& v1 = static_cast<const hf_inner::factor::SupernodalFactor&>(*f1).values();
      const auto& v2 = static_cast<const hf_inner::factor::SupernodalFactor&>(*f2).values();
      ASSERT_EQ(v1.size(), v2.size());
      EXPECT_EQ(std::memcmp(v1.data(), v2.data(), v1.size() * sizeof(double)), 0);
      for (const std::int32_t channels : {1, 3, 8}) {
        const std::vector<double> b = random_vector(static_cast<std::size_t>(a.size()) * channels, 9);
        EXPECT_EQ(solve(*f1, b, channels, &one), solve(*f1, b, channels, jobs)) << channels;
      }
    }
  }
}

// A host that runs the jobs backwards, one after the other, on one thread.
void run_backwards(void* user, std::uint32_t count, void (*job)(void* data, std::uint32_t index), void* data) {
  ++*static_cast<int*>(user);
  for (std::uint32_t k = count; k-- > 0;) job(data, k);
}

TEST_F(FactorTest, a_host_that_runs_jobs_serially_and_backwards_gets_the_same_bits) {
  const hf_test::TriangleMesh mesh = hf_test::torus(160, 100, 0.25);
  const hf_inner::SymmetricMatrix a = hf_test::cotangent_matrix(memory, mesh);
  const std::vector<float> points(mesh.points.begin(), mesh.points.end());
  int batches = 0;
  hf_job_runner host{run_backwards, &batches};
  hf_inner::JobRunner jobs(4, host);
  hf_inner::factor::FactorOptions options;
  const hf_inner::Span<const float> coordinates(points.data(), points.size());
  const auto f = hf_inner::factor::Factor::make(a, coordinates, options, memory, one),
             g = hf_inner::factor::Factor::make(a, coordinates, options, memory, jobs);
  EXPECT_GT(batches, 3);
  const auto& v = static_cast<const hf_inner::factor::SupernodalFactor&>(*f).values();
  const auto& w = static_cast<const hf_inner::factor::SupernodalFactor&>(*g).values();
  ASSERT_EQ(v.size(), w.size());
  EXPECT_EQ(std::memcmp(v.data(), w.data(), v.size() * sizeof(double)), 0);
  const std::vector<double> b = random_vector(static_cast<std::size_t>(a.size()) * 3, 9);
  EXPECT_EQ(solve(*f, b, 3, &one), solve(*g, b, 3, &jobs));
}

TEST_F(FactorTest, clones_of_one_factor_sweep_on_many_threads_at_once) {
  const hf_inner::SymmetricMatrix a = hf_test::grid_laplacian(memory, 80, 70);
  const auto factor = make(a);
  const std::vector<double> b = random_vector(static_cast<std::size_t>(a.size()), 9), expected = solve(*factor, b);
  std::vector<std::thread> threads;
  std::vector<int> good(4, 0);
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      hf_inner::JobRunner own(1 + static_cast<std::uint32_t>(t) % 2);
      for (int round = 0; round < 5; ++round)
        good[static_cast<std::size_t>(t)] += solve(*factor, b, 1, &own) == expected;
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const int count : good) EXPECT_EQ(count, 5);
}

TEST_F(FactorTest, a_cancelled_factorisation_unwinds_and_frees_everything) {
  hf_inner::Memory counted;
  const hf_inner::SymmetricMatrix a = hf_test::grid_laplacian(memory, 60, 60);
  hf_inner::Progress progress;
  progress.cancel();
  hf_inner::factor::FactorOptions options;
  const hf_inner::CallProgress call(&progress);
  try {
    hf_inner::factor::Factor::make(a, {}, options, counted, two);
    FAIL() << "went on";
  } catch (const hf_inner::Error& error) {
    EXPECT_EQ(error.code(), HF_ERROR_CANCELLED);
  }
  EXPECT_EQ(counted.live_bytes(), 0u);
}

TEST_F(FactorTest, avx2_and_avx512_give_the_same_bits) {
  const hf_inner::factor::Kernels* narrow = hf_inner::factor::avx2_kernels();
  const hf_inner::factor::Kernels* wide = hf_inner::factor::avx512_kernels();
  if (!narrow || !wide) GTEST_SKIP() << "this processor has not both AVX2 and AVX-512";
  for (const bool bend : {false, true}) {
    hf_inner::SymmetricMatrix a = hf_test::cotangent_matrix(memory, hf_test::torus(100, 60, 0.25));
    if (bend) a = hf_test::squared(memory, a, 1.0);
    const auto made = make(a);
    const auto analysis = static_cast<const hf_inner::factor::SupernodalFactor&>(*made).analysis();
    hf_inner::factor::SupernodalFactor f(analysis, memory), g(analysis, memory), h(analysis, memory);
    f.use_kernels(*narrow);
    g.use_kernels(*wide);
    h.use_kernels(*hf_inner::factor::plain_kernels());
    f.compute(a, {}, hf_inner::factor::default_lost_share, one);
    g.compute(a, {}, hf_inner::factor::default_lost_share, one);
    h.compute(a, {}, hf_inner::factor::default_lost_share, one);
    ASSERT_EQ(std::memcmp(f.values().data(), g.values().data(), f.values().size() * sizeof(double)), 0);
    for (const std::int32_t channels : {1, 2, 3, 4, 8, 9}) {
      const std::vector<double> b = random_vector(static_cast<std::size_t>(a.size()) * channels, 9);
      const std::vector<double> x = solve(f, b, channels), y = solve(g, b, channels), p = solve(h, b, channels);
      EXPECT_EQ(x, y) << channels;
      double worst = 0, size = 0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        worst = std::max(worst, std::abs(x[i] - p[i]));
        size = std::max(size, std::abs(x[i]));
      }
      EXPECT_LT(worst, (bend ? 1e-7 : 1e-10) * size) << "plain kernels";
    }
  }
}

TEST_F(FactorTest, a_lost_pivot_names_the_callers_column) {
  hf_inner::SymmetricMatrix a = hf_test::grid_laplacian(memory, 30, 30);
  for (std::int32_t e = a.column_start[411]; e < a.column_start[412]; ++e) {
    if (a.row[e] == 411) a.value[e] = -5;
  }
  for (hf_inner::JobRunner* jobs : {&one, &two}) {
    try {
      hf_inner::factor::FactorOptions options;
      options.ordering = hf_inner::factor::Ordering::minimum_degree;
      hf_inner::factor::Factor::make(a, {}, options, memory, *jobs);
      FAIL() << "accepted an indefinite matrix";
    } catch (const hf_inner::Error& error) {
      EXPECT_EQ(error.code(), HF_ERROR_NOT_POSITIVE_DEFINITE);
      EXPECT_EQ(error.index(), 411u);
    }
  }
}

TEST_F(FactorTest, a_singular_laplacian_is_refused) {
  const hf_inner::SymmetricMatrix a = hf_test::grid_laplacian(memory, 30, 30, 0.0);
  try {
    make(a);
    FAIL() << "accepted a singular matrix";
  } catch (const hf_inner::Error& error) {
    EXPECT_EQ(error.code(), HF_ERROR_NOT_POSITIVE_DEFINITE);
  }
}

TEST_F(FactorTest, nan_and_infinity_name_their_column) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    hf_inner::SymmetricMatrix a = hf_test::grid_laplacian(memory, 10, 10);
    a.value[static_cast<std::size_t>(a.column_start[37])] = bad;
    try {
      make(a);
      FAIL() << "accepted " << bad;
    } catch (const hf_inner::Error& error) {
      EXPECT_EQ(error.code(), HF_ERROR_NON_FINITE);
      EXPECT_EQ(error.index(), 37u);
    }
  }
}

TEST_F(FactorTest, malformed_matrices_are_refused) {
  const auto code_of = [&](const hf_inner::SymmetricMatrix& a) {
    try {
      make(a);
    } catch (const hf_inner::Error& error) {
      return error.code();
    }
    return static_cast<hf_result>(HF_OK);
  };
  hf_inner::SymmetricMatrix a = hf_test::grid_laplacian(memory, 5, 5);
  a.row[3] = 99;
  EXPECT_EQ(code_of(a), HF_ERROR_INVALID_ARGUMENT);
  a = hf_test::grid_laplacian(memory, 5, 5);
  std::swap(a.row[0], a.row[1]);
  EXPECT_EQ(code_of(a), HF_ERROR_INVALID_ARGUMENT);
  a = hf_test::grid_laplacian(memory, 5, 5);
  a.column_start[3] = 1000;
  EXPECT_EQ(code_of(a), HF_ERROR_INVALID_ARGUMENT);
}

TEST_F(FactorTest, refactor_solves_the_matrix_with_eliminated_rows) {
  const hf_inner::SymmetricMatrix a = hf_test::grid_laplacian(memory, 25, 20, 0.0);
  const hf_inner::SymmetricMatrix grounded = hf_test::grid_laplacian(memory, 25, 20, 1.0);
  const auto factor = make(grounded);
  std::vector<std::uint8_t> eliminated(500, 0);
  for (const int v : {3, 77, 250, 499}) eliminated[static_cast<std::size_t>(v)] = 1;
  const auto reduced = factor->refactor(a, {eliminated.data(), eliminated.size()}, memory, two);
  hf_inner::SymmetricMatrix expected = a;
  for (std::int32_t j = 0; j < 500; ++j) {
    for (std::int32_t e = a.column_start[j]; e < a.column_start[j + 1]; ++e) {
      if (eliminated[static_cast<std::size_t>(j)] || eliminated[static_cast<std::size_t>(a.row[e])])
        expected.value[static_cast<std::size_t>(e)] = a.row[e] == j;
    }
  }
  expect_residual(expected, *reduced, 1e-14);
  EXPECT_THROW(factor->refactor(hf_test::grid_laplacian(memory, 20, 26), {}, memory, one), hf_inner::Error);
}

// Links add entries to a matrix; the ordering of the factor before stays.
TEST_F(FactorTest, refactor_takes_a_matrix_of_another_pattern) {
  const auto factor = make(hf_test::grid_laplacian(memory, 25, 20, 1.0));
  const hf_inner::SymmetricMatrix other = hf_test::grid_laplacian(memory, 20, 25, 1.0);
  const auto again = factor->refactor(other, {}, memory, two);
  expect_residual(other, *again, 1e-14);
  expect_residual(other, *again->refactor(other, {}, memory, one), 1e-14);
}

struct Batch {
  std::vector<std::int32_t> start{0}, row;
  std::vector<double> value;
  void add(std::initializer_list<std::pair<std::int32_t, double>> entries) {
    for (const auto& [r, v] : entries) {
      row.push_back(r);
      value.push_back(v);
    }
    start.push_back(static_cast<std::int32_t>(row.size()));
  }
  hf_inner::factor::SparseColumns view() const {
    return {{start.data(), start.size()}, {row.data(), row.size()}, {value.data(), value.size()}};
  }
};

TEST_F(FactorTest, paths_gram_combine_project_and_clear_equal_the_dense_forms) {
  const hf_inner::SymmetricMatrix a = hf_test::grid_laplacian(memory, 40, 35);
  const std::int32_t n = a.size();
  for (const auto ordering : {hf_inner::factor::Ordering::minimum_degree, hf_inner::factor::Ordering::natural}) {
    const auto factor = make(a, ordering);
    for (const std::int32_t k : {1, 2, 3, 7, 8, 9, 33, 70, 150}) {
      Batch batch;
      std::mt19937 random(static_cast<std::uint32_t>(k));
      for (std::int32_t i = 0; i < k; ++i) {
        const std::int32_t v = static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(n - 41));
        if (i % 3 == 0)
          batch.add({{v, 0.2}, {v + 1, 0.3}, {v + 41, 0.5}});
        else if (i % 7 == 1)
          batch.add({{v, 0.4}, {(v * 7 + 13) % n, 0.6}});  // two far rows
        else
          batch.add({{v, 1.0}});
      }
      Eigen::MatrixXd y = Eigen::MatrixXd::Zero(n, k);
      for (std::int32_t i = 0; i < k; ++i) {
        std::vector<double> z(static_cast<std::size_t>(n), 0.0);
        for (std::int32_t e = batch.start[i]; e < batch.start[i + 1]; ++e)
          z[static_cast<std::size_t>(factor->position()[batch.row[e]])] += batch.value[e];
        factor->forward(z.data(), 1, one);
        for (std::int32_t r = 0; r < n; ++r) y(r, i) = z[static_cast<std::size_t>(r)];
      }
      hf_inner::Vector<std::shared_ptr<const hf_inner::factor::PathGroup>> groups(&memory);
      std::vector<std::int32_t> group(static_cast<std::size_t>(k)), column(static_cast<std::size_t>(k));
      factor->solve_paths(batch.view(), memory, two, groups, {group.data(), group.size()},
                          {column.data(), column.size()});
      std::int32_t total = 0;
      for (const auto& g : groups) {
        total += g->count();
        ASSERT_LE(g->count(), hf_inner::factor::PathGroup::capacity);
      }
      ASSERT_EQ(total, k);
      const double scale = 1e-13 * (1 + y.cwiseAbs().maxCoeff());
      // combine with unit vectors gives back the columns
      for (std::int32_t i = 0; i < k; ++i) {
        const auto& g = *groups[static_cast<std::size_t>(group[i])];
        for (const std::int32_t channels : {1, 3}) {
          std::vector<double> lambda(static_cast<std::size_t>(g.count() * channels), 0.0);
          for (std::int32_t c = 0; c < channels; ++c)
            lambda[static_cast<std::size_t>(column[i] * channels + c)] = c + 1.0;
          std::vector<double> z(static_cast<std::size_t>(n * channels), 0.0);
          factor->combine(g, lambda.data(), channels, z.data());
          for (std::int32_t r = 0; r < n; ++r) {
            for (std::int32_t c = 0; c < channels; ++c)
              ASSERT_NEAR(z[r * channels + c], (c + 1) * y(r, i), 3 * scale) << k << " " << i << " row " << r;
          }
          factor->clear(g, channels, z.data());
          for (const double v : z) ASSERT_EQ(v, 0.0);
        }
      }
      const Eigen::MatrixXd s = hf_test::dense_product(y, y, true);
      for (std::int32_t i = 0; i < k; ++i) {
        for (std::int32_t j = 0; j < k; ++j) {
          const auto& p = *groups[static_cast<std::size_t>(group[i])];
          const auto& q = *groups[static_cast<std::size_t>(group[j])];
          std::vector<double> tile(40 * 32, 0.0);
          if (i % 10 == 0 || j % 10 == 0) {
            factor->gram(p, q, tile.data(), 40);
            ASSERT_NEAR(tile[static_cast<std::size_t>(column[i] * 40 + column[j])], s(i, j),
                        1e-12 * (1 + s.cwiseAbs().maxCoeff()));
          }
        }
      }
      for (const std::int32_t channels : {1, 2}) {
        const std::vector<double> z = random_vector(static_cast<std::size_t>(n * channels), 1);
        for (std::int32_t i = 0; i < k; ++i) {
          const auto& g = *groups[static_cast<std::size_t>(group[i])];
          std::vector<double> out(static_cast<std::size_t>(g.count() * channels));
          factor->project(g, z.data(), channels, out.data());
          for (std::int32_t c = 0; c < channels; ++c) {
            double expected = 0;
            for (std::int32_t r = 0; r < n; ++r) expected += y(r, i) * z[static_cast<std::size_t>(r * channels + c)];
            ASSERT_NEAR(out[static_cast<std::size_t>(column[i] * channels + c)], expected, 1e-11);
          }
        }
      }
    }
  }
}

TEST_F(FactorTest, a_site_outside_the_matrix_is_refused) {
  const auto factor = make(hf_test::grid_laplacian(memory, 5, 5));
  hf_inner::Vector<std::shared_ptr<const hf_inner::factor::PathGroup>> groups(&memory);
  std::int32_t group = 0, column = 0;
  for (const std::int32_t row : {-1, 25, INT32_MAX}) {
    Batch batch;
    batch.add({{row, 1.0}});
    EXPECT_THROW(factor->solve_paths(batch.view(), memory, one, groups, {&group, 1}, {&column, 1}), hf_inner::Error);
  }
}

TEST_F(FactorTest, memory_that_runs_out_anywhere_is_reported_and_nothing_leaks) {
  const hf_inner::SymmetricMatrix a = hf_test::grid_laplacian(memory, 60, 60);
  std::uint64_t needed = 0;
  {
    hf_inner::Memory counted;
    hf_inner::factor::FactorOptions options;
    hf_inner::factor::Factor::make(a, {}, options, counted, two);
    needed = counted.peak_bytes();
    EXPECT_EQ(counted.live_bytes(), 0u);
  }
  int refused = 0;
  for (std::uint64_t limit = 1000; limit < needed; limit += needed / 40) {
    hf_inner::Memory tight({}, limit);
    try {
      hf_inner::factor::FactorOptions options;
      hf_inner::factor::Factor::make(a, {}, options, tight, two);
    } catch (const std::bad_alloc&) {
      ++refused;
    } catch (const hf_inner::Error& error) {  // known before the factor is allocated
      EXPECT_EQ(error.code(), HF_ERROR_OUT_OF_MEMORY);
      ++refused;
    }
    EXPECT_EQ(tight.live_bytes(), 0u);
  }
  EXPECT_GT(refused, 20);
}

}  // namespace

// Edited factors against the dense inverse of the edited matrix.
#include "factor/edited_factor.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "base/error.h"
#include "base/index.h"
#include "support/dense.h"
#include "unit/factor/matrices.h"

namespace {

using hf_inner::at;
using hf_inner::Index;
using hf_inner::factor::MatrixChange;
using hf_inner::factor::PathGroup;

class EditedFactorTest : public testing::Test {
 protected:
  // A grid whose edges inside a window, and one link from corner to corner, have other weights. With `know` the rows of
  // the matrix inside the change are given. right: of the right half of the window, 0: as the left.
  void make(double inside, double link, bool know = true, double right = 0) {
    const Index nx = 23, ny = 17;
    const hf_inner::SymmetricMatrix matrix = hf_test::grid_laplacian(memory, nx, ny);
    const std::vector<float> points = hf_test::grid_points(nx, ny);
    base = hf_inner::factor::Factor::make(matrix, hf_inner::Span<const float>(points.data(), points.size()), {}, memory,
                                          two);
    n = matrix.size();
    exact = Eigen::MatrixXd::Zero(n, n);
    for (Index j = 0; j < n; ++j) {
      for (Index e = matrix.column_start[at(j)]; e < matrix.column_start[at(j) + 1]; ++e)
        exact(matrix.row[at(e)], j) = matrix.value[at(e)];
    }
    Eigen::MatrixXd delta = Eigen::MatrixXd::Zero(n, n);
    const auto add = [&](Index i, Index j, double weight) {
      delta(i, i) += weight;
      delta(j, j) += weight;
      delta(i, j) -= weight;
      delta(j, i) -= weight;
    };
    for (Index y = 5; y < 11; ++y) {
      for (Index x = 4; x < 14; ++x) {
        const Index v = y * nx + x;
        const double factor = x < 9 || right == 0 ? inside : right;
        add(v, v + 1, (factor - 1) * -exact(v, v + 1));
        add(v, v + nx, (factor - 1) * -exact(v, v + nx));
      }
    }
    if (link > 0) add(0, n - 1, link);
    const Eigen::MatrixXd before = exact;
    exact += delta;
    change.unknown.clear();
    change.entries.clear();
    std::vector<Index> place(at(n), -1);
    for (Index v = 0; v < n; ++v) {
      if (delta.col(v).cwiseAbs().maxCoeff() == 0) continue;
      place[at(v)] = static_cast<Index>(change.unknown.size());
      change.unknown.push_back(v);
    }
    for (const Index v : change.unknown) {
      for (const Index u : change.unknown) {
        if (delta(v, u) != 0) change.entries.push_back({place[at(v)], place[at(u)], delta(v, u)});
      }
    }
    change.inside.clear();
    change.inside_entries.clear();
    for (Index v = 0; know && v < n; ++v) {
      bool is_inside = place[at(v)] >= 0;
      for (Index u = 0; u < n; ++u) is_inside &= before(u, v) == 0 || place[at(u)] >= 0;
      if (!is_inside) continue;
      change.inside.push_back(place[at(v)]);
      for (Index u = 0; u < n; ++u) {
        if (before(u, v) != 0) change.inside_entries.push_back({place[at(v)], place[at(u)], before(u, v)});
      }
    }
  }
  Eigen::MatrixXd random(Index columns) const {
    std::srand(3);
    return Eigen::MatrixXd::Random(n, columns);
  }

  hf_inner::Memory memory;
  hf_inner::JobRunner two{2};
  std::shared_ptr<const hf_inner::factor::Factor> base;
  MatrixChange change{memory};
  Eigen::MatrixXd exact;
  Index n = 0;
};

// The errors are about what the factor tells of its rounding, and below 1e-12 where that is less.
TEST_F(EditedFactorTest, SweepsSolveTheEditedMatrix) {
  const double cases[][2] = {{1e-4, 0}, {0.3, 0},    {5.0, 0},
                             {1e4, 0},  {1e4, 1e-4}, {1e-4, 1e4}};  // the last beside each other
  for (const auto& one : cases) {
    make(one[0], 2.5, one[0] != 5.0, one[1]);
    const auto factor = hf_inner::factor::edit_factor(base, change, memory, two);
    const hf_test::DenseSolver dense(exact);
    for (const Index m : {1, 3, 8}) {
      // the error of the reference is removed by steps with residuals in long double
      const Eigen::MatrixXd right = random(m), solution = dense.solve_exactly(right, 4);
      std::vector<double> x(at(n * m)), scratch(x.size());
      for (Index v = 0; v < n; ++v) {
        for (Index q = 0; q < m; ++q) x[at(v * m + q)] = right(v, q);
      }
      factor->solve(x.data(), x.data(), m, scratch.data(), two);
      double worst = 0;
      for (Index v = 0; v < n; ++v) {
        for (Index q = 0; q < m; ++q) worst = std::max(worst, std::fabs(x[at(v * m + q)] - solution(v, q)));
      }
      const double error = worst / solution.cwiseAbs().maxCoeff();
      EXPECT_LT(error, std::max(1e-12, 4 * factor->statistics().rounding)) << one[0] << " " << one[1] << " " << m;
    }
  }
}

// Products of paths are entries of the inverse: w_i' A'^-1 w_j. Sums of paths go back to fields.
TEST_F(EditedFactorTest, PathsAreThoseOfTheEditedMatrix) {
  make(40, 3);
  ASSERT_GT(change.inside.size(), 40u);
  const auto factor = hf_inner::factor::edit_factor(base, change, memory, two);
  const Eigen::MatrixXd inverse = hf_test::DenseSolver(exact).solve(Eigen::MatrixXd(Eigen::MatrixXd::Identity(n, n)));
  const Index k = 70;  // more than two groups
  std::vector<Index> start(1, 0), row;
  std::vector<double> value;
  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(n, k);
  for (Index i = 0; i < k; ++i) {
    for (Index c = 0; c <= i % 3; ++c) {
      const Index v = (37 * i + 101 * c) % n;
      row.push_back(v);
      value.push_back(0.5 + c);
      w(v, i) += 0.5 + c;
    }
    start.push_back(static_cast<Index>(row.size()));
  }
  hf_inner::Vector<std::shared_ptr<const PathGroup>> groups(&memory);
  std::vector<Index> group(at(k)), column(at(k));
  factor->solve_paths({{start.data(), start.size()}, {row.data(), row.size()}, {value.data(), value.size()}}, memory,
                      two, groups, {group.data(), group.size()}, {column.data(), column.size()});
  ASSERT_GT(groups.size(), 2u);
  const Eigen::MatrixXd gram = hf_test::dense_product(w, hf_test::dense_product(inverse, w), true);
  double tile[PathGroup::capacity * PathGroup::capacity];
  for (Index i = 0; i < k; ++i) {
    for (Index j = 0; j < k; ++j) {
      factor->gram(*groups[at(group[at(i)])], *groups[at(group[at(j)])], tile, PathGroup::capacity);
      ASSERT_NEAR(tile[column[at(i)] * PathGroup::capacity + column[at(j)]], gram(i, j), 1e-11) << i << " " << j;
    }
  }
  // combine and a backward sweep: A'^-1 w, and project is its transpose
  const Eigen::MatrixXd lambda = random(1).topRows(k),
                        field = hf_test::dense_product(inverse, hf_test::dense_product(w, lambda));
  std::vector<double> z(at(n), 0.0), own(PathGroup::capacity), out(PathGroup::capacity);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    std::fill(own.begin(), own.end(), 0.0);
    for (Index i = 0; i < k; ++i) {
      if (at(group[at(i)]) == g) own[at(column[at(i)])] = lambda(i);
    }
    factor->combine(*groups[g], own.data(), 1, z.data());
  }
  const Eigen::MatrixXd products = hf_test::dense_product(gram, lambda);
  for (Index i = 0; i < k; ++i) {
    factor->project(*groups[at(group[at(i)])], z.data(), 1, out.data());
    ASSERT_NEAR(out[at(column[at(i)])], products(i), 1e-12 * products.cwiseAbs().maxCoeff());
  }
  const Index asked[2] = {n / 2, 7};
  std::vector<double> part = z;
  factor->backward_at({asked, 2}, part.data(), 1);
  factor->backward(z.data(), 1, two);
  const double bound = 1e-12 * field.cwiseAbs().maxCoeff();
  for (Index v = 0; v < n; ++v) ASSERT_NEAR(z[at(factor->position()[at(v)])], field(v), bound);
  for (const Index v : asked) EXPECT_NEAR(part[at(factor->position()[at(v)])], field(v), bound);
  factor->clear_at({asked, 2}, part.data(), 1);
  for (const auto& each : groups) factor->clear(*each, 1, part.data());
  for (const double left : part) ASSERT_EQ(left, 0.0);
}

// Row j of G as a column is G^-1 P A e_j, and its square is A_jj. Wide and narrow supernodes are stored differently.
TEST_F(EditedFactorTest, RowsOfTheFactorAreSweepsOfColumns) {
  make(1, 0);
  std::vector<Index> all(at(n));
  for (Index v = 0; v < n; ++v) all[at(v)] = v;
  hf_inner::factor::SparseVectors rows(memory);
  ASSERT_TRUE(base->rows_of({all.data(), all.size()}, rows));
  ASSERT_EQ(rows.start.size(), at(n) + 1);
  for (Index v = 0; v < n; ++v) {
    std::vector<double> z(at(n));
    for (Index u = 0; u < n; ++u) z[at(base->position()[at(u)])] = exact(u, v);
    base->forward(z.data(), 1, two);
    for (Index e = rows.start[at(v)]; e < rows.start[at(v) + 1]; ++e) z[at(rows.row[at(e)])] -= rows.value[at(e)];
    for (const double left : z) ASSERT_NEAR(left, 0, 1e-13) << v;
  }
}

TEST_F(EditedFactorTest, AMatrixThatIsNotPositiveDefiniteIsRefused) {
  make(1, 0);
  change.unknown = hf_inner::Vector<Index>({5, 6}, &memory);
  change.inside.clear();
  change.inside_entries.clear();
  const double weight = -exact(5, 6) * 50;  // more than the rest of the grid carries between the two
  change.entries = hf_inner::Vector<MatrixChange::Entry>(
      {{0, 0, -weight}, {1, 1, -weight}, {0, 1, weight}, {1, 0, weight}}, &memory);
  try {
    hf_inner::factor::edit_factor(base, change, memory, two);
    FAIL() << "made";
  } catch (const hf_inner::Error& error) {
    EXPECT_EQ(error.code(), HF_ERROR_NOT_POSITIVE_DEFINITE);
  }
}

}  // namespace

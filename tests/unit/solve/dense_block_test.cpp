// The dense part: appending and removing rows keeps a factor of the present matrix.
#include "solve/dense_block.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <Eigen/Core>
#include <random>
#include <vector>

#include "support/dense.h"

namespace {

TEST(DenseBlock, solves_with_the_present_rows_after_any_edits) {
  hf_inner::Memory memory;
  hf_inner::JobRunner jobs(2);
  hf_inner::solve::DenseBlock block(memory);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const int most = 90;
  Eigen::MatrixXd y(200, most * 3);
  for (int i = 0; i < y.rows(); ++i) {
    for (int j = 0; j < y.cols(); ++j) y(i, j) = normal(random);
  }
  std::vector<int> present;
  int next = 0;
  while (next < most * 3) {
    const int grow = 1 + static_cast<int>(random() % 20);
    for (int g = 0; g < grow && next < most * 3; ++g, ++next) {
      std::vector<double> row;
      for (const int j : present) row.push_back(y.col(next).dot(y.col(j)));
      row.push_back(y.col(next).dot(y.col(next)));
      block.append(next, row.data());
      present.push_back(next);
    }
    ASSERT_EQ(block.factorise(jobs), -1);
    // few: plane rotations; many: factorised again
    const std::size_t leave =
        random() % 4 == 0 ? present.size() / 2 : std::min<std::size_t>(present.size() - 1, random() % 4);
    std::vector<int> shuffled = present;
    std::shuffle(shuffled.begin(), shuffled.end(), random);
    std::vector<std::int32_t> leaving(shuffled.begin(), shuffled.begin() + static_cast<std::ptrdiff_t>(leave));
    block.remove(leaving);
    ASSERT_EQ(block.factorise(jobs), -1);
    for (const int s : leaving) present.erase(std::find(present.begin(), present.end(), s));
    ASSERT_TRUE(std::equal(present.begin(), present.end(), block.ids().begin(), block.ids().end()));

    const int k = static_cast<int>(present.size());
    Eigen::MatrixXd s(k, k);
    for (int i = 0; i < k; ++i) {
      for (int j = 0; j < k; ++j)
        s(i, j) = y.col(present[static_cast<std::size_t>(i)]).dot(y.col(present[static_cast<std::size_t>(j)]));
    }
    std::vector<double> x(static_cast<std::size_t>(2 * k));
    for (double& v : x) v = normal(random);
    const Eigen::MatrixXd b = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>>(x.data(), k, 2);
    block.solve(x.data(), 2);
    const Eigen::MatrixXd solved =
        Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>>(x.data(), k, 2);
    EXPECT_LE((hf_test::dense_product(s, solved) - b).cwiseAbs().maxCoeff(),
              1e-9 * b.cwiseAbs().maxCoeff() * s.norm() / s.cwiseAbs().minCoeff() * 1e-3 + 1e-8);
    EXPECT_LE((solved - hf_test::DenseSolver(s).solve(b)).cwiseAbs().maxCoeff(), 1e-9);
    if (present.size() > 60) {
      std::vector<std::int32_t> all(present.begin() + 10, present.end());
      block.remove(all);
      ASSERT_EQ(block.factorise(jobs), -1);
      present.resize(10);
    }
  }
}

TEST(DenseBlock, names_the_row_that_depends_on_those_before_it) {
  hf_inner::Memory memory;
  hf_inner::JobRunner jobs(2);
  hf_inner::solve::DenseBlock block(memory);
  const double first[] = {2}, second[] = {1, 3}, copy_of_first[] = {2, 1, 2};
  block.append(7, first);
  block.append(8, second);
  block.append(9, copy_of_first);
  EXPECT_EQ(block.factorise(jobs), 2);
}

}  // namespace

#include "dense.h"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <optional>

namespace hf_test {

using Map = Eigen::Map<const Eigen::MatrixXd>;

struct DenseSolver::Parts {
  Eigen::MatrixXd a;
  std::optional<Eigen::PartialPivLU<Eigen::MatrixXd>> partial;
  std::optional<Eigen::FullPivLU<Eigen::MatrixXd>> full;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const {
    if (full) return full->solve(b);
    return partial->solve(b);
  }
};

DenseSolver::DenseSolver(const double* a, std::ptrdiff_t size, Pivots pivots) : parts_(new Parts) {
  parts_->a = Map(a, size, size);
  if (pivots == full)
    parts_->full.emplace(parts_->a);
  else
    parts_->partial.emplace(parts_->a);
}

DenseSolver::~DenseSolver() = default;

void DenseSolver::solve(const double* b, std::ptrdiff_t columns, double* x) const {
  const Eigen::MatrixXd right = Map(b, parts_->a.rows(), columns);
  Eigen::MatrixXd left = parts_->solve(right);
  left += parts_->solve(right - parts_->a * left);
  Eigen::Map<Eigen::MatrixXd>(x, left.rows(), columns) = left;
}

std::ptrdiff_t dense_rank(const double* a, std::ptrdiff_t rows, std::ptrdiff_t columns, double threshold) {
  Eigen::FullPivLU<Eigen::MatrixXd> lu(Map(a, rows, columns));
  lu.setThreshold(threshold);
  return lu.rank();
}

void symmetric_eigen(const double* a, std::ptrdiff_t size, double* values, double* vectors) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(Map(a, size, size));
  Eigen::Map<Eigen::VectorXd>(values, size) = eigen.eigenvalues();
  Eigen::Map<Eigen::MatrixXd>(vectors, size, size) = eigen.eigenvectors();
}

double best_rotation_value(const double* s) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(Eigen::Map<const Eigen::Matrix3d>(s),
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d sigma = svd.singularValues();
  const bool mirrors = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0;
  return sigma(0) + sigma(1) + (mirrors ? -sigma(2) : sigma(2));
}

std::vector<double> sparse_solve(int size, const std::vector<SparseEntry>& entries, const double* b) {
  std::vector<Eigen::Triplet<double>> triplets;
  for (const SparseEntry& e : entries) triplets.emplace_back(e.row, e.column, e.value);
  Eigen::SparseMatrix<double> a(size, size);
  a.setFromTriplets(triplets.begin(), triplets.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(a);
  const Eigen::Map<const Eigen::VectorXd> right(b, size);
  Eigen::VectorXd x = factor.solve(right);
  for (int round = 0; round < 3; ++round) x += factor.solve(right - a * x);
  return {x.data(), x.data() + size};
}

}  // namespace hf_test

#include "dense.h"

#include <algorithm>
#include <cmath>
#include <Eigen/SparseCholesky>
#include <tuple>
#include <utility>

namespace hf_test {
namespace {

using Index = std::size_t;

// Elimination with pivots of the whole rest, or of a column of it: P A Q = L U, columns first.
template <class Real>
struct Elimination {
  Index rows, columns;
  std::vector<Real> a;
  std::vector<Index> row_of, column_of;
  std::vector<Real> pivots;

  Elimination(const Real* values, Index row_count, Index column_count, bool all)
      : rows(row_count), columns(column_count), a(values, values + row_count * column_count) {
    for (Index i = 0; i < rows; ++i) row_of.push_back(i);
    for (Index j = 0; j < columns; ++j) column_of.push_back(j);
    for (Index k = 0; k < std::min(rows, columns); ++k) {
      Index row = k, column = k;
      for (Index j = k; j < (all ? columns : k + 1); ++j) {
        for (Index i = k; i < rows; ++i) {
          if (std::abs(a[i + j * rows]) > std::abs(a[row + column * rows])) std::tie(row, column) = std::pair(i, j);
        }
      }
      pivots.push_back(std::abs(a[row + column * rows]));
      if (pivots.back() == 0) continue;
      for (Index j = 0; j < columns; ++j) std::swap(a[k + j * rows], a[row + j * rows]);
      std::swap_ranges(&a[k * rows], &a[k * rows] + rows, &a[column * rows]);
      std::swap(row_of[k], row_of[row]);
      std::swap(column_of[k], column_of[column]);
      const Real* from = &a[k * rows];
      for (Index i = k + 1; i < rows; ++i) a[i + k * rows] /= from[k];
      for (Index j = k + 1; j < columns; ++j) {
        Real* to = &a[j * rows];
        const Real times = to[k];
        for (Index i = k + 1; i < rows && times != 0; ++i) to[i] -= times * from[i];
      }
    }
  }

  std::vector<Real> solve(const Real* b) const {
    std::vector<Real> y(rows), x(rows);
    for (Index i = 0; i < rows; ++i) y[i] = b[row_of[i]];
    for (Index k = 0; k < rows; ++k) {
      for (Index i = k + 1; i < rows; ++i) y[i] -= y[k] * a[i + k * rows];
    }
    for (Index k = rows; k-- > 0;) {
      y[k] /= a[k + k * rows];
      for (Index i = 0; i < k; ++i) y[i] -= y[k] * a[i + k * rows];
    }
    for (Index k = 0; k < rows; ++k) x[column_of[k]] = y[k];
    return x;
  }
};

// The turn of two columns after which their product, of which p, q and s are the entries, is diagonal: cosine and sine.
std::pair<double, double> jacobi_turn(double p, double s, double q) {
  const double t = (q - p) / (2 * s), tangent = (t < 0 ? -1 : 1) / (std::fabs(t) + std::hypot(1.0, t));
  const double cosine = 1 / std::hypot(1.0, tangent);
  return {cosine, tangent * cosine};
}

void turn_columns(double* a, double* b, Index size, std::pair<double, double> turn) {
  for (Index i = 0; i < size; ++i)
    std::tie(a[i], b[i]) = std::pair(turn.first * a[i] - turn.second * b[i], turn.second * a[i] + turn.first * b[i]);
}

constexpr int most_sweeps = 60;

}  // namespace

struct DenseSolver::Parts {
  std::vector<double> a;
  Elimination<double> factor;
};

DenseSolver::DenseSolver(const double* a, std::ptrdiff_t size, Pivots pivots) {
  const Index n = static_cast<Index>(size);
  parts_.reset(new Parts{{a, a + n * n}, Elimination<double>(a, n, n, pivots == full)});
}

DenseSolver::~DenseSolver() = default;

void DenseSolver::solve(const double* b, std::ptrdiff_t columns, double* x) const {
  const Index n = parts_->factor.rows;
  for (Index c = 0; c < static_cast<Index>(columns); ++c) {
    const std::vector<double> first = parts_->factor.solve(b + c * n);
    std::vector<double> left(b + c * n, b + (c + 1) * n);
    for (Index j = 0; j < n; ++j) {
      for (Index i = 0; i < n; ++i) left[i] -= parts_->a[i + j * n] * first[j];
    }
    const std::vector<double> more = parts_->factor.solve(left.data());
    for (Index i = 0; i < n; ++i) x[i + c * n] = first[i] + more[i];
  }
}

void DenseSolver::correct(const double* b, std::ptrdiff_t columns, int steps, double* x) const {
  const Index n = parts_->factor.rows;
  for (Index c = 0; c < static_cast<Index>(columns); ++c) {
    double* const own = x + c * n;
    for (int step = 0; step < steps; ++step) {
      std::vector<long double> left(b + c * n, b + (c + 1) * n);
      for (Index j = 0; j < n; ++j) {
        for (Index i = 0; i < n; ++i) left[i] -= static_cast<long double>(parts_->a[i + j * n]) * own[j];
      }
      const std::vector<double> more = parts_->factor.solve(std::vector<double>(left.begin(), left.end()).data());
      for (Index i = 0; i < n; ++i) own[i] += more[i];
    }
  }
}

std::vector<long double> dense_solve(const std::vector<long double>& a, const std::vector<long double>& b) {
  return Elimination<long double>(a.data(), b.size(), b.size(), true).solve(b.data());
}

void multiply(const double* a, std::ptrdiff_t rows, std::ptrdiff_t columns, bool transposed, const double* b,
              std::ptrdiff_t b_columns, double* out) {
  const Index m = static_cast<Index>(rows), n = static_cast<Index>(columns);
  for (Index c = 0; c < static_cast<Index>(b_columns); ++c, b += transposed ? m : n, out += transposed ? n : m) {
    std::fill_n(out, transposed ? n : m, 0.0);
    for (Index j = 0; j < n; ++j) {
      const double* const column = a + j * m;
      for (Index i = 0; i < m; ++i) {
        if (transposed)
          out[j] += column[i] * b[i];
        else
          out[i] += column[i] * b[j];
      }
    }
  }
}

void dense_cholesky(const double* a, std::ptrdiff_t size, double* lower) {
  const Index n = static_cast<Index>(size);
  std::copy_n(a, n * n, lower);
  for (Index k = 0; k < n; ++k) {
    double* const column = lower + k * n;
    std::fill_n(column, k, 0.0);
    const double pivot = std::sqrt(column[k]);
    for (Index i = k; i < n; ++i) column[i] /= pivot;
    for (Index j = k + 1; j < n; ++j) {
      for (Index i = j; i < n; ++i) lower[i + j * n] -= column[i] * column[j];
    }
  }
}

void lower_solve(const double* lower, std::ptrdiff_t size, bool transposed, double* b, std::ptrdiff_t columns) {
  const Index n = static_cast<Index>(size);
  for (Index c = 0; c < static_cast<Index>(columns); ++c, b += n) {
    for (Index step = 0; step < n; ++step) {
      const Index k = transposed ? n - 1 - step : step;
      const double* const column = lower + k * n;
      for (Index i = k + 1; transposed && i < n; ++i) b[k] -= column[i] * b[i];
      b[k] /= column[k];
      for (Index i = k + 1; !transposed && i < n; ++i) b[i] -= column[i] * b[k];
    }
  }
}

std::ptrdiff_t dense_rank(const double* a, std::ptrdiff_t rows, std::ptrdiff_t columns, double threshold) {
  const Elimination<double> factor(a, static_cast<Index>(rows), static_cast<Index>(columns), true);
  const double largest = factor.pivots.empty() ? 0 : *std::max_element(factor.pivots.begin(), factor.pivots.end());
  return std::count_if(factor.pivots.begin(), factor.pivots.end(), [&](double p) { return p > threshold * largest; });
}

void symmetric_eigen(const double* a, std::ptrdiff_t size, double* values, double* vectors) {
  const Index n = static_cast<Index>(size);
  std::vector<double> m(a, a + n * n), v(n * n, 0.0);
  for (Index i = 0; i < n; ++i) v[i + i * n] = 1;
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    for (Index p = 0; p < n; ++p) {
      for (Index q = p + 1; q < n; ++q) {
        if (m[p + q * n] == 0) continue;
        const auto turn = jacobi_turn(m[p + p * n], m[p + q * n], m[q + q * n]);
        turn_columns(&m[p * n], &m[q * n], n, turn);
        for (Index j = 0; j < n; ++j) turn_columns(&m[p + j * n], &m[q + j * n], 1, turn);
        m[p + q * n] = m[q + p * n] = 0;
        turn_columns(&v[p * n], &v[q * n], n, turn);
      }
    }
  }
  std::vector<Index> order;
  for (Index i = 0; i < n; ++i) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](Index i, Index j) { return m[i + i * n] < m[j + j * n]; });
  for (Index k = 0; k < n; ++k) {
    values[k] = m[order[k] + order[k] * n];
    std::copy_n(&v[order[k] * n], n, vectors + k * n);
  }
}

double best_rotation_value(const double* s) {
  double b[9];  // turned until its columns are perpendicular; their lengths are the singular values
  std::copy_n(s, 9, b);
  const auto product = [&](Index p, Index q) {
    return b[3 * p] * b[3 * q] + b[3 * p + 1] * b[3 * q + 1] + b[3 * p + 2] * b[3 * q + 2];
  };
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    for (const auto& [p, q] : {std::pair<Index, Index>{0, 1}, {0, 2}, {1, 2}}) {
      if (std::fabs(product(p, q)) > 1e-17 * std::sqrt(product(p, p) * product(q, q)))
        turn_columns(b + 3 * p, b + 3 * q, 3, jacobi_turn(product(p, p), product(p, q), product(q, q)));
    }
  }
  const double sigma[] = {std::sqrt(product(0, 0)), std::sqrt(product(1, 1)), std::sqrt(product(2, 2))};
  const double volume =
      b[0] * (b[4] * b[8] - b[5] * b[7]) - b[1] * (b[3] * b[8] - b[5] * b[6]) + b[2] * (b[3] * b[7] - b[4] * b[6]);
  const double sum = sigma[0] + sigma[1] + sigma[2];
  return volume < 0 ? sum - 2 * std::min({sigma[0], sigma[1], sigma[2]}) : sum;
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

// Decompositions for oracles, compiled once: those of Eigen take the compiler seconds in every file that has them.
// Arrays go in and out, columns first, so that both copies of Eigen fit (base/algebra.h renames one).
#pragma once
#include <cstddef>
#include <memory>
#include <vector>

namespace hf_test {

// Solves with a square matrix by elimination, and corrects once by what is left.
class DenseSolver {
 public:
  enum Pivots { partial, full };
  template <class Matrix>
  explicit DenseSolver(const Matrix& a, Pivots pivots = partial) : DenseSolver(a.data(), a.rows(), pivots) {}
  ~DenseSolver();
  template <class Right>
  Right solve(const Right& b) const {
    Right x = b;
    solve(b.data(), b.cols(), x.data());
    return x;
  }
  // The same, corrected so many times more by what is left in long double.
  template <class Right>
  Right solve_exactly(const Right& b, int steps) const {
    Right x = solve(b);
    correct(b.data(), b.cols(), steps, x.data());
    return x;
  }

 private:
  struct Parts;
  DenseSolver(const double* a, std::ptrdiff_t size, Pivots pivots);
  void solve(const double* b, std::ptrdiff_t columns, double* x) const;
  void correct(const double* b, std::ptrdiff_t columns, int steps, double* x) const;
  std::unique_ptr<Parts> parts_;
};

// Solves with a square matrix, columns first, by elimination with pivots of the whole rest.
std::vector<long double> dense_solve(const std::vector<long double>& a, const std::vector<long double>& b);

// A b, or A' b where `transposed`.
void multiply(const double* a, std::ptrdiff_t rows, std::ptrdiff_t columns, bool transposed, const double* b,
              std::ptrdiff_t b_columns, double* out);
template <class Matrix>
Matrix dense_product(const Matrix& a, const Matrix& b, bool transposed = false) {
  Matrix out(transposed ? a.cols() : a.rows(), b.cols());
  multiply(a.data(), a.rows(), a.cols(), transposed, b.data(), b.cols(), out.data());
  return out;
}

// L of A = L L'; L^-1 b, or L'^-1 b where `transposed`, in the place of b.
void dense_cholesky(const double* a, std::ptrdiff_t size, double* lower);
void lower_solve(const double* lower, std::ptrdiff_t size, bool transposed, double* b, std::ptrdiff_t columns);

// Pivots over `threshold` times the largest count.
std::ptrdiff_t dense_rank(const double* a, std::ptrdiff_t rows, std::ptrdiff_t columns, double threshold);

// Values ascend; vector k is column k.
void symmetric_eigen(const double* a, std::ptrdiff_t size, double* values, double* vectors);

// max tr(R'S) over rotations R, for S of 3 by 3: the singular values, the least with the sign of det S.
double best_rotation_value(const double* s);

// Solves with a sparse symmetric matrix, both halves given; equal places add up.
struct SparseEntry {
  int row, column;
  double value;
};
std::vector<double> sparse_solve(int size, const std::vector<SparseEntry>& entries, const double* b);

}  // namespace hf_test

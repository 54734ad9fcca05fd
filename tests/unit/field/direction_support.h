// The field of least energy of a direction system under constraints, densely.
#pragma once
#include <complex>
#include <Eigen/Core>
#include <vector>

#include "base/index.h"
#include "field/direction_solver.h"
#include "support/dense.h"

namespace hf_test {

using Complex = std::complex<double>;

// Minimises z' K z; vertices of components without a constraint get 0.
inline std::vector<Complex> dense_field(const hf_inner::field::DirectionSolver& solver,
                                        const std::vector<std::int32_t>& vertices, const std::vector<Complex>& values) {
  const hf_inner::SymmetricMatrix& k = solver.matrix();
  const hf_inner::surface::Core& core = solver.core();
  const int n = k.size(), m = 2 * static_cast<int>(vertices.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n + m, n + m);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n + m);
  std::vector<int> reached(hf_inner::at(core.mesh.component_count()), 0);
  for (const std::int32_t v : vertices) reached[hf_inner::at(core.mesh.component[hf_inner::at(v)])] = 1;
  const auto unknown = [&](std::int32_t v, int part) { return solver.system().unknown(v, part); };
  for (std::int32_t v = 0; v < core.size(); ++v) {
    for (int part = 0; part < 2; ++part) {
      const int u = unknown(v, part);
      if (!reached[hf_inner::at(core.mesh.component[hf_inner::at(v)])]) a(u, u) = 1;
      for (std::int32_t i = k.column_start[hf_inner::at(u)]; i < k.column_start[hf_inner::at(u) + 1]; ++i) {
        if (reached[hf_inner::at(core.mesh.component[hf_inner::at(v)])])
          a(k.row[hf_inner::at(i)], u) = k.value[hf_inner::at(i)];
      }
    }
  }
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    for (int part = 0; part < 2; ++part) {
      const int row = n + 2 * static_cast<int>(i) + part, u = unknown(vertices[i], part);
      a(row, u) = 1;
      a(u, row) = -1;
      b(row) = part ? values[i].imag() : values[i].real();
    }
  }
  const Eigen::VectorXd x = DenseSolver(a).solve(b);
  std::vector<Complex> field;
  for (std::int32_t v = 0; v < core.size(); ++v) field.emplace_back(x(unknown(v, 0)), x(unknown(v, 1)));
  return field;
}

}  // namespace hf_test

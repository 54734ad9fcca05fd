// The exact answer to a field problem on a small mesh, by a dense solve of the whole saddle-point system
//     [ K  -W ] [   u    ]   [ 0 ]
//     [ W'  D ] [ lambda ] = [ s ]
// by plain elimination; shares no code with the engines.
#pragma once
#include <Eigen/Core>

#include "solve/site_solver.h"
#include "support/dense.h"

namespace hf_test {

// K as a dense matrix; a product of dense matrices where the core does not form it.
inline Eigen::MatrixXd dense_operator(const hf_inner::surface::Core& core) {
  const hf_inner::SymmetricMatrix& m = core.root ? core.root->matrix() : core.matrix();
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(core.size(), core.size());
  for (int v = 0; v < core.size(); ++v) {
    for (int i = m.column_start[static_cast<std::size_t>(v)]; i < m.column_start[static_cast<std::size_t>(v) + 1]; ++i)
      k(v, m.row[static_cast<std::size_t>(i)]) = m.value[static_cast<std::size_t>(i)];
  }
  if (!core.root) return k;
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(core.size());
  for (std::size_t v = 0; v < core.inverse_mass.size(); ++v) scale[static_cast<int>(v)] = core.inverse_mass[v];
  return dense_product(k, Eigen::MatrixXd(scale.asDiagonal() * k));
}

// sites in use only; values one row per site. Returns n x m (components without a site: zero rows). lambda: one row per
// site.
inline Eigen::MatrixXd dense_field(const hf_inner::surface::Core& core, const std::vector<hf_inner::solve::Site>& sites,
                                   const Eigen::MatrixXd& values, Eigen::MatrixXd* lambda = nullptr) {
  const int n = core.size(), k = static_cast<int>(sites.size());
  std::vector<int> reached(static_cast<std::size_t>(core.mesh.component_count()), 0);
  for (const hf_inner::solve::Site& site : sites) reached[static_cast<std::size_t>(site.component)] = 1;
  const Eigen::MatrixXd operation = dense_operator(core);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n + k, n + k);
  for (int v = 0; v < n; ++v) {
    if (!reached[static_cast<std::size_t>(core.mesh.component[static_cast<std::size_t>(v)])]) {
      a(v, v) = 1;
      continue;
    }
    a.row(v).head(n) = operation.row(v);
  }
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(n + k, values.cols());
  for (int i = 0; i < k; ++i) {
    const hf_inner::solve::Site& site = sites[static_cast<std::size_t>(i)];
    for (int q = 0; q < 3; ++q) {
      if (site.vertex[q] < 0) continue;
      a(site.vertex[q], n + i) -= site.weight[q];
      a(n + i, site.vertex[q]) += site.weight[q];
    }
    a(n + i, n + i) = site.compliance / core.mean_diagonal[static_cast<std::size_t>(site.component)];
    b.row(n + i) = values.row(i);
  }
  const Eigen::MatrixXd x = DenseSolver(a).solve(b);
  if (lambda) *lambda = x.bottomRows(k);
  return x.topRows(n);
}

}  // namespace hf_test

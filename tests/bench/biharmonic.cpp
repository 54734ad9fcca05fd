#include "bench/biharmonic.h"

#include <algorithm>
#include <cmath>

#include "bench/inner_factor.h"
#include "support/peers.h"

namespace bench {
namespace {

// K du = right off the eliminated vertices, du = 0 on them; both in the core's vertex numbers.
void solve_eliminated(const InnerSystem& system, const std::vector<uint8_t>& eliminated, std::vector<double>& right) {
  const hf_inner::SymmetricMatrix& k = system.core().laplacian;
  const auto grounded =
      hf_inner::factor::Factor::make(system.matrix(), system.coordinates(), {}, system.memory(), system.jobs());
  // sites stand in for the grounds: K itself, pattern as it was
  const auto factor = grounded->refactor(k, {eliminated.data(), eliminated.size()}, system.memory(), system.jobs());
  std::vector<double> z(right.size());
  for (size_t v = 0; v < right.size(); ++v) z[static_cast<size_t>(factor->position()[v])] = right[v];
  factor->forward(z.data(), 1, system.jobs());
  factor->backward(z.data(), 1, system.jobs());
  for (size_t v = 0; v < right.size(); ++v) right[v] = z[static_cast<size_t>(factor->position()[v])];
}

}  // namespace

BiharmonicResult biharmonic_refinement(const Mesh& mesh, uint32_t threads) {
  BiharmonicResult result;
  const std::vector<uint32_t> sites = scattered_vertices(mesh.vertex_count(), 100, 3);
  std::vector<double> given;
  double low = 1, high = 0;
  {
    SolverOptions options{ENGINE_GREEN, threads};
    options.field_kind = HF_FIELD_BIHARMONIC;
    const Solver solver(mesh, options);
    Sites(solver).edit(sites, {});
    result.create_ms = solver.create_ms();
    solver.solve(given);
    result.solve_ms = median_ms(3, [&] { solver.solve(given); });
  }
  const InnerSystem system(mesh, threads, hf_inner::mesh::FieldKind::biharmonic);
  const hf_inner::mesh::Mesh& inner = system.core().mesh;
  const hf_inner::SymmetricMatrix& k = system.core().laplacian;
  const size_t n = static_cast<size_t>(k.size());
  std::vector<double> u(n), change(n, 0.0);
  std::vector<uint8_t> eliminated(n, 0);
  for (size_t v = 0; v < n; ++v) u[v] = given[static_cast<size_t>(inner.given_of_inner[v])];
  for (const uint32_t v : sites) {
    eliminated[static_cast<size_t>(inner.inner_of_given[v])] = 1;
    low = std::min(low, value_of(v));
    high = std::max(high, value_of(v));
  }
  double diagonal = 0;
  for (size_t v = 0; v < n; ++v) {
    for (int32_t i = k.column_start[v]; i < k.column_start[v + 1]; ++i) {
      const size_t w = static_cast<size_t>(k.row[static_cast<size_t>(i)]);
      const double value = k.value[static_cast<size_t>(i)];
      change[v] -= value * (u[w] - u[v]);
      if (w == v) diagonal += value / static_cast<double>(n);
    }
    if (eliminated[v]) change[v] = 0;
    result.residual = std::max(result.residual, std::fabs(change[v]));
  }
  result.residual /= diagonal;
  solve_eliminated(system, eliminated, change);
  for (const double c : change) result.change = std::max(result.change, std::fabs(c) / (high - low));
  return result;
}

}  // namespace bench

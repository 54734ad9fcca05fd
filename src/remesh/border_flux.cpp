#include "remesh/border_flux.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "remesh/constants.h"

namespace hf_inner {
namespace {

// Solves A x = b by Cholesky in place; b becomes x. a: a positive definite matrix, row by row. It is written by hand,
// because the size is only known at run time.
void solve_dense(Vector<double>& a, Vector<double>& b) {
  const std::size_t n = b.size();
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = j; i < n; ++i) {
      double sum = a[i * n + j];
      for (std::size_t k = 0; k < j; ++k) sum -= a[i * n + k] * a[j * n + k];
      if (i == j) {
        if (!(sum > 0)) fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX, "sites are too close to part sources from sinks");
        a[j * n + j] = std::sqrt(sum);
      } else {
        a[i * n + j] = sum / a[j * n + j];
      }
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= a[i * n + k] * b[k];
    b[i] /= a[i * n + i];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[k * n + i] * b[k];
    b[i] /= a[i * n + i];
  }
}

// A border is an extremum of the exact field. A site on it can have its level, and rounding then decides which of the
// two is the extremum. So every apex that its ring passes is put beyond the ring by one unit in the last place.
void part_borders(const FluxSurface& s, const Vector<FluxSite>& sites, Vector<double>& u) {
  for (const FluxSite& site : sites) {
    if (!s.is_apex(site.vertex)) continue;
    const double way = site.lines > 0 ? HUGE_VAL : -HUGE_VAL;
    double& level = u[static_cast<std::size_t>(site.vertex)];
    const std::int32_t begin = s.out[site.vertex];
    for (std::int32_t g = begin;;) {
      const double beside = u[static_cast<std::size_t>(s.head(g))];
      if (way > 0 ? beside >= level : beside <= level) level = std::nextafter(beside, way);
      g = s.turn_left(g);
      if (g == begin) break;
    }
  }
}

}  // namespace

Vector<double> solve_between_levels(const FluxSurface& s, const FluxSolver& solver, Vector<FluxSite>& sites) {
  const auto memory = sites.get_allocator();
  Vector<FluxSite> exact(memory);
  for (std::int32_t c = 0; c < s.component_count; ++c) {
    Vector<std::size_t> own(memory);
    for (std::size_t i = 0; i < sites.size(); ++i)
      if (s.component[sites[i].vertex] == c) own.push_back(i);
    const std::size_t n = own.size() - 1;
    double total = 0;
    for (const std::size_t i : own) total += std::max(sites[i].lines, 0.0);
    const FluxSite& first = sites[own[0]];
    auto level = [&](std::size_t i) { return sites[own[i]].lines > 0 ? 1.0 : 0.0; };
    Vector<double> a(n * n, 0.0, memory), q(n, 0.0, memory);
    for (std::size_t j = 0; j < n; ++j) {
      const FluxSite pair[2] = {{sites[own[j + 1]].vertex, 1.0}, {first.vertex, -1.0}};
      const Vector<double> g = solver.solve({pair, 2});
      for (std::size_t i = 0; i < n; ++i)
        a[i * n + j] =
            g[static_cast<std::size_t>(sites[own[i + 1]].vertex)] - g[static_cast<std::size_t>(first.vertex)];
      q[j] = level(j + 1) - level(0);
    }
    solve_dense(a, q);
    double rest = 0, sum = 0;
    for (const double flux : q) rest -= flux, sum += std::max(flux, 0.0);
    sum += std::max(rest, 0.0);
    const double scale = sum > 0 ? total / sum : 0.0;
    for (std::size_t i = 0; i <= n; ++i) {
      const double flux = scale * (i == 0 ? rest : q[i - 1]);
      exact.push_back({sites[own[i]].vertex, flux});
      const double lines = std::max(least_lines, 2 * std::round(std::fabs(flux) / 2));
      sites[own[i]].lines = sites[own[i]].lines > 0 ? lines : -lines;
    }
  }
  Vector<double> u = solver.solve(exact);
  part_borders(s, sites, u);
  return u;
}

}  // namespace hf_inner

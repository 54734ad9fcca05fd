// Computes how well the field u and the fluxes lambda of the sites satisfy K u = W lambda and w_i' u + lambda_i /
// alpha_i = s_i. Site i has the weights w_i (a column of W), the stiffness alpha_i and the value s_i. The errors are
//
//     residual     max_v |sum_j K_vj (u_j - u_v) - (W lambda)_v| / (K_vv r)
//     site error   max_i |w_i'u + lambda_i / alpha_i - s_i| / r
//     overshoot    max_v max(u_v - max s, min s - u_v) / r
//
// Here r is the range of the site values of the component and channel. The sums use the differences u_j - u_v, so a
// large constant in u costs no digits. The check uses K itself, but neither the factor nor the dense system of the
// sites, so it finds a fault in either. A small residual does not bound the error of u on meshes of bad quality. But a
// damaged factor, a missing site or a number that is not finite cannot pass.
//
// Overshoot is how far the field leaves the range of its site values. It is checked only if K has no positive entry off
// its diagonal (an M-matrix) and every site is a vertex. The maximum principle then forbids overshoot. In other cases,
// such as cotangent weights with obtuse triangles, bi-harmonic fields or points inside triangles, overshoot is allowed.
//
// Cost: a solve and a product with K. The function changes nothing.
#include "field/certificate.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/index.h"

namespace hf_inner {
namespace {

// Default tolerances of the errors. All engines (ways to solve) stay well below them. The engine updown treats sites as
// penalties, which meet their values only to about 1 / penalty.
constexpr double exact_tolerance = 1e-8, penalty_tolerance = 1e-5;

// The smallest and largest site value of each component and channel.
struct Ranges {
  Ranges(const SiteSet& sites, std::size_t components, std::size_t channels, Memory& memory)
      : low(components * channels, HUGE_VAL, &memory), high(components * channels, -HUGE_VAL, &memory) {
    for (std::size_t slot = 0; slot < sites.slots().size(); ++slot) {
      if (!sites.slots()[slot].used()) continue;
      const std::size_t c = at(sites.slots()[slot].site.component) * channels;
      for (std::size_t q = 0; q < channels; ++q) {
        const double value = sites.values()[slot * channels + q];
        low[c + q] = std::min(low[c + q], value), high[c + q] = std::max(high[c + q], value);
      }
    }
  }
  double range(std::size_t i) const noexcept { return high[i] - low[i]; }
  // Returns the unit of errors for a component and channel: the range of the site values, or their size if the range is
  // 0.
  double unit(std::size_t i) const noexcept {
    const double size = std::max(std::fabs(low[i]), std::fabs(high[i]));
    return range(i) > 0 ? range(i) : size > 0 ? size : 1.0;
  }
  Vector<double> low, high;
};

// Raises `largest` to `error` if `error` is larger. An error that is not finite counts as infinite.
bool raise(double& largest, double error) noexcept {
  const double wrong = std::isfinite(error) ? error : HUGE_VAL;
  if (!(wrong > largest)) return false;
  largest = wrong;
  return true;
}

// Sums K_vj (u_j - u_v) over row v. Returns true if no entry off the diagonal is positive, as an M-matrix requires.
bool row_of(const SymmetricMatrix& k, std::size_t v, const double* u, std::size_t m, double* out) noexcept {
  bool one_sign = true;
  std::fill_n(out, m, 0.0);
  for (std::int32_t i = k.column_start[v]; i < k.column_start[v + 1]; ++i) {
    const std::size_t j = at(k.row[at(i)]);
    if (j == v) continue;
    const double weight = k.value[at(i)];
    one_sign = one_sign && weight <= 0;
    for (std::size_t q = 0; q < m; ++q) out[q] += weight * (u[j * m + q] - u[v * m + q]);
  }
  return one_sign;
}

}  // namespace

double certificate_tolerance(double asked, EngineKind engine) {
  if (asked == 0) return engine == EngineKind::updown ? penalty_tolerance : exact_tolerance;
  if (!(asked > 0) || !std::isfinite(asked))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "tolerance is %g; it must be above 0 and finite, or 0 for the engine's own", asked);
  return asked;
}

Certificate certify(const ScalarField& field) {
  const Core& core = field.core();
  Memory& memory = *core.memory;
  const SiteSet& sites = field.sites();
  const SymmetricMatrix& k = core.laplacian;
  const std::size_t n = at(core.size()), m = at(sites.channels()), components = at(core.mesh.component_count());
  if (sites.count() == 0) fail(HF_ERROR_NO_SITES, HF_NO_INDEX, "the solver has no sites; there is no field to certify");
  Workspace u(core.workspaces, n * m), right(core.workspaces, n * m);
  Vector<double> flux(&memory), row(m, &memory);
  field.flux(flux, u.data());
  const Ranges ranges(sites, components, m, memory);

  Certificate found;
  found.overshoot_checked = core.refinements == 0;
  double worst = -1;
  const auto note = [&](double& largest, double error, std::int32_t vertex) {
    raise(largest, error);
    if (raise(worst, error)) found.vertex = vertex;
  };

  // Measures the error of each site, and adds up the fluxes of the sites by vertex.
  std::fill_n(right.data(), n * m, 0.0);
  for (std::size_t slot = 0; slot < sites.slots().size(); ++slot) {
    if (!sites.slots()[slot].used()) continue;
    const Site& site = sites.slots()[slot].site;
    const std::size_t c = at(site.component);
    found.overshoot_checked = found.overshoot_checked && site.is_vertex();
    for (std::size_t q = 0; q < m; ++q) {
      const double lambda = flux[slot * m + q];
      double error = site.compliance / core.mean_diagonal[c] * lambda - sites.values()[slot * m + q];
      for (int corner = 0; corner < 3; ++corner) {
        if (site.vertex[corner] < 0) continue;
        error += site.weight[corner] * u[at(site.vertex[corner]) * m + q];
        right[at(site.vertex[corner]) * m + q] += site.weight[corner] * lambda;
      }
      note(found.site_error, std::fabs(error) / ranges.unit(c * m + q), site.vertex[0]);
    }
  }

  for (std::size_t v = 0; v < n; ++v) {
    const std::size_t c = at(core.mesh.component[v]);
    if (field.engine().site_count(static_cast<std::int32_t>(c)) == 0) continue;
    const double diagonal = std::fabs(k.value[k.diagonal(static_cast<std::int32_t>(v))]);
    if (!row_of(k, v, u.data(), m, row.data())) found.overshoot_checked = false;
    for (std::size_t q = 0; q < m; ++q) {
      const double unit = ranges.unit(c * m + q), residual = std::fabs(row[q] - right[v * m + q]);
      note(found.residual, (diagonal > 0 ? residual / diagonal : residual) / unit, static_cast<std::int32_t>(v));
    }
  }
  for (std::size_t i = 0; i < components * m; ++i) {
    if (ranges.low[i] <= ranges.high[i]) found.value_range = std::max(found.value_range, ranges.range(i));
  }
  for (std::size_t v = 0; found.overshoot_checked && v < n; ++v) {
    const std::size_t c = at(core.mesh.component[v]);
    if (field.engine().site_count(static_cast<std::int32_t>(c)) == 0) continue;
    for (std::size_t q = 0; q < m; ++q) {
      const double value = u[v * m + q], low = ranges.low[c * m + q], high = ranges.high[c * m + q];
      note(found.overshoot, std::max(value - high, low - value) / ranges.unit(c * m + q), static_cast<std::int32_t>(v));
    }
  }
  return found;
}

}  // namespace hf_inner

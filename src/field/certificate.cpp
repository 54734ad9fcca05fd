// Computes how well the field u and the fluxes lambda of the sites satisfy K u = W lambda and w_i' u + lambda_i /
// alpha_i = s_i. Site i has the weights w_i (a column of W), the stiffness alpha_i and the value s_i. The errors are
//
//     residual     max_v |sum_j K_vj (u_j - u_v) - (W lambda)_v| / (K_vv r)
//     site error   max_i |w_i'u + lambda_i / alpha_i - s_i| / r
//     overshoot    max_v max(u_v - max s, min s - u_v) / r
//     error        max_v |u_v - exact| / r, estimated
//
// A screened field has A H (p - u) on the right-hand side too, and K with A H on its diagonal below. A graph is checked
// with the weights of the caller. The operator may have others where the weights span more digits than a double has.
//
// Here r is the range of the site values (and targets) of the component and channel. The sums use the differences u_j -
// u_v, so a large constant in u costs no digits. The check uses K itself, but neither the factor nor the dense system
// of the sites, so it finds a fault in either. A small residual does not bound the error of u on meshes of bad quality.
// But a damaged factor, a missing site or a number that is not finite cannot pass.
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
#include "field/flow_bound.h"
#include "mesh/laplacian.h"
#include "surface/edited_core.h"

namespace hf_inner::field {
namespace {

// The smallest and largest site value of each component and channel, and target where the field is screened.
struct Ranges {
  Ranges(const ScalarField& field, std::size_t components, std::size_t channels, Memory& memory)
      : low(components * channels, HUGE_VAL, &memory), high(components * channels, -HUGE_VAL, &memory) {
    const solve::SiteSet& sites = field.sites();
    const auto take = [&](std::int32_t component, const double* values) {
      for (std::size_t q = 0; q < channels; ++q) {
        const std::size_t i = at(component) * channels + q;
        const double value = values ? values[q] : 0.0;
        low[i] = std::min(low[i], value);
        high[i] = std::max(high[i], value);
      }
    };
    for (std::size_t slot = 0; slot < sites.slots().size(); ++slot) {
      if (sites.slots()[slot].used()) take(sites.slots()[slot].site.component, sites.values() + slot * channels);
    }
    const solve::Screening* screening = field.screening();
    for (std::size_t v = 0; screening && v < screening->screened->mass.size(); ++v) {
      if (screening->screened->mass[v] > 0)
        take(field.core().mesh.component[v],
             screening->target.empty() ? nullptr : screening->target.data() + v * channels);
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

// Largest share of the error that a correction is taken to leave, for the estimate by two corrections. Closer to 1
// refuses fields whose corrections are all rounding; at half a factor passes that hardly corrects.
constexpr double most_left = 0.9;

// u_j - u_v summed with the weights of row v.
void row_of(const SymmetricMatrix& k, std::size_t v, const double* u, std::size_t m, double* out) noexcept {
  std::fill_n(out, m, 0.0);
  for (std::int32_t i = k.column_start[v]; i < k.column_start[v + 1]; ++i) {
    const std::size_t j = at(k.row[at(i)]);
    if (j == v) continue;
    for (std::size_t q = 0; q < m; ++q) out[q] += k.value[at(i)] * (u[j * m + q] - u[v * m + q]);
  }
}

bool is_m_matrix(const SymmetricMatrix& k) noexcept {
  for (std::int32_t v = 0; v < k.size(); ++v) {
    for (std::size_t i = at(k.column_start[at(v)]); i < at(k.column_start[at(v) + 1]); ++i)
      if (k.row[i] != v && k.value[i] > 0) return false;
  }
  return true;
}

// A vertex that a soft condition holds: how far a flow of 1 moves it.
struct SoftRoot {
  Index vertex = -1;
  double softness = 0;
};

// The Laplacian of a graph's own weights if the operator has others; else empty.
SymmetricMatrix given_weights(const surface::Core& core) {
  const surface::Geometry& plain = core.geometry->unlinked();
  if (!core.mesh.is_graph() || core.field_kind != mesh::FieldKind::harmonic || core.changed_count == 0)
    return SymmetricMatrix(*core.memory);
  SymmetricMatrix given = mesh::laplacian(plain.topology(), plain.weights(), *core.memory, core.jobs.get());
  if (core.stiffness) surface::stiffen(given, *core.stiffness, *core.memory);
  return given;
}

// The checks of one field.
class Check {
 public:
  explicit Check(const ScalarField& field)
      : field_(field),
        core_(field.core()),
        memory_(*core_.memory),
        sites_(field.sites()),
        n_(at(core_.size())),
        m_(at(sites_.channels())),
        screening_(field.screening()),
        given_(given_weights(core_)),
        k_(screening_          ? screening_->screened->matrix
           : given_.size() > 0 ? given_
                               : core_.matrix()),
        ranges_(field, at(core_.mesh.component_count()), m_, memory_),
        u_(core_.workspaces, n_ * m_),
        left_(core_.workspaces, n_ * m_),
        flux_(&memory_),
        site_error_(ranges_.low.size(), 0.0, &memory_) {
    flux_.resize(std::max(sites_.slots().size(), at(field.engine().slot_count())) * m_);
    found_.overshoot_checked = core_.refinements == 0 && is_m_matrix(k_);
    bounded_ = found_.overshoot_checked;
  }

  Certificate run() {
    field_.engine().solve(sites_.values(), sites_.channels(), u_.data(), flux_.data());
    check_sites();
    check_residual();
    check_overshoot();
    check_error();
    for (std::size_t i = 0; i < ranges_.low.size(); ++i) {
      if (ranges_.low[i] <= ranges_.high[i]) found_.value_range = std::max(found_.value_range, ranges_.range(i));
    }
    return found_;
  }

 private:
  template <class Work>
  void each_site(Work&& work) const {
    for (std::size_t slot = 0; slot < sites_.slots().size(); ++slot)
      if (sites_.slots()[slot].used()) work(slot, sites_.slots()[slot].site);
  }
  bool reached(std::size_t v) const noexcept { return field_.engine().site_count(core_.mesh.component[v]) > 0; }
  std::size_t unit_of(std::size_t v, std::size_t q) const noexcept { return at(core_.mesh.component[v]) * m_ + q; }
  double compliance(const solve::Site& site) const noexcept {
    return site.compliance / core_.mean_diagonal[at(site.component)];
  }

  void note(double& largest, double error, std::int32_t vertex) noexcept {
    raise(largest, error);
    if (raise(worst_, error)) found_.vertex = vertex;
  }

  void check_sites() {
    each_site([&](std::size_t slot, const solve::Site& site) {
      found_.overshoot_checked = found_.overshoot_checked && site.is_vertex();
      for (std::size_t q = 0; q < m_; ++q) {
        double error = compliance(site) * flux_[slot * m_ + q] - sites_.values()[slot * m_ + q];
        for (int corner = 0; corner < 3; ++corner)
          if (site.vertex[corner] >= 0) error += site.weight[corner] * u_[at(site.vertex[corner]) * m_ + q];
        const std::size_t i = at(site.component) * m_ + q;
        raise(site_error_[i], std::fabs(error) / ranges_.unit(i));
        note(found_.site_error, std::fabs(error) / ranges_.unit(i), site.vertex[0]);
      }
    });
  }

  // left += W lambda
  void add_flux(const Vector<double>& flux) {
    each_site([&](std::size_t slot, const solve::Site& site) {
      for (int corner = 0; corner < 3; ++corner) {
        if (site.vertex[corner] < 0) continue;
        for (std::size_t q = 0; q < m_; ++q)
          left_[at(site.vertex[corner]) * m_ + q] += site.weight[corner] * flux[slot * m_ + q];
      }
    });
  }
  // left -= K u, and A H (u - p) where the field is screened. wish: p, or null for 0.
  void subtract_product(const double* u, const double* wish) {
    if (core_.root || screening_) {
      surface::Workspace product(core_.workspaces, n_ * m_);
      const Index channels = static_cast<Index>(m_);
      if (screening_)
        screening_->screened->multiply(u, wish, channels, product.data());
      else
        surface::apply_operator(core_, u, channels, product.data());
      for (std::size_t v = 0; v < n_; ++v) {
        for (std::size_t q = 0; reached(v) && q < m_; ++q) left_[v * m_ + q] -= product[v * m_ + q];
      }
      return;
    }
    Vector<double> row(m_, &memory_);
    for (std::size_t v = 0; v < n_; ++v) {
      if (!reached(v)) continue;
      row_of(k_, v, u, m_, row.data());
      for (std::size_t q = 0; q < m_; ++q) left_[v * m_ + q] -= row[q];
    }
  }

  void check_residual() {
    Vector<double> diagonals = surface::operator_diagonal(core_);
    for (std::size_t v = 0; !core_.root && v < n_; ++v) diagonals[v] = k_.value[k_.diagonal(static_cast<Index>(v))];
    std::fill_n(left_.data(), n_ * m_, 0.0);
    add_flux(flux_);
    subtract_product(u_.data(), screening_ && !screening_->target.empty() ? screening_->target.data() : nullptr);
    for (std::size_t v = 0; v < n_; ++v) {
      if (!reached(v)) continue;
      const double diagonal = std::fabs(diagonals[v]);
      for (std::size_t q = 0; q < m_; ++q) {
        const double size = std::fabs(left_[v * m_ + q]) / ranges_.unit(unit_of(v, q));
        raise(found_.residual, diagonal > 0 ? size / diagonal : size);
      }
    }
  }

  void check_overshoot() {
    for (std::size_t v = 0; found_.overshoot_checked && v < n_; ++v) {
      if (!reached(v)) continue;
      for (std::size_t q = 0; q < m_; ++q) {
        const std::size_t i = unit_of(v, q);
        const double over = std::max(u_[v * m_ + q] - ranges_.high[i], ranges_.low[i] - u_[v * m_ + q]);
        note(found_.overshoot, over / ranges_.unit(i), static_cast<std::int32_t>(v));
      }
    }
  }

  // The largest change over the unit, and where; by component and channel where asked for.
  double size_of(const double* change, std::int32_t& vertex, Vector<double>* by_unit = nullptr) const {
    double largest = -1;
    for (std::size_t v = 0; v < n_; ++v) {
      for (std::size_t q = 0; reached(v) && q < m_; ++q) {
        const double size = std::fabs(change[v * m_ + q]) / ranges_.unit(unit_of(v, q));
        if (raise(largest, size)) vertex = static_cast<std::int32_t>(v);
        if (by_unit) raise((*by_unit)[unit_of(v, q)], size);
      }
    }
    return std::max(largest, 0.0);
  }

  bool correct(const double* u, const Vector<double>& flux, double* change, Vector<double>& flux_change) const {
    flux_change.assign(flux.size(), 0.0);
    return field_.engine().correct(sites_.values(), sites_.channels(), u, flux.data(), change, flux_change.data());
  }

  void check_error() {
    surface::Workspace change(core_.workspaces, n_ * m_);
    Vector<double> flux_change(&memory_), size(site_error_, &memory_);
    std::int32_t vertex = mesh::Mesh::none;
    const bool corrected = std::isfinite(found_.residual) && correct(u_.data(), flux_, change.data(), flux_change);
    double first = corrected ? size_of(change.data(), vertex, bounded_ ? &size : nullptr) : 0;
    double error = found_.residual;
    if (!std::isfinite(found_.residual) || !std::isfinite(first)) {
      error = HUGE_VAL;
    } else if (bounded_) {
      if (corrected) {
        add_flux(flux_change);
        subtract_product(change.data(), nullptr);
      }
      error = bounded(size);
    } else if (corrected) {
      for (std::size_t i = 0; i < n_ * m_; ++i) u_[i] += change[i];
      for (std::size_t i = 0; i < flux_.size(); ++i) flux_[i] += flux_change[i];
      std::int32_t elsewhere = mesh::Mesh::none;
      correct(u_.data(), flux_, change.data(), flux_change);
      const double second = size_of(change.data(), elsewhere);
      error = std::max(first, second) / (1 - (first > 0 ? std::min(second / first, most_left) : 0.0));
    }
    if (vertex == mesh::Mesh::none) vertex = sites_.slots().empty() ? 0 : found_.vertex;
    note(found_.error, error, vertex);
  }

  // Adds the bound of the remaining residual to the sizes of the correction, and returns the largest.
  double bounded(Vector<double>& size) {
    // e is 0 at hard vertex sites. A component without one has its hardest site as its root; screening holds a vertex
    // as a soft site does.
    const std::size_t components = at(core_.mesh.component_count());
    Vector<Index> roots(&memory_);
    Vector<std::uint8_t> held(components, 0, &memory_);
    Vector<SoftRoot> hardest(components, &memory_);
    const auto offer = [&](Index component, const SoftRoot& root) {
      SoftRoot& best = hardest[at(component)];
      if (best.vertex < 0 || root.softness < best.softness) best = root;
    };
    each_site([&](std::size_t, const solve::Site& site) {
      if (site.is_hard_vertex()) {
        roots.push_back(site.vertex[0]);
        held[at(site.component)] = 1;
        std::fill_n(left_.data() + at(site.vertex[0]) * m_, m_, 0.0);  // lambda is free there
      } else {
        offer(site.component, {site.vertex[0], compliance(site)});
      }
    });
    for (std::size_t v = 0; screening_ && v < n_; ++v) {
      const double mass = screening_->screened->mass[v];
      if (mass > 0) offer(core_.mesh.component[v], {static_cast<Index>(v), 1 / mass});
    }
    for (std::size_t c = 0; c < components; ++c) {
      if (!held[c] && hardest[c].vertex >= 0) roots.push_back(hardest[c].vertex);
    }
    for (std::size_t v = 0; v < n_; ++v) {
      for (std::size_t q = 0; q < m_; ++q) {
        double& r = left_[v * m_ + q];
        r = reached(v) ? r / ranges_.unit(unit_of(v, q)) : 0.0;
      }
    }
    const Vector<double> bound = FlowBound(core_, k_, roots).bound(left_.data(), m_);
    double largest = 0;
    for (std::size_t c = 0; c < components; ++c) {
      if (!held[c] && hardest[c].vertex < 0) continue;
      for (std::size_t q = 0; q < m_; ++q) {
        double error = size[c * m_ + q] + bound[c * m_ + q];
        if (!held[c]) {
          // what flows out of a soft root moves it by its compliance; a point moves as far as its corners differ
          error += bound[c * m_ + q] + hardest[c].softness * std::fabs(left_[at(hardest[c].vertex) * m_ + q]);
        }
        raise(largest, error);
      }
    }
    return largest;
  }

  const ScalarField& field_;
  const surface::Core& core_;
  Memory& memory_;
  const solve::SiteSet& sites_;
  std::size_t n_, m_;
  const solve::Screening* screening_;  // null: none
  const SymmetricMatrix given_;        // of a graph's own weights, where the operator has others
  const SymmetricMatrix& k_;
  Ranges ranges_;
  surface::Workspace u_, left_;  // the field, and its remaining residual
  Vector<double> flux_, site_error_;
  Certificate found_;
  double worst_ = -1;
  bool bounded_;
};

}  // namespace

double certificate_tolerance(double asked, const solve::SiteSolver& engine) {
  if (asked == 0) return engine.tolerance();
  if (!(asked > 0) || !std::isfinite(asked))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "tolerance is %g; it must be above 0 and finite, or 0 for the engine's own", asked);
  return asked;
}

Certificate certify(const ScalarField& field) {
  field.require_sites();
  return Check(field).run();
}

void require_accuracy(const Certificate& found, double tolerance, std::uint32_t vertex) {
  const double worst = std::max({found.error, found.site_error, found.overshoot});
  if (!(worst <= tolerance))
    fail(HF_ERROR_INACCURATE, vertex,
         "the field is wrong by %.3g of the range of its values at vertex %u, more than the tolerance %.3g; make a "
         "new surface of the mesh",
         worst, vertex, tolerance);
}

}  // namespace hf_inner::field

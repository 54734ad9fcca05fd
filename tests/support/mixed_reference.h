// The bi-harmonic field of hard vertex sites on a mesh of any valence, in long double, for tests.
//
// L v = 0 and L u = M v away from the sites; u = s at the sites, and v there such that L u = M v there too. Both are
// solved by an elimination of its own, without the library's factor, and corrected once.
#pragma once
#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "support/dense.h"
#include "surface/core.h"

namespace hf_test {

class MixedReference {
 public:
  using Real = long double;
  MixedReference(const hf_inner::SymmetricMatrix& l, const hf_inner::Vector<double>& inverse_mass,
                 std::vector<int> sites)
      : l_(l), sites_(std::move(sites)), site_of_(static_cast<std::size_t>(l.size()), -1), mass_(site_of_.size(), 1) {
    for (std::size_t v = 0; v < inverse_mass.size(); ++v) mass_[v] = 1 / Real(inverse_mass[v]);
    for (std::size_t i = 0; i < sites_.size(); ++i) site_of_[at(sites_[i])] = static_cast<int>(i);
    eliminate();
  }

  std::vector<Real> field(const std::vector<double>& values) const {
    const std::size_t k = sites_.size();
    std::vector<std::vector<Real>> h;
    for (std::size_t i = 0; i < k; ++i) {
      std::vector<Real> unit(k, 0);
      unit[i] = 1;
      h.push_back(solve(unit, {}));
    }
    std::vector<Real> b(k * k, 0);
    for (std::size_t i = 0; i < k; ++i) {
      for (std::size_t j = 0; j < k; ++j) {
        for (std::size_t v = 0; v < mass_.size(); ++v) b[i * k + j] += mass_[v] * h[i][v] * h[j][v];
      }
    }
    const std::vector<Real> s(values.begin(), values.end()), plain = solve(s, {});
    std::vector<Real> right;
    for (const int site : sites_) right.push_back(row(site, plain));
    const std::vector<Real> c = dense_solve(b, right);
    std::vector<Real> load(mass_.size(), 0);
    for (std::size_t v = 0; v < mass_.size(); ++v) {
      for (std::size_t i = 0; i < k; ++i) load[v] += mass_[v] * c[i] * h[i][v];
    }
    return solve(s, load);
  }

 private:
  static std::size_t at(int v) { return static_cast<std::size_t>(v); }
  // (L u)_v by differences
  Real row(int v, const std::vector<Real>& u) const {
    Real sum = 0;
    for (int i = l_.column_start[at(v)]; i < l_.column_start[at(v) + 1]; ++i)
      sum += Real(l_.value[at(i)]) * (u[at(l_.row[at(i)])] - u[at(v)]);
    return sum;
  }

  void eliminate() {
    const int n = l_.size();
    const auto valence = [&](int v) { return l_.column_start[at(v) + 1] - l_.column_start[at(v)]; };
    for (int v = 0; v < n; ++v)
      if (site_of_[at(v)] < 0) order_.push_back(v);
    std::stable_sort(order_.begin(), order_.end(),
                     [&](int a, int b) { return valence(a) > 100 ? valence(b) > valence(a) : valence(b) > 100; });
    std::vector<std::map<int, Real>> rest(at(n));
    for (const int v : order_) {
      for (int i = l_.column_start[at(v)]; i < l_.column_start[at(v) + 1]; ++i)
        if (site_of_[at(l_.row[at(i)])] < 0) rest[at(v)][l_.row[at(i)]] = l_.value[at(i)];
    }
    column_.resize(at(n));
    pivot_.resize(at(n));
    for (const int v : order_) {
      pivot_[at(v)] = rest[at(v)][v];
      for (const auto& [w, value] : rest[at(v)])
        if (w != v) column_[at(v)].push_back({w, value / pivot_[at(v)]});
      for (const auto& [a, x] : column_[at(v)]) {
        rest[at(a)].erase(v);
        for (const auto& [c, y] : column_[at(v)]) rest[at(a)][c] -= x * y * pivot_[at(v)];
      }
      rest[at(v)].clear();
    }
  }

  // L u = load away from the sites, u = values there; corrected once.
  std::vector<Real> solve(const std::vector<Real>& values, const std::vector<Real>& load) const {
    std::vector<Real> u(mass_.size(), 0);
    for (std::size_t i = 0; i < sites_.size(); ++i) u[at(sites_[i])] = values[i];
    for (int turn = 0; turn < 2; ++turn) {
      std::vector<Real> r(mass_.size(), 0);
      for (const int v : order_) r[at(v)] = (load.empty() ? 0 : load[at(v)]) - row(v, u);
      for (const int v : order_)
        for (const auto& [w, x] : column_[at(v)]) r[at(w)] -= x * r[at(v)];
      for (auto v = order_.rbegin(); v != order_.rend(); ++v) {
        Real sum = r[at(*v)] / pivot_[at(*v)];
        for (const auto& [w, x] : column_[at(*v)]) sum -= x * r[at(w)];
        r[at(*v)] = sum;
      }
      for (const int v : order_) u[at(v)] += r[at(v)];
    }
    return u;
  }

  const hf_inner::SymmetricMatrix& l_;
  std::vector<int> sites_, site_of_, order_;
  std::vector<Real> mass_, pivot_;
  std::vector<std::vector<std::pair<int, Real>>> column_;
};

}  // namespace hf_test

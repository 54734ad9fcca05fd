#include "sequence_model.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "support/dense.h"

namespace sequences {
namespace {

constexpr double updown_penalty = 1e8;  // the default of hf_solver_desc.penalty

bool all_finite(const double* values, std::size_t count) {
  return std::all_of(values, values + count, [](double x) { return std::isfinite(x); });
}

}  // namespace

hf_result Model::locate(const Place& place, Site& site) const {
  const Surface& s = *setting_.surface;
  if (place.triangle == HF_NO_INDEX) {
    if (place.vertex >= s.vertex_count()) return HF_ERROR_OUT_OF_RANGE;
    if (s.inner[place.vertex] < 0) return HF_ERROR_INVALID_ARGUMENT;
    site.given_vertex = place.vertex;
    site.at_vertex = s.inner[place.vertex];
    site.row = {{site.at_vertex, 1.0}};
  } else {
    double sum = 0;
    for (const double w : place.weight) {
      if (!std::isfinite(w)) return HF_ERROR_NON_FINITE;
      if (w < 0) return HF_ERROR_INVALID_ARGUMENT;
      sum += w;
    }
    if (!(std::fabs(sum - 1) <= 1e-6)) return HF_ERROR_INVALID_ARGUMENT;
    if (place.triangle >= s.triangle_count()) return HF_ERROR_OUT_OF_RANGE;
    const std::uint32_t* v = s.triangles.data() + std::size_t{3} * place.triangle;
    site.given_vertex = HF_NO_INDEX;
    site.at_vertex = -1;
    site.row.clear();
    for (int k = 0; k < 3; ++k) {
      if (!(place.weight[k] > 0)) continue;
      const int corner = s.inner[v[k]];
      if (corner < 0) return HF_ERROR_INVALID_ARGUMENT;
      const auto same =
          std::find_if(site.row.begin(), site.row.end(), [&](const auto& e) { return e.first == corner; });
      if (same == site.row.end())
        site.row.emplace_back(corner, place.weight[k]);
      else
        same->second += place.weight[k];
    }
    for (const auto& entry : site.row) {
      if (s.component[at(entry.first)] != s.component[at(site.row[0].first)]) return HF_ERROR_INVALID_ARGUMENT;
    }
    if (site.row.size() == 1) {  // a corner is a vertex, named by its first copy
      site.at_vertex = site.row[0].first;
      site.given_vertex =
          static_cast<std::uint32_t>(std::find(s.inner.begin(), s.inner.end(), site.at_vertex) - s.inner.begin());
    }
  }
  site.component = s.component[at(site.row[0].first)];
  return HF_OK;
}

hf_result Model::claim(const Sites& sites, const std::vector<Site>& more, const Site& site) const {
  if (site.at_vertex < 0) return HF_OK;
  const auto judge_other = [&](const Site& other) {
    if (other.at_vertex != site.at_vertex) return HF_OK;
    const bool same = other.stiffness == site.stiffness && other.values == site.values;
    return same ? HF_ERROR_DUPLICATE : HF_ERROR_CONFLICT;
  };
  for (const auto& other : sites) {
    if (const hf_result code = judge_other(other.second)) return code;
  }
  for (const Site& other : more) {
    if (const hf_result code = judge_other(other)) return code;
  }
  return HF_OK;
}

// Whether the hard sites of some component are linearly dependent. Weights are eighths: dependent or clearly not.
bool Model::dependent(const Sites& sites, const std::vector<Site>& more) const {
  std::vector<const Site*> hard;
  bool points = false;
  const auto take = [&](const Site& site) {
    if (site.stiffness == 0) {
      hard.push_back(&site);
      points = points || site.at_vertex < 0;
    }
  };
  for (const auto& site : sites) take(site.second);
  for (const Site& site : more) take(site);
  if (!points) return false;  // sites at different vertices are independent
  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(hard.size()), setting_.surface->inner_count);
  for (std::size_t i = 0; i < hard.size(); ++i) {
    for (const auto& [vertex, weight] : hard[i]->row) w(static_cast<Eigen::Index>(i), vertex) = weight;
  }
  return hf_test::dense_rank(w.data(), w.rows(), w.cols(), 1e-9) < w.rows();
}

hf_result Model::judge(const Edit& edit) {
  next_ = sites_;
  added_.clear();
  if (edit.remove.size() > sites_.size()) return HF_ERROR_NOT_FOUND;
  const std::size_t left = sites_.size() - edit.remove.size(), m = setting_.channels;
  if (edit.move.size() > left || edit.set.size() > left) return HF_ERROR_NOT_FOUND;
  for (const std::uint32_t number : edit.remove) {
    if (next_.erase(number) == 0) return HF_ERROR_NOT_FOUND;
  }
  std::vector<Site> moving;
  std::vector<std::uint32_t> numbers;
  for (const std::uint32_t number : edit.move) {  // all leave before any arrives
    const auto found = next_.find(number);
    if (found == next_.end()) return HF_ERROR_NOT_FOUND;
    moving.push_back(found->second);
    numbers.push_back(number);
    next_.erase(found);
  }
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (const hf_result code = locate(edit.move_to[i], moving[i])) return code;
    if (const hf_result code = claim(next_, {}, moving[i])) return code;
    next_[numbers[i]] = moving[i];
  }
  for (std::size_t i = 0; i < edit.set.size(); ++i) {
    const auto found = next_.find(edit.set[i]);
    if (found == next_.end()) return HF_ERROR_NOT_FOUND;
    if (!all_finite(edit.set_values.data() + i * m, m)) return HF_ERROR_NON_FINITE;
    found->second.values.assign(edit.set_values.begin() + static_cast<std::ptrdiff_t>(i * m),
                                edit.set_values.begin() + static_cast<std::ptrdiff_t>((i + 1) * m));
  }
  if (next_.size() + edit.add.size() > setting_.site_limit) return HF_ERROR_TOO_LARGE;
  for (std::size_t i = 0; i < edit.add.size(); ++i) {
    Site site;
    if (const hf_result code = locate(edit.add[i], site)) return code;
    site.stiffness = edit.add_stiffness.empty() ? 0.0 : edit.add_stiffness[i];
    if (!std::isfinite(site.stiffness)) return HF_ERROR_NON_FINITE;
    if (site.stiffness < 0) return HF_ERROR_INVALID_ARGUMENT;
    site.values.assign(m, 0.0);
    if (!edit.add_values.empty()) {
      if (!all_finite(edit.add_values.data() + i * m, m)) return HF_ERROR_NON_FINITE;
      std::copy_n(edit.add_values.begin() + static_cast<std::ptrdiff_t>(i * m), m, site.values.begin());
    }
    if (const hf_result code = claim(next_, added_, site)) return code;
    added_.push_back(site);
  }
  // penalties are never dependent
  return setting_.engine != HF_ENGINE_UPDOWN && dependent(next_, added_) ? HF_ERROR_CONFLICT : HF_OK;
}

bool Model::accept(const std::vector<std::uint32_t>& added) {
  for (std::size_t i = 0; i < added_.size(); ++i) {
    if (!next_.emplace(added[i], added_[i]).second) return false;
  }
  sites_ = std::move(next_);
  known_ = false;
  return true;
}

void Model::solve_component(int component) {
  const Surface& s = *setting_.surface;
  std::vector<int> vertices, local(at(s.inner_count), -1);
  for (int v = 0; v < s.inner_count; ++v) {
    if (s.component[at(v)] == component) {
      local[at(v)] = static_cast<int>(vertices.size());
      vertices.push_back(v);
    }
  }
  std::vector<const Site*> sites;
  std::vector<int> places;  // in the order of all sites
  int place = 0;
  for (const auto& site : sites_) {
    if (site.second.component == component) {
      sites.push_back(&site.second);
      places.push_back(place);
    }
    ++place;
  }
  answer_.sites_of_component[at(component)] = static_cast<int>(sites.size());
  const Eigen::Index n = static_cast<Eigen::Index>(vertices.size()), k = static_cast<Eigen::Index>(sites.size());
  const Eigen::Index m = static_cast<Eigen::Index>(setting_.channels);
  if (k == 0) return;
  const double unit = setting_.operation->mean_diagonal[at(component)];
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n + k, n + k), b = Eigen::MatrixXd::Zero(n + k, m), values(k, m);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j)
      a(i, j) =
          setting_.operation->matrix(vertices[static_cast<std::size_t>(i)], vertices[static_cast<std::size_t>(j)]) /
          unit;
  }
  for (Eigen::Index i = 0; i < k; ++i) {
    const Site& site = *sites[static_cast<std::size_t>(i)];
    for (const auto& [vertex, weight] : site.row) {
      a(local[at(vertex)], n + i) -= weight;
      a(n + i, local[at(vertex)]) += weight;
    }
    double stiffness = site.stiffness;
    if (setting_.engine == HF_ENGINE_UPDOWN)
      stiffness = stiffness > 0 ? std::min(stiffness, updown_penalty) : updown_penalty;
    a(n + i, n + i) = stiffness > 0 ? 1 / stiffness : 0.0;
    for (Eigen::Index c = 0; c < m; ++c) values(i, c) = site.values[static_cast<std::size_t>(c)];
  }
  const Eigen::RowVectorXd centre = values.row(0);
  b.bottomRows(k) = values.rowwise() - centre;
  const Eigen::MatrixXd x = hf_test::DenseSolver(a).solve(b);
  for (Eigen::Index i = 0; i < n; ++i) answer_.field.row(vertices[static_cast<std::size_t>(i)]) = x.row(i) + centre;
  for (Eigen::Index i = 0; i < k; ++i) answer_.lambda.row(places[static_cast<std::size_t>(i)]) = unit * x.row(n + i);
  for (Eigen::Index c = 0; c < m; ++c) {
    const double range = values.col(c).maxCoeff() - values.col(c).minCoeff();
    const double overshoot = x.col(c).head(n).maxCoeff() - x.col(c).head(n).minCoeff();
    answer_.scale(component, c) = std::max({range, overshoot, 1e-5 * values.col(c).cwiseAbs().maxCoeff(), 1e-300});
  }
}

const Model::Answer& Model::answer() {
  if (known_) return answer_;
  const Surface& s = *setting_.surface;
  const Eigen::Index m = static_cast<Eigen::Index>(setting_.channels);
  answer_.field = Eigen::MatrixXd::Zero(s.inner_count, m);
  answer_.scale = Eigen::MatrixXd::Zero(s.component_count, m);
  answer_.lambda = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(sites_.size()), m);
  answer_.sites_of_component.assign(at(s.component_count), 0);
  for (int c = 0; c < s.component_count; ++c) solve_component(c);
  known_ = true;
  return answer_;
}

}  // namespace sequences

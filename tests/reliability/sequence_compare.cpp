// Compares a branch of a sequence with its model: sites, fluxes, field.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "sequence_play.h"
#include "support/arrays.h"

namespace sequences {

std::vector<double> Player::field_of(Branch& branch) {
  std::vector<double> field(std::size_t{surface_->vertex_count()} * setting_.channels, -123.0);
  hf_solve_info info = HF_INIT(hf_solve_info);
  const hf_result got = hf_solver_solve(branch.solver, OUT(field.data()), &info);
  if (branch.model.sites().empty()) {
    expect(HF_ERROR_EMPTY, got, "hf_solver_solve");
    hold(std::count(field.begin(), field.end(), -123.0) == static_cast<std::ptrdiff_t>(field.size()),
         "a refused solve wrote");
    return {};
  }
  expect(HF_OK, got, "hf_solver_solve");
  const Model::Answer& answer = branch.model.answer();
  std::uint32_t unreached = 0, first = HF_NO_INDEX, vertices = 0;
  for (int c = surface_->component_count - 1; c >= 0; --c) {
    if (answer.sites_of_component[static_cast<std::size_t>(c)] == 0) {
      ++unreached;
      first = static_cast<std::uint32_t>(c);
    }
  }
  for (std::uint32_t v = 0; v < surface_->vertex_count(); ++v) {
    const int inner = surface_->inner[v];
    vertices +=
        inner < 0 ||
        answer.sites_of_component[static_cast<std::size_t>(surface_->component[static_cast<std::size_t>(inner)])] == 0;
  }
  hold(info.unreached_component_count == unreached && info.first_unreached_component == first &&
           info.unreached_vertex_count == vertices,
       "hf_solve_info is wrong");
  return field;
}

// Largest error over the scale of the component's values.
double Player::error_of(Branch& branch, const std::vector<double>& field) {
  const Model::Answer& answer = branch.model.answer();
  double worst = 0;
  for (std::uint32_t v = 0; v < surface_->vertex_count(); ++v) {
    const int inner = surface_->inner[v];
    for (std::size_t c = 0; c < setting_.channels; ++c) {
      const double got = field[v * setting_.channels + c];
      const Eigen::Index column = static_cast<Eigen::Index>(c);
      const int component = inner < 0 ? -1 : surface_->component[static_cast<std::size_t>(inner)];
      if (component < 0 || answer.sites_of_component[static_cast<std::size_t>(component)] == 0) {
        hold(got == 0, "an unreached vertex is not 0");
        continue;
      }
      const double error = std::fabs(got - answer.field(inner, column)) / answer.scale(component, column);
      hold(error <= 1e300, "a field value is not finite");
      worst = std::max(worst, error);
    }
  }
  return worst;
}

void Player::compare_sites(Branch& branch) {
  const Model::Sites& sites = branch.model.sites();
  const std::size_t count = sites.size(), m = setting_.channels;
  hold(hf_solver_get_site_count(branch.solver) == count, "hf_solver_get_site_count is wrong");
  std::vector<std::uint32_t> numbers(count), vertices(count), components(count);
  std::vector<double> values(count * m), stiffness(count), flux(count * m);
  hf_sites_info info = HF_INIT(hf_sites_info);
  info.capacity = static_cast<std::uint32_t>(count);
  info.sites = numbers.data();
  info.vertices = vertices.data();
  info.components = components.data();
  info.values = values.data();
  info.stiffness = stiffness.data();
  info.flux = flux.data();
  expect(HF_OK, hf_solver_get_sites(branch.solver, &info), "hf_solver_get_sites");
  const Model::Answer& answer = branch.model.answer();
  std::size_t i = 0;
  for (const auto& [number, site] : sites) {
    const bool same =
        numbers[i] == number && vertices[i] == site.given_vertex &&
        components[i] == static_cast<std::uint32_t>(site.component) && stiffness[i] == site.stiffness &&
        std::equal(site.values.begin(), site.values.end(), values.begin() + static_cast<std::ptrdiff_t>(i * m));
    hold(same, "hf_solver_get_sites: site " + std::to_string(number) + " is not what was set");
    for (std::size_t c = 0; c < m && setting_.engine != ENGINE_UPDOWN; ++c) {
      const Eigen::Index column = static_cast<Eigen::Index>(c);
      // the fluxes of crowded points are far larger than those of the field
      const double unit = std::max(setting_.operation->mean_diagonal[static_cast<std::size_t>(site.component)] *
                                       answer.scale(site.component, column),
                                   answer.lambda.col(column).cwiseAbs().maxCoeff());
      const double error = std::fabs(flux[i * m + c] - answer.lambda(static_cast<Eigen::Index>(i), column)) / unit;
      char text[96];
      std::snprintf(text, sizeof text, "hf_solver_get_sites: the flux of site %u is off by %.3g of its scale", number,
                    error);
      hold(error <= (setting_.engine == ENGINE_GREEN ? 1e-8 : 1e-6), text);
    }
    ++i;
  }
}

void Player::compare(Branch& branch) {
  compare_sites(branch);
  const std::vector<double> field = field_of(branch);
  if (field.empty()) return;
  const double error = error_of(branch, field);
  double& worst = outcome_.worst[static_cast<std::size_t>(setting_.engine)];
  worst = std::max(worst, error);
  const double most = setting_.engine == ENGINE_UPDOWN     ? penalty_tolerance
                      : setting_.engine == ENGINE_REFACTOR ? baseline_tolerance
                                                           : exact_tolerance;
  char text[64];
  std::snprintf(text, sizeof text, "the field is off by %.3g of its scale", error);
  hold(error <= most, text);
}

// A kept clone has the sites and the bits that its solver had when it was made.
void Player::compare_kept(Branch& clone) {
  compare_sites(clone);
  const std::vector<double> field = field_of(clone);
  const std::size_t bytes = sizeof(double) * field.size();
  hold(field.size() == clone.kept_field.size() &&
           (bytes == 0 || std::memcmp(field.data(), clone.kept_field.data(), bytes) == 0),
       "a kept clone has other bits than its solver had");
}

}  // namespace sequences

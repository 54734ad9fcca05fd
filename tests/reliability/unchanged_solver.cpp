// Solvers: sites of every form, batches, undo and redo, clones, a rebase prepared and waiting, previews, certificates.
#include "unchanged_solver.h"

#include <cmath>

namespace unchanged {

std::string Solvers::compare_fresh(const SolverBranch& b) const {
  const std::uint32_t count = hf_solver_get_site_count(b.handle);
  std::vector<double> values(count * channels_), stiffness(count), radii(count);
  std::vector<double> field(rows()), other(rows());
  hf_sites_info info = HF_INIT(hf_sites_info);
  info.capacity = count, info.values = values.data(), info.stiffness = stiffness.data(), info.radii = radii.data();
  if (count == 0) return {};
  if (hf_solver_get_sites(b.handle, &info) != HF_OK) return "its sites are not told";
  hf_solver fresh = nullptr;
  if (hf_create(world.surface, &desc_, &fresh) != HF_OK) return "a fresh solver is refused";
  hf_result result = HF_OK;
  std::size_t i = 0;
  for (const auto& site : b.places) {
    Lists one;
    one.places = {site.second};
    one.values.assign(&values[i * channels_], &values[i * channels_] + channels_);
    one.stiffness = {stiffness[i]}, one.radii = {radii[i]}, one.finish(), ++i;
    if (result == HF_OK) result = hf_add_sites(fresh, &one.desc, nullptr);
  }
  if (result == HF_OK) result = hf_solver_solve_f64(fresh, other.data(), 0, nullptr);
  if (result == HF_OK) result = hf_solver_solve_f64(b.handle, field.data(), 0, nullptr);
  hf_solver_destroy(fresh);
  // points that are just independent may be refused in another order
  if (result != HF_OK) return result == HF_ERROR_CONFLICT ? "" : hf_result_get_name(result);
  double scale = 1e-300;
  for (const double v : values) scale = std::fmax(scale, std::fabs(v));
  double most = 0;
  for (std::size_t v = 0; v < field.size(); ++v) most = std::fmax(most, std::fabs(field[v] - other[v]));
  const double tolerance = desc_.engine == HF_ENGINE_GREEN    ? 1e-9
                           : desc_.engine == HF_ENGINE_UPDOWN ? 1e-6  // a penalty of 1e8 costs half of the digits
                                                              : 1e-7;
  return most <= tolerance * scale ? "" : "a fresh solver differs by " + text(most / scale);
}

std::unique_ptr<Subject> make_solvers(World& world, Random& random) {
  auto made = std::make_unique<Solvers>(world, random);
  return made->ready() ? std::move(made) : nullptr;
}

}  // namespace unchanged

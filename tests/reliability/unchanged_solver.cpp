// Solvers on meshes and graphs: sites of every form, batches, clones, screening, a rebase prepared and waiting,
// previews, certificates.
#include "unchanged_solver.h"
#include "support/arrays.h"

#include <cmath>

namespace unchanged {

std::string Solvers::compare_fresh(const SolverBranch& b) const {
  const std::uint32_t count = hf_solver_get_site_count(b.handle);
  std::vector<double> values(count * channels_), stiffness(count), radii(count);
  std::vector<double> field(rows()), other(rows());
  hf_sites_info info = HF_INIT(hf_sites_info);
  info.capacity = count;
  info.values = values.data();
  info.stiffness = stiffness.data();
  info.radii = radii.data();
  if (count == 0 && b.screening.strength.empty()) return {};
  if (hf_solver_get_sites(b.handle, &info) != HF_OK) return "its sites are not told";
  hf_solver fresh = nullptr;
  if (create_with(engine_, surface(), &desc_, &fresh) != HF_OK) return "a fresh solver is refused";
  const bool before = count % 2 == 0;  // of the sites, or after them
  hf_result result = b.screening.strength.empty() || !before ? HF_OK : b.screening.set(fresh);
  std::size_t i = 0;
  for (const auto& site : b.places) {
    Lists one;
    one.places = {site.second};
    one.values.assign(&values[i * channels_], &values[i * channels_] + channels_);
    one.stiffness = {stiffness[i]};
    one.radii = {radii[i]};
    one.finish();
    ++i;
    if (result == HF_OK) result = hf_add_sites(fresh, &one.desc, nullptr);
  }
  if (result == HF_OK && !b.screening.strength.empty() && !before) result = b.screening.set(fresh);
  if (result == HF_OK) result = hf_solver_solve(fresh, OUT(other.data()), nullptr);
  const hf_result own = hf_solver_solve(b.handle, OUT(field.data()), nullptr);
  hf_solver_destroy(fresh);
  if (count == 0 && result == own && own == HF_ERROR_EMPTY) return {};  // screening of 0 everywhere
  if (result == HF_OK) result = own;
  // points that are just independent may be refused in another order
  if (result != HF_OK) return result == HF_ERROR_CONFLICT ? "" : hf_result_get_name(result);
  double scale = 1e-300;
  for (const double v : values) scale = std::fmax(scale, std::fabs(v));
  for (const double v : b.screening.targets) scale = std::fmax(scale, std::fabs(v));
  double most = 0;
  for (std::size_t v = 0; v < field.size(); ++v) most = std::fmax(most, std::fabs(field[v] - other[v]));
  const double tolerance = engine_ == ENGINE_GREEN    ? 1e-9
                           : engine_ == ENGINE_UPDOWN ? 1e-6  // a penalty of 1e8 costs half of the digits
                                                      : 1e-7;
  return most <= tolerance * scale ? "" : "a fresh solver differs by " + text(most / scale);
}

// The edges of the triangles, with weights of any sizes.
void Solvers::make_graph(Random& random) {
  const std::vector<std::uint32_t>& t = world.shape->triangles;
  std::vector<std::uint32_t> edges;
  std::vector<double> weights;
  for (std::size_t i = 0; i < t.size(); ++i) {
    edges.push_back(t[i]);
    edges.push_back(t[i % 3 == 2 ? i - 2 : i + 1]);
    weights.push_back(random.real(0.1, 2));
  }
  hf_graph_desc desc = HF_INIT(hf_graph_desc);
  desc.vertex_count = world.shape->vertices();
  desc.edges = HF_ARRAY(edges.data(), weights.size());
  desc.weights = HF_ARRAY(weights.data(), weights.size());
  desc.field_kind = world.desc.field_kind;
  desc.allocator = world.memory.hooks();
  desc.memory_limit_mb = world.desc.memory_limit_mb;
  if (hf_surface_create_graph(&desc, &graph_) != HF_OK) graph_ = nullptr;
  world.graph = graph_;
}

std::unique_ptr<Subject> make_solvers(World& world, Random& random) {
  auto made = std::make_unique<Solvers>(world, random);
  return made->ready() ? std::move(made) : nullptr;
}

}  // namespace unchanged

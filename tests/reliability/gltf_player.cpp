#include "gltf_player.h"

#include <sys/resource.h>
#include <time.h>

#include <cctype>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "common/mesh_file.h"
#include "gltf/animate.h"
#include "gltf/gltf_read.h"
#include "gltf/gltf_write.h"
#include "gltf/skin_write.h"
#include "hf/hf.h"

namespace hostile {
namespace {

using namespace samples;
using namespace hf_gltf;

struct Wrong : std::logic_error {
  using std::logic_error::logic_error;
};

void hold(bool condition, const char* what) {
  if (!condition) throw Wrong(what);
}

// Picks a used vertex by its own position, and casts a ray at it. The vertex found must be there; a hit must be finite.
void pick(hf_surface surface, const FlatMesh& mesh, std::uint32_t vertex, double box) {
  const glm::dvec3& p = mesh.positions[vertex];
  const double point[3] = {p.x, p.y, p.z}, along[3] = {1, 2, 3};
  std::uint32_t nearest = HF_NO_INDEX;
  double distance = -1;
  hold(hf_surface_find_vertex(surface, point, nullptr, &nearest, &distance) == HF_OK, "hf_surface_find_vertex failed");
  hold(nearest < mesh.vertex_count() && distance >= 0 && distance <= 1e-9 * box, "the nearest vertex is elsewhere");
  hf_hit hit = HF_INIT(hf_hit);
  hold(hf_surface_cast_ray(surface, point, along, nullptr, &hit) == HF_OK, "hf_surface_cast_ray failed");
  hold(hit.found == (hit.triangle != HF_NO_INDEX), "a hit without a triangle");
  if (!hit.found) return;
  hold(hit.triangle < mesh.triangle_count() && std::isfinite(hit.distance), "a hit is nowhere");
  const double sum = hit.place.barycentrics[0] + hit.place.barycentrics[1] + hit.place.barycentrics[2];
  hold(std::fabs(sum - 1) <= 1e-9, "barycentrics of a hit do not sum to 1");
}

// Makes a surface, or checks the documented code of a refusal. Then it adds a site at the first vertex of every
// component and checks the field.
bool solve(const FlatMesh& mesh) {
  const std::vector<double> positions = double_positions(mesh.positions);
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.vertex_count = mesh.vertex_count();
  desc.triangle_count = mesh.triangle_count();
  desc.positions_f64 = positions.data();
  desc.triangles = mesh.triangles.data();
  desc.vertex_limit = 200000;
  desc.memory_limit_mb = 256;
  struct Owner {
    hf_surface surface = nullptr;
    hf_solver solver = nullptr;
    ~Owner() {
      hf_solver_destroy(solver);
      hf_surface_destroy(surface);
    }
  } owner;
  const hf_result made = hf_surface_create(&desc, &owner.surface);
  const hf_surface surface = owner.surface;
  if (made != HF_OK) {
    hold(surface == nullptr, "a refused hf_surface_create gave a handle");
    // a mesh may be empty, far too large, or hold numbers that overflow a double when squared
    hold(made == HF_ERROR_EMPTY || made == HF_ERROR_TOO_LARGE || made == HF_ERROR_OUT_OF_MEMORY ||
             made == HF_ERROR_NON_FINITE,
         hf_result_get_name(made));
    return false;
  }
  hold(hf_create(surface, nullptr, &owner.solver) == HF_OK, "hf_create failed");
  const hf_solver solver = owner.solver;
  std::vector<std::uint32_t> component(mesh.vertex_count());
  hold(hf_surface_get_components(surface, mesh.vertex_count(), component.data(), nullptr) == HF_OK,
       "hf_surface_get_components failed");
  std::vector<std::uint32_t> places;
  std::vector<bool> seen(mesh.vertex_count(), false);
  for (std::uint32_t v = 0; v < mesh.vertex_count() && places.size() < 64; ++v) {
    if (component[v] == HF_NO_INDEX || seen[component[v]]) continue;
    seen[component[v]] = true;
    places.push_back(v);
  }
  if (places.empty()) return false;
  std::vector<double> values(places.size()), field(mesh.vertex_count());
  for (std::size_t i = 0; i < places.size(); ++i) values[i] = static_cast<double>(i % 7);
  hf_sites_desc sites = HF_INIT(hf_sites_desc);
  sites.site_count = static_cast<std::uint32_t>(places.size());
  sites.vertices = places.data();
  sites.values = values.data();
  hold(hf_add_sites(solver, &sites, nullptr) == HF_OK, "hf_add_sites refused first vertices of components");
  // one more site on the last vertex of the first component makes the field vary
  for (std::uint32_t v = mesh.vertex_count(); v-- > 0;) {
    if (component[v] != component[places[0]] || mesh.positions[v] == mesh.positions[places[0]]) continue;
    const double value = 10;
    sites.site_count = 1;
    sites.vertices = &v;
    sites.values = &value;
    const hf_result added = hf_add_sites(solver, &sites, nullptr);
    hold(added == HF_OK, hf_result_get_name(added));
    break;
  }
  hold(hf_solver_solve_f64(solver, field.data(), 0, nullptr) == HF_OK, "hf_solver_solve_f64 failed");
  // with degenerate triangles (a vertex at 1e30, say) only finite values are promised
  hf_surface_report report = HF_INIT(hf_surface_report);
  hold(hf_surface_get_report(surface, &report) == HF_OK, "hf_surface_get_report failed");
  const bool sound = report.degenerate_triangle_count == 0;
  for (const double u : field) {
    hold(std::isfinite(u), "a field value is not finite");
    hold(!sound || (u >= -1e-6 && u <= 10 + 1e-6), "a field value lies outside the values of its sites");
  }
  pick(surface, mesh, places[0], report.bounding_box_diagonal);
  return true;
}

bool use(Model model) {
  const FlatMesh mesh = flatten(model);
  for (const Animation& animation : model.animations) {
    for (const double t : {0.0, 0.3 * clip_duration(animation), 1e9}) posed_positions(model, mesh, animation, t);
  }
  welded_normals(mesh, mesh.positions, true);
  const bool solved = solve(mesh);
  const std::string bytes = gltf_bytes(model, true);
  read_gltf_bytes({bytes.begin(), bytes.end()}, "again.glb");
  scatter(model, mesh, mesh.positions);
  return solved;
}

Outcome outcome_of(const std::function<bool()>& work) {
  Outcome outcome;
  try {
    outcome.solved = work();
  } catch (const Wrong& wrong) {
    outcome.ending = Ending::wrong;
    outcome.what = wrong.what();
  } catch (const std::runtime_error& error) {
    const std::string sentence = error.what();
    outcome.ending = sentence.size() > 10 && sentence.find('\n') == std::string::npos ? Ending::refused : Ending::wrong;
    outcome.what = sentence;
  } catch (const std::exception& error) {
    outcome.ending = Ending::wrong;
    outcome.what = std::string("another exception: ") + error.what();
  }
  return outcome;
}

}  // namespace

Outcome play_gltf(const std::vector<std::uint8_t>& bytes) {
  return outcome_of([&] { return use(read_gltf_bytes(bytes, "hostile.glb")); });
}

Outcome play_file(const std::filesystem::path& file) {
  return outcome_of([&] {
    std::string extension = file.extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (extension == ".gltf" || extension == ".glb") return use(read_gltf(file));
    const FlatMesh mesh = to_flat_mesh(read_mesh_file(file));
    welded_normals(mesh, mesh.positions);
    return solve(mesh);
  });
}

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

}  // namespace hostile

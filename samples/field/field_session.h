// A solver, the numbers of its sites by place, and the analyses of its field. It wraps the C functions of hf/solver.h
// and hf/analysis.h with std::vector.
#ifndef HF_SAMPLES_FIELD_SESSION_H
#define HF_SAMPLES_FIELD_SESSION_H

#include <map>
#include <tuple>
#include <vector>

#include "common/mesh_file.h"
#include "field/field_options.h"
#include "hf/hf.h"

namespace samples {

// Throws the detail of the failing call.
void check(hf_result result);

struct IsoLine {
  std::vector<glm::dvec3> points;
  uint32_t level = 0;
  bool closed = false;
};

class Session {
 public:
  Session(const SurfaceMesh& mesh, const FieldOptions& options);
  ~Session() {
    destroy(past_);
    destroy(undone_);
    hf_direction_destroy(direction_);
    hf_solver_destroy(solver_);
    hf_surface_destroy(surface_);
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  hf_surface surface() const { return surface_; }
  hf_solver solver() const { return solver_; }
  size_t components() const { return components_; }
  uint32_t site_count() const {
    return direction_ ? hf_direction_get_site_count(direction_) : hf_solver_get_site_count(solver_);
  }

  void apply(const Edit& edit);
  // One row of components() values per vertex.
  std::vector<double> solve(hf_solve_info& info) const;
  // Places of all sites, for pictures.
  std::vector<glm::dvec3> positions(const SurfaceMesh& mesh) const;

  // Tells for each vertex whether its component has a site.
  std::vector<bool> reached(const std::vector<double>& field) const;

  std::vector<hf_extremity> extremities(int kind) const;
  // Geodesic distance of every vertex to the nearest source, or -1 where there is no path.
  std::vector<double> distance(const std::vector<uint32_t>& sources) const;
  std::vector<double> levels(const std::vector<double>& field, int spacing, int count) const;
  std::vector<IsoLine> isolines(const std::vector<double>& field, const std::vector<double>& levels) const;
  // The singularities of a direction field; empty for other fields.
  std::vector<hf_singularity> singularities() const;
  std::vector<hf_critical_point> critical_points(const std::vector<double>& field, hf_critical_info& info) const;

 private:
  static constexpr uint32_t no_triangle = 0xFFFFFFFFu;
  struct Order {
    bool operator()(const Place& a, const Place& b) const {
      return std::tie(a.triangle, a.vertex, a.weights) < std::tie(b.triangle, b.vertex, b.weights);
    }
  };
  using Numbers = std::map<Place, uint32_t, Order>;

  uint32_t number(const Place& place) const;
  void change(const Edit& edit);
  void change_directions(const Edit& edit);

  hf_surface surface_ = nullptr;
  hf_solver solver_ = nullptr;
  hf_direction direction_ = nullptr;  // of a direction field, with sites of its own
  uint32_t vertex_count_;
  size_t components_;
  std::vector<uint32_t> triangles_;  // of the file
  Numbers sites_;
  struct State {
    hf_solver solver;
    hf_direction direction;
    Numbers sites;
  };
  State copy() const;
  static void destroy(std::vector<State>& states);
  std::vector<State> past_, undone_;
};

// Proposes sites for an unknown mesh: its extremities. If a component has fewer than two, the vertex farthest from the
// first is added. The values alternate between 0 and 1, or are vectors along the surface. Every component gets sites.
std::vector<SiteArgument> propose_sites(const SurfaceMesh& mesh, const Session& session, int extremities);

}  // namespace samples

#endif

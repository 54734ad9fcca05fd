// A solver and the numbers of its sites by place, and what the library finds out about a field: the C functions of
// hf/solver.h and hf/analysis.h with std::vector.
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
    hf_direction_destroy(direction_);
    hf_solver_destroy(solver_), hf_surface_destroy(surface_);
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
  // One row of components() values a vertex.
  std::vector<double> solve(hf_solve_info& info) const;
  // Places of all sites, for pictures.
  std::vector<glm::dvec3> positions(const SurfaceMesh& mesh) const;

  // Whether a site is in the component of each vertex.
  std::vector<bool> reached() const;

  std::vector<hf_extremity> extremities(int kind) const;
  // Geodesic distance of every vertex to the nearest source, -1 where there is none.
  std::vector<double> distance(const std::vector<uint32_t>& sources) const;
  std::vector<double> levels(const std::vector<double>& field, int spacing, int count) const;
  std::vector<IsoLine> isolines(const std::vector<double>& field, const std::vector<double>& levels) const;
  // Of a direction field; empty for others.
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
  Numbers sites_;
  std::vector<Numbers> undone_from_, redone_from_;
};

// Sites for a mesh one knows nothing of: its extremities, and where a component has fewer than two, the vertex farthest
// from the first; with the values 0 and 1 in turn, or vectors along the surface. Every vertex is reached.
std::vector<SiteArgument> propose_sites(const SurfaceMesh& mesh, const Session& session, int extremities);

}  // namespace samples

#endif

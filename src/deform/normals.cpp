#include "deform/normals.h"

#include <cmath>

namespace hf {

void vertex_normals(const Mesh& mesh, const Rest& rest, const Vec3* positions, Vec3* triangle_normals, Vec3* normals,
                    JobRunner& jobs) {
  for_vertex_pieces(jobs, mesh.triangle_count(), [&](std::int32_t first, std::int32_t last) {
    for (std::int32_t t = first; t < last; ++t) {
      const std::int32_t* corner = mesh.triangle(t);
      const Vec3 p = positions[corner[0]];
      triangle_normals[t] = cross(positions[corner[1]] - p, positions[corner[2]] - p);
    }
  });
  for_vertex_pieces(jobs, mesh.vertex_count(), [&](std::int32_t first, std::int32_t last) {
    for (std::int32_t v = first; v < last; ++v) {
      Vec3 sum;
      for (std::int32_t k = rest.incident_start[v]; k < rest.incident_start[v + 1]; ++k)
        sum = sum + triangle_normals[rest.incident[k]];
      const double length = std::sqrt(dot(sum, sum));
      normals[v] = length > 1e-150 && length < 1e150 ? (1.0 / length) * sum : Vec3{0, 0, 1};
    }
  });
}

}  // namespace hf

#include "field/vector_field.h"

namespace hf {

Vector<Vec3> vertex_normals(const Mesh& mesh, Memory& memory) {
  const auto at = [](std::int32_t i) { return static_cast<std::size_t>(i); };
  Vector<Vec3> normals(mesh.positions.size(), &memory);
  for (std::int32_t t = 0; t < mesh.triangle_count(); ++t) {
    const std::int32_t* v = mesh.triangle(t);
    const Vec3 a = mesh.positions[at(v[0])];
    const Vec3 n = cross(mesh.positions[at(v[1])] - a, mesh.positions[at(v[2])] - a);
    for (int k = 0; k < 3; ++k) normals[at(v[k])] = normals[at(v[k])] + n;
  }
  for (Vec3& n : normals) {
    const double length = norm(n);
    n = length > 0 ? (1 / length) * n : Vec3{};
  }
  return normals;
}

void project_on_tangent_planes(const Vector<Vec3>& normals, double* vectors) noexcept {
  for (std::size_t v = 0; v < normals.size(); ++v) {
    double* p = vectors + 3 * v;
    const Vec3 n = normals[v];
    for (int pass = 0; pass < 2; ++pass) {
      const double along = n.x * p[0] + n.y * p[1] + n.z * p[2];
      p[0] -= along * n.x, p[1] -= along * n.y, p[2] -= along * n.z;
    }
  }
}

}  // namespace hf

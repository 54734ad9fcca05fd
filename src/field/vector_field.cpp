#include "field/vector_field.h"

namespace hf_inner::field {

Vector<Vec3> vertex_normals(const mesh::Mesh& mesh, Memory& memory) {
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

Vec3 vertex_normal(const mesh::Mesh& mesh, const mesh::Topology& topology, std::int32_t vertex) noexcept {
  const auto at = [](std::int32_t i) { return static_cast<std::size_t>(i); };
  Vec3 sum;
  for (std::int32_t i = topology.neighbour_start[at(vertex)]; i < topology.neighbour_start[at(vertex) + 1]; ++i) {
    const std::int32_t e = topology.neighbour_edge[at(i)], next = topology.neighbour[at(i)];
    for (std::int32_t s = topology.edge_triangle_start[at(e)]; s < topology.edge_triangle_start[at(e) + 1]; ++s) {
      const std::int32_t* t = mesh.triangle(topology.triangle(s));
      const int k = t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2;
      if (t[(k + 1) % 3] != next) continue;  // every triangle from the edge that leaves the vertex
      const Vec3 a = mesh.positions[at(vertex)];
      sum = sum + cross(mesh.positions[at(next)] - a, mesh.positions[at(t[(k + 2) % 3])] - a);
    }
  }
  const double length = norm(sum);
  return length > 0 ? (1 / length) * sum : Vec3{};
}

void project_on_tangent_planes(const Vector<Vec3>& normals, double* vectors) noexcept {
  for (std::size_t v = 0; v < normals.size(); ++v) {
    double* p = vectors + 3 * v;
    const Vec3 n = normals[v];
    for (int pass = 0; pass < 2; ++pass) {
      const double along = n.x * p[0] + n.y * p[1] + n.z * p[2];
      p[0] -= along * n.x;
      p[1] -= along * n.y;
      p[2] -= along * n.z;
    }
  }
}

}  // namespace hf_inner::field

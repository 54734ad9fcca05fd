#include "mesh/skin_shape.h"

#include <algorithm>

#include "mesh/orientation.h"

namespace hf_inner::mesh {
namespace {

// Three rays tell whether a point is inside. Most of them decide, so that one that passes along a seam does not. They
// are parallel to no axis, since faces of models often are. Turned to other axes, and reversed, they leave the same
// figures of ten shared rigs.
constexpr double ray_directions[3][3] = {{0.83, 0.41, 0.37}, {-0.31, 0.87, -0.38}, {0.29, -0.43, 0.85}};
// A ray of this length, in boxes, leaves the box from any point in it. No result depends on it above 1; 1.2 and 8 find
// the same bones of 14 shared rigs outside.
constexpr double ray_length = 4;

Vec3 area_vector(const Mesh& mesh, Index t) noexcept {
  const Index* v = mesh.triangle(t);
  const Vec3 a = mesh.positions[at(v[0])];
  return cross(mesh.positions[at(v[1])] - a, mesh.positions[at(v[2])] - a);
}

}  // namespace

SkinShape::SkinShape(const Mesh& mesh, Memory& memory)
    : mesh_(mesh),
      side_(component_sides(mesh, memory)),
      normals_(&memory),
      tree_(triangle_boxes(mesh.positions, mesh.corners, memory), memory) {
  normals_.assign(at(mesh.vertex_count()), Vec3{});
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const Vec3 area = area_vector(mesh, t);
    for (int k = 0; k < 3; ++k) {
      Vec3& normal = normals_[at(mesh.triangle(t)[k])];
      normal = normal + area;
    }
  }
  for (std::size_t v = 0; v < normals_.size(); ++v) {
    const double length = norm(normals_[v]);
    normals_[v] = length > 0 ? (side_[at(mesh.component[v])] / length) * normals_[v] : Vec3{};
  }
}

bool SkinShape::crosses(const Vec3& from, const Vec3& to, Index piece, Index own, bool outwards) const noexcept {
  const Vec3 way = to - from;
  const bool turned = (side_[at(piece)] < 0) != outwards;
  return tree_.along(from, to, [&](Index t) {
    const Index* v = mesh_.triangle(t);
    if (mesh_.component[at(v[0])] != piece || v[0] == own || v[1] == own || v[2] == own) return false;
    bool entering = false;
    const double where =
        crossing(from, way, mesh_.positions[at(v[0])], mesh_.positions[at(v[1])], mesh_.positions[at(v[2])], entering);
    return where >= 0 && entering != turned;
  });
}

double SkinShape::way_out(const Vec3& from, const Vec3& direction, double most) const noexcept {
  double nearest = most;
  tree_.along(from, from + most * direction, [&](Index t) {
    const Index* v = mesh_.triangle(t);
    bool entering = false;
    const double where = most * crossing(from, most * direction, mesh_.positions[at(v[0])], mesh_.positions[at(v[1])],
                                         mesh_.positions[at(v[2])], entering);
    const bool turned = side_[at(mesh_.component[at(v[0])])] < 0;
    if (where >= 0 && entering == turned && where < nearest) nearest = where;
    return false;
  });
  return nearest;
}

void SkinShape::pieces_along(const Vec3& from, const Vec3& to, Vector<Index>& out) const {
  out.clear();
  const Vec3 way = to - from;
  tree_.along(from, to, [&](Index t) {
    const Index* v = mesh_.triangle(t);
    bool entering = false;
    if (crossing(from, way, mesh_.positions[at(v[0])], mesh_.positions[at(v[1])], mesh_.positions[at(v[2])],
                 entering) >= 0)
      out.push_back(mesh_.component[at(v[0])]);
    return false;
  });
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
}

bool SkinShape::inside(const Vec3& point) const noexcept {
  int votes = 0;
  for (const auto& d : ray_directions) {
    int out = 0;
    const Vec3 way = ray_length * Vec3{d[0], d[1], d[2]};
    tree_.along(point, point + way, [&](Index t) {
      const Index* v = mesh_.triangle(t);
      bool entering = false;
      const double where = crossing(point, way, mesh_.positions[at(v[0])], mesh_.positions[at(v[1])],
                                    mesh_.positions[at(v[2])], entering);
      const bool turned = side_[at(mesh_.component[at(v[0])])] < 0;
      if (where >= 0) out += entering == turned ? 1 : -1;
      return false;
    });
    votes += out > 0;
  }
  return votes >= 2;
}

}  // namespace hf_inner::mesh

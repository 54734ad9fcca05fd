#include "remesh/quad_faults.h"

#include "mesh/box_tree.h"

namespace hf_inner::remesh {
namespace {

struct HalfQuad {
  const std::int32_t* quad;
  Vec3 corner[3];
  mesh::ItemBox box;
};

double volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept {
  return dot(cross(b - a, c - a), d - a);
}

// Both ends on different sides of the triangle, and all three edges of it passed on the same side.
bool passes(const Vec3& p, const Vec3& q, const Vec3* t) noexcept {
  const double from = volume(t[0], t[1], t[2], p), to = volume(t[0], t[1], t[2], q);
  if (!((from < 0 && to > 0) || (from > 0 && to < 0))) return false;
  const double a = volume(p, q, t[0], t[1]), b = volume(p, q, t[1], t[2]), c = volume(p, q, t[2], t[0]);
  return (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
}

bool cross_each_other(const HalfQuad& a, const HalfQuad& b) noexcept {
  if (mesh::squared_distance(a.box, b.box) > 0) return false;
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 4; ++k) {
      if (a.quad[i] == b.quad[k]) return false;
    }
  }
  for (int k = 0; k < 3; ++k) {
    if (passes(a.corner[k], a.corner[(k + 1) % 3], b.corner) || passes(b.corner[k], b.corner[(k + 1) % 3], a.corner))
      return true;
  }
  return false;
}

}  // namespace

QuadFaults faults_near(const QuadMesh& mesh, const Vec3& place, double radius, Memory& memory) {
  QuadFaults out;
  Vector<HalfQuad> halves(&memory);
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    const std::int32_t* c = mesh.quad(f);
    Vec3 p[4];
    bool near = false;
    for (int k = 0; k < 4; ++k) {
      p[k] = mesh.position[c[k]];
      near = near || norm(p[k] - place) <= radius;
    }
    if (!near) continue;
    const Vec3 normal = cross(p[2] - p[0], p[3] - p[1]);
    for (int k = 0; k < 4; ++k) out.turned += !(dot(cross(p[(k + 1) % 4] - p[k], p[(k + 3) % 4] - p[k]), normal) > 0);
    for (int k = 1; k < 3; ++k) {
      HalfQuad half{c, {p[0], p[k], p[k + 1]}, mesh::ItemBox::of(p[0])};
      half.box.take(p[k]);
      half.box.take(p[k + 1]);
      halves.push_back(half);
    }
  }
  for (std::size_t i = 0; i < halves.size(); ++i) {
    for (std::size_t k = i + 1; k < halves.size(); ++k) out.crossing += cross_each_other(halves[i], halves[k]);
  }
  return out;
}

}  // namespace hf_inner::remesh

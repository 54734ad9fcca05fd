// The full-mesh step against the normal equations of its energy, written out here.
#include <gtest/gtest.h>

#include "cases.h"

namespace {

using namespace hf_inner;
using namespace deform_test;

// use(w, neighbour) for the ring of a vertex in the triangulation of the operator.
template <class Use>
void for_operator_ring(const hf_inner::Core& core, std::int32_t v, Use&& use) {
  const hf_inner::SymmetricMatrix& k = core.laplacian;
  for (std::int32_t e = k.column_start[v]; e < k.column_start[v + 1]; ++e) {
    if (k.row[e] != v) use(-k.value[e], k.row[e]);
  }
}

// The rotation of every ring in x against the rest p; vertices of handles have those of their handles.
std::vector<Quaternion> operator_rotations(const hf_inner::Core& core, const std::vector<std::int32_t>& owner,
                                           const std::vector<Quaternion>& turn, const std::vector<Vec3>& p,
                                           const std::vector<Vec3>& x) {
  std::vector<Quaternion> out;
  for (std::int32_t v = 0; v < core.size(); ++v) {
    Mat3 s;
    for_operator_ring(core, v, [&](double w, std::int32_t u) { add_outer(s, w, x[v] - x[u], p[v] - p[u]); });
    out.push_back(owner[v] < 0 ? best_rotation(s, {}) : turn[owner[v]]);
  }
  return out;
}

double operator_energy(const hf_inner::Core& core, const std::vector<Quaternion>& rotation, const std::vector<Vec3>& p,
                       const std::vector<Vec3>& x) {
  double sum = 0;
  for (std::int32_t v = 0; v < core.size(); ++v) {
    for_operator_ring(core, v, [&](double w, std::int32_t u) {
      const Vec3 d = x[v] - x[u] - rotate(rotation[v], p[v] - p[u]);
      sum += w * dot(d, d);
    });
  }
  return sum;
}

TEST(Refine, OneStepLeadsToTheMinimumForItsRotationsOnObtuseTrianglesToo) {
  // sheared until every second corner is beyond 150 degrees: many cotangents of its own edges are negative
  Case c = plane_lift(41);
  for (std::size_t k = 0; k < c.mesh.positions.size(); k += 3) c.mesh.positions[k] += 2 * c.mesh.positions[k + 2];
  c.regions = {[](Vec3 p) { return std::max(std::fabs(p.x - 2 * p.z), std::fabs(p.z)) > 0.9; },
               [](Vec3 p) { return std::hypot(p.x - 2 * p.z, p.z) < 0.2; }};
  c.motion = [](std::size_t, double t, Vec3) { return HandleTransform{about({1, 0, 0}, 0.5 * t), {0, 0.6 * t, 0}}; };
  Dragged d = drag(c, {}, 10, 5);
  while (d.pose->deform({false, 100, false}).iteration_count > 0) continue;  // later frames start from the same pose
  const std::vector<Vec3> before = positions(d.pose->deform({}));
  DeformRequest request;
  request.iteration_count = 1, request.refine = true;
  const std::vector<Vec3> after = positions(d.pose->deform(request));
  std::vector<std::int32_t> owner(static_cast<std::size_t>(d.core->size()), -1);
  std::vector<Quaternion> turn;
  for (std::size_t h = 0; h < c.regions.size(); ++h) {
    for (const std::int32_t v : select(*d.core, c.regions[h])) owner[v] = static_cast<std::int32_t>(h);
    turn.push_back(h == 0 ? Quaternion() : c.motion(h, 1, Vec3()).rotation);
  }
  const std::vector<Vec3> p = rest(*d.core);
  const std::vector<Quaternion> start = operator_rotations(*d.core, owner, turn, p, before),
                                end = operator_rotations(*d.core, owner, turn, p, after);
  const double plain = operator_energy(*d.core, start, p, before), refined = operator_energy(*d.core, end, p, after);
  std::printf("obtuse triangles: energy %.5f, refined %.5f\n", plain, refined);
  EXPECT_LT(refined, 0.8 * plain);
  // for the rotations of the start the step leads to the minimum: no force is left on a free vertex
  double largest = 0;
  for (std::int32_t v = 0; v < d.core->size(); ++v) {
    if (owner[v] >= 0) continue;
    Vec3 force;
    for_operator_ring(*d.core, v, [&](double w, std::int32_t u) {
      const Vec3 edge = p[v] - p[u], wished = 0.5 * (rotate(start[v], edge) + rotate(start[u], edge));
      force = force + w * (after[v] - after[u] - wished);
    });
    largest = std::max(largest, norm(force));
  }
  EXPECT_LT(largest, 1e-10 * d.core->mesh.scale);
}

}  // namespace

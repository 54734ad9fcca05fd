// The cactus of the deformation papers, as an implicit body: a trunk, two arms that leave sideways and turn up.
#include "even_mesh.h"
#include "shapes.h"

namespace samples {

ShapeMesh cactus(uint32_t vertices) {
  ImplicitBody body;
  body.blobs.push_back(capsule({0, 0, 0}, {0, 1.75, 0}, 0.24, 0.20, 0.05));
  const auto arm = [&](double side, double height, double rise) {
    const dvec3 root{0, height, 0}, knee{side * 0.55, height + 0.05, 0}, tip{side * 0.60, height + rise, 0};
    body.blobs.push_back(capsule(root, knee, 0.125, 0.125, 0.10));
    body.blobs.push_back(capsule(knee, tip, 0.130, 0.115, 0.06));
  };
  arm(1, 0.80, 0.55);
  arm(-1, 1.05, 0.45);
  body.cut_at_ground = true;
  body.ground_edge = 0.03;
  body.finish();
  const MeshPlan plan = plan_mesh(vertices);
  TriangleMesh mesh = base_mesh(body, plan.base);
  std::vector<std::array<uint32_t, 2>> parents;
  for (int level = 0; level < plan.levels; ++level) mesh = refine(body, mesh, parents);
  std::vector<uint32_t> triangle_order;
  mesh = reorder(mesh, spatial_order(mesh.points), triangle_order);
  ShapeMesh shape;
  for (const dvec3& p : mesh.points) shape.positions.insert(shape.positions.end(), {p.x, p.y, p.z});
  for (const Triangle& t : mesh.triangles) shape.triangles.insert(shape.triangles.end(), t.begin(), t.end());
  return shape;
}

}  // namespace samples

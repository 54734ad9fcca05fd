#include "weights/carry_match.h"

#include <cmath>

#include "mesh/nearest_triangle.h"

namespace hf_inner {

WeightedShape::WeightedShape(const Mesh& mesh, const SkinShape& skin, const WeightRows& rows, Memory& memory)
    : mesh_(mesh), skin_(skin), rows_(rows), triangle_(&memory), tree_(collect(memory), memory) {}

Vector<ItemBox> WeightedShape::collect(Memory& memory) {
  Vector<ItemBox> boxes(&memory);
  for (Index t = 0; t < mesh_.triangle_count(); ++t) {
    const Index* v = mesh_.triangle(t);
    if (!rows_.has(v[0]) && !rows_.has(v[1]) && !rows_.has(v[2])) continue;
    ItemBox box = ItemBox::of(mesh_.positions[at(v[0])]);
    box.take(mesh_.positions[at(v[1])]);
    box.take(mesh_.positions[at(v[2])]);
    boxes.push_back(box);
    triangle_.push_back(t);
  }
  return boxes;
}

Match WeightedShape::find(const Vec3& p, const Vec3& normal, double within, double cosine) const noexcept {
  Match best;
  best.squared = within;
  tree_.near(
      p, [&] { return best.squared; },
      [&](Index i) {
        const Index t = triangle_[at(i)];
        const Index* v = mesh_.triangle(t);
        double w[3];
        const double squared =
            squared_to_triangle(p, mesh_.positions[at(v[0])], mesh_.positions[at(v[1])], mesh_.positions[at(v[2])], w);
        // Among equally near triangles the lowest number wins.
        if (!(squared < best.squared) && !(squared == best.squared && (best.triangle < 0 || t < best.triangle))) return;
        if (cosine > -1) {
          Vec3 there;
          for (int k = 0; k < 3; ++k) there = there + w[k] * skin_.normals()[at(v[k])];
          const double length = norm(there);
          if (!(length > 0) || !(dot(there, normal) >= cosine * length)) return;
        }
        best.triangle = t;
        best.squared = squared;
        for (int k = 0; k < 3; ++k) best.weight[k] = w[k];
      });
  return best;
}

}  // namespace hf_inner

#include "weights/carry_match.h"

#include <limits>

#include "mesh/nearest_triangle.h"

namespace hf_inner::weights {

// Squared distances that differ by less than this share are equal. It is above their rounding, 1e-16.
constexpr double same_distance = 1e-12;

WeightedShape::WeightedShape(const mesh::Mesh& mesh, const mesh::SkinShape& skin, const WeightRows& rows,
                             Memory& memory)
    : mesh_(mesh), skin_(skin), rows_(rows), triangle_(&memory), tree_(collect(memory), memory) {}

Vector<mesh::ItemBox> WeightedShape::collect(Memory& memory) {
  Vector<mesh::ItemBox> boxes(&memory);
  for (Index t = 0; t < mesh_.triangle_count(); ++t) {
    const Index* v = mesh_.triangle(t);
    if (!rows_.has(v[0]) && !rows_.has(v[1]) && !rows_.has(v[2])) continue;
    mesh::ItemBox box = mesh::ItemBox::of(mesh_.positions[at(v[0])]);
    box.take(mesh_.positions[at(v[1])]);
    box.take(mesh_.positions[at(v[2])]);
    boxes.push_back(box);
    triangle_.push_back(t);
  }
  return boxes;
}

Match WeightedShape::nearest(Index t, const Vec3& p) const noexcept {
  const Index* v = mesh_.triangle(t);
  Match out;
  out.triangle = t;
  out.squared = mesh::squared_to_triangle(p, mesh_.positions[at(v[0])], mesh_.positions[at(v[1])],
                                          mesh_.positions[at(v[2])], out.weight);
  return out;
}

bool WeightedShape::agrees(const Match& match, const Vec3& normal, double cosine) const noexcept {
  if (!(cosine > -1)) return true;
  const Index* v = mesh_.triangle(match.triangle);
  Vec3 there;
  for (int k = 0; k < 3; ++k) there = there + match.weight[k] * skin_.normals()[at(v[k])];
  const double length = norm(there);
  return length > 0 && dot(there, normal) >= cosine * length;
}

Match WeightedShape::find(const Vec3& p, const Vec3& normal, double within, double cosine) const noexcept {
  Match best;
  best.squared = within;
  tree_.near(
      p, [&] { return best.squared; },
      [&](Index i) {
        const Match found = nearest(triangle_[at(i)], p);
        // Among equally near triangles the lowest number wins.
        const bool nearer = found.squared < best.squared ||
                            (found.squared == best.squared && (best.triangle < 0 || found.triangle < best.triangle));
        if (nearer && agrees(found, normal, cosine)) best = found;
      });
  if (best.triangle < 0 || known_share(best) > least_known) return best;
  // Triangles that meet at a point without weights have other corners with weights. The one whose middle is nearest
  // gives them, so that the order of the triangles does not count.
  const double limit = best.squared + same_distance * (best.squared + same_distance);
  double least = std::numeric_limits<double>::infinity();
  tree_.near(
      p, [&] { return limit; },
      [&](Index i) {
        const Match found = nearest(triangle_[at(i)], p);
        const Index* v = mesh_.triangle(found.triangle);
        const Vec3 away = mesh_.positions[at(v[0])] + mesh_.positions[at(v[1])] + mesh_.positions[at(v[2])] - 3.0 * p;
        if (found.squared > limit || dot(away, away) >= least || !agrees(found, normal, cosine)) return;
        least = dot(away, away);
        best = found;
      });
  return best;
}

}  // namespace hf_inner::weights

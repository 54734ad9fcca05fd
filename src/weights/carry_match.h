// Finds for a point the nearest point of a surface with weights, among those whose normal agrees.
#pragma once
#include "weights/skeleton.h"
#include "weights/weight_rows.h"

namespace hf_inner::weights {

struct Match {
  Index triangle = -1;
  double weight[3] = {0, 0, 0};
  double squared = 0;  // of the distance, in the inner unit of the surface
};

// A point with less than this share at corners with weights has none of its own. It is above the rounding of shares,
// which is 1e-16. Needles have more. More takes small shares for none.
constexpr double least_known = 1e-9;

class WeightedShape {
 public:
  // Takes triangles with a corner that has weights. All arguments must outlive this object.
  WeightedShape(const mesh::Mesh& mesh, const mesh::SkinShape& skin, const WeightRows& rows, Memory& memory);
  bool empty() const noexcept { return triangle_.empty(); }
  // The nearest point within a squared distance, whose normal has at least this cosine with `normal`. A cosine of -1
  // takes any normal. Triangle -1: there is none.
  Match find(const Vec3& p, const Vec3& normal, double within, double cosine) const noexcept;
  // Passes the weights at a point to take(bone, share), with the sum 1, from the corners that have weights.
  template <class Take>
  void add(const Match& match, Take&& take) const {
    const Index* v = mesh_.triangle(match.triangle);
    double corners = 0;
    for (int k = 0; k < 3; ++k) corners += rows_.has(v[k]);
    const double sum = known_share(match);
    // A point at a corner without weights gets the weights of the other corners.
    for (int k = 0; k < 3; ++k) {
      const double part = sum > least_known ? match.weight[k] / sum : 1 / corners;
      for (const Share& share : rows_.of(v[k])) take(share.bone, part * share.weight);
    }
  }

 private:
  Vector<mesh::ItemBox> collect(Memory& memory);
  // How much of a point belongs to corners with weights, 0 to 1.
  double known_share(const Match& match) const noexcept {
    const Index* v = mesh_.triangle(match.triangle);
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += rows_.has(v[k]) ? match.weight[k] : 0;
    return sum;
  }
  // The point of triangle t nearest to p.
  Match nearest(Index t, const Vec3& p) const noexcept;
  bool agrees(const Match& match, const Vec3& normal, double cosine) const noexcept;
  const mesh::Mesh& mesh_;
  const mesh::SkinShape& skin_;
  const WeightRows& rows_;
  Vector<Index> triangle_;
  mesh::BoxTree tree_;
};

}  // namespace hf_inner::weights

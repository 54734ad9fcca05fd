// Finds for a point the nearest point of a surface with weights, among those whose normal agrees.
#pragma once
#include "weights/skeleton.h"
#include "weights/weight_rows.h"

namespace hf_inner {

struct Match {
  Index triangle = -1;
  double weight[3] = {0, 0, 0};
  double squared = 0;  // of the distance, in the inner unit of the surface
};

class WeightedShape {
 public:
  // Takes triangles with a corner that has weights. All arguments must outlive this object.
  WeightedShape(const Mesh& mesh, const SkinShape& skin, const WeightRows& rows, Memory& memory);
  bool empty() const noexcept { return triangle_.empty(); }
  // The nearest point within a squared distance, whose normal has at least this cosine with `normal`. A cosine of -1
  // takes any normal. Triangle -1: there is none.
  Match find(const Vec3& p, const Vec3& normal, double within, double cosine) const noexcept;
  // Passes the weights at a point to take(bone, share), with the sum 1: those of the corners that have some.
  template <class Take>
  void add(const Match& match, Take&& take) const {
    const Index* v = mesh_.triangle(match.triangle);
    double sum = 0, corners = 0;
    for (int k = 0; k < 3; ++k) {
      if (rows_.has(v[k])) {
        sum += match.weight[k];
        corners += 1;
      }
    }
    // A point at a corner without weights takes those of the other corners.
    for (int k = 0; k < 3; ++k) {
      const double part = sum > 0 ? match.weight[k] / sum : 1 / corners;
      for (const Share& share : rows_.of(v[k])) take(share.bone, part * share.weight);
    }
  }

 private:
  Vector<ItemBox> collect(Memory& memory);
  const Mesh& mesh_;
  const SkinShape& skin_;
  const WeightRows& rows_;
  Vector<Index> triangle_;
  BoxTree tree_;
};

}  // namespace hf_inner

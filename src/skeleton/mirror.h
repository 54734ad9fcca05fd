// Tries planes of symmetry: how many joints find their mirror image, and how well the skin lies on itself.
#pragma once
#include "skeleton/body.h"

namespace hf_inner::skeleton {

struct Plane {
  Vec3 left;
  double offset = 0, score = -1;
  Vector<Index> mates;  // of each joint, -1: none
  explicit Plane(Memory& memory) : mates(&memory) {}
};

class MirrorSearch {
 public:
  // Joints are compared by their pivots and by the means of the vertices that they own. pivots: may differ from the
  // pivots of the body.
  MirrorSearch(const Body& body, Index main, const Vector<Vec3>& pivots, const Vector<Vec3>& means);
  // with_skin: the reflected skin counts too. all: every joint votes and gets its mate.
  Plane look(Vec3 left, bool with_skin, bool all = false);

 private:
  Index nearest(Vec3 pivot, Vec3 mean, Index self, Index guess) const;
  double count_pairs(Plane& plane, bool all);
  double skin_distance(const Plane& plane);

  const Body& body_;
  const Index main_;
  const Vector<Vec3>& pivots_;
  const Vector<Vec3>& means_;
  Vector<Index> joints_;
  // Both are trees: the middle of each range splits it along one axis in turn.
  struct Place {
    Vec3 mean;
    Index joint;
  };
  Vector<Place> places_;
  Vector<Vec3> cloud_;
};

}  // namespace hf_inner::skeleton

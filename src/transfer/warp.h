// A smooth map of space that takes given points to given points: matches the form of two surfaces.
//
// The map is x + sum_k a_k |x - c_k| + B x + b, the interpolation by radial functions whose kernel is biharmonic in
// space (Carr et al. 2001), with ridges. Points that need no displacement leave the map the identity, to the last bit.
// Fitting k points costs O(k^3), a place O(k).
#pragma once
#include "base/algebra.h"
#include "base/memory.h"
#include "base/span.h"
#include "mesh/mesh.h"

namespace hf_inner::transfer {

class Warp {
 public:
  explicit Warp(Memory& memory) : memory_(memory), centre_(&memory), weight_(&memory) {}
  // from and to are of one length. ridge: how far the map may miss the points, as a share of a box.
  void fit(Span<const Vec3> from, Span<const Vec3> to, double ridge);
  Vec3 operator()(Vec3 x) const noexcept;

 private:
  Memory& memory_;
  Vector<Vec3> centre_, weight_;
  Vec3 affine_[4];  // columns of B, and b
};

}  // namespace hf_inner::transfer

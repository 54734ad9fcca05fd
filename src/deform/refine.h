// What turns a pose into more than a blend of clusters, and what lets one pose start from the surface of another.
//
// Refinement: one as-rigid-as-possible step of the whole surface against its original rest shape (Sorkine and Alexa
// 2007), from the blended positions x:
//     R_v = argmax tr(R' sum_u w_vu (x_v - x_u)(p_v - p_u)'),
//     sum_u w_vu (y_v - y_u) = sum_u w_vu / 2 (R_v + R_u)(p_v - p_u),   y = x on the handles.
// w are the weights of the operator K the fields are solved with (u over the neighbours in the intrinsic Delaunay
// triangulation, all w >= 0, unless it was made of other edges), so y = x + K^-1 (b - K x) with b the right side, and
// the factor that is there does it: two sweeps, and the harmonic field that takes the rings back to their places, one
// more. The energy of these weights never grows. With cotangents of the mesh's own edges for w, above K where triangles
// are obtuse, the step overshoots there: it folded a scan's (smallest stretch 0.55; now 0.78). One step only: further
// ones walk towards the collapsed minima of that energy. Cost: a rotation per vertex, three sweeps of three channels.
//
// GroupStart: the rotation of every rotation group of a given surface, from the edges at some of its vertices.
//
// Both keep their room from frame to frame. On failure nothing is changed.
#pragma once
#include "deform/blend.h"
#include "deform/groups.h"
#include "deform/handles.h"
#include "deform/rotation.h"

namespace hf_inner {

struct RefineInput {
  const Core& core;
  const Rest& rest;
  const Reach& reach;
  const ClusterWeights& weights;
  const SiteSolver& sites;
  const Handles& handles;
  const Groups* groups;                      // null: rotations are found without a start
  const Vector<Quaternion>* group_rotation;  // by group
  const Affine* transforms;                  // by cluster, handles first
};

class Refinement {
 public:
  Refinement(const Core& core, Memory& memory);
  // Room for the values of this many slots.
  void fit(std::int32_t slot_count);
  // positions: blended, in the given unit and frame; improved in place. Vertices of handles and of components that are
  // not elastic keep theirs.
  void apply(const RefineInput& input, Vec3* positions);

 private:
  void fit_rotations(const RefineInput& input, const Vec3* positions);
  void set_right_hand_side(const RefineInput& input, const Vec3* positions, double* z);

  Buffer<Mat3> rotation_;         // by vertex
  Buffer<double> field_;          // three channels
  Vector<double> values_;         // three channels by slot
  Vector<std::uint8_t> elastic_;  // by component
};

class GroupStart {
 public:
  explicit GroupStart(Memory& memory)
      : rotation(&memory), motion(&memory), own_unit(&memory), group_(&memory), start_(&memory), vertex_(&memory) {}
  // Samples of these groups; rotation is sized to all groups.
  void choose(const Core& core, const Groups& groups, const Vector<std::int32_t>& active);
  void fit(const Core& core, const Rest& rest, Span<const Vec3> surface) noexcept;
  Vector<Quaternion> rotation;  // by group; smooth mode
  Vector<RigidMotion> motion;   // by free cluster; the paper's mode
  Vector<Vec3> own_unit;        // scratch of the paper's mode

 private:
  Vector<std::int32_t> group_, start_, vertex_;
};

// The rotation of the edges at one vertex: sum_u w_vu (x_v - x_u)(p_v - p_u)'.
void add_ring(const Core& core, const Rest& rest, const Vec3* positions, std::int32_t v, Mat3& sum) noexcept;

}  // namespace hf_inner

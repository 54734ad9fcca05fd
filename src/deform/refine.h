// A full-mesh step on top of a blended pose, and the start of one pose from another's surface.
//
// Refinement is one as-rigid-as-possible step of the whole surface against its rest shape (Sorkine and Alexa 2007).
// From the blended positions x it solves
//     R_v = argmax tr(R' sum_u w_vu (x_v - x_u)(p_v - p_u)'),
//     sum_u w_vu (y_v - y_u) = sum_u w_vu / 2 (R_v + R_u)(p_v - p_u),   y = x on the handles.
// The weights w are those of the operator K, and u runs over the neighbours in its triangulation. So y = x + K^-1 (b -
// K x) with b the right side, on the factor that is there. With these weights the energy never grows. Cotangents of the
// mesh's own edges are larger where triangles are obtuse, and the step overshoots there. More steps walk towards the
// collapsed minima of that energy. Cost: a rotation per vertex, three sweeps of three channels.
//
// GroupStart finds the rotation of every rotation group of a given surface, from the edges at some of its vertices.
//
// Both keep their memory from frame to frame. On failure nothing is changed.
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
  // Room for the values of this many slots, and whether there is.
  void fit(std::int32_t slot_count);
  bool has_room(std::int32_t slot_count) const noexcept {
    return 3 * static_cast<std::size_t>(slot_count) <= values_.capacity();
  }
  // positions: blended, in the given unit and frame; improved in place. Vertices of handles and of components that are
  // not elastic keep theirs.
  void apply(const RefineInput& input, Vec3* positions);

 private:
  void fit_rotations(const RefineInput& input, const Vec3* positions);
  void set_right_hand_side(const RefineInput& input, const Vec3* positions, double* z);

  Vector<Mat3> rotation_;         // by vertex
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

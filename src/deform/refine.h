// Improves a blended pose by full-mesh steps (Refinement), and starts one pose from another's surface (GroupStart).
//
// Refinement is one as-rigid-as-possible step of the whole surface against its rest shape (Sorkine and Alexa 2007).
// From the blended positions x and the rest positions p it solves
//     R_v = argmax tr(R' sum_u w_vu (x_v - x_u)(p_v - p_u)'),
//     sum_u w_vu (y_v - y_u) = sum_u w_vu / 2 (R_v + R_u)(p_v - p_u),   y = x on the handles.
// R_v is the rotation of vertex v, and y are the new positions. The weights w belong to the operator K, and u runs over
// the neighbours of v in its triangulation. So y = x + u with K u = b - K x and u = 0 on the handles, where b is the
// right side, and the existing factor is used. With these weights the energy never grows. Cotangents of the mesh's own
// edges would be larger at obtuse triangles, and the step would overshoot there. Cost of a step: a rotation per vertex,
// and two sweeps for three coordinates.
//
// Several steps approach the minimum of this energy, which keeps lengths best but lets volume shrink and bends sharpen.
// With x_k before step k and y_k after it, the next positions are x_k+1 = x_k-1 + w_k (y_k - x_k-1), where w_1 = 1, w_2
// = 2 / (2 - r^2), w_k+1 = 4 / (4 - r^2 w_k) (Chebyshev's semi-iterative method for local and global steps, Wang 2015),
// and r is 1 - 0.4 / steps.
//
// Steps can also go on from the last frame's surface (Followed). Let x be the blended pose and y the refined surface.
// The correction of the last frame is c = y - x. It turns with the pose, and the first step begins at
//     x_v + q_v (c_v + refine_momentum m_v).
// The rotation q_v leads from the last blended pose to this one; it is blended from the clusters. m is how c changed in
// the last step (Nesterov's momentum, 1983). So the steps of all frames are one iteration. While handles do not move,
// it converges to the minimum. The momentum is dropped when a step goes against it (O'Donoghue and Candes 2015). With
// it, the energy may still grow for a step.
//
// Steps on limbs alone (limbs.h) have u = 0 on all other vertices, and a factor of their own.
//
// GroupStart finds the rotation of every rotation group on a given surface, from the edges at some of its vertices.
//
// Both keep their memory from frame to frame. A failed call changes nothing.
#pragma once
#include "deform/blend.h"
#include "deform/groups.h"
#include "deform/handles.h"
#include "deform/limbs.h"
#include "deform/rotation.h"

namespace hf_inner::deform {

struct RefineInput {
  const surface::Core& core;
  const Rest& rest;
  const Reach& reach;
  const ClusterWeights& weights;
  const solve::SiteSolver& sites;
  const Handles& handles;
  const Groups* groups;                      // groups of vertices that share a rotation; null: no starting rotations
  const Vector<Quaternion>* group_rotation;  // rotation by group, where the search starts
  const Affine* transforms;                  // by cluster, handles first
  const Limbs* limbs = nullptr;              // null: the steps move the whole surface
};

// The state that the steps of one frame leave for the next.
struct Followed {
  // No correction yet.
  Followed(std::size_t vertices, std::size_t clusters, Memory& memory)
      : correction(memory, 3 * vertices), change(memory, 3 * vertices), rotation(clusters, Quaternion(), &memory) {
    forget();
  }
  Followed(const Followed& other, Memory& memory)
      : correction(memory, other.correction.size()),
        change(memory, other.change.size()),
        rotation(other.rotation, &memory),
        turned(other.turned) {
    std::copy(other.correction.begin(), other.correction.end(), correction.begin());
    std::copy(other.change.begin(), other.change.end(), change.begin());
  }
  // Drops the correction: the next steps begin at the blended pose.
  void forget() noexcept {
    std::fill(correction.begin(), correction.end(), 0.0f);
    std::fill(change.begin(), change.end(), 0.0f);
  }
  // The next steps begin at this surface, if the blended pose stays.
  void lead(const Vec3* blended, const Vec3* surface) noexcept;
  Buffer<float> correction, change;  // three per vertex, in the unit and frame of the caller's mesh
  Vector<Quaternion> rotation;       // by cluster, in the frame of the correction
  bool turned = false;               // `rotation` is known; otherwise the correction is taken as it is
};

class Refinement {
 public:
  Refinement(const surface::Core& core, Memory& memory);
  // Makes room for the values of this many sites, for this many steps, and for `followed`, which may be null.
  void fit(std::int32_t slot_count, std::uint32_t steps, const Followed* followed);
  bool has_room(std::int32_t slot_count, std::uint32_t steps, const Followed* followed) const noexcept {
    return 3 * static_cast<std::size_t>(slot_count) <= values_.capacity() && (steps < 2 || !last_.empty()) &&
           (!followed || (!blended_.empty() && followed->rotation.size() <= relative_.capacity()));
  }
  // Improves the blended `positions` in place by this many steps. They are in the given unit and frame. Vertices of
  // handles and of components without free clusters keep their positions. followed: null, or where the steps
  // continue from, which this call renews; null with limbs.
  void apply(const RefineInput& input, std::uint32_t steps, Followed* followed, Vec3* positions);

 private:
  void take_steps(const RefineInput& input, std::uint32_t steps, Vec3* positions);
  void begin_from_last(const RefineInput& input, Followed& followed, Vec3* positions);
  void note_correction(const RefineInput& input, Followed& followed, const Vec3* positions);
  void step(const RefineInput& input, Vec3* positions);
  void fit_rotations(const RefineInput& input, const Vec3* positions);
  void set_right_hand_side(const RefineInput& input, const Vec3* positions, double* z);
  void respond(const RefineInput& input, double* load);

  Memory* memory_;
  Vector<Mat3> rotation_;         // by vertex
  Buffer<double> field_;          // correction by vertex, or by vertex of limbs: x, y, z
  Vector<double> values_;         // x, y, z by site
  Buffer<Vec3> before_, last_;    // positions before this step and the one before; several steps only
  Buffer<Vec3> blended_, begin_;  // positions without and with the last correction; steps from the last frame only
  Vector<Quaternion> relative_;   // by cluster: how it turned since the last frame
  Vector<double> along_;          // by piece of vertices: how far the steps went along the momentum
  Vector<std::uint8_t> elastic_;  // by component: 1 if vertices can move without a handle
};

class GroupStart {
 public:
  explicit GroupStart(Memory& memory)
      : rotation(&memory), motion(&memory), own_unit(&memory), group_(&memory), start_(&memory), vertex_(&memory) {}
  // Chooses sample vertices for the groups of vertices in `active`. `rotation` gets an entry for every group.
  void choose(const surface::Core& core, const Groups& groups, const Vector<std::int32_t>& active);
  void fit(const surface::Core& core, const Rest& rest, Span<const Vec3> surface) noexcept;
  Vector<Quaternion> rotation;  // by group of vertices; without a scheme
  Vector<RigidMotion> motion;   // by cluster that is no handle; with a scheme
  Vector<Vec3> own_unit;        // scratch with a scheme

 private:
  Vector<std::int32_t> group_, start_, vertex_;
};

// The 3 x 3 part of a cluster's transform.
Mat3 linear_part(const Affine& affine) noexcept;

// Adds the moment matrix of the edges at one vertex: sum_u w_vu (x_v - x_u)(p_v - p_u)'. The rotation nearest to it is
// the rotation of these edges.
void add_ring(const surface::Core& core, const Rest& rest, const Vec3* positions, std::int32_t v, Mat3& sum) noexcept;

}  // namespace hf_inner::deform

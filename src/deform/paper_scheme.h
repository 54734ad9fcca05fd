// The pose solve of the paper (Xu, Zhang, Cohen-Or and Xiong 2009, Section 5.2), kept as a mode of its own.
//
// Every cluster moves rigidly. Repeat: place sample vertices by blending the transforms of the clusters they lie in;
// give every free cluster the rigid motion that fits its samples best (shape matching). All clusters step at once, so
// motion travels through the overlaps by one band per iteration, and hundreds of iterations are needed; the smooth mode
// (pose_solver.h) needs a few. Cost: 40 samples per cluster and iteration. Allocates nothing, cannot fail.
#pragma once
#include "deform/blend.h"
#include "deform/pose_solver.h"
#include "deform/rotation.h"

namespace hf_inner {

// The system of one set of handles. Immutable once made.
struct PaperSystem {
  PaperSystem(const Core& core, const ClusterWeights& weights, Memory& memory);
  std::int32_t handle_count, free_count;
  Vector<std::int32_t> sample;         // vertices, all different
  Vector<std::int32_t> cluster_start;  // samples of free cluster f: member[cluster_start[f] .. cluster_start[f + 1])
  struct Member {
    std::int32_t sample;  // position in `sample`
    double weight;
  };
  Vector<Member> member;
};

struct PaperState {
  explicit PaperState(Memory& memory) : motion(&memory), position(&memory) {}
  PaperState(const PaperState& other, Memory& memory)
      : motion(other.motion, &memory), position(other.position, &memory) {}
  // Makes room for a system, clusters at rest.
  void fit(const PaperSystem& system);
  Vector<RigidMotion> motion;  // per free cluster, in the mesh's own unit
  Vector<Vec3> position;       // per sample
};

// x = R p + t with the rotation as a matrix, as the blend takes it.
Affine to_affine(const RigidMotion& motion) noexcept;

// Motions that fit given positions (in the mesh's own unit) best: to go on from a pose after the handles changed.
void fit_motions(const PaperSystem& system, const Mesh& mesh, const Vec3* positions, PaperState& state) noexcept;

// transforms: those of the handles are read, those of the free clusters written.
SolveReport solve_paper_pose(const PaperSystem& system, const Mesh& mesh, const ClusterWeights& weights,
                             std::uint32_t iterations, double tolerance, PaperState& state,
                             Affine* transforms) noexcept;

}  // namespace hf_inner

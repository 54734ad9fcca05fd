// The pose solve of the paper (Xu, Zhang, Cohen-Or and Xiong 2009, Section 5.2), kept as a mode of its own.
//
// Every cluster moves rigidly. An iteration has two steps. First, sample vertices are placed by blending the transforms
// of their clusters. Then every free cluster gets the rigid motion that fits its samples best (shape matching). All
// clusters move at once, so motion travels through their overlaps by one band per iteration. That takes hundreds of
// iterations, fewer with Anderson acceleration (anderson.h), which ends where they end; the smooth mode (pose_solver.h)
// needs a few. Cost: 40 samples per cluster and iteration. Allocates nothing and cannot fail.
#pragma once
#include "deform/blend.h"
#include "deform/pose_solver.h"
#include "deform/rotation.h"

namespace hf_inner {

// The prepared system for one set of handles. It never changes.
struct PaperSystem {
  PaperSystem(const Core& core, const ClusterWeights& weights, Memory& memory);
  std::int32_t handle_count, free_count;
  Vector<std::int32_t> sample;         // sampled vertices, all different
  Vector<std::int32_t> cluster_start;  // samples of free cluster f: member[cluster_start[f] .. cluster_start[f + 1])
  struct Member {
    std::int32_t sample;  // position in `sample`
    double weight;
  };
  Vector<Member> member;
};

struct PaperState {
  explicit PaperState(Memory& memory)
      : motion(&memory), position(&memory), iterate(&memory), residual(&memory), anderson(memory) {}
  PaperState(const PaperState& other, Memory& memory)
      : motion(other.motion, &memory),
        position(other.position, &memory),
        iterate(other.iterate, &memory),
        residual(other.residual, &memory),
        anderson(other.anderson, memory) {}
  // Makes room for a system, with all its clusters (overlapping bands of vertices) at rest.
  void fit(const PaperSystem& system);
  Vector<RigidMotion> motion;  // by free cluster, in the unit of the scaled mesh
  Vector<Vec3> position;       // per sample
  // Seven numbers per free cluster, its motion, and how far they are from their fit; and the acceleration that uses
  // them.
  Vector<double> iterate, residual;
  Anderson anderson;
};

// Turns a rigid motion x = R p + t into the 3 x 4 matrix that the blend uses.
Affine to_affine(const RigidMotion& motion) noexcept;

// Fits the motions of the clusters (overlapping bands of vertices) to given positions (in the unit of the scaled mesh).
// A pose continues from them after its handles changed.
void fit_motions(const PaperSystem& system, const Mesh& mesh, const Vec3* positions, PaperState& state) noexcept;

// Solves the pose. transforms: one per cluster of vertices; those of handles are read, the others are written.
SolveReport solve_paper_pose(const PaperSystem& system, const Mesh& mesh, const ClusterWeights& weights,
                             std::uint32_t iterations, double tolerance, PaperState& state,
                             Affine* transforms) noexcept;

}  // namespace hf_inner

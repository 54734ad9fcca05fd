// The pose solve of the paper (Xu, Zhang, Cohen-Or and Xiong 2009, Section 5.2).
//
// Every cluster moves rigidly. An iteration has two steps. First, sample vertices are placed by blending the transforms
// of their clusters. Then every free cluster gets the rigid motion that fits its samples best (shape matching). All
// clusters move at once, so motion travels through their overlaps by one band per iteration. That takes hundreds of
// iterations, fewer with Anderson acceleration (anderson.h), which ends where they end; pose_solver.h needs a few.
// Cost: 40 samples per cluster and iteration. Allocates nothing and cannot fail.
#pragma once
#include "deform/anderson.h"
#include "deform/pose_scheme.h"

namespace hf_inner::peers {

// The scheme, for PoseOptions::scheme.
std::shared_ptr<const deform::PoseScheme> paper_scheme() noexcept;

struct PaperSystem final : deform::PoseScheme::System {
  PaperSystem(const surface::Core& core, const deform::ClusterWeights& weights, Memory& memory);
  std::shared_ptr<deform::PoseScheme::State> rest(Memory& memory) const override;
  void fit(const mesh::Mesh& mesh, const Vec3* positions, deform::PoseScheme::State& state) const noexcept override;
  deform::SolveReport solve(const mesh::Mesh& mesh, const deform::ClusterWeights& weights, std::uint32_t iterations,
                            double tolerance, deform::PoseScheme::State& state,
                            deform::Affine* transforms) const noexcept override;
  std::int32_t handle_count, free_count;
  Vector<std::int32_t> sample;         // sampled vertices, all different
  Vector<std::int32_t> cluster_start;  // samples of free cluster f: member[cluster_start[f] .. cluster_start[f + 1])
  struct Member {
    std::int32_t sample;  // position in `sample`
    double weight;
  };
  Vector<Member> member;
};

struct PaperState final : deform::PoseScheme::State {
  explicit PaperState(Memory& memory)
      : State(memory), position(&memory), iterate(&memory), residual(&memory), anderson(memory) {}
  PaperState(const PaperState& other, Memory& memory)
      : State(other, memory),
        position(other.position, &memory),
        iterate(other.iterate, &memory),
        residual(other.residual, &memory),
        anderson(other.anderson, memory) {}
  std::shared_ptr<State> clone(Memory& memory) const override {
    return make_shared_in<PaperState>(memory, *this, memory);
  }
  // Makes room for a system, with all its clusters (overlapping bands of vertices) at rest.
  void fit(const PaperSystem& system);
  Vector<Vec3> position;  // per sample
  // Seven numbers per free cluster, its motion, and how far they are from their fit; and the acceleration that uses
  // them.
  Vector<double> iterate, residual;
  deform::Anderson anderson;
};

}  // namespace hf_inner::peers

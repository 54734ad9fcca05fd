// The interface to solve a pose otherwise than by the reduced energy of pose_solver.h: every cluster moves rigidly, and
// the scheme finds the motions. Poses of hosts have no scheme. The room peers has the scheme of the paper.
#pragma once
#include <cstdint>
#include <memory>

#include "deform/bands.h"
#include "deform/pose_solver.h"

namespace hf_inner::deform {

class PoseScheme {
 public:
  // The state that a solve changes. Motions are by cluster that is no handle, in the unit of the scaled mesh.
  struct State {
    explicit State(Memory& memory) : motion(&memory) {}
    State(const State& other, Memory& memory) : motion(other.motion, &memory) {}
    virtual ~State() = default;
    virtual std::shared_ptr<State> clone(Memory& memory) const = 0;
    Vector<RigidMotion> motion;
  };

  // The prepared system for one set of handles. It never changes. Its functions allocate nothing but in rest().
  struct System {
    virtual ~System() = default;
    // Returns a state with all clusters at rest.
    virtual std::shared_ptr<State> rest(Memory& memory) const = 0;
    // Fits the motions to given positions, in the unit of the scaled mesh. A pose continues from them after its handles
    // changed.
    virtual void fit(const mesh::Mesh& mesh, const Vec3* positions, State& state) const noexcept = 0;
    // Solves the pose. transforms: one per cluster; the solve reads the transforms of handles and writes the others.
    virtual SolveReport solve(const mesh::Mesh& mesh, const ClusterWeights& weights, std::uint32_t iterations,
                              double tolerance, State& state, Affine* transforms) const noexcept = 0;
  };

  virtual ~PoseScheme() = default;
  virtual std::shared_ptr<const System> prepare(const surface::Core& core, const ClusterWeights& weights,
                                                Memory& memory) const = 0;

  // The kind of its bands and the default of their number. The iterations of a frame unless the pose has its own
  // number, and their limit while the handles do not move.
  const BandOptions bands;
  const std::uint32_t default_iterations, idle_limit;

 protected:
  PoseScheme(const BandOptions& own, std::uint32_t iterations, std::uint32_t idle) noexcept
      : bands(own), default_iterations(iterations), idle_limit(idle) {}
};

}  // namespace hf_inner::deform

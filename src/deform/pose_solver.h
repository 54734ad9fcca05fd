// The pose solve of the smooth mode: a few local and global iterations on the reduced elastic energy (subspace.h).
//
// R_g is the rotation of group g, seed_g its seed vertex, and phi_i the field of handle i. Predict: R_g <- exp(sum_i
// phi_i(seed_g) dw_i) R_g, where dw_i is the turn of handle i since the last solve. Turns add up, so 450 degrees stay
// 450. Start: R_g = exp(sum_i phi_i(seed_g) w_i), where w_i is the accumulated turn of handle i. Global step: a
// prefactored dense system gives the transforms of the free clusters. Local step: R_g = argmax tr(R' S_g). Rotations
// and stresses together are accelerated (anderson.h), because a limb that no handle holds turns slowly otherwise. If a
// group is strained beyond its limits (strain.h), it gets a stress, and the next global step aims at that stress too.
// Turn limit: if handles are turned far against each other, a pose can fall back by a whole turn. So R_g must stay
// within an angle of the start rotation. This angle shrinks as the turn grows (constants.h).
//
// Cost per iteration: size^2 multiply-adds on four lanes, and one rotation per group. Allocates nothing and cannot
// fail.
#pragma once
#include "deform/anderson.h"
#include "deform/blend.h"
#include "deform/free_turns.h"
#include "deform/holds.h"
#include "deform/strain.h"
#include "deform/subspace.h"

namespace hf_inner::deform {

// The prepared system for one set of handles. It never changes.
struct SmoothSystem {
  SmoothSystem(const surface::Core& core, const Rest& rest, const ClusterWeights& weights, const Groups& groups,
               const HandleFields& fields, Memory& memory);
  Subspace subspace;
  std::int32_t handle_count, free_count;
  Vector<double> seed_field;  // handle i's field at the first vertex of group k: [k * handle_count + i]
  Vector<Sheet> sheet;        // rest moments for the stretch limits, per group
};

// The state that one solve leaves for the next.
struct SmoothState {
  static constexpr double no_turn_limit = 10;  // beyond pi, the largest angle there is
  explicit SmoothState(Memory& memory)
      : rotation(&memory),
        anchor(&memory),
        stress(&memory),
        columns(&memory),
        rows(&memory),
        known(&memory),
        iterate(&memory),
        residual(&memory),
        anderson(memory),
        free(memory),
        held(memory) {}
  SmoothState(const SmoothState& other, Memory& memory)
      : rotation(other.rotation, &memory),
        anchor(other.anchor, &memory),
        stress(other.stress, &memory),
        columns(other.columns, &memory),
        rows(other.rows, &memory),
        known(other.known, &memory),
        iterate(other.iterate, &memory),
        residual(other.residual, &memory),
        anderson(other.anderson, memory),
        turn_limit(other.turn_limit),
        turns(other.turns),
        free(other.free, memory),
        holds(other.holds),
        held(other.held, memory) {}
  // Makes room for a system. Groups of vertices that existed before keep their rotations, and no group has a stress.
  void fit(const SmoothSystem& system, const Groups& groups);
  Vector<Quaternion> rotation;       // per group of vertices (groups.h)
  Vector<Quaternion> anchor;         // centre of a group's allowed rotations, while turn_limit < pi
  Vector<Stress> stress;             // per group of vertices that can bend
  Vector<double> columns;            // by group: the rotation wanted for its edges, three columns of four numbers
  Vector<double> rows;               // 4 x 4 doubles per cluster, handles first: its transform, transposed and padded
  Vector<double> known;              // the handles' part of the right-hand side
  Vector<double> iterate, residual;  // seven numbers per group in use: its rotation and its stress
  Anderson anderson;
  double turn_limit = no_turn_limit;       // radians between a rotation and its anchor
  std::shared_ptr<const FreeTurns> turns;  // null: the rotations of all handles are given
  FreeTurnsState free;
  std::shared_ptr<const Holds> holds;  // null: nothing is held back
  HoldsState held;
};

struct SolveReport {
  std::uint32_t iterations = 0;
  // The largest change of a vertex group's rotation or stress in the last iteration (Frobenius norm).
  double last_change = 0;
};

// The next two functions set the rotations of the vertex groups before a solve. The first starts from the handles'
// whole turns. The second adds the turns since the last solve. The first takes the groups of `component`, or all groups
// if it is negative, and clears their stress.
void start_rotations(const SmoothSystem& system, const Groups& groups, std::int32_t component, Span<const Vec3> turns,
                     SmoothState& state) noexcept;
void predict_rotations(const SmoothSystem& system, Span<const Vec3> increments, SmoothState& state) noexcept;
// Sets turn_limit, and anchor: the rotations from which it is measured, for the accumulated turns of the handles. The
// limit follows from the handles of given rotation alone: a handle of free rotation may unwind.
void set_turn_limit(const SmoothSystem& system, Span<const Vec3> turns, SmoothState& state) noexcept;
// Solves the pose. transforms: one per cluster of vertices; the solve reads the transforms of handles and writes the
// others. The rotations of free handles start from state.free and end there. Their transforms are written too. It stops
// early when last_change falls below `tolerance`.
SolveReport solve_pose(const SmoothSystem& system, std::uint32_t iterations, double tolerance, SmoothState& state,
                       Affine* transforms) noexcept;

}  // namespace hf_inner::deform

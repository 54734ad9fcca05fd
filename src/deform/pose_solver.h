// The pose solve of the smooth mode: a few local and global iterations on the reduced elastic energy (subspace.h).
//
// Predict: R_g <- exp(sum_i phi_i(seed_g) dw_i) R_g, with dw_i the turn of handle i since the last solve. Turns add up,
// so 450 degrees stay 450.
// Start: R_g = exp(sum_i phi_i(seed_g) w_i), with w_i the accumulated turn of handle i.
// Global step: transforms of the free clusters from the prefactored dense system.
// Local step: R_g = argmax tr(R' S_g), over-relaxed except in the last iteration. A group strained beyond its limits
// (strain.h) gets a stress, which the next global step aims at too.
// Turn limit: a pose whose handles are turned far against each other can fall back by a whole turn. R_g then stays
// within an angle of exp(sum_i phi_i(seed_g) w_i), which shrinks as the turn grows (constants.h).
//
// Cost per iteration: size^2 multiply-adds on four lanes, and a rotation per group. Allocates nothing, cannot fail.
#pragma once
#include "deform/blend.h"
#include "deform/strain.h"
#include "deform/subspace.h"

namespace hf_inner {

// The system of one set of handles. Immutable once made.
struct SmoothSystem {
  SmoothSystem(const Core& core, const Rest& rest, const ClusterWeights& weights, const Groups& groups,
               const HandleFields& fields, Memory& memory);
  Subspace subspace;
  std::int32_t handle_count, free_count;
  Vector<double> seed_field;  // phi_i at the seed of active group k: [k * handle_count + i]
  Vector<Sheet> sheet;        // per active group
};

// The state that one solve leaves for the next.
struct SmoothState {
  static constexpr double no_turn_limit = 10;  // beyond pi, the largest angle there is
  explicit SmoothState(Memory& memory)
      : rotation(&memory), anchor(&memory), stress(&memory), columns(&memory), rows(&memory), known(&memory) {}
  SmoothState(const SmoothState& other, Memory& memory)
      : rotation(other.rotation, &memory),
        anchor(other.anchor, &memory),
        stress(other.stress, &memory),
        columns(other.columns, &memory),
        rows(other.rows, &memory),
        known(other.known, &memory),
        turn_limit(other.turn_limit) {}
  // Makes room for a system; rotations of groups that were there stay, no group is under stress.
  void fit(const SmoothSystem& system, const Groups& groups);
  Vector<Quaternion> rotation;  // per group of Groups
  Vector<Quaternion> anchor;    // per active group: the rotation that turn_limit is about, set while that is below pi
  Vector<Stress> stress;        // per active group
  Vector<double> columns;       // per active group what the global step aims at: three columns of four numbers each
  Vector<double> rows;          // 4 x 4 doubles per cluster, handles first: rows of X, padded
  Vector<double> known;         // the handles' part of the right-hand side
  double turn_limit = no_turn_limit;  // radians
};

struct SolveReport {
  std::uint32_t iterations = 0;
  // Largest Frobenius norm of the change of a group's rotation, or stress, in the last iteration.
  double last_change = 0;
};

// Groups of `component`, or of all when it is negative; their stress is taken away.
void start_rotations(const SmoothSystem& system, const Groups& groups, std::int32_t component, Span<const Vec3> turns,
                     SmoothState& state) noexcept;
void predict_rotations(const SmoothSystem& system, Span<const Vec3> increments, SmoothState& state) noexcept;
// Sets turn_limit and anchors for the accumulated turns of the handles.
void set_turn_limit(const SmoothSystem& system, Span<const Vec3> turns, SmoothState& state) noexcept;
// transforms: those of the handles are read, those of the free clusters written. Stops early when last_change falls
// below `tolerance`.
SolveReport solve_pose(const SmoothSystem& system, std::uint32_t iterations, double tolerance, SmoothState& state,
                       Affine* transforms) noexcept;

}  // namespace hf_inner

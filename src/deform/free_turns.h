// Handles whose place alone is given: the pose solve finds their rotations.
//
// A handle of free rotation is a positional constraint on the centroid of its region. Its rotation R_h is one more
// unknown of the local step of as-rigid-as-possible energy (Sorkine and Alexa 2007), a Procrustes problem. Let c_h be
// the centroid, d_h its given place, J_h = (I, -c_h), so the handle's transform (4 x 3, subspace.h) is X_h = J_h' R_h'
// + e_4 d_h'. subspace.h explains the other symbols. f stands for all free clusters together. |R_h y| = |y|, so the
// energy is linear in R_h, also after X_f is eliminated (variable projection, Golub and Pereyra 1973):
//     R_h = argmax tr(R' S_h),   -S_h' = J_h (sum_k L_hk Y_k - sum_g Q_gh R_g') + U_h' r + sum_{k != h} C_hk R_k',
//     U_h = L_ff^-1 L_fh J_h',   C_hk = J_h L_hk J_k' - (L_fh J_h')' U_k,   X_f = L_ff^-1 r - sum_h U_h R_h'.
// Y_k is X_k for a handle of given rotation, and e_4 d_k' for one of free rotation. r is the right-hand side of X_f for
// Y. So X_f and R_h are found together. Alternating between them would take many more iterations.
//
// One FreeTurns holds U, C and Q of one set of such handles. It never changes. Cost: one dense solve per handle, once;
// a frame adds a few products of vectors per iteration.
#pragma once
#include <cstdint>

#include "deform/handles.h"
#include "deform/holds.h"
#include "deform/rotation.h"
#include "deform/subspace.h"

namespace hf_inner::deform {

struct FreeTurns {
  explicit FreeTurns(Memory& memory)
      : handle(&memory), centroid(&memory), moment_start(&memory), moment(&memory), cross(&memory), follow(&memory) {}
  // How a rotation group acts on a handle: J_h Q_gh. group: position in Subspace::group.
  struct Moment {
    std::int32_t group;
    double q[3][3];
  };
  std::size_t count() const noexcept { return handle.size(); }

  std::size_t handle_count = 0;       // of the pose
  Vector<std::int32_t> handle;        // positions of the handles of free rotation, ascending
  Vector<Vec3> centroid;              // c_h, in the unit of the scaled mesh
  Vector<std::int32_t> moment_start;  // of handle k of the set: moment[moment_start[k] .. moment_start[k + 1])
  Vector<Moment> moment;
  Buffer<double> response;  // U_h: per handle of the set size rows of four numbers, the fourth is padding
  Vector<Mat3> cross;       // C_hk: [h * count + k]
  std::size_t hold_count = 0;
  Buffer<double> hold_pull;  // J_h V_h T (holds.h): per handle of the set four numbers a pin, the fourth is padding
  // The share of each handle of given rotation in the start rotation of handle h: [h * handle_count + i]. All 0 if no
  // handle of given rotation meets h.
  Vector<double> follow;
};

// seed_field: as SmoothSystem has it. free_turn: per handle, 1 for free rotation. holds: null, or the pins.
FreeTurns make_free_turns(const Subspace& subspace, const Handles& handles, Span<const std::uint8_t> free_turn,
                          const Vector<double>& seed_field, const Holds* holds, Memory& memory);

// The arrays that the solve for the rotations reads and writes.
struct FreeTurnsState {
  explicit FreeTurnsState(Memory& memory) : rotation(&memory), place(&memory), constant(&memory), fixed(&memory) {}
  FreeTurnsState(const FreeTurnsState& other, Memory& memory)
      : rotation(other.rotation, &memory),
        place(other.place, &memory),
        constant(other.constant, &memory),
        fixed(other.fixed, &memory) {}
  void fit(std::size_t count) {
    rotation.assign(count, Quaternion());
    place.assign(count, Vec3());
    constant.assign(count, Mat3());
    fixed.assign(count, Mat3());
  }
  Vector<Quaternion> rotation;  // R_h: the start, then the result
  Vector<Vec3> place;           // d_h, given
  Vector<Mat3> constant;        // J_h sum_k L_hk Y_k of this solve
  Vector<Mat3> fixed;           // the terms of -S_h' without other free handles, in this iteration
};

// Replaces the transforms of the free handles in `rows` (SmoothState::rows) by Y, and notes what stays the same in a
// solve.
void begin_turns(const FreeTurns& turns, const Subspace& subspace, double* rows, FreeTurnsState& state) noexcept;
// Finds the rotations for the right-hand side r (`size` unknowns, four numbers each) and the columns of the groups
// (SmoothState::columns), and writes the transforms of the handles into rows. gap: of the pins, four numbers each.
void find_turns(const FreeTurns& turns, const double* r, std::size_t size, const double* columns, const double* gap,
                double* rows, FreeTurnsState& state) noexcept;
// Subtracts sum_h U_h R_h' from the solved X_f.
void respond_to_turns(const FreeTurns& turns, const FreeTurnsState& state, double* solved, std::size_t size) noexcept;

}  // namespace hf_inner::deform

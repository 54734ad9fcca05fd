// Pins that hold the surface back where a handle is not to take it along.
//
// Each handle h has a share f_h: at 1 the whole surface follows it, at 0 its limb alone. m vertices v_j are pinned
// softly, spread over the components that have a handle with a share below 1. Each pin pulls towards y_j, where the
// surface would be without these handles. The reduced energy (subspace.h) becomes
//     E + 1/2 sum_j k_j |x_j - y_j|^2,   x = Z' X,   Z_c,j = W_{v_j},c (p_j, 1).
// With D = diag(k), L_ff the matrix of the free clusters and r their right-hand side without pins (Woodbury),
//     X_f = L_ff^-1 r + U lambda,   lambda = T (y - Z_h' X_h - Z_f' L_ff^-1 r),
//     U = L_ff^-1 Z_f,   T = (D^-1 + Z_f' U)^-1.
// So L_ff is not factorised again, and a new share costs m^3 / 6 multiply-adds. With handles of free rotation
// (free_turns.h explains the symbols) the energy of the pins is |y - V' X_h - U' r_g|_T^2 / 2, V = Z_h - L_hf U, and
//     -S_h' -= J_h V_h T e,   C_hk += J_h V_h T V_k' J_k',   e: the gap of the pins for Y.
//
// The strength of pin j follows from the fields phi of the handles with a share below 1:
//     k_j = s (1 - max phi(v_j))^p sum_h phi_h(v_j) g(f_h) / sum_h phi_h(v_j),   g(f) = hold_strength (1 - f) / f.
// It is small on the limb, whose field is near 1. With s = 1 / sum_j (Z_f' U)_jj the pins together are as stiff as the
// surface at one of them. So the size of the mesh and the number of pins do not matter.
//
// Cost: m / 4 dense solves, once; a frame adds 2 m size products per iteration. A failed call changes nothing.
#pragma once
#include <cstdint>

#include "deform/handles.h"
#include "deform/rotation.h"
#include "deform/subspace.h"

namespace hf_inner::deform {

// Strength of the pins at a share of one half, where all pins together count as one point of the surface. More lets a
// hand take less of the body along at the same share. A hand pulled up by 0.25 of the box moves the head of eight
// bipeds by 0.04 to 0.08. With a share of 0.25 the head moves by at most 0.03, and by 0.039 with a fifth of this
// strength.
constexpr double hold_strength = 6;
// How fast pins get weaker towards the handle: (1 - field)^power. With 4 the head moves by 0.039.
constexpr double hold_power = 2;
// A share below it holds as if it were this: an infinite strength would hold the limb too.
constexpr double least_following = 0.02;

struct Holds {
  explicit Holds(Memory& memory)
      : vertex(&memory), row_start(&memory), row(&memory), strength(&memory), system(memory) {}
  struct Part {
    std::int32_t cluster;
    double z[4];  // weight times (p, 1)
  };
  std::size_t count() const noexcept { return vertex.size(); }

  Vector<std::int32_t> vertex;     // v_j, inner
  Vector<std::int32_t> row_start;  // Z of pin j: row[row_start[j] .. row_start[j + 1])
  Vector<Part> row;
  Vector<double> strength;  // k_j
  Buffer<double> response;  // U: [unknown * count + j]
  DenseFactor system;       // of D^-1 + Z_f' U
};

struct HoldsInput {
  const mesh::Mesh& mesh;
  const Subspace& subspace;
  const ClusterWeights& weights;
  const Groups& groups;
  const HandleFields& fields;
  const Reach& reach;
  Span<const double> follow;  // f_h, by handle
};

// Returns no pin where no handle with a share below 1 meets another one.
Holds make_holds(const HoldsInput& input, Memory& memory);

// The arrays that a solve reads and writes.
struct HoldsState {
  explicit HoldsState(Memory& memory) : target(&memory), gap(&memory), pull(&memory) {}
  HoldsState(const HoldsState& other, Memory& memory)
      : target(other.target, &memory), gap(other.gap, &memory), pull(other.pull, &memory) {}
  void fit(std::size_t count) {
    target.assign(4 * count, 0.0);
    gap.assign(4 * count, 0.0);
    pull.assign(4 * count, 0.0);
  }
  Vector<double> target;  // y, four numbers a pin; given
  Vector<double> gap;     // y - Z_h' Y
  Vector<double> pull;    // lambda, scratch
};

// Notes the gap that the handles leave. rows: SmoothState::rows.
void begin_holds(const Holds& holds, std::size_t handle_count, const double* rows, HoldsState& state) noexcept;
// e = gap - U' r, into state.pull.
void gap_before(const Holds& holds, const double* r, std::size_t size, HoldsState& state) noexcept;
// Adds U lambda to the solved X_f. rows holds the transforms of all clusters, `solved` the transforms of the free
// clusters in it.
void add_holds(const Holds& holds, const double* rows, double* solved, std::size_t size, HoldsState& state) noexcept;

}  // namespace hf_inner::deform

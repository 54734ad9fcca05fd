// The elastic energy of the surface, restricted to positions blended from cluster transforms.
//
//     E(A, R) = 1/2 sum_e w_e |x_i - x_j - R (p_i - p_j)|^2,   x_v = sum_c W_vc A_c (p_v, 1)
//
// as-rigid-as-possible (Sorkine and Alexa 2007) in a reduced subspace with one rotation per group of vertices (Jacobson
// et al. 2012). With z_c(e) = W_ic (p_i, 1) - W_jc (p_j, 1) and X_c = A_c' (4 x 3), for fixed rotations
//     sum_d L_cd X_d = sum_g Q_gc R_g' + eps_c Rbar_c',
//     L_cd = sum_e w_e z_c z_d',   Q_gc = sum_{e at g} w_e/2 z_c (p_i - p_j)',
// over the free clusters d; those of handles are given. eps_c keeps a cluster that the energy leaves free near the mean
// rotation Rbar_c of its groups. For fixed transforms R_g = argmax tr(R' S_g), S_g = sum_c A_c Q_gc.
//
// Bending ends abruptly at a handle, and the group that lies across its border turns too far for the triangles there:
// edges gain weight towards the border, (1 + a b^4), b the handle's weight at the edge. With two handles a = 1/4;
// measured: smallest stretch of the bent cactus 0.786 -> 0.801, of the plane's longest edge 2.7 -> 2.5, energy + 0.1
// per cent.
// With more handles, whose bands are eased towards them (bands.h), a = 7/2.
//
// What the subspace leaves out: a cross-section stays affine. Ten times the groups and twice the bands lower the energy
// of the bent cylinder and of the twisted bar by 0.3 per cent, the full-mesh step (refine.h) by 3 and 5. Surfaces of
// the same volume with half the energy exist, but they are folded: dihedral angles change by 25 to 35 degrees.
//
// On large meshes edges are sampled, with 1 / probability as weight, never those of clusters that have few.
// Cost: edges times the square of the clusters at an edge, and one dense factorisation. On failure nothing is left
// behind.
#pragma once
#include <cstdint>

#include "deform/bands.h"
#include "deform/dense.h"
#include "deform/groups.h"
#include "deform/rotation.h"

namespace hf_inner {

struct Subspace {
  explicit Subspace(Memory& memory)
      : group(&memory),
        shared(&memory),
        entry_start(&memory),
        entry(&memory),
        use_start(&memory),
        use(&memory),
        mean_start(&memory),
        mean(&memory),
        stiffness(&memory),
        factor(memory) {}

  // What a group says to a cluster.
  struct Entry {
    std::int32_t cluster;
    double area;     // sum over the group's vertices of area times weight
    double q[4][3];  // Q_gc
  };
  struct Share {
    std::int32_t group;  // position in Subspace::group
    double area;
  };

  Vector<std::int32_t> group;        // groups of the elastic components, ascending
  Vector<std::uint8_t> shared;       // per active group: more than two handles meet in its component
  Vector<std::int32_t> entry_start;  // entries of group[k]: entry[entry_start[k] .. entry_start[k + 1])
  Vector<Entry> entry;
  // The entries of free cluster f and their groups (positions in Subspace::group), by group: use[use_start[f] ..
  // use_start[f + 1]).
  struct Use {
    std::int32_t entry, group;
  };
  Vector<std::int32_t> use_start;
  Vector<Use> use;
  Vector<std::int32_t> mean_start;  // groups under free cluster f: mean[mean_start[f] .. mean_start[f + 1])
  Vector<Share> mean;
  Vector<double> stiffness;  // eps_c per free cluster
  Buffer<double> coupling;   // L between free (rows) and handle clusters (columns), 4 x 4 blocks, row-major
  DenseFactor factor;        // of the free block
};

Subspace make_subspace(const Core& core, const Rest& rest, const ClusterWeights& weights, const Groups& groups,
                       Memory& memory);

}  // namespace hf_inner

// The elastic energy of the surface, restricted to positions blended from cluster transforms.
//
//     E(A, R) = 1/2 sum_e w_e |x_i - x_j - R (p_i - p_j)|^2,   x_v = sum_c W_vc A_c (p_v, 1)
//
// The sum runs over the edges e = (i, j). p is the rest position and x the posed position. A_c is the transform of
// cluster c. W_vc is the weight of vertex v in it. R is the rotation of the group at the edge. This is
// as-rigid-as-possible energy (Sorkine and Alexa 2007) in a reduced subspace, with one rotation per group of vertices
// (Jacobson et al. 2012). Let z_c(e) = W_ic (p_i, 1) - W_jc (p_j, 1) and X_c = A_c' (4 x 3). For fixed rotations
//     sum_d L_cd X_d = sum_g Q_gc R_g' + eps_c Rbar_c'
// holds for every free cluster c; the transforms of the handles are given. The coefficients are
//     L_cd = sum_e w_e z_c z_d',   Q_gc = sum_{e at g} w_e/2 z_c (p_i - p_j)'.
// eps_c keeps a cluster that the energy leaves free near the mean rotation Rbar_c of its groups. For fixed transforms
//     R_g = argmax tr(R' S_g),   S_g = sum_c A_c Q_gc.
//
// Bending ends abruptly at a handle, and the group across its border turns too far for the triangles there. So edges
// gain weight towards the border by the factor 1 + a b^4, where b is the handle's weight at the edge and a is
// border_stiffness.
//
// In this subspace cross-sections stay affine. On large meshes edges are sampled, and a sampled edge weighs 1 /
// probability. Clusters with few edges keep all of them. Cost: edges times the square of the clusters at an edge, and
// one dense factorisation. A failed call changes nothing.
#pragma once
#include <cstdint>

#include "deform/bands.h"
#include "deform/dense.h"
#include "deform/groups.h"
#include "deform/rotation.h"

namespace hf_inner::deform {

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

  // The coefficients by which a rotation group and a cluster act on each other.
  struct Entry {
    std::int32_t cluster;
    double area;     // sum over the group's vertices of area times weight in the cluster
    double q[4][3];  // Q_gc = sum of w_e/2 z_c (p_i - p_j)' over the group's edges
  };
  struct Share {
    std::int32_t group;  // position in Subspace::group
    double area;
  };

  Vector<std::int32_t> group;        // numbers of the rotation groups in use, by component, ascending
  Vector<std::uint8_t> shared;       // per group in use: more than two handles meet in its component
  Vector<std::int32_t> entry_start;  // entries of group[k]: entry[entry_start[k] .. entry_start[k + 1])
  Vector<Entry> entry;
  // The entries (pairs with a rotation group) of free cluster f, ordered by group, a position in Subspace::group:
  // use[use_start[f] .. use_start[f + 1]).
  struct Use {
    std::int32_t entry, group;
  };
  Vector<std::int32_t> use_start;
  Vector<Use> use;
  Vector<std::int32_t> mean_start;  // rotation groups under free cluster f: mean[mean_start[f] .. mean_start[f + 1])
  Vector<Share> mean;
  Vector<double> stiffness;  // eps_c, a small stiffness per free cluster
  Buffer<double> coupling;   // L between free (rows) and handle clusters (columns), 4 x 4 blocks, row-major
  Buffer<double> between;    // L between handles, the blocks of a row up to its diagonal, likewise
  DenseFactor factor;        // factor of the part of L between free clusters
};

Subspace make_subspace(const surface::Core& core, const Rest& rest, const ClusterWeights& weights, const Groups& groups,
                       Memory& memory);

}  // namespace hf_inner::deform

// The chosen numbers of poses: what each trades, and on what it was chosen. Limits that hosts meet come first.
//
// "Bench" is hf_bench deform-quality: planes, bars, a cylinder, a cactus and a scan (docs/studies/poses.md).
#pragma once
#include <cstddef>
#include <cstdint>

namespace hf_inner {

// ---- limits of the C ABI: src/capi checks against these ----

constexpr std::uint32_t handle_limit = 256;  // of a pose; with free_cluster_limit, cluster numbers fit 16 bits
constexpr std::uint32_t layer_limit = 8;     // of a pose; each layer above the first holds two more poses
constexpr std::uint32_t least_bands = 2, most_bands = 64;  // clusters are bounded by free_cluster_target anyway
constexpr std::uint32_t most_iterations = 1000;            // of one deform()
constexpr std::uint32_t most_groups = 2000;                // an iteration costs one rotation a group
constexpr std::uint32_t most_joints = 8;                   // weights of a vertex in a skin: engines read 4 or 8
constexpr double largest_translation = 1e15;  // box diagonals; beyond, a double no longer resolves the surface

// ---- pose.cpp, pose_stack.cpp ----

// Bands per field. Smooth, on the scan: 5 cost 8 to 18 % of energy, 20 gain 6 % and stretch an edge by 1.42 for 1.29.
constexpr std::uint32_t default_bands_smooth = 10, default_bands_paper = 12;
// Per frame. Five smooth ones leave 0.3 % of the energy at most; the paper's mode moves one band per iteration.
constexpr std::uint32_t default_iterations_smooth = 5, default_iterations_paper = 200;
// Rotation groups, against time per iteration. 125 lower the pulled scan's smallest stretch from 0.74 to 0.68. Ten
// times the groups with twice the bands lower the energy of the bent cylinder and the twisted bar by 0.3 %; the
// full-mesh step lowers it by 3 and 5.
constexpr std::uint32_t default_groups = 250;
// Largest change of a rotation (Frobenius) below which a pose asked for again is not solved on.
constexpr double settled_change = 1e-6;
// Iterations on one target. The smooth mode unwinds twists of many turns beyond; the paper's needs hundreds to
// converge.
constexpr std::uint32_t idle_limit_smooth = 100, idle_limit_paper = 2000;
// Radians a handle may turn in one step; beyond, the pose starts afresh from the fields instead of predicting.
constexpr double jump_turn = 1.75;
// Steps of a layer, which starts from the surface below at every change; more than the default of a pose that goes on.
constexpr std::uint32_t least_layer_iterations = 16;

// Largest error of a number of a rigid matrix: rounded to floats it is off by 6e-8. What passes is made rigid.
constexpr double rigid_tolerance = 1e-4;

// ---- pose_solver.cpp ----

// Step of the local rotations over the fitted one; 1 is plain alternation. 1.25 and 1.75 move energies by 0.2 % at
// most.
constexpr double over_relaxation = 1.5;
// Cosine of half the turn (90 degrees) above which steps are over-relaxed; larger turns go to the fitted rotation.
constexpr double over_relaxed_cosine = 0.7;
// Radians between handles at which rotations are kept near the blended turns, and at which the limit is
// least_turn_limit: a twist of 450 degrees must not fall back by a whole turn (tests/unit/deform/drag_test.cpp).
constexpr double turn_limit_from = 5.0, turn_limit_full = 7.0, least_turn_limit = 0.3;

// ---- strain.cpp ----

struct StrainLimits {
  double low, high;    // of sigma
  double stiffness;    // k
  double largest;      // c
  double contraction;  // n
  double follow;       // r
};
// By the handles of the component: two, more. Fitted on two planes and two poses of a scan; settings nearby meet the
// same bars, and 15 of 16 poses of eight other meshes keep more edges within [0.8, 1.25] (docs/studies/poses.md).
constexpr StrainLimits strain_limits[] = {{0.8, 1.24, 4.0, 0.25, 0.0, 0.28}, {0.92, 1.14, 8.0, 0.5, 0.2, 0.16}};
// m_2 / m_1 below which a group is a line, which is never under stress; half or double: the same bench.
constexpr double thinnest_sheet = 1e-2;
constexpr double largest_strain = 1e150;  // its square is still a double

// ---- subspace.cpp ----

// eps over the mean diagonal of a cluster's linear part: holds what the energy leaves free. Half of
// it loses the bar of the plane's refined stretch (0.846 for 0.851), double costs the plane 0.6 % of energy.
constexpr double rigidity = 1e-3;
// Gain of edges at a handle's border, by the handles of the component: two, more. 1/4 raises the smallest stretch of
// the bent cactus from 0.786 to 0.801 for 0.1 % of energy; 7/2 belongs to the strain limits (docs/studies/poses.md).
constexpr double border_stiffness[] = {0.25, 3.5};
// Edges of the energy, against the time of first handles. Half or double change the scan's energy by 1 %.
constexpr double edge_samples = 60000;
constexpr std::int32_t few_edges = 1500;    // clusters with fewer are summed whole; half or double: the same bench
constexpr std::int32_t edge_piece = 16384;  // edges a thread takes at once; fixed, so that sums keep their order

// ---- rest.cpp, rest.h ----

// Edge weights of the energy are clamped: negative ones would reward collapse, huge ones come from needles. Half or
// double of either bound changes nothing in the bench.
constexpr double least_edge_weight = 0.01, largest_edge_weight = 25;
constexpr std::int32_t vertex_piece = 4096;  // vertices a thread takes at once; fixed, so that sums keep their order

// ---- bands.cpp, cluster_rows.cpp ----

// Of |phi|: smaller fields do not count at a vertex. With 0.03 a scan with three handles has 2 % less energy and twice
// the weights, a torus with eight handles four times as many. With 0.6 the scan folds, with 0.15 its longest edge goes
// from 1.29 to 1.40.
constexpr double field_prune = 0.3;
constexpr double piece_share =
    0.02;  // of its band: smaller pieces are dropped; half or double change nothing in the bench
constexpr double smallest_area =
    2e-4;                          // of its component: smaller clusters are dropped; double drops 1 of the scan's 30
constexpr double area_growth = 4;  // of smallest_area, until clusters are within free_cluster_limit
// The dense solve grows with the cube of the clusters: bands get wider to reach the target, pieces are dropped above
// the limit.
constexpr std::int32_t free_cluster_target = 480, free_cluster_limit = 768;
constexpr double weight_prune = 1e-3;  // of |W|: smaller weights are dropped; half or double move energies by 0.2 %

// ---- levels.cpp ----

constexpr double least_twice_area = 1e-300;  // guards a division; triangles without area have no gradient
constexpr double steepest_gradient = 1e9;    // per box: beyond, a needle and not the field
constexpr int level_bins = 128;              // of a field's values, against 10 to 64 bands
constexpr int smoothed_bins = 3;  // to each side in the running mean of gradients; 1 or 6 move energies by 0.3 %
constexpr double least_gradient =
    1e-4;  // of the largest: bounds the length of flat parts; half or double: the same bench
constexpr double triangle_samples = 20000;     // of a component, against time; half or double move energies by 0.2 %
constexpr std::uint32_t histogram_shares = 8;  // parts of the triangles for threads; fixed: sums keep their order

// ---- groups.cpp ----

constexpr std::int32_t least_group_share = 4;  // a component gets its share by area, and 1/4 of all groups at least
constexpr std::size_t farthest_block = 256;    // vertices searched again when a distance among them changed

// ---- blend.cpp, blend_blocks.cpp ----

constexpr std::int32_t packed_at_once = 256;  // vertices (6 KB): still in the first cache when they are packed
constexpr std::int32_t blocks_at_once = 512;  // of eight vertices: vertex_piece, as threads take them elsewhere
constexpr std::int32_t block_sharing = 4;     // weights per cluster from which eight vertices are blended together

// ---- dense.cpp ----

constexpr double pivot_floor = 1e-10;  // of the diagonal: below, an unknown depends on the ones before it

// ---- paper_scheme.cpp ----

constexpr std::int32_t samples_per_cluster = 40;  // against time; 240 lower the energy by 7 to 11 % (bench)

// ---- refine.cpp ----

constexpr std::int32_t samples_per_group = 24;  // vertices whose edges give a group its rotation on a given surface

// ---- rotation.cpp, rotation_batch.cpp ----

constexpr double least_norm_square = 1e-200, largest_norm_square = 1e200;      // beyond, normalised_far()
constexpr double least_matrix_square = 1e-300, largest_matrix_square = 1e300;  // squares within keep their digits
constexpr double least_near_share = 1e-20;  // squared: below, `near` is orthogonal to all best rotations
// When a drag goes on beyond half a turn. Half and double (and 1e-10 or 1e-3 radians for the axis) pass the 22 tests of
// drags and rotations alike; no other figure was tried.
constexpr double principal_turn = 0.9 * 3.14159265358979323846;  // radians: below, the shortest turn is meant
constexpr double least_axis_angle = 1e-9;                        // radians: below, a turn has no axis
constexpr double farthest_gap2 = 1.0, longest_step2 = 2.25;      // squared radians: beyond the gap, the old axis stays
constexpr double small_angle = 1e-4;           // radians: below, two terms of the series are exact in double
constexpr double equal_eigenvalues = 1e-12;    // of a matrix of size 1: rounding of its eigenvalues, and a margin
constexpr double newton_floor = 1e-6;          // of |S|: pivots above it certify a maximum
constexpr int newton_steps = 6;                // each squares the error: warm starts arrive in four (rotation_test)
constexpr double longest_newton_step = 1.0;    // squared radians: beyond, the quadratic model says nothing
constexpr double settled_newton_step = 1e-14;  // squared radians of the last step; its error is of the order of that

// ---- skin.cpp ----

// Stretching joints replay a lifted plane within 0.2 % of the box, rigid ones within 2.5; bends and twists 0.1 for 0.6.
constexpr double skin_vertices = 20000;      // of the fit, against its time
constexpr int skin_rounds = 8;               // over all joints
constexpr int stretch_rounds = 6;            // rotation and stretch of one joint in turn
constexpr double least_moment = 1e-300;      // guards a division
constexpr double stretch_ballast = 1e-6;     // of the moments: directions in which a joint has no extent keep s = 1
constexpr double least_stretch = 1e-3;       // a joint's scale stays positive
constexpr double least_vertex_area = 1e-12;  // of the box squared: vertices without area still count

}  // namespace hf_inner

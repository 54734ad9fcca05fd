// The chosen numbers of poses: what each trades, and on what it was chosen. Limits that callers meet come first.
//
// "Bench" is the program hf_bench deform-quality: planes, bars, a cylinder, a cactus and a scan
// (docs/studies/poses.md).
#pragma once
#include <cstddef>
#include <cstdint>

namespace hf_inner {

// ---- limits of the C ABI; src/capi checks them ----

// Most handles of a pose. Together with free_cluster_limit it keeps cluster numbers within 16 bits.
constexpr std::uint32_t handle_limit = 256;
// Most layers of a pose; each layer above the first holds two more poses.
constexpr std::uint32_t layer_limit = 8;
// Fewest and most bands that a caller may ask for; free_cluster_target bounds the clusters anyway.
constexpr std::uint32_t least_bands = 2, most_bands = 64;
// Most iterations of one deform() call.
constexpr std::uint32_t most_iterations = 1000;
// Most rotation groups; an iteration computes one rotation per group.
constexpr std::uint32_t most_groups = 2000;
// Most weights of a vertex in a skin; game engines read 4 or 8.
constexpr std::uint32_t most_joints = 8;
// Largest translation, in diagonals of the bounding box. Beyond it a double no longer resolves the surface.
constexpr double largest_translation = 1e15;

// ---- pose.cpp, pose_stack.cpp ----

// Bands per field. With 5 smooth bands, the scan's energy is 8 to 18 % larger. With 20 it is 6 % smaller, but the
// largest edge stretch grows from 1.29 to 1.42.
constexpr std::uint32_t default_bands_smooth = 10, default_bands_paper = 12;
// Iterations per frame. After five in smooth mode, the energy is within 0.3 % of its minimum. In paper mode, motion
// moves on by only one band per iteration.
constexpr std::uint32_t default_iterations_smooth = 5, default_iterations_paper = 200;
// Rotation groups: more of them fit better but make each iteration slower. With 125, the pulled scan's smallest stretch
// falls from 0.74 to 0.68. Ten times the groups with twice the bands lower the energy of the bent cylinder and the
// twisted bar by 0.3 %. The full-mesh step (refine.h) lowers these two energies by 3 and 5 %.
constexpr std::uint32_t default_groups = 250;
// A pose counts as converged when no rotation changes by more (Frobenius norm). Solving it again then does nothing.
constexpr double settled_change = 1e-6;
// Most iterations while the handles stay in place. Beyond it, the smooth mode would unwind twists of many turns. The
// paper mode needs hundreds to converge.
constexpr std::uint32_t idle_limit_smooth = 100, idle_limit_paper = 2000;
// If a handle turns by more radians in one step, the pose starts again from the fields instead of from a prediction.
constexpr double jump_turn = 1.75;
// Fewest iterations of a layer. A layer starts from the surface below at every change, so it needs more than a pose
// that continues.
constexpr std::uint32_t least_layer_iterations = 16;

// How far an entry of a given matrix may be from a rigid motion; rounding to floats costs 6e-8. An accepted matrix is
// replaced by the nearest rigid one.
constexpr double rigid_tolerance = 1e-4;

// ---- pose_solver.cpp ----

// Length of a local rotation step, relative to the step to the fitted rotation (over-relaxation). 1 is plain
// alternation. 1.25 and 1.75 change energies by at most 0.2 %.
constexpr double over_relaxation = 1.5;
// Only steps with a larger cosine of half their angle (turns below 90 degrees) are over-relaxed. Larger turns go
// exactly to the fitted rotation.
constexpr double over_relaxed_cosine = 0.7;
// When handles turn against each other by more than the first angle, group rotations must stay near the blended turns.
// From the second angle on they stay within least_turn_limit (all in radians). Otherwise a twist of 450 degrees falls
// back by a whole turn (tests/unit/deform/drag_test.cpp).
constexpr double turn_limit_from = 5.0, turn_limit_full = 7.0, least_turn_limit = 0.3;

// ---- strain.cpp ----

struct StrainLimits {
  double low, high;    // clamps the stretch sigma
  double stiffness;    // k: how many times stiffer a group gets outside the limits
  double largest;      // c: largest stress
  double contraction;  // n: contraction across a pull
  double follow;       // r: share of the way to the wanted stress, per iteration
};
// Limits for components with two handles, and for those with more. They were fitted on two planes and two poses of a
// scan. Settings close to these meet the same targets of stretch. In 15 of 16 poses of eight other meshes, more edges
// keep a stretch within [0.8, 1.25] (docs/studies/poses.md).
constexpr StrainLimits strain_limits[] = {{0.8, 1.24, 4.0, 0.25, 0.0, 0.28}, {0.92, 1.14, 8.0, 0.5, 0.2, 0.16}};
// A group whose second moment is below this share of its first is a line, and a line has no stress. Halving or doubling
// it changes no bench figure.
constexpr double thinnest_sheet = 1e-2;
constexpr double largest_strain = 1e150;  // its square is still a double

// ---- subspace.cpp ----

// Stiffness that holds a cluster where the energy leaves it free, relative to the mean diagonal of its linear part.
// Half the value lowers the plane's smallest stretch after refinement from 0.851 to 0.846, below its bound. Twice the
// value raises the plane's energy by 0.6 %.
constexpr double rigidity = 1e-3;
// Extra weight of edges at a handle's border, for components with two handles and with more. 0.25 raises the smallest
// stretch of the bent cactus from 0.786 to 0.801, and the energy by 0.1 %. 3.5 was fitted together with the strain
// limits (docs/studies/poses.md).
constexpr double border_stiffness[] = {0.25, 3.5};
// Edges sampled for the energy: fewer make the first solve with new handles faster. Halving or doubling it changes the
// scan's energy by 1 %.
constexpr double edge_samples = 60000;
// A cluster with fewer edges uses all of them instead of a sample. Halving or doubling it changes no bench figure.
constexpr std::int32_t few_edges = 1500;
// Edges of one thread's job. The size is fixed, so that sums keep their order.
constexpr std::int32_t edge_piece = 16384;

// ---- rest.cpp, rest.h ----

// Edge weights of the energy are clamped to this range. Negative weights would reward collapse, and huge ones come from
// needle-shaped triangles. Halving or doubling either bound changes no bench figure.
constexpr double least_edge_weight = 0.01, largest_edge_weight = 25;
// Vertices of one thread's job. The size is fixed, so that sums keep their order.
constexpr std::int32_t vertex_piece = 4096;

// ---- bands.cpp, cluster_rows.cpp ----

// A field counts at a vertex only above this share of the norm of all fields there. With 0.03, a scan with three
// handles has 2 % less energy but twice the weights, and a torus with eight handles four times the weights. With 0.6
// the scan folds. With 0.15 its longest edge stretches by 1.40 instead of 1.29.
constexpr double field_prune = 0.3;
// Connected pieces below this share of their band's area are dropped. Halving or doubling it changes no bench figure.
constexpr double piece_share = 0.02;
// Clusters below this share of their component's area are dropped. Twice the value drops 1 of the scan's 30 clusters.
constexpr double smallest_area = 2e-4;
// While there are more than free_cluster_limit clusters, smallest_area grows by this factor.
constexpr double area_growth = 4;
// The time of the dense solve grows with the cube of the number of clusters. Bands get wider to reach the target, and
// pieces are dropped above the limit.
constexpr std::int32_t free_cluster_target = 480, free_cluster_limit = 768;
// Weights below this share of the norm of their row are dropped. Halving or doubling it changes energies by 0.2 %.
constexpr double weight_prune = 1e-3;

// ---- levels.cpp ----

// Guards a division: triangles without area have no gradient.
constexpr double least_twice_area = 1e-300;
// Largest gradient, per box diagonal. A larger one comes from a needle and not from the field.
constexpr double steepest_gradient = 1e9;
// Bins into which the values of a field are sorted, to space 10 to 64 bands.
constexpr int level_bins = 128;
// Bins to each side in the running mean of gradients. 1 and 6 change energies by 0.3 %.
constexpr int smoothed_bins = 3;
// Least gradient, as a share of the largest. It limits how many bands fall on parts where the field is nearly constant.
// Halving or doubling it changes no bench figure.
constexpr double least_gradient = 1e-4;
// Triangles of a component in the histogram: fewer take less time. Halving or doubling it changes energies by 0.2 %.
constexpr double triangle_samples = 20000;
// Jobs into which the triangles are split. The number is fixed, so that sums keep their order.
constexpr std::uint32_t histogram_shares = 8;

// ---- groups.cpp ----

// A component gets rotation groups by its share of the area, and at least one group in this many of all groups.
constexpr std::int32_t least_group_share = 4;
// Size of a block of vertices. A block is searched again when a distance in it has changed.
constexpr std::size_t farthest_block = 256;

// ---- blend.cpp, blend_blocks.cpp ----

// Vertices (6 KB) blended before they are packed: they are still in the first-level cache then.
constexpr std::int32_t packed_at_once = 256;
// Blocks of eight vertices in one job; together they are vertex_piece vertices.
constexpr std::int32_t blocks_at_once = 512;
// Eight vertices are blended as one block if they have at least this many weights per different cluster.
constexpr std::int32_t block_sharing = 4;

// ---- dense.cpp ----

// A pivot below this share of its diagonal means that the unknown depends on earlier ones.
constexpr double pivot_floor = 1e-10;

// ---- paper_scheme.cpp ----

// Sampled vertices per cluster: fewer take less time. 240 lower the energy by 7 to 11 % in the bench.
constexpr std::int32_t samples_per_cluster = 40;

// ---- refine.cpp ----

// Most vertices of a group whose edges give the group its rotation on a given surface.
constexpr std::int32_t samples_per_group = 24;

// ---- rotation.cpp, rotation_batch.cpp ----

// Squared norms of quaternions outside this range are scaled first, by normalised_far().
constexpr double least_norm_square = 1e-200, largest_norm_square = 1e200;
// Squares of matrices within this range keep their digits.
constexpr double least_matrix_square = 1e-300, largest_matrix_square = 1e300;
// Squared. Below it, the rotation to stay near is orthogonal to all best rotations.
constexpr double least_near_share = 1e-20;
// The next three decide how a drag goes on beyond half a turn. At half and at twice each value (the axis also with
// 1e-10 and 1e-3 radians), the 22 tests of drags and rotations pass alike; no other figure was tried.
constexpr double principal_turn = 0.9 * 3.14159265358979323846;  // radians: below it, the shortest turn is meant
constexpr double least_axis_angle = 1e-9;                        // radians: a smaller turn has no axis
constexpr double farthest_gap2 = 1.0, longest_step2 = 2.25;      // squared radians: beyond the gap, the old axis stays
// Below this angle (radians) the first two terms of the sine's series are exact in double.
constexpr double small_angle = 1e-4;
// Eigenvalues of a matrix of size 1 that differ by less count as equal: their rounding error and a margin.
constexpr double equal_eigenvalues = 1e-12;
// Pivots above this share of the norm of S prove that the step is near a maximum.
constexpr double newton_floor = 1e-6;
// At most this many Newton steps. Each squares the error, so starts near the result need four (rotation_test).
constexpr int newton_steps = 6;
// Longest Newton step (squared radians). Beyond it the quadratic model does not predict the maximum.
constexpr double longest_newton_step = 1.0;
// Length of the last Newton step (squared radians). The remaining error is about as large as this number.
constexpr double settled_newton_step = 1e-14;

// ---- skin.cpp ----

// The next numbers fit joints to the posed surface. With stretching joints, a lifted plane is replayed within 0.2 % of
// the box, with rigid joints within 2.5 %. Bends and twists come within 0.1 % instead of 0.6 %.
constexpr double skin_vertices = 20000;  // at most this many vertices in the fit: fewer take less time
constexpr int skin_rounds = 8;           // rounds over all joints
constexpr int stretch_rounds = 6;        // rounds that fit rotation and stretch of one joint in turn
constexpr double least_moment = 1e-300;  // guards a division
// Added to the moments, as a share of them: a joint without extent in a direction keeps the scale 1 there.
constexpr double stretch_ballast = 1e-6;
constexpr double least_stretch = 1e-3;       // keeps a joint's scale positive
constexpr double least_vertex_area = 1e-12;  // as a share of the squared box: vertices without area still count

}  // namespace hf_inner

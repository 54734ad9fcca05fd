// The chosen numbers of poses: each with its trade, and the data on which it was chosen. Limits that callers meet come
// first.
//
// The benchmark is the program hf_bench deform-quality: planes, bars, a cylinder, a cactus and a scan
// (docs/poses.md). "Twelve poses" are seven of a tube and five of meshes. The tube is twisted by 450 degrees,
// turned by 149 at once, or turned by 30 and left alone. It is bent, also refined, in the paper's mode, and with a
// handle on a second layer. The meshes are a cat, a scorpion, a triceratops, an anchor and a machine of 47 pieces, with
// 6 to 39 handles that turn and move. Lengths of edges are shares of those at rest.
#pragma once
#include <cstddef>
#include <cstdint>

namespace hf_inner::deform {

// ---- limits of the C ABI; intake.cpp checks them ----

// At most this many handles in a pose. Then the numbers of handles and clusters (overlapping bands) fit 16 bits.
constexpr std::uint32_t handle_limit = 256;
// At most this many layers of handles in a pose; each layer above the first holds two more poses.
constexpr std::uint32_t layer_limit = 8;
// A caller may ask for this many level bands per handle at least and at most. Each band makes clusters of vertices, and
// free_cluster_target bounds their number anyway.
constexpr std::uint32_t least_bands = 2, most_bands = 64;
// At most this many iterations in one deform() call.
constexpr std::uint32_t most_iterations = 1000;
// At most this many full-mesh steps in one deform() call. It bounds the time: 16 end within 5 % of the energy of
// converged as-rigid-as-possible, 64 within 1 % (median of three scans).
constexpr std::uint32_t most_refine_steps = 64;
// At most this many groups of vertices that share a rotation; an iteration computes one rotation per group.
constexpr std::uint32_t most_groups = 2000;
// At most this many joints move a vertex of a skin; game engines read 4 or 8.
constexpr std::uint32_t most_joints = 8;
// Largest translation, in diagonals of the bounding box. Beyond it a double no longer resolves the surface.
constexpr double largest_translation = 1e15;

// Bounds what a wrong count of joints reads. Skins of scene files number joints with 16 bits.
constexpr std::uint32_t most_skeleton_joints = 65536;
// Proposals without a limit of the caller: more than limbs of an animal, few enough for a menu. 18 shared creatures get
// 8 on average, so it bounds hosts alone.
constexpr std::uint32_t default_proposals = 32;

// ---- normals.cpp ----

// A shorter normal sum (in squares of the box) is only rounding of the positions and has no direction. It is a guard:
// frame_test takes normals of surfaces of 1e-15 boxes.
constexpr double least_normal_sum = 1e-36;
// A sum of normals with a length in this range can be squared in single precision: its square is 1e-30 to 1e30, and a
// float ends at 1e-38 and 3e38. Other sums take double precision, which changes the last bits.
constexpr float shortest_sum = 1e-15f, longest_sum = 1e15f;

// ---- pose.cpp, pose_stack.cpp ----

// Level bands per handle's field. With 5, the elastic energy of a scanned mesh
// is 8 to 18 % larger. With 20 it is 6 % smaller, but the largest edge stretch grows from 1.29 to 1.42.
constexpr std::uint32_t default_pose_bands = 10;
// Iterations per frame. They trade time for a surface that stands still when a drag stops. On 36 poses of 12 shapes,
// dragged as in docs/poses.md, it creeps on by 6.5e-5 of the box in the mean. With 8 it is 1.1e-4, with 6 it is 5.1e-4.
// Each takes 0.16 ms with five handles.
constexpr std::uint32_t default_pose_iterations = 10;
// Groups of vertices that share a rotation: more of them fit better but make each iteration slower. With 125, the
// smallest edge stretch of a pulled scan falls from 0.74 to 0.68. Ten times the groups with twice the bands lower the
// elastic energy of a bent cylinder and a twisted bar by 0.3 %. The full-mesh step (refine.h) lowers these two energies
// by 3 and 5 %.
constexpr std::uint32_t default_groups = 250;
// The elastic energy counts a stiffness of at most this and at least 1 over it; the fields count all of it. With 25 a
// stiff region changes its lengths four times as much. With 1e4 its rotation hardly changes in an
// iteration: a tube with a rigid belt stops 0.04 of its box short of its place with 25 to 256.
constexpr double largest_energy_stiffness = 100;
// A pose counts as converged when no group's rotation changes by more in an iteration (Frobenius norm). Solving it
// again then does nothing. At 1e-6, poses at rest stay 2e-5 of the box away from it.
constexpr double settled_change = 1e-9;
// At most this many iterations while the handles stay in place. More would unwind twists of many turns. A bound: half
// and double change no bit of twelve poses, whose motion settles before.
constexpr std::uint32_t pose_idle_limit = 100;
// If a handle turns by more radians in one step, the rotations start again from all handles' whole turns. Otherwise the
// step is added to the last rotations. A smaller angle forgets fast drags, a larger one keeps a twist that was meant
// anew. Half and double change no bit of twelve poses, one of which turns by more at once, nor a figure of the
// benchmark.
constexpr double jump_turn = 1.75;
// At least this many iterations solve a layer of handles. A layer starts from the surface below at every change, so it
// needs more than a pose that continues. On a bent tube with a handle on a second layer, half moves the surface by
// 0.012 of its length. It presses edges to 0.32 instead of 0.35. Double moves it by 0.003 in twice the time.
constexpr std::uint32_t least_layer_iterations = 16;

// How far an entry of a given matrix may be from a rigid motion; rounding to floats costs 6e-8. An accepted matrix is
// replaced by the nearest rigid one.
constexpr double rigid_tolerance = 1e-4;

// ---- pose_solver.cpp ----

// Steps that the acceleration of rotations learns from (anderson.h). They are to reach back beyond the iterations of a
// frame: steps of earlier frames know the slow motions. With ten iterations a frame, 12 poses of four shapes creep by
// 1.3e-5 of the box in the geometric mean when a drag stops. With 16 steps it is 8.6e-5. With 32 it is 7e-6, for a
// third more memory.
constexpr std::size_t anderson_steps = 24;
// A residual whose square grows by this factor makes the acceleration forget its steps. With 100 the mean is 2.1e-4,
// but the worst pose is 3.1e-2 off instead of 1.6e-2.
constexpr double anderson_growth = 4;
// Damps directions in which the steps hardly differ, beside 1. With 1e-12 the mean is 2.5e-4, with 1e-6 2.6e-4.
constexpr double anderson_damping = 1e-9;
// The acceleration moves the rotation of a group by at most this (Frobenius norm; 0.3 radians), and by as much a motion
// of a scheme (pose_scheme.h). Without it, one pose of 36 went to another minimum and stayed there. 0.1 gives the same
// mean.
constexpr double longest_leap = 0.4;
// When handles turn against each other by more than the first angle, the rotation of each vertex group must stay near
// the blended turns. From the second angle on it stays within least_turn_limit (all in radians). Otherwise a twist of
// 450 degrees falls back by a whole turn (tests/unit/deform/drag_test.cpp). Half the first angle moves one of twelve
// poses by 0.001 of the box. With full at 3.5 or from at 10, all poses are limited: the elastic energy of a lifted
// plane is 1.29 times the least instead of 1.17. On the twisted tube double the second or the third presses edges to
// 0.60 instead of 0.70, half the third to 0.67.
constexpr double turn_limit_from = 5.0, turn_limit_full = 7.0, least_turn_limit = 0.3;

// ---- strain.cpp ----

struct StrainLimits {
  double low, high;    // stretch of a group of vertices that meets no added stiffness
  double stiffness;    // k: how many times stiffer a group gets outside low and high
  double largest;      // c: largest stress
  double contraction;  // n: contraction across a pull (Poisson's ratio)
  double follow;       // r: share of the way to the wanted stress, per iteration
};
// Limits of stretch for components with two handles, and for those with more. They were fitted on two planes and two
// poses of a scan. Settings close to these keep the same share of edges within the wanted stretch. In 15 of 16 poses of
// eight other meshes, more edges keep a stretch within [0.8, 1.25] (docs/poses.md).
constexpr StrainLimits strain_limits[] = {{0.8, 1.24, 4.0, 0.25, 0.0, 0.28}, {0.92, 1.14, 8.0, 0.5, 0.2, 0.16}};
// A group of vertices whose second moment is below this share of its first is a line, and a line has no stress. Halving
// or doubling it changes no energy or stretch in the benchmark.
constexpr double thinnest_sheet = 1e-2;
// Its square is still a double.
constexpr double largest_strain = 1e150;

// ---- subspace.cpp ----

// Stiffness that holds a cluster (part of a level band) where the elastic energy leaves it free, as a share of its mean
// diagonal. Half the value lowers the smallest edge stretch of a refined plane from 0.851 to 0.846, below its bound.
// Twice the value raises the plane's energy by 0.6 %.
constexpr double rigidity = 1e-3;
// Extra weight of edges at a handle's border, for components with two handles and with more. The first raises the
// smallest edge stretch of a bent cactus from 0.786 to 0.801, and its elastic energy by 0.1 %. The second was fitted
// together with strain_limits (docs/poses.md).
constexpr double border_stiffness[] = {0.25, 3.5};
// Edges sampled for the elastic energy: fewer make the first solve with new handles faster. Halving or doubling it
// changes the energy of a scan by 1 %.
constexpr double edge_samples = 60000;
// A cluster of vertices with fewer edges uses all of them instead of a sample. Halving or doubling it changes no energy
// or stretch in the benchmark.
constexpr std::int32_t few_edges = 1500;
// Jobs that count the edges of clusters. Counts are whole numbers, so no result depends on it.
constexpr std::uint32_t count_shares = 8;
// One thread's job sums this many edges of the elastic energy: smaller jobs cost more to start, larger ones leave
// threads idle. The size is fixed, so that sums keep their order. Half and double change no bit of twelve poses.
constexpr std::int32_t edge_piece = 16384;
// Most edges whose sums are taken together, where the clusters are the same: more take room in the first-level cache.
// No result depends on it: every sum keeps the order of edges.
constexpr std::int32_t longest_run = 16;

// ---- rest.cpp, rest.h ----

// Edge weights of the energy are clamped to this range. Negative weights would reward collapse, and huge ones come from
// needle-shaped triangles. Halving or doubling either bound changes no energy or stretch in the benchmark.
constexpr double least_edge_weight = 0.01, largest_edge_weight = 25;
// One thread's job handles this many vertices: smaller jobs cost more to start, larger ones leave threads idle. The
// size is fixed, so that sums keep their order. Half and double change no bit of twelve poses.
constexpr std::int32_t vertex_piece = 4096;
// Triangles of a component that give the field's mean gradient: fewer take less time. Halving or doubling it changes
// elastic energies by 0.2 %.
constexpr double triangle_samples = 20000;
// Jobs into which the triangles are split: more suit more threads and add more sums. The number is fixed, so that sums
// keep their order. Half and double change no bit of twelve poses.
constexpr std::uint32_t histogram_shares = 8;
// Guards a division: triangles without area have no gradient.
constexpr double least_twice_area = 1e-300;

// ---- band_patches.cpp, bands.cpp, cluster_rows.cpp ----

// A handle's field counts at a vertex only above this share of the norm of all fields there. With 0.03, a scan with
// three handles has 2 % less elastic energy but twice as many weights per vertex. A torus with eight handles then has
// four times as many. With 0.6 the scan folds. With 0.15 its longest edge stretches by 1.40 instead of 1.29.
constexpr double field_prune = 0.3;
// Connected pieces of a level band below this share of the band's area make no cluster. Halving or doubling it changes
// no energy or stretch in the benchmark.
constexpr double piece_share = 0.02;
// Clusters (pieces of level bands) below this share of their component's area are dropped. Twice the value drops 1 of
// 30 clusters of a scan.
constexpr double smallest_area = 2e-4;
// While there are more than free_cluster_limit clusters of vertices, smallest_area grows by this factor: a larger one
// takes fewer rounds and drops more. With 2 and 8 twelve poses and a cat with 69 handles keep their bits.
constexpr double area_growth = 4;
// Wished and largest number of clusters (pieces of level bands) that are no handles. The time of the dense solve grows
// with its cube. Bands get wider to reach the target, and the smallest clusters are dropped above the limit. On a
// machine with 39 handles half the target moves vertices by 0.07 of the box and presses edges to 0.34 instead of 0.36;
// double changes nothing there. With 69 handles on a cat half and double move vertices by 0.04 and 0.05 of the box.
// Half and double the limit change no bit of these.
constexpr std::int32_t free_cluster_target = 480, free_cluster_limit = 768;
// Room for the fields that count at a vertex at first. It trades memory for one more copy of the list. No result
// depends on it.
constexpr std::size_t slots_a_vertex = 3;
// A vertex drops its weights in clusters that are below this share of their norm. Halving or doubling it changes
// elastic energies by 0.2 %.
constexpr double weight_prune = 1e-3;

// ---- levels.cpp ----

// Largest gradient, per box diagonal. A larger one comes from a needle and not from the field. It is a guard: half and
// double change no bit of twelve poses, of which the anchor has angles of 0.0007 degrees.
constexpr double steepest_gradient = 1e9;
// A smaller step of a field over a triangle is rounding, as on a linked piece behind a handle, where the field is
// constant. Without this bound nearly all bands went there.
constexpr double least_step = 1e-9;
// Bins into which the values of a field are sorted, to space 10 to 64 bands: two for each of the most bands. More bins
// follow the field more closely and hold fewer triangles each. Half changes elastic energies of the benchmark by at
// most 0.13 % and edge stretches by at most 0.01; double changes only edge stretches of its planes, by 0.01.
constexpr int level_bins = 128;
// Bins to each side in the running mean that smooths the field's gradient over its values. 1 and 6 change elastic
// energies by 0.3 %.
constexpr int smoothed_bins = 3;
// The gradient of a handle's field counts as at least this share of its largest value. It limits how many bands fall on
// parts where the field is nearly constant. Halving or doubling it changes no energy or stretch in the benchmark.
constexpr double least_gradient = 1e-4;

// ---- crossfade.cpp, pose.cpp ----

// Way of a handle, in box diagonals, over which a surface that was kept in place goes over to the new pose. Shorter
// ways move it more a frame, longer ones keep handles off their targets for longer. In a drag of 0.005 a frame on four
// meshes no vertex moves by more than 0.0056. Half: 0.0074, double: 0.0052.
constexpr double crossfade_reach = 0.05;
// Box diagonals that a turn of one radian counts: the lever arm of a limb. More lets go sooner in a turn. In turns of
// 0.02 radians a frame no vertex moves by more than 0.0045. Half: 0.0040, double: 0.0076.
constexpr double crossfade_turn = 0.25;
// Iterations that settle the new pose before the difference is taken. Each takes as long as one of a frame. Half and
// double change the moves above by at most 0.0009, on a human whose pose settles slowly.
constexpr std::uint32_t crossfade_iterations = 20;

// ---- rigid_pieces.cpp ----

// How much of the fit of a rigid piece the vertices where links hold it decide; the rest is for its area. With 1 a
// piece that is held at a point could turn freely; with less it slides in the hand.
constexpr double rigid_hold_share = 0.9;

// ---- groups.cpp ----

// The vertices of a component form groups that share a rotation. Larger components get more groups, but each gets at
// least all wished groups divided by this number: less makes small pieces stiff, more leaves fewer groups to large
// ones. On a machine of 47 pieces half and double move vertices by 0.07 and 0.05 of the box. The shortest edges change
// by at most 0.02. The other eleven poses keep their bits.
constexpr std::int32_t least_group_share = 4;
// Size of a block of vertices. The search for the farthest vertex reads a block again when a distance in it has
// changed: smaller blocks are read less, larger ones are fewer. No result depends on it. The first frame of a torus of
// 102,400 vertices with 1,000 groups takes as long with half and double. With 32 it takes 8 % longer, with 2,048 it
// takes 2 % longer.
constexpr std::size_t farthest_block = 256;

// ---- blend.cpp, blend_blocks.cpp ----

// Vertices (6 KB) blended before they are packed: they are still in the first-level cache then, of 32 KB and more. Half
// and double change no bit of twelve poses.
constexpr std::int32_t packed_at_once = 256;
// Blocks of eight vertices in one thread's job; together they are vertex_piece vertices. Half and double change no bit
// of twelve poses.
constexpr std::int32_t blocks_at_once = 512;
// Eight vertices are blended as one block if a cluster that moves one of them moves this many on average. With fewer,
// most of a block's products are with weights of 0; with more, single vertices load each matrix again. Half and double
// change no bit of twelve poses.
constexpr std::int32_t block_sharing = 4;

// ---- dense.cpp ----

// A pivot of the poses' dense system below this share of its diagonal means that the unknown depends on earlier ones.
// Less lets rounding through, more drops clusters that could move. Half and double change no bit of twelve poses.
constexpr double pivot_floor = 1e-10;

// ---- proposals.cpp, trunk.cpp: shares of the box diagonal, where nothing else is said ----
//
// Halved and doubled one by one on 18 shared creatures (deform_proposed_test): 142 proposals, 68 of them feet, all
// right. Where a line names no figure, the list stays the same at half and at double.

// A flatter surface has no feet.
constexpr double least_tall = 0.05;
// Feet are at most this share of the height above the lowest vertex. Double finds a foot too many, half loses the
// ankles of a body whose shoes are pieces of their own.
constexpr double ground_share = 0.1;
// The surface rises by this share of the height from a foot on the way to another, so that toes are no feet.
constexpr double leg_share = 0.1;
// The least height of a component that is a foot by itself, a shoe for example, as a share of the height.
constexpr double shoe_share = 0.03;
// The depth of a sole, as a share of the height. The middle of the sole is the place. Double moves 7 of 70 places more
// than 3 % of the box away from the ends of joints.
constexpr double sole_share = 0.02;
// The radius of a foot, as a share of the size of its sole: the region goes beyond the sole.
constexpr double sole_margin = 1.2;
// Radii: of every proposal at least, of a foot and a tip at most. With tips twice as large one tip less fits.
constexpr double least_radius = 0.01, most_sole_radius = 0.06, most_tip_radius = 0.05;
// A limb is where the Poisson field is above this share of its fall from the tip; the rest is trunk. A hand pulled up
// by 0.25 of the box moves the highest vertex of six bipeds by at most 0.018, with feet alone by 0.06 to 0.17. Without
// shoulders in the trunk, 0.5 gives 0.023 and 0.7 gives 0.039.
constexpr double limb_share = 0.4;
// The least radius of the trunk, so that its region goes around. 0.05 holds the back of a slim body alone.
constexpr double least_trunk_radius = 0.08;
// The radius grows until the region has this share of the area of the trunk. Less stops at parts inside a body, as in a
// wolf and a robot; double is beyond most_radius in a horse.
constexpr double held_trunk_share = 0.1;
// A middle that is farther from the surface than this is in a ball or a ring; then a vertex replaces it.
constexpr double most_depth = 0.12;
// Added to heights as weights of a trunk. It decides in a flat one, whose heights differ by rounding alone.
constexpr double flat_trunk = 1e-6;
// The radius of a tip, as a share of its length.
constexpr double tip_share = 0.25;
// A tip lower than this share of the height may be a toe: less proposes toes, more takes low heads for toes. Half
// proposes 14 handles on a scorpion instead of 12; double changes none of three creatures.
constexpr double low_tip_share = 0.2;
// A low tip this near to a foot is the foot. Half proposes five toes more.
constexpr double foot_reach = 0.1;
// A smaller component gets no ends. Double drops the four ends of two pieces of a cow.
constexpr double least_piece = 0.1;
// An end joint this near to a proposal belongs to it; farther away from the surface it is a helper. Not counted above:
// the lists there are made without skeletons. A smaller reach proposes a limb twice, a larger one loses joints. Half
// and double give the tube of proposals_test the same list.
constexpr double joint_reach = 0.1;
// The radius of a joint, as a share of its distance from the surface: the region goes around the limb. Less leaves a
// rest of the limb out, more takes in its neighbours. Half and double give the tube of proposals_test the same list.
constexpr double around_joint = 1.3;
// Vertices: a smaller region of a coarse mesh grows, because one vertex holds no rotation. Double drops one tip.
constexpr std::size_t least_region = 6;
// How much follows a proposed handle that is dragged. A hand pulled up by a quarter of the box moves the head of 15
// bipeds that stand on their feet by at most 0.02 of it; with 1 by up to 0.43.
constexpr double tip_following = 0.25;
// Roles of at least this confidence count as known. Below it they are guesses.
constexpr double sure_roles = 0.5;
// A vertex belongs to a head, a hand or a foot that has more than this share of its weight. A larger share leaves out
// horns of smooth weights, a smaller share takes in the neck.
constexpr double part_share = 0.5;
// A trunk that rises by this cosine is upright: 53 degrees. Its hands do not stand.
constexpr double upright_trunk = 0.6;
// A part with a larger share of the surface is no head, hand or foot, but a body with one joint.
constexpr double most_part_share = 0.8;
// Edges between a head and the pinned trunk. With 0 a head without a neck tears off its body. With more a small trunk
// has no vertices left.
constexpr int free_rings = 2;
// A trunk whose head has no neck is pinned beyond this share of its length. Less draws the chest of kk_Knight out to a
// neck with teeth, as 0.5 does; half pins nearly all of it. More than 1 pins nothing.
constexpr double neckless_share = 0.7;
// Vertices: a smaller part is too coarse for a region of its own.
constexpr std::size_t least_part = 3;
// A radius grows or shrinks by this factor, up to most_radius and most_attempts times, until its region fits.
constexpr double radius_growth = 1.4, most_radius = 0.15;
constexpr int most_attempts = 12;

// ---- refine.cpp ----

// When a pose starts from an already deformed surface, each group of vertices gets its rotation there. The edges at up
// to this many of its vertices decide it: fewer take less time. Half moves the bent tube with a second layer by 2e-4 of
// its length; double changes no bit of twelve poses.
constexpr std::int32_t samples_per_group = 24;
// Several full-mesh steps go on in the direction of the steps before (Chebyshev's semi-iterative method, as in Wang
// 2015). It assumes that one step has the spectral radius 1 - refine_gap / steps: few steps must not overshoot, many
// may go far. Eight steps lower the energy over converged ARAP's from 2.06 to 1.18 (median of three scans). 64 steps
// lower it to 1.005. Eight without this constant lower it to 1.42. With half and double, eight steps end at 1.26 and
// 1.21.
constexpr double refine_gap = 0.4;
// Share of its last change that a correction takes again, when steps go on from the last frame (Nesterov 1983). More
// gets nearer to the minimum in a drag, but swings about it when handles stop. One step a frame at the end of a drag,
// on eight scans: the energy over converged ARAP's is 1.30 with 0, 1.17 with 0.6, and 1.12 with this and with 0.9.
constexpr double refine_momentum = 0.8;

// ---- rotation.cpp, rotation_batch.cpp ----

// Squared norms of quaternions outside this range are scaled first, by normalised_far(). A bound 1e30 times nearer to 1
// or farther off changes no bit of twelve poses.
constexpr double least_norm_square = 1e-200, largest_norm_square = 1e200;
// Squares of matrices within this range keep their digits. A bound 1e5 times nearer to 1 or farther off changes no bit
// of twelve poses.
constexpr double least_matrix_square = 1e-300, largest_matrix_square = 1e300;
// Squared. Below it, the rotation to stay near is orthogonal to all best rotations. It is above rounding, 1e-32. Half
// and double change no bit of twelve poses.
constexpr double least_near_share = 1e-20;
// The next four numbers decide how a drag continues beyond half a turn. At half and at twice each of them, 22 tests of
// drags and rotations pass alike (for the axis also at 1e-10 and 1e-3). No other figure was tried.
//
// Below this angle, in radians, the shortest turn is meant.
constexpr double principal_turn = 0.9 * 3.14159265358979323846;
// A smaller turn, in radians, has no axis.
constexpr double least_axis_angle = 1e-9;
// The old axis stays if the nearest turn is farther from the expected turn than the gap, and the step is shorter than
// the second number. Both are squared radians.
constexpr double farthest_gap2 = 1.0, longest_step2 = 2.25;
// Below this angle (radians) the first two terms of the sine's series are exact in double: the third is 1e-4^4 / 1920.
// Half and double change no bit of twelve poses.
constexpr double small_angle = 1e-4;
// Eigenvalues of a matrix with norm 1 that differ by less count as equal: their rounding error and a margin. Half and
// double change no bit of twelve poses.
constexpr double equal_eigenvalues = 1e-12;
// A Newton step maximises tr(R' S) over rotations R. Pivots of its Hessian above this share of the norm of S prove that
// the maximum is near. Less trusts steps that may leave it, more takes the slow way more often. Half and double change
// no bit of twelve poses.
constexpr double newton_floor = 1e-6;
// At most this many Newton steps find a rotation. Each step squares the error, so a start near the result needs four
// (rotation_test). Half moves twelve poses by 1e-13 of the box at most, double changes no bit.
constexpr int newton_steps = 6;
// Longest Newton step of a rotation (squared radians). A longer one leaves the range where the quadratic model predicts
// the maximum; after a shorter one the slow way is taken more often. Half and double move twelve poses by 1e-14 of the
// box.
constexpr double longest_newton_step = 1.0;
// Newton steps of a rotation end when one is shorter (squared radians). The remaining error is about as large as this
// number. Half and double move a tube in the paper's mode by 1e-7 of its length, the other poses by 1e-9.
constexpr double settled_newton_step = 1e-14;

// ---- skin.cpp, holds.cpp, rigid_pieces.cpp ----

// Guards a division: joints without extent have moments of 0. At 1e-200 and 0 a bent tube has the same skin.
constexpr double least_moment = 1e-300;
// Area of a vertex without area, as a share of the squared box, so that it still counts. It is a guard: half and double
// leave the skin of a bent tube the same.
constexpr double least_vertex_area = 1e-12;

}  // namespace hf_inner::deform

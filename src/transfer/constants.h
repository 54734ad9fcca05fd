// All chosen numbers of this folder, grouped by the file that uses them.
//
// "A box" means the diagonal of a mesh's bounding box, which is 1 in inner coordinates. The lines say what happened
// with half or twice the value. All figures come from the shared animals. The self error compares the motion of
// q_Horse, transferred to itself, with the original. It was 0.0090 boxes when most lines were written; with the slides
// of slack.cpp it is 0.0030. The foot error is how far feet end from their scaled paths. Edge stretch is the 95th
// percentile over all edges; it is 0.32 on a wolf and 0.35 on a deer.
//
// "The sample" is hf_transfer_table --half choosing --sample 4, 377 runs. Most lines were measured with a kernel width
// of 0.04 and without levers. There 8 frames spike. 89.4 % of the runs are calm: they accelerate at most 1.1 times as
// much as their source. The steps of 41 runs are more than 1.5 times as long. The gaps of 28 runs are more than 0.5 %
// of the box. The deepest sinks 0.0042 boxes. On their own model 22 of 33 clips are right: within 0.010 boxes in the
// mean and 0.025 at worst. The lines of levers.cpp and of the kernel width were measured with both. There 1 frame
// spikes and 95.0 % of the runs are calm.
//
// "Five runs" are first clips: horse on wolf, wolf on deer, horse on fox, tyrannosaur on velociraptor, cow on fox. The
// third has the dials stride 1.2, neck_follow 1 and tail_follow -0.5. "Falls" are six runs of the same models that
// fall, jump or gallop.
#pragma once
#include <cstddef>
#include <cstdint>

namespace hf_inner::transfer {

constexpr double degree = 3.14159265358979323846 / 180;
// A height above every real one, in boxes: a search for the lowest height starts from it.
constexpr double no_height = 1e300;

// --- options ---

// Clusters of a transfer: trades detail for time. At half the value the sample has 32 open runs and the same spikes. At
// twice the value it is 26 open runs and 10 spikes.
constexpr std::int32_t default_cluster_count = 80;
// Clusters for each pair, if that is more than the default. With 60 pairs, 80 clusters leave most pairs without a
// cluster near them: the space of the fields has a dimension for each pair. Ten pairs of a horse on a wolf have 80
// clusters at half and as it is, and 100 at twice the value. Then vertices move by up to 0.024 boxes, and edges stretch
// by 4.3 instead of 4.9 %.
constexpr std::int32_t clusters_per_pair = 5;
// Width of a cluster of vertices, as a distance of field values: trades local detail for smoothness. At twice the value
// 63 frames of the sample spike, instead of 1. On their own model 97 clips of the choosing half are right. At 0.04 it
// is 86, at 0.02 it is 99. Less changes nothing from eight pairs on (width_per_pair).
constexpr double default_kernel_width = 0.03;
// That width for each pair, if it is more than the default, and at most: fields of many regions change faster along the
// surface. Four transfers to another body, with 20 and 60 true pairs, have a mean error of 0.0040 boxes. Without it the
// error is 0.0046 and 0.0053. Double changes the error by 0.0001 at most. With half the upper bound it is 0.0042 and
// 0.0048.
constexpr double width_per_pair = 0.004, widest_default_kernel = 0.12;
// A limb turns to the source's rest direction by a share that grows with the angle between the two directions. It is
// half at this angle: less takes the target's own stance away, more leaves limbs that point elsewhere. On five runs
// half raises the foot error of a wolf from 4e-5 to 5e-3. At twice the value a tail 85 degrees off no longer turns: it
// moves by 0.15 of the box.
constexpr double default_alignment_angle = 40 * degree;
// The share is 0 up to the first part of the alignment angle and 1 from the second on. A narrow range jumps between two
// limbs that are nearly alike, a wide one turns limbs that should stay. On five runs half the first number raises the
// foot error of a wolf from 4e-5 to 1e-3; 1.2 moves vertices by up to 3e-4 boxes. With 1.05 as the second they move by
// 5e-4, with 2.1 by 0.013.
constexpr double align_from = 0.6, align_to = 1.4;
// At most this many clusters: bounds a dense matrix. For 512 clusters it takes 2 MB, and 22 million multiply-adds to
// factor.
constexpr std::uint32_t cluster_limit = 512;
// Refuses cluster widths that are a mistake. The fields of two vertices differ by at most 1.41. Below the lower bound,
// nearest_count alone decides the width.
constexpr double least_kernel_width = 0.005, most_kernel_width = 0.5;
// Refuses scales that are a mistake; no result depends on these bounds.
constexpr double least_scale = 1e-6, most_scale = 1e6;
// Trades exact edge lengths for exact paths of feet. At half the value the sample has 26 open runs, and edges of a wolf
// stretch by 0.34 (0.32 now). At twice the value feet end 1.3 times as far from their paths, and 75 instead of 74 runs
// slide.
constexpr double default_spread_share = 0.5;
// Trades shape for exact paths of anchors, the regions that follow their source. At half the value: feet end 1.8 times
// as far from their paths. At twice the value they end 0.6 times as far, and edges stretch the same. Both have 9 spikes
// in the sample.
constexpr double default_anchor_pull = 1;
// When no region follows its source's path, the body's centroid alone fixes its place. This is the weight of the
// centroid's goal. Halving or doubling it changes errors and edge stretches by at most 3 % and moves vertices by up to
// 0.004 boxes.
constexpr double root_alone = 1;
// Weight of the goal of the body's centroid when the trunk follows its source's path. It is small, because the trunk
// should decide the place. Halving or doubling it changes errors and edge stretches by at most 3 %.
constexpr double root_with_trunk = 1e-3;
// Weight of the goal of the body's centroid when only feet follow their source's paths. The edge stretch of a wolf
// without a trunk pair is 0.28. It is 0.26 at half the value, 0.30 at twice and 0.45 at ten times the value.
constexpr double root_without_trunk = 0.1;
// Weight that ties clusters of vertices to the motion of the whole body, if they overlap no other cluster. Halving or
// doubling it changes errors and edge stretches by at most 3 %.
constexpr double default_whole_pull = 1e-6;

// --- alignment.cpp ---

// Accepts body axes (right, up, forward) that the caller wrote with three digits; the code makes them orthonormal
// afterwards.
constexpr double axes_tolerance = 1e-3;
struct FieldWindow {
  double low, high;
};
// A leg is measured where the foot's field is between these values. If one window has no vertex, the next is used. With
// half the first window, feet end 1.2 times as far from their paths. With twice the first window, errors and edge
// stretches of a wolf change by at most 3 %.
constexpr FieldWindow leg_windows[] = {{0.4, 0.6}, {0.3, 0.7}, {0.2, 0.8}};
// A limb begins where its field is between these values; its direction starts there. Halving both changes errors and
// edge stretches by at most 3 %. At twice the values, limbs of the test models wolf and fox no longer turn to the
// source's rest direction.
constexpr FieldWindow limb_window = {0.4, 0.65};
// Two directions count as opposite if 1 + the cosine of their angle is smaller (within 0.08 degrees). Then their cross
// product gives no axis to turn about. Half and double move no vertex of five runs.
constexpr double opposite = 1e-6;
// Opposite directions turn about the x axis, or about y if their x coordinate is larger than this. Any value from 0.58
// to 1 works. It must only keep the axis away from the direction. On five runs 0.25 and 0.95 move no vertex.
constexpr double steep_share = 0.5;

// --- clusters.h, clusters.cpp ---

// Clusters (joints) that move a target vertex, one JOINTS set of glTF. With all weights instead of four, errors and
// edge stretches stay equal to four digits.
constexpr std::int32_t blend_count = 4;
// A kernel (Gaussian weight around a cluster's centre) becomes wide enough to have this many source vertices within one
// width. At half the value the sample has 9 spikes and steps of up to 3.8 times the source's (3.0 now). At twice the
// value it has 7, and 90.7 % of calm runs. But 30 runs open, and the largest mean on the own model is 0.031 boxes
// (0.024 now).
constexpr std::int32_t nearest_count = 6;
// A kernel (Gaussian weight around a cluster's centre) ends at this many widths from the centre. At half the value: the
// edge stretch of a wolf is 0.35 (0.32 now). Doubling it changes errors and edge stretches by at most 3 %.
constexpr double kernel_cut = 2.5;
// Each cluster has a narrow kernel (Gaussian weight of vertices) and a broad one, this many times as wide. At half the
// value: the edge stretch of a wolf is 0.33 (0.32 now). Doubling it changes errors and edge stretches by at most 3 %.
constexpr double broad_factor = 3;
// Cotangent weights of edges are clamped to this range. Halving or doubling the lower bound changes the error of a
// horse transferred to itself, and every edge stretch, by at most 3 %. Halving or doubling the upper bound moves no
// vertex by more than 1e-6 boxes.
constexpr double flattest_weight = 1e-3, steepest_weight = 50;
// At most this many source vertices give a cluster its rotation, in its narrow and its broad kernel; this bounds the
// time of a frame. With half as many in the narrow kernel, vertices move by at most 1e-4 boxes. Any other halving or
// doubling changes errors and edge stretches by at most 3 %.
constexpr std::size_t most_narrow = 1536, most_broad = 384;
// A new cluster's centre must be at least this share of the kernel width from all others. It only matters on tiny
// meshes. Halving or doubling it changes nothing.
constexpr double redundant_share = 0.25;
// A vertex's area counts as at least this share of the mean, so that every vertex has some weight. Halving or doubling
// it changes no vertex of any frame.
constexpr double least_area_share = 1e-6;

// --- gradients.cpp, matches.cpp, nearest_rows.cpp, warp.cpp ---

// The numbers of this group and the next hold for HF_TRANSFER_STRETCH alone. They were chosen on one pair of generated
// heads (tests/unit/transfer/stretch_test.cpp, 9,900 and 11,918 vertices). Other values were measured on five
// pairs of such heads, 52 shapes each, and on a horse's walk on a bull. The error is the error over all shapes, as a
// share of their motion: 0.18 to 0.22 now. Closed lids are 0.5 to 15 % of their opening apart.

// Weight of the fields of the pairs beside places in boxes, where points of two surfaces are matched: trades parts told
// apart for smooth matches. At half the value errors are 5 to 12 % smaller, at twice the value 11 to 23 % larger. With
// 0 they are 6 to 17 % smaller: these heads do not need the fields.
constexpr double match_field_weight = 0.1;
// A triangle with a smaller squared sine of its angle is matched along its edges only; guards a division. With 0 and
// 1e-6 no vertex moves.
constexpr double flat_triangle = 1e-12;
// How far a warp may miss its points, and the size of its affine part, in boxes: without the second a warp of less than
// four points has no solution. Half and double change errors by at most 0.6 % for the first, 0.01 % for the second.
constexpr double warp_ridge = 1e-3, affine_ridge = 1e-4;
// Samples of the target, and of its border, that a warp takes to the source. More samples match closer. The time of
// preparing grows with their cube. With 100 of the target, errors are 1 to 3 % smaller, and edges of the bull stretch 2
// % more. With 400 they are at most 2 % larger, and preparing takes at least 1.5 times as long. Half of the border's
// leaves closed lids up to 9 % farther apart; double changes errors by at most 0.3 %.
constexpr std::size_t warp_samples = 200, warp_border_samples = 100;
// Rounds of matching them. With 1 and 2 errors are up to 9 % smaller. With 8 they are up to 8 % larger.
constexpr std::int32_t warp_rounds = 4;
// A sample whose match lies farther away (in boxes) or faces another way is left out. Halving or doubling them changes
// no head. Edges of the bull stretch 1 % more with half the first, and 3 % more with twice the second.
constexpr double warp_reach = 0.1, warp_cosine = 0.3;
// A vertex of the target's border matches the source's border if that is at most this much farther in coordinates (in
// boxes) than the nearest point of the source. Else the source has no such border. Half, double and ten times the value
// change no vertex. At 0.01 errors change by at most 1 %.
constexpr double border_reach = 0.1;
// In a direction without an edge of the vertex, the gradient of the whole body counts, with this weight. At 1e-9 a
// source of twice the size is off by 1e-9. With a tenth and ten times the value, errors have the same five digits.
constexpr double least_edge_moment = 1e-12;
// An edge that is longer than its match by more than this, beyond the scale, does not take the match's own change. At
// half the value one pair's lids close 11 % better. Half and double change errors by at most 0.2 %.
constexpr double most_edge_ratio = 4;
// Rows in a leaf of the tree: trades nodes for compared rows. No result depends on it.
constexpr std::int32_t rows_in_leaf = 8;

// --- openings.cpp, gradient_openings.cpp ---

// Cosine of the largest angle between an outward direction and the place that faces it: 60 degrees. At 0.25 one pair's
// error is 0.39 instead of 0.20. At 0.8 most lids end 2 to 7 times as far apart. One pair's error is 69 at 0.8, and 36
// at 0.6. With 0.4 that pair's lids are 9 % apart instead of 15, and the others stay the same.
constexpr double facing_cosine = 0.5;
// An opening (in boxes) that is wider at rest is not held: lids and lips are narrower, sleeves and necks wider. At half
// the value four of five pairs have lids 2 to 30 times as far apart. At twice the value one pair's error is 0.52, and
// another's is 373. With 0.045 no vertex moves; with 0.08 one pair's error is 0.53.
constexpr double widest_opening = 0.06;
// How far the constraint of an opening gives way, as a share of its own compliance: trades closed lids for a smooth
// skin where constraints contradict each other. Without gaps across a border, closed lids are 1.4 % of the opening
// apart at 1e-5 and 2.0 % at 1e-2. Coarse lids are 36 % and 16 % apart. Now half and double change errors by at most 2
// %, and coarse lids are 17 and 12 % apart instead of 15.
constexpr double opening_give = 1e-3;
// At most this many constraints of openings; bounds the dense matrix. The five pairs have less: with 48 and 768 no
// vertex moves.
constexpr std::size_t most_openings = 384;
// Right-hand sides in one sweep of the factor: as channel_block of the engines.
constexpr std::int32_t opening_channels = 8;
// A gap (in boxes) below which its direction means nothing; guards a division. With 1e-12 and 1e-6 no vertex moves.
constexpr double least_gap = 1e-9;

// --- islands.cpp ---

// At most this many sweeps spread field values over a piece without a region (an eye, a strap). All numbers of this
// group were measured on six characters with 3 to 66 pieces. At half the value, field values change by at
// most 0.008. At twice the value they change by 0.006, in up to twice the time.
constexpr std::int32_t most_sweeps = 200;
// The sweeps over a piece without a region end when no field value changes by more. Halving or doubling it changes
// field values by 3e-6.
constexpr double still_enough = 1e-7;
// In a piece without a region that is smaller than this (in boxes), all vertices get the same field values. At half the
// value: they change by 0.009. At twice the value: by 0.045, in a quarter of the time on the model of a woman.
constexpr double rigid_island = 0.03;
// In a piece without a region, one vertex in three keeps the field values of the surface beside it. If all do, values
// jump twice as far across an edge. If one in six does, values end 1.2 times as far from the values of the surface.
constexpr std::size_t held_divisor = 3;
// At least this many vertices of a piece without a region keep the field values of the surface beside it: three points
// fix a piece in space. With one, field values change by 0.03. With six, by 0.16 on pieces of some ten vertices.
constexpr std::size_t least_held = 3;
// The mean number of points per cell of the grid that finds the nearest vertex: trades memory for visited points. No
// result depends on it.
constexpr double points_per_cell = 2;
// Bounds the grid that finds the nearest vertex to 64^3 cells (1 MB); no result depends on it.
constexpr std::int32_t most_cells = 64;
// Size of the grid that finds the nearest vertex, when all points coincide; guards a division. Half and double move no
// vertex of five runs.
constexpr double least_extent = 1e-12;
// An edge's weight counts as at least this share of the mean, also in translations.cpp. Halving or doubling it changes
// errors and edge stretches by at most 3 %. It changes field values of pieces without a region by at most 0.0014.
constexpr double least_weight_share = 1e-3;

// --- levers.cpp ---

// A cluster of the source counts as at least this wide (in boxes): coarse meshes have clusters of one vertex. With
// half, 98.7 instead of 98.4 % of the sample's runs accelerate at most 1.3 times as much as their source. With double,
// 94.4 instead of 95.0 % are calm. Then 3 runs instead of 1 move beside a still source.
constexpr double least_reach = 0.01;
// The length from a cluster of the source to the end of its limb counts as at least this (in boxes): it is nearly none
// at the end. At 0.1 tails of cows move more than twice as far as a deer's that stands still (10 instead of 3 runs of
// the choosing half).
constexpr double shortest_reach = 0.03;
// A limb's end counts as farther away on the target between these ratios, and a cluster at a limb's root as wider. If
// they are less, clusters of similar bodies count as longer parts, because their places differ a little. In the
// choosing half 95.1 % are calm. On generated bodies 8 to 60 true pairs have mean errors of 0.0044 to 0.0047 boxes.
// With 1.3 and 1.8 for both (and 0 below) this hardly changes. With 1.15 and 1.5 for both, the errors rise to 0.0049.
constexpr double ends_from = 1.15, ends_to = 1.5, wider_from = 1.3, wider_to = 1.8;
// The place of a cluster of a wider kernel is less certain. For each width of the default kernel beyond it, a limb's
// end counts as nearer by this share of the cluster's spread. At 0, 20 and 60 true pairs are worse (above). With 0.3 of
// the spread whatever the kernel, and ends between 1.2 and 1.6, 94.9 % are calm.
constexpr double ends_unsure = 0.5;
// A cluster hangs on one that overlaps it by this share of the smaller of the two: less finds ways over vertices that
// hardly belong to both. With a tenth, 93.6 instead of 95.0 % of the sample's runs are calm.
constexpr double least_hinge = 1e-3;

// --- refit.cpp ---

// Sharpness of the rotation that turns a cluster towards its neighbours (soft_rotation.h). The four rounds of turns are
// a contraction only where it is small: at 4, a sheep's legs jump between two states (6 spikes in one walk, 0 at 0.25).
constexpr double refit_sharpness = 0.25;
// How strongly a cluster keeps its source's rotation when it turns towards its neighbours. Half and double leave the
// counts of the sample as they are; means on themselves change by at most 1e-4 boxes.
constexpr double keep_rotation = 0.18;
// A cluster of vertices whose centre has a larger field value belongs to a region and keeps its rotation. With 0.45
// edges of a deer stretch by 0.39 (0.35 now). With 1 the sample has 29 spikes and steps of up to 7.5 times the
// source's.
constexpr double handle_share = 0.9;
// Mean squared extent of a cluster's overlaps (in squared boxes) below which they count as one point, which gives no
// rotation. Rounding leaves 1e-32, the test models have 9e-11 and more. Halving or doubling it changes no vertex.
constexpr double least_overlap_extent = 1e-12;

// --- slack.cpp ---

// The figures count clips of the choosing half of tests/bench/transfer_table.cpp that are right on their own model. A
// clip is right within 0.010 boxes in the mean and 0.025 at worst. Now all 116 are right, without slides 36. The
// largest mean is 0.0096.

// Added to the diagonal of the fit, as a share of it and of the mean: bounds translations of clusters that differ in
// few vertices. Ten times leaves 116 and 0.0094.
constexpr double fit_ridge = 1e-3;
// Two clusters with a smaller overlap on the source (as a share of the mean of a cluster with itself) count as without
// one: guards a division. At 1e-7 and 1e-3 the figures are the same.
constexpr double least_common = 1e-6;
// The edges of E_spread between two clusters have positive and negative weights. If their sum is a smaller share of the
// sum of their sizes, the slide of the overlap counts, or none. Half and double give the same figures.
constexpr double certain_tie = 0.1;
// How far from the middle of their overlap two clusters may turn, in distances of the clusters: trades exact joints for
// calm where parts do not correspond. Half gives 110 and 0.0135, double 116 and 0.0088. Double had two more spikes in
// 1,508 runs when it was chosen.
constexpr double most_offset = 6;

// --- soft_rotation.cpp ---

// Steps of the power that stands for an exponential, a power of two: trades exactness for a matrix product per
// doubling. On five runs half moves vertices by up to 3e-5 boxes, double by 2e-5.
constexpr int soft_steps = 64;
// Bounds the share that one step adds to the identity, over the size of the moment matrix: below 1 / sqrt(3) the power
// stays positive definite. Half of that bound leaves room. It only guards against large moments: on five runs a
// quarter, half and double move no vertex.
constexpr double most_soft_step = 0.28;

// --- source_rotations.cpp ---

// Sharpness of a cluster's own rotation (soft_rotation.h), and the weight of the rotation around it. They decide the
// twist of thin clusters: it follows the rotation around them where their own moments do not tell. On five runs half
// and double the sharpness move vertices by up to 0.005 and 3e-4 boxes, half and double the weight by 0.002 and 0.005.
// Half the weight brings the feet of a velociraptor a fifth nearer to their paths; double, or half the sharpness, takes
// them half as far again.
constexpr double narrow_sharpness = 4, narrow_prior = 0.02;
// Weight of the whole body's rotation when the rotation around a cluster is computed. Halving or doubling it changes
// errors and edge stretches by at most 3 %.
constexpr double broad_prior = 1e-3;
// At most this many vertices give the rotation of the whole body; this bounds its time. At half the value: vertices
// move by up to 0.003 boxes.
constexpr std::size_t most_sampled = 4096;

// --- thin_parts.cpp ---

// A surface is thin if it is less than this through, in boxes: more takes necks, less leaves antlers out. Half and
// double change no spike, depth or gap of 377 runs of tests/bench/transfer_table.cpp.
constexpr double thin_width = 0.04;
// Fields are constant where none changes by more than this over a box: more takes parts of thighs and muzzles, less
// only the tips of antlers. At 0.5, 544 instead of 328 of the 1,560 vertices of a cow's head may sink. Half and double
// change no spike, depth or gap of these runs.
constexpr double idle_slope = 0.2;

// --- transfer.cpp ---

// A shorter limb (in boxes) has no reliable direction, so it does not turn to the source's. Halving it changes no
// frame. At twice the value, the limbs of the test models wolf, fox and Knight no longer turn.
constexpr double shortest_limb = 0.1;
// A limb's turn to the source's rest direction starts at the first field value and grows over the second. Halving the
// start moves vertices by up to 0.08 boxes, doubling it by 0.21. For the width it is 0.04 and 0.06.
constexpr double fade_from = 0.35, fade_width = 0.2;
// Shorter legs (in boxes) give no scale between the bodies; guards a division. Half and double move no vertex of five
// runs.
constexpr double least_leg = 1e-6;
// A region nearer to the body's middle plane (in boxes) is neither left nor right: less tells tails apart that are only
// bent, more takes narrow legs for one side. It is the radius of a default region. Half and double change no vertex of
// five runs and six falls.
constexpr double least_side = 0.03;
// A cluster's rotation counts as certain if it comes from this many source vertices: as many as its kernel must cover.
// It is reported and moves no vertex.
constexpr std::int32_t enough_support = nearest_count;
// A cluster (vertices with a common motion) belongs to a region if it has at least this share of the region's weight.
// Halving or doubling it changes no vertex of any frame.
constexpr double region_cluster_share = 0.05;
// A vertex that sinks below the ground is raised with a region if its weight in the region's clusters is larger. At
// half the value: vertices move by up to 0.008 boxes. If no vertex does, a deer sinks 0.004 boxes into the ground.
constexpr double region_vertex_share = 0.75;
// Vertices of one thread's job. Half and double of all such sizes of this file change the frames per second by at most
// 4 % (10,000 vertices, two threads).
constexpr std::size_t owner_block = 256;

// --- transfer_dials.cpp ---

// The range of each dial. Beyond these a dial is a mistake, such as degrees for radians; no result depends on them.
constexpr double least_stride = 0.1, most_stride = 4;
constexpr double most_hip_height = 0.5;
constexpr double most_follow = 1;
constexpr double most_arm_space = 90 * degree;
// A limb that a dial turns begins at the first field value and turns fully after the second. The field of a nose is 0.1
// where a horse's neck leaves its chest and 0.3 in the middle of the neck, so a neck turns as a whole. The limits of
// rest alignment would turn the head alone. On a horse's neck and tail on a fox, half and double the first number move
// vertices by up to 0.016 and 0.013 boxes, half and double the second by 0.012.
constexpr double root_from = 0.1, root_width = 0.2;
// The rest direction of such a limb starts at the vertices with these field values, around its root. On the same run
// half moves vertices by up to 0.005 boxes, double by 0.06, and edges stretch by 2.4 % instead of 1.6 %.
constexpr FieldWindow root_window = {0.08, 0.2};

// --- transfer_frame.cpp ---

// Distance from rigid motion (in boxes) at which a frame counts as half rigid. Trades exact copies of noisy rigid
// motion for a calm ground: an idle body breathes by 1e-4 to 1e-3, and a share that changes with its breath makes it
// flicker. In 52 idle clips of and on a dinosaur, acceleration is up to 1.6 times the source's. It is 10.9 times at
// 1e-4 and 5.1 times at 1e-3. Then 7 and 12 clips sink by more than 0.01 boxes (4 now).
constexpr double rigid_residual = 1e-5;
// Between these angles a body counts as fallen over by a share from 0 to 1. A narrow range moves the feet of a body
// that falls fast. The 130 falls of the choosing half of tests/bench/transfer_table.cpp have 7 spikes and accelerate at
// most 1.29 times as much as their source. With 50 as the second it is 20 and 1.93. With 140 it is 6 and 1.24. A body
// that turned had the same range then.
constexpr double fall_low = 20 * degree, fall_high = 110 * degree;
// Up to this angle of the body a foot falls as far as it tips itself. So a body may lean over planted feet. From
// fall_high on, a foot falls with the body. In the judging half of tests/bench/transfer_table.cpp no planted foot
// slides, 9 runs are restless and 44 frames spike. With 40 degrees it is 19, 8 and 45. Without the rule it is 0, 26 and
// 58.
constexpr double lean_high = 60 * degree;
// Between these angles a body, or a foot, counts as turned about the vertical by a share from 0 to 1. With a narrow
// range, bodies that turn fast swing out. With a wide range, bodies that turned around stay half behind. In the runs of
// the choosing half of tests/bench/transfer_table.cpp 23 frames spike and 270 feet slide. With 50 as the second it is
// 36 and 277. With 0 and 180, a body turned by 90 degrees is 0.03 to 0.05 boxes beside its feet.
constexpr double turn_low = 20 * degree, turn_high = 90 * degree;
// The turn of a foot about the vertical counts by a share from 0 to 1. The share rises between these squared lengths of
// the quaternion of that turn. A foot that is turned over has no such turn. A narrow range would make it jump when it
// turns over. Half and double of both move no vertex of five runs and six falls.
constexpr double twist_low = 0.05, twist_high = 0.3;
// A foot higher than this (in boxes) does not turn its own offset; between `stands` and this height it does by a share.
// A foot that kicks or is drawn up points anywhere, and the offset is long if one body is. In the runs of the choosing
// half of tests/bench/transfer_table.cpp, without the slides of slack.cpp, 51 frames spike, and 57 without this rule.
// With half, 14 instead of 13 frames of 377 runs spike; with double, 13.
constexpr double turns_freely = 0.2;
// Rounds that turn clusters towards their neighbours; each places all clusters once. Half and double leave the counts
// of the sample as they are, and its largest gap changes by 1e-4 boxes.
constexpr std::int32_t refit_rounds = 4;
// Vertices of one thread's job; the figures of owner_block hold.
constexpr std::size_t vertex_block = 2048;

// --- transfer_ground.cpp ---

// Heights of a foot (in boxes) below which it stands, and above which it is free. Halving or doubling the first changes
// errors and edge stretches by at most 3 %. With half the second, feet end 1.2 times as far from their paths. With
// twice the second, vertices are 0.002 boxes deeper under the ground.
constexpr double stands = 0.01, flies = 0.05;
// A region flagged as a contact touches the ground below the first share of its rest height, and is free above the
// second. In 377 runs of tests/bench/transfer_table.cpp, 12 frames of 8 runs spike. With 0.45 as the second share it is
// 14 frames of 10 runs. With 0.05 and 0.7 it is the same.
constexpr double touches = 0.1, leaves = 0.9;
// Shares of the surface that touch the ground when a body begins to lie, and when it lies fully. On 35 falls, 86 % are
// calm; with half of both shares 74 % (at a rigid_residual of 1e-3).
constexpr double lies_low = 0.02, lies_high = 0.5;
// Depth (in boxes) that a surface may sink into the ground. Vertices are exactly that deep. At half the value they sink
// by 5e-5, at twice the value by 2e-4.
constexpr double least_depth = 1e-4;
// A constraint of a frame (hold) that is met to a smaller share is left out; guards a division by the share. Halving or
// doubling it changes no frame.
constexpr double least_hold = 1e-6;
// A frame with a smaller share of non-rigid motion is not lifted above the ground. Halving or doubling it changes no
// frame.
constexpr double least_share = 1e-3;
// Sweeps that raise what sinks. In 377 runs of tests/bench/transfer_table.cpp, half and twice as many give the same
// figures: 14 frames spike, 2 runs sink by more than 0.01 boxes.
constexpr std::int32_t rise_sweeps = 8;
// The weights of a vertex are floats that sum to 1. No sum is larger than this, whatever was rounded: it only saves the
// look at blocks that cannot sink. Double moves no vertex of five runs and six falls.
constexpr double weight_sum_limit = 1.001;
// Vertices that are tested together for one that must rise; the figures of owner_block hold.
constexpr std::size_t rise_block = 64;
// How far a held region moves when the surface around it must rise, as a share of its move without a hold. Ten times
// the value changes no figure of these runs.
constexpr double held_give = 0.1;

// --- translations.cpp ---

// This share of the diagonal is added to it, so that two constraints on the same place can be solved. Halving or
// doubling it changes errors and edge stretches by at most 3 %.
constexpr double hold_ridge = 1e-9;
// Keeps the square root of a failed Cholesky pivot positive. Half and double move no vertex of five runs.
constexpr double least_pivot = 1e-300;

}  // namespace hf_inner::transfer

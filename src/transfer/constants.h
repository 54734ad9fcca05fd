// Every chosen number of this room, grouped by the file that uses it.
//
// A box is the diagonal of a mesh's bounding box, 1 in inner coordinates. "Half" and "double" tell what changing the
// number did: "self" is the error of q_Horse on itself (0.0090 boxes), "feet" how far feet are off their scaled paths,
// "stretch" the 95th percentile of edges (wolf 0.32, deer 0.35), "same" figures within 3 %. All on the shared animals.
#pragma once
#include <cstddef>
#include <cstdint>

namespace hf_inner {

constexpr double degree = 3.14159265358979323846 / 180;
// Above every height: starts a search for the lowest one.
constexpr double no_height = 1e300;

// --- options (transfer.h, clusters.h, translations.h) ---
// Detail against cost. Half: self 0.0095, a standing foot slides 0.025. Double: self 0.0082, surfaces sink 0.004.
constexpr std::int32_t default_cluster_count = 80;
// Local detail against smoothness. Half: self 0.0080, stretch of the deer 0.45. Double: self 0.0099, feet twice as far.
constexpr double default_kernel_width = 0.04;
// Rest directions that differ more are aligned. Half: wolf's legs too, feet 8 times as far. Double: not Knight's hands.
constexpr double default_alignment_angle = 40 * degree;
// Bounds the dense matrix of the translations: 512 clusters take 2 MB and 22 million multiply-adds to factor.
constexpr std::uint32_t cluster_limit = 512;
// Refuses mistakes: rows of the fields lie at most 1.41 apart, and nearest_count decides below the lower bound.
constexpr double least_kernel_width = 0.005, most_kernel_width = 0.5;
// Refuses ratios that are a mistake; no result depends on them.
constexpr double least_scale = 1e-6, most_scale = 1e6;
// Edge lengths against paths of feet. Half: stretch of the wolf 0.34. Double: feet 1.3 times as far.
constexpr double default_spread_share = 0.5;
// Paths of anchors against shape. Half: feet 1.8 times as far. Double: 0.6 times, stretch the same.
constexpr double default_anchor_pull = 1;
// The centroid, when no region is anchored: it alone fixes the place. Half and double: same, vertices within 0.004.
constexpr double root_alone = 1;
// The centroid beside an anchored trunk, which must win. Half and double: same.
constexpr double root_with_trunk = 1e-3;
// The centroid beside feet alone. Wolf without a trunk, half: stretch 0.26 for 0.28. Double: 0.30. Tenfold: 0.45.
constexpr double root_without_trunk = 0.1;
// Ties clusters that overlap nothing to the motion of the whole. Half and double: same.
constexpr double default_whole_pull = 1e-6;

// --- alignment.cpp ---
// Accepts axes that were written with three digits; they are made orthonormal afterwards.
constexpr double axes_tolerance = 1e-3;
struct FieldWindow {
  double low, high;
};
// Fields of a leg; the next window where one is empty. First, half: feet 1.2 times as far; double: same on the wolf.
constexpr FieldWindow leg_windows[] = {{0.4, 0.6}, {0.3, 0.7}, {0.2, 0.8}};
// Where a limb begins. Half: same. Double: limbs of wolf and fox are no longer aligned.
constexpr FieldWindow limb_window = {0.4, 0.65};
// Directions within 0.08 degrees of opposite have no cross product to turn about.
constexpr double opposite = 1e-6;

// --- clusters.h, clusters.cpp ---
// Clusters per target vertex: one JOINTS set of glTF; all weights instead of four change nothing to four digits.
constexpr std::int32_t blend_count = 4;
// Source vertices in one width of a kernel. Half: stretch of the wolf 0.33. Double: self 0.0096, without anchors +14 %.
constexpr std::int32_t nearest_count = 6;
// Kernels end at so many widths. Half: stretch of the wolf 0.35. Double: same.
constexpr double kernel_cut = 2.5;
// Width of the broad kernel over the narrow one. Half: stretch of the wolf 0.33. Double: same.
constexpr double broad_factor = 3;
// Cotangent weights are clamped to these. Half and double: same; the upper one moves no vertex by more than 1e-6.
constexpr double flattest_weight = 1e-3, steepest_weight = 50;
// Bound the cost of a cluster and frame by thinning kernels. Half: at most 1e-4 (narrow), same (broad). Double: same.
constexpr std::size_t most_narrow = 1536, most_broad = 384;
// Centres nearer than this share of the width are not added. Half and double: nothing; for tiny meshes.
constexpr double redundant_share = 0.25;
// Paper mode. Half: self 0.018 for 0.021, feet twice as far. Double: self 0.031, feet a sixth.
constexpr std::int32_t default_bands = 8;
// A hat function needs two bands; the upper bound keeps the dense matrix small.
constexpr std::int32_t least_paper_bands = 2, most_paper_bands = 64;
// Paper mode: shrinks clusters to their handle. Half: self 0.024 for 0.021. Double: 0.020, feet 1.1 times as far.
constexpr double band_exponent = 4;
// Paper mode: half the width of the broad kernel, in bands. Half and double: same, vertices within 0.005.
constexpr double broad_bands = 3;
// Paper mode: keeps vertices of field 0 in the broad kernel. Half and double: at most 2e-6.
constexpr double broad_band_floor = 1e-6;
// 2^24, the significand of a float: weights that are multiples of its inverse sum to 1 exactly.
constexpr double weight_units = 16777216.0;
// Least area of a vertex, in means: no vertex is without weight. Half and double: nothing.
constexpr double least_area_share = 1e-6;

// --- islands.cpp (figures of six shared characters with 3 to 66 pieces) ---
// Bounds the relaxation. Half: rows differ by 0.008 at most. Double: by 0.006, up to twice the time.
constexpr std::int32_t most_sweeps = 200;
// Ends the relaxation. Half and double: rows differ by 3e-6.
constexpr double still_enough = 1e-7;
// Pieces below this box get one row. Half: rows differ by 0.009. Double: by 0.045, a quarter of the time on a woman.
constexpr double rigid_island = 0.03;
// Held: a third of a piece. All: rows jump twice as far over an edge. A sixth: rows 1.2 times as far from their place.
constexpr std::size_t held_divisor = 3;
// Three points fix a piece in space. One: rows differ by 0.03. Six: by 0.16 on pieces of some ten vertices.
constexpr std::size_t least_held = 3;
// Memory of the search grid against vertices looked at; no result depends on it.
constexpr double points_per_cell = 2;
// Bounds the grid at 64^3 cells, 1 MB; no result depends on it.
constexpr std::int32_t most_cells = 64;
// Width of the cells when all points are at one place.
constexpr double least_extent = 1e-12;
// Least weight of an edge, in means, also in translations.cpp. Half and double: same; rows of pieces within 0.0014.
constexpr double least_weight_share = 1e-3;

// --- refit.cpp ---
// The source's rotation against neighbours' places. Half: self 0.0095. Double: self 0.0085, stretch of the wolf 0.34.
constexpr double keep_rotation = 0.18;
// Centres above belong to a handle and keep their rotation. 0.45: stretch of the deer 0.39. 1: a foot slides 0.014.
constexpr double handle_share = 0.9;

// --- source_rotations.cpp ---
// Spreads of the cluster that the broad rotation weighs: decides the twist of thin clusters. Half and double: same.
constexpr double narrow_prior = 0.02;
// The same of the whole's rotation in a broad cluster. Half and double: same.
constexpr double broad_prior = 1e-3;
// Vertices for the rotation of the whole, to bound its cost. Half: vertices within 0.003.
constexpr std::size_t most_sampled = 4096;

// --- transfer.cpp ---
// Boxes: shorter limbs have no reliable direction. Half: nothing. Double: wolf, fox and Knight are not aligned (0.3).
constexpr double shortest_limb = 0.1;
// Where an alignment fades in. Half and double: vertices within 0.08 and 0.21 (start), 0.04 and 0.06 (width).
constexpr double fade_from = 0.35, fade_width = 0.2;
// Boxes: shorter legs give no scale; guards a division.
constexpr double least_leg = 1e-6;
// Boxes: nearer to the middle a region is neither left nor right. The radius of a default region.
constexpr double least_side = 0.03;
// Source vertices of a cluster to count as confident: those its kernel reaches.
constexpr std::int32_t enough_support = nearest_count;
// Share of a region from which a cluster is one of its own. Half and double: nothing.
constexpr double region_cluster_share = 0.05;
// Share of a vertex in such clusters to move with the region. Half: within 0.008. Never: the deer sinks 0.004.
constexpr double region_vertex_share = 0.75;
// Vertices of one job; no result depends on it.
constexpr std::size_t owner_block = 256;

// --- transfer_frame.cpp ---
// Boxes of residual at which a frame is half a rigid motion. Half and double: same.
constexpr double rigid_residual = 1e-3;
// A fall is smooth between them: step over the source's 1.14; low 40 or high 25: 1.5; high 100: 1.35.
constexpr double turn_low = 20 * degree, turn_high = 50 * degree;
// Rounds of turning clusters. Half: self 0.0086. Double: 0.0094. All else the same; each is a solve of all clusters.
constexpr std::int32_t refit_rounds = 4;
// Vertices of one job; no result depends on it.
constexpr std::size_t vertex_block = 2048;

// --- transfer_ground.cpp ---
// Boxes of a foot over the ground. First, half, double: same. Second, half: feet 1.2 times as far; double: sinks 0.002.
constexpr double stands = 0.01, flies = 0.05;
// Rest heights of a contact. The deer's largest step, 0.026: half, double 0.022, 0.040 (first), 0.033, 0.035 (second).
constexpr double touches = 0.1, leaves = 0.45;
// Share of the surface that touches, from standing to lying. Half and double: within 0.04, accelerations 8 %.
constexpr double lies_low = 0.01, lies_high = 0.06;
// Boxes: how deep a surface may sink, which is how deep it does. Half: 5e-5. Double: 2e-4.
constexpr double least_depth = 1e-4;
// Weaker holds are left out: guards a division by the share. Half and double: nothing.
constexpr double least_hold = 1e-6;
// Share of a hold that lifts what sinks: nearer to 1 needs fewer rounds. Half: the Knight sinks 9e-5 for 1e-5.
constexpr double sunk_hold = 0.98;
// Holds below this share of sunk_hold are replaced, not raised. Half and double: within 9e-4.
constexpr double weak_hold = 0.5;
// Frames nearer than this to a rigid motion are not lifted. Half and double: nothing.
constexpr double least_share = 1e-3;
// Rounds of lifting what still sinks. Half: surfaces sink 0.0007 instead of 0.0001. Double: same.
constexpr std::int32_t sunk_rounds = 8;
// Rounds in which clusters turn as well. Half: stretch of a cow 0.204 for 0.211. Double: same.
constexpr std::int32_t turning_rounds = 3;

// --- translations.cpp ---
// Single vertices that can be held in one frame: bounds the Gram matrix and the cost of a frame in which much sinks.
constexpr std::size_t vertex_rows = 24;
// Relative to the diagonal: two holds of one place stay solvable. Half and double: same.
constexpr double hold_ridge = 1e-9;
// Keeps the square root of a failed pivot positive.
constexpr double least_pivot = 1e-300;

}  // namespace hf_inner

// All chosen numbers of this folder, grouped by the file that uses them.
//
// "Box" means the diagonal of a mesh's bounding box, which is 1 in inner coordinates. The lines say what happened with
// half or twice the value. All figures come from the animals in ../shared. The self error compares the motion of
// q_Horse, transferred to itself, with the original: it is 0.0090 boxes. The foot error is how far feet end from their
// scaled paths. Edge stretch is the 95th percentile over all edges; it is 0.32 on a wolf and 0.35 on a deer.
#pragma once
#include <cstddef>
#include <cstdint>

namespace hf_inner {

constexpr double degree = 3.14159265358979323846 / 180;
// A height above every real one: a search for the lowest height starts from it.
constexpr double no_height = 1e300;

// --- options ---

// Trades detail for time. At half the value: the error of a horse transferred to itself is 0.0095 (0.0090 now), and a
// standing foot slides by 0.025 boxes. At twice the value: that error is 0.0082, but surfaces sink 0.004 boxes into the
// ground.
constexpr std::int32_t default_cluster_count = 80;
// Trades local detail for smoothness. At half the value: the error of a horse transferred to itself is 0.0080 (0.0090
// now), and the edge stretch of a deer 0.45 (0.35 now). At twice the value: that error is 0.0099, and feet end twice as
// far from their paths.
constexpr double default_kernel_width = 0.04;
// Limbs are aligned if their rest directions differ by more. At half the value: the legs of a wolf are aligned too, and
// its feet end 8 times as far from their paths. At twice the value: the hands of the test model Knight are no longer
// aligned.
constexpr double default_alignment_angle = 40 * degree;
// Bounds the dense matrix of the translations. For 512 clusters it takes 2 MB, and 22 million multiply-adds to factor.
constexpr std::uint32_t cluster_limit = 512;
// Refuses widths that are a mistake. Two field rows differ by at most 1.41, and below the lower bound nearest_count
// decides alone.
constexpr double least_kernel_width = 0.005, most_kernel_width = 0.5;
// Refuses scales that are a mistake; no result depends on these bounds.
constexpr double least_scale = 1e-6, most_scale = 1e6;
// Trades exact edge lengths for exact paths of feet. At half the value: the edge stretch of a wolf is 0.34 (0.32 now).
// At twice the value: feet end 1.3 times as far from their paths.
constexpr double default_spread_share = 0.5;
// Trades exact paths of anchors for shape. At half the value: feet end 1.8 times as far from their paths. At twice the
// value they end 0.6 times as far, and edges stretch the same.
constexpr double default_anchor_pull = 1;
// Weight of the centroid when no region is anchored; it alone then fixes the place. Halving or doubling it changes
// results by at most 3 % and moves vertices by up to 0.004 boxes.
constexpr double root_alone = 1;
// Weight of the centroid beside an anchored trunk. It is small, because the trunk should decide the place. Halving or
// doubling it changes results by at most 3 %.
constexpr double root_with_trunk = 1e-3;
// Weight of the centroid when only feet are anchored. The edge stretch of a wolf without a trunk pair is 0.28. It is
// 0.26 at half the value, 0.30 at twice and 0.45 at ten times the value.
constexpr double root_without_trunk = 0.1;
// Ties clusters that overlap no other cluster to the motion of the whole body. Halving or doubling it changes results
// by at most 3 %.
constexpr double default_whole_pull = 1e-6;

// --- alignment.cpp ---

// Accepts axes that the caller wrote with three digits; the code makes them orthonormal afterwards.
constexpr double axes_tolerance = 1e-3;
struct FieldWindow {
  double low, high;
};
// Field values between which a leg is measured; if no vertex lies in one window, the next is used. With half the first
// window, feet end 1.2 times as far from their paths. With twice the first window, results of a wolf change by at most
// 3 %.
constexpr FieldWindow leg_windows[] = {{0.4, 0.6}, {0.3, 0.7}, {0.2, 0.8}};
// Field values at which a limb begins. Halving it changes results by at most 3 %. At twice the value: limbs of the test
// models wolf and fox are no longer aligned.
constexpr FieldWindow limb_window = {0.4, 0.65};
// Two directions count as opposite if 1 + the cosine of their angle is smaller (within 0.08 degrees). Then their cross
// product gives no axis to turn about.
constexpr double opposite = 1e-6;

// --- clusters.h, clusters.cpp ---

// Clusters per target vertex, one JOINTS set of glTF. Using all weights instead of four changes no figure to four
// digits.
constexpr std::int32_t blend_count = 4;
// A kernel is made wide enough to have this many source vertices within one width. At half the value: the edge stretch
// of a wolf is 0.33 (0.32 now). At twice the value: the error of a horse transferred to itself is 0.0096 (0.0090 now);
// without anchors it grows by 14 %.
constexpr std::int32_t nearest_count = 6;
// A kernel ends at this many widths from its centre. At half the value: the edge stretch of a wolf is 0.35 (0.32 now).
// Doubling it changes results by at most 3 %.
constexpr double kernel_cut = 2.5;
// How many times wider the broad kernel is than the narrow one. At half the value: the edge stretch of a wolf is 0.33
// (0.32 now). Doubling it changes results by at most 3 %.
constexpr double broad_factor = 3;
// Cotangent weights are clamped to this range. Halving or doubling it changes results by at most 3 %. The upper bound
// moves no vertex by more than 1e-6.
constexpr double flattest_weight = 1e-3, steepest_weight = 50;
// Largest kernels; longer ones are thinned to bound the time of a frame. At half the value: vertices move by at most
// 1e-4 for the narrow kernel, and results change by at most 3 % for the broad one. At twice the value results change by
// at most 3 %.
constexpr std::size_t most_narrow = 1536, most_broad = 384;
// A new centre must be at least this share of the kernel width from all others. It only matters on tiny meshes. Halving
// or doubling it changes nothing.
constexpr double redundant_share = 0.25;
// Bands per field in paper mode. At half the value: the error of a horse transferred to itself is 0.018 (0.021 now),
// feet end twice as far from their paths. At twice the value: the error is 0.031, feet a sixth as far.
constexpr std::int32_t default_bands = 8;
// A hat function needs two bands; the upper bound keeps the dense matrix small.
constexpr std::int32_t least_paper_bands = 2, most_paper_bands = 64;
// Power that shrinks the clusters of paper mode towards their handle. At half the value: the error of a horse
// transferred to itself is 0.024 (0.021 now). At twice the value: 0.020, but feet end 1.1 times as far from their
// paths.
constexpr double band_exponent = 4;
// Half the width of the broad kernel in paper mode, in bands. Halving or doubling it changes results by at most 3 % and
// moves vertices by up to 0.005 boxes.
constexpr double broad_bands = 3;
// Weight in paper mode that keeps vertices of field 0 in the broad kernel. Halving or doubling it moves vertices by at
// most 2e-6.
constexpr double broad_band_floor = 1e-6;
// 2^24, the significand of a float: weights that are multiples of its inverse sum to 1 exactly.
constexpr double weight_units = 16777216.0;
// Least area of a vertex as a share of the mean, so that every vertex has some weight. Halving or doubling it changes
// nothing.
constexpr double least_area_share = 1e-6;

// --- islands.cpp ---

// Most sweeps of the relaxation, a bound on its time. A row is the field values of one vertex. All numbers of this file
// were measured on six characters of ../shared with 3 to 66 pieces. At half the value, rows change by at most 0.008. At
// twice the value they change by 0.006, in up to twice the time.
constexpr std::int32_t most_sweeps = 200;
// The relaxation ends when no value changes by more. Halving or doubling it changes rows by 3e-6.
constexpr double still_enough = 1e-7;
// A piece smaller than this (in boxes) gets one row for all vertices. At half the value: rows change by 0.009. At twice
// the value: by 0.045, in a quarter of the time on a woman.
constexpr double rigid_island = 0.03;
// One vertex in three of a piece keeps its host's row. If all do, rows jump twice as far across an edge. If one in six
// does, rows end 1.2 times as far from their hosts'.
constexpr std::size_t held_divisor = 3;
// Least number of such vertices: three points fix a piece in space. With one, rows change by 0.03. With six, by 0.16 on
// pieces of some ten vertices.
constexpr std::size_t least_held = 3;
// The mean number of points per cell of the search grid: trades memory for visited points. No result depends on it.
constexpr double points_per_cell = 2;
// Bounds the grid to 64^3 cells (1 MB); no result depends on it.
constexpr std::int32_t most_cells = 64;
// Size of the grid when all points coincide; guards a division.
constexpr double least_extent = 1e-12;
// Least weight of an edge as a share of the mean, also in translations.cpp. Halving or doubling it changes results by
// at most 3 %, and rows of pieces by at most 0.0014.
constexpr double least_weight_share = 1e-3;

// --- refit.cpp ---

// Trades the source's rotation for matching the neighbours' places. At half the value: the error of a horse transferred
// to itself is 0.0095 (0.0090 now). At twice the value: 0.0085, but the edge stretch of a wolf is 0.34 (0.32 now).
constexpr double keep_rotation = 0.18;
// A cluster whose centre has a larger field value belongs to a handle and keeps its rotation. With 0.45: the edge
// stretch of a deer is 0.39 (0.35 now). With 1: a standing foot slides by 0.014 boxes.
constexpr double handle_share = 0.9;

// --- source_rotations.cpp ---

// Weight of the broad kernel's rotation in the narrow one. It decides the twist of thin clusters. Halving or doubling
// it changes results by at most 3 %.
constexpr double narrow_prior = 0.02;
// Weight of the whole body's rotation in the broad kernel. Halving or doubling it changes results by at most 3 %.
constexpr double broad_prior = 1e-3;
// Most vertices used for the rotation of the whole body, a bound on its time. At half the value: vertices move by up to
// 0.003 boxes.
constexpr std::size_t most_sampled = 4096;

// --- transfer.cpp ---

// A shorter limb (in boxes) has no reliable direction. Halving it changes nothing. At twice the value: the test models
// wolf, fox and Knight, whose limbs measure 0.3, are not aligned.
constexpr double shortest_limb = 0.1;
// Field values at which the alignment of a limb starts, and over which it grows. Halving and doubling the start moves
// vertices by up to 0.08 and 0.21 boxes. For the width it is 0.04 and 0.06.
constexpr double fade_from = 0.35, fade_width = 0.2;
// Shorter legs (in boxes) give no scale; guards a division.
constexpr double least_leg = 1e-6;
// A region nearer to the middle plane (in boxes) is neither left nor right. It equals the radius of a default region.
constexpr double least_side = 0.03;
// Source vertices that a cluster needs to count as confident: as many as its kernel must cover.
constexpr std::int32_t enough_support = nearest_count;
// A cluster belongs to a region if it has at least this share of the region's weight. Halving or doubling it changes
// nothing.
constexpr double region_cluster_share = 0.05;
// A vertex moves with a region if its weight in the region's clusters is larger. At half the value: vertices move by up
// to 0.008 boxes. If no vertex does, a deer sinks 0.004 boxes into the ground.
constexpr double region_vertex_share = 0.75;
// Vertices of one job; no result depends on it.
constexpr std::size_t owner_block = 256;

// --- transfer_frame.cpp ---

// Distance from rigid motion (in boxes) at which a frame counts as half rigid. Halving or doubling it changes results
// by at most 3 %.
constexpr double rigid_residual = 1e-3;
// Between these angles the share of a turn or fall grows from 0 to 1. The largest step in a fall is now 1.14 times the
// source's. It is 1.5 times with low 40 or high 25, and 1.35 times with high 100.
constexpr double turn_low = 20 * degree, turn_high = 50 * degree;
// Rounds that turn clusters; each solves all clusters once. At half the value: the error of a horse transferred to
// itself is 0.0086 (0.0090 now). At twice the value: 0.0094. All other results stay the same.
constexpr std::int32_t refit_rounds = 4;
// Vertices of one job; no result depends on it.
constexpr std::size_t vertex_block = 2048;

// --- transfer_ground.cpp ---

// Heights of a foot (in boxes) below which it stands, and above which it is free. Halving or doubling the first changes
// results by at most 3 %. With half the second, feet end 1.2 times as far from their paths. With twice the second,
// surfaces sink 0.002 boxes.
constexpr double stands = 0.01, flies = 0.05;
// Shares of its rest height below which a contact touches the ground, and above which it is free. The largest step of a
// deer between two frames is 0.026. Halving and doubling the first gives 0.022 and 0.040. For the second it is 0.033
// and 0.035.
constexpr double touches = 0.1, leaves = 0.45;
// Shares of the surface that touch the ground when a body begins to lie, and when it lies fully. Halving or doubling it
// moves vertices by up to 0.04 boxes and changes accelerations by 8 %.
constexpr double lies_low = 0.01, lies_high = 0.06;
// Depth (in boxes) that a surface may sink into the ground. Surfaces sink exactly that deep. At half the value they
// sink by 5e-5, at twice the value by 2e-4.
constexpr double least_depth = 1e-4;
// A constraint of a frame (hold) with a smaller share is left out; guards a division by the share. Halving or doubling
// it changes nothing.
constexpr double least_hold = 1e-6;
// Share of a constraint (hold) that lifts a sunk part, where 1 meets the goal exactly. Closer to 1 needs fewer rounds.
// At half the value: the test model Knight sinks 9e-5 boxes (1e-5 now).
constexpr double sunk_hold = 0.98;
// A constraint (hold) below this part of sunk_hold is replaced instead of raised. Halving or doubling it moves vertices
// by up to 9e-4 boxes.
constexpr double weak_hold = 0.5;
// A frame with a smaller share of non-rigid motion is not lifted. Halving or doubling it changes nothing.
constexpr double least_share = 1e-3;
// Rounds that lift sunk parts. At half the value: surfaces sink 0.0007 boxes instead of 0.0001. Doubling it changes
// results by at most 3 %.
constexpr std::int32_t sunk_rounds = 8;
// Rounds of lifting in which the clusters turn as well. At half the value: the edge stretch of a cow is 0.204 (0.211
// now). Doubling it changes results by at most 3 %.
constexpr std::int32_t turning_rounds = 3;

// --- translations.cpp ---

// Most single vertices held in one frame. It bounds the Gram matrix and the time of a frame in which many vertices
// sink.
constexpr std::size_t vertex_rows = 24;
// This share of the diagonal is added to the diagonal, so that two constraints (holds) of the same place can be solved.
// Halving or doubling it changes results by at most 3 %.
constexpr double hold_ridge = 1e-9;
// Keeps the square root of a failed pivot positive.
constexpr double least_pivot = 1e-300;

}  // namespace hf_inner

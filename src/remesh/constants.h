// Every chosen number of this room, grouped by the file that uses it.
//
// The lines say what half and double do, or the values named. They were tried at edges of 3 to 4 % of the box on a cow,
// a figure of eight (both kinds), an elephant, a triceratops, and a blob of three pieces with borders. H is the
// Hausdorff distance in % of the box; aspect and angles are 95 % quantiles. "Same" means the same figures. "No trend":
// figures move, but half and double move them alike or both ways, H by 0.3 at most. Numbers decide whole lines and
// faces, so rounding alone can move the faces by 1.4 %.
#pragma once
#include <cstddef>
#include <cstdint>

namespace hf_inner {

// --- quads.h ---
// Faces against detail, as share of the box; docs/quads.md is measured at this value. Half: four times the faces.
constexpr double default_edge_length = 0.022;
// Evenness against time. 30: aspect of the eight 2.5 to 2.6, irregular 34 to 37 %; 120: as 60.
constexpr std::int32_t default_relax_rounds = 60;

// --- quads.cpp: sites ---
// Keeps one site a limb, in box diagonals. Half: same; double: other sites on the cow, irregular 19 to 16 %.
constexpr double tip_distance = 0.06;
// Bounds the sites of busy shapes. 8: the cow has 22 % fewer faces, irregular 19 to 27 %; 64: same.
constexpr std::size_t most_tips = 32;
struct TipLengths {
  double geodesic, poisson;
};
// Lists from many sites to few; the best mesh is kept. Half or double geodesic lengths: no trend.
constexpr TipLengths tip_lengths[] = {{0.008, 0.02}, {0.015, 0.05}, {0.03, 0.1}, {0.1, 0.3}};
// How many of the lists are tried: 2 to 20 % of the time each. 1 or 2: the same mesh won on four shapes.
constexpr int tip_trials = 4;
// Sources of the mean distance: time against tips found. 20: other tips on the cow; 80: same.
constexpr std::int32_t geodesic_sources = 40;
// Time step of the heat method in squared mean edges, 1 as its authors have it. Half or double: no trend.
constexpr double geodesic_smoothing = 1.0;
// Holds a border at one level against freedom of the flow. 3: 12 % fewer faces; 300: 36 % more (the blob).
constexpr double apex_weight = 30;

// --- quads.cpp: lines of kind pure ---
// Rounds of scaling lines to faces. 1 or 4: same (the eight, kind pure).
constexpr int line_rounds = 2;
// Faces for the area. 1.0: H 0.84 to 0.89 with 14 % fewer faces; 1.3: 0.80 with 8 % more.
constexpr double area_share = 1.15;
// A guard: bounds a correction of the lines. 0.5, 0.1 or no bound: same on two meshes of kind pure.
constexpr double least_line_scale = 0.25;
// A guard: bounds a correction of the lines. 4, 16 or no bound: same on two meshes of kind pure.
constexpr double most_line_scale = 8.0;

// --- quads.cpp: evening out ---
// Share of the rounds, 1 in 6, before thin parts are measured. 1 in 3 or 1 in 12: same on two meshes of kind pure.
constexpr std::int32_t early_share = 6;
// How much nearer the mesh relaxed less must be to be kept. 0.5 or 1: same on two meshes of kind pure.
constexpr double early_gain = 0.9;
// Below this distance, in box diagonals, snapping is left out: saves time on smooth shapes. Half or double: same.
constexpr double capture_from = 0.003;

// --- quads.cpp: fitting ---
// Distance of samples, in edge lengths: finds misses against time. Half: H no trend; double: mean up to +6 %.
constexpr double sample_spacing = 0.33;
// H against faces, 0.86 % of the box at 2.2 % edges (tests: 1 %). Half: up to 18 % more faces; double: H to 2.9.
constexpr double fit_tolerance = 0.39;
// Tolerance of collapses over that of fitting; above 1, so that collapses do not undo the fit. At 1.0 the Hausdorff
// distance fell from 1.26 to 1.18 %; at 1.2 it was 1.17 %, with 30 % more faces.
constexpr double collapse_tolerance = 1.03;
// A guard against an endless loop of fitting and collapsing; 4 are reached. 2 or 1,000: same bytes on nine meshes.
constexpr int fit_turns = 4;
// Corners that a step may turn over, more each turn: distance against folds. 1: H 1.60 to 1.63; 4: same H.
constexpr std::int32_t folds_a_turn = 2;
// Rings relaxed around a step in odd turns. 0: H 1.26 to 1.28; 2: H same.
constexpr std::int32_t fit_rings_odd = 1;
// Shortest edges that kind pure keeps where it was refined. Half or double: same on three meshes.
constexpr double short_edge_pure = 0.3;

// --- quads.cpp: choice ---
// Meshes this much farther than the nearest are not fitted: saves time. 1.1 or 3: same.
constexpr double trial_cutoff = 1.35;
// Meshes fitted at most: time against choice. 1: the same mesh won on five shapes.
constexpr std::size_t most_fitted = 3;
// Meshes of each density fitted at most: time against choice. 1: same on four shapes.
constexpr std::size_t most_dense = 2;
// How many densities follow.
constexpr int density_count = 2;
// Tried if no mesh is good; the skull and an elephant of docs/quads.md need them. Half or double steps: same.
constexpr double densities[density_count] = {1.15, 1.3};
// Distance of a good mesh, 0.9 % of the box at 2.2 % edges (tests: 1 %). 0.3: up to 66 % more faces; 0.6: same.
constexpr double near_distance = 0.41;
// Cost from which denser meshes are tried: time against distance. 1.0 or 1.2: same on four shapes.
constexpr double near_enough = 1.06;
// Share of edges and quads that may be worse, as docs/quads.md reports 5 and 95 %. 0.02 or 0.1: same.
constexpr double outliers = 0.05;
// Edges of an even mesh, above the 0.5 of the tests. 0.3 or 0.7: same choice.
constexpr double shortest_even = 0.52;
// Edges of an even mesh, below the 2.1 of the tests. 1.5: up to 32 % more faces; 4: same.
constexpr double longest_even = 2;
// Aspect of an even mesh: evenness against faces. 2: up to 65 % more faces; 8: same.
constexpr double narrowest_even = 4;
// Aspect of an even mesh of kind pure, where lines cannot end. 6 or 24: same.
constexpr double narrowest_pure = 12;
// Weight of edges too short against those too long in the choice. 1 or 4: same on four shapes.
constexpr double short_edge_cost = 2;
// Stands for the aspect of a quad with an edge of length 0; any number far above narrowest_pure.
constexpr double most_aspect = 1e3;

// --- quads.cpp: progress ---
struct QuadsProgress {
  float prepared, far_tips, tips, tried, fitted;
};
// Measured: tips end at 1 to 8 % of the time, trials at 10 to 86, fitting at 44 to 100. None is right for all.
constexpr QuadsProgress quads_progress = {0.15f, 0.25f, 0.3f, 0.6f, 0.8f};
struct MakeProgress {
  float flow, solved, counted, arcs, rings, polygons, split;
};
// Measured: a mesh spends 65 to 97 % in evening out, which has the last 30 % here; a test bounds the steps.
constexpr MakeProgress make_progress = {0.2f, 0.3f, 0.35f, 0.4f, 0.6f, 0.65f, 0.7f};
struct EvenProgress {
  float early, early_measured, relaxed, measured, captured;
};
// Order only; the shares are not measured.
constexpr EvenProgress even_progress = {0.1f, 0.2f, 0.5f, 0.6f, 0.9f};
// Order only; the share is not measured.
constexpr float fit_progress = 0.6f;
// Order only. Measured on three shapes: making takes 10 to 50 % of making and fitting.
constexpr float given_made = 0.7f;
// As given_made.
constexpr float dense_made = 0.3f;

// --- flux_sites.cpp, border_flux.cpp ---
// Nodes of a ring, lines of a site: 2 would double an edge, which check_quads refuses. 2 or 6: same on four shapes.
constexpr double least_lines = 4;
// Where the girth of a limb is measured, in box diagonals. Half: aspect of the cow 2.2 to 3.4; double: H +0.1 to +0.2.
constexpr double circle_radius = 0.1;
// Width of the band of that circle over its radius. Half: H of the eight 1.00 to 1.35; double: 1.08.
constexpr double circle_band = 0.2;
// Geodesic distance of a tip from borders and earlier sites. Half: same; double: 95 % edge of the cow 1.5 to 1.9.
constexpr double border_distance = 0.08;
// Bounds time and memory: pairs of sites and a dense system (border_flux.cpp). Not measured.
constexpr std::size_t most_sites = 400;
// A source and a sink.
constexpr std::size_t least_sites = 2;
// Sites of a surface with handles. 2: H of the eight 1.00 to 1.02; 8: 1.14, irregular 34 to 50 %.
constexpr std::size_t least_sites_with_handles = 4;
// Progress only: the usual number of sites, before it is known.
constexpr std::size_t expected_sites = 4;
// Neighbours of one sign against balance of the sides. Half or double: the same partition on four shapes.
constexpr double neighbour_cost = 0.5;
// A guard against 0 for sites in one place; positions have a box of diagonal 1.
constexpr double least_mean_distance = 1e-12;
// All partitions: 2,048 of 12 sites, twice as many a site. 6: edges of the cow 0.64 to 0.55 (5 %); 16: same.
constexpr std::size_t most_tried_at_once = 12;
// Time: double exchanges of k sites cost k^4 a sweep. Not measured: no shape tried had 20 sites.
constexpr std::size_t most_exchanged_in_pairs = 40;
// Above rounding of a cost of size 1, so that exchanges end.
constexpr double least_cost_gain = 1e-12;
// Pins a vertex of each component; any value above 1 gives one field. 1.001 or 20: the eight by rounding, +-1 % faces.
constexpr double pinned_diagonal = 2;
// Solves, refinements included. 1: faces by rounding, 518 to 511 on the cow; 6: as 3, within rounding.
constexpr int flux_solves = 3;
// Raises before sources and sinks are held at two levels: time against even lines. 3: same on a sheet with holes.
constexpr int border_rounds = 6;
// Factor of a raise. 1.3: same; 3: H of a sheet with holes 1.54 to 1.89, aspect 12 to 19.
constexpr double border_raise = 1.7;

// --- flux_field.cpp ---
// Keeps the flux of equal values positive; near the smallest double, so that it adds nothing to others.
constexpr double least_flux = 1e-300;
// Share of the inflow that counts as used up: some units of rounding.
constexpr double least_segment = 1e-15;

// --- ring_levels.cpp ---
// Edge lengths from a site to its first ring, between both kinds. Half: H -0.2 to +0.1; 1.2: -0.1 to +0.2, fewer faces.
constexpr double ring_at_site = 0.8;
// Half a face on both sides of a saddle. 0.25: H -0.3 to +0.2; 1: up to +0.3, irregular 30 to 40 % on the cow.
constexpr double ring_at_saddle = 0.5;
// Loops whose lengths are integrated along an arc: time against even rings. Half or double: no trend.
constexpr std::int32_t loops_an_arc = 64;
// Share of an arc's range above which a step is subdivided. Half or double: no trend.
constexpr double long_step = 0.01;
// Pieces of such a step. 4 or 16: no trend.
constexpr std::int32_t long_step_pieces = 8;
// A guard against division by 0.
constexpr double least_arc_flux = 1e-30;
// A guard: an edge_length of 1e-4 of the box, the least allowed, gives some ten thousand rings an arc.
constexpr double most_rings = 1e6;

// --- rings.cpp ---
// A guard for the conversion to an integer.
constexpr double most_nodes = 1e6;
// Valence of a site, 3 or more after splitting 6 nodes. 4: angles of the cow 42 to 52 degrees (95 %); 8: 47.
constexpr double least_nodes_at_site = 6;
// Edge lengths of a gap that gets a pair of nodes. 1.6: irregular 34 to 51 %, faces +10 to 17; 3: H to 1.3, 31 % fewer.
constexpr double widest_gap_length = 1.9;
// A pair of lines ends where three neighbouring gaps together are narrower than this many edge lengths. 1.2: 2 to 6 %
// more faces; 2.4: 2 to 6 % fewer.
constexpr double narrowest_gaps_length = 1.7;
// Lines that a ring keeps, a hexagon. 4: same on four shapes; 12: no trend.
constexpr std::int32_t least_lined = 6;
// Share of the gap between two lines that are traced down together. 0.125 or 0.5: same on four shapes.
constexpr double second_line = 0.25;

// --- quad_mesh.cpp ---
// Cost of a reflex corner, above the 1 of a flat one. 0: H of the eight 1.00 to 1.02, aspect 2.5 to 2.6; 8: same.
constexpr double reflex_cost = 4;
// Above any sum of four squared cosines and reflex_cost, so that such a quad is chosen last.
constexpr double degenerate_cost = 1e3;

// --- relax.cpp ---
// Share of the way to the proposals, below 1 against swinging. 0.25 or 1: no trend.
constexpr double relax_step = 0.5;
// Share of the way to the edge length aimed at. 0.25: no trend; 1: more irregular vertices on the cow, 30 to 33 %.
constexpr double size_step = 0.5;
// A guard against an endless walk on degenerate triangles; the highest seen is 18. 100,000: same on nine meshes.
constexpr int most_crossings = 200;

// --- nearest.cpp ---
// Boxes against triangles to test. The result does not depend on it.
constexpr std::int32_t triangles_a_leaf = 4;
// 2^31 triangles halved to leaves give 29 levels, each with one box waiting.
constexpr std::int32_t tree_stack = 32;

// --- quad_distance.cpp ---
// Time on large surfaces: every second vertex from 60,000 on, every third from 120,000.
constexpr std::int32_t most_samples = 60000;
// Triangles up to which their insides are sampled: time; finer surfaces have vertices enough.
constexpr std::int32_t most_spread = 30000;
// Bounds the samples of a triangle. 4: blob has 25 % fewer faces, H 1.48 to 1.77; no bound: same on eight of nine.
constexpr double most_steps = 8;
// Steps on a triangle of the surface at least: its vertices are samples already. 2: same on four shapes.
constexpr std::int32_t surface_steps = 1;
// Steps on a triangle of a quad at least, so that the middles of edges are sampled. 1 or 4: same on four shapes.
constexpr std::int32_t quad_steps = 2;
// Squared spacings, 0.14 of one: a diagonal that near needs no better. 0: mean within 3 %; 0.08: mean up to +6 %.
constexpr double flat_diagonal = 0.02;
// Places on a diagonal that are measured: the middle first, so that a bad diagonal is left early.
constexpr double diagonal_shares[] = {0.5, 0.25, 0.75};
// Size of a piece of parallel work, in samples. The result does not depend on it.
constexpr std::int32_t samples_a_piece = 4096;
// Size of a piece of parallel work, in faces. The result does not depend on it.
constexpr std::int32_t faces_a_piece = 512;
// 2^64 over the golden ratio, as in splitmix64.
constexpr std::uint64_t hash_start = 0x9e3779b97f4a7c15u;
// The first multiplier of MurmurHash3's finaliser.
constexpr std::uint64_t hash_factor = 0xff51afd7ed558ccdu;

// --- capture.cpp ---
// Places snapped, in box diagonals: reach against shape. Half: aspect up to 7.1; double: mean up to +24 %, even quads.
constexpr double capture_tolerance = 0.006;
// Rounds of snapping. 2 or 10: no trend.
constexpr std::int32_t capture_rounds = 5;
// Rounds of relaxation after snapping. 4 or 16: no trend.
constexpr std::int32_t capture_relax_rounds = 8;
// Rings relaxed around a snapped vertex. 1 or 6: no trend.
constexpr std::int32_t capture_rings = 3;

// --- fit.h, fit.cpp ---
// A guard against an endless loop of steps; the highest seen is 57 of 80. 40 or 100,000: same on nine meshes.
constexpr std::int32_t fit_rounds = 80;
// Rounds of relaxation after a step. 6 or 24: H same, faces within 3 %.
constexpr std::int32_t fit_relax_rounds = 12;
// Rings relaxed around a step. 1: H same, faces +2 %; 4: H 1.26 to 1.29.
constexpr std::int32_t fit_rings = 2;
// Rings more for release and snap. 0: H same; 2: H 1.26 to 1.27.
constexpr std::int32_t fit_snap_rings = 1;
// Rings relaxed after subdividing and snapping. 0 or 2: same on six meshes, where subdividing is rare.
constexpr std::int32_t fit_resnap_rings = 1;
// Rings between places of one round: more places at once against steps that touch. 1: H 1.26 to 1.18; 6: same.
constexpr std::int32_t fit_apart = 3;
// Edge lengths around a place in which a step is compared, a little above fit_rings. Half: faces +2 %; double: H +0.01.
constexpr double fit_reach = 2.2;
// Edge lengths within which a place counts as tried: repeats against skipped places. Half or double: no trend.
constexpr double fit_same_place = 0.8;
// A step of fitting stays only if the distance to the surface falls to this share of what it was. 0.8: same; 1: the
// Hausdorff distance of the triceratops rose from 1.60 to 1.87 %.
constexpr double fit_gain = 0.97;
// The same where corners turn over: distance against folds. Half: H same; 1: same.
constexpr double fit_folding_gain = 0.5;
// Bounds the faces added. 1.1 or 3: same on six meshes, which add less.
constexpr double fit_most_faces = 1.5;

// --- refine.cpp ---
// Edge length after subdividing, between 1 and the half of a middle. 0.5 or 1: same on six meshes.
constexpr float subdivided_scale = 0.75f;
// Edge length after a split, which adds one face. 0.75 or 1: H same.
constexpr float split_scale = 0.92f;

// --- coarsen.h, coarsen.cpp ---
// Faces against short edges. Half: irregular 16 to 32 %, 5 % edge down to 0.43; 0.8: irregular 56 to 66 %.
constexpr double short_edge = 0.55;
// A guard against an endless loop; the highest seen is 16 of 24. 100,000: same on nine; 12: one H 1.65 to 1.71.
constexpr std::int32_t collapse_rounds = 24;
// Share of quads with a short edge that may stay: time against evenness. Half: H same; double: faces up to +4 %.
constexpr double collapse_enough = 0.02;
// Rounds of relaxation after collapses. 6 or 24: no trend.
constexpr std::int32_t collapse_relax_rounds = 12;
// Rings relaxed around a collapse. 1 or 4: no trend.
constexpr std::int32_t collapse_rings = 2;
// A merged vertex has two faces fewer. 7: faces up to +7 %, 39 to 32 % irregular; 10: as 8.
constexpr std::int32_t collapse_most_faces = 8;
// Bounds the time of a round. 2 or 1,000: same bytes on eight of nine meshes, faces of the ninth +0.4 or +1.4 %.
constexpr int collapse_tries = 4;
// Edge lengths around a collapse in which nothing more may be missed. Half or double: no trend.
constexpr double collapse_reach = 2;
// Distance beyond that reach, in tolerances, that takes a collapse back. 1.0 or 2.2: same on seven meshes.
constexpr double collapse_far = 1.1;
// Edge lengths from a collapse taken back in which none is tried again. Half: same; double: faces +1 %.
constexpr double collapse_same_place = 0.3;

}  // namespace hf_inner

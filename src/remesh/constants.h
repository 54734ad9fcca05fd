// All chosen numbers of this folder, grouped by the file that uses them.
//
// The lines say what happened with half or twice the value, or with other values. All were tried at edges of 3 to 4 %
// of the box on a cow, a figure of eight (kind uniform, and kind pure, whose lines never end between sites), an
// elephant, a triceratops, and a blob of three pieces with borders. "Box" means the diagonal of the bounding box.
// Distances are Hausdorff distances in % of the box, unless they are called mean. Aspects and angles are 95 %
// quantiles. "Irregular" is the share of irregular vertices. Where some results got better and others worse, the
// distance changed by at most 0.3. All these numbers decide about whole lines and faces, so rounding alone can change
// the number of faces by 1.4 %.
#pragma once
#include <cstddef>
#include <cstdint>

namespace hf_inner {

// --- intake.cpp: bounds of options, as hf/quads.h states them ---

// Edge lengths, as shares of the box: below, a mesh would have 10^8 faces; above, none. They refuse wrong units;
// api_bad_quads_test tries a shorter one. No result depends on them.
constexpr double least_edge_length = 1e-4, most_edge_length = 1.0;
// Counts: 16 times the usual rounds, lines of a site, lines of a flow. They refuse other numbers in the place of
// counts; api_bad_quads_test tries the first two. No result depends on them.
constexpr std::uint32_t most_relax_count = 1000, most_flow_lines = 1000000;
constexpr std::int32_t most_site_lines = 100000;

// --- quads.h ---

// Wanted edge length of quads, as a share of the box: trades detail for faces. docs/quads.md is measured with it. At
// half the value: four times the faces.
constexpr double default_edge_length = 0.022;
// Rounds that even out a quad mesh. At 30 a figure of eight has quads of aspect 2.6 instead of 2.5, and 37 % irregular
// vertices instead of 34 %. With 120 the mesh is as good as with 60.
constexpr std::int32_t default_relax_rounds = 60;

// --- quads.cpp: sites ---

// A tip nearer to an earlier one than this share of the box becomes no site, so that each limb has one site. Halving it
// changes no mesh. At twice the value: a cow has other sites, and 16 % irregular vertices instead of 19 %.
constexpr double tip_distance = 0.06;
// At most this many tips become sites. With 8, a cow has 22 % fewer faces, and 27 % irregular vertices instead of 19 %.
// With 64 its mesh is the same.
constexpr std::size_t most_tips = 32;
struct TipLengths {
  double geodesic, poisson;
};
// Tips must be at least this long: a list of limits, from many sites to few. The best mesh of all is kept. Halving or
// doubling the geodesic lengths improves some meshes and worsens others.
constexpr TipLengths tip_lengths[] = {{0.008, 0.02}, {0.015, 0.05}, {0.03, 0.1}, {0.1, 0.3}};
// Of tip_lengths, this many are tried; each takes 2 to 20 % of the time. 1 or 2 give the same four test meshes.
constexpr int tip_trials = 4;
// Vertices whose mean distance to a point tells how far out it lies: more find tips more exactly but take longer. With
// 20: other tips on a cow. With 80 the same tips.
constexpr std::int32_t geodesic_sources = 40;
// Time step of the heat method for distances, in squared mean edges. Its authors use 1. Halving or doubling it improves
// some meshes and worsens others.
constexpr double geodesic_smoothing = 1.0;
// Weight that keeps the flow field nearly constant on a border; more weight restricts the flow. On a blob of three
// pieces, 3 gives 12 % fewer faces, and 300 gives 36 % more.
constexpr double apex_weight = 30;

// --- quads.cpp: lines of kind pure ---

// Rounds that scale the flow lines to the wanted number of faces. 1 and 4 give a figure of eight the same mesh.
constexpr int line_rounds = 2;
// Wanted faces, relative to area over squared edge length. At 1.0 the distance to the surface is 0.89 % of the box
// instead of 0.84, with 14 % fewer faces. At 1.3 it is 0.80 %, with 8 % more.
constexpr double area_share = 1.15;
// One round multiplies the number of flow lines by at least this. With 0.5 and 0.1 no test mesh changes.
constexpr double least_line_scale = 0.25;
// One round multiplies the number of flow lines by at most this. With 4 and 16 no test mesh changes.
constexpr double most_line_scale = 8.0;

// --- quads.cpp: evening out ---

// One in this many rounds of relaxation (evening out) runs before thin parts are measured. One in 3 or one in 12
// changes neither of two test meshes whose lines never end between sites (kind pure).
constexpr std::int32_t early_share = 6;
// The mesh after the early rounds (early_share) is kept if its distance to the surface is below this share of the final
// mesh's. With 0.5 and 1 no test mesh changes.
constexpr double early_gain = 0.9;
// Below this distance between mesh and surface (share of the box), no vertices are snapped to missed places, which
// saves time. Halving or doubling it changes no test mesh.
constexpr double capture_from = 0.003;

// --- quads.cpp: fitting ---

// Spacing of sample points for distances, in edge lengths: trades exactness for time. Half the value makes distances
// smaller on some meshes and larger on others. Twice the value raises the mean distance by up to 6 %.
constexpr double sample_spacing = 0.33;
// A place farther than this from the surface is fitted; in edge lengths. It gives distances of 0.86 % of the box at
// edges of 2.2 %; the tests demand 1 %. Half the value: up to 18 % more faces. Twice: distances up to 2.9 %.
constexpr double fit_tolerance = 0.39;
// Tolerance of collapses relative to fit_tolerance, above 1 so that collapses do not undo the fit. At 1.0 the distance
// to the surface is 1.18 % of the box instead of 1.26. At 1.2 it is 1.17 %, with 30 % more faces.
constexpr double collapse_tolerance = 1.03;
// Fitting and collapsing alternate at most this many times. With 2 and 8 seven test meshes stay the same.
constexpr int fit_turns = 4;
// A fitting step may turn over this many more corners with each turn: trades distance for folds. At 1 the distance to
// the surface is 1.63 % of the box instead of 1.60. At 4 it stays the same.
constexpr std::int32_t folds_a_turn = 2;
// Fitting and collapsing alternate in turns. In odd turns, quads up to this many rows from a fitting step are relaxed
// (evened out). At 0 the distance to the surface is 1.28 % of the box instead of 1.26. At 2 it stays the same.
constexpr std::int32_t fit_rings_odd = 1;
// Shortest edges, in edge lengths, that kind pure (no line ends between sites) keeps where the mesh was refined.
// Halving or doubling it changes none of three test meshes.
constexpr double short_edge_pure = 0.3;

// --- quads.cpp: choice ---

// A mesh this many times farther from the surface than the nearest is not fitted. 1.1 and 3 change no choice.
constexpr double trial_cutoff = 1.35;
// At most this many meshes are fitted, the best is chosen. With 1 the same mesh was chosen on five test shapes.
constexpr std::size_t most_fitted = 3;
// At most this many meshes are fitted for each entry of `densities`. With 1 four test shapes get the same mesh.
constexpr std::size_t most_dense = 2;
// Number of entries of `densities`.
constexpr int density_count = 2;
// Edges shorter by these factors are tried if no mesh is good. The skull and an elephant of docs/quads.md need them.
// Halving or doubling the steps above 1 changes no mesh.
constexpr double densities[density_count] = {1.15, 1.3};
// Distance of a good mesh to the surface, in edge lengths: 0.9 % of the box at edges of 2.2 %; the tests demand 1 %.
// With 0.3: up to 66 % more faces. With 0.6 the same meshes are chosen.
constexpr double near_distance = 0.41;
// Denser meshes are tried only if the best mesh has a larger cost (1 or less is good); this saves time. With 1.0 and
// 1.2 four test shapes get the same mesh.
constexpr double near_enough = 1.06;
// Share of edges and of quads that may be worse in an even mesh. docs/quads.md reports the same 5 and 95 % quantiles.
// With 0.02 and 0.1 the same meshes are chosen.
constexpr double outliers = 0.05;
// Shortest edges of an even mesh, in edge lengths; tests demand 0.5. With 0.3 and 0.7 no chosen mesh changes.
constexpr double shortest_even = 0.52;
// Longest edges of an even mesh, in edge lengths; the tests demand at most 2.1. With 1.5: up to 32 % more faces. With 4
// the same meshes are chosen.
constexpr double longest_even = 2;
// Largest aspect of quads in an even mesh. With 2: up to 65 % more faces. With 8 no chosen mesh changes.
constexpr double narrowest_even = 4;
// Like narrowest_even, but for kind pure, where lines cannot end. With 6 and 24 no chosen mesh changes.
constexpr double narrowest_pure = 12;
// Cost of too short edges, relative to too long ones. With 1 and 4 four test shapes get the same mesh.
constexpr double short_edge_cost = 2;
// Stands for the aspect of a quad with an edge of length 0. Any number far above narrowest_pure will do.
constexpr double most_aspect = 1e3;

// --- quads.cpp: progress ---
struct QuadsProgress {
  float prepared, far_tips, tips, tried, fitted;
};
// Reported progress (0 to 1) at the end of each stage. Measured: tips ended at 1 to 8 % of the time, trials at 10 to 86
// %, and fitting at 44 to 100 %. No set of values fits all shapes.
constexpr QuadsProgress quads_progress = {0.15f, 0.25f, 0.3f, 0.6f, 0.8f};
struct MakeProgress {
  float flow, solved, counted, arcs, rings, polygons, split;
};
// Reported progress while one mesh is made. Evening out took 65 to 97 % of the time, but gets only the last 30 % of the
// progress here. A test limits the size of the steps.
constexpr MakeProgress make_progress = {0.2f, 0.3f, 0.35f, 0.4f, 0.6f, 0.65f, 0.7f};
struct EvenProgress {
  float early, early_measured, relaxed, measured, captured;
};
// Reported progress while one mesh is evened out. On four shapes, relaxing took 12 to 15 % of the time and snapping 57
// to 73 %. No result depends on it.
constexpr EvenProgress even_progress = {0.1f, 0.2f, 0.5f, 0.6f, 0.9f};
// Share of a turn's reported progress for fitting; the rest is for collapsing quads. On four shapes, fitting took 20 to
// 94 % of both, so no share fits all. No result depends on it.
constexpr float fit_progress = 0.6f;
// Reported progress at which a mesh from given sites is made; the rest is for fitting it. On three shapes, making took
// 10 to 50 % of both.
constexpr float given_made = 0.7f;
// Reported progress at which a denser mesh is made; the rest is for fitting it. Making took 10 to 50 % of both, as
// above. No result depends on it.
constexpr float dense_made = 0.3f;

// --- flux_sites.cpp, border_flux.cpp ---

// At least this many flow lines start at a site, and at least this many nodes lie on a ring. 2 would double an edge,
// which check_quads refuses. With 2 and 6 four test shapes get the same mesh.
constexpr double least_lines = 4;
// Radius of the circle that measures the girth of a limb, as a share of the box. At half the value: quads of a cow have
// aspect 3.4 instead of 2.2. At twice the value: the distance to the surface grows by 0.1 to 0.2 % of the box.
constexpr double circle_radius = 0.1;
// Vertices this close to circle_radius, as a share of it, measure the girth of a limb. The distance to the surface of a
// figure of eight is 1.00 % of the box, 1.35 at half the value, 1.08 at twice the value.
constexpr double circle_band = 0.2;
// A tip must be at least this far (share of the box, along the surface) from borders and earlier sites. Halving it
// changes no mesh. At twice the value: the 95 % quantile of a cow's edges is 1.9 edge lengths instead of 1.5.
constexpr double border_distance = 0.08;
// At most this many sites per component. It bounds a table of all their pairs (border_flux.cpp). Half of it refuses a
// sheet with 226 borders. Double takes a sheet with 441, in 4 s and 75 MB without relaxing.
constexpr std::size_t most_sites = 400;
// At least this many sites in a component: a source and a sink of the flow.
constexpr std::size_t least_sites = 2;
// At least this many sites on a surface with handles (tunnels). With 2, the distance to the surface of a figure of
// eight is 1.02 % of the box instead of 1.00. With 8 it is 1.14, and 50 % of the vertices are irregular instead of 34.
constexpr std::size_t least_sites_with_handles = 4;
// The usual number of sites; progress uses it before the number is known.
constexpr std::size_t expected_sites = 4;
// Cost of neighbours that are both sources or both sinks of the flow, against the balance of sources and sinks. Halving
// or doubling it gives the same partition on four test shapes.
constexpr double neighbour_cost = 0.5;
// Guards a division by 0 when all sites are in one place. Positions are scaled to a bounding box with diagonal 1.
constexpr double least_mean_distance = 1e-12;
// Up to this many sites, all partitions into sources and sinks are tried: 2,048 for 12 sites. With 6, the 5 % quantile
// of a cow's edges is 0.55 edge lengths instead of 0.64. With 16 its mesh is the same.
constexpr std::size_t most_tried_at_once = 12;
// Up to this many sites, two swap sides (source, sink) at once, which costs k^4 per sweep for k sites. At half the
// value, a sheet with 31 borders has 12 % more faces, and aspect 29 instead of 9.6. At twice the value, a sheet with 57
// has 28 % fewer faces, and aspect 17 instead of 85. At 120, a sheet with 101 takes 2.2 s without relaxing, not 0.4.
constexpr std::size_t most_exchanged_in_pairs = 40;
// A swap of sites must lower the partition's cost by at least this, so swaps end. It is above rounding errors.
constexpr double least_cost_gain = 1e-12;
// Factor on the diagonal of one vertex per component, which makes the flow matrix regular. Any value above 1 gives the
// same field. With 1.001 or 20, rounding changes the faces of a figure of eight by 1 %.
constexpr double pinned_diagonal = 2;
// Solves per flow field, refinements included. With 1, rounding changes the faces of a cow from 518 to 511. With 6 they
// change by no more than that.
constexpr int flux_solves = 3;
// Rounds that raise flow through borders before fixed values replace it. 3 gives a sheet with holes the same mesh.
constexpr int border_rounds = 6;
// One round multiplies a border's flow by this. With 1.3 the meshes stay the same. With 3: the distance to the surface
// of a sheet with holes is 1.89 % of the box instead of 1.54, its quads have aspect 19 instead of 12.
constexpr double border_raise = 1.7;

// --- flux_field.cpp ---

// Keeps the flux between equal values positive. It is near the smallest double, so it does not change other fluxes.
constexpr double least_flux = 1e-300;
// A rest of flux below this share of the flux into a vertex counts as used up: a few units of rounding.
constexpr double least_segment = 1e-15;

// --- ring_levels.cpp ---

// Distance from a site to the first ring of nodes around it, in edge lengths. One value serves both kinds of mesh, with
// lines that may end between sites and with lines that may not. Half the value changes the distance to the surface by
// -0.2 to +0.1 % of the box, 1.2 by -0.1 to +0.2.
constexpr double ring_at_site = 0.8;
// Distance from a saddle to the next ring of nodes, in edge lengths. At 0.25 the distance to the surface changes by
// -0.3 to +0.2 % of the box. At 1 it grows by up to 0.3, and a cow has 40 % irregular vertices instead of 30.
constexpr double ring_at_saddle = 0.5;
// The spacing of rings is measured on at most this many level loops between two critical points: more take longer, for
// evener rings. Halving or doubling it improves some meshes and worsens others.
constexpr std::int32_t loops_an_arc = 64;
// A step between two level loops above this share of the field's range is subdivided. Halving or doubling it improves
// some meshes and worsens others.
constexpr double long_step = 0.01;
// Pieces into which such a long step is subdivided. 4 and 16 improve some meshes and worsen others.
constexpr std::int32_t long_step_pieces = 8;
// Guards a division by a flux of 0.
constexpr double least_arc_flux = 1e-30;
// At most this many rings of nodes in a mesh. An edge_length of 1e-4 of the box, the least allowed, gives some ten
// thousand rings from one critical point to the next. It bounds memory.
constexpr double most_rings = 1e6;

// --- rings.cpp ---

// Keeps a number of nodes within the range of an integer.
constexpr double most_nodes = 1e6;
// At least this many nodes on the ring beside a site; the site then has 3 or more faces. Angles of a cow (95 %
// quantile): 42 degrees, 52 with 4, 47 with 8.
constexpr double least_nodes_at_site = 6;
// A gap between lines wider than this many edge lengths gets two more lines. At 1.6, 51 % of the vertices are irregular
// instead of 34, with 10 to 17 % more faces. At 3 distances grow to 1.3 % of the box, with 31 % fewer faces.
constexpr double widest_gap_length = 1.9;
// Two lines end where three neighbouring gaps together are narrower than this many edge lengths. With 1.2: 2 to 6 %
// more faces; with 2.4: 2 to 6 % fewer.
constexpr double narrowest_gaps_length = 1.7;
// A ring of nodes keeps at least this many lines when lines end there: a hexagon. With 4 four test shapes get the same
// mesh. 12 improves some meshes and worsens others.
constexpr std::int32_t least_lined = 6;
// Two lines traced down together are this share of the gap apart. 0.125 and 0.5 give the same four test meshes.
constexpr double second_line = 0.25;

// --- quad_mesh.cpp ---

// Cost of a quad's reflex corner; a flat corner costs 1. With 0, the distance to the surface of a figure of eight is
// 1.02 % of the box instead of 1.00, its quads have aspect 2.6 instead of 2.5. With 8 its mesh is the same.
constexpr double reflex_cost = 4;
// Cost of a quad with an edge of length 0. It is above every other cost, so such a quad is chosen last.
constexpr double degenerate_cost = 1e3;

// --- relax.cpp ---

// A vertex moves by this share of the way to its proposed place. Below 1 it does not swing to and fro. 0.25 and 1
// improve some meshes and worsen others.
constexpr double relax_step = 0.5;
// Sizes of quads move by this share of the way to the wanted edge length. 0.25 improves some meshes and worsens others.
// At 1 a cow has 33 % irregular vertices instead of 30.
constexpr double size_step = 0.5;
// A walk along the surface crosses at most this many edges. With 50 and 800 no test mesh changes.
constexpr int most_crossings = 200;

// --- quad_distance.cpp ---

// From this many vertices on, only every second is sampled, from twice as many every third; this saves time. Half,
// which samples every second vertex of an armadillo of 50,000, gives 261 faces instead of 308, and 2.63 % of the box
// instead of 2.62.
constexpr std::int32_t most_samples = 60000;
// Up to this many triangles, points inside them are sampled too. Finer surfaces have enough vertices. Half leaves them
// out on a cow of 23,062 triangles, double takes them in on a man of 34,986: both get the same mesh.
constexpr std::int32_t most_spread = 30000;
// At most this many steps between samples along an edge of a triangle. With 4, the quad mesh of a test blob has 2 %
// more faces. With 16 it is the same.
constexpr double most_steps = 8;
// At least this many steps between samples along edges of surface triangles. 2 gives the same four test meshes.
constexpr std::int32_t surface_steps = 1;
// At least this many steps between samples along a quad's edges. 1 and 4 give the same four test meshes.
constexpr std::int32_t quad_steps = 2;
// A diagonal of a quad this near to the surface needs no better one. It is a squared distance in squared sample
// spacings: 0.14 of a spacing. With 0 the mean distance changes by 3 %, with 0.08 it grows by up to 6 %.
constexpr double flat_diagonal = 0.02;
// Places on a quad's diagonal that are measured. The middle comes first, so that a bad diagonal is rejected early. More
// places find more bad diagonals and take longer. With the middle alone, and with outer places half and 1.6 times as
// far from it, two test meshes have at most 3 % fewer and 1 % more faces; their mean distances change by at most 3 %.
constexpr double diagonal_shares[] = {0.5, 0.25, 0.75};
// Samples and faces in one thread's job: smaller jobs cost more to hand out, larger ones leave threads idle. Quads of
// an armadillo of 15,000 vertices take as long with half and double of both, within 1 %.
constexpr std::int32_t samples_a_piece = 4096;
constexpr std::int32_t faces_a_piece = 512;
// The value with which the hash starts: 2^64 over the golden ratio, as in splitmix64.
constexpr std::uint64_t hash_start = 0x9e3779b97f4a7c15u;
// The multiplier that mixes the hash, the first one in the last step of MurmurHash3.
constexpr std::uint64_t hash_factor = 0xff51afd7ed558ccdu;

// --- capture.cpp ---

// A vertex is snapped to a missed place this far away (share of the box): trades distance for shape. At half the value:
// quads of aspects up to 7.1. At twice the value: mean distance up to 24 % larger, but even quads.
constexpr double capture_tolerance = 0.006;
// Rounds that snap vertices to missed places. 2 and 10 improve some meshes and worsen others.
constexpr std::int32_t capture_rounds = 5;
// Rounds of relaxation (evening out) after snapping. 4 and 16 improve some meshes and worsen others.
constexpr std::int32_t capture_relax_rounds = 8;
// Quads up to this many rows from a snapped vertex are relaxed. 1 and 6 improve some meshes and worsen others.
constexpr std::int32_t capture_rings = 3;

// --- fit.h, fit.cpp ---

// At most this many rounds of fitting in one turn; it bounds the time. With 40 and 160 six test meshes stay the same.
constexpr std::int32_t fit_rounds = 80;
// Rounds of relaxation (evening out) after a fitting step. With 6 and 24 the distance to the surface is the same, and
// the number of faces changes by 3 %.
constexpr std::int32_t fit_relax_rounds = 12;
// Quads up to this many rows from a fitting step are relaxed. With 1 the distance to the surface is the same, with 2 %
// more faces. With 4 it is 1.29 % of the box instead of 1.26.
constexpr std::int32_t fit_rings = 2;
// After the fitting steps release and snap, quads this many rows farther away are relaxed too. With 0 the distance to
// the surface is the same. With 2 it is 1.27 % of the box instead of 1.26.
constexpr std::int32_t fit_snap_rings = 1;
// Quads this many rows away are relaxed after subdividing and snapping. 0 and 2 change none of six meshes.
constexpr std::int32_t fit_resnap_rings = 1;
// Rows of quads between two places fitted in one round: fewer allow more places at once, but their steps may touch.
// With 1 the distance to the surface is 1.18 % of the box instead of 1.26. With 6 the mesh is the same.
constexpr std::int32_t fit_apart = 3;
// Radius, in edge lengths, in which a fitting step is judged; a little above fit_rings. At half the value: 2 % more
// faces. At twice the value: the distance to the surface grows by 0.01 % of the box.
constexpr double fit_reach = 2.2;
// Radius, in edge lengths, within which a place counts as tried: smaller repeats places, larger skips some. Halving or
// doubling it improves some meshes and worsens others.
constexpr double fit_same_place = 0.8;
// A fitting step stays only if the distance to the surface falls to this share of its former value. With 0.8 the meshes
// stay the same. With 1 the distance of a triceratops is 1.87 % of the box instead of 1.60.
constexpr double fit_gain = 0.97;
// Like fit_gain, but for a step that turns corners over: trades distance for folds. With half the value the distance to
// the surface is the same, with 1 the mesh is.
constexpr double fit_folding_gain = 0.5;
// Fitting multiplies the number of faces by at most this. 1.1 and 3 change none of six test meshes.
constexpr double fit_most_faces = 1.5;

// --- refine.cpp ---

// Factor on the wanted edge length after subdividing. With 0.5 and 1 six test meshes stay the same.
constexpr float subdivided_scale = 0.75f;
// Factor on the wanted edge length after a vertex split. With 0.75 and 1 distances to the surface are the same.
constexpr float split_scale = 0.92f;

// --- coarsen.h, coarsen.cpp ---

// A quad with an edge below this many edge lengths may collapse. At half the value: 32 % irregular vertices instead of
// 16, and the 5 % quantile of the edges falls to 0.43. With 0.8: 66 % irregular vertices instead of 56.
constexpr double short_edge = 0.55;
// At most this many rounds in which quads collapse; it bounds the time. With 12 and 48 seven test meshes stay the same.
constexpr std::int32_t collapse_rounds = 24;
// Share of quads with a short edge that may stay: trades time for evenness. At half the value: the distance to the
// surface is the same. At twice the value: up to 4 % more faces.
constexpr double collapse_enough = 0.02;
// Rounds of relaxation (evening out) after quads collapse. 6 and 24 improve some meshes and worsen others.
constexpr std::int32_t collapse_relax_rounds = 12;
// Quads up to this many rows from a collapse are relaxed. 1 and 4 improve some meshes and worsen others.
constexpr std::int32_t collapse_rings = 2;
// At most this many faces at two vertices that a collapse merges; two of them vanish. With 7: up to 7 % more faces, and
// 32 % irregular vertices instead of 39. With 10 the meshes are those of 8.
constexpr std::int32_t collapse_most_faces = 8;
// At most this many trials in a round of collapses; it bounds the time. With 2 and 8 seven test meshes stay the same.
constexpr int collapse_tries = 4;
// Radius, in edge lengths, in which a collapse may not worsen the distance to the surface. Halving or doubling it
// improves some meshes and worsens others.
constexpr double collapse_reach = 2;
// A place outside collapse_reach undoes the nearest collapse if it is this many tolerances from the surface. With 1.0
// and 2.2 seven test meshes stay the same.
constexpr double collapse_far = 1.1;
// Radius, in edge lengths, around an undone collapse in which no other is tried. Halving it changes no mesh. At twice
// the value: 1 % more faces.
constexpr double collapse_same_place = 0.3;

// To reach a number of quads, at most one in this many collapses in a round: fewer rounds against evenness. Half
// changes none of 21 runs. Double changes 7: some get better and some worse, in about the same time.
constexpr std::int32_t count_share = 12;

}  // namespace hf_inner

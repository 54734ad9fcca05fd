// All chosen numbers of this folder, grouped by the file that uses them.
//
// The lines say what happened with half or twice the value, or with other values. They were tried at edges of 3 to 4 %
// of the box on a cow, a figure of eight, an elephant, a triceratops, and a blob of three pieces with borders. Their
// quads were more irregular before evening out than the quads of the room `quads`. "Box" means the diagonal of the
// bounding box. Distances are Hausdorff distances in % of the box, unless they are called mean. Aspects and angles are
// 95 % quantiles. "Irregular" is the share of irregular vertices. Where some results got better and others worse, the
// distance changed by at most 0.3. These numbers decide about whole faces, so rounding alone can change the number of
// faces by 1.4 %.
#pragma once
#include <cstddef>
#include <cstdint>

namespace hf_inner::remesh {

// --- intake.cpp ---

// Lines of a flow, as hf/quads.h states it. It refuses other numbers in the place of counts; api_bad_quads_test tries
// more. No result depends on it.
constexpr std::uint32_t most_streamlines = 1000000;

// --- flux_field.cpp ---

// Keeps the flux between equal values positive. It is near the smallest double, so it does not change other fluxes.
constexpr double least_flux = 1e-300;
// A rest of flux below this share of the flux into a vertex counts as used up: a few units of rounding.
constexpr double least_segment = 1e-15;

// --- relax.cpp ---

// A vertex moves by this share of the way to its proposed place. Below 1 it does not swing to and fro. 0.25 and 1
// improve some meshes and worsen others.
constexpr double relax_step = 0.5;
// Sizes of quads move by this share of the way to the wanted edge length. 0.25 improves some meshes and worsens others.
// At 1 a cow has 33 % irregular vertices instead of 30.
constexpr double size_step = 0.5;
// A walk along the surface crosses at most this many edges. With 50 and 800 no test mesh changes.
constexpr int most_crossings = 200;

// --- unfold.cpp ---
//
// Chosen on triceratops, mpi_triang, man, anchor, skull and boot at 5,000 quads. They have 1 to 72 turned corners
// before.

// On all six together, 2 corners stay turned over, and 102 quads run through others.

// Corners count as unfolded from this sine on. Larger moves more vertices. With half and double the turned corners are
// the same, and 106 and 101 quads run through others.
constexpr double unfold_margin = 0.1;
// It bounds the time. Half and double give the same figures.
constexpr std::int32_t unfold_rounds = 20;
// A vertex tries places this far away, in edge lengths, then half as far, down to the least. Longer steps unfold more
// and make more quads run through others: 99 with half, 109 with double, 150 with four times.
constexpr double unfold_reach = 0.2;
// Half gives 2 and 101, double the same.
constexpr double unfold_least = 0.02;
// How often vertices go back near places that are too far from the surface. Each time one more ring goes back; at last
// all vertices do. Half and double give the same figures.
constexpr std::int32_t unfold_returns = 4;
// A place lies on the border, or at its vertex, if the weights of the other corners are below this: rounding.
constexpr double on_border = 1e-9;
// Vertices on borders slide along them as far as the cosine of the border's turn stays above this: 18 degrees. More
// rounds the border off, less keeps vertices where they are. On b9, blobby, the elephant and the plane with holes 18
// corners stay turned over at 5,000 quads. With 13 degrees it is 19, with 26 it is 18.
constexpr double straight_border = 0.95;
// They keep at least this share of an edge, or of the old distance, from the other corners of their quads: else edges
// would vanish. With half 18 corners stay turned over there, with double 19.
constexpr double unfold_apart = 0.25;

// --- quad_distance.cpp ---

// From this many vertices on, only every second is sampled, from twice as many every third; this saves time. Half,
// which samples every second vertex of an armadillo of 50,000, gives 261 faces instead of 308, at the same distance.
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
// places find more bad diagonals and take longer. Tried: the middle alone, and outer places half and 1.6 times as far
// from it. The faces and mean distances of two test meshes change by at most 3 %.
constexpr double diagonal_shares[] = {0.5, 0.25, 0.75};
// Samples and faces in one thread's job: smaller jobs cost more to hand out, larger ones leave threads idle. Half and
// double of both change the time for quads of an armadillo of 15,000 by at most 1 %.
constexpr std::int32_t samples_a_piece = 4096;
constexpr std::int32_t faces_a_piece = 512;
// The value with which the hash starts: 2^64 over the golden ratio, as in splitmix64.
constexpr std::uint64_t hash_start = 0x9e3779b97f4a7c15u;
// The multiplier that mixes the hash, the first one in the last step of MurmurHash3.
constexpr std::uint64_t hash_factor = 0xff51afd7ed558ccdu;

// --- fit.cpp ---

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
// Fitting multiplies the number of faces by at most this. 1.1 and 3 change none of six test meshes.
constexpr double fit_most_faces = 1.5;

// --- refine.cpp ---

// Factor on the wanted edge length after subdividing. With 0.5 and 1 six test meshes stay the same.
constexpr float subdivided_scale = 0.75f;
// Factor on the wanted edge length after a vertex split. With 0.75 and 1 distances to the surface are the same.
constexpr float split_scale = 0.92f;

// --- coarsen.cpp ---

// Rounds of relaxation (evening out) after quads collapse. 6 and 24 improve some meshes and worsen others.
constexpr std::int32_t collapse_relax_rounds = 12;
// Quads up to this many rows from a collapse are relaxed. 1 and 4 improve some meshes and worsen others.
constexpr std::int32_t collapse_rings = 2;
// At most this many faces at two vertices that a collapse merges; two of them vanish. With 7: up to 7 % more faces, and
// 32 % irregular vertices instead of 39. 10 gives the same meshes as 8.
constexpr std::int32_t collapse_most_faces = 8;
// To reach a number of quads, at most one in this many collapses in a round: fewer rounds against evenness. Half
// changes none of 21 runs. Double changes 7: some get better and some worse, in about the same time.
constexpr std::int32_t count_share = 12;

}  // namespace hf_inner::remesh

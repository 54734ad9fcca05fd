// The chosen numbers of the search for links. Lengths are shares of the diagonal of the box.
#pragma once
#include <cstddef>

#include "base/index.h"

namespace hf_inner {

// Pieces touch up to this distance, and then link both ways.
constexpr double touching = 0.005;
// Points of a contact cost at most this much more than the cheapest one.
constexpr double contact_depth = 0.005;
// Different skin weights count like this much more distance: all joints differ at this distance.
constexpr double skin_distance = 0.02;
// Pieces that touch but differ by more than this in their skin weights only link in the tree, unless they are as near
// as this.
constexpr double skin_difference = 0.5, crossing_pieces = 0.001;
// Points of a side that link to the other side; half as many where pieces touch outside the tree.
constexpr std::size_t links_a_side = 8;
// A light piece has at least this share of its area within the overlay distance of one larger piece, and at most this
// share of the whole area.
constexpr double light_cover = 0.5, light_area = 0.25;
// A light piece has at least this share of its area within so many overlay distances of larger pieces: what sticks out,
// such as a blade, is no sheet.
constexpr double light_near = 0.9, overlay_reach = 2;
// The tree takes a way around a sheet that is this much longer than the way through it, so that a sheet becomes a leaf.
// At 0.02 a robot of 66 pieces had tree links of 1.9 % of the box instead of 0.8, and four times the gaps.
constexpr double sheet_detour = 0.005;
// Vertices that tell whether a piece is a sheet.
constexpr std::size_t sheet_samples = 24;
// The samples are taken in so many turns over the piece: trades early ends for neighbours in memory. No link depends on
// it.
constexpr std::size_t sheet_turns = 6;
// Links of a light piece are this far apart, but there are at least links_a_side of them.
constexpr double light_spacing = 0.02;
// Candidate pairs that each piece keeps, the nearest boxes first: bounds the work on thousands of overlapping pieces.
constexpr std::size_t pairs_a_piece = 32;
// A link goes to one corner of the triangle if it is this near to the nearest point: trades fill for the place of the
// link. Chosen on a robot, a man, a spider, a frog and a model of large triangles; docs/studies/links.md has the
// figures at half, a quarter and 0.
constexpr double corner_distance = 0.02;
// A corner of less weight than this in a link is left out: the factor has fewer entries.
constexpr double least_share = 0.05;

// About so many vertices of a side are tried for links where more lie near the other piece: bounds the work on large
// contacts.
constexpr std::size_t link_candidates = 64;
// Vertices that visit the leaves of another piece together: trades tests of boxes for tests of vertices. No link
// depends on it.
constexpr Index chunk_vertices = 8;

}  // namespace hf_inner

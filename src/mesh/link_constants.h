// The chosen numbers of the search for links. Lengths are shares of the diagonal of the box.
//
// Each was tried at half and at double on six models, the choosing half of docs/links.md. Figures are means
// over them: the gap at 95 % of the contacts and the worst, in % of the box; entries of the factor against the surface
// without links; false links; light pieces. As chosen: gap .072 / .36, entries 1.190, false 0.7 %, 54 light pieces.
#pragma once
#include <cstddef>

#include "base/index.h"

namespace hf_inner::mesh {

// Joints per vertex of a given skin, as the headers state: refuses a count of another thing, such as all joints.
constexpr std::uint32_t most_skin_joints = 64;
// Pieces touch up to this distance, and then link both ways, in the tree or not. It trades links for gaps. Half: gap
// .072 / .32. Double: .072 / .35, 1.192, false 0.9 %.
constexpr double touching = 0.005;
// Points of a contact cost at most this much more than the cheapest one: a wider contact holds better and costs
// entries. Half: gap .154 / .65, entries 1.167. Double: .075 / .38, 1.210, false 1.7 %.
constexpr double contact_depth = 0.007;
// Different skin weights count like this much more distance: all joints differ at this distance. Half: false 2.4 %.
// Double: the longest link of a tree is 2.7 instead of .9 % of the box, gap .138 / .57. With a skeleton it counts once
// for each step between the joints: left and right foot are far.
constexpr double skin_distance = 0.02;
// Pieces that differ by more than this in their skin weights hinge: they link in the tree only, and near the middle of
// their contact. Half: gap .148 / .38, entries 1.150, false 0.4 %. Double, so that no pair hinges: .059 / .20, 1.225,
// false 4.5 %.
constexpr double skin_difference = 0.5;
// A link whose ends have equal skin weights is so much stronger; at skin_difference it is as strong as others. It
// trades closed pieces for bodies whose fields rigid neighbours bridge. On the choosing half of
// tests/bench/transfer_table.cpp, 90 transfers open by more than 0.5 % of the box. With 0 it is 195, with 300 93, with
// 3,000 87. A two-legged robot played on itself is 1.38 % off, and 1.03 % with 0.
constexpr double rigid_weight = 1000;
// Where a skeleton says that pieces are parent and child, they link all around: at points whose joints are at most so
// many steps apart. 1 leaves out the back of an arm, beside the joint below the chest: kk_Knight opens by 3.4 % of the
// box. Double reaches a thigh that a hand touches.
constexpr Index joint_steps = 2;
// Such links are so much stiffer: trades closed joints for pieces that bend with them. The head of kk_Knight
// that is pulled by 17 % of the box opens it by 5.2 %, with half by 5.9. With double it is 4.6, and the left hand of
// q_CyberCharacter opens by 0.74 instead of 0.54 %.
constexpr double joint_stiffness = 4;
// The depth of contacts between such pieces. Half: gap .069 / .34, entries 1.177. Double: .067 / .32, 1.192, false
// 0.9 %.
constexpr double hinge_depth = 0.0025;
// A point of a hinge may be so much farther from the middle than the nearest one, and be nearer to the other piece.
// Half: gap .072 / .36. Double: .068 / .31, entries 1.192. On two mechs, false links stay and go
// from 2.3 to 2.5 %.
constexpr double hinge_width = 0.005;
// Links of a light piece that hinges with all pieces below. No model of the six has one. On two mechs, of which false
// links are 3.0 and 1.5 %: one link 2.5 and 1.2 %, four 4.8 and 2.1 %. The gaps stay.
constexpr std::size_t light_hinge_links = 2;
// Points of a side that link to the other side; half as many where pieces touch outside the tree, and one, as stiff as
// all these, at a hinge. It trades entries for gaps. Half: .169 / .52, entries 1.150. Double: .050 / .30, 1.258.
constexpr std::size_t links_a_side = 8;
// A light piece has at least this share of its area within the overlay distance of one larger piece. Half: 52 light
// pieces. Double: 28, entries 1.222.
constexpr double light_cover = 0.5;
// A light piece has at least this share of its area within so many overlay distances of larger pieces: what sticks out,
// such as a blade, is no sheet. Half the share: the robot opens by 7.8 at worst; above 1 nothing is light. Half the
// reach: 48 light pieces, entries 1.183. Double: the robot opens by 3.5.
constexpr double light_near = 0.9;
constexpr double overlay_reach = 2;
// The tree takes a way around a sheet that is this much longer than the way through it, so that a sheet becomes a leaf.
// Half: 51 light pieces. Double: 55, and a model played on itself is 1.57 instead of 1.21 % off in the mean.
constexpr double sheet_detour = 0.005;
// Vertices that tell whether a piece is a sheet. Half: 53 light pieces, one is missed. Double: the same links.
constexpr std::size_t sheet_samples = 24;
// The samples are taken in so many turns over the piece: trades early ends for neighbours in memory. No link depends on
// it. Half: up to 0.6 % more instructions of the search on three models. Double: from 0.1 % fewer to 0.1 % more.
constexpr std::size_t sheet_turns = 6;
// Links of a light piece are this far apart, but there are at least links_a_side of them. Half: entries 1.228, the same
// gaps. Double: 1.182, the same gaps.
constexpr double light_spacing = 0.02;
// Candidate pairs that each piece keeps, the nearest boxes first: bounds the work on thousands of overlapping pieces.
// Half and double: the same links on 28 models. A quarter leaves out links of a man and a woman.
constexpr std::size_t pairs_a_piece = 32;
// A link goes to one corner of the triangle if it is this near to the nearest point: trades fill for the place of the
// link. Half: the same. Double: gap .084 / .45, on a model of large triangles.
constexpr double corner_distance = 0.06;
// The same for light pieces, whose field stays smooth. Half: entries 1.193. Double: 1.188.
constexpr double light_corner_distance = 0.02;
// A corner of less weight than this in a link is left out: the factor has fewer entries. Half: gap .071 / .35, entries
// 1.188. Double: .093 / .42.
constexpr double least_share = 0.05;
// About so many vertices of a side are tried for links where more lie near the other piece: bounds the work on large
// contacts. Half: other links on one of six models. Double: the same links. At 64 the ends of contacts were missed: a
// two-legged robot opened 1.54 instead of 1.08 %.
constexpr std::size_t link_candidates = 256;
// Vertices that are left out together where they are far from another piece: trades tests of boxes for tests of
// vertices. No link depends on it. Half: 0.4 % more instructions of the search of the robot. Double: 0.8 % more.
constexpr Index chunk_vertices = 8;

// The longest link where the caller gives none. Half leaves a mesh of three blobs apart; half and double change nothing
// on twelve shared models. Their longest is 1.1 %.
constexpr double default_link_distance = 0.05;
// How far a sheet lies from a larger piece at most, where the caller gives none. Half: 43 light pieces, entries 1.178.
// Double: 57, and the robot opens by 3.6.
constexpr double default_overlay = 0.015;
// Edges and links of a light piece count this share. A smaller one changes the field of the body less and costs digits
// of the light piece. A unit test bounds the change by 1e-4. Half and double: the same gaps.
constexpr double light_share = 1e-3;

// Where the edges at a link are longer than this, the link is stiffer in proportion: a coarse mesh opens as one of
// edges of this length does. Half: .058 / .32. Double: .091 / .42, and
// a model of 156 vertices opens by .6 instead of .4.
constexpr double spring_edge = 0.01;

}  // namespace hf_inner::mesh

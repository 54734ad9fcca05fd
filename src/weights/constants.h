// All chosen numbers of this folder, grouped by the file that uses them. Lengths are shares of the bounding box
// diagonal.
#pragma once
#include <cstddef>
#include <cstdint>

namespace hf_inner::weights {

// --- intake.cpp, carry_intake.cpp ---

// Bounds the memory of a runaway host; rigs have some hundred bones.
constexpr std::uint32_t most_bones = 1u << 20;

// --- skeleton.cpp ---

// Coordinates of bones are clamped to this many boxes, so that squares of distances stay finite. A smaller number moves
// bones that stand far off. Half and double change no figure of the 28 shared rigs, nor does 1 on seven of them.
constexpr double farthest = 1e6;
// Places along a bone that are tried until one is inside the surface: more find shorter parts inside and take longer.
// On 14 shared rigs 41 bones are outside with five places and with two, 35 with eleven.
constexpr double probed_shares[] = {0.1, 0.3, 0.5, 0.7, 0.9};
// Bones, or samples, between two looks at a cancel: at most 0.8 ms on four shared rigs, 0.1 ms and 0.02 ms. No result
// depends on it.
constexpr std::uint32_t bones_per_poll = 64, samples_per_poll = 64, filled_per_poll = 256;
// A bone shorter than this has no length: it is a point. Rounding of the caller's floats is 1e-7. A larger number takes
// short bones for points. Half and double change no figure of the 28 shared rigs, nor does 1e-2 on seven of them.
constexpr double no_length = 1e-6;
// A child lies along the axis of its parent if the cosine of the angle between is above this. At 0.95, one of 14 rigs
// (a tyrannosaur) is posed a fifth worse; exporters put such children on the axis up to rounding.
constexpr double axis_cosine = 0.99;
// Figures of the next three are means of logarithms of the 95 % distances on 14 rigs, in % of the box.
// A bone without a tail and a child ends at the skin, but is at most this many times as long as its parent. 0.7 gives
// 0.547, 1.5 and 2 give 0.482.
constexpr double leaf_length = 1.5;
// It ends at another joint that lies along its axis, up to this many lengths of its parent away. 1 gives 0.524. 3 gives
// 0.483 and joins feet with other feet. Without the rule it is 0.595.
constexpr double meet_length = 1.5;
// A joint with children, none of them along its axis, is at most this many times as long as its parent. 0.25 gives
// 0.557, 1 gives 0.488.
constexpr double hub_length = 0.5;
// It is at most this many times as far as its nearest child: a short root of a spine would lie along the whole spine.
// On the 28 shared rigs, in the mean of logarithms, 2 and 3 give 0.459. The values 1 and 4 give 0.477 and 0.460.
constexpr double hub_reach = 2;

// --- informants.cpp ---

// Strength of the screening H = strength / d^2, d the distance to the nearest bone. A larger number makes weights
// follow the nearest bone more closely. On 14 rigs, 2 and 6 pose vertices 44 % and 19 % farther from the artist's pose.
// With 3 and 5 it is 14 % and 8 %.
constexpr double screening_strength = 4;
// A distance is divided by half the cosine to the normal plus this. The excess over 1 bounds the division: a bone
// behind the skin counts 2,000 times as far. An excess of 0.5 poses the rigs 6 % worse.
constexpr double facing_excess = 1.001;
// An open piece faces its bones if this share of its vertices faces the nearest one. All of a sheet before its bones
// does, at most half of an open part of the shared bodies. A share of 0.5 takes armour on a knight for such a sheet. It
// then poses 95 % of the vertices 1.5 % farther from the artist's pose.
constexpr double front_share = 0.75;
// Bones this much farther than the nearest one inform a vertex as well. Two bones share the vertices around their
// joint, where their distances differ by rounding. Without, the rigs are posed 0.5 % worse; 1.01 is 1 % worse.
constexpr double equal_distance = 1 + 1e-4;
// At most this many bones are the constraint of one vertex: the bones of the lowest numbers. A larger number costs
// memory. Half and double change no figure of the 28 shared rigs. On seven of them, 1 poses 95 % of the vertices 13 %
// farther from the artist's pose.
constexpr std::int32_t most_informants = 8;
// A vertex on a bone has the screening of this distance. A smaller number binds such vertices more strongly, a larger
// one blurs thin parts. Half and double change no figure of the 28 shared rigs; 1e-2 poses seven of them 0.4 % farther
// from the artist's pose in the mean.
constexpr double least_distance = 1e-4;
// The mass A H of a piece is at least this share of its mean diagonal; below it, rounding would hide H. The weights
// of such a piece are nearly constant, so the factor does not show in them. Half and double change no figure of the
// 28 shared rigs; 1 poses seven of them 3.6 % farther from the artist's pose in the mean.
constexpr double least_mass = 1e-6;
// Vertices in one thread's job: some 0.2 ms.
constexpr std::size_t vertex_piece = 256;

// --- solution.cpp ---

// Edge weights of the operator are raised to this share of the mean diagonal. The first with which the matrix can be
// factorised is taken; the last is the combinatorial Laplacian. A larger share forgets the shape of the triangles. With
// half and double the first, the 28 shared rigs have the same figures. With 1e-3 first, seven of them are posed 4 %
// farther from the artist's pose in the mean. With 0.1 first they are twice as far.
constexpr double weight_floors[] = {1e-9, 1e-6, 1e-3, 1e3};
// A piece without information that is smaller than this moves rigidly: all its vertices get the same weights. A
// larger number keeps larger loose parts from bending. Half and double change no figure of the 28 shared rigs, where
// every piece has information.
constexpr double rigid_size = 0.15;

// --- piece_bones.cpp, piece_contacts.cpp, rigid_pieces.cpp ---
//
// Figures are means of logarithms of the 95 % distances on the third table of docs/weights.md, 29 models, in %
// of the box; distances below 0.001 count as 0.001. As chosen: 0.226. Without these rules: 0.814. Rows that say "from
// 0.249" were measured when two of the constants stood at their doubles.

// Places of a bone, besides its joint, that a piece may have around them: more take longer. Half gives 0.248, double
// gives 0.249, as 10 does.
constexpr int bone_places = 5;
// A piece is around a place if this many of 26 rays from it meet the piece. Fewer let a plate hold the bones beside
// it, more let an open shell hold none. From 0.249: 9 gives 0.379, 20 gives 0.252. On the first table 20 gives 0.451 in
// place of 0.395, where a jacket becomes a plate.
constexpr std::size_t around_rays = 18;
// The rays are turned off the axes by this much, since faces of models often lie along them. Half and double change
// nothing.
constexpr double piece_tilt[3] = {0.013, 0.027, -0.019};
// Places in one thread's job: some 0.2 ms.
constexpr std::size_t place_piece = 16;
// Pieces touch up to this distance. Less misses armour that floats, more takes time. From 0.249: half 0.297, double
// 0.242.
constexpr double contact_distance = 0.04;
// Contacts count by the inverse square of their distance plus this: less lets the nearest decide. From 0.249: half
// 0.249, double 0.242.
constexpr double contact_softness = 0.008;
// Pieces that a sample may touch, the nearest ones: fewer hide a piece behind another, more take time. From 0.249: 2
// gives 0.297, 8 gives 0.249.
constexpr std::size_t contacts_a_sample = 4;
// Vertices of a piece that look for others: fewer save time. From 0.249: half 0.250, double 0.239.
constexpr std::size_t piece_samples = 128;
// A piece holds a bone if this share of it is in the piece. Less counts joints that reach into their neighbours,
// more misses bones that stick out. From 0.249: 0.7 gives 0.300, double gives 0.294.
constexpr double held_share = 0.5;
// A piece that holds this many bones bends. Fewer let limbs of robots bend, more make animals robots. From 0.249: 2 and
// 4 give 0.34, 6 gives 0.386.
constexpr std::ptrdiff_t bending_bones = 3;
// A robot bends on less than this share of its area. The robots of the three tables bend on at most 0.08, with a jacket
// on 0.25. The creatures bend on at least 0.55. Half: 0.249 from 0.249, but the robot with the jacket is none. Double:
// 0.253.
constexpr double robot_bends = 0.3;
// A piece is solid if its area vectors sum to at most this share of its area. With less, robots with open parts count
// as loose triangles. With more, half shells count as solid. From 0.249: half 0.266, double 0.249.
constexpr double solid_openness = 0.25;
// A robot is solid on at least this share of its area: at least 0.73 on the robots of the three tables. From 0.249:
// half 0.249, 0.75 gives 0.266.
constexpr double robot_solid = 0.5;
// A piece of a robot takes a bone of which it has this share. Less takes the parent for the part at a joint, more
// leaves limbs to their neighbours. 0.2 gives 0.450; 0.3 and 0.6 change nothing.
constexpr double owned_share = 0.4;
// Or it takes the bone whose joint is this near to its middle, as a share of its own box: a ball in a joint. 0.1 gives
// 0.240 in place of 0.249, 0.4 gives 0.297.
constexpr double joint_reach = 0.15;
// On creatures, pieces below this share of the box may take one bone: more stiffens loose fins. From 0.249: half
// 0.266, double 0.249.
constexpr double small_piece = 0.3;
// They do if one bone has this share of the weights around and of their own weights. Less stiffens what bends, more
// leaves eyes and buttons smooth. From 0.249: 0.3 gives 0.253, 0.7 gives 0.271; never gives 0.284.
constexpr double clear_share = 0.6;
// Sums of weights that differ by less than this are equal; the bone with the larger own weight is taken. It is above
// the rounding of sums. More lets own weights decide against clear contacts.
constexpr double equal_sums = 1e-9;
// Largest own weights that a piece remembers: more cost memory. Half and double change nothing.
constexpr std::size_t kept_shares = 4;

// --- pins.cpp ---

// The field of a bone is corrected at the pins if it misses one of their weights by more than this. Weights below 0.025
// are dropped at the end, so a larger number would show, a smaller one costs time. With ten pins on four shared rigs,
// half, double and 1e-2 leave the same distances.
constexpr double pin_tolerance = 1e-5;

// --- prune.cpp ---

// Weights up to the first number become 0, weights from the second number on stay, and a line leads from one to the
// other. Without, the mean distance to the artist's pose is 7 % larger; at 0.05 and 0.1 it is as it is.
constexpr double drop_below = 0.025, keep_above = 0.05;

// --- carry.cpp ---

// A vertex matches a point of the other surface within this distance, and if the angle between their normals is at most
// this many radians (30 degrees). The published values.
constexpr double carry_distance = 0.05, carry_angle = 0.5235987755982988;
// An angle of the caller is at most pi, with some room for rounding; hf/weights.h says up to 3.15. From any_angle on,
// which is below pi, normals do not count. On 20 mirrored rigs the slack changes nothing.
constexpr double most_angle = 3.15, any_angle = 3.14;
// A cosine this much below the one of the angle still matches: normals that are equal up to rounding do at angle 0. It
// is above the rounding of a cosine; 0 and 1e-9 change nothing on 20 mirrored rigs.
constexpr double equal_cosine = 1e-12;

// --- mirror.cpp, mirror_plane.cpp, mirror_bones.cpp ---
//
// The figures come from ten shared rigs, mirrored to one side, whose joints lost their names. There are 20 runs: each
// rig as it is, and with vertices moved by up to 0.4 % of the box, so that no plane is exact. Distances are measured
// from posed vertices to the poses of the file, in % of the box, the mean over the vertices. "Named" are 16 rigs as
// they are.

// A vertex this near to the plane belongs to both sides: less takes a seam for a side, more merges sides. Exporters
// round coordinates to 1e-7. Half and double change the vertices of 5 and 6 of 20 runs, no distance by more than 0.003.
constexpr double mirror_seam = 1e-4;
// A normal within this sine of an axis of the frame becomes that axis: models are built along axes, and more would bend
// a plane that is not. Half is the same on 20 runs, double changes two distances by 0.001. Named, double brings a
// knight from 0.075 to 0.041.
constexpr double axis_slack = 1e-3;
// A pair of bones counts for the plane if they are at least this far apart: less lets rounding turn it, more wastes
// pairs. Named, half, double and 0.03 change nothing.
constexpr double paired_apart = 1e-3;
// The plane of the bones counts if their reflections are within this distance of their partners, in the mean. Rigs in
// their bind pose are within 0.01; a pose is farther off, and the surface decides. Named, half and double change
// nothing.
constexpr double bones_mirror = 0.03;
// A bone without a partner by name takes a bone within this distance of its reflection: less leaves bones alone, more
// may pair strangers. Half leaves 6 bones of a knight alone, 0.97 instead of 0.04. Double pairs the last 4 bones of a
// manta ray, 0.02 instead of 1.83; the other 18 runs stay the same.
constexpr double paired_off = 0.02;
// Vertices that say how well a plane reflects the surface. More cost time: 6 planes, 8 steps and a search for each.
// Half changes four of 20 runs by at most 0.002, double one by 0.001.
constexpr std::size_t most_mirror_samples = 1000;
// Steps that bring a plane nearer at most; the gain ends them earlier. Half and double give the same 20 runs.
constexpr int mirror_steps = 8;
// Points farther than this from the surface do not pull the plane: less ignores what could be mirrored better, more
// lets a weapon in one hand pull. Half and double change one of 20 runs, from 0.003 to 0.002 and 0.009.
constexpr double mirror_outlier = 0.05;
// A step, or another plane, must lower the mean distance to this share: less stops early, more follows noise. Half
// raises a fox with moved vertices from 0.056 to 0.081. At 1 a robot with moved vertices has 0.012 instead of 0.041. A
// frog has 0.037 instead of 0.033. The other 17 runs change by at most 0.006.
constexpr double mirror_gain = 0.95;

}  // namespace hf_inner::weights

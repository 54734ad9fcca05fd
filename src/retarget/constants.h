// All chosen numbers of this folder. Lengths are shares of the leg, from hip to sole, if nothing else is said.
#pragma once
#include <cstddef>

namespace hf_inner::retarget {

// A joint of a limb that bends by more than this cosine's angle at rest (20 degrees) ends a segment. Straighter ones
// halve a bone, as twist joints in the chain do. Elbows of people at rest bend less: then the middle joint counts.
constexpr double segment_bend = 0.94;
// The plane in which a limb bends at rest counts in full above this share of its length, and not at all below the
// other.
constexpr double bend_seen = 0.1, bend_unseen = 0.04;
// A leg that lies within this sine of the direction of its foot, as on a chair, does not say where its knee bends.
constexpr double hinge_seen = 0.5;
// A foot is planted if its lowest point is below the first, and is free above the second. Toes of a swinging foot pass
// the ground at about the second.
constexpr double standing_height = 0.03, free_height = 0.06;
// It is planted if it is slower than the first against the ground, and is free above the second: legs a second. On
// ground that moves, shares of its speed count where they are more.
constexpr double standing_speed = 0.7, free_speed = 1.4, standing_share = 0.4, free_share = 0.6;
// A foot comes down to the sole of the source the less its turns lift it, and not at all above this. Twice as much lets
// toes that drag on the source stretch the leg of a body with shorter feet.
constexpr double free_lift = 0.15;
// Points of a sole count as low up to this above the lowest: the thickness of a shoe's edge.
constexpr double low_share = 0.01;
// A foot becomes planted, or free, within this time in seconds: two frames.
constexpr double standing_time = 0.03;
// A ground slower than this rests, in legs a second.
constexpr double least_ground_speed = 0.2;
// Velocities of soles belong together within the first, in legs a second, or this share of their own.
constexpr double velocity_radius = 0.3, velocity_share = 0.25;
// A sole in the air is no lower than the sole of the source below the first; above the second it follows the turned
// leg.
constexpr double near_height = 0.05, far_height = 0.3;
// Points of a sole share the weight of the body over this height above the lowest.
constexpr double sole_softness = 0.006;
// The offset of a foot fades in this time when the foot is free, in seconds: a third of a short swing.
constexpr double fade_time = 0.1;
// The offset of a standing foot stays below this. With half, feet of three strides slide on shorter legs: 0.13 instead
// of 0.04 boxes a second. With double they slide as little.
constexpr double most_offset = 0.3;
// A leg that was not stretched further by its turns is stretched up to the first share of its length, and softly up to
// the second.
constexpr double soft_reach = 0.985, full_reach = 0.999;
// A leg is not folded shorter than this share of its length, so that its knee does not turn round the hip.
constexpr double least_fold = 0.3;
// The hips sink at most by this, so that feet reach the ground.
constexpr double most_drop = 0.25;
// A knee keeps bending to the side of its rest by this share of the thigh.
constexpr double knee_side = 0.1;
// Sines of the angle between the axis of a knee and the line from hip to ankle. The axis counts in full above the first
// sine and not at all below the second: an axis along that line has no side.
constexpr double side_seen = 0.5, side_unseen = 0.25;
// Steps of a leg of three segments, and their damping as a share of its squared length. Eight steps meet a goal that is
// a tenth of the leg away to a thousandth.
constexpr int leg_steps = 8;
constexpr double leg_damping = 1e-4;
// Rounds of soles and legs: skin at the ankle moves with the shin, so that the lowest point is found again.
constexpr int foot_rounds = 2;
// Points that stand for a sole and for a part of the body. More change depths below a thousandth of the height.
constexpr std::size_t sole_directions = 32, part_directions = 26;
// A neck or tail turns up by no more than this, in radians; more turns a neck upside down.
constexpr double most_pitch = 1.0;
// Rounds of turning up: another point may be the lowest then.
constexpr int pitch_rounds = 3;
// Numbers of two rests are equal within this, as a share of the largest.
constexpr double same_rest = 1e-5;
// Two joints are in one place, with no bone between them, below this share of the height. Rounding of 32-bit files is a
// hundredth of it; ten times as much is a bone of a finger.
constexpr double no_length = 1e-5;
// A bone of the pelvis below the hips is no longer than this share of the height: a Biped's is 0.04.
constexpr double pelvis_bone = 0.08;
// Poses taken for equal skeletons hold rotations that differ by no more than this in a quaternion.
constexpr double same_turn = 1e-5;

}  // namespace hf_inner::retarget

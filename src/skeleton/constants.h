// All chosen numbers of this folder. Lengths are shares of the diagonal of the bounding box, if nothing else is said.
#pragma once
#include <cstddef>
#include <cstdint>

namespace hf_inner::skeleton {

// A word in more than this share of the names is a prefix or a suffix and says nothing (mixamorig, Bip01, _jnt).
constexpr double common_word = 0.8;
// A joint nearer to the plane of symmetry than this is central.
constexpr double central = 0.02;
// Joints nearer than this are in one place.
constexpr double one_place = 0.1 * central;
// A mirrored joint is found within this.
constexpr double mirrored = 0.04;
// A side axis with a larger cosine to a coordinate axis is that axis: 14 degrees.
constexpr double snapped = 0.97;
// Bones of two arms in different poses have lengths in this ratio, and arms are this long from root to end. A lower
// ratio takes a sword and a shield for arms; a higher one loses arms that were drawn by hand. Half the length takes
// pouches for arms, double loses arms that are bent at rest.
constexpr double equal_bones = 0.9, least_arm = 0.08;
// A plane of symmetry that is so little better than the next is not sure.
constexpr double unsure = 0.1;
// A limb stands if its lowest vertex is within this of the ground, as a share of the height.
constexpr double standing = 0.06;
// A limb ends, in a hand or a paw, where the second child is at least this long against the first.
constexpr double branching = 0.5;
// The foot of a leg is its last joint below this share of the height of the hip.
constexpr double ankle_height = 0.5;
// A leg begins with a bone of the hips if that is shorter than this share of the next (a thigh's twist bones are a
// third), or if it drops by less than this share of its length: 20 degrees; thighs of stout bodies drop by 70.
constexpr double hip_stub = 0.15, level_bone = 0.35;
// Feet so far from the box of the surface are not under it: a robe ends at half of it.
constexpr double far_from_surface = 0.25;
// A joint on the way to the head that lies lower than the shoulders by more than this share of the height is no neck.
// On 47 upright bodies each neck lies above them, and the chest of a man of boxes lies .14 below.
constexpr double below_shoulders = 0.1;
// The trunk is upright above this cosine of hips to head against up.
constexpr double upright_trunk = 0.6;
// A clip that leads less far leads nowhere.
constexpr double travelled = 0.2;
// If no up is declared, +y and +z get this much more than other axes: half as much as known legs give.
constexpr double customary_up = 0.5;

// Bounds on work, which no character of ours comes near. Four counts. Samples of the skin that are reflected. Vertices
// among which they are sought. Joints that vote for a plane where there are four times as many. Joints that are tested
// for being inside.
constexpr std::size_t skin_samples = 1000, skin_targets = 30000, plane_voters = 60, inside_tests = 64;
constexpr std::uint32_t most_joints = 1u << 16;

}  // namespace hf_inner::skeleton

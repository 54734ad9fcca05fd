// Transforms of joints at rest, and the surface of a skin in that pose.
#pragma once
#include "base/vec3.h"
#include "skeleton/character.h"

namespace hf_inner::skeleton {

// An affine map: the images of the axes, and of the origin.
struct Transform {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin;
  Vec3 turned(Vec3 v) const noexcept { return v.x * x + v.y * y + v.z * z; }
  Transform operator*(const Transform& other) const noexcept {
    return {turned(other.x), turned(other.y), turned(other.z), turned(other.origin) + origin};
  }
};

// Reads the rest transform of a joint relative to its parent. Throws HF_ERROR_NON_FINITE, or HF_ERROR_INVALID_ARGUMENT
// for a rotation of length 0 (index: joint).
Transform local_transform(const CharacterInput& in, std::size_t joint);

// Moves the vertices of a skin from the pose of the inverse binds to the pose `rest`:
//
//     p' = sum_j w_j G_j B_j p / sum_j w_j
//
// with the rest transforms G_j of the joints in the space of the roots, and their inverse binds B_j. A joint without
// one counts nothing, and a vertex without such a joint stays. Joints in a circle move nothing: know_character refuses
// them. Throws HF_ERROR_NON_FINITE (index: vertex) as well.
void pose_skin_at_rest(const CharacterInput& in, Vector<double>& positions, Memory& memory);

}  // namespace hf_inner::skeleton

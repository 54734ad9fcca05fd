#include "skeleton/rest_transforms.h"

#include <cmath>

#include "base/error.h"
#include "base/index.h"

namespace hf_inner::skeleton {
namespace {

// The transforms of all joints in the space of the roots. Empty: joints in a circle.
Vector<Transform> rest_transforms(const CharacterInput& in, Memory& memory) {
  const std::size_t n = in.joint_count;
  Vector<Transform> out(n, &memory);
  Vector<std::uint8_t> known(n, 0, &memory);
  Vector<std::size_t> above(&memory);
  for (std::size_t j = 0; j < n; ++j) {
    above.clear();
    for (Index k = static_cast<Index>(j); k >= 0 && !known[at(k)]; k = in.parents[at(k)]) {
      if (above.size() == n) return Vector<Transform>(&memory);
      above.push_back(at(k));
    }
    while (!above.empty()) {
      const std::size_t k = above.back();
      above.pop_back();
      const Index parent = in.parents[k];
      out[k] = parent < 0 ? local_transform(in, k) : out[at(parent)] * local_transform(in, k);
      known[k] = 1;
    }
  }
  return out;
}

}  // namespace

Transform local_transform(const CharacterInput& in, std::size_t joint) {
  const std::size_t size = in.matrices ? 16 : 10;
  const double* m = (in.matrices ? in.matrices : in.trs) + size * joint;
  for (std::size_t k = 0; k < size; ++k) {
    if (!std::isfinite(m[k]))
      fail(HF_ERROR_NON_FINITE, static_cast<std::uint32_t>(joint),
           "the rest transform of joint %zu has a number that is not finite", joint);
  }
  if (in.matrices) return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
  const double length = std::sqrt(m[3] * m[3] + m[4] * m[4] + m[5] * m[5] + m[6] * m[6]);
  if (!(length > 0))
    fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(joint),
         "the rotation of joint %zu is 0; give a quaternion x y z w of length 1", joint);
  const double x = m[3] / length, y = m[4] / length, z = m[5] / length, w = m[6] / length;
  return {m[7] * Vec3{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
          m[8] * Vec3{2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
          m[9] * Vec3{2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)},
          {m[0], m[1], m[2]}};
}

void pose_skin_at_rest(const CharacterInput& in, Vector<double>& positions, Memory& memory) {
  const Vector<Transform> rest = rest_transforms(in, memory);
  if (rest.empty()) return;
  Vector<Transform> moved(&memory);
  for (std::size_t j = 0; j < rest.size(); ++j) {
    const double* const m = in.inverse_binds + 16 * j;
    moved.push_back(rest[j] *
                    Transform{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}});
  }
  for (std::size_t v = 0; v < in.vertex_count; ++v) {
    double* const p = positions.data() + 3 * v;
    const Vec3 bound{p[0], p[1], p[2]};
    Vec3 sum;
    double weight = 0;
    for (std::size_t k = in.influence_starts[v]; k < in.influence_starts[v + 1]; ++k) {
      const std::size_t j = in.influence_joints[k];
      if (in.bound && !in.bound[j]) continue;
      const double w = in.influence_weights[k];
      sum = sum + w * (moved[j].turned(bound) + moved[j].origin);
      weight += w;
    }
    if (!(weight > 0)) continue;
    sum = (1 / weight) * sum;
    if (!std::isfinite(sum.x + sum.y + sum.z))
      fail(HF_ERROR_NON_FINITE, static_cast<std::uint32_t>(v),
           "vertex %zu leaves the range of numbers in the pose of `rest`", v);
    p[0] = sum.x;
    p[1] = sum.y;
    p[2] = sum.z;
  }
}

}  // namespace hf_inner::skeleton

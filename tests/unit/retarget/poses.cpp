#include "poses.h"

#include "retarget/turns.h"

namespace hf_test {

using hf_inner::Vec3;
using hf_inner::retarget::Linear;
using hf_inner::retarget::Turn;

std::vector<double> rest_trs(const hf_inner::skeleton::CharacterInput& in) {
  if (in.trs) return {in.trs, in.trs + 10 * std::size_t{in.joint_count}};
  std::vector<double> out;
  for (std::size_t j = 0; j < in.joint_count; ++j) {
    const double* p = in.matrices + 16 * j;
    const Linear m{{p[0], p[1], p[2]}, {p[4], p[5], p[6]}, {p[8], p[9], p[10]}};
    const double mirror = determinant(m) < 0 ? -1 : 1;
    const Vec3 s{norm(m.x), norm(m.y), mirror * norm(m.z)};
    const Turn q = hf_inner::retarget::turn_of_frame((1 / s.x) * m.x, (1 / s.y) * m.y, (1 / s.z) * m.z);
    for (const double v : {p[12], p[13], p[14], q.x, q.y, q.z, q.w, s.x, s.y, s.z}) out.push_back(v);
  }
  return out;
}

std::vector<double> world_of(const std::vector<std::int32_t>& parents, const double* trs) {
  std::vector<double> out(12 * parents.size());
  std::vector<char> done(parents.size(), 0);
  for (std::size_t left = parents.size(); left > 0;) {
    for (std::size_t j = 0; j < parents.size(); ++j) {
      const std::int32_t p = parents[j];
      if (done[j] || (p >= 0 && !done[static_cast<std::size_t>(p)])) continue;
      const double* t = trs + 10 * j;
      Linear m = hf_inner::retarget::linear_of(Turn{t[3], t[4], t[5], t[6]}, {t[7], t[8], t[9]});
      Vec3 o{t[0], t[1], t[2]};
      if (p >= 0) {
        const double* f = &out[12 * static_cast<std::size_t>(p)];
        const Linear above{{f[0], f[1], f[2]}, {f[3], f[4], f[5]}, {f[6], f[7], f[8]}};
        m = above * m;
        o = Vec3{f[9], f[10], f[11]} + above * o;
      }
      double* w = &out[12 * j];
      for (const Vec3& column : {m.x, m.y, m.z, o}) {
        *w++ = column.x;
        *w++ = column.y;
        *w++ = column.z;
      }
      done[j] = 1;
      --left;
    }
  }
  return out;
}

}  // namespace hf_test

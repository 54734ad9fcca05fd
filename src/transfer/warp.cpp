// See warp.h.
#include "transfer/warp.h"

#include <algorithm>
#include <cmath>

#include "base/index.h"
#include "transfer/constants.h"

namespace hf_inner::transfer {

// Solves [-R + ridge, P; P', -affine_ridge] [a; b] = [d; 0] by elimination with row pivots; R holds the distances, P
// the places and ones. It is written by hand, because the size is known at run time only.
void Warp::fit(Span<const Vec3> from, Span<const Vec3> to, double ridge) {
  const std::size_t k = from.size(), n = k + 4;
  centre_.assign(from.begin(), from.end());
  Vector<double> m(n * n, 0.0, &memory_);
  Vector<Vec3> x(n, Vec3(), &memory_);
  for (std::size_t i = 0; i < k; ++i) {
    for (std::size_t j = 0; j < k; ++j) m[i * n + j] = -norm(from[i] - from[j]);
    m[i * n + i] += ridge;
    const double place[4] = {from[i].x, from[i].y, from[i].z, 1};
    for (std::size_t c = 0; c < 4; ++c) m[i * n + k + c] = m[(k + c) * n + i] = place[c];
    x[i] = to[i] - from[i];
  }
  for (std::size_t c = 0; c < 4; ++c) m[(k + c) * n + k + c] = -affine_ridge;
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r < n; ++r)
      if (std::abs(m[r * n + c]) > std::abs(m[pivot * n + c])) pivot = r;
    if (pivot != c) {
      std::swap_ranges(m.begin() + static_cast<std::ptrdiff_t>(c * n),
                       m.begin() + static_cast<std::ptrdiff_t>(c * n + n),
                       m.begin() + static_cast<std::ptrdiff_t>(pivot * n));
      std::swap(x[c], x[pivot]);
    }
    for (std::size_t r = c + 1; r < n; ++r) {
      const double f = m[r * n + c] / m[c * n + c];
      if (f == 0) continue;
      for (std::size_t j = c + 1; j < n; ++j) m[r * n + j] -= f * m[c * n + j];
      x[r] = x[r] - f * x[c];
    }
  }
  for (std::size_t r = n; r-- > 0;) {
    for (std::size_t j = r + 1; j < n; ++j) x[r] = x[r] - m[r * n + j] * x[j];
    x[r] = (1 / m[r * n + r]) * x[r];
  }
  weight_.assign(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(k));
  for (std::size_t c = 0; c < 4; ++c) affine_[c] = x[k + c];
}

Vec3 Warp::operator()(Vec3 x) const noexcept {
  Vec3 sum = affine_[3] + x.x * affine_[0] + x.y * affine_[1] + x.z * affine_[2];
  for (std::size_t i = 0; i < centre_.size(); ++i) sum = sum - norm(x - centre_[i]) * weight_[i];
  return x + sum;
}

}  // namespace hf_inner::transfer

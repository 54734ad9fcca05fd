#include "deform/crossfade.h"

#include <algorithm>

#include "deform/rest.h"

namespace hf_inner::deform {
namespace {

double way(const RigidMotion& from, const RigidMotion& to) noexcept {
  return norm(to.translation - from.translation) + crossfade_turn * angle_between(from.rotation, to.rotation);
}

}  // namespace

double largest_way(Span<const RigidMotion> from, Span<const RigidMotion> to) noexcept {
  double largest = 0;
  for (std::size_t i = 0; i < from.size(); ++i) largest = std::max(largest, way(from[i], to[i]));
  return largest;
}

double way_from_rest(Span<const RigidMotion> placed) noexcept {
  double largest = 0;
  for (const RigidMotion& motion : placed) largest = std::max(largest, way(RigidMotion(), motion));
  return largest;
}

double share_left(const Crossfade& crossfade, Span<const RigidMotion> now) noexcept {
  const double left = 1 - largest_way(crossfade.placed, now) / crossfade_reach;
  if (!(left > 0)) return 0;
  if (!(crossfade.from_rest > 0)) return left * left;
  return left * left * std::min(1.0, way_from_rest(now) / crossfade.from_rest);
}

void add_crossfade(const Crossfade& crossfade, double share, Vec3* positions, JobRunner& jobs) {
  const std::int32_t count = static_cast<std::int32_t>(crossfade.offset.size() / 3);
  for_vertex_pieces(jobs, count, [&](std::int32_t first, std::int32_t last) {
    for (std::int32_t v = first; v < last; ++v) {
      const float* d = crossfade.offset.data() + 3 * static_cast<std::size_t>(v);
      positions[v] = positions[v] + share * Vec3{d[0], d[1], d[2]};
    }
  });
}

}  // namespace hf_inner::deform

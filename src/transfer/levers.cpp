// See levers.h.
#include "transfer/levers.h"

#include <algorithm>

#include "base/elementary.h"
#include "base/index.h"
#include "transfer/constants.h"
#include "transfer/prepared.h"

namespace hf_inner::transfer {
namespace {

// The turn q, of which a part of the share `follow` is taken. whole: from 0 to 1, from that part to q.
deform::Quaternion part_of(const deform::Quaternion& q, double follow, double whole) noexcept {
  const Vec3 turn = deform::logarithm(q);
  const double angle = norm(turn);
  if (!(angle > 0)) return q;
  const double less =
      follow >= 0.5 ? angle - (1 - follow) * sine(angle) : follow * (4.0 / 3 * sine(angle) - sine(2 * angle) / 6);
  return deform::exponential(((less + whole * (angle - less)) / angle) * turn);
}

}  // namespace

double counted_ratio(double ratio, double from, double to) noexcept {
  return ratio > 1 ? 1 + (ratio - 1) * smooth_step(from, to, ratio) : 1.0;
}

void Levers::prepare(const Overlaps& from, const Overlaps& to, Span<const double> limb, Span<const double> outer,
                     Span<const double> ends, double scale, Vec3 centre, Memory& memory) {
  const std::size_t count = limb.size();
  follow_.assign(count, 1.0);
  own_.assign(count, deform::Quaternion());
  bent_.assign(count, std::uint8_t{0});
  for (std::size_t c = 0; c < count; ++c) {
    const double wider = to.spread[c] / std::max(scale * from.spread[c], least_reach);
    if (wider > 1)
      follow_[c] =
          1 - outer[c] * (1 - 1 / wider) - (limb[c] - outer[c]) * (1 - 1 / counted_ratio(wider, wider_from, wider_to));
    if (ends[c] > 1) follow_[c] = std::min(follow_[c], 1 - limb[c] * (1 - 1 / ends[c]));
  }
  // The shortest ways (Dijkstra 1959), from the cluster that is nearest to the centre.
  order_.reserve(count);
  before_.assign(count, -1);
  Vector<double> way(count, no_height, &memory);
  Vector<std::uint8_t> done(count, std::uint8_t{0}, &memory);
  std::size_t root = 0;
  for (std::size_t c = 0; c < count; ++c)
    if (norm(to.centroid[c] - centre) < norm(to.centroid[root] - centre)) root = c;
  way[root] = 0;
  for (std::size_t step = 0; step < count; ++step) {
    std::size_t next = count;
    for (std::size_t c = 0; c < count; ++c)
      if (!done[c] && (next == count || way[c] < way[next])) next = c;
    done[next] = 1;
    order_.push_back(static_cast<std::int32_t>(next));
    if (way[next] == no_height) continue;
    for (std::size_t c = 0; c < count; ++c) {
      if (done[c] || !(to.mass[next * count + c] > least_hinge * std::min(to.own[next], to.own[c]))) continue;
      const double length = way[next] + norm(to.centroid[next] - to.centroid[c]);
      if (length < way[c]) {
        way[c] = length;
        before_[c] = static_cast<std::int32_t>(next);
      }
    }
  }
  // A cluster that belongs to no limb keeps its rotation, whatever clusters are before it.
  for (std::size_t c = 0; c < count; ++c)
    if (!(limb[c] > 0)) before_[c] = -1;
}

void Levers::turn(const deform::Quaternion& body, double whole, deform::Quaternion* rotations) noexcept {
  if (whole == 1) return;
  std::copy_n(rotations, own_.size(), own_.begin());
  for (const std::int32_t i : order_) {
    const std::size_t c = at(i);
    const bool hangs = before_[c] >= 0 && bent_[at(before_[c])];
    bent_[c] = hangs || follow_[c] < 1;
    if (!bent_[c]) continue;
    const deform::Quaternion before = before_[c] >= 0 ? own_[at(before_[c])] : body,
                             now = before_[c] >= 0 ? rotations[before_[c]] : body;
    rotations[c] = deform::normalised(now * part_of(before.conjugate() * own_[c], follow_[c], whole));
  }
}

}  // namespace hf_inner::transfer

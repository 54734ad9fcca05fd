// Brings the rests of two limbs together.
#include <algorithm>
#include <cmath>

#include "retarget/match.h"

namespace hf_inner {

std::size_t bone_count(const Segments& chain) noexcept { return chain.count() - (chain.tip.joint >= 0 ? 0 : 1); }

Vec3 segment_place(const Rig& rig, const Segments& chain, std::size_t k) noexcept {
  return k < chain.count() ? rig.rest.place[at(chain.first(k))] : rig.tip_place(chain.tip, rig.rest);
}

namespace {

Vec3 across_line(Vec3 v, Vec3 line) noexcept { return v - dot(v, line) * line; }

// Turns about the line of both chains until they bend the same way. A chain that is nearly straight has no way.
Turn bend_turn(Vec3 line, Vec3 bend, Vec3 wanted, double length) noexcept {
  const Vec3 a = across_line(bend, line), b = across_line(wanted, line);
  const double seen = std::min(norm(a), norm(b)) / length;
  const double weight = std::min(1.0, std::max(0.0, (seen - bend_unseen) / (bend_seen - bend_unseen)));
  if (!(weight > 0)) return {};
  return turn_about(line, weight * arc_tangent(dot(line, cross(a, b)), dot(a, b)));
}

}  // namespace

void align_chain(const Retargeter& r, ChainPair& pair, Aligning how, Turn before) {
  pair.align.assign(pair.target.count(), before);
  const std::size_t ns = bone_count(pair.source), nt = bone_count(pair.target);
  if (how == Aligning::none || ns == 0 || nt == 0) return;
  const bool equal = pair.source.count() == pair.target.count();
  const std::size_t bones = std::min(ns, nt);
  const auto wanted = [&](std::size_t k) { return r.across * segment_place(r.source, pair.source, k); };
  const auto own = [&](std::size_t k) { return segment_place(r.target, pair.target, k); };
  const Vec3 whole = wanted(equal ? bones : ns) - wanted(0);
  Turn turn = shortest_turn(before * (own(equal ? bones : nt) - own(0)), whole) * before;
  if (equal && bones > 1 && norm(whole) > 0) {
    const Vec3 line = unit_vector(whole);
    turn = bend_turn(line, turn * (own(1) - own(0)),
                     (norm(own(bones) - own(0)) / norm(whole)) * (wanted(1) - wanted(0)), norm(own(bones) - own(0))) *
           turn;
  }
  for (std::size_t k = 0; k < pair.target.count(); ++k) {
    if (how == Aligning::segments && equal && k < bones)
      turn = shortest_turn(turn * (own(k + 1) - own(k)), wanted(k + 1) - wanted(k)) * turn;
    pair.align[k] = turn;
  }
}

}  // namespace hf_inner

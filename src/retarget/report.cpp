// Measures how far bones of limbs point away from the bones of the source.
#include <algorithm>

#include "retarget/match.h"

namespace hf_inner::retarget {
namespace {

Vec3 bone(const Rig& rig, const Stance& stance, const Segments& chain, std::size_t k) noexcept {
  const Vec3 a = stance.place[at(chain.first(k))];
  const Vec3 b = k + 1 < chain.count() ? stance.place[at(chain.first(k + 1))] : rig.tip_place(chain.tip, stance);
  return b - a;
}

}  // namespace

void Retargeter::measure() {
  constexpr double degree = 3.14159265358979323846 / 180;
  ++report_.frames;
  const double frames = static_cast<double>(report_.frames);
  double limbs = 0, limb_count = 0;
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    ChainPair& pair = pairs[c];
    if (!pair.compared) continue;
    const std::size_t bones = std::min(bone_count(pair.source), bone_count(pair.target));
    double sum = 0;
    for (std::size_t k = 0; k < bones; ++k) {
      const Vec3 a = across * bone(source, from, pair.source, k), b = bone(target, to, pair.target, k);
      const double angle = arc_tangent(norm(cross(a, b)), dot(a, b)) / degree;
      sum += angle;
      pair.worst = std::max(pair.worst, angle);
    }
    pair.sum += sum / static_cast<double>(bones);
    report_.chains[c].mean_degrees = pair.sum / frames;
    report_.chains[c].worst_degrees = pair.worst;
    if (pair.role != skeleton::Role::arm && pair.role != skeleton::Role::leg) continue;
    limbs += report_.chains[c].mean_degrees;
    limb_count += 1;
  }
  report_.limb_degrees = limb_count > 0 ? limbs / limb_count : 0;
}

}  // namespace hf_inner::retarget

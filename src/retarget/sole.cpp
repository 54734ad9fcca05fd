#include "retarget/sole.h"

#include <algorithm>

namespace hf_inner::retarget {

double lowest(const Rig& rig, const Vector<Vec3>& points) noexcept {
  double low = 1e300;
  for (const Vec3& p : points) low = std::min(low, dot(p, rig.up));
  return low;
}

Vec3 sole_step(const Rig& rig, const Vector<Vec3>& was, const Vector<Vec3>& now, double softness) noexcept {
  const double low_was = lowest(rig, was), low_now = lowest(rig, now);
  const auto weight = [&](double above) {
    const double w = 1 / (1 + (above / softness) * (above / softness));
    return w * w;
  };
  Vec3 step_was, step_now;
  double sum_was = 0, sum_now = 0;
  for (std::size_t k = 0; k < now.size(); ++k) {
    const double a = weight(dot(was[k], rig.up) - low_was), b = weight(dot(now[k], rig.up) - low_now);
    step_was = step_was + a * (now[k] - was[k]);
    step_now = step_now + b * (now[k] - was[k]);
    sum_was += a;
    sum_now += b;
  }
  return rig.level((0.5 / sum_was) * step_was + (0.5 / sum_now) * step_now);
}

void read_sole(const RigLeg& leg, const Stance& stance, Vector<Vec3>& points) noexcept {
  for (std::size_t k = 0; k < points.size(); ++k) points[k] = leg.sole[k].at(stance);
}

double slowest_step(const Rig& rig, const Vector<Vec3>& was, const Vector<Vec3>& now, Vec3 ground,
                    double low) noexcept {
  const double height = lowest(rig, now) + low;
  double least = 1e300;
  for (std::size_t k = 0; k < now.size(); ++k) {
    if (dot(now[k], rig.up) <= height) least = std::min(least, norm(rig.level(now[k] - was[k]) - ground));
  }
  return least;
}

}  // namespace hf_inner::retarget

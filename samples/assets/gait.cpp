// Foot paths and leg inverse kinematics; see gait.h.
#include "gait.h"

#include <algorithm>
#include <cmath>

namespace samples {
namespace {

constexpr double pi = 3.14159265358979323846;

dvec3 turn_x(double angle, const dvec3& v) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {v.x, c * v.y - s * v.z, s * v.y + c * v.z};
}

dquat about(int axis, double angle) {
  dvec3 n(0);
  n[axis] = 1;
  return glm::angleAxis(angle, n);
}

double wrap(double phase) { return phase - std::floor(phase); }

// World rotations and positions of all joints while a frame is built.
struct Frame {
  std::vector<dquat> local, world;
  std::vector<dvec3> translation, position;
};

void forward(const std::vector<Joint>& joints, Frame& frame) {
  for (size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].parent < 0) {
      frame.world[j] = frame.local[j];
      frame.position[j] = frame.translation[j];
    } else {
      const size_t p = static_cast<size_t>(joints[j].parent);
      frame.world[j] = frame.world[p] * frame.local[j];
      frame.position[j] = frame.position[p] + frame.world[p] * frame.translation[j];
    }
  }
}

// Where the toe tip is, and the tilt of the foot, at the leg's own phase.
struct FootTarget {
  dvec3 tip;
  double hoof, pastern, fold;
};

FootTarget foot_target(const Gait& gait, const Leg& leg, double phase) {
  FootTarget target{leg.tip, leg.hoof(phase), leg.pastern(phase), leg.fold(phase)};
  const double travel = gait.stride * gait.duty;
  target.tip.z += leg.stance_shift;
  if (phase < gait.duty || gait.duty >= 1) {
    target.tip.z += travel * (0.5 - phase / gait.duty);
    return target;
  }
  // swing: over the ground the foot covers one stride, with speed and acceleration zero at both ends
  const double w = (phase - gait.duty) / (1 - gait.duty);
  const double over_ground = w * w * w * (10 + w * (6 * w - 15));
  target.tip.z += -0.5 * travel - gait.stride * (1 - gait.duty) * w + gait.stride * over_ground;
  target.tip.y += leg.lift * std::pow(std::sin(pi * std::pow(w, 0.85)), 1.4);
  return target;
}

// Sets the local rotations of one leg; returns by how much the target was out of reach.
double solve_leg(const std::vector<Joint>& joints, const std::vector<dvec3>& rest, const Leg& leg,
                 const FootTarget& target, Frame& frame) {
  const auto [upper, lower, cannon, pastern, hoof] = leg.joints;
  const dvec3 v1 = rest[lower] - rest[upper], v2 = rest[cannon] - rest[lower], v3 = rest[pastern] - rest[cannon];
  // the foot from the ground up
  dvec3 coffin;
  if (leg.heel_strike && target.pastern < 0) {
    const dvec3 heel = leg.heel + (target.tip - leg.tip);
    coffin = heel + turn_x(target.pastern, rest[hoof] - leg.heel);
  } else {
    coffin = target.tip + turn_x(target.hoof, rest[hoof] - leg.tip);
  }
  const dvec3 fetlock = coffin + turn_x(target.pastern, rest[pastern] - rest[hoof]);
  // lean the leg's plane sideways until its lateral offset fits
  const dvec3 reach = fetlock - frame.position[upper];
  const double lateral = v1.x + v2.x + v3.x;
  const double height = std::sqrt(std::max(reach.x * reach.x + reach.y * reach.y - lateral * lateral, 1e-12));
  const double lean = std::atan2(reach.y, reach.x) - std::atan2(-height, lateral);
  const double wanted = std::sqrt(height * height + reach.z * reach.z);
  const auto chain = [&](double phi) {
    const double a2 = leg.bend_lower * phi, a3 = a2 + leg.bend_cannon * phi + target.fold;
    return v1 + turn_x(a2, v2) + turn_x(a3, v3);
  };
  const auto span = [&](double phi) {
    const dvec3 c = chain(phi);
    return std::sqrt(c.y * c.y + c.z * c.z);
  };
  // the leg is longest at some slight extension; it shortens with flexion from there on
  double straight = -0.9;
  for (double phi = -0.9; phi < 0.6; phi += 0.01) {
    if (span(phi) > span(straight)) straight = phi;
  }
  double low = straight, high = 2.4;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (span(middle) > wanted ? low : high) = middle;
  }
  const double phi = 0.5 * (low + high);
  const dvec3 c = chain(phi);
  // rotate the chain (y, z) onto (-height, reach.z)
  const double swing = std::atan2(reach.z, -height) - std::atan2(c.z, c.y);
  const dquat plane = about(2, lean);
  const double a2 = swing + leg.bend_lower * phi, a3 = a2 + leg.bend_cannon * phi + target.fold;
  dquat world[5] = {plane * about(0, swing), plane * about(0, a2), plane * about(0, a3), about(0, target.pastern),
                    about(0, target.hoof)};
  if (lower == cannon) world[2] = world[1];
  dquat above = frame.world[static_cast<size_t>(joints[upper].parent)];
  for (size_t i = 0; i < 5; ++i) {
    if (i == 2 && lower == cannon) continue;
    frame.local[leg.joints[i]] = inverse(above) * world[i];
    above = world[i];
  }
  return std::abs(span(phi) - wanted);
}

}  // namespace

PhaseCurve::PhaseCurve(std::vector<std::pair<double, double>> knots) : knots_(std::move(knots)) {
  const size_t n = knots_.size();
  slopes_.assign(n, 0.0);
  if (n < 2) return;
  const auto secant = [&](size_t i) {
    const auto& a = knots_[i % n];
    const auto& b = knots_[(i + 1) % n];
    const double width = b.first - a.first + (i % n + 1 == n ? 1 : 0);
    return std::make_pair((b.second - a.second) / width, width);
  };
  for (size_t i = 0; i < n; ++i) {
    const auto [before, width_before] = secant(i + n - 1);
    const auto [after, width_after] = secant(i);
    if (before * after <= 0) continue;
    const double w1 = 2 * width_after + width_before, w2 = width_after + 2 * width_before;
    slopes_[i] = (w1 + w2) / (w1 / before + w2 / after);
  }
}

double PhaseCurve::operator()(double phase) const {
  const size_t n = knots_.size();
  if (n == 0) return 0;
  if (n == 1) return knots_[0].second;
  phase = wrap(phase);
  size_t i = n - 1;
  for (size_t k = 0; k + 1 < n; ++k) {
    if (phase >= knots_[k].first && phase < knots_[k + 1].first) i = k;
  }
  const size_t j = (i + 1) % n;
  const double width = knots_[j].first - knots_[i].first + (j == 0 ? 1 : 0);
  const double t = wrap(phase - knots_[i].first) / width, t2 = t * t, t3 = t2 * t;
  return knots_[i].second * (2 * t3 - 3 * t2 + 1) + width * slopes_[i] * (t3 - 2 * t2 + t) +
         knots_[j].second * (3 * t2 - 2 * t3) + width * slopes_[j] * (t3 - t2);
}

double Wave::at(double phase) const {
  return mean + first * std::sin(2 * pi * (phase + first_at)) + second * std::sin(4 * pi * (phase + second_at));
}

Clip make_clip(const std::vector<Joint>& joints, const std::vector<dvec3>& rest, const Gait& gait, double* worst_miss) {
  Clip clip;
  clip.name = gait.name;
  clip.speed = gait.stride / gait.duration;
  clip.joints.resize(joints.size());
  double worst = 0;
  std::vector<bool> turns(joints.size(), false), moves(joints.size(), false);
  for (const Wave& wave : gait.rotations) turns[wave.joint] = true;
  for (const Wave& wave : gait.translations) moves[wave.joint] = true;
  for (const Leg& leg : gait.legs) {
    for (uint32_t j : leg.joints) turns[j] = true;
  }
  std::vector<dquat> previous(joints.size(), dquat(1, 0, 0, 0));
  for (int i = 0; i <= gait.intervals; ++i) {
    const double phase = double(i % gait.intervals) / gait.intervals;
    Frame frame;
    frame.local.assign(joints.size(), dquat(1, 0, 0, 0));
    frame.world = frame.local;
    for (const Joint& j : joints) frame.translation.push_back({j.translation[0], j.translation[1], j.translation[2]});
    frame.position = frame.translation;
    for (const Wave& wave : gait.translations) frame.translation[wave.joint][wave.axis] += wave.at(phase);
    for (const Wave& wave : gait.rotations) {
      frame.local[wave.joint] = frame.local[wave.joint] * about(wave.axis, wave.at(phase));
    }
    forward(joints, frame);
    for (const Leg& leg : gait.legs) {
      const FootTarget target = foot_target(gait, leg, wrap(phase - leg.phase));
      worst = std::max(worst, solve_leg(joints, rest, leg, target, frame));
    }
    clip.times.push_back(static_cast<float>(gait.duration * i / gait.intervals));
    for (size_t j = 0; j < joints.size(); ++j) {
      JointKeys& keys = clip.joints[j];
      if (turns[j]) {
        dquat q = normalize(frame.local[j]);
        // the last key repeats the first; in between stay on one side of the double cover
        if (i > 0 && dot(q, previous[j]) < 0) q = -q;
        previous[j] = q;
        for (double x : {q.x, q.y, q.z, q.w}) keys.rotations.push_back(static_cast<float>(x));
        if (i == gait.intervals) std::copy_n(keys.rotations.begin(), 4, keys.rotations.end() - 4);
      }
      if (moves[j]) {
        for (int k = 0; k < 3; ++k) keys.translations.push_back(static_cast<float>(frame.translation[j][k]));
      }
    }
  }
  if (worst_miss) *worst_miss = worst;
  return clip;
}

}  // namespace samples

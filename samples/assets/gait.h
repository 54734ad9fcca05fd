// Looping clips from foot paths. A foot path says where the toe tip is and how the foot is tilted at every phase of the
// cycle; the leg above follows by inverse kinematics, so a planted foot does not slide.
//
// Leg: upper bone, lower bone, cannon, then a foot of two parts (pastern and hoof, or sole and toes) whose tilts are
// given. The joint between upper and lower bone flexes by b1 phi, the one below by b2 phi + k(phase): in the hind leg
// of a hoofed animal tendons couple stifle and hock (b2 = -0.85 b1), the carpus of a fore leg is locked in stance and
// folds by k in the swing, a biped's lower leg has no cannon. phi comes from the distance between hip and fetlock by
// bisection, the swing of the whole leg from the direction. Four-beat lateral walk after Hildebrand (1965): left hind,
// left fore, right hind, right fore at quarters of the cycle, each foot on the ground for more than half of it.
//
// Rotations are about x with positive = the lower end swings backwards. Failure: none; a foot that would be out of
// reach lifts, and the largest miss is reported.
#ifndef HF_SAMPLES_ASSETS_GAIT_H
#define HF_SAMPLES_ASSETS_GAIT_H

#include <array>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <utility>
#include <vector>

#include "creature.h"

namespace samples {

using glm::dquat;
using glm::dvec3;

// Periodic monotone cubic (Fritsch and Carlson 1980) through (phase, value) knots, phases ascending in [0, 1).
class PhaseCurve {
 public:
  PhaseCurve() = default;
  PhaseCurve(std::vector<std::pair<double, double>> knots);
  double operator()(double phase) const;

 private:
  std::vector<std::pair<double, double>> knots_;
  std::vector<double> slopes_;
};

struct Leg {
  std::array<uint32_t, 5> joints{};  // upper, lower, cannon, pastern, hoof; a biped repeats lower as cannon
  dvec3 tip{0};                      // toe tip on the ground in the rest pose
  double phase = 0;                  // when its stance begins
  double bend_lower = 1, bend_cannon = 0;
  double stance_shift = 0;         // centre of the stance relative to the rest position, along z
  double lift = 0.1;               // height of the swing
  PhaseCurve hoof, pastern, fold;  // tilts and k over the leg's own phase, 0 = touch down
  bool heel_strike = false;        // a foot tilted up turns about its heel instead of the tip
  dvec3 heel{0};
};

// Rotation of a joint about an axis (0 x, 1 y, 2 z): mean + first sin(2 pi (s + first_at)) + second sin(4 pi (s +
// second_at)).
struct Wave {
  uint32_t joint = 0;
  int axis = 0;
  double mean = 0, first = 0, first_at = 0, second = 0, second_at = 0;
  double at(double phase) const;
};

// The same for the translation of a joint, added to its rest translation.
struct Gait {
  std::string name;
  double duration = 1;
  double stride = 0;  // ground covered per cycle
  double duty = 0.6;  // share of the cycle a foot is down
  int intervals = 48;
  std::vector<Leg> legs;
  std::vector<Wave> rotations, translations;
};

// Samples the gait on a skeleton whose rest positions are given. worst_miss: largest distance by which a foot could not
// reach its target, may be null.
Clip make_clip(const std::vector<Joint>& joints, const std::vector<dvec3>& rest, const Gait& gait,
               double* worst_miss = nullptr);

}  // namespace samples

#endif

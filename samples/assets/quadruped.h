// Walk and idle clips shared by the four-legged creatures. The design must use the joint names of the horse.
#ifndef HF_SAMPLES_ASSETS_QUADRUPED_H
#define HF_SAMPLES_ASSETS_QUADRUPED_H

#include "creature_design.h"

namespace samples {

struct QuadrupedStyle {
  double duration = 1.12;  // seconds per cycle
  double stride = 1.60;    // metres per cycle
  double duty = 0.62;
  double front_lift = 0.11, hind_lift = 0.08;
  double front_fold = 1.0;  // carpus in the swing, radians
  double sink = 0.03;       // mean lowering of the trunk, so that the legs reach
  double bob = 0.012;
  double sway = 1.0;  // scales yaw and roll of trunk and neck
  double nod = 1.0;
  double tail = 1.0;
  double front_shift = 0.02, hind_shift = 0.06;
  dvec3 front_tip{0}, hind_tip{0};  // left toe tips, rest pose
};

// Appends the clips "walk" and "idle".
void add_quadruped_clips(Design& design, const QuadrupedStyle& style);

}  // namespace samples

#endif

// What the four-legged creatures share: joints, charts, and the clips of walking and standing.
#ifndef HF_SAMPLES_ASSETS_QUADRUPED_H
#define HF_SAMPLES_ASSETS_QUADRUPED_H

#include "creature_design.h"

namespace samples {

// Where the joints are in the rest pose, in metres; of a pair the left one (+x). The root lies at the origin.
struct QuadrupedJoints {
  dvec3 hips{0}, spine_1{0}, spine_2{0}, chest{0}, neck_1{0}, neck_2{0}, neck_3{0}, head{0}, jaw{0}, ear{0};
  dvec3 tail_1{0}, tail_2{0}, tail_3{0}, tail_4{0};
  dvec3 shoulder{0}, front_upper_leg{0}, front_lower_leg{0}, front_cannon{0}, front_pastern{0}, front_hoof{0};
  dvec3 hind_upper_leg{0}, hind_lower_leg{0}, hind_cannon{0}, hind_pastern{0}, hind_hoof{0};
};

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

// Joints by the names of QuadrupedJoints, pairs with _L and _R.
void add_quadruped_joints(Design& design, const QuadrupedJoints& at);

// UV charts of those joints; the ears are seen along `left_ear_axis`.
void add_quadruped_charts(Design& design, const dvec3& left_ear_axis);

// Appends the clips "walk" and "idle".
void add_quadruped_clips(Design& design, const QuadrupedStyle& style);

}  // namespace samples

#endif

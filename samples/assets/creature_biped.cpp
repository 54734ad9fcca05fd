// A biped: a sturdy cartoon walker of 1.75 m in shirt, shorts and shoes, arms hanging at an angle in the rest pose,
// hands with a thumb and three fingers.
#include "creature_design.h"

namespace samples {
namespace {

// Points along the left arm: t = 0 shoulder, 1 elbow, 2 wrist, 3 knuckles.
const dvec3 shoulder{0.205, 1.405, -0.015}, elbow{0.375, 1.185, -0.030}, wrist{0.535, 0.985, 0.010};
const dvec3 knuckles{0.598, 0.902, 0.028}, finger_tips{0.640, 0.835, 0.044};

void add_joints(Design& d) {
  d.add_joint("root", "", {0, 0, 0});
  d.add_joint("hips", "root", {0, 0.93, 0});
  d.add_joint("spine_1", "hips", {0, 1.04, 0});
  d.add_joint("spine_2", "spine_1", {0, 1.17, -0.01});
  d.add_joint("chest", "spine_2", {0, 1.29, -0.015});
  d.add_joint("neck", "chest", {0, 1.46, -0.015});
  d.add_joint("head", "neck", {0, 1.54, 0.005});
  d.add_pair("clavicle", "chest", {0.05, 1.42, 0});
  d.add_pair("upper_arm", "clavicle", shoulder);
  d.add_pair("lower_arm", "upper_arm", elbow);
  d.add_pair("hand", "lower_arm", wrist);
  d.add_pair("fingers", "hand", knuckles);
  d.add_pair("thumb", "hand", {0.548, 0.945, 0.052});
  d.add_pair("upper_leg", "hips", {0.100, 0.90, 0});
  d.add_pair("lower_leg", "upper_leg", {0.112, 0.49, 0.012});
  d.add_pair("foot", "lower_leg", {0.115, 0.095, -0.020});
  d.add_pair("toes", "foot", {0.125, 0.032, 0.115});
}

void add_trunk(Design& d) {
  d.flesh("hips", ellipsoid({0, 0.935, -0.005}, {0.175, 0.120, 0.130}, 0.06, {0, 0, 1}));
  d.flesh_pair("hips", ellipsoid({0.080, 0.885, -0.055}, {0.085, 0.095, 0.090}, 0.07));
  d.flesh("spine_1", capsule({0, 1.00, 0.005}, {0, 1.12, 0.005}, 0.120, 0.116, 0.09, 1.28));
  d.flesh("spine_2", capsule({0, 1.12, 0.005}, {0, 1.24, 0.000}, 0.116, 0.125, 0.09, 1.28));
  d.flesh("chest", ellipsoid({0, 1.315, -0.010}, {0.190, 0.165, 0.135}, 0.08, {0, 0, 1}));
  d.flesh_pair("chest", ellipsoid({0.080, 1.335, 0.085}, {0.085, 0.070, 0.045}, 0.07));
  d.flesh_pair("clavicle", capsule({0.040, 1.435, -0.010}, {0.165, 1.415, -0.012}, 0.060, 0.070, 0.08));
  d.flesh("neck", capsule({0, 1.42, -0.020}, {0, 1.56, 0.000}, 0.066, 0.058, 0.07));
}

void add_head(Design& d) {
  d.flesh("head", ellipsoid({0, 1.665, 0.000}, {0.094, 0.115, 0.108}, 0.05, {0, 0, 1}), 0.65);
  d.flesh("head", ellipsoid({0, 1.595, 0.045}, {0.066, 0.065, 0.062}, 0.06, {0, 0, 1}), 0.6);
  // chin, nose, brow, cheeks, eyes, ears
  d.flesh("head", ellipsoid({0, 1.557, 0.082}, {0.034, 0.026, 0.026}, 0.04), 0.55);
  d.flesh("head", capsule({0, 1.662, 0.100}, {0, 1.630, 0.122}, 0.014, 0.022, 0.025), 0.4);
  d.flesh_pair("head", ellipsoid({0.040, 1.695, 0.092}, {0.036, 0.013, 0.018}, 0.025), 0.45);
  d.flesh_pair("head", ellipsoid({0.048, 1.622, 0.072}, {0.030, 0.030, 0.030}, 0.035), 0.5);
  d.flesh_pair("head", ellipsoid({0.037, 1.668, 0.095}, {0.018, 0.018, 0.014}, 0.006), 0.33);
  d.flesh_pair("head", ellipsoid({0.097, 1.650, -0.005}, {0.014, 0.036, 0.026}, 0.015, {0.35, 0, 1}), 0.45);
  // hair
  d.flesh("head", ellipsoid({0, 1.702, -0.022}, {0.102, 0.090, 0.108}, 0.025, {0, 0, 1}), 0.65);
  d.flesh("head", ellipsoid({0.022, 1.760, 0.050}, {0.062, 0.030, 0.048}, 0.03, {0, 0, 1}), 0.6);
}

void add_arms(Design& d) {
  d.flesh_pair("upper_arm", ellipsoid({0.195, 1.395, -0.012}, {0.070, 0.075, 0.072}, 0.06), 0.85);
  d.flesh_pair("upper_arm", capsule({0.210, 1.375, -0.015}, mix(shoulder, elbow, 0.95), 0.064, 0.050, 0.05), 0.8);
  d.flesh_pair("lower_arm", capsule(elbow, mix(elbow, wrist, 0.35), 0.047, 0.050, 0.04), 0.75);
  d.flesh_pair("lower_arm", capsule(mix(elbow, wrist, 0.35), mix(elbow, wrist, 0.97), 0.050, 0.033, 0.04), 0.7);
  // the palm's normal and the way its fingers spread
  const dvec3 along = normalize(knuckles - wrist), spread = normalize(dvec3(0.10, 0.12, 1.0));
  d.flesh_pair(
      "hand",
      capsule(mix(wrist, knuckles, 0.10), mix(wrist, knuckles, 0.75), 0.042, 0.048, 0.03, 0.50, cross(along, spread)),
      0.6);
  for (int i = -1; i <= 1; ++i) {
    const dvec3 root = knuckles + 0.034 * double(i) * spread - 0.012 * along;
    const dvec3 tip = finger_tips + 0.058 * double(i) * spread - (i == 0 ? 0.0 : 0.010) * along;
    d.flesh_pair("fingers", capsule(root, tip, 0.0165, 0.0145, 0.012), 0.42);
  }
  d.flesh_pair("thumb", capsule({0.550, 0.955, 0.045}, {0.560, 0.915, 0.100}, 0.019, 0.016, 0.018), 0.42);
}

void add_legs(Design& d) {
  d.flesh_pair("upper_leg", capsule({0.098, 0.86, -0.005}, {0.110, 0.55, 0.010}, 0.098, 0.068, 0.045));
  d.flesh_pair("lower_leg", ellipsoid({0.112, 0.495, 0.018}, {0.060, 0.075, 0.060}, 0.04), 0.9);
  d.flesh_pair("lower_leg", capsule({0.112, 0.46, 0.000}, {0.113, 0.34, -0.018}, 0.058, 0.064, 0.05), 0.85);
  d.flesh_pair("lower_leg", capsule({0.113, 0.34, -0.018}, {0.115, 0.13, -0.022}, 0.064, 0.046, 0.04), 0.8);
  d.flesh_pair("foot", capsule({0.115, 0.085, -0.030}, {0.121, 0.050, 0.085}, 0.056, 0.050, 0.03, 1.05), 0.65);
  d.flesh_pair("foot", ellipsoid({0.115, 0.035, -0.055}, {0.050, 0.050, 0.055}, 0.03), 0.65);
  d.flesh_pair("toes", capsule({0.123, 0.036, 0.105}, {0.128, 0.028, 0.175}, 0.046, 0.040, 0.03, 1.25), 0.6);
}

void add_charts(Design& d) {
  d.chart({"root", "hips", "spine_1", "spine_2", "chest", "clavicle_L", "clavicle_R"}, {0, 0, 1});
  d.chart({"neck", "head"});
  d.chart_pair({"upper_arm", "lower_arm"}, {0, 0, 1});
  d.chart_pair({"hand", "fingers", "thumb"}, {0.78, 0.62, -0.1});
  d.chart_pair({"upper_leg", "lower_leg"});
  d.chart_pair({"foot", "toes"});
}

double step(double low, double high, double x) { return glm::smoothstep(low, high, x); }

dvec3 clothes(const dvec3& p, const dvec3& n) {
  const dvec3 skin(0.62, 0.33, 0.20), shirt(0.62, 0.10, 0.055), shorts(0.055, 0.10, 0.24), shoe(0.060, 0.055, 0.060);
  const dvec3 sole(0.55, 0.52, 0.47), hair(0.050, 0.026, 0.014), sock(0.66, 0.64, 0.60);
  const double x = std::abs(p.x);
  dvec3 color = skin;
  // shirt with short sleeves and collar
  const double down_arm = dot(dvec3(x, p.y, p.z) - shoulder, normalize(elbow - shoulder));
  const bool on_trunk = p.y > 0.90 && p.y < 1.53;
  const double from_neck = glm::length(glm::dvec2(x, p.z + 0.010 + 0.25 * (p.y - 1.45)));
  if (on_trunk && (x < 0.215 || down_arm < 0.16)) {
    const double sleeve = x < 0.20 && p.y < 1.30 ? 0.0 : down_arm;
    color =
        mix(color, shirt, step(0.160, 0.152, sleeve) * std::max(step(1.44, 1.43, p.y), step(0.078, 0.084, from_neck)));
    color = mix(color, shirt * 1.6, step(1.235, 1.230, p.y) * step(1.185, 1.190, p.y));
  }
  if (x < 0.24) {
    color = mix(color, shorts, step(1.005, 0.998, p.y) * step(0.555, 0.562, p.y));
    color = mix(color, dvec3(0.10, 0.06, 0.03), step(1.012, 1.006, p.y) * step(0.972, 0.978, p.y));
    color = mix(color, sock, step(0.190, 0.184, p.y));
    color = mix(color, shoe, step(0.128, 0.122, p.y));
    color = mix(color, sole, step(0.028, 0.022, p.y));
    color = mix(color, sole, step(0.150, 0.162, p.z) * step(0.10, 0.08, p.y) * 0.8);
  }
  // hair, brows, eyes, mouth
  const double hairline = p.y - (1.735 - 0.95 * std::max(0.0, 0.055 - p.z) - 0.10 * x);
  color = mix(color, hair, step(-0.006, 0.004, hairline) * step(1.575, 1.585, p.y));
  color = mix(color, hair,
              step(0.012, 0.008, std::abs(p.y - 1.700 + 3 * (x - 0.04) * (x - 0.04))) * step(0.070, 0.060, x) *
                  step(0.012, 0.018, x) * step(0.080, 0.090, p.z));
  const double white = length(dvec3(x - 0.037, p.y - 1.668, p.z - 0.100));
  color = mix(color, dvec3(0.82), step(0.0185, 0.0165, white) * step(0.098, 0.101, p.z));
  color =
      mix(color, dvec3(0.012), step(0.0095, 0.0078, length(dvec3(x - 0.036, p.y - 1.668, 0))) * step(0.09, 0.1, p.z));
  const double smile = p.y - 1.593 - 6.0 * x * x;
  color = mix(color, dvec3(0.30, 0.06, 0.05),
              step(0.0050, 0.0030, std::abs(smile)) * step(0.032, 0.027, x) * step(0.07, 0.09, p.z));
  (void)n;
  return color;
}

Leg leg_of(const Design& d, const Gait& gait, bool left, bool walking) {
  const std::string side = left ? "_L" : "_R";
  Leg leg;
  const uint32_t lower = d.joint("lower_leg" + side);
  leg.joints = {d.joint("upper_leg" + side), lower, lower, d.joint("foot" + side), d.joint("toes" + side)};
  const double mirror = left ? 1 : -1;
  leg.tip = {0.128 * mirror, 0, 0.115};  // the ball of the foot
  leg.heel = {0.115 * mirror, 0, -0.095};
  leg.heel_strike = true;
  leg.phase = left ? 0 : 0.5;
  leg.bend_lower = 1;
  leg.bend_cannon = 0;
  if (!walking) return leg;
  const double on = gait.duty, air = 1 - gait.duty;
  leg.stance_shift = 0.01;
  leg.lift = 0.075;
  // heel strike, flat, heel off over the ball, toes last
  leg.pastern = PhaseCurve({{0, -0.30},
                            {0.14 * on, 0},
                            {0.62 * on, 0},
                            {on, 0.85},
                            {on + 0.22 * air, 0.95},
                            {on + 0.65 * air, 0.10},
                            {on + 0.92 * air, -0.30}});
  leg.hoof = PhaseCurve({{0, -0.30},
                         {0.14 * on, 0},
                         {0.88 * on, 0},
                         {on, 0.22},
                         {on + 0.22 * air, 0.70},
                         {on + 0.65 * air, 0.05},
                         {on + 0.92 * air, -0.35}});
  return leg;
}

Gait walk(const Design& d) {
  Gait gait;
  gait.name = "walk";
  gait.duration = 1.05;
  gait.stride = 1.30;
  gait.duty = 0.60;
  for (bool left : {true, false}) gait.legs.push_back(leg_of(d, gait, left, true));
  const auto turn = [&](const std::string& joint, int axis, double mean, double first, double first_at,
                        double second = 0, double second_at = 0) {
    gait.rotations.push_back({d.joint(joint), axis, mean, first, first_at, second, second_at});
  };
  const double quarter = 0.25, middle = 0.5 * gait.duty;
  gait.translations.push_back({d.joint("hips"), 1, -0.035, 0, 0, 0.018, 0.125 - middle});
  gait.translations.push_back({d.joint("hips"), 0, 0, 0.018, quarter - middle, 0, 0});
  turn("hips", 1, 0, 0.10, -quarter);
  turn("hips", 2, 0, 0.045, quarter - middle);
  turn("hips", 0, 0.03, 0, 0);
  turn("spine_1", 1, 0, -0.08, -quarter);
  turn("spine_1", 2, 0, -0.035, quarter - middle);
  turn("spine_2", 1, 0, -0.08, -quarter);
  turn("spine_2", 2, 0, -0.02, quarter - middle);
  turn("chest", 1, 0, -0.06, -quarter);
  turn("chest", 0, 0.01, 0, 0, 0.015, 0.1);
  turn("neck", 1, 0, 0.05, -quarter);
  turn("head", 1, 0, 0.06, -quarter);
  turn("head", 0, -0.03, 0, 0, -0.015, 0.1);
  // arms hang down and swing against the legs of their side
  for (bool left : {true, false}) {
    const std::string side = left ? "_L" : "_R";
    const double mirror = left ? 1 : -1, at = left ? 0 : 0.5;
    turn("clavicle" + side, 1, 0, 0.04 * mirror, at - quarter);
    turn("upper_arm" + side, 0, 0.08, 0.42, at + quarter + 0.02);
    turn("upper_arm" + side, 2, -0.46 * mirror, 0, 0);
    turn("lower_arm" + side, 0, -0.42, 0.24, at + quarter - 0.02);
    turn("hand" + side, 0, -0.05, 0.10, at + quarter - 0.08);
    turn("fingers" + side, 2, -0.30 * mirror, 0.05, at);
  }
  return gait;
}

Gait idle(const Design& d) {
  Gait gait;
  gait.name = "idle";
  gait.duration = 4;
  gait.duty = 1;
  gait.intervals = 64;
  for (bool left : {true, false}) gait.legs.push_back(leg_of(d, gait, left, false));
  const auto turn = [&](const std::string& joint, int axis, double mean, double first, double first_at,
                        double second = 0, double second_at = 0) {
    gait.rotations.push_back({d.joint(joint), axis, mean, first, first_at, second, second_at});
  };
  gait.translations.push_back({d.joint("hips"), 1, -0.014, 0, 0, 0.004, 0});
  gait.translations.push_back({d.joint("hips"), 0, 0, 0.022, 0, 0, 0});
  turn("hips", 2, 0, 0.03, 0);
  turn("spine_1", 2, 0, -0.02, 0);
  turn("spine_2", 0, 0, 0, 0, 0.012, 0.05);
  turn("chest", 0, 0, 0, 0, -0.018, 0);
  turn("chest", 1, 0, 0.05, 0.2);
  turn("neck", 1, 0, 0.12, 0.15);
  turn("head", 1, 0, 0.20, 0.12);
  turn("head", 0, 0.04, 0.05, 0.6, 0.04, 0);
  for (bool left : {true, false}) {
    const std::string side = left ? "_L" : "_R";
    const double mirror = left ? 1 : -1;
    turn("clavicle" + side, 2, 0, 0, 0, 0.03 * mirror, 0);
    turn("upper_arm" + side, 2, -0.44 * mirror, 0.02 * mirror, 0, 0.015 * mirror, 0);
    turn("upper_arm" + side, 0, 0.04, 0.03, left ? 0 : 0.3);
    turn("lower_arm" + side, 0, -0.24, 0.05, left ? 0.1 : 0.4);
    turn("fingers" + side, 2, -0.25 * mirror, 0.06, 0.3);
  }
  return gait;
}

}  // namespace

Design design_biped() {
  Design d;
  d.name = "biped";
  add_joints(d);
  add_trunk(d);
  add_head(d);
  add_arms(d);
  add_legs(d);
  add_charts(d);
  d.color = clothes;
  d.body.cut_at_ground = true;
  d.body.finish();
  d.clips.push_back(make_clip(d.joints, d.rest, walk(d)));
  d.clips.push_back(make_clip(d.joints, d.rest, idle(d)));
  return d;
}

}  // namespace samples

// A horse: slender, withers at 1.58 m, long legs, long neck and head. Proportions follow the riding-horse rule that the
// length from shoulder to buttock equals the height at the withers and two and a half heads.
#include "quadruped.h"

namespace samples {
namespace {

void add_joints(Design& d) {
  QuadrupedJoints at;
  at.hips = {0, 1.30, -0.56};
  at.spine_1 = {0, 1.30, -0.26};
  at.spine_2 = {0, 1.28, 0.06};
  at.chest = {0, 1.28, 0.34};
  at.neck_1 = {0, 1.32, 0.62};
  at.neck_2 = {0, 1.55, 0.84};
  at.neck_3 = {0, 1.75, 1.00};
  at.head = {0, 1.91, 1.12};
  at.jaw = {0, 1.76, 1.17};
  at.ear = {0.055, 1.97, 1.10};
  at.tail_1 = {0, 1.40, -0.84};
  at.tail_2 = {0, 1.27, -0.99};
  at.tail_3 = {0, 1.03, -1.06};
  at.tail_4 = {0, 0.78, -1.08};
  at.shoulder = {0.12, 1.42, 0.40};
  at.front_upper_leg = {0.165, 1.08, 0.66};
  at.front_lower_leg = {0.165, 0.92, 0.44};
  at.front_cannon = {0.155, 0.50, 0.47};
  at.front_pastern = {0.150, 0.185, 0.46};
  at.front_hoof = {0.150, 0.075, 0.525};
  at.hind_upper_leg = {0.145, 1.24, -0.56};
  at.hind_lower_leg = {0.175, 0.95, -0.34};
  at.hind_cannon = {0.150, 0.60, -0.74};
  at.hind_pastern = {0.150, 0.190, -0.70};
  at.hind_hoof = {0.150, 0.075, -0.635};
  add_quadruped_joints(d, at);
}

void add_torso(Design& d) {
  d.flesh("chest", capsule({0, 1.17, 0.46}, {0, 1.16, 0.24}, 0.300, 0.315, 0.05, 0.76));
  d.flesh("spine_2", capsule({0, 1.16, 0.22}, {0, 1.15, -0.04}, 0.315, 0.315, 0.02, 0.82));
  d.flesh("spine_1", capsule({0, 1.15, -0.05}, {0, 1.20, -0.36}, 0.314, 0.272, 0.02, 0.86));
  d.flesh("hips", capsule({0, 1.21, -0.38}, {0, 1.25, -0.62}, 0.272, 0.245, 0.02, 0.90));
  // hamstrings, from the buttock down to the gaskin
  d.flesh_pair("hind_upper_leg", capsule({0.120, 1.14, -0.72}, {0.145, 0.86, -0.575}, 0.105, 0.070, 0.10, 0.8));
  // withers, back line, croup, tail head
  d.flesh("chest", capsule({0, 1.46, 0.42}, {0, 1.40, 0.12}, 0.085, 0.08, 0.14));
  d.flesh("hips", capsule({0, 1.39, -0.45}, {0, 1.37, -0.78}, 0.12, 0.085, 0.14, 1.4));
  // breast and breast bone
  d.flesh_pair("chest", ellipsoid({0.090, 1.08, 0.68}, {0.10, 0.13, 0.12}, 0.09));
  d.flesh("chest", capsule({0, 0.98, 0.60}, {0, 0.96, 0.16}, 0.13, 0.12, 0.14));
  // shoulder blades, haunches, buttocks
  d.flesh_pair("shoulder", capsule({0.125, 1.36, 0.38}, {0.165, 1.10, 0.60}, 0.115, 0.135, 0.09, 0.62));
  d.flesh_pair("hips", ellipsoid({0.130, 1.24, -0.56}, {0.135, 0.19, 0.22}, 0.10));
  d.flesh_pair("hind_upper_leg", ellipsoid({0.115, 1.10, -0.72}, {0.11, 0.19, 0.13}, 0.10));
}

void add_head_and_neck(Design& d) {
  d.flesh("neck_1", capsule({0, 1.26, 0.52}, {0, 1.46, 0.76}, 0.255, 0.190, 0.12, 0.64));
  d.flesh("neck_2", capsule({0, 1.46, 0.76}, {0, 1.66, 0.92}, 0.190, 0.150, 0.012, 0.64));
  d.flesh("neck_3", capsule({0, 1.66, 0.92}, {0, 1.86, 1.06}, 0.150, 0.110, 0.012, 0.66));
  // throat line
  d.flesh("neck_1", capsule({0, 1.12, 0.66}, {0, 1.36, 0.87}, 0.120, 0.095, 0.06, 0.8));
  d.flesh("neck_2", capsule({0, 1.36, 0.87}, {0, 1.55, 0.99}, 0.095, 0.080, 0.03, 0.8));
  d.flesh("neck_3", capsule({0, 1.55, 0.99}, {0, 1.72, 1.09}, 0.080, 0.075, 0.03, 0.8));
  // crest with mane
  d.flesh("neck_1", capsule({0, 1.50, 0.50}, {0, 1.66, 0.70}, 0.055, 0.060, 0.07, 0.7), 0.9);
  d.flesh("neck_2", capsule({0, 1.66, 0.70}, {0, 1.82, 0.84}, 0.060, 0.060, 0.03, 0.7), 0.9);
  d.flesh("neck_3", capsule({0, 1.82, 0.84}, {0, 1.99, 1.04}, 0.060, 0.045, 0.03, 0.7), 0.8);
  // skull, nasal bone, muzzle, cheeks, chin
  d.flesh("head", ellipsoid({0, 1.86, 1.15}, {0.088, 0.105, 0.125}, 0.06, {0, -0.72, 0.69}), 0.6);
  d.flesh("head", capsule({0, 1.82, 1.22}, {0, 1.52, 1.46}, 0.090, 0.066, 0.05, 0.80), 0.55);
  d.flesh("head", ellipsoid({0, 1.465, 1.490}, {0.062, 0.068, 0.085}, 0.045, {0, -0.75, 0.66}), 0.5);
  d.flesh_pair("head", ellipsoid({0.040, 1.465, 1.530}, {0.026, 0.030, 0.036}, 0.025, {0, -0.75, 0.66}), 0.45);
  d.flesh_pair("head", ellipsoid({0.050, 1.755, 1.185}, {0.042, 0.100, 0.115}, 0.05, {0, -0.72, 0.69}), 0.6);
  d.flesh("jaw", capsule({0, 1.70, 1.20}, {0, 1.46, 1.415}, 0.068, 0.040, 0.05, 0.8), 0.55);
  d.flesh("jaw", ellipsoid({0, 1.425, 1.440}, {0.038, 0.032, 0.042}, 0.035), 0.5);
  // brows and eyes
  d.flesh_pair("head", ellipsoid({0.070, 1.825, 1.225}, {0.026, 0.028, 0.045}, 0.04, {0, -0.72, 0.69}), 0.45);
  d.flesh_pair("head", ellipsoid({0.080, 1.800, 1.232}, {0.021, 0.023, 0.027}, 0.010, {0, -0.72, 0.69}), 0.35);
  // ears, hollow side forwards
  d.flesh_pair("ear", capsule({0.052, 1.945, 1.115}, {0.068, 2.045, 1.115}, 0.034, 0.038, 0.03, 0.60, {0, 0.1, 1}),
               0.42);
  d.flesh_pair("ear", capsule({0.068, 2.045, 1.115}, {0.066, 2.150, 1.130}, 0.038, 0.013, 0.02, 0.62, {0, 0.1, 1}),
               0.30);
  // forelock
  d.flesh("head", capsule({0, 2.00, 1.08}, {0, 1.90, 1.225}, 0.040, 0.022, 0.035, 1.3), 0.6);
}

void add_legs(Design& d) {
  d.flesh_pair("front_upper_leg", capsule({0.160, 1.06, 0.60}, {0.160, 0.93, 0.47}, 0.120, 0.112, 0.08, 0.72));
  d.flesh_pair("front_lower_leg", capsule({0.160, 0.93, 0.46}, {0.155, 0.54, 0.475}, 0.100, 0.050, 0.05, 0.85), 0.8);
  d.flesh_pair("front_cannon", ellipsoid({0.155, 0.50, 0.478}, {0.052, 0.075, 0.055}, 0.03, {0, 0, 1}), 0.6);
  d.flesh_pair("front_cannon", capsule({0.154, 0.47, 0.470}, {0.150, 0.20, 0.460}, 0.041, 0.036, 0.03, 0.85), 0.6);
  d.flesh_pair("front_pastern", ellipsoid({0.150, 0.185, 0.455}, {0.043, 0.050, 0.048}, 0.025), 0.5);
  d.flesh_pair("front_pastern", capsule({0.150, 0.175, 0.465}, {0.150, 0.090, 0.515}, 0.037, 0.040, 0.03), 0.5);
  d.flesh_pair("front_hoof", capsule({0.150, 0.085, 0.522}, {0.150, 0.020, 0.545}, 0.046, 0.066, 0.02), 0.5);

  d.flesh_pair("hind_upper_leg", capsule({0.140, 1.16, -0.56}, {0.165, 0.97, -0.38}, 0.185, 0.125, 0.09, 0.68));
  d.flesh_pair("hind_lower_leg", capsule({0.165, 0.99, -0.44}, {0.152, 0.66, -0.70}, 0.130, 0.056, 0.06, 0.72), 0.8);
  d.flesh_pair("hind_cannon", ellipsoid({0.150, 0.605, -0.735}, {0.047, 0.085, 0.058}, 0.03), 0.6);
  d.flesh_pair("hind_cannon", capsule({0.151, 0.655, -0.785}, {0.151, 0.56, -0.755}, 0.028, 0.034, 0.03), 0.6);
  d.flesh_pair("hind_cannon", capsule({0.150, 0.57, -0.735}, {0.150, 0.21, -0.700}, 0.044, 0.038, 0.03, 0.85), 0.6);
  d.flesh_pair("hind_pastern", ellipsoid({0.150, 0.190, -0.705}, {0.044, 0.050, 0.050}, 0.025), 0.5);
  d.flesh_pair("hind_pastern", capsule({0.150, 0.180, -0.695}, {0.150, 0.090, -0.645}, 0.038, 0.040, 0.03), 0.5);
  d.flesh_pair("hind_hoof", capsule({0.150, 0.085, -0.638}, {0.150, 0.020, -0.615}, 0.045, 0.064, 0.02), 0.5);
}

void add_tail(Design& d) {
  d.flesh("tail_1", capsule({0, 1.385, -0.80}, {0, 1.35, -0.91}, 0.052, 0.046, 0.010), 0.7);
  d.flesh("tail_1", capsule({0, 1.35, -0.91}, {0, 1.27, -0.985}, 0.046, 0.050, 0.010), 0.7);
  d.flesh("tail_2", capsule({0, 1.27, -0.985}, {0, 1.16, -1.035}, 0.050, 0.064, 0.010), 0.8);
  d.flesh("tail_2", capsule({0, 1.16, -1.035}, {0, 1.03, -1.065}, 0.064, 0.074, 0.010), 0.8);
  d.flesh("tail_3", capsule({0, 1.03, -1.065}, {0, 0.78, -1.085}, 0.074, 0.070, 0.010), 0.8);
  d.flesh("tail_4", capsule({0, 0.78, -1.085}, {0, 0.60, -1.075}, 0.070, 0.046, 0.010), 0.8);
  d.flesh("tail_4", capsule({0, 0.60, -1.075}, {0, 0.45, -1.055}, 0.046, 0.016, 0.010), 0.8);
}

double step(double low, double high, double x) { return glm::smoothstep(low, high, x); }

// Bay: brown coat, black legs, mane, tail and muzzle.
dvec3 bay(const dvec3& p, const dvec3& n) {
  const dvec3 coat(0.27, 0.105, 0.040), belly(0.36, 0.17, 0.075), black(0.018, 0.015, 0.014), hoof(0.075, 0.062, 0.052);
  dvec3 color = mix(coat, belly, step(0.2, -0.9, n.y) * step(0.8, 1.0, p.y) * 0.7);
  color = mix(color, black, step(0.66, 0.42, p.y));
  color = mix(color, hoof, step(0.088, 0.078, p.y));
  // tail, and the crest behind the neck's upper edge
  color = mix(color, black, step(-0.86, -0.93, p.z) * step(-0.90, -0.97, p.z + 0.25 * std::max(0.0, 0.9 - p.y)));
  const double crest = p.y - (1.545 + 0.88 * (p.z - 0.50));
  color = mix(color, black,
              step(-0.035, -0.015, crest) * step(0.44, 0.50, p.z) * step(1.24, 1.16, p.z) *
                  step(0.062, 0.050, std::abs(p.x)) * step(1.30, 1.42, p.y));
  // muzzle, eyes, a white star
  color = mix(color, black, step(1.60, 1.50, p.y) * step(1.30, 1.36, p.z));
  const dvec3 eye(std::abs(p.x) - 0.092, p.y - 1.800, p.z - 1.236);
  color = mix(color, dvec3(0.006), step(0.026, 0.021, length(eye)));
  const dvec3 star(p.x, p.y - 1.80, p.z - 1.31);
  color = mix(color, dvec3(0.75, 0.72, 0.66), step(0.034, 0.026, length(star * dvec3(1.3, 0.6, 1))));
  return color;
}

}  // namespace

Design design_horse() {
  Design d;
  d.name = "horse";
  add_joints(d);
  add_torso(d);
  add_head_and_neck(d);
  add_legs(d);
  add_tail(d);
  add_quadruped_charts(d, {0.2, 0.1, 1});
  d.color = bay;
  d.body.cut_at_ground = true;
  d.body.finish();
  QuadrupedStyle style;
  style.front_tip = {0.150, 0, 0.60};
  style.hind_tip = {0.150, 0, -0.56};
  add_quadruped_clips(d, style);
  return d;
}

}  // namespace samples

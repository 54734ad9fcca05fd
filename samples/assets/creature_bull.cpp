// A bull: stocky, 1.40 m at the hump, barrel trunk on short legs, short neck, big low head with horns, thin tail with a
// tuft. Coat of a Hereford: red-brown with a white face, breast, underline, feet and tail tuft.
#include "quadruped.h"

namespace samples {
namespace {

void add_joints(Design& d) {
  QuadrupedJoints at;
  at.hips = {0, 1.02, -0.62};
  at.spine_1 = {0, 1.03, -0.32};
  at.spine_2 = {0, 1.03, 0.02};
  at.chest = {0, 1.06, 0.34};
  at.neck_1 = {0, 1.10, 0.62};
  at.neck_2 = {0, 1.13, 0.78};
  at.neck_3 = {0, 1.15, 0.92};
  at.head = {0, 1.18, 1.03};
  at.jaw = {0, 1.06, 1.10};
  at.ear = {0.13, 1.19, 1.05};
  at.tail_1 = {0, 1.20, -0.95};
  at.tail_2 = {0, 1.02, -1.08};
  at.tail_3 = {0, 0.80, -1.09};
  at.tail_4 = {0, 0.58, -1.09};
  at.shoulder = {0.15, 1.20, 0.44};
  at.front_upper_leg = {0.205, 0.86, 0.66};
  at.front_lower_leg = {0.205, 0.70, 0.45};
  at.front_cannon = {0.195, 0.38, 0.48};
  at.front_pastern = {0.190, 0.150, 0.47};
  at.front_hoof = {0.190, 0.065, 0.52};
  at.hind_upper_leg = {0.175, 0.98, -0.64};
  at.hind_lower_leg = {0.215, 0.72, -0.43};
  at.hind_cannon = {0.190, 0.46, -0.79};
  at.hind_pastern = {0.185, 0.155, -0.75};
  at.hind_hoof = {0.185, 0.065, -0.695};
  add_quadruped_joints(d, at);
}

void add_torso(Design& d) {
  d.flesh("chest", capsule({0, 0.96, 0.48}, {0, 0.94, 0.24}, 0.375, 0.395, 0.06, 0.78));
  d.flesh("spine_2", capsule({0, 0.94, 0.22}, {0, 0.91, -0.08}, 0.395, 0.395, 0.02, 0.82));
  d.flesh("spine_1", capsule({0, 0.92, -0.10}, {0, 0.94, -0.40}, 0.392, 0.352, 0.02, 0.85));
  d.flesh("hips", capsule({0, 0.95, -0.42}, {0, 0.98, -0.70}, 0.350, 0.300, 0.03, 0.86));
  // hump, loin, hook bones, tail head
  d.flesh("chest", capsule({0, 1.25, 0.50}, {0, 1.24, 0.24}, 0.155, 0.10, 0.18, 0.9));
  d.flesh("hips", capsule({0, 1.22, -0.40}, {0, 1.18, -0.88}, 0.085, 0.075, 0.15));
  d.flesh_pair("hips", ellipsoid({0.195, 1.16, -0.52}, {0.075, 0.07, 0.09}, 0.12));
  // breast, brisket, underline
  d.flesh_pair("chest", ellipsoid({0.11, 0.84, 0.74}, {0.12, 0.17, 0.13}, 0.11));
  d.flesh("chest", capsule({0, 0.78, 0.80}, {0, 0.60, 0.42}, 0.075, 0.085, 0.14, 0.8));
  // shoulder blades, haunches, hamstrings
  d.flesh_pair("shoulder", capsule({0.165, 1.14, 0.42}, {0.210, 0.88, 0.60}, 0.155, 0.165, 0.11, 0.60));
  d.flesh_pair("hips", ellipsoid({0.150, 0.98, -0.66}, {0.155, 0.20, 0.23}, 0.11));
  d.flesh_pair("hind_upper_leg", ellipsoid({0.135, 0.86, -0.82}, {0.13, 0.21, 0.13}, 0.11));
  d.flesh_pair("hind_upper_leg", capsule({0.140, 0.84, -0.82}, {0.180, 0.64, -0.68}, 0.12, 0.08, 0.10, 0.8));
}

void add_head_and_neck(Design& d) {
  d.flesh("neck_1", capsule({0, 1.03, 0.52}, {0, 1.09, 0.74}, 0.315, 0.250, 0.14, 0.72));
  d.flesh("neck_2", capsule({0, 1.09, 0.74}, {0, 1.12, 0.88}, 0.250, 0.205, 0.03, 0.74));
  d.flesh("neck_3", capsule({0, 1.12, 0.88}, {0, 1.15, 1.00}, 0.205, 0.165, 0.03, 0.78));
  d.flesh("neck_1", capsule({0, 1.30, 0.56}, {0, 1.29, 0.76}, 0.10, 0.085, 0.14));
  d.flesh("neck_2", capsule({0, 1.29, 0.76}, {0, 1.27, 0.92}, 0.085, 0.075, 0.12));
  // dewlap
  d.flesh("neck_2", capsule({0, 0.94, 0.98}, {0, 0.84, 0.86}, 0.030, 0.040, 0.09, 0.6), 0.8);
  d.flesh("neck_1", capsule({0, 0.84, 0.86}, {0, 0.70, 0.76}, 0.040, 0.045, 0.09, 0.6), 0.8);
  // skull, face, muzzle, cheeks, chin
  const dvec3 face = normalize(dvec3(0, -0.78, 0.62));
  d.flesh("head", ellipsoid({0, 1.18, 1.09}, {0.135, 0.125, 0.150}, 0.08, face), 0.65);
  d.flesh("head", capsule({0, 1.13, 1.17}, {0, 0.86, 1.365}, 0.125, 0.092, 0.06, 0.92), 0.6);
  d.flesh("head", ellipsoid({0, 0.835, 1.385}, {0.105, 0.085, 0.090}, 0.05, face), 0.55);
  d.flesh_pair("head", ellipsoid({0.060, 0.855, 1.445}, {0.034, 0.034, 0.034}, 0.03, face), 0.45);
  d.flesh_pair("head", ellipsoid({0.068, 1.05, 1.130}, {0.060, 0.110, 0.130}, 0.06, face), 0.65);
  d.flesh("jaw", capsule({0, 1.00, 1.13}, {0, 0.80, 1.30}, 0.085, 0.062, 0.06, 0.95), 0.6);
  d.flesh("jaw", ellipsoid({0, 0.775, 1.325}, {0.060, 0.045, 0.055}, 0.045), 0.55);
  // poll with a tuft, brows, eyes
  d.flesh("head", ellipsoid({0, 1.30, 1.06}, {0.100, 0.055, 0.070}, 0.06), 0.65);
  d.flesh_pair("head", ellipsoid({0.108, 1.145, 1.205}, {0.032, 0.036, 0.052}, 0.05, face), 0.5);
  d.flesh_pair("head", ellipsoid({0.128, 1.112, 1.210}, {0.022, 0.026, 0.030}, 0.010, face), 0.35);
  // horns
  d.flesh_pair("head", capsule({0.080, 1.275, 1.05}, {0.235, 1.315, 1.055}, 0.052, 0.046, 0.03), 0.55);
  d.flesh_pair("head", capsule({0.235, 1.315, 1.055}, {0.335, 1.385, 1.110}, 0.046, 0.036, 0.015), 0.5);
  d.flesh_pair("head", capsule({0.335, 1.385, 1.110}, {0.365, 1.490, 1.175}, 0.036, 0.016, 0.015), 0.45);
  // ears, sideways and a little down, hollow side forwards
  d.flesh_pair("ear", capsule({0.115, 1.200, 1.045}, {0.215, 1.180, 1.035}, 0.034, 0.050, 0.025, 0.45, {0, 0, 1}), 0.5);
  d.flesh_pair("ear", capsule({0.215, 1.180, 1.035}, {0.305, 1.140, 1.030}, 0.050, 0.018, 0.02, 0.45, {0, 0, 1}), 0.5);
}

void add_legs(Design& d) {
  d.flesh_pair("front_upper_leg", capsule({0.200, 0.84, 0.60}, {0.205, 0.70, 0.48}, 0.155, 0.135, 0.10, 0.72));
  d.flesh_pair("front_lower_leg", capsule({0.205, 0.70, 0.465}, {0.196, 0.41, 0.48}, 0.122, 0.068, 0.06, 0.88), 0.8);
  d.flesh_pair("front_cannon", ellipsoid({0.195, 0.385, 0.485}, {0.066, 0.075, 0.068}, 0.035), 0.65);
  d.flesh_pair("front_cannon", capsule({0.194, 0.36, 0.478}, {0.190, 0.17, 0.470}, 0.054, 0.047, 0.035, 0.9), 0.65);
  d.flesh_pair("front_pastern", ellipsoid({0.190, 0.150, 0.465}, {0.056, 0.055, 0.060}, 0.03), 0.55);
  d.flesh_pair("front_pastern", capsule({0.190, 0.145, 0.475}, {0.190, 0.080, 0.515}, 0.048, 0.052, 0.03), 0.55);
  d.flesh_pair("front_hoof", capsule({0.190, 0.080, 0.515}, {0.190, 0.022, 0.535}, 0.058, 0.076, 0.02, 1.08), 0.5);

  d.flesh_pair("hind_upper_leg", capsule({0.165, 0.92, -0.64}, {0.205, 0.74, -0.46}, 0.215, 0.150, 0.11, 0.68));
  d.flesh_pair("hind_lower_leg", capsule({0.205, 0.76, -0.52}, {0.191, 0.50, -0.755}, 0.150, 0.072, 0.07, 0.74), 0.8);
  d.flesh_pair("hind_cannon", ellipsoid({0.190, 0.465, -0.785}, {0.058, 0.085, 0.068}, 0.035), 0.65);
  d.flesh_pair("hind_cannon", capsule({0.190, 0.515, -0.840}, {0.190, 0.43, -0.800}, 0.032, 0.042, 0.03), 0.65);
  d.flesh_pair("hind_cannon", capsule({0.190, 0.43, -0.785}, {0.186, 0.175, -0.752}, 0.056, 0.048, 0.035, 0.9), 0.65);
  d.flesh_pair("hind_pastern", ellipsoid({0.185, 0.155, -0.755}, {0.056, 0.055, 0.060}, 0.03), 0.55);
  d.flesh_pair("hind_pastern", capsule({0.185, 0.148, -0.745}, {0.185, 0.080, -0.702}, 0.048, 0.052, 0.03), 0.55);
  d.flesh_pair("hind_hoof", capsule({0.185, 0.080, -0.700}, {0.185, 0.022, -0.680}, 0.057, 0.074, 0.02, 1.08), 0.5);
}

void add_tail(Design& d) {
  d.flesh("tail_1", capsule({0, 1.185, -0.92}, {0, 1.15, -1.02}, 0.042, 0.034, 0.06), 0.65);
  d.flesh("tail_1", capsule({0, 1.15, -1.02}, {0, 1.02, -1.085}, 0.034, 0.030, 0.05), 0.6);
  d.flesh("tail_2", capsule({0, 1.02, -1.085}, {0, 0.80, -1.095}, 0.030, 0.028, 0.04), 0.6);
  d.flesh("tail_3", capsule({0, 0.80, -1.095}, {0, 0.58, -1.095}, 0.028, 0.030, 0.04), 0.6);
  d.flesh("tail_4", capsule({0, 0.58, -1.095}, {0, 0.46, -1.095}, 0.036, 0.052, 0.05), 0.65);
  d.flesh("tail_4", capsule({0, 0.46, -1.095}, {0, 0.32, -1.085}, 0.052, 0.018, 0.05), 0.65);
}

double step(double low, double high, double x) { return glm::smoothstep(low, high, x); }

dvec3 hereford(const dvec3& p, const dvec3& n) {
  const dvec3 red(0.235, 0.062, 0.026), white(0.72, 0.67, 0.58), hoof(0.060, 0.048, 0.042), nose(0.44, 0.23, 0.19);
  const dvec3 horn(0.52, 0.44, 0.32), dark(0.05, 0.04, 0.035);
  const double x = std::abs(p.x);
  dvec3 color = red;
  // underline and breast
  const double wavy = 0.025 * std::sin(9 * p.z) + 0.015 * std::sin(23 * p.z + 4 * x);
  color = mix(color, white, step(0.62, 0.57, p.y + wavy) * step(-0.35, -0.65, n.y) * step(-0.60, -0.5, p.z));
  color = mix(color, white, step(0.62, 0.68, p.z) * step(0.92, 0.84, p.y + 0.9 * x + wavy));
  // feet, tail tuft
  color = mix(color, white, step(0.32, 0.27, p.y + wavy) * step(-0.98, -0.94, p.z));
  color = mix(color, hoof, step(0.082, 0.074, p.y) * step(-0.98, -0.94, p.z));
  color = mix(color, white, step(-0.98, -1.02, p.z) * step(0.60, 0.54, p.y));
  // face: white in front of the ears and on the poll, a red ring around the eye
  const double along = p.z - 1.03 + 0.75 * (1.18 - p.y);
  color = mix(color, white, step(0.02, 0.06, along) * step(0.96, 1.02, p.z + 0.4 * std::max(0.0, p.y - 1.2)));
  color = mix(color, red, step(0.105, 0.075, length(dvec3(x - 0.13, p.y - 1.12, p.z - 1.19))));
  color = mix(color, red, step(0.13, 0.15, x) * step(1.27, 1.24, p.y) * step(1.08, 1.065, p.z) * step(0.95, 1.0, p.z));
  color = mix(color, nose, step(0.87, 0.83, p.y - 0.35 * (p.z - 1.42)) * step(1.34, 1.39, p.z));
  color = mix(color, dark, step(0.020, 0.014, length(dvec3(x - 0.066, p.y - 0.850, (p.z - 1.470) * 0.6))));
  // horns with dark tips, eyes
  const double on_horn = step(0.125, 0.145, x) * step(1.235, 1.262, p.y) * step(0.97, 0.99, p.z);
  color = mix(color, mix(horn, dark, step(1.40, 1.50, p.y)), on_horn);
  color = mix(color, dvec3(0.006), step(0.030, 0.025, length(dvec3(x - 0.146, p.y - 1.112, p.z - 1.214))));
  return color;
}

}  // namespace

Design design_bull() {
  Design d;
  d.name = "bull";
  add_joints(d);
  add_torso(d);
  add_head_and_neck(d);
  add_legs(d);
  add_tail(d);
  add_quadruped_charts(d, {0, 0, 1});
  d.color = hereford;
  d.body.cut_at_ground = true;
  d.body.finish();
  QuadrupedStyle style;
  style.duration = 1.28;
  style.stride = 1.14;
  style.duty = 0.66;
  style.front_lift = 0.075;
  style.hind_lift = 0.06;
  style.front_fold = 0.85;
  style.sink = 0.028;
  style.bob = 0.010;
  style.sway = 1.25;
  style.nod = 0.8;
  style.tail = 1.3;
  style.front_shift = 0.02;
  style.hind_shift = 0.07;
  style.front_tip = {0.190, 0, 0.605};
  style.hind_tip = {0.185, 0, -0.612};
  add_quadruped_clips(d, style);
  return d;
}

}  // namespace samples

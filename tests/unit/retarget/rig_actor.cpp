#include "rig_actor.h"

#include <algorithm>
#include <cmath>

#include "poses.h"
#include "retarget/turns.h"

namespace hf_test {

using hf_inner::retarget::Turn;

namespace {

constexpr double degree = 3.14159265358979323846 / 180;

Turn about(Vec3 axis, double degrees) { return hf_inner::retarget::turn_about(axis, degree * degrees); }
constexpr Vec3 x_axis{1, 0, 0}, y_axis{0, 1, 0}, z_axis{0, 0, 1};

Turn mirror(Turn q) { return {q.x, -q.y, -q.z, q.w}; }

// What the parts of the body do, as rotations since the T pose. Left side; phase shifts the right one.
struct Motion {
  double t;
  double wave(double phase) const { return std::sin(6 * t + phase); }
  Turn hips() const { return about(y_axis, 8 * wave(0.3)) * about(x_axis, 4 * wave(1)); }
  Turn spine(double share) const { return hips() * about(y_axis, -20 * share * wave(0.3)) * about(x_axis, 12 * share); }
  Turn neck() const { return spine(1) * about(x_axis, -6.0); }
  Turn head() const { return spine(1) * about(y_axis, 25 * wave(2)); }
  Turn collar(double s) const { return spine(1) * about(z_axis, s * 6 * wave(s)); }
  Turn arm(double s) const {
    return spine(1) * about(z_axis, s * (-50 + 30 * wave(0.5 * s))) * about(y_axis, s * 25 * wave(1.7 * s)) *
           about(x_axis, 20 * wave(s));
  }
  Turn forearm(double s) const { return arm(s) * about(y_axis, -s * (45 + 35 * wave(1.1 * s))); }
  Turn hand(double s) const { return forearm(s) * about(x_axis, 25 * wave(0.4 * s)) * about(z_axis, 15.0 * s); }
  Turn finger(double s, int piece) const { return hand(s) * about(z_axis, -s * 25.0 * (piece + 1)); }
  Turn thigh(double s) const { return hips() * about(x_axis, -18 + 28 * s * wave(0)) * about(z_axis, s * 6.0); }
  Turn shin(double s) const { return thigh(s) * about(x_axis, 30 + 25 * s * wave(1.4)); }
  Turn foot(double s) const { return about(x_axis, 14 * s * wave(0.7)) * about(y_axis, 10 * s); }
};

bool is_thigh(const Rig& t_rig, std::size_t joint, double leg) {
  return t_rig.joints[joint].pivot.y > 0.5 * leg + 1e-6;
}

}  // namespace

struct RigActor::Frame {
  Turn since_t;  // what its part does
  Turn rest;     // what the rest turned it by, from the T pose
};

RigActor::RigActor(const std::string& convention, const BodyShape& shape, const Placing& placing)
    : shape_(shape), convention_(convention), placing_(placing) {
  BodyShape t_shape = shape;
  t_shape.rest = Rest::t;
  rig_ = std::make_unique<Rig>(make_biped(convention, shape));
  t_rig_ = std::make_unique<Rig>(make_biped(convention, t_shape));
  placed_ = std::make_unique<PlacedRig>(*rig_, placing);
  input_ = placed_->input();
  character_ = std::make_unique<hf_inner::skeleton::Character>(hf_inner::skeleton::know_character(input_, memory_));
  const auto& joints = t_rig_->joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    int carrier = joints[j].parent;
    if (joints[j].role == Role::foot && (carrier < 0 || joints[static_cast<std::size_t>(carrier)].helper)) {
      for (std::size_t k = 0; k < joints.size(); ++k) {
        if (joints[k].role == Role::leg && joints[k].side == joints[j].side &&
            (carrier < 0 || joints[static_cast<std::size_t>(carrier)].helper ||
             joints[k].pivot.y < joints[static_cast<std::size_t>(carrier)].pivot.y))
          carrier = static_cast<int>(k);
      }
    }
    carriers_.push_back(carrier);
    // Spine joints turn by their share of the way from the first to the chest.
    const double hip = 0.95 * shape.leg;
    const double share =
        joints[j].role == Role::spine ? (joints[j].pivot.y - hip - 0.12) / 0.36 + 1.0 / shape.spine : 0;
    spine_shares_.push_back(joints[j].pivot.y < hip + 0.11 ? -1 : share);
  }
  rest_ground_ = 1e300;
  for (const Vec3& p : rig_->points) rest_ground_ = std::min(rest_ground_, p.y);
}

RigActor::Frame RigActor::frame_of(std::size_t joint, double time, bool mirrored) const {
  const RigJoint* j = &t_rig_->joints[joint];
  std::size_t at = joint;
  while (j->helper || !j->judged) {  // it goes with what carries it
    if (j->parent < 0) return {};
    at = static_cast<std::size_t>(j->parent);
    j = &t_rig_->joints[at];
  }
  const double side = j->side == Side::middle ? 0 : j->side == Side::left ? 1 : -1;
  // The right side does what the left does, mirrored and at another time: s is +1 for the left one of the motion.
  const double s = mirrored ? -side : side;
  const Motion m{time};
  Frame out;
  const double rest_angle = shape_.rest == Rest::t ? 0 : shape_.rest == Rest::a ? -45 : -70;
  const bool crouched = shape_.rest == Rest::crouched && convention_ != "quaternius";
  int piece = 0;
  switch (j->role) {
    case Role::spine:
      out.since_t = spine_shares_[at] < 0 ? m.hips() : m.spine(spine_shares_[at]);
      break;
    case Role::neck:
      out.since_t = m.neck();
      break;
    case Role::shoulder:
      out.since_t = j->pivot.y < shape_.leg ? m.hips() : m.collar(s);
      break;
    case Role::arm:
    case Role::hand:
    case Role::finger: {
      const double elbow = 0.19 + 0.27 * shape_.arm;
      for (int p = j->parent;
           j->role == Role::finger && t_rig_->joints[static_cast<std::size_t>(p)].role == Role::finger;
           p = t_rig_->joints[static_cast<std::size_t>(p)].parent)
        ++piece;
      out.since_t = j->role == Role::finger                ? m.finger(s, piece)
                    : j->role == Role::hand                ? m.hand(s)
                    : std::fabs(j->pivot.x) > elbow - 1e-6 ? m.forearm(s)
                                                           : m.arm(s);
      out.rest = about(z_axis, side * rest_angle);
      break;
    }
    case Role::leg: {
      const bool thigh = is_thigh(*t_rig_, at, shape_.leg);
      out.since_t = thigh ? m.thigh(s) : m.shin(s);
      if (crouched) out.rest = about(x_axis, thigh ? -50 : 25);
      break;
    }
    case Role::foot:
    case Role::toe:
      out.since_t = m.foot(s);
      break;
    case Role::other:
      break;
    default:
      out.since_t = m.head();
  }
  if (mirrored) out.since_t = mirror(out.since_t);
  return out;
}

Acted RigActor::act(double time, bool mirrored) const {
  const auto& joints = t_rig_->joints;
  std::vector<Frame> frames;
  std::vector<Vec3> places(joints.size());
  std::vector<char> done(joints.size(), 0);
  for (std::size_t j = 0; j < joints.size(); ++j) frames.push_back(frame_of(j, time, mirrored));
  const auto is_static = [&](std::size_t j) {  // controls and the root
    for (int k = static_cast<int>(j); k >= 0; k = joints[static_cast<std::size_t>(k)].parent) {
      if (!joints[static_cast<std::size_t>(k)].helper) return false;
    }
    return true;
  };
  int hips = -1;
  for (std::size_t j = 0; j < joints.size() && hips < 0; ++j) {
    if (joints[j].role == Role::spine) hips = static_cast<int>(j);
  }
  for (std::size_t left = joints.size(); left > 0;) {
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const int c = carriers_[j];
      const bool free = is_static(j) || static_cast<int>(j) == hips;
      if (done[j] || (!free && !done[static_cast<std::size_t>(c)])) continue;
      places[j] = joints[j].pivot;
      if (!free)
        places[j] =
            places[static_cast<std::size_t>(c)] +
            frames[static_cast<std::size_t>(c)].since_t * (joints[j].pivot - joints[static_cast<std::size_t>(c)].pivot);
      done[j] = 1;
      --left;
    }
  }
  // The lower foot stands on the ground; the body walks and sways.
  double low = 1e300;
  for (std::size_t v = 0; v < t_rig_->points.size(); ++v) {
    const std::size_t j = static_cast<std::size_t>(t_rig_->owners[v]);
    if (joints[j].role != Role::foot && joints[j].role != Role::toe) continue;
    low = std::min(low, (places[j] + frames[j].since_t * (t_rig_->points[v] - joints[j].pivot)).y);
  }
  const double sway = 0.03 * std::sin(6 * time) * (mirrored ? -1 : 1);
  const Vec3 travel{sway, rest_ground_ - low, 0.8 * time};
  Acted out;
  std::vector<double> matrices;
  std::vector<std::array<Vec3, 4>> world;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const Vec3 axis =
        hf_inner::unit_vector({std::sin(1.0 + static_cast<double>(j)), std::cos(2.0 * static_cast<double>(j)), 0.3});
    const Turn own = hf_inner::retarget::turn_about(axis, 0.7 * static_cast<double>(j));  // as PlacedRig has it
    const Turn turn = frames[j].since_t * (hf_inner::retarget::inverse(frames[j].rest) * own);
    const Vec3 place = is_static(j) ? rig_->joints[j].pivot : places[j] + travel;
    std::array<Vec3, 4> frame;
    const Vec3 axes[] = {x_axis, y_axis, z_axis};
    for (std::size_t c = 0; c < 3; ++c) frame[c] = placing_.scale * placing_.along(turn * axes[c]);
    frame[3] = placing_(place);
    world.push_back(frame);
    out.places.push_back(frame[3]);
    std::array<Vec3, 4> local = frame;
    if (const int p = joints[j].parent; p >= 0) {
      const auto& f = world[static_cast<std::size_t>(p)];
      const double k = 1 / (placing_.scale * placing_.scale);
      for (std::size_t c = 0; c < 4; ++c) {
        const Vec3 v = c < 3 ? frame[c] : frame[3] - f[3];
        local[c] = {k * hf_inner::dot(v, f[0]), k * hf_inner::dot(v, f[1]), k * hf_inner::dot(v, f[2])};
      }
    }
    for (std::size_t c = 0; c < 4; ++c)
      matrices.insert(matrices.end(), {local[c].x, local[c].y, local[c].z, c == 3 ? 1.0 : 0.0});
  }
  hf_inner::skeleton::CharacterInput pose;
  pose.joint_count = static_cast<std::uint32_t>(joints.size());
  pose.matrices = matrices.data();
  out.trs = rest_trs(pose);
  return out;
}

double RigActor::sole_height(const std::vector<double>& world) const {
  const auto rest = world_of(placed_->parents, rest_trs(input_).data());
  double low = 1e300;
  for (std::size_t v = 0; v < rig_->points.size(); ++v) {
    const std::size_t j = static_cast<std::size_t>(rig_->owners[v]);
    if (rig_->joints[j].role != Role::foot && rig_->joints[j].role != Role::toe) continue;
    const auto linear = [&](const std::vector<double>& w) {
      const double* p = &w[12 * j];
      return hf_inner::retarget::Linear{{p[0], p[1], p[2]}, {p[3], p[4], p[5]}, {p[6], p[7], p[8]}};
    };
    const auto origin = [&](const std::vector<double>& w) {
      return Vec3{w[12 * j + 9], w[12 * j + 10], w[12 * j + 11]};
    };
    const Vec3 p{placed_->positions[3 * v], placed_->positions[3 * v + 1], placed_->positions[3 * v + 2]};
    const Vec3 now = linear(world) * hf_inner::retarget::solve(linear(rest), p - origin(rest)) + origin(world);
    low = std::min(low, hf_inner::dot(now, character_->up) - character_->ground);
  }
  return low;
}

}  // namespace hf_test

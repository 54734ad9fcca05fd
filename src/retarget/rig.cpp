#include "retarget/rig.h"

#include <algorithm>
#include <cmath>

#include "base/arguments.h"
#include "base/error.h"

namespace hf_inner::retarget {

void Stance::resize(std::size_t joints) {
  linear.resize(joints);
  place.resize(joints);
  turn.resize(joints);
}

Vec3 SkinPoint::at(const Stance& stance) const noexcept {
  Vec3 sum;
  for (std::size_t k = 0; k < most && joints[k] >= 0; ++k) {
    const std::size_t j = static_cast<std::size_t>(joints[k]);
    sum = sum + weights[k] * (stance.linear[j] * local[k] + stance.place[j]);
  }
  return sum;
}

namespace {

// Reads the transform of one joint and refuses a matrix that is no transform.
void read_joint(const double* m, std::size_t joint, const char* name, Vec3& translation, Turn& rotation, Vec3& scale) {
  for (std::size_t k = 0; k < 10; ++k) {
    if (!std::isfinite(m[k]))
      fail(HF_ERROR_NON_FINITE, static_cast<std::uint32_t>(joint),
           "the transform of joint %zu of the %s has a number that is not finite", joint, name);
  }
  rotation = {m[3], m[4], m[5], m[6]};
  if (!(dot(rotation, rotation) > 0))
    fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(joint),
         "the rotation of joint %zu of the %s is 0; give a quaternion x y z w of length 1", joint, name);
  rotation = unit_turn(rotation);
  translation = {m[0], m[1], m[2]};
  scale = {m[7], m[8], m[9]};
}

void check_side(const RetargetSide& side, const char* name) {
  const skeleton::CharacterInput& in = side.input;
  require_list(in.joint_count, in.parents, "joint_count", "parents");
  require_either(in.matrices, in.trs, "matrices and trs");
  if (side.character.kinds.size() != in.joint_count)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "the %s has %u joints and its character %zu; give the character that was made of this input", name,
         in.joint_count, side.character.kinds.size());
}

void set_axes(Rig& rig, const skeleton::Character& character) {
  rig.up = character.up;
  rig.forward = character.forward;
  rig.left = character.left;
  rig.axes = turn_of_frame(rig.left, rig.up, rig.forward);
  rig.ground = character.ground;
  rig.height = character.height;
  rig.leg_length = character.leg_length;
  rig.hip_height = character.hip_height;
}

// A pose that is named as rest may face elsewhere: the axes turn about up as the line between the thighs did.
void face_rest(Rig& rig) {
  for (std::size_t k = 0; k + 1 < rig.legs.size(); ++k) {
    const RigLeg &a = rig.legs[k], &b = rig.legs[k + 1];
    if (a.side != skeleton::Side::left || b.side != skeleton::Side::right) continue;
    const std::size_t l = at(a.segments.joints[0]), r = at(b.segments.joints[0]);
    const Vec3 was = rig.level(rig.file_rest.place[l] - rig.file_rest.place[r]);
    const Vec3 is = rig.level(rig.rest.place[l] - rig.rest.place[r]);
    const Turn turn = turn_about(rig.up, arc_tangent(dot(rig.up, cross(was, is)), dot(was, is)));
    rig.forward = turn * rig.forward;
    rig.left = turn * rig.left;
    rig.axes = turn * rig.axes;
    return;
  }
}

}  // namespace

// Translation, rotation and scale of each joint, relative to its parent. Shear is dropped.
void read_rest(Rig& rig, const RetargetSide& side, Memory& memory) {
  const std::size_t n = at(rig.count);
  const skeleton::CharacterInput& in = side.input;
  rig.translations.resize(n);
  rig.scales.resize(n);
  rig.rotations.resize(n);
  for (std::size_t j = 0; j < n; ++j) {
    if (in.trs) {
      read_joint(in.trs + 10 * j, j, rig.name, rig.translations[j], rig.rotations[j], rig.scales[j]);
      continue;
    }
    const double* m = in.matrices + 16 * j;
    for (std::size_t k = 0; k < 16; ++k) {
      if (!std::isfinite(m[k]))
        fail(HF_ERROR_NON_FINITE, static_cast<std::uint32_t>(j),
             "the transform of joint %zu of the %s has a number that is not finite", j, rig.name);
    }
    const Linear map{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}};
    const Turn q = turn_of(map);
    rig.translations[j] = {m[12], m[13], m[14]};
    rig.rotations[j] = q;
    rig.scales[j] = {dot(map.x, q * Vec3{1, 0, 0}), dot(map.y, q * Vec3{0, 1, 0}), dot(map.z, q * Vec3{0, 0, 1})};
  }
  (void)memory;
}

namespace {

void stand(const Rig& rig, Stance& stance) {
  for (const Index j : rig.order) {
    const std::size_t i = at(j);
    const Linear own = linear_of(rig.rotations[i], rig.scales[i]);
    const Index p = rig.parents[i];
    stance.linear[i] = p < 0 ? own : stance.linear[at(p)] * own;
    stance.place[i] = p < 0 ? rig.translations[i] : stance.place[at(p)] + stance.linear[at(p)] * rig.translations[i];
    stance.turn[i] = turn_of(stance.linear[i]);
  }
}

// Which way local rotations are read where a rest transform mirrors. Let F = diag(1, 1, -1) for a joint that mirrors,
// and T its turn. The rotation is then T F, and the local rotation is (Fp Tp^-1 T Fp) (Fp F sign(scale)).
void find_flips(Rig& rig, const Stance& stance) {
  for (std::size_t j = 0; j < at(rig.count); ++j) rig.flipped[j] = determinant(stance.linear[j]) < 0;
  for (std::size_t j = 0; j < at(rig.count); ++j) {
    const Index p = rig.parents[j];
    const bool turned = rig.flipped[j] != (p >= 0 && rig.flipped[at(p)] != 0);
    const Vec3 s = rig.scales[j];
    const double x = s.x < 0 ? -1 : 1, y = s.y < 0 ? -1 : 1, z = (s.z < 0 ? -1 : 1) * (turned ? -1 : 1);
    rig.posts[j] = x > 0 && y > 0 && z > 0 ? Turn{}
                   : x > 0                 ? Turn{1, 0, 0, 0}
                   : y > 0                 ? Turn{0, 1, 0, 0}
                                           : Turn{0, 0, 1, 0};
  }
}

}  // namespace

Rig::Rig(const RetargetSide& side, const char* side_name, Memory& m)
    : name(side_name),
      parents(&m),
      order(&m),
      carriers(&m),
      linked(&m),
      moves(&m),
      translations(&m),
      scales(&m),
      rotations(&m),
      flipped(&m),
      posts(&m),
      file_rest(m),
      rest(m),
      ends(&m),
      trunk(&m),
      neck(&m),
      second_rows(&m),
      legs(&m) {
  check_side(side, name);
  count = static_cast<Index>(side.input.joint_count);
  const std::size_t n = at(count);
  parents.assign(side.input.parents, side.input.parents + n);
  carriers.assign(side.character.carriers.begin(), side.character.carriers.end());
  set_axes(*this, side.character);
  read_rest(*this, side, m);
  linked.assign(n, 0);
  find_order(*this, m);
  rest.resize(n);
  stand(*this, rest);
  file_rest = rest;
  flipped.assign(n, 0);
  posts.resize(n);
  if (side.rest) {
    for (std::size_t j = 0; j < n; ++j)
      read_joint(side.rest + 10 * j, j, name, translations[j], rotations[j], scales[j]);
    stand(*this, rest);
  }
  find_flips(*this, rest);
  find_ends(*this, side, m);
  find_legs(*this, side.character, m);
  find_trunk(*this, side.character);
  find_soles(*this, side, m);
  if (side.rest) face_rest(*this);
}

bool Rig::is_below(Index joint, Index ancestor) const noexcept {
  for (Index steps = 0; joint >= 0 && steps <= count; ++steps) {
    if (joint == ancestor) return true;
    joint = carriers[at(joint)] >= 0 ? carriers[at(joint)] : parents[at(joint)];
  }
  return false;
}

bool Rig::is_under(Index joint, Index ancestor) const noexcept {
  while (joint >= 0 && joint != ancestor) joint = parents[at(joint)];
  return joint >= 0;
}

// Parents first, and a joint that hangs loose after the one that carries it.
void find_order(Rig& rig, Memory& memory) {
  const std::size_t n = at(rig.count);
  for (std::size_t j = 0; j < n; ++j) {
    if (rig.parents[j] < -1 || rig.parents[j] >= rig.count)
      fail(HF_ERROR_OUT_OF_RANGE, static_cast<std::uint32_t>(j), "parents[%zu] of the %s is %d; it must be -1 to %d", j,
           rig.name, rig.parents[j], rig.count - 1);
    Index p = rig.parents[j];
    for (Index steps = 0; p >= 0 && p != rig.carriers[j]; p = rig.parents[at(p)]) {
      if (++steps > rig.count)
        fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(j),
             "joint %zu of the %s is its own ancestor; parents must lead to a joint with parent -1", j, rig.name);
    }
    rig.linked[j] = rig.carriers[j] >= 0 && p != rig.carriers[j];
  }
  Vector<std::uint8_t> state(n, 0, &memory);  // 1: on the stack, 2: in the order
  Vector<Index> stack(&memory);
  for (std::size_t first = 0; first < n; ++first) {
    if (state[first] == 0) stack.push_back(static_cast<Index>(first));
    while (!stack.empty()) {
      const Index j = stack.back();
      state[at(j)] = state[at(j)] == 2 ? 2 : 1;
      const Index needs[] = {rig.parents[at(j)], rig.linked[at(j)] ? rig.carriers[at(j)] : -1};
      Index next = -1;
      for (const Index k : needs) {
        if (k < 0 || state[at(k)] == 2) continue;
        if (state[at(k)] == 1)
          rig.linked[at(j)] = 0;  // loose parts that carry each other stay where their parents put them
        else
          next = k;
      }
      if (next >= 0) {
        stack.push_back(next);
        continue;
      }
      stack.pop_back();
      if (state[at(j)] == 2) continue;
      state[at(j)] = 2;
      rig.order.push_back(j);
    }
  }
}

void Rig::read_pose(const double* trs, Stance& stance) const {
  for (const Index j : order) {
    const std::size_t i = at(j);
    Vec3 t, s;
    Turn q;
    read_joint(trs + 10 * i, i, name, t, q, s);
    const Linear own = linear_of(q, s);
    const Index p = parents[i];
    stance.linear[i] = p < 0 ? own : stance.linear[at(p)] * own;
    stance.place[i] = p < 0 ? t : stance.place[at(p)] + stance.linear[at(p)] * t;
    stance.turn[i] = turn_of(stance.linear[i]);
  }
}

Turn Rig::local_turn(Index joint, const Stance& stance) const noexcept {
  const Index p = parents[at(joint)];
  Turn q = p < 0 ? stance.turn[at(joint)] : inverse(stance.turn[at(p)]) * stance.turn[at(joint)];
  if (p >= 0 && flipped[at(p)]) q = {-q.x, -q.y, q.z, q.w};
  return unit_turn(q * posts[at(joint)]);
}

void Rig::place(const Vector<std::uint8_t>& wanted, Vec3 mover_place, Stance& stance) const {
  for (const Index j : order) {
    const std::size_t i = at(j);
    const Index p = parents[i];
    if (!wanted[i])
      stance.turn[i] =
          p < 0 ? rest.turn[i] : unit_turn(stance.turn[at(p)] * (inverse(rest.turn[at(p)]) * rest.turn[i]));
    const Linear own = linear_of(wanted[i] ? local_turn(j, stance) : rotations[i], scales[i]);
    stance.linear[i] = p < 0 ? own : stance.linear[at(p)] * own;
    if (j == mover) {
      stance.place[i] = mover_place;
    } else if (linked[i]) {
      const std::size_t c = at(carriers[i]);
      stance.place[i] = stance.place[c] + stance.turn[c] * (inverse(rest.turn[c]) * (rest.place[i] - rest.place[c]));
    } else {
      stance.place[i] = p < 0 ? translations[i] : stance.place[at(p)] + stance.linear[at(p)] * translations[i];
    }
  }
}

Vec3 Rig::tip_place(const Tip& tip, const Stance& stance) const noexcept {
  const std::size_t j = at(tip.joint);
  return stance.place[j] + stance.turn[j] * (inverse(rest.turn[j]) * tip.offset);
}

Vec3 Rig::hip_place(const Stance& stance) const noexcept {
  if (legs.empty()) return stance.place[at(mover)];
  Vec3 sum;
  for (const RigLeg& leg : legs) sum = sum + stance.place[at(leg.segments.joints[0])];
  return (1 / static_cast<double>(legs.size())) * sum;
}

}  // namespace hf_inner::retarget

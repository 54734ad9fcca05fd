#include "plain_retarget.h"

#include <algorithm>
#include <cmath>

#include "base/algebra.h"

namespace hf_test {

using hf_inner::Character;
using hf_inner::CharacterInput;
using hf_inner::Mat3;
using hf_inner::Role;
using hf_inner::Side;
using Vec = hf_eigen::Vector3d;
using Quat = hf_eigen::Quaterniond;

std::vector<double> rest_trs(const CharacterInput& in) {
  if (in.trs) return {in.trs, in.trs + 10 * std::size_t{in.joint_count}};
  std::vector<double> out;
  for (std::size_t j = 0; j < in.joint_count; ++j) {
    const double* p = in.matrices + 16 * j;
    Mat3 m;
    m << p[0], p[4], p[8], p[1], p[5], p[9], p[2], p[6], p[10];
    Vec s(m.col(0).norm(), m.col(1).norm(), m.col(2).norm());
    if (m.determinant() < 0) s.z() = -s.z();
    for (int c = 0; c < 3; ++c) m.col(c) /= s[c];
    const Quat q(m);
    for (const double v : {p[12], p[13], p[14], q.x(), q.y(), q.z(), q.w(), s.x(), s.y(), s.z()}) out.push_back(v);
  }
  return out;
}

namespace {

Mat3 matrix(const double* p) { return hf_eigen::Map<const Mat3>(p); }
Vec place(const std::vector<double>& world, std::size_t j) { return Vec(&world[12 * j + 9]); }

// The rotation of a world matrix; one that mirrors keeps its first columns.
Mat3 turn(const std::vector<double>& world, std::size_t j) {
  Mat3 m = matrix(&world[12 * j]);
  m.col(0).normalize();
  m.col(1) = (m.col(1) - m.col(0).dot(m.col(1)) * m.col(0)).normalized();
  m.col(2) = m.col(0).cross(m.col(1));
  return m;
}

int joint_of(const Character& c, Role role, Side side, std::uint32_t place_in_chain) {
  for (const auto& chain : c.chains) {
    if (chain.role == role && chain.side == side && chain.number == 0 && place_in_chain < chain.count)
      return static_cast<int>(c.chain_joints[chain.first + place_in_chain]);
  }
  return -1;
}

// What carries both legs; without legs the first joint of the trunk.
int hips_of(const Character& c) {
  const int left = joint_of(c, Role::leg, Side::left, 0), right = joint_of(c, Role::leg, Side::right, 0);
  for (int a = left; a >= 0; a = c.carriers[static_cast<std::size_t>(a)]) {
    for (int b = right; b >= 0; b = c.carriers[static_cast<std::size_t>(b)]) {
      if (a == b) return a;
    }
  }
  return joint_of(c, Role::spine, Side::middle, 0);
}

Mat3 axes(const Character& c) {
  Mat3 m;
  m << c.left.x, c.up.x, c.forward.x, c.left.y, c.up.y, c.forward.y, c.left.z, c.up.z, c.forward.z;
  return m;
}

}  // namespace

std::vector<double> world_of(const std::vector<std::int32_t>& parents, const double* trs) {
  std::vector<double> out(12 * parents.size());
  std::vector<char> done(parents.size(), 0);
  for (std::size_t left = parents.size(); left > 0;) {
    for (std::size_t j = 0; j < parents.size(); ++j) {
      const std::int32_t p = parents[j];
      if (done[j] || (p >= 0 && !done[static_cast<std::size_t>(p)])) continue;
      const double* t = trs + 10 * j;
      const Mat3 own = Quat(t[6], t[3], t[4], t[5]).toRotationMatrix() * Vec(t[7], t[8], t[9]).asDiagonal();
      const Mat3 m = p < 0 ? own : Mat3(matrix(&out[12 * static_cast<std::size_t>(p)]) * own);
      const Vec o = p < 0 ? Vec(t[0], t[1], t[2])
                          : Vec(place(out, static_cast<std::size_t>(p)) +
                                matrix(&out[12 * static_cast<std::size_t>(p)]) * Vec(t[0], t[1], t[2]));
      std::copy(m.data(), m.data() + 9, out.begin() + static_cast<std::ptrdiff_t>(12 * j));
      std::copy(o.data(), o.data() + 3, out.begin() + static_cast<std::ptrdiff_t>(12 * j + 9));
      done[j] = 1;
      --left;
    }
  }
  return out;
}

PlainRetarget::PlainRetarget(const CharacterInput& source, const Character& a, const CharacterInput& target,
                             const Character& b)
    : source_parents_(source.parents, source.parents + source.joint_count),
      target_parents_(target.parents, target.parents + target.joint_count),
      partners_(target.joint_count, -1),
      source_rest_(rest_trs(source)),
      target_rest_(rest_trs(target)) {
  const Mat3 across = axes(b) * axes(a).transpose();
  std::copy(across.data(), across.data() + 9, across_);
  if (a.leg_length > 0 && b.leg_length > 0) scale_ = b.leg_length / a.leg_length;
  for (int role = 0; role < hf_inner::role_count; ++role) {
    for (const Side side : {Side::middle, Side::left, Side::right}) {
      if (const Role r = static_cast<Role>(role); r == Role::other || r == Role::finger || r == Role::spine) continue;
      for (std::uint32_t k = 0;; ++k) {
        const int s = joint_of(a, static_cast<Role>(role), side, k), t = joint_of(b, static_cast<Role>(role), side, k);
        if (s < 0 || t < 0) break;
        partners_[static_cast<std::size_t>(t)] = s;
      }
    }
  }
  source_hips_ = hips_of(a);
  target_hips_ = hips_of(b);
  // The trunk is counted from the hips on.
  const auto trunk = [](const Character& c, int hips) {
    std::vector<int> out;
    for (int j = joint_of(c, Role::head, Side::middle, 0); j >= 0 && j != hips;
         j = c.carriers[static_cast<std::size_t>(j)]) {
      if (c.roles[static_cast<std::size_t>(j)] == Role::spine) out.insert(out.begin(), j);
    }
    return out;
  };
  const std::vector<int> from_trunk = trunk(a, source_hips_), to_trunk = trunk(b, target_hips_);
  for (std::size_t k = 0; k < std::min(from_trunk.size(), to_trunk.size()); ++k)
    partners_[static_cast<std::size_t>(to_trunk[k])] = from_trunk[k];
  if (source_hips_ >= 0 && target_hips_ >= 0) partners_[static_cast<std::size_t>(target_hips_)] = source_hips_;
  const auto from = world_of(source_parents_, source_rest_.data()), to = world_of(target_parents_, target_rest_.data());
  for (std::size_t j = 0; j < target.joint_count; ++j) {
    const auto next = [&](const Character& c, int joint) {
      const Role role = c.roles[static_cast<std::size_t>(joint)];
      for (std::size_t k = 0; k < c.carriers.size(); ++k) {
        const Role at = c.roles[k];
        if (c.carriers[k] == joint &&
            (at == role || (role == Role::arm && at == Role::hand) || (role == Role::leg && at == Role::foot)))
          return static_cast<int>(k);
      }
      return -1;
    };
    Mat3 align = Mat3::Identity();
    const int s = partners_[j];
    if (s >= 0 && (b.roles[j] == Role::arm || b.roles[j] == Role::leg)) {
      const int m = next(a, s), n = next(b, static_cast<int>(j));
      if (m >= 0 && n >= 0)
        align = Quat::FromTwoVectors(
                    place(to, static_cast<std::size_t>(n)) - place(to, j),
                    across * (place(from, static_cast<std::size_t>(m)) - place(from, static_cast<std::size_t>(s))))
                    .toRotationMatrix();
    }
    align_.insert(align_.end(), align.data(), align.data() + 9);
  }
}

void PlainRetarget::frame(const double* source, double* target) const {
  const auto rest = world_of(source_parents_, source_rest_.data()), now = world_of(source_parents_, source);
  const auto target_rest = world_of(target_parents_, target_rest_.data());
  const Mat3 across = matrix(across_);
  std::vector<double> out = target_rest_;
  std::vector<char> done(target_parents_.size(), 0);
  std::vector<double> world;
  for (std::size_t round = 0; round < target_parents_.size(); ++round) {  // joints whose parents are done
    world = world_of(target_parents_, out.data());
    bool any = false;
    for (std::size_t j = 0; j < target_parents_.size(); ++j) {
      const std::int32_t p = target_parents_[j];
      if (done[j] || (p >= 0 && !done[static_cast<std::size_t>(p)])) continue;
      done[j] = 2;
      any = true;
      const int s = partners_[j];
      if (s < 0) continue;
      const std::size_t i = static_cast<std::size_t>(s);
      const Mat3 wanted = across * turn(now, i) * turn(rest, i).transpose() * across.transpose() *
                          matrix(&align_[9 * j]) * turn(target_rest, j);
      const Mat3 parent = p < 0 ? Mat3(Mat3::Identity()) : turn(world, static_cast<std::size_t>(p));
      const Quat q(Mat3(parent.transpose() * wanted));
      const double numbers[] = {q.x(), q.y(), q.z(), q.w()};
      for (std::size_t k = 0; k < 4; ++k) out[10 * j + 3 + k] = numbers[k];
      if (static_cast<int>(j) != target_hips_) continue;
      const std::size_t h = static_cast<std::size_t>(source_hips_);
      const Vec o = place(target_rest, j) + scale_ * (across * (place(now, h) - place(rest, h)));
      const Vec t = p < 0 ? o
                          : Vec(matrix(&world[12 * static_cast<std::size_t>(p)]).inverse() *
                                (o - place(world, static_cast<std::size_t>(p))));
      for (std::size_t k = 0; k < 3; ++k) out[10 * j + k] = t[static_cast<int>(k)];
    }
    if (!any) break;
  }
  std::copy(out.begin(), out.end(), target);
}

}  // namespace hf_test

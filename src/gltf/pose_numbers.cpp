// See pose_numbers.h.
#include "gltf/pose_numbers.h"

#include <cmath>
#include <utility>

#include "gltf/clip_binding.h"

namespace hf_gltf {

void append_trs(const Pose& pose, std::vector<double>& out) {
  for (const NodePose& node : pose) {
    NodePose p = node;
    if (node.fixed) {
      Node whole;
      whole.matrix = node.matrix;
      split_matrix(whole);
      p.translation = whole.translation;
      p.rotation = glm::dquat(whole.rotation);
      p.scale = glm::dvec3(whole.scale);
    }
    const glm::dvec3 &t = p.translation, &s = p.scale;
    const glm::dquat& q = p.rotation;
    for (const double number : {t.x, t.y, t.z, q.x, q.y, q.z, q.w, s.x, s.y, s.z}) out.push_back(number);
  }
}

Pose pose_of(const Pose& rest, const std::vector<double>& trs) {
  Pose out = rest;
  for (size_t n = 0; n < out.size(); ++n) {
    const double* p = &trs[10 * n];
    out[n].fixed = false;
    out[n].translation = {p[0], p[1], p[2]};
    out[n].rotation = glm::dquat(p[6], p[3], p[4], p[5]);
    out[n].scale = {p[7], p[8], p[9]};
  }
  return out;
}

namespace {

void add_key(Channel& channel, const glm::dvec3& v) {
  for (int c = 0; c < 3; ++c) channel.values.push_back(static_cast<float>(v[c]));
}

// The same rotation with the sign that lies nearer to the key before.
void add_key(Channel& channel, const glm::dquat& q) {
  double cosine = 1;
  if (const size_t at = channel.values.size(); at >= 4)
    cosine = channel.values[at - 4] * q.x + channel.values[at - 3] * q.y + channel.values[at - 2] * q.z +
             channel.values[at - 1] * q.w;
  const double sign = cosine < 0 ? -1 : 1;
  for (const double x : {q.x, q.y, q.z, q.w}) channel.values.push_back(static_cast<float>(sign * x));
}

}  // namespace

Animation clip_of_poses(const Model& model, const std::string& name, const std::vector<double>& times,
                        const std::vector<Pose>& poses) {
  // Below this a float does not tell two numbers apart.
  constexpr double equal = 1e-7;
  Animation out;
  out.name = name;
  std::vector<double> rest_trs;
  append_trs(rest_pose(model), rest_trs);
  const Pose rest = pose_of(rest_pose(model), rest_trs);
  for (size_t n = 0; n < model.nodes.size(); ++n) {
    Channel move, turn, grow;
    move.node = turn.node = grow.node = static_cast<int>(n);
    turn.path = Path::rotation;
    turn.width = 4;
    grow.path = Path::scale;
    bool moves = false, turns = false, grows = false;
    for (const Pose& pose : poses) {
      moves = moves || glm::distance(pose[n].translation, rest[n].translation) >
                           equal * (1e-3 + glm::length(rest[n].translation));
      turns = turns || std::abs(glm::dot(pose[n].rotation, rest[n].rotation)) < 1 - equal * equal ||
              glm::length(glm::dvec4(pose[n].rotation.x, pose[n].rotation.y, pose[n].rotation.z, pose[n].rotation.w) -
                          glm::dvec4(rest[n].rotation.x, rest[n].rotation.y, rest[n].rotation.z, rest[n].rotation.w)) >
                  equal;
      grows = grows || glm::distance(pose[n].scale, rest[n].scale) > 1e-6 * glm::length(rest[n].scale);
      add_key(move, pose[n].translation);
      add_key(turn, pose[n].rotation);
      add_key(grow, pose[n].scale);
    }
    for (auto& [used, channel] : {std::pair<bool, Channel*>(moves, &move), {turns, &turn}, {grows, &grow}}) {
      if (!used) continue;
      channel->times.assign(times.begin(), times.end());
      out.channels.push_back(std::move(*channel));
    }
  }
  return out;
}

}  // namespace hf_gltf

#include "clip_player.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace hf_test {

std::vector<double> trs_of(const hf_gltf::Pose& pose) {
  std::vector<double> out;
  for (const hf_gltf::NodePose& node : pose) {
    glm::dvec3 t = node.translation, s = node.scale;
    glm::dquat q = node.rotation;
    if (node.fixed) {
      glm::dmat3 m(node.matrix);
      t = glm::dvec3(node.matrix[3]);
      s = {glm::length(m[0]), glm::length(m[1]), glm::length(m[2])};
      if (glm::determinant(m) < 0) s.z = -s.z;
      for (int c = 0; c < 3; ++c) m[c] /= s[c] != 0 ? s[c] : 1;
      q = glm::normalize(glm::quat_cast(m));
    }
    for (const double number : {t.x, t.y, t.z, q.x, q.y, q.z, q.w, s.x, s.y, s.z}) out.push_back(number);
  }
  return out;
}

void set_clip(hf_gltf::Model& model, const std::string& name, const std::vector<double>& times,
              const std::vector<std::vector<double>>& frames) {
  hf_gltf::Animation clip;
  clip.name = name;
  const std::vector<float> keys(times.begin(), times.end());
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    hf_gltf::Channel move, turn;
    move.node = turn.node = static_cast<int>(n);
    turn.path = hf_gltf::Path::rotation;
    turn.width = 4;
    move.times = turn.times = keys;
    bool moves = false, turns = false;
    for (const std::vector<double>& frame : frames) {
      const double* p = &frame[10 * n];
      for (int k = 0; k < 3; ++k) {
        move.values.push_back(static_cast<float>(p[k]));
        moves |= std::fabs(p[k] - frames[0][10 * n + static_cast<std::size_t>(k)]) > 0 ||
                 std::fabs(p[k] - model.nodes[n].translation[k]) > 1e-9;
      }
      double sign = 1;
      if (const std::size_t at = turn.values.size(); at >= 4) {  // the short way from key to key
        double cosine = 0;
        for (std::size_t k = 0; k < 4; ++k) cosine += turn.values[at - 4 + k] * p[3 + k];
        sign = cosine < 0 ? -1 : 1;
      }
      for (int k = 3; k < 7; ++k) {
        turn.values.push_back(static_cast<float>(sign * p[k]));
        turns |= std::fabs(p[k] - frames[0][10 * n + static_cast<std::size_t>(k)]) > 0;
      }
    }
    const double* first = &frames[0][10 * n];
    model.nodes[n].matrix.reset();
    model.nodes[n].translation = {first[0], first[1], first[2]};
    model.nodes[n].rotation = glm::quat(static_cast<float>(first[6]), static_cast<float>(first[3]),
                                        static_cast<float>(first[4]), static_cast<float>(first[5]));
    model.nodes[n].scale = {first[7], first[8], first[9]};
    if (moves) clip.channels.push_back(move);
    if (turns) clip.channels.push_back(turn);
  }
  model.animations = {clip};
}

}  // namespace hf_test

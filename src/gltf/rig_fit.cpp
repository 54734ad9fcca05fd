// See rig_fit.h.
#include "gltf/rig_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace hf_gltf {
namespace {

constexpr double keep_rest = 2e-4;   // k, over the mean diagonal of the normal matrix
constexpr double damping = 1e-3;     // of each diagonal entry
constexpr double foot_weight = 300;  // of a vertex of a standing foot, beside 1: planted feet do not slide
constexpr double moved = 1e-3;       // of the diagonal: a clip that moves a joint less does not move it

// The rotation of a matrix whose columns may be scaled.
glm::dquat rotation_of(const glm::dmat4& matrix) {
  glm::dmat3 m(matrix);
  for (int c = 0; c < 3; ++c) m[c] = glm::length(m[c]) > 0 ? glm::normalize(m[c]) : m[c];
  if (glm::determinant(m) < 0) m = -m;
  return glm::normalize(glm::quat_cast(m));
}

glm::dvec3 rotation_vector(glm::dquat q) {
  if (q.w < 0) q = -q;
  const glm::dvec3 v(q.x, q.y, q.z);
  const double s = glm::length(v);
  return s < 1e-12 ? 2.0 * v : 2 * std::atan2(s, q.w) / s * v;
}

glm::dquat exponential(const glm::dvec3& w) {
  const double angle = glm::length(w);
  return angle < 1e-12 ? glm::normalize(glm::dquat(1, 0.5 * w.x, 0.5 * w.y, 0.5 * w.z))
                       : glm::angleAxis(angle, w / angle);
}

// Solves the positive definite system in place by Cholesky.
void solve(std::vector<double>& m, std::vector<double>& b) {
  const size_t n = b.size();
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = 0; j <= i; ++j) {
      double x = m[i * n + j];
      for (size_t k = 0; k < j; ++k) x -= m[i * n + k] * m[j * n + k];
      m[i * n + j] = i == j ? std::sqrt(std::max(x, 1e-300)) : x / m[j * n + j];
    }
    for (size_t k = 0; k < i; ++k) b[i] -= m[i * n + k] * b[k];
    b[i] /= m[i * n + i];
  }
  for (size_t i = n; i-- > 0;) {
    for (size_t k = i + 1; k < n; ++k) b[i] -= m[k * n + i] * b[k];
    b[i] /= m[i * n + i];
  }
}

// Nodes with a matrix get translation, rotation and scale where that says the same.
Pose decomposed(Pose pose) {
  for (NodePose& node : pose) {
    if (!node.fixed) continue;
    const glm::dmat4 m = node.matrix;
    NodePose out = node;
    out.fixed = false;
    out.translation = glm::dvec3(m[3]);
    out.rotation = rotation_of(m);
    for (int c = 0; c < 3; ++c) out.scale[c] = glm::length(glm::dvec3(m[c]));
    if (glm::determinant(glm::dmat3(m)) < 0) out.scale = -out.scale;
    const glm::dmat4 again = local_matrix(out);
    double worst = 0;
    for (int c = 0; c < 4; ++c) worst = std::max(worst, glm::length(again[c] - m[c]));
    if (worst < 1e-5 * (1 + glm::length(out.translation))) node = out;
  }
  return pose;
}

}  // namespace

RigFit::RigFit(const Model& model, const FlatMesh& mesh) : model_(model), joint_of_node_(model.nodes.size(), -1) {
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-std::numeric_limits<double>::infinity());
  for (const glm::dvec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
  diagonal_ = glm::length(high - low);
  find_joints();
  find_vertices(mesh);
  if (joints_.empty())
    throw std::runtime_error(model.name + " has no skin to keep: leave --onto-skin out, and it gets a new one");
}

// Joints at or above an influence, parents first; which of them shift.
void RigFit::find_joints() {
  std::vector<char> used(model_.nodes.size(), 0), is_joint(model_.nodes.size(), 0);
  for (const Skin& skin : model_.skins)
    for (const int node : skin.joints) is_joint[static_cast<size_t>(node)] = 1;
  for (const Node& node : model_.nodes) {
    if (node.mesh < 0 || node.skin < 0) continue;
    const Skin& skin = model_.skins[static_cast<size_t>(node.skin)];
    for (const Primitive& primitive : model_.meshes[static_cast<size_t>(node.mesh)].primitives) {
      for (const Influences& influences : primitive.influences) {
        for (size_t k = 0; k < influences.weights.size(); ++k) {
          if (!(influences.weights[k] > 0)) continue;
          for (int n = skin.joints[influences.joints[k]]; n >= 0 && !used[static_cast<size_t>(n)];
               n = model_.nodes[static_cast<size_t>(n)].parent)
            used[static_cast<size_t>(n)] = is_joint[static_cast<size_t>(n)];
        }
      }
    }
  }
  const Pose rest = decomposed(rest_pose(model_));
  std::vector<int> order;
  for (size_t n = 0; n < model_.nodes.size(); ++n)
    if (model_.nodes[n].parent < 0) order.push_back(static_cast<int>(n));
  for (size_t i = 0; i < order.size(); ++i)
    for (const int child : model_.nodes[static_cast<size_t>(order[i])].children) order.push_back(child);
  const std::vector<glm::dmat4> globals = global_matrices(model_, rest);
  for (const int node : order) {
    const auto n = static_cast<size_t>(node);
    if (!used[n] || rest[n].fixed) continue;
    Joint joint;
    joint.node = node;
    for (int up = model_.nodes[n].parent; up >= 0 && joint.parent < 0;
         up = model_.nodes[static_cast<size_t>(up)].parent)
      joint.parent = joint_of_node_[static_cast<size_t>(up)];
    joint.rotation = static_cast<int>(unknowns_), unknowns_ += 3;
    // in world units: the clip's path under the parent's rest transform
    const int up = model_.nodes[n].parent;
    const double unit = up < 0 ? 1.0 : glm::length(glm::dvec3(globals[static_cast<size_t>(up)][0]));
    bool shifts = joint.parent < 0;
    for (const Animation& animation : model_.animations) {
      for (const Channel& channel : animation.channels) {
        if (channel.node != node || channel.path != Path::translation) continue;
        for (const double time : channel.times) {
          const std::vector<double> t = sample_channel(channel, time);
          shifts =
              shifts || unit * glm::distance(glm::dvec3(t[0], t[1], t[2]), rest[n].translation) > moved * diagonal_;
        }
      }
    }
    if (shifts) joint.translation = static_cast<int>(unknowns_), unknowns_ += 3, ++shifting_;
    joint_of_node_[n] = static_cast<int>(joints_.size());
    joints_.push_back(joint);
  }
}

void RigFit::find_vertices(const FlatMesh& mesh) {
  std::vector<double> area(mesh.welded_count, 0.0);
  std::vector<uint32_t> copies(mesh.welded_count, 0);
  for (const uint32_t w : mesh.welded) ++copies[w];
  for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const glm::dvec3 &a = mesh.positions[mesh.triangles[t]], &b = mesh.positions[mesh.triangles[t + 1]],
                     &c = mesh.positions[mesh.triangles[t + 2]];
    for (size_t k = 0; k < 3; ++k)
      area[mesh.welded[mesh.triangles[t + k]]] += glm::length(glm::cross(b - a, c - a)) / 6;
  }
  double total = 0;
  for (const double a : area) total += a;
  for (const FlatPart& part : mesh.parts) {
    const int skin = model_.nodes[static_cast<size_t>(part.node)].skin;
    const Primitive& primitive =
        model_.meshes[static_cast<size_t>(part.mesh)].primitives[static_cast<size_t>(part.primitive)];
    if (skin < 0 || primitive.influences.empty()) continue;
    for (uint32_t i = 0; i < part.vertex_count; ++i) {
      Vertex vertex;
      vertex.flat = part.first_vertex + i;
      const uint32_t w = mesh.welded[vertex.flat];
      // half by area and half by count, so that small feet matter
      vertex.area = (0.5 * area[w] / total + 0.5 / mesh.welded_count) / copies[w];
      const Influences& influences = primitive.influences[i];
      for (size_t k = 0; k < influences.weights.size(); ++k) {
        if (!(influences.weights[k] > 0)) continue;
        const Skin& from = model_.skins[static_cast<size_t>(skin)];
        Influence influence;
        influence.node = from.joints[influences.joints[k]],
        influence.weight = static_cast<double>(influences.weights[k]);
        influence.rest = glm::dvec3(glm::dmat4(from.inverse_bind[influences.joints[k]]) *
                                    glm::dvec4(glm::dvec3(primitive.positions[i]), 1));
        influence.joint = -1;
        for (int n = influence.node; n >= 0 && influence.joint < 0; n = model_.nodes[static_cast<size_t>(n)].parent)
          influence.joint = joint_of_node_[static_cast<size_t>(n)];
        vertex.influences.push_back(influence);
      }
      vertices_.push_back(vertex);
    }
  }
}

Pose RigFit::fit(const std::vector<double>& frame, const Pose& start, int iterations,
                 const std::vector<double>& firm) const {
  const Pose rest = decomposed(rest_pose(model_));
  Pose pose = decomposed(start);
  const size_t n = unknowns_;
  std::vector<double> matrix(n * n), rhs(n);
  std::vector<int> slot(joints_.size(), -1), active;
  std::vector<glm::dvec3> sum(joints_.size());
  std::vector<double> weight(joints_.size());
  for (int round = 0; round < iterations; ++round) {
    const std::vector<glm::dmat4> globals = global_matrices(model_, pose);
    std::fill(matrix.begin(), matrix.end(), 0.0), std::fill(rhs.begin(), rhs.end(), 0.0);
    for (const Vertex& vertex : vertices_) {
      glm::dvec3 at(0);
      active.clear();
      for (const Influence& influence : vertex.influences) {
        const glm::dvec3 x = glm::dvec3(globals[static_cast<size_t>(influence.node)] * glm::dvec4(influence.rest, 1));
        at += influence.weight * x;
        for (int j = influence.joint; j >= 0; j = joints_[static_cast<size_t>(j)].parent) {
          const auto k = static_cast<size_t>(j);
          if (slot[k] < 0)
            slot[k] = static_cast<int>(active.size()), active.push_back(j), sum[k] = glm::dvec3(0), weight[k] = 0;
          sum[k] += influence.weight * x, weight[k] += influence.weight;
        }
      }
      const glm::dvec3 miss = glm::dvec3(frame[3 * size_t{vertex.flat}], frame[3 * size_t{vertex.flat} + 1],
                                         frame[3 * size_t{vertex.flat} + 2]) -
                              at;
      // columns of the Jacobian: three of the turn, three of the shift
      struct Column {
        size_t index;
        glm::dvec3 value;
      };
      Column columns[6 * 64];
      size_t used = 0;
      for (const int j : active) {
        const auto k = static_cast<size_t>(j);
        slot[k] = -1;
        if (used + 6 > 6 * 64) continue;
        const glm::dvec3 arm = sum[k] - weight[k] * glm::dvec3(globals[static_cast<size_t>(joints_[k].node)][3]);
        for (int c = 0; c < 3; ++c) {
          glm::dvec3 axis(0);
          axis[c] = 1;
          columns[used++] = {static_cast<size_t>(joints_[k].rotation + c), glm::cross(axis, arm)};
          if (joints_[k].translation >= 0)
            columns[used++] = {static_cast<size_t>(joints_[k].translation + c), weight[k] * axis};
        }
      }
      const double area = vertex.area * (firm.empty() ? 1.0 : 1 + foot_weight * firm[vertex.flat]);
      for (size_t a = 0; a < used; ++a) {
        rhs[columns[a].index] += area * glm::dot(columns[a].value, miss);
        for (size_t b = 0; b < used; ++b)
          if (columns[b].index <= columns[a].index)
            matrix[columns[a].index * n + columns[b].index] += area * glm::dot(columns[a].value, columns[b].value);
      }
    }
    double mean = 0;
    for (const Joint& joint : joints_)
      for (int c = 0; c < 3; ++c)
        mean += matrix[static_cast<size_t>(joint.rotation + c) * (n + 1)] / (3 * static_cast<double>(joints_.size()));
    for (const Joint& joint : joints_) {
      const int up = model_.nodes[static_cast<size_t>(joint.node)].parent;
      const glm::dquat parent = up < 0 ? glm::dquat(1, 0, 0, 0) : rotation_of(globals[static_cast<size_t>(up)]);
      const auto node = static_cast<size_t>(joint.node);
      // turn from rest as a world vector
      const glm::dvec3 turned = parent * rotation_vector(pose[node].rotation * glm::conjugate(rest[node].rotation));
      for (int c = 0; c < 3; ++c) {
        const auto i = static_cast<size_t>(joint.rotation + c);
        matrix[i * (n + 1)] += keep_rest * mean, rhs[i] -= keep_rest * mean * turned[c];
      }
    }
    for (size_t i = 0; i < n; ++i) matrix[i * (n + 1)] += damping * matrix[i * (n + 1)] + 1e-12 * mean;
    solve(matrix, rhs);
    for (const Joint& joint : joints_) {
      const auto node = static_cast<size_t>(joint.node);
      const int up = model_.nodes[node].parent;
      const glm::dmat4 above = up < 0 ? glm::dmat4(1) : globals[static_cast<size_t>(up)];
      const glm::dquat parent = rotation_of(above);
      const auto r = static_cast<size_t>(joint.rotation);
      glm::dvec3 turn(rhs[r], rhs[r + 1], rhs[r + 2]);
      if (glm::length(turn) > 0.7) turn *= 0.7 / glm::length(turn);
      pose[node].rotation = glm::normalize(glm::conjugate(parent) * exponential(turn) * parent * pose[node].rotation);
      if (joint.translation < 0) continue;
      const auto t = static_cast<size_t>(joint.translation);
      pose[node].translation += glm::inverse(glm::dmat3(above)) * glm::dvec3(rhs[t], rhs[t + 1], rhs[t + 2]);
    }
  }
  return pose;
}

std::vector<Pose> RigFit::fit_all(const std::vector<std::vector<double>>& frames,
                                  const std::function<std::vector<double>(size_t)>& firm) const {
  constexpr int first_steps = 30, steps = 6;  // from rest, and from the frame before, which is near
  std::vector<Pose> out;
  const Pose rest = rest_pose(model_);
  for (size_t f = 0; f < frames.size(); ++f)
    out.push_back(fit(frames[f], f == 0 ? rest : out.back(), f == 0 ? first_steps : steps, firm(f)));
  return out;
}

Animation RigFit::clip(const std::string& name, const std::vector<double>& times,
                       const std::vector<Pose>& poses) const {
  Animation out;
  out.name = name;
  for (const Joint& joint : joints_) {
    const auto node = static_cast<size_t>(joint.node);
    Channel rotation, translation;
    rotation.node = translation.node = joint.node;
    rotation.path = Path::rotation, rotation.width = 4;
    rotation.times.assign(times.begin(), times.end()), translation.times = rotation.times;
    glm::dquat before(1, 0, 0, 0);
    for (const Pose& pose : poses) {
      glm::dquat q = pose[node].rotation;
      if (glm::dot(q, before) < 0) q = -q;
      before = q;
      for (const double value : {q.x, q.y, q.z, q.w}) rotation.values.push_back(static_cast<float>(value));
      for (int c = 0; c < 3; ++c) translation.values.push_back(static_cast<float>(pose[node].translation[c]));
    }
    out.channels.push_back(std::move(rotation));
    if (joint.translation >= 0) out.channels.push_back(std::move(translation));
  }
  return out;
}

}  // namespace hf_gltf

// See animate.h.
#include "gltf/animate.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

namespace hf_gltf {
namespace {

[[noreturn]] void fail(const Model& model, const std::string& message) {
  throw std::runtime_error((model.name.empty() ? "the model" : model.name) + ": " + message + ".");
}

glm::dquat to_quat(const double* xyzw) {
  const glm::dquat q(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
  const double length = glm::length(q);
  return length > 0 ? q / length : glm::dquat(1, 0, 0, 0);
}

void from_quat(const glm::dquat& q, std::vector<double>& out) { out = {q.x, q.y, q.z, q.w}; }

// Shorter arc; near-parallel quaternions are blended straight, which is the limit.
glm::dquat spherical(const glm::dquat& a, glm::dquat b, double s) {
  double cosine = glm::dot(a, b);
  if (cosine < 0) {
    b = -b;
    cosine = -cosine;
  }
  if (cosine > 1 - 1e-12) return glm::normalize(a * (1 - s) + b * s);
  const double angle = std::acos(std::min(cosine, 1.0));
  return glm::normalize((a * std::sin((1 - s) * angle) + b * std::sin(s * angle)) / std::sin(angle));
}

std::vector<double> morph_weights(const Model& model, const Node& node) {
  if (node.mesh < 0) return {};
  const MeshData& mesh = model.meshes[static_cast<size_t>(node.mesh)];
  const size_t targets = mesh.primitives.empty() ? 0 : mesh.primitives.front().targets.size();
  const std::vector<float>& given = node.weights.empty() ? mesh.weights : node.weights;
  std::vector<double> weights(targets, 0.0);
  std::copy_n(given.begin(), std::min(given.size(), targets), weights.begin());
  return weights;
}

void apply(const Channel& channel, const std::vector<double>& value, NodePose& pose) {
  switch (channel.path) {
    case Path::translation:
      pose.translation = {value[0], value[1], value[2]};
      break;
    case Path::scale:
      pose.scale = {value[0], value[1], value[2]};
      break;
    case Path::rotation:
      pose.rotation = to_quat(value.data());
      break;
    case Path::weights:
      std::copy_n(value.begin(), std::min(value.size(), pose.weights.size()), pose.weights.begin());
  }
}

}  // namespace

Pose rest_pose(const Model& model) {
  Pose pose(model.nodes.size());
  for (size_t n = 0; n < pose.size(); ++n) {
    const Node& node = model.nodes[n];
    pose[n].translation = node.translation;
    pose[n].rotation = glm::normalize(glm::dquat(node.rotation));
    pose[n].scale = node.scale;
    pose[n].fixed = node.matrix.has_value();
    if (node.matrix) pose[n].matrix = *node.matrix;
    pose[n].weights = morph_weights(model, node);
  }
  return pose;
}

Pose sample(const Model& model, const Animation& animation, double time) {
  Pose pose = rest_pose(model);
  for (const Channel& channel : animation.channels) {
    if (channel.times.empty()) continue;
    if (channel.node < 0 || static_cast<size_t>(channel.node) >= pose.size()) {
      fail(model, "animation \"" + animation.name + "\" moves node " + std::to_string(channel.node) +
                      ", which does not exist");
    }
    apply(channel, sample_channel(channel, time), pose[static_cast<size_t>(channel.node)]);
  }
  return pose;
}

std::vector<double> sample_channel(const Channel& channel, double time) {
  const size_t keys = channel.times.size(), width = channel.width;
  const bool cubic = channel.interpolation == Interpolation::cubic_spline;
  const size_t groups = cubic ? 3 : 1;
  if (keys == 0 || channel.values.size() != keys * groups * width || (channel.path == Path::rotation && width != 4)) {
    throw std::runtime_error("a channel with " + std::to_string(keys) + " keys of width " + std::to_string(width) +
                             " holds " + std::to_string(channel.values.size()) + " values.");
  }
  // part: 0 in-tangent, 1 value, 2 out-tangent
  const auto value = [&](size_t key, size_t part, size_t c) {
    return static_cast<double>(channel.values[(key * groups + (cubic ? part : 0)) * width + c]);
  };
  std::vector<double> out(width);
  // the last key at or before the time, so the last of keys at one time counts
  const auto after = std::upper_bound(channel.times.begin(), channel.times.end(), time,
                                      [](double t, float key) { return t < static_cast<double>(key); });
  const auto next = static_cast<size_t>(after - channel.times.begin());
  const size_t key = next == 0 ? 0 : next - 1;
  const bool held = next == 0 || next == keys || channel.interpolation == Interpolation::step;
  if (held || !(time == time)) {
    for (size_t c = 0; c < width; ++c) out[c] = value(key, 1, c);
    if (channel.path == Path::rotation) from_quat(to_quat(out.data()), out);
    return out;
  }
  const double start = channel.times[key], d = static_cast<double>(channel.times[next]) - start;
  const double s = (time - start) / d;
  if (cubic) {
    const double s2 = s * s, s3 = s2 * s;
    for (size_t c = 0; c < width; ++c) {
      out[c] = (2 * s3 - 3 * s2 + 1) * value(key, 1, c) + d * (s3 - 2 * s2 + s) * value(key, 2, c) +
               (-2 * s3 + 3 * s2) * value(next, 1, c) + d * (s3 - s2) * value(next, 0, c);
    }
    if (channel.path == Path::rotation) from_quat(to_quat(out.data()), out);
    return out;
  }
  if (channel.path == Path::rotation) {
    double a[4], b[4];
    for (size_t c = 0; c < 4; ++c) {
      a[c] = value(key, 1, c);
      b[c] = value(next, 1, c);
    }
    from_quat(spherical(to_quat(a), to_quat(b), s), out);
    return out;
  }
  for (size_t c = 0; c < width; ++c) out[c] = (1 - s) * value(key, 1, c) + s * value(next, 1, c);
  return out;
}

glm::dmat4 local_matrix(const NodePose& pose) {
  if (pose.fixed) return pose.matrix;
  glm::dmat4 matrix = glm::mat4_cast(pose.rotation);
  for (int c = 0; c < 3; ++c) matrix[c] *= pose.scale[c];
  matrix[3] = glm::dvec4(pose.translation, 1.0);
  return matrix;
}

std::vector<glm::dmat4> global_matrices(const Model& model, const Pose& pose) {
  const size_t count = model.nodes.size();
  if (pose.size() != count) fail(model, "the pose has another number of nodes");
  std::vector<glm::dmat4> globals(count);
  enum : char { open, on_path, done };
  std::vector<char> state(count, open);
  std::vector<size_t> path;
  for (size_t n = 0; n < count; ++n) {
    // up to the first finished ancestor, then down again
    for (int i = static_cast<int>(n); i >= 0 && state[static_cast<size_t>(i)] != done;
         i = model.nodes[static_cast<size_t>(i)].parent) {
      const auto at = static_cast<size_t>(i);
      if (state[at] == on_path) fail(model, "node " + std::to_string(i) + " lies on a cycle of parents");
      if (model.nodes[at].parent >= static_cast<int>(count))
        fail(model, "node " + std::to_string(i) + " has no such parent");
      state[at] = on_path;
      path.push_back(at);
    }
    for (; !path.empty(); path.pop_back()) {
      const size_t at = path.back();
      const int parent = model.nodes[at].parent;
      const glm::dmat4 local = local_matrix(pose[at]);
      globals[at] = parent < 0 ? local : globals[static_cast<size_t>(parent)] * local;
      state[at] = done;
    }
  }
  return globals;
}

double clip_duration(const Animation& animation) {
  double end = 0;
  for (const Channel& channel : animation.channels) {
    if (!channel.times.empty()) end = std::max(end, static_cast<double>(channel.times.back()));
  }
  return end;
}

std::vector<double> key_times(const Animation& animation) {
  std::vector<double> times;
  for (const Channel& channel : animation.channels)
    times.insert(times.end(), channel.times.begin(), channel.times.end());
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

std::vector<double> frame_times(const Animation& animation, double rate) {
  if (!(rate > 0 && rate <= 1000)) throw std::runtime_error("a frame rate must lie above 0 and not above 1000.");
  const double end = clip_duration(animation);
  if (end * rate > 1e6) throw std::runtime_error("the clip \"" + animation.name + "\" has more than a million frames.");
  std::vector<double> times;
  // the end replaces a frame that would lie closer to it than half a step
  for (size_t f = 0; static_cast<double>(f) < end * rate - 0.5; ++f) times.push_back(static_cast<double>(f) / rate);
  times.push_back(end);
  return times;
}

std::vector<glm::dmat4> vertex_matrices(const Model& model, const std::vector<glm::dmat4>& globals, int node,
                                        const Primitive& primitive) {
  const Node& owner = model.nodes[static_cast<size_t>(node)];
  std::vector<glm::dmat4> matrices(primitive.positions.size());
  if (owner.skin < 0 || primitive.influences.empty()) {
    std::fill(matrices.begin(), matrices.end(), globals[static_cast<size_t>(node)]);
    return matrices;
  }
  const Skin& skin = model.skins[static_cast<size_t>(owner.skin)];
  const size_t joint_count = skin.joints.size();
  const auto joint_matrix = [&](size_t j) {
    return globals[static_cast<size_t>(skin.joints[j])] * glm::dmat4(skin.inverse_bind[j]);
  };
  // a small primitive of a large skin: only the joints it names, so that many of them cost what their vertices cost
  const bool few = joint_count > std::tuple_size_v<decltype(Influences::joints)> * matrices.size();
  std::vector<glm::dmat4> joints(few ? 0 : joint_count);
  for (size_t j = 0; j < joints.size(); ++j) joints[j] = joint_matrix(j);
  for (size_t v = 0; v < matrices.size(); ++v) {
    const Influences& o = primitive.influences[v];
    glm::dmat4 blend(0.0);
    double sum = 0;
    for (size_t k = 0; k < o.weights.size(); ++k) {
      if (o.weights[k] == 0) continue;
      if (o.joints[k] >= joint_count) fail(model, "vertex " + std::to_string(v) + " names a joint the skin lacks");
      blend += (few ? joint_matrix(o.joints[k]) : joints[o.joints[k]]) * static_cast<double>(o.weights[k]);
      sum += static_cast<double>(o.weights[k]);
    }
    matrices[v] = sum > 0 ? blend * (1 / sum) : globals[static_cast<size_t>(node)];
  }
  return matrices;
}

std::vector<glm::dvec3> posed_primitive(const Model& model, const Pose& pose, const std::vector<glm::dmat4>& globals,
                                        int node, const Primitive& primitive, std::vector<glm::vec3>* normals) {
  const std::vector<double>& weights = pose[static_cast<size_t>(node)].weights;
  const std::vector<glm::dmat4> matrices = vertex_matrices(model, globals, node, primitive);
  const bool with_normals = normals && !primitive.normals.empty();
  if (normals) normals->assign(primitive.positions.size(), glm::vec3(0));
  std::vector<glm::dvec3> out(primitive.positions.size());
  for (size_t v = 0; v < out.size(); ++v) {
    glm::dvec3 p(primitive.positions[v]);
    glm::dvec3 n(with_normals ? primitive.normals[v] : glm::vec3(0));
    for (size_t t = 0; t < primitive.targets.size() && t < weights.size(); ++t) {
      const MorphTarget& target = primitive.targets[t];
      if (weights[t] == 0) continue;
      if (!target.positions.empty()) p += weights[t] * glm::dvec3(target.positions[v]);
      if (!target.normals.empty()) n += weights[t] * glm::dvec3(target.normals[v]);
    }
    const glm::dmat4& m = matrices[v];
    out[v] = glm::dvec3(m * glm::dvec4(p, 1.0));
    if (!with_normals) continue;
    // cofactors: the inverse transposed without dividing by a determinant that may be zero
    const glm::dvec3 a(m[0]), b(m[1]), c(m[2]);
    const glm::dvec3 bc = glm::cross(b, c);
    glm::dvec3 moved = bc * n.x + glm::cross(c, a) * n.y + glm::cross(a, b) * n.z;
    if (glm::dot(a, bc) < 0) moved = -moved;
    const double length = glm::length(moved);
    if (length > 0) (*normals)[v] = glm::vec3(moved / length);
  }
  return out;
}

static std::vector<glm::dvec3> positions_of(const Model& model, const FlatMesh& mesh, const Pose& pose,
                                            const std::vector<glm::dmat4>& globals) {
  std::vector<glm::dvec3> out(mesh.positions.size());
  for (const FlatPart& part : mesh.parts) {
    const bool good =
        part.node >= 0 && static_cast<size_t>(part.node) < model.nodes.size() && part.mesh >= 0 &&
        static_cast<size_t>(part.mesh) < model.meshes.size() && part.primitive >= 0 &&
        static_cast<size_t>(part.primitive) < model.meshes[static_cast<size_t>(part.mesh)].primitives.size();
    if (!good) fail(model, "the flat mesh was not made from this model");
    const Primitive& primitive =
        model.meshes[static_cast<size_t>(part.mesh)].primitives[static_cast<size_t>(part.primitive)];
    if (primitive.positions.size() != part.vertex_count) fail(model, "the flat mesh was not made from this model");
    const std::vector<glm::dvec3> posed = posed_primitive(model, pose, globals, part.node, primitive, nullptr);
    std::copy(posed.begin(), posed.end(), out.begin() + part.first_vertex);
  }
  return out;
}

std::vector<glm::dvec3> posed_positions(const Model& model, const FlatMesh& mesh, const Pose& pose) {
  return positions_of(model, mesh, pose, global_matrices(model, pose));
}

std::vector<glm::dvec3> posed_positions(const Model& model, const FlatMesh& mesh, const Animation& animation,
                                        double time) {
  return posed_positions(model, mesh, sample(model, animation, time));
}

std::vector<int> with_parents(const Model& model, const std::vector<int>& nodes) {
  std::vector<char> taken(model.nodes.size(), 0);
  std::vector<int> out, path;
  for (const int node : nodes) {
    for (int n = node; n >= 0 && !taken[static_cast<size_t>(n)]; n = model.nodes[static_cast<size_t>(n)].parent) {
      taken[static_cast<size_t>(n)] = 1;
      path.push_back(n);
    }
    out.insert(out.end(), path.rbegin(), path.rend());
    path.clear();
  }
  return out;
}

SurfacePoser::SurfacePoser(const Model& model, const FlatMesh& mesh)
    : model_(model),
      mesh_(mesh),
      moves_(model.nodes.size(), 0),
      rest_(rest_pose(model)),
      pose_(rest_),
      globals_(model.nodes.size()) {
  std::vector<int> movers;
  const auto add = [&](int node) {
    if (!moves_[static_cast<size_t>(node)]) movers.push_back(node);
    moves_[static_cast<size_t>(node)] = 1;
  };
  for (const FlatPart& part : mesh.parts) {
    add(part.node);
    const int skin = model.nodes[static_cast<size_t>(part.node)].skin;
    if (skin < 0) continue;
    const std::vector<int>& joints = model.skins[static_cast<size_t>(skin)].joints;
    for (const Influences& influences :
         model.meshes[static_cast<size_t>(part.mesh)].primitives[static_cast<size_t>(part.primitive)].influences) {
      for (size_t k = 0; k < influences.weights.size(); ++k)
        if (influences.weights[k] != 0) add(joints[influences.joints[k]]);
    }
  }
  nodes_ = with_parents(model, movers);
  for (const int node : nodes_) moves_[static_cast<size_t>(node)] = 1;
}

std::vector<glm::dvec3> SurfacePoser::at(const Animation& animation, double time) {
  for (const int node : nodes_) pose_[static_cast<size_t>(node)] = rest_[static_cast<size_t>(node)];
  for (const Channel& channel : animation.channels) {
    const auto node = static_cast<size_t>(channel.node);
    if (node >= moves_.size()) fail(model_, "animation \"" + animation.name + "\" moves a node that does not exist");
    if (!channel.times.empty() && moves_[node]) apply(channel, sample_channel(channel, time), pose_[node]);
  }
  for (const int n : nodes_) {
    const auto node = static_cast<size_t>(n);
    const int parent = model_.nodes[node].parent;
    const glm::dmat4 local = local_matrix(pose_[node]);
    globals_[node] = parent < 0 ? local : globals_[static_cast<size_t>(parent)] * local;
  }
  return positions_of(model_, mesh_, pose_, globals_);
}

int find_node(const Model& model, const std::string& name) {
  for (size_t n = 0; n < model.nodes.size(); ++n) {
    if (model.nodes[n].name == name) return static_cast<int>(n);
  }
  return -1;
}

int find_animation(const Model& model, const std::string& name) {
  for (size_t a = 0; a < model.animations.size(); ++a) {
    if (model.animations[a].name == name) return static_cast<int>(a);
  }
  return -1;
}

}  // namespace hf_gltf

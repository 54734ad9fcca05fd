#include "weights/skeleton_from.h"

#include <stdexcept>

#include "gltf/animate.h"
#include "gltf/node_match.h"
#include "gltf/pairs_file.h"
#include "weights/rig.h"

namespace samples {

using namespace hf_gltf;
namespace {

// The way of a point from one model to the other.
class Fit {
 public:
  Fit(const FlatMesh& source, const FlatMesh& target, const std::vector<Landmark>& landmarks)
      : from_(source), to_(target), landmarks_(landmarks) {}
  glm::dvec3 operator()(const glm::dvec3& p) const {
    glm::dvec3 shift(0);
    double sum = 0;
    for (const Landmark& mark : landmarks_) {
      const double squared = glm::dot(p - mark.from, p - mark.from);
      if (squared == 0) return mark.to;
      shift += (mark.to - boxed(mark.from)) / squared;
      sum += 1 / squared;
    }
    return sum > 0 ? boxed(p) + shift / sum : boxed(p);
  }

 private:
  glm::dvec3 boxed(const glm::dvec3& p) const {
    glm::dvec3 out;
    for (int c = 0; c < 3; ++c) {
      const double size = from_.high[c] - from_.low[c];
      const double share = size > 0 ? (p[c] - from_.low[c]) / size : 0.5;
      out[c] = to_.low[c] + share * (to_.high[c] - to_.low[c]);
    }
    return out;
  }
  SurfaceBox from_, to_;
  const std::vector<Landmark>& landmarks_;
};

glm::dvec3 middle_of(const FlatMesh& mesh, const Region& region) {
  glm::dvec3 sum(0);
  for (const uint32_t v : region.vertices) sum += mesh.positions[v] / static_cast<double>(region.vertices.size());
  return sum;
}

glm::dquat turn_of(const glm::dmat4& m) {
  glm::dmat3 axes(m);
  for (int c = 0; c < 3; ++c) {
    const double length = glm::length(axes[c]);
    if (!(length > 0)) return {1, 0, 0, 0};
    axes[c] /= length;
  }
  return glm::determinant(axes) > 0 ? glm::normalize(glm::quat_cast(axes)) : glm::dquat(1, 0, 0, 0);
}

}  // namespace

std::vector<Landmark> pair_landmarks(const std::filesystem::path& file, const Model& source, const Model& target) {
  const PairsFile pairs = read_pairs(file);
  const FlatMesh from = flatten(source), to = flatten(target);
  const RegionFinder of_source(source, from, pairs.source_axes), of_target(target, to, pairs.target_axes);
  std::vector<Landmark> out;
  for (const PairEntry& pair : pairs.pairs)
    out.push_back({middle_of(from, of_source.find(pair.source)), middle_of(to, of_target.find(pair.target))});
  return out;
}

std::vector<Landmark> name_landmarks(const Model& source, const Model& target) {
  const std::vector<glm::dmat4> from = global_matrices(source, rest_pose(source)),
                                to = global_matrices(target, rest_pose(target));
  const std::vector<int> joints = read_rig(source).joints;
  const NodeMatch match = match_nodes(source, joints, target);
  std::vector<Landmark> out;
  for (const int joint : joints) {
    const auto node = static_cast<size_t>(joint);
    if (match.there[node] < 0) continue;
    const auto there = static_cast<size_t>(match.there[node]);
    if (source.nodes[node].name.empty() || target.nodes[there].mesh >= 0) continue;
    out.push_back({glm::dvec3(from[node][3]), glm::dvec3(to[there][3])});
  }
  return out;
}

TakenSkeleton take_skeleton(const Model& source, const Model& target, const std::vector<Landmark>& landmarks,
                            bool in_place) {
  const Rig rig = read_rig(source);
  const FlatMesh from = flatten(source), to = flatten(target);
  const Fit fit(from, to, landmarks);
  const std::vector<glm::dmat4> globals = global_matrices(source, rest_pose(source));
  TakenSkeleton out{bake(target, to, to.positions), {}};
  Model& model = out.model;
  // the nodes of a skinned mesh do not move it, so the bind matrices take the offset of the positions
  glm::dmat4 offset(1);
  offset[3] = glm::dvec4(model.nodes.front().translation, 1);
  for (Node& node : model.nodes) node.translation = glm::dvec3(0);
  const int first = static_cast<int>(model.nodes.size());
  Skin skin;
  skin.name = "skeleton";
  std::vector<glm::dmat4> world;
  for (size_t j = 0; j < rig.joints.size(); ++j) {
    const glm::dmat4& old = globals[static_cast<size_t>(rig.joints[j])];
    const glm::dvec3 place = in_place ? glm::dvec3(old[3]) : fit(glm::dvec3(old[3]));
    world.push_back(glm::mat4_cast(turn_of(old)));
    world.back()[3] = glm::dvec4(place, 1.0);
    if (j < rig.joint_count()) {
      skin.joints.push_back(first + static_cast<int>(j));
      skin.inverse_bind.push_back(glm::mat4(glm::inverse(world.back()) * offset));
    }
    out.deforms.push_back(rig.bones.deforms[j]);
  }
  for (size_t j = 0; j < rig.joints.size(); ++j) {
    Node node;
    node.name = rig.names[j];
    const uint32_t parent = rig.bones.parents[j];
    const glm::dmat4 local = parent == HF_NO_INDEX ? world[j] : glm::inverse(world[parent]) * world[j];
    node.translation = glm::dvec3(local[3]);
    node.rotation = glm::quat(turn_of(local));
    if (parent != HF_NO_INDEX) node.parent = first + static_cast<int>(parent);
    model.nodes.push_back(node);
  }
  for (size_t j = 0; j < rig.joints.size(); ++j) {
    const int at = first + static_cast<int>(j), parent = model.nodes[static_cast<size_t>(at)].parent;
    if (parent >= 0) {
      model.nodes[static_cast<size_t>(parent)].children.push_back(at);
    } else {
      model.scene_roots.push_back(at);
      if (!model.scenes.empty()) model.scenes[model.shown_scene].roots.push_back(at);
    }
  }
  model.skins.push_back(skin);
  for (int n = 0; n < first; ++n) {
    Node& node = model.nodes[static_cast<size_t>(n)];
    if (node.mesh >= 0) node.skin = static_cast<int>(model.skins.size()) - 1;
  }
  Influences whole;
  whole.weights[0] = 1;
  for (MeshData& mesh : model.meshes) {
    for (Primitive& primitive : mesh.primitives) primitive.influences.assign(primitive.positions.size(), whole);
  }
  return out;
}

}  // namespace samples

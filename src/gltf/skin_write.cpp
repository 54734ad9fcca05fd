// See skin_write.h.
#include "gltf/skin_write.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "gltf/animate.h"
#include "gltf/clip_binding.h"

namespace hf_gltf {
namespace {

[[noreturn]] void fail(const std::string& message) {
  throw std::runtime_error("the skin cannot be made: " + message + ".");
}

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void check(const FlatMesh& mesh, const SkinDescription& skin) {
  const size_t joints = skin.joints.size(), k = skin.influences_per_vertex;
  if (joints == 0 || joints > 65535) fail("it needs 1 to 65535 joints, not " + std::to_string(joints));
  if (k < 1 || k > 8) fail("a vertex may have 1 to 8 influences, not " + std::to_string(k));
  const size_t slots = mesh.positions.size() * k;
  if (skin.vertex_joints.size() != slots || skin.vertex_weights.size() != slots) {
    fail(std::to_string(mesh.positions.size()) + " vertices with " + std::to_string(k) + " influences need " +
         std::to_string(slots) + " joints and weights");
  }
  for (size_t j = 0; j < joints; ++j) {
    if (!is_finite(skin.joints[j].pivot)) fail("the pivot of joint " + std::to_string(j) + " is not finite");
    if (!(std::abs(glm::length(skin.joints[j].axes) - 1) < 1e-3))
      fail("the axes of joint " + std::to_string(j) + " are no rotation of unit length");
  }
  for (size_t i = 0; i < slots; ++i) {
    const float weight = skin.vertex_weights[i];
    if (!(weight >= 0) || !std::isfinite(weight)) fail("vertex " + std::to_string(i / k) + " has a bad weight");
    if (weight > 0 && skin.vertex_joints[i] >= joints) {
      fail("vertex " + std::to_string(i / k) + " names joint " + std::to_string(skin.vertex_joints[i]) + " of " +
           std::to_string(joints));
    }
  }
  for (const SkinClip& clip : skin.clips) {
    const std::string name = "clip \"" + clip.name + "\"";
    const size_t motions = clip.times.size() * joints;
    if (clip.times.empty()) fail(name + " has no frames");
    if (clip.rotations.size() != motions || clip.translations.size() != motions) {
      fail(name + " needs " + std::to_string(motions) + " rotations and translations");
    }
    if (!clip.scales.empty() && clip.scales.size() != motions)
      fail(name + " needs " + std::to_string(motions) + " scales or none");
    for (size_t i = 0; i < clip.scales.size(); ++i) {
      if (!is_finite(clip.scales[i]))
        fail(name + ", frame " + std::to_string(i / joints) + ", joint " + std::to_string(i % joints) +
             ": the scale is not finite");
    }
    for (size_t i = 0; i < motions; ++i) {
      const double length = glm::length(clip.rotations[i]);
      if (!(std::abs(length - 1) < 1e-3) || !is_finite(clip.translations[i])) {
        fail(name + ", frame " + std::to_string(i / joints) + ", joint " + std::to_string(i % joints) +
             ": the rotation is not of unit length or the translation is not finite");
      }
    }
  }
}

Influences influences_of(const SkinDescription& skin, uint32_t vertex) {
  const uint32_t k = skin.influences_per_vertex;
  Influences out;
  double sum = 0;
  for (uint32_t i = 0; i < k; ++i) sum += static_cast<double>(skin.vertex_weights[static_cast<size_t>(vertex) * k + i]);
  if (!(sum > 0)) fail("vertex " + std::to_string(vertex) + " has no weight");
  for (uint32_t i = 0; i < k; ++i) {
    const size_t slot = static_cast<size_t>(vertex) * k + i;
    out.weights[i] = static_cast<float>(static_cast<double>(skin.vertex_weights[slot]) / sum);
    out.joints[i] = out.weights[i] > 0 ? static_cast<uint16_t>(skin.vertex_joints[slot]) : uint16_t{0};
  }
  return out;
}

// A primitive and the one before it that look the same and have the same kinds of numbers become one, which a player
// draws at once. Vertices keep their order. Indices stay below 65,536, so that they are written as shorts.
void join_neighbours(std::vector<Primitive>& primitives) {
  constexpr size_t most_vertices = 65535;
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  const auto joins = [&](const Primitive& a, const Primitive& b) {
    return a.topology == b.topology && a.material == b.material && a.texcoords.size() == b.texcoords.size() &&
           a.colors.empty() == b.colors.empty() && a.normals.empty() == b.normals.empty() &&
           a.tangents.empty() == b.tangents.empty() && a.carried_attributes.empty() && b.carried_attributes.empty() &&
           a.carried.extras == b.carried.extras && a.carried.extensions == b.carried.extensions &&
           a.positions.size() + b.positions.size() <= most_vertices;
  };
  std::vector<Primitive> joined;
  for (Primitive& primitive : primitives) {
    if (joined.empty() || !joins(joined.back(), primitive)) {
      joined.push_back(std::move(primitive));
      continue;
    }
    Primitive& to = joined.back();
    const auto first = static_cast<uint32_t>(to.positions.size());
    for (const uint32_t index : primitive.indices) to.indices.push_back(first + index);
    append(to.positions, primitive.positions);
    append(to.normals, primitive.normals);
    append(to.colors, primitive.colors);
    append(to.influences, primitive.influences);
    append(to.tangents, primitive.tangents);
    for (size_t set = 0; set < to.texcoords.size(); ++set) append(to.texcoords[set], primitive.texcoords[set]);
    primitive = {};
  }
  primitives = std::move(joined);
}

void add_mesh(const FlatMesh& mesh, const SkinDescription& skin, Model& out) {
  // bake() left one mesh per node; here all their primitives become one mesh
  MeshData all;
  all.name = "skinned";
  for (MeshData& part : out.meshes) {
    for (Primitive& primitive : part.primitives) all.primitives.push_back(std::move(primitive));
  }
  for (size_t p = 0; p < mesh.parts.size(); ++p) {
    const FlatPart& part = mesh.parts[p];
    Primitive& primitive = all.primitives[p];
    for (uint32_t v = 0; v < part.vertex_count; ++v) {
      primitive.influences.push_back(influences_of(skin, part.first_vertex + v));
    }
    // normals of the file at rest, where it has them all
    const auto first = mesh.normals.begin() + part.first_vertex, last = first + part.vertex_count;
    if (std::none_of(first, last, [](const glm::vec3& n) { return n == glm::vec3(0); })) {
      primitive.normals.assign(first, last);
    }
  }
  join_neighbours(all.primitives);
  out.meshes.clear();
  out.meshes.push_back(std::move(all));
}

// offset: where the root stands, so that positions and joints are small numbers below it.
void add_joints(const SkinDescription& skin, const glm::dvec3& offset, Model& out) {
  out.nodes.clear();
  Node root;
  root.name = "root";
  root.translation = offset;
  Node body;
  body.name = "body";
  body.mesh = 0;
  body.skin = 0;
  Skin to;
  to.name = "skin";
  to.skeleton = 0;
  out.nodes.push_back(root);
  for (size_t j = 0; j < skin.joints.size(); ++j) {
    Node joint;
    joint.name = skin.joints[j].name.empty() ? "joint_" + std::to_string(j) : skin.joints[j].name;
    joint.parent = 0;
    // the pivot as the file holds it, so that node and inverse bind matrix cancel exactly at rest
    const glm::vec3 pivot(skin.joints[j].pivot - offset);
    joint.translation = glm::dvec3(pivot);
    const int number = static_cast<int>(out.nodes.size());
    out.nodes[0].children.push_back(number);
    to.joints.push_back(number);
    glm::mat4 inverse_bind(1);
    inverse_bind[3] = glm::vec4(-pivot, 1);
    if (skin.joints[j].axes != glm::dquat(1, 0, 0, 0)) {
      joint.rotation = glm::quat(glm::normalize(skin.joints[j].axes));
      inverse_bind = glm::mat4_cast(glm::conjugate(joint.rotation)) * inverse_bind;
    }
    to.inverse_bind.push_back(inverse_bind);
    out.nodes.push_back(std::move(joint));
  }
  out.scene_roots = {0, static_cast<int>(out.nodes.size())};
  out.nodes.push_back(body);
  out.skins = {to};
}

Animation make_clip(const SkinDescription& skin, const glm::dvec3& offset, const SkinClip& clip) {
  Animation animation;
  animation.name = clip.name;
  const size_t joints = skin.joints.size();
  const std::vector<float> times(clip.times.begin(), clip.times.end());
  for (size_t j = 0; j < joints; ++j) {
    Channel rotation, translation, scale;
    rotation.node = translation.node = scale.node = static_cast<int>(j) + 1;
    rotation.path = Path::rotation;
    rotation.width = 4;
    scale.path = Path::scale;
    rotation.times = translation.times = scale.times = times;
    const glm::dquat axes = glm::normalize(skin.joints[j].axes);
    const glm::dvec3 pivot = float_rounded(skin.joints[j].pivot - offset) + offset;
    glm::dquat before(1, 0, 0, 0);
    for (size_t f = 0; f < times.size(); ++f) {
      glm::dquat q = glm::normalize(clip.rotations[f * joints + j]);
      const glm::dvec3 t = q * pivot + clip.translations[f * joints + j] - offset;
      q = glm::normalize(q * axes);
      if (glm::dot(q, before) < 0) q = -q;
      before = q;
      for (const double value : {q.x, q.y, q.z, q.w}) rotation.values.push_back(static_cast<float>(value));
      for (int c = 0; c < 3; ++c) translation.values.push_back(static_cast<float>(t[c]));
      for (int c = 0; c < 3 && !clip.scales.empty(); ++c)
        scale.values.push_back(static_cast<float>(clip.scales[f * joints + j][c]));
    }
    animation.channels.push_back(std::move(translation));
    animation.channels.push_back(std::move(rotation));
    if (!clip.scales.empty()) animation.channels.push_back(std::move(scale));
  }
  return animation;
}

}  // namespace

Model skin_model(const Model& source, const FlatMesh& mesh, const SkinDescription& skin) {
  check(mesh, skin);
  if (mesh.positions.empty()) fail("the surface is empty");
  Model out = bake(source, mesh, mesh.positions);
  const glm::dvec3 offset = out.nodes.front().translation;
  add_mesh(mesh, skin, out);
  add_joints(skin, offset, out);
  for (const SkinClip& clip : skin.clips) out.animations.push_back(make_clip(skin, offset, clip));
  return out;
}

void keep_carried(const Model& from, Model& out) {
  out.asset = from.asset;
  out.carried = from.carried;
  out.required_extensions = from.required_extensions;
  out.cameras = from.cameras;
  if (from.shown_scene < from.scenes.size()) {
    out.scenes = {from.scenes[from.shown_scene]};
    out.shown_scene = 0;
  }
  const std::vector<glm::dmat4> globals = global_matrices(from, rest_pose(from));
  std::map<std::string, size_t> given;  // how many nodes of a name, with a mesh, have come
  for (size_t n = 0; n < from.nodes.size(); ++n) {
    const Node& node = from.nodes[n];
    const size_t number = node.mesh >= 0 ? given[node.name]++ : 0;
    const bool carries = node.camera >= 0 || !node.carried.extras.empty() || !node.carried.extensions.empty();
    int top = static_cast<int>(n);
    while (from.nodes[static_cast<size_t>(top)].parent >= 0) top = from.nodes[static_cast<size_t>(top)].parent;
    if (!carries || std::find(from.scene_roots.begin(), from.scene_roots.end(), top) == from.scene_roots.end())
      continue;
    size_t before = 0;
    const auto own = std::find_if(out.nodes.begin(), out.nodes.end(), [&](const Node& other) {
      const bool same = node.mesh >= 0 && other.mesh >= 0 && other.skin < 0 && other.name == node.name;
      return same && before++ == number;
    });
    if (own != out.nodes.end()) {
      own->carried = node.carried;
      continue;
    }
    Node kept;
    kept.name = node.name;
    kept.camera = node.camera;
    kept.carried = node.carried;
    kept.matrix = globals[n];
    split_matrix(kept);
    out.scene_roots.push_back(static_cast<int>(out.nodes.size()));
    out.nodes.push_back(std::move(kept));
  }
  if (!out.scenes.empty()) out.scenes.front().roots = out.scene_roots;
}

void keep_shapes(const Model& from, const FlatMesh& mesh, Model& out) {
  const Pose rest = rest_pose(from);
  const std::vector<glm::dvec3> still = posed_positions(from, mesh, rest);
  const std::vector<glm::vec3> still_normals = welded_normals(mesh, still);
  MeshData& to = out.meshes.front();
  if (std::all_of(mesh.parts.begin(), mesh.parts.end(),
                  [&](const FlatPart& part) { return part.mesh == mesh.parts.front().mesh; }))
    to.carried = from.meshes[static_cast<size_t>(mesh.parts.front().mesh)].carried;
  std::vector<std::string> names;
  std::vector<std::vector<int>> nodes;  // of each name, those whose mesh has it
  std::vector<std::vector<size_t>> numbers;
  for (const FlatPart& part : mesh.parts) {
    const MeshData& own = from.meshes[static_cast<size_t>(part.mesh)];
    std::set<std::string> of_mesh;
    for (size_t k = 0; k < own.primitives.front().targets.size(); ++k) {
      const std::string given = k < own.target_names.size() ? own.target_names[k] : "shape " + std::to_string(k);
      std::string name = given;  // two shapes of one mesh are two, whatever their names
      for (int copy = 2; !of_mesh.insert(name).second; ++copy) name = given + " (" + std::to_string(copy) + ")";
      const auto at = static_cast<size_t>(std::find(names.begin(), names.end(), name) - names.begin());
      if (at == names.size()) {
        names.push_back(name);
        nodes.emplace_back();
        numbers.emplace_back();
      }
      if (std::find(nodes[at].begin(), nodes[at].end(), part.node) != nodes[at].end()) continue;
      nodes[at].push_back(part.node);
      numbers[at].push_back(k);
    }
  }
  for (size_t t = 0; t < names.size(); ++t) {
    // where the shape takes the surface at rest: a difference of poses, so it holds under joints and nodes too
    Pose pose = rest;
    for (size_t i = 0; i < nodes[t].size(); ++i) pose[static_cast<size_t>(nodes[t][i])].weights[numbers[t][i]] += 1;
    const double weight = rest[static_cast<size_t>(nodes[t].front())].weights[numbers[t].front()];
    const std::vector<glm::dvec3> moved = posed_positions(from, mesh, pose);
    const std::vector<glm::vec3> normals = welded_normals(mesh, moved);
    size_t v = 0;
    for (Primitive& primitive : to.primitives) {
      MorphTarget target;
      for (glm::vec3& place : primitive.positions) {
        target.positions.push_back(glm::vec3(moved[v] - still[v]));
        target.normals.push_back(normals[v] - still_normals[v]);
        place -= static_cast<float>(weight) * target.positions.back();
        ++v;
      }
      primitive.targets.push_back(std::move(target));
    }
    to.target_names.push_back(names[t]);
    to.weights.push_back(static_cast<float>(weight));
  }
}

}  // namespace hf_gltf

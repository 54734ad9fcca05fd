// See clip_binding.h.
#include "gltf/clip_binding.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include "gltf/animate.h"
#include "gltf/node_match.h"

namespace hf_gltf {
namespace {

// Less of the animated joints, and the skeletons are not the same. A library's rig has a few joints of its own (hand
// slots, twist joints); another body has none of the names.
constexpr double least_shared = 0.5;

// The text behind the last bar: exporters write "Armature|Walk".
std::string tail_of(const std::string& name) {
  const size_t bar = name.rfind('|');
  return bar == std::string::npos ? name : name.substr(bar + 1);
}

// Lengths of the model's bones over lengths of the clips' bones, over the joints that both skeletons have below a
// joint.
double length_ratio(const Model& model, const Model& clips, const std::map<int, int>& found) {
  double own = 0, other = 0;
  for (const auto& [from, to] : found) {
    const Node &a = clips.nodes[static_cast<size_t>(from)], &b = model.nodes[static_cast<size_t>(to)];
    if (found.count(a.parent) == 0 || b.parent < 0) continue;
    other += glm::length(rest_translation(a));
    own += glm::length(rest_translation(b));
  }
  return own > 0 && other > 0 ? own / other : 1.0;
}

void move_translations(Channel& channel, const glm::dvec3& from, const glm::dvec3& to, double scale) {
  const bool cubic = channel.interpolation == Interpolation::cubic_spline;
  for (size_t i = 0; i + 2 < channel.values.size(); i += 3) {
    const bool tangent = cubic && (i / 3) % 3 != 1;
    for (size_t c = 0; c < 3; ++c) {
      const auto axis = static_cast<int>(c);
      float& x = channel.values[i + c];
      const auto was = static_cast<double>(x);
      x = static_cast<float>(tangent ? scale * was : to[axis] + scale * (was - from[axis]));
    }
  }
}

}  // namespace

bool has_surface(const Model& model) {
  return std::any_of(model.meshes.begin(), model.meshes.end(), [](const MeshData& mesh) {
    return std::any_of(mesh.primitives.begin(), mesh.primitives.end(),
                       [](const Primitive& primitive) { return !primitive.indices.empty(); });
  });
}

bool has_skin(const Model& model) {
  return std::any_of(model.nodes.begin(), model.nodes.end(), [&](const Node& node) {
    if (node.skin < 0 || node.mesh < 0) return false;
    const std::vector<Primitive>& primitives = model.meshes[static_cast<size_t>(node.mesh)].primitives;
    return std::any_of(primitives.begin(), primitives.end(),
                       [](const Primitive& primitive) { return !primitive.influences.empty(); });
  });
}

void insert_clip(Model& model, size_t place, Animation clip) {
  const std::string name = clip.name;
  for (int copy = 2; find_animation(model, clip.name) >= 0; ++copy)
    clip.name = name + " (" + std::to_string(copy) + ")";
  for (const Channel& channel : clip.channels) split_matrix(model.nodes[static_cast<size_t>(channel.node)]);
  model.animations.insert(model.animations.begin() + static_cast<std::ptrdiff_t>(place), std::move(clip));
}

void split_matrix(Node& node) {
  if (!node.matrix) return;
  const glm::dmat4 whole = *node.matrix;
  const glm::mat4 m(whole);
  node.matrix.reset();
  node.translation = glm::dvec3(whole[3]);
  for (int c = 0; c < 3; ++c) node.scale[c] = glm::length(glm::vec3(m[c]));
  if (glm::determinant(glm::mat3(m)) < 0) node.scale = -node.scale;
  glm::mat3 turn(m);
  for (int c = 0; c < 3; ++c) turn[c] /= node.scale[c];
  node.rotation = glm::normalize(glm::quat_cast(turn));
}

std::vector<const Animation*> choose_clips(const Model& model, const std::string& wanted) {
  if (model.animations.empty()) throw std::runtime_error(model.name + " has no clip to transfer");
  std::vector<const Animation*> out;
  if (wanted == "all") {
    for (const Animation& animation : model.animations) out.push_back(&animation);
    return out;
  }
  if (wanted.empty()) return {&model.animations.front()};
  std::vector<size_t> same, tails;
  for (size_t i = 0; i < model.animations.size(); ++i) {
    if (model.animations[i].name == wanted) same.push_back(i);
    if (tail_of(model.animations[i].name) == wanted) tails.push_back(i);
  }
  const std::vector<size_t>& named = same.empty() ? tails : same;
  if (named.size() > 1) {
    std::string numbers;
    for (const size_t i : named) numbers += (numbers.empty() ? "" : ", ") + std::to_string(i);
    throw std::runtime_error(model.name + " has " + std::to_string(named.size()) + " clips \"" + wanted +
                             "\"; give the index of one: " + numbers);
  }
  if (named.size() == 1) return {&model.animations[named.front()]};
  char* end = nullptr;
  const unsigned long index = std::strtoul(wanted.c_str(), &end, 10);
  if (*end == 0 && index < model.animations.size()) return {&model.animations[index]};
  std::string names;
  for (size_t i = 0; i < model.animations.size(); ++i)
    names += (i ? ", " : "") + std::to_string(i) + " \"" + model.animations[i].name + "\"";
  throw std::runtime_error(model.name + " has no clip \"" + wanted + "\"; it has " + names);
}

BoundClips bind_clips(const Model& model, const Model& clips, const std::string& wanted) {
  const std::vector<const Animation*> chosen = choose_clips(clips, wanted);
  std::set<int> moved;
  for (const Animation* clip : chosen) {
    for (const Channel& channel : clip->channels)
      if (channel.path != Path::weights) moved.insert(channel.node);
  }
  BoundClips out;
  out.model = model;
  out.clips = chosen.size();
  out.animated = moved.size();
  const NodeMatch match = match_nodes(clips, {moved.begin(), moved.end()}, model);
  std::map<int, int> found;  // from the clips' nodes to the model's
  for (const int node : moved) {
    const auto n = static_cast<size_t>(node);
    if (match.there[n] >= 0) found[node] = match.there[n];
    if (match.there[n] < 0) out.missing.push_back(clips.nodes[n].name);
    out.shared += match.shared[n] ? 1u : 0u;
  }
  out.joints = found.size();
  if (moved.empty() || static_cast<double>(out.joints) < least_shared * static_cast<double>(moved.size())) {
    throw std::runtime_error(clips.name + " has no surface, and " + model.name + " has " + std::to_string(out.joints) +
                             " of the " + std::to_string(moved.size()) +
                             " joints that its clips move: the skeletons differ. Give a model of its skeleton as the "
                             "source, and the clips with --clips");
  }
  out.scale = length_ratio(model, clips, found);
  size_t done = 0;
  for (const Animation* clip : chosen) {
    Animation bound;
    bound.name = clip->name;
    for (const Channel& channel : clip->channels) {
      const auto here = found.find(channel.node);
      if (channel.path == Path::weights || here == found.end()) continue;
      const Node& from = clips.nodes[static_cast<size_t>(channel.node)];
      Node& to = out.model.nodes[static_cast<size_t>(here->second)];
      split_matrix(to);
      bound.channels.push_back(channel);
      bound.channels.back().node = here->second;
      if (channel.path == Path::translation)
        move_translations(bound.channels.back(), rest_translation(from), rest_translation(to), out.scale);
    }
    insert_clip(out.model, done++, std::move(bound));
  }
  return out;
}

}  // namespace hf_gltf

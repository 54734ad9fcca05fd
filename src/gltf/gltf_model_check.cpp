// The rules that a Model must satisfy before it is written. See gltf_write.h.
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "gltf/gltf_appearance.h"
#include "gltf/gltf_write.h"

namespace hf_gltf {
namespace {

class ModelCheck {
 public:
  explicit ModelCheck(const Model& model) : model_(model) {}

  void run() const {
    for (size_t m = 0; m < model_.meshes.size(); ++m) check_mesh(model_.meshes[m], "mesh " + std::to_string(m));
    for (size_t n = 0; n < model_.nodes.size(); ++n) check_node(model_.nodes[n], static_cast<int>(n));
    check_graph();
    for (size_t s = 0; s < model_.skins.size(); ++s) check_skin(model_.skins[s], "skin " + std::to_string(s));
    for (size_t a = 0; a < model_.animations.size(); ++a) {
      check_animation(model_.animations[a], "animation " + std::to_string(a));
    }
  }

 private:
  [[noreturn]] void fail(const std::string& where, const std::string& message) const {
    throw std::runtime_error((model_.name.empty() ? "the model" : model_.name) + " cannot be written: " + where + " " +
                             message + ".");
  }

  void index(int value, size_t count, const std::string& where) const {
    if (value < -1 || (value >= 0 && static_cast<size_t>(value) >= count)) {
      fail(where, "is " + std::to_string(value) + ", but there are " + std::to_string(count));
    }
  }

  template <typename Vector>
  void finite(const std::vector<Vector>& values, const std::string& where) const {
    for (size_t i = 0; i < values.size(); ++i) {
      for (int c = 0; c < Vector::length(); ++c) {
        if (!std::isfinite(values[i][c])) fail(where, "holds a NaN or infinity in element " + std::to_string(i));
      }
    }
  }
  void finite(const std::vector<float>& values, const std::string& where) const {
    for (size_t i = 0; i < values.size(); ++i) {
      if (!std::isfinite(values[i])) fail(where, "holds a NaN or infinity in element " + std::to_string(i));
    }
  }

  template <typename Vector>
  void attribute(const std::vector<Vector>& values, size_t count, const std::string& where) const {
    if (!values.empty() && values.size() != count) {
      fail(where, "has " + std::to_string(values.size()) + " elements for " + std::to_string(count) + " vertices");
    }
    finite(values, where);
  }

  void check_mesh(const MeshData& mesh, const std::string& where) const {
    const size_t targets = mesh.primitives.empty() ? 0 : mesh.primitives.front().targets.size();
    for (size_t p = 0; p < mesh.primitives.size(); ++p) {
      const std::string inner = where + ", primitive " + std::to_string(p);
      if (mesh.primitives[p].targets.size() != targets) fail(inner, "has another number of morph targets");
      check_primitive(mesh.primitives[p], inner);
    }
    if (!mesh.weights.empty() && mesh.weights.size() != targets) fail(where, "has another number of morph weights");
    finite(mesh.weights, where + " (weights)");
  }

  void check_primitive(const Primitive& o, const std::string& where) const {
    const size_t count = o.positions.size();
    attribute(o.positions, count, where + " (positions)");
    attribute(o.normals, count, where + " (normals)");
    attribute(o.tangents, count, where + " (tangents)");
    attribute(o.colors, count, where + " (colors)");
    for (const auto& set : o.texcoords) {
      if (set.size() != count) fail(where, "has a texture coordinate set of another length");
      attribute(set, count, where + " (texture coordinates)");
    }
    for (const auto& item : o.carried_attributes) check_carried(item.second, count, where + " (" + item.first + ")");
    const size_t corners = o.topology == Topology::points ? 1 : o.topology == Topology::lines ? 2 : 3;
    if (o.indices.size() % corners != 0) fail(where, "has indices left over");
    for (const uint32_t v : o.indices) {
      if (v >= count) fail(where, "names vertex " + std::to_string(v) + " of " + std::to_string(count));
    }
    for (const MorphTarget& target : o.targets) {
      attribute(target.positions, count, where + " (morph target)");
      attribute(target.normals, count, where + " (morph target normals)");
      attribute(target.tangents, count, where + " (morph target tangents)");
    }
    check_influences(o, where);
    const size_t carried = model_.appearance ? model_.appearance->materials.size() : 0;
    index(o.material, std::max(carried, model_.materials.size()), where + "'s material");
  }

  void check_carried(const CarriedNumbers& o, size_t count, const std::string& where) const {
    const int size = tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(o.component));
    if (o.count == 0 || o.count != count || o.type < 1 || o.type > 4 || size <= 0 ||
        o.bytes.size() != o.count * static_cast<size_t>(o.type * size))
      fail(where, "has bytes that do not fit");
  }

  void check_influences(const Primitive& o, const std::string& where) const {
    if (!o.influences.empty() && o.influences.size() != o.positions.size()) {
      fail(where, "has influences of another length");
    }
    for (size_t v = 0; v < o.influences.size(); ++v) {
      float sum = 0;
      for (const float weight : o.influences[v].weights) {
        if (!(weight >= 0) || !std::isfinite(weight)) fail(where, "has a bad weight at vertex " + std::to_string(v));
        sum += weight;
      }
      if (!(sum > 0)) fail(where, "has no weight at vertex " + std::to_string(v));
    }
  }

  void check_node(const Node& node, int n) const {
    const std::string where = "node " + std::to_string(n);
    index(node.parent, model_.nodes.size(), where + "'s parent");
    index(node.mesh, model_.meshes.size(), where + "'s mesh");
    index(node.skin, model_.skins.size(), where + "'s skin");
    for (const int child : node.children) {
      index(child, model_.nodes.size(), where + "'s child");
      if (child < 0 || model_.nodes[static_cast<size_t>(child)].parent != n)
        fail(where, "has a child with another parent");
    }
    finite(std::vector<glm::vec3>{glm::vec3(node.translation), node.scale}, where);
    if (!(std::abs(glm::length(node.rotation) - 1) < 0.01f)) fail(where, "has a rotation that is not of unit length");
    if (node.matrix) {
      for (int c = 0; c < 4; ++c) finite(std::vector<glm::vec4>{glm::vec4((*node.matrix)[c])}, where + " (matrix)");
    }
    finite(node.weights, where + " (weights)");
    index(node.camera, model_.cameras.size(), where + "'s camera");
    if (node.instances) check_instances(*node.instances, where);
    if (!node.weights.empty() && node.mesh >= 0) {
      const auto& primitives = model_.meshes[static_cast<size_t>(node.mesh)].primitives;
      if (!primitives.empty() && primitives.front().targets.size() != node.weights.size()) {
        fail(where, "has another number of morph weights than its mesh has targets");
      }
    }
    if (node.mesh >= 0 && node.skin >= 0) check_skinned_node(node, where);
  }

  void check_instances(const Instances& o, const std::string& where) const {
    const size_t count = std::max({o.translations.size(), o.rotations.size(), o.scales.size()});
    attribute(o.translations, count, where + " (instances)");
    attribute(o.rotations, count, where + " (instances)");
    attribute(o.scales, count, where + " (instances)");
  }

  void check_skinned_node(const Node& node, const std::string& where) const {
    const size_t joints = model_.skins[static_cast<size_t>(node.skin)].joints.size();
    const auto& primitives = model_.meshes[static_cast<size_t>(node.mesh)].primitives;
    size_t weighted = 0;
    for (const Primitive& primitive : primitives) {
      weighted += !primitive.influences.empty();
      for (const Influences& o : primitive.influences) {
        for (size_t k = 0; k < o.weights.size(); ++k) {
          if (o.weights[k] > 0 && o.joints[k] >= joints) fail(where, "has weights for joints its skin lacks");
        }
      }
    }
    if (weighted != 0 && weighted != primitives.size()) {
      fail(where, "has a mesh in which only some primitives have weights; split it into two nodes");
    }
  }

  // Parents and children agree (checked before), so a cycle shows in the parents alone.
  void check_graph() const {
    std::vector<char> done(model_.nodes.size(), 0);
    for (size_t n = 0; n < model_.nodes.size(); ++n) {
      std::vector<size_t> path;
      for (int i = static_cast<int>(n); i >= 0 && done[static_cast<size_t>(i)] != 2;
           i = model_.nodes[static_cast<size_t>(i)].parent) {
        if (done[static_cast<size_t>(i)] == 1) fail("node " + std::to_string(i), "lies on a cycle of parents");
        done[static_cast<size_t>(i)] = 1;
        path.push_back(static_cast<size_t>(i));
      }
      for (const size_t i : path) done[i] = 2;
    }
    for (const Scene& scene : model_.scenes) check_roots(scene.roots);
    check_roots(model_.scene_roots);
  }

  void check_roots(const std::vector<int>& roots) const {
    for (const int root : roots) {
      index(root, model_.nodes.size(), "a scene root");
      if (root < 0 || model_.nodes[static_cast<size_t>(root)].parent >= 0) {
        fail("node " + std::to_string(root), "is listed as a scene root but is none");
      }
    }
  }

  void check_skin(const Skin& skin, const std::string& where) const {
    if (skin.joints.empty()) fail(where, "has no joints");
    if (skin.joints.size() != skin.inverse_bind.size()) fail(where, "has another number of inverse bind matrices");
    std::set<int> seen;
    for (const int joint : skin.joints) {
      index(joint, model_.nodes.size(), where + "'s joint");
      if (joint < 0 || !seen.insert(joint).second) fail(where, "names a joint twice or none");
    }
    index(skin.skeleton, model_.nodes.size(), where + "'s skeleton");
    for (const glm::mat4& matrix : skin.inverse_bind) {
      for (int c = 0; c < 4; ++c) {
        finite(std::vector<glm::vec4>{matrix[c]}, where + " (inverse bind matrix)");
        if (matrix[c][3] != (c == 3 ? 1.0f : 0.0f)) fail(where, "has an inverse bind matrix that is not affine");
      }
    }
  }

  void check_animation(const Animation& animation, const std::string& where) const {
    std::set<std::pair<int, Path>> seen;
    for (size_t c = 0; c < animation.channels.size(); ++c) {
      const std::string inner = where + ", channel " + std::to_string(c);
      const Channel& channel = animation.channels[c];
      index(channel.node, model_.nodes.size(), inner + "'s node");
      if (channel.node < 0) fail(inner, "moves no node");
      if (!seen.insert({channel.node, channel.path}).second) fail(inner, "moves what an earlier channel moves");
      const Node& node = model_.nodes[static_cast<size_t>(channel.node)];
      if (node.matrix && channel.path != Path::weights) fail(inner, "moves a node that is given by a matrix");
      check_keys(channel, inner);
    }
    for (const CarriedChannel& channel : animation.carried_channels) {
      const size_t keys = channel.times.size() * (channel.interpolation == Interpolation::cubic_spline ? 3 : 1);
      if (keys == 0 || channel.values.count % keys != 0) fail(where, "has a carried channel whose keys do not fit");
      check_carried(channel.values, channel.values.count, where + " (carried)");
      finite(channel.times, where + " (times)");
    }
  }

  void check_keys(const Channel& channel, const std::string& where) const {
    const size_t groups = channel.interpolation == Interpolation::cubic_spline ? 3 : 1;
    const size_t width = channel.path == Path::rotation ? 4 : channel.path == Path::weights ? channel.width : 3;
    if (channel.times.empty() || channel.width != width || width == 0 ||
        channel.values.size() != channel.times.size() * groups * width) {
      fail(where, "has " + std::to_string(channel.values.size()) + " values for " +
                      std::to_string(channel.times.size()) + " keys");
    }
    finite(channel.times, where + " (times)");
    finite(channel.values, where + " (values)");
    for (size_t k = 0; k < channel.times.size(); ++k) {
      if (channel.times[k] < 0 || (k > 0 && !(channel.times[k] > channel.times[k - 1]))) {
        fail(where, "has key times that are negative or do not increase at key " + std::to_string(k));
      }
    }
    if (channel.path != Path::rotation) return;
    for (size_t k = 0; k < channel.times.size(); ++k) {
      const float* q = channel.values.data() + (k * groups + groups / 2) * 4;
      const float length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
      if (!(std::abs(length - 1) < 1e-3f))
        fail(where, "has a rotation that is not of unit length at key " + std::to_string(k));
    }
  }

  const Model& model_;
};

}  // namespace

void check_model(const Model& model) { ModelCheck(model).run(); }

}  // namespace hf_gltf

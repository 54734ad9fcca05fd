// See gltf_write.h. The check of the model stands in gltf_model_check.cpp.
#include "gltf/gltf_write.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "gltf/file_bytes.h"
#include "gltf/file_name.h"
#include "gltf/file_write.h"
#include "gltf/gltf_accessor_write.h"
#include "gltf/gltf_appearance.h"
#include "gltf/gltf_pack.h"

namespace hf_gltf {
namespace {

// Arrays of vertices in one file: primitives times attributes and shape keys. An array takes 2.5 KB while it is
// written, 160 MB at this limit; half would refuse crowds of 300 parts with a hundred keys.
constexpr size_t max_vertex_arrays = 65536;

const char* path_name(Path path) {
  switch (path) {
    case Path::translation:
      return "translation";
    case Path::rotation:
      return "rotation";
    case Path::scale:
      return "scale";
    case Path::weights:
      return "weights";
  }
  return "";
}

const char* interpolation_name(Interpolation interpolation) {
  switch (interpolation) {
    case Interpolation::step:
      return "STEP";
    case Interpolation::linear:
      return "LINEAR";
    case Interpolation::cubic_spline:
      return "CUBICSPLINE";
  }
  return "";
}

glm::vec3 unit(const glm::vec3& n) {
  const glm::dvec3 d(n);
  const double length = glm::length(d);
  // a normal that does not exist must still be a unit vector in the file
  return length > 1e-12 && std::isfinite(length) ? glm::vec3(d / length) : glm::vec3(0, 0, 1);
}

// Joints named once, weights descending, their float sum 1 as closely as floats allow.
Influences tidy(const Influences& from) {
  std::map<uint16_t, double> merged;
  double sum = 0;
  for (size_t k = 0; k < 8; ++k) {
    if (!(from.weights[k] > 0)) continue;
    merged[from.joints[k]] += static_cast<double>(from.weights[k]);
    sum += static_cast<double>(from.weights[k]);
  }
  std::vector<std::pair<double, uint16_t>> order;
  for (const auto& item : merged) order.emplace_back(item.second, item.first);
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  Influences to;
  float written = 0;
  for (size_t k = 0; k < order.size(); ++k) {
    to.joints[k] = order[k].second;
    to.weights[k] = static_cast<float>(order[k].first / sum);
    if (to.weights[k] == 0) to.joints[k] = 0;
    written += to.weights[k];
  }
  to.weights[0] += 1.0f - written;
  return to;
}

class Writer : AccessorWriter {
 public:
  explicit Writer(const Model& model) : AccessorWriter(model.name), model_(model) {}

  std::string run(bool binary) {
    check_vertex_arrays();
    out_.asset.version = "2.0";
    out_.asset.generator = "hf samples";
    add_looks();
    add_meshes();
    add_nodes();
    add_skins();
    add_animations();
    return pack_gltf(model_, out_, numbers_, bytes_, binary);
  }

 private:
  void add_looks() {
    if (model_.appearance) {
      const Appearance& looks = *model_.appearance;
      out_.materials = looks.materials;
      out_.textures = looks.textures;
      out_.samplers = looks.samplers;
      for (size_t i = 0; i < looks.images.size(); ++i) out_.images.push_back(embedded(looks.images[i]));
      for (size_t i = 0; i < out_.textures.size(); ++i) {
        // an empty JSON object would be lost
        if (out_.textures[i].name.empty()) out_.textures[i].name = "texture_" + std::to_string(i);
      }
    }
    for (size_t m = out_.materials.size(); m < model_.materials.size(); ++m) add_material(model_.materials[m]);
  }

  tinygltf::Image embedded(const tinygltf::Image& from) {
    tinygltf::Image to;
    to.name = from.name;
    to.extras = from.extras;
    to.extensions = from.extensions;
    to.uri = from.uri;
    if (!from.image.empty()) {
      const std::string type = image_mime_type(from.image);
      to.mimeType = !type.empty() ? type : from.mimeType.empty() ? "application/octet-stream" : from.mimeType;
      to.bufferView = add_view(from.image.data(), from.image.size(), 0);
      to.uri.clear();
    }
    return to;
  }

  void add_material(const Material& from) {
    tinygltf::Material to;
    to.name = from.name;
    to.doubleSided = from.double_sided;
    auto& pbr = to.pbrMetallicRoughness;
    pbr.baseColorFactor.clear();
    for (int c = 0; c < 4; ++c)
      pbr.baseColorFactor.push_back(std::clamp(static_cast<double>(from.base_color[c]), 0.0, 1.0));
    pbr.metallicFactor = std::clamp(static_cast<double>(from.metallic), 0.0, 1.0);
    pbr.roughnessFactor = std::clamp(static_cast<double>(from.roughness), 0.0, 1.0);
    if (from.base_color.a < 1) to.alphaMode = "BLEND";
    if (from.unlit) {
      to.extensions["KHR_materials_unlit"] = tinygltf::Value(tinygltf::Value::Object());
    }
    out_.materials.push_back(std::move(to));
  }

  void check_vertex_arrays() const {
    size_t arrays = 0;
    for (const MeshData& mesh : model_.meshes) {
      for (const Primitive& primitive : mesh.primitives) {
        arrays += 1 + !primitive.normals.empty() + primitive.texcoords.size() + primitive.carried_attributes.size();
        for (const MorphTarget& target : primitive.targets)
          arrays += 1 + !target.normals.empty() + !target.tangents.empty();
      }
    }
    if (arrays <= max_vertex_arrays) return;
    throw std::runtime_error(model_.name + ": the model has " + std::to_string(arrays) +
                             " arrays of vertices, shape keys included, and cannot be written; the limit is " +
                             std::to_string(max_vertex_arrays) + ". Join its primitives or ask for fewer keys.");
  }

  // Primitives without a triangle or line and meshes without a primitive cannot be written; they show nothing.
  void add_meshes() {
    numbers_.meshes.assign(model_.meshes.size(), -1);
    for (size_t m = 0; m < model_.meshes.size(); ++m) {
      const MeshData& from = model_.meshes[m];
      tinygltf::Mesh to;
      to.name = from.name;
      std::vector<int>& numbers = numbers_.primitives.emplace_back();
      for (const Primitive& primitive : from.primitives) {
        numbers.push_back(primitive.indices.empty() ? -1 : static_cast<int>(to.primitives.size()));
        if (!primitive.indices.empty()) to.primitives.push_back(add_primitive(primitive));
      }
      if (to.primitives.empty()) continue;
      to.weights.assign(from.weights.begin(), from.weights.end());
      if (!from.target_names.empty()) {
        tinygltf::Value::Array names;
        for (const std::string& name : from.target_names) names.emplace_back(name);
        tinygltf::Value::Object extras;
        extras["targetNames"] = tinygltf::Value(names);
        to.extras = tinygltf::Value(extras);
      }
      numbers_.meshes[m] = static_cast<int>(out_.meshes.size());
      out_.meshes.push_back(std::move(to));
    }
  }

  tinygltf::Primitive add_primitive(const Primitive& from) {
    tinygltf::Primitive to;
    to.mode = from.topology == Topology::points  ? TINYGLTF_MODE_POINTS
              : from.topology == Topology::lines ? TINYGLTF_MODE_LINE
                                                 : TINYGLTF_MODE_TRIANGLES;
    to.material = from.material;
    to.attributes["POSITION"] = add_vectors(from.positions, true);
    if (!from.normals.empty()) {
      std::vector<glm::vec3> normals(from.normals.size());
      std::transform(from.normals.begin(), from.normals.end(), normals.begin(), unit);
      to.attributes["NORMAL"] = add_vectors(normals);
      add_tangents(from, to);
    }
    for (size_t set = 0; set < from.texcoords.size(); ++set) {
      to.attributes["TEXCOORD_" + std::to_string(set)] = add_vectors(from.texcoords[set]);
    }
    if (!from.colors.empty()) {
      std::vector<glm::vec4> colors = from.colors;
      for (glm::vec4& c : colors) c = glm::clamp(c, 0.0f, 1.0f);
      to.attributes["COLOR_0"] = add_vectors(colors);
    }
    if (!from.influences.empty()) add_influences(from, to);
    for (const auto& item : from.carried_attributes)
      to.attributes[item.first] = add_carried(item.second, TINYGLTF_TARGET_ARRAY_BUFFER);
    to.indices = add_indices(from.indices);
    const bool tangents = to.attributes.count("TANGENT") != 0;
    for (const MorphTarget& target : from.targets) to.targets.push_back(add_target(from, target, tangents));
    return to;
  }

  void add_tangents(const Primitive& from, tinygltf::Primitive& to) {
    if (from.tangents.empty()) return;
    std::vector<glm::vec4> tangents = from.tangents;
    for (glm::vec4& t : tangents) {
      const float length = glm::length(glm::vec3(t));
      if (!(length > 1e-6f)) return;
      t = glm::vec4(unit(glm::vec3(t)), t.w < 0 ? -1.0f : 1.0f);
    }
    to.attributes["TANGENT"] = add_vectors(tangents);
  }

  void add_influences(const Primitive& from, tinygltf::Primitive& to) {
    std::vector<Influences> tidied(from.influences.size());
    uint16_t highest = 0;
    bool second = false;
    for (size_t v = 0; v < tidied.size(); ++v) {
      tidied[v] = tidy(from.influences[v]);
      highest = std::max(highest, *std::max_element(tidied[v].joints.begin(), tidied[v].joints.end()));
      second = second || tidied[v].weights[4] > 0;
    }
    for (size_t set = 0; set < (second ? 2u : 1u); ++set) {
      std::vector<uint8_t> bytes;
      std::vector<uint16_t> shorts;
      std::vector<glm::vec4> weights(tidied.size());
      for (size_t v = 0; v < tidied.size(); ++v) {
        for (size_t k = 0; k < 4; ++k) {
          const uint16_t joint = tidied[v].joints[4 * set + k];
          if (highest < 256) {
            bytes.push_back(static_cast<uint8_t>(joint));
          } else {
            shorts.push_back(joint);
          }
          weights[v][static_cast<int>(k)] = tidied[v].weights[4 * set + k];
        }
      }
      const std::string n = std::to_string(set);
      to.attributes["JOINTS_" + n] =
          highest < 256 ? add_accessor(bytes.data(), tidied.size(), TINYGLTF_TYPE_VEC4,
                                       TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_TARGET_ARRAY_BUFFER)
                        : add_accessor(shorts.data(), tidied.size(), TINYGLTF_TYPE_VEC4,
                                       TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TARGET_ARRAY_BUFFER);
      to.attributes["WEIGHTS_" + n] = add_vectors(weights);
    }
  }

  std::map<std::string, int> add_target(const Primitive& from, const MorphTarget& target, bool tangents) {
    std::map<std::string, int> to;
    const std::vector<glm::vec3> none(target.positions.empty() ? from.positions.size() : 0, glm::vec3(0));
    to["POSITION"] = add_displacements(target.positions.empty() ? none : target.positions, true);
    if (!target.normals.empty() && !from.normals.empty()) to["NORMAL"] = add_displacements(target.normals);
    if (!target.tangents.empty() && tangents) to["TANGENT"] = add_displacements(target.tangents);
    return to;
  }

  bool is_skinned(const Node& node) const {
    if (node.skin < 0 || node.mesh < 0) return false;
    const auto& primitives = model_.meshes[static_cast<size_t>(node.mesh)].primitives;
    return std::any_of(primitives.begin(), primitives.end(), [](const Primitive& p) { return !p.influences.empty(); });
  }

  void add_nodes() {
    for (size_t n = 0; n < model_.nodes.size(); ++n) out_.nodes.push_back(make_node(model_.nodes[n], n));
    for (const Node& node : model_.nodes) numbers_.instances.push_back(add_instances(node));
    if (out_.nodes.empty() && model_.scenes.empty()) return;
    std::vector<Scene> scenes = model_.scenes;
    if (scenes.empty()) scenes.resize(1);
    const size_t shown = model_.shown_scene < scenes.size() ? model_.shown_scene : 0;
    scenes[shown].roots = model_.scene_roots;
    // only a single scene may stand for every root node
    for (size_t n = 0; scenes.size() == 1 && model_.scene_roots.empty() && n < model_.nodes.size(); ++n) {
      if (model_.nodes[n].parent < 0) scenes[0].roots.push_back(static_cast<int>(n));
    }
    for (const Scene& from : scenes) {
      tinygltf::Scene scene;
      scene.name = from.name;
      scene.nodes = from.roots;
      // an empty JSON object would be lost
      if (scene.name.empty() && scene.nodes.empty()) scene.name = "scene_" + std::to_string(out_.scenes.size());
      out_.scenes.push_back(std::move(scene));
    }
    out_.defaultScene = static_cast<int>(shown);
  }

  WrittenNumbers::InstanceAccessors add_instances(const Node& node) {
    WrittenNumbers::InstanceAccessors out;
    if (!node.instances || node.mesh < 0 || numbers_.meshes[static_cast<size_t>(node.mesh)] < 0) return out;
    const auto add = [&](const auto& values, int type) {
      return values.empty() ? -1 : add_accessor(values.data(), values.size(), type, TINYGLTF_COMPONENT_TYPE_FLOAT, 0);
    };
    out.translations = add(node.instances->translations, TINYGLTF_TYPE_VEC3);
    out.rotations = add(node.instances->rotations, TINYGLTF_TYPE_VEC4);
    out.scales = add(node.instances->scales, TINYGLTF_TYPE_VEC3);
    return out;
  }

  tinygltf::Node make_node(const Node& from, size_t n) const {
    tinygltf::Node to;
    // an empty JSON object would be lost
    to.name = from.name.empty() ? "node_" + std::to_string(n) : from.name;
    to.children = from.children;
    to.mesh = from.mesh < 0 ? -1 : numbers_.meshes[static_cast<size_t>(from.mesh)];
    if (to.mesh >= 0 && is_skinned(from)) to.skin = from.skin;
    if (to.mesh >= 0) to.weights.assign(from.weights.begin(), from.weights.end());
    if (from.matrix) {
      for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) to.matrix.push_back((*from.matrix)[c][r]);
      }
      return to;
    }
    if (from.translation != glm::dvec3(0)) {
      to.translation = {from.translation.x, from.translation.y, from.translation.z};
    }
    const glm::dquat q = glm::normalize(glm::dquat(from.rotation));
    if (q != glm::dquat(1, 0, 0, 0)) to.rotation = {q.x, q.y, q.z, q.w};
    if (from.scale != glm::vec3(1)) to.scale = {from.scale.x, from.scale.y, from.scale.z};
    return to;
  }

  // Numbers every node in depth-first order: those below a node lie between its own number and its last.
  void number_nodes() {
    const size_t count = model_.nodes.size();
    enter_.assign(count, 0);
    last_.assign(count, 0);
    int next = 0;
    std::vector<std::pair<size_t, size_t>> path;  // node, children done
    for (size_t root = 0; root < count; ++root) {
      if (model_.nodes[root].parent >= 0) continue;
      enter_[root] = next++;
      path.emplace_back(root, 0);
      while (!path.empty()) {
        const size_t n = path.back().first;
        const std::vector<int>& children = model_.nodes[n].children;
        if (path.back().second == children.size()) {
          last_[n] = next - 1;
          path.pop_back();
          continue;
        }
        const auto child = static_cast<size_t>(children[path.back().second++]);
        enter_[child] = next++;
        path.emplace_back(child, 0);
      }
    }
  }

  bool is_ancestor(int node, int below) const {
    const int at = enter_[static_cast<size_t>(below)];
    return at >= enter_[static_cast<size_t>(node)] && at <= last_[static_cast<size_t>(node)];
  }

  void add_skins() {
    if (!model_.skins.empty()) number_nodes();
    for (const Skin& from : model_.skins) {
      tinygltf::Skin to;
      to.name = from.name;
      to.joints = from.joints;
      const bool root = from.skeleton >= 0 && std::all_of(from.joints.begin(), from.joints.end(),
                                                          [&](int joint) { return is_ancestor(from.skeleton, joint); });
      to.skeleton = root ? from.skeleton : -1;
      to.inverseBindMatrices = add_accessor(from.inverse_bind.data(), from.inverse_bind.size(), TINYGLTF_TYPE_MAT4,
                                            TINYGLTF_COMPONENT_TYPE_FLOAT, 0);
      out_.skins.push_back(std::move(to));
    }
  }

  void add_animations() {
    for (const Animation& from : model_.animations) {
      tinygltf::Animation to;
      to.name = from.name;
      std::map<std::vector<float>, int> inputs;
      begin_keys();
      for (const Channel& channel : from.channels) {
        const int node_mesh = model_.nodes[static_cast<size_t>(channel.node)].mesh;
        if (channel.path == Path::weights && (node_mesh < 0 || numbers_.meshes[static_cast<size_t>(node_mesh)] < 0))
          continue;
        const auto known = inputs.find(channel.times);
        const int input = known != inputs.end()
                              ? known->second
                              : add_keys(channel.times.data(), channel.times.size(), TINYGLTF_TYPE_SCALAR, true);
        inputs.emplace(channel.times, input);
        tinygltf::AnimationSampler sampler;
        sampler.input = input;
        sampler.output = add_values(channel);
        sampler.interpolation = interpolation_name(channel.interpolation);
        tinygltf::AnimationChannel target;
        target.sampler = static_cast<int>(to.samplers.size());
        target.target_node = channel.node;
        target.target_path = path_name(channel.path);
        to.samplers.push_back(sampler);
        to.channels.push_back(target);
      }
      add_carried_keys(from);
      const bool empty = to.channels.empty() && from.carried_channels.empty();
      numbers_.animations.push_back(empty ? -1 : static_cast<int>(out_.animations.size()));
      // glTF has no empty animation
      if (!empty) out_.animations.push_back(std::move(to));
    }
  }

  // Their keys. gltf_pack.cpp adds samplers and channels: tinygltf leaves out an animation that moves no node.
  void add_carried_keys(const Animation& from) {
    auto& numbers = numbers_.carried_keys.emplace_back();
    for (const CarriedChannel& channel : from.carried_channels) {
      const int input = add_accessor(channel.times.data(), channel.times.size(), TINYGLTF_TYPE_SCALAR,
                                     TINYGLTF_COMPONENT_TYPE_FLOAT, 0, true);
      numbers.push_back({input, add_carried(channel.values, 0), interpolation_name(channel.interpolation)});
    }
  }

  int add_values(const Channel& channel) {
    const bool scalars = channel.path == Path::weights;
    const size_t width = scalars ? 1 : channel.width;
    const int type = scalars ? TINYGLTF_TYPE_SCALAR : width == 4 ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3;
    if (!channel.shorts) return add_keys(channel.values.data(), channel.values.size() / width, type);
    std::vector<int16_t> values;
    for (const float value : channel.values) values.push_back(static_cast<int16_t>(std::lround(value * 32767)));
    return add_short_keys(values.data(), values.size() / width, type);
  }

  const Model& model_;
  WrittenNumbers numbers_;
  std::vector<int> enter_, last_;  // see number_nodes()
};

}  // namespace

std::string gltf_bytes(const Model& model, bool binary) {
  check_model(model);
  return Writer(model).run(binary);
}

bool is_binary_name(const std::filesystem::path& file) {
  const std::string extension = ending_of(file);
  if (extension == ".glb" || extension == ".gltf" || extension == ".vrm") return extension != ".gltf";
  throw std::runtime_error(file.string() +
                           ": models are written as glTF; give a name that ends in .glb, .gltf or .vrm.");
}

size_t image_count(const Model& model) { return model.appearance ? model.appearance->images.size() : 0; }

void write_gltf(const Model& model, const std::filesystem::path& file) {
  const bool binary = is_binary_name(file);
  const std::string& extensions = model.carried.extensions;
  const bool avatar =
      extensions.find("\"VRM\"") != std::string::npos || extensions.find("\"VRMC_vrm\"") != std::string::npos;
  if (ending_of(file) == ".vrm" && !avatar)
    throw std::runtime_error(file.string() +
                             ": the model has no humanoid map and no licence as a .vrm file needs them; write .glb.");
  write_bytes(file, gltf_bytes(model, binary));
}

}  // namespace hf_gltf

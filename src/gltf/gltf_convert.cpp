// See gltf_convert.h. Nodes, skins and looks here; meshes in gltf_meshes.cpp, animations in gltf_animations.cpp.
#include "gltf/gltf_convert.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "gltf/file_bytes.h"
#include "gltf/gltf_appearance.h"
#include "gltf/gltf_convert_parts.h"

namespace hf_gltf {
namespace {

glm::vec3 to_vec3(const std::vector<double>& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

std::vector<float> to_floats(const std::vector<double>& values) { return {values.begin(), values.end()}; }

class Converter {
 public:
  Converter(GltfSource& source, const ReadLimits& limits) : in_(source, limits) {}

  Model run() {
    Model& model = in_.model;
    model.name = in_.source.name;
    model.warnings = std::move(in_.source.warnings);
    convert_nodes();
    convert_skins();
    convert_meshes(in_);
    check_node_weights();
    convert_animations(in_);
    convert_scene();
    convert_looks();
    carry(model, in_.source.carried);
    say_up();
    return std::move(model);
  }

 private:
  int index(int value, size_t count, const std::string& where) const {
    if (value < -1 || (value >= 0 && static_cast<size_t>(value) >= count)) {
      in_.fail(where, "names element " + std::to_string(value) + " of " + std::to_string(count));
    }
    return value;
  }

  void convert_nodes() {
    const auto& nodes = in_.source.gltf.nodes;
    in_.model.nodes.resize(nodes.size());
    for (size_t n = 0; n < nodes.size(); ++n) convert_node(nodes[n], n);
    for (size_t n = 0; n < nodes.size(); ++n) {
      for (const int child : in_.model.nodes[n].children) {
        in_.model.nodes[static_cast<size_t>(child)].parent = static_cast<int>(n);
      }
    }
  }

  void convert_node(const tinygltf::Node& from, size_t n) {
    const std::string where = "nodes[" + std::to_string(n) + "]";
    const tinygltf::Model& gltf = in_.source.gltf;
    Node& to = in_.model.nodes[n];
    to.name = from.name;
    to.mesh = index(from.mesh, gltf.meshes.size(), where + ".mesh");
    to.skin = index(from.skin, gltf.skins.size(), where + ".skin");
    for (const int child : from.children) {
      if (index(child, gltf.nodes.size(), where + ".children") < 0) in_.fail(where, "names no child");
      to.children.push_back(child);
    }
    to.weights = to_floats(from.weights);
    const bool trs = !from.translation.empty() || !from.rotation.empty() || !from.scale.empty();
    if (from.matrix.size() == 16) {
      glm::dmat4 matrix(1);
      for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) matrix[c][r] = from.matrix[static_cast<size_t>(4 * c + r)];
      }
      if (matrix[0][3] != 0 || matrix[1][3] != 0 || matrix[2][3] != 0 || matrix[3][3] != 1) {
        in_.fail(where + ".matrix", "is not affine: its last row is not 0 0 0 1");
      }
      to.matrix = matrix;
      if (trs) in_.warn(where + " has a matrix and TRS; the matrix counts");
      return;
    }
    if (from.translation.size() == 3) to.translation = {from.translation[0], from.translation[1], from.translation[2]};
    if (from.scale.size() == 3) to.scale = to_vec3(from.scale);
    if (from.rotation.size() == 4) {
      const auto& r = from.rotation;
      const double length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
      if (!(length > 1e-6) || !std::isfinite(length)) {
        in_.fail(where + ".rotation", "has length " + std::to_string(length) + ", a quaternion must have length 1");
      }
      to.rotation = glm::quat(static_cast<float>(r[3] / length), static_cast<float>(r[0] / length),
                              static_cast<float>(r[1] / length), static_cast<float>(r[2] / length));
      if (std::abs(length - 1) > 0.01) in_.warn(where + ".rotation is not of unit length and was normalised");
    }
  }

  void convert_skins() {
    const tinygltf::Model& gltf = in_.source.gltf;
    for (size_t s = 0; s < gltf.skins.size(); ++s) {
      const std::string where = "skins[" + std::to_string(s) + "]";
      const tinygltf::Skin& from = gltf.skins[s];
      Skin to;
      to.name = from.name;
      to.skeleton = index(from.skeleton, gltf.nodes.size(), where + ".skeleton");
      if (from.joints.size() > 65535) in_.fail(where, "has more than 65535 joints");
      for (const int joint : from.joints) {
        if (index(joint, gltf.nodes.size(), where + ".joints") < 0) in_.fail(where + ".joints", "names no node");
        to.joints.push_back(joint);
      }
      to.inverse_bind.assign(to.joints.size(), glm::mat4(1));
      if (from.inverseBindMatrices >= 0)
        read_inverse_bind(from.inverseBindMatrices, to, where + ".inverseBindMatrices");
      in_.model.skins.push_back(std::move(to));
    }
  }

  void read_inverse_bind(int accessor, Skin& skin, const std::string& where) {
    if (in_.reader.count(accessor, where) < skin.joints.size()) {
      in_.fail(where, "has " + std::to_string(in_.reader.count(accessor, where)) + " matrices for " +
                          std::to_string(skin.joints.size()) + " joints");
    }
    const std::vector<float> values = in_.reader.floats(accessor, TINYGLTF_TYPE_MAT4, Stored::floats, where);
    for (size_t j = 0; j < skin.joints.size(); ++j) {
      for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) skin.inverse_bind[j][c][r] = values[16 * j + static_cast<size_t>(4 * c + r)];
      }
      glm::mat4& matrix = skin.inverse_bind[j];
      const bool affine = std::abs(matrix[0][3]) < 1e-4f && std::abs(matrix[1][3]) < 1e-4f &&
                          std::abs(matrix[2][3]) < 1e-4f && std::abs(matrix[3][3] - 1) < 1e-4f;
      if (!affine) in_.fail(where + "[" + std::to_string(j) + "]", "is not affine: its last row is not 0 0 0 1");
      for (int c = 0; c < 4; ++c) matrix[c][3] = c == 3 ? 1.0f : 0.0f;
    }
  }

  // Morph weights of a node must fit its mesh.
  void check_node_weights() {
    uint64_t weights = 0;
    for (size_t n = 0; n < in_.model.nodes.size(); ++n) {
      Node& node = in_.model.nodes[n];
      const size_t targets = node.mesh < 0 ? 0 : target_count(in_.model.meshes[static_cast<size_t>(node.mesh)]);
      weights += targets;  // a pose holds them all
      if (weights > in_.limits.max_morph_weights) {
        in_.fail("nodes[" + std::to_string(n) + "]", "takes the morph weights of all nodes to " +
                                                         std::to_string(weights) + ", above the limit of " +
                                                         std::to_string(in_.limits.max_morph_weights) +
                                                         "; raise max_morph_weights if the file is to be trusted");
      }
      if (node.weights.empty()) continue;
      if (node.weights.size() == targets) continue;
      if (node.mesh >= 0 && targets > 0) {
        in_.fail("nodes[" + std::to_string(n) + "].weights", "has " + std::to_string(node.weights.size()) +
                                                                 " numbers where its mesh has " +
                                                                 std::to_string(targets) + " morph targets");
      }
      in_.warn("nodes[" + std::to_string(n) + "].weights belong to no morph target and are dropped");
      node.weights.clear();
    }
  }

  void convert_scene() {
    const tinygltf::Model& gltf = in_.source.gltf;
    Model& model = in_.model;
    if (gltf.scenes.empty()) {
      for (size_t n = 0; n < model.nodes.size(); ++n) {
        if (model.nodes[n].parent < 0) model.scene_roots.push_back(static_cast<int>(n));
      }
      return;
    }
    model.shown_scene = static_cast<size_t>(std::max(index(gltf.defaultScene, gltf.scenes.size(), "scene"), 0));
    for (const tinygltf::Scene& from : gltf.scenes) {
      Scene to;
      to.name = from.name;
      std::vector<char> seen(gltf.nodes.size(), 0);
      for (const int node : from.nodes) {
        if (index(node, gltf.nodes.size(), "scenes") < 0) continue;
        const auto n = static_cast<size_t>(node);
        if (seen[n] || model.nodes[n].parent >= 0) {
          in_.warn("scene node " + std::to_string(n) + " is not a root or is named twice");
          continue;
        }
        seen[n] = 1;
        to.roots.push_back(node);
      }
      model.scenes.push_back(std::move(to));
    }
    model.scene_roots = model.scenes[model.shown_scene].roots;
  }

  // The lists of the carried document are as long as the lists of the model: both count the checked document.
  void carry(Model& model, CarriedDocument& from) {
    model.carried = std::move(from.top);
    model.asset = std::move(from.asset);
    model.cameras = std::move(from.cameras);
    model.required_extensions = std::move(from.required);
    const auto give = [](std::vector<Carried>& carried, auto& to) {
      for (size_t i = 0; i < to.size() && i < carried.size(); ++i) to[i].carried = std::move(carried[i]);
    };
    give(from.scenes, model.scenes);
    give(from.nodes, model.nodes);
    give(from.meshes, model.meshes);
    give(from.skins, model.skins);
    for (size_t n = 0; n < model.nodes.size(); ++n) {
      if (n < from.node_cameras.size()) model.nodes[n].camera = from.node_cameras[n];
      if (n < from.node_instances.size() && !from.node_instances[n].is_null())
        read_instances(from.node_instances[n], n);
    }
  }

  void read_instances(const nlohmann::json& attributes, size_t n) {
    const std::string where = "nodes[" + std::to_string(n) + "] (EXT_mesh_gpu_instancing)";
    Instances to;
    size_t count = 0;
    for (const auto& item : attributes.items()) {
      const bool turn = item.key() == "ROTATION";
      if (!turn && item.key() != "TRANSLATION" && item.key() != "SCALE") {
        in_.warn(where + ": attribute " + item.key().substr(0, 60) + " is not kept");
        continue;
      }
      const int accessor = item.value().get<int>();
      const size_t rows = in_.reader.count(accessor, where), width = turn ? 4 : 3;
      if (count != 0 && rows != count) in_.fail(where, "has attributes of different lengths");
      count = rows;
      in_.reader.charge(static_cast<uint64_t>(rows) * width * sizeof(float), where);
      const std::vector<float> values =
          in_.reader.floats(accessor, turn ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3,
                            turn ? Stored::signed_normalized : Stored::floats, where + "." + item.key());
      for (size_t i = 0; i < rows; ++i) {
        const float* v = values.data() + width * i;
        if (turn) {
          to.rotations.emplace_back(v[0], v[1], v[2], v[3]);
        } else {
          (item.key() == "SCALE" ? to.scales : to.translations).emplace_back(v[0], v[1], v[2]);
        }
      }
    }
    if (count == 0) return;
    in_.warn(where + " shows its mesh " + std::to_string(count) + " times; the places are kept, not posed");
    in_.model.nodes[n].instances = std::move(to);
  }

  // glTF is Y up. Exporters of Z-up tools turn the root.
  void say_up() {
    for (const int root : in_.model.scene_roots) {
      const Node& node = in_.model.nodes[static_cast<size_t>(root)];
      const glm::mat3 turn = node.matrix ? glm::mat3(glm::dmat3(*node.matrix)) : glm::mat3_cast(node.rotation);
      const float length = glm::length(turn[2]);
      // its z axis points up to a degree
      if (!(length > 0) || turn[2].y < 0.9998f * length) continue;
      in_.model.notes.push_back("root node " + std::to_string(root) + " turns the model from Z up to glTF's Y up");
      return;
    }
  }

  void convert_looks() {
    tinygltf::Model& gltf = in_.source.gltf;
    auto looks = std::make_shared<Appearance>();
    for (const tinygltf::Material& from : gltf.materials) in_.model.materials.push_back(plain_material(from));
    looks->materials = std::move(gltf.materials);
    looks->textures = std::move(gltf.textures);
    looks->images = std::move(gltf.images);
    looks->samplers = std::move(gltf.samplers);
    in_.model.appearance = std::move(looks);
  }

  static Material plain_material(const tinygltf::Material& from) {
    Material to;
    to.name = from.name;
    to.double_sided = from.doubleSided;
    const auto& pbr = from.pbrMetallicRoughness;
    for (size_t c = 0; c < 4 && c < pbr.baseColorFactor.size(); ++c) {
      to.base_color[static_cast<int>(c)] = static_cast<float>(std::clamp(pbr.baseColorFactor[c], 0.0, 1.0));
    }
    to.metallic = static_cast<float>(std::clamp(pbr.metallicFactor, 0.0, 1.0));
    to.roughness = static_cast<float>(std::clamp(pbr.roughnessFactor, 0.0, 1.0));
    return to;
  }

  Conversion in_;
};

}  // namespace

void Conversion::fail(const std::string& where, const std::string& message) const {
  throw std::runtime_error(source.name + ": " + printable(where + " " + message) + ".");
}

size_t target_count(const MeshData& mesh) {
  return mesh.primitives.empty() ? 0 : mesh.primitives.front().targets.size();
}

Model convert(GltfSource& source, const ReadLimits& limits) { return Converter(source, limits).run(); }

}  // namespace hf_gltf

// Makes a model of the scene that assimp reads, and a GLB of the model: foreign_glb_here() of foreign_file.h.
//
// The writer of glTF that assimp has is not used: it makes one skin for all meshes and keeps four joints per vertex.
// Lengths: an FBX file states its unit in centimetres, COLLADA in metres (assimp scales the root by it), BVH has none.
// The unit is multiplied into places, bind matrices and keys, so that no node scales for it.
#ifdef HF_GLTF_ASSIMP
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <map>
#include <new>
#include <stdexcept>
#include <unordered_map>

#include "gltf/animate.h"
#include "gltf/clip_binding.h"
#include "gltf/file_bytes.h"
#include "gltf/foreign_file.h"
#include "gltf/foreign_mesh.h"
#include "gltf/gltf_read.h"
#include "gltf/gltf_write.h"

namespace hf_gltf {
namespace {

// How far a matrix may be from the product of its parts, and a joint from where its skin was bound, by the largest
// entry: above the rounding of floats.
constexpr double rounding = 1e-5;
// Ticks per second where the file says 0, as in assimp.
constexpr double default_ticks = 25;

std::string text_of(const aiString& s) { return printable({s.C_Str(), s.length}); }

double largest_entry(const glm::dmat4& m) {
  double out = 0;
  for (int c = 0; c < 4; ++c)
    for (int row = 0; row < 4; ++row) out = std::max(out, std::fabs(m[c][row]));
  return out;
}

bool agree(const glm::dmat4& a, const glm::dmat4& b) {
  return largest_entry(a - b) <= rounding * std::max(largest_entry(a), largest_entry(b));
}

glm::dmat4 local_of(const Node& node) {
  Model one;
  one.nodes.push_back(node);
  one.nodes[0].mesh = -1;
  return local_matrix(rest_pose(one)[0]);
}

// Sets translation, rotation and scale, or the matrix where it shears.
void place(Node& node, const glm::dmat4& local) {
  node.matrix = local;
  Node parts = node;
  split_matrix(parts);
  if (agree(local_of(parts), local)) node = parts;
}

class SceneModel {
 public:
  SceneModel(const aiScene& scene, FileKind kind, const std::string& name, std::vector<std::string>& warnings)
      : scene_(scene), fbx_(kind == FileKind::fbx), warnings_(warnings) {
    model_.name = name;
    set_root(kind);
  }

  Model run() {
    add_materials();
    add_node(*scene_.mRootNode, -1, 0);
    for (const auto& [node, mesh] : surfaces_) add_surfaces(node, *mesh);
    if (fbx_) rest_where_bound();
    for (unsigned m = 0; m < scene_.mNumAnimations; ++m) add_clip(*scene_.mAnimations[m]);
    if (lost_bones_)
      warnings_.push_back(std::to_string(lost_bones_) +
                          " bones of skins have no node and are left out; export the skeleton with the mesh");
    if (lost_channels_)
      warnings_.push_back(
          std::to_string(lost_channels_) +
          " curves are left out: they move a pivot, or no node has their name; bake the clip before export");
    if (shared_names_)
      warnings_.push_back(std::to_string(shared_names_) +
                          " nodes have the name of another, and a clip may move the wrong one; rename them");
    if (lost_faces_)
      warnings_.push_back(std::to_string(lost_faces_) + " points and lines are left out; only faces are read");
    return std::move(model_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw std::runtime_error(model_.name + ": " + what); }

  void set_root(FileKind kind) {
    root_ = scene_.mRootNode->mTransformation;
    if (kind == FileKind::dae) {
      unit_ = static_cast<float>(std::sqrt(root_.a1 * root_.a1 + root_.b1 * root_.b1 + root_.c1 * root_.c1));
      if (!(unit_ > 0) || !std::isfinite(unit_)) unit_ = 1;
      const aiMatrix4x4 whole(aiVector3D(1 / unit_, 1 / unit_, 1 / unit_), aiQuaternion(), aiVector3D());
      root_ = root_ * whole;
    }
    if (!fbx_) return;
    root_ = aiMatrix4x4();  // newer releases of assimp put the axes there, older ones do not
    if (!scene_.mMetaData) return;
    float centimetres = 1;
    double exact = 1;
    if (scene_.mMetaData->Get("UnitScaleFactor", exact)) centimetres = static_cast<float>(exact);
    scene_.mMetaData->Get("UnitScaleFactor", centimetres);
    unit_ = centimetres > 0 && std::isfinite(centimetres) ? 0.01f * centimetres : 0.01f;
    aiMatrix4x4 axes;
    const char* names[3][2] = {
        {"CoordAxis", "CoordAxisSign"}, {"UpAxis", "UpAxisSign"}, {"FrontAxis", "FrontAxisSign"}};
    for (unsigned row = 0; row < 3; ++row) {
      int32_t axis = static_cast<int32_t>(row), sign = 1;
      scene_.mMetaData->Get(names[row][0], axis);
      scene_.mMetaData->Get(names[row][1], sign);
      for (unsigned c = 0; c < 3; ++c)
        axes[row][c] = static_cast<int32_t>(c) == axis ? (sign < 0 ? -1.0f : 1.0f) : 0.0f;
    }
    if (axes.Determinant() > 0.5f)
      root_ = axes;
    else
      warnings_.push_back("its axes are not right-handed, so y is taken as up; export it with right-handed axes");
  }

  glm::dmat4 matrix_of(const aiMatrix4x4& m) const {
    glm::dmat4 out;
    for (unsigned row = 0; row < 4; ++row)
      for (unsigned c = 0; c < 4; ++c)
        out[static_cast<int>(c)][static_cast<int>(row)] =
            static_cast<double>(m[row][c]) * (c == 3 && row < 3 ? unit_ : 1);
    return out;
  }

  void add_node(const aiNode& from, int parent, uint32_t depth) {
    const ReadLimits limits;
    if (depth > limits.max_node_depth || model_.nodes.size() >= limits.max_nodes)
      fail("has more than " + std::to_string(limits.max_nodes) + " nodes, or nodes more than " +
           std::to_string(limits.max_node_depth) + " deep; split it into several files");
    int self = parent;
    // the root of FBX stands for the file alone
    if (depth > 0 || !fbx_ || from.mNumMeshes > 0 || root_ != aiMatrix4x4()) {
      self = static_cast<int>(model_.nodes.size());
      Node& node = model_.nodes.emplace_back();
      node.name = text_of(from.mName);
      place(node, matrix_of(depth == 0 ? root_ : from.mTransformation));
      attach(self, parent);
      const auto [known, is_new] = by_name_.emplace(from.mName.C_Str(), self);
      shared_names_ += !is_new;
      if (!is_new && from.mNumMeshes == 0) known->second = self;  // a bone under an object of its name
      if (from.mNumMeshes > 0) surfaces_.emplace_back(self, &from);
    }
    for (unsigned c = 0; c < from.mNumChildren; ++c) add_node(*from.mChildren[c], self, depth + 1);
  }

  void attach(int self, int parent) {
    model_.nodes[static_cast<size_t>(self)].parent = parent;
    if (parent >= 0)
      model_.nodes[static_cast<size_t>(parent)].children.push_back(self);
    else
      model_.scene_roots.push_back(self);
  }

  int node_named(const aiString& name) const {
    const auto found = by_name_.find(name.C_Str());
    return found == by_name_.end() ? -1 : found->second;
  }

  void add_materials() {
    size_t textured = 0;
    for (unsigned m = 0; m < scene_.mNumMaterials; ++m) {
      const aiMaterial& from = *scene_.mMaterials[m];
      Material material;
      aiString name;
      if (from.Get(AI_MATKEY_NAME, name) == AI_SUCCESS) material.name = text_of(name);
      aiColor4D color(1, 1, 1, 1);
      if (from.Get(AI_MATKEY_BASE_COLOR, color) != AI_SUCCESS) from.Get(AI_MATKEY_COLOR_DIFFUSE, color);
      material.base_color = glm::clamp(glm::vec4(color.r, color.g, color.b, 1), 0.0f, 1.0f);
      material.metallic = 0;
      int both = 0;
      material.double_sided = from.Get(AI_MATKEY_TWOSIDED, both) == AI_SUCCESS && both != 0;
      for (int kind = aiTextureType_DIFFUSE; kind <= AI_TEXTURE_TYPE_MAX; ++kind)
        if (from.GetTextureCount(static_cast<aiTextureType>(kind)) > 0) {
          ++textured;
          break;
        }
      model_.materials.push_back(material);
    }
    if (textured)
      warnings_.push_back("textures of " + std::to_string(textured) +
                          " materials are left out; glTF exported from Blender keeps them");
  }

  static bool have_one_rig(const aiMesh& a, const aiMesh& b) {
    bool out = a.mNumBones == b.mNumBones && a.mNumAnimMeshes == b.mNumAnimMeshes;
    for (unsigned k = 0; out && k < a.mNumBones; ++k)
      out = a.mBones[k]->mName == b.mBones[k]->mName && a.mBones[k]->mOffsetMatrix == b.mBones[k]->mOffsetMatrix;
    return out;
  }

  // The meshes of a node, one for each material. Those that follow with the same bones become one; others hang on nodes
  // of their own.
  void add_surfaces(int node, const aiNode& from) {
    int holder = node;
    for (unsigned m = 0; m < from.mNumMeshes;) {
      const aiMesh& first = *scene_.mMeshes[from.mMeshes[m]];
      MeshData mesh;
      mesh.name = text_of(first.mName);
      for (unsigned t = 0; t < first.mNumAnimMeshes; ++t) {
        // assimp gives shape keys of FBX the weight 1, whatever the file says
        mesh.weights.push_back(fbx_ ? 0 : first.mAnimMeshes[t]->mWeight);
        mesh.target_names.push_back(text_of(first.mAnimMeshes[t]->mName));
      }
      Skin skin;
      for (unsigned b = 0; b < first.mNumBones; ++b) {
        const int joint = node_named(first.mBones[b]->mName);
        if (joint < 0) {
          lost_bones_ += first.mBones[b]->mNumWeights > 0;
        } else if (std::find(skin.joints.begin(), skin.joints.end(), joint) == skin.joints.end()) {
          skin.joints.push_back(joint);
          skin.inverse_bind.emplace_back(matrix_of(first.mBones[b]->mOffsetMatrix));
        }
      }
      for (; m < from.mNumMeshes && have_one_rig(first, *scene_.mMeshes[from.mMeshes[m]]); ++m)
        if (Primitive part = part_of(*scene_.mMeshes[from.mMeshes[m]], node, skin); !part.indices.empty())
          mesh.primitives.push_back(std::move(part));
      if (mesh.primitives.empty()) continue;
      if (holder < 0) {
        holder = static_cast<int>(model_.nodes.size());
        model_.nodes.emplace_back().name = mesh.name;
        attach(holder, node);
      }
      Node& to = model_.nodes[static_cast<size_t>(holder)];
      to.mesh = static_cast<int>(model_.meshes.size());
      model_.meshes.push_back(std::move(mesh));
      holder = -1;
      if (skin.joints.empty()) continue;
      to.skin = static_cast<int>(model_.skins.size());
      model_.skins.push_back(std::move(skin));
    }
  }

  Primitive part_of(const aiMesh& mesh, int node, Skin& skin) {
    ForeignMesh part{mesh, node, unit_, [this](const char* name) { return node_named(aiString(name)); }};
    Primitive out = foreign_primitive(part, skin);
    out.material = mesh.mMaterialIndex < model_.materials.size() ? static_cast<int>(mesh.mMaterialIndex) : -1;
    lost_faces_ += part.lost_faces;
    return out;
  }

  // The nodes of an FBX file stand as they did when it was saved, perhaps in the middle of a clip. This moves joints to
  // where their skins were bound: there the surface has its stored shape.
  void rest_where_bound() {
    const std::vector<glm::dmat4> before = global_matrices(model_, rest_pose(model_));
    std::unordered_map<int, glm::dmat4> bound;
    for (const auto& [node, mesh] : surfaces_) {
      const int skin = model_.nodes[static_cast<size_t>(node)].skin;
      if (skin < 0) continue;
      const Skin& of = model_.skins[static_cast<size_t>(skin)];
      for (size_t j = 0; j < of.joints.size(); ++j)
        if (glm::dmat4 bind(of.inverse_bind[j]); std::fabs(glm::determinant(bind)) > 0)
          bound.emplace(of.joints[j], before[static_cast<size_t>(node)] * glm::inverse(bind));
    }
    std::vector<glm::dmat4> worlds = before;
    for (size_t n = 0; n < model_.nodes.size(); ++n) {  // parents stand before children
      Node& node = model_.nodes[n];
      const glm::dmat4 parent = node.parent < 0 ? glm::dmat4(1) : worlds[static_cast<size_t>(node.parent)];
      worlds[n] = parent * local_of(node);
      const auto to = bound.find(static_cast<int>(n));
      if (to == bound.end() || agree(worlds[n], to->second)) continue;
      saved_.emplace(static_cast<int>(n), node);
      place(node, glm::inverse(parent) * to->second);
      worlds[n] = to->second;
    }
  }

  // Takes the keys whose times increase. values(k, out) appends key k.
  template <typename Key, typename Values>
  void add_channel(Animation& clip, int node, Path path, double ticks, const Key* keys, unsigned count, size_t width,
                   Values&& values) const {
    Channel channel;
    channel.node = node;
    channel.path = path;
    channel.width = width;
    for (unsigned k = 0; k < count; ++k) {
      const auto time = static_cast<float>(keys[k].mTime / ticks);
      if (!(time >= 0) || (!channel.times.empty() && time <= channel.times.back())) continue;
      channel.times.push_back(time);
      values(keys[k], channel.values);
    }
    if (!channel.times.empty()) clip.channels.push_back(std::move(channel));
  }

  void add_clip(const aiAnimation& from) {
    Animation clip;
    clip.name = text_of(from.mName);
    const double ticks = from.mTicksPerSecond != 0 ? from.mTicksPerSecond : default_ticks;
    std::unordered_map<int, bool> moved;
    for (unsigned c = 0; c < from.mNumChannels; ++c) {
      const aiNodeAnim& of = *from.mChannels[c];
      const int node = node_named(of.mNodeName);
      if (node < 0 || !moved.emplace(node, true).second) {
        ++lost_channels_;
        continue;
      }
      split_matrix(model_.nodes[static_cast<size_t>(node)]);
      const auto put = [](std::vector<float>& out, const glm::vec3& v) { out.insert(out.end(), {v.x, v.y, v.z}); };
      add_channel(clip, node, Path::translation, ticks, of.mPositionKeys, of.mNumPositionKeys, 3,
                  [&](const aiVectorKey& key, auto& out) { put(out, vec(key.mValue) * unit_); });
      add_channel(clip, node, Path::rotation, ticks, of.mRotationKeys, of.mNumRotationKeys, 4,
                  [](const aiQuatKey& key, auto& out) {
                    const aiQuaternion& q = key.mValue;
                    out.insert(out.end(), {q.x, q.y, q.z, q.w});
                  });
      add_channel(clip, node, Path::scale, ticks, of.mScalingKeys, of.mNumScalingKeys, 3,
                  [&](const aiVectorKey& key, auto& out) { put(out, vec(key.mValue)); });
    }
    // a joint that a clip does not move stands as it was saved
    for (const auto& [node, saved] : saved_)
      if (!moved.count(node)) hold(clip, node, saved);
    for (unsigned c = 0; c < from.mNumMorphMeshChannels; ++c) add_shape_keys(clip, *from.mMorphMeshChannels[c], ticks);
    if (!clip.channels.empty()) model_.animations.push_back(std::move(clip));
  }

  void hold(Animation& clip, int node, const Node& saved) const {
    if (saved.matrix || model_.nodes[static_cast<size_t>(node)].matrix) return;
    const auto add = [&](Path path, std::vector<float> values) {
      Channel channel;
      channel.node = node;
      channel.path = path;
      channel.width = values.size();
      channel.times = {0};
      channel.values = std::move(values);
      clip.channels.push_back(std::move(channel));
    };
    const glm::vec3 place(saved.translation);
    add(Path::translation, {place.x, place.y, place.z});
    add(Path::rotation, {saved.rotation.x, saved.rotation.y, saved.rotation.z, saved.rotation.w});
    add(Path::scale, {saved.scale.x, saved.scale.y, saved.scale.z});
  }

  // The curves of shape keys stand under the node's name, a star and a number.
  void add_shape_keys(Animation& clip, const aiMeshMorphAnim& of, double ticks) {
    const std::string name(of.mName.C_Str());
    const int node = node_named(aiString(name.substr(0, name.rfind('*'))));
    const int mesh = node < 0 ? -1 : model_.nodes[static_cast<size_t>(node)].mesh;
    const size_t width = mesh < 0 ? 0 : model_.meshes[static_cast<size_t>(mesh)].weights.size();
    if (width == 0) {
      ++lost_channels_;
      return;
    }
    std::vector<float> weights = model_.meshes[static_cast<size_t>(mesh)].weights;
    add_channel(clip, node, Path::weights, ticks, of.mKeys, of.mNumKeys, width,
                [&](const aiMeshMorphKey& key, auto& out) {
                  for (unsigned i = 0; i < key.mNumValuesAndWeights; ++i)
                    if (key.mValues[i] < width) weights[key.mValues[i]] = static_cast<float>(key.mWeights[i]);
                  out.insert(out.end(), weights.begin(), weights.end());
                });
  }

  const aiScene& scene_;
  const bool fbx_;
  std::vector<std::string>& warnings_;
  Model model_;
  aiMatrix4x4 root_;
  float unit_ = 1;
  std::unordered_map<std::string, int> by_name_;
  std::vector<std::pair<int, const aiNode*>> surfaces_;
  std::map<int, Node> saved_;  // joints as they stood before they went to where they were bound
  size_t shared_names_ = 0, lost_bones_ = 0, lost_channels_ = 0, lost_faces_ = 0;
};

const char* hint_of(FileKind kind) { return kind == FileKind::fbx ? "fbx" : kind == FileKind::dae ? "dae" : "bvh"; }

}  // namespace

std::string foreign_glb_here(const std::vector<uint8_t>& bytes, FileKind kind, const std::string& name,
                             std::vector<std::string>& warnings) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_CAMERAS, false);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_LIGHTS, false);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  // from memory: assimp opens no file
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), aiProcess_Triangulate, hint_of(kind));
  const std::string error = importer.GetErrorString();
  if (error.find("bad_alloc") != std::string::npos) throw std::bad_alloc();
  if (!scene || !scene->mRootNode)
    throw std::runtime_error(name + ": is not accepted by assimp: " + printable(error).substr(0, 400) + "; " +
                             advice_on(FileKind::usd));
  return gltf_bytes(SceneModel(*scene, kind, name, warnings).run(), true);
}

}  // namespace hf_gltf
#endif

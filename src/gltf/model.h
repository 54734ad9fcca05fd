// A glTF 2.0 asset in memory, decoded: plain arrays of floats, no buffers, no accessors, no quantisation.
//
// The function read_gltf() fills it and guarantees the comment of each field; write_gltf() writes it. The programs
// change it in between. Looks (materials, textures, images) are carried through unchanged in an opaque block.
//
//   Model model = read_gltf("horse.glb");
//   FlatMesh mesh = flatten(model);                       // flat_mesh.h: world rest pose, one vertex array, welded
//   auto posed = posed_positions(model, mesh, model.animations[0], 0.5);   // animate.h
#ifndef HF_GLTF_MODEL_H
#define HF_GLTF_MODEL_H

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hf_gltf {

// JSON text of an element that no program reads: extras, and extensions that name no accessor. "" = none. It is written
// again as it was read.
struct Carried {
  std::string extras, extensions;
};

// Places of EXT_mesh_gpu_instancing, as many in each list that is not empty. Carried through, not applied.
struct Instances {
  std::vector<glm::vec3> translations, scales;
  std::vector<glm::vec4> rotations;  // x y z w
};

// Numbers that no program reads, as the file stores them: `count` elements without gaps. component and type have glTF's
// values; type is the number of components, 1 to 4.
struct CarriedNumbers {
  int component = 0, type = 0;
  bool normalized = false;
  size_t count = 0;
  std::vector<uint8_t> bytes;
};

// A node of the hierarchy. Indices are into the model's arrays, -1 = none. Local transform = matrix where given (an
// animated node never has one), otherwise translation * rotation * scale.
struct Node {
  std::string name;
  int parent = -1;
  std::vector<int> children;
  glm::dvec3 translation{0, 0, 0};  // in double: places can lie far from 0
  glm::quat rotation{1, 0, 0, 0};   // w, x, y, z; unit length
  glm::vec3 scale{1, 1, 1};
  std::optional<glm::dmat4> matrix;
  int mesh = -1;
  int skin = -1;               // its own transform is ignored then, as glTF says
  std::vector<float> weights;  // of the morph targets; empty: the mesh's
  int camera = -1;             // of Model::cameras
  std::optional<Instances> instances;
  Carried carried;
};

struct Scene {
  std::string name;
  std::vector<int> roots;
  Carried carried;
};

// Displacements added to a primitive, scaled by the target's weight. Each list may be empty.
struct MorphTarget {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec3> tangents;  // written where the primitive has tangents
};

// Joints and weights of a vertex. Weights are not negative and sum to 1; unused slots have weight 0 and joint 0.
struct Influences {
  std::array<uint16_t, 8> joints{};
  std::array<float, 8> weights{};
};

enum class Topology { triangles, lines, points };

// Per-vertex arrays are empty or as long as positions.
struct Primitive {
  Topology topology = Topology::triangles;
  std::vector<glm::vec3> positions;               // finite
  std::vector<glm::vec3> normals;                 // as stored; a zero normal stays zero
  std::vector<glm::vec4> tangents;                // xyz, w = handedness
  std::vector<std::vector<glm::vec2>> texcoords;  // TEXCOORD_0, 1, ...
  std::vector<glm::vec4> colors;                  // COLOR_0, linear, alpha 1 where the file has none
  std::vector<Influences> influences;             // joints are below the joint count of every skin used with the mesh
  std::vector<uint32_t> indices;                  // three per triangle, two per line; below positions.size()
  std::vector<MorphTarget> targets;               // as many in every primitive of a mesh
  int material = -1;
  // COLOR_1, TEXCOORD_8, _FEATURE_ID_0 and others, an element for each vertex.
  std::vector<std::pair<std::string, CarriedNumbers>> carried_attributes;
  Carried carried;
};

struct MeshData {
  std::string name;
  std::vector<Primitive> primitives;
  std::vector<float> weights;  // default morph weights; empty: zeros
  std::vector<std::string> target_names;
  Carried carried;
};

struct Skin {
  std::string name;
  std::vector<int> joints;              // nodes
  std::vector<glm::mat4> inverse_bind;  // one per joint
  int skeleton = -1;
  Carried carried;
};

enum class Interpolation { step, linear, cubic_spline };
enum class Path { translation, rotation, scale, weights };

// Key times increase strictly and are not negative. The array values holds, per key, `width` floats: 3, 4 (x y z w), or
// the number of morph targets. For cubic splines it holds three groups of them per key: in-tangent, value, out-tangent.
struct Channel {
  int node = -1;
  Path path = Path::translation;
  Interpolation interpolation = Interpolation::linear;
  size_t width = 3;
  std::vector<float> times;
  std::vector<float> values;
  bool shorts = false;  // a rotation whose values are multiples of 1 / 32767 and are written as such
};

// A channel that moves something else than a node, such as a colour (KHR_animation_pointer).
struct CarriedChannel {
  std::string target;  // JSON
  Interpolation interpolation = Interpolation::linear;
  std::vector<float> times;
  CarriedNumbers values;
};

struct Animation {
  std::string name;
  std::vector<Channel> channels;  // at most one per node and path
  std::vector<CarriedChannel> carried_channels;
  Carried carried;
};

// The part of a material that pictures need. The full material is carried through in Model::appearance under the same
// index.
struct Material {
  std::string name;
  glm::vec4 base_color{1, 1, 1, 1};  // linear
  float metallic = 1, roughness = 1;
  bool double_sided = false;
  bool unlit = false;  // written as KHR_materials_unlit
};

// Materials, textures, images and samplers as the file has them; defined in gltf_appearance.h for reader and writer.
struct Appearance;

// A caller's statement about a joint: its chain has this part and side.
struct SaidJoint {
  int node = -1;
  std::string part;  // as role_name of skeleton/character.h
  int side = 0;      // 1: left, 2: right
  std::string chain;
};

struct Model {
  std::string name;  // the file's name, for messages
  std::vector<Node> nodes;
  std::vector<int> scene_roots;  // of the scene shown; every root node when the file has no scene
  // Every scene of the file; empty: one scene of scene_roots. scene_roots counts for the one shown.
  std::vector<Scene> scenes;
  size_t shown_scene = 0;
  std::vector<MeshData> meshes;
  std::vector<Skin> skins;
  std::vector<Animation> animations;
  // Indices below the appearance's material count are written from there, those above from here.
  std::vector<Material> materials;
  std::shared_ptr<const Appearance> appearance;
  Carried carried;                               // of the top level
  std::string asset;                             // JSON of the asset without version and generator: copyright, extras
  std::vector<std::string> cameras;              // JSON of each
  std::vector<std::string> required_extensions;  // written as required where they are still in use
  std::vector<SaidJoint> said;                   // no part of the file
  std::vector<std::string> notes;                // about the file, one sentence each; nothing is wrong
  std::vector<std::string> warnings;             // skipped, repaired and lost parts; one sentence each
};

}  // namespace hf_gltf

#endif

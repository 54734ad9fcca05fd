// Inner header of the glTF reader and writer: JSON that is carried through without being read.
//
// Extras are kept as they are. An extension is kept unless it names accessors, views or samplers, because these get new
// numbers. Nodes, materials, textures, skins and scenes keep their numbers.
#ifndef HF_GLTF_GLTF_CARRIED_H
#define HF_GLTF_GLTF_CARRIED_H

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gltf/model.h"

namespace hf_gltf {

// The parts of the checked document that tinygltf is not given, by number of the element.
struct CarriedDocument {
  Carried top;
  std::string asset;
  std::vector<std::string> cameras;
  std::vector<Carried> scenes, nodes, meshes, skins, animations;
  std::vector<std::vector<Carried>> primitives;    // by mesh
  std::vector<nlohmann::json> animation_channels;  // by animation: those without a node, {target, sampler}
  std::vector<int> node_cameras;
  std::vector<nlohmann::json> node_instances;  // attributes of EXT_mesh_gpu_instancing, name to accessor; or null
  std::vector<std::string> required;
};

// Takes extras and extensions out of an object. `dropped` gets the names of extensions that cannot be kept.
Carried take_carried(nlohmann::json& object, std::vector<std::string>& dropped);

// Whether an extension names accessors, views or samplers.
bool extension_names_data(const std::string& extension, const nlohmann::json& value);

// The extras and extensions of a document that a model of other nodes keeps: extensions that name no node.
Carried carried_without_nodes(const Carried& carried);

// Adds them to an object that is written. Members of the object stay.
void put_carried(const Carried& carried, nlohmann::json& object);

// Names of the extensions used anywhere in a document, extras left out.
std::vector<std::string> used_extensions(const nlohmann::json& document);

}  // namespace hf_gltf

#endif

// See gltf_carried.h.
#include "gltf/gltf_carried.h"

#include <algorithm>
#include <set>

namespace hf_gltf {
namespace {

using nlohmann::json;

// Decoded by the reader, or about data that is written in another form.
bool is_consumed(const std::string& name) {
  static const std::set<std::string> names = {"KHR_draco_mesh_compression", "EXT_meshopt_compression",
                                              "KHR_meshopt_compression", "EXT_mesh_gpu_instancing"};
  return names.count(name) != 0;
}

// The JSON is bounded in depth, so recursion is.
bool names_data(const json& value) {
  static const std::set<std::string> keys = {"accessor",   "accessors",   "attributes", "buffer",  "buffers",
                                             "bufferView", "bufferViews", "indices",    "sampler", "samplers"};
  if (value.is_array()) return std::any_of(value.begin(), value.end(), names_data);
  if (!value.is_object()) return false;
  for (const auto& item : value.items()) {
    if (item.key() == "extras") continue;
    if (keys.count(item.key()) != 0 || names_data(item.value())) return true;
  }
  return false;
}

}  // namespace

bool extension_names_data(const std::string& extension, const json& value) {
  // the tables of EXT_structural_metadata name views as "values", a key that others use for numbers
  if (extension == "EXT_structural_metadata" && value.contains("propertyTables")) return true;
  return names_data(value);
}

namespace {

void collect(const json& value, std::set<std::string>& names) {
  if (value.is_array()) {
    for (const json& element : value) collect(element, names);
  }
  if (!value.is_object()) return;
  for (const auto& item : value.items()) {
    if (item.key() == "extras") continue;
    if (item.key() == "extensions" && item.value().is_object()) {
      for (const auto& extension : item.value().items()) names.insert(extension.key());
    }
    collect(item.value(), names);
  }
}

}  // namespace

Carried take_carried(json& object, std::vector<std::string>& dropped) {
  Carried out;
  const auto extras = object.find("extras");
  if (extras != object.end() && !extras->is_null()) out.extras = extras->dump();
  const auto extensions = object.find("extensions");
  if (extensions != object.end() && extensions->is_object()) {
    json kept = json::object();
    for (auto& item : extensions->items()) {
      if (is_consumed(item.key())) continue;
      if (item.value().is_object() && !extension_names_data(item.key(), item.value())) {
        kept[item.key()] = item.value();
      } else {
        dropped.push_back(item.key());
      }
    }
    if (!kept.empty()) out.extensions = kept.dump();
  }
  object.erase("extras");
  object.erase("extensions");
  return out;
}

Carried carried_without_nodes(const Carried& carried) {
  Carried out;
  out.extras = carried.extras;
  if (carried.extensions.empty()) return out;
  json kept = json::object();
  const json extensions = json::parse(carried.extensions);
  for (const char* name : {"KHR_materials_variants", "KHR_xmp_json_ld", "EXT_structural_metadata"}) {
    if (extensions.contains(name)) kept[name] = extensions[name];
  }
  if (!kept.empty()) out.extensions = kept.dump();
  return out;
}

void put_carried(const Carried& carried, json& object) {
  if (!carried.extras.empty()) {
    const json extras = json::parse(carried.extras);
    json& to = object["extras"];
    if (to.is_null()) {
      to = extras;
    } else if (to.is_object() && extras.is_object()) {
      for (const auto& item : extras.items()) to.emplace(item.key(), item.value());
    }
  }
  if (carried.extensions.empty()) return;
  const json extensions = json::parse(carried.extensions);
  json& to = object["extensions"];
  for (const auto& item : extensions.items()) to.emplace(item.key(), item.value());
}

std::vector<std::string> used_extensions(const json& document) {
  std::set<std::string> names;
  collect(document, names);
  return {names.begin(), names.end()};
}

}  // namespace hf_gltf

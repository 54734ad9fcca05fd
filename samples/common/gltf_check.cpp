// check_document() of gltf_check.h.
#include "common/gltf_check.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <stdexcept>

#include "common/file_bytes.h"

namespace samples {
namespace {

using nlohmann::json;

constexpr uint64_t max_integer = 1ull << 53;  // beyond it a JSON number need not be a whole one

// Required extensions this reader honours. Those on looks are carried through.
const std::set<std::string>& known_extensions() {
  static const std::set<std::string> names = {"KHR_mesh_quantization",
                                              "KHR_texture_transform",
                                              "KHR_texture_basisu",
                                              "EXT_texture_webp",
                                              "EXT_texture_avif",
                                              "MSFT_texture_dds",
                                              "KHR_lights_punctual",
                                              "KHR_materials_anisotropy",
                                              "KHR_materials_clearcoat",
                                              "KHR_materials_dispersion",
                                              "KHR_materials_emissive_strength",
                                              "KHR_materials_ior",
                                              "KHR_materials_iridescence",
                                              "KHR_materials_pbrSpecularGlossiness",
                                              "KHR_materials_sheen",
                                              "KHR_materials_specular",
                                              "KHR_materials_transmission",
                                              "KHR_materials_unlit",
                                              "KHR_materials_volume"};
  return names;
}

class DocumentCheck {
 public:
  DocumentCheck(json& document, const std::string& name, const ReadLimits& limits, std::vector<std::string>& warnings)
      : document_(document), name_(name), limits_(limits), warnings_(warnings) {}

  void run() {
    if (!document_.is_object()) fail("the top level", "is not a JSON object");
    check_asset();
    check_collections();
    check_extensions();
    each("buffers", [&](json& o, const std::string& w) { check_buffer(o, w); });
    each("bufferViews", [&](json& o, const std::string& w) { check_view(o, w); });
    each("accessors", [&](json& o, const std::string& w) { check_accessor(o, w); });
    each("samplers", [&](json& o, const std::string& w) { check_sampler(o, w); });
    each("images", [&](json& o, const std::string& w) { check_image(o, w); });
    each("textures", [&](json& o, const std::string& w) { check_texture(o, w); });
    each("materials", [&](json& o, const std::string& w) { check_textures_in(o, w); });
    each("meshes", [&](json& o, const std::string& w) { check_mesh(o, w); });
    each("nodes", [&](json& o, const std::string& w) { check_node(o, w); });
    each("skins", [&](json& o, const std::string& w) { check_skin(o, w); });
    each("animations", [&](json& o, const std::string& w) { check_animation(o, w); });
    each("scenes", [&](json& o, const std::string& w) { check_scene(o, w); });
    if (size("scenes") > 0) index(document_, "scene", "the top level", "scenes", false);
    if (size("scenes") == 0) document_.erase("scene");
    check_graph();
  }

 private:
  using Where = const std::string&;

  [[noreturn]] void fail(Where where, const std::string& message) const {
    throw std::runtime_error(name_ + ": " + printable(where + " " + message) + ".");
  }

  template <typename Function>
  void each(const char* collection, Function check) {
    const auto found = document_.find(collection);
    if (found == document_.end()) return;
    for (size_t i = 0; i < found->size(); ++i) {
      const std::string where = std::string(collection) + "[" + std::to_string(i) + "]";
      json& object = (*found)[i];
      if (!object.is_object()) fail(where, "is not an object");
      const auto name = object.find("name");
      if (name != object.end() && !name->is_string()) object.erase(name);
      check(object, where);
    }
  }

  size_t size(const char* collection) const {
    const auto found = document_.find(collection);
    return found == document_.end() ? 0 : found->size();
  }

  // A whole number in [low, high]; 5126.0 is one. Left in the tree as an integer.
  uint64_t whole(json& value, Where where, uint64_t low, uint64_t high) const {
    uint64_t number = 0;
    bool good = false;
    if (value.is_number_unsigned()) {
      number = value.get<uint64_t>();
      good = true;
    } else if (value.is_number_float()) {
      const double real = value.get<double>();
      good = real >= 0 && real <= static_cast<double>(max_integer) && real == std::floor(real);
      if (good) number = static_cast<uint64_t>(real);
    }
    if (!good || number < low || number > high) {
      fail(where, "is " + shown(value) + ", which is not a whole number from " + std::to_string(low) + " to " +
                      std::to_string(high));
    }
    value = number;
    return number;
  }

  static std::string shown(const json& value) {
    if (value.is_structured()) return value.is_array() ? "an array" : "an object";
    return value.dump(-1, ' ', false, json::error_handler_t::replace).substr(0, 40);
  }

  uint64_t whole(json& object, const char* key, Where where, uint64_t low, uint64_t high, bool required,
                 uint64_t otherwise = 0) const {
    const auto found = object.find(key);
    if (found == object.end()) {
      if (required) fail(where, "has no \"" + std::string(key) + "\"");
      return otherwise;
    }
    return whole(*found, where + "." + key, low, high);
  }

  // An index into a collection, checked; -1 where absent.
  int index(json& value, Where where, const char* collection) const {
    const size_t count = size(collection);
    if (count == 0) fail(where, "names an element of \"" + std::string(collection) + "\", which is empty");
    return static_cast<int>(whole(value, where, 0, count - 1));
  }
  int index(json& object, const char* key, Where where, const char* collection, bool required) const {
    const auto found = object.find(key);
    if (found == object.end()) {
      if (required) fail(where, "has no \"" + std::string(key) + "\"");
      return -1;
    }
    return index(*found, where + "." + key, collection);
  }

  // The member, which must be an array (object) if it is there.
  json* array(json& object, const char* key, Where where, bool required) const {
    const auto found = object.find(key);
    if (found == object.end()) {
      if (required) fail(where, "has no \"" + std::string(key) + "\"");
      return nullptr;
    }
    if (!found->is_array()) fail(where + "." + key, "is not an array");
    if (found->empty() && required) fail(where + "." + key, "is empty");
    return &*found;
  }
  json* object(json& parent, const char* key, Where where, bool required) const {
    const auto found = parent.find(key);
    if (found == parent.end()) {
      if (required) fail(where, "has no \"" + std::string(key) + "\"");
      return nullptr;
    }
    if (!found->is_object()) fail(where + "." + key, "is not an object");
    return &*found;
  }

  // An array of finite numbers that fit a float; expected = 0: any length.
  void numbers(json& object, const char* key, Where where, size_t expected) const {
    json* values = array(object, key, where, false);
    if (!values) return;
    if (expected != 0 && values->size() != expected) {
      fail(where + "." + key, "has " + std::to_string(values->size()) + " numbers, not " + std::to_string(expected));
    }
    for (size_t i = 0; i < values->size(); ++i) {
      const json& value = (*values)[i];
      if (!value.is_number() || !(std::abs(value.get<double>()) <= std::numeric_limits<float>::max())) {
        fail(where + "." + key + "[" + std::to_string(i) + "]", "is " + shown(value) + ", which is not a finite float");
      }
    }
  }

  bool text(const json& object, const char* key, Where where, bool required) const {
    const auto found = object.find(key);
    if (found == object.end()) {
      if (required) fail(where, "has no \"" + std::string(key) + "\"");
      return false;
    }
    if (!found->is_string()) fail(where + "." + key, "is not a string");
    return true;
  }

  static void keep_only(json& object, std::initializer_list<const char*> keys) {
    json kept = json::object();
    for (const char* key : keys) {
      const auto found = object.find(key);
      if (found != object.end()) kept[key] = std::move(*found);
    }
    object = std::move(kept);
  }

  static bool has_extension(const json& object, const char* name) {
    const auto found = object.find("extensions");
    return found != object.end() && found->is_object() && found->contains(name);
  }

  void check_asset() {
    json* asset = object(document_, "asset", "the top level", true);
    text(*asset, "version", "asset", true);
    const std::string version = (*asset)["version"].get<std::string>();
    if (version.compare(0, 2, "2.") != 0) {
      fail("asset.version", "is \"" + version.substr(0, 20) + "\"; only glTF 2.x is read, convert the file first");
    }
    if (text(*asset, "minVersion", "asset", false) && (*asset)["minVersion"] != "2.0") {
      fail("asset.minVersion", "asks for more than glTF 2.0");
    }
    keep_only(*asset, {"version"});
  }

  void check_collections() {
    for (const char* key :
         {"buffers", "bufferViews", "accessors", "samplers", "images", "textures", "materials", "meshes", "nodes",
          "skins", "animations", "scenes", "extensionsUsed", "extensionsRequired"}) {
      array(document_, key, "the top level", false);
    }
    check_size("nodes", limits_.max_nodes);
    for (const char* key : {"samplers", "images", "textures", "materials", "scenes"})
      check_size(key, limits_.max_looks);
    if (size("cameras") > 0) warnings_.push_back("cameras are not kept");
    if (has_extension(document_, "KHR_lights_punctual")) warnings_.push_back("lights are not kept");
    keep_only(document_,
              {"asset", "buffers", "bufferViews", "accessors", "samplers", "images", "textures", "materials", "meshes",
               "nodes", "skins", "animations", "scenes", "scene", "extensionsUsed", "extensionsRequired"});
  }

  void check_size(const char* key, uint64_t limit) const {
    if (size(key) <= limit) return;
    fail(key, "has " + std::to_string(size(key)) + " elements, above the limit of " + std::to_string(limit) +
                  "; raise the limit if the file is to be trusted");
  }

  void check_extensions() {
    for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
      const auto found = document_.find(key);
      if (found == document_.end()) continue;
      for (const json& name : *found) {
        if (!name.is_string()) fail(key, "holds something that is not a string");
        if (std::strcmp(key, "extensionsRequired") == 0 && known_extensions().count(name.get<std::string>()) == 0) {
          fail("the file", "requires the extension " + name.get<std::string>().substr(0, 80) +
                               ", which cannot be decoded here; export it again without that extension");
        }
        if (name == "EXT_mesh_gpu_instancing") warnings_.push_back("EXT_mesh_gpu_instancing is not applied");
      }
    }
  }

  void check_buffer(json& o, Where where) {
    whole(o, "byteLength", where, 1, limits_.max_total_bytes, true);
    text(o, "uri", where, false);
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
      if (has_extension(o, name) && !o.contains("uri")) fail(where, "is encoded with " + std::string(name));
    }
    keep_only(o, {"byteLength", "uri"});
  }

  void check_view(json& o, Where where) {
    const int buffer = index(o, "buffer", where, "buffers", true);
    const uint64_t length = whole(o, "byteLength", where, 1, max_integer, true);
    const uint64_t offset = whole(o, "byteOffset", where, 0, max_integer, false);
    whole(o, "byteStride", where, 0, 65535, false);
    const uint64_t available = document_["buffers"][static_cast<size_t>(buffer)]["byteLength"].get<uint64_t>();
    if (offset > available || length > available - offset) {
      fail(where, "covers bytes " + std::to_string(offset) + " to " + std::to_string(offset + length) +
                      ", beyond buffer " + std::to_string(buffer) + " of " + std::to_string(available) + " bytes");
    }
    keep_only(o, {"buffer", "byteLength", "byteOffset", "byteStride"});
  }

  static uint64_t component_bytes(uint64_t type) {
    switch (type) {
      case 5120:
      case 5121:
        return 1;
      case 5122:
      case 5123:
        return 2;
      case 5125:
      case 5126:
        return 4;
      default:
        return 0;
    }
  }

  static uint64_t component_count(const std::string& type) {
    if (type == "SCALAR") return 1;
    if (type == "VEC2") return 2;
    if (type == "VEC3") return 3;
    if (type == "VEC4" || type == "MAT2") return 4;
    if (type == "MAT3") return 9;
    if (type == "MAT4") return 16;
    return 0;
  }

  // count elements of element_bytes from offset, stride apart, within a view. All operands are at most 2^53, 65535 or
  // 144, the count is bounded by the limit on decoded bytes: no product leaves 64 bits.
  void check_range(uint64_t view, uint64_t offset, uint64_t count, uint64_t element_bytes, Where where) {
    const json& o = document_["bufferViews"][view];
    const uint64_t available = o["byteLength"].get<uint64_t>();
    const auto found = o.find("byteStride");
    uint64_t stride = found == o.end() ? 0 : found->get<uint64_t>();
    if (stride == 0) stride = element_bytes;
    if (stride < element_bytes) {
      fail(where,
           "has elements of " + std::to_string(element_bytes) + " bytes in a view of stride " + std::to_string(stride));
    }
    const uint64_t end = offset + stride * (count - 1) + element_bytes;
    if (end > available) {
      fail(where, "needs " + std::to_string(end) + " bytes of bufferViews[" + std::to_string(view) + "], which has " +
                      std::to_string(available));
    }
  }

  void check_accessor(json& o, Where where) {
    const uint64_t component = whole(o, "componentType", where, 0, 65535, true);
    if (component_bytes(component) == 0)
      fail(where + ".componentType", "is " + std::to_string(component) + ", which glTF does not know");
    text(o, "type", where, true);
    const uint64_t components = component_count(o["type"].get<std::string>());
    if (components == 0) fail(where + ".type", "is " + shown(o["type"]) + ", which glTF does not know");
    // every element becomes at least one float or index
    const uint64_t count = whole(o, "count", where, 1, limits_.max_decoded_bytes / 4, true);
    const uint64_t offset = whole(o, "byteOffset", where, 0, max_integer, false);
    const int view = index(o, "bufferView", where, "bufferViews", false);
    if (o.contains("normalized") && !o["normalized"].is_boolean()) fail(where + ".normalized", "is not true or false");
    const uint64_t bytes = components * component_bytes(component);
    if (view >= 0) check_range(static_cast<uint64_t>(view), offset, count, bytes, where);
    if (json* sparse = object(o, "sparse", where, false)) check_sparse(*sparse, count, bytes, where + ".sparse");
    keep_only(o, {"componentType", "type", "count", "byteOffset", "bufferView", "normalized", "sparse"});
  }

  void check_sparse(json& o, uint64_t elements, uint64_t element_bytes, Where where) {
    const uint64_t count = whole(o, "count", where, 1, elements, true);
    json* indices = object(o, "indices", where, true);
    json* values = object(o, "values", where, true);
    const uint64_t component = whole(*indices, "componentType", where + ".indices", 0, 65535, true);
    if (component != 5121 && component != 5123 && component != 5125) {
      fail(where + ".indices.componentType", "is " + std::to_string(component) + ", not an unsigned type");
    }
    const auto range = [&](json& part, uint64_t bytes, Where part_where) {
      const int view = index(part, "bufferView", part_where, "bufferViews", true);
      const uint64_t offset = whole(part, "byteOffset", part_where, 0, max_integer, false);
      if (!part.contains("byteOffset")) part["byteOffset"] = 0;
      check_range(static_cast<uint64_t>(view), offset, count, bytes, part_where);
    };
    range(*indices, component_bytes(component), where + ".indices");
    range(*values, element_bytes, where + ".values");
    keep_only(o, {"count", "indices", "values"});
  }

  void check_sampler(json& o, Where where) {
    for (const char* key : {"magFilter", "minFilter", "wrapS", "wrapT"}) whole(o, key, where, 0, 65535, false);
  }

  void check_image(json& o, Where where) {
    const bool has_uri = text(o, "uri", where, false);
    const bool has_view = index(o, "bufferView", where, "bufferViews", false) >= 0;
    if (has_uri == has_view) fail(where, "must have either \"uri\" or \"bufferView\"");
    text(o, "mimeType", where, false);
    keep_only(o, {"name", "uri", "bufferView", "mimeType", "extensions", "extras"});
  }

  void check_texture(json& o, Where where) {
    index(o, "sampler", where, "samplers", false);
    index(o, "source", where, "images", false);
    json* extensions = object(o, "extensions", where, false);
    if (!extensions) return;
    for (auto& item : extensions->items()) {
      if (item.value().is_object()) index(item.value(), "source", where + "." + item.key(), "images", false);
    }
  }

  // Every texture reference below a material, extensions included: an object {"index": n} under a key ...Texture.
  void check_textures_in(json& value, Where where) {
    if (value.is_array()) {
      for (json& element : value) check_textures_in(element, where);
    }
    if (!value.is_object()) return;
    for (auto& item : value.items()) {
      const std::string& key = item.key();
      const std::string inner = where + "." + key.substr(0, 60);
      if (key == "extras") continue;
      const bool reference = key.size() >= 7 && key.compare(key.size() - 7, 7, "Texture") == 0;
      if (reference && item.value().is_object()) {
        index(item.value(), "index", inner, "textures", true);
        whole(item.value(), "texCoord", inner, 0, 255, false);
      }
      check_textures_in(item.value(), inner);
    }
  }

  void check_mesh(json& o, Where where) {
    json* primitives = array(o, "primitives", where, true);
    for (size_t i = 0; i < primitives->size(); ++i) {
      const std::string inner = where + ".primitives[" + std::to_string(i) + "]";
      json& primitive = (*primitives)[i];
      if (!primitive.is_object()) fail(inner, "is not an object");
      check_primitive(primitive, inner);
    }
    numbers(o, "weights", where, 0);
    const auto extras = o.find("extras");
    if (extras != o.end() && extras->is_object() && extras->contains("targetNames")) {
      o["targetNames"] = (*extras)["targetNames"];
    }
    keep_only(o, {"name", "primitives", "weights", "targetNames"});
  }

  void check_primitive(json& o, Where where) {
    check_attributes(*object(o, "attributes", where, true), where + ".attributes", where, o);
    index(o, "indices", where, "accessors", false);
    index(o, "material", where, "materials", false);
    whole(o, "mode", where, 0, 6, false);
    if (json* targets = array(o, "targets", where, false)) {
      for (size_t t = 0; t < targets->size(); ++t) {
        const std::string inner = where + ".targets[" + std::to_string(t) + "]";
        if (!(*targets)[t].is_object()) fail(inner, "is not an object");
        check_attributes((*targets)[t], inner, where, o);
      }
    }
    if (has_extension(o, "KHR_materials_variants")) warnings_.push_back(where + ": material variants are not kept");
    keep_only(o, {"attributes", "indices", "material", "mode", "targets"});
  }

  void check_attributes(json& attributes, Where where, Where primitive_where, const json& primitive) {
    for (auto& item : attributes.items()) {
      const int accessor = index(item.value(), where + "." + item.key().substr(0, 60), "accessors");
      const json& o = document_["accessors"][static_cast<size_t>(accessor)];
      if (has_extension(primitive, "KHR_draco_mesh_compression") && !o.contains("bufferView")) {
        fail(primitive_where,
             "is encoded with KHR_draco_mesh_compression, which cannot be decoded here; export it "
             "again without compression");
      }
    }
  }

  void check_node(json& o, Where where) {
    index(o, "mesh", where, "meshes", false);
    index(o, "skin", where, "skins", false);
    numbers(o, "matrix", where, 16);
    numbers(o, "translation", where, 3);
    numbers(o, "rotation", where, 4);
    numbers(o, "scale", where, 3);
    numbers(o, "weights", where, 0);
    if (json* children = array(o, "children", where, false)) {
      for (json& child : *children) index(child, where + ".children", "nodes");
    }
    keep_only(o, {"name", "mesh", "skin", "matrix", "translation", "rotation", "scale", "weights", "children"});
  }

  void check_skin(json& o, Where where) {
    json* joints = array(o, "joints", where, true);
    std::set<int> seen;
    for (json& joint : *joints) {
      const int node = index(joint, where + ".joints", "nodes");
      if (!seen.insert(node).second) fail(where + ".joints", "names node " + std::to_string(node) + " twice");
    }
    index(o, "inverseBindMatrices", where, "accessors", false);
    index(o, "skeleton", where, "nodes", false);
    keep_only(o, {"name", "joints", "inverseBindMatrices", "skeleton"});
  }

  void check_animation(json& o, Where where) {
    json* samplers = array(o, "samplers", where, true);
    for (size_t i = 0; i < samplers->size(); ++i) {
      const std::string inner = where + ".samplers[" + std::to_string(i) + "]";
      json& sampler = (*samplers)[i];
      if (!sampler.is_object()) fail(inner, "is not an object");
      index(sampler, "input", inner, "accessors", true);
      index(sampler, "output", inner, "accessors", true);
      if (text(sampler, "interpolation", inner, false)) {
        const std::string mode = sampler["interpolation"].get<std::string>();
        if (mode != "LINEAR" && mode != "STEP" && mode != "CUBICSPLINE") {
          fail(inner + ".interpolation", "is \"" + mode.substr(0, 40) + "\", which glTF does not know");
        }
      }
      keep_only(sampler, {"input", "output", "interpolation"});
    }
    json* channels = array(o, "channels", where, true);
    for (size_t i = 0; i < channels->size(); ++i) {
      const std::string inner = where + ".channels[" + std::to_string(i) + "]";
      json& channel = (*channels)[i];
      if (!channel.is_object()) fail(inner, "is not an object");
      whole(channel, "sampler", inner, 0, samplers->size() - 1, true);
      json* target = object(channel, "target", inner, true);
      text(*target, "path", inner + ".target", true);
      index(*target, "node", inner + ".target", "nodes", false);
      keep_only(*target, {"node", "path"});
      keep_only(channel, {"sampler", "target"});
    }
    keep_only(o, {"name", "samplers", "channels"});
  }

  void check_scene(json& o, Where where) {
    if (json* nodes = array(o, "nodes", where, false)) {
      for (json& node : *nodes) index(node, where + ".nodes", "nodes");
    }
    keep_only(o, {"name", "nodes"});
  }

  // One parent each; walked breadth first from the roots, so that neither depth nor cycles cost stack. A node no root
  // reaches lies on a cycle or below one.
  void check_graph() {
    const size_t count = size("nodes");
    if (count == 0) return;
    json& nodes = document_["nodes"];
    std::vector<int> parent(count, -1);
    for (size_t n = 0; n < count; ++n) {
      const auto children = nodes[n].find("children");
      if (children == nodes[n].end()) continue;
      for (const json& child : *children) {
        const auto c = child.get<size_t>();
        const std::string where = "nodes[" + std::to_string(c) + "]";
        if (c == n) fail(where, "is its own child");
        if (parent[c] == static_cast<int>(n)) fail(where, "is named twice by its parent " + std::to_string(n));
        if (parent[c] >= 0) {
          fail(where, "has two parents, " + std::to_string(parent[c]) + " and " + std::to_string(n));
        }
        parent[c] = static_cast<int>(n);
      }
    }
    std::vector<size_t> level, next;
    std::vector<char> reached(count, 0);
    for (size_t n = 0; n < count; ++n) {
      if (parent[n] < 0) level.push_back(n);
    }
    for (uint32_t depth = 1; !level.empty(); ++depth) {
      if (depth > limits_.max_node_depth) {
        fail("nodes[" + std::to_string(level[0]) + "]",
             "lies deeper in the hierarchy than " + std::to_string(limits_.max_node_depth) + " levels");
      }
      next.clear();
      for (const size_t n : level) {
        reached[n] = 1;
        const auto children = nodes[n].find("children");
        if (children == nodes[n].end()) continue;
        for (const json& child : *children) next.push_back(child.get<size_t>());
      }
      level.swap(next);
    }
    for (size_t n = 0; n < count; ++n) {
      if (!reached[n]) fail("nodes[" + std::to_string(n) + "]", "lies on or below a cycle of parents");
    }
  }

  json& document_;
  const std::string& name_;
  const ReadLimits& limits_;
  std::vector<std::string>& warnings_;
};

}  // namespace

void check_document(json& document, const std::string& name, const ReadLimits& limits,
                    std::vector<std::string>& warnings) {
  DocumentCheck(document, name, limits, warnings).run();
}

}  // namespace samples

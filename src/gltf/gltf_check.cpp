// check_document() of gltf_check.h.
#include "gltf/gltf_check.h"

#include <cstring>
#include <set>

#include "gltf/gltf_check_parts.h"
#include "gltf/gltf_decompress.h"

namespace hf_gltf {
namespace {

using nlohmann::json;

// Required extensions this reader honours. Those on looks and on what no program reads are carried through.
const std::set<std::string>& known_extensions() {
  static const std::set<std::string> names = {"KHR_mesh_quantization",
                                              "EXT_mesh_gpu_instancing",
                                              "KHR_draco_mesh_compression",
                                              "EXT_meshopt_compression",
                                              "KHR_meshopt_compression",
                                              "KHR_materials_variants",
                                              "KHR_node_visibility",
                                              "KHR_xmp_json_ld",
                                              "MSFT_lod",
                                              "KHR_texture_transform",
                                              "KHR_texture_basisu",
                                              "EXT_texture_webp",
                                              "EXT_texture_avif",
                                              "MSFT_texture_dds",
                                              "KHR_lights_punctual",
                                              "KHR_materials_anisotropy",
                                              "KHR_materials_clearcoat",
                                              "KHR_materials_diffuse_transmission",
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

class DocumentCheck : private TreeCheck {
 public:
  DocumentCheck(json& document, const std::string& name, const ReadLimits& limits, CarriedDocument& carried,
                std::vector<std::string>& warnings)
      : TreeCheck(document, name, limits), carried_(carried), warnings_(warnings) {}

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
    drop_empty_skins();
    each("skins", [&](json& o, const std::string& w) { check_skin(o, w); });
    each("animations", [&](json& o, const std::string& w) { check_animation(o, w); });
    each("scenes", [&](json& o, const std::string& w) { check_scene(o, w); });
    if (size("scenes") > 0) index(document_, "scene", "the top level", "scenes", false);
    if (size("scenes") == 0) document_.erase("scene");
    document_.erase("cameras");
    check_graph();
    warn_dropped();
  }

 private:
  using Where = TreeCheck::Where;

  Carried take(json& o) { return take_carried(o, dropped_); }

  void warn(const std::string& message) {
    if (warnings_.size() < 100) warnings_.push_back(message);
  }

  void warn_dropped() {
    std::sort(dropped_.begin(), dropped_.end());
    dropped_.erase(std::unique(dropped_.begin(), dropped_.end()), dropped_.end());
    if (dropped_.size() > 20) dropped_.resize(20);
    for (const std::string& name : dropped_) {
      warnings_.push_back("extension " + printable(name.substr(0, 60)) + " is not kept: it names accessors or views");
    }
  }

  void check_asset() {
    json* asset = object(document_, "asset", "the top level", true);
    text(*asset, "version", "asset", true);
    const std::string version = (*asset)["version"].get<std::string>();
    if (version.compare(0, 2, "2.") != 0) {
      fail("asset.version", "is \"" + version.substr(0, 20) + "\"; only glTF 2.x is read, convert the file first");
    }
    if (text(*asset, "minVersion", "asset", false) && (*asset)["minVersion"] != "2.0") {
      fail("asset.minVersion", "needs a newer glTF than 2.0");
    }
    json kept = *asset;
    for (const char* key : {"version", "minVersion", "generator"}) kept.erase(key);
    if (!kept.empty()) carried_.asset = kept.dump();
    keep_only(*asset, {"version"});
  }

  void check_collections() {
    for (const char* key :
         {"buffers", "bufferViews", "accessors", "samplers", "images", "textures", "materials", "meshes", "nodes",
          "skins", "animations", "scenes", "cameras", "extensionsUsed", "extensionsRequired"}) {
      array(document_, key, "the top level", false);
    }
    check_size("nodes", limits_.max_nodes);
    for (const char* key : {"samplers", "images", "textures", "materials", "scenes", "cameras"})
      check_size(key, limits_.max_looks);
    each("cameras", [&](json& o, const std::string&) { carried_.cameras.push_back(o.dump()); });
    carried_.top = take(document_);
    keep_only(document_,
              {"asset", "buffers", "bufferViews", "accessors", "samplers", "images", "textures", "materials", "meshes",
               "nodes", "skins", "animations", "scenes", "scene", "cameras", "extensionsUsed", "extensionsRequired"});
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
        if (std::strcmp(key, "extensionsRequired") == 0) check_required(name.get<std::string>());
      }
    }
  }

  void check_required(const std::string& name) {
    if (known_extensions().count(name) == 0) {
      fail("the file", "requires the extension " + name.substr(0, 80) +
                           ", which cannot be decoded here; export it again without that extension");
    }
    const std::string missing = missing_decoder(name);
    if (!missing.empty()) fail("the file", "requires the extension " + name + "; " + missing);
    carried_.required.push_back(name);
  }

  void check_buffer(json& o, Where where) {
    whole(o, "byteLength", where, 0, limits_.max_total_bytes, true);
    text(o, "uri", where, false);
    const bool fallback = has_extension(o, "EXT_meshopt_compression") || has_extension(o, "KHR_meshopt_compression");
    stored_.push_back(!fallback || o.contains("uri"));
    keep_only(o, {"byteLength", "uri"});
  }

  void check_view(json& o, Where where) {
    const int buffer = index(o, "buffer", where, "buffers", true);
    const uint64_t length = whole(o, "byteLength", where, 0, max_json_integer, true);
    if (length == 0) o.erase("byteOffset");  // nothing can read from it
    const uint64_t offset = whole(o, "byteOffset", where, 0, max_json_integer, false);
    whole(o, "byteStride", where, 0, 65535, false);
    const uint64_t available = document_["buffers"][static_cast<size_t>(buffer)]["byteLength"].get<uint64_t>();
    if (offset > available || length > available - offset) {
      fail(where, "covers bytes " + std::to_string(offset) + " to " + std::to_string(offset + length) +
                      ", beyond buffer " + std::to_string(buffer) + " of " + std::to_string(available) + " bytes");
    }
    const bool stored = stored_[static_cast<size_t>(buffer)];
    if (!check_meshopt(*this, o, stored, where) && !stored) fail(where, "lies in a buffer without bytes");
    keep_only(o, {"buffer", "byteLength", "byteOffset", "byteStride", "meshopt"});
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

  // count elements of element_bytes from offset, stride apart, within a view. Every operand is at most 2^53, and the
  // limit on decoded bytes bounds the count. So no product leaves 64 bits.
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
    const uint64_t count = whole(o, "count", where, 0, limits_.max_decoded_bytes / 4, true);
    if (count == 0) keep_only(o, {"componentType", "type", "count"});  // where its bytes would be does not matter
    const uint64_t offset = whole(o, "byteOffset", where, 0, max_json_integer, false);
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
      const uint64_t offset = whole(part, "byteOffset", part_where, 0, max_json_integer, false);
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
    const int view = index(o, "bufferView", where, "bufferViews", false);
    if (has_uri == (view >= 0)) fail(where, "must have either \"uri\" or \"bufferView\"");
    if (view >= 0 && document_["bufferViews"][static_cast<size_t>(view)]["byteLength"] == 0)
      fail(where, "lies in a view without bytes");
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
    json* primitives = array(o, "primitives", where, false);
    carried_.primitives.emplace_back();
    if (!primitives || primitives->empty()) warn(where + " has no primitives and shows nothing");
    for (size_t i = 0; primitives && i < primitives->size(); ++i) {
      const std::string inner = where + ".primitives[" + std::to_string(i) + "]";
      json& primitive = (*primitives)[i];
      if (!primitive.is_object()) fail(inner, "is not an object");
      check_primitive(primitive, inner);
    }
    numbers(o, "weights", where, 0);
    const auto extras = o.find("extras");
    if (extras != o.end() && extras->is_object() && extras->contains("targetNames")) {
      o["targetNames"] = std::move((*extras)["targetNames"]);
      extras->erase("targetNames");
      if (extras->empty()) o.erase(extras);
    }
    carried_.meshes.push_back(take(o));
    keep_only(o, {"name", "primitives", "weights", "targetNames"});
  }

  void check_primitive(json& o, Where where) {
    check_attributes(*object(o, "attributes", where, true), where + ".attributes");
    index(o, "indices", where, "accessors", false);
    index(o, "material", where, "materials", false);
    whole(o, "mode", where, 0, 6, false);
    if (json* targets = array(o, "targets", where, false)) {
      for (size_t t = 0; t < targets->size(); ++t) {
        const std::string inner = where + ".targets[" + std::to_string(t) + "]";
        if (!(*targets)[t].is_object()) fail(inner, "is not an object");
        check_attributes((*targets)[t], inner);
      }
    }
    check_draco(*this, o, where);
    const auto is_empty = [&](const json& from, const char* key) {
      const auto found = from.find(key);
      return found != from.end() && document_["accessors"][found->get<size_t>()]["count"] == 0;
    };
    if (is_empty(o, "indices") || is_empty(o["attributes"], "POSITION")) o["attributes"] = json::object();
    if (o["attributes"].empty()) keep_only(o, {"attributes"});
    carried_.primitives.back().push_back(take(o));
    keep_only(o, {"attributes", "indices", "material", "mode", "targets", "draco"});
  }

  void check_attributes(json& attributes, Where where) {
    for (auto& item : attributes.items()) index(item.value(), where + "." + item.key().substr(0, 60), "accessors");
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
    carried_.node_cameras.push_back(index(o, "camera", where, "cameras", false));
    carried_.node_instances.push_back(instances(o, where));
    carried_.nodes.push_back(take(o));
    keep_only(o, {"name", "mesh", "skin", "matrix", "translation", "rotation", "scale", "weights", "children"});
  }

  // The attributes of EXT_mesh_gpu_instancing; null without it.
  json instances(json& o, Where where) {
    if (!has_extension(o, "EXT_mesh_gpu_instancing")) return {};
    const std::string inner = where + ".extensions.EXT_mesh_gpu_instancing";
    json& extension = o["extensions"]["EXT_mesh_gpu_instancing"];
    if (!extension.is_object()) fail(inner, "is not an object");
    json* attributes = object(extension, "attributes", inner, true);
    check_attributes(*attributes, inner + ".attributes");
    return *attributes;
  }

  // Skins without joints move nothing: nodes lose them, the others move up.
  void drop_empty_skins() {
    json kept = json::array();
    std::vector<int> number;
    each("skins", [&](json& o, const std::string& where) {
      const bool empty = array(o, "joints", where, false) && o["joints"].empty();
      if (empty) warn(where + " has no joints and is skipped");
      number.push_back(empty ? -1 : static_cast<int>(kept.size()));
      if (!empty) kept.push_back(std::move(o));
    });
    if (number.empty()) return;
    document_["skins"] = std::move(kept);
    each("nodes", [&](json& o, const std::string&) {
      const auto skin = o.find("skin");
      if (skin == o.end()) return;
      const int to = number[skin->get<size_t>()];
      if (to >= 0) *skin = to;
      if (to < 0) o.erase(skin);
    });
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
    carried_.skins.push_back(take(o));
    keep_only(o, {"name", "joints", "inverseBindMatrices", "skeleton"});
  }

  void check_animation(json& o, Where where) {
    json* channels = array(o, "channels", where, false);
    // what a clip without channels has besides does not matter
    if (!channels || channels->empty()) o["samplers"] = o["channels"] = json::array();
    channels = &o["channels"];
    json* samplers = array(o, "samplers", where, !channels->empty());
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
    json kept = json::array(), carried = json::array();
    for (size_t i = 0; i < channels->size(); ++i) {
      const std::string inner = where + ".channels[" + std::to_string(i) + "]";
      json& channel = (*channels)[i];
      if (!channel.is_object()) fail(inner, "is not an object");
      whole(channel, "sampler", inner, 0, samplers->size() - 1, true);
      json* target = object(channel, "target", inner, true);
      text(*target, "path", inner + ".target", true);
      index(*target, "node", inner + ".target", "nodes", false);
      if (!target->contains("node")) {
        const auto extensions = target->find("extensions");
        const bool pointer = has_extension(*target, "KHR_animation_pointer") &&
                             std::none_of(extensions->items().begin(), extensions->items().end(), [](const auto& item) {
                               return extension_names_data(item.key(), item.value());
                             });
        if (pointer) {
          carried.push_back({{"target", *target}, {"sampler", (*samplers)[channel["sampler"].get<size_t>()]}});
        } else {
          warn(inner + " has no target node and is skipped");
        }
        continue;
      }
      keep_only(*target, {"node", "path"});
      keep_only(channel, {"sampler", "target"});
      kept.push_back(std::move(channel));
    }
    *channels = std::move(kept);
    carried_.animation_channels.push_back(std::move(carried));
    carried_.animations.push_back(take(o));
    keep_only(o, {"name", "samplers", "channels"});
  }

  void check_scene(json& o, Where where) {
    if (json* nodes = array(o, "nodes", where, false)) {
      for (json& node : *nodes) index(node, where + ".nodes", "nodes");
    }
    carried_.scenes.push_back(take(o));
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

  CarriedDocument& carried_;
  std::vector<std::string>& warnings_;
  std::vector<std::string> dropped_;  // names of extensions
  std::vector<char> stored_;          // by buffer: whether it has bytes
};

}  // namespace

void check_document(json& document, const std::string& name, const ReadLimits& limits, CarriedDocument& carried,
                    std::vector<std::string>& warnings) {
  DocumentCheck(document, name, limits, carried, warnings).run();
}

}  // namespace hf_gltf

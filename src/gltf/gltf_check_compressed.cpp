// Checks of compressed views and primitives. See gltf_check_parts.h.
#include "gltf/gltf_check_parts.h"
#include "gltf/gltf_decompress.h"

namespace hf_gltf {
namespace {

using nlohmann::json;

// Strides the decoder takes; it has undefined behaviour for others.
bool fits(const std::string& mode, const std::string& filter, uint64_t stride, uint64_t count) {
  if (mode == "TRIANGLES") return (stride == 2 || stride == 4) && count % 3 == 0 && filter == "NONE";
  if (mode == "INDICES") return (stride == 2 || stride == 4) && filter == "NONE";
  if (stride % 4 != 0 || stride == 0 || stride > 256) return false;
  if (filter == "OCTAHEDRAL") return stride == 4 || stride == 8;
  if (filter == "QUATERNION") return stride == 8;
  return true;
}

}  // namespace

bool check_meshopt(const TreeCheck& check, json& view, bool stored, const std::string& where) {
  const char* name = TreeCheck::has_extension(view, "EXT_meshopt_compression")   ? "EXT_meshopt_compression"
                     : TreeCheck::has_extension(view, "KHR_meshopt_compression") ? "KHR_meshopt_compression"
                                                                                 : nullptr;
  if (!name) return false;
  const std::string missing = missing_decoder(name);
  if (!missing.empty()) {
    if (stored) return false;
    check.fail(where, "is compressed with " + std::string(name) + "; " + missing);
  }
  const std::string inner = where + ".extensions." + name;
  json& o = view["extensions"][name];
  if (!o.is_object()) check.fail(inner, "is not an object");
  const int buffer = check.index(o, "buffer", inner, "buffers", true);
  const uint64_t length = check.whole(o, "byteLength", inner, 1, max_json_integer, true);
  const uint64_t offset = check.whole(o, "byteOffset", inner, 0, max_json_integer, false);
  const uint64_t stride = check.whole(o, "byteStride", inner, 1, 256, true);
  const uint64_t count = check.whole(o, "count", inner, 1, check.limits().max_total_bytes, true);
  const uint64_t available = check.document()["buffers"][static_cast<size_t>(buffer)]["byteLength"].get<uint64_t>();
  if (offset > available || length > available - offset) {
    check.fail(inner, "covers bytes " + std::to_string(offset) + " to " + std::to_string(offset + length) +
                          ", beyond buffer " + std::to_string(buffer) + " of " + std::to_string(available) + " bytes");
  }
  const uint64_t size = view["byteLength"].get<uint64_t>();
  if (size != count * stride) {
    check.fail(inner, "holds " + std::to_string(count) + " elements of " + std::to_string(stride) +
                          " bytes, but its view has " + std::to_string(size) + " bytes");
  }
  check.text(o, "mode", inner, true);
  const bool filtered = check.text(o, "filter", inner, false);
  const std::string mode = o["mode"].get<std::string>();
  const std::string filter = filtered ? o["filter"].get<std::string>() : "NONE";
  if (mode != "ATTRIBUTES" && mode != "TRIANGLES" && mode != "INDICES") {
    check.fail(inner + ".mode", "is \"" + mode.substr(0, 40) + "\", which cannot be decoded here");
  }
  if (filter != "NONE" && filter != "OCTAHEDRAL" && filter != "QUATERNION" && filter != "EXPONENTIAL") {
    check.fail(inner + ".filter", "is \"" + filter.substr(0, 40) + "\", which cannot be decoded here");
  }
  if (!fits(mode, filter, stride, count)) {
    check.fail(inner, "has " + std::to_string(count) + " elements of " + std::to_string(stride) +
                          " bytes, which do not belong to mode " + mode + " and filter " + filter);
  }
  view["meshopt"] = {{"buffer", buffer}, {"byteOffset", offset}, {"byteLength", length}, {"byteStride", stride},
                     {"count", count},   {"mode", mode},         {"filter", filter}};
  return true;
}

void check_draco(const TreeCheck& check, json& primitive, const std::string& where) {
  const std::string name = "KHR_draco_mesh_compression";
  if (!TreeCheck::has_extension(primitive, name.c_str())) return;
  const std::string inner = where + ".extensions." + name;
  json& o = primitive["extensions"][name];
  if (!o.is_object()) check.fail(inner, "is not an object");
  check.index(o, "bufferView", inner, "bufferViews", true);
  json* attributes = check.object(o, "attributes", inner, true);
  const json& own = primitive["attributes"];
  const json& accessors = check.document()["accessors"];
  const auto is_stored = [&](const json& accessor) { return accessors[accessor.get<size_t>()].contains("bufferView"); };
  bool stored = primitive.contains("indices") && is_stored(primitive["indices"]);
  for (auto& item : attributes->items()) {
    const std::string key = item.key().substr(0, 60);
    check.whole(item.value(), inner + ".attributes." + key, 0, 1u << 30);
    const auto found = own.find(item.key());
    if (found == own.end()) check.fail(inner + ".attributes", "names " + key + ", which the primitive does not have");
    stored = stored && is_stored(*found);
  }
  // the uncompressed form beside it counts: it is the exact one
  if (stored) return;
  const std::string missing = missing_decoder(name);
  if (!missing.empty()) check.fail(where, "is compressed with " + name + "; " + missing);
  if (!primitive.contains("indices")) check.fail(where, "is compressed with " + name + " and has no indices");
  const auto mode = primitive.find("mode");
  const uint64_t kind = mode == primitive.end() ? 4 : mode->get<uint64_t>();
  if (kind != 4 && kind != 5) check.fail(where, "is compressed with " + name + " and holds no triangles");
  primitive["draco"] = {{"bufferView", o["bufferView"]}, {"attributes", *attributes}};
}

}  // namespace hf_gltf

// See gltf_decompress.h. The document's side; the streams are decoded in gltf_draco.cpp and gltf_meshopt.cpp.
#include "gltf/gltf_decompress.h"

#include <algorithm>
#include <stdexcept>

#include "gltf/file_bytes.h"

namespace hf_gltf {
namespace {

using nlohmann::json;

constexpr uint64_t index_bytes = 4;

uint64_t component_bytes(int type) { return type == 5120 || type == 5121 ? 1 : type == 5122 || type == 5123 ? 2 : 4; }

uint64_t component_count(const std::string& type) {
  if (type == "SCALAR") return 1;
  return type.size() == 4 && type.compare(0, 3, "VEC") == 0 ? static_cast<uint64_t>(type[3] - '0') : 0;
}

[[noreturn]] void fail(const std::string& where, const std::string& message) {
  throw std::runtime_error(printable(where + " " + message));
}

// Calls decode and puts the place in front of the message that it throws.
template <typename Decode>
void decode_at(const std::string& where, Decode&& decode) {
  try {
    decode();
  } catch (const std::bad_alloc&) {
    fail(where, "needs more memory to decode than there is");
  } catch (const std::exception& error) {
    fail(where, error.what());
  }
}

void decompress_view(json& view, const BufferStore& store, const std::string& where) {
  const json from = std::move(view["meshopt"]);
  view.erase("meshopt");
  MeshoptView stream;
  stream.count = from["count"].get<size_t>();
  stream.stride = from["byteStride"].get<size_t>();
  stream.mode = from["mode"].get<std::string>();
  stream.filter = from["filter"].get<std::string>();
  store.charge(stream.count * stream.stride, where);
  const std::vector<uint8_t>& buffer = store.bytes_of(from["buffer"].get<size_t>());
  std::vector<uint8_t> out;
  decode_at(where, [&] {
    decode_meshopt(stream, buffer.data() + from["byteOffset"].get<size_t>(), from["byteLength"].get<size_t>(), out);
  });
  view["buffer"] = store.add(std::move(out));
  view["byteOffset"] = 0;
}

class PrimitiveDecoder {
 public:
  PrimitiveDecoder(json& document, json& primitive, const BufferStore& store, std::string where)
      : document_(document), primitive_(primitive), store_(store), where_(std::move(where)) {}

  void run() {
    const json from = std::move(primitive_["draco"]);
    primitive_.erase("draco");
    read_attributes(from["attributes"]);
    const size_t index_count = accessor(primitive_["indices"])["count"].get<size_t>();
    const bool strip = primitive_.value("mode", 4) == 5;
    store_.charge(index_count * index_bytes * (strip ? 3 : 1), where_);
    const json& view = document_["bufferViews"][from["bufferView"].get<size_t>()];
    const std::vector<uint8_t>& buffer = store_.bytes_of(view["buffer"].get<size_t>());
    const size_t offset = view.value("byteOffset", size_t{0}), size = view["byteLength"].get<size_t>();
    std::vector<uint8_t> indices;
    decode_at(where_, [&] {
      decode_draco(buffer.data() + offset, size, points_, index_count, strip, store_.memory_limit, attributes_,
                   indices);
    });
    for (size_t i = 0; i < names_.size(); ++i) {
      json out = accessor(primitive_["attributes"][names_[i]]);
      primitive_["attributes"][names_[i]] = add(std::move(out), std::move(attributes_[i].data));
    }
    json out = {{"type", "SCALAR"}, {"componentType", 5125}, {"count", indices.size() / index_bytes}};
    primitive_["indices"] = add(std::move(out), std::move(indices));
    primitive_["mode"] = 4;
  }

 private:
  const json& accessor(const json& number) const { return document_["accessors"][number.get<size_t>()]; }

  void read_attributes(const json& ids) {
    for (const auto& item : ids.items()) {
      const json& o = accessor(primitive_["attributes"][item.key()]);
      if (o.contains("sparse")) fail(where_, "is compressed and has sparse accessors, which cannot be decoded here");
      DracoAttribute attribute;
      attribute.id = item.value().get<uint32_t>();
      attribute.component_type = o["componentType"].get<int>();
      attribute.components = component_count(o["type"].get<std::string>());
      attribute.bytes = component_bytes(attribute.component_type);
      const size_t count = o["count"].get<size_t>();
      if (attribute.components == 0)
        fail(where_ + "." + item.key().substr(0, 60), "is a matrix, which Draco cannot hold");
      if (!names_.empty() && count != points_) fail(where_, "has attributes of different lengths");
      points_ = count;
      store_.charge(count * attribute.components * attribute.bytes, where_);
      names_.push_back(item.key());
      attributes_.push_back(std::move(attribute));
    }
    if (names_.empty()) fail(where_, "is compressed and names no attribute");
  }

  // A new accessor, because another primitive may use the old one.
  size_t add(json out, std::vector<uint8_t> bytes) {
    const size_t size = bytes.size();
    document_["bufferViews"].push_back(
        {{"buffer", store_.add(std::move(bytes))}, {"byteOffset", 0}, {"byteLength", size}});
    out["bufferView"] = document_["bufferViews"].size() - 1;
    out["byteOffset"] = 0;
    document_["accessors"].push_back(std::move(out));
    return document_["accessors"].size() - 1;
  }

  json& document_;
  json& primitive_;
  const BufferStore& store_;
  const std::string where_;
  size_t points_ = 0;
  std::vector<std::string> names_;
  std::vector<DracoAttribute> attributes_;
};

}  // namespace

std::string missing_decoder(const std::string& extension) {
  const bool draco = extension == "KHR_draco_mesh_compression";
  const bool meshopt = extension == "EXT_meshopt_compression" || extension == "KHR_meshopt_compression";
  const std::string way_on = " and build again, or export the file without compression";
  if (draco && !has_draco()) return "this build has no Draco: install libdraco-dev" + way_on;
  if (meshopt && !has_meshopt()) return "this build has no meshoptimizer: install libmeshoptimizer-dev" + way_on;
  return "";
}

void decompress(json& document, const BufferStore& store) {
  const auto views = document.find("bufferViews");
  for (size_t i = 0; views != document.end() && i < views->size(); ++i) {
    json& view = document["bufferViews"][i];
    if (view.contains("meshopt")) decompress_view(view, store, "bufferViews[" + std::to_string(i) + "]");
  }
  const auto meshes = document.find("meshes");
  for (size_t m = 0; meshes != document.end() && m < meshes->size(); ++m) {
    json& primitives = document["meshes"][m]["primitives"];
    for (size_t p = 0; p < primitives.size(); ++p) {
      if (!primitives[p].contains("draco")) continue;
      const std::string where = "meshes[" + std::to_string(m) + "].primitives[" + std::to_string(p) + "]";
      PrimitiveDecoder(document, primitives[p], store, where).run();
    }
  }
}

}  // namespace hf_gltf

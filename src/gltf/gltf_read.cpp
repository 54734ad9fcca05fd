// See gltf_read.h. Here: bytes -> checked text -> tinygltf's structures with every buffer in memory. gltf_convert.cpp
// interprets them.
#include "gltf/gltf_read.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "gltf/file_bytes.h"
#include "gltf/foreign_file.h"
#include "gltf/gltf_check.h"
#include "gltf/gltf_convert.h"
#include "gltf/gltf_decompress.h"

namespace hf_gltf {
namespace {

using nlohmann::json;

// The only files tinygltf gets to see.
using VirtualFiles = std::map<std::string, std::vector<uint8_t>>;

bool virtual_exists(const std::string& name, void* user) {
  return static_cast<const VirtualFiles*>(user)->count(name) != 0;
}

std::string virtual_expand(const std::string& name, void*) { return name; }

bool virtual_read(std::vector<unsigned char>* out, std::string* error, const std::string& name, void* user) {
  auto& files = *static_cast<VirtualFiles*>(user);
  const auto found = files.find(name);
  if (found == files.end()) {
    if (error) *error += "not found";
    return false;
  }
  *out = std::move(found->second);
  files.erase(found);
  return true;
}

bool virtual_write(std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; }

// Keeps the encoded bytes, whatever they are.
bool keep_image(tinygltf::Image* image, const int, std::string*, std::string*, int, int, const unsigned char* bytes,
                int size, void*) {
  image->image.assign(bytes, bytes + std::max(size, 0));
  image->as_is = true;
  return true;
}

class Loader {
 public:
  Loader(std::vector<uint8_t> bytes, std::string name, std::filesystem::path location, const ReadLimits& limits)
      : bytes_(std::move(bytes)), name_(std::move(name)), location_(std::move(location)), limits_(limits) {}

  Model run() {
    GltfContainer container = open_container(bytes_, name_, limits_, warnings_);
    json& document = container.document;
    GltfSource source;
    check_document(document, name_, limits_, source.carried, warnings_);

    load_buffers(document, container);
    decompress_all(document);
    source.stored_bytes = bytes_.size() + used_;
    bytes_ = std::vector<uint8_t>();
    load_images(document, limits_.decoded_limit(source.stored_bytes));
    source.name = name_;
    collect_target_names(document, source);
    parse(document, source.gltf);
    restore_images(source.gltf);
    source.warnings = std::move(warnings_);
    return convert(source, limits_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw std::runtime_error(name_ + ": " + printable(message) + ".");
  }

  static std::string element(const char* collection, size_t i) {
    return std::string(collection) + "[" + std::to_string(i) + "]";
  }

  void charge(uint64_t bytes, const std::string& what) {
    if (bytes > limits_.max_total_bytes - used_) {
      fail(what + " takes the file's buffers and images above the limit of " + std::to_string(limits_.max_total_bytes) +
           " bytes");
    }
    used_ += bytes;
  }

  void load_buffers(json& document, const GltfContainer& container) {
    const auto found = document.find("buffers");
    if (found == document.end()) return;
    const std::vector<char> viewed = viewed_buffers(document);
    for (size_t i = 0; i < found->size(); ++i) {
      json& o = (*found)[i];
      const auto length = o["byteLength"].get<uint64_t>();
      const std::string what = element("buffers", i);
      const bool stored = o.contains("uri") || (i == 0 && container.has_binary_chunk);
      if (length == 0 || (!stored && !viewed[i])) {
        // empty, or a placeholder for an extension: there is nothing to read, but the parser wants bytes
        o["byteLength"] = 1;
        o["uri"] = "buffer" + std::to_string(i);
        files_["buffer" + std::to_string(i)] = {0};
        continue;
      }
      charge(length, what);
      std::vector<uint8_t> data = o.contains("uri") ? buffer_from_uri(o["uri"].get_ref<const std::string&>(), what)
                                                    : buffer_from_chunk(i, container, what);
      if (data.size() < length) {
        fail(what + " should have " + std::to_string(length) + " bytes but has " + std::to_string(data.size()));
      }
      data.resize(static_cast<size_t>(length));
      const std::string virtual_name = "buffer" + std::to_string(i);
      o["uri"] = virtual_name;
      files_[virtual_name] = std::move(data);
    }
  }

  // Per buffer whether a view names it. A compressed view names the buffer of its compressed bytes.
  static std::vector<char> viewed_buffers(const json& document) {
    std::vector<char> viewed(document["buffers"].size(), 0);
    const auto views = document.find("bufferViews");
    if (views == document.end()) return viewed;
    for (const json& view : *views) {
      const json& stored = view.contains("meshopt") ? view["meshopt"] : view;
      viewed[stored["buffer"].get<size_t>()] = 1;
    }
    return viewed;
  }

  void decompress_all(json& document) {
    uint64_t decompressed = 0;
    const uint64_t limit = limits_.free_decoded_bytes + limits_.decompressed_per_byte * (bytes_.size() + used_);
    BufferStore store;
    store.memory_limit = limits_.max_decompress_bytes;
    store.bytes_of = [&](size_t i) -> const std::vector<uint8_t>& { return files_["buffer" + std::to_string(i)]; };
    store.charge = [&](uint64_t bytes, const std::string& what) {
      charge(bytes, what);
      decompressed += bytes;
      if (decompressed > limit) {
        fail(what + " takes what compressed geometry decodes to above the limit of " + std::to_string(limit) +
             " bytes; raise free_decoded_bytes if the file is to be trusted");
      }
    };
    store.add = [&](std::vector<uint8_t> data) {
      const size_t i = document["buffers"].size();
      const std::string virtual_name = "buffer" + std::to_string(i);
      document["buffers"].push_back({{"byteLength", data.size()}, {"uri", virtual_name}});
      files_[virtual_name] = std::move(data);
      return i;
    };
    try {
      decompress(document, store);
    } catch (const std::runtime_error& error) {
      const std::string what = error.what();
      if (what.compare(0, name_.size(), name_) == 0) throw;
      fail(what);
    }
  }

  std::vector<uint8_t> buffer_from_chunk(size_t i, const GltfContainer& container, const std::string& what) const {
    if (i != 0 || !container.has_binary_chunk) fail(what + " has no uri and is not the binary chunk of a GLB");
    const auto first = bytes_.begin() + static_cast<std::ptrdiff_t>(container.binary_offset);
    return {first, first + static_cast<std::ptrdiff_t>(container.binary_size)};
  }

  std::vector<uint8_t> buffer_from_uri(const std::string& uri, const std::string& what) const {
    std::vector<uint8_t> data;
    std::string mime_type;
    if (uri.compare(0, 5, "data:") == 0) {
      if (!decode_data_uri(uri, data, mime_type)) fail(what + ": its data: URI is not valid base64");
      return data;
    }
    std::string reason;
    const std::filesystem::path file = resolve(uri, reason);
    if (file.empty()) fail(what + " names the file \"" + uri.substr(0, 120) + "\", which is not read: " + reason);
    return read_bytes(file, limits_.max_file_bytes);
  }

  std::filesystem::path resolve(const std::string& uri, std::string& reason) const {
    if (!location_.empty()) return resolve_below(location_, uri, reason);
    reason = "the model was not read from a folder";
    return {};
  }

  // An image that cannot be read is no reason to refuse a model: its URI is kept and is in the output again. Parameter
  // copied_limit: bytes of views that images may copy.
  void load_images(json& document, uint64_t copied_limit) {
    const auto found = document.find("images");
    if (found == document.end()) return;
    image_uris_.resize(found->size());
    uint64_t copied = 0;
    for (size_t i = 0; i < found->size(); ++i) {
      json& o = (*found)[i];
      if (!o.contains("uri")) {
        // the bytes of the view are copied by the image callback
        const auto bytes = document["bufferViews"][o["bufferView"].get<size_t>()]["byteLength"].get<uint64_t>();
        charge(bytes, element("images", i));
        copied += bytes;
        if (copied > copied_limit) {
          fail(element("images", i) + " takes what images copy from views to " + std::to_string(copied) +
               " bytes, above the limit of " + std::to_string(copied_limit) +
               "; raise free_decoded_bytes if the file is to be trusted");
        }
        continue;
      }
      std::string uri = o["uri"].get<std::string>();
      std::vector<uint8_t> data;
      std::string reason = image_bytes(uri, o, data);
      const std::string virtual_name = "image" + std::to_string(i);
      o["uri"] = virtual_name;
      if (reason.empty() && !data.empty()) {
        charge(data.size(), element("images", i));
        files_[virtual_name] = std::move(data);
      } else {
        warnings_.push_back(element("images", i) + " \"" + uri.substr(0, 120) +
                            "\" is not read, its name is kept: " + (reason.empty() ? "it is empty" : reason));
      }
      image_uris_[i] = std::move(uri);
    }
  }

  std::string image_bytes(const std::string& uri, json& o, std::vector<uint8_t>& data) const {
    std::string mime_type, reason;
    if (uri.compare(0, 5, "data:") == 0) {
      if (!decode_data_uri(uri, data, mime_type)) return "its data: URI is not valid base64";
      if (!o.contains("mimeType") && !mime_type.empty()) o["mimeType"] = mime_type;
      return "";
    }
    const std::filesystem::path file = resolve(uri, reason);
    if (file.empty()) return reason;
    try {
      data = read_bytes(file, std::min(limits_.max_file_bytes, limits_.max_total_bytes - used_));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  // Where the bytes are here the name is dropped: the writer embeds them.
  void restore_images(tinygltf::Model& gltf) const {
    for (size_t i = 0; i < gltf.images.size() && i < image_uris_.size(); ++i) {
      gltf.images[i].uri = gltf.images[i].image.empty() ? image_uris_[i] : "";
    }
  }

  static void collect_target_names(json& document, GltfSource& source) {
    const auto found = document.find("meshes");
    if (found == document.end()) return;
    for (json& mesh : *found) {
      std::vector<std::string> names;
      const auto list = mesh.find("targetNames");
      if (list != mesh.end() && list->is_array()) {
        for (const json& name : *list) names.push_back(name.is_string() ? name.get<std::string>() : "");
      }
      mesh.erase("targetNames");
      source.target_names.push_back(std::move(names));
    }
  }

  void parse(json& document, tinygltf::Model& gltf) {
    tinygltf::TinyGLTF parser;
    parser.SetImageLoader(&keep_image, nullptr);
    tinygltf::FsCallbacks callbacks{&virtual_exists, &virtual_expand, &virtual_read, &virtual_write, &files_};
    parser.SetFsCallbacks(callbacks);
    std::string error, warning;
    bool good = false;
    try {
      const std::string text = document.dump();
      document = json();
      good = parser.LoadASCIIFromString(&gltf, &error, &warning, text.data(), static_cast<unsigned int>(text.size()),
                                        "", tinygltf::NO_REQUIRE);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& exception) {
      error = exception.what();
    }
    if (good) return;
    std::replace(error.begin(), error.end(), '\n', ' ');
    fail("is not accepted by the glTF parser: " + error.substr(0, 400));
  }

  std::vector<uint8_t> bytes_;
  const std::string name_;
  const std::filesystem::path location_;
  const ReadLimits& limits_;
  uint64_t used_ = 0;
  VirtualFiles files_;
  std::vector<std::string> image_uris_;
  std::vector<std::string> warnings_;
};

}  // namespace

Model read_gltf_bytes(std::vector<uint8_t> bytes, const std::string& name, const std::filesystem::path& location,
                      const ReadLimits& limits) {
  if (bytes.size() > limits.max_file_bytes) {
    throw std::runtime_error(name + ": has " + std::to_string(bytes.size()) + " bytes, above the limit of " +
                             std::to_string(limits.max_file_bytes) + ".");
  }
  const FileKind kind = kind_of(bytes.data(), bytes.size(), bytes.size(), name);
  std::vector<std::string> warnings;
  if (reads_foreign(kind)) bytes = foreign_glb(bytes, kind, name, warnings);
  Model model = Loader(std::move(bytes), name, location, limits).run();
  model.warnings.insert(model.warnings.begin(), warnings.begin(), warnings.end());
  return model;
}

Model read_gltf(const std::filesystem::path& file, const ReadLimits& limits) {
  return read_gltf_bytes(read_bytes(file, limits.max_file_bytes), file.string(), file, limits);
}

}  // namespace hf_gltf

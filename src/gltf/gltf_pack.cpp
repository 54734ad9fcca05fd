// See gltf_pack.h.
#include "gltf/gltf_pack.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "gltf/gltf_carried.h"

namespace hf_gltf {
namespace {

using nlohmann::json;

json structure_json(const Model& model, tinygltf::Model& structures) {
  tinygltf::TinyGLTF writer;
  writer.SetImageWriter(
      [](const std::string*, const std::string*, const tinygltf::Image*, bool, std::string*, void*) { return false; },
      nullptr);
  std::ostringstream stream;
  if (!writer.WriteGltfSceneToStream(&structures, stream, false, false) || !stream) {
    throw std::runtime_error(model.name + ": the glTF writer failed.");
  }
  return json::parse(stream.str());
}

void put_instances(const WrittenNumbers::InstanceAccessors& from, json& node) {
  json attributes = json::object();
  if (from.translations >= 0) attributes["TRANSLATION"] = from.translations;
  if (from.rotations >= 0) attributes["ROTATION"] = from.rotations;
  if (from.scales >= 0) attributes["SCALE"] = from.scales;
  if (!attributes.empty()) node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = attributes;
}

void put_all(const Model& model, const WrittenNumbers& numbers, json& document) {
  put_carried(model.carried, document);
  if (!model.asset.empty()) {
    const json asset = json::parse(model.asset);
    for (const auto& item : asset.items()) document["asset"].emplace(item.key(), item.value());
  }
  for (size_t i = 0; i < model.scenes.size(); ++i) put_carried(model.scenes[i].carried, document["scenes"][i]);
  for (size_t n = 0; n < model.nodes.size(); ++n) {
    json& node = document["nodes"][n];
    put_carried(model.nodes[n].carried, node);
    put_instances(numbers.instances[n], node);
    if (model.nodes[n].camera >= 0) node["camera"] = model.nodes[n].camera;
  }
  for (const std::string& camera : model.cameras) document["cameras"].push_back(json::parse(camera));
  for (size_t s = 0; s < model.skins.size(); ++s) put_carried(model.skins[s].carried, document["skins"][s]);
  for (size_t m = 0; m < model.meshes.size(); ++m) {
    if (numbers.meshes[m] < 0) continue;
    json& mesh = document["meshes"][static_cast<size_t>(numbers.meshes[m])];
    put_carried(model.meshes[m].carried, mesh);
    for (size_t p = 0; p < numbers.primitives[m].size(); ++p) {
      const int number = numbers.primitives[m][p];
      if (number < 0) continue;
      put_carried(model.meshes[m].primitives[p].carried, mesh["primitives"][static_cast<size_t>(number)]);
    }
  }
  for (size_t a = 0; a < model.animations.size(); ++a) {
    if (numbers.animations[a] < 0) continue;
    json& animation = document["animations"][static_cast<size_t>(numbers.animations[a])];
    put_carried(model.animations[a].carried, animation);
    for (size_t c = 0; c < model.animations[a].carried_channels.size(); ++c) {
      const WrittenNumbers::CarriedKeys& keys = numbers.carried_keys[a][c];
      animation["channels"].push_back({{"sampler", animation["samplers"].size()},
                                       {"target", json::parse(model.animations[a].carried_channels[c].target)}});
      animation["samplers"].push_back(
          {{"input", keys.input}, {"output", keys.output}, {"interpolation", keys.interpolation}});
    }
    if (!model.animations[a].name.empty()) animation["name"] = model.animations[a].name;
  }
}

void list_extensions(const Model& model, json& document) {
  document.erase("extensionsUsed");
  document.erase("extensionsRequired");
  const std::vector<std::string> used = used_extensions(document);
  if (!used.empty()) document["extensionsUsed"] = used;
  for (const std::string& name : model.required_extensions) {
    if (std::find(used.begin(), used.end(), name) != used.end()) document["extensionsRequired"].push_back(name);
  }
}

std::string base64(const std::vector<unsigned char>& bytes) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t count = std::min<size_t>(3, bytes.size() - i);
    uint32_t word = 0;
    for (size_t k = 0; k < 3; ++k) word = word << 8 | (k < count ? bytes[i + k] : 0u);
    for (size_t k = 0; k < 4; ++k) out += k <= count ? digits[word >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

void append_u32(std::string& out, size_t value) {
  for (int i = 0; i < 4; ++i) out += static_cast<char>(value >> (8 * i) & 255);
}

std::string container(std::string text, const std::vector<unsigned char>& bytes) {
  constexpr size_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const size_t padded = (bytes.size() + 3) / 4 * 4;
  std::string out = "glTF";
  append_u32(out, 2);
  append_u32(out, 20 + text.size() + (bytes.empty() ? 0 : 8 + padded));
  append_u32(out, text.size());
  append_u32(out, json_chunk);
  out += text;
  if (bytes.empty()) return out;
  append_u32(out, padded);
  append_u32(out, binary_chunk);
  out.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  out.resize(out.size() + padded - bytes.size(), '\0');
  return out;
}

}  // namespace

std::string pack_gltf(const Model& model, tinygltf::Model& structures, const WrittenNumbers& numbers,
                      const std::vector<unsigned char>& bytes, bool binary) {
  json document = structure_json(model, structures);
  put_all(model, numbers, document);
  list_extensions(model, document);
  document.erase("buffers");
  if (!bytes.empty()) {
    json buffer = {{"byteLength", bytes.size()}};
    if (!binary) buffer["uri"] = "data:application/octet-stream;base64," + base64(bytes);
    document["buffers"].push_back(std::move(buffer));
  }
  return binary ? container(document.dump(), bytes) : document.dump(2) + "\n";
}

}  // namespace hf_gltf

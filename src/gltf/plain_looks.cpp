// See plain_looks.h.
#include "gltf/plain_looks.h"

#include <map>
#include <memory>

#include "gltf/gltf_appearance.h"

namespace hf_gltf {

PlainLooks plain_looks(const Model& model) {
  PlainLooks out;
  out.materials = model.materials;
  out.images_of.assign(model.materials.size(), -1);
  if (!model.appearance) return out;
  const Appearance& looks = *model.appearance;
  std::map<int, int> taken;
  for (size_t m = 0; m < looks.materials.size() && m < out.materials.size(); ++m) {
    const int texture = looks.materials[m].pbrMetallicRoughness.baseColorTexture.index;
    if (texture < 0 || static_cast<size_t>(texture) >= looks.textures.size()) continue;
    const int source = looks.textures[static_cast<size_t>(texture)].source;
    if (source < 0 || static_cast<size_t>(source) >= looks.images.size()) continue;
    const auto [at, is_new] = taken.emplace(source, static_cast<int>(out.images.size()));
    const tinygltf::Image& image = looks.images[static_cast<size_t>(source)];
    if (is_new) out.images.push_back({image.image.empty() ? image.uri : "", image.image});
    out.images_of[m] = at->second;
  }
  return out;
}

void set_plain_looks(Model& model, const PlainLooks& looks) {
  auto to = std::make_shared<Appearance>();
  for (const PlainImage& from : looks.images) {
    tinygltf::Image image;
    image.uri = from.uri;
    image.image = from.bytes;
    tinygltf::Texture texture;
    texture.source = static_cast<int>(to->images.size());
    to->images.push_back(std::move(image));
    to->textures.push_back(std::move(texture));
  }
  for (size_t m = 0; m < looks.materials.size(); ++m) {
    const Material& from = looks.materials[m];
    tinygltf::Material material;
    material.name = from.name;
    material.doubleSided = from.double_sided;
    auto& pbr = material.pbrMetallicRoughness;
    pbr.baseColorFactor.clear();
    for (int c = 0; c < 4; ++c) pbr.baseColorFactor.push_back(static_cast<double>(from.base_color[c]));
    pbr.metallicFactor = static_cast<double>(from.metallic);
    pbr.roughnessFactor = static_cast<double>(from.roughness);
    pbr.baseColorTexture.index = looks.images_of[m];
    if (from.base_color.a < 1) material.alphaMode = "BLEND";
    to->materials.push_back(std::move(material));
  }
  model.materials = looks.materials;
  model.appearance = std::move(to);
}

}  // namespace hf_gltf

// See texture_colors.h. The decoder is Sean Barrett's stb_image, compiled here as static functions.
#include "transfer/texture_colors.h"

#include <cmath>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#endif
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#include <stb/stb_image.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

#include "gltf/gltf_appearance.h"

namespace samples {
namespace {

constexpr int most_pixels_a_side = 4096;

template <class T>
const T* entry(const std::vector<T>& list, int i) {
  return i >= 0 && static_cast<size_t>(i) < list.size() ? &list[static_cast<size_t>(i)] : nullptr;
}

// Moves of texture coordinates (KHR_texture_transform).
struct Placement {
  glm::vec2 offset{0}, scale{1};
  float rotation = 0;
  int set = 0;

  explicit Placement(const tinygltf::TextureInfo& info) : set(info.texCoord) {
    const auto found = info.extensions.find("KHR_texture_transform");
    if (found == info.extensions.end() || !found->second.IsObject()) return;
    const tinygltf::Value& o = found->second;
    const auto pair = [&](const char* name, glm::vec2& to) {
      if (!o.Has(name) || !o.Get(name).IsArray() || o.Get(name).ArrayLen() != 2) return;
      for (int k = 0; k < 2; ++k)
        to[k] = static_cast<float>(o.Get(name).Get(static_cast<size_t>(k)).GetNumberAsDouble());
    };
    pair("offset", offset);
    pair("scale", scale);
    if (o.Has("rotation")) rotation = static_cast<float>(o.Get("rotation").GetNumberAsDouble());
    if (o.Has("texCoord")) set = o.Get("texCoord").GetNumberAsInt();
  }
  glm::vec2 of(glm::vec2 uv) const {
    uv *= scale;
    const float c = std::cos(rotation), s = std::sin(rotation);
    return offset + glm::vec2(c * uv.x + s * uv.y, c * uv.y - s * uv.x);
  }
};

float linear(uint8_t value) { return std::pow(static_cast<float>(value) / 255.0F, 2.2F); }

// The pixel of a coordinate that repeats.
int pixel(float at, int size) {
  if (!std::isfinite(at)) return 0;
  return std::min(static_cast<int>((at - std::floor(at)) * static_cast<float>(size)), size - 1);
}

}  // namespace

const TextureColors::Pixels& TextureColors::pixels(int image) {
  const auto [found, is_new] = read_.try_emplace(image);
  Pixels& out = found->second;
  const tinygltf::Image* const stored = entry(model_.appearance->images, image);
  if (!is_new || !stored || stored->image.empty()) return out;
  const auto size = static_cast<int>(stored->image.size());
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(stored->image.data(), size, &width, &height, &channels)) return out;
  if (width > most_pixels_a_side || height > most_pixels_a_side) return out;
  uint8_t* const rgb = stbi_load_from_memory(stored->image.data(), size, &width, &height, &channels, 3);
  if (!rgb) return out;
  out.width = width;
  out.height = height;
  out.rgb.assign(rgb, rgb + 3 * static_cast<size_t>(width) * static_cast<size_t>(height));
  stbi_image_free(rgb);
  return out;
}

std::vector<glm::vec3> TextureColors::of(const hf_gltf::Primitive& primitive) {
  std::vector<glm::vec3> out(primitive.positions.size(), glm::vec3(1));
  const tinygltf::Material* const material =
      model_.appearance ? entry(model_.appearance->materials, primitive.material) : nullptr;
  if (!material) return out;
  const tinygltf::TextureInfo& info = material->pbrMetallicRoughness.baseColorTexture;
  const tinygltf::Texture* const texture = entry(model_.appearance->textures, info.index);
  const Placement placement(info);
  const std::vector<glm::vec2>* const coordinates = entry(primitive.texcoords, placement.set);
  if (!texture || !coordinates || coordinates->size() != out.size()) return out;
  const Pixels& image = pixels(texture->source);
  if (image.rgb.empty()) return out;
  for (size_t v = 0; v < out.size(); ++v) {
    const glm::vec2 uv = placement.of((*coordinates)[v]);
    const size_t at = 3 * (static_cast<size_t>(pixel(uv.y, image.height)) * static_cast<size_t>(image.width) +
                           static_cast<size_t>(pixel(uv.x, image.width)));
    for (int c = 0; c < 3; ++c) out[v][c] = linear(image.rgb[at + static_cast<size_t>(c)]);
  }
  return out;
}

}  // namespace samples

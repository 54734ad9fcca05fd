// The colours of base-colour textures at vertices, for pictures.
#ifndef HF_SAMPLES_TRANSFER_TEXTURE_COLORS_H
#define HF_SAMPLES_TRANSFER_TEXTURE_COLORS_H

#include <cstdint>
#include <map>
#include <vector>

#include "gltf/model.h"

namespace samples {

class TextureColors {
 public:
  explicit TextureColors(const hf_gltf::Model& model) : model_(model) {}

  // Colours of the vertices, linear; white where there is no texture. PNG and JPEG of up to 4096 pixels a side are
  // read; other images count as none.
  std::vector<glm::vec3> of(const hf_gltf::Primitive& primitive);

 private:
  struct Pixels {
    int width = 0, height = 0;
    std::vector<uint8_t> rgb;
  };
  const Pixels& pixels(int image);

  const hf_gltf::Model& model_;
  std::map<int, Pixels> read_;
};

}  // namespace samples

#endif

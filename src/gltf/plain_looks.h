// Materials in the form that other formats hold: a colour and an image for each.
#ifndef HF_GLTF_PLAIN_LOOKS_H
#define HF_GLTF_PLAIN_LOOKS_H

#include <cstdint>
#include <string>
#include <vector>

#include "gltf/model.h"

namespace hf_gltf {

struct PlainImage {
  std::string uri;             // where the bytes are not at hand
  std::vector<uint8_t> bytes;  // of a PNG or another file
};

struct PlainLooks {
  std::vector<Material> materials;
  std::vector<int> images_of;  // one a material: its image of the base colour, of the list below, or -1
  std::vector<PlainImage> images;
};

// The materials of a model with the images that their base colours use.
PlainLooks plain_looks(const Model& model);
// Gives a model these materials in place of its own.
void set_plain_looks(Model& model, const PlainLooks& looks);

}  // namespace hf_gltf

#endif

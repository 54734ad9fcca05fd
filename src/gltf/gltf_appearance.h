// Inner header of gltf_read.cpp and gltf_write.cpp: the parts that are carried through unchanged, in tinygltf's own
// types.
#ifndef HF_GLTF_GLTF_APPEARANCE_H
#define HF_GLTF_GLTF_APPEARANCE_H

#include <tiny_gltf.h>

#include <string>
#include <vector>

namespace hf_gltf {

// Images hold their encoded bytes in Image::image (as_is), or only a URI where the bytes were not read.
struct Appearance {
  std::vector<tinygltf::Material> materials;
  std::vector<tinygltf::Texture> textures;
  std::vector<tinygltf::Image> images;
  std::vector<tinygltf::Sampler> samplers;
};

}  // namespace hf_gltf

#endif

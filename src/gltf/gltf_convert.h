// Inner header of gltf_read.cpp: tinygltf's structures, buffers loaded, to a Model, with every value checked.
#ifndef HF_GLTF_GLTF_CONVERT_H
#define HF_GLTF_GLTF_CONVERT_H

#include <tiny_gltf.h>

#include <string>
#include <vector>

#include "gltf/gltf_carried.h"
#include "gltf/gltf_read.h"

namespace hf_gltf {

struct GltfSource {
  std::string name;
  tinygltf::Model gltf;
  std::vector<std::vector<std::string>> target_names;  // per mesh
  CarriedDocument carried;
  std::vector<std::string> warnings;
  uint64_t stored_bytes = 0;  // of the file and its buffers
};

// Takes the looks out of the source.
Model convert(GltfSource& source, const ReadLimits& limits);

}  // namespace hf_gltf

#endif

// Inner header of gltf_convert.cpp, gltf_meshes.cpp and gltf_animations.cpp: the state of one conversion.
#ifndef HF_GLTF_GLTF_CONVERT_PARTS_H
#define HF_GLTF_GLTF_CONVERT_PARTS_H

#include <string>

#include "gltf/gltf_accessor.h"
#include "gltf/gltf_convert.h"
#include "gltf/model.h"

namespace hf_gltf {

struct Conversion {
  Conversion(GltfSource& from, const ReadLimits& given)
      : source(from), limits(given), reader(from.gltf, from.name, given.decoded_limit(from.stored_bytes)) {}

  [[noreturn]] void fail(const std::string& where, const std::string& message) const;
  // At most a hundred: a hostile file must not fill the memory with complaints.
  void warn(const std::string& message) {
    if (model.warnings.size() < 100) model.warnings.push_back(message);
  }

  GltfSource& source;
  const ReadLimits& limits;
  AccessorReader reader;
  Model model;
};

size_t target_count(const MeshData& mesh);

// Nodes and skins are there already.
void convert_meshes(Conversion& in);
void convert_animations(Conversion& in);

}  // namespace hf_gltf

#endif

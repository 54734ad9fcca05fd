// Inner header of gltf_write.cpp: what tinygltf's structures become a file with.
//
// tinygltf writes the JSON of its structures without a buffer. The function pack_gltf() adds the parts that are carried
// past it, the list of extensions, and the bytes.
#ifndef HF_GLTF_GLTF_PACK_H
#define HF_GLTF_GLTF_PACK_H

#include <tiny_gltf.h>

#include <string>
#include <vector>

#include "gltf/model.h"

namespace hf_gltf {

// Numbers of the written elements, -1 where one is left out.
struct WrittenNumbers {
  std::vector<int> meshes, animations;
  std::vector<std::vector<int>> primitives;  // by mesh of the model
  struct CarriedKeys {
    int input, output;
    const char* interpolation;
  };
  std::vector<std::vector<CarriedKeys>> carried_keys;  // by animation of the model and carried channel
  // By node: accessors of its instances, -1 where there are none.
  struct InstanceAccessors {
    int translations = -1, rotations = -1, scales = -1;
  };
  std::vector<InstanceAccessors> instances;
};

std::string pack_gltf(const Model& model, tinygltf::Model& structures, const WrittenNumbers& numbers,
                      const std::vector<unsigned char>& bytes, bool binary);

}  // namespace hf_gltf

#endif

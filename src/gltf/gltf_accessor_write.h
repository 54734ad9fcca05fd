// The buffer of a glTF file while it is written: views and accessors, added one after the other.
#ifndef HF_GLTF_GLTF_ACCESSOR_WRITE_H
#define HF_GLTF_GLTF_ACCESSOR_WRITE_H

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "gltf/model.h"

namespace hf_gltf {

class AccessorWriter {
 protected:
  // name: of the model, for messages.
  explicit AccessorWriter(const std::string& name) : name_(name) {}

  // Each returns the number of the added item. Throws std::runtime_error if the buffer would pass 2 GB.
  int add_view(const void* data, size_t size, int target);
  int add_accessor(const void* data, size_t count, int type, int component, int target, bool bounds = false);
  // Keys of a clip: accessors that share a view, since a view for each takes more bytes than short keys do.
  // Nothing else may be added between them.
  void begin_keys() { keys_ = -1; }
  int add_keys(const float* values, size_t count, int type, bool bounds = false);
  int add_short_keys(const int16_t* values, size_t count, int type);  // normalized
  int add_carried(const CarriedNumbers& values, int target);
  int add_indices(const std::vector<uint32_t>& indices);
  // Displacements of a morph target: most move few vertices, so zeros are left out where that halves the bytes.
  int add_displacements(const std::vector<glm::vec3>& values, bool bounds = false);
  template <typename Vector>
  int add_vectors(const std::vector<Vector>& values, bool bounds = false) {
    constexpr int types[] = {0, 0, TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4};
    return add_accessor(values.data(), values.size(), types[Vector::length()], TINYGLTF_COMPONENT_TYPE_FLOAT,
                        TINYGLTF_TARGET_ARRAY_BUFFER, bounds);
  }

  tinygltf::Model out_;
  std::vector<unsigned char> bytes_;

 private:
  void append(const void* data, size_t size);
  tinygltf::Accessor keys(const void* data, size_t count, int type, int component);

  const std::string& name_;
  int keys_ = -1;  // the view of the clip, or -1 before its first keys
};

}  // namespace hf_gltf

#endif

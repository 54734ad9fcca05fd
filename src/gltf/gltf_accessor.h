// Inner header of gltf_read.cpp: accessors as plain arrays.
//
// Ranges are checked again on tinygltf's own structures, in 64 bits with every operand bounded first. Normalised
// integers become floats as glTF says (u8: c / 255, i8: max(c / 127, -1), 16 bits alike); sparse values are laid over;
// an accessor without a view is zeros. Every decoded array is charged against one budget before it is allocated.
#ifndef HF_GLTF_GLTF_ACCESSOR_H
#define HF_GLTF_GLTF_ACCESSOR_H

#include <tiny_gltf.h>

#include <cstdint>
#include <string>
#include <vector>

#include "gltf/model.h"

namespace hf_gltf {

// The types that a use allows besides 32-bit floats.
enum class Stored {
  floats,             // nothing
  normalized,         // u8, u16, normalised: weights, colours, texture coordinates
  signed_normalized,  // i8, i16, u8, u16, normalised: rotations, morph weights
  quantized           // any 8 or 16 bits where KHR_mesh_quantization is declared, else as `base`
};

class AccessorReader {
 public:
  AccessorReader(const tinygltf::Model& model, const std::string& name, uint64_t max_decoded_bytes);

  // count x components floats, all finite unless any_value. type: TINYGLTF_TYPE_...; 0 allows VEC3 and VEC4 (see
  // components_of).
  std::vector<float> floats(int accessor, int type, Stored stored, const std::string& where,
                            Stored base = Stored::floats, bool any_value = false);
  // Whole numbers. wide: 32 bits are allowed too (indices), otherwise 8 and 16 (joints).
  std::vector<uint32_t> integers(int accessor, int type, bool wide, const std::string& where);

  // The elements as they are stored. Matrices and numbers of more than 32 bits have no elements.
  CarriedNumbers stored(int accessor, const std::string& where);

  size_t count(int accessor, const std::string& where) const { return at(accessor, where).count; }
  int components_of(int accessor, const std::string& where) const;

  // Charges bytes that a caller is about to allocate.
  void charge(uint64_t bytes, const std::string& where);

 private:
  struct Range {
    const unsigned char* first;
    size_t stride;
  };

  const tinygltf::Accessor& at(int accessor, const std::string& where) const;
  Range range(int view, uint64_t offset, uint64_t count, uint64_t element_bytes, const std::string& where) const;
  // Calls copy(bytes, element) for each element that is stored; a sparse one comes after the one it replaces.
  template <typename Copy>
  void each(const tinygltf::Accessor& accessor, size_t components, const std::string& where, const Copy& copy) const;
  template <typename T>
  void decode(const tinygltf::Accessor& accessor, size_t components, const std::string& where,
              std::vector<T>& out) const;
  [[noreturn]] void fail(const std::string& where, const std::string& message) const;

  const tinygltf::Model& model_;
  const std::string& name_;
  const uint64_t limit_;
  uint64_t left_;
  bool quantization_ = false;
};

}  // namespace hf_gltf

#endif

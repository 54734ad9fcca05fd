// See gltf_accessor.h.
#include "gltf/gltf_accessor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace hf_gltf {
namespace {

// Component types are checked before these are reached.
template <typename Stored>
Stored load(const unsigned char* bytes) {
  Stored value;
  std::memcpy(&value, bytes, sizeof(value));
  return value;
}

template <typename T>
T component(const unsigned char* bytes, int type, bool normalized) {
  const auto scaled = [&](double value, double highest) {
    return normalized ? static_cast<T>(std::max(value / highest, -1.0)) : static_cast<T>(value);
  };
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return scaled(load<int8_t>(bytes), 127);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return scaled(load<uint8_t>(bytes), 255);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return scaled(load<int16_t>(bytes), 32767);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return scaled(load<uint16_t>(bytes), 65535);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return static_cast<T>(load<uint32_t>(bytes));
    default:
      return static_cast<T>(load<float>(bytes));
  }
}

const char* type_name(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR:
      return "SCALAR";
    case TINYGLTF_TYPE_VEC2:
      return "VEC2";
    case TINYGLTF_TYPE_VEC3:
      return "VEC3";
    case TINYGLTF_TYPE_VEC4:
      return "VEC4";
    case TINYGLTF_TYPE_MAT4:
      return "MAT4";
    default:
      return "another type";
  }
}

bool is_unsigned(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
}

bool is_small(int type) {
  return is_unsigned(type) || type == TINYGLTF_COMPONENT_TYPE_BYTE || type == TINYGLTF_COMPONENT_TYPE_SHORT;
}

bool allows(Stored stored, const tinygltf::Accessor& accessor, Stored base, bool quantization) {
  const int type = accessor.componentType;
  if (type == TINYGLTF_COMPONENT_TYPE_FLOAT) return true;
  switch (stored) {
    case Stored::floats:
      return false;
    case Stored::normalized:
      return accessor.normalized && is_unsigned(type);
    case Stored::signed_normalized:
      return accessor.normalized && is_small(type);
    case Stored::quantized:
      if (quantization && is_small(type)) return true;
      return base != Stored::quantized && allows(base, accessor, base, false);
  }
  return false;
}

}  // namespace

AccessorReader::AccessorReader(const tinygltf::Model& model, const std::string& name, uint64_t max_decoded_bytes)
    : model_(model), name_(name), limit_(max_decoded_bytes), left_(max_decoded_bytes) {
  const auto& used = model.extensionsUsed;
  const auto& required = model.extensionsRequired;
  const std::string extension = "KHR_mesh_quantization";
  quantization_ = std::find(used.begin(), used.end(), extension) != used.end() ||
                  std::find(required.begin(), required.end(), extension) != required.end();
}

void AccessorReader::fail(const std::string& where, const std::string& message) const {
  throw std::runtime_error(name_ + ": " + where + " " + message + ".");
}

void AccessorReader::charge(uint64_t bytes, const std::string& where) {
  if (bytes > left_) {
    fail(where, "takes the decoded data above the limit of " + std::to_string(limit_) +
                    " bytes; raise max_decoded_bytes or free_decoded_bytes if the file is to be trusted");
  }
  left_ -= bytes;
}

const tinygltf::Accessor& AccessorReader::at(int accessor, const std::string& where) const {
  if (accessor < 0 || static_cast<size_t>(accessor) >= model_.accessors.size()) {
    fail(where, "names accessor " + std::to_string(accessor) + " of " + std::to_string(model_.accessors.size()));
  }
  return model_.accessors[static_cast<size_t>(accessor)];
}

int AccessorReader::components_of(int accessor, const std::string& where) const {
  const int components = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(at(accessor, where).type));
  if (components <= 0) fail(where, "has an accessor of unknown type");
  return components;
}

AccessorReader::Range AccessorReader::range(int view, uint64_t offset, uint64_t count, uint64_t element_bytes,
                                            const std::string& where) const {
  constexpr uint64_t bound = 1ull << 40;
  if (view < 0 || static_cast<size_t>(view) >= model_.bufferViews.size()) fail(where, "names no buffer view");
  const tinygltf::BufferView& o = model_.bufferViews[static_cast<size_t>(view)];
  if (o.buffer < 0 || static_cast<size_t>(o.buffer) >= model_.buffers.size()) fail(where, "names no buffer");
  const std::vector<unsigned char>& data = model_.buffers[static_cast<size_t>(o.buffer)].data;
  const uint64_t stride = o.byteStride == 0 ? element_bytes : o.byteStride;
  if (count == 0 || count > bound || offset > bound || o.byteOffset > bound || o.byteLength > bound || stride > 65535) {
    fail(where, "has a count, offset or stride out of range");
  }
  if (stride < element_bytes) fail(where, "has a stride smaller than its elements");
  const uint64_t end = offset + stride * (count - 1) + element_bytes;
  if (end > o.byteLength || o.byteOffset + o.byteLength > data.size()) {
    fail(where, "reaches beyond its buffer view or buffer");
  }
  return {data.data() + o.byteOffset + offset, static_cast<size_t>(stride)};
}

template <typename Copy>
void AccessorReader::each(const tinygltf::Accessor& accessor, size_t components, const std::string& where,
                          const Copy& copy) const {
  const auto size =
      static_cast<size_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(accessor.componentType)));
  if (accessor.bufferView >= 0) {
    const Range from = range(accessor.bufferView, accessor.byteOffset, accessor.count, components * size, where);
    for (size_t i = 0; i < accessor.count; ++i) copy(from.first + i * from.stride, i);
  }
  if (!accessor.sparse.isSparse) return;

  const auto& sparse = accessor.sparse;
  const int index_type = sparse.indices.componentType;
  if (sparse.count < 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0 ||
      !(is_unsigned(index_type) || index_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)) {
    fail(where, "has broken sparse data");
  }
  const auto index_size = static_cast<size_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(index_type)));
  const auto count = static_cast<size_t>(sparse.count);
  const Range indices = range(sparse.indices.bufferView, static_cast<uint64_t>(sparse.indices.byteOffset), count,
                              index_size, where + " (sparse indices)");
  const Range values = range(sparse.values.bufferView, static_cast<uint64_t>(sparse.values.byteOffset), count,
                             components * size, where + " (sparse values)");
  uint64_t before = 0;
  for (size_t i = 0; i < count; ++i) {
    const auto element = component<uint32_t>(indices.first + i * indices.stride, index_type, false);
    if (element >= accessor.count) {
      fail(where, "has sparse index " + std::to_string(element) + " where it has " + std::to_string(accessor.count) +
                      " elements");
    }
    if (i > 0 && element <= before) fail(where, "has sparse indices that do not increase");
    before = element;
    copy(values.first + i * values.stride, element);
  }
}

template <typename T>
void AccessorReader::decode(const tinygltf::Accessor& accessor, size_t components, const std::string& where,
                            std::vector<T>& out) const {
  const int type = accessor.componentType;
  const auto size = static_cast<size_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(type)));
  each(accessor, components, where, [&](const unsigned char* bytes, size_t element) {
    for (size_t c = 0; c < components; ++c) {
      out[element * components + c] = component<T>(bytes + c * size, type, accessor.normalized);
    }
  });
}

CarriedNumbers AccessorReader::stored(int accessor, const std::string& where) {
  const tinygltf::Accessor& o = at(accessor, where);
  CarriedNumbers out;
  const bool known = is_small(o.componentType) || o.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT ||
                     o.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
  const auto components = static_cast<size_t>(components_of(accessor, where));
  if (!known || components > 4 || o.type == TINYGLTF_TYPE_MAT2) return out;
  const size_t row =
      components * static_cast<size_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(o.componentType)));
  charge(static_cast<uint64_t>(o.count) * row, where);
  out.component = o.componentType;
  out.type = static_cast<int>(components);
  out.normalized = o.normalized;
  out.count = o.count;
  out.bytes.resize(o.count * row);
  each(o, components, where,
       [&](const unsigned char* bytes, size_t element) { std::memcpy(out.bytes.data() + element * row, bytes, row); });
  for (size_t i = 0; o.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT && i < out.bytes.size(); i += sizeof(float)) {
    if (!std::isfinite(load<float>(out.bytes.data() + i))) {
      fail(where, "has a NaN or infinity in element " + std::to_string(i / row));
    }
  }
  return out;
}

std::vector<float> AccessorReader::floats(int accessor, int type, Stored stored, const std::string& where, Stored base,
                                          bool any_value) {
  const tinygltf::Accessor& o = at(accessor, where);
  if (o.type != type) {
    fail(where, std::string("is ") + type_name(o.type) + " where " + type_name(type) + " belongs");
  }
  if (!allows(stored, o, base, quantization_)) {
    const bool quantizable = stored == Stored::quantized && !quantization_ && is_small(o.componentType);
    fail(where, quantizable ? "is stored as integers, but the file does not declare KHR_mesh_quantization"
                            : "has component type " + std::to_string(o.componentType) +
                                  (o.normalized ? " (normalized)" : "") + ", which does not belong there");
  }
  const auto components = static_cast<size_t>(components_of(accessor, where));
  charge(static_cast<uint64_t>(o.count) * components * sizeof(float), where);
  std::vector<float> values(o.count * components, 0.0f);
  decode(o, components, where, values);
  for (size_t i = 0; !any_value && i < values.size(); ++i) {
    if (!std::isfinite(values[i])) fail(where, "has a NaN or infinity in element " + std::to_string(i / components));
  }
  return values;
}

std::vector<uint32_t> AccessorReader::integers(int accessor, int type, bool wide, const std::string& where) {
  const tinygltf::Accessor& o = at(accessor, where);
  if (o.type != type) {
    fail(where, std::string("is ") + type_name(o.type) + " where " + type_name(type) + " belongs");
  }
  const bool good = is_unsigned(o.componentType) || (wide && o.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
  if (!good || o.normalized) {
    fail(where, "has component type " + std::to_string(o.componentType) + (o.normalized ? " (normalized)" : "") +
                    ", which does not belong there");
  }
  const auto components = static_cast<size_t>(components_of(accessor, where));
  charge(static_cast<uint64_t>(o.count) * components * sizeof(uint32_t), where);
  std::vector<uint32_t> values(o.count * components, 0);
  decode(o, components, where, values);
  return values;
}

}  // namespace hf_gltf

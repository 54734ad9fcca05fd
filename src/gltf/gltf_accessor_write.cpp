// See gltf_accessor_write.h.
#include "gltf/gltf_accessor_write.h"

#include <algorithm>
#include <stdexcept>

namespace hf_gltf {
namespace {

constexpr size_t max_buffer_bytes = (1ull << 31) - 1;  // what tinygltf's own offsets hold

void add_bounds(const float* values, size_t count, size_t components, tinygltf::Accessor& accessor) {
  for (size_t c = 0; c < components; ++c) {
    float low = values[c], high = values[c];
    for (size_t i = 0; i < count; ++i) {
      low = std::min(low, values[i * components + c]);
      high = std::max(high, values[i * components + c]);
    }
    accessor.minValues.push_back(low);
    accessor.maxValues.push_back(high);
  }
}

}  // namespace

void AccessorWriter::append(const void* data, size_t size) {
  if (size > max_buffer_bytes - 4 || bytes_.size() > max_buffer_bytes - 4 - size) {
    throw std::runtime_error(name_ + ": the model takes more than 2 GB and cannot be written as one glTF.");
  }
  const auto* bytes = static_cast<const unsigned char*>(data);
  bytes_.insert(bytes_.end(), bytes, bytes + size);
}

int AccessorWriter::add_view(const void* data, size_t size, int target) {
  bytes_.resize((bytes_.size() + 3) / 4 * 4, 0);
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = bytes_.size();
  view.byteLength = size;
  view.target = target;
  append(data, size);
  out_.bufferViews.push_back(view);
  return static_cast<int>(out_.bufferViews.size()) - 1;
}

int AccessorWriter::add_accessor(const void* data, size_t count, int type, int component, int target, bool bounds) {
  const int components = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(type));
  const int bytes = tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(component));
  tinygltf::Accessor accessor;
  accessor.bufferView = add_view(data, count * static_cast<size_t>(components * bytes), target);
  accessor.count = count;
  accessor.type = type;
  accessor.componentType = component;
  if (bounds) add_bounds(static_cast<const float*>(data), count, static_cast<size_t>(components), accessor);
  out_.accessors.push_back(accessor);
  return static_cast<int>(out_.accessors.size()) - 1;
}

tinygltf::Accessor AccessorWriter::keys(const void* data, size_t count, int type, int component) {
  if (keys_ < 0) keys_ = add_view(nullptr, 0, 0);
  tinygltf::BufferView& view = out_.bufferViews[static_cast<size_t>(keys_)];
  tinygltf::Accessor out;
  out.bufferView = keys_;
  out.byteOffset = view.byteLength;
  out.count = count;
  out.type = type;
  out.componentType = component;
  const size_t size = count * static_cast<size_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(type)) *
                                                  tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(component)));
  append(data, size);
  view.byteLength += size;
  return out;
}

int AccessorWriter::add_keys(const float* values, size_t count, int type, bool bounds) {
  tinygltf::Accessor accessor = keys(values, count, type, TINYGLTF_COMPONENT_TYPE_FLOAT);
  const int components = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(type));
  if (bounds) add_bounds(values, count, static_cast<size_t>(components), accessor);
  out_.accessors.push_back(accessor);
  return static_cast<int>(out_.accessors.size()) - 1;
}

int AccessorWriter::add_short_keys(const int16_t* values, size_t count, int type) {
  out_.accessors.push_back(keys(values, count, type, TINYGLTF_COMPONENT_TYPE_SHORT));
  out_.accessors.back().normalized = true;
  return static_cast<int>(out_.accessors.size()) - 1;
}

int AccessorWriter::add_carried(const CarriedNumbers& values, int target) {
  constexpr int types[] = {0, TINYGLTF_TYPE_SCALAR, TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4};
  const size_t row = values.bytes.size() / values.count;
  // glTF wants the elements of vertices on four bytes
  const size_t stride = target == TINYGLTF_TARGET_ARRAY_BUFFER ? (row + 3) / 4 * 4 : row;
  std::vector<uint8_t> spaced(values.count * stride, 0);
  for (size_t i = 0; i < values.count; ++i) std::copy_n(values.bytes.data() + i * row, row, spaced.data() + i * stride);
  tinygltf::Accessor accessor;
  accessor.bufferView = add_view(spaced.data(), spaced.size(), target);
  if (stride != row) out_.bufferViews.back().byteStride = stride;
  accessor.count = values.count;
  accessor.type = types[values.type];
  accessor.componentType = values.component;
  accessor.normalized = values.normalized;
  out_.accessors.push_back(accessor);
  return static_cast<int>(out_.accessors.size()) - 1;
}

int AccessorWriter::add_indices(const std::vector<uint32_t>& indices) {
  const uint32_t highest = *std::max_element(indices.begin(), indices.end());
  if (highest < 65535) {
    const std::vector<uint16_t> shorts(indices.begin(), indices.end());
    return add_accessor(shorts.data(), shorts.size(), TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                        TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  }
  return add_accessor(indices.data(), indices.size(), TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                      TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
}

int AccessorWriter::add_displacements(const std::vector<glm::vec3>& values, bool bounds) {
  std::vector<uint32_t> indices;
  std::vector<glm::vec3> moved;
  for (size_t v = 0; v < values.size(); ++v)
    if (values[v] != glm::vec3(0)) {
      indices.push_back(static_cast<uint32_t>(v));
      moved.push_back(values[v]);
    }
  constexpr size_t row = sizeof(uint32_t) + sizeof(glm::vec3);
  if (2 * row * indices.size() > sizeof(glm::vec3) * values.size() || values.empty())
    return add_vectors(values, bounds);
  if (indices.empty()) {
    indices.push_back(0);
    moved.emplace_back(0.0f);
  }
  tinygltf::Accessor accessor;
  accessor.count = values.size();
  accessor.type = TINYGLTF_TYPE_VEC3;
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
  if (bounds) add_bounds(&values[0].x, values.size(), 3, accessor);
  accessor.sparse.isSparse = true;
  accessor.sparse.count = static_cast<int>(indices.size());
  accessor.sparse.indices.byteOffset = accessor.sparse.values.byteOffset = 0;
  accessor.sparse.indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  accessor.sparse.indices.bufferView = add_view(indices.data(), indices.size() * sizeof(uint32_t), 0);
  accessor.sparse.values.bufferView = add_view(moved.data(), moved.size() * sizeof(glm::vec3), 0);
  out_.accessors.push_back(accessor);
  return static_cast<int>(out_.accessors.size()) - 1;
}

}  // namespace hf_gltf

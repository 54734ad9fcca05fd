// decode_meshopt() of gltf_decompress.h, by meshoptimizer (MIT) where the build has it.
#include <stdexcept>

#include "gltf/gltf_decompress.h"
#ifdef HF_GLTF_MESHOPT
#include <meshoptimizer.h>
#endif

namespace hf_gltf {

#ifdef HF_GLTF_MESHOPT
bool has_meshopt() { return true; }

void decode_meshopt(const MeshoptView& view, const uint8_t* data, size_t size, std::vector<uint8_t>& out) {
  out.resize(view.count * view.stride);
  int failed = 0;
  if (view.mode == "ATTRIBUTES") {
    failed = meshopt_decodeVertexBuffer(out.data(), view.count, view.stride, data, size);
  } else if (view.mode == "TRIANGLES") {
    failed = meshopt_decodeIndexBuffer(out.data(), view.count, view.stride, data, size);
  } else {
    failed = meshopt_decodeIndexSequence(out.data(), view.count, view.stride, data, size);
  }
  if (failed) {
    throw std::runtime_error("is not a stream of " + std::to_string(view.count) + " elements that meshoptimizer " +
                             "decodes (error " + std::to_string(failed) + "): it is damaged or of a newer version");
  }
  if (view.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out.data(), view.count, view.stride);
  if (view.filter == "QUATERNION") meshopt_decodeFilterQuat(out.data(), view.count, view.stride);
  if (view.filter == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), view.count, view.stride);
}
#else
bool has_meshopt() { return false; }

void decode_meshopt(const MeshoptView&, const uint8_t*, size_t, std::vector<uint8_t>&) {
  throw std::runtime_error("needs meshoptimizer");
}
#endif

}  // namespace hf_gltf

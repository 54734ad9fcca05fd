// The surface of a flat mesh, as all programs make it. Vertices are welded within 1e-5 of the largest extent, because
// some exporters round copies of a vertex differently.
#ifndef HF_SAMPLES_TRANSFER_FLAT_SURFACE_H
#define HF_SAMPLES_TRANSFER_FLAT_SURFACE_H

#include <string>
#include <vector>

#include "gltf/flat_mesh.h"
#include "hf/hf.h"

namespace samples {

using namespace hf_gltf;

// Throws std::runtime_error with "what: the library's message" unless the result is HF_OK.
void check(hf_result result, const std::string& what);

// The extremities of a mesh, largest first (hf_surface_find_extremities); none where the library finds none.
std::vector<uint32_t> tips_of(const FlatMesh& mesh, const std::string& name);

class FlatSurface {
 public:
  // paper: use plain cotangent weights, as in the paper, instead of the library's default operator. links: NULL, or
  // how pieces are linked.
  FlatSurface(const FlatMesh& mesh, const std::string& name, uint32_t threads, bool paper = false,
              const hf_links_desc* links = nullptr);
  ~FlatSurface() { hf_surface_destroy(surface_); }
  FlatSurface(const FlatSurface&) = delete;
  FlatSurface& operator=(const FlatSurface&) = delete;
  hf_surface get() const { return surface_; }

 private:
  hf_surface surface_ = nullptr;
};

}  // namespace samples

#endif

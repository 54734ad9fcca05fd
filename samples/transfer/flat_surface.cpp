// See flat_surface.h.
#include "transfer/flat_surface.h"

#include <algorithm>
#include <stdexcept>

#include "common/limits.h"

namespace samples {

void check(hf_result result, const std::string& what) {
  if (result == HF_OK) return;
  hf_error_detail detail;
  hf_error_get_detail(&detail);
  throw std::runtime_error(what + ": " + (detail.code == result ? detail.message : hf_result_get_name(result)) + " (" +
                           hf_result_get_name(result) + ")");
}

std::vector<uint32_t> tips_of(const FlatMesh& mesh, const std::string& name) {
  const FlatSurface surface(mesh, name, 1);
  hf_extremities_desc desc = HF_INIT(hf_extremities_desc);
  desc.kind = HF_EXTREMITIES_GEODESIC;
  std::vector<hf_extremity> found(256);
  uint32_t count = 0;
  const hf_result result =
      hf_surface_find_extremities(surface.get(), &desc, static_cast<uint32_t>(found.size()), found.data(), &count);
  std::vector<uint32_t> out;
  for (uint32_t i = 0; result == HF_OK && i < count; ++i) out.push_back(found[i].vertex);
  return out;
}

FlatSurface::FlatSurface(const FlatMesh& mesh, const std::string& name, uint32_t threads, bool paper,
                         const hf_links_desc* links) {
  const std::vector<double> positions = double_positions(mesh.positions);
  const SurfaceBox box(mesh);
  const glm::dvec3 extent = box.high - box.low;
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.positions = HF_ARRAY(positions.data(), mesh.vertex_count());
  desc.triangles = HF_ARRAY(mesh.triangles.data(), mesh.triangle_count());
  desc.weld = HF_WELD_TOLERANCE;
  desc.weld_tolerance = 1e-5 * std::max({extent.x, extent.y, extent.z, 1e-20});
  desc.thread_count = threads;
  desc.links = links;
  if (paper) desc.operator_kind = HF_OPERATOR_COTANGENT;
  limit_surface(desc);
  check(hf_surface_create(&desc, &surface_), name);
}

}  // namespace samples

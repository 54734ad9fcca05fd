#include "quads/apart.h"

#include <algorithm>
#include <cmath>

#include "base/index.h"

namespace hf_inner::quads {

Apart::Apart(remesh::FluxSurface& surface, Memory& memory) : offset_(surface.component_count, Vec3(), memory) {
  if (surface.component_count < 2) return;
  remesh::Table<Vec3> low(surface.component_count, {HUGE_VAL, HUGE_VAL, HUGE_VAL}, memory),
      high(surface.component_count, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, memory);
  for (std::int32_t v = 0; v < surface.vertex_count(); ++v) {
    const Vec3 p = surface.position[v];
    Vec3 &l = low[surface.component[v]], &h = high[surface.component[v]];
    l = {std::min(l.x, p.x), std::min(l.y, p.y), std::min(l.z, p.z)};
    h = {std::max(h.x, p.x), std::max(h.y, p.y), std::max(h.z, p.z)};
  }
  double end = high[0].x, before = norm(high[0] - low[0]);
  for (std::int32_t c = 1; c < surface.component_count; ++c) {
    const double length = norm(high[c] - low[c]);
    offset_[c].x = end + before + length - low[c].x;
    end = high[c].x + offset_[c].x;
    before = length;
  }
  for (std::int32_t v = 0; v < surface.vertex_count(); ++v)
    surface.position[v] = surface.position[v] + offset_[surface.component[v]];
}

Vec3 Apart::moved(const remesh::FluxSurface& surface, Vec3 place) const noexcept {
  if (offset_.size() < 2) return place;
  double least = HUGE_VAL;
  Vec3 offset;
  for (std::int32_t v = 0; v < surface.first_apex; ++v) {
    const Vec3 own = offset_[surface.component[v]];
    if (const double d = norm(surface.position[v] - own - place); d < least) {
      least = d;
      offset = own;
    }
  }
  return place + offset;
}

void Apart::bring_home(const remesh::FluxSurface& surface, const mesh::Mesh& mesh,
                       remesh::QuadMesh& quads) const noexcept {
  if (offset_.size() < 2) return;
  for (std::int32_t v = 0; v < quads.position.size(); ++v) {
    const remesh::SurfacePoint& at_point = quads.location[v];
    Vec3 place;
    for (int k = 0; k < 3; ++k) {
      const std::int32_t corner = surface.tail[3 * at_point.triangle + k];
      place = place + at_point.weight[k] * mesh.positions[at(surface.mesh_vertex[corner])];
    }
    quads.position[v] = place;
  }
}

}  // namespace hf_inner::quads

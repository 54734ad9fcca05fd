// Writes positions and normals of a morphed region to the arrays of hf_morph_desc.
#pragma once
#include "capi/boundary.h"
#include "capi/vertex_writer.h"
#include "detail/intake.h"
#include "detail/morph.h"
#include "hf/region.h"

namespace hf_inner::capi {

struct MorphOut : PointsOut {
  double weight;
};

inline MorphOut read_morph(const hf_morph_desc* given, std::size_t vertex_count) {
  const hf_morph_desc desc = read_struct(given, "desc");
  const double weight = detail::read_morph_weight(desc);
  return {read_points_out(desc, vertex_count), weight};
}

// moved(given, i) returns the morphed position of the i-th vertex inside the region; `given` is its number in the mesh
// as the caller passed it. Throws as Overflow.
template <class Moved>
void write_morph(const detail::RegionSurface& surface, const detail::RegionState& state, const MorphOut& out,
                 Moved&& moved) {
  const surface::Core& core = *surface.core;
  const detail::RegionShape& shape = *state.shape;
  Vector<Vec3> normal_sums(core.memory.get());
  if (out.normals) {
    Vector<Vec3> local(core.memory.get());
    local.reserve(static_cast<std::size_t>(shape.local_count()));
    for (std::size_t i = 0; i < shape.inside.size(); ++i)
      local.push_back(
          moved(static_cast<std::size_t>(core.mesh.given_of_inner[static_cast<std::size_t>(shape.inside[i])]), i));
    for (Vec3& p : local) p = core.mesh.to_inner(p);
    for (const std::int32_t v : shape.rim) local.push_back(surface.scaled_position(v));
    normal_sums = detail::local_normal_sums(state, local, *core.memory);
  }
  Overflow overflow(out.positions.is_double());
  for_each_given(core, 0, surface.positions.size(), [&](std::size_t v, std::int32_t inner) {
    double row[3];
    const std::int32_t local = inner == mesh::Mesh::none ? -1 : shape.local[static_cast<std::size_t>(inner)];
    const std::size_t i = static_cast<std::size_t>(local);
    if (out.positions) {
      put(local >= 0 && i < shape.inside.size() ? moved(v, i) : surface.positions[v], row);
      for (std::size_t c = 0; c < 3; ++c) {
        overflow.look(v, row[c]);
        out.positions.set(v, c, row[c]);
      }
    }
    if (out.normals) {
      put(inner == mesh::Mesh::none
              ? Vec3{0, 0, 1}
              : detail::unit_normal(local >= 0 ? normal_sums[i] : surface.normal_sum[static_cast<std::size_t>(inner)]),
          row);
      for (std::size_t c = 0; c < 3; ++c) out.normals.set(v, c, row[c]);
    }
  });
  overflow.check();
}

}  // namespace hf_inner::capi

// Counts the vertices and components that no site of a field reaches.
#pragma once
#include "hf/solver.h"
#include "surface/geometry.h"

namespace hf_inner::field {

// site_count(component) returns the number of sites on a component.
template <class Count>
hf_solve_info unreached_by(const surface::Geometry& shape, Count&& site_count) {
  hf_solve_info info{};
  info.first_unreached_component = HF_NO_INDEX;
  info.unreached_vertex_count = shape.mesh.report.isolated_vertex_count;
  for (std::uint32_t c = 0; c < shape.mesh.report.component_count; ++c) {
    if (site_count(static_cast<std::int32_t>(c)) > 0) continue;
    if (info.unreached_component_count++ == 0) info.first_unreached_component = c;
    info.unreached_vertex_count += shape.given_count[c];
  }
  return info;
}

}  // namespace hf_inner::field

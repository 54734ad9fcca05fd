// Regions on small surfaces, and oracles that share no code with them.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Core>
#include <functional>
#include <memory>
#include <set>
#include <vector>

#include "assets/shapes.h"
#include "base/error.h"
#include "detail/morph.h"
#include "detail/region.h"
#include "support/meshes.h"
#include "support/oracle.h"

namespace hf_test {

using Numbers = std::vector<std::int32_t>;

inline PlainMesh plain(const samples::ShapeMesh& shape) { return {shape.positions, shape.triangles}; }

inline hf_inner::surface::CoreOptions thin_plate() {
  hf_inner::surface::CoreOptions options;
  options.field_kind = hf_inner::mesh::FieldKind::biharmonic;
  return options;
}

// The surface of a mesh as given.
inline std::shared_ptr<const hf_inner::detail::RegionSurface> surface_of(
    const std::shared_ptr<const hf_inner::surface::Core>& core) {
  hf_inner::Vector<hf_inner::Vec3> positions(core->mesh.report.vertex_count, core->memory.get());
  for (std::size_t v = 0; v < positions.size(); ++v)
    positions[v] = core->mesh.to_given(core->mesh.positions[static_cast<std::size_t>(core->mesh.inner_of_given[v])]);
  return hf_inner::make_owner_in<hf_inner::detail::RegionSurface>(core->memory, core, std::move(positions));
}

inline Numbers numbers(const hf_inner::Vector<std::int32_t>& list) { return {list.begin(), list.end()}; }

// The vertices that a test on their place picks.
inline Numbers vertices_where(const hf_inner::detail::RegionSurface& surface,
                              const std::function<bool(hf_inner::Vec3)>& inside) {
  Numbers list;
  for (std::int32_t v = 0; v < surface.core->size(); ++v)
    if (inside(surface.position(v))) list.push_back(v);
  return list;
}

inline void add(hf_inner::detail::Region& region, const Numbers& vertices) {
  hf_inner::detail::RegionEdit edit;
  edit.add = {vertices.data(), vertices.size()};
  region.edit(edit);
}

inline hf_inner::detail::Region region_where(const std::shared_ptr<const hf_inner::detail::RegionSurface>& surface,
                                             const std::function<bool(hf_inner::Vec3)>& inside) {
  hf_inner::detail::Region region(surface);
  add(region, vertices_where(*surface, inside));
  return region;
}

// The base by a dense solve of the whole saddle-point system, in units of the box.
inline double distance_from_dense_base(const hf_inner::detail::Region& region) {
  const hf_inner::surface::Core& core = region.core();
  const hf_inner::detail::RegionState& state = *region.state();
  std::vector<hf_inner::solve::Site> sites;
  Eigen::MatrixXd values(state.shape->sites.size(), 3);
  for (std::size_t i = 0; i < state.shape->sites.size(); ++i) {
    sites.push_back(hf_inner::solve::Site::at_vertex(core.mesh, state.shape->sites[i]));
    const hf_inner::Vec3 p = core.mesh.to_inner(region.surface()->position(state.shape->sites[i]));
    values.row(static_cast<Eigen::Index>(i)) << p.x, p.y, p.z;
  }
  const Eigen::MatrixXd field = dense_field(core, sites, values);
  double worst = 0;
  for (std::size_t i = 0; i < state.shape->inside.size(); ++i) {
    const hf_inner::Vec3 u = core.mesh.to_inner(state.base[i]);
    worst = std::max(worst, (field.row(state.shape->inside[i]).transpose() - Eigen::Vector3d(u.x, u.y, u.z)).norm());
  }
  return worst;
}

// Expects work() to throw this code, and returns the index it names.
inline std::uint32_t index_of_failure(hf_result code, const std::function<void()>& work) {
  try {
    work();
  } catch (const hf_inner::Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.index();
  }
  ADD_FAILURE() << "nothing failed";
  return 0;
}

inline bool same(const hf_inner::Vector<hf_inner::Vec3>& a, const hf_inner::Vector<hf_inner::Vec3>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](hf_inner::Vec3 p, hf_inner::Vec3 q) { return p.x == q.x && p.y == q.y && p.z == q.z; });
}

inline double largest_difference(const hf_inner::Vector<hf_inner::Vec3>& a, const hf_inner::Vector<hf_inner::Vec3>& b) {
  EXPECT_EQ(a.size(), b.size());
  double worst = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) worst = std::max(worst, hf_inner::norm(a[i] - b[i]));
  return worst;
}

}  // namespace hf_test

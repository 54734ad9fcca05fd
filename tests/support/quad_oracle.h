// The oracle of quad meshes, apart from the library's own check: counted from the faces alone.
#pragma once
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>

#include "remesh/quad_mesh.h"
#include "surface/core.h"

namespace hf_test {

// Each directed edge occurs once, no face repeats a corner, every vertex is used, the Euler characteristic is that of
// the surface, and there are borders where the surface has some.
inline void expect_manifold(const hf_inner::surface::Core& core, const hf_inner::remesh::QuadMesh& mesh,
                            const std::string& what) {
  std::set<std::pair<std::int32_t, std::int32_t>> directed;
  std::set<std::int32_t> used;
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    std::set<std::int32_t> corners;
    for (std::int32_t k = 0; k < 4; ++k) {
      const std::int32_t a = mesh.quad(f)[k], b = mesh.quad(f)[(k + 1) % 4];
      ASSERT_TRUE(corners.insert(a).second) << what << ": face " << f << " repeats corner " << a;
      ASSERT_TRUE(directed.insert({a, b}).second) << what << ": edge " << a << " -> " << b << " twice";
      used.insert(a);
    }
  }
  ASSERT_EQ(mesh.corner.size() % 4, 0) << what;
  std::int64_t edges = 0, borders = 0;
  for (const auto& [a, b] : directed) {
    const bool inner = directed.count({b, a}) > 0;
    edges += inner ? 1 : 2;
    borders += inner ? 0 : 1;
  }
  ASSERT_EQ(static_cast<std::int32_t>(used.size()), mesh.position.size()) << what;
  const std::int64_t surface =
      std::int64_t{core.mesh.vertex_count()} - core.topology().edge_count() + core.mesh.triangle_count();
  EXPECT_EQ(mesh.position.size() - edges / 2 + mesh.face_count(), surface) << what;
  EXPECT_EQ(borders > 0, core.mesh.report.boundary_edge_count > 0) << what;
}

}  // namespace hf_test

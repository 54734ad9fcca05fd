// Thin plates: the clamped bi-harmonic problem, and a rim without a crease.
#include "detail_support.h"
#include "support/dense.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::detail;
using namespace hf_test;

// The clamped plate by itself: K_II u = -K_IS p, dense, with K from the core and everything off I held.
TEST(ThinPlate, IsTheClampedProblemOfItsSurroundings) {
  struct Case {
    mesh::OperatorKind kind;
    std::int32_t formed_valence;  // 3: the core does not form K
  };
  for (const Case given : {Case{mesh::OperatorKind::intrinsic_delaunay, surface::most_formed_valence},
                           {mesh::OperatorKind::cotangent, 1000},
                           {mesh::OperatorKind::intrinsic_delaunay, 3},
                           {mesh::OperatorKind::cotangent, 3}}) {
    surface::CoreOptions options = thin_plate();
    options.operator_kind = given.kind;
    options.formed_valence = given.formed_valence;
    const auto surface = surface_of(make_core(torus(28, 18), 1, options));
    EXPECT_EQ(surface->core->root != nullptr, given.formed_valence == 3);
    const Eigen::MatrixXd k = dense_operator(*surface->core);
    Region region = region_where(surface, [](Vec3 p) { return p.x > 1.9; });
    for (const std::int32_t rings : {0, 1, -2}) {
      if (rings != 0) {
        RegionEdit edit;
        edit.rings = rings;
        region.edit(edit);
        if (given.formed_valence > 3) {
          EXPECT_EQ(region.state()->engine->counters().factorisations, 1u);
        }
      }
      const RegionShape& shape = *region.state()->shape;
      EXPECT_GT(shape.sites.size(), shape.rim.size());
      const Eigen::Index n = static_cast<Eigen::Index>(shape.inside.size());
      Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n), b = Eigen::MatrixXd::Zero(n, 3);
      for (Eigen::Index i = 0; i < n; ++i) {
        const std::int32_t v = shape.inside[static_cast<std::size_t>(i)];
        for (std::int32_t w = 0; w < surface->core->size(); ++w) {
          const auto found = std::lower_bound(shape.inside.begin(), shape.inside.end(), w);
          const double value = k(v, w);
          if (found != shape.inside.end() && *found == w) {
            a(i, found - shape.inside.begin()) += value;
          } else if (value != 0) {
            EXPECT_TRUE(std::binary_search(shape.sites.begin(), shape.sites.end(), w));
            const Vec3 p = surface->core->mesh.to_inner(surface->position(w));
            b.row(i) -= value * Eigen::RowVector3d(p.x, p.y, p.z);
          }
        }
      }
      const Eigen::MatrixXd u = hf_test::DenseSolver(a).solve(b);
      for (Eigen::Index i = 0; i < n; ++i) {
        const Vec3 p = surface->core->mesh.to_inner(region.state()->base[static_cast<std::size_t>(i)]);
        EXPECT_LT((u.row(i) - Eigen::RowVector3d(p.x, p.y, p.z)).norm(), 1e-9);
      }
    }
  }
}

// Mean angle between the normals on both sides of the edges where the region meets the surface, in degrees.
double crease(const RegionSurface& surface, const RegionState& state) {
  const mesh::Mesh& mesh = surface.core->mesh;
  const Vector<Vec3> local = morphed_positions(surface, state, 1.0, *surface.core->memory);
  const auto place = [&](std::int32_t v) {
    const std::int32_t l = state.shape->local[static_cast<std::size_t>(v)];
    return l >= 0 ? local[static_cast<std::size_t>(l)] : surface.scaled_position(v);
  };
  const auto moves = [&](std::int32_t t) {
    return std::binary_search(state.shape->triangles.begin(), state.shape->triangles.end(), t);
  };
  const auto normal = [&](std::int32_t t) {
    const std::int32_t* v = mesh.triangle(t);
    return unit_normal(cross(place(v[1]) - place(v[0]), place(v[2]) - place(v[0])));
  };
  const mesh::Topology& topology = surface.core->topology();
  double sum = 0, count = 0;
  for (std::size_t e = 0; e < static_cast<std::size_t>(topology.edge_count()); ++e) {
    const std::size_t first = static_cast<std::size_t>(topology.edge_triangle_start[e]);
    if (topology.edge_triangle_start[e + 1] - topology.edge_triangle_start[e] != 2) continue;
    const std::int32_t a = topology.triangle(first), b = topology.triangle(first + 1);
    if (moves(a) == moves(b)) continue;
    sum += std::acos(std::min(1.0, std::max(-1.0, dot(normal(a), normal(b))))) * 180 / 3.14159265358979;
    count += 1;
  }
  EXPECT_GT(count, 20);
  return sum / count;
}

// A cap of the sphere with a dent, at edges of about h = 1/8 to 1/64.
TEST(ThinPlate, CreaseAtTheRimFallsWithTheEdgeLengthAMembranesStays) {
  double plate[4], membrane[4];
  int level = 0;
  for (const std::uint32_t frequency : {8u, 16u, 32u, 64u}) {
    const PlainMesh mesh = plain(samples::sphere(frequency));
    const auto cap = [](Vec3 p) { return p.y > 0.6; };
    const Region bent = region_where(surface_of(make_core(mesh, 1, thin_plate())), cap);
    const Region flat = region_where(surface_of(make_core(mesh)), cap);
    plate[level] = crease(*bent.surface(), *bent.state());
    membrane[level] = crease(*flat.surface(), *flat.state());
    std::printf("frequency %2u: crease of the thin plate %6.3f, of the membrane %6.3f degrees\n", frequency,
                plate[level], membrane[level]);
    ++level;
  }
  for (int i = 1; i < 4; ++i) {
    EXPECT_LT(plate[i], 0.65 * plate[i - 1]) << i;
    EXPECT_GT(membrane[i], 0.85 * membrane[i - 1]) << i;
  }
  EXPECT_LT(plate[3], 3);
  EXPECT_GT(membrane[3], 25);
}

// A plate bends as little as its surroundings allow: a plane stays a plane, bumps go.
TEST(ThinPlate, ContinuesAPlane) {
  PlainMesh mesh = grid(24, 24, 1, 0.2);
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const double x = mesh.positions[3 * v] - 12, y = mesh.positions[3 * v + 1] - 12, r = x * x + y * y;
    mesh.positions[3 * v + 2] = 0.3 * x + (r < 25 ? 2 * std::pow(1 - r / 25, 3) : 0);
  }
  const auto surface = surface_of(make_core(mesh, 1, thin_plate()));
  const Region region = region_where(surface, [](Vec3 p) { return std::hypot(p.x - 12, p.y - 12) < 6; });
  double highest = 0;
  for (const Vec3 p : region.state()->base) highest = std::max(highest, std::fabs(p.z - 0.3 * (p.x - 12)));
  EXPECT_LT(highest, 1e-8);
}

}  // namespace

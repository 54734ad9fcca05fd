// Quad meshes: valid on every surface, few irregular places, even, and near to what they were made from.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>

#include "assets/creature.h"
#include "assets/shapes.h"
#include "common/mesh_file.h"
#include "quads/field_quads.h"
#include "quads/surface_distance.h"
#include "remesh/relax.h"
#include "support/creature.h"
#include "support/full.h"
#include "support/meshes.h"
#include "support/quad_oracle.h"

namespace {

namespace fs = std::filesystem;
using namespace hf_inner;
using namespace hf_inner::quads;

hf_test::PlainMesh plain(const samples::ShapeMesh& shape) { return {shape.positions, shape.triangles}; }

QuadResult make(const std::shared_ptr<const surface::Core>& core, double edge_length = 0.022) {
  FieldQuadOptions options;
  options.core = core;
  options.edge_length = edge_length;
  return make_field_quads(options);
}

// The oracle, apart from the library's own check: counted from the faces alone.
void expect_valid(const surface::Core& core, const QuadResult& result, const std::string& what) {
  const remesh::QuadMesh& mesh = result.mesh;
  hf_test::expect_manifold(core, mesh, what);
  // every vertex is in its triangle, and where its weights say
  for (std::int32_t v = 0; v < mesh.position.size(); ++v) {
    const remesh::SurfacePoint& point = mesh.location[v];
    Vec3 p;
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      ASSERT_GE(point.weight[k], -1e-12) << what;
      sum += point.weight[k];
      p = p + point.weight[k] * core.mesh.positions[static_cast<std::size_t>(core.mesh.triangle(point.triangle)[k])];
    }
    ASSERT_NEAR(sum, 1, 1e-9) << what;
    ASSERT_LT(norm(p - mesh.position[v]), 1e-6) << what;
  }
}

// Distance of the mesh and its surface, as hf_quads prints it: by code of the sample's own, over the box diagonal.
double distance_of(const hf_test::PlainMesh& plain_mesh, const surface::Core& core, const remesh::QuadMesh& mesh) {
  samples::TriangleSoup surface, quads;
  for (std::size_t v = 0; v < plain_mesh.positions.size(); v += 3)
    surface.positions.push_back({plain_mesh.positions[v], plain_mesh.positions[v + 1], plain_mesh.positions[v + 2]});
  surface.triangles = plain_mesh.triangles;
  for (std::int32_t v = 0; v < mesh.position.size(); ++v) {
    const Vec3 p = core.mesh.to_given(mesh.position[v]);
    quads.positions.push_back({p.x, p.y, p.z});
  }
  const std::vector<std::uint32_t> corners(mesh.corner.begin(), mesh.corner.end());
  samples::FaceTriangles cut;
  for (std::int32_t f = 0; f < mesh.face_count(); ++f)
    samples::append_measured(cut, quads.positions, &corners[4 * static_cast<std::size_t>(f)], 4, quads.triangles);
  return samples::surface_distance(surface, quads).largest() / core.mesh.scale;
}

struct Edges {
  double low, high;  // 5th and 95th percentile over the edge length
};
Edges edges_of(const remesh::QuadMesh& mesh, double edge_length) {
  std::vector<double> lengths;
  for (std::int32_t f = 0; f < mesh.face_count(); ++f)
    for (std::int32_t k = 0; k < 4; ++k)
      lengths.push_back(norm(mesh.position[mesh.quad(f)[(k + 1) % 4]] - mesh.position[mesh.quad(f)[k]]) / edge_length);
  std::sort(lengths.begin(), lengths.end());
  return {lengths[lengths.size() / 20], lengths[lengths.size() - lengths.size() / 20 - 1]};
}

TEST(Quads, OpenBordersAreFollowedAndComponentsStayApart) {
  hf_test::PlainMesh mesh = plain(samples::bumpy_plane(40, 40));
  const hf_test::PlainMesh other = plain(samples::sphere(12));
  const std::uint32_t base = mesh.vertex_count();
  for (std::size_t i = 0; i < other.positions.size(); ++i)
    mesh.positions.push_back(other.positions[i] + (i % 3 == 1 ? 3.0 : 0.0));
  for (const std::uint32_t v : other.triangles) mesh.triangles.push_back(base + v);
  const auto core = hf_test::make_core(mesh);
  const QuadResult result = make(core, 0.03);
  expect_valid(*core, result, "plane and sphere");
  // border vertices lie on the border
  std::map<std::int32_t, bool> rim;
  for (std::int32_t e = 0; e < core->topology().edge_count(); ++e) {
    const std::size_t i = static_cast<std::size_t>(e);
    if (core->topology().edge_triangle_start[i + 1] - core->topology().edge_triangle_start[i] == 1)
      rim[core->topology().first(e)] = rim[core->topology().second(e)] = true;
  }
  std::int32_t on_border = 0;
  for (std::int32_t v = 0; v < result.mesh.position.size(); ++v) {
    if (!result.mesh.border[v]) continue;
    ++on_border;
    for (int k = 0; k < 3; ++k) {
      const std::int32_t corner = core->mesh.triangle(result.mesh.location[v].triangle)[k];
      EXPECT_TRUE(result.mesh.location[v].weight[k] <= 1e-9 || rim.count(corner)) << corner;
    }
  }
  EXPECT_GT(on_border, 20);
}

TEST(Quads, OfASheetWithManyHolesHaveAllOfThem) {
  hf_test::PlainMesh mesh = hf_test::grid(40, 40);
  std::vector<std::uint32_t> kept;
  int holes = 0;
  const double cell = 8;  // a hole of 4 x 4 in every 8 x 8
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    double x = 0, y = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      x += mesh.positions[3 * mesh.triangles[t + k]] / 3;
      y += mesh.positions[3 * mesh.triangles[t + k] + 1] / 3;
    }
    x -= cell * std::floor(x / cell);
    y -= cell * std::floor(y / cell);
    const bool hole = std::fabs(x - cell / 2) < cell / 4 && std::fabs(y - cell / 2) < cell / 4;
    holes += hole;
    if (!hole) kept.insert(kept.end(), &mesh.triangles[t], &mesh.triangles[t] + 3);
  }
  ASSERT_GT(holes, 64);
  mesh.triangles = kept;
  const auto core = hf_test::make_core(mesh);
  ASSERT_GT(core->mesh.report.boundary_edge_count, 300u);
  const QuadResult result = make(core, 0.04);
  expect_valid(*core, result, "sheet with holes");
  EXPECT_EQ(result.euler_characteristic, 1 - 25);
}

TEST(Quads, OfTheCreaturesAreValidEvenAndNear) {
  // Distances over the box diagonal; an edge length is 0.022. The horse was 0.019 away while steps of fitting were
  // undone for corners that unfolding mends.
  for (const auto& [name, most] :
       hf_test::quick_and_full<std::pair<const char*, double>>({{"biped", 0.01}, {"horse", 0.014}}, {{"bull", 0.01}})) {
    const hf_test::PlainMesh mesh = plain(samples::welded_surface(hf_test::creature(name, 6000)));
    const auto core = hf_test::make_core(mesh);
    const QuadResult result = make(core);
    expect_valid(*core, result, name);
    const Edges edges = edges_of(result.mesh, 0.022);
    EXPECT_GE(edges.low, 0.5) << name;
    EXPECT_LE(edges.high, 1.6) << name;
    EXPECT_LE(distance_of(mesh, *core, result.mesh), most) << name;
  }
}

// At the default edge length. Distances over the box diagonal, edges over the edge length: 5th and 95th percentile.
// The quick form takes the meshes that take seconds, HF_FULL_TESTS all of them.
TEST(Quads, OfTheSharedMeshesAreValidAndNear) {
  const char* data = std::getenv("HF_SHARED_DATA");
  const fs::path folder = (data ? fs::path(data) : fs::path(HF_SOURCE_DIR) / ".." / "shared" / "data") / "meshes";
  if (!fs::exists(folder)) GTEST_SKIP() << "the shared data is not there";
  struct Row {
    const char* name;
    double distance, shortest, longest;
    bool quick;
  };
  // An edge length is 0.022. The boot has features that are thinner (docs/quads.md).
  const Row rows[] = {{"spot.obj", 0.01, 0.7, 1.4, true},
                      {"cat_low_resolution.obj", 0.022, 0.7, 1.4, true},
                      {"hand_closed.obj", 0.01, 0.7, 1.4, true},
                      {"cgal_knot1.off", 0.005, 0.7, 1.4, true},
                      {"skull.obj", 0.014, 0.7, 1.4, false},
                      {"cgal_elephant.off", 0.014, 0.7, 1.4, false},
                      {"boot.obj", 0.027, 0.4, 1.9, false},
                      {"cgal_blobby_3cc.off", 0.022, 0.7, 1.4, false},
                      {"bunny_35k_holes_isolated.obj", 0.012, 0.7, 1.4, false}};
  const bool full = hf_test::is_full();
  for (const Row& row : rows) {
    if (!full && !row.quick) continue;
    const samples::SurfaceMesh file = samples::read_mesh_file(folder / row.name);
    hf_test::PlainMesh mesh;
    for (const glm::dvec3& p : file.positions) mesh.positions.insert(mesh.positions.end(), {p.x, p.y, p.z});
    mesh.triangles = file.triangles;
    const auto core = hf_test::make_core(mesh);
    const QuadResult result = make(core);
    expect_valid(*core, result, row.name);
    const Edges edges = edges_of(result.mesh, 0.022);
    EXPECT_LE(distance_of(mesh, *core, result.mesh), row.distance) << row.name;
    EXPECT_GE(edges.low, row.shortest) << row.name;
    EXPECT_LE(edges.high, row.longest) << row.name;
  }
}

TEST(Quads, TheSameFromAnyNumberOfThreads) {
  const hf_test::PlainMesh mesh = plain(hf_test::cactus(3000));
  // the results lie in the cores' memory
  const auto one_core = hf_test::make_core(mesh, 1), four_core = hf_test::make_core(mesh, 4);
  const QuadResult one = make(one_core), four = make(four_core);
  ASSERT_EQ(one.mesh.position.size(), four.mesh.position.size());
  for (std::int32_t v = 0; v < one.mesh.position.size(); ++v)
    EXPECT_EQ(norm(one.mesh.position[v] - four.mesh.position[v]), 0);
}

TEST(Relax, WalksStraightOverEdgesAndStopsAtABorder) {
  const auto core = hf_test::make_core(hf_test::grid(10, 10, 1, 0.3));
  const remesh::FluxSurface s = remesh::FluxSurface::make(core->mesh, core->topology(), *core->memory);
  remesh::SurfacePoint start;
  start.triangle = 101;
  start.weight[0] = 0.5;
  start.weight[1] = 0.3;
  start.weight[2] = 0.2;
  const Vec3 p = position_of(s, start), way{0.21, -0.13, 0.7};  // what points out of the plane is left out
  const Vec3 q = position_of(s, remesh::walk_surface(s, start, way));
  EXPECT_NEAR(q.x - p.x, 0.21, 1e-12);
  EXPECT_NEAR(q.y - p.y, -0.13, 1e-12);
  const Vec3 end = position_of(s, remesh::walk_surface(s, start, {5, 0, 0}));
  double border = -1;
  for (const Vec3& v : core->mesh.positions) border = std::max(border, v.x);
  EXPECT_NEAR(end.x, border, 1e-9);
  EXPECT_NEAR(end.y, p.y, 1e-9);
}

TEST(NearestTriangle, AgreesWithTryingThemAll) {
  const auto core = hf_test::make_core(plain(hf_test::cactus(800)));
  Memory& memory = *core->memory;
  remesh::Table<Vec3> positions(memory);
  remesh::Table<std::int32_t> corners(memory), one(memory);
  for (const Vec3& p : core->mesh.positions) positions.push_back(p);
  for (const std::int32_t v : core->mesh.corners) corners.push_back(v);
  const mesh::NearestTriangle tree(remesh::span_of(positions), remesh::span_of(corners), memory);
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Vec3 p{samples::hash_to_unit(1, i) - 0.5, samples::hash_to_unit(2, i) - 0.5,
                 samples::hash_to_unit(3, i) - 0.5};
    double least = 1e300;
    for (std::int32_t t = 0; 3 * t < corners.size(); ++t) {
      one.clear();
      for (std::int32_t k = 0; k < 3; ++k) one.push_back(corners[3 * t + k]);
      least = std::min(least,
                       mesh::NearestTriangle(remesh::span_of(positions), remesh::span_of(one), memory).find(p).squared);
    }
    EXPECT_NEAR(tree.find(p).squared, least, 1e-15);
    // a search that may end early ends at something near enough, or at the nearest
    const double enough = 2 * samples::hash_to_unit(4, i) * least;
    const auto found = tree.find(p, static_cast<std::int32_t>(i), enough);
    EXPECT_LE(found.squared, std::max(enough, least + 1e-15));
    EXPECT_GE(found.squared, least - 1e-15);
    double w[3];
    tree.weights(p, found.triangle, w);
    Vec3 q;
    for (std::int32_t k = 0; k < 3; ++k) {
      EXPECT_GE(w[k], 0);
      q = q + w[k] * positions[corners[3 * found.triangle + k]];
    }
    EXPECT_NEAR(w[0] + w[1] + w[2], 1, 1e-12);
    EXPECT_NEAR(dot(p - q, p - q), found.squared, 1e-12);
  }
}

}  // namespace

// Every kind of field on every mesh of the shared data, real ones and broken ones, through the C ABI: finite, within
// the range of its sites where the operator promises it, tangent where it should be, singularities that sum up.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <random>

#include "common/mesh_file.h"
#include "hf/hf.h"
#include "support/arrays.h"
#include "support/full.h"

namespace {

namespace fs = std::filesystem;

fs::path data_folder() {
  if (const char* given = std::getenv("HF_SHARED_DATA")) return given;
  return fs::path(HF_SOURCE_DIR) / ".." / "shared" / "data";
}

struct Given {
  std::string name;
  samples::SurfaceMesh mesh;
};

// Meshes of the data that can be read, up to so many vertices; ten times as many when HF_FULL_TESTS is set.
std::vector<Given> meshes(std::size_t most) {
  if (hf_test::is_full()) most *= 10;
  std::vector<fs::path> files;
  for (const char* folder : {"meshes", "hostile"}) {
    if (!fs::exists(data_folder() / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(data_folder() / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension == ".obj" || extension == ".off" || extension == ".ply") files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  std::vector<Given> found;
  for (const fs::path& file : files) {
    if (fs::file_size(file) > 120 * most) continue;
    try {
      Given given{file.filename().string(), samples::read_mesh_file(file)};
      if (given.mesh.positions.size() <= most && !given.mesh.triangles.empty()) found.push_back(std::move(given));
    } catch (const std::exception&) {
      // what the reader refuses is its own tests' business
    }
  }
  return found;
}

// The surface of a mesh; null when the mesh is refused.
hf_surface make_surface(const samples::SurfaceMesh& mesh, int field_kind) {
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.positions = HF_ARRAY(&mesh.positions[0].x, mesh.positions.size());
  desc.triangles = HF_ARRAY(mesh.triangles.data(), mesh.triangles.size() / 3);
  desc.operator_kind = HF_OPERATOR_INTRINSIC_DELAUNAY;
  desc.field_kind = field_kind;
  hf_surface surface = nullptr;
  const hf_result made = hf_surface_create(&desc, &surface);
  // coordinates that are not numbers, or no triangle that is one
  EXPECT_TRUE(made == HF_OK || made == HF_ERROR_NON_FINITE || made == HF_ERROR_EMPTY || made == HF_ERROR_OUT_OF_RANGE ||
              made == HF_ERROR_TOO_LARGE)
      << hf_result_get_name(made);
  return surface;
}

// A solver on the mesh with eight random sites of values in [-1, 1] and their range; null when the mesh is refused.
hf_solver make_solver(const samples::SurfaceMesh& mesh, int field_kind, std::vector<std::uint32_t>& vertices,
                      std::vector<double>& values) {
  const hf_surface surface = make_surface(mesh, field_kind);
  if (!surface) return nullptr;
  hf_solver_desc desc = HF_INIT(hf_solver_desc);
  desc.field_kind = field_kind;
  hf_solver solver = nullptr;
  EXPECT_EQ(hf_create(surface, &desc, &solver), HF_OK);
  hf_surface_destroy(surface);
  std::mt19937 random(7);
  for (int i = 0; i < 40 && vertices.size() < 8; ++i) {
    const std::uint32_t v = random() % static_cast<std::uint32_t>(mesh.positions.size());
    const double value = std::uniform_real_distribution<double>(-1, 1)(random);
    hf_sites_desc batch = HF_INIT(hf_sites_desc);
    batch.site_count = 1;
    batch.vertices = &v;
    batch.values = &value;
    if (hf_add_sites(solver, &batch, nullptr) == HF_OK) {
      vertices.push_back(v);
      values.push_back(value);
    }
  }
  return solver;
}

TEST(EveryMesh, harmonic_fields_keep_to_the_range_of_their_sites) {
  const std::vector<Given> given = meshes(20000);
  if (given.empty()) GTEST_SKIP() << "no shared data under " << data_folder();
  int solved = 0;
  for (const Given& g : given) {
    SCOPED_TRACE(g.name);
    std::vector<std::uint32_t> vertices;
    std::vector<double> values;
    const hf_solver solver = make_solver(g.mesh, HF_FIELD_HARMONIC, vertices, values);
    if (!solver || vertices.empty()) {
      hf_solver_destroy(solver);
      continue;
    }
    std::vector<double> u(g.mesh.positions.size());
    ASSERT_EQ(hf_solver_solve(solver, OUT(u.data()), nullptr), HF_OK);
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    for (const double x : u) {
      ASSERT_TRUE(std::isfinite(x));
      // components without a site are 0
      ASSERT_TRUE(x == 0 || (x >= *low - 1e-9 && x <= *high + 1e-9)) << x << " outside " << *low << " to " << *high;
    }
    ++solved;
    hf_solver_destroy(solver);
  }
  std::printf("%d of %zu meshes\n", solved, given.size());
  EXPECT_GE(solved, 20);
}

TEST(EveryMesh, biharmonic_fields_are_finite_and_hold_their_sites) {
  const std::vector<Given> given = meshes(6000);
  if (given.empty()) GTEST_SKIP() << "no shared data under " << data_folder();
  for (const Given& g : given) {
    SCOPED_TRACE(g.name);
    for (const int kind : {HF_FIELD_BIHARMONIC, HF_FIELD_BIHARMONIC_GRAPH}) {
      std::vector<std::uint32_t> vertices;
      std::vector<double> values;
      const hf_solver solver = make_solver(g.mesh, kind, vertices, values);
      if (!solver || vertices.empty()) {
        hf_solver_destroy(solver);
        continue;
      }
      std::vector<double> u(g.mesh.positions.size());
      ASSERT_EQ(hf_solver_solve(solver, OUT(u.data()), nullptr), HF_OK);
      double most = 0;
      for (const double x : u) {
        ASSERT_TRUE(std::isfinite(x));
        most = std::max(most, std::fabs(x));
      }
      EXPECT_LE(most, 1e4);
      for (std::size_t i = 0; i < vertices.size(); ++i) EXPECT_EQ(u[vertices[i]], values[i]);
      hf_solver_destroy(solver);
    }
  }
}

TEST(EveryMesh, direction_fields_are_finite_and_their_singularities_sum_up) {
  const std::vector<Given> given = meshes(9000);
  if (given.empty()) GTEST_SKIP() << "no shared data under " << data_folder();
  int closed = 0;
  for (const Given& g : given) {
    SCOPED_TRACE(g.name);
    std::vector<std::uint32_t> vertices;
    std::vector<double> values;
    const hf_solver solver = make_solver(g.mesh, HF_FIELD_HARMONIC, vertices, values);
    if (!solver) continue;
    const hf_surface surface = make_surface(g.mesh, HF_FIELD_HARMONIC);
    hf_direction direction = nullptr;
    ASSERT_EQ(hf_direction_create(surface, nullptr, &direction), HF_OK);
    for (const std::uint32_t v : vertices) {
      const double vector[3] = {1, 0.3, -0.2};
      const hf_result added = hf_direction_add_sites(direction, 1, &v, vector, nullptr);
      EXPECT_TRUE(added == HF_OK || added == HF_ERROR_INVALID_ARGUMENT || added == HF_ERROR_DUPLICATE)
          << hf_result_get_name(added);
    }
    std::vector<double> u(3 * g.mesh.positions.size());
    if (hf_direction_solve(direction, OUT(u.data()), nullptr) == HF_OK) {
      for (const double x : u) {
        ASSERT_TRUE(std::isfinite(x));
        ASSERT_LE(std::fabs(x), 2.0);
      }
      hf_surface_report report = HF_INIT(hf_surface_report);
      hf_direction_statistics statistics = HF_INIT(hf_direction_statistics);
      ASSERT_EQ(hf_surface_get_report(surface, &report), HF_OK);
      ASSERT_EQ(hf_direction_get_statistics(direction, &statistics), HF_OK);
      std::uint32_t count = 0;
      ASSERT_EQ(hf_direction_get_singularities(direction, 0, nullptr, &count), HF_OK);
      std::vector<hf_singularity> found(count + 1);
      ASSERT_EQ(hf_direction_get_singularities(direction, count, found.data(), &count), HF_OK);
      if (report.component_count == 1 && report.boundary_edge_count == 0 && statistics.irregular_vertex_count == 0) {
        int sum = 0;
        for (std::uint32_t i = 0; i < count; ++i) sum += found[i].index;
        const int triangles = static_cast<int>(report.triangle_count - report.collapsed_triangle_count);
        const int used = static_cast<int>(report.welded_vertex_count - report.isolated_vertex_count);
        EXPECT_EQ(sum, used - triangles / 2);
        ++closed;
      }
    }
    hf_direction_destroy(direction);
    hf_solver_destroy(solver);
    hf_surface_destroy(surface);
  }
  std::printf("%d closed meshes\n", closed);
  EXPECT_GE(closed, 8);
}

}  // namespace

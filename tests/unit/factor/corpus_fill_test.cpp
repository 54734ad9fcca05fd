// Fill of our own ordering against minimum degree on real meshes, where the shared data is at hand, and on surfaces
// made to be hard. The limit holds for what Factor::make delivers, with its guard against graphs that separate badly.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "common/mesh_file.h"
#include "factor/ordering.h"
#include "factor/symbolic.h"
#include "support/full.h"
#include "support/hard_meshes.h"

namespace {

using hf_test::PlainMesh;

// entries and flops of the factor hf_create makes, over those of minimum degree
struct Ratio {
  double entries, flops;
};
Ratio ratio_to_minimum_degree(const PlainMesh& mesh) {
  // the graph of the mesh's own edges, which the limits are for; the intrinsic operator has others
  hf_inner::surface::CoreOptions options;
  options.operator_kind = hf_inner::mesh::OperatorKind::cotangent;
  const auto core = hf_test::make_core(mesh, 1, options);
  const hf_inner::SymmetricMatrix a = hf_inner::surface::grounded(*core);
  hf_inner::Buffer<std::int32_t> order;
  hf_inner::factor::order_by_minimum_degree(a, *core->memory, order);
  const hf_inner::factor::FillEstimate degree =
      hf_inner::factor::estimate_fill(a, {order.data(), order.size()}, *core->memory);
  const hf_inner::factor::FactorStatistics& own = core->factor->statistics();
  return {own.entries / degree.entries, own.flops / degree.flops};
}

// Small graphs fill so little that balance costs a share of it; large ones must gain.
void expect_bounded(const PlainMesh& mesh, const std::string& name, double limit = 0) {
  const Ratio ratio = ratio_to_minimum_degree(mesh);
  if (limit == 0) limit = mesh.vertex_count() < 3000 ? 1.35 : mesh.vertex_count() < 20000 ? 1.2 : 1.05;
  EXPECT_LE(ratio.entries, limit) << name << ", " << mesh.vertex_count() << " vertices";
  EXPECT_LE(ratio.flops, limit * limit * 1.1) << name << ", " << mesh.vertex_count() << " vertices";
  ::testing::Test::RecordProperty(name + "_entries", std::to_string(ratio.entries));
}

TEST(CorpusFill, is_bounded_by_minimum_degree_on_real_meshes) {
  const char* given = std::getenv("HF_SHARED_DATA");
  const std::filesystem::path folder =
      (given ? std::filesystem::path(given) : std::filesystem::path(HF_SOURCE_DIR) / ".." / "shared" / "data") /
      "meshes";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no shared data here: " << folder << " is not there";
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  int seen = 0;
  for (const auto& file : files) {
    if (!hf_test::is_full() && std::filesystem::file_size(file) > 1200000)
      continue;  // the large ones in the full form only
    const samples::SurfaceMesh read = samples::read_mesh_file(file);
    PlainMesh mesh;
    for (const glm::dvec3& p : read.positions) mesh.positions.insert(mesh.positions.end(), {p.x, p.y, p.z});
    mesh.triangles = read.triangles;
    expect_bounded(mesh, file.filename().string());
    ++seen;
  }
  EXPECT_GT(seen, 10) << "the folder of meshes is nearly empty: " << folder;
}

TEST(CorpusFill, is_bounded_by_minimum_degree_on_hard_surfaces) {
  // thousands of islands of one to eighteen triangles
  PlainMesh islands;
  for (std::uint32_t i = 0; i < 1500; ++i)
    append(islands, hf_test::grid(1 + i % 3, 1 + i / 3 % 3, 1, 0.2, i), 10.0 * i);
  expect_bounded(islands, "islands");
  // strips of one to four quads: next to no fill (three to six entries a column), of which balance costs a share
  expect_bounded(hf_test::grid(6000, 1), "strip_1", 1.6);
  expect_bounded(hf_test::grid(5000, 2, 1, 0.2), "strip_2", 1.5);
  expect_bounded(hf_test::grid(4000, 4, 1, 0.2), "strip_4", 1.5);
  // closed rings of triangles thirty times as long around as along: places mislead, the graph does not
  expect_bounded(hf_test::torus(5000, 4), "ring_4", 1.1);
  expect_bounded(hf_test::torus(1500, 16), "ring_16", 1.1);
  // all points of a surface in one place (nothing is welded): zero area everywhere, no coordinate to go by
  PlainMesh point = hf_test::torus(70, 60);
  std::fill(point.positions.begin(), point.positions.end(), 2.5);
  hf_inner::mesh::MeshInput input;
  input.vertex_count = point.vertex_count();
  input.triangle_count = point.triangle_count();
  input.positions = hf_inner::ConstRows(point.positions.data(), 3 * sizeof(double));
  input.triangles = hf_inner::IndexRows(point.triangles.data(), 3);
  input.weld = hf_inner::mesh::Weld::none;
  const auto memory = std::make_shared<hf_inner::Memory>();
  hf_inner::surface::CoreOptions options;
  options.operator_kind = hf_inner::mesh::OperatorKind::uniform;
  const auto core = hf_inner::surface::Core::make(input, options, memory, std::make_shared<hf_inner::JobRunner>(1));
  const hf_inner::SymmetricMatrix a = hf_inner::surface::grounded(*core);
  hf_inner::Buffer<std::int32_t> order;
  hf_inner::factor::order_by_minimum_degree(a, *memory, order);
  EXPECT_LE(core->factor->statistics().entries,
            1.15 * hf_inner::factor::estimate_fill(a, {order.data(), order.size()}, *memory).entries);
  // many handles, needles, dirt
  expect_bounded(hf_test::slab_with_holes(40, 4), "genus_40");
  PlainMesh needles = hf_test::torus(300, 40);
  for (std::size_t i = 2; i < needles.positions.size(); i += 3) needles.positions[i] *= 1e-4;
  expect_bounded(needles, "needles");
  expect_bounded(hf_test::dirty(60), "dirty");
  // a body with eight long arms
  expect_bounded(hf_test::voxel_surface(60, 60, 4,
                                        [](int x, int y, int) {
                                          const bool body = x > 24 && x < 36 && y > 24 && y < 36;
                                          return body || (y > 28 && y < 32) || (x > 28 && x < 32) ||
                                                 (y == 26 && x < 30) || (x == 34 && y > 30);
                                        }),
                 "arms");
}

}  // namespace

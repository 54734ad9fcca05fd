// Harmonic fields of libigl (sites eliminated exactly, plain cotangents, vertices as stored) reproduced by every engine
// through the C ABI.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "common/mesh_file.h"
#include "hf/hf.h"
#include "support/peers.h"
#include "support/arrays.h"

namespace {

std::filesystem::path data_folder() {
  if (const char* given = std::getenv("HF_SHARED_DATA")) return given;
  return std::filesystem::path(HF_SOURCE_DIR) / ".." / "shared" / "data";
}

class ReferenceField : public testing::TestWithParam<const char*> {};

TEST_P(ReferenceField, is_reproduced_by_every_engine) {
  const std::filesystem::path folder = data_folder();
  std::filesystem::path mesh_file;
  for (const char* extension : {".obj", ".off", ".ply"}) {
    if (std::filesystem::exists(folder / "meshes" / (std::string(GetParam()) + extension)))
      mesh_file = folder / "meshes" / (std::string(GetParam()) + extension);
  }
  if (mesh_file.empty()) GTEST_SKIP() << "no shared data here: " << GetParam() << " is not in " << folder;
  const samples::SurfaceMesh mesh = samples::read_mesh_file(mesh_file);
  std::vector<std::uint32_t> vertices;
  std::vector<double> values, reference;
  std::ifstream sites(folder / "reference" / (std::string(GetParam()) + ".sites.txt")),
      field(folder / "reference" / (std::string(GetParam()) + ".field.txt"));
  std::uint32_t v;
  double x;
  while (sites >> v >> x) {
    vertices.push_back(v);
    values.push_back(x);
  }
  while (field >> x) reference.push_back(x);
  ASSERT_EQ(reference.size(), mesh.positions.size());
  const auto [low, high] = std::minmax_element(reference.begin(), reference.end());

  for (const int engine : {ENGINE_GREEN, ENGINE_REFACTOR, ENGINE_UPDOWN}) {
    if (engine == ENGINE_UPDOWN && !has_gpl()) continue;
    hf_surface_desc desc = HF_INIT(hf_surface_desc);
    desc.positions = HF_ARRAY(&mesh.positions[0].x, mesh.positions.size());
    desc.triangles = HF_ARRAY(mesh.triangles.data(), mesh.triangles.size() / 3);
    desc.weld = HF_WELD_NONE;
    desc.operator_kind = HF_OPERATOR_COTANGENT;
    hf_surface surface = nullptr;
    hf_solver solver = nullptr;
    ASSERT_EQ(hf_surface_create(&desc, &surface), HF_OK);
    ASSERT_EQ(create_with(engine, surface, nullptr, &solver), HF_OK);
    hf_sites_desc batch = HF_INIT(hf_sites_desc);
    batch.site_count = static_cast<std::uint32_t>(vertices.size());
    batch.vertices = vertices.data();
    batch.values = values.data();
    ASSERT_EQ(hf_add_sites(solver, &batch, nullptr), HF_OK);
    std::vector<double> u(reference.size());
    ASSERT_EQ(hf_solver_solve(solver, OUT(u.data()), nullptr), HF_OK);
    double worst = 0;
    for (std::size_t i = 0; i < u.size(); ++i) worst = std::max(worst, std::fabs(u[i] - reference[i]));
    // updown holds its sites by penalties of 1e8
    EXPECT_LE(worst, (engine == ENGINE_UPDOWN ? 1e-6 : 1e-9) * (*high - *low)) << "engine " << engine;
    std::printf("%s engine %d: %.1e of the range\n", GetParam(), engine, worst / (*high - *low));
    hf_solver_destroy(solver);
    hf_surface_destroy(surface);
  }
}

INSTANTIATE_TEST_SUITE_P(Libigl, ReferenceField,
                         testing::Values("spot", "hand_closed", "armadillo_43k", "skull", "boot", "cgal_knot1",
                                         "plane_holes"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace

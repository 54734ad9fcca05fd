// Errors of the default distances on real meshes, against exact distances.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "base/index.h"
#include "common/mesh_file.h"
#include "field/distances.h"
#include "support/full.h"
#include "support/meshes.h"

namespace {

namespace fs = std::filesystem;
using hf_inner::at;
using hf_inner::Index;
using hf_inner::field::DistanceMethod;

struct Errors {
  double mean = 0, worst = 0;  // shares of the largest exact distance
};

Errors errors_of(const std::vector<double>& found, const std::vector<double>& exact) {
  Errors errors;
  double diameter = 0, count = 0;
  for (const double d : exact) diameter = std::max(diameter, d);
  for (std::size_t v = 0; v < exact.size(); ++v) {
    EXPECT_EQ(found[v] < 0, exact[v] < 0);
    if (!(exact[v] > 0)) continue;
    const double error = std::fabs(found[v] - exact[v]) / diameter;
    errors.mean += error;
    errors.worst = std::max(errors.worst, error);
    ++count;
  }
  errors.mean /= std::max(1.0, count);
  return errors;
}

TEST(CorpusDistance, is_off_by_one_per_cent_at_most_and_by_three_at_worst_on_real_meshes) {
  const char* given = std::getenv("HF_SHARED_DATA");
  const fs::path folder = (given ? fs::path(given) : fs::path(HF_SOURCE_DIR) / ".." / "shared" / "data") / "meshes";
  if (!fs::exists(folder)) GTEST_SKIP() << "no shared data here: " << folder << " is not there";
  const bool full = hf_test::is_full();
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  int seen = 0;
  for (const auto& file : files) {
    if (!full && fs::file_size(file) > 1400000) continue;  // the large ones in the full form only
    const samples::SurfaceMesh read = samples::read_mesh_file(file);
    hf_test::PlainMesh plain;
    for (const auto& p : read.positions) plain.positions.insert(plain.positions.end(), {p.x, p.y, p.z});
    plain.triangles = read.triangles;
    hf_inner::mesh::MeshInput input;
    input.vertex_count = plain.vertex_count();
    input.triangle_count = plain.triangle_count();
    input.positions = hf_inner::ConstRows(plain.positions.data(), 3 * sizeof(double));
    input.triangles = hf_inner::IndexRows(plain.triangles.data(), 3);
    const hf_inner::surface::Surface surface(
        hf_inner::surface::Geometry::make(input, hf_inner::mesh::OperatorKind::intrinsic_delaunay,
                                          std::make_shared<hf_inner::Memory>(),
                                          std::make_shared<hf_inner::JobRunner>(1)),
        {});
    const std::size_t n = surface.geometry().mesh.positions.size();
    const hf_inner::field::Distances standard(surface, DistanceMethod::automatic, 1),
        exact(surface, DistanceMethod::exact, 1), heat(surface, DistanceMethod::heat, 1),
        front(surface, DistanceMethod::front, 1);
    Errors worst, worst_heat, worst_front;
    for (const Index source : {Index{0}, static_cast<Index>(n / 3), static_cast<Index>(n - 1)}) {
      const auto solve = [&](const hf_inner::field::Distances& method) {
        std::vector<double> d(n);
        method.solve(hf_inner::Span<const Index>(&source, 1), d.data());
        return d;
      };
      const auto take = [](Errors& most, const Errors& e) {
        most.mean = std::max(most.mean, e.mean);
        most.worst = std::max(most.worst, e.worst);
      };
      const std::vector<double> truth = solve(exact);
      take(worst, errors_of(solve(standard), truth));
      take(worst_heat, errors_of(solve(heat), truth));
      take(worst_front, errors_of(solve(front), truth));
    }
    EXPECT_LE(worst.mean, 0.01) << file;
    EXPECT_LE(worst.worst, 0.03) << file;
    std::printf(
        "%-36s %7zu vertices: mean / largest error in %%: default %.2f / %.2f, front %.2f / %.2f, heat %.2f / %.2f\n",
        file.filename().c_str(), n, 100 * worst.mean, 100 * worst.worst, 100 * worst_front.mean,
        100 * worst_front.worst, 100 * worst_heat.mean, 100 * worst_heat.worst);
    ++seen;
  }
  EXPECT_GT(seen, 20);
}

}  // namespace

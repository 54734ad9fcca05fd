// Quads from crosses: the crosses, the seams, the map to the grid, its quads.
#include "quads/field_quads.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <map>
#include <set>

#include "assets/creature.h"
#include "assets/shapes.h"
#include "base/error.h"
#include "support/meshes.h"

namespace {

using namespace hf_inner;
using Complex = std::complex<double>;

std::shared_ptr<const Core> core_of(const samples::ShapeMesh& shape) {
  return hf_test::make_core({shape.positions, shape.triangles});
}

// Everything up to the map.
struct Stages {
  explicit Stages(std::shared_ptr<const Core> given, double radius = 0.1)
      : core(std::move(given)),
        surface(FluxSurface::make(core->mesh, core->topology, 0, *core->memory)),
        system(core, 4),
        faces([&] {
          CrossOptions options;
          options.radius = radius;
          return FaceCross::make(surface, system.connection,
                                 smooth_crosses(system, curvature_crosses(*core, system.connection, 2), {}, options),
                                 *core->memory);
        }()),
        seams(Seams::make(surface, faces, *core->memory)) {}
  GridMapper mapper() const { return GridMapper(surface, faces, seams, system.position, *core->memory, *core->jobs); }
  std::int32_t index_sum() const {
    std::int32_t sum = 0;
    for (const std::int32_t index : faces.index) sum += index;
    return sum;
  }
  std::shared_ptr<const Core> core;
  FluxSurface surface;
  DirectionSystem system;
  FaceCross faces;
  Seams seams;
};

std::vector<std::pair<std::string, std::shared_ptr<const Core>>> shapes() {
  std::vector<std::pair<std::string, std::shared_ptr<const Core>>> out;
  out.emplace_back("sphere", core_of(samples::sphere(24)));
  out.emplace_back("torus", core_of(samples::jittered_torus(40, 30)));
  out.emplace_back("cactus", core_of(samples::cactus(3000)));
  return out;
}

TEST(FieldQuads, indices_of_crosses_sum_to_four_times_the_euler_characteristic) {
  for (const auto& [name, core] : shapes()) {
    const Stages stages(core);
    EXPECT_EQ(stages.index_sum(), 4 * stages.surface.euler_characteristic) << name;
  }
}

TEST(FieldQuads, the_map_fits_at_every_seam) {
  for (const auto& [name, core] : shapes()) {
    const Stages stages(core);
    GridMapper mapper = stages.mapper();
    const GridMap map = mapper.make(0.05);
    const std::int64_t whole = (std::int64_t{1} << map.bits) - 1;
    for (std::int32_t h = 0; h < 3 * stages.surface.real_triangles; ++h) {
      const std::int32_t g = stages.surface.twin[h];
      // Z_left = i^k Z_right + t at both ends, with one whole t.
      const int k = stages.seams.transition[h];
      const auto moved = [&](std::int32_t left, std::int32_t right) {
        const std::int64_t a = map.u[right], b = map.v[right];
        const std::int64_t u = k == 0   ? a
                               : k == 1 ? -b
                               : k == 2 ? -a
                                        : b,
                           v = k == 0   ? b
                               : k == 1 ? a
                               : k == 2 ? -b
                                        : -a;
        return std::make_pair(map.u[left] - u, map.v[left] - v);
      };
      const auto at_tail = moved(h, FluxSurface::next(g)), at_head = moved(FluxSurface::next(h), g);
      ASSERT_EQ(at_tail, at_head) << name << " half-edge " << h;
      ASSERT_EQ(at_tail.first & whole, 0) << name;
      ASSERT_EQ(at_tail.second & whole, 0) << name;
      if (!stages.seams.cut[h]) {
        ASSERT_EQ(at_tail, std::make_pair(std::int64_t{0}, std::int64_t{0})) << name;
      }
    }
  }
}

TEST(FieldQuads, rounding_one_after_the_other_solves_the_dense_system) {
  for (const auto& core :
       {core_of(samples::sphere(8)), core_of(samples::jittered_torus(16, 10)), core_of(samples::cactus(500))}) {
    const Stages stages(core);
    GridMapper mapper = stages.mapper();
    const double edge_length = 0.1;
    Vector<Index> fixed;
    Vector<double> values;
    const Vector<double> x = mapper.round(edge_length, &fixed, &values);
    // [K W'; W 0] [x; lambda] = [b; s]
    const SymmetricMatrix& k = mapper.matrix();
    const Index n = k.size(), m = static_cast<Index>(fixed.size());
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n + m, n + m);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(n + m);
    for (Index c = 0; c < n; ++c) {
      for (Index i = k.column_start[at(c)]; i < k.column_start[at(c) + 1]; ++i) a(k.row[at(i)], c) = k.value[at(i)];
      b(c) = mapper.right()[at(c)] / edge_length;
    }
    ASSERT_LT((a - a.transpose()).cwiseAbs().maxCoeff(), 1e-12);
    for (Index s = 0; s < m; ++s) a(n + s, fixed[at(s)]) = a(fixed[at(s)], n + s) = 1, b(n + s) = values[at(s)];
    const Eigen::VectorXd exact = a.fullPivLu().solve(b);
    double worst = 0;
    for (Index i = 0; i < n; ++i) worst = std::max(worst, std::fabs(x[at(i)] - exact(i)));
    EXPECT_LT(worst, 1e-9);
    EXPECT_EQ(m, 2 * stages.seams.parameter_count);
    EXPECT_EQ(mapper.system().counts().rebases, 0u);
  }
}

TEST(FieldQuads, closed_shapes_of_genus_0_and_1_become_valid_meshes) {
  for (const auto& [name, core] : shapes()) {
    FieldQuadOptions options;
    options.core = core, options.edge_length = 0.04;
    FieldQuadReport report;
    const QuadResult result = make_field_quads(options, &report);
    std::map<std::int32_t, std::int32_t> valences;
    Table<std::int32_t> valence(result.mesh.position.size(), 0, *core->memory);
    for (const std::int32_t v : result.mesh.corner) ++valence[v];
    std::int32_t irregular = 0;
    for (const std::int32_t v : valence) irregular += v != 4, ++valences[v];
    std::printf(
        "%s: %d faces, %d irregular of %d, singularities %d, parameters %d, turned over %d, backward %d, doublets %d, "
        "tries %d\n",
        name.c_str(), result.mesh.face_count(), irregular, result.mesh.position.size(), report.singularities,
        report.parameters, report.turned_over, report.backward, report.doublets, report.tries);
    EXPECT_LE(irregular, result.mesh.position.size() / 10) << name;
  }
}

}  // namespace

// Bi-harmonic operators: their identities, their fields against closed forms, and all engines against the dense oracle.
#include "mesh/biharmonic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/index.h"
#include "support/dirty_meshes.h"
#include "support/engines.h"
#include "support/meshes.h"
#include "support/oracle.h"

namespace {

using hf_inner::at;
using hf_test::PlainMesh;

constexpr hf_inner::mesh::FieldKind both[] = {hf_inner::mesh::FieldKind::biharmonic,
                                              hf_inner::mesh::FieldKind::biharmonic_graph};
constexpr hf_inner::mesh::OperatorKind laplacians[] = {hf_inner::mesh::OperatorKind::cotangent,
                                                       hf_inner::mesh::OperatorKind::intrinsic_delaunay};

std::shared_ptr<const hf_inner::surface::Core> make(
    const PlainMesh& mesh, hf_inner::mesh::FieldKind field,
    hf_inner::mesh::OperatorKind kind = hf_inner::mesh::OperatorKind::cotangent, std::uint32_t threads = 1) {
  hf_inner::surface::CoreOptions options;
  options.field_kind = field;
  options.operator_kind = kind;
  return hf_test::make_core(mesh, threads, options);
}

Eigen::MatrixXd dense(const hf_inner::SymmetricMatrix& k) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(k.size(), k.size());
  for (std::int32_t v = 0; v < k.size(); ++v) {
    for (std::int32_t i = k.column_start[at(v)]; i < k.column_start[at(v) + 1]; ++i)
      a(k.row[at(i)], v) = k.value[at(i)];
  }
  return a;
}

std::vector<double> field_of(const std::shared_ptr<const hf_inner::surface::Core>& core,
                             const std::vector<std::int32_t>& vertices, const std::vector<double>& values,
                             hf_test::EngineKind kind = hf_test::EngineKind::green) {
  const auto solver = hf_test::make_engine(kind, core);
  std::vector<std::int32_t> slots;
  std::vector<hf_inner::solve::Site> sites;
  for (const std::int32_t v : vertices) {
    slots.push_back(static_cast<std::int32_t>(slots.size()));
    sites.push_back(hf_inner::solve::Site::at_vertex(core->mesh, v));
  }
  hf_inner::solve::SiteEdit edit;
  edit.add = slots;
  edit.sites = sites;
  solver->edit(edit);
  std::vector<double> field(at(core->size()));
  solver->solve(values.data(), 1, field.data(), nullptr);
  return field;
}

TEST(Biharmonic, is_l_times_inverse_mass_times_l) {
  const PlainMesh mesh = hf_test::torus(14, 10, 0.3);
  for (const hf_inner::mesh::OperatorKind kind : laplacians) {
    const Eigen::MatrixXd l = dense(make(mesh, hf_inner::mesh::FieldKind::harmonic, kind)->laplacian);
    const auto mass_core = make(mesh, hf_inner::mesh::FieldKind::biharmonic, kind);
    const Eigen::MatrixXd graph = dense(make(mesh, hf_inner::mesh::FieldKind::biharmonic_graph, kind)->laplacian);
    EXPECT_LE((graph - hf_test::dense_product(l, l)).cwiseAbs().maxCoeff(), 1e-13 * graph.cwiseAbs().maxCoeff());
    EXPECT_TRUE(graph == graph.transpose());
    const Eigen::MatrixXd mass = dense(mass_core->laplacian);
    EXPECT_TRUE(mass == mass.transpose());
    if (kind == hf_inner::mesh::OperatorKind::cotangent) {
      const hf_inner::Vector<double> areas = hf_inner::mesh::vertex_areas(mass_core->mesh, *mass_core->memory);
      Eigen::VectorXd m(l.rows());
      for (int v = 0; v < l.rows(); ++v) m(v) = areas[static_cast<std::size_t>(v)];
      m /= m.mean();
      const Eigen::MatrixXd expected = hf_test::dense_product(l, Eigen::MatrixXd(m.cwiseInverse().asDiagonal() * l));
      EXPECT_LE((mass - expected).cwiseAbs().maxCoeff(), 1e-12 * mass.cwiseAbs().maxCoeff());
    }
  }
}

TEST(Biharmonic, annihilates_constants_to_rounding) {
  for (const auto& [name, mesh] : hf_test::dirty_meshes()) {
    SCOPED_TRACE(name);
    for (const hf_inner::mesh::FieldKind field : both) {
      const hf_inner::SymmetricMatrix k =
          make(mesh, field, hf_inner::mesh::OperatorKind::intrinsic_delaunay)->laplacian;
      for (std::int32_t v = 0; v < k.size(); ++v) {
        double sum = 0, size = 0;
        for (std::int32_t i = k.column_start[at(v)]; i < k.column_start[at(v) + 1]; ++i) {
          sum += k.value[at(i)];
          size += std::fabs(k.value[at(i)]);
        }
        EXPECT_LE(std::fabs(sum), 1e-14 * size);
      }
    }
  }
}

TEST(Biharmonic, field_overshoots_its_sites_where_the_harmonic_one_does_not) {
  const PlainMesh mesh = hf_test::grid(24, 24, 1, 0.2);
  const std::vector<std::int32_t> vertices = {12 * 25 + 4, 12 * 25 + 8, 12 * 25 + 12, 8 * 25 + 8, 16 * 25 + 8};
  const std::vector<double> values = {0, 1, 0, 1, 1};
  const auto range = [&](hf_inner::mesh::FieldKind kind) {
    const std::vector<double> u = field_of(make(mesh, kind), vertices, values);
    return std::make_pair(*std::min_element(u.begin(), u.end()), *std::max_element(u.begin(), u.end()));
  };
  const auto harmonic = range(hf_inner::mesh::FieldKind::harmonic);
  EXPECT_GE(harmonic.first, -1e-12);
  EXPECT_LE(harmonic.second, 1 + 1e-12);
  for (const hf_inner::mesh::FieldKind kind : both) {
    const auto [low, high] = range(kind);
    EXPECT_TRUE(low < -0.05 || high > 1.05) << low << " to " << high;
  }
}

// u = x (x^2 + y^2) and u = r^2 log r are bi-harmonic and not harmonic. Sites on the rim r >= 0.7, and for the second
// one on r <= 0.2, give value and slope.
TEST(Biharmonic, field_converges_quadratically_to_known_solutions_on_a_disk) {
  for (const int solution : {0, 1}) {
    std::vector<double> error;
    for (const std::uint32_t rings : {10u, 20u, 40u}) {
      const auto core = make(hf_test::disk(rings), hf_inner::mesh::FieldKind::biharmonic);
      const auto exact = [&](std::int32_t v) {
        const hf_inner::Vec3 given = core->mesh.to_given(core->mesh.positions[at(v)]);
        const double r2 = given.x * given.x + given.y * given.y;
        return solution == 0 ? given.x * r2 : r2 > 0 ? 0.5 * r2 * std::log(r2) : 0.0;
      };
      std::vector<std::int32_t> vertices;
      std::vector<double> values;
      for (std::int32_t v = 0; v < core->size(); ++v) {
        const hf_inner::Vec3 p = core->mesh.to_given(core->mesh.positions[at(v)]);
        const double r = std::hypot(p.x, p.y);
        if (r > 0.699 || (solution == 1 && r < 0.201)) {
          vertices.push_back(v);
          values.push_back(exact(v));
        }
      }
      const std::vector<double> u = field_of(core, vertices, values);
      double worst = 0;
      for (std::int32_t v = 0; v < core->size(); ++v) worst = std::max(worst, std::fabs(u[at(v)] - exact(v)));
      error.push_back(worst);
    }
    std::printf("solution %d: errors %.2e %.2e %.2e\n", solution, error[0], error[1], error[2]);
    EXPECT_LE(error[2], 2e-3);
    EXPECT_GE(error[0] / error[1], 3.2);
    EXPECT_GE(error[1] / error[2], 3.2);
  }
}

TEST(Biharmonic, field_is_the_same_at_any_scale_and_place) {
  const PlainMesh mesh = hf_test::torus(40, 25, 0.3);
  const std::vector<std::int32_t> vertices = {3, 200, 501, 777};
  const std::vector<double> values = {0, 1, -1, 0.5};
  const std::vector<double> first = field_of(make(mesh, hf_inner::mesh::FieldKind::biharmonic), vertices, values);
  for (const double scale : {1000.0, 0.001}) {
    PlainMesh moved = mesh;
    for (double& x : moved.positions) x = scale * (x + 5);
    const std::vector<double> second = field_of(make(moved, hf_inner::mesh::FieldKind::biharmonic), vertices, values);
    for (std::size_t v = 0; v < first.size(); ++v) EXPECT_NEAR(first[v], second[v], 1e-9);
  }
}

PlainMesh two_islands() {
  PlainMesh mesh = hf_test::sheared_patch(9, 7, 0.7);
  append(mesh, hf_test::torus(12, 9), 20);
  return mesh;
}

// Sites come, go and move; soft ones and ones inside triangles among them.
TEST(Biharmonic, every_engine_gives_the_dense_oracles_field_under_edits) {
  struct Case {
    hf_test::EngineKind engine;
    double tolerance;  // of the value range
  };
  std::vector<Case> cases = {{hf_test::EngineKind::green, 1e-10}, {hf_test::EngineKind::refactor, 1e-8}};
#ifdef HF_WITH_GPL
  cases.push_back({hf_test::EngineKind::updown, 1e-6});  // sites are penalties of 1e8 mean diagonals
#endif
  for (const hf_inner::mesh::FieldKind field : both) {
    for (const hf_inner::mesh::OperatorKind kind : laplacians) {
      const auto core = make(two_islands(), field, kind);
      for (const Case& c : cases) {
        const auto solver = hf_test::make_engine(c.engine, core);
        std::mt19937 random(17);
        std::vector<hf_inner::solve::Site> sites;  // by slot
        std::vector<double> values;
        double worst = 0;
        for (int round = 0; round < 12; ++round) {
          std::vector<std::int32_t> remove, add;
          std::vector<hf_inner::solve::Site> fresh;
          for (std::size_t s = 0; s < sites.size(); ++s) {
            if (sites[s].component >= 0 && random() % 4 == 0) remove.push_back(static_cast<std::int32_t>(s));
          }
          for (const std::int32_t s : remove) sites[at(s)] = hf_inner::solve::Site{};
          for (int i = 0; i < 4; ++i) {
            const std::int32_t t =
                static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(core->mesh.triangle_count()));
            const std::int32_t* v = core->mesh.triangle(t);
            bool taken = false;
            for (const hf_inner::solve::Site& s : sites) {
              for (const std::int32_t w : s.vertex) taken = taken || w == v[0] || w == v[1] || w == v[2];
            }
            if (taken) continue;
            hf_inner::solve::Site site = hf_inner::solve::Site::at_vertex(core->mesh, v[0], i == 1 ? 1e-3 : 0.0);
            if (i == 2) {
              for (int q = 0; q < 3; ++q) {
                site.vertex[q] = v[q];
                site.weight[q] = q == 0 ? 0.5 : 0.25;
              }
            }
            std::size_t slot = 0;  // a slot just left may be taken again: a move
            while (slot < sites.size() && sites[slot].component >= 0) ++slot;
            if (slot == sites.size()) {
              sites.emplace_back();
              values.push_back(0);
            }
            sites[slot] = site;
            values[slot] = std::uniform_real_distribution<double>(-1, 1)(random);
            add.push_back(static_cast<std::int32_t>(slot));
            fresh.push_back(site);
          }
          hf_inner::solve::SiteEdit edit;
          edit.remove = remove;
          edit.add = add;
          edit.sites = fresh;
          solver->edit(edit);
          std::vector<hf_inner::solve::Site> used;
          std::vector<double> s;
          for (std::size_t i = 0; i < sites.size(); ++i) {
            if (sites[i].component >= 0) {
              used.push_back(sites[i]);
              s.push_back(values[i]);
            }
          }
          const Eigen::MatrixXd exact =
              hf_test::dense_field(*core, used, Eigen::Map<Eigen::VectorXd>(s.data(), static_cast<int>(s.size())));
          std::vector<double> u(at(core->size()));
          solver->solve(values.data(), 1, u.data(), nullptr);
          const double size = std::max(1.0, exact.cwiseAbs().maxCoeff());
          for (std::int32_t v = 0; v < core->size(); ++v)
            worst = std::max(worst, std::fabs(u[at(v)] - exact(v, 0)) / size);
        }
        std::printf("field %d operator %d engine %d: %.1e of the largest value\n", static_cast<int>(field),
                    static_cast<int>(kind), static_cast<int>(c.engine), worst);
        EXPECT_LE(worst, c.tolerance) << "engine " << static_cast<int>(c.engine);
      }
    }
  }
}

TEST(Biharmonic, many_sites_at_once_give_the_same_field_as_a_fresh_elimination) {
  const auto core = make(hf_test::torus(60, 40, 0.2), hf_inner::mesh::FieldKind::biharmonic);
  std::vector<std::int32_t> vertices;
  std::vector<double> values;
  for (std::int32_t v = 0; v < core->size(); v += 3) {
    vertices.push_back(v);
    values.push_back(std::sin(0.1 * v));
  }
  const std::vector<double> green = field_of(core, vertices, values),
                            fresh = field_of(core, vertices, values, hf_test::EngineKind::refactor);
  for (std::size_t v = 0; v < green.size(); ++v) EXPECT_NEAR(green[v], fresh[v], 1e-10);
}

TEST(Biharmonic, gives_the_same_bits_for_any_number_of_threads) {
  std::vector<double> first;
  for (const std::uint32_t threads : {1u, 2u, 4u}) {
    const auto core = make(hf_test::torus(220, 90, 0.3), hf_inner::mesh::FieldKind::biharmonic,
                           hf_inner::mesh::OperatorKind::cotangent, threads);
    std::vector<double> value(core->laplacian.value.begin(), core->laplacian.value.end());
    const std::vector<double> u = field_of(core, {5, 7000, 12000}, {0, 1, 2});
    value.insert(value.end(), u.begin(), u.end());
    if (first.empty()) first = value;
    EXPECT_EQ(first, value);
  }
}

}  // namespace

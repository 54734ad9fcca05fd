// Quads from crosses: the crosses, the seams, the map to the grid, its quads.
#include "quads/field_quads.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Core>

#include "assets/creature.h"
#include "assets/shapes.h"
#include "base/error.h"
#include "base/progress.h"
#include "quads/untangle.h"
#include "support/creature.h"
#include "support/dense.h"
#include "support/full.h"
#include "support/meshes.h"
#include "support/quad_oracle.h"
#include "unit/field/analysis_support.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::quads;
using Complex = std::complex<double>;

std::shared_ptr<const surface::Core> core_of(const samples::ShapeMesh& shape) {
  return hf_test::make_core({shape.positions, shape.triangles});
}

// Everything up to the map.
struct Stages {
  explicit Stages(std::shared_ptr<const surface::Core> given, double radius = 0.1)
      : core(std::move(given)),
        surface(remesh::FluxSurface::make(core->mesh, core->topology(), *core->memory)),
        system(core, 4),
        features(find_features(surface, 100, *core->memory)),
        faces([&] {
          const Vector<Complex> wish = curvature_crosses(*core, system.connection, 2);
          return FaceCross::make(surface, system.connection, CrossSmoother(system, radius).smooth(wish, {}), features,
                                 SharpCorners(*core->memory), remesh::Table<std::complex<double>>(*core->memory),
                                 *core->memory);
        }()),
        seams(Seams::make(surface, faces, *core->memory)) {}
  GridMapper mapper() const {
    return GridMapper(surface, faces, seams, features, system.position, *core->memory, *core->jobs);
  }
  std::int32_t index_sum() const {
    std::int32_t sum = 0;
    for (const std::int32_t index : faces.index) sum += index;
    return sum;
  }
  std::shared_ptr<const surface::Core> core;
  remesh::FluxSurface surface;
  field::DirectionMatrix system;
  remesh::Table<std::uint8_t> features;
  FaceCross faces;
  Seams seams;
};

std::vector<std::pair<std::string, std::shared_ptr<const surface::Core>>> shapes() {
  std::vector<std::pair<std::string, std::shared_ptr<const surface::Core>>> out;
  out.emplace_back("sphere", core_of(samples::sphere(24)));
  out.emplace_back("torus", core_of(samples::jittered_torus(40, 30)));
  out.emplace_back("cactus", core_of(hf_test::cactus(3000)));
  out.emplace_back("ladder of genus 3", hf_test::make_core(hf_test::ladder(3, 0.16)));
  hf_test::PlainMesh two = hf_test::torus(24, 18);
  hf_test::append(two, hf_test::torus(20, 15, 0.1), 8);
  out.emplace_back("two tori", hf_test::make_core(two));
  return out;
}

void expect_valid(const surface::Core& core, const remesh::QuadMesh& mesh, const std::string& what) {
  hf_test::expect_manifold(core, mesh, what);
  for (std::int32_t v = 0; v < mesh.position.size(); ++v) {
    const remesh::SurfacePoint& point = mesh.location[v];
    Vec3 p;
    for (int k = 0; k < 3; ++k) {
      ASSERT_GE(point.weight[k], -1e-9) << what;
      p = p + point.weight[k] * core.mesh.positions[at(core.mesh.triangle(point.triangle)[k])];
    }
    ASSERT_LT(norm(p - mesh.position[v]), 1e-6) << what;
  }
}

// Inner vertices of not 4 quads.
std::int32_t irregular_count(const remesh::QuadMesh& mesh, Memory& memory) {
  remesh::Table<std::int32_t> valence(mesh.position.size(), 0, memory);
  for (const std::int32_t v : mesh.corner) ++valence[v];
  std::int32_t count = 0;
  for (std::int32_t v = 0; v < valence.size(); ++v) count += !mesh.border[v] && valence[v] != 4;
  return count;
}

double area_of(const remesh::QuadMesh& mesh) {
  double sum = 0;
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    const std::int32_t* c = &mesh.corner[4 * f];
    for (int k = 1; k < 3; ++k)
      sum +=
          0.5 * norm(cross(mesh.position[c[k]] - mesh.position[c[0]], mesh.position[c[k + 1]] - mesh.position[c[0]]));
  }
  return sum;
}

TEST(FieldQuads, indices_of_crosses_sum_to_four_times_the_euler_characteristic) {
  for (const auto& [name, core] : shapes()) {
    const Stages stages(core);
    EXPECT_EQ(stages.index_sum(), 4 * stages.surface.euler_characteristic) << name;
  }
}

TEST(FieldQuads, crosses_of_a_torus_are_its_principal_directions) {
  const Stages stages(core_of(samples::jittered_torus(60, 40, 0.0)));
  EXPECT_EQ(stages.seams.singularity_count, 0);
  // The axis is where the torus is flattest.
  Vec3 low{1, 1, 1}, high{-1, -1, -1};
  for (const Vec3& p : stages.core->mesh.positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Vec3 size = high - low, middle = 0.5 * (low + high);
  const Vec3 axis = size.x < size.y && size.x < size.z ? Vec3{1, 0, 0}
                    : size.y < size.z                  ? Vec3{0, 1, 0}
                                                       : Vec3{0, 0, 1};
  double worst = 0;
  for (std::int32_t t = 0; t < stages.surface.real_triangles; ++t) {
    Vec3 p[3], centre;
    for (int k = 0; k < 3; ++k) {
      p[k] = stages.surface.position[stages.surface.tail[3 * t + k]];
      centre = centre + 1 / 3.0 * p[k];
    }
    const Vec3 x = unit_vector(p[1] - p[0]), y = cross(unit_vector(cross(p[1] - p[0], p[2] - p[0])), x);
    const Vec3 parallel = cross(axis, centre - middle);
    const Complex along(dot(parallel, x), dot(parallel, y));
    Complex off = stages.faces.direction[t] * std::conj(along) / std::abs(along);
    off *= off;
    off *= off;
    worst = std::max(worst, std::fabs(std::arg(off)) / 4);
  }
  EXPECT_LT(worst * 180 / std::acos(-1.0), 3);  // 22.5 is random
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
      const auto at_tail = moved(h, remesh::FluxSurface::next(g)), at_head = moved(remesh::FluxSurface::next(h), g);
      ASSERT_EQ(at_tail, at_head) << name << " half-edge " << h;
      ASSERT_EQ(at_tail.first & whole, 0) << name;
      ASSERT_EQ(at_tail.second & whole, 0) << name;
      if (!stages.seams.cut[h]) {
        ASSERT_EQ(at_tail, std::make_pair(std::int64_t{0}, std::int64_t{0})) << name;
      }
    }
  }
}

// How many triangles of a map are turned over or flat, without those that have two corners at one place.
std::int32_t turned_over(const remesh::FluxSurface& surface, const GridMap& map) {
  std::int32_t count = 0;
  for (std::int32_t h = 0; h < 3 * surface.real_triangles; h += 3) {
    const auto side = [&](std::int32_t a, std::int32_t b) {
      return std::make_pair(map.u[b] - map.u[a], map.v[b] - map.v[a]);
    };
    const auto a = side(h, h + 1), b = side(h + 1, h + 2), c = side(h + 2, h);
    const std::pair<std::int64_t, std::int64_t> same(0, 0);
    count += a != same && b != same && c != same && a.first * b.second <= a.second * b.first;
  }
  return count;
}

TEST(FieldQuads, a_map_is_untangled_but_where_singularities_share_a_place) {
  std::int32_t before = 0;
  for (const auto& [name, core] : shapes()) {
    const Stages stages(core);
    GridMapper mapper = stages.mapper();
    for (const double length : {0.02, 0.04, 0.08}) {
      const GridMap folded = mapper.make(length, false), map = mapper.make(length);
      const std::int32_t was = turned_over(stages.surface, folded), is = turned_over(stages.surface, map);
      std::printf("%s at %.2f: %d turned over, then %d\n", name.c_str(), length, was, is);
      before += was;
      EXPECT_EQ(is, 0) << name << " at " << length;
      if (folded.turned_over > 0) continue;
      EXPECT_TRUE(std::equal(map.u.begin(), map.u.end(), folded.u.begin()));
      EXPECT_TRUE(std::equal(map.v.begin(), map.v.end(), folded.v.begin()));
    }
  }
  EXPECT_GT(before, 20);
}

TEST(FieldQuads, untangling_finds_back_a_plane_whose_inside_is_scrambled) {
  const Stages stages(hf_test::make_core(hf_test::grid(14, 14)));
  const remesh::FluxSurface& surface = stages.surface;
  Memory& memory = *stages.core->memory;
  const double length = 1.7 * norm(surface.position[surface.head(0)] - surface.position[surface.tail[0]]);
  const Vec3 origin = surface.position[surface.tail[0]];
  const Vec3 normal =
      unit_vector(cross(surface.position[surface.tail[1]] - origin, surface.position[surface.tail[2]] - origin));
  const Vec3 x = unit_vector(surface.position[surface.tail[1]] - origin), y = cross(normal, x);
  for (const bool border : {true, false}) {
    remesh::Table<Complex> z(surface.vertex_count(), Complex(0, 0), memory);
    remesh::Table<std::uint8_t> whole(2 * surface.vertex_count(), 0, memory);
    std::uint32_t seed = 7;
    const auto draw = [&] { return (seed = 1664525 * seed + 1013904223) / 4294967296.0 - 0.5; };
    for (std::int32_t v = 0; v < surface.first_apex; ++v) {
      const Vec3 p = surface.position[v] - origin;
      z[v] = Complex(dot(p, x), dot(p, y)) / length;
      bool inside = true;
      std::int32_t h = surface.out[v];
      do {
        inside &= surface.is_real(h);
        h = surface.turn_left(h);
      } while (h != surface.out[v]);
      if (inside) {
        z[v] += Complex(4 * draw(), 4 * draw());
      } else if (border) {
        whole[2 * v] = whole[2 * v + 1] = 1;
      } else {
        whole[2 * v + v % 2] = 1;  // one coordinate is free
      }
    }
    const remesh::Table<Complex> given = z;
    const auto count = [&] {
      std::int32_t turned = 0;
      for (std::int32_t t = 0; t < surface.real_triangles; ++t) {
        const Complex* p[3];
        for (int k = 0; k < 3; ++k) p[k] = &z[surface.tail[3 * t + k]];
        turned += (std::conj(*p[1] - *p[0]) * (*p[2] - *p[0])).imag() <= 0;
      }
      return turned;
    };
    EXPECT_GT(count(), 100);
    untangle(surface, stages.faces, stages.seams, length, {}, whole, z, memory);
    EXPECT_EQ(count(), 0);
    for (std::int32_t v = 0; v < surface.first_apex; ++v) {
      EXPECT_TRUE(!whole[2 * v] || z[v].real() == given[v].real());
      EXPECT_TRUE(!whole[2 * v + 1] || z[v].imag() == given[v].imag());
    }
  }
}

TEST(FieldQuads, rounding_one_after_the_other_solves_the_dense_system) {
  for (const auto& core :
       {core_of(samples::sphere(8)), core_of(samples::jittered_torus(16, 10)), core_of(hf_test::cactus(500))}) {
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
    for (Index s = 0; s < m; ++s) {
      a(n + s, fixed[at(s)]) = a(fixed[at(s)], n + s) = 1;
      b(n + s) = values[at(s)];
    }
    const Eigen::VectorXd exact = hf_test::DenseSolver(a).solve(b);
    double worst = 0;
    for (Index i = 0; i < n; ++i) worst = std::max(worst, std::fabs(x[at(i)] - exact(i)));
    EXPECT_LT(worst, 1e-9);
    EXPECT_EQ(m, 2 * stages.seams.parameter_count);
    EXPECT_EQ(mapper.system().counts().rebases, 0u);
  }
}

TEST(FieldQuads, rounding_takes_the_unknown_nearest_to_a_whole_number_at_every_step) {
  const Stages stages(core_of(hf_test::cactus(500)));
  GridMapper mapper = stages.mapper();
  const double edge_length = 0.07;
  Vector<Index> fixed;
  Vector<double> values;
  mapper.round(edge_length, &fixed, &values);
  const SymmetricMatrix& k = mapper.matrix();
  const Index n = k.size(), m = static_cast<Index>(fixed.size()), first = n - m;
  ASSERT_GT(m, 40);  // steps are taken together by 32
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
  for (Index c = 0; c < n; ++c) {
    for (Index i = k.column_start[at(c)]; i < k.column_start[at(c) + 1]; ++i) a(k.row[at(i)], c) = k.value[at(i)];
    b(c) = mapper.right()[at(c)] / edge_length;
  }
  const hf_test::DenseSolver solver(a);
  Eigen::VectorXd x = solver.solve(b).tail(m);
  Eigen::MatrixXd c = solver.solve(Eigen::MatrixXd(Eigen::MatrixXd::Identity(n, n).rightCols(m))).bottomRows(m);
  std::vector<bool> held(at(m), false);
  for (Index s = 0; s < m; ++s) {
    const Index i = fixed[at(s)] - first;
    ASSERT_GE(i, 0);
    ASSERT_FALSE(held[at(i)]);
    const double away = std::fabs(x(i) - std::nearbyint(x(i)));
    EXPECT_NEAR(x(i), values[at(s)], away + 1e-7);
    for (Index j = 0; j < m; ++j) {
      if (!held[at(j)]) {
        EXPECT_GE(std::fabs(x(j) - std::nearbyint(x(j))), away - 1e-7) << s << " " << j;
      }
    }
    held[at(i)] = true;
    x += (values[at(s)] - x(i)) / c(i, i) * c.col(i);
    c -= Eigen::MatrixXd(c.col(i) * c.row(i) / c(i, i));
  }
}

TEST(FieldQuads, closed_shapes_of_any_genus_become_valid_meshes) {
  for (const auto& [name, core] : shapes()) {
    FieldQuadOptions options;
    options.core = core;
    options.faces = 1500;
    FieldQuadReport report;
    const QuadResult result = make_field_quads(options, &report);
    expect_valid(*core, result.mesh, name);
    const std::int32_t irregular = irregular_count(result.mesh, *core->memory);
    std::printf(
        "%s: %d faces, %d irregular of %d, singularities %d, parameters %d, turned over %d, backward %d, removed %d, "
        "tries %d\n",
        name.c_str(), result.mesh.face_count(), irregular, result.mesh.position.size(), report.singularities,
        report.parameters, report.turned_over, report.backward, report.removed, report.tries);
    EXPECT_LE(irregular, report.singularities + result.mesh.position.size() / 50) << name;
    EXPECT_NEAR(result.mesh.face_count(), 1500, 75) << name;
  }
}

TEST(FieldQuads, a_rectangle_becomes_a_grid) {
  const auto core = hf_test::make_core(hf_test::grid(20, 14, 1, 0.2));
  FieldQuadOptions options;
  options.core = core;
  options.edge_length = 2 / core->mesh.scale;
  const QuadResult result = make_field_quads(options);
  expect_valid(*core, result.mesh, "rectangle");
  EXPECT_EQ(result.mesh.face_count(), 10 * 7);
  EXPECT_EQ(irregular_count(result.mesh, *core->memory), 0);
  EXPECT_NEAR(area_of(result.mesh) * core->mesh.scale * core->mesh.scale, 20 * 14, 1e-6);  // borders are kept
}

TEST(FieldQuads, creases_of_a_box_are_kept) {
  const auto core = core_of(samples::box(3, 2, 1, 12, 9, 6));
  FieldQuadOptions options;
  options.core = core;
  options.faces = 300;
  options.crease = 0.7;
  FieldQuadReport report;
  const QuadResult result = make_field_quads(options, &report);
  expect_valid(*core, result.mesh, "box");
  EXPECT_EQ(report.left_out, 0);
  EXPECT_EQ(report.singularities, 8);
  EXPECT_EQ(irregular_count(result.mesh, *core->memory), 8);
  const double scale = core->mesh.scale;
  EXPECT_NEAR(area_of(result.mesh) * scale * scale, 2 * (3 * 2 + 3 * 1 + 2 * 1), 1e-6);
  // Without creases, edges and corners are cut.
  options.crease = 0;
  EXPECT_LT(area_of(make_field_quads(options).mesh) * scale * scale, 22 - 1e-3);
}

TEST(FieldQuads, a_map_that_is_turned_over_has_crossings_that_cancel) {
  const Stages stages(core_of(samples::jittered_torus(60, 40)));
  GridMapper mapper = stages.mapper();
  GridMap map = mapper.make(0.06);
  Memory& memory = *stages.core->memory;
  std::int32_t backward = 0;
  const QuadComplex before = extract_quads(stages.surface, map, stages.features, backward, memory);
  ASSERT_EQ(backward, 0);
  // Some vertices that no seam touches are moved in the map, so that triangles around them turn over.
  std::int32_t moved = 0;
  for (std::int32_t v = 0; v < stages.surface.first_apex; v += 37) {
    const std::int32_t begin = stages.surface.out[v];
    bool free = stages.seams.parameter[v] == Seams::free;
    for (std::int32_t h = begin;;) {
      free &= !stages.seams.cut[h];
      h = stages.surface.turn_left(h);
      if (h == begin) break;
    }
    if (!free) continue;
    ++moved;
    const std::int64_t by = (std::int64_t{2} << map.bits) * 2 / 5;
    for (std::int32_t h = begin;;) {
      map.u[h] += by / 2 * 2;
      map.v[h] -= by / 3 * 2 / 2 * 2;
      h = stages.surface.turn_left(h);
      if (h == begin) break;
    }
  }
  ASSERT_GT(moved, 10);
  QuadComplex quads = extract_quads(stages.surface, map, stages.features, backward, memory);
  EXPECT_GT(backward, 0);
  EXPECT_EQ(quads.quad_count() - 2 * backward, before.quad_count());
  RepairReport report;
  repair_quads(stages.surface, quads, report, memory);
  EXPECT_GT(report.removed, 0);
  remesh::check_quads(quads.mesh(memory), stages.surface.euler_characteristic, memory);
}

// A torus of rows x columns quads, all at one place of a surface.
QuadComplex torus_of(const remesh::FluxSurface& surface, std::int32_t rows, std::int32_t columns, Memory& memory) {
  QuadComplex out(memory);
  const std::int32_t count = rows * columns;
  out.twin.assign(4 * count, -1);
  out.tail.assign(4 * count, 0);
  out.feature.assign(4 * count, 0);
  remesh::SurfacePoint point;
  point.triangle = 0;
  point.weight[0] = 1;
  out.vertices.add_vertex(point, position_of(surface, point), remesh::QuadMesh::free, false, 1);
  for (std::int32_t i = 0; i < rows; ++i) {
    for (std::int32_t j = 0; j < columns; ++j) {
      const std::int32_t q = i * columns + j, right = i * columns + (j + 1) % columns,
                         above = (i + 1) % rows * columns + j;
      out.join(4 * q + 1, 4 * right + 3);
      out.join(4 * q + 2, 4 * above);
    }
  }
  out.split_fans(memory);
  return out;
}

// A corner of the border belongs to triangles that have no side there.
TEST(FieldQuads, quads_of_triangles_share_their_vertices_and_hold_the_border) {
  const auto core = core_of(samples::plane(6, 5));
  Memory& memory = *core->memory;
  const remesh::FluxSurface surface = remesh::FluxSurface::make(core->mesh, core->topology(), memory);
  const remesh::Table<std::uint8_t> features = find_features(surface, 100, memory);
  const QuadComplex quads = split_triangles(surface, features, remesh::Table<std::uint8_t>(1, 1, memory), memory);
  EXPECT_EQ(quads.quad_count(), 3 * surface.real_triangles);
  EXPECT_EQ(quads.vertices.position.size(),
            core->mesh.vertex_count() + core->topology().edge_count() + core->mesh.triangle_count());
  std::int32_t at_border = 0;
  for (std::int32_t v = 0; v < quads.vertices.position.size(); ++v) {
    EXPECT_EQ(quads.vertices.pinned[v] == remesh::QuadMesh::feature, quads.vertices.border[v] != 0) << v;
    at_border += quads.vertices.border[v] != 0;
  }
  EXPECT_GT(at_border, 20);
}

// What every mesh of quads goes through before a caller sees it must be able to refuse one.
TEST(FieldQuads, the_check_refuses_each_fault) {
  Memory memory;
  const auto cube = [&] {
    remesh::QuadMesh mesh(memory);
    for (int v = 0; v < 8; ++v) mesh.add_vertex({}, {v & 1 ? 1.0 : 0, v & 2 ? 1.0 : 0, v & 4 ? 1.0 : 0}, 0, false, 1);
    for (const int v : {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5})
      mesh.corner.push_back(v);
    return mesh;
  };
  const auto is_refused = [&](const remesh::QuadMesh& mesh, std::int32_t euler_characteristic) {
    try {
      remesh::check_quads(mesh, euler_characteristic, memory);
    } catch (const Error& error) {
      return error.code() == HF_ERROR_INTERNAL;
    }
    return false;
  };
  remesh::QuadMesh mesh = cube();
  EXPECT_FALSE(is_refused(mesh, 2));
  EXPECT_TRUE(is_refused(mesh, 1)) << "another Euler characteristic";
  std::swap(mesh.corner[1], mesh.corner[3]);
  EXPECT_TRUE(is_refused(mesh, 2)) << "a face that is turned over";
  remesh::QuadMesh twice(memory);  // each directed edge once, and the Euler characteristic is right
  for (int v = 0; v < 3; ++v) twice.add_vertex({}, {1.0 * v, 0, 0}, 0, false, 1);
  for (const int v : {0, 1, 0, 2}) twice.corner.push_back(v);
  EXPECT_TRUE(is_refused(twice, 2)) << "a corner twice";
  mesh = cube();
  mesh.corner.resize(20, 0);
  EXPECT_FALSE(is_refused(mesh, 1)) << "a border";
}

TEST(FieldQuads, one_or_two_edges_around_a_thin_part_become_three) {
  const auto core = core_of(samples::sphere(8));
  Memory& memory = *core->memory;
  const remesh::FluxSurface surface = remesh::FluxSurface::make(core->mesh, core->topology(), memory);
  for (const std::int32_t columns : {1, 2, 3}) {
    QuadComplex quads = torus_of(surface, 6, columns, memory);
    EXPECT_EQ(quads.vertices.position.size(), 6 * columns);
    RepairReport report;
    repair_quads(surface, quads, report, memory);
    EXPECT_EQ(report.removed, 0);
    EXPECT_EQ(report.added > 0, columns < 3) << columns;
    remesh::check_quads(quads.mesh(memory), 0, memory);
  }
}

TEST(FieldQuads, chords_are_removed_until_the_number_is_reached_or_rings_of_four_are_left) {
  const auto core = core_of(samples::sphere(8));
  Memory& memory = *core->memory;
  const remesh::FluxSurface surface = remesh::FluxSurface::make(core->mesh, core->topology(), memory);
  QuadComplex quads = torus_of(surface, 12, 8, memory);
  collapse_chords(quads, 64, 0, memory);
  EXPECT_LE(quads.quad_count(), 64);
  EXPECT_GE(quads.quad_count(), 64 - 12);
  remesh::check_quads(quads.mesh(memory), 0, memory);
  collapse_chords(quads, 0, 0, memory);
  EXPECT_EQ(quads.quad_count(), 16);
  remesh::check_quads(quads.mesh(memory), 0, memory);
}

TEST(FieldQuads, chords_go_where_the_mesh_stays_valid_only) {
  for (const auto& [name, core] : shapes()) {
    Memory& memory = *core->memory;
    const remesh::FluxSurface surface = remesh::FluxSurface::make(core->mesh, core->topology(), memory);
    const remesh::Table<std::uint8_t> all(surface.component_count, 1, memory);
    const remesh::Table<std::uint8_t> features(surface.half_count(), 0, memory);
    QuadComplex quads = split_triangles(surface, features, all, memory);
    EXPECT_EQ(quads.quad_count(), 3 * surface.real_triangles) << name;
    expect_valid(*core, quads.mesh(memory), name);
    const std::int32_t before = quads.quad_count();
    EXPECT_GT(collapse_chords(quads, before / 2, 0, memory), 0) << name;
    EXPECT_LT(quads.quad_count(), before) << name;
    expect_valid(*core, quads.mesh(memory), name);
  }
}

void add_point(samples::ShapeMesh& mesh, double x, double y, double z) {
  for (const double value : {x, y, z}) mesh.positions.push_back(value);
}

// Rings of `corners` vertices around one vertex. Every chord beside the hub would walk all of its quads.
samples::ShapeMesh fan_of(std::uint32_t corners, std::uint32_t rings) {
  samples::ShapeMesh mesh;
  add_point(mesh, 0, 0, 1);
  for (std::uint32_t r = 1; r <= rings; ++r) {
    for (std::uint32_t i = 0; i < corners; ++i) {
      const double turn = 6.283185307179586 * i / corners;
      add_point(mesh, r * std::cos(turn), r * std::sin(turn), 0);
    }
  }
  const auto number = [&](std::uint32_t r, std::uint32_t i) {
    return r == 0 ? 0 : 1 + (r - 1) * corners + i % corners;
  };
  for (std::uint32_t r = 0; r < rings; ++r) {
    for (std::uint32_t i = 0; i < corners; ++i) {
      for (const std::uint32_t v : {number(r, i), number(r + 1, i), number(r + 1, i + 1)}) mesh.triangles.push_back(v);
      if (r == 0) continue;
      for (const std::uint32_t v : {number(r, i), number(r + 1, i + 1), number(r, i + 1)}) mesh.triangles.push_back(v);
    }
  }
  return mesh;
}

TEST(FieldQuads, chords_beside_hubs_leave_valid_meshes_too) {
  auto meshes = shapes();
  meshes.emplace_back("fan", core_of(fan_of(600, 1)));
  meshes.emplace_back("three rings", core_of(fan_of(300, 3)));
  for (const auto& [name, core] : meshes) {
    Memory& memory = *core->memory;
    const remesh::FluxSurface surface = remesh::FluxSurface::make(core->mesh, core->topology(), memory);
    const remesh::Table<std::uint8_t> all(surface.component_count, 1, memory);
    const remesh::Table<std::uint8_t> features = find_features(surface, HUGE_VAL, memory);
    std::int32_t removed[2] = {0, 0};
    // With a limit of 3 most vertices are hubs, so that what the whole walk refuses is refused without it as well.
    // The quick form leaves out what lies between.
    const bool full = hf_test::is_full();
    for (const std::int32_t hub : {3, 5, 8, 1000000}) {
      for (const std::int32_t share : {2, 8, 64}) {
        if (!full && (hub == 5 || share == 2)) continue;
        QuadComplex quads = split_triangles(surface, features, all, memory);
        const std::int32_t count = collapse_chords(quads, quads.quad_count() / share, 0, memory, hub);
        expect_valid(*core, quads.mesh(memory), name);
        if (share == 8) removed[hub > 8] += count;
      }
    }
    EXPECT_GT(removed[0], 0) << name;
    std::printf("%s: %d chords removed with three small limits, %d without\n", name.c_str(), removed[0], removed[1]);
  }
}

// A triangle touches few of the cells in its box of the grid if it is long and thin.
TEST(FieldQuads, long_thin_triangles_take_the_memory_of_what_they_touch) {
  const auto core = core_of(fan_of(2000, 1));
  const Stages stages(core);
  GridMapper mapper = stages.mapper();
  const GridMap map = mapper.make(0.005);
  const std::uint64_t before = core->memory->peak_bytes();
  std::int32_t backward = 0;
  const QuadComplex quads = extract_quads(stages.surface, map, stages.features, backward, *core->memory);
  EXPECT_GT(quads.quad_count(), 10000);
  EXPECT_LT(static_cast<double>(core->memory->peak_bytes() - before), 1e8);
}

// Two zigzag borders face each other, and each of their edges is a line of its own.
TEST(FieldQuads, the_shortest_of_too_many_lines_of_features_need_not_be_whole) {
  const std::uint32_t half = 3000;
  samples::ShapeMesh comb;
  for (std::uint32_t side = 0; side < 2; ++side) {
    for (std::uint32_t k = 0; k < half; ++k) add_point(comb, k, side == 0 ? 3 * (k % 2) : 9 + k % 2, 0);
  }
  for (std::uint32_t k = 0; k + 1 < half; ++k) {
    for (const std::uint32_t v : {k, k + 1, half + k, k + 1, half + k + 1, half + k}) comb.triangles.push_back(v);
  }
  const Stages stages(core_of(comb));
  GridMapper mapper = stages.mapper();
  EXPECT_GT(mapper.left_out(), 1000);
  const GridMap map = mapper.make(0.01);
  EXPECT_LE(map.roundings, 1024 + 2 * stages.seams.parameter_count);
  EXPECT_GE(map.roundings, 1024);
}

TEST(FieldQuads, thin_parts_keep_their_handles_at_any_number_of_faces) {
  for (const auto& [name, core] : shapes()) {
    for (const std::int32_t wanted : {150, 400, 4000}) {
      FieldQuadOptions options;
      options.core = core;
      options.faces = wanted;
      FieldQuadReport report;
      const QuadResult result = make_field_quads(options, &report);
      expect_valid(*core, result.mesh, name);
      std::printf("%s: wanted %d, %d faces, substitutes %d, split %d, added %d, removed %d\n", name.c_str(), wanted,
                  result.mesh.face_count(), report.substitutes, report.split, report.added, report.removed);
      EXPECT_NEAR(result.mesh.face_count(), wanted, wanted / 20) << name;
    }
  }
}

TEST(FieldQuads, handles_thinner_than_an_edge_become_valid_meshes) {
  const auto core = hf_test::make_core(hf_test::ladder(5, 0.16));
  std::int32_t repaired = 0;
  for (const std::int32_t wanted : {20, 60, 120}) {
    FieldQuadOptions options;
    options.core = core;
    options.faces = wanted;
    FieldQuadReport report;
    const QuadResult result = make_field_quads(options, &report);
    expect_valid(*core, result.mesh, "ladder");
    std::printf("ladder of genus 5: wanted %d, %d faces, substitutes %d, split %d, added %d, chords %d\n", wanted,
                result.mesh.face_count(), report.substitutes, report.split, report.added, report.chords);
    repaired += report.substitutes + report.added;
  }
  EXPECT_GT(repaired, 0);
}

TEST(FieldQuads, small_components_with_borders_become_valid_meshes) {
  // A sphere, and sheets that are far smaller than the wanted edges.
  const samples::ShapeMesh ball = samples::sphere(16);
  hf_test::PlainMesh mesh{ball.positions, ball.triangles};
  hf_test::append(mesh, hf_test::grid(2, 1, 0.01, 0), 3);
  hf_test::PlainMesh ring = hf_test::torus(8, 6);
  for (double& x : ring.positions) x *= 0.01;
  hf_test::append(mesh, ring, 6);
  const auto core = hf_test::make_core(mesh);
  FieldQuadOptions options;
  options.core = core;
  options.faces = 400;
  FieldQuadReport report;
  const QuadResult result = make_field_quads(options, &report);
  expect_valid(*core, result.mesh, "components");
  EXPECT_GT(report.substitutes, 0);
}

TEST(FieldQuads, stops_when_it_is_cancelled) {
  Progress progress;
  FieldQuadOptions options;
  options.core = core_of(samples::sphere(24));
  const CallProgress call(&progress);
  progress.cancel();
  try {
    make_field_quads(options);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), HF_ERROR_CANCELLED);
  }
}

}  // namespace

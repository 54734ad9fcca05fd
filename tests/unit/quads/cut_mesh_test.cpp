// Surfaces of long triangles: they are cut, stay the same surface, and their quads are those of a fine one.
#include "quads/cut_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "support/meshes.h"
#include "support/quad_oracle.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::quads;

// A box of 12 triangles.
hf_test::PlainMesh box(double x, double y, double z) {
  hf_test::PlainMesh mesh;
  for (int i = 0; i < 8; ++i) {
    for (const double p : {i & 1 ? x : 0.0, i & 2 ? y : 0.0, i & 4 ? z : 0.0}) mesh.positions.push_back(p);
  }
  mesh.triangles = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                    2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  return mesh;
}

double area_of(const std::vector<Vec3>& p, const Index* c) {
  return 0.5 * norm(cross(p[at(c[1])] - p[at(c[0])], p[at(c[2])] - p[at(c[0])]));
}

TEST(CutMesh, is_the_same_surface_with_short_edges) {
  for (const hf_test::PlainMesh& mesh : {box(1, 2, 0.1), hf_test::torus(9, 5), hf_test::grid(3, 1, 1, 0.4)}) {
    const auto core = hf_test::make_core(mesh);
    const double longest = 0.07;
    const CutMesh cut = CutMesh::make(*core, longest, 1000000);
    const std::vector<Vec3> position(cut.position.begin(), cut.position.end());
    ASSERT_GT(cut.parent.size(), at(core->mesh.triangle_count()));
    std::vector<double> area(at(core->mesh.triangle_count()), 0.0);
    for (std::size_t t = 0; t < cut.parent.size(); ++t) {
      const Index* c = &cut.corner[3 * t];
      area[at(cut.parent[t])] += area_of(position, c);
      const Index* parent = core->mesh.triangle(cut.parent[t]);
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_LE(norm(position[at(c[(k + 1) % 3])] - position[at(c[k])]), longest);
        Vec3 p;
        for (int j = 0; j < 3; ++j) p = p + cut.weight[t].of[k][j] * core->mesh.positions[at(parent[j])];
        EXPECT_LT(norm(p - position[at(c[k])]), 1e-15);
      }
    }
    for (std::size_t t = 0; t < area.size(); ++t) {
      const std::vector<Vec3> whole(core->mesh.positions.begin(), core->mesh.positions.end());
      EXPECT_NEAR(area[t], area_of(whole, core->mesh.triangle(static_cast<Index>(t))), 1e-14);
    }
    // Neighbours share their new vertices: the same Euler characteristic and borders as long.
    hf_test::PlainMesh fine;
    for (const Vec3& p : cut.position) {
      for (const double x : {p.x, p.y, p.z}) fine.positions.push_back(x);
    }
    fine.triangles.assign(cut.corner.begin(), cut.corner.end());
    const auto fine_core = hf_test::make_core(fine);
    const auto euler = [](const surface::Core& c) {
      return c.mesh.vertex_count() - c.topology().edge_count() + c.mesh.triangle_count();
    };
    const auto border = [](const surface::Core& c) {
      double sum = 0;
      for (Index e = 0; e < c.topology().edge_count(); ++e) {
        if (c.topology().edge_triangle_start[at(e) + 1] - c.topology().edge_triangle_start[at(e)] != 1) continue;
        sum += norm(c.mesh.positions[at(c.topology().first(e))] - c.mesh.positions[at(c.topology().second(e))]);
      }
      return sum * c.mesh.scale;
    };
    EXPECT_EQ(euler(*fine_core), euler(*core));
    EXPECT_NEAR(border(*fine_core), border(*core) / core->mesh.scale, 1e-12);
    // The pieces of every edge, from one end to the other.
    for (Index e = 0; e < core->topology().edge_count(); ++e) {
      const Index first = core->topology().first(e), last = core->topology().second(e);
      Index here = first;
      double length = 0;
      cut.for_pieces(first, last, [&](Index a, Index b) {
        EXPECT_EQ(a, here);
        here = b;
        length += norm(position[at(b)] - position[at(a)]);
      });
      EXPECT_EQ(here, last);
      EXPECT_NEAR(length, norm(position[at(last)] - position[at(first)]), 1e-14);
    }
  }
}

TEST(CutMesh, has_no_more_triangles_than_allowed_and_the_longest_edges_go_first) {
  const auto core = hf_test::make_core(box(1, 2, 0.01));
  std::size_t before = 0;
  for (const Index most : {12, 40, 200, 2000}) {
    const CutMesh cut = CutMesh::make(*core, 1e-4, most);
    EXPECT_LE(cut.parent.size(), at(most));
    EXPECT_GE(cut.parent.size(), before);
    before = cut.parent.size();
  }
  EXPECT_GT(before, std::size_t{200});
}

TEST(CutQuads, lie_on_the_triangles_they_name) {
  for (const bool symmetric : {false, true}) {
    const auto core = hf_test::make_core(box(1, 1.5, 0.7));
    FieldQuadOptions options;
    options.core = core;
    options.faces = 600;
    options.crease = 0.7;
    if (symmetric) options.plane = mesh::MirrorPlane{{1, 0, 0}, 0};
    ASSERT_TRUE(is_coarse(coarse_part(*core, 0.05)));
    const QuadResult result = make_field_quads(options);
    hf_test::expect_manifold(*core, result.mesh, "box");
    EXPECT_NEAR(result.mesh.face_count(), 600, 30);
    for (Index v = 0; v < result.mesh.position.size(); ++v) {
      const remesh::SurfacePoint& point = result.mesh.location[v];
      Vec3 p;
      double sum = 0;
      for (int k = 0; k < 3; ++k) {
        EXPECT_GE(point.weight[k], -1e-12);
        p = p + point.weight[k] * core->mesh.positions[at(core->mesh.triangle(point.triangle)[k])];
        sum += point.weight[k];
      }
      EXPECT_NEAR(sum, 1, 1e-12);
      EXPECT_LT(norm(p - result.mesh.position[v]), 1e-9);
    }
    // Creases are kept: every quad lies in one side of the box, and all corners of the box are corners of quads.
    for (Index f = 0; f < result.mesh.face_count(); ++f) {
      const Index* c = result.mesh.quad(f);
      const auto p = [&](int k) { return core->mesh.to_given(result.mesh.position[c[k]]); };
      const Vec3 n = unit_vector(cross(p(2) - p(0), p(3) - p(1)));
      EXPECT_GT(std::max({std::fabs(n.x), std::fabs(n.y), std::fabs(n.z)}), 1 - 1e-9) << f;
    }
    for (const Vec3& corner : core->mesh.positions) {
      double least = 1;
      for (const Vec3& p : result.mesh.position) least = std::min(least, norm(p - corner));
      EXPECT_LT(least, 1e-9);
    }
  }
}

// Triangles of a torus that are many quads long: the map must bend inside them.
TEST(CutQuads, of_long_triangles_are_square) {
  const auto core = hf_test::make_core(hf_test::torus(14, 6, 0));
  FieldQuadOptions options;
  options.core = core;
  options.faces = 3000;
  const QuadResult result = make_field_quads(options);
  hf_test::expect_manifold(*core, result.mesh, "torus");
  std::vector<double> sines;
  for (Index f = 0; f < result.mesh.face_count(); ++f) {
    const Index* c = result.mesh.quad(f);
    for (int k = 0; k < 4; ++k) {
      const Vec3 p = result.mesh.position[c[k]];
      sines.push_back(norm(cross(unit_vector(result.mesh.position[c[(k + 1) % 4]] - p),
                                 unit_vector(result.mesh.position[c[(k + 3) % 4]] - p))));
    }
  }
  std::sort(sines.begin(), sines.end());
  EXPECT_GT(sines[sines.size() / 20], std::cos(25 * 3.14159265358979 / 180));
}

TEST(CutQuads, of_an_update_are_those_of_a_new_mesh) {
  const auto core = hf_test::make_core(box(1, 1.5, 0.7));
  QuadKeeper kept;
  std::vector<QuadGuide> guides;
  std::vector<Index> creases;
  FieldQuadOptions options;
  options.core = core;
  options.faces = 700;
  options.relax = 5;
  const auto same = [&](const char* what) {
    options.guides = {guides.data(), guides.size()};
    options.crease_edges = {creases.data(), creases.size()};
    const QuadResult a = make_field_quads(options, nullptr, &kept), b = make_field_quads(options);
    ASSERT_EQ(a.mesh.face_count(), b.mesh.face_count()) << what;
    for (Index v = 0; v < a.mesh.position.size(); ++v)
      ASSERT_EQ(norm(a.mesh.position[v] - b.mesh.position[v]), 0) << what;
  };
  same("alone");
  guides.push_back({0, {1, 0.4, 0}, 1, 0});
  same("with a guide");
  creases.push_back(core->topology().edge_between(core->mesh.inner_of_given[0], core->mesh.inner_of_given[1]));
  ASSERT_GE(creases[0], 0);
  same("with a crease");
  options.faces = 900;
  same("with another number");
  options.plane = mesh::MirrorPlane{{1, 0, 0}, 0};
  guides.clear();
  same("with a plane");
}

// A ring too thin for the quads needs shorter edges. Then the surface as it is gets them, not its cut triangles.
TEST(CutQuads, of_a_component_that_needs_shorter_edges_come_from_the_surface_as_it_is) {
  hf_test::PlainMesh mesh = box(1, 1.5, 0.7);
  const std::uint32_t first = static_cast<std::uint32_t>(mesh.positions.size() / 3), around = 16, across = 3;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      const double a = 2 * 3.14159265358979 * i / around, b = 2 * 3.14159265358979 * j / across;
      const double r = 1 + 0.02 * std::cos(b);
      for (const double x : {4 + r * std::cos(a), r * std::sin(a), 0.02 * std::sin(b)}) mesh.positions.push_back(x);
      const auto at = [&](std::uint32_t k, std::uint32_t l) { return first + (k % around) * across + l % across; };
      for (const std::uint32_t v : {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)})
        mesh.triangles.push_back(v);
    }
  }
  const auto core = hf_test::make_core(mesh);
  FieldQuadOptions options;
  options.core = core;
  options.faces = 300;
  options.relax = 5;
  const double length = 0.14 / core->mesh.scale;
  ASSERT_TRUE(is_coarse(coarse_part(*core, length)));
  FieldQuadReport report;
  QuadKeeper kept;
  const QuadResult result = make_field_quads(options, &report), again = make_field_quads(options, nullptr, &kept);
  EXPECT_GT(report.substitutes, 0);
  hf_test::expect_manifold(*core, result.mesh, "ring");
  ASSERT_TRUE(kept.cut && kept.whole);  // both were tried
  ASSERT_EQ(again.mesh.face_count(), result.mesh.face_count());
  for (Index v = 0; v < result.mesh.position.size(); ++v)
    ASSERT_EQ(norm(result.mesh.position[v] - again.mesh.position[v]), 0);
}

// A pole gets a ring of small triangles, where the surface has long ones.
TEST(CutQuads, hold_poles_on_long_triangles) {
  const auto core = hf_test::make_core(box(1, 1.5, 0.7));
  const double edge = 0.03;
  int held = 0;
  for (int i = 0; i < 4; ++i) {
    const Vec3 place = core->mesh.to_inner({0.3 + 0.1 * i, 0.4 + 0.2 * i, 0});
    std::vector<QuadPole> poles{{place, 3, {1, 0, 0}}};
    FieldQuadOptions options;
    options.core = core;
    options.edge_length = edge;
    options.relax = 0;
    options.poles = {poles.data(), poles.size()};
    const QuadResult result = make_field_quads(options);
    std::vector<std::int32_t> valence(at(result.mesh.position.size()), 0);
    for (const Index v : result.mesh.corner) ++valence[at(v)];
    for (Index v = 0; v < result.mesh.position.size(); ++v)
      held += valence[at(v)] == 3 && norm(result.mesh.position[v] - place) < 0.02 * edge;
  }
  EXPECT_GE(held, 4);
}

}  // namespace

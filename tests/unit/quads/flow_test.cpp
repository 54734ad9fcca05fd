// Flux lines as the exact discrete flow they are: balanced, rising, never crossing, and back where they came from.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "assets/shapes.h"
#include "remesh/arcs.h"
#include "remesh/flow_lines.h"
#include "remesh/flux_sites.h"
#include "support/meshes.h"

namespace {

using namespace hf_inner;

hf_test::PlainMesh plain(const samples::ShapeMesh& shape) { return {shape.positions, shape.triangles}; }

// A surface with a source at its first vertex, a sink at its last and one half way.
struct Flow {
  explicit Flow(const hf_test::PlainMesh& mesh, double apex_weight = 30)
      : core(hf_test::make_core(mesh)),
        memory(*core->memory),
        surface(FluxSurface::make(core->mesh, core->topology, apex_weight, memory)),
        sites(&memory) {
    sites.push_back({0, -12}), sites.push_back({surface.first_apex / 2, 4}),
        sites.push_back({surface.first_apex - 1, 8});
    const FluxSolver solver(surface, memory, *core->jobs);
    field.emplace(surface, solver.solve(sites), memory);
  }
  bool is_site(std::int32_t v) const {
    return std::any_of(sites.begin(), sites.end(), [&](const FluxSite& site) { return site.vertex == v; });
  }
  std::shared_ptr<const Core> core;
  Memory& memory;
  FluxSurface surface;
  Vector<FluxSite> sites;
  std::optional<FluxField> field;
};

hf_test::PlainMesh bumpy_torus() { return plain(samples::jittered_torus(60, 40, 0.35)); }

TEST(Flux, BalancesEveryVertexButTheSitesAndHasExtremaOnlyThere) {
  const Flow flow(bumpy_torus());
  std::int32_t index = 0;
  for (std::int32_t v = 0; v < flow.surface.vertex_count(); ++v) {
    const std::int32_t changes = flow.field->sign_changes(v);
    EXPECT_EQ(changes == 0, flow.is_site(v)) << v;
    if (changes > 2) index += changes / 2 - 1;
    if (flow.is_site(v)) continue;
    EXPECT_LT(std::fabs(flow.field->imbalance(v)), 1e-9) << v;
  }
  EXPECT_EQ(index, 3 - 0);  // saddles: sites less the Euler characteristic
}

TEST(Flux, TenThousandLinesRiseAndComeBackWhenReversed) {
  const Flow flow(bumpy_torus());
  const FluxSurface& s = flow.surface;
  std::int32_t traced = 0, passed_saddles = 0;
  for (std::int32_t round = 0; traced < 10000; ++round) {
    for (std::int32_t h = 0; h < s.half_count() && traced < 10000; ++h) {
      if (!flow.field->rises(h)) continue;
      ++traced;
      // an offset that differs by edge and round
      const double share = std::fmod(0.5 + 0.618033988749895 * (h + 7 * round), 1.0);
      FluxPoint p{h, share * flow.field->flux(h)};
      std::vector<FluxPoint> way{p};
      for (int step = 0; step < 60; ++step) {
        const std::int32_t v = s.head(p.half);
        p = flow.field->up(p);
        if (p.half < 0) break;
        ASSERT_EQ(s.tail[p.half], v);
        ASSERT_TRUE(flow.field->rises(p.half));
        ASSERT_LE(p.offset, flow.field->flux(p.half) * (1 + 1e-12));
        passed_saddles += flow.field->sign_changes(v) > 2;
        way.push_back(p);
      }
      p = way.back();
      for (std::size_t k = way.size() - 1; k-- > 0;) {
        p = flow.field->down(p);
        ASSERT_EQ(p.half, way[k].half);
        ASSERT_NEAR(p.offset, way[k].offset, 1e-9 * flow.field->flux(p.half) + 1e-12);
      }
    }
  }
  EXPECT_GT(passed_saddles, 20);
}

TEST(Flux, LinesKeepTheirOrderFromLoopToLoop) {
  const Flow flow(bumpy_torus());
  Memory& memory = flow.memory;
  const ArcGraph graph(*flow.field, memory);
  Table<std::int32_t> low(memory), high(memory);
  std::int32_t compared = 0;
  for (const Arc& arc : graph.arcs) {
    const std::int32_t size = arc.last - arc.first;
    if (size < 30) continue;
    const Loop below = graph.loop(*flow.field, arc, size / 4), above = graph.loop(*flow.field, arc, 3 * size / 4);
    walk_loop(*flow.field, below, low), walk_loop(*flow.field, above, high);
    double flux = 0;
    for (const std::int32_t h : low) flux += flow.field->flux(h);
    EXPECT_NEAR(flux, arc.flux, 1e-9 * arc.flux);  // conserved along the arc
    // three lines per edge, by their flux coordinate on the loop above
    std::vector<double> coordinate;
    for (const std::int32_t h : low) {
      for (const double share : {0.2, 0.5, 0.8}) {
        FluxPoint p{h, share * flow.field->flux(h)};
        while (flow.field->rank(flow.surface.head(p.half)) < above.threshold) p = flow.field->up(p);
        double sum = 0;
        bool found = false;
        for (const std::int32_t g : high) {
          if (g == p.half) {
            found = true;
            break;
          }
          sum += flow.field->flux(g);
        }
        ASSERT_TRUE(found);
        coordinate.push_back(sum + p.offset);
      }
    }
    // rising but for one step back to the start of the loop
    int falls = 0;
    for (std::size_t k = 0; k < coordinate.size(); ++k)
      falls += coordinate[(k + 1) % coordinate.size()] <= coordinate[k];
    EXPECT_EQ(falls, 1);
    ++compared;
  }
  EXPECT_GE(compared, 3);
}

TEST(Flux, ArcsPartTheRegularVertices) {
  const Flow flow(bumpy_torus());
  const ArcGraph graph(*flow.field, flow.memory);
  std::vector<int> seen(static_cast<std::size_t>(flow.surface.vertex_count()), 0);
  for (const std::int32_t v : graph.vertices) ++seen[static_cast<std::size_t>(v)];
  for (const std::int32_t v : graph.critical) ++seen[static_cast<std::size_t>(v)];
  for (const int count : seen) EXPECT_EQ(count, 1);
  for (const Arc& arc : graph.arcs) {
    for (std::int32_t k = arc.first + 1; k < arc.last; ++k)
      ASSERT_LT(flow.field->rank(graph.vertices[k - 1]), flow.field->rank(graph.vertices[k]));
  }
  // as many arcs as a Reeb graph of a torus with three extrema has: one loop more than a tree
  EXPECT_EQ(graph.arcs.size(), graph.critical.size() - 1 + 1);
}

TEST(FluxSurface, ClosesBordersTurnsTrianglesAndPartsFans) {
  hf_test::PlainMesh mesh = hf_test::grid(6, 5);
  std::swap(mesh.triangles[0], mesh.triangles[1]);  // one triangle turned over
  // two more, that touch the sheet in its first vertex only
  const std::uint32_t n = mesh.vertex_count();
  mesh.positions.insert(mesh.positions.end(), {-1, 0, 0, -1, -1, 0});
  mesh.triangles.insert(mesh.triangles.end(), {0, n, n + 1});
  const auto core = hf_test::make_core(mesh);
  const FluxSurface s = FluxSurface::make(core->mesh, core->topology, 1, *core->memory);
  EXPECT_EQ(s.first_apex, static_cast<std::int32_t>(n) + 2 + 1);  // the shared vertex is two
  EXPECT_EQ(s.vertex_count() - s.first_apex, 2);                  // a border each
  EXPECT_EQ(s.component_count, 2);
  EXPECT_EQ(s.euler_characteristic, 2);
  for (std::int32_t h = 0; h < s.half_count(); ++h) {
    ASSERT_EQ(s.twin[s.twin[h]], h);
    ASSERT_EQ(s.tail[s.twin[h]], s.head(h));
    ASSERT_EQ(s.weight[h], s.weight[s.twin[h]]);
    ASSERT_GT(s.weight[h], 0);
  }
}

hf_test::PlainMesh moebius_band(std::uint32_t n) {
  hf_test::PlainMesh mesh;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double a = 2 * std::acos(-1.0) * i / n;
    for (const double r : {-0.3, 0.3})
      mesh.positions.insert(mesh.positions.end(), {(1 + r * std::cos(a / 2)) * std::cos(a),
                                                   (1 + r * std::cos(a / 2)) * std::sin(a), r * std::sin(a / 2)});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = 2 * i, b = a + 1;
    const std::uint32_t c = i + 1 < n ? a + 2 : 1, d = i + 1 < n ? a + 3 : 0;
    mesh.triangles.insert(mesh.triangles.end(), {a, b, c, b, d, c});
  }
  return mesh;
}

TEST(FluxSurface, AMoebiusBandIsPartedOnceWhereItsTrianglesDisagree) {
  for (const std::uint32_t begin : {0u, 5u, 20u}) {
    hf_test::PlainMesh mesh = moebius_band(12);
    std::rotate(mesh.triangles.begin(), mesh.triangles.begin() + 3 * begin, mesh.triangles.end());
    const auto core = hf_test::make_core(mesh);
    const FluxSurface s = FluxSurface::make(core->mesh, core->topology, 1, *core->memory);
    EXPECT_EQ(s.euler_characteristic, 1);           // a disc
    EXPECT_EQ(s.vertex_count() - s.first_apex, 1);  // with one border
    EXPECT_EQ(s.first_apex, 2 * 12 + 2);            // the two vertices where it is parted are there twice
    // The first edge is where the last square meets the first one, turned over.
    std::int32_t parted = 0;
    for (std::int32_t h = 0; h < 3 * s.real_triangles; ++h) {
      const std::int32_t a = s.mesh_vertex[s.tail[h]], b = s.mesh_vertex[s.head(h)];
      const bool border = !s.is_real(s.twin[h]);
      parted += border && ((a == 0 && b == 1) || (a == 1 && b == 0));
    }
    EXPECT_EQ(parted, 2) << begin;
  }
}

// So few squares that the cut is more than 5 % of the edges.
TEST(FluxSurface, ASurfaceThatIsMostlyMoebiusBandsIsRefused) {
  hf_test::PlainMesh mesh;
  for (int k = 0; k < 3; ++k) hf_test::append(mesh, moebius_band(5), 3.0 * k);
  const auto core = hf_test::make_core(mesh);
  try {
    FluxSurface::make(core->mesh, core->topology, 1, *core->memory);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), HF_ERROR_UNSUPPORTED);
    EXPECT_LT(error.index(), 30u);
  }
}

TEST(FlowLines, OfAHeightAreStraightUpAndEvenInFlux) {
  // an open tube: u = height is harmonic there, so lines run up the sides
  hf_test::PlainMesh mesh;
  const std::uint32_t around = 24, rings = 21;
  for (std::uint32_t j = 0; j < rings; ++j)
    for (std::uint32_t i = 0; i < around; ++i) {
      const double a = 2 * std::acos(-1.0) * i / around;
      mesh.positions.insert(mesh.positions.end(), {std::cos(a), 0.25 * j, std::sin(a)});
    }
  for (std::uint32_t j = 0; j + 1 < rings; ++j)
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::uint32_t a = j * around + i, b = j * around + (i + 1) % around;
      mesh.triangles.insert(mesh.triangles.end(), {a, a + around, b, b, a + around, b + around});
    }
  const auto core = hf_test::make_core(mesh);
  const FlowTracer tracer(core);
  std::vector<double> u;
  for (const Vec3& p : core->mesh.positions) u.push_back(p.y);
  const std::vector<std::int32_t> seeds = {10 * 24 + 5};
  const FlowLineSet lines = tracer.trace(u, 0, seeds);
  ASSERT_EQ(lines.from.size(), 1u);
  const Vec3 at = core->mesh.positions[10 * 24 + 5];
  for (std::size_t k = 0; k < lines.point.size(); ++k) {
    EXPECT_NEAR(lines.point[k].x, at.x, 0.03);
    EXPECT_NEAR(lines.point[k].z, at.z, 0.03);
    EXPECT_GT(lines.value[k], k ? lines.value[k - 1] : -1e300);
  }
  EXPECT_GE(lines.point.size(), 20u);
}

}  // namespace

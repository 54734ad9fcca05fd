// Flux lines as the exact discrete flow they are: balanced, rising, never crossing, and back where they came from.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "assets/shapes.h"
#include "remesh/streamlines.h"
#include "support/dense.h"
#include "support/meshes.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::remesh;

hf_test::PlainMesh plain(const samples::ShapeMesh& shape) { return {shape.positions, shape.triangles}; }

// A harmonic field with a source at its first vertex, a sink at its last and one half way: K u = lines.
struct Flow {
  explicit Flow(const hf_test::PlainMesh& mesh)
      : core(hf_test::make_core(mesh)),
        memory(*core->memory),
        surface(FluxSurface::make(core->mesh, core->topology(), *core->memory)) {
    const std::int32_t n = surface.vertex_count();
    sites = {0, n / 2, n - 1};
    std::vector<hf_test::SparseEntry> entries;
    for (std::int32_t h = 0; h < surface.half_count(); ++h) {
      entries.push_back({surface.tail[h], surface.tail[h], surface.weight[h]});
      entries.push_back({surface.tail[h], surface.head(h), -surface.weight[h]});
    }
    entries.push_back({0, 0, surface.weight[surface.out[0]]});  // holds the first vertex at 0
    std::vector<double> lines(static_cast<std::size_t>(n), 0.0);
    const double flows[] = {-12, 4, 8};
    for (std::size_t i = 0; i < sites.size(); ++i) lines[static_cast<std::size_t>(sites[i])] = flows[i];
    const std::vector<double> u = hf_test::sparse_solve(n, entries, lines.data());
    field.emplace(surface, Span<const double>(u.data(), static_cast<std::size_t>(n)), memory);
  }
  bool is_site(std::int32_t v) const { return std::find(sites.begin(), sites.end(), v) != sites.end(); }
  // (outflow - inflow) / (outflow + inflow)
  double imbalance(std::int32_t v) const {
    double in = 0, out = 0;
    std::int32_t h = surface.out[v];
    do {
      (field->rises(h) ? out : in) += field->flux(field->rises(h) ? h : surface.twin[h]);
      h = surface.turn_left(h);
    } while (h != surface.out[v]);
    return (out - in) / (out + in);
  }
  std::shared_ptr<const surface::Core> core;
  Memory& memory;
  FluxSurface surface;
  std::vector<std::int32_t> sites;
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
    EXPECT_LT(std::fabs(flow.imbalance(v)), 1e-9) << v;
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

TEST(FluxSurface, ClosesBordersTurnsTrianglesAndPartsFans) {
  hf_test::PlainMesh mesh = hf_test::grid(6, 5);
  std::swap(mesh.triangles[0], mesh.triangles[1]);  // one triangle turned over
  // two more, that touch the sheet in its first vertex only
  const std::uint32_t n = mesh.vertex_count();
  mesh.positions.insert(mesh.positions.end(), {-1, 0, 0, -1, -1, 0});
  mesh.triangles.insert(mesh.triangles.end(), {0, n, n + 1});
  const auto core = hf_test::make_core(mesh);
  const FluxSurface s = FluxSurface::make(core->mesh, core->topology(), *core->memory);
  EXPECT_EQ(s.first_apex, static_cast<std::int32_t>(n) + 2 + 1);  // the shared vertex is two
  EXPECT_EQ(s.vertex_count() - s.first_apex, 2);                  // a border each
  EXPECT_EQ(s.component_count, 2);
  EXPECT_EQ(s.euler_characteristic, 2);
  for (std::int32_t h = 0; h < s.half_count(); ++h) {
    ASSERT_EQ(s.twin[s.twin[h]], h);
    ASSERT_EQ(s.tail[s.twin[h]], s.head(h));
    ASSERT_EQ(s.weight[h], s.weight[s.twin[h]]);
    ASSERT_EQ(s.weight[h] > 0, !s.is_apex(s.tail[h]) && !s.is_apex(s.head(h)));
  }
}

TEST(FluxSurface, JoinsTheFlattestTrianglesOfAnEdgeHoweverFarTheyLean) {
  hf_test::PlainMesh mesh = hf_test::grid(6, 5);
  const std::uint32_t n = mesh.vertex_count();
  // an edge along x with a triangle to each side, and one that stands on it; all lean far along the edge
  mesh.positions.insert(mesh.positions.end(), {5, 0, 0, 5.1, 0, 0, 6, 0.2, 0, 6, -0.2, 0, 4, 0, 0.2});
  mesh.triangles.insert(mesh.triangles.end(), {n, n + 1, n + 2, n + 1, n, n + 3, n, n + 1, n + 4});
  const auto core = hf_test::make_core(mesh);
  const FluxSurface s = FluxSurface::make(core->mesh, core->topology(), *core->memory);
  const auto place = [&](std::int32_t v) { return core->mesh.to_given(s.position[v]); };
  int flat = 0, standing = 0;
  for (std::int32_t h = 0; h < 3 * s.real_triangles; ++h) {
    const Vec3 a = place(s.tail[h]), b = place(s.head(h)), apex = place(s.tail[FluxSurface::previous(h)]);
    if (std::fabs(a.x + b.x - 10.1) > 1e-9 || std::fabs(a.x - b.x) > 0.1 + 1e-9) continue;
    const bool stands = apex.z > 0.1;
    EXPECT_EQ(s.is_real(s.twin[h]), !stands);
    (stands ? standing : flat) += 1;
  }
  EXPECT_EQ(flat, 2);
  EXPECT_EQ(standing, 1);
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
    const FluxSurface s = FluxSurface::make(core->mesh, core->topology(), *core->memory);
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
    FluxSurface::make(core->mesh, core->topology(), *core->memory);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), HF_ERROR_UNSUPPORTED);
    EXPECT_LT(error.index(), 30u);
  }
}

TEST(Streamlines, OfAHeightAreStraightUpAndEvenInFlux) {
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
  const StreamlineSet lines = tracer.trace(u, 0, seeds);
  ASSERT_EQ(lines.from.size(), 1u);
  const Vec3 at = core->mesh.positions[10 * 24 + 5];
  for (std::size_t k = 0; k < lines.point.size(); ++k) {
    EXPECT_NEAR(lines.point[k].x, at.x, 0.03);
    EXPECT_NEAR(lines.point[k].z, at.z, 0.03);
    EXPECT_GT(lines.value[k], k ? lines.value[k - 1] : -1e300);
  }
  EXPECT_GE(lines.point.size(), 20u);
}

TEST(Streamlines, WhereTheFieldIsFlatAreTheSeedAlone) {
  const auto core = hf_test::make_core(hf_test::grid(8, 8));
  const FlowTracer tracer(core);
  std::vector<double> flat(81, 2.5), plateau;
  for (const Vec3& p : core->mesh.positions) plateau.push_back(std::max(0.0, p.x - core->mesh.positions[0].x - 0.4));
  const std::vector<std::int32_t> seeds = {0, 40, 80};
  const StreamlineSet alone = tracer.trace(flat, 0, seeds);
  ASSERT_EQ(alone.point.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(alone.from[k], seeds[k]);
    EXPECT_EQ(alone.to[k], seeds[k]);
    EXPECT_EQ(alone.value[k], 2.5);
    EXPECT_EQ(norm(alone.point[k] - core->mesh.positions[static_cast<std::size_t>(seeds[k])]), 0);
  }
  EXPECT_EQ(tracer.trace(flat, 10, {}).from.size(), 0u);
  const StreamlineSet lines = tracer.trace(plateau, 0, seeds);
  ASSERT_EQ(lines.from.size(), 3u);
  EXPECT_EQ(lines.start[1], 1u);                       // the seed on the plateau
  EXPECT_GT(lines.point.size() - lines.start[2], 1u);  // the seed at the top
}

}  // namespace

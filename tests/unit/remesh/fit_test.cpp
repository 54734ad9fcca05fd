// Fitting a quad mesh to its surface: refined, coarsened, snapped and measured, it stays a mesh of quads.
#include "remesh/fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "assets/creature.h"
#include "assets/shapes.h"
#include "quads/field_quads.h"
#include "remesh/coarsen.h"
#include "remesh/quad_faults.h"
#include "remesh/refine.h"
#include "remesh/relax.h"
#include "support/creature.h"
#include "support/meshes.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::remesh;

hf_test::PlainMesh plain(const samples::ShapeMesh& shape) { return {shape.positions, shape.triangles}; }

// Quads as they come from the map, with the surface they lie on; scale and pins as in a mesh that was not refined.
struct Made {
  explicit Made(const hf_test::PlainMesh& mesh, double edge_length = 0.05, std::int32_t relax = 0)
      : core(hf_test::make_core(mesh)),
        surface(FluxSurface::make(core->mesh, core->topology(), *core->memory)),
        result([&] {
          quads::FieldQuadOptions options;
          options.core = core;
          options.edge_length = edge_length;
          options.relax = relax;
          return quads::make_field_quads(options);
        }()) {}
  std::shared_ptr<const surface::Core> core;
  FluxSurface surface;
  quads::QuadResult result;
};

// From the faces alone.
void expect_closed_quads(const QuadMesh& mesh, std::int32_t euler_characteristic) {
  std::set<std::pair<std::int32_t, std::int32_t>> directed;
  std::set<std::int32_t> used;
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    std::set<std::int32_t> corners;
    for (std::int32_t k = 0; k < 4; ++k) {
      const std::int32_t a = mesh.quad(f)[k], b = mesh.quad(f)[(k + 1) % 4];
      ASSERT_TRUE(corners.insert(a).second) << "face " << f;
      ASSERT_TRUE(directed.insert({a, b}).second) << a << " -> " << b;
      used.insert(a);
    }
  }
  for (const auto& [a, b] : directed) ASSERT_TRUE(directed.count({b, a})) << a << " -> " << b;
  ASSERT_EQ(static_cast<std::int32_t>(used.size()), mesh.position.size());
  EXPECT_EQ(mesh.position.size() - static_cast<std::int32_t>(directed.size()) / 2 + mesh.face_count(),
            euler_characteristic);
}

void expect_on_surface(const FluxSurface& surface, const QuadMesh& mesh) {
  ASSERT_EQ(mesh.location.size(), mesh.position.size());
  ASSERT_EQ(mesh.scale.size(), mesh.position.size());
  for (std::int32_t v = 0; v < mesh.position.size(); ++v)
    ASSERT_LT(norm(position_of(surface, mesh.location[v]) - mesh.position[v]), 1e-9) << v;
}

TEST(RefineQuads, WhateverIsMarkedTheMeshStaysClosedAndOfQuads) {
  const Made made(plain(samples::jittered_torus(60, 40)));
  Memory& memory = *made.core->memory;
  QuadMesh mesh = made.result.mesh;
  for (std::uint64_t round = 0; round < 3; ++round) {
    const VertexFans fans(mesh, memory);
    Table<std::uint8_t> marked(mesh.position.size(), 0, memory), blocked = marked;
    std::int32_t faces = mesh.face_count(), count = 0;
    for (std::int32_t v = 0; v < mesh.position.size(); ++v) {
      if (blocked[v] || samples::hash_to_unit(round, static_cast<std::uint64_t>(v)) < 0.7) continue;
      marked[v] = 1;
      faces += 2 * fans.valence(v);
      ++count;
      for (std::int32_t i = fans.start[v]; i < fans.start[v + 1]; ++i)
        for (std::int32_t k = 0; k < 4; ++k) blocked[mesh.quad(fans.face[i])[k]] = 1;
    }
    ASSERT_GT(count, 10);
    refine_quads(made.surface, mesh, marked, memory);
    EXPECT_EQ(mesh.face_count(), faces);  // every quad at a marked vertex became three
    expect_closed_quads(mesh, 0);
    expect_on_surface(made.surface, mesh);
  }
}

// Vertices from a sequence that jumps over the mesh, one by one, those of four quads or more.
TEST(SplitVertex, MakesOneQuadMoreAndTheMeshStaysClosedAndOfQuads) {
  const Made made(plain(samples::jittered_torus(60, 40)));
  Memory& memory = *made.core->memory;
  QuadMesh mesh = made.result.mesh;
  std::int32_t splits = 0;
  for (std::uint64_t i = 0; splits < 200; ++i) {
    const auto v = static_cast<std::int32_t>(samples::hash_to_unit(1, i) * mesh.position.size());
    const VertexFans fans(mesh, memory);
    if (fans.valence(v) < 4) continue;
    const std::int32_t faces = mesh.face_count(), valence = fans.valence(v);
    const Vec3 towards = mesh.position[v] + Vec3{samples::hash_to_unit(2, i) - 0.5, samples::hash_to_unit(3, i) - 0.5,
                                                 samples::hash_to_unit(4, i) - 0.5};
    const std::int32_t added = split_vertex(mesh, v, towards, memory);
    ++splits;
    ASSERT_EQ(added, mesh.position.size() - 1);
    ASSERT_EQ(mesh.face_count(), faces + 1);
    const VertexFans after(mesh, memory);
    ASSERT_EQ(after.valence(v) + after.valence(added), valence + 2);
    ASSERT_GE(std::min(after.valence(v), after.valence(added)), 3);
  }
  expect_closed_quads(mesh, 0);
  expect_on_surface(made.surface, mesh);
}

// The quads that go with the new vertex are those on the side it goes to.
TEST(SplitVertex, SplitsAcrossTheWay) {
  const auto core = hf_test::make_core(hf_test::grid(4, 4, 1, 0));
  Memory& memory = *core->memory;
  QuadMesh mesh(memory);
  for (std::int32_t j = 0; j < 3; ++j)
    for (std::int32_t i = 0; i < 3; ++i)
      mesh.add_vertex({}, {static_cast<double>(i), static_cast<double>(j), 0}, QuadMesh::free, i != 1 || j != 1, 1);
  for (const std::int32_t v : {0, 1, 3, 4}) {
    for (const std::int32_t c : {v, v + 1, v + 4, v + 3}) mesh.corner.push_back(c);
  }
  const std::int32_t added = split_vertex(mesh, 4, {2, 1, 0}, memory);
  const VertexFans fans(mesh, memory);
  EXPECT_EQ(fans.valence(added), 3);
  for (const std::int32_t f : {1, 3}) {  // the right ones
    const std::int32_t* c = mesh.quad(f);
    EXPECT_EQ(std::count(c, c + 4, added), 1) << f;
    EXPECT_EQ(std::count(c, c + 4, 4), 0) << f;
  }
  const std::int32_t* c = mesh.quad(4);
  EXPECT_EQ(std::set<std::int32_t>(c, c + 4), (std::set<std::int32_t>{1, 4, 7, added}));
}

TEST(FitQuads, BringsTheMeshNearAndItStaysClosedAndOfQuads) {
  const double edge_length = 0.02;
  const Made made(plain(samples::welded_surface(hf_test::creature("horse", 6000))), edge_length, 0);
  Memory& memory = *made.core->memory;
  QuadMesh mesh = made.result.mesh;
  RelaxOptions relax;
  relax.edge_length = edge_length;
  relax.rounds = 20;
  relax_quads(made.surface, mesh, relax, memory);
  const QuadDistance distance(made.surface, 0.33 * edge_length, memory);
  const double before = distance.measure(mesh, 0, nullptr);
  FitOptions options;
  options.edge_length = edge_length;
  options.tolerance = 0.4 * edge_length;
  ASSERT_GT(before, 3 * options.tolerance);
  const std::int32_t faces = mesh.face_count();
  const double after = fit_quads(made.surface, distance, mesh, options, memory);
  EXPECT_LE(after, 1.05 * options.tolerance);
  EXPECT_LE(distance.measure(mesh, 0, nullptr), after * (1 + 1e-12));
  EXPECT_GT(mesh.face_count(), faces);
  EXPECT_LT(mesh.face_count(), 1.05 * faces);  // one quad at a time, where one is enough
  expect_closed_quads(mesh, made.result.euler_characteristic);
  expect_on_surface(made.surface, mesh);
}

// Two parallel quads, one of them on its edge and through the other, or with a corner turned over.
TEST(QuadFaults, AreTurnedCornersAndQuadsThatRunThroughOthersNearThePlace) {
  const auto core = hf_test::make_core(hf_test::grid(2, 2));
  Memory& memory = *core->memory;
  const auto pair_of = [&](const Vec3(&second)[4]) {
    QuadMesh mesh(memory);
    for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}}) mesh.position.push_back(p);
    for (const Vec3& p : second) mesh.position.push_back(p);
    for (std::int32_t v = 0; v < 8; ++v) mesh.corner.push_back(v);
    return mesh;
  };
  const auto expect = [&](const QuadMesh& mesh, const Vec3& place, std::int32_t turned, bool crossing) {
    const QuadFaults found = faults_near(mesh, place, 0.7, memory);
    EXPECT_EQ(found.turned, turned);
    EXPECT_EQ(found.crossing > 0, crossing);
  };
  const Vec3 beside[4] = {{0, 0, 0.1}, {1, 0, 0.1}, {1, 1, 0.1}, {0, 1, 0.1}};
  expect(pair_of(beside), {0, 0, 0}, 0, false);
  const Vec3 through[4] = {{0.5, 0.2, -0.5}, {0.5, 0.8, -0.5}, {0.5, 0.8, 0.5}, {0.5, 0.2, 0.5}};
  expect(pair_of(through), {0.5, 0, 0}, 0, true);
  expect(pair_of(through), {-1, 0, 0}, 0, false);  // too far
  QuadMesh neighbours = pair_of(through);
  neighbours.corner[4] = 0;  // they share a vertex
  EXPECT_EQ(faults_near(neighbours, {0.5, 0, 0}, 0.7, memory).crossing, 0);
  const Vec3 turned[4] = {{0, 0, 0.1}, {1, 0, 0.1}, {0.2, 0.2, 0.1}, {0, 1, 0.1}};
  expect(pair_of(turned), {0, 0, 0}, 1, false);
  const Vec3 flat[4] = {{0, 0, 0.1}, {1, 0, 0.1}, {1, 0, 0.1}, {0, 0, 0.1}};
  expect(pair_of(flat), {0, 0, 0}, 4, false);
}

// What is left out because it was found near changes nothing, and neither does the number of threads.
TEST(QuadDistance, IsTheSameWithFacesKnownAndFromAnyNumberOfThreads) {
  const Made made(plain(hf_test::cactus(4000)), 0.03, 0);
  Memory& memory = *made.core->memory;
  JobRunner four(4);
  const QuadDistance alone(made.surface, 0.01, memory), shared(made.surface, 0.01, memory, &four);
  QuadMesh mesh = made.result.mesh;
  alone.turn_quads(mesh);
  QuadMesh same = made.result.mesh;
  shared.turn_quads(same);
  for (std::int32_t i = 0; i < mesh.corner.size(); ++i) ASSERT_EQ(mesh.corner[i], same.corner[i]);
  const double worst = alone.measure(mesh, 0, nullptr);
  EXPECT_EQ(shared.measure(mesh, 0, nullptr), worst);
  Vector<QuadMiss> all(&memory), again(&memory);
  const double tolerance = 0.6 * worst;
  NearFaces known(memory);
  EXPECT_EQ(alone.measure(mesh, tolerance, &all), worst);
  EXPECT_EQ(shared.measure(mesh, tolerance, &again, &known), worst);
  ASSERT_FALSE(known.keys.empty());
  ASSERT_EQ(all.size(), again.size());
  again.clear();
  shared.measure(mesh, tolerance, &again, &known);  // now with what is known
  ASSERT_EQ(all.size(), again.size());
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i].distance, again[i].distance);
  // a corner that moves makes its faces unknown
  const std::int32_t f = 0, v = mesh.quad(f)[0];
  if (known.has(mesh, f)) mesh.position[v] = mesh.position[v] + Vec3{3 * tolerance, 0, 0};
  EXPECT_FALSE(known.has(mesh, f));
}

TEST(CollapseToCount, TakesOutAllItMayAndTheMeshStaysClosedAndOfQuads) {
  for (const bool sphere : {true, false}) {
    const Made made(plain(sphere ? samples::sphere(24) : samples::jittered_torus(60, 40, 0.15)));
    Memory& memory = *made.core->memory;
    QuadMesh mesh = made.result.mesh;
    const std::int32_t before = mesh.face_count();
    collapse_to_count(made.surface, mesh, 3 * before / 4, 0.05, memory);
    EXPECT_EQ(mesh.face_count(), 3 * before / 4);
    expect_closed_quads(mesh, sphere ? 2 : 0);
    expect_on_surface(made.surface, mesh);
    collapse_to_count(made.surface, mesh, 0, 0.05, memory);
    EXPECT_LT(mesh.face_count(), before / 2);
    expect_closed_quads(mesh, sphere ? 2 : 0);
    expect_on_surface(made.surface, mesh);
    const VertexFans fans(mesh, memory);
    for (std::int32_t v = 0; v < mesh.position.size(); ++v) EXPECT_GE(fans.valence(v), 3) << v;
  }
}

// Three faces at every corner: collapsing one would leave a corner of two.
TEST(CollapseToCount, OfACubeNoQuadMayCollapse) {
  const auto core = hf_test::make_core(plain(samples::sphere(6)));
  Memory& memory = *core->memory;
  // numbered around the bottom, then around the top
  QuadMesh mesh(memory);
  for (std::int32_t v = 0; v < 8; ++v) mesh.add_vertex({}, {}, QuadMesh::free, false, 1);
  for (const auto& face : {std::array<std::int32_t, 4>{0, 3, 2, 1},
                           {4, 5, 6, 7},
                           {0, 1, 5, 4},
                           {1, 2, 6, 5},
                           {2, 3, 7, 6},
                           {3, 0, 4, 7}}) {
    for (const std::int32_t v : face) mesh.corner.push_back(v);
  }
  const VertexFans fans(mesh, memory);
  for (std::int32_t f = 0; f < 6; ++f)
    for (std::int32_t k = 0; k < 2; ++k)
      EXPECT_FALSE(can_collapse(mesh, fans, f, k)) << f;  // three faces at each corner
}

// A sheet of quads over a sheet with one peak of known height: that far are they apart, both ways, and there.
TEST(QuadDistance, OfAPeakIsItsHeightAndIsFoundAtTheQuadBelow) {
  hf_test::PlainMesh sheet = hf_test::grid(10, 10, 1, 0);
  const std::uint32_t peak = sheet.vertex_count() / 2;
  const auto flat = hf_test::make_core(sheet);
  double lowest[3], highest[3];
  for (int k = 0; k < 3; ++k) {
    lowest[k] = 1e300;
    highest[k] = -1e300;
    for (std::uint32_t v = 0; v < sheet.vertex_count(); ++v) {
      lowest[k] = std::min(lowest[k], sheet.positions[3 * v + static_cast<std::uint32_t>(k)]);
      highest[k] = std::max(highest[k], sheet.positions[3 * v + static_cast<std::uint32_t>(k)]);
    }
  }
  int across = 0;
  for (int k = 1; k < 3; ++k)
    if (highest[k] - lowest[k] < highest[across] - lowest[across]) across = k;
  sheet.positions[3 * peak + static_cast<std::uint32_t>(across)] += 0.2 * (highest[across == 0] - lowest[across == 0]);
  const auto core = hf_test::make_core(sheet);
  Memory& memory = *core->memory;
  const FluxSurface surface = FluxSurface::make(core->mesh, core->topology(), memory);
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300}, top;
  auto component = [](Vec3& p, int k) -> double& { return k == 0 ? p.x : k == 1 ? p.y : p.z; };
  for (Vec3 p : core->mesh.positions)
    for (int k = 0; k < 3; ++k) {
      component(low, k) = std::min(component(low, k), component(p, k));
      if (component(p, k) > component(high, k) && k == across) top = p;
      component(high, k) = std::max(component(high, k), component(p, k));
    }
  const double height = component(high, across) - component(low, across);
  QuadMesh mesh(memory);
  const int u = (across + 1) % 3, w = (across + 2) % 3;
  for (int corner = 0; corner < 4; ++corner) {
    Vec3 p = low;
    if (corner == 1 || corner == 2) component(p, u) = component(high, u);
    if (corner >= 2) component(p, w) = component(high, w);
    mesh.add_vertex({}, p, QuadMesh::free, true, 1);
    mesh.corner.push_back(corner);
  }
  const QuadDistance distance(surface, 0.05, memory);
  Vector<QuadMiss> misses(&memory);
  EXPECT_NEAR(distance.measure(mesh, 0.5 * height, &misses), height, 1e-12);
  ASSERT_FALSE(misses.empty());
  EXPECT_EQ(misses[0].face, 0);
  EXPECT_LT(norm(surface.position[misses[0].vertex] - top), 1e-12);
}

TEST(TurnQuads, AQuadBeginsAtItsReflexCornerOrAtTheDiagonalOnTheSurface) {
  const auto core = hf_test::make_core(hf_test::grid(10, 10, 1, 0));
  Memory& memory = *core->memory;
  const FluxSurface surface = FluxSurface::make(core->mesh, core->topology(), memory);
  const QuadDistance distance(surface, 0.05, memory);
  const std::int32_t t[3] = {surface.tail[0], surface.tail[1], surface.tail[2]};
  const Vec3 a = surface.position[t[0]], b = surface.position[t[1]], c = surface.position[t[2]];
  const Vec3 up = cross(b - a, c - a);
  for (int turn = 0; turn < 4; ++turn) {
    // an arrow in the plane, whose notch is corner 3; a tent, whose corners 0 and 2 are in the plane, 1 and 3 above it
    const Vec3 notch[4] = {b, c, a, (1.0 / 3) * (a + b + c)};
    const Vec3 tent[4] = {a, b + 10.0 * up, c, a + c - b + 10.0 * up};
    for (const bool arrowed : {true, false}) {
      QuadMesh mesh(memory);
      for (int k = 0; k < 4; ++k) mesh.add_vertex({}, arrowed ? notch[k] : tent[k], QuadMesh::free, false, 1);
      for (int k = 0; k < 4; ++k) mesh.corner.push_back((k + turn) % 4);
      distance.turn_quads(mesh);
      const std::int32_t first = mesh.corner[0];
      if (arrowed) {
        EXPECT_EQ(first, 3);
      } else {
        EXPECT_EQ(first % 2, 0);
      }
      for (int k = 0; k < 4; ++k) EXPECT_EQ(mesh.corner[k], (first + k) % 4);
    }
  }
}

TEST(ProgressRange, NestsAndEndsWithItsScope) {
  Progress progress;
  const CallProgress call(&progress);
  {
    const ProgressRange outer(0.2f, 0.6f);
    progress.report(0.5f);
    EXPECT_FLOAT_EQ(progress.fraction(), 0.4f);
    {
      const ProgressRange inner(0.5f, 1.0f);
      progress.report(0.5f);
      EXPECT_FLOAT_EQ(progress.fraction(), 0.5f);
    }
    progress.report(1.0f);
    EXPECT_FLOAT_EQ(progress.fraction(), 0.6f);
  }
  progress.report(1.0f);
  EXPECT_FLOAT_EQ(progress.fraction(), 1.0f);
  const CallProgress without(nullptr);
  const ProgressRange none(0, 1);
  report(0.5f);
}

}  // namespace

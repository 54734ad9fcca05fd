// What is smaller than the quads: holes, walls between holes, ends, rods, specks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "assets/creature.h"
#include "assets/shapes.h"
#include "quads/field_quads.h"
#include "remesh/quad_distance.h"
#include "support/creature.h"
#include "support/full.h"
#include "support/meshes.h"
#include "support/quad_oracle.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::quads;

// A plane of n x n squares, without those that `gone` names.
template <class Gone>
std::shared_ptr<const surface::Core> sheet(std::uint32_t n, Gone gone) {
  hf_test::PlainMesh mesh = hf_test::grid(n, n, 1, 0.2);
  std::vector<std::uint32_t> kept;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const std::uint32_t square = static_cast<std::uint32_t>(t / 6);
    if (gone(square % n, square / n)) continue;
    kept.insert(kept.end(), mesh.triangles.begin() + static_cast<std::ptrdiff_t>(t),
                mesh.triangles.begin() + static_cast<std::ptrdiff_t>(t) + 3);
  }
  mesh.triangles = kept;
  return hf_test::make_core(mesh);
}

// Quads without a substitute: no component got quads of shorter edges, or of its triangles.
remesh::QuadMesh quads_of(const std::shared_ptr<const surface::Core>& core, std::int32_t faces,
                          const std::string& what) {
  FieldQuadOptions options;
  options.core = core;
  options.faces = faces;
  FieldQuadReport report;
  QuadResult result = make_field_quads(options, &report);
  hf_test::expect_manifold(*core, result.mesh, what);
  EXPECT_EQ(report.substitutes, 0) << what;
  EXPECT_NEAR(result.mesh.face_count(), faces, 0.35 * faces) << what;
  return std::move(result.mesh);
}

// The lengths of the borders, in the caller's unit, the shortest first.
std::vector<double> border_loops(const remesh::QuadMesh& mesh, double scale) {
  std::map<std::int32_t, std::int32_t> next;
  std::map<std::pair<std::int32_t, std::int32_t>, bool> directed;
  for (std::int32_t i = 0; i < mesh.corner.size(); ++i)
    directed[{mesh.corner[i], mesh.corner[i % 4 == 3 ? i - 3 : i + 1]}] = true;
  for (const auto& [edge, there] : directed) {
    if (!directed.count({edge.second, edge.first})) next[edge.first] = edge.second;
  }
  std::vector<double> loops;
  while (!next.empty()) {
    std::int32_t count = 0;
    double length = 0;
    for (auto at = next.begin(); at != next.end(); ++count) {
      const std::int32_t to = at->second;
      length += scale * norm(mesh.position[to] - mesh.position[at->first]);
      next.erase(at);
      at = next.find(to);
    }
    EXPECT_GE(count, 3) << "edges of a border";
    loops.push_back(length);
  }
  std::sort(loops.begin(), loops.end());
  return loops;
}

TEST(SmallParts, holes_that_no_line_crosses_are_open) {
  for (const std::uint32_t place : {9u, 10u, 11u, 12u, 13u}) {
    const auto core = sheet(24, [&](std::uint32_t x, std::uint32_t y) {
      return (x == place && y == 11) || (x == 3 && y == place) || (x == 18 && y == 19);
    });
    const remesh::QuadMesh mesh = quads_of(core, 36, "holes at " + std::to_string(place));
    const std::vector<double> loops = border_loops(mesh, core->mesh.scale);
    ASSERT_EQ(loops.size(), 4u);
    for (int i = 0; i < 3; ++i) EXPECT_GT(loops[static_cast<std::size_t>(i)], 1.5);  // 4, with cut corners
  }
}

TEST(SmallParts, walls_between_holes_stay) {
  for (const std::uint32_t place : {9u, 10u, 11u, 12u, 13u}) {
    const auto core = sheet(24, [&](std::uint32_t x, std::uint32_t y) {
      return y > 6 && y < 17 && ((x > 4 && x < place) || (x > place && x < 20));
    });
    const remesh::QuadMesh mesh = quads_of(core, 40, "wall at " + std::to_string(place));
    EXPECT_EQ(border_loops(mesh, core->mesh.scale).size(), 3u);
  }
}

// A cone without its tip: the hole there is narrower than a quad.
TEST(SmallParts, narrow_ends_stay_open) {
  for (const double radius : {0.02, 0.05, 0.1}) {
    hf_test::PlainMesh mesh;
    const std::uint32_t around = 24, rings = 30;
    for (std::uint32_t r = 0; r <= rings; ++r) {
      for (std::uint32_t i = 0; i < around; ++i) {
        const double size = 1 + (radius - 1) * r / rings, angle = 2 * std::acos(-1.0) * (i + 0.1 * (r % 3)) / around;
        mesh.positions.insert(mesh.positions.end(), {size * std::cos(angle), size * std::sin(angle), 3.0 * r / rings});
      }
    }
    for (std::uint32_t r = 0; r < rings; ++r) {
      for (std::uint32_t i = 0; i < around; ++i) {
        const std::uint32_t a = r * around + i, b = r * around + (i + 1) % around;
        mesh.triangles.insert(mesh.triangles.end(), {a, b, b + around, a, b + around, a + around});
      }
    }
    const auto core = hf_test::make_core(mesh);
    const remesh::QuadMesh quads = quads_of(core, 80, "cone " + std::to_string(radius));
    const std::vector<double> loops = border_loops(quads, core->mesh.scale);
    ASSERT_EQ(loops.size(), 2u);
    EXPECT_GT(loops[0], 0.6 * 2 * std::acos(-1.0) * radius);
  }
}

struct Extent {
  Vec3 low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
  void add(Vec3 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
};

// Three lines or less would run round the legs, which then are two quads back to back, or none.
TEST(SmallParts, limbs_that_few_lines_run_round_are_kept) {
  const samples::ShapeMesh shape = samples::welded_surface(hf_test::creature("horse", 3000));
  const auto core = hf_test::make_core({shape.positions, shape.triangles});
  const remesh::FluxSurface surface = remesh::FluxSurface::make(core->mesh, core->topology(), *core->memory);
  const remesh::QuadDistance distance(surface, 0.01, *core->memory);
  for (const auto& [length, rounds] :
       hf_test::quick_and_full<std::pair<double, int>>({{0.03, 20}}, {{0.026, 20}, {0.03, 60}})) {
    FieldQuadOptions options;
    options.core = core;
    options.edge_length = length;
    options.relax = rounds;
    FieldQuadReport report;
    const remesh::QuadMesh mesh = make_field_quads(options, &report).mesh;
    hf_test::expect_manifold(*core, mesh, "horse");
    const double off = distance.measure(mesh, 0, nullptr) / length;
    std::printf("edges of %.3f: %d quads, %.2f edges off\n", length, mesh.face_count(), off);
    EXPECT_LT(off, 1.1) << length;
    EXPECT_NEAR(report.edge_length, length, 1e-12);
  }
}

// A triangle smaller than the quads becomes three quads around a point: one quad would have a flat corner. A needle
// too. Where there are too many quads, those of triangles stay.
TEST(SmallParts, lone_triangles_become_three_quads) {
  for (const int needles : {1, 60}) {
    hf_test::PlainMesh mesh = hf_test::grid(20, 20, 1, 0.2);
    std::vector<std::vector<double>> lone = {{30, 0, 0, 31.5, 0.2, 0, 30.4, 1.3, 0}};
    for (int i = 0; i < needles; ++i)
      lone.push_back({28.62 + 3 * i, -53.98, -2.69, 27.81 + 3 * i, -53.72, -2.69, 29.38 + 3 * i, -54.23, -2.66});
    for (const std::vector<double>& corners : lone) {
      const std::uint32_t first = static_cast<std::uint32_t>(mesh.positions.size() / 3);
      mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
      for (std::uint32_t k = 0; k < 3; ++k) mesh.triangles.push_back(first + k);
    }
    const auto core = hf_test::make_core(mesh);
    FieldQuadOptions options;
    options.core = core;
    options.faces = 150;
    const QuadResult result = make_field_quads(options);
    hf_test::expect_manifold(*core, result.mesh, "triangles");
    std::int32_t count = 0;
    for (std::int32_t f = 0; f < result.mesh.face_count(); ++f) {
      const std::int32_t* c = result.mesh.quad(f);
      if (core->mesh.to_given(result.mesh.position[c[0]]).x < 25) continue;
      ++count;
      const Vec3 normal = cross(result.mesh.position[c[2]] - result.mesh.position[c[0]],
                                result.mesh.position[c[3]] - result.mesh.position[c[1]]);
      for (int k = 0; k < 4; ++k) {
        const Vec3 p = result.mesh.position[c[k]];
        const Vec3 turn = cross(unit_vector(result.mesh.position[c[(k + 1) % 4]] - p),
                                unit_vector(result.mesh.position[c[(k + 3) % 4]] - p));
        EXPECT_GT(dot(turn, normal), 0) << f;
      }
    }
    EXPECT_EQ(count, 3 * (needles + 1));
  }
}

// A prism of height and radius 1.
samples::ShapeMesh coin(std::uint32_t sides) {
  samples::ShapeMesh mesh;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double a = 2 * std::acos(-1.0) * i / sides;
    for (const double z : {0.0, 1.0}) mesh.positions.insert(mesh.positions.end(), {std::cos(a), std::sin(a), z});
    const std::uint32_t low = 2 * i, next = 2 * ((i + 1) % sides);
    mesh.triangles.insert(mesh.triangles.end(), {low, next, next + 1, low, next + 1, low + 1});
    if (i > 0 && i + 1 < sides) mesh.triangles.insert(mesh.triangles.end(), {0, next, low, 1, low + 1, next + 1});
  }
  return mesh;
}

// A ball with a rod and a speck beside it, a ball that faces inwards, a coin, and a leaf with a border.
TEST(SmallParts, rods_and_specks_keep_their_extent) {
  samples::ShapeMesh mesh = samples::sphere(16);
  std::vector<Extent> extents(1);
  const auto append = [&](samples::ShapeMesh part, Vec3 size, Vec3 move, bool turned) {
    const std::uint32_t base = static_cast<std::uint32_t>(mesh.positions.size() / 3);
    extents.emplace_back();
    for (std::size_t i = 0; i < part.positions.size(); i += 3) {
      const Vec3 p{size.x * part.positions[i] + move.x, size.y * part.positions[i + 1] + move.y,
                   size.z * part.positions[i + 2] + move.z};
      mesh.positions.insert(mesh.positions.end(), {p.x, p.y, p.z});
    }
    for (std::size_t i = 0; i < part.triangles.size(); i += 3) {
      if (turned) std::swap(part.triangles[i], part.triangles[i + 1]);
      for (std::size_t k = 0; k < 3; ++k) mesh.triangles.push_back(base + part.triangles[i + k]);
    }
  };
  append(samples::sphere(6), {0.8, 0.03, 0.02}, {2.2, 0, 0}, false);
  append(samples::sphere(4), {0.05, 0.05, 0.05}, {0, 1.5, 0}, false);
  append(samples::sphere(4), {0.05, 0.06, 0.05}, {0, -1.5, 0}, true);
  append(coin(20), {0.106, 0.106, 0.03}, {-2.2, 0, 0}, false);  // shrank to a point when it was evened out
  append(samples::plane(5, 4), {0.06, 1, 0.05}, {0, 0, 1.6}, false);
  const auto core = hf_test::make_core({mesh.positions, mesh.triangles});
  for (const std::int32_t faces : {60, 200, 800}) {
    FieldQuadOptions options;
    options.core = core;
    options.faces = faces;
    const remesh::QuadMesh quads = make_field_quads(options).mesh;
    const std::string what = std::to_string(faces) + " faces";
    hf_test::expect_manifold(*core, quads, what);
    std::vector<Extent> was(extents.size()), is(extents.size());
    std::vector<double> volume(extents.size(), 0.0);
    for (Index v = 0; v < core->size(); ++v)
      was[at(core->mesh.component[at(v)])].add(core->mesh.to_given(core->mesh.positions[at(v)]));
    const auto component = [&](std::int32_t v) {
      return at(core->mesh.component[at(core->mesh.triangle(quads.location[v].triangle)[0])]);
    };
    for (std::int32_t v = 0; v < quads.position.size(); ++v)
      is[component(v)].add(core->mesh.to_given(quads.position[v]));
    for (std::int32_t f = 0; f < quads.face_count(); ++f) {
      const auto p = [&](std::int32_t k) { return quads.position[quads.corner[4 * f + k]]; };
      volume[component(quads.corner[4 * f])] += dot(p(0), cross(p(1), p(2))) + dot(p(0), cross(p(2), p(3)));
    }
    for (std::size_t c = 0; c < was.size(); ++c) {
      const Vec3 size = was[c].high - was[c].low, got = is[c].high - is[c].low;
      EXPECT_GT(std::max({got.x, got.y, got.z}), 0.55 * std::max({size.x, size.y, size.z})) << what << " part " << c;
      const double expected = c + 1 == was.size() ? 0 : c == 3 ? -1 : 1;  // the leaf, the ball that faces inwards
      if (expected != 0) {
        EXPECT_GT(expected * volume[c], 0) << what << " part " << c;
      }
    }
  }
}

// A rod keeps its length, whatever lies beside it. Distances were measured to the quads of all pieces once: a rod in a
// sleeve lost an end, because the quads of the sleeve are near it.
TEST(SmallParts, rods_in_sleeves_keep_their_length) {
  for (const double width : {0.02, 0.03, 0.04, 0.06}) {
    samples::ShapeMesh mesh = samples::sphere(16);
    const auto append = [&](Vec3 size, Vec3 move) {
      const samples::ShapeMesh part = samples::sphere(6);
      const std::uint32_t base = static_cast<std::uint32_t>(mesh.positions.size() / 3);
      for (std::size_t i = 0; i < part.positions.size(); i += 3) {
        mesh.positions.insert(mesh.positions.end(),
                              {size.x * part.positions[i] + move.x, size.y * part.positions[i + 1] + move.y,
                               size.z * part.positions[i + 2] + move.z});
      }
      for (const std::uint32_t corner : part.triangles) mesh.triangles.push_back(base + corner);
    };
    append({0.8, width, width}, {2.2, 0, 0});
    append({0.84, width + 0.08, width + 0.08}, {2.2, 0, 0});
    const auto core = hf_test::make_core({mesh.positions, mesh.triangles});
    for (const std::int32_t faces : {100, 200, 400}) {
      FieldQuadOptions options;
      options.core = core;
      options.faces = faces;
      const remesh::QuadMesh quads = make_field_quads(options).mesh;
      Extent rod;
      for (std::int32_t v = 0; v < quads.position.size(); ++v) {
        if (core->mesh.component[at(core->mesh.triangle(quads.location[v].triangle)[0])] == 1)
          rod.add(core->mesh.to_given(quads.position[v]));
      }
      EXPECT_GT(rod.high.x - rod.low.x, 0.85 * 1.6) << width << ", " << faces << " faces";
    }
  }
}

}  // namespace

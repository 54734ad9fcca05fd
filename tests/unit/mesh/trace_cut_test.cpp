// Cuts through triangles: the patch covers what it replaces, opens along the line and nowhere else.
#include "mesh/trace_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "base/error.h"
#include "mesh/mesh_patch.h"
#include "mesh/union_find.h"
#include "support/dirty_meshes.h"
#include "support/hard_meshes.h"
#include "support/parts.h"
#include "unit/field/analysis_support.h"

namespace {

using namespace hf_inner;
using hf_test::PlainMesh;
using Edge = std::array<std::uint32_t, 2>;

CurvePoint vertex(Index v) { return at_vertex(v); }

struct Shape {
  explicit Shape(const PlainMesh& plain)
      : core(hf_test::make_core(plain)),
        geometry(core->geometry->unlinked()),
        mesh(geometry.mesh),
        topology(geometry.topology()),
        given(plain) {}
  TracedCut cut(const std::vector<CurvePoint>& line, double snap_share = 0.05, std::size_t most = 1000000) const {
    return trace_cut(mesh, topology, {line.data(), line.size()}, {snap_share, most}, memory);
  }
  hf_result code(const std::vector<CurvePoint>& line, std::uint32_t index, double snap_share = 0.05,
                 std::size_t most = 1000000) const {
    try {
      (void)cut(line, snap_share, most);
    } catch (const Error& error) {
      EXPECT_EQ(error.index(), index) << error.what();
      return error.code();
    }
    return HF_OK;
  }
  // A point of a triangle of the caller, by weights of its corners.
  CurvePoint in(std::uint32_t t, double a, double b) const {
    CurvePoint point{{}, {a, b, 1 - a - b}};
    for (std::size_t k = 0; k < 3; ++k) point.corner[k] = mesh.inner_of_given[given.triangles[3 * t + k]];
    return point;
  }
  mutable Memory memory;
  std::shared_ptr<const Core> core;
  const Geometry& geometry;
  const Mesh& mesh;
  const Topology& topology;
  PlainMesh given;
};

Vec3 row(const std::vector<double>& positions, std::uint32_t v) {
  return {positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]};
}
Vec3 area(const PlainMesh& mesh, const std::uint32_t* v) {
  const Vec3 a = row(mesh.positions, v[0]);
  return 0.5 * cross(row(mesh.positions, v[1]) - a, row(mesh.positions, v[2]) - a);
}

// The caller's mesh after the cut.
PlainMesh applied(const Shape& shape, const TracedCut& cut) {
  PlainMesh out;
  out.positions = shape.given.positions;
  for (const SurfacePlace& place : cut.vertices) {
    const Vec3 p = position_of(shape.mesh, place);
    out.positions.insert(out.positions.end(), {p.x, p.y, p.z});
  }
  for (std::uint32_t t = 0; t < shape.given.triangle_count(); ++t) {
    if (std::binary_search(cut.removed.begin(), cut.removed.end(), t)) continue;
    out.triangles.insert(out.triangles.end(), &shape.given.triangles[3 * t], &shape.given.triangles[3 * t] + 3);
  }
  out.triangles.insert(out.triangles.end(), cut.triangles.begin(), cut.triangles.end());
  return out;
}

struct Counts {
  std::map<Edge, int> directed;
  std::set<Edge> border;
  int euler = 0, components = 0;
  std::size_t most_on_edge = 0;
};
Counts counts(const PlainMesh& mesh) {
  Counts out;
  std::map<Edge, int> edges;
  Memory memory;
  UnionFind sets(mesh.vertex_count(), memory);
  std::set<std::uint32_t> used;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const std::uint32_t* const v = &mesh.triangles[3 * t];
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = v[k], b = v[(k + 1) % 3];
      ++out.directed[{a, b}];
      ++edges[{std::min(a, b), std::max(a, b)}];
      sets.unite(static_cast<Index>(a), static_cast<Index>(b));
      used.insert(a);
    }
  }
  std::set<Index> roots;
  for (const std::uint32_t v : used) roots.insert(sets.find(static_cast<Index>(v)));
  for (const auto& edge : edges) {
    if (edge.second == 1) out.border.insert(edge.first);
    out.most_on_edge = std::max(out.most_on_edge, static_cast<std::size_t>(edge.second));
  }
  out.components = static_cast<int>(roots.size());
  out.euler = static_cast<int>(used.size()) - static_cast<int>(edges.size()) + static_cast<int>(mesh.triangle_count());
  EXPECT_EQ(used.size(), mesh.vertex_count());  // no vertex is lost
  return out;
}
Edge ordered(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

// The identities of every cut. Returns the mesh after it.
PlainMesh check(const Shape& shape, const TracedCut& cut, bool closed = false) {
  const PlainMesh& given = shape.given;
  const PlainMesh after = applied(shape, cut);
  // the parts of a triangle cover it, turn as it does, and have the places that their weights say
  std::map<std::uint32_t, double> covered;
  for (std::size_t t = 0; t < cut.sources.size(); ++t) {
    const std::uint32_t* const old = &given.triangles[3 * cut.sources[t]];
    const Vec3 whole = area(given, old), part = area(after, &cut.triangles[3 * t]);
    EXPECT_GT(dot(whole, part), 0);
    covered[cut.sources[t]] += norm(part) / norm(whole);
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3 p;
      const double* const w = &cut.weights[9 * t + 3 * k];
      for (std::size_t c = 0; c < 3; ++c) p = p + w[c] * row(given.positions, old[c]);
      EXPECT_LT(norm(p - row(after.positions, cut.triangles[3 * t + k])), 1e-12 * (1 + norm(p)));
      EXPECT_EQ(w[0] + w[1] + w[2], 1);
    }
  }
  std::vector<std::uint32_t> sources;
  for (const auto& one : covered) {
    sources.push_back(one.first);
    EXPECT_NEAR(one.second, 1, 1e-10);
  }
  EXPECT_TRUE(std::equal(sources.begin(), sources.end(), cut.removed.begin(), cut.removed.end()));
  // edges stay manifold, and triangles stay turned alike
  const Counts before = counts(given), now = counts(after);
  EXPECT_LE(now.most_on_edge, before.most_on_edge);
  if (std::all_of(before.directed.begin(), before.directed.end(), [](const auto& one) { return one.second == 1; }))
    EXPECT_TRUE(std::all_of(now.directed.begin(), now.directed.end(), [](const auto& one) { return one.second == 1; }));
  // what is new on the border is the rims of the line, and old borders that it divides
  std::set<Edge> rims;
  const std::size_t points = cut.rims.size() / 2;
  for (std::size_t i = 0; i + !closed < points; ++i) {
    for (std::size_t s = 0; s < 2; ++s) {
      const std::uint32_t a = cut.rims[2 * i + s], b = cut.rims[2 * ((i + 1) % points) + s];
      rims.insert(ordered(a, b));
      EXPECT_EQ(now.border.count(ordered(a, b)), 1u) << i << ", side " << s;
    }
    if (before.directed.empty()) continue;
    if (cut.rims[2 * i] == cut.rims[2 * i + 1]) continue;
    // the left triangle runs along the line, the right one against it
    const std::uint32_t left[2] = {cut.rims[2 * i], cut.rims[2 * ((i + 1) % points)]};
    EXPECT_EQ(now.directed.count({left[0], left[1]}), 1u) << i;
  }
  for (const Edge& edge : now.border) {
    if (before.border.count(edge) > 0 || rims.count(edge) > 0) continue;
    // a part of an old border edge: its ends lie on one
    std::set<std::uint32_t> on;
    for (const std::uint32_t v : edge) {
      if (v < given.vertex_count()) {
        on.insert(v);
        continue;
      }
      const SurfacePlace& place = cut.vertices[v - given.vertex_count()];
      for (int k = 0; k < 3 && place.vertex[k] != Mesh::none; ++k)
        on.insert(static_cast<std::uint32_t>(shape.mesh.given_of_inner[at(place.vertex[k])]));
    }
    EXPECT_TRUE(on.size() == 2 && before.border.count({*on.begin(), *on.rbegin()}) > 0) << edge[0] << ", " << edge[1];
  }
  // the library takes it
  std::vector<Vec3> positions;
  for (const SurfacePlace& place : cut.vertices) positions.push_back(position_of(shape.mesh, place));
  MeshPatch patch;
  patch.removed = cut.removed;
  patch.positions = {positions.data(), positions.size()};
  patch.triangles = cut.triangles;
  const PatchedMesh patched = patched_mesh(shape.mesh, &shape.topology, patch, shape.memory);
  EXPECT_EQ(patched.mesh.component_count(), now.components);
  EXPECT_EQ(patched.mesh.triangle_count(), static_cast<Index>(after.triangle_count()));
  return after;
}

std::vector<CurvePoint> random_line(const Shape& shape, std::mt19937& random, bool near) {
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<CurvePoint> line;
  const std::size_t count = 2 + random() % 6;
  std::uint32_t t = random() % shape.given.triangle_count();
  for (std::size_t i = 0; i < count; ++i) {
    if (!near || random() % 4 == 0) t = random() % shape.given.triangle_count();
    const std::uint32_t kind = random() % 6;
    if (kind == 0) {
      line.push_back(vertex(shape.mesh.inner_of_given[shape.given.triangles[3 * t + random() % 3]]));
    } else if (kind == 1) {
      const double a = share(random);
      line.push_back(shape.in(t, a, 1 - a));
    } else {
      const double a = share(random), b = share(random) * (1 - a);
      line.push_back(shape.in(t, a, b));
    }
  }
  if (random() % 4 == 0) line.push_back(line.front());
  return line;
}

// Random lines: each is cut with all identities, or refused by a code that the header names.
TEST(TraceCut, RandomLinesKeepTheSurfaceOrAreRefused) {
  const char* const full = std::getenv("HF_FULL_TESTS");
  const int rounds = full && *full && *full != '0' ? 2000 : 250;
  std::mt19937 random(11);
  int made = 0, refused = 0;
  const std::vector<PlainMesh> meshes = {
      hf_test::grid(7, 6, 1, 0.3), hf_test::torus(14, 9), hf_test::ball(2, 1, {0, 0, 0}), hf_test::disk(4),
      hf_test::slab_with_holes(3), hf_test::from_shape(samples::horned(0.4)), hf_test::book(3, 4, 4, 0.3)};
  for (const PlainMesh& plain : meshes) {
    const Shape shape(plain);
    for (int round = 0; round < rounds; ++round) {
      const std::vector<CurvePoint> line = random_line(shape, random, round % 2 == 0);
      const double share = round % 3 == 0 ? 1e-6 : round % 3 == 1 ? 0.05 : 0.4;
      try {
        const TracedCut cut = shape.cut(line, share);
        const bool closed = 2 * cut.rims.size() > 0 && line.size() > 2 && line.front().corner[0] == line.back().corner[0] &&
                            std::equal(line.front().weight, line.front().weight + 3, line.back().weight);
        SCOPED_TRACE(round);
        check(shape, cut, closed);
        ++made;
      } catch (const Error& error) {
        EXPECT_TRUE(error.code() == HF_ERROR_CONFLICT || error.code() == HF_ERROR_EMPTY) << error.what();
        if (error.code() == HF_ERROR_CONFLICT) {
          EXPECT_LT(error.index() + 1, line.size()) << error.what();
        }
        ++refused;
      }
      ASSERT_FALSE(HasFailure()) << plain.vertex_count() << " vertices, round " << round;
    }
  }
  EXPECT_GT(made, 3 * rounds);
  std::printf("%d cut, %d refused\n", made, refused);
}

}  // namespace

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
#include "support/full.h"
#include "support/hard_meshes.h"
#include "support/parts.h"
#include "unit/field/analysis_support.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::mesh;
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
  std::shared_ptr<const surface::Core> core;
  const surface::Geometry& geometry;
  const Mesh& mesh;
  const Topology& topology;
  PlainMesh given;
};

Vec3 row(const std::vector<double>& positions, std::uint32_t v) {
  return {positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]};
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
// A mesh whose vertices at one place are one.
PlainMesh joined(const PlainMesh& mesh) {
  PlainMesh out;
  std::map<std::array<double, 3>, std::uint32_t> at_place;
  for (const std::uint32_t v : mesh.triangles) {
    const double* const p = &mesh.positions[3 * v];
    const auto put = at_place.insert({{p[0], p[1], p[2]}, out.vertex_count()});
    if (put.second) out.positions.insert(out.positions.end(), p, p + 3);
    out.triangles.push_back(put.first->second);
  }
  return out;
}
Edge ordered(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

// The identities of every cut. Returns the mesh after it.
PlainMesh check(const Shape& shape, const TracedCut& cut, bool closed = false) {
  const PlainMesh& given = shape.given;
  const PlainMesh after = applied(shape, cut);
  // the parts of a triangle cover it, turn as it does, and have the places that their weights say
  std::map<std::uint32_t, std::int64_t> covered;
  for (std::size_t t = 0; t < cut.sources.size(); ++t) {
    const std::uint32_t* const old = &given.triangles[3 * cut.sources[t]];
    GridPoint corner[3];
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3 p;
      const double* const w = &cut.weights[9 * t + 3 * k];
      for (std::size_t c = 0; c < 3; ++c) p = p + w[c] * row(given.positions, old[c]);
      EXPECT_LT(norm(p - row(after.positions, cut.triangles[3 * t + k])), 1e-12 * (1 + norm(p)));
      EXPECT_EQ(w[0] + w[1] + w[2], 1);
      corner[k] = {static_cast<std::int64_t>(w[0] * GridPoint::grid),
                   static_cast<std::int64_t>(w[1] * GridPoint::grid)};
    }
    const std::int64_t area = (corner[1].a - corner[0].a) * (corner[2].b - corner[0].b) -
                              (corner[1].b - corner[0].b) * (corner[2].a - corner[0].a);
    EXPECT_GT(area, 0);
    covered[cut.sources[t]] += area;
  }
  std::vector<std::uint32_t> sources;
  for (const auto& one : covered) {
    sources.push_back(one.first);
    EXPECT_EQ(one.second, GridPoint::grid * GridPoint::grid);
  }
  EXPECT_TRUE(std::equal(sources.begin(), sources.end(), cut.removed.begin(), cut.removed.end()));
  // edges stay manifold, and triangles stay turned alike
  const Counts before = counts(given), now = counts(after);
  EXPECT_LE(now.most_on_edge, before.most_on_edge);
  const bool oriented =
      std::all_of(before.directed.begin(), before.directed.end(), [](const auto& one) { return one.second == 1; });
  if (oriented) {
    EXPECT_TRUE(std::all_of(now.directed.begin(), now.directed.end(), [](const auto& one) { return one.second == 1; }));
  }
  // what is new on the border is the rims of the line, and old borders that it divides
  const auto places = [&](std::uint32_t v, std::set<std::uint32_t>& on) {  // the given vertices that it lies between
    if (v < given.vertex_count()) {
      on.insert(v);
      return;
    }
    const SurfacePlace& place = cut.vertices[v - given.vertex_count()];
    for (int k = 0; k < 3 && place.vertex[k] != Mesh::none; ++k)
      on.insert(static_cast<std::uint32_t>(shape.mesh.given_of_inner[at(place.vertex[k])]));
  };
  const auto is_on_border = [&](const Edge& edge) {
    std::set<std::uint32_t> on;
    for (const std::uint32_t v : edge) places(v, on);
    return on.size() == 2 && before.border.count({*on.begin(), *on.rbegin()}) > 0;
  };
  // Where a line touches a border between its ends, the border parts one side: its vertices there are of the next
  // piece.
  std::set<std::uint32_t> on_border;
  for (const Edge& edge : before.border) on_border.insert(edge.begin(), edge.end());
  const auto touches = [&](std::uint32_t v) {
    std::set<std::uint32_t> on;
    places(v, on);
    return (on.size() == 1 && on_border.count(*on.begin()) > 0) ||
           (on.size() == 2 && before.border.count({*on.begin(), *on.rbegin()}) > 0);
  };
  std::set<Edge> rims;
  const std::size_t points = cut.rims.size() / 2;
  if (points < 3) closed = false;  // snapping can leave one edge of a closed line: it goes out and back
  for (std::size_t i = 0; i + !closed < points; ++i) {
    const std::uint32_t* const here = &cut.rims[2 * i];
    const std::uint32_t* const next = &cut.rims[2 * ((i + 1) % points)];
    const bool along_border = is_on_border({here[0], next[0]});
    if (touches(next[0]) && (closed || i + 2 < points)) continue;
    std::uint32_t open = 0;
    for (int s = 0; s < 2; ++s) {
      rims.insert(ordered(here[s], next[s]));
      open += now.border.count(ordered(here[s], next[s]));
    }
    // where more than two triangles meet, those that the line does not cross hold its sides together
    if (before.most_on_edge == 2) {
      EXPECT_GE(open, along_border ? 1u : 2u) << i;
    }
    // the left triangle runs along the line, the right one against it
    if (!oriented || along_border || here[0] == here[1]) continue;
    EXPECT_EQ(now.directed.count({here[0], next[0]}), 1u) << i;
    EXPECT_EQ(now.directed.count({next[1], here[1]}), 1u) << i;
  }
  for (const Edge& edge : now.border) {
    if (before.most_on_edge > 2) break;  // a line along the spine parts more than two triangles
    if (before.border.count(edge) > 0 || rims.count(edge) > 0 || touches(edge[0]) || touches(edge[1])) continue;
    EXPECT_TRUE(is_on_border(edge)) << edge[0] << ", " << edge[1];
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
  const int rounds = hf_test::is_full() ? 2000 : 250;
  std::mt19937 random(11);
  int made = 0, refused = 0;
  const std::vector<PlainMesh> meshes = {
      hf_test::grid(7, 6, 1, 0.3), hf_test::torus(14, 9),    hf_test::ball(2, 1, {0, 0, 0}),     hf_test::disk(4),
      hf_test::slab_with_holes(3), hf_test::ladder(1, 0.25), joined(hf_test::book(3, 4, 4, 0.3))};
  for (const PlainMesh& plain : meshes) {
    const Shape shape(plain);
    for (int round = 0; round < rounds; ++round) {
      const std::vector<CurvePoint> line = random_line(shape, random, round % 2 == 0);
      const double share = round % 3 == 0 ? 1e-6 : round % 3 == 1 ? 0.05 : 0.4;
      try {
        const TracedCut cut = shape.cut(line, share);
        const bool closed =
            cut_line(shape.mesh, shape.topology, {line.data(), line.size()}, {share, 1000000}, shape.memory).closed;
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

TEST(TraceCut, LinesPartWhatTheyShould) {
  // a closed line on a sphere: two discs
  const Shape ball(hf_test::ball(3, 1, {0, 0, 0}));
  const auto near = [&](const Shape& shape, Vec3 p) {
    std::uint32_t best = 0;
    double least = 1e9;
    for (std::uint32_t t = 0; t < shape.given.triangle_count(); ++t) {
      Vec3 centre;
      for (std::size_t k = 0; k < 3; ++k)
        centre = centre + (1.0 / 3) * row(shape.given.positions, shape.given.triangles[3 * t + k]);
      if (norm(centre - p) < least) {
        least = norm(centre - p);
        best = t;
      }
    }
    return shape.in(best, 0.3, 0.4);
  };
  std::vector<CurvePoint> ring;
  for (int i = 0; i < 5; ++i) ring.push_back(near(ball, {std::cos(1.26 * i), std::sin(1.26 * i), 0.3}));
  ring.push_back(ring.front());
  Counts now = counts(check(ball, ball.cut(ring), true));
  EXPECT_EQ(now.components, 2);
  EXPECT_EQ(now.euler, 2);
  // an open line on it: a slit
  ring.pop_back();
  now = counts(check(ball, ball.cut(ring)));
  EXPECT_EQ(now.components, 1);
  EXPECT_EQ(now.euler, 1);
  // round the tube of a torus: an annulus; along it too: a disc with a slit
  const Shape torus(hf_test::torus(24, 16));
  std::vector<CurvePoint> round;
  for (int i = 0; i < 4; ++i) round.push_back(near(torus, {2 + std::cos(1.57 * i), 0, std::sin(1.57 * i)}));
  round.push_back(round.front());
  now = counts(check(torus, torus.cut(round), true));
  EXPECT_EQ(now.components, 1);
  EXPECT_EQ(now.euler, 0);
  // a sheet from border to border, and from the border inwards
  const Shape sheet(hf_test::grid(8, 6, 1, 0.2));
  const std::vector<CurvePoint> across = {vertex(sheet.mesh.inner_of_given[3]), near(sheet, {4.3, 3.1, 0}),
                                          vertex(sheet.mesh.inner_of_given[9 * 6 + 4])};
  now = counts(check(sheet, sheet.cut(across)));
  EXPECT_EQ(now.components, 2);
  EXPECT_EQ(now.euler, 2);
  now = counts(check(sheet, sheet.cut({across[0], across[1]})));
  EXPECT_EQ(now.components, 1);
  EXPECT_EQ(now.euler, 1);
}

// The line is as long as the paths that it stands for, whatever it crosses.
TEST(TraceCut, LinesAreShortestPaths) {
  const Shape shape(hf_test::torus(20, 12));
  const TriangleSides sides(shape.mesh, shape.topology, shape.memory);
  std::mt19937 random(4);
  for (int round = 0; round < 40; ++round) {
    const CurvePoint from = shape.in(random() % shape.given.triangle_count(), 0.3, 0.3),
                     to = shape.in(random() % shape.given.triangle_count(), 0.2, 0.5);
    if (from.corner[0] == to.corner[0]) continue;
    const TracedCut cut = shape.cut({from, to}, 1e-6);
    const PlainMesh after = applied(shape, cut);
    double length = 0;
    for (std::size_t i = 2; i < cut.rims.size(); i += 2)
      length += norm(row(after.positions, cut.rims[i]) - row(after.positions, cut.rims[i - 2]));
    const SurfacePath path = shortest_path(sides, GeodesicPoint(sides, from.corner, from.weight, shape.memory),
                                           GeodesicPoint(sides, to.corner, to.weight, shape.memory), shape.memory);
    EXPECT_NEAR(length, shape.mesh.scale * path.length, 1e-5 * length) << round;
  }
}

// Straight lines leave no triangle thinner than the share: each part has more than the square of it.
TEST(TraceCut, NoSliversComeIn) {
  const Shape shape(hf_test::grid(9, 7, 1, 0.3));
  std::mt19937 random(9);
  for (const double share : {0.05, 0.2}) {
    for (int round = 0; round < 60; ++round) {
      const std::uint32_t from = random() % shape.given.vertex_count(), to = random() % shape.given.vertex_count();
      TracedCut cut(shape.memory);
      try {
        cut = shape.cut({vertex(shape.mesh.inner_of_given[from]), vertex(shape.mesh.inner_of_given[to])}, share);
      } catch (const Error& error) {
        ASSERT_EQ(error.code(), HF_ERROR_EMPTY) << error.what();
        continue;
      }
      for (std::size_t t = 0; t < cut.sources.size(); ++t) {
        const double* const w = &cut.weights[9 * t];
        const double area = (w[3] - w[0]) * (w[7] - w[1]) - (w[4] - w[1]) * (w[6] - w[0]);
        EXPECT_GT(area, share * share * (1 - 1e-6)) << round;
      }
    }
  }
}

TEST(TraceCut, LinesThatCannotBeCutAreRefusedByTheirSegment) {
  PlainMesh plain = hf_test::grid(6, 6);
  const Shape shape(plain);
  const auto v = [&](std::uint32_t x, std::uint32_t y) { return vertex(shape.mesh.inner_of_given[7 * y + x]); };
  EXPECT_EQ(shape.code({v(1, 1), v(4, 1), v(4, 4), v(2, 4), v(2, 0)}, 3), HF_ERROR_CONFLICT);  // crosses
  EXPECT_EQ(shape.code({v(1, 1), v(4, 1), v(4, 4), v(2, 4), v(2, 1)}, 3), HF_ERROR_CONFLICT);  // touches at its end
  EXPECT_EQ(shape.code({v(1, 1), v(4, 1), v(2, 1)}, 1), HF_ERROR_CONFLICT);                    // goes back
  EXPECT_EQ(shape.code({v(1, 1), v(1, 1)}, HF_NO_INDEX), HF_ERROR_EMPTY);
  EXPECT_EQ(shape.code({v(1, 1), v(2, 1)}, HF_NO_INDEX), HF_ERROR_EMPTY);
  EXPECT_EQ(shape.code({v(1, 0), v(2, 0)}, HF_NO_INDEX), HF_ERROR_EMPTY);  // along the border
  EXPECT_EQ(shape.code({v(0, 3), v(6, 4)}, 0, 0.05, 4), HF_ERROR_TOO_LARGE);
  EXPECT_EQ(shape.code({v(1, 1), v(2, 1), v(2, 1), v(3, 1)}, HF_NO_INDEX), HF_OK);
  // the middle of a triangle has no weight above a share of 0.4: it becomes a corner, and crashed once
  EXPECT_EQ(shape.code({shape.in(20, 0.34, 0.33), shape.in(50, 0.33, 0.34)}, HF_NO_INDEX, 0.4), HF_OK);
  // a point moves onto the edge that it is near to: along that edge, nothing is crossed
  EXPECT_EQ(shape.cut({v(1, 1), v(2, 1), v(3, 1)}).triangles.size(), shape.cut({v(1, 1), v(3, 1)}).triangles.size());
}

}  // namespace

// What the caller says of quads from crosses: directions, crease edges, a plane of symmetry.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "assets/creature.h"
#include "assets/shapes.h"
#include "base/error.h"
#include "quads/symmetric.h"
#include "support/creature.h"
#include "support/meshes.h"
#include "support/quad_oracle.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::quads;

std::shared_ptr<const surface::Core> core_of(const samples::ShapeMesh& shape) {
  return hf_test::make_core({shape.positions, shape.triangles});
}

// The mean angle between a direction and the nearest side of the quads, at the vertices that `near` takes.
template <class Near>
double angle_off(const remesh::QuadMesh& mesh, Vec3 direction, Near near) {
  double sum = 0, count = 0;
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    for (int k = 0; k < 4; ++k) {
      const Vec3 a = mesh.position[mesh.corner[4 * f + k]], b = mesh.position[mesh.corner[4 * f + (k + 1) % 4]];
      if (!near(0.5 * (a + b))) continue;
      const double along = std::min(1.0, std::fabs(dot(unit_vector(b - a), unit_vector(direction))));
      const double angle = std::acos(along) * 180 / std::acos(-1.0);
      sum += std::min(angle, 90 - angle);
      count += 1;
    }
  }
  return sum / count;
}

std::vector<QuadGuide> stroke(const surface::Core& core, Vec3 direction, double weight) {
  std::vector<QuadGuide> out;
  for (Index v = 0; v < core.size(); ++v) {
    const Vec3 p = core.mesh.positions[at(v)];
    if (norm(p) < 0.3) out.push_back({v, direction, weight, static_cast<Index>(out.size())});
  }
  return out;
}

TEST(GuidedQuads, edges_follow_guides_as_their_weight_says) {
  // A plane says nothing of directions but at its border, which is far away.
  const auto core = core_of(samples::plane(60, 60));
  ASSERT_LT(std::fabs(core->mesh.positions[0].z - core->mesh.positions[1].z) +
                std::fabs(core->mesh.positions[0].y - core->mesh.positions[1].y),
            1e-12);
  const Vec3 x = core->mesh.positions[1] - core->mesh.positions[0];
  Vec3 y{};
  for (const Vec3& p : core->mesh.positions) {
    if (std::fabs(dot(p - core->mesh.positions[0], x)) < 1e-12) y = p - core->mesh.positions[0];
  }
  const Vec3 slanting = unit_vector(x) + std::tan(0.5) * unit_vector(y);
  FieldQuadOptions options;
  options.core = core;
  options.faces = 1600;
  const auto near = [](Vec3 p) { return norm(p) < 0.1; };
  const double free = angle_off(make_field_quads(options).mesh, slanting, near);
  double off[2];
  for (int i = 0; i < 2; ++i) {
    const std::vector<QuadGuide> guides = stroke(*core, (i ? 1e-200 : 7.0) * slanting, i ? 0.3 : 1.0);
    options.guides = {guides.data(), guides.size()};
    const remesh::QuadMesh mesh = make_field_quads(options).mesh;
    hf_test::expect_manifold(*core, mesh, "guided");
    off[i] = angle_off(mesh, slanting, near);
  }
  std::printf("degrees off the guides: %.1f without, %.1f with weight 1, %.1f with weight 0.3\n", free, off[0], off[1]);
  EXPECT_GT(free, 25);  // 0.5 rad is 28.6 degrees
  EXPECT_LT(off[0], 4);
  EXPECT_LT(off[1], 18);
  EXPECT_GT(off[1], off[0]);
}

TEST(GuidedQuads, guides_of_one_vertex_are_averaged_and_opposite_ones_cancel) {
  const auto core = core_of(samples::plane(30, 30));
  const Vec3 x = core->mesh.positions[1] - core->mesh.positions[0];
  Vec3 y{};
  for (const Vec3& p : core->mesh.positions) {
    if (std::fabs(dot(p - core->mesh.positions[0], x)) < 1e-12) y = p - core->mesh.positions[0];
  }
  FieldQuadOptions options;
  options.core = core;
  options.faces = 400;
  const remesh::QuadMesh plain = make_field_quads(options).mesh;
  const auto with = [&](std::initializer_list<Vec3> directions) {
    std::vector<QuadGuide> guides;
    for (const Vec3& d : directions) {
      for (const QuadGuide& g : stroke(*core, d, 1)) guides.push_back(g);
    }
    options.guides = {guides.data(), guides.size()};
    return make_field_quads(options).mesh;
  };
  const Vec3 a = unit_vector(x), b = unit_vector(y);
  // A direction, the opposite one and both across are one cross.
  const remesh::QuadMesh once = with({a + 0.4 * b}), again = with({a + 0.4 * b, -1 * (a + 0.4 * b), b + -0.4 * a});
  ASSERT_EQ(once.position.size(), again.position.size());
  for (std::int32_t v = 0; v < once.position.size(); ++v)
    EXPECT_LT(norm(once.position[v] - again.position[v]), 1e-9) << v;
  // Two crosses at 45 degrees leave the vertex as it was without guides, but that the curvature loses its say.
  const remesh::QuadMesh none_left = with({a, a + b});
  EXPECT_EQ(none_left.face_count(), plain.face_count());
}

TEST(GuidedQuads, a_guide_that_stands_on_the_surface_is_refused) {
  const auto core = core_of(samples::plane(8, 8));
  const Vec3 x = core->mesh.positions[1] - core->mesh.positions[0];
  Vec3 up = cross(x, core->mesh.positions[20] - core->mesh.positions[0]);
  const std::vector<QuadGuide> guides{{3, x, 1, 0}, {4, up, 1, 1}};
  FieldQuadOptions options;
  options.core = core;
  options.faces = 30;
  options.guides = {guides.data(), guides.size()};
  try {
    make_field_quads(options);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), HF_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(error.index(), 1u);
  }
}

TEST(GuidedQuads, crease_edges_of_any_angle_become_edges_of_quads) {
  const auto core = core_of(samples::plane(25, 25));
  const mesh::Mesh& mesh = core->mesh;
  const Vec3 x = unit_vector(mesh.positions[1] - mesh.positions[0]);
  const auto in_middle = [&](Vec3 a, Vec3 b) { return std::fabs(dot(a, x)) < 1e-9 && std::fabs(dot(b, x)) < 1e-9; };
  std::vector<Index> creases;
  for (Index e = 0; e < core->topology().edge_count(); ++e) {
    if (in_middle(mesh.positions[at(core->topology().first(e))], mesh.positions[at(core->topology().second(e))]))
      creases.push_back(e);
  }
  ASSERT_EQ(creases.size(), 24u);
  FieldQuadOptions options;
  options.core = core;
  options.faces = 169;  // an odd number of columns, so that no line lies there by itself
  const auto covered = [&](const remesh::QuadMesh& quads) {
    double length = 0;
    for (std::int32_t i = 0; i < quads.corner.size(); ++i) {
      const Vec3 a = quads.position[quads.corner[i]], b = quads.position[quads.corner[i % 4 == 3 ? i - 3 : i + 1]];
      if (in_middle(a, b)) length += norm(b - a) / 2;  // both sides
    }
    return length;
  };
  EXPECT_EQ(covered(make_field_quads(options).mesh), 0);
  double height = 0;
  for (const Index e : creases)
    height += norm(mesh.positions[at(core->topology().second(e))] - mesh.positions[at(core->topology().first(e))]);
  options.crease_edges = {creases.data(), creases.size()};
  const remesh::QuadMesh kept = make_field_quads(options).mesh;
  hf_test::expect_manifold(*core, kept, "kept");
  EXPECT_NEAR(covered(kept), height, 1e-9);
}

// The plane is through a point of the caller's frame.
mesh::MirrorPlane plane_of(const surface::Core& core, Vec3 normal, double offset) {
  mesh::MirrorPlane plane;
  plane.normal = unit_vector(normal);
  plane.offset = (offset - dot(plane.normal, core.mesh.centre)) / core.mesh.scale;
  return plane;
}

// Every vertex and every face has its mirror image, which is turned over.
void expect_symmetric(const remesh::QuadMesh& mesh, const mesh::MirrorPlane& plane, const std::string& what) {
  std::vector<std::pair<std::array<double, 3>, std::int32_t>> sorted;
  std::vector<std::int32_t> image(static_cast<std::size_t>(mesh.position.size()), -1);
  for (std::int32_t v = 0; v < mesh.position.size(); ++v) {
    const Vec3 p = plane.reflect(mesh.position[v]);
    for (std::int32_t w = 0; w < mesh.position.size(); ++w) {
      if (norm(mesh.position[w] - p) < 1e-12) image[at(v)] = w;
    }
    ASSERT_GE(image[at(v)], 0) << what << " vertex " << v;
    EXPECT_EQ(mesh.border[v], mesh.border[image[at(v)]]) << what;
  }
  const auto first_least = [](std::array<std::int32_t, 4> face) {
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    return face;
  };
  std::map<std::array<std::int32_t, 4>, int> faces;
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    const std::int32_t* c = &mesh.corner[4 * f];
    ++faces[first_least({c[0], c[1], c[2], c[3]})];
  }
  for (const auto& [face, count] : faces) {
    const auto i = [&](int k) { return image[at(face[static_cast<std::size_t>(k)])]; };
    EXPECT_EQ(faces.count(first_least({i(0), i(3), i(2), i(1)})), 1u) << what;
    EXPECT_EQ(count, 1);
  }
}

void expect_near_surface(const surface::Core& core, const remesh::QuadMesh& mesh, double most,
                         const std::string& what) {
  for (std::int32_t v = 0; v < mesh.position.size(); ++v) {
    const remesh::SurfacePoint& point = mesh.location[v];
    Vec3 p;
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      ASSERT_GE(point.weight[k], -1e-9) << what;
      sum += point.weight[k];
      p = p + point.weight[k] * core.mesh.positions[at(core.mesh.triangle(point.triangle)[k])];
    }
    ASSERT_NEAR(sum, 1, 1e-9) << what;
    ASSERT_LT(norm(p - mesh.position[v]), most) << what << " vertex " << v;
  }
}

TEST(SymmetricQuads, quads_of_symmetric_surfaces_are_their_own_image) {
  struct Case {
    std::string name;
    std::shared_ptr<const surface::Core> core;
    Vec3 normal;
    double offset, off;
  };
  hf_test::PlainMesh eyes = hf_test::torus(24, 18, 0.2, 3);
  hf_test::PlainMesh pair = eyes;
  hf_test::append(pair, eyes, 9);
  for (std::size_t i = eyes.positions.size(); i < pair.positions.size(); i += 3)
    pair.positions[i] = 9 - eyes.positions[i - eyes.positions.size()];
  for (std::size_t i = eyes.triangles.size(); i < pair.triangles.size(); i += 3)
    std::swap(pair.triangles[i], pair.triangles[i + 1]);
  // off: chords of other triangles lie this far from the mirror image of a vertex.
  const std::vector<Case> cases{{"torus", core_of(samples::jittered_torus(60, 40)), {1, 0, 0}, 0, 2e-3},
                                {"torus, slanting", core_of(samples::jittered_torus(60, 40)), {3, 0, 4}, 0, 2e-3},
                                {"torus, the other way", core_of(samples::jittered_torus(60, 40)), {0, -2, 0}, 0, 2e-3},
                                {"sphere", core_of(samples::sphere(24)), {1, 2, 3}, 0, 2e-3},
                                {"rectangle", hf_test::make_core(hf_test::grid(20, 14, 1, 0.2)), {1, 0, 0}, 10, 1e-9},
                                {"two tori beside the plane", hf_test::make_core(pair), {1, 0, 0}, 4.5, 1e-9},
                                {"box", core_of(samples::box(3, 2, 1, 12, 9, 6)), {1, 0, 0}, 0, 1e-9}};
  for (const Case& c : cases) {
    for (const std::int32_t wanted : {200, 1500}) {
      FieldQuadOptions options;
      options.core = c.core;
      options.faces = wanted;
      options.plane = plane_of(*c.core, c.normal, c.offset);
      const std::string what = c.name + " " + std::to_string(wanted);
      const QuadResult result = make_field_quads(options);
      hf_test::expect_manifold(*c.core, result.mesh, what);
      expect_symmetric(result.mesh, *options.plane, what);
      expect_near_surface(*c.core, result.mesh, c.off + 1e-6, what);
      EXPECT_NEAR(result.mesh.face_count(), wanted, 0.1 * wanted) << what;
    }
  }
}

TEST(SymmetricQuads, guides_and_creases_of_the_kept_side_count) {
  const auto core = core_of(samples::plane(40, 40));
  const Vec3 x = unit_vector(core->mesh.positions[1] - core->mesh.positions[0]);
  std::vector<QuadGuide> guides;
  Vec3 y{};
  for (const Vec3& p : core->mesh.positions) {
    if (std::fabs(dot(p - core->mesh.positions[0], x)) < 1e-12) y = unit_vector(p - core->mesh.positions[0]);
  }
  const Vec3 middle = 0.18 * x;
  for (Index v = 0; v < core->size(); ++v) {
    const Vec3 p = core->mesh.positions[at(v)];
    // On the other side the guides say something else, which is not heard.
    if (norm(p - middle) < 0.16) guides.push_back({v, x + 0.6 * y, 1, 0});
    if (norm(p + middle) < 0.16) guides.push_back({v, x, 1, 0});
  }
  FieldQuadOptions options;
  mesh::MirrorPlane plane;
  plane.normal = x;
  options.core = core;
  options.faces = 900;
  options.plane = plane;
  options.guides = {guides.data(), guides.size()};
  const remesh::QuadMesh mesh = make_field_quads(options).mesh;
  expect_symmetric(mesh, plane, "guided");
  EXPECT_LT(angle_off(mesh, x + 0.6 * y, [&](Vec3 p) { return norm(p - middle) < 0.07; }), 8);
  EXPECT_LT(angle_off(mesh, x + -0.6 * y, [&](Vec3 p) { return norm(p + middle) < 0.07; }), 8);
}

TEST(SymmetricQuads, the_two_sides_of_a_plane_make_the_surface) {
  const auto core = core_of(samples::jittered_torus(30, 20));
  mesh::MirrorPlane plane = plane_of(*core, {1, 0, 2}, 0.1);
  double area[2] = {0, 0}, whole = 0;
  for (double& sum : area) {
    const HalfSurface half = HalfSurface::make(*core, plane);
    for (std::size_t t = 0; t < half.corner.size(); t += 3) {
      Vec3 p[3];
      for (std::size_t k = 0; k < 3; ++k) {
        p[k] = half.position[at(half.corner[t + k])];
        EXPECT_GE(plane.side(p[k]), -1e-12);
      }
      sum += 0.5 * norm(cross(p[1] - p[0], p[2] - p[0]));
    }
    plane.normal = -1 * plane.normal;
    plane.offset = -plane.offset;
  }
  for (const double a : core->areas) whole += a;
  EXPECT_NEAR(area[0] + area[1], whole, 0.002 * whole);    // vertices near the plane are moved onto it
  EXPECT_GT(std::fabs(area[0] - area[1]), 0.001 * whole);  // the plane is not through the middle
}

TEST(SymmetricQuads, surfaces_without_that_symmetry_are_refused) {
  const auto refusal = [](const std::shared_ptr<const surface::Core>& core, Vec3 normal, double offset) {
    FieldQuadOptions options;
    options.core = core;
    options.faces = 200;
    options.plane = plane_of(*core, normal, offset);
    try {
      make_field_quads(options);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), HF_ERROR_UNSUPPORTED);
      return std::string(error.what());
    }
    return std::string("none");
  };
  const auto torus = core_of(samples::jittered_torus(30, 20));
  EXPECT_NE(refusal(torus, {1, 0, 0}, 0.7).find("not symmetric"), std::string::npos);
  EXPECT_NE(refusal(core_of(hf_test::cactus(2000)), {1, 0.3, 0.2}, 0).find("not symmetric"), std::string::npos);
  EXPECT_EQ(refusal(torus, {1, 0, 0}, 0), "none");
}

// A long thin box is a trough on one side of a plane along it: quads there have three or four sides on the plane.
TEST(SymmetricQuads, thin_parts_on_the_plane_keep_their_shape) {
  for (const double thick : {0.05, 0.1, 0.3}) {
    samples::ShapeMesh mesh = samples::box(thick, thick, 3, 4, 4, 40);
    samples::ShapeMesh ball = samples::sphere(10);
    const std::uint32_t base = static_cast<std::uint32_t>(mesh.positions.size() / 3);
    for (std::size_t i = 0; i < ball.positions.size(); ++i)
      mesh.positions.push_back(ball.positions[i] + (i % 3 == 1 ? 2.0 : 0.0));
    for (const std::uint32_t v : ball.triangles) mesh.triangles.push_back(base + v);
    const auto core = core_of(mesh);
    for (const std::int32_t wanted : {20, 60, 200, 1000}) {
      const std::string what = std::to_string(thick) + " thick, " + std::to_string(wanted) + " quads";
      FieldQuadOptions options;
      options.core = core;
      options.faces = wanted;
      options.plane = plane_of(*core, {1, 0, 0}, 0);
      const remesh::QuadMesh quads = make_field_quads(options).mesh;
      hf_test::expect_manifold(*core, quads, what);
      expect_symmetric(quads, *options.plane, what);
      double low = 1e9, high = -1e9, width = 0;
      for (std::int32_t v = 0; v < quads.position.size(); ++v) {
        const Vec3 p = core->mesh.to_given(quads.position[v]);
        if (p.y > 0.9) continue;  // the ball
        low = std::min(low, p.z);
        high = std::max(high, p.z);
        width = std::max(width, p.x);
      }
      EXPECT_GT(high - low, 2.5) << what;
      EXPECT_GT(width, 0.3 * thick) << what;
    }
  }
}

// The corners 0 to 3 lie on the plane, and more where it is said. place puts new vertices on a sphere.
TEST(SymmetricQuads, quads_at_the_plane_go_or_get_a_row) {
  const auto core = core_of(samples::sphere(6));
  Memory& memory = *core->memory;
  const mesh::NearestTriangle nearest(core->mesh.positions, core->mesh.corners, memory);
  const PlaceOnSurface place{*core, nearest};
  struct Case {
    std::string name;
    std::vector<std::int32_t> corners;
    std::int32_t vertices;
    std::vector<std::int32_t> off_plane;
    std::int32_t faces, sides;
  };
  const std::vector<Case> cases{{"nothing on the plane", {0, 1, 4, 5, 1, 2, 3, 4}, 6, {0, 1, 2, 3, 4, 5}, 2, 0},
                                {"a row along the plane stays", {0, 1, 5, 4, 1, 2, 6, 5}, 7, {4, 5, 6}, 2, 2},
                                {"a small piece with a tongue", {0, 1, 2, 3, 0, 3, 4, 5}, 6, {4, 5}, 5, 3},
                                {"one quad gets a row all round", {0, 1, 2, 3}, 4, {}, 5, 4},
                                {"so do two", {0, 1, 4, 3, 1, 2, 5, 4}, 6, {}, 8, 6},
                                {"and three", {0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6}, 8, {}, 11, 8},
                                {"a strip between two lines of the plane",
                                 {0, 1, 4, 3, 1, 2, 5, 4, 6, 0, 3, 7, 2, 8, 9, 5},
                                 10,
                                 {6, 7, 8, 9},
                                 8,
                                 4}};
  // A tongue of two quads on a sheet of 6 by 6: the sheet's vertices 7 y + x, two of which lie on the plane.
  Case sheet{"a large piece with a tongue", {}, 53, {}, 36, 1};
  for (std::int32_t y = 0; y < 6; ++y) {
    for (std::int32_t x = 0; x < 6; ++x) {
      for (const std::int32_t v : {7 * y + x, 7 * y + x + 1, 7 * y + x + 8, 7 * y + x + 7}) sheet.corners.push_back(v);
    }
  }
  for (const std::int32_t v : {3, 2, 50, 49, 49, 50, 52, 51}) sheet.corners.push_back(v);
  for (std::int32_t v = 0; v < 49; ++v) {
    if (v != 2 && v != 3) sheet.off_plane.push_back(v);
  }
  std::vector<Case> all = cases;
  all.push_back(sheet);
  for (const Case& c : all) {
    remesh::QuadMesh mesh(memory);
    for (std::int32_t v = 0; v < c.vertices; ++v)
      mesh.add_vertex({}, {0, 0.1 * std::cos(0.7 * v), 0.1 * std::sin(0.7 * v)}, remesh::QuadMesh::feature, true, 1);
    for (const std::int32_t v : c.corners) mesh.corner.push_back(v);
    remesh::Table<std::uint8_t> on_plane(c.vertices, 1, memory);
    for (const std::int32_t v : c.off_plane) on_plane[v] = 0;
    std::int32_t sides = -1;
    mesh::MirrorPlane plane;
    prepare_at_plane(mesh, on_plane, plane, place, sides, memory);
    EXPECT_EQ(mesh.face_count(), c.faces) << c.name;
    EXPECT_EQ(sides, c.sides) << c.name;
    EXPECT_EQ(on_plane.size(), mesh.position.size()) << c.name;
    // No quad has three sides on the plane, and no side off the border lies there.
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> times;
    for (std::int32_t i = 0; i < mesh.corner.size(); ++i) {
      const std::int32_t a = mesh.corner[i], b = mesh.corner[i % 4 == 3 ? i - 3 : i + 1];
      if (on_plane[a] && on_plane[b]) ++times[{std::min(a, b), std::max(a, b)}];
    }
    for (const auto& [edge, count] : times) EXPECT_EQ(count, 1) << c.name;
  }
}

}  // namespace

// Bug reports against other tools, re-created on hf. The comment over a test names the tool and the number of the
// report; the test asks for what is right. Inputs are made here, so the tests need no data.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/mesh_file.h"
#include "gltf/animate.h"
#include "hf/hf.hpp"
#include "reports_shapes.h"
#include "unit/gltf/gltf_support.h"

namespace {

using namespace reports;

hf::Geodesics geodesics(const hf::Surface& surface, int32_t method) {
  auto desc = hf::make<hf_geodesics_desc>();
  desc.method = method;
  return hf::Geodesics(surface, desc);
}

hf_place place(uint32_t a, uint32_t b, uint32_t c, double x, double y, double z) { return {{a, b, c}, 0, {x, y, z}}; }
hf_place place(uint32_t vertex) { return place(vertex, vertex, vertex, 1, 0, 0); }

double length_of(const std::vector<double>& path) {
  double out = 0;
  for (size_t i = 3; i < path.size(); i += 3) {
    out += std::hypot(path[i] - path[i - 3], path[i + 1] - path[i - 2], path[i + 2] - path[i - 1]);
  }
  return out;
}

constexpr int32_t methods[] = {HF_GEODESICS_AUTO, HF_GEODESICS_FRONT, HF_GEODESICS_EXACT, HF_GEODESICS_HEAT};

// libigl 2554 (0 for a vertex that cannot be reached), pygeodesic 11 (length 0 and an empty path), splocs 6 (NaN)
TEST(Reports, AVertexOfAnotherPieceIsNotReached) {
  Shape two = grid(2, 2);
  two.add(grid(2, 2), {5, 0, 0});
  const hf::Surface surface = two.surface();
  for (const int32_t method : methods) {
    const hf::Geodesics tool = geodesics(surface, method);
    const std::vector<double> distance = tool.solve_f64({0});
    for (uint32_t v = 4; v < 8; ++v) EXPECT_EQ(distance[v], -1) << method;
    auto path = hf::make<hf_path>();
    const hf_place from = place(0), to = place(7);
    ASSERT_EQ(hf_geodesics_find_path(tool.get(), &from, &to, &path), HF_OK);
    EXPECT_EQ(path.point_count, 0u);
    EXPECT_EQ(path.length, -1);
  }
}

// libigl 1048 (a grid of nine vertices: twice as far, not symmetric), 1511 (twice as far), 2442 (neighbours),
// potpourri3d 30
TEST(Reports, DistancesInAPlaneAreStraightOnTheCoarsestMeshes) {
  Shape kite;
  kite.add({0, 0, 0});
  kite.add({1, -3, 0});
  kite.add({2, 0, 0});
  kite.add({1, 3, 0});
  kite.triangles = {0, 1, 2, 0, 2, 3};
  for (const Shape& shape : {grid(3, 3), kite}) {
    const hf::Surface surface = shape.surface();
    for (const int32_t method : {HF_GEODESICS_AUTO, HF_GEODESICS_FRONT, HF_GEODESICS_EXACT}) {
      for (uint32_t v = 0; v < shape.count(); ++v) {
        const std::vector<double> distance = geodesics(surface, method).solve_f64({v});
        // the straight line between the tips of the kite leaves it
        for (uint32_t w = 0; w < shape.count(); ++w) {
          const bool tips = shape.count() == 4 && v % 2 == 1 && w % 2 == 1 && v != w;
          EXPECT_NEAR(distance[w], tips ? 6 : between(shape.at(v), shape.at(w)), 1e-12)
              << method << ": " << v << " " << w;
        }
      }
    }
  }
}

// geometry-central 36 (heat that has died away before the end of a long mesh)
TEST(Reports, DistancesGrowToTheEndOfALongStrip) {
  const hf::Surface surface = grid(2001, 3).surface();
  for (const int32_t method : methods) {
    const std::vector<double> distance = geodesics(surface, method).solve_f64({2001});
    for (uint32_t v = 2002; v < 4002; ++v) ASSERT_GT(distance[v], distance[v - 1]) << method;
    EXPECT_NEAR(distance[4001], 2000, 2) << method;
  }
}

// CGAL 6681 (a source on a border: 2.118 for 0.5), 1179 (both ends on one edge)
TEST(Reports, PathsFromPointsOfBordersAndEdgesAreStraightBothWays) {
  Shape square = grid(2, 2);
  const hf::Surface surface = square.surface();
  const hf::Geodesics tool(surface);
  // triangles 0 1 3 and 0 3 2 of the unit square
  const struct {
    hf_place a, b;
    double length;
  } cases[] = {{place(0, 1, 3, 0.5, 0.5, 0), place(0, 3, 2, 0.5, 0, 0.5), std::sqrt(0.5)},
               {place(0, 1, 3, 0.5, 0.5, 0), place(0, 1, 3, 0.25, 0.75, 0), 0.25},
               {place(0, 1, 3, 0.5, 0.5, 0), place(0, 1, 3, 0.5, 0, 0.5), 0.5},
               {place(0, 1, 3, 0.5, 0.5, 0), place(0), 0.5},
               {place(0, 1, 3, 0.5, 0.5, 0), place(0, 1, 3, 0.5, 0.5, 0), 0}};
  for (const auto& o : cases) {
    EXPECT_NEAR(length_of(tool.find_path(o.a, o.b).positions), o.length, 1e-12);
    EXPECT_NEAR(length_of(tool.find_path(o.b, o.a).positions), o.length, 1e-12);
  }
}

// CGAL 3993 (a path that stays at a border once it meets one)
TEST(Reports, APathLeavesABorderBehindAnInnerCorner) {
  Shape u = grid(9, 9);
  std::vector<uint32_t> kept;
  for (size_t t = 0; t < u.triangles.size(); t += 3) {
    double x = 0, y = 0;
    for (int k = 0; k < 3; ++k) {
      x += u.at(u.triangles[t + k])[0] / 3;
      y += u.at(u.triangles[t + k])[1] / 3;
    }
    if (x > 3 && x < 5 && y > 2) continue;
    kept.insert(kept.end(), &u.triangles[t], &u.triangles[t] + 3);
  }
  u.triangles = kept;
  const hf::Surface surface = u.surface();
  // from one top corner around both inner corners, 3 2 and 5 2, to the other
  EXPECT_NEAR(length_of(hf::Geodesics(surface).find_path(place(72), place(80)).positions), 2 * std::hypot(3, 6) + 2,
              1e-12);
  EXPECT_NEAR(length_of(hf::Geodesics(surface).find_path(place(75), place(77)).positions), 6 + 2 + 6, 1e-12);
}

// geometry-central 114 (no map of a point on an edge)
TEST(Reports, TheMapOfAPointAnywhereInAPlaneIsThePlane) {
  const Shape shape = grid(6, 6);
  const hf::Surface surface = shape.surface();
  const hf::Geodesics tool(surface);
  for (const hf_place& o : {place(14, 15, 21, 0.5, 0.5, 0), place(14, 15, 21, 0.4, 0, 0.6),
                            place(14, 15, 21, 0.2, 0.3, 0.5), place(0), place(3), place(14)}) {
    const std::vector<double> map = std::get<0>(tool.map(o));
    for (uint32_t v = 0; v < 36; ++v) {
      for (uint32_t w = 0; w < v; ++w) {
        const double apart = std::hypot(map[2 * v] - map[2 * w], map[2 * v + 1] - map[2 * w + 1]);
        ASSERT_NEAR(apart, between(shape.at(v), shape.at(w)), 1e-12);
      }
    }
  }
}

// libigl 1245, xarray-spatial 2790 and 2892 (lines of length zero at vertices on the level), geometry-central 251 (no
// line through vertices)
TEST(Reports, LinesThroughVerticesAreWholeAndHaveNoSegmentOfLengthZero) {
  const hf::Surface surface = grid(4, 4).surface();
  const struct {
    std::vector<double> field;
    double level;
    size_t lines;
    double length;
  } cases[] = {{{0, 0, 0, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 0, 0, 0}, 1, 1, 4},
               {{0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3}, 1, 1, 3},
               {{0, -1, -2, -3, 1, 0, -1, -2, 2, 1, 0, -1, 3, 2, 1, 0}, 0, 1, std::sqrt(18.0)},
               {{0, 1, 2, 3, 1, 2, 3, 4, 2, 3, 4, 5, 3, 4, 5, 6}, 3, 1, std::sqrt(18.0)},
               {std::vector<double>(16, 1.0), 1, 0, 0}};
  for (const auto& o : cases) {
    const hf::Isolines found = surface.trace_isolines(o.field, {o.level});
    ASSERT_EQ(found.line_closed.size(), o.lines);
    double length = 0;
    for (size_t line = 0; line < o.lines; ++line) {
      const uint32_t first = found.line_starts[line], end = found.line_starts[line + 1];
      for (uint32_t i = first; i + (found.line_closed[line] ? 0 : 1) < end; ++i) {
        const uint32_t next = i + 1 < end ? i + 1 : first;
        const double step = std::hypot(found.positions[3 * i] - found.positions[3 * next],
                                       found.positions[3 * i + 1] - found.positions[3 * next + 1]);
        EXPECT_GT(step, 0.1);
        length += step;
      }
    }
    EXPECT_NEAR(length, o.length, 1e-12);
  }
}

// embree 174, tinybvh 168, trimesh 1496 (rays through vertices and edges pass)
TEST(Reports, RaysThroughVerticesAndEdgesHit) {
  const Shape shape = tube(9, 0.7);
  const hf::Surface surface = shape.surface();
  const std::vector<double> inside = {0.05, 0.9, -0.1};
  for (size_t i = 0; i < shape.triangles.size(); ++i) {
    const size_t first = i - i % 3;
    const Point a = shape.at(shape.triangles[i]), b = shape.at(shape.triangles[first + (i + 1) % 3]);
    for (const double t : {0.0, 0.25, 1.0 / 3, 0.5}) {
      std::vector<double> towards(3);
      for (size_t c = 0; c < 3; ++c) towards[c] = a[c] + t * (b[c] - a[c]) - inside[c];
      ASSERT_NE(surface.cast_ray(inside, towards).found, 0) << i << " " << t;
    }
  }
}

// libigl 2526 (indices that do not sum to the Euler characteristic; none at the poles of a field of longitudes)
TEST(Reports, IndicesOfCrossesSumToTheEulerCharacteristic) {
  const Shape closed = tube(9, 0.7);
  const hf::Surface surface = closed.surface();
  for (const uint32_t degree : {1, 2, 4}) {
    hf::DirectionOptions options;
    options.degree = degree;
    hf::Direction field(surface, options);
    std::vector<uint32_t> vertices;
    std::vector<double> vectors;
    for (uint32_t v = 0; v < 9 * around; ++v) {
      vertices.push_back(v);
      vectors.insert(vectors.end(), {-closed.at(v)[2], 0, closed.at(v)[0]});
    }
    field.add_sites(vertices, vectors);
    int32_t start = 0, end = 0;
    for (const hf_singularity& o : field.singularities()) (o.vertex == 9 * around ? start : end) += o.index;
    EXPECT_EQ(start + end, 2 * degree);
    EXPECT_EQ(start, degree);
  }
}

// Weights of one bone, by vertex, of a tube along y with three bones; pieces: more behind it.
std::vector<double> weights_of(const Shape& shape, uint32_t bone, bool points = false) {
  const double heads[] = {0, 0.05, 0, 0, 0.7, 0, 0, 1.3, 0}, tails[] = {0, 0.7, 0, 0, 1.3, 0, 0, 1.95, 0};
  const double places[] = {0, 0.3, 0, 0, 1, 0, 0, 1.7, 0};
  auto bones = hf::make<hf_joints_desc>();
  bones.joint_count = 3;
  bones.heads = points ? places : heads;
  bones.tails = points ? places : tails;
  const hf::Surface surface = shape.surface();
  hf_weights weights = nullptr;
  hf::check(hf_weights_create(surface.get(), &bones, 4, &weights));
  std::vector<uint32_t> joints(4 * shape.count());
  std::vector<float> shares(4 * shape.count());
  auto out = hf::make<hf_weights_out>();
  out.vertex_capacity = shape.count();
  out.joints = joints.data();
  out.weights = shares.data();
  hf::check(hf_weights_get(weights, &out));
  hf_weights_destroy(weights);
  std::vector<double> found(shape.count());
  for (size_t i = 0; i < joints.size(); ++i) found[i / 4] += joints[i] == bone ? static_cast<double>(shares[i]) : 0;
  return found;
}

// image-to-3dlab 12 (specks beside a body leave every bone without weights), MEPP2 32 (vertices in no triangle)
TEST(Reports, SpecksBesideABodyDoNotChangeItsWeights) {
  const Shape body = tube(41, 0.2);
  Shape all = body;
  for (int k = 0; k < 13; ++k) all.add(cube(0.01), {0.6 * std::cos(k), 0.15 * k, 0.6 * std::sin(k)});
  all.add({0.4, 0.4, 0.4});
  std::vector<double> sum(all.count());
  for (uint32_t bone = 0; bone < 3; ++bone) {
    const std::vector<double> alone = weights_of(body, bone), beside = weights_of(all, bone);
    for (uint32_t v = 0; v < all.count(); ++v) {
      if (v < body.count()) {
        EXPECT_EQ(alone[v], beside[v]) << v;
      }
      sum[v] += beside[v];
    }
  }
  for (const double s : sum) EXPECT_NEAR(s, 1, 1e-6);
}

// libigl 1249 (bones that are points inside, not at vertices), spine-editor 587 (bones outside)
TEST(Reports, BonesThatArePointsMoveTheVerticesAroundThem) {
  const Shape body = tube(41, 0.2);
  const std::vector<double> first = weights_of(body, 0, true), middle = weights_of(body, 1, true);
  for (uint32_t i = 0; i < around; ++i) {
    EXPECT_GT(first[i], 0.9);
    EXPECT_GT(middle[20 * around + i], 0.9);
    EXPECT_NEAR(middle[10 * around + i], middle[30 * around + i], 1e-4);
  }
}

// robust-weight-transfer 21 (two socks of one mesh mix), BodySlide 488 (vertices too far away stay without weights)
TEST(Reports, EachSockTakesTheWeightsOfItsLeg) {
  Shape legs = tube(21, 0.2), socks = tube(9, 0.24);
  const uint32_t leg = legs.count(), sock = socks.count();
  legs.add(tube(21, 0.2), {0.5, 0, 0});
  socks.add(tube(9, 0.24), {0.48, 0, 0});
  socks.add(tube(9, 0.05), {9, 1, 0});  // far from both
  std::vector<uint32_t> joints(legs.count());
  std::fill(joints.begin() + leg, joints.end(), 1u);
  const std::vector<float> weights(legs.count(), 1.0f);
  auto desc = hf::make<hf_weights_transfer_desc>();
  desc.source_influence_count = 1;
  desc.joints = joints.data();
  desc.weights = weights.data();
  std::vector<uint32_t> out_joints(4 * socks.count());
  std::vector<float> out_weights(4 * socks.count());
  auto out = hf::make<hf_weights_out>();
  out.vertex_capacity = socks.count();
  out.joints = out_joints.data();
  out.weights = out_weights.data();
  const hf::Surface from = legs.surface(), to = socks.surface();
  hf::check(hf_weights_transfer(from.get(), to.get(), &desc, &out, nullptr));
  for (uint32_t v = 0; v < socks.count(); ++v) {
    EXPECT_EQ(out_joints[4 * v], v < sock ? 0u : 1u) << v;
    EXPECT_NEAR(static_cast<double>(out_weights[4 * v]), 1, 1e-6) << v;
  }
}

// A pose with a handle that stays and one that turns by 45 degrees and moves.
std::vector<double> posed(const Shape& shape, const std::vector<uint32_t>& still, const std::vector<uint32_t>& moved) {
  const hf::Surface surface = shape.surface();
  hf::Pose pose(surface);
  const std::vector<uint32_t> handles = pose.add_handles({still, moved});
  pose.set_transform(handles[1], {{std::sin(pi / 8), 0, 0, std::cos(pi / 8)}}, {{0, -0.2, 0.3}});
  std::vector<double> out(shape.positions.size());
  auto desc = hf::make<hf_deform_desc>();
  desc.positions_f64 = out.data();
  hf::check(hf_pose_deform(pose.get(), &desc, nullptr));
  return out;
}

// CGAL 2124 (faces of area zero: NaN), libigl 1252 and Open3D 4049 (pieces without a handle, a box of eight vertices:
// cannot be factorised)
TEST(Reports, PosesAreFiniteOnFacesWithoutAreaLoosePiecesAndBoxes) {
  std::vector<uint32_t> first, last;
  for (uint32_t i = 0; i < around; ++i) {
    first.push_back(i);
    last.push_back(40 * around + i);
  }
  Shape body = tube(41, 0.2);
  const uint32_t count = body.count();
  body.add(body.at(100));
  body.add(body.at(100));
  for (const uint32_t v : {100u, count, count + 1, 7u, 7u, 8u, 160u, 176u, 192u}) body.triangles.push_back(v);
  body.add(cube(1), {3, 0, 0});
  const std::vector<double> out = posed(body, first, last);
  for (size_t i = 0; i < out.size(); ++i) ASSERT_TRUE(std::isfinite(out[i])) << i;
  for (uint32_t v = count + 2; v < body.count(); ++v) {
    for (uint32_t c = 0; c < 3; ++c) EXPECT_NEAR(out[3 * v + c], body.at(v)[c], 1e-9);
  }
  const Shape box = cube(1);
  const std::vector<double> bent = posed(box, {0, 1, 2, 3}, {7});
  for (uint32_t v = 0; v < 4; ++v) {
    for (uint32_t c = 0; c < 3; ++c) EXPECT_NEAR(bent[3 * v + c], box.at(v)[c], 1e-12);
  }
  for (const double x : bent) EXPECT_LT(std::abs(x), 3);
}

samples::SurfaceMesh read(const std::string& text, const std::string& extension) {
  return samples::read_mesh_bytes({text.begin(), text.end()}, extension, "test" + extension);
}

// assimp 3532 (a backslash at the end of a comment swallows the next line), 2186 (names with backslashes), PMP 221
// (tabs)
TEST(Reports, BackslashesInCommentsAndNamesContinueNothing) {
  const auto mesh = read("# head\\Solid\\\nv 0 0 0\nv\t1\t0\t0\nv 0 1 0\nusemtl a\\b\\Normal\nf\t1\t2 3\n", ".obj");
  EXPECT_EQ(mesh.positions.size(), 3u);
  EXPECT_EQ(mesh.triangles, (std::vector<uint32_t>{0, 1, 2}));
}

// three.js 14937 (a header with line ends of two bytes), assimp 4755 (data that begin with a line end), happly 12
// (obj_info)
TEST(Reports, BinaryDataBeginBehindTheFirstLineEndOfThePlyHeader) {
  std::string data("\n\r\n\x20", 4);  // a small number, the first x
  for (const float x : {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) data.append(reinterpret_cast<const char*>(&x), 4);
  data += '\3';
  for (const int32_t v : {0, 1, 2}) data.append(reinterpret_cast<const char*>(&v), 4);
  for (const std::string end : {"\n", "\r\n"}) {
    std::string header;
    for (const char* line : {"ply", "format binary_little_endian 1.0", "obj_info made by a scanner!",
                             "element vertex 3", "property float x", "property float y", "property float z",
                             "element face 1", "property list uchar int vertex_indices", "end_header"}) {
      header += line + end;
    }
    const auto mesh = read(header + data, ".ply");
    EXPECT_EQ(mesh.triangles, (std::vector<uint32_t>{0, 1, 2}));
    EXPECT_EQ(mesh.positions[1], glm::dvec3(1, 0, 0));
    EXPECT_NEAR(mesh.positions[0].x, 0, 1e-15);
  }
}

// glTF-Blender-Exporter 234 (one key of a cubic spline), Godot 83617 (a spline with too few values: crash), glTF 1327
// (a first key later than 0), raylib 6048 (the end of a clip jumps to its start)
TEST(Reports, OneKeyIsHeldAndAClipEndsAtItsLastKey) {
  using samples_test::GlbBuilder;
  const auto model = [](std::vector<float> times, std::vector<float> values, const char* interpolation) {
    GlbBuilder file;
    file.triangle_mesh({{"POSITION", file.floats(samples_test::unit_triangle(), "VEC3")}});
    const int input = file.floats(times, "SCALAR"), output = file.floats(values, "VEC3");
    file.document["animations"] = {
        {{"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
    return file;
  };
  const auto x_at = [](const GlbBuilder& file, double time) {
    const hf_gltf::Model read = file.read();
    return hf_gltf::sample(read, read.animations[0], time)[0].translation.x;
  };
  for (const double time : {0.0, 2.5, 9.0}) {
    EXPECT_EQ(x_at(model({2.5f}, {9, 9, 9, 1, 2, 3, 9, 9, 9}, "CUBICSPLINE"), time), 1);
    EXPECT_EQ(x_at(model({2.5f}, {1, 2, 3}, "LINEAR"), time), 1);
    EXPECT_EQ(x_at(model({2.5f}, {1, 2, 3}, "STEP"), time), 1);
  }
  const GlbBuilder late = model({2, 3}, {1, 0, 0, 2, 0, 0}, "LINEAR");
  EXPECT_EQ(x_at(late, 0), 1);
  EXPECT_EQ(x_at(late, 2.5), 1.5);
  EXPECT_EQ(x_at(late, 3), 2);
  const GlbBuilder few = model({0, 1}, {1, 0, 0, 2, 0, 0}, "CUBICSPLINE");
  EXPECT_NE(samples_test::message_of([&] { few.read(); }).find("2 keys ask for 6"), std::string::npos);
}

}  // namespace

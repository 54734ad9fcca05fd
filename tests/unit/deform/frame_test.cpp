// What a frame writes: the blend on every kind of lanes, normals by pieces, weights in whole steps.
#include <gtest/gtest.h>

#include <cstring>
#include <numeric>
#include <random>

#include "cases.h"
#include "deform/blend_rows.h"
#include "deform/normals_avx2.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::deform;
using namespace deform_test;

// The plane with its vertices in any order: every piece of vertices has triangles that lie across to all others.
Case scattered_plane() {
  Case c = plane_lift();
  const std::size_t n = c.mesh.vertex_count();
  std::vector<std::uint32_t> to(n);
  std::iota(to.begin(), to.end(), 0u);
  std::mt19937 random(5);
  std::shuffle(to.begin(), to.end(), random);
  const hf_test::PlainMesh before = c.mesh;
  for (std::size_t v = 0; v < n; ++v) std::copy_n(&before.positions[3 * v], 3, &c.mesh.positions[3 * to[v]]);
  for (auto& corner : c.mesh.triangles) corner = to[corner];
  return c;
}

std::vector<Vec3> normals_one_by_one(const mesh::Mesh& mesh, const std::vector<Vec3>& x) {
  std::vector<Vec3> sum(x.size());
  for (std::int32_t t = 0; t < mesh.triangle_count(); ++t) {
    const std::int32_t* k = mesh.triangle(t);
    const Vec3 n = cross(x[k[1]] - x[k[0]], x[k[2]] - x[k[0]]);
    for (int c = 0; c < 3; ++c) sum[k[c]] = sum[k[c]] + n;
  }
  for (Vec3& n : sum) n = (1 / norm(n)) * n;
  return sum;
}

TEST(Frame, NormalsAreThoseOfTheTrianglesRoundAVertexWhateverThePieces) {
  for (const Case& c : {plane_lift(), scattered_plane(), cactus_bend(70, 9000)}) {
    const Dragged d = drag(c, {}, 3);
    ASSERT_GT(d.core->size(), 2 * vertex_piece);
    const DeformReport report = d.pose->deform({true, 1, false});
    const std::vector<Vec3> wanted = normals_one_by_one(d.core->mesh, positions(report));
    ASSERT_EQ(report.normals.size(), wanted.size());
    double off = 0;
    for (std::size_t v = 0; v < wanted.size(); ++v) off = std::max(off, norm(to_vec3(report.normals[v]) - wanted[v]));
    EXPECT_LT(off, 1e-6) << c.name;
    // the loop of processors without lanes
    const std::vector<Vec3> x = positions(report);
    std::vector<float> sum(4 * x.size());
    const NormalRows rows{&x[0].x, 1 / d.core->mesh.scale, sum.data(), nullptr};
    add_border_normals_plain(rows, d.core->mesh.corners.data(), d.core->mesh.triangle_count(), 0, d.core->size());
    for (std::size_t v = 0; v < x.size(); ++v) {
      const Vec3 n{sum[4 * v], sum[4 * v + 1], sum[4 * v + 2]};
      EXPECT_LT(norm((1 / norm(n)) * n - wanted[v]), 1e-5) << c.name << " " << v;
    }
  }
}

// Sizes where a normal of a triangle, or its square, leaves single precision.
TEST(Frame, NormalsHoldForTinyAndHugeSurfaces) {
  const Case c = cactus_bend(70, 1500);
  const auto core = hf_test::make_core(c.mesh, 1);
  const Rest rest(*core, *core->memory);
  const std::vector<Vec3> p = deform_test::rest(*core);
  const std::vector<Vec3> wanted = normals_one_by_one(core->mesh, p);
  std::vector<NormalSum> sums(p.size());
  std::vector<Normal> normals(p.size());
  for (const double size : {1e-15, 1e-9, 1e-4, 1.0, 1e4, 1e9, 1e14}) {
    std::vector<Vec3> x;
    for (const Vec3& q : p) x.push_back(size * q);
    vertex_normals(core->mesh, rest, x.data(), sums.data(), normals.data(), *core->jobs);
    double off = 0;
    for (std::size_t v = 0; v < p.size(); ++v) off = std::max(off, norm(to_vec3(normals[v]) - wanted[v]));
    EXPECT_LT(off, 1e-6) << size;
  }
  const std::vector<Vec3> point(p.size(), p[0]);
  vertex_normals(core->mesh, rest, point.data(), sums.data(), normals.data(), *core->jobs);
  for (const Normal& n : normals) EXPECT_TRUE(n.x == 0 && n.y == 0 && n.z == 1);
}

// The unit of the mesh: areas of 1e50 and 1e-50 are no floats.
TEST(Frame, NormalsDoNotDependOnTheUnitOfTheMesh) {
  for (const double unit : {1e-25, 1e25}) {
    Case c = cactus_bend(70, 1500);
    for (double& x : c.mesh.positions) x *= unit;
    const auto core = hf_test::make_core(c.mesh, 1);
    const Rest rest(*core, *core->memory);
    const std::vector<Vec3> p = deform_test::rest(*core), wanted = normals_one_by_one(core->mesh, p);
    std::vector<NormalSum> sums(p.size());
    std::vector<Normal> normals(p.size());
    vertex_normals(core->mesh, rest, p.data(), sums.data(), normals.data(), *core->jobs);
    double off = 0;
    for (std::size_t v = 0; v < p.size(); ++v) off = std::max(off, norm(to_vec3(normals[v]) - wanted[v]));
    EXPECT_LT(off, 1e-6) << unit;
  }
}

TEST(Frame, WeightsAreWholeStepsAndSumToOneExactly) {
  const Case c = cactus_bend();
  Dragged d = set_up(c, {});
  add(*d.pose,
      {select(*d.core, [](Vec3 p) { return p.x > 0.55; }), select(*d.core, [](Vec3 p) { return p.x < -0.5; })});
  const ClusterWeights& w = *d.pose->weights();
  std::size_t shared = 0;
  for (std::int32_t v = 0; v < d.core->size(); ++v) {
    double sum = 0;
    for (std::int32_t k = w.start[v]; k < w.start[v + 1]; ++k) {
      const double steps = 16777216.0 * w.weight[k];
      EXPECT_EQ(steps, std::floor(steps));
      EXPECT_GE(steps, 1);
      sum += w.weight[k];
    }
    EXPECT_EQ(sum, 1) << v;
    shared += w.start[v + 1] - w.start[v] > 3;
  }
  EXPECT_GT(shared, 1000u);
}

void expect_same_blend(const Dragged& d) {
  const mesh::Mesh& mesh = d.core->mesh;
  const ClusterWeights& w = *d.pose->weights();
  const Span<const Affine> transforms = d.pose->cluster_transforms();
  std::vector<Vec3> plain;
  for (std::int32_t v = 0; v < d.core->size(); ++v)
    plain.push_back(mesh.centre + mesh.scale * blend_vertex(mesh, w, transforms.data(), v));
  Buffer<double> columns(*d.core->memory, column_count(w));
  std::vector<Vec3> x(plain.size());
  std::vector<float> packed(3 * plain.size(), -1);
  blend(mesh, w, transforms.data(), columns.data(), mesh.centre, mesh.scale, x.data(), packed.data(), *d.core->jobs);
  EXPECT_EQ(std::memcmp(x.data(), plain.data(), x.size() * sizeof(Vec3)), 0);
  for (std::size_t i = 0; i < packed.size(); ++i) ASSERT_EQ(packed[i], static_cast<float>((&x[0].x)[i]));
#if defined(__x86_64__) && defined(__GNUC__)
  for (const bool blocks : {true, false}) {
    const BlendRows rows{w.start.data(),
                         w.cluster.data(),
                         w.weight.data(),
                         columns.data(),
                         &mesh.positions.data()->x,
                         {mesh.centre.x, mesh.centre.y, mesh.centre.z},
                         mesh.scale,
                         &x[0].x,
                         blocks ? w.block_start.data() : nullptr,
                         w.block_cluster.data(),
                         w.block_weight.data()};
    if (!__builtin_cpu_supports("avx2")) continue;
    std::fill(x.begin(), x.end(), Vec3());
    blend_rows_avx2(rows, 0, d.core->size());
    EXPECT_EQ(std::memcmp(x.data(), plain.data(), x.size() * sizeof(Vec3)), 0);
  }
#endif
}

double listed_share(const ClusterWeights& w) {
  double listed = 0;
  for (std::size_t b = 0; b + 1 < w.block_start.size(); ++b) listed += w.block_start[b + 1] > w.block_start[b];
  return listed / static_cast<double>(w.block_start.size() - 1);
}

TEST(Frame, TheBlendHasTheSameBitsOnAllLanes) {
  const Dragged d = drag(cactus_bend(), {}, 4);
  EXPECT_GT(listed_share(*d.pose->weights()), 0.9);  // neighbours in the mesh's order share their clusters
  expect_same_blend(d);
}

TEST(Frame, VerticesInAnyOrderAreBlendedOneByOne) {
  const Dragged d = drag(scattered_plane(), {}, 4);
  EXPECT_LT(listed_share(*d.pose->weights()), 0.2);
  expect_same_blend(d);
}

TEST(Frame, BlocksHoldTheWeightsOfTheirVertices) {
  Case c = cactus_bend();
  Dragged d = set_up(c, {});
  add(*d.pose,
      {select(*d.core, [](Vec3 p) { return p.x > 0.55; }), select(*d.core, [](Vec3 p) { return p.x < -0.5; })});
  const ClusterWeights& w = *d.pose->weights();
  for (std::size_t b = 0; b + 1 < w.block_start.size(); ++b) {
    if (w.block_start[b] == w.block_start[b + 1]) continue;
    for (std::size_t l = 0; l < 8; ++l) {
      const std::size_t v = 8 * b + l;
      std::int32_t next = w.start[v];
      for (std::int32_t k = w.block_start[b]; k < w.block_start[b + 1]; ++k) {
        ASSERT_TRUE(k == w.block_start[b] || w.block_cluster[k - 1] < w.block_cluster[k]);
        const float weight = w.block_weight[8 * static_cast<std::size_t>(k) + l];
        if (weight == 0) continue;
        ASSERT_EQ(w.cluster[next], w.block_cluster[k]);
        ASSERT_EQ(w.weight[next++], weight);
      }
      ASSERT_EQ(next, w.start[v + 1]);
    }
  }
}

}  // namespace

// Handles, their fields, levels, bands and the dense system they end in.
#include "deform/bands.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <tuple>

#include "base/error.h"
#include "cases.h"
#include "deform/blend_box.h"
#include "deform/dense.h"
#include "deform/dense_panels.h"
#include "deform/groups.h"
#include "support/dense.h"
#include "support/eigen.h"
#include "support/pose_modes.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::deform;
using namespace deform_test;

// A closed tube of `around` vertices and `rows` rings along y, ends open.
hf_test::PlainMesh tube(std::uint32_t around, std::uint32_t rows, double length) {
  hf_test::PlainMesh mesh;
  for (std::uint32_t j = 0; j < rows; ++j) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const double a = 2 * pi * i / around;
      mesh.positions.insert(mesh.positions.end(), {0.5 * std::cos(a), length * j / (rows - 1), 0.5 * std::sin(a)});
    }
  }
  for (std::uint32_t j = 0; j + 1 < rows; ++j) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::uint32_t a = j * around + i, b = j * around + (i + 1) % around, c = a + around, d = b + around;
      mesh.triangles.insert(mesh.triangles.end(), {a, c, d, a, d, b});
    }
  }
  return mesh;
}

double leak_with(std::uint32_t samples) {
  const auto core = hf_test::make_core(tube(128, 160, 4));
  PoseOptions options;
  options.rim_site_count = samples;
  const auto pose = Pose::make(core, options);
  const auto numbers =
      add(*pose, {select(*core, [](Vec3 p) { return p.y < 0.8; }), select(*core, [](Vec3 p) { return p.y > 3.2; })});
  const std::uint32_t expected = samples == 0 ? 128 : samples;
  EXPECT_EQ(pose->handle(numbers[0]).site_count, expected);
  return std::max(pose->handle(numbers[0]).leak, pose->handle(numbers[1]).leak);
}

TEST(Levels, EasedLevelsSlowToHalfAtTheEndsAndKeepTheMiddle) {
  for (const std::int32_t bands : {2, 3, 10, 64}) {
    EXPECT_EQ(eased_level(0, bands), 0);
    EXPECT_EQ(eased_level(1, bands), 1);
    const double step = 1e-7;
    EXPECT_NEAR(eased_level(step, bands) / step, 0.5, 1e-4);
    EXPECT_NEAR((1 - eased_level(1 - step, bands)) / step, 0.5, 1e-4);
    double last = -1;
    for (double s = 0; s <= 1; s += 1.0 / 1024) {
      const double eased = eased_level(s, bands);
      EXPECT_GT(eased, last);
      EXPECT_NEAR(eased + eased_level(1 - s, bands), 1, 1e-14);
      EXPECT_TRUE(eased == s || s * bands <= 1 || (1 - s) * bands <= 1);
      // never slower than half, and no corner where the middle begins
      if (s < 1) {
        EXPECT_NEAR(eased_level(s + step, bands) - eased, step, 0.51 * step);
      }
      last = eased;
    }
    EXPECT_NEAR(eased_level(1.0 / bands - step, bands), 1.0 / bands - step, 1e-3 * step);
  }
}

TEST(Handles, SampledRingsLeakAsMeasuredAndFullRingsDoNot) {
  const double few = leak_with(24), more = leak_with(48), all = leak_with(0);
  std::printf("leak: 24 of 128 %.3f %%, 48 of 128 %.3f %%, all %.1e\n", 100 * few, 100 * more, all);
  EXPECT_NEAR(few, 0.036, 0.015);
  EXPECT_NEAR(more, 0.017, 0.008);
  EXPECT_LT(all, 1e-11);
}

TEST(Handles, FieldsEqualADirectSolve) {
  const Case c = cactus_bend(70, 1500);
  const Dragged d = set_up(c, {});
  const surface::Core& core = *d.core;
  // K with unit rows on the regions, factored by a general sparse solver
  std::vector<int> owner(static_cast<std::size_t>(core.size()), -1);
  for (std::size_t i = 0; i < c.regions.size(); ++i) {
    for (const std::int32_t v : select(core, c.regions[i])) owner[v] = static_cast<int>(i);
  }
  std::vector<hf_test::SparseEntry> entries;
  std::vector<double> b(static_cast<std::size_t>(core.size()), 0.0);
  for (int v = 0; v < core.size(); ++v) {
    if (owner[v] >= 0) {
      entries.push_back({v, v, 1.0});
      b[static_cast<std::size_t>(v)] = owner[v] == 1;
      continue;
    }
    for (int k = core.laplacian.column_start[v]; k < core.laplacian.column_start[v + 1]; ++k) {
      const int u = core.laplacian.row[k];
      if (owner[u] >= 0) {
        b[static_cast<std::size_t>(v)] -= core.laplacian.value[k] * (owner[u] == 1);
      } else {
        entries.push_back({v, u, core.laplacian.value[k]});
      }
    }
  }
  const std::vector<double> oracle = hf_test::sparse_solve(core.size(), entries, b.data());
  double largest = 0;
  for (int v = 0; v < core.size(); ++v)
    largest = std::max(largest, std::fabs(d.pose->field(d.handles[1])[v] - oracle[static_cast<std::size_t>(v)]));
  EXPECT_LT(largest, 1e-11);
}

TEST(Handles, FieldsAreExactOnTheRegionsAndSumToOne) {
  const auto core = hf_test::make_core(cactus(2000));
  const auto pose = Pose::make(core, {});
  std::vector<std::vector<std::int32_t>> regions;
  for (int k = 0; k < 5; ++k)
    regions.push_back(select(*core, [&](Vec3 p) { return p.y > 0.4 * k && p.y < 0.4 * k + 0.06; }));
  const auto numbers = add(*pose, regions);
  for (std::int32_t v = 0; v < core->size(); ++v) {
    double sum = 0;
    for (const std::uint32_t n : numbers) {
      const double value = pose->field(n)[v];
      EXPECT_GE(value, 0);
      EXPECT_LE(value, 1);
      sum += value;
    }
    EXPECT_NEAR(sum, 1, 1e-14);
  }
  for (std::size_t i = 0; i < regions.size(); ++i) {
    for (const std::int32_t v : regions[i]) EXPECT_EQ(pose->field(numbers[i])[v], 1.0);
  }
}

TEST(Bands, BasisIsAPartitionOfUnityThatEndsInTheHandles) {
  for (const int degree : {1, 2}) {
    for (const int bands : {2, 3, 10, 64}) {
      BandValues before = band_values(0, bands, degree);
      EXPECT_EQ(before.first, 0);
      EXPECT_EQ(before.value[0], 1.0);
      for (int i = 0; i <= 1000; ++i) {
        const BandValues b = band_values(i / 1000.0, bands, degree);
        EXPECT_NEAR(b.value[0] + b.value[1] + b.value[2], 1, 1e-15);
        for (int k = 0; k <= degree; ++k) {
          EXPECT_GE(b.value[k], -1e-15);
          // continuous: at most the largest slope, 2 spans per unit, from one sample to the next
          const int other = b.first + k - before.first;
          const double old = other >= 0 && other <= degree ? before.value[other] : 0.0;
          EXPECT_NEAR(b.value[k], old, 2.1e-3 * (bands + 1));
        }
        before = b;
      }
      EXPECT_EQ(before.first + degree, bands + 1);
      EXPECT_EQ(before.value[degree], 1.0);
    }
  }
}

TEST(Bands, EqualLengthLevelsFollowTheLengthOfATubeOfChangingWidth) {
  // a cone: phi = log r is harmonic, its levels crowd at the tip; equal length must undo that
  hf_test::PlainMesh mesh = tube(48, 120, 4);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const double y = mesh.positions[3 * v + 1], width = 0.1 + 0.9 * y / 4;
    mesh.positions[3 * v] *= width;
    mesh.positions[3 * v + 2] *= width;
  }
  const auto core = hf_test::make_core(mesh);
  const auto pose = Pose::make(core, {});
  const auto numbers =
      add(*pose, {select(*core, [](Vec3 p) { return p.y < 0.1; }), select(*core, [](Vec3 p) { return p.y > 3.9; })});
  Memory memory;
  const Rest rest_surface(*core, memory);
  HandleFields fields(core->size(), 2, memory);
  for (std::int32_t v = 0; v < core->size(); ++v) {
    for (int i = 0; i < 2; ++i) fields.at(v)[i] = pose->field(numbers[i])[v];
  }
  const Vector<FieldPart> parts({{0, 1}}, &memory);
  const Vector<std::int32_t> part_start({0, static_cast<std::int32_t>(parts.size())}, &memory);
  const Vector<Levels> length =
      make_levels(*core, rest_surface, fields, parts, part_start, BandSpacing::equal_length, memory);
  const Vector<Levels> value =
      make_levels(*core, rest_surface, fields, parts, part_start, BandSpacing::equal_value, memory);
  double largest = 0, largest_by_value = 0;
  for (std::int32_t v = 0; v < core->size(); ++v) {
    const double y = core->mesh.to_given(core->mesh.positions[v]).y;
    if (y < 0.1 || y > 3.9) continue;
    largest = std::max(largest, std::fabs(length[0](fields.of(1)[v]) - (y - 0.1) / 3.8));
    largest_by_value = std::max(largest_by_value, std::fabs(value[0](fields.of(1)[v]) - (y - 0.1) / 3.8));
  }
  EXPECT_LT(largest, 0.02);
  EXPECT_GT(largest_by_value, 0.2);
}

class Weights : public ::testing::TestWithParam<int> {};

TEST_P(Weights, CoverEveryVertexOfReachedComponentsAndSumToOne) {
  hf_test::PlainMesh mesh = cactus(3000);
  hf_test::append(mesh, plain(samples::sphere(6)), 5);   // one handle: rigid
  hf_test::append(mesh, plain(samples::sphere(5)), 10);  // none: at rest
  const auto core = hf_test::make_core(mesh);
  PoseOptions options;
  options.scheme = hf_test::scheme_of(static_cast<hf_test::DeformMode>(GetParam()));
  const auto pose = Pose::make(core, options);
  const auto top = select(*core, [](Vec3 p) { return p.x < 3 && p.y > 1.7; });
  add(*pose, {select(*core, [](Vec3 p) { return p.x < 3 && p.y < 0.1; }), top,
              select(*core, [](Vec3 p) { return p.x > 0.5 && p.x < 2 && p.y > 1.2; }),
              select(*core, [](Vec3 p) { return p.x > 4 && p.x < 6.5 && p.y > 0.5; })});
  const ClusterWeights& w = *pose->weights();
  EXPECT_EQ(w.handle_count, 4);
  EXPECT_GT(w.free_count(), 10);
  EXPECT_EQ(w.elastic_components.size(), 1u);
  std::int32_t unreached = 0;
  for (std::int32_t v = 0; v < core->size(); ++v) {
    double sum = 0;
    for (std::int32_t k = w.start[v]; k < w.start[v + 1]; ++k) {
      EXPECT_GT(w.weight[k], 0);
      if (k > w.start[v]) {
        EXPECT_LT(w.cluster[k - 1], w.cluster[k]);
      }
      sum += w.weight[k];
    }
    const double x = core->mesh.to_given(core->mesh.positions[v]).x;
    if (x > 8) {
      EXPECT_EQ(w.start[v], w.start[v + 1]);
      ++unreached;
    } else {
      EXPECT_NEAR(sum, 1, 1e-14);
    }
    if (x > 3 && x < 8) {
      EXPECT_EQ(w.cluster[w.start[v]], 3);
    }
  }
  EXPECT_EQ(unreached, w.unreached_vertex_count);
  for (const std::int32_t v : top) {
    ASSERT_EQ(w.start[v + 1] - w.start[v], 1);
    EXPECT_EQ(w.cluster[w.start[v]], 1);
  }
}
INSTANTIATE_TEST_SUITE_P(Modes, Weights, ::testing::Values(0, 1));

TEST(Bands, OfTwoHandlesAreTheBasisOfOneField) {
  const auto core = hf_test::make_core(tube(24, 60, 4));
  PoseOptions options;
  options.scheme = hf_test::scheme_of(hf_test::DeformMode::paper);
  const auto pose = Pose::make(core, options);
  const auto numbers =
      add(*pose, {select(*core, [](Vec3 p) { return p.y < 0.5; }), select(*core, [](Vec3 p) { return p.y > 3.5; })});
  const ClusterWeights& w = *pose->weights();
  ASSERT_EQ(w.free_count(), w.band_count);
  for (std::int32_t v = 0; v < core->size(); ++v) {
    const BandValues b = band_values(pose->field(numbers[1])[v], w.band_count, 1);
    double low = 0, high = 0;
    for (std::int32_t k = w.start[v]; k < w.start[v + 1]; ++k) {
      if (w.cluster[k] == 0) low = w.weight[k];
      if (w.cluster[k] == 1) high = w.weight[k];
    }
    EXPECT_NEAR(low, b.first == 0 ? b.value[0] : 0.0, 2e-3);
    EXPECT_NEAR(high, b.first == w.band_count ? b.value[1] : 0.0, 2e-3);
  }
}

TEST(Bands, AreSplitByConnectedComponent) {
  // between two handles on a torus every level passes two tubes
  const auto core = hf_test::make_core(plain(samples::jittered_torus(60, 24)));
  const auto pose = Pose::make(core, {});
  add(*pose, {select(*core, [](Vec3 p) { return p.x > 0 && std::fabs(p.z) < 0.06; }),
              select(*core, [](Vec3 p) { return p.x < 0 && std::fabs(p.z) < 0.06; })});
  EXPECT_EQ(pose->weights()->free_count(), 2 * pose->weights()->band_count);
  // each cluster is one connected piece
  const ClusterWeights& w = *pose->weights();
  for (std::int32_t c = w.handle_count; c < w.cluster_count; ++c) {
    std::vector<std::uint8_t> member(static_cast<std::size_t>(core->size()), 0);
    std::int32_t first = -1, count = 0;
    for (std::int32_t v = 0; v < core->size(); ++v) {
      for (std::int32_t k = w.start[v]; k < w.start[v + 1]; ++k) {
        if (w.cluster[k] == c) {
          member[v] = 1;
          first = v;
          ++count;
        }
      }
    }
    if (first < 0) continue;
    std::vector<std::int32_t> stack{first};
    member[first] = 0;
    std::int32_t reached = 0;
    while (!stack.empty()) {
      const std::int32_t v = stack.back();
      stack.pop_back();
      ++reached;
      for (std::int32_t k = core->topology().neighbour_start[v]; k < core->topology().neighbour_start[v + 1]; ++k) {
        const std::int32_t u = core->topology().neighbour[k];
        if (member[u]) {
          member[u] = 0;
          stack.push_back(u);
        }
      }
    }
    // small weights are pruned, which may cut off a few vertices at the rim
    EXPECT_GE(reached, 0.98 * count) << "cluster " << c;
  }
}

TEST(Bands, ManyHandlesKeepTheDenseSystemBounded) {
  EXPECT_EQ(bands_for(10, 2), 10);
  EXPECT_EQ(bands_for(64, 256), 2);
  const auto core = hf_test::make_core(plain(samples::sphere(24)));
  PoseOptions options;
  options.band_count = 64;
  const auto pose = Pose::make(core, options);
  std::vector<std::vector<std::int32_t>> regions;
  for (int i = 0; i < 64; ++i) regions.push_back({core->size() * i / 64 + 7});
  add(*pose, regions);
  EXPECT_LE(pose->weights()->free_count(), free_cluster_limit);
  for (std::int32_t v = 0; v < core->size(); ++v) EXPECT_GT(pose->weights()->start[v + 1], pose->weights()->start[v]);
}

TEST(Groups, CoverElasticComponentsAndKeepTheirNumbers) {
  hf_test::PlainMesh mesh = plain(samples::sphere(16));
  hf_test::append(mesh, plain(samples::sphere(8)), 4);
  const auto core = hf_test::make_core(mesh);
  Memory memory;
  const Rest rest_surface(*core, memory);
  const std::int32_t zero = 0, one = 1;
  const auto first = Groups::with(nullptr, *core, rest_surface, {&zero, 1}, 200, memory);
  const auto both = Groups::with(first, *core, rest_surface, {&one, 1}, 200, memory);
  EXPECT_EQ(Groups::with(both, *core, rest_surface, {&zero, 1}, 200, memory), both);
  EXPECT_EQ(first->count(), 100);
  EXPECT_EQ(both->count(), 200);
  for (std::int32_t v = 0; v < core->size(); ++v) {
    EXPECT_GE(both->group_of[v], 0);
    if (core->mesh.component[v] == 0) {
      EXPECT_EQ(both->group_of[v], first->group_of[v]);
    }
    EXPECT_EQ(both->component[both->group_of[v]], core->mesh.component[v]);
  }
  for (std::int32_t g = 0; g < both->count(); ++g) EXPECT_EQ(both->group_of[both->seed[g]], g);
}

TEST(DenseFactor, SolvesLikeEigenAndDropsDependentUnknowns) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (const int rank : {37, 30, 1, 0}) {
    const int size = 37;
    Eigen::MatrixXd half(size, std::max(rank, 1));
    for (double& x : half.reshaped()) x = rank == 0 ? 0.0 : normal(random);
    const Eigen::MatrixXd other = half.transpose(), a = hf_test::dense_product(other, other, true);
    const Eigen::MatrixXd truth = Eigen::MatrixXd::NullaryExpr(size, 3, [&] { return normal(random); });
    const Eigen::MatrixXd b = hf_test::dense_product(a, truth);
    Memory memory;
    Buffer<double> lower(memory, size * size);
    for (int i = 0; i < size; ++i) {
      for (int j = 0; j < size; ++j) lower[static_cast<std::size_t>(i * size + j)] = j <= i ? a(i, j) : 1e300;
    }
    DenseFactor factor(memory);
    factor.factorise(std::move(lower), size, memory);
    EXPECT_EQ(factor.dropped(), size - rank);
    std::vector<double> x(4 * size, 0.0);
    for (int i = 0; i < size; ++i) {
      for (int k = 0; k < 3; ++k) x[static_cast<std::size_t>(4 * i + k)] = b(i, k);
    }
    factor.solve(x.data());
    Eigen::MatrixXd solved(size, 3);
    for (int i = 0; i < size; ++i) {
      for (int k = 0; k < 3; ++k) solved(i, k) = x[static_cast<std::size_t>(4 * i + k)];
    }
    EXPECT_LT((hf_test::dense_product(a, solved) - b).norm(), 1e-8 * (1 + b.norm()));
    if (rank == size) {
      EXPECT_LT((solved - hf_test::DenseSolver(a).solve(b)).norm(), 1e-6 * truth.norm());
    }
  }
}

// One row after the other, in four sums by column modulo 4, as the header of the loops says; then two rows at a time.
void solve_by_rows(const std::vector<double>& l, const std::vector<double>& inverse, std::size_t size,
                   std::size_t sides, double* x) {
  for (std::size_t k = 0; k < sides; ++k) {
    for (std::size_t i = 0; i < size; ++i) {
      double sum[4] = {0, 0, 0, 0};
      for (std::size_t j = 0; j < i; ++j) sum[j < i / 4 * 4 ? j % 4 : 0] += l[size * i + j] * x[4 * j + k];
      x[4 * i + k] = (x[4 * i + k] - ((sum[0] + sum[1]) + (sum[2] + sum[3]))) * inverse[i];
    }
    std::size_t i = size;
    if (i % 2 == 1) {
      --i;
      const double y = x[4 * i + k] *= inverse[i];
      for (std::size_t j = 0; j < i; ++j) x[4 * j + k] -= l[size * i + j] * y;
    }
    while (i > 0) {
      i -= 2;
      const double z = x[4 * i + 4 + k] *= inverse[i + 1];
      const double y = x[4 * i + k] = (x[4 * i + k] - l[size * (i + 1) + i] * z) * inverse[i];
      for (std::size_t j = 0; j < i; ++j) x[4 * j + k] -= l[size * i + j] * y + l[size * (i + 1) + j] * z;
    }
  }
}

TEST(DenseFactor, SolvesHaveTheSameBitsOnAllLanes) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<DenseLoop> loops{&solve_dense};
#if defined(__x86_64__) && defined(__GNUC__)
  if (__builtin_cpu_supports("avx2")) loops.push_back(&solve_dense_avx2);
  if (__builtin_cpu_supports("avx512f")) loops.push_back(&solve_dense_avx512);
#endif
  for (std::size_t size = 0; size < 70; ++size) {
    std::vector<double> l(size * size), inverse(size), b(4 * size);
    for (double& entry : l) entry = number(random);
    for (double& entry : inverse) entry = 0.3 + number(random) * 0.1;
    for (double& entry : b) entry = number(random);
    if (size > 3) inverse[size / 2] = 0;  // a dropped unknown
    const std::size_t panels = DensePanels::count(size);
    std::vector<double> rows(DensePanels::rows_at(panels)), columns(rows.size());
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        rows[DensePanels::rows_at(i / 8) + 8 * j + i % 8] = l[size * i + j];
        columns[DensePanels::columns_at(j / 8, panels) + 8 * (i - j / 8 * 8) + j % 8] = l[size * i + j];
      }
    }
    for (const int sides : {3, 4}) {
      std::vector<double> expected = b;
      solve_by_rows(l, inverse, size, static_cast<std::size_t>(sides), expected.data());
      for (const DenseLoop loop : loops) {
        std::vector<double> x = b;
        loop({size, rows.data(), columns.data(), inverse.data()}, sides, x.data());
        EXPECT_EQ(std::memcmp(x.data(), expected.data(), 4 * size * sizeof(double)), 0) << size;
      }
    }
  }
}

TEST(BlendBox, HoldsTheFloatsOfClustersThatMoveFarApart) {
  const auto core = hf_test::make_core({{0, 0, 0, 1, 0, 0, 0.3, 0.7, 0}, {0, 1, 2}});
  Memory memory;
  ClusterWeights weights(memory);
  weights.cluster_count = 2;
  for (const int start : {0, 2, 4, 6}) weights.start.push_back(start);
  for (int k = 0; k < 6; ++k) {
    weights.cluster.push_back(static_cast<std::uint16_t>(k % 2));
    weights.weight.push_back(0.5f);
  }
  // each cluster goes far, their mean goes nowhere
  const double far = 1234.567;
  const Affine transforms[2] = {{{{1, 0, 0, far}, {0, 1, 0, far}, {0, 0, 1, far}}},
                                {{{1, 0, 0, -far}, {0, 1, 0, -far}, {0, 0, 1, -far}}}};
  const Vector<BlendBox> boxes = cluster_boxes(core->mesh, weights, memory);
  const BlendBox box = blended_box(core->mesh, weights, boxes, transforms);
  for (const Vec3& p : core->mesh.positions) {
    for (const auto& [at, low, high] :
         {std::tuple(p.x, box.low.x, box.high.x), std::tuple(p.y, box.low.y, box.high.y)}) {
      const float there = static_cast<float>(at) + static_cast<float>(far),
                  back = static_cast<float>(at) - static_cast<float>(far);
      const double shaded = static_cast<double>(0.5f * there + 0.5f * back);
      EXPECT_LE(low, shaded);
      EXPECT_LE(shaded, high);
      EXPECT_LT(high - low, 1.01);
    }
  }
}

}  // namespace

// Pairs of opposite singularities that crosses can do without.
#include "quads/opposite_pairs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/meshes.h"
#include "unit/field/analysis_support.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::quads;
using Complex = std::complex<double>;

constexpr double edge_length = 0.015;

// A ring with a few bumps and dents on one side. Its crosses follow them into singularities of both signs.
struct BumpedRing {
  explicit BumpedRing(double height)
      : core(hf_test::make_core([&] {
          const int around = 90, along = 120;
          hf_test::PlainMesh mesh;
          for (int i = 0; i < along; ++i) {
            for (int k = 0; k < around; ++k) {
              const double turn = 6.283185307179586, a = turn * k / around, b = turn * i / along;
              const double near = std::exp(-(a - 3) * (a - 3) - 9 * (b - 3) * (b - 3)),
                           bump = height * near * std::sin(4 * a) * std::sin(12 * b);
              const double r = 1 + bump;
              for (const double x :
                   {(3 + r * std::cos(a)) * std::cos(b), (3 + r * std::cos(a)) * std::sin(b), r * std::sin(a)})
                mesh.positions.push_back(x);
              const auto at = [&](int p, int q) { return static_cast<std::uint32_t>(p % along * around + q % around); };
              for (const std::uint32_t v :
                   {at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k), at(i + 1, k + 1), at(i, k + 1)})
                mesh.triangles.push_back(v);
            }
          }
          return mesh;
        }())),
        surface(remesh::FluxSurface::make(core->mesh, core->topology(), *core->memory)),
        system(core, 4),
        smoother(system, 2 * edge_length),
        features(find_features(surface, 100, *core->memory)),
        wish(curvature_crosses(*core, system.connection, 2)) {}

  std::vector<std::int32_t> index() {
    const FaceCross faces =
        FaceCross::make(surface, system.connection, smoother.smooth(wish, {}), features, SharpCorners(*core->memory),
                        remesh::Table<std::complex<double>>(*core->memory), *core->memory);
    return {faces.index.begin(), faces.index.end()};
  }
  std::shared_ptr<const surface::Core> core;
  remesh::FluxSurface surface;
  field::DirectionMatrix system;
  CrossSmoother smoother;
  remesh::Table<std::uint8_t> features;
  Vector<Complex> wish;
};

TEST(OppositePairs, CancelWhereTheCrossesCanDoWithoutThem) {
  BumpedRing ring(0.4);
  const auto count = [](const std::vector<std::int32_t>& index) {
    std::int32_t out = 0, sum = 0;
    for (const std::int32_t i : index) {
      out += i != 0;
      sum += i;
    }
    EXPECT_EQ(sum, 0);
    return out;
  };
  const std::int32_t before = count(ring.index());
  ASSERT_GT(before, 0);
  const Vector<Complex> old(ring.wish.begin(), ring.wish.end(), ring.core->memory.get());
  leave_out_pairs(ring.surface, ring.system, ring.smoother, {}, ring.features, SharpCorners(*ring.core->memory),
                  edge_length, ring.wish);
  EXPECT_LT(count(ring.index()), before);
  std::size_t left_out = 0;
  for (std::size_t v = 0; v < old.size(); ++v) {
    EXPECT_TRUE(ring.wish[v] == old[v] || ring.wish[v] == Complex(0, 0));
    left_out += ring.wish[v] != old[v];
  }
  EXPECT_GT(left_out, 0u);
  EXPECT_LT(left_out, old.size() / 4);
}

TEST(OppositePairs, WithoutSingularitiesNothingChanges) {
  BumpedRing ring(0);
  const Vector<Complex> old(ring.wish.begin(), ring.wish.end(), ring.core->memory.get());
  leave_out_pairs(ring.surface, ring.system, ring.smoother, {}, ring.features, SharpCorners(*ring.core->memory),
                  edge_length, ring.wish);
  for (std::size_t v = 0; v < old.size(); ++v) EXPECT_EQ(ring.wish[v], old[v]);
}

}  // namespace

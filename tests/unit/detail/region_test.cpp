// Regions and membranes: the base is the Dirichlet problem of its rim, whatever edits led there.
#include <cstring>
#include <random>

#include "detail_support.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::detail;
using namespace hf_test;

std::shared_ptr<const RegionSurface> torus_surface(mesh::OperatorKind kind = mesh::OperatorKind::intrinsic_delaunay) {
  surface::CoreOptions options;
  options.operator_kind = kind;
  return surface_of(make_core(torus(28, 18), 1, options));
}

bool right_end(Vec3 p) { return p.x > 1.7; }

TEST(Region, MembraneIsTheFreshSolveOfItsRim) {
  for (const mesh::OperatorKind kind :
       {mesh::OperatorKind::intrinsic_delaunay, mesh::OperatorKind::cotangent, mesh::OperatorKind::uniform}) {
    const Region region = region_where(torus_surface(kind), right_end);
    EXPECT_GT(region.state()->shape->inside.size(), 50u);
    EXPECT_EQ(numbers(region.state()->shape->sites), numbers(region.state()->shape->rim));
    EXPECT_LT(distance_from_dense_base(region), 1e-12);
  }
}

// Weights of the intrinsic and of the clamped operator are not negative: u is a mean of rim values everywhere.
TEST(Region, MembraneStaysInTheConvexHullOfItsRim) {
  for (const mesh::OperatorKind kind : {mesh::OperatorKind::intrinsic_delaunay, mesh::OperatorKind::clamped}) {
    const auto surface = torus_surface(kind);
    const Region region = region_where(surface, right_end);
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    bool moved = false;
    for (int i = 0; i < 500; ++i) {
      const Vec3 d{normal(random), normal(random), normal(random)};
      double rim = -1e300, base = -1e300, before = -1e300;
      for (const std::int32_t v : region.state()->shape->rim) rim = std::max(rim, dot(d, surface->position(v)));
      for (const std::int32_t v : region.state()->shape->inside)
        before = std::max(before, dot(d, surface->position(v)));
      for (const Vec3 p : region.state()->base) base = std::max(base, dot(d, p));
      EXPECT_LE(base, rim + 1e-12);
      moved = moved || before > rim + 0.1;
    }
    EXPECT_TRUE(moved) << "the surface itself lies in the hull: nothing was tested";
  }
}

TEST(Region, GrowsAndShrinksBySiteEditsAlone) {
  const auto surface = torus_surface();
  Region region = region_where(surface, [](Vec3 p) { return p.x > 2.2; });
  std::uint32_t paths = region.state()->engine->counters().path_solves;
  for (const std::int32_t rings : {1, 2, -1, 3, -4}) {
    const Numbers before = numbers(region.state()->shape->sites);
    RegionEdit edit;
    edit.rings = rings;
    region.edit(edit);
    const RegionState& state = *region.state();
    const Numbers now = numbers(state.shape->sites);
    Numbers stay;
    std::set_intersection(before.begin(), before.end(), now.begin(), now.end(), std::back_inserter(stay));
    EXPECT_EQ(state.kept, stay.size());
    EXPECT_EQ(state.inserted, now.size() - stay.size());
    EXPECT_EQ(state.removed, before.size() - stay.size());
    EXPECT_EQ(state.engine->counters().factorisations, 1u);  // the core's own
    // no other path than those of the new sites, but for sparse groups that are packed anew
    EXPECT_LE(state.engine->counters().path_solves - paths, state.inserted + 64) << rings;
    paths = state.engine->counters().path_solves;
    EXPECT_LT(distance_from_dense_base(region), 1e-11) << rings;
  }
}

TEST(Region, RingsAreDistancesInEdges) {
  const auto surface = surface_of(make_core(grid(20, 20)));
  Region region(surface);
  add(region, {10 * 21 + 10});
  RegionEdit edit;
  edit.rings = 3;
  region.edit(edit);
  const Numbers grown = numbers(region.state()->shape->inside);
  // breadth first from the middle, over the mesh's own triangles
  std::vector<int> steps(441, -1);
  Numbers front{220}, expected{220};
  steps[220] = 0;
  for (int s = 1; s <= 3; ++s) {
    Numbers next;
    for (std::int32_t t = 0; t < surface->core->mesh.triangle_count(); ++t) {
      const std::int32_t* v = surface->core->mesh.triangle(t);
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l)
          if (steps[v[k]] == s - 1 && steps[v[l]] < 0) {
            steps[v[l]] = s;
            expected.push_back(v[l]);
          }
    }
  }
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(grown, expected);
  edit.rings = -3;
  region.edit(edit);
  EXPECT_EQ(numbers(region.state()->shape->inside), Numbers{220});
  edit.rings = -1;
  index_of_failure(HF_ERROR_EMPTY, [&] { region.edit(edit); });
}

TEST(Region, AnyEditsLeadToWhatAFreshRegionGives) {
  const auto surface = torus_surface();
  Region region = region_where(surface, right_end);
  std::mt19937 random(11);
  for (int i = 0; i < 25; ++i) {
    Numbers come, go;
    for (int k = 0; k < 12; ++k) {
      come.push_back(static_cast<std::int32_t>(random() % 504));
      go.push_back(static_cast<std::int32_t>(random() % 504));
    }
    RegionEdit edit;
    edit.add = {come.data(), come.size()};
    edit.remove = {go.data(), go.size()};
    edit.rings = i % 7 == 3 ? -1 : 0;
    region.edit(edit);
    Region fresh(surface);
    add(fresh, numbers(region.state()->shape->inside));
    EXPECT_EQ(numbers(fresh.state()->shape->sites), numbers(region.state()->shape->sites));
    EXPECT_LT(largest_difference(fresh.state()->base, region.state()->base), 1e-10) << i;
  }
}

TEST(Region, ACloneSharesTheStateUntilOneOfThemIsEdited) {
  const auto surface = torus_surface();
  Region region = region_where(surface, right_end);
  const auto first = region.state();
  const Region clone(region);
  RegionEdit edit;
  edit.rings = 2;
  region.edit(edit);
  EXPECT_NE(region.state(), first);
  EXPECT_EQ(clone.state(), first);
}

// A small region is solved over its own paths: the same bits as a sweep through the whole factor.
TEST(Region, SmallRegionsGetTheBitsOfAWholeSweep) {
  const auto surface = surface_of(make_core(torus(60, 40)));
  const Region region = region_where(surface, [](Vec3 p) { return p.x > 2.7; });
  const RegionState& state = *region.state();
  ASSERT_FALSE(state.whole_sweep);
  ASSERT_GT(state.shape->inside.size(), 20u);
  std::vector<double> values(static_cast<std::size_t>(state.engine->slot_count()) * 3), field(2400 * 3);
  for (std::size_t i = 0; i < state.slot.size(); ++i) {
    const Vec3 p = surface->core->mesh.to_inner(surface->position(state.shape->sites[i]));
    double* value = &values[static_cast<std::size_t>(state.slot[i]) * 3];
    value[0] = p.x;
    value[1] = p.y;
    value[2] = p.z;
  }
  state.engine->solve(values.data(), 3, field.data(), nullptr);
  for (std::size_t i = 0; i < state.base.size(); ++i) {
    const double* u = &field[static_cast<std::size_t>(state.shape->inside[i]) * 3];
    const Vec3 p = surface->core->mesh.to_given({u[0], u[1], u[2]});
    EXPECT_TRUE(p.x == state.base[i].x && p.y == state.base[i].y && p.z == state.base[i].z);
  }
}

TEST(Region, AreasAreThoseOfItsTriangles) {
  const auto surface = torus_surface();
  const Region region = region_where(surface, right_end);
  double area = 0;
  const mesh::Mesh& mesh = surface->core->mesh;
  for (std::int32_t t = 0; t < mesh.triangle_count(); ++t) {
    const std::int32_t* v = mesh.triangle(t);
    bool touches = false;
    for (int k = 0; k < 3; ++k) touches = touches || right_end(surface->position(v[k]));
    const Vec3 a = surface->position(v[0]);
    if (touches) area += 0.5 * norm(cross(surface->position(v[1]) - a, surface->position(v[2]) - a));
  }
  area /= mesh.scale * mesh.scale;
  EXPECT_NEAR(region.state()->area, area, 1e-12 * area);
  EXPECT_LT(region.state()->base_area, 0.9 * area);  // a membrane is smaller than what bulges over it
  EXPECT_GT(region.state()->base_area, 0.1 * area);
}

TEST(Region, NormalsAreThoseOfTheMorphedSurface) {
  const auto surface = torus_surface();
  const Region region = region_where(surface, right_end);
  const RegionState& state = *region.state();
  for (const double weight : {0.0, 0.4, 1.0, -0.7}) {
    const Vector<Vec3> local = morphed_positions(*surface, state, weight, *surface->core->memory);
    const Vector<Vec3> sums = local_normal_sums(state, local, *surface->core->memory);
    std::vector<Vec3> position, expected(static_cast<std::size_t>(surface->core->size()));
    for (std::int32_t v = 0; v < surface->core->size(); ++v) {
      const std::int32_t l = state.shape->local[static_cast<std::size_t>(v)];
      position.push_back(l >= 0 ? local[static_cast<std::size_t>(l)] : surface->scaled_position(v));
    }
    for (std::int32_t t = 0; t < surface->core->mesh.triangle_count(); ++t) {
      const std::int32_t* v = surface->core->mesh.triangle(t);
      const Vec3 n = cross(position[static_cast<std::size_t>(v[1])] - position[static_cast<std::size_t>(v[0])],
                           position[static_cast<std::size_t>(v[2])] - position[static_cast<std::size_t>(v[0])]);
      for (int k = 0; k < 3; ++k)
        expected[static_cast<std::size_t>(v[k])] = expected[static_cast<std::size_t>(v[k])] + n;
    }
    for (std::int32_t l = 0; l < state.shape->local_count(); ++l)
      EXPECT_LT(norm(sums[static_cast<std::size_t>(l)] - expected[static_cast<std::size_t>(state.shape->vertex(l))]),
                1e-13);
  }
}

// Squares of a unit of 1e-170 or 1e170 leave the range of double.
TEST(Region, NothingDependsOnTheUnit) {
  const PlainMesh mesh = torus(28, 18);
  const Region region = region_where(surface_of(make_core(mesh)), right_end);
  const Vector<Vec3> local = morphed_positions(*region.surface(), *region.state(), 0.5, *region.core().memory);
  const Vector<Vec3> normals = local_normal_sums(*region.state(), local, *region.core().memory);
  for (const double unit : {1e-170, 1e170}) {
    PlainMesh other = mesh;
    for (double& x : other.positions) x *= unit;
    Region scaled(surface_of(make_core(other)));
    add(scaled, numbers(region.state()->shape->inside));
    EXPECT_NEAR(scaled.state()->area, region.state()->area, 1e-9);
    EXPECT_NEAR(scaled.state()->base_area, region.state()->base_area, 1e-9);
    const Vector<Vec3> there = morphed_positions(*scaled.surface(), *scaled.state(), 0.5, *scaled.core().memory);
    const Vector<Vec3> sums = local_normal_sums(*scaled.state(), there, *scaled.core().memory);
    EXPECT_LT(largest_difference(there, local), 1e-9);
    for (std::size_t i = 0; i < sums.size(); ++i) EXPECT_LT(norm(unit_normal(sums[i]) - unit_normal(normals[i])), 1e-6);
    for (std::size_t i = 0; i < scaled.state()->base.size(); ++i)
      EXPECT_LT(norm((1 / unit) * scaled.state()->base[i] - region.state()->base[i]), 1e-9);
  }
}

TEST(Region, AComponentNeedsARim) {
  PlainMesh mesh = torus(10, 8);
  append(mesh, torus(6, 5), 10);
  const auto surface = surface_of(make_core(mesh));
  Region region(surface);
  Numbers all;
  for (std::int32_t v = 80; v < 110; ++v) all.push_back(v);
  EXPECT_EQ(index_of_failure(HF_ERROR_INVALID_ARGUMENT, [&] { add(region, all); }), 109u);
  EXPECT_TRUE(region.state()->shape->inside.empty());
  all.pop_back();
  add(region, all);
  // pieces in two components
  add(region, {3, 4, 5});
  EXPECT_EQ(region.state()->shape->inside.size(), 32u);
  EXPECT_LT(distance_from_dense_base(region), 1e-12);
}

TEST(Region, CancellingLeavesTheRegionAsItWas) {
  Region region = region_where(torus_surface(), right_end);
  const auto before = region.state();
  Progress progress;
  progress.cancel();
  const CallProgress call(&progress);
  RegionEdit edit;
  edit.rings = 1;
  index_of_failure(HF_ERROR_CANCELLED, [&] { region.edit(edit); });
  EXPECT_EQ(region.state(), before);
}

}  // namespace

// Detail carried by local frames: onto itself, onto moved copies, onto other meshes.
#include "detail/carried_detail.h"

#include "detail_support.h"
#include "support/creature.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::detail;
using namespace hf_test;

Memory& memory_of(const Region& region) { return *region.core().memory; }

// Distance of the carried surface at weight 1 from what a function of the target's vertices says.
double worst_difference(const CarriedDetail& carried, const std::function<Vec3(std::int32_t)>& expected) {
  double worst = 0;
  for (std::size_t i = 0; i < carried.offset.size(); ++i)
    worst =
        std::max(worst, norm(carried.state->base[i] + carried.offset[i] - expected(carried.state->shape->inside[i])));
  return worst;
}

// Bumps over [0, 1]^2, flat from a radius of 0.35 round the middle on; up to 0.2 high times `scale`.
double height(double x, double y, double scale) {
  const double r = std::hypot(x - 0.5, y - 0.5), fade = r < 0.35 ? std::pow(1 - r * r / 0.1225, 2) : 0;
  return scale * fade * (0.12 + 0.6 * (x - 0.5) + 0.04 * std::sin(14 * x + 3 * y));
}
PlainMesh bumps(std::uint32_t n, double scale = 1, std::uint32_t seed = 1) {
  PlainMesh mesh = grid(n, n, 1.0 / n, 0.2, seed);
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
    mesh.positions[3 * v + 2] = height(mesh.positions[3 * v], mesh.positions[3 * v + 1], scale);
  return mesh;
}
constexpr double low = 0.05;  // bumps so low that the surface is nearly isometric to its base
bool in_disc(Vec3 p) { return std::hypot(p.x - 0.5, p.y - 0.5) < 0.4; }

CarriedDetail carry(const Region& source, const Region& target, CarryOptions options = {}) {
  return carry_detail(source, target, options, memory_of(target));
}

// The rim vertex in the direction of an angle.
std::int32_t rim_towards(const Region& region, double angle) {
  std::int32_t best = -1;
  double most = -1e300;
  for (const std::int32_t v : region.state()->shape->rim) {
    const Vec3 p = region.surface()->position(v);
    const double along =
        (std::cos(angle) * (p.x - 0.5) + std::sin(angle) * (p.y - 0.5)) / std::hypot(p.x - 0.5, p.y - 0.5);
    if (along > most) {
      most = along;
      best = v;
    }
  }
  return best;
}

TEST(CarriedDetail, OntoItselfGivesTheSurfaceBack) {
  const auto check = [](const Region& region, const char* what) {
    const CarriedDetail carried = carry(region, region);
    EXPECT_LT(worst_difference(carried, [&](std::int32_t v) { return region.surface()->position(v); }), 1e-9) << what;
  };
  check(region_where(surface_of(make_core(bumps(30))), in_disc), "bumps");
  check(region_where(surface_of(make_core(torus(40, 24))), [](Vec3 p) { return p.x > 2.2 && p.z > -0.4; }), "torus");
  check(region_where(surface_of(make_core(plain(samples::sphere(20)), 1, thin_plate())),
                     [](Vec3 p) { return p.y > 0.3; }),
        "thin plate");
  // a long arm: the membrane shrinks it to a point
  check(region_where(surface_of(make_core(plain(samples::cylinder(8, 60)))), [](Vec3 p) { return p.y > 2.5; }), "arm");
}

TEST(CarriedDetail, FollowsRotationTranslationAndScale) {
  const PlainMesh mesh = bumps(30);
  PlainMesh moved = mesh;
  const double c = std::cos(0.9), s = std::sin(0.9);
  const auto map = [&](double x, double y, double z) {
    return Vec3{2.5 * (c * x - s * z) + 7, 2.5 * y - 3, 2.5 * (s * x + c * z) + 1};
  };
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    double* p = &moved.positions[3 * v];
    const Vec3 q = map(p[0], p[1], p[2]);
    p[0] = q.x;
    p[1] = q.y;
    p[2] = q.z;
  }
  const Region source = region_where(surface_of(make_core(mesh)), in_disc);
  Region target(surface_of(make_core(moved)));
  add(target, numbers(source.state()->shape->inside));
  const CarriedDetail carried = carry(source, target);
  EXPECT_LT(worst_difference(carried, [&](std::int32_t v) { return target.surface()->position(v); }), 1e-8);
  // a scale of its own
  CarryOptions options;
  options.scale = 1.25;  // half of what the areas say
  const CarriedDetail half = carry(source, target, options);
  for (std::size_t i = 0; i < half.offset.size(); ++i) EXPECT_LT(norm(half.offset[i] - 0.5 * carried.offset[i]), 1e-8);
}

// Bumps onto a flat sheet of other triangles: the heights come over, the better the finer both are.
TEST(CarriedDetail, OntoAnotherMeshComesNearerWithFinerMeshes) {
  double before = 1;
  for (const std::uint32_t n : {24u, 48u, 96u}) {
    const Region source = region_where(surface_of(make_core(bumps(n, low))), in_disc);
    const Region target = region_where(surface_of(make_core(bumps(n + 7, 0, 9))), in_disc);
    CarryOptions options;
    Numbers from, to;
    for (int k = 0; k < 4; ++k) {
      from.push_back(rim_towards(source, 1.5708 * k));
      to.push_back(rim_towards(target, 1.5708 * k));
    }
    options.source_pins = {from.data(), from.size()};
    options.target_pins = {to.data(), to.size()};
    options.scale = 1;
    const CarriedDetail carried = carry(source, target, options);
    double sum = 0;
    for (std::size_t i = 0; i < carried.offset.size(); ++i) {
      const Vec3 x = carried.state->base[i] + carried.offset[i];
      sum += std::pow(x.z - height(x.x, x.y, low), 2);
    }
    const double off = std::sqrt(sum / static_cast<double>(carried.offset.size())) / (0.2 * low);
    std::printf("%u quads: heights off by %.2f %% of the highest bump in the root mean square\n", n, 100 * off);
    EXPECT_LT(off, 0.7 * before);
    before = off;
  }
  EXPECT_LT(before, 0.02);
}

// Heights over a flat sheet become heights over a curved one: along the normals of its base, vertex by vertex.
TEST(CarriedDetail, StandsUprightOnACurvedBase) {
  const Region source = region_where(surface_of(make_core(bumps(40, low))), in_disc);
  const Region target = region_where(surface_of(make_core(plain(samples::sphere(24)), 1, thin_plate())),
                                     [](Vec3 p) { return p.y > 0.6; });
  const CarriedDetail carried = carry(source, target);
  double highest = 0;
  for (const Vec3 d : carried.offset) highest = std::max(highest, norm(d));
  double most = 0;
  int count = 0;
  for (std::size_t i = 0; i < carried.offset.size(); ++i) {
    const double length = norm(carried.offset[i]);
    if (length < 0.2 * highest) continue;
    // the thin plate of a cap is nearly the cap: its normals are the places on the sphere
    const Vec3 normal = (1 / norm(carried.state->base[i])) * carried.state->base[i];
    most = std::max(most, 1 - dot(carried.offset[i], normal) / length);
    ++count;
  }
  EXPECT_GT(count, 100);
  EXPECT_LT(most, 0.02);  // 11 degrees; the direction of the whole cap is up to 30 off
}

TEST(CarriedDetail, PairsTurnItOnTheRim) {
  const Region source = region_where(surface_of(make_core(bumps(40, low))), in_disc);
  const Region target = region_where(surface_of(make_core(bumps(40, 0))), in_disc);
  const Numbers from{rim_towards(source, 0)}, to{rim_towards(target, 1.5707963)};
  CarryOptions options;
  options.source_pins = {from.data(), 1};
  options.target_pins = {to.data(), 1};
  options.scale = 1;
  const CarriedDetail carried = carry(source, target, options);
  double turned = 0, straight = 0;
  for (std::size_t i = 0; i < carried.offset.size(); ++i) {
    const Vec3 x = carried.state->base[i] + carried.offset[i];
    // a quarter turn takes (a, b) to (-b, a): the height here was at (y, 1 - x)
    turned += std::pow(x.z - height(x.y, 1 - x.x, low), 2);
    straight += std::pow(x.z - height(x.x, x.y, low), 2);
  }
  EXPECT_LT(turned, 0.05 * straight);
}

TEST(CarriedDetail, PairsThatAreNotInOrderAreNamed) {
  const Region region = region_where(surface_of(make_core(bumps(24))), in_disc);
  Numbers there, back;
  for (const double a : {0.0, 1.5, 3.0, 4.5}) there.push_back(rim_towards(region, a));
  back = {there[0], there[2], there[1], there[3]};
  CarryOptions options;
  options.source_pins = {there.data(), 4};
  options.target_pins = {back.data(), 4};
  EXPECT_EQ(index_of_failure(HF_ERROR_INVALID_ARGUMENT, [&] { carry(region, region, options); }), 2u);
  back = {there[0], region.state()->shape->inside[0]};
  options.source_pins = {there.data(), 2};
  options.target_pins = {back.data(), 2};
  EXPECT_EQ(index_of_failure(HF_ERROR_INVALID_ARGUMENT, [&] { carry(region, region, options); }), 1u);
}

TEST(CarriedDetail, RegionsThatAreNoDiscsAreRefused) {
  const auto surface = surface_of(make_core(bumps(24)));
  const Region disc = region_where(surface, in_disc);
  const Region ring =
      region_where(surface, [](Vec3 p) { return in_disc(p) && std::hypot(p.x - 0.5, p.y - 0.5) > 0.2; });
  const Region two = region_where(surface, [](Vec3 p) { return in_disc(p) && std::fabs(p.x - 0.5) > 0.12; });
  const Region handle =
      region_where(surface_of(make_core(torus(20, 12))), [](Vec3 p) { return p.x > -2.5 || p.z > 0; });
  const Region empty(surface);
  for (const Region* region : {&ring, &two, &handle}) {
    EXPECT_LT(index_of_failure(HF_ERROR_UNSUPPORTED, [&] { carry(disc, *region); }), 700u);
    index_of_failure(HF_ERROR_UNSUPPORTED, [&] { carry(*region, disc); });
  }
  index_of_failure(HF_ERROR_EMPTY, [&] { carry(empty, disc); });
}

TEST(DiscMap, IsAnEmbeddingAndItsSearchFindsEveryTriangle) {
  const Region region =
      region_where(surface_of(make_core(plain(hf_test::cactus(3000)))), [](Vec3 p) { return p.y > 0.9; });
  Memory& memory = memory_of(region);
  const RegionState& state = *region.state();
  const DiscBoundary boundary(*region.surface(), state, memory);
  DiscPins pins(memory);
  pins.place.push_back(3);
  pins.turn.push_back(0);
  const Vector<DiscPoint> disc = map_to_disc(*region.surface(), state, boundary, pins, memory);
  const auto area = [&](DiscPoint a, DiscPoint b, DiscPoint c) {
    return (b.u - a.u) * (c.v - a.v) - (c.u - a.u) * (b.v - a.v);
  };
  const Vector<std::int32_t>& corners = state.shape->corners;
  const auto point = [&](std::size_t i) { return disc[static_cast<std::size_t>(corners[i])]; };
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    EXPECT_GT(area(point(i), point(i + 1), point(i + 2)), 0) << i / 3;
    sum += area(point(i), point(i + 1), point(i + 2)) / 2;
  }
  EXPECT_GT(sum, 2.9);  // the disc but for what the rim's chords cut off
  EXPECT_LT(sum, 3.1416);
  for (const std::int32_t l : boundary.loop) {
    const DiscPoint p = disc[static_cast<std::size_t>(l)];
    EXPECT_NEAR(p.u * p.u + p.v * p.v, 1, 1e-12);
  }
  EXPECT_NEAR(disc[static_cast<std::size_t>(boundary.loop[3])].u, 1, 1e-12);
  const DiscSearch search(corners, disc, memory);
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const double mix[3] = {0.2, 0.5, 0.3};
    DiscPoint p;
    for (std::size_t k = 0; k < 3; ++k) {
      p.u += mix[k] * point(i + k).u;
      p.v += mix[k] * point(i + k).v;
    }
    double w[3];
    const std::int32_t found = search.find(p, w);
    EXPECT_EQ(found, static_cast<std::int32_t>(i / 3));
    if (area(point(i), point(i + 1), point(i + 2)) < 1e-8) continue;
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(w[k], mix[k], 1e-6);
  }
  // outside: the nearest point of the rim
  const DiscPoint far{3, 0.5};
  double w[3], least = 1e300;
  const std::int32_t found = search.find(far, w);
  DiscPoint nearest;
  for (std::size_t k = 0; k < 3; ++k) {
    const DiscPoint p = point(3 * static_cast<std::size_t>(found) + k);
    nearest.u += w[k] * p.u;
    nearest.v += w[k] * p.v;
    EXPECT_GE(w[k], 0);
  }
  for (std::size_t i = 0; i < boundary.loop.size(); ++i) {
    const DiscPoint a = disc[static_cast<std::size_t>(boundary.loop[i])],
                    b = disc[static_cast<std::size_t>(boundary.loop[(i + 1) % boundary.loop.size()])];
    for (double t = 0; t <= 1; t += 0.01)
      least = std::min(least, std::hypot(a.u + t * (b.u - a.u) - far.u, a.v + t * (b.v - a.v) - far.v));
  }
  EXPECT_NEAR(w[0] + w[1] + w[2], 1, 1e-12);
  EXPECT_NEAR(std::hypot(nearest.u - far.u, nearest.v - far.v), least, 1e-4);
}

}  // namespace

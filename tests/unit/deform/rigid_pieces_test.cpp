// Pieces that are rigid: their edges keep their lengths, whoever moves them, and a handle takes all of a piece.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <map>

#include "base/error.h"
#include "cases.h"
#include "deform/constants.h"
#include "deform/pose_stack.h"
#include "mesh/link_constants.h"
#include "support/parts.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::deform;
using namespace deform_test;
using Surface = std::vector<Vec3>;
using Region = std::vector<std::int32_t>;

// A beam along x from 0 to 3 and a blade that lies on it, linked.
hf_test::PlainMesh beam_and_blade() {
  hf_test::PlainMesh mesh = hf_test::box(16, {3, 0.4, 0.4}, {0, 0, 0});
  hf_test::append(mesh, hf_test::box(12, {1.8, 0.1, 0.25}, {0, 0.405, 0.07}), 0.9);
  return mesh;
}

std::shared_ptr<const surface::Core> linked_core(const hf_test::PlainMesh& mesh) {
  mesh::MeshInput input;
  input.vertex_count = mesh.vertex_count();
  input.triangle_count = mesh.triangle_count();
  input.positions = ConstRows(mesh.positions.data(), 3 * sizeof(double));
  input.triangles = IndexRows(mesh.triangles.data(), 3);
  mesh::LinkOptions links;
  links.mode = mesh::LinkMode::pieces;
  links.distance = mesh::default_link_distance;
  links.overlay = mesh::default_overlay;
  const auto plain = surface::Geometry::make(input, {}, std::make_shared<Memory>(), std::make_shared<JobRunner>(1u));
  return surface::Core::make(surface::Geometry::linked(plain, links), {});
}

struct Scene {
  std::shared_ptr<const surface::Core> core = shared_core();
  std::shared_ptr<PoseStack> pose = PoseStack::make(core, {});
  double box = core->mesh.scale;
  Region blade = select(*core, [](Vec3 p) { return p.y > 0.402; });
  Region foot = select(*core, [](Vec3 p) { return p.x < 0.3; });
  Region end = select(*core, [](Vec3 p) { return p.x > 2.4 && p.y < 0.402; });
  Region middle = select(*core, [](Vec3 p) { return p.x > 1.3 && p.x < 1.7 && p.y < 0.402; });
  Region tip = select(*core, [](Vec3 p) { return p.y > 0.402 && p.x > 2.5; });
  static std::shared_ptr<const surface::Core> shared_core() {
    static const std::shared_ptr<const surface::Core> core = linked_core(beam_and_blade());
    return core;
  }
  std::uint32_t add(const Region& region, std::uint32_t layer = 0, const HandleKind& kind = {}) {
    const std::uint32_t start[2] = {0, static_cast<std::uint32_t>(region.size())};
    std::uint32_t number = 0;
    pose->add_handles({start, 2}, region, layer, {&number, 1}, kind);
    return number;
  }
  void rigid(const Region& vertices) { pose->set_rigid_pieces(vertices); }
  void put(std::uint32_t handle, const HandleTransform& t) { pose->set_transforms({&handle, 1}, {&t, 1}); }
  Surface frame(std::uint32_t refine = 0, bool from_last = false, bool restart = false) {
    DeformRequest request;
    request.restart = restart;
    request.refine = refine;
    request.refine_from_last = from_last;
    const DeformReport report = pose->deform(request);
    return {report.positions.begin(), report.positions.end()};
  }
  // The largest change of an edge of the blade, as a share of it.
  double stretch(const Surface& x) const {
    const surface::Geometry& plain = core->geometry->unlinked();
    double most = 0;
    for (std::int32_t e = 0; e < plain.topology().edge_count(); ++e) {
      const std::int32_t i = plain.topology().first(e), j = plain.topology().second(e);
      const Vec3 p = core->mesh.to_given(core->mesh.positions[i]), q = core->mesh.to_given(core->mesh.positions[j]);
      if (p.y > 0.402 && q.y > 0.402) most = std::max(most, std::fabs(norm(x[i] - x[j]) / norm(p - q) - 1));
    }
    return most;
  }
};
const HandleTransform bent{{{0, 0, 0.38268343}, 0.92387953}, {-0.4, 0.6, 0.2}};

TEST(RigidPieces, EdgesKeepTheirLengthsAlsoAfterRefineAndOnLayers) {
  Scene scene;
  ASSERT_EQ(scene.core->mesh.component_count(), 1);
  scene.add(scene.foot);
  scene.add(scene.end);
  scene.put(1, bent);
  EXPECT_GT(scene.stretch(scene.frame()), 1e-3);  // without the call the blade bends
  scene.rigid({scene.blade[0], scene.blade[3]});
  EXPECT_LT(scene.stretch(scene.frame()), 1e-6);
  EXPECT_LT(scene.stretch(scene.frame(3)), 1e-6);
  EXPECT_LT(scene.stretch(scene.frame(1, true)), 1e-6);
  const std::uint32_t middle = scene.add(scene.middle, 1);
  scene.put(middle, {{}, {0, 0.3, 0.3}});
  EXPECT_LT(scene.stretch(scene.frame()), 1e-6);
  EXPECT_LT(scene.stretch(scene.frame(2)), 1e-6);
  EXPECT_LT(scene.stretch(scene.frame()), 1e-6);
  scene.rigid({});
  EXPECT_GT(scene.stretch(scene.frame()), 1e-3);
}

TEST(RigidPieces, OtherVerticesStayAndThePieceStaysWhereLinksHoldIt) {
  Scene scene, plain;
  for (Scene* s : {&scene, &plain}) {
    s->add(s->foot);
    s->add(s->end);
    s->put(1, bent);
  }
  scene.rigid({scene.blade[0]});
  const Surface x = scene.frame(), y = plain.frame();
  std::vector<bool> in_blade(x.size(), false);
  for (const std::int32_t v : scene.blade) in_blade[v] = true;
  for (std::size_t v = 0; v < x.size(); ++v) {
    if (in_blade[v]) continue;
    EXPECT_EQ(std::memcmp(&x[v], &y[v], sizeof(Vec3)), 0) << v;
  }
  Vec3 off;
  double count = 0;
  for (const mesh::Link& link : scene.core->geometry->links->links) {
    if (!in_blade[link.vertex]) continue;
    off = off + (x[link.vertex] - y[link.vertex]);
    ++count;
  }
  ASSERT_GT(count, 0);
  EXPECT_LT(norm((1 / count) * off), 0.02 * scene.box);
}

TEST(RigidPieces, AHandleOnAPieceMovesAllOfIt) {
  Scene scene;
  scene.rigid({scene.blade[0]});
  scene.add(scene.foot);
  const std::uint32_t tip = scene.add(scene.tip);
  EXPECT_EQ(scene.pose->handle(tip).vertex_count, scene.blade.size());
  scene.put(tip, bent);
  const Surface x = scene.frame();
  const Vec3 c = scene.pose->handle(tip).centroid;
  for (const std::int32_t v : scene.blade) {
    const Vec3 p = scene.core->mesh.to_given(scene.core->mesh.positions[v]);
    EXPECT_LT(norm(rotate(normalised(bent.rotation), p - c) + c + bent.translation - x[v]), 1e-12 * scene.box);
  }
}

void expect_conflict(const std::function<void()>& call, std::uint32_t index) {
  try {
    call();
    FAIL() << "it was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), HF_ERROR_CONFLICT) << error.what();
    EXPECT_EQ(error.index(), index) << error.what();
  }
}

TEST(RigidPieces, ASecondHandleOnAPieceIsRefusedAndNothingChanges) {
  Scene scene;
  scene.rigid({scene.blade[0]});
  scene.add(scene.foot);
  scene.add({scene.blade[0]});
  scene.put(1, bent);
  const Surface before = scene.frame(0, false, true);
  expect_conflict([&] { scene.add({scene.end[0], scene.tip[0]}, 1); }, 1);
  expect_conflict([&] { scene.add({scene.blade[5]}); }, 0);
  const std::uint32_t layered = scene.add({scene.end[0]}, 1);
  expect_conflict([&] { scene.add({scene.middle[0], scene.end[0]}); }, 1);
  scene.pose->remove_handles({&layered, 1});
  const std::uint32_t start[3] = {0, 1, 2};
  std::uint32_t numbers[2];
  EXPECT_EQ(scene.pose->handle_count(), 2u);
  const Surface after = scene.frame(0, false, true);
  EXPECT_EQ(std::memcmp(before.data(), after.data(), before.size() * sizeof(Vec3)), 0);
  Scene fresh;
  fresh.rigid({fresh.blade[0]});
  expect_conflict(
      [&] {
        const Region two{fresh.blade[0], fresh.tip[0] == fresh.blade[0] ? fresh.tip[1] : fresh.tip[0]};
        fresh.pose->add_handles({start, 3}, two, 0, {numbers, 2});
      },
      1);
}

// The beam is a piece, too: the region has grown by all of it before the second vertex is read.
TEST(RigidPieces, TheIndexOfARefusedRegionIsThatOfTheList) {
  Scene scene;
  scene.rigid({scene.foot[0], scene.blade[0]});
  scene.add({scene.blade[0]});
  expect_conflict([&] { scene.add({scene.foot[0], scene.tip[0]}); }, 1);
  Scene layered;
  layered.rigid({layered.blade[0]});
  layered.add({layered.end[0]}, 1);
  expect_conflict([&] { layered.add({layered.tip[0], layered.end[0]}); }, 1);
}

TEST(RigidPieces, EveryPieceIsMadeRigid) {
  Scene scene;
  const RigidPieces pieces(*scene.core, Region{scene.foot[0], scene.blade[0], scene.foot[1]}, *scene.core->memory);
  ASSERT_EQ(pieces.count(), 2u);
  const mesh::Mesh& mesh = scene.core->mesh;
  Surface x, scratch(pieces.scratch_size());
  for (const Vec3& inner : mesh.positions) {
    const Vec3 p = mesh.to_given(inner);
    x.push_back({p.x, p.y + 0.1 * p.x * p.x, p.z});
  }
  pieces.make_rigid(x.data(), scratch.data());
  const mesh::Topology& edges = scene.core->geometry->unlinked().topology();
  for (std::int32_t e = 0; e < edges.edge_count(); ++e) {
    const std::int32_t i = edges.first(e), j = edges.second(e);
    EXPECT_NEAR(norm(x[i] - x[j]), norm(mesh.to_given(mesh.positions[i]) - mesh.to_given(mesh.positions[j])), 1e-9);
  }
}

// A rigid fit takes the weighted centroid to the weighted centroid, so the centroid tells the weights.
TEST(RigidPieces, VerticesOfLinksCountMost) {
  Scene scene;
  const surface::Core& core = *scene.core;
  const RigidPieces pieces(core, Region{scene.blade[0]}, *core.memory);
  Surface x, scratch(pieces.scratch_size());
  for (const Vec3& inner : core.mesh.positions) {
    const Vec3 p = core.mesh.to_given(inner);
    x.push_back({p.x, p.y + 0.1 * p.x * p.x, p.z});
  }
  Surface fitted = x;
  pieces.make_rigid(fitted.data(), scratch.data());
  std::map<std::int32_t, double> held;
  double held_sum = 0, area_sum = 0;
  const auto hold = [&](std::int32_t v, double weight) {
    if (v == mesh::Mesh::none || pieces.piece_of(v) < 0) return;
    held[v] += weight;
    held_sum += weight;
  };
  for (const mesh::Link& link : core.geometry->links->links) {
    hold(link.vertex, link.weight);
    for (int c = 0; c < 3; ++c) hold(link.corner[c], link.weight * link.share[c]);
  }
  ASSERT_GT(held_sum, 0);
  for (const std::int32_t v : scene.blade) area_sum += core.geometry->areas[v];
  Vec3 off, plain_off;
  for (const std::int32_t v : scene.blade) {
    const double area = core.geometry->areas[v] / area_sum;
    const Vec3 moved = fitted[v] - x[v];
    off = off + ((1 - rigid_hold_share) * area + rigid_hold_share * held[v] / held_sum) * moved;
    plain_off = plain_off + area * moved;
  }
  EXPECT_LT(norm(off), 1e-7 * scene.box);
  EXPECT_GT(norm(plain_off), 1e-4 * scene.box);
}

TEST(RigidPieces, FloatsOfAFrameHaveThem) {
  Scene scene;
  scene.add(scene.foot);
  scene.add(scene.end);
  scene.put(1, bent);
  scene.rigid({scene.blade[0]});
  std::vector<float> floats(3 * static_cast<std::size_t>(scene.core->size()));
  DeformRequest request;
  request.packed_positions = floats.data();
  const DeformReport report = scene.pose->deform(request);
  for (std::size_t v = 0; report.packed_positions && v < report.positions.size(); ++v)
    EXPECT_NEAR(static_cast<double>(floats[3 * v + 1]), report.positions[v].y, 1e-5);
}

TEST(RigidPieces, AHandleWithAPartOfAPieceIsNamed) {
  Scene scene;
  scene.add(scene.foot);
  scene.add(scene.tip);
  expect_conflict([&] { scene.rigid({scene.foot[0], scene.blade[0]}); }, 0);
  EXPECT_FALSE(scene.pose->has_rigid_pieces());
  scene.pose->remove_handles(std::vector<std::uint32_t>{0});
  expect_conflict([&] { scene.rigid({scene.foot[0], scene.blade[0]}); }, 1);
  scene.pose->remove_handles(std::vector<std::uint32_t>{1});
  scene.rigid({scene.foot[0], scene.blade[0]});
}

TEST(RigidPieces, ClonesHaveThem) {
  Scene scene, copy;
  scene.rigid({scene.blade[0]});
  scene.add(scene.foot);
  scene.add(scene.end);
  scene.put(1, bent);
  copy.pose = scene.pose->clone();
  const Surface x = scene.frame(), y = copy.frame();
  EXPECT_EQ(std::memcmp(x.data(), y.data(), x.size() * sizeof(Vec3)), 0);
  copy.put(copy.add(copy.middle, 1), {{}, {0, 0.3, 0.3}});
  EXPECT_LT(copy.stretch(copy.frame()), 1e-6);
}

}  // namespace

// Steps on the limbs of handles: they keep lengths there, solve their equations, and move nothing else.
#include "deform/limbs.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "body.h"
#include "deform/pose_layout.h"
#include "deform/refine.h"
#include "support/dense.h"
#include "support/full.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::deform;
using namespace deform_test;

constexpr std::uint32_t hand = 2;

// Feet stand, a free hand is dragged, and the body is held back.
Body standing(const Creature& on = biped(), double following = 0.25) {
  Body body(on);
  for (const char* joint : {"foot_L", "foot_R", "hand_L"}) body.add(joint, {false, joint[0] == 'h'});
  body.follow(hand, following);
  return body;
}
void set_steps(Body& body, std::uint32_t steps, std::uint32_t handle = hand) {
  body.pose->set_limb_steps({&handle, 1}, steps);
}

struct Parts {
  explicit Parts(const Body& body, const std::vector<const char*>& joints)
      : core(*body.creature.core), handles(core.memory.get()) {
    Memory& memory = *core.memory;
    for (const char* joint : joints)
      handles.push_back(
          {static_cast<std::uint32_t>(handles.size()), make_region(core, body.region_at(joint), 0, memory)});
    reach = std::make_unique<Reach>(core.mesh, handles, memory);
    const auto sites = solve::SiteSolver::make(body.creature.core);
    set_handle_sites(core, *sites, Handles(&memory), handles, memory);
    fields = std::make_unique<HandleFields>(solve_handle_fields(core, *sites, handles, *reach, memory));
  }
  Region limb(std::int32_t handle) const {
    const Vector<std::int32_t> found = limb_of(core, *reach, *fields, handle, *core.memory);
    return {found.begin(), found.end()};
  }
  const surface::Core& core;
  Handles handles;
  std::unique_ptr<Reach> reach;
  std::unique_ptr<HandleFields> fields;
};

// Changes of length, as shares, of the edges of a triangulation within a part; the 95th of 100.
double changed_length(const surface::Core& core, const Region& part, const Surface& x) {
  std::vector<std::uint8_t> inside(static_cast<std::size_t>(core.size()), 0);
  for (const std::int32_t v : part) inside[v] = 1;
  std::vector<double> change;
  const SymmetricMatrix& k = core.laplacian;
  for (const std::int32_t v : part) {
    for (std::int32_t e = k.column_start[v]; e < k.column_start[v + 1]; ++e) {
      const std::int32_t u = k.row[e];
      if (u <= v || !inside[u]) continue;
      const double rest = core.mesh.scale * norm(core.mesh.positions[v] - core.mesh.positions[u]);
      change.push_back(std::fabs(norm(x[v] - x[u]) / rest - 1));
    }
  }
  std::sort(change.begin(), change.end());
  return change[change.size() * 95 / 100];
}

TEST(Limbs, AnArmEndsAtTheTrunk) {
  const Body body;
  const Parts feet(body, {"foot_L", "foot_R", "hand_L"}), trunk(body, {"foot_L", "foot_R", "hips", "hand_L"});
  for (const auto& [parts, handle] : {std::pair{&feet, 2}, std::pair{&trunk, 3}}) {
    const Region limb = parts->limb(handle);
    const auto holds = [&](const char* joint) {
      const Region region = body.region_at(joint, 0.03);
      std::size_t inside = 0;
      for (const std::int32_t v : region) inside += std::binary_search(limb.begin(), limb.end(), v);
      return static_cast<double>(inside) / static_cast<double>(region.size());
    };
    EXPECT_EQ(holds("lower_arm_L"), 1);
    for (const char* joint : {"head", "hand_R", "lower_arm_R", "lower_leg_L", "lower_leg_R", "hips"})
      EXPECT_EQ(holds(joint), 0) << joint;
    EXPECT_LT(limb.size(), static_cast<std::size_t>(body.creature.core->size()) / 4);
    EXPECT_TRUE(std::is_sorted(limb.begin(), limb.end()));
  }
}

TEST(Limbs, AnArmThatAnotherHandleCutsEndsThere) {
  const Body body;
  const Parts parts(body, {"foot_L", "foot_R", "hand_L", "lower_arm_L"});
  const Region limb = parts.limb(2), upper = body.region_at("upper_arm_L", 0.03);
  EXPECT_FALSE(limb.empty());
  for (const std::int32_t v : upper) EXPECT_FALSE(std::binary_search(limb.begin(), limb.end(), v));
}

TEST(Limbs, ATubeBetweenTwoHandlesIsAllLimb) {
  const auto core = hf_test::make_core(plain(samples::cylinder(16, 60)));
  Memory& memory = *core->memory;
  double low = HUGE_VAL, high = -HUGE_VAL;
  const auto along = [&](std::int32_t v) { return core->mesh.to_given(core->mesh.positions[v]).y; };
  for (std::int32_t v = 0; v < core->size(); ++v) {
    low = std::min(low, along(v));
    high = std::max(high, along(v));
  }
  Handles handles(&memory);
  for (const double end : {low, high}) {
    const Region region = select(*core, [&](Vec3 p) { return std::fabs(p.y - end) < 0.1 * (high - low); });
    handles.push_back({static_cast<std::uint32_t>(handles.size()), make_region(*core, region, 0, memory)});
  }
  const Reach reach(core->mesh, handles, memory);
  const auto sites = solve::SiteSolver::make(core);
  set_handle_sites(*core, *sites, Handles(&memory), handles, memory);
  const HandleFields fields = solve_handle_fields(*core, *sites, handles, reach, memory);
  for (const std::int32_t handle : {0, 1}) {
    const std::size_t limb = limb_of(*core, reach, fields, handle, memory).size();
    const std::size_t held = handles[0].region->vertices.size() + handles[1].region->vertices.size();
    EXPECT_GT(limb, 0.97 * static_cast<double>(static_cast<std::size_t>(core->size()) - held));
  }
}

TEST(Limbs, TheRestOfTheSurfaceKeepsItsBits) {
  Body plain = standing(), kept = standing();
  set_steps(kept, 8);
  const Region limb = Parts(plain, {"foot_L", "foot_R", "hand_L"}).limb(2);
  const Vec3 way{0.1, 0.25 * plain.box, 0.05};
  const Surface x = plain.drag(hand, way), y = kept.drag(hand, way);
  double inside = 0;
  for (std::int32_t v = 0; v < plain.creature.core->size(); ++v) {
    const double off = norm(x[v] - y[v]);
    inside = std::max(inside, off);
    if (off > 0) {
      EXPECT_TRUE(std::binary_search(limb.begin(), limb.end(), v)) << v;
    }
  }
  EXPECT_GT(inside, 1e-3 * plain.box);
}

// Where the hand comes when the arm turns about the shoulder and gets shorter between both: the elbow has to bend.
Vec3 bent_arm(const Creature& on, double angle, Vec3 axis, double share) {
  const Vec3 shoulder = on.joints.at("upper_arm_L"), arm = on.joints.at("hand_L") - shoulder;
  return shoulder + share * rotate(about(axis, angle), arm) - on.joints.at("hand_L");
}

TEST(Limbs, StepsKeepTheLengthsOfTheLimb) {
  const Creature creature = make_body("biped", 12000);
  const Region limb = Parts(Body(creature), {"foot_L", "foot_R", "hand_L"}).limb(2);
  for (const auto& [angle, axis] :
       hf_test::quick_and_full<std::pair<double, Vec3>>({{0.9, {0, 0, 1}}}, {{-0.7, {1, 0.3, 0}}, {0.6, {0, 1, 1}}})) {
    double last = HUGE_VAL, none = 0;
    for (const std::uint32_t steps : {0u, 1u, 8u, 32u}) {
      Body body = standing(creature);
      set_steps(body, steps);
      const Surface x = body.drag(hand, bent_arm(creature, angle, axis, 0.85));
      const double change = changed_length(*creature.core, limb, x);
      std::printf("limb, %u steps: %.1f %%\n", steps, 100 * change);
      EXPECT_LT(change, 1.02 * last);
      none = steps == 0 ? change : none;
      last = change;
    }
    EXPECT_LT(last, 0.85 * none);
  }
}

// One step from the frame x: u solves K_LL u = (b - K x)_L, with the rotations that fit x.
TEST(Limbs, AStepSolvesTheEquationsOfTheLimb) {
  Body plain = standing(), kept = standing();
  set_steps(kept, 1);
  const Vec3 way{0.1, 0.2 * plain.box, 0.1};
  const Surface x = plain.drag(hand, way), y = kept.drag(hand, way);
  const Parts parts(plain, {"foot_L", "foot_R", "hand_L"});
  const surface::Core& core = parts.core;
  const SymmetricMatrix& k = core.laplacian;
  const Region limb = parts.limb(2);
  const auto rotation = [&](std::int32_t v) {
    Mat3 sum;
    for (std::int32_t e = k.column_start[v]; e < k.column_start[v + 1]; ++e) {
      if (k.row[e] != v)
        add_outer(sum, std::max(0.0, -k.value[e]), x[v] - x[k.row[e]],
                  core.mesh.positions[v] - core.mesh.positions[k.row[e]]);
    }
    return best_rotation(sum, Quaternion());
  };
  std::vector<hf_test::SparseEntry> entries;
  std::vector<double> right[3];
  std::vector<Quaternion> handle_rotation;
  for (std::uint32_t h = 0; h < 3; ++h) handle_rotation.push_back(plain.pose->placed(h).rotation);
  const auto row_of = [&](std::int32_t v) {
    const auto at = std::lower_bound(limb.begin(), limb.end(), v);
    return at != limb.end() && *at == v ? static_cast<int>(at - limb.begin()) : -1;
  };
  const auto turned = [&](std::int32_t v) {
    const std::int32_t owner = parts.reach->owner[v];
    return owner >= 0 ? handle_rotation[static_cast<std::size_t>(owner)] : rotation(v);
  };
  for (const std::int32_t v : limb) {
    Vec3 sum;
    for (std::int32_t e = k.column_start[v]; e < k.column_start[v + 1]; ++e) {
      const std::int32_t u = k.row[e];
      if (const int row = row_of(u); row >= 0) entries.push_back({row_of(v), row, k.value[e]});
      if (u == v) continue;
      const Vec3 edge = core.mesh.scale * (core.mesh.positions[v] - core.mesh.positions[u]);
      sum = sum - k.value[e] * (0.5 * (rotate(turned(v), edge) + rotate(turned(u), edge)) - (x[v] - x[u]));
    }
    right[0].push_back(sum.x);
    right[1].push_back(sum.y);
    right[2].push_back(sum.z);
  }
  const int size = static_cast<int>(limb.size());
  std::vector<double> u[3];
  for (int i = 0; i < 3; ++i) u[i] = hf_test::sparse_solve(size, entries, right[i].data());
  double off = 0, moved = 0;
  for (std::size_t i = 0; i < limb.size(); ++i) {
    const Vec3 wanted{u[0][i], u[1][i], u[2][i]}, found = y[limb[i]] - x[limb[i]];
    off = std::max(off, norm(wanted - found));
    moved = std::max(moved, norm(found));
  }
  EXPECT_GT(moved, 1e-3 * plain.box);
  EXPECT_LT(off, 1e-9 * plain.box);
}

TEST(Limbs, WithoutStepsTheBitsAreThoseOfThePlainPose) {
  Body plain = standing(), back = standing();
  set_steps(back, 8);
  EXPECT_EQ(back.pose->limb_steps(hand), 8u);
  back.drag(hand, {0, 0.3, 0.1});
  set_steps(back, 0);
  EXPECT_EQ(back.pose->limb_steps(hand), 0u);
  for (Body* b : {&plain, &back}) b->put(hand, {{}, {0, 0.3, 0.1}});
  EXPECT_TRUE(same_bits(plain.frame(true), back.frame(true)));
}

TEST(Limbs, RestartAndClonesHaveTheBitsOfAFreshPose) {
  Body body = standing(), fresh = standing();
  set_steps(body, 4);
  body.drag(hand, {0, 0.21, 0.14});
  fresh.put(hand, {{}, {0, 0.21, 0.14}});
  set_steps(fresh, 4);
  EXPECT_TRUE(same_bits(body.frame(true), fresh.frame()));
  Body copy;
  copy.pose = body.pose->clone();
  EXPECT_EQ(copy.pose->limb_steps(hand), 4u);
  for (Body* b : {&body, &copy}) b->put(hand, {{}, {0.1, 0.3, 0}});
  EXPECT_TRUE(same_bits(body.frame(), copy.frame()));
}

TEST(Limbs, HandlesThatComeAndGoLeaveTheBits) {
  Body body = standing();
  set_steps(body, 4);
  body.put(hand, {{}, {0, 0.2, 0}});
  const Surface before = body.settle();
  const std::uint32_t other = body.add("hand_R");
  set_steps(body, 12, other);
  EXPECT_EQ(body.pose->limb_steps(hand), 4u);
  body.put(other, {{}, {0, 0.2, 0}});
  body.frame();
  body.pose->remove_handles({&other, 1});
  EXPECT_TRUE(same_bits(before, body.settle()));
  const std::uint32_t last = body.add("hand_R");
  set_steps(body, 0);
  body.pose->remove_handles({&last, 1});
  Body plain = standing();
  plain.put(hand, {{}, {0, 0.2, 0}});
  EXPECT_TRUE(same_bits(plain.frame(true), body.frame(true)));
}

TEST(Limbs, AddedInPlaceAHandleMovesNothing) {
  Body body = standing();
  set_steps(body, 8);
  body.put(hand, {{}, {0, 0.2, 0.1}});
  const Surface before = body.settle();
  body.add("hand_R", {true, true});
  EXPECT_LT(largest_distance(before, body.settle()), 1e-6 * body.box);
}

TEST(Limbs, TakenAfterStepsOfTheWholeSurfaceTheyMoveTheLimbAlone) {
  Body plain = standing(), kept = standing();
  set_steps(kept, 3);
  const Region limb = Parts(plain, {"foot_L", "foot_R", "hand_L"}).limb(2);
  DeformRequest request;
  request.refine = 2;
  for (Body* b : {&plain, &kept}) b->put(hand, {{}, {0, 0.2, 0.1}});
  const Span<const Vec3> x = plain.pose->deform(request).positions, y = kept.pose->deform(request).positions;
  bool differs = false;
  for (std::int32_t v = 0; v < plain.creature.core->size(); ++v) {
    const bool same = norm(x[v] - y[v]) == 0;
    differs = differs || !same;
    if (!same) {
      EXPECT_TRUE(std::binary_search(limb.begin(), limb.end(), v));
    }
  }
  EXPECT_TRUE(differs);
}

TEST(Limbs, AHandleAloneAndAHandleThatTouchesItsNeighbourHaveNoSteps) {
  Body body;
  const std::uint32_t foot = body.add("foot_L");
  set_steps(body, 5, foot);
  EXPECT_EQ(body.pose->limb_steps(foot), 5u);
  const Vec3 way{0.1, 0.2, 0.3};
  const Surface rest = body.frame();
  body.put(foot, {{}, way});
  const Surface x = body.frame();
  for (std::size_t v = 0; v < x.size(); ++v) EXPECT_LT(norm(x[v] - rest[v] - way), 1e-12 * body.box);
}

TEST(Limbs, LayersRefuseThem) {
  Body body;
  expect_layers_refuse(body, [&](Span<const std::uint32_t> handles) { body.pose->set_limb_steps(handles, 2); });
  EXPECT_EQ(body.pose->limb_steps(0), 0u);
}

// Figures of docs: time and lengths beside steps of the whole surface, on 50,000 vertices. Run with
// --gtest_also_run_disabled_tests.
TEST(Limbs, DISABLED_Figures) {
  const Creature creature = make_body("biped", 50000);
  const Region limb = Parts(Body(creature), {"foot_L", "foot_R", "hand_L"}).limb(2);
  std::printf("%d vertices, %zu of the limb\n", creature.core->size(), limb.size());
  for (const double following : {1.0, 0.25}) {
    for (const auto& [whole, steps] : {std::pair{0u, 0u}, {1u, 0u}, {8u, 0u}, {0u, 1u}, {0u, 8u}, {0u, 16u}}) {
      Body body = standing(creature, following);
      set_steps(body, steps);
      DeformRequest request;
      request.refine = whole;
      Surface x;
      std::vector<double> total, refine;
      for (int f = 1; f <= 40; ++f) {
        body.put(hand, {{}, (std::min(f, 25) / 25.0) * bent_arm(creature, 0.9, {0, 0, 1}, 0.85)});
        const DeformReport report = body.pose->deform(request);
        x.assign(report.positions.begin(), report.positions.end());
        total.push_back(report.solve_ms + report.blend_ms + report.refine_ms);
        refine.push_back(report.refine_ms);
      }
      std::sort(total.begin(), total.end());
      std::sort(refine.begin(), refine.end());
      std::printf("following %.2f, whole %u, limb %u: 95 %% of edges within %.1f %%, frame %.2f ms, steps %.2f ms\n",
                  following, whole, steps, 100 * changed_length(*creature.core, limb, x), total[20], refine[20]);
    }
  }
}

}  // namespace

// How much follows a handle: the body stays with a small share, all follows with 1, and the pins solve their equations.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/error.h"
#include "body.h"
#include "deform/constants.h"
#include "deform/pose_layout.h"
#include "support/dense.h"
#include "support/pose_modes.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::deform;
using namespace deform_test;
// The hand is pulled up by a quarter of the box; feet stand.
struct Drag {
  explicit Drag(double share) {
    for (const char* foot : {"foot_L", "foot_R"}) body.add(foot);
    hand = body.add("hand_L", free_kind);
    if (share < 1) body.follow(hand, share);
    rest = body.settle();
    posed = body.drag(hand, {0, 0.25 * body.box, 0});
  }
  double moved_at(const char* joint) const { return moved(rest, posed, body.region_at(joint, 0.04)) / body.box; }
  Body body;
  std::uint32_t hand = 0;
  Surface rest, posed;
};

TEST(Following, TheBodyStaysMoreTheLessFollows) {
  double last[3] = {1, 1, 1};
  for (const double share : {1.0, 0.75, 0.5, 0.25, 0.1, 0.0}) {
    const Drag drag(share);
    const double now[3] = {drag.moved_at("head"), drag.moved_at("hand_R"), drag.moved_at("lower_leg_R")};
    std::printf("%.2f: head %.4f, other hand %.4f, other knee %.4f of the box\n", share, now[0], now[1], now[2]);
    for (int k = 0; k < 3; ++k) {
      EXPECT_LE(now[k], last[k]) << "share " << share << ", place " << k;
      last[k] = now[k];
      if (share <= 0.25) {
        EXPECT_LT(now[k], 0.03);
      }
    }
    if (share == 1) {
      EXPECT_GT(now[0], 0.04);
    }
    Vec3 mean;
    const Region region = drag.body.region_at("hand_L");
    for (const std::int32_t v : region) mean = mean + (drag.posed[v] - drag.rest[v]);
    mean = (1.0 / static_cast<double>(region.size())) * mean;
    EXPECT_LT(norm(mean - Vec3{0, 0.25 * drag.body.box, 0}), 1e-12 * drag.body.box);
  }
}

TEST(Following, AtOneTheBitsAreThoseOfTodaysWay) {
  Body plain, back;
  for (Body* b : {&plain, &back}) {
    b->add("foot_L");
    b->add("foot_R");
    b->add("hand_L", free_kind);
  }
  back.follow(2, 0.3);
  back.put(2, {{}, {0, 0.1, 0.1}});
  back.settle();
  back.follow(2, 1);
  EXPECT_EQ(back.pose->following(2), 1);
  for (Body* b : {&plain, &back}) b->put(2, {{}, {0, 0.3, 0.1}});
  EXPECT_TRUE(same_bits(plain.frame(true), back.frame(true)));
  EXPECT_TRUE(same_bits(plain.frame(), back.frame()));
}

TEST(Following, AShareThatChangesShowsInTheNextFrame) {
  Drag drag(0.1);
  drag.body.follow(drag.hand, 1);
  EXPECT_GT(largest_distance(drag.posed, drag.body.frame()), 1e-3 * drag.body.box);
  EXPECT_LT(largest_distance(Drag(1).posed, drag.body.settle()), 1e-3 * drag.body.box);
}

TEST(Following, APullOfTheOthersTakesTheHandAlongAsIfItHadNoPins) {
  Body body;
  for (const char* joint : {"foot_L", "foot_R", "hips", "hand_L", "hand_R"})
    body.add(joint, {}, joint[1] == 'i' ? 0.08 : 0.05);
  body.follow(3, 0.1);
  body.follow(4, 0.3);
  const Surface p = body.settle();
  for (int round = 1; round < 7; ++round) {
    const Quaternion turn = about({1, 0.5 * round, -1}, 0.35 * round);
    const Vec3 way{0.3 * round, -0.1, 0.2};
    for (std::uint32_t h = 0; h < 5; ++h) {
      const Vec3 c = body.pose->handle(h).centroid;
      body.put(h, {turn, rotate(turn, c) - c + way});
    }
    const Surface x = body.frame(round % 3 == 2);
    double off = 0;
    for (std::size_t v = 0; v < x.size(); ++v) off = std::max(off, norm(x[v] - rotate(turn, p[v]) - way));
    EXPECT_LT(off, 1e-8 * body.box) << "round " << round;
  }
}

TEST(Following, PinsPullToThePoseWithoutTheHandle) {
  Body with, without;
  for (Body* b : {&with, &without}) {
    b->add("foot_L");
    b->add("foot_R");
    b->add("hips", {}, 0.08);
    b->put(2, {about({0, 0, 1}, 0.3), {0.05, -0.12, 0.02}});
  }
  const std::uint32_t hand = with.add("hand_L", free_kind);
  with.follow(hand, 0);
  const Surface bent = without.settle();
  Vec3 mean;
  const Region region = with.region_at("hand_L");
  const Vec3 c = with.pose->handle(hand).centroid;
  for (const std::int32_t v : region) mean = mean + (1.0 / static_cast<double>(region.size())) * bent[v];
  with.put(hand, {{}, mean - c + Vec3{0, 0.2 * with.box, 0}});
  const Surface dragged = with.settle();
  for (const char* joint : {"head", "hand_R", "lower_leg_L", "lower_leg_R"})
    EXPECT_LT(moved(bent, dragged, with.region_at(joint, 0.04)), 0.01 * with.box) << joint;
}

TEST(Following, RestartAndClonesHaveTheBitsOfAFreshPose) {
  Body body, fresh;
  for (Body* b : {&body, &fresh}) {
    for (const char* joint : {"foot_L", "foot_R", "hand_L"}) b->add(joint, {false, joint[0] == 'h'});
  }
  body.follow(2, 0.2);
  for (int k = 1; k < 8; ++k) {
    body.put(1, {{}, {0.01 * k, 0, 0.02 * k}});
    body.put(2, {{}, {0, 0.03 * k, 0.02 * k}});
    body.frame();
  }
  fresh.put(1, {{}, {0.07, 0, 0.14}});
  fresh.put(2, {{}, {0, 0.21, 0.14}});
  fresh.follow(2, 0.2);
  EXPECT_TRUE(same_bits(body.frame(true), fresh.frame()));
  Body copy;
  copy.pose = body.pose->clone();
  EXPECT_EQ(copy.pose->following(2), 0.2);
  for (Body* b : {&body, &copy}) b->put(2, {{}, {0.1, 0.3, 0}});
  EXPECT_TRUE(same_bits(body.frame(), copy.frame()));
  for (Body* b : {&body, &copy}) b->put(0, {{}, {0, 0.1, 0}});
  EXPECT_TRUE(same_bits(body.frame(), copy.frame()));
}

TEST(Following, RemovingTheLastHandleRestoresTheBits) {
  Body body;
  for (const char* joint : {"foot_L", "foot_R", "hand_L"}) body.add(joint);
  body.follow(2, 0.2);
  body.put(2, {{}, {0, 0.2, 0}});
  body.put(1, {{}, {0, 0.1, 0}});
  const Surface before = body.settle();
  const std::uint32_t other = body.add("hand_R");
  body.follow(other, 0.4);
  body.put(other, {{}, {0, 0.2, 0}});
  body.frame();
  body.pose->remove_handles({&other, 1});
  EXPECT_TRUE(same_bits(before, body.settle()));
}

TEST(Following, RemovingTheLastHandleAfterFramesRestoresTheBitsOfAFreeHand) {
  Body body;
  for (const char* joint : {"foot_L", "foot_R", "hand_L"}) body.add(joint, {false, joint[0] == 'h'});
  body.follow(2, 0.2);
  body.put(2, {{}, {0, 0.2, 0}});
  const Surface before = body.settle();
  const std::uint32_t other = body.add("hand_R");
  body.put(other, {{}, {0, 0.2, 0}});
  body.settle();
  body.pose->remove_handles({&other, 1});
  EXPECT_TRUE(same_bits(before, body.settle()));
}

TEST(Following, AHandleThatIsFreedIsFreeWhereThePinsPullTo) {
  Body body, fresh;
  for (Body* b : {&body, &fresh}) {
    for (const char* joint : {"foot_L", "hips", "hand_L"}) b->add(joint, {false, b == &fresh && joint[1] == 'i'});
    b->follow(2, 0.2);
    b->put(1, {{}, {0.1, -0.1, 0.05}});
    b->put(2, {{}, {0, 0.2, 0.1}});
  }
  const Surface wanted = fresh.frame();
  const std::uint32_t hips = 1;
  body.settle();
  body.pose->set_free_turns({&hips, 1}, true);
  EXPECT_TRUE(same_bits(body.frame(true), wanted));
  body.pose->set_free_turns({&hips, 1}, false);
  const std::uint32_t other = body.add("hand_R");
  body.pose->set_free_turns({&hips, 1}, true);
  body.pose->remove_handles({&other, 1});
  EXPECT_TRUE(same_bits(body.frame(true), wanted));
}

TEST(Following, AddedInPlaceAHandleMovesNothing) {
  Body body;
  for (const char* joint : {"foot_L", "foot_R", "hand_L"}) body.add(joint, {false, joint[0] == 'h'});
  body.follow(2, 0.2);
  body.put(2, {{}, {0, 0.2, 0.1}});
  const Surface before = body.settle();
  body.add("hand_R", {true, true});
  EXPECT_LT(largest_distance(before, body.settle()), 1e-6 * body.box);
}

TEST(Following, LayersAndThePapersModeRefuseIt) {
  Body body;
  expect_layers_refuse(body, [&](Span<const std::uint32_t> handles) { body.pose->set_following(handles, 0.5); });
  EXPECT_EQ(body.pose->following(0), 1);
  PoseOptions paper;
  paper.scheme = hf_test::scheme_of(hf_test::DeformMode::paper);
  body.pose = PoseStack::make(body.creature.core, paper);
  const std::uint32_t foot = body.add("foot_L");
  EXPECT_THROW(body.follow(foot, 0.5), Error);
  body.follow(foot, 1);
}

// The prepared system of a set of handles, and its dense matrix.
struct System {
  Body body;
  const surface::Core& core = *body.creature.core;
  Memory& memory = *core.memory;
  Rest rest{core, memory};
  Handles handles{&memory};
  std::unique_ptr<Reach> reach;
  std::unique_ptr<HandleFields> fields;
  std::unique_ptr<ClusterWeights> weights;
  std::shared_ptr<const Groups> groups;
  std::unique_ptr<SmoothSystem> smooth;
  std::size_t size = 0;
  hf_eigen::MatrixXd matrix, inverse;  // of the free clusters
  System() {
    for (const char* joint : {"foot_L", "foot_R", "hand_L", "hand_R"})
      handles.push_back(
          {static_cast<std::uint32_t>(handles.size()), make_region(core, body.region_at(joint), 0, memory)});
    reach = std::make_unique<Reach>(core.mesh, handles, memory);
    const auto sites = solve::SiteSolver::make(body.creature.core);
    set_handle_sites(core, *sites, Handles(&memory), handles, memory);
    fields = std::make_unique<HandleFields>(solve_handle_fields(core, *sites, handles, *reach, memory));
    weights = std::make_unique<ClusterWeights>(make_cluster_weights(core, rest, *reach, *fields, {}, memory));
    groups = Groups::with(nullptr, core, rest, Vector<std::int32_t>(1, 0, &memory), default_groups, memory);
    smooth = std::make_unique<SmoothSystem>(core, rest, *weights, *groups, *fields, memory);
    size = static_cast<std::size_t>(smooth->subspace.factor.size());
    inverse.resize(static_cast<hf_eigen::Index>(size), static_cast<hf_eigen::Index>(size));
    for (std::size_t k = 0; k < size; ++k) {
      std::vector<double> x(4 * size, 0.0);
      x[4 * k] = 1;
      smooth->subspace.factor.solve(x.data());
      for (std::size_t i = 0; i < size; ++i)
        inverse(static_cast<hf_eigen::Index>(i), static_cast<hf_eigen::Index>(k)) = x[4 * i];
    }
    matrix = hf_test::DenseSolver(inverse).solve(
        hf_eigen::MatrixXd(hf_eigen::MatrixXd::Identity(inverse.rows(), inverse.cols())));
  }
  Holds holds(const std::vector<double>& follow) {
    return make_holds({core.mesh, smooth->subspace, *weights, *groups, *fields, *reach, follow}, memory);
  }
  // Z_f: a column of free unknowns for each pin.
  hf_eigen::MatrixXd free_parts(const Holds& holds) const {
    hf_eigen::MatrixXd z = hf_eigen::MatrixXd::Zero(inverse.rows(), static_cast<hf_eigen::Index>(holds.count()));
    for (hf_eigen::Index j = 0; j < z.cols(); ++j) {
      for (std::int32_t e = holds.row_start[j]; e < holds.row_start[j + 1]; ++e) {
        const std::int32_t f = holds.row[e].cluster - smooth->handle_count;
        for (int a = 0; f >= 0 && a < 4; ++a) z(4 * f + a, j) = holds.row[e].z[a];
      }
    }
    return z;
  }
};

TEST(Following, APinIsAsStrongAsTheFieldsAndTheSurfaceSay) {
  System s;
  for (const double share : {0.2, 0.0}) {
    const Holds holds = s.holds({1, 1, share, 0.5});
    ASSERT_GT(holds.count(), 20u);
    const hf_eigen::MatrixXd z = s.free_parts(holds);
    const hf_eigen::VectorXd given =
        hf_test::dense_product(z, hf_test::dense_product(s.inverse, z), true).diagonal();  // by a pin to a unit force
    std::map<std::int32_t, double> softness;
    for (std::size_t j = 0; j < holds.count(); ++j)
      softness[s.core.mesh.component[holds.vertex[j]]] += given(static_cast<hf_eigen::Index>(j));
    for (std::size_t j = 0; j < holds.count(); ++j) {
      const std::int32_t v = holds.vertex[j];
      const double a = s.fields->at(v)[2], b = s.fields->at(v)[3];
      const double g = hold_strength * (1 - share) / std::max(share, least_following), of_half = hold_strength;
      const double wanted = std::pow(1 - std::max(a, b), hold_power) * (a * g + b * of_half) / (a + b);
      EXPECT_NEAR(holds.strength[j] * softness[s.core.mesh.component[v]], wanted, 1e-6 * wanted) << j;
    }
  }
}

TEST(Following, ThePinsSolveTheSystemThatHasThemInItsMatrix) {
  System s;
  const Holds holds = s.holds({1, 1, 0.2, 0.5});
  ASSERT_GT(holds.count(), 20u);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  const std::size_t handles = 16 * static_cast<std::size_t>(s.smooth->handle_count);
  std::vector<double> rows(handles + 16 * static_cast<std::size_t>(s.smooth->free_count));
  for (double& x : rows) x = any(random);
  HoldsState state(s.memory);
  state.fit(holds.count());
  for (double& x : state.target) x = any(random);
  // dense: (L + Z D Z') X = r + Z D (y - Z_h' X_h)
  const hf_eigen::Index size = static_cast<hf_eigen::Index>(s.size), m = static_cast<hf_eigen::Index>(holds.count());
  const hf_eigen::MatrixXd z = s.free_parts(holds);
  hf_eigen::MatrixXd r(size, 3), gap(m, 3);
  for (hf_eigen::Index i = 0; i < size; ++i) {
    for (hf_eigen::Index k = 0; k < 3; ++k) r(i, k) = rows[handles + static_cast<std::size_t>(4 * i + k)];
  }
  for (hf_eigen::Index j = 0; j < m; ++j) {
    for (hf_eigen::Index k = 0; k < 3; ++k) gap(j, k) = state.target[static_cast<std::size_t>(4 * j + k)];
    for (std::int32_t e = holds.row_start[j]; e < holds.row_start[j + 1]; ++e) {
      const Holds::Part& part = holds.row[e];
      for (int a = 0; a < 4; ++a) {
        const hf_eigen::Index row = 4 * (part.cluster - s.smooth->handle_count) + a;
        for (int k = 0; row < 0 && k < 3; ++k)
          gap(j, k) -= part.z[a] * rows[static_cast<std::size_t>(16 * part.cluster + 4 * a + k)];
      }
    }
  }
  const hf_eigen::VectorXd strength = hf_eigen::Map<const hf_eigen::VectorXd>(holds.strength.data(), m);
  const hf_eigen::MatrixXd rows_of_pins = z.transpose(), strong = strength.asDiagonal() * gap,
                           stiff = strength.asDiagonal() * rows_of_pins,
                           with_pins = s.matrix + hf_test::dense_product(z, stiff),
                           pulled = r + hf_test::dense_product(z, strong),
                           wanted = hf_test::DenseSolver(with_pins).solve(pulled);
  double* const solved = rows.data() + handles;
  begin_holds(holds, static_cast<std::size_t>(s.smooth->handle_count), rows.data(), state);
  gap_before(holds, solved, s.size, state);
  const hf_eigen::MatrixXd gap_wanted = gap - hf_test::dense_product(z, hf_test::dense_product(s.inverse, r), true);
  for (hf_eigen::Index j = 0; j < m; ++j) {
    for (hf_eigen::Index k = 0; k < 3; ++k)
      EXPECT_NEAR(state.pull[static_cast<std::size_t>(4 * j + k)], gap_wanted(j, k), 1e-9 * gap.cwiseAbs().maxCoeff());
  }
  s.smooth->subspace.factor.solve(solved);
  const hf_eigen::MatrixXd plain = hf_test::DenseSolver(s.matrix).solve(r);
  add_holds(holds, rows.data(), solved, s.size, state);
  double off = 0;
  for (hf_eigen::Index i = 0; i < size; ++i) {
    for (hf_eigen::Index k = 0; k < 3; ++k)
      off = std::max(off, std::fabs(wanted(i, k) - solved[static_cast<std::size_t>(4 * i + k)]));
  }
  EXPECT_LT(off, 1e-6 * wanted.cwiseAbs().maxCoeff());
  EXPECT_GT((wanted - plain).cwiseAbs().maxCoeff(), 1e-3 * wanted.cwiseAbs().maxCoeff());
}

}  // namespace

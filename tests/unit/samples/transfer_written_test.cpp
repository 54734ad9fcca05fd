// What is written to the target's own skin, beside the computed frames: the fit of its joints, and the keys left out.
#include <gtest/gtest.h>

#include <cmath>

#include "gltf/animate.h"
#include "gltf/key_reduce.h"
#include "gltf/rig_fit.h"
#include "unit/samples/transfer_program_support.h"

namespace {

using namespace transfer_program;
using namespace hf_gltf;

// Legs half as long again as the bones, upside down: no pose meets the frame. The best one stays when it is fitted
// again.
TEST(TransferWritten, AFitThatStartsAtItsResultStaysThere) {
  const Model horse = read_gltf(creature("horse"));
  const FlatMesh mesh = flatten(horse);
  const RigFit rig(horse, mesh);
  std::vector<double> frame;
  for (const glm::dvec3& p : posed_positions(horse, mesh, horse.animations[0], 0.3))
    for (const double x : {-p.x, p.y > 1 ? -p.y : -1.5 * p.y, p.z}) frame.push_back(x);
  const RigPose once = rig.fit(frame, rig.rest(), {}, {}), again = rig.fit(frame, once, {}, {});
  const auto miss = [&](const RigPose& pose) {
    const std::vector<glm::dvec3> got = posed_positions(horse, mesh, rig.whole(pose));
    double sum = 0;
    for (size_t v = 0; v < got.size(); ++v)
      sum += std::pow(glm::distance(got[v], {frame[3 * v], frame[3 * v + 1], frame[3 * v + 2]}), 2);
    return std::sqrt(sum / static_cast<double>(got.size()));
  };
  std::printf("misses %.5f, fitted again %.5f\n", miss(once), miss(again));
  EXPECT_NEAR(miss(again), miss(once), 0.01 * miss(once));
}

// The model under a node that scales it: the fit is the same in any unit.
TEST(TransferWritten, AFitDoesNotDependOnTheUnit) {
  const auto fitted = [](double scale) {
    Model horse = read_gltf(creature("horse"));
    Node root;
    root.scale = glm::dvec3(scale);
    for (size_t n = 0; n < horse.nodes.size(); ++n) {
      if (horse.nodes[n].parent >= 0) continue;
      horse.nodes[n].parent = static_cast<int>(horse.nodes.size());
      root.children.push_back(static_cast<int>(n));
    }
    horse.nodes.push_back(root);
    const FlatMesh mesh = flatten(horse);
    const RigFit rig(horse, mesh);
    std::vector<double> frame;
    for (const glm::dvec3& p : posed_positions(horse, mesh, horse.animations[0], 0.3))
      for (const double x : {-p.x, p.y > scale ? -p.y : -1.5 * p.y, p.z}) frame.push_back(x);
    std::vector<glm::dvec3> out = posed_positions(horse, mesh, rig.whole(rig.fit(frame, rig.rest(), {}, {})));
    for (glm::dvec3& p : out) p /= scale;
    return out;
  };
  const std::vector<glm::dvec3> wanted = fitted(1);
  for (const double scale : {1e-6, 1e-4, 1e6}) {
    const std::vector<glm::dvec3> got = fitted(scale);
    double worst = 0;
    for (size_t v = 0; v < got.size(); ++v) worst = std::max(worst, glm::distance(got[v], wanted[v]));
    EXPECT_LT(worst, 1e-5) << "scale " << scale;
  }
}

// Root and hips of a horse can both carry it along. The path goes into the upper one that its own clips move.
TEST(TransferWritten, ThePathOfABodyIsInOneJoint) {
  const Model horse = read_gltf(creature("horse"));
  const auto node_of = [&](const std::string& name) {
    for (size_t n = 0; n < horse.nodes.size(); ++n)
      if (horse.nodes[n].name == name) return static_cast<int>(n);
    throw std::runtime_error("no joint " + name);
  };
  const int root = node_of("root"), hips = node_of("hips");
  const FlatMesh mesh = flatten(horse);
  std::vector<double> frame;
  for (const glm::dvec3& p : posed_positions(horse, mesh, rest_pose(horse)))
    for (const double x : {p.x, p.y, p.z + 3}) frame.push_back(x);
  struct Case {
    std::vector<int> moving;
    int carrier;
  };
  for (const Case& c : {Case{{root, hips}, root}, Case{{root}, root}, Case{{hips}, hips}, Case{{}, root}}) {
    Model model = horse;
    model.animations.assign(1, Animation{});
    for (const int node : c.moving) {
      const glm::dvec3 at = model.nodes[static_cast<size_t>(node)].translation;
      Channel channel;
      channel.node = node;
      channel.path = Path::translation;
      channel.times = {0, 1};
      for (const double z : {at.z, at.z + 1})
        for (const double x : {at.x, at.y, z}) channel.values.push_back(static_cast<float>(x));
      model.animations[0].channels.push_back(channel);
    }
    const RigFit rig(model, mesh);
    const Pose pose = rig.whole(rig.fit(frame, rig.rest(), {}, {})), rest = rig.whole(rig.rest());
    for (size_t n = 0; n < pose.size(); ++n) {
      const double wanted = static_cast<int>(n) == c.carrier ? 3 : 0;
      EXPECT_NEAR(glm::distance(pose[n].translation, rest[n].translation), wanted, 1e-3) << model.nodes[n].name;
    }
  }
}

// A file of a chain of 1,001 joints, each with a vertex: its system would take gigabytes.
TEST(TransferWritten, AModelOfTooManyJointsIsRefused) {
  constexpr uint16_t joints = 1001;
  Model model;
  model.name = "chain";
  Primitive primitive;
  Skin skin;
  for (uint16_t j = 0; j < joints; ++j) {
    Node node;
    node.parent = j == 0 ? -1 : j - 1;
    if (j + 1 < joints) node.children = {j + 1};
    model.nodes.push_back(node);
    skin.joints.push_back(j);
    skin.inverse_bind.emplace_back(1);
    primitive.positions.emplace_back(j, j % 2, 0);
    Influences influences;
    influences.joints[0] = j;
    influences.weights[0] = 1;
    primitive.influences.push_back(influences);
    if (j >= 2) primitive.indices.insert(primitive.indices.end(), {uint32_t(j - 2), uint32_t(j - 1), uint32_t(j)});
  }
  Node body;
  body.mesh = 0;
  body.skin = 0;
  model.nodes.push_back(body);
  model.skins = {skin};
  model.meshes.emplace_back();
  model.meshes[0].primitives = {primitive};
  try {
    const RigFit rig(model, flatten(model));
    FAIL() << "1,001 joints were taken";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "chain has 1001 joints, and at most 1000 can be fitted: take --as skin or --as morph");
  }
}

// Frames of the rig itself, turned over as a whole: every frame is met.
TEST(TransferWritten, ASomersaultIsMet) {
  const Model horse = read_gltf(creature("horse"));
  const FlatMesh mesh = flatten(horse);
  const RigFit rig(horse, mesh);
  std::vector<std::vector<double>> frames;
  std::vector<double> times;
  for (int f = 0; f <= 24; ++f) {
    const double angle = f * 3.14159265358979 / 12;
    times.push_back(f / 30.0);
    frames.emplace_back();
    for (const glm::dvec3& p : posed_positions(horse, mesh, horse.animations[0], 0.2)) {
      const glm::dvec3 q = glm::angleAxis(angle, glm::dvec3(1, 0, 0)) * p;
      for (int c = 0; c < 3; ++c) frames.back().push_back(q[c]);
    }
  }
  const std::vector<RigPose> poses = rig.fit_all(times, frames, [](size_t) { return std::vector<double>(); });
  double worst = 0;
  for (size_t f = 0; f < frames.size(); ++f) {
    const std::vector<glm::dvec3> got = posed_positions(horse, mesh, rig.whole(poses[f]));
    for (size_t v = 0; v < got.size(); ++v)
      worst = std::max(worst, glm::distance(got[v], {frames[f][3 * v], frames[f][3 * v + 1], frames[f][3 * v + 2]}));
  }
  std::printf("a somersault is missed by %.4f\n", worst);
  EXPECT_LT(worst, 0.05);  // of a body some 5 long: small bones keep near their rest
}

// Legs that the frames shorten by a third stand on the ground there. Bones keep their lengths, so the nearest pose
// would sink. With a ground it bends its legs, and parts that may sink stay where they were.
TEST(TransferWritten, BonesThatAreTooLongStayAboveTheGround) {
  const Model horse = read_gltf(creature("horse"));
  const FlatMesh mesh = flatten(horse);
  const RigFit rig(horse, mesh);
  double ground = 1e300, top = -1e300;
  for (const glm::dvec3& p : mesh.positions) {
    ground = std::min(ground, p.y);
    top = std::max(top, p.y);
  }
  const double hip = 0.5 * (ground + top);
  std::vector<double> frame;
  for (const glm::dvec3& p : posed_positions(horse, mesh, horse.animations[0], 0.3))
    for (const double x : {p.x, p.y > hip ? p.y - (hip - ground) / 3 : ground + (p.y - ground) * 2 / 3, p.z})
      frame.push_back(x);
  const auto depth = [&](const RigGround* given) {
    double low = 1e300;
    for (const glm::dvec3& p : posed_positions(horse, mesh, rig.whole(rig.fit(frame, rig.rest(), {}, {}, given))))
      low = std::min(low, p.y);
    return (ground - low) / (top - ground);
  };
  const RigGround all = {{0, 1, 0}, {ground}, {}},
                  none = {{0, 1, 0}, {ground}, std::vector<uint8_t>(mesh.positions.size(), 1)},
                  far = {{0, 1, 0}, {ground - top}, {}};
  std::printf("the deepest sinks by %.4f, with a ground by %.4f\n", depth(nullptr), depth(&all));
  EXPECT_GT(depth(nullptr), 0.03);
  EXPECT_LT(depth(&all), 0.01);
  EXPECT_EQ(depth(&none), depth(nullptr));
  EXPECT_EQ(depth(&far), depth(nullptr));
}

// A body on one leg: a strip of rows from 0 to 5, with a hip at 2 and a knee at 1.
Model one_leg() {
  Model model;
  model.name = "one leg";
  Skin skin;
  const double heights[3] = {3, 2, 1};
  for (int j = 0; j < 3; ++j) {
    Node node;
    node.parent = j - 1;
    node.translation = {0, j == 0 ? heights[0] : -1, 0};
    if (j < 2) node.children = {j + 1};
    model.nodes.push_back(node);
    skin.joints.push_back(j);
    glm::dmat4 bind(1);
    bind[3][1] = -heights[j];
    skin.inverse_bind.emplace_back(bind);
  }
  Primitive primitive;
  for (uint32_t row = 0; row <= 20; ++row) {
    for (const double x : {-0.1, 0.1}) {
      primitive.positions.emplace_back(x, 0.25 * row, 0);
      Influences influences;
      influences.joints[0] = row >= 8 ? 0 : row >= 4 ? 1 : 2;
      influences.weights[0] = 1;
      primitive.influences.push_back(influences);
    }
    const uint32_t a = 2 * row;
    if (row < 20) primitive.indices.insert(primitive.indices.end(), {a, a + 1, a + 2, a + 2, a + 1, a + 3});
  }
  Node body;
  body.mesh = 0;
  body.skin = 0;
  model.nodes.push_back(body);
  model.skins = {skin};
  model.meshes.emplace_back();
  model.meshes[0].primitives = {primitive};
  return model;
}

// The leg is `length` times as long, and its knee stands out by `bend`.
std::vector<double> frame_of_leg(const FlatMesh& mesh, double length, double bend) {
  std::vector<double> out;
  for (const glm::dvec3& p : mesh.positions) {
    const double share = std::min(p.y / 2, 1.0);  // of the leg, from the foot up
    out.insert(out.end(), {p.x + 4 * bend * share * (1 - share), p.y - 2 * share * (1 - length), p.z});
  }
  return out;
}

// A standing leg that the frames shorten bends slowly from one side to the other. Bones keep their lengths, so the
// nearest pose of a frame has a bent knee, and snaps where the leg is straight. Over a clip the body rises instead.
TEST(TransferWritten, AKneeDoesNotSnapWhereTheLegIsStraight) {
  const Model model = one_leg();
  const FlatMesh mesh = flatten(model);
  const RigFit rig(model, mesh);
  std::vector<double> times, foot(mesh.positions.size(), 0.0);
  foot[0] = foot[1] = 1;
  std::vector<std::vector<double>> frames;
  std::vector<RigPose> alone;
  for (int f = 0; f < 30; ++f) {
    times.push_back(f / 30.0);
    frames.push_back(frame_of_leg(mesh, 0.88, 0.5 - f / 29.0));
    alone.push_back(rig.fit(frames.back(), f == 0 ? rig.rest() : alone.back(), foot, {}));
  }
  const auto jerk = [&](const std::vector<RigPose>& poses) {
    std::vector<std::vector<glm::dvec3>> got;
    for (const RigPose& pose : poses) got.push_back(posed_positions(model, mesh, rig.whole(pose)));
    double out = 0;
    for (size_t f = 1; f + 1 < got.size(); ++f)
      for (size_t v = 0; v < got[f].size(); ++v)
        out = std::max(out, glm::length(got[f - 1][v] - 2.0 * got[f][v] + got[f + 1][v]));
    return out;
  };
  const std::vector<RigPose> poses = rig.fit_all(times, frames, [&](size_t) { return foot; });
  double slide = 0;
  for (const RigPose& pose : poses)
    slide = std::max(slide, std::abs(posed_positions(model, mesh, rig.whole(pose))[0].x - mesh.positions[0].x));
  std::printf("a knee jerks by %.3f where frames are alone, by %.3f in a clip; the foot slides by %.4f\n", jerk(alone),
              jerk(poses), slide);
  EXPECT_GT(jerk(alone), 0.3);
  EXPECT_LT(jerk(poses), 0.05);
  EXPECT_LT(slide, 0.005);
}

// What stands still is written as one pose, and a loop closes, however badly the frames are met.
TEST(TransferWritten, HeldFramesAndTheEndsOfALoopHaveOnePose) {
  const Model model = one_leg();
  const FlatMesh mesh = flatten(model);
  const RigFit rig(model, mesh);
  std::vector<double> times;
  std::vector<std::vector<double>> frames;
  for (int f = 0; f <= 40; ++f) {
    const double angle = 2 * 3.14159265358979 * (f <= 10 ? f : f <= 20 ? 10 : f - 10) / 30;
    times.push_back(f / 30.0);
    frames.push_back(frame_of_leg(mesh, 0.9 + 0.08 * std::cos(angle), 0.2 * std::sin(angle)));
  }
  const std::vector<RigPose> poses = rig.fit_all(times, frames, [](size_t) { return std::vector<double>(); });
  ASSERT_EQ(poses.size(), frames.size());
  const auto expect_equal = [&](size_t a, size_t b) {
    for (size_t n = 0; n < 3; ++n) {
      EXPECT_EQ(poses[a].nodes[n].rotation, poses[b].nodes[n].rotation) << a << " " << b;
      EXPECT_EQ(poses[a].nodes[n].translation, poses[b].nodes[n].translation) << a << " " << b;
    }
  };
  for (size_t f = 11; f <= 20; ++f) expect_equal(10, f);
  expect_equal(0, 40);
  EXPECT_NE(poses[10].nodes[2].rotation, poses[21].nodes[2].rotation);
}

// A clip of few keys is made of straight lines. A slow sway must not jerk at their ends: neither of one joint, nor of
// all, whose misses add up.
TEST(TransferWritten, LeftOutKeysDoNotMakeACalmMotionJerk) {
  const Model horse = read_gltf(creature("horse"));
  const FlatMesh mesh = flatten(horse);
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::dvec3& p : mesh.positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const double tolerance = 0.0005 * glm::length(high - low);
  for (const size_t joints : {size_t{1}, horse.skins[0].joints.size()}) {
    Animation sway;
    for (size_t j = 0; j < joints; ++j) {
      Channel turn;
      turn.node = horse.skins[0].joints[j];
      turn.path = Path::rotation;
      turn.width = 4;
      for (int f = 0; f < 120; ++f) {
        const double angle =
            0.1 / std::sqrt(static_cast<double>(joints)) * std::sin(f * 0.05 + 0.7 * static_cast<double>(j));
        turn.times.push_back(static_cast<float>(f / 30.0));
        for (const double x : {0.0, 0.0, std::sin(angle / 2), std::cos(angle / 2)})
          turn.values.push_back(static_cast<float>(x));
      }
      sway.channels.push_back(turn);
    }
    const auto acceleration = [&](const Animation& clip) {
      double sum = 0;
      std::vector<std::vector<glm::dvec3>> frames;
      for (const float time : sway.channels[0].times)
        frames.push_back(posed_positions(horse, mesh, clip, static_cast<double>(time)));
      for (size_t f = 1; f + 1 < frames.size(); ++f)
        for (size_t v = 0; v < frames[f].size(); ++v) {
          const glm::dvec3 bend = frames[f - 1][v] - 2.0 * frames[f][v] + frames[f + 1][v];
          sum += glm::dot(bend, bend);
        }
      return std::sqrt(sum);
    };
    Animation few = sway;
    const double moved = reduce_keys(horse, mesh, few, tolerance);
    std::printf("%zu of %zu keys, %.2f times the acceleration\n", key_count(few), key_count(sway),
                acceleration(few) / acceleration(sway));
    EXPECT_LE(moved, tolerance);
    EXPECT_LT(key_count(few), key_count(sway));
    // of one joint: 2.13 with a bound on places alone, 1.29 while small angles were lost to rounding
    EXPECT_LT(acceleration(few), 1.05 * acceleration(sway)) << joints;
  }
}

// A joint that turns, stands still, and turns back: its keys move within the tolerance, but where it stood it stands.
TEST(TransferWritten, LeftOutKeysDoNotMoveWhatStandsStill) {
  const Model horse = read_gltf(creature("horse"));
  const FlatMesh mesh = flatten(horse);
  Animation clip;
  Channel turn;
  turn.node = horse.skins[0].joints[3];
  turn.path = Path::rotation;
  turn.width = 4;
  for (int f = 0; f < 30; ++f) {
    const double angle = 0.0004 * (f < 12 ? f : f < 20 ? 12 : 32 - f);
    turn.times.push_back(static_cast<float>(f / 30.0));
    for (const double x : {0.0, 0.0, std::sin(angle / 2), std::cos(angle / 2)})
      turn.values.push_back(static_cast<float>(x));
  }
  clip.channels.push_back(turn);
  const auto at = [&](int f) { return posed_positions(horse, mesh, clip, static_cast<double>(turn.times[size_t(f)])); };
  reduce_keys(horse, mesh, clip, 0.01);
  EXPECT_LT(key_count(clip), 8U);
  for (int f = 13; f < 20; ++f) EXPECT_TRUE(at(12) == at(f)) << f;
}

// Trials whose misses add up beyond the bound are not measured to their end, and seemed calm.
TEST(TransferWritten, ACalmIdleStaysCalm) {
  if (!fs::exists(data() / "q_CyberCharacter.glb") || !fs::exists(data() / "q_Man_Casual.glb"))
    GTEST_SKIP() << "no q_CyberCharacter.glb or q_Man_Casual.glb under " << data();
  const fs::path report = folder() / "idle.json";
  std::string said;
  ASSERT_EQ(transfer(quoted(data() / "q_CyberCharacter.glb") + " " + quoted(data() / "q_Man_Casual.glb") +
                         " --clip \"CharacterArmature|Idle_Neutral\" -o " + quoted(folder() / "idle.glb") + " --json " +
                         quoted(report),
                     said),
            0)
      << said;
  // Keys that are left out may add 3 %; without that bound they add more.
  EXPECT_LT(read_json(report)["clips"][0]["faults"]["acceleration"].get<double>(), 1.03);
}

// Computed frames keep their feet on the ground; those of the file sank by .03.
TEST(TransferWritten, FeetOfTheFileDoNotSink) {
  if (!fs::exists(data() / "khr_Fox.glb") || !fs::exists(data() / "CesiumMan.glb"))
    GTEST_SKIP() << "no khr_Fox.glb or CesiumMan.glb under " << data();
  const fs::path report = folder() / "sinks.json";
  std::string said;
  ASSERT_EQ(transfer(quoted(data() / "khr_Fox.glb") + " " + quoted(data() / "CesiumMan.glb") + " --clip Walk -o " +
                         quoted(folder() / "sinks.glb") + " --json " + quoted(report),
                     said),
            0)
      << said;
  EXPECT_LT(read_json(report)["clips"][0]["faults"]["sunk"].get<double>(), 0.01);  // .003; .028 before
}

// Rigid pieces on joints that may shift: the fit of frames in which legs are stretched tore an arm off.
TEST(TransferWritten, ARobotThatRollsDoesNotJumpAndStaysTogether) {
  if (!fs::exists(data() / "q_KnightCharacter.glb") || !fs::exists(data() / "q_CyberCharacter.glb"))
    GTEST_SKIP() << "no q_KnightCharacter.glb or q_CyberCharacter.glb under " << data();
  for (const char* clip : {"HumanArmature|Roll", "HumanArmature|Run"}) {
    const fs::path report = folder() / "rolls.json";
    std::string said;
    ASSERT_EQ(
        transfer(quoted(data() / "q_KnightCharacter.glb") + " " + quoted(data() / "q_CyberCharacter.glb") +
                     " --clip \"" + clip + "\" -o " + quoted(folder() / "rolls.glb") + " --json " + quoted(report),
                 said),
        0)
        << said;
    const json first = read_json(report)["clips"][0]["faults"];
    EXPECT_EQ(first["spikes"], 0) << clip;  // 5 in the roll before steps were taken back
    // .204 in the roll and .096 in the run before links counted
    EXPECT_LT(first["gap"].get<double>(), std::string(clip) == "HumanArmature|Run" ? 0.05 : 0.15) << clip;
  }
}

}  // namespace

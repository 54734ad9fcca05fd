// Sampling of animations and skinning against closed forms and a dense computation by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "gltf/animate.h"
#include "gltf/gltf_write.h"
#include "gltf_support.h"

namespace {

using namespace hf_gltf;

Channel channel_of(Path path, Interpolation interpolation, std::vector<float> times, std::vector<float> values) {
  Channel channel;
  channel.node = 0;
  channel.path = path;
  channel.interpolation = interpolation;
  channel.width = path == Path::rotation ? 4 : path == Path::weights ? 2 : 3;
  channel.times = std::move(times);
  channel.values = std::move(values);
  return channel;
}

void expect_near(const std::vector<double>& found, const std::vector<double>& expected, double tolerance = 1e-12) {
  ASSERT_EQ(found.size(), expected.size());
  for (size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], tolerance) << "component " << i;
}

TEST(Animate, StepHoldsTheKeyBefore) {
  for (const Path path : {Path::translation, Path::scale}) {
    const Channel c = channel_of(path, Interpolation::step, {1, 2, 4}, {1, 2, 3, 4, 5, 6, 7, 8, 9});
    expect_near(sample_channel(c, 0), {1, 2, 3});
    expect_near(sample_channel(c, 1.999), {1, 2, 3});
    expect_near(sample_channel(c, 2), {4, 5, 6});
    expect_near(sample_channel(c, 3.999), {4, 5, 6});
    expect_near(sample_channel(c, 4), {7, 8, 9});
    expect_near(sample_channel(c, 99), {7, 8, 9});
  }
}

TEST(Animate, LinearIsAStraightLineAndHeldOutside) {
  const Channel c = channel_of(Path::translation, Interpolation::linear, {1, 3}, {0, 10, -2, 4, 20, 2});
  expect_near(sample_channel(c, 2), {2, 15, 0});
  expect_near(sample_channel(c, 1.5), {1, 12.5, -1});
  expect_near(sample_channel(c, -5), {0, 10, -2});
  expect_near(sample_channel(c, 5), {4, 20, 2});
  const Channel w = channel_of(Path::weights, Interpolation::linear, {0, 1}, {0, 1, 1, 0});
  expect_near(sample_channel(w, 0.25), {0.25, 0.75});
}

TEST(Animate, LinearRotationTurnsAtConstantSpeedOnTheShorterArc) {
  const float h = std::sqrt(0.5f);
  // from 0 to 90 degrees about z, the second key given with the opposite sign
  for (const float sign : {1.0f, -1.0f}) {
    const Channel c = channel_of(Path::rotation, Interpolation::linear, {0, 1}, {0, 0, 0, 1, 0, 0, sign * h, sign * h});
    for (const double s : {0.0, 0.1, 0.5, 0.9, 1.0}) {
      const auto q = sample_channel(c, s);
      const double angle = s * M_PI / 4;
      const double turn = q[3] < 0 ? -1 : 1;
      expect_near({turn * q[0], turn * q[1], turn * q[2], turn * q[3]}, {0, 0, std::sin(angle), std::cos(angle)}, 1e-7);
    }
  }
}

TEST(Animate, CubicSplineIsTheHermitePolynomial) {
  // keys of p(t) = t^3 - t with its derivatives as tangents: the spline is the cubic itself
  const auto p = [](double t) { return t * t * t - t; };
  const auto d = [](double t) { return 3 * t * t - 1; };
  std::vector<float> times = {0, 2, 3}, values;
  for (const float t : times) {
    for (int part = 0; part < 3; ++part) {
      const auto v = static_cast<float>(part == 1 ? p(t) : d(t));
      values.insert(values.end(), {v, 2 * v, -v});
    }
  }
  for (const Path path : {Path::translation, Path::scale}) {
    const Channel c = channel_of(path, Interpolation::cubic_spline, times, values);
    for (const double t : {0.0, 0.3, 1.0, 1.9, 2.0, 2.5, 3.0}) {
      expect_near(sample_channel(c, t), {p(t), 2 * p(t), -p(t)}, 1e-9);
    }
    expect_near(sample_channel(c, -1), {p(0), 2 * p(0), -p(0)});
    expect_near(sample_channel(c, 7), {p(3), 2 * p(3), -p(3)});
  }
}

TEST(Animate, CubicSplineTangentsAreScaledByTheKeyDistance) {
  // one segment of length 4, values 0, out-tangent 1, in-tangent 0: p(s) = 4 (s^3 - 2 s^2 + s)
  const Channel c =
      channel_of(Path::weights, Interpolation::cubic_spline, {0, 4}, {0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0});
  const double s = 0.25;
  const double expected = 4 * (s * s * s - 2 * s * s + s);
  expect_near(sample_channel(c, 1), {expected, expected});
}

TEST(Animate, CubicSplineRotationsAreNormalised) {
  const float h = std::sqrt(0.5f);
  const Channel c = channel_of(Path::rotation, Interpolation::cubic_spline, {0, 1},
                               {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, h, h, 0, 0, 0, 0});
  const auto q = sample_channel(c, 0.5);
  // tangents 0: the mean of both quaternions, which is 45 degrees
  expect_near(q, {0, 0, std::sin(M_PI / 8), std::cos(M_PI / 8)}, 1e-7);
}

// What a file holds before 0 s, where glTF allows no key, is cut off: the same motion from 0 s on, and a valid file.
TEST(Animate, KeysBeforeZeroGiveWayToOneThere) {
  using samples_test::json;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> number(-1, 1);
  const std::vector<std::vector<float>> all_times = {{-1, -0.25f, 0.5f, 2}, {-1, 0, 2}, {-0.001f, 1}, {-2, -1}};
  for (const std::vector<float>& times : all_times) {
    for (const char* path : {"translation", "rotation", "scale"}) {
      for (const char* mode : {"STEP", "LINEAR", "CUBICSPLINE"}) {
        const bool turn = std::string(path) == "rotation", cubic = std::string(mode) == "CUBICSPLINE";
        const Interpolation how = cubic                         ? Interpolation::cubic_spline
                                  : std::string(mode) == "STEP" ? Interpolation::step
                                                                : Interpolation::linear;
        std::vector<float> values(times.size() * (cubic ? 3 : 1) * (turn ? 4 : 3));
        for (float& value : values) value = number(random);
        Channel whole = channel_of(turn ? Path::rotation : Path::scale, how, times, values);
        const size_t groups = cubic ? 3 : 1;
        for (size_t k = 0; turn && k < times.size(); ++k) {
          float* q = whole.values.data() + 4 * (k * groups + groups / 2);
          const float length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
          for (int c = 0; c < 4; ++c) q[c] /= length;
        }
        samples_test::GlbBuilder b;
        b.document["nodes"] = {{{"name", "a"}}};
        const int input = b.floats(times, "SCALAR"), output = b.floats(whole.values, turn ? "VEC4" : "VEC3");
        b.document["animations"] = {{{"samplers", {{{"input", input}, {"output", output}, {"interpolation", mode}}}},
                                     {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}}};
        const Model model = b.read();
        ASSERT_EQ(model.warnings.size(), 1u);
        EXPECT_NE(model.warnings[0].find("begins at 0 s"), std::string::npos);
        const std::string written = gltf_bytes(model, true);
        const Model again = read_gltf_bytes({written.begin(), written.end()}, "again.glb");
        EXPECT_TRUE(again.warnings.empty());
        const Channel& cut = again.animations.at(0).channels.at(0);
        ASSERT_EQ(cut.times[0], 0.0f);
        for (const double t : {0.0, 1e-4, 0.2, 0.5, 0.7, 1.5, 2.0, 9.0}) {
          // the first part of a normalised cubic keeps its ends and their slopes only
          const bool near =
              turn && cubic && t > 0 && t < static_cast<double>(cut.times[std::min<size_t>(1, cut.times.size() - 1)]);
          if (!near || t < 1e-3) expect_near(sample_channel(cut, t), sample_channel(whole, t), near ? 1e-5 : 2e-6);
        }
      }
    }
  }
}

TEST(Animate, OfKeysAtOneTimeTheLastCounts) {
  const Channel c =
      channel_of(Path::translation, Interpolation::linear, {0, 1, 1, 2}, {0, 0, 0, 1, 1, 1, 5, 5, 5, 6, 6, 6});
  expect_near(sample_channel(c, 1), {5, 5, 5});
  expect_near(sample_channel(c, 0.5), {0.5, 0.5, 0.5});
  expect_near(sample_channel(c, 1.5), {5.5, 5.5, 5.5});
}

TEST(Animate, WorldMatricesAreProductsDownTheHierarchy) {
  Model model;
  model.nodes.resize(3);
  model.nodes[2].children = {0};  // children may come before their parents
  model.nodes[0].parent = 2;
  model.nodes[0].children = {1};
  model.nodes[1].parent = 0;
  model.nodes[2].translation = {1, 2, 3};
  model.nodes[0].rotation = glm::angleAxis(glm::radians(90.0f), glm::vec3(0, 0, 1));
  model.nodes[0].scale = {2, 2, 2};
  model.nodes[1].matrix = glm::mat4(1);
  (*model.nodes[1].matrix)[3] = glm::vec4(1, 0, 0, 1);
  const auto globals = global_matrices(model, rest_pose(model));
  const glm::dvec4 origin = globals[1] * glm::dvec4(0, 0, 0, 1);  // (1,0,0) turned to y, doubled, moved
  EXPECT_NEAR(origin.x, 1, 1e-6);
  EXPECT_NEAR(origin.y, 4, 1e-6);
  EXPECT_NEAR(origin.z, 3, 1e-6);
  model.nodes[2].parent = 1;
  EXPECT_THROW(global_matrices(model, rest_pose(model)), std::runtime_error);
}

// A random model with a chain of joints, 8 influences and two morph targets, posed at a random time, against the plain
// formula written out with inverses and sums over all joints.
TEST(Animate, SkinnedVerticesEqualTheDenseSumOverAllJoints) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> number(-1, 1);
  const auto vec = [&] { return glm::vec3(number(random), number(random), number(random)); };
  const auto quat = [&] {
    return glm::normalize(glm::quat(number(random) + 2, number(random), number(random), number(random)));
  };
  const int joints = 10;
  Model model;
  model.nodes.resize(joints + 1);
  Skin skin;
  for (int j = 0; j < joints; ++j) {
    Node& node = model.nodes[static_cast<size_t>(j)];
    node.parent = j - 1;
    if (j + 1 < joints) node.children = {j + 1};
    node.translation = vec();
    node.rotation = quat();
    node.scale = glm::vec3(1) + 0.3f * vec();
    skin.joints.push_back(j);
    glm::mat4 bind = glm::mat4_cast(quat());
    bind[3] = glm::vec4(vec(), 1);
    skin.inverse_bind.push_back(bind);
  }
  model.skins.push_back(skin);
  Node& body = model.nodes[joints];
  body.mesh = 0;
  body.skin = 0;
  body.translation = {100, 100, 100};  // must not matter
  body.weights = {0.5f, -0.25f};
  Primitive primitive;
  primitive.targets.resize(2);
  for (int v = 0; v < 30; ++v) {
    primitive.positions.push_back(vec());
    Influences o;
    float sum = 0;
    for (size_t k = 0; k < 8; ++k) {
      o.joints[k] = static_cast<uint16_t>((v + static_cast<int>(k)) % joints);
      o.weights[k] = number(random) + 1.01f;
      sum += o.weights[k];
    }
    for (float& w : o.weights) w /= sum;
    primitive.influences.push_back(o);
    for (auto& target : primitive.targets) target.positions.push_back(vec());
    primitive.indices.push_back(static_cast<uint32_t>(v));
  }
  model.meshes.resize(1);
  model.meshes[0].primitives.push_back(primitive);
  Animation animation;
  animation.channels.push_back(channel_of(Path::rotation, Interpolation::step, {0}, {0, 0, 1, 0}));
  animation.channels.back().node = 3;
  animation.channels.push_back(channel_of(Path::weights, Interpolation::linear, {0, 2}, {0, 0, 2, 4}));
  animation.channels.back().node = joints;

  const FlatMesh mesh = flatten(model);
  const auto posed = posed_positions(model, mesh, animation, 1);
  // by hand: local matrices, their products, sums
  std::vector<glm::dmat4> world(joints);
  for (int j = 0; j < joints; ++j) {
    const Node& node = model.nodes[static_cast<size_t>(j)];
    const glm::dquat q = j == 3 ? glm::dquat(0, 0, 0, 1) : glm::dquat(node.rotation);
    glm::dmat4 t(1), s(1);
    t[3] = glm::dvec4(glm::dvec3(node.translation), 1);
    for (int c = 0; c < 3; ++c) s[c][c] = static_cast<double>(node.scale[c]);
    const glm::dmat4 local = t * glm::mat4_cast(glm::normalize(q)) * s;
    world[static_cast<size_t>(j)] = j == 0 ? local : world[static_cast<size_t>(j - 1)] * local;
  }
  for (size_t v = 0; v < posed.size(); ++v) {
    const glm::dvec3 p = glm::dvec3(primitive.positions[v]) + 1.0 * glm::dvec3(primitive.targets[0].positions[v]) +
                         2.0 * glm::dvec3(primitive.targets[1].positions[v]);
    glm::dvec3 sum(0);
    double total = 0;
    for (size_t j = 0; j < static_cast<size_t>(joints); ++j) {
      double weight = 0;
      for (size_t k = 0; k < 8; ++k) {
        if (primitive.influences[v].joints[k] == j) weight += static_cast<double>(primitive.influences[v].weights[k]);
      }
      sum += weight * glm::dvec3(world[j] * (glm::dmat4(skin.inverse_bind[j]) * glm::dvec4(p, 1)));
      total += weight;
    }
    EXPECT_LT(glm::distance(posed[v], sum / total), 1e-12 * 100) << v;
  }
}

TEST(Animate, ClipTimesListKeysAndFrames) {
  Animation animation;
  animation.channels.push_back(channel_of(Path::translation, Interpolation::linear, {0, 1}, std::vector<float>(6, 0)));
  animation.channels.push_back(channel_of(Path::scale, Interpolation::linear, {0.5f, 1}, std::vector<float>(6, 0)));
  EXPECT_EQ(clip_duration(animation), 1);
  EXPECT_EQ(key_times(animation), (std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(frame_times(animation, 4), (std::vector<double>{0, 0.25, 0.5, 0.75, 1}));
  EXPECT_EQ(frame_times(Animation(), 30), (std::vector<double>{0}));
}

}  // namespace

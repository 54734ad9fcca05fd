// Mirrored weights: bones paired by names and by places, the plane found, meshes whose vertices do not mirror.
#include "weights/mirror.h"

#include <cstring>

#include "base/error.h"
#include "carry_support.h"

namespace {

using namespace hf_test;
using namespace hf_inner;
using namespace hf_inner::weights;

std::vector<Index> partners(const std::string& names, std::size_t count) {
  Memory memory;
  const Vector<Index> found = pair_names({names.data(), names.size()}, count, memory);
  return {found.begin(), found.end()};
}

TEST(PairedNames, ASideIsAWordOfItsOwn) {
  const char* const pairs[][2] = {{"arm.L", "arm.R"},
                                  {"arm_l", "arm_r"},
                                  {"L_arm", "R_arm"},
                                  {"LeftArm", "RightArm"},
                                  {"mixamorig:LeftUpLeg", "mixamorig:RightUpLeg"},
                                  {"armL", "armR"},
                                  {"LArm", "RArm"},
                                  {"thumb.01.L", "thumb.01.R"},
                                  {"upperleftarm", "upperrightarm"},
                                  {"ARM-LEFT", "ARM-RIGHT"},
                                  {"arm l", "arm r"},
                                  {"b_LeftLeg01_015", "b_RightLeg01_019"},
                                  {"Bone.L.001", "Bone.R.001"},
                                  {"hand_L1", "hand_R1"}};
  for (const auto& pair : pairs) {
    const std::string names = std::string(pair[1]) + "\nspine\n" + pair[0] + "\n";
    EXPECT_EQ(partners(names, 3), (std::vector<Index>{2, -1, 0})) << pair[0];
  }
  // Letters of a word are no side, and a name with two partners has none.
  EXPECT_EQ(partners("tail\ntair\nlimb\nrimb\n", 4), (std::vector<Index>{-1, -1, -1, -1}));
  EXPECT_EQ(partners("a.L\na.R\nA.L\n", 3), (std::vector<Index>{-1, -1, -1}));
  EXPECT_EQ(partners("", 2), (std::vector<Index>{-1, -1}));
  EXPECT_EQ(partners("arm.L\r\narm.R", 2), (std::vector<Index>{1, 0}));
}

// The weights of a creature, with the bones in the frame of its mesh.
struct Scene {
  Scene(const std::string& name, double turn = 0, const Point& shift = {0, 0, 0}) : body(make_body(name, 1200)) {
    const auto place = [&](double* p) {
      const double x = p[0], z = p[2];
      p[0] = std::cos(turn) * x + std::sin(turn) * z + shift[0];
      p[2] = std::cos(turn) * z - std::sin(turn) * x + shift[2];
      p[1] += shift[1];
    };
    for (std::size_t i = 0; i < body.mesh.positions.size(); i += 3) place(body.mesh.positions.data() + i);
    for (Point& head : body.heads) place(head.data());
    core = make_core(body.mesh);
    skin = make_owner_in<SkinSurface>(core->memory, core);
    for (const samples::Joint& joint : body.creature.skeleton) names += joint.name + "\n";
  }
  MirroredWeights mirror(MirrorTo to, bool by_names, const GivenWeights& given) const {
    MirrorBones bones(*core->memory);
    for (const Point& head : body.heads) bones.heads.push_back(core->mesh.to_inner({head[0], head[1], head[2]}));
    const std::size_t count = body.heads.size();
    bones.partner =
        pair_names(by_names ? Span<const char>{names.data(), names.size()} : Span<const char>{}, count, *core->memory);
    bones.given.assign(count, 0);
    MirrorOptions options;
    options.to = to;
    options.carry = carry_options();
    return mirror_weights(*skin, given, bones, options);
  }
  // The mean share of vertices that other joints move than in the generator's weights.
  double off(const FilledWeights& found) const {
    double sum = 0;
    for (Index v = 0; v < core->size(); ++v) {
      const std::size_t given = at(core->mesh.given_of_inner[at(v)]);
      double same = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        const double w = static_cast<double>(body.weights[4 * given + k]);
        if (w > 0) same += std::min(w, share_of(found, at(v), body.joints[4 * given + k]));
      }
      sum += 1 - same;
    }
    return sum / core->size();
  }
  Body body;
  std::shared_ptr<const surface::Core> core;
  std::shared_ptr<const SkinSurface> skin;
  std::string names;
};

TEST(MirroredWeights, OneSideGivesTheOther) {
  for (const char* name : {"biped", "horse"}) {
    const Scene scene(name);
    for (const bool by_names : {true, false}) {
      for (const MirrorTo to : {MirrorTo::negative, MirrorTo::positive, MirrorTo::both}) {
        const MirroredWeights found = scene.mirror(to, by_names, scene.body.given());
        EXPECT_EQ(faults_of(found.filled, at(scene.core->size()), scene.body.heads.size()), 0u);
        EXPECT_EQ(found.plane.from, by_names ? mesh::PlaneFrom::bones : mesh::PlaneFrom::surface);
        EXPECT_NEAR(std::fabs(found.plane.normal.x), 1, 1e-4);
        for (std::size_t b = 0; b < scene.body.heads.size(); ++b) {
          const std::string& joint = scene.body.creature.skeleton[b].name;
          const std::size_t partner = at(found.pairs.partner[b]);
          std::string other = joint;
          if (joint.size() > 2 && joint[joint.size() - 2] == '_' && (joint.back() == 'L' || joint.back() == 'R'))
            other.back() = joint.back() == 'L' ? 'R' : 'L';
          EXPECT_EQ(scene.body.creature.skeleton[partner].name, other);
          EXPECT_LT(found.pairs.off[b], 0.01);
        }
        EXPECT_LT(scene.off(found.filled), 0.03) << name << " to " << static_cast<int>(to);
        EXPECT_LT(found.mean_off, 0.005);
      }
    }
  }
}

// The side that takes has no weights at all, and the frame is turned and far from the origin.
TEST(MirroredWeights, TheOtherSideNeedsNoWeightsAndTheFrameIsAny) {
  const Scene scene("biped", 0.7, {5, -3, 8});
  std::vector<float> half = scene.body.weights;
  for (std::size_t v = 0; v < scene.body.mesh.vertex_count(); ++v) {
    const double x = static_cast<double>(std::cos(0.7)) * (scene.body.mesh.positions[3 * v] - 5) -
                     std::sin(0.7) * (scene.body.mesh.positions[3 * v + 2] - 8);
    for (std::size_t k = 0; x < -1e-4 && k < 4; ++k) half[4 * v + k] = 0;
  }
  for (const bool by_names : {true, false}) {
    const MirroredWeights found =
        scene.mirror(MirrorTo::negative, by_names, {4, scene.body.joints.data(), half.data()});
    EXPECT_EQ(faults_of(found.filled, at(scene.core->size()), scene.body.heads.size()), 0u);
    EXPECT_NEAR(found.plane.normal.x, std::cos(0.7), 2e-3);
    EXPECT_LT(scene.off(found.filled), 0.02);
    EXPECT_GT(found.filled.by_origin[static_cast<std::size_t>(Origin::kept)], 400u);
  }
}

// What stands on one side alone: the side that gives keeps its own, the side that takes is filled in or guessed.
TEST(MirroredWeights, WhatHasNoCounterpartGetsWeights) {
  Scene scene("biped");
  PlainMesh mesh = scene.body.mesh;
  append(mesh, around_line({-0.6, 2.5, 0}, {-0.9, 2.5, 0}, 0.1, 0.1, 9, 6), 0);
  append(mesh, around_line({0.6, 2.5, 0.4}, {0.9, 2.5, 0.4}, 0.1, 0.1, 9, 6), 0);
  std::vector<std::uint32_t> joints = scene.body.joints;
  std::vector<float> weights = scene.body.weights;
  joints.resize(4 * mesh.vertex_count(), 0);
  weights.resize(4 * mesh.vertex_count(), 0.0f);
  scene.body.mesh = mesh;
  scene.core = make_core(mesh);
  scene.skin = make_owner_in<SkinSurface>(scene.core->memory, scene.core);
  const MirroredWeights found = scene.mirror(MirrorTo::negative, true, {4, joints.data(), weights.data()});
  EXPECT_EQ(faults_of(found.filled, at(scene.core->size()), scene.body.heads.size()), 0u);
  EXPECT_EQ(found.filled.pieces_guessed, 2u);
  EXPECT_GT(found.worst_off, 0.05);
  std::fill(weights.begin(), weights.end(), 0.0f);
  EXPECT_THROW(scene.mirror(MirrorTo::negative, true, {4, joints.data(), weights.data()}), Error);
}

// Weights of the tube's two halves differ; the mean of both sides is the same on both.
TEST(MirroredWeights, BothSidesTakeTheMean) {
  const PlainMesh mesh = around_line({-2, 0, 0}, {2, 0, 0}, 1, 1, 16, 17);
  const auto core = make_core(mesh);
  const auto skin = make_owner_in<SkinSurface>(core->memory, core);
  std::vector<std::uint32_t> joints;
  std::vector<float> weights;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const float x = static_cast<float>(mesh.positions[3 * v] / 4 + 0.5);
    joints.insert(joints.end(), {0, 1});
    weights.insert(weights.end(), {1 - x * x, x * x});
  }
  MirrorBones bones(*core->memory);
  bones.heads.push_back(core->mesh.to_inner({-1, 0, 0}));
  bones.heads.push_back(core->mesh.to_inner({1, 0, 0}));
  bones.partner.assign(2, -1);
  bones.given.assign(2, 0);
  MirrorOptions options;
  options.to = MirrorTo::both;
  options.carry = carry_options();
  options.has_plane = true;
  const MirroredWeights found = mirror_weights(*skin, {2, joints.data(), weights.data()}, bones, options);
  EXPECT_EQ(found.pairs.by[0], PairedBy::place);
  for (Index v = 0; v < core->size(); ++v) {
    const double x = mesh.positions[3 * at(core->mesh.given_of_inner[at(v)])] / 4 + 0.5;
    EXPECT_NEAR(share_of(found.filled, at(v), 1), 0.5 * (x * x + 1 - (1 - x) * (1 - x)), 1e-6);
  }
}

}  // namespace

// The generated creatures: one closed skin with seams, sound weights, clips that loop and feet that stay where they
// stand.
#include "assets/creature.h"

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "mesh_checks.h"
#include "support/creature.h"
#include "support/full.h"

namespace {

using mesh_checks::examine;
using mesh_checks::Report;
using samples::Creature;

// Creatures are made once per size; tests share them.
const Creature& creature(const std::string& name, uint32_t vertices) {
  static std::map<std::pair<std::string, uint32_t>, Creature> made;
  const auto key = std::make_pair(name, vertices);
  auto found = made.find(key);
  if (found == made.end()) found = made.emplace(key, samples::make_creature(name, vertices)).first;
  return found->second;
}

class CreatureSize : public testing::TestWithParam<std::tuple<std::string, uint32_t>> {
 protected:
  const std::string name = std::get<0>(GetParam());
  const uint32_t wanted = std::get<1>(GetParam());
  const Creature& it() const { return creature(name, wanted); }
};

TEST_P(CreatureSize, TheWeldedSkinIsOneClosedManifoldOfGenusZero) {
  uint32_t welded_count = 0;
  const std::vector<uint32_t> welded = mesh_checks::weld(it().positions, welded_count);
  std::vector<double> positions(3 * size_t(welded_count));
  std::vector<uint32_t> triangles;
  for (size_t v = 0; v < welded.size(); ++v) {
    for (size_t k = 0; k < 3; ++k) positions[3 * size_t(welded[v]) + k] = double(it().positions[3 * v + k]);
  }
  for (uint32_t v : it().triangles) triangles.push_back(welded[v]);
  const Report report = examine(positions, triangles);
  EXPECT_TRUE(report.manifold);
  EXPECT_EQ(report.borders, 0u);
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.euler(), 2);
  EXPECT_GT(report.volume, 0);
  EXPECT_EQ(welded_count, it().surface_vertex_count);
  // the map the creature carries says the same as welding by position
  std::vector<uint32_t> name(welded_count, 0xFFFFFFFFu);
  for (size_t v = 0; v < welded.size(); ++v) {
    uint32_t& known = name[welded[v]];
    if (known == 0xFFFFFFFFu) known = it().surface_vertex[v];
    ASSERT_EQ(known, it().surface_vertex[v]);
  }
}

TEST_P(CreatureSize, TheVertexCountIsReachedWithinThreePerCent) {
  EXPECT_NEAR(double(it().surface_vertex_count), double(wanted), 0.03 * wanted);
}

TEST_P(CreatureSize, TheSkinFallsApartAlongSeamsAsStored) {
  std::vector<double> positions(it().positions.begin(), it().positions.end());
  const Report report = examine(positions, it().triangles);
  EXPECT_TRUE(report.manifold);
  EXPECT_GE(report.components, 10u);
  EXPECT_EQ(report.components, it().chart_count);
  EXPECT_GT(report.borders, 0u);
  EXPECT_GT(it().vertex_count(), it().surface_vertex_count);
}

TEST_P(CreatureSize, TrianglesAreWellShaped) {
  const samples::ShapeMesh surface = samples::welded_surface(it());
  const Report report = examine(surface.positions, surface.triangles);
  RecordProperty("mean_min_angle", std::to_string(report.mean_min_angle));
  RecordProperty("percentile_1_min_angle", std::to_string(report.percentile_1));
  RecordProperty("smallest_angle", std::to_string(report.smallest_angle));
  EXPECT_GT(report.mean_min_angle, 35);
  EXPECT_GT(report.percentile_1, 12);
  EXPECT_GT(report.smallest_angle, 0.5);  // slivers sit in finger webs and ear roots only
}

TEST_P(CreatureSize, WeightsAreAPartitionOfUnityOverAtMostFourJoints) {
  ASSERT_EQ(it().weights.size(), it().vertex_count());
  ASSERT_EQ(it().joints.size(), it().vertex_count());
  std::vector<double> load(it().skeleton.size(), 0.0);
  for (size_t v = 0; v < it().weights.size(); ++v) {
    double sum = 0;
    for (size_t k = 0; k < 4; ++k) {
      ASSERT_GE(it().weights[v][k], 0);
      ASSERT_LT(it().joints[v][k], it().skeleton.size());
      sum += double(it().weights[v][k]);
      load[it().joints[v][k]] += double(it().weights[v][k]);
    }
    ASSERT_NEAR(sum, 1, 1e-6);
  }
  // every joint but the root moves some skin
  for (size_t j = 1; j < load.size(); ++j) EXPECT_GT(load[j], 0) << it().skeleton[j].name;
}

TEST_P(CreatureSize, CopiesAlongSeamsAgreeInEverythingButTheirTexcoords) {
  std::vector<int64_t> first(it().surface_vertex_count, -1);
  for (size_t v = 0; v < it().surface_vertex.size(); ++v) {
    int64_t& known = first[it().surface_vertex[v]];
    if (known < 0) {
      known = int64_t(v);
      continue;
    }
    for (size_t k = 0; k < 3; ++k) {
      ASSERT_EQ(it().positions[3 * v + k], it().positions[3 * size_t(known) + k]);
      ASSERT_EQ(it().normals[3 * v + k], it().normals[3 * size_t(known) + k]);
    }
    ASSERT_EQ(it().joints[v], it().joints[size_t(known)]);
    ASSERT_EQ(it().weights[v], it().weights[size_t(known)]);
  }
  for (int64_t v : first) ASSERT_GE(v, 0);
}

TEST_P(CreatureSize, TexcoordsFillTheUnitSquareWithFewTurnedTriangles) {
  size_t turned = 0;
  for (float x : it().texcoords) {
    ASSERT_GE(x, 0);
    ASSERT_LE(x, 1);
  }
  for (size_t t = 0; t < it().triangles.size(); t += 3) {
    double u[3], v[3];
    for (size_t k = 0; k < 3; ++k) {
      u[k] = double(it().texcoords[2 * size_t(it().triangles[t + k])]);
      v[k] = 1 - double(it().texcoords[2 * size_t(it().triangles[t + k]) + 1]);
    }
    turned += (u[1] - u[0]) * (v[2] - v[0]) - (u[2] - u[0]) * (v[1] - v[0]) <= 0;
  }
  RecordProperty("turned_in_texture", std::to_string(turned));
  EXPECT_LT(double(turned), (wanted < 5000 ? 0.08 : 0.04) * double(it().triangles.size() / 3));
}

TEST_P(CreatureSize, NormalsAreUnitAndPointOutwards) {
  size_t against = 0;
  for (size_t t = 0; t < it().triangles.size(); t += 3) {
    double p[3][3], n[3] = {0, 0, 0};
    for (size_t k = 0; k < 3; ++k) {
      double length = 0;
      for (size_t i = 0; i < 3; ++i) {
        const size_t at = 3 * size_t(it().triangles[t + k]) + i;
        p[k][i] = double(it().positions[at]);
        n[i] += double(it().normals[at]);
        length += double(it().normals[at]) * double(it().normals[at]);
      }
      ASSERT_NEAR(length, 1, 1e-5);
    }
    double face = 0;
    for (size_t i = 0; i < 3; ++i) {
      const size_t j = (i + 1) % 3, l = (i + 2) % 3;
      face += n[i] * ((p[1][j] - p[0][j]) * (p[2][l] - p[0][l]) - (p[1][l] - p[0][l]) * (p[2][j] - p[0][j]));
    }
    against += face <= 0;
  }
  EXPECT_LE(double(against),
            wanted < 5000 ? 0.02 * double(it().triangles.size() / 3) : 0.0005 * double(it().triangles.size() / 3));
}

TEST_P(CreatureSize, TheSkinnedRestPoseIsTheRestPose) {
  const std::vector<double> posed = samples::skin_positions(it(), samples::rest_pose(it()));
  for (size_t i = 0; i < posed.size(); ++i) ASSERT_NEAR(posed[i], double(it().positions[i]), 1e-6);
}

TEST_P(CreatureSize, ItStandsOnTheGroundAndLooksAlongZ) {
  float lowest = 1e9f, highest = -1e9f;
  for (size_t i = 1; i < it().positions.size(); i += 3) {
    lowest = std::min(lowest, it().positions[i]);
    highest = std::max(highest, it().positions[i]);
  }
  EXPECT_NEAR(lowest, 0, 2e-3);
  EXPECT_GT(highest, 1.2f);
  // the head is in front of the hips and left is +x
  const std::vector<double> world = samples::rest_pose(it());
  const auto z = [&](const char* joint) { return world[16 * size_t(samples::find_joint(it(), joint)) + 14]; };
  EXPECT_GT(z("head"), z("hips"));
  for (size_t j = 0; j < it().skeleton.size(); ++j) {
    const std::string& joint = it().skeleton[j].name;
    if (joint.size() < 2 || joint.compare(joint.size() - 2, 2, "_L") != 0) continue;
    const size_t other = samples::find_joint(it(), joint.substr(0, joint.size() - 2) + "_R");
    EXPECT_GT(world[16 * j + 12], 0) << joint;
    EXPECT_NEAR(world[16 * j + 12], -world[16 * other + 12], 1e-9) << joint;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Sizes, CreatureSize,
    testing::Combine(testing::Values("horse", "bull", "biped"),
                     testing::ValuesIn(hf_test::is_full() ? std::vector<uint32_t>{1000, 10000, 100000}
                                                          : std::vector<uint32_t>{1000, 4000})),
    [](const auto& info) { return std::get<0>(info.param) + "_" + std::to_string(std::get<1>(info.param)); });

class EachCreature : public testing::TestWithParam<std::string> {
 protected:
  const Creature& it() const { return creature(GetParam(), 10000); }
};

TEST_P(EachCreature, IsTheSameToTheBitWhenMadeAgain) {
  EXPECT_EQ(samples::creature_hash(it()), samples::creature_hash(samples::make_creature(GetParam(), 10000)));
  EXPECT_NE(samples::creature_hash(it()), samples::creature_hash(creature(GetParam(), 1000)));
}

TEST_P(EachCreature, ParentsStandBeforeChildrenAndNamesDiffer) {
  std::set<std::string> names;
  EXPECT_EQ(it().skeleton[0].parent, -1);
  for (size_t j = 0; j < it().skeleton.size(); ++j) {
    EXPECT_LT(it().skeleton[j].parent, int32_t(j));
    EXPECT_TRUE(j == 0 || it().skeleton[j].parent >= 0);
    EXPECT_TRUE(names.insert(it().skeleton[j].name).second);
  }
}

TEST_P(EachCreature, ClipsLoopWithIncreasingTimesAndUnitRotations) {
  ASSERT_GE(it().clips.size(), 2u);
  for (const samples::Clip& clip : it().clips) {
    SCOPED_TRACE(clip.name);
    ASSERT_GE(clip.times.size(), 2u);
    EXPECT_EQ(clip.times[0], 0);
    for (size_t i = 1; i < clip.times.size(); ++i) ASSERT_GT(clip.times[i], clip.times[i - 1]);
    size_t moving = 0;
    for (const samples::JointKeys& keys : clip.joints) {
      moving += !keys.rotations.empty();
      ASSERT_TRUE(keys.rotations.empty() || keys.rotations.size() == 4 * clip.times.size());
      ASSERT_TRUE(keys.translations.empty() || keys.translations.size() == 3 * clip.times.size());
      for (size_t i = 0; i < keys.rotations.size(); i += 4) {
        double length = 0;
        for (size_t k = 0; k < 4; ++k) length += double(keys.rotations[i + k]) * double(keys.rotations[i + k]);
        ASSERT_NEAR(length, 1, 1e-5);
      }
      const size_t last = clip.times.size() - 1;
      for (size_t k = 0; k < 4 && !keys.rotations.empty(); ++k) {
        ASSERT_EQ(keys.rotations[k], keys.rotations[4 * last + k]);
      }
      for (size_t k = 0; k < 3 && !keys.translations.empty(); ++k) {
        ASSERT_EQ(keys.translations[k], keys.translations[3 * last + k]);
      }
    }
    EXPECT_GT(moving, 15u);
  }
}

TEST_P(EachCreature, ClipsMoveSmoothly) {
  // no joint turns faster than a limb can: a jump is a sign of a broken solution of the leg
  for (const samples::Clip& clip : it().clips) {
    for (size_t j = 0; j < clip.joints.size(); ++j) {
      const std::vector<float>& r = clip.joints[j].rotations;
      for (size_t i = 4; i < r.size(); i += 4) {
        double dot = 0;
        for (size_t k = 0; k < 4; ++k) dot += double(r[i + k]) * double(r[i - 4 + k]);
        const double angle = 2 * std::acos(std::min(1.0, dot));
        const double rate = angle / (double(clip.times[i / 4]) - double(clip.times[i / 4 - 1]));
        ASSERT_LT(rate, 22.0) << clip.name << " " << it().skeleton[j].name << " key " << i / 4;
      }
    }
  }
}

// Vertices that touch the ground in two consecutive frames must move with the ground.
TEST_P(EachCreature, PlantedFeetDoNotSlide) {
  for (const samples::Clip& clip : it().clips) {
    SCOPED_TRACE(clip.name);
    const int frames = 60;
    const double step = clip.duration() / frames;
    std::vector<double> slides;
    double deepest = 0;
    std::vector<double> before = samples::skin_positions(it(), samples::clip_pose(it(), clip, 0));
    for (int f = 1; f <= frames; ++f) {
      const std::vector<double> now = samples::skin_positions(it(), samples::clip_pose(it(), clip, f * step));
      size_t contacts = 0;
      for (size_t v = 0; v < now.size(); v += 3) {
        deepest = std::min(deepest, now[v + 1]);
        if (it().positions[v + 1] > 0.004f || now[v + 1] > 0.002 || before[v + 1] > 0.002) continue;
        ++contacts;
        slides.push_back(std::hypot(now[v] - before[v], now[v + 2] - before[v + 2] + clip.speed * step) / step);
      }
      EXPECT_GT(contacts, 0u) << "frame " << f << " has no foot on the ground";
      before = now;
    }
    std::sort(slides.begin(), slides.end());
    ASSERT_FALSE(slides.empty());
    // metres per second relative to the ground
    const double median = slides[slides.size() / 2], high = slides[slides.size() * 95 / 100];
    RecordProperty(clip.name + "_slide_median", std::to_string(median));
    RecordProperty(clip.name + "_slide_95", std::to_string(high));
    EXPECT_LT(median, 0.02);
    EXPECT_LT(high, 0.15);
    EXPECT_GT(deepest, -0.03) << "a foot sinks into the ground";
  }
}

TEST_P(EachCreature, TheWalkMovesAtAWalkingSpeedAndTheIdleStands) {
  const samples::Clip& walk = it().clips[samples::find_clip(it(), "walk")];
  EXPECT_GT(walk.speed, 0.6);
  EXPECT_LT(walk.speed, 2.0);
  EXPECT_EQ(it().clips[samples::find_clip(it(), "idle")].speed, 0);
}

INSTANTIATE_TEST_SUITE_P(All, EachCreature, testing::Values("horse", "bull", "biped"),
                         [](const auto& info) { return info.param; });

TEST(Creature, TheTwoQuadrupedsAreOfDifferentBuild) {
  const auto ratio = [](const char* name) {
    const Creature& it = creature(name, 1000);
    const std::vector<double> world = samples::rest_pose(it);
    const auto y = [&](const char* joint) { return world[16 * size_t(samples::find_joint(it, joint)) + 13]; };
    // leg length over head height
    return y("front_lower_leg_L") / y("head");
  };
  const Creature& horse = creature("horse", 1000);
  const Creature& bull = creature("bull", 1000);
  EXPECT_LT(ratio("horse"), ratio("bull"));  // the bull carries its head low
  const auto leg = [](const Creature& it) {
    return samples::rest_pose(it)[16 * size_t(samples::find_joint(it, "front_lower_leg_L")) + 13];
  };
  EXPECT_GT(leg(horse), 1.25 * leg(bull));
}

TEST(Creature, BadRequestsAreRefusedByName) {
  EXPECT_THROW(samples::make_creature("unicorn", 1000), std::runtime_error);
  EXPECT_THROW(samples::make_creature("horse", 10), std::runtime_error);
  EXPECT_THROW(samples::make_creature("horse", 3000000), std::runtime_error);
  EXPECT_THROW(samples::find_clip(creature("horse", 1000), "gallop"), std::runtime_error);
  EXPECT_THROW(samples::find_joint(creature("horse", 1000), "wing"), std::runtime_error);
  EXPECT_THROW(samples::skin_positions(creature("horse", 1000), {1, 2, 3}), std::runtime_error);
  try {
    samples::make_creature("unicorn", 1000);
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("unicorn"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("horse"), std::string::npos);
  }
}

TEST(KeptCreature, HasTheBitsOfTheOneThatWasMade) {
  const Creature &made = creature("horse", 1000), kept = hf_test::read_back(made);
  EXPECT_EQ(samples::creature_hash(kept), samples::creature_hash(made));
  EXPECT_EQ(kept.name, made.name);
  EXPECT_EQ(kept.chart_count, made.chart_count);
  EXPECT_EQ(kept.surface_vertex_count, made.surface_vertex_count);
  EXPECT_EQ(kept.base_color, made.base_color);
  for (size_t j = 0; j < made.skeleton.size(); ++j) EXPECT_EQ(kept.skeleton.at(j).parent, made.skeleton[j].parent);
  for (size_t i = 0; i < made.clips.size(); ++i) {
    EXPECT_EQ(kept.clips.at(i).name, made.clips[i].name);
    EXPECT_EQ(kept.clips[i].speed, made.clips[i].speed);
  }
}

}  // namespace

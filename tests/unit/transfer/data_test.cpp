// Real animals, when the shared data is there: the bars of the self-transfer, and that of feet across species.
#include <gtest/gtest.h>

#include "peers/paper_transfer.h"
#include "unit/transfer/transfer_support.h"

namespace {

using namespace transfer_test;
using hf_inner::Vec3;

bool have(const std::string& name) { return std::filesystem::exists(data_folder() / "gltf" / name); }
Body load(const std::string& name, const World& world) {
  return Body(hf_gltf::read_gltf(data_folder() / "gltf" / name), world);
}

struct Figures {
  double mean = 0, worst = 0, idle = 0;
};

// Six frames of every clip, q_Horse on itself.
Figures self_transfer(bool paper, bool anchored) {
  const World world;
  const Body horse = load("q_Horse.glb", world);
  Pairs pairs = find_pairs("q_horse_to_q_wolf.json", horse, horse, true);
  for (uint32_t& flags : pairs.flags)
    flags = anchored ? flags | HF_PAIR_ANCHOR : flags & ~uint32_t{HF_PAIR_ANCHOR | HF_PAIR_FOOT};
  hf_inner::transfer::TransferOptions options;
  if (paper) options.scheme = hf_inner::peers::paper_clusters();
  options.scale = 1;
  hf_inner::transfer::Transfer transfer(horse.core, horse.core, options);
  add(transfer, pairs.inputs());
  Figures out;
  int frames = 0;
  for (const hf_gltf::Animation& clip : horse.model.animations) {
    for (int k = 0; k < 6; ++k, ++frames) {
      const std::vector<Vec3> posed = horse.posed(clip, hf_gltf::clip_duration(clip) * k / 5);
      const double error = rms(*horse.core, frame_of(transfer, posed), posed, !anchored);
      out.mean += error;
      out.worst = std::max(out.worst, error);
      if (clip.name == "AnimalArmature|Idle") out.idle = std::max(out.idle, error);
    }
  }
  out.mean /= frames;
  return out;
}

TEST(TransferData, TheHorseOnItselfStaysWithinTheBars) {
  if (!have("q_Horse.glb")) GTEST_SKIP() << "no q_Horse.glb under " << data_folder();
  const Figures anchored = self_transfer(false, true), free_standing = self_transfer(false, false);
  const Figures paper = self_transfer(true, true), paper_free = self_transfer(true, false);
  std::printf("self-transfer of q_Horse, rms / box     mean   worst   idle\n");
  const auto line = [](const char* name, const Figures& f) {
    std::printf("  %-34s %.4f  %.4f  %.4f\n", name, f.mean, f.worst, f.idle);
  };
  line("fields, anchored (bar .004 .012 .001)", anchored);
  line("fields, free (bar .004)", free_standing);
  line("paper, anchored", paper);
  line("paper, free", paper_free);
  EXPECT_LT(anchored.mean, 0.004);
  EXPECT_LT(anchored.worst, 0.012);
  EXPECT_LT(anchored.idle, 0.001);
  EXPECT_LT(free_standing.mean, 0.004);
  EXPECT_LT(anchored.mean, paper.mean);
}

// Feet and stretch over four clips, feet in boxes.
struct CrossFigures {
  double mean = 0, largest = 0, stretch = 0, scale = 0;
};

CrossFigures cross(const Body& horse, const Body& other, const Pairs& pairs, bool paper) {
  hf_inner::transfer::TransferOptions options;
  if (paper) options.scheme = hf_inner::peers::paper_clusters();
  hf_inner::transfer::Transfer transfer(horse.core, other.core, options);
  add(transfer, pairs.inputs());
  const std::vector<Vec3> horse_rest = horse.rest(), rest = other.rest();
  CrossFigures out;
  out.scale = transfer.scale();
  int count = 0;
  for (const char* name : {"Gallop", "Walk", "Eating", "Idle"}) {
    const hf_gltf::Animation& clip = horse.model.animations[static_cast<size_t>(
        hf_gltf::find_animation(horse.model, std::string("AnimalArmature|") + name))];
    for (int f = 0; f < 12; ++f) {
      const std::vector<Vec3> posed = horse.posed(clip, hf_gltf::clip_duration(clip) * f / 12),
                              frame = frame_of(transfer, posed);
      for (size_t p = 0; p < pairs.names.size(); ++p) {
        if (!(pairs.flags[p] & HF_PAIR_FOOT)) continue;
        const Vec3 path = out.scale * (centre_of(pairs.source[p], posed) - centre_of(pairs.source[p], horse_rest));
        const double miss =
            hf_inner::norm(centre_of(pairs.target[p], frame) - centre_of(pairs.target[p], rest) - path) /
            other.core->mesh.scale;
        out.mean += miss;
        out.largest = std::max(out.largest, miss);
        ++count;
      }
      std::vector<double> stretch;
      for (int32_t e = 0; e < other.core->topology().edge_count(); ++e) {
        const auto i = static_cast<size_t>(other.core->topology().first(e)),
                   j = static_cast<size_t>(other.core->topology().second(e));
        stretch.push_back(std::abs(hf_inner::norm(frame[i] - frame[j]) / hf_inner::norm(rest[i] - rest[j]) - 1));
      }
      std::nth_element(stretch.begin(), stretch.begin() + static_cast<std::ptrdiff_t>(stretch.size() * 95 / 100),
                       stretch.end());
      out.stretch = std::max(out.stretch, stretch[stretch.size() * 95 / 100]);
    }
  }
  out.mean /= count;
  return out;
}

void check_cross(const std::string& file, const std::string& target_name, double lowest_scale, double highest_scale) {
  if (!have("q_Horse.glb") || !have(target_name))
    GTEST_SKIP() << "no q_Horse.glb or " << target_name << " under " << data_folder();
  const World world;
  const Body horse = load("q_Horse.glb", world), other = load(target_name, world);
  const Pairs pairs = find_pairs(file, horse, other);
  const CrossFigures fields = cross(horse, other, pairs, false), paper = cross(horse, other, pairs, true);
  for (const CrossFigures* f : {&fields, &paper})
    std::printf("q_Horse -> %s, %s: scale %.3f, foot paths mean %.4f max %.4f of the box, edge stretch p95 %.3f\n",
                target_name.c_str(), f == &fields ? "fields" : "the paper's form", f->scale, f->mean, f->largest,
                f->stretch);
  EXPECT_GT(fields.scale, lowest_scale);
  EXPECT_LT(fields.scale, highest_scale);
  EXPECT_LT(fields.mean, 0.005);
  EXPECT_LT(fields.largest, 0.012);
  EXPECT_LT(fields.stretch, 0.4);
}

// The horse grazes with its nose at 0.037 of its box over the ground; the deer's comes as near, scaled.
TEST(TransferData, TheDeersNoseComesAsNearToTheGroundAsTheGrazingHorses) {
  if (!have("q_Horse.glb") || !have("q_Deer.glb")) GTEST_SKIP() << "no q_Horse or q_Deer under " << data_folder();
  const World world;
  const Body horse = load("q_Horse.glb", world), deer = load("q_Deer.glb", world);
  Pairs pairs = find_pairs("q_horse_to_q_deer.json", horse, deer);
  ASSERT_EQ(pairs.names[0], "nose");
  pairs.flags[0] |= HF_PAIR_CONTACT;
  hf_inner::transfer::Transfer transfer(horse.core, deer.core, {});
  add(transfer, pairs.inputs());
  const hf_gltf::Animation& eating =
      horse.model.animations[static_cast<size_t>(hf_gltf::find_animation(horse.model, "AnimalArmature|Eating"))];
  double from = 1e300, to = 1e300;
  for (int k = 0; k <= 60; ++k) {
    const std::vector<Vec3> posed = horse.posed(eating, hf_gltf::clip_duration(eating) * k / 60);
    from = std::min(from, transfer.scale() * (lowest_of(pairs.source[0], posed) - lowest_of(horse.rest())));
    to = std::min(to, lowest_of(pairs.target[0], frame_of(transfer, posed)) - lowest_of(deer.rest()));
  }
  const double box = deer.core->mesh.scale;
  std::printf("eating: the deer's nose %.4f of the box over the ground, the horse's scaled %.4f\n", to / box,
              from / box);
  EXPECT_NEAR(to, from, 0.003 * box);
  EXPECT_LT(to, 0.05 * box);
}

TEST(TransferData, TheHorsesClipsStandOnTheWolfsFeet) { check_cross("q_horse_to_q_wolf.json", "q_Wolf.glb", 0.5, 0.7); }
TEST(TransferData, TheHorsesClipsStandOnTheCowsFeet) {
  check_cross("q_horse_to_farm_cow.json", "farm_Cow.glb", 1.0, 1.3);
}
TEST(TransferData, TheDeersRumpStaysWholeUnderTheHorsesClips) {
  check_cross("q_horse_to_q_deer.json", "q_Deer.glb", 0.8, 0.9);
}

}  // namespace

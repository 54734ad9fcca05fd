// Real animals, when the shared data is there: the bars of the self-transfer, and that of feet across species.
#include <gtest/gtest.h>

#include "unit/transfer/transfer_support.h"

namespace {

using namespace transfer_test;
using hf::Vec3;

bool have(const std::string& name) { return std::filesystem::exists(data_folder() / "gltf" / name); }
Body load(const std::string& name, const World& world) {
  return Body(samples::read_gltf(data_folder() / "gltf" / name), world);
}

struct Figures {
  double mean = 0, worst = 0, idle = 0;
};

// Six frames of every clip, q_Horse on itself.
Figures self_transfer(int32_t mode, bool anchored) {
  const World world;
  const Body horse = load("q_Horse.glb", world);
  Pairs pairs = find_pairs("q_horse_to_q_wolf.json", horse, horse, true);
  for (uint32_t& flags : pairs.flags)
    flags = anchored ? flags | HF_PAIR_ANCHOR : flags & ~uint32_t{HF_PAIR_ANCHOR | HF_PAIR_FOOT};
  hf::TransferOptions options;
  options.mode = mode, options.scale = 1;
  hf::Transfer transfer(horse.core, horse.core, options);
  add(transfer, pairs.inputs());
  Figures out;
  int frames = 0;
  for (const samples::Animation& clip : horse.model.animations) {
    for (int k = 0; k < 6; ++k, ++frames) {
      const std::vector<Vec3> posed = horse.posed(clip, samples::clip_duration(clip) * k / 5);
      const double error = rms(*horse.core, frame_of(transfer, posed), posed, !anchored);
      out.mean += error, out.worst = std::max(out.worst, error);
      if (clip.name == "AnimalArmature|Idle") out.idle = std::max(out.idle, error);
    }
  }
  out.mean /= frames;
  return out;
}

TEST(TransferData, TheHorseOnItselfStaysWithinTheBars) {
  if (!have("q_Horse.glb")) GTEST_SKIP() << "no q_Horse.glb under " << data_folder();
  const Figures anchored = self_transfer(HF_TRANSFER_FIELDS, true),
                free_standing = self_transfer(HF_TRANSFER_FIELDS, false);
  const Figures paper = self_transfer(HF_TRANSFER_PAPER, true), paper_free = self_transfer(HF_TRANSFER_PAPER, false);
  std::printf("self-transfer of q_Horse, rms / box     mean   worst   idle\n");
  const auto line = [](const char* name, const Figures& f) {
    std::printf("  %-34s %.4f  %.4f  %.4f\n", name, f.mean, f.worst, f.idle);
  };
  line("fields, anchored (bar .010 .025 .003)", anchored), line("fields, free (bar .016)", free_standing);
  line("paper, anchored", paper), line("paper, free", paper_free);
  EXPECT_LT(anchored.mean, 0.010);
  EXPECT_LT(anchored.worst, 0.025);
  EXPECT_LT(anchored.idle, 0.003);
  EXPECT_LT(free_standing.mean, 0.016);
  EXPECT_LT(anchored.mean, paper.mean);
}

void check_cross(const std::string& file, const std::string& target_name, double lowest_scale, double highest_scale) {
  if (!have("q_Horse.glb") || !have(target_name))
    GTEST_SKIP() << "no q_Horse.glb or " << target_name << " under " << data_folder();
  const World world;
  const Body horse = load("q_Horse.glb", world), other = load(target_name, world);
  const Pairs pairs = find_pairs(file, horse, other);
  hf::Transfer transfer(horse.core, other.core, {});
  add(transfer, pairs.inputs());
  EXPECT_GT(transfer.scale(), lowest_scale);
  EXPECT_LT(transfer.scale(), highest_scale);
  const std::vector<Vec3> horse_rest = horse.rest(), rest = other.rest();
  const auto centre = [](const std::vector<int32_t>& region, const std::vector<Vec3>& points) {
    Vec3 sum;
    for (const int32_t v : region)
      sum = sum + (1.0 / static_cast<double>(region.size())) * points[static_cast<size_t>(v)];
    return sum;
  };
  double sum = 0, largest = 0, stretch_sum = 0;
  int count = 0, frames = 0;
  for (const char* name : {"Gallop", "Walk", "Eating", "Idle"}) {
    const samples::Animation& clip = horse.model.animations[static_cast<size_t>(
        samples::find_animation(horse.model, std::string("AnimalArmature|") + name))];
    for (int f = 0; f < 12; ++f, ++frames) {
      const std::vector<Vec3> posed = horse.posed(clip, samples::clip_duration(clip) * f / 12),
                              out = frame_of(transfer, posed);
      for (size_t p = 0; p < pairs.names.size(); ++p) {
        if (!(pairs.flags[p] & HF_PAIR_FOOT)) continue;
        const Vec3 path = transfer.scale() * (centre(pairs.source[p], posed) - centre(pairs.source[p], horse_rest));
        const double miss =
            hf::norm(centre(pairs.target[p], out) - centre(pairs.target[p], rest) - path) / other.core->mesh.scale;
        sum += miss, largest = std::max(largest, miss), ++count;
      }
      std::vector<double> stretch;
      for (int32_t e = 0; e < other.core->topology.edge_count(); ++e) {
        const auto i = static_cast<size_t>(other.core->topology.first(e)),
                   j = static_cast<size_t>(other.core->topology.second(e));
        stretch.push_back(std::abs(hf::norm(out[i] - out[j]) / hf::norm(rest[i] - rest[j]) - 1));
      }
      std::nth_element(stretch.begin(), stretch.begin() + static_cast<std::ptrdiff_t>(stretch.size() * 95 / 100),
                       stretch.end());
      stretch_sum = std::max(stretch_sum, stretch[stretch.size() * 95 / 100]);
    }
  }
  std::printf("q_Horse -> %s: scale %.3f, foot paths mean %.4f max %.4f of the box, edge stretch p95 %.3f\n",
              target_name.c_str(), transfer.scale(), sum / count, largest, stretch_sum);
  EXPECT_LT(sum / count, 0.005);
  EXPECT_LT(largest, 0.015);
  EXPECT_LT(stretch_sum, 0.4);
}

TEST(TransferData, TheHorsesClipsStandOnTheWolfsFeet) { check_cross("q_horse_to_q_wolf.json", "q_Wolf.glb", 0.5, 0.7); }
TEST(TransferData, TheHorsesClipsStandOnTheCowsFeet) {
  check_cross("q_horse_to_farm_cow.json", "farm_Cow.glb", 1.0, 1.3);
}
TEST(TransferData, TheDeersRumpStaysWholeUnderTheHorsesClips) {
  check_cross("q_horse_to_q_deer.json", "q_Deer.glb", 0.8, 0.9);
}

}  // namespace

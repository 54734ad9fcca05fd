// hf_pictures: the pictures of the documentation, made again. See --help.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "common/program.h"
#include "pictures/animation_file.h"
#include "pictures/scenes.h"

namespace samples {
namespace {

const char* const usage =
    "usage: hf_pictures OUT --pairs FILE.json [--vertices N] [--frames N] [--every N] [--percent N]\n"
    "  Writes hf.png (an animated PNG: pose, field, and a walk on another body) and ability_*.png to the folder OUT.\n"
    "  --pairs FILE   pairs of the horse and the bull, as hf_transfer takes them\n"
    "  --vertices N   of a creature (16000)\n"
    "  --frames N     of the animation, a multiple of 3 (48)\n"
    "  --every N      draws one of N frames: as they are in the whole animation (1)\n"
    "  --percent N    size of the pictures; 100 is 700 pixels wide (100)\n";

struct Command {
  std::filesystem::path out, pairs;
  uint32_t vertices = 16000, frames = 48, every = 1, percent = 100;
  bool help = false;
};

constexpr double seconds = 4;       // that the animation takes
constexpr uint32_t walk_count = 3;  // walks in that time

Command parse(Words words) {
  Command out;
  while (words.next()) {
    if (words.is("--help", "-h")) {
      out.help = true;
    } else if (words.is("--pairs")) {
      out.pairs = words.file();
    } else if (words.is("--vertices")) {
      out.vertices = words.whole(500, 300000);
    } else if (words.is("--frames")) {
      out.frames = words.whole(3, 300);
    } else if (words.is("--every")) {
      out.every = words.whole(1, 300);
    } else if (words.is("--percent")) {
      out.percent = words.whole(5, 400);
    } else {
      words.take_mesh(out.out);
    }
  }
  if (out.help) return out;
  if (out.out.empty() || out.pairs.empty()) throw std::runtime_error("name a folder and --pairs; see --help");
  if (out.frames % walk_count != 0) throw std::runtime_error("--frames must be a multiple of 3");
  return out;
}

// 0 at both ends and up to there slowly: pulled in the first third, held, let back in the last half.
double pull_at(double phase) {
  const auto ease = [](double t) {
    t = std::min(std::max(t, 0.0), 1.0);
    return t * t * t * (t * (6 * t - 15) + 10);
  };
  return ease(phase / 0.35) * (1 - ease((phase - 0.5) / 0.4));
}

void run(const Command& options) {
  std::filesystem::create_directories(options.out);
  const auto pixels = [&](int full) { return std::max(8, full * static_cast<int>(options.percent) / 100); };
  const auto write = [&](const std::string& name, const std::vector<Picture>& frames) {
    const std::filesystem::path file = options.out / name;
    write_frames(file.string(), frames, static_cast<uint32_t>(1000 * seconds * options.every / options.frames));
    std::printf("wrote %s (%zu frames, %ju bytes)\n", file.string().c_str(), frames.size(),
                static_cast<uintmax_t>(std::filesystem::file_size(file)));
    std::fflush(stdout);
  };
  const Body horse("horse", options.vertices);
  PoseScene pose(horse);
  FieldScene field(horse);
  const WalkScene walk(horse.creature, make_creature("bull", options.vertices), options.pairs,
                       options.frames / walk_count);
  const int width = pixels(320), height = pixels(240);
  write("ability_field.png", {field.draw(width, height, 0)});
  write("ability_pose.png", {pose.draw(width, height, 1)});
  write("ability_surface.png", {draw_surface(Body("horse", std::min(options.vertices, 1600u)), 2 * width, 2 * height)});
  write("ability_geodesics.png", {draw_geodesics(horse, 2 * width, 2 * height)});
  write("ability_cut.png", {draw_cut(Body("horse", std::min(options.vertices, 4000u)), 2 * width, 2 * height)});
  write("ability_quads.png", {draw_quads(horse, width, height)});
  write("ability_detail.png", {draw_detail(horse, width, height)});
  write("ability_direction.png", {draw_direction(horse, width, height)});
  write("ability_transfer.png", {walk.draw_both(width, height, 1)});

  const int tile = pixels(350), upper = pixels(270), lower = pixels(210);
  std::vector<Picture> frames;
  for (uint32_t i = 0; i < options.frames; ++i) {
    const double phase = static_cast<double>(i) / options.frames;
    if (i % options.every != 0) {
      pose.pull(pull_at(phase));
      continue;
    }
    Picture page{2 * tile, upper + lower, {}};
    page.rgb.resize(3 * size_t(page.width) * size_t(page.height));
    paste(page, pose.draw(tile, upper, pull_at(phase)), 0, 0);
    paste(page, field.draw(tile, upper, phase), tile, 0);
    paste(page, walk.draw(tile, lower, i, false), 0, upper);
    paste(page, walk.draw(tile, lower, i, true), tile, upper);
    if (options.percent >= 50) {
      const Color grey{0.36, 0.39, 0.45};
      draw_text(page, 12, 10, "pose: the head is pulled", 1, grey);
      draw_text(page, tile + 12, 10, "field: a site is dragged", 1, grey);
      draw_text(page, 12, upper + 4, "a walk", 1, grey);
      draw_text(page, tile + 12, upper + 4, "transferred to another body", 1, grey);
    }
    frames.push_back(std::move(page));
  }
  write("hf.png", frames);
}

}  // namespace
}  // namespace samples

int main(int count, char** arguments) {
  return samples::run_program("hf_pictures", samples::usage, count, arguments, samples::parse, samples::run);
}

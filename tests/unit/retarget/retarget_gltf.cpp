// retarget_gltf SOURCE CLIP TARGET OUT.glb [--plain] [--no-goals] [--no-align] [--no-copy] [--rate N] [--in-place]
// Writes the target with the clip of the source on its own joints, and prints how that went. --plain: by the peer.
#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>
#include <stdexcept>

#include "../skeleton/gltf_character.h"
#include "clip_player.h"
#include "gltf/gltf_read.h"
#include "gltf/gltf_write.h"
#include "plain_retarget.h"
#include "retarget/retarget.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::retarget;

void print_report(const RetargetReport& report, const hf_test::GltfCharacter& a, const hf_test::GltfCharacter& b,
                  double frame_us) {
  std::printf(
      "  scale %.4g by %s%s, %u joints follow, limbs off %.2f degrees, hips sank %.3g, stride %.3f, %.1f us a frame\n",
      report.scale, scale_source_name(report.scale_source), report.same_skeleton ? ", same skeleton" : "",
      report.matched_joints, report.limb_degrees, report.deepest_drop, report.stride, frame_us);
  for (const ChainReport& chain : report.chains)
    std::printf("    %-8s %-2s %2u on %2u: %.2f, at most %.2f\n", skeleton::role_name(chain.role),
                chain.side == skeleton::Side::left    ? ".l"
                : chain.side == skeleton::Side::right ? ".r"
                                                      : "",
                chain.source_joints, chain.target_joints, chain.mean_degrees, chain.worst_degrees);
  for (const auto& [name, list, names] : {std::tuple{"source", &report.unmatched_source, &a.names},
                                          std::tuple{"target", &report.unmatched_target, &b.names}}) {
    std::printf("    without a partner on the %s:", name);
    for (const std::uint32_t j : *list) std::printf(" %s", (*names)[j]);
    std::printf("\n");
  }
}

std::size_t find_clip(const hf_gltf::Model& model, const std::string& name) {
  for (std::size_t k = 0; k < model.animations.size(); ++k) {
    if (model.animations[k].name == name || std::to_string(k) == name) return k;
  }
  std::string list;
  for (const auto& clip : model.animations) list += " " + clip.name;
  throw std::runtime_error("no clip " + name + "; there are" + list);
}

int run(int argc, char** argv) {
  RetargetOptions options;
  bool plain = false;
  double rate = 30;
  std::vector<std::string> files;
  for (int k = 1; k < argc; ++k) {
    const std::string text = argv[k];
    if (text == "--plain")
      plain = true;
    else if (text == "--no-goals")
      options.goals = false;
    else if (text == "--no-align")
      options.align_rests = false;
    else if (text == "--no-copy")
      options.copy_same = false;
    else if (text == "--in-place")
      options.root_motion = RootMotion::in_place;
    else if (text == "--rate" && k + 1 < argc)
      rate = std::stod(argv[++k]);
    else
      files.push_back(text);
  }
  if (files.size() != 4) throw std::runtime_error("give SOURCE CLIP TARGET OUT.glb");
  const hf_gltf::Model source = hf_gltf::read_gltf(files[0]);
  hf_gltf::Model target = hf_gltf::read_gltf(files[2]);
  const hf_test::GltfCharacter a(source), b(target);
  Memory memory;
  const skeleton::Character ca = skeleton::know_character(a.input(), memory),
                            cb = skeleton::know_character(b.input(), memory);
  const hf_gltf::Animation& clip = source.animations[find_clip(source, files[1])];
  const std::vector<double> times = hf_gltf::frame_times(clip, rate);
  std::vector<std::vector<double>> frames;
  std::vector<double> poses;
  for (const double time : times) {
    const std::vector<double> pose = hf_test::trs_of(hf_gltf::sample(source, clip, time));
    poses.insert(poses.end(), pose.begin(), pose.end());
  }
  const skeleton::CharacterInput ia = a.input(), ib = b.input();
  find_ground_velocity({ia, ca, nullptr}, poses.data(), static_cast<std::uint32_t>(times.size()), 1 / rate,
                       options.ground_velocity, memory);
  Retarget retarget({ia, ca, nullptr}, {ib, cb, nullptr}, options, memory);
  const hf_test::PlainRetarget peer(ia, ib);
  double us = 0;
  for (std::size_t f = 0; f < times.size(); ++f) {
    const double* pose = &poses[10 * source.nodes.size() * f];
    frames.emplace_back(10 * target.nodes.size());
    const auto start = std::chrono::steady_clock::now();
    if (plain)
      peer.frame(pose, frames.back().data());
    else
      retarget.frame(pose, f == 0 ? 0 : times[f] - times[f - 1], frames.back().data());
    us += std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
  }
  std::printf("%s %s on %s, %zu frames, ground %.3g %.3g %.3g\n", files[0].c_str(), clip.name.c_str(), files[2].c_str(),
              times.size(), options.ground_velocity[0], options.ground_velocity[1], options.ground_velocity[2]);
  if (!plain) print_report(retarget.report(), a, b, us / static_cast<double>(times.size()));
  hf_test::set_clip(target, clip.name, times, frames);
  hf_gltf::write_gltf(target, files[3]);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::printf("%s\n", error.what());
    return 1;
  }
}

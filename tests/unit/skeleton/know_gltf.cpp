// know_gltf [--no-names] [--no-up] [--no-declared] [--why] FILE...: prints what know_character finds in glTF files.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>

#include "base/error.h"
#include "gltf/gltf_read.h"
#include "gltf/stance.h"
#include "gltf_character.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::skeleton;

const char* axis_name(Vec3 v, char* text) {
  static const char* names[] = {"+x", "-x", "+y", "-y", "+z", "-z"};
  const double c[] = {v.x, -v.x, v.y, -v.y, v.z, -v.z};
  for (int k = 0; k < 6; ++k) {
    if (c[k] > 0.999) return names[k];
  }
  std::snprintf(text, 32, "%.2f,%.2f,%.2f", v.x, v.y, v.z);
  return text;
}

void print_chains(const Character& c, const hf_test::GltfCharacter& g) {
  for (const Chain& chain : c.chains) {
    if (chain.role == Role::other || chain.role == Role::finger) continue;
    std::printf("    %s%s%u %.3g:", role_name(chain.role),
                chain.side == Side::left    ? ".l"
                : chain.side == Side::right ? ".r"
                                            : "",
                chain.number, chain.length);
    for (std::uint32_t k = 0; k < chain.count; ++k) {
      const std::uint32_t j = c.chain_joints[chain.first + k];
      std::printf(" %s", g.names[j]);
    }
    std::printf("\n");
  }
}

void print_file(const char* file, bool names, bool up, bool declared, bool why) {
  const hf_gltf::Model model = hf_gltf::read_gltf(file);
  const auto stance = hf_gltf::find_stance(model, hf_gltf::flatten(model), nullptr);
  if (stance) std::printf("stands %s: ", stance->from.c_str());
  const hf_test::GltfCharacter g(model, stance ? stance->pose : hf_gltf::rest_pose(model));
  Memory memory;
  const auto start = std::chrono::steady_clock::now();
  const Character c = know_character(g.input(names, up, declared), memory);
  const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  char a[32], b[32];
  std::printf(
      "%s joints %zu up %s %.2f forward %s %.2f roles %.2f | leg %.3g hip %.3g arm %.3g height %.3g trunk %.2f | %.1f "
      "ms | up: %.*s | forward: %.*s\n",
      std::strrchr(file, '/') ? std::strrchr(file, '/') + 1 : file, g.names.size(), axis_name(c.up, a), c.up_confidence,
      axis_name(c.forward, b), c.forward_confidence, c.role_confidence, c.leg_length, c.hip_height, c.arm_length,
      c.height, c.trunk, ms, static_cast<int>(c.up_why.size()), c.up_why.data(), static_cast<int>(c.forward_why.size()),
      c.forward_why.data());
  if (!why) return;
  std::printf("%.*s", static_cast<int>(c.why.size()), c.why.data());
  print_chains(c, g);
}

}  // namespace

int main(int argc, char** argv) {
  bool names = true, up = true, declared = true, why = false;
  for (int k = 1; k < argc; ++k) {
    if (!std::strcmp(argv[k], "--no-names"))
      names = false;
    else if (!std::strcmp(argv[k], "--no-up"))
      up = false;
    else if (!std::strcmp(argv[k], "--no-declared"))
      declared = false;
    else if (!std::strcmp(argv[k], "--why"))
      why = true;
    else {
      try {
        print_file(argv[k], names, up, declared, why);
      } catch (const std::exception& error) {
        std::printf("%s: %s\n", argv[k], error.what());
      }
    }
  }
  return 0;
}

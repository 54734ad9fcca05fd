// Characters of other people, from the shared data: up and forward by eye.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "gltf/gltf_read.h"
#include "gltf_character.h"

namespace hf_test {
namespace {

using hf_inner::Vec3;

std::filesystem::path models() {
  const char* given = std::getenv("HF_SHARED_DATA");
  return std::filesystem::path(given ? given : HF_SOURCE_DIR "/../shared/data") / "gltf";
}

struct Seen {
  const char* file;
  Vec3 forward{0, 0, 1};
};

const Seen seen[] = {{"CesiumMan", {1, 0, 0}},
                     {"alien", {0, 0, -1}},
                     {"RiggedFigure"},
                     {"RobotExpressive"},
                     {"farm_Cow"},
                     {"farm_Llama"},
                     {"farm_Pug"},
                     {"farm_Sheep"},
                     {"godot_robot"},
                     {"kenney"},
                     {"khr_Fox"},
                     {"kk_Knight"},
                     {"mannequiny"},
                     {"q_Alpaca"},
                     {"q_Cow"},
                     {"q_CyberCharacter"},
                     {"q_Deer"},
                     {"q_Enemy_2Legs"},
                     {"q_Fox"},
                     {"q_Frog"},
                     {"q_Horse"},
                     {"q_Husky"},
                     {"q_KnightCharacter"},
                     {"q_Man_Casual"},
                     {"q_Manta_ray"},
                     {"q_PlatformerCharacter"},
                     {"q_PlatformerHumanoidRig"},
                     {"q_Spider"},
                     {"q_Trex"},
                     {"q_Triceratops"},
                     {"q_Velociraptor"},
                     {"q_Wolf"},
                     {"q_Woman_Casual"}};

// Where the file declares nothing but what its format says, and where it does not even say that.
TEST(World, CharactersFaceWhereTheyAreSeenToFace) {
  if (!std::filesystem::exists(models())) GTEST_SKIP() << "the optional shared data is not there (HF_SHARED_DATA)";
  for (const Seen& one : seen) {
    const std::filesystem::path file = models() / (std::string(one.file) + ".glb");
    if (!std::filesystem::exists(file)) continue;
    const GltfCharacter character(hf_gltf::read_gltf(file));
    for (const bool with_up : {true, false}) {
      hf_inner::Memory memory;
      const hf_inner::skeleton::Character found =
          hf_inner::skeleton::know_character(character.input(true, with_up), memory);
      const std::string why(found.why.begin(), found.why.end());
      EXPECT_GT(found.up.y, 0.95) << one.file << " with up " << with_up << "\n" << why;
      EXPECT_GT(hf_inner::dot(found.forward, one.forward), 0.9) << one.file << " with up " << with_up << "\n" << why;
    }
  }
}

}  // namespace
}  // namespace hf_test

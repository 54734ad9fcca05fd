// Helper bones are proposed for reasons; a bone that carries skin is not proposed for one reason alone.
#include "weights/helper_bones.h"

#include <string>

#include "weights_support.h"

namespace {

using namespace hf_test;
using namespace hf_inner;
using namespace hf_inner::weights;

TEST(HelperBones, ReasonsAddUp) {
  Memory memory;
  Bones bones(memory);
  const std::string names = "root\nspine\nPoleTarget.L\nIKHandle\nuprooted\nhand_end\narm\nroot2\n";
  const int parents[] = {-1, 0, 0, 0, 1, 4, 4, 1};
  for (const int parent : parents) {
    bones.head.push_back({});
    bones.parent.push_back(parent);
    bones.deforms.push_back(1);
  }
  bones.deforms[7] = 0;
  Vector<std::uint32_t> faults(8, 0u, &memory);
  faults[0] = faults[2] = bone_outside | bone_informs_none;
  faults[5] = bone_informs_none | bone_no_length;
  faults[6] = bone_coincident;
  const auto found = helper_reasons(bones, faults, {names.data(), names.size()}, memory);
  EXPECT_EQ(found[0], helper_proposed | helper_name_root | helper_root | helper_outside | helper_informs_none);
  EXPECT_EQ(found[1], 0u);
  EXPECT_EQ(found[2], helper_proposed | helper_name_control | helper_apart | helper_outside | helper_informs_none);
  EXPECT_EQ(found[3], helper_name_control | helper_apart);  // a name and a place are not enough
  EXPECT_EQ(found[4], 0u);                                  // root inside a word is no root
  EXPECT_EQ(found[5], helper_proposed | helper_name_end | helper_informs_none | helper_no_length);
  EXPECT_EQ(found[6], +helper_coincident);
  EXPECT_EQ(found[7], 0u);  // it does not deform already
  const auto nameless = helper_reasons(bones, faults, {}, memory);
  EXPECT_EQ(nameless[3], +helper_apart);
}

}  // namespace

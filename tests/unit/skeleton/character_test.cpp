// One body in the conventions of many tools: axes, roles and sides are found for all of them.
#include <gtest/gtest.h>

#include "rig_family.h"

namespace hf_test {
namespace {

using hf_inner::Character;
using hf_inner::know_character;
using hf_inner::Memory;

std::string why(const Character& c) { return {c.why.begin(), c.why.end()}; }

std::vector<std::pair<const char*, BodyShape>> shapes() {
  std::vector<std::pair<const char*, BodyShape>> out;
  for (const auto& [name, rest] :
       {std::pair{"T", Rest::t}, std::pair{"A", Rest::a}, std::pair{"crouched", Rest::crouched}}) {
    for (const int spine : {3, 5}) {
      for (const auto& [leg, arm, head] :
           {std::tuple{1.0, 1.0, 1.0}, std::tuple{0.45, 0.6, 2.6}, std::tuple{1.5, 1.5, 0.9}})
        out.push_back({name, {leg, arm, head, spine, rest}});
    }
  }
  return out;
}

class Biped : public testing::TestWithParam<std::string> {};

TEST_P(Biped, AxesRolesAndSidesAreFoundInEveryShape) {
  for (const auto& [name, shape] : shapes()) {
    const Rig rig = make_biped(GetParam(), shape);
    Memory memory;
    const PlacedRig placed(rig, {});
    const Character found = know_character(placed.input(), memory);
    EXPECT_EQ(placed.faults(found), "") << name << " leg " << shape.leg << " spine " << shape.spine << "\n"
                                        << why(found);
  }
}

TEST_P(Biped, ScaleUpAxisFacingAndMirrorDoNotMatter) {
  const Rig rig = make_biped(GetParam(), {});
  for (const Placing& placing :
       {Placing{0.01, 0, false, false, {}}, Placing{100, 0, false, false, {5, -3, 8}}, Placing{1, 90, false, false, {}},
        Placing{1, 180, false, false, {}}, Placing{1, 217, false, false, {1, 0, 0}}, Placing{1, 0, true, false, {}},
        Placing{1, 180, true, false, {}}, Placing{100, 90, true, false, {}}, Placing{1, 0, false, true, {}},
        Placing{1, 90, true, true, {}}}) {
    Memory memory;
    const PlacedRig placed(rig, placing);
    const Character found = know_character(placed.input(), memory);
    EXPECT_EQ(placed.faults(found), "") << "yaw " << placing.yaw << " z up " << placing.z_up << " mirrored "
                                        << placing.mirrored << " scale " << placing.scale << "\n"
                                        << why(found);
  }
}

INSTANTIATE_TEST_SUITE_P(Conventions, Biped, testing::ValuesIn(biped_conventions), [](const auto& info) {
  std::string name = info.param;
  for (char& c : name) c = c == ' ' ? '_' : c;
  return name;
});

}  // namespace
}  // namespace hf_test

// Which bones inform vertices where no vertex sees one, and where the front of a sheet faces them.
#include "weights_support.h"

namespace {

using namespace hf_test;
using hf_inner::weights::Bones;
using hf_inner::weights::Weights;

// Two tetrahedra through one another: the corners of each are behind a face of the other, so none sees the bones in the
// middle. A triangle from corner to corner makes one piece of them.
TEST(Informants, ABodyThatSeesNoBoneAsksUnseenWhateverAButtonSees) {
  PlainMesh star;
  star.positions = {1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1, -1, -1, -1, -1, 1, 1, 1, -1, 1, 1, 1, -1, 3, 3, 3};
  star.triangles = {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2, 4, 6, 5, 4, 5, 7, 4, 7, 6, 5, 6, 7, 0, 7, 8};
  PlainMesh dressed = star;
  append(dressed, tube(4, 2, 0.05), 2);
  for (std::size_t i = 3 * star.vertex_count(); i < dressed.positions.size(); ++i)
    dressed.positions[i] *= i % 3 == 0 ? 1 : 0.05;
  const auto weights_of = [](const PlainMesh& mesh) {
    const auto skin = skin_of(mesh);
    Bones bones = chain(*skin->core->memory, 2, 0.2);
    for (int b = 0; b < 2; ++b) {
      bones.head[at(b)].x -= 0.1;
      bones.tail[at(b)].x -= 0.1;
    }
    return Weights(skin, 4, bones);
  };
  const Weights alone = weights_of(star), both = weights_of(dressed);
  EXPECT_TRUE(alone.state().counts.blind);
  EXPECT_TRUE(both.state().counts.blind);
  for (Index v = 0; at(v) < star.vertex_count(); ++v) {
    EXPECT_EQ(both.state().origin[at(v)], hf_inner::weights::Origin::informed);
    EXPECT_NEAR(weight_of(both, v, 0), weight_of(alone, v, 0), 1e-5);
  }
  EXPECT_GT(weight_of(both, 4, 0), 0.5);
  EXPECT_GT(weight_of(both, 0, 1), 0.5);
}

// A sheet of 0.4 times 2, flat or bent to a half pipe, with two bones along it at a distance before or behind its
// front.
Weights weights_of_sheet(double bend, double distance) {
  PlainMesh sheet;
  constexpr std::uint32_t across = 5, along = 21;
  for (std::uint32_t i = 0; i < along; ++i) {
    for (std::uint32_t k = 0; k < across; ++k) {
      const double y = 0.1 * k - 0.2;
      sheet.positions.insert(sheet.positions.end(), {0.1 * i, y, bend * y * y});
      if (i == 0 || k == 0) continue;
      const std::uint32_t d = i * across + k, c = d - 1, b = d - across, a = b - 1;
      sheet.triangles.insert(sheet.triangles.end(), {a, c, d, a, d, b});
    }
  }
  for (std::size_t t = 0; distance < 0 && t < sheet.triangles.size(); t += 3)
    std::swap(sheet.triangles[t], sheet.triangles[t + 1]);
  const auto skin = skin_of(sheet);
  Bones bones = chain(*skin->core->memory, 2, 2);
  for (int b = 0; b < 2; ++b) bones.head[at(b)].z = bones.tail[at(b)].z = std::fabs(distance);
  return Weights(skin, 4, bones);
}

TEST(Informants, ASheetWhoseFrontFacesItsBonesHasTheWeightsOfOneTurnedRound) {
  for (const double bend : {0.0, 4.0}) {
    const Weights front = weights_of_sheet(bend, 0.2), turned = weights_of_sheet(bend, -0.2);
    expect_valid(front);
    EXPECT_LT(worst_difference(front, turned), 1e-5) << bend;
    EXPECT_GT(weight_of(front, 2, 0), 0.9) << bend;
    EXPECT_GT(weight_of(front, 5 * 20 + 2, 1), 0.9) << bend;
  }
}

}  // namespace

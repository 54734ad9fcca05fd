// Touching the ground and being held: planted feet, contacts, places the caller decides, exchanged sides; and the
// comparison with joint rotations copied by name, on real animals when the shared data is there.
#include <gtest/gtest.h>

#include "peers/paper_transfer.h"
#include "unit/transfer/transfer_support.h"

namespace {

using namespace transfer_test;
using hf_inner::Vec3;

TEST(TransferContacts, ARegionTheCallerHoldsGoesExactlyWhereItIsSaidAndTheRestFollows) {
  const Animals& a = animals();
  hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, {});
  std::vector<uint32_t> numbers(a.pairs.names.size());
  add(transfer, a.pairs.inputs(), numbers.data());
  const std::vector<Vec3> posed = a.horse.posed(a.walk, 0.3);
  const std::vector<Vec3> free_frame = frame_of(transfer, posed);
  // a foot, which is an anchor, and the nose, which is none
  const size_t foot = 2, nose = a.pair("nose");
  ASSERT_LT(nose, numbers.size());
  const Vec3 step = centre_of(a.pairs.target[foot], free_frame) + Vec3{0, 0.05 * a.box, 0.02 * a.box};
  const Vec3 rail = centre_of(a.pairs.target[nose], free_frame) + Vec3{0.03 * a.box, 0.02 * a.box, 0};
  const hf_inner::transfer::PairHold holds[] = {{numbers[foot], step}, {numbers[nose], rail}};
  std::vector<Vec3> held(static_cast<size_t>(transfer.target().size()));
  transfer.apply(posed.data(), held.data(), {holds, 2});
  EXPECT_LT(hf_inner::norm(centre_of(a.pairs.target[foot], held) - step), 1e-6 * a.box);
  EXPECT_LT(hf_inner::norm(centre_of(a.pairs.target[nose], held) - rail), 1e-6 * a.box);
  // another foot stays, and nothing tears
  EXPECT_LT(hf_inner::norm(centre_of(a.pairs.target[5], held) - centre_of(a.pairs.target[5], free_frame)),
            0.01 * a.box);
  EXPECT_LT(largest_distance(held, free_frame), 0.12 * a.box);
  // holds are of one frame
  EXPECT_EQ(largest_distance(frame_of(transfer, posed), free_frame), 0.0);
}

TEST(TransferContacts, BadHoldsAreNamedAndChangeNothing) {
  const Animals& a = animals();
  hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, {});
  std::vector<uint32_t> numbers(a.pairs.names.size());
  add(transfer, a.pairs.inputs(), numbers.data());
  const std::vector<Vec3> posed = a.horse.posed(a.walk, 0.3), before = frame_of(transfer, posed);
  std::vector<Vec3> out = before;
  const auto refused = [&](std::vector<hf_inner::transfer::PairHold> holds, hf_result code, uint32_t index) {
    try {
      transfer.apply(posed.data(), out.data(), {holds.data(), holds.size()});
      ADD_FAILURE() << "not refused";
    } catch (const hf_inner::Error& error) {
      EXPECT_EQ(error.code(), code);
      EXPECT_EQ(error.index(), index);
    }
    EXPECT_EQ(largest_distance(out, before), 0.0);
  };
  refused({{numbers[0], {0, 0, 0}}, {77, {0, 0, 0}}}, HF_ERROR_NOT_FOUND, 1);
  refused({{numbers[0], {0, NAN, 0}}}, HF_ERROR_NON_FINITE, 0);
  refused({{numbers[0], {0, 0, 0}}, {numbers[0], {1, 0, 0}}}, HF_ERROR_INVALID_ARGUMENT, 1);
  EXPECT_EQ(largest_distance(frame_of(transfer, posed), before), 0.0);
}

TEST(TransferContacts, AStandingFootDoesNotSlideOffItsScaledPath) {
  const Animals& a = animals();
  hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, {});
  add(transfer, a.pairs.inputs());
  const std::vector<Vec3> source_rest = a.horse.rest(), rest = a.bull.rest();
  double worst = 0;
  int standing = 0;
  for (int f = 0; f < 40; ++f) {
    const std::vector<Vec3> posed = a.horse.posed(a.walk, hf_gltf::clip_duration(a.walk) * f / 40),
                            out = frame_of(transfer, posed);
    for (size_t foot = 2; foot < 6; ++foot) {
      if (transfer.scale() * (lowest_of(a.pairs.source[foot], posed) - lowest_of(source_rest)) > 0.009 * a.box)
        continue;
      ++standing;
      Vec3 off =
          centre_of(a.pairs.target[foot], out) - centre_of(a.pairs.target[foot], rest) -
          transfer.scale() * (centre_of(a.pairs.source[foot], posed) - centre_of(a.pairs.source[foot], source_rest));
      off.y = 0;
      worst = std::max(worst, hf_inner::norm(off) / a.box);
    }
  }
  EXPECT_GT(standing, 40);
  EXPECT_LT(worst, 1e-3);
}

TEST(TransferContacts, AContactComesAsNearToTheGroundAsItsSource) {
  const Animals& a = animals();
  const size_t nose = a.pair("nose");
  const std::vector<Vec3> rest = a.horse.rest();
  const double ground = lowest_of(rest), target_ground = lowest_of(a.bull.rest());
  // the horse's front bows until its nose is near the ground
  const double tip = centre_of(a.pairs.source[nose], rest).z, from = 0.3 * tip,
               drop = lowest_of(a.pairs.source[nose], rest) - ground - 0.02 * a.horse.core->mesh.scale;
  std::vector<Vec3> posed = rest;
  for (Vec3& p : posed) {
    const double t = std::clamp((p.z - from) / (tip - from), 0.0, 1.0);
    if (p.y - ground > 0.3 * a.horse.core->mesh.scale) p.y -= drop * t * t;
  }
  const double low = lowest_of(a.pairs.source[nose], posed) - ground;
  double miss[2];
  for (const bool contact : {false, true}) {
    Pairs pairs = a.pairs;
    if (contact) pairs.flags[nose] |= HF_PAIR_CONTACT;
    hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, {});
    add(transfer, pairs.inputs());
    const std::vector<Vec3> out = frame_of(transfer, posed);
    miss[contact] = std::abs(lowest_of(pairs.target[nose], out) - target_ground - transfer.scale() * low) / a.box;
  }
  std::printf("contact: the nose is off the scaled height by %.4f of the box, %.4f without\n", miss[1], miss[0]);
  EXPECT_LT(miss[1], 0.01);
  EXPECT_LT(miss[1], 0.5 * miss[0]);
}

TEST(TransferContacts, PairsThatChangeSidesAreSaidToBeCrossed) {
  const Animals& a = animals();
  Pairs pairs = a.pairs;
  const size_t left = a.pair("front foot left"), right = a.pair("front foot right");
  ASSERT_LT(std::max(left, right), pairs.names.size());
  std::swap(pairs.target[left], pairs.target[right]);
  hf_inner::transfer::Transfer good(a.horse.core, a.bull.core, {}), bad(a.horse.core, a.bull.core, {});
  std::vector<uint32_t> numbers(pairs.names.size());
  add(good, a.pairs.inputs(), numbers.data());
  add(bad, pairs.inputs());
  for (size_t p = 0; p < numbers.size(); ++p) {
    EXPECT_FALSE(good.pair_info(numbers[p]).crossed) << pairs.names[p];
    EXPECT_EQ(bad.pair_info(numbers[p]).crossed, p == left || p == right) << pairs.names[p];
  }
}

// ---- against joints copied by name ----

// Local rotations of the source's joints on the target's joints of the same name; translations by their change, scaled.
std::vector<glm::dvec3> copied_by_name(const Body& source, const hf_gltf::Animation& clip, double time,
                                       const Body& target, double scale) {
  const hf_gltf::Pose from = hf_gltf::sample(source.model, clip, time), from_rest = hf_gltf::rest_pose(source.model);
  hf_gltf::Pose to = hf_gltf::rest_pose(target.model);
  for (size_t n = 0; n < to.size(); ++n) {
    const int other = hf_gltf::find_node(source.model, target.model.nodes[n].name);
    if (other < 0) continue;
    const auto o = static_cast<size_t>(other);
    to[n].rotation = from[o].rotation;
    to[n].translation += scale * (from[o].translation - from_rest[o].translation);
  }
  return hf_gltf::posed_positions(target.model, target.mesh, to);
}

void check_against_names(const std::string& target_name, const std::string& list) {
  const auto file = [](const std::string& name) { return data_folder() / "gltf" / name; };
  if (!std::filesystem::exists(file("q_Horse.glb")) || !std::filesystem::exists(file(target_name)))
    GTEST_SKIP() << "no q_Horse.glb or " << target_name << " under " << data_folder();
  const World world;
  const Body horse(hf_gltf::read_gltf(file("q_Horse.glb")), world), other(hf_gltf::read_gltf(file(target_name)), world);
  const Pairs pairs = find_pairs(list, horse, other);
  hf_inner::transfer::TransferOptions paper_options;
  paper_options.scheme = hf_inner::peers::paper_clusters();
  hf_inner::transfer::Transfer transfer(horse.core, other.core, {}), paper(horse.core, other.core, paper_options);
  add(transfer, pairs.inputs());
  add(paper, pairs.inputs());
  for (const char* name : {"AnimalArmature|Gallop", "AnimalArmature|Walk"}) {
    const hf_gltf::Animation& clip =
        horse.model.animations[static_cast<size_t>(hf_gltf::find_animation(horse.model, name))];
    double mean = 0, of_paper = 0, nothing = 0;
    for (int k = 0; k < 12; ++k) {
      const double time = hf_gltf::clip_duration(clip) * k / 11;
      const std::vector<Vec3> posed = horse.posed(clip, time),
                              named = other.inner(copied_by_name(horse, clip, time, other, transfer.scale()));
      mean += rms(*other.core, frame_of(transfer, posed), named, true) / 12;
      of_paper += rms(*other.core, frame_of(paper, posed), named, true) / 12;
      nothing += rms(*other.core, other.rest(), named, true) / 12;
    }
    std::printf("q_Horse -> %s, %s: %.4f of the box from joints copied by name (the paper's form %.4f, rest %.4f)\n",
                target_name.c_str(), name, mean, of_paper, nothing);
    EXPECT_LT(mean, 0.040) << name;
    EXPECT_LT(mean, nothing) << name;
    EXPECT_LT(mean, of_paper) << name;
  }
}

TEST(TransferContacts, TheWolfMovesAsWithJointsCopiedByName) {
  check_against_names("q_Wolf.glb", "q_horse_to_q_wolf.json");
}
TEST(TransferContacts, TheFoxMovesAsWithJointsCopiedByName) {
  check_against_names("q_Fox.glb", "q_horse_to_q_fox.json");
}

}  // namespace

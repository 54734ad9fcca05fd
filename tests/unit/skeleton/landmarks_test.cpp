// Places of bodies with fins, wings and horns: what the skeleton knows as another part is no foot and no hand.
#include <gtest/gtest.h>

#include "gltf/skeleton_pair.h"
#include "gltf/suggest_pairs.h"
#include "rig_model.h"

namespace hf_test {
namespace {

using hf_gltf::find_landmarks;
using hf_gltf::FlatMesh;
using hf_gltf::flatten;
using hf_gltf::Landmarks;
using hf_gltf::Model;
using hf_gltf::suggest_pairs;
using hf_gltf::Suggestion;

Model model_of(const Rig& rig, const std::string& name = "body.glb") {
  return make_rig_model(PlacedRig(rig, {}), name);
}

// A ray: long fins whose tips are the lowest places, and a horn on each side of the head.
Rig make_ray() {
  Rig rig;
  const int body = rig.add("Spine1", -1, {0, 0, 0}, Role::spine);
  rig.add_box(body, {0, 0, -0.5}, {0, 0, 0.5}, 0.2);
  const int head = rig.add("Head", body, {0, 0, 0.5}, Role::head);
  rig.add_box(head, {0, 0, 0.5}, {0, 0, 0.8}, 0.25);
  const int tail = rig.add("Tail1", body, {0, 0, -0.5}, Role::tail);
  rig.add_box(tail, {0, 0, -0.5}, {0, 0, -1.2}, 0.05);
  const int end = rig.add("Tail2", tail, {0, 0, -1.2}, Role::tail);
  rig.add_box(end, {0, 0, -1.2}, {0, 0, -2}, 0.03);
  for (const double s : {1.0, -1.0}) {
    const Side side = s > 0 ? Side::left : Side::right;
    const std::string word = s > 0 ? ".L" : ".R";
    rig.add_box(head, {s * 0.3, 0, 0.8}, {s * 0.4, 0.05, 1.1}, 0.03);
    const int first = rig.add("TopFlipper" + word, body, {s * 0.2, 0, 0}, Role::fin, side);
    rig.add_box(first, {s * 0.2, 0, 0}, {s * 0.9, -0.1, -0.1}, 0.06);
    const int second = rig.add("MidFlipper" + word, first, {s * 0.9, -0.1, -0.1}, Role::fin, side);
    rig.add_box(second, {s * 0.9, -0.1, -0.1}, {s * 1.5, -0.5, -0.2}, 0.04);
    const int third = rig.add("BottomFlipper" + word, second, {s * 1.5, -0.5, -0.2}, Role::fin, side);
    rig.add_box(third, {s * 1.5, -0.5, -0.2}, {s * 1.8, -0.9, -0.3}, 0.03);
  }
  return rig;
}

// The vertices farthest out, as a search for extremities finds them.
std::vector<uint32_t> tips_of(const FlatMesh& mesh) {
  std::vector<uint32_t> out;
  for (const glm::dvec3 way : {glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0.3, 0.2, 1),
                               glm::dvec3(-0.3, 0.2, 1), glm::dvec3(0, 0, -1)}) {
    uint32_t best = 0;
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v)
      if (glm::dot(mesh.positions[v], way) > glm::dot(mesh.positions[best], way)) best = v;
    out.push_back(best);
  }
  return out;
}

Landmarks landmarks_of(const Model& model) {
  const FlatMesh mesh = flatten(model);
  return find_landmarks({model, mesh, tips_of(mesh), nullptr});
}

Suggestion suggest(const Model& source, const Model& target) {
  const FlatMesh a = flatten(source), b = flatten(target);
  return suggest_pairs({source, a, tips_of(a), nullptr}, {target, b, tips_of(b), nullptr});
}

bool has_pair(const Suggestion& suggestion, const std::string& name) {
  for (const auto& pair : suggestion.pairs)
    if (pair.name == name) return true;
  return false;
}

std::string notes_of(const Suggestion& suggestion) {
  std::string out;
  for (const std::string& note : suggestion.notes) out += note + "\n";
  return out;
}

TEST(Landmarks, FinsAreNoFeetAndHornsNoHands) {
  const Landmarks found = landmarks_of(model_of(make_ray()));
  EXPECT_TRUE(found.known.swims());
  EXPECT_EQ(found.leg_pairs, 0u);
  for (const char* name : {"foot left", "foot right", "hand left", "hand right"})
    EXPECT_EQ(found.get(name), nullptr) << name;
  for (const auto& [name, x] : {std::pair{"fin left", 1.8}, std::pair{"fin right", -1.8}}) {
    ASSERT_NE(found.get(name), nullptr) << name;
    EXPECT_NEAR(found.get(name)->position.x, x, 0.06) << name;
    EXPECT_NEAR(found.get(name)->position.y, -0.9, 0.06) << name;
    EXPECT_EQ(found.get(name)->found, "tip of the fin joints");
  }
  ASSERT_NE(found.get("tail"), nullptr);
  EXPECT_LT(found.get("tail")->position.z, -1.9);
}

// Without names the shape says so: the only limbs at the ground reach farther aside than down.
TEST(Landmarks, ARayWithoutNamesLiesOnFins) {
  Rig rig = make_ray();
  for (std::size_t j = 0; j < rig.joints.size(); ++j) rig.joints[j].name = std::to_string(j);
  const Landmarks found = landmarks_of(model_of(rig));
  EXPECT_TRUE(found.known.knows_parts());
  EXPECT_TRUE(found.known.swims());
  EXPECT_EQ(found.get("foot left"), nullptr);
  EXPECT_NE(found.get("fin left"), nullptr);
  // a tyrannosaur without names stands on the only limbs at the ground
  Rig beast = make_beast("tyrannosaur", true);
  for (std::size_t j = 0; j < beast.joints.size(); ++j) beast.joints[j].name = std::to_string(j);
  const Landmarks legs = landmarks_of(model_of(beast));
  EXPECT_FALSE(legs.known.swims());
  EXPECT_NE(legs.get("foot left"), nullptr);
}

TEST(Landmarks, TheTipOfAWingIsNoHand) {
  const Landmarks found = landmarks_of(model_of(make_beast("bird", true)));
  EXPECT_FALSE(found.known.swims());
  EXPECT_EQ(found.leg_pairs, 1u);
  EXPECT_EQ(found.get("hand left"), nullptr);
  EXPECT_EQ(found.get("hand right"), nullptr);
  for (const auto& [name, x] : {std::pair{"wing left", 1.7}, std::pair{"wing right", -1.7}}) {
    ASSERT_NE(found.get(name), nullptr) << name;
    EXPECT_NEAR(found.get(name)->position.x, x, 0.06) << name;
  }
}

// What only the shape says is a hand has another one on the other side: a pack on one side is none.
TEST(Landmarks, AHandByShapeNeedsOneOnTheOtherSide) {
  Rig rig = make_beast("tyrannosaur", true);
  for (std::size_t j = 0; j < rig.joints.size(); ++j) {
    if (rig.joints[j].role != Role::arm) continue;
    rig.joints[j].name = "weapon" + std::to_string(j);
    for (std::size_t v = 0; v < rig.points.size(); ++v) {
      if (rig.owners[v] != static_cast<int>(j)) continue;
      if (rig.joints[j].side == Side::right) rig.points[v].x *= 0.4;
      if (rig.joints[j].side == Side::left) rig.points[v].x *= 4;
    }
  }
  const Landmarks found = landmarks_of(model_of(rig));
  ASSERT_EQ(found.leg_pairs, 1u);
  EXPECT_EQ(found.get("hand right"), nullptr);
  EXPECT_EQ(found.get("hand left"), nullptr);
}

// A fish has no ground under it, and its fins move arms.
TEST(SuggestPairs, FinsLeadHandsAndAFishHasNoGround) {
  const Model ray = model_of(make_ray(), "ray.glb"), man = model_of(make_biped("mixamo", {}), "man.glb");
  const Suggestion on_man = suggest(ray, man);
  EXPECT_TRUE(has_pair(on_man, "fin left") && has_pair(on_man, "fin right")) << notes_of(on_man);
  EXPECT_FALSE(has_pair(on_man, "foot left") || has_pair(on_man, "hand left"));
  EXPECT_EQ(on_man.file["settings"]["ground"], false);
  EXPECT_NE(notes_of(on_man).find("ray has fins and no legs: there is no ground"), std::string::npos);
  // Hands that hang would fold fins down.
  const Suggestion on_ray = suggest(man, ray);
  EXPECT_FALSE(has_pair(on_ray, "hand left") || has_pair(on_ray, "foot left")) << notes_of(on_ray);
  EXPECT_EQ(on_ray.file["settings"]["ground"], false);
  // Strokes of fins would splay front legs, whose steps paddle with fins.
  const Model horse = model_of(make_beast("horse", true), "horse.glb");
  EXPECT_FALSE(has_pair(suggest(ray, horse), "fin left"));
  EXPECT_TRUE(has_pair(suggest(horse, ray), "front foot left"));
  EXPECT_FALSE(suggest(man, man).file.contains("settings"));
}

// A slab without a skeleton, between four corners.
Model make_slab(const glm::dvec3 (&corners)[4]) {
  constexpr uint32_t n = 9;
  std::vector<glm::dvec3> positions;
  std::vector<uint32_t> triangles;
  const auto face = [&](uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    triangles.insert(triangles.end(), {a, b, c, a, c, d});
  };
  for (const double y : {0.0, 0.3})
    for (uint32_t i = 0; i < n; ++i)
      for (uint32_t k = 0; k < n; ++k) {
        const double s = i / (n - 1.0), t = k / (n - 1.0);
        const glm::dvec3 place =
            (1 - s) * ((1 - t) * corners[0] + t * corners[1]) + s * ((1 - t) * corners[3] + t * corners[2]);
        positions.push_back((y > 0 ? 1 : 0.9) * place + glm::dvec3(0, y, 0));  // wider above: one widest place
      }
  const auto at = [&](uint32_t layer, uint32_t i, uint32_t k) { return layer * n * n + i * n + k; };
  for (uint32_t i = 0; i + 1 < n; ++i) {
    for (uint32_t k = 0; k + 1 < n; ++k) {
      face(at(0, i, k), at(0, i + 1, k), at(0, i + 1, k + 1), at(0, i, k + 1));
      face(at(1, i, k), at(1, i, k + 1), at(1, i + 1, k + 1), at(1, i + 1, k));
    }
    for (const uint32_t end : {0u, n - 1}) {
      face(at(0, i, end), at(0, i + 1, end), at(1, i + 1, end), at(1, i, end));
      face(at(0, end, i), at(0, end, i + 1), at(1, end, i + 1), at(1, end, i));
    }
  }
  return hf_gltf::make_model("slab.glb", positions, triangles);
}

// The foremost place is the widest one on the left too. A fin on the right alone would beat without the other.
TEST(SuggestPairs, APlaceThatIsLeftOutTakesItsMirrorImageAlong) {
  const Model even = make_slab({{0, 0, -1}, {1.5, 0, 0.1}, {0, 0, 2}, {-1.5, 0, 0.1}}),
              odd = make_slab({{0, 0, -1}, {1.5, 0, 2}, {0, 0, 0.8}, {-1.5, 0, 0}});
  const auto run = [](const Model& model) {
    const FlatMesh mesh = flatten(model);
    return suggest_pairs({model, mesh, {}, nullptr}, {model, mesh, {}, nullptr});
  };
  const Suggestion both = run(even), none = run(odd);
  EXPECT_TRUE(has_pair(both, "fin left") && has_pair(both, "fin right")) << notes_of(both);
  EXPECT_FALSE(has_pair(none, "fin left") || has_pair(none, "fin right")) << notes_of(none);
  EXPECT_TRUE(has_pair(none, "nose") && has_pair(none, "tail"));
  EXPECT_NE(notes_of(none).find(
                "\"fin right\" lies inside other places on one of the two; it is left out, as its mirror image is"),
            std::string::npos)
      << notes_of(none);
}

// Joints lead a man's arms by the fins of a ray. His legs stand, and the figures say that nothing leads them.
TEST(SkeletonPair, FinsLeadArmsAndLegsStand) {
  const Model ray = model_of(make_ray(), "ray.glb"), man = model_of(make_biped("mixamo", {}), "man.glb");
  const FlatMesh a = flatten(ray), b = flatten(man);
  const hf_gltf::SkeletonPair pair({ray, a, nullptr, nullptr}, {man, b, nullptr, nullptr});
  EXPECT_EQ(pair.refusal(), "");
  EXPECT_EQ(pair.limbs_text(), "0 legs and 2 arms");
  const hf_gltf::PoseFit fit = pair.fit({}, {});
  EXPECT_EQ(fit.source_limbs, 2u);
  EXPECT_EQ(fit.target_limbs, 4u);
  EXPECT_NEAR(fit.unmatched, 0.5, 1e-9);
  EXPECT_TRUE(fit.flaps);
  // the other way nothing corresponds: arms do not lead fins
  const hf_gltf::SkeletonPair back({man, b, nullptr, nullptr}, {ray, a, nullptr, nullptr});
  EXPECT_NE(back.refusal().find("no pair of arms, legs, wings or fins in common"), std::string::npos);
  const hf_gltf::SkeletonPair itself({ray, a, nullptr, nullptr}, {ray, a, nullptr, nullptr});
  EXPECT_EQ(itself.refusal(), "");
  EXPECT_EQ(itself.limbs_text(), "2 wings or fins");
}

}  // namespace
}  // namespace hf_test

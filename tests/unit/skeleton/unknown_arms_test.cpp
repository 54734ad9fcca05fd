// Bodies whose arms have no names: bones of rigid pieces that hang down, as in models that were made of loose parts.
// They are understood as arms, or the pair of bodies says that arms have no partner.
#include <gtest/gtest.h>

#include "gltf/skeleton_pair.h"
#include "rig_model.h"

namespace hf_test {
namespace {

using hf_gltf::flatten;
using hf_gltf::Model;
using hf_gltf::PoseFit;
using hf_gltf::SkeletonPair;

bool is_arm(const RigJoint& joint) {
  return joint.role == Role::arm || joint.role == Role::hand || joint.role == Role::finger ||
         joint.role == Role::shoulder;
}

Rig straight_body() {
  Rig rig = make_biped("mixamo", {});
  for (const auto& [name, side] : {std::pair("mixamorig:LeftArm", 1.0), {"mixamorig:RightArm", -1.0}})
    rig.turn(rig.find(name), {0, 0, 1}, -85 * side);
  return rig;
}

Rig unnamed(Rig rig) {
  int number = 15;
  for (RigJoint& joint : rig.joints)
    if (is_arm(joint)) joint.name = "Bone." + std::to_string(number++);
  return rig;
}

// The body without its arms; each arm is one mesh on a node, or on a joint, that hangs on the chest. shrug: the right
// one is turned aside by degrees.
enum class Hang { on_node, on_joint };
Model pieces(Hang hang, double shrug, bool pivots_at_origin) {
  const Rig whole = straight_body();
  Rig rig;
  std::vector<int> moved(whole.joints.size(), -1);
  for (std::size_t j = 0; j < whole.joints.size(); ++j) {
    if (is_arm(whole.joints[j])) continue;
    moved[j] = static_cast<int>(rig.joints.size());
    rig.joints.push_back(whole.joints[j]);
    int& parent = rig.joints.back().parent;
    parent = parent < 0 ? -1 : moved[static_cast<std::size_t>(parent)];
  }
  std::vector<int> places(whole.points.size(), -1);
  for (std::size_t v = 0; v < whole.points.size(); ++v) {
    const int owner = moved[static_cast<std::size_t>(whole.owners[v])];
    if (owner < 0) continue;
    places[v] = static_cast<int>(rig.points.size());
    rig.points.push_back(whole.points[v]);
    rig.owners.push_back(owner);
  }
  for (std::size_t t = 0; t < whole.triangles.size(); t += 3) {
    if (places[whole.triangles[t]] < 0) continue;
    for (std::size_t c = 0; c < 3; ++c)
      rig.triangles.push_back(static_cast<std::uint32_t>(places[whole.triangles[t + c]]));
  }
  const int chest = rig.find("mixamorig:Spine2");
  std::vector<Rig> arms;
  for (const double s : {1.0, -1.0}) {
    Rig& to = hang == Hang::on_joint ? rig : arms.emplace_back();
    const Vec3 shoulder{s * 0.22, 1.4, 0};
    const int joint =
        to.add(s > 0 ? "Bone.015" : "Bone.021", hang == Hang::on_joint ? chest : -1, shoulder, Role::other);
    to.add_box(joint, shoulder, {s * 0.25, 1.15, 0}, 0.05);
    to.add_box(joint, {s * 0.25, 1.15, 0}, {s * 0.26, 0.85, 0.05}, 0.045);
    if (s < 0) to.turn(joint, {0, 0, 1}, -shrug);
    if (pivots_at_origin) to.joints[static_cast<std::size_t>(joint)].pivot = {};
  }
  const PlacedRig placed(rig, {});
  Model model = make_rig_model(placed, "robot.glb");
  for (const Rig& arm : arms) {  // nodes of no skin below the chest
    std::vector<glm::dvec3> places_of;
    for (const Vec3& p : arm.points) places_of.emplace_back(p.x, p.y, p.z);
    hf_gltf::Node node;
    node.name = arm.joints[0].name;
    node.mesh = static_cast<int>(model.meshes.size());
    node.parent = chest + 1;
    const auto globals = hf_gltf::global_matrices(model, hf_gltf::rest_pose(model));
    node.matrix = glm::inverse(globals[static_cast<std::size_t>(node.parent)]);
    model.meshes.push_back(hf_gltf::make_model(node.name, places_of, arm.triangles).meshes[0]);
    model.nodes[static_cast<std::size_t>(node.parent)].children.push_back(static_cast<int>(model.nodes.size()));
    model.nodes.push_back(node);
  }
  return model;
}

PoseFit fit_of(const Model& target) {
  const Rig rig = make_biped("mixamo", {});
  const PlacedRig placed(rig, {});
  const Model source = make_rig_model(placed, "person.glb");
  const hf_gltf::FlatMesh source_mesh = flatten(source), target_mesh = flatten(target);
  const SkeletonPair pair({source, source_mesh}, {target, target_mesh});
  EXPECT_EQ(pair.refusal(), "");
  return pair.fit({}, {});
}

TEST(UnknownArms, ChainsWithoutNamesThatMirrorEachOtherAreArms) {
  const Rig rig = unnamed(straight_body());
  const PoseFit fit = fit_of(make_rig_model(PlacedRig(rig, {}), "robot.glb"));
  EXPECT_EQ(fit.limbs.size(), 4u);
  EXPECT_EQ(fit.unmatched, 0);
}

// One arm is raised, and its hand holds something.
TEST(UnknownArms, ChainsWithoutNamesInDifferentPosesAreArms) {
  Rig rig = straight_body();
  const int hand = rig.find("mixamorig:RightHand");
  rig.turn(rig.find("mixamorig:RightArm"), {0, 0, 1}, -60);
  rig.turn(rig.find("mixamorig:RightForeArm"), {1, 0, 0}, -40);
  const Vec3 grip = rig.joints[static_cast<std::size_t>(hand)].pivot;
  const int club = rig.add("Bone.044", hand, grip + Vec3{-0.05, 0, 0.05}, Role::other);
  rig.add_box(club, grip, grip + Vec3{-0.1, 0.1, 0.4}, 0.03);
  const PoseFit fit = fit_of(make_rig_model(PlacedRig(unnamed(rig), {}), "robot.glb"));
  EXPECT_EQ(fit.limbs.size(), 4u);
  EXPECT_EQ(fit.unmatched, 0);
}

TEST(UnknownArms, PiecesThatNothingLeadsHaveNoPartner) {
  for (const Hang hang : {Hang::on_node, Hang::on_joint}) {
    for (const double shrug : {0.0, 30.0}) {
      for (const bool at_origin : {false, true}) {
        const PoseFit fit = fit_of(pieces(hang, shrug, at_origin));
        const bool understood = fit.limbs.size() == 4 && !at_origin;  // a turn about the origin throws an arm away
        EXPECT_TRUE(understood || fit.unmatched >= 0.5)
            << (hang == Hang::on_node ? "node " : "joint ") << shrug << " " << at_origin << ": " << fit.limbs.size()
            << " limbs, " << fit.unmatched;
        std::printf("%s %g %d: %zu limbs, %g\n", hang == Hang::on_node ? "node" : "joint", shrug, at_origin,
                    fit.limbs.size(), fit.unmatched);
      }
    }
  }
}

// A pack, a cape and pouches at the hips are no arms.
TEST(UnknownArms, WhatABodyWithoutArmsWearsIsNoArm) {
  Rig rig = straight_body();
  const int chest = rig.find("mixamorig:Spine2"), hips = rig.find("mixamorig:Hips");
  for (std::size_t v = 0; v < rig.points.size(); ++v)
    if (is_arm(rig.joints[static_cast<std::size_t>(rig.owners[v])])) rig.owners[v] = chest;
  const int pack = rig.add("pack", chest, {0, 1.4, -0.1}, Role::other);
  rig.add_block(pack, {-0.15, 1, -0.3}, {0.17, 1.45, -0.11});
  const int skirt = rig.add("Bone.101", hips, {0.16, 1, 0}, Role::other);
  rig.add_block(skirt, {0.17, 0.6, -0.1}, {0.2, 1, 0.1});
  const int pouch = rig.add("Bone.102", chest, {-0.2, 1.2, 0}, Role::other);
  rig.add_block(pouch, {-0.25, 1.15, -0.05}, {-0.18, 1.25, 0.05});
  const PoseFit fit = fit_of(make_rig_model(PlacedRig(rig, {}), "armless.glb"));
  EXPECT_EQ(fit.limbs.size(), 2u);
  EXPECT_EQ(fit.unmatched, 0);
}

}  // namespace
}  // namespace hf_test

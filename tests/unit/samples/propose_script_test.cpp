// Proposals as a list and as a script, and handles by name: no model is read, all is made here.
#include "deform/propose_script.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace samples;

ProposedHandle handle(const std::string& name, int32_t reason, bool pinned) {
  ProposedHandle out;
  out.proposal = hf_handle_proposal();
  out.proposal.reason = reason;
  out.proposal.pinned = pinned;
  out.entry.name = name;
  out.entry.offered = !pinned;
  out.entry.vertices = {1, 2};
  return out;
}

std::vector<std::string> dragged(const ScriptFile& script) {
  std::vector<std::string> out;
  for (const Step& step : script.steps)
    for (const auto& [name, motion] : step.drag)
      if (out.empty() || out.back() != name) out.push_back(name);
  return out;
}

// A column of boxes' corners: a trunk at the bottom, a head on it, and an arm that leads along x.
FlatMesh figure() {
  FlatMesh mesh;
  const auto add = [&](const glm::dvec3& low, const glm::dvec3& size) {
    for (int corner = 0; corner < 8; ++corner)
      mesh.positions.push_back(low + size * glm::dvec3(corner & 1, (corner >> 1) & 1, corner >> 2));
  };
  add({-1, 0, -1}, {2, 6, 2});           // the trunk: 0 to 7
  add({-1, 6.5, -1}, {2, 2, 2});         // the head: 8 to 15
  add({5, 4.75, -0.25}, {1, 0.5, 0.5});  // the hand: 16 to 23
  mesh.weld();
  return mesh;
}

ProposedHandle part(const FlatMesh& mesh, const std::string& name, uint32_t first, int32_t role, bool pinned) {
  ProposedHandle out = handle(name, pinned ? HF_HANDLE_REASON_MIDDLE : HF_HANDLE_REASON_TIP, pinned);
  out.proposal.role = role;
  out.entry.vertices.clear();
  for (uint32_t v = first; v < first + 8; ++v) {
    out.entry.vertices.push_back(v);
    out.place += mesh.positions[v] / 8.0;
  }
  return out;
}

// The head of a figure was lifted off its neck by the length of its trunk.
TEST(ProposeScript, a_hand_comes_first_and_no_limb_stretches) {
  const FlatMesh mesh = figure();
  const std::vector<ProposedHandle> handles = {part(mesh, "trunk", 0, HF_ROLE_SPINE, true),
                                               part(mesh, "head", 8, HF_ROLE_HEAD, false),
                                               part(mesh, "hand", 16, HF_ROLE_HAND, false)};
  const ScriptFile script = propose_script(mesh, handles, {0, 1, 0}, 3);
  EXPECT_EQ(dragged(script), (std::vector<std::string>{"hand", "head"}));
  for (const Step& step : script.steps) {
    if (step.label == "hand dragged") {
      const MotionEntry& motion = step.drag.at("hand");
      ASSERT_TRUE(motion.has_pivot);
      const glm::dvec3 hand(5.5, 5, 0), low(-1, 0, -1), pivot = low + motion.pivot * glm::dvec3(7, 8.5, 2);
      EXPECT_LT(glm::distance(pivot, glm::dvec3(1, 6, 0)), 1.1) << "about the shoulder, so the arm keeps its length";
      const glm::dvec3 moved = pivot + glm::angleAxis(glm::radians(motion.degrees), motion.axis) * (hand - pivot);
      EXPECT_GT(moved.y, hand.y + 0.5) << "it is raised";
      EXPECT_LT(glm::distance(moved, hand), 0.14 * SurfaceBox(mesh).diagonal());
    }
    if (step.label == "head dragged") {
      const MotionEntry& motion = step.drag.at("head");
      EXPECT_EQ(motion.degrees, 20) << "a head tilts";
      ASSERT_TRUE(motion.has_pivot);
      EXPECT_NEAR(motion.pivot.y * 8.5, 6.25, 0.3) << "about the neck";
    }
  }
}

// The spine of a fox was pulled out of its back as the third "tip".
TEST(ProposeScript, drags_tips_and_no_joints) {
  const std::vector<ProposedHandle> handles = {
      handle("foot", HF_HANDLE_REASON_FOOT, true), handle("tail", HF_HANDLE_REASON_TIP, false),
      handle("spine", HF_HANDLE_REASON_JOINT, false), handle("head", HF_HANDLE_REASON_TIP, false)};
  const FlatMesh none = figure();
  const ScriptFile script = propose_script(none, handles, {0, 1, 0}, 3);
  EXPECT_EQ(dragged(script), (std::vector<std::string>{"tail", "head"}));
  EXPECT_EQ(script.steps[1].add.size(), 3u) << "all that is offered is shown";
  EXPECT_EQ(dragged(propose_script(none, handles, {0, 1, 0}, 1)), (std::vector<std::string>{"tail"}));
  EXPECT_EQ(dragged(propose_script(none, {handles[0], handles[2]}, {0, 1, 0}, 3)), (std::vector<std::string>{"spine"}))
      << "without a tip joints are dragged";
  std::vector<ProposedHandle> flat = {handles[1], handles[2]};
  flat[1].proposal.role = HF_ROLE_HEAD;
  EXPECT_EQ(dragged(propose_script(none, flat, {0, 1, 0}, 3)), (std::vector<std::string>{"tail", "spine"}))
      << "a head that does not protrude is a joint";
}

// "The vertex belongs to handle 0 already" names a number that no script has.
TEST(Posable, names_the_handle_that_has_a_vertex_already) {
  SurfaceMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  const FlatMesh flat = to_flat_mesh(mesh);
  Posable posable(flat, {});
  HandleEntry first, second;
  first.name = "hand";
  first.vertices = {0, 1};
  second.name = "arm";
  second.vertices = {1, 2};
  posable.add({first});
  try {
    posable.add({second});
    ADD_FAILURE() << "the regions overlap";
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.rfind("handle \"arm\": ", 0), 0u) << text;
    EXPECT_NE(text.find("the vertex belongs to handle \"hand\" already"), std::string::npos) << text;
  }
}

// A line was cut at 200 letters, and names of ten letters moved the columns.
TEST(ProposeScript, lists_one_whole_line_for_each_handle_in_columns) {
  const std::string text = list_of(
      {handle("tail", HF_HANDLE_REASON_TIP, false), handle(std::string(300, 'n'), HF_HANDLE_REASON_FOOT, true)});
  ASSERT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
  const size_t second = text.find('\n') + 1;
  EXPECT_EQ(text.back(), '\n');
  EXPECT_EQ(text.find("vertex"), text.find("vertex", second) - second);
  EXPECT_NE(text.find("region 2\n", second), std::string::npos);
}

}  // namespace

// Proposals as a list and as a script: no model is read, the proposals are made here.
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

// The spine of a fox was pulled out of its back as the third "tip".
TEST(ProposeScript, drags_tips_and_no_joints) {
  const std::vector<ProposedHandle> handles = {
      handle("foot", HF_HANDLE_REASON_FOOT, true), handle("tail", HF_HANDLE_REASON_TIP, false),
      handle("spine", HF_HANDLE_REASON_JOINT, false), handle("head", HF_HANDLE_REASON_TIP, false)};
  const ScriptFile script = propose_script(handles, {0, 1, 0}, 3);
  EXPECT_EQ(dragged(script), (std::vector<std::string>{"tail", "head"}));
  EXPECT_EQ(script.steps[1].add.size(), 3u) << "all that is offered is shown";
  EXPECT_EQ(dragged(propose_script(handles, {0, 1, 0}, 1)), (std::vector<std::string>{"tail"}));
  EXPECT_EQ(dragged(propose_script({handles[0], handles[2]}, {0, 1, 0}, 3)), (std::vector<std::string>{"spine"}))
      << "without a tip joints are dragged";
  std::vector<ProposedHandle> flat = {handles[1], handles[2]};
  flat[1].proposal.role = HF_ROLE_HEAD;
  EXPECT_EQ(dragged(propose_script(flat, {0, 1, 0}, 3)), (std::vector<std::string>{"tail", "spine"}))
      << "a head that does not protrude is a joint";
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

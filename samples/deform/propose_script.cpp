// See propose_script.h.
#include "deform/propose_script.h"

#include <algorithm>
#include <cstdio>

#include "deform/model_skeleton.h"

namespace samples {

using namespace hf_gltf;
namespace {

const char* reason_name(int32_t reason) {
  switch (reason) {
    case HF_HANDLE_REASON_FOOT:
      return "foot";
    case HF_HANDLE_REASON_TIP:
      return "tip";
    case HF_HANDLE_REASON_END:
      return "end";
    case HF_HANDLE_REASON_JOINT:
      return "joint";
    default:
      return "middle";
  }
}

// "hand left"; empty where no role is known.
std::string role_name(const hf_handle_proposal& proposal) {
  static constexpr const char* roles[] = {"",     "spine", "neck",   "head", "jaw",     "shoulder",
                                          "arm",  "hand",  "finger", "leg",  "foot",    "toe",
                                          "tail", "wing",  "ear",    "eye",  "antenna", "fin"};
  static constexpr const char* sides[] = {"", " left", " right"};
  return std::string(roles[proposal.role]) + sides[proposal.side];
}

// A joint inside a limb or the trunk is none: pulled out, it makes a spike of the surface around it. Heads, hands and
// feet that do not protrude are proposed as joints too.
bool is_tip(const ProposedHandle& handle) {
  const hf_handle_proposal& p = handle.proposal;
  return handle.entry.offered && (p.reason != HF_HANDLE_REASON_JOINT || p.role == HF_ROLE_HEAD ||
                                  p.role == HF_ROLE_HAND || p.role == HF_ROLE_FOOT);
}

}  // namespace

std::vector<ProposedHandle> propose(const PosableMesh& mesh, const Posable& posable, const glm::dvec3& up) {
  const ModelSkeleton skeleton(mesh.model, mesh.flat);
  std::vector<uint32_t> regions(mesh.flat.positions.size());
  hf_handle_proposals_desc desc = HF_INIT(hf_handle_proposals_desc);
  desc.skeleton = skeleton.get();
  for (int c = 0; c < 3; ++c) desc.up[c] = up[c];
  desc.out_regions = regions.data();
  std::vector<hf_handle_proposal> found(HF_HANDLE_LIMIT);
  uint32_t count = 0;
  expect_ok(hf_surface_propose_handles(posable.surface(), &desc, HF_HANDLE_LIMIT, found.data(), &count),
            "the proposals");
  std::map<std::string, int> numbers;
  std::vector<ProposedHandle> out(count);
  for (uint32_t i = 0; i < count; ++i) {
    ProposedHandle& handle = out[i];
    const hf_handle_proposal& proposal = handle.proposal = found[i];
    HandleEntry& entry = handle.entry;
    handle.place = {proposal.position[0], proposal.position[1], proposal.position[2]};
    entry.offered = proposal.pinned == 0;
    entry.following = proposal.following;
    if (proposal.joint != HF_NO_INDEX) entry.name = mesh.model.nodes[proposal.joint].name;
    const bool named = !entry.name.empty();
    if (!named) entry.name = reason_name(proposal.reason);
    const int number = ++numbers[entry.name];
    if (!named || number > 1) entry.name += " " + std::to_string(number);
  }
  for (uint32_t v = 0; v < regions.size(); ++v) {
    if (regions[v] != HF_NO_INDEX) out[regions[v]].entry.vertices.push_back(v);
  }
  return out;
}

std::string list_of(const std::vector<ProposedHandle>& handles) {
  size_t width = 0;
  for (const ProposedHandle& handle : handles) width = std::max(width, handle.entry.name.size());
  std::string out;
  for (const ProposedHandle& handle : handles) {
    char line[160];
    const hf_handle_proposal& p = handle.proposal;
    std::snprintf(line, sizeof line, " %-7s %-13s vertex %-7u radius %-10.4g length %-10.4g region %zu\n",
                  p.pinned ? "holds" : "offered", role_name(p).c_str(), p.vertex, p.radius, p.length,
                  handle.entry.vertices.size());
    out += "  " + handle.entry.name + std::string(width - handle.entry.name.size(), ' ') + line;
  }
  return out;
}

Step hold_step(const std::vector<ProposedHandle>& handles) {
  Step step;
  step.label = "what holds";
  for (const ProposedHandle& handle : handles) {
    if (!handle.entry.offered) step.add.push_back(handle.entry);
  }
  return step;
}

ScriptFile propose_script(const std::vector<ProposedHandle>& handles, const glm::dvec3& up, size_t tips) {
  ScriptFile script;
  script.up = up;
  // from above the side, whatever is up
  script.view = std::abs(up.z) > 0.5 ? glm::dvec3(0.8, 1.0, 0.35 * up.z) : glm::dvec3(0.8, 0.35 * up.y, 1.0);
  if (std::abs(up.x) > 0.5) script.view = {0.35 * up.x, 0.8, 1.0};
  script.steps.push_back(hold_step(handles));
  Step all, gone;
  all.label = "proposed";
  glm::dvec3 middle(0);
  for (const ProposedHandle& handle : handles) {
    middle += handle.place / static_cast<double>(handles.size());
    if (!handle.entry.offered) continue;
    all.add.push_back(handle.entry);
    gone.remove.push_back(handle.entry.name);
  }
  if (!all.add.empty()) {
    script.steps.insert(script.steps.end(), {all, gone});
    script.steps.back().label.clear();
  }
  const bool any_tip = std::any_of(handles.begin(), handles.end(), is_tip);
  for (const ProposedHandle& handle : handles) {
    if (!handle.entry.offered || (any_tip && !is_tip(handle)) || tips == 0) continue;
    --tips;
    constexpr double rise = 0.12, outward = 0.05;  // of the diagonal: a change that shows and tears nothing
    const glm::dvec3 away = handle.place - middle;
    Step add, drag, back, leave;
    add.add.push_back(handle.entry);
    MotionEntry motion;
    motion.move = rise * up;
    if (glm::length(away) > 0) motion.move += outward * glm::normalize(away);
    drag.drag[handle.entry.name] = motion;
    drag.seconds = 1;
    drag.label = handle.entry.name + " dragged";
    back.drag[handle.entry.name] = MotionEntry();
    back.seconds = 0.5;
    leave.remove.push_back(handle.entry.name);
    script.steps.insert(script.steps.end(), {add, drag, back, leave});
  }
  return script;
}

}  // namespace samples

// See propose_script.h.
#include "deform/propose_script.h"

#include <algorithm>
#include <cstdio>

#include "deform/propose_names.h"
#include "gltf/animate.h"

namespace samples {

using namespace hf_gltf;
namespace {

// The joints of all skins, with the nearest ancestor that is a joint as parent.
struct Skeleton {
  std::vector<double> places;
  std::vector<uint32_t> parents;
  std::vector<std::string> names;
};

Skeleton skeleton_of(const Model& model) {
  std::vector<uint32_t> number(model.nodes.size(), HF_NO_INDEX);
  std::vector<int> joints;
  for (const Skin& skin : model.skins) {
    for (const int joint : skin.joints) {
      uint32_t& n = number[static_cast<size_t>(joint)];
      if (n != HF_NO_INDEX) continue;
      n = static_cast<uint32_t>(joints.size());
      joints.push_back(joint);
    }
  }
  Skeleton out;
  const std::vector<glm::dmat4> globals = global_matrices(model, rest_pose(model));
  for (const int joint : joints) {
    const Node& node = model.nodes[static_cast<size_t>(joint)];
    const glm::dvec4 place = globals[static_cast<size_t>(joint)][3];
    out.places.insert(out.places.end(), {place.x, place.y, place.z});
    int above = node.parent;
    while (above >= 0 && number[static_cast<size_t>(above)] == HF_NO_INDEX)
      above = model.nodes[static_cast<size_t>(above)].parent;
    out.parents.push_back(above < 0 ? HF_NO_INDEX : number[static_cast<size_t>(above)]);
    out.names.push_back(node.name);
  }
  return out;
}

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

}  // namespace

std::vector<ProposedHandle> propose(const PosableMesh& mesh, const Posable& posable, const glm::dvec3& up) {
  const Skeleton skeleton = skeleton_of(mesh.model);
  hf_handle_proposals_desc desc = HF_INIT(hf_handle_proposals_desc);
  desc.joint_count = static_cast<uint32_t>(skeleton.parents.size());
  desc.joints = skeleton.places.data();
  desc.parents = skeleton.parents.data();
  for (int c = 0; c < 3; ++c) desc.up[c] = up[c];
  std::vector<hf_handle_proposal> found(HF_HANDLE_LIMIT);
  uint32_t count = 0;
  expect_ok(hf_surface_propose_handles(posable.surface(), &desc, HF_HANDLE_LIMIT, found.data(), &count),
            "the proposals");
  found.resize(count);
  const RegionOwners owners(mesh);
  std::map<std::string, int> numbers;
  std::vector<ProposedHandle> out;
  for (const hf_handle_proposal& proposal : found) {
    ProposedHandle handle;
    handle.proposal = proposal;
    if (proposal.joint != HF_NO_INDEX) handle.joint = skeleton.names[proposal.joint];
    handle.entry.has_point = handle.entry.absolute = true;
    handle.entry.point = {proposal.position[0], proposal.position[1], proposal.position[2]};
    handle.entry.radius = proposal.radius;
    const int owner = owners.owner(handle.entry.point, proposal.radius);
    handle.pinned = proposal.pinned != 0 && !owners.hangs_free(owner);
    handle.entry.offered = !handle.pinned;
    handle.entry.name = owners.name(owner);
    const bool named = !handle.entry.name.empty();
    if (!named) handle.entry.name = reason_name(proposal.reason);
    const int number = ++numbers[handle.entry.name];
    if (!named || number > 1) handle.entry.name += " " + std::to_string(number);
    out.push_back(std::move(handle));
  }
  // a body of arms alone stands on what the library says
  if (std::none_of(out.begin(), out.end(), [](const ProposedHandle& handle) { return handle.pinned; })) {
    for (ProposedHandle& handle : out) {
      handle.pinned = handle.proposal.pinned != 0;
      handle.entry.offered = !handle.pinned;
    }
  }
  return out;
}

std::string list_of(const std::vector<ProposedHandle>& handles) {
  std::string out;
  for (const ProposedHandle& handle : handles) {
    char line[160];
    std::snprintf(line, sizeof line, "  %-9s %-7s vertex %-7u radius %-10.4g length %-10.4g", handle.entry.name.c_str(),
                  handle.pinned ? "holds" : "offered", handle.proposal.vertex, handle.proposal.radius,
                  handle.proposal.length);
    out += line + (handle.joint.empty() ? "" : " joint " + handle.joint) + "\n";
  }
  return out;
}

Step hold_step(const std::vector<ProposedHandle>& handles) {
  Step step;
  step.label = "what holds";
  for (const ProposedHandle& handle : handles) {
    if (handle.pinned) step.add.push_back(handle.entry);
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
    middle += handle.entry.point / static_cast<double>(handles.size());
    if (handle.pinned) continue;
    all.add.push_back(handle.entry);
    gone.remove.push_back(handle.entry.name);
  }
  if (!all.add.empty()) {
    script.steps.insert(script.steps.end(), {all, gone});
    script.steps.back().label.clear();
  }
  for (const ProposedHandle& handle : handles) {
    if (handle.pinned || tips == 0) continue;
    --tips;
    constexpr double rise = 0.12, outward = 0.05;  // of the diagonal: a change that shows and tears nothing
    const glm::dvec3 away = handle.entry.point - middle;
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

// See propose_script.h.
#include "deform/propose_script.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

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

namespace {

using Handles = std::vector<ProposedHandle>;

// Places of the vertices, each once: copies at seams must not weigh more.
std::vector<glm::dvec3> places_of(const FlatMesh& mesh, const std::vector<uint32_t>& vertices) {
  std::vector<glm::dvec3> out;
  std::set<uint32_t> seen;
  for (const uint32_t v : vertices)
    if (seen.insert(mesh.welded[v]).second) out.push_back(mesh.positions[v]);
  return out;
}

glm::dvec3 mean_of(const std::vector<glm::dvec3>& places) {
  glm::dvec3 sum(0);
  for (const glm::dvec3& p : places) sum += p / static_cast<double>(places.size());
  return sum;
}

// The end of a region that lies towards a point: the mean of its nearest part. The nearest vertex alone lies on one
// side of a neck; half of a region is no end.
glm::dvec3 end_towards(const FlatMesh& mesh, const std::vector<uint32_t>& vertices, const glm::dvec3& point) {
  constexpr double share = 0.15;  // of the way from the nearest vertex to the farthest
  std::vector<glm::dvec3> places = places_of(mesh, vertices);
  if (places.empty()) return point;
  const auto nearer = [&](const glm::dvec3& a, const glm::dvec3& b) {
    return glm::distance(a, point) < glm::distance(b, point);
  };
  const auto [first, last] = std::minmax_element(places.begin(), places.end(), nearer);
  const double near = glm::distance(*first, point), far = glm::distance(*last, point);
  const double most = near + share * (far - near);
  places.erase(
      std::remove_if(places.begin(), places.end(), [&](const glm::dvec3& p) { return glm::distance(p, point) > most; }),
      places.end());
  return mean_of(places);
}

glm::dvec3 centre_of(const FlatMesh& mesh, const ProposedHandle& handle) {
  const std::vector<glm::dvec3> places = places_of(mesh, handle.entry.vertices);
  return places.empty() ? handle.place : mean_of(places);
}

// Where the limb of a tip begins: the nearest end of what holds, of the trunk where it does. A hand that hangs down is
// nearer to a foot.
glm::dvec3 base_of(const FlatMesh& mesh, const Handles& handles, const glm::dvec3& centre, const glm::dvec3& middle) {
  const auto holds = [&](const ProposedHandle& handle, bool feet) {
    return !handle.entry.offered && (feet || handle.proposal.reason != HF_HANDLE_REASON_FOOT);
  };
  const bool trunk =
      std::any_of(handles.begin(), handles.end(), [&](const ProposedHandle& handle) { return holds(handle, false); });
  glm::dvec3 base = middle;
  bool any = false;
  for (const ProposedHandle& handle : handles) {
    if (!holds(handle, !trunk)) continue;
    const glm::dvec3 end = end_towards(mesh, handle.entry.vertices, centre);
    if (!any || glm::distance(end, centre) < glm::distance(base, centre)) base = end;
    any = true;
  }
  return base;
}

// Turns a limb about its base, so that it does not stretch. A free rotation would turn a long sword round. A limb that
// stands up already, such as a head, tilts.
MotionEntry motion_of(const FlatMesh& mesh, const Handles& handles, const ProposedHandle& handle, const glm::dvec3& up,
                      const glm::dvec3& middle) {
  // Half shows little; double folds a limb over. Heads tilt as far as those of people do.
  constexpr double raised = 35, tilted = 20, degree = 0.017453292519943295;
  constexpr double most = 0.13;     // of the diagonal: a change that shows and tears nothing
  constexpr double upright = 0.7;   // cosine, 45 degrees: above, raising would stretch
  constexpr double outwards = 0.4;  // raises a limb that hangs down away from the body
  const SurfaceBox box(mesh);
  const glm::dvec3 centre = centre_of(mesh, handle), base = base_of(mesh, handles, centre, middle);
  const glm::dvec3 limb = centre - base, away = centre - middle;
  const double length = glm::length(limb);
  MotionEntry motion;
  if (!(length > 0)) return motion;
  glm::dvec3 goal = up, pivot = base;
  if (glm::length(away) > 0) goal += outwards * glm::normalize(away);
  motion.axis = glm::cross(limb, goal);
  motion.degrees = std::min(raised, 2 * std::asin(std::min(1.0, most * box.diagonal() / (2 * length))) / degree);
  if (glm::dot(limb, up) > upright * length * glm::length(up)) {
    pivot = (base + end_towards(mesh, handle.entry.vertices, base)) / 2.0;
    motion.axis = std::abs(up.z) > 0.5 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    motion.degrees = tilted;
  }
  if (!(glm::length(motion.axis) > 0)) return {};
  motion.axis = glm::normalize(motion.axis);
  motion.has_pivot = true;
  const glm::dvec3 side = box.high - box.low;
  for (int c = 0; c < 3; ++c) motion.pivot[c] = side[c] > 0 ? (pivot[c] - box.low[c]) / side[c] : 0;
  return motion;
}

// Arms stand before other tips: they show best what a drag does.
bool is_arm(const ProposedHandle& handle) {
  return handle.proposal.role == HF_ROLE_HAND || handle.proposal.role == HF_ROLE_ARM;
}

}  // namespace

ScriptFile propose_script(const FlatMesh& mesh, const std::vector<ProposedHandle>& handles, const glm::dvec3& up,
                          size_t tips) {
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
  std::vector<const ProposedHandle*> order;
  for (const ProposedHandle& handle : handles)
    if (handle.entry.offered && (!any_tip || is_tip(handle))) order.push_back(&handle);
  std::stable_partition(order.begin(), order.end(), [](const ProposedHandle* handle) { return is_arm(*handle); });
  order.resize(std::min(order.size(), tips));
  for (const ProposedHandle* tip : order) {
    const ProposedHandle& handle = *tip;
    Step add, drag, back, leave;
    add.add.push_back(handle.entry);
    const MotionEntry motion = motion_of(mesh, handles, handle, up, middle);
    drag.drag[handle.entry.name] = motion;
    drag.seconds = 1;
    drag.label = handle.entry.name + " dragged";
    back.drag[handle.entry.name] = motion;
    // without a turn the rotation would become free on the way back
    back.drag[handle.entry.name].degrees = std::min(motion.degrees, 1e-6);
    back.seconds = 0.5;
    leave.remove.push_back(handle.entry.name);
    script.steps.insert(script.steps.end(), {add, drag, back, leave});
  }
  return script;
}

}  // namespace samples

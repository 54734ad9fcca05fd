// See rig_file.h.
#include "deform/rig_file.h"

#include <stdexcept>

#include "gltf/json_file.h"

namespace samples {

using namespace hf_gltf;
namespace {

glm::dvec3 point_of(const JsonReader& json) {
  const std::vector<double> n = json.numbers(3);
  return {n[0], n[1], n[2]};
}

// The keys that say which vertices. noun: what has them.
HandleEntry read_region(const JsonReader& json, const std::string& noun) {
  HandleEntry out;
  if (json.has("vertices")) {
    const JsonReader list = json.at("vertices");
    for (size_t i = 0; i < list.size(); ++i)
      out.vertices.push_back(static_cast<uint32_t>(list.at(i).integer(0, 4000000000ll)));
    if (out.vertices.empty()) list.fail("a region has at least one vertex");
  }
  if (json.has("point")) {
    out.has_point = true;
    out.point = point_of(json.at("point"));
    out.radius = json.at("radius").number(0, 1);
  }
  if (json.has("box")) {
    const JsonReader box = json.at("box");
    if (box.size() != 2) box.fail("expected two corners, [[x, y, z], [x, y, z]]");
    out.has_box = true;
    out.lower = point_of(box.at(0));
    out.upper = point_of(box.at(1));
    out.outside = json.boolean_or("outside", false);
  }
  if (int(!out.vertices.empty()) + int(out.has_point) + int(out.has_box) != 1)
    json.fail(noun + " needs one of vertices, point with radius, or box");
  return out;
}

HandleEntry read_handle(const JsonReader& json) {
  json.expect_only({"name", "layer", "vertices", "point", "radius", "box", "outside"});
  HandleEntry out = read_region(json, "a handle");
  out.name = json.at("name").string();
  if (out.name.empty()) json.at("name").fail("a handle needs a name");
  out.layer = static_cast<uint32_t>(json.integer_or("layer", 0, 7, 0));
  return out;
}

StiffEntry read_stiff(const JsonReader& json) {
  json.expect_only({"stiffness", "vertices", "point", "radius", "box", "outside"});
  return {read_region(json, "a stiff region"), json.at("stiffness").number(1e-4, 1e4)};
}

MotionEntry read_motion(const JsonReader& json) {
  json.expect_only({"turn", "degrees", "about", "move", "bend_from", "bend_to"});
  MotionEntry out;
  if (json.has("turn")) {
    out.axis = point_of(json.at("turn"));
    if (!(glm::length(out.axis) > 1e-9)) json.at("turn").fail("the axis has no length");
    out.axis = glm::normalize(out.axis);
    out.degrees = json.at("degrees").number(-3600, 3600);
  }
  if (json.has("about")) {
    out.has_pivot = true;
    out.pivot = point_of(json.at("about"));
  }
  if (json.has("move")) out.move = point_of(json.at("move"));
  if (json.has("bend_from") || json.has("bend_to")) {
    out.bend = true;
    out.bend_from = point_of(json.at("bend_from"));
    out.bend_to = point_of(json.at("bend_to"));
    if (!json.has("turn")) json.fail("a bend needs turn (the axis) and degrees");
    if (out.has_pivot) json.fail("a bend has no \"about\"");
  }
  return out;
}

Step read_step(const JsonReader& json, bool drags_only) {
  if (drags_only) {
    json.expect_only({"drag", "seconds", "label"});
  } else {
    json.expect_only({"stiff", "add", "remove", "drag", "seconds", "label"});
  }
  Step out;
  out.label = json.string_or("label", "");
  if (json.has("stiff")) {
    const JsonReader list = json.at("stiff");
    for (size_t i = 0; i < list.size(); ++i) out.stiff.push_back(read_stiff(list.at(i)));
  }
  if (json.has("add")) {
    const JsonReader list = json.at("add");
    for (size_t i = 0; i < list.size(); ++i) out.add.push_back(read_handle(list.at(i)));
  }
  if (json.has("remove")) {
    const JsonReader list = json.at("remove");
    for (size_t i = 0; i < list.size(); ++i) out.remove.push_back(list.at(i).string());
  }
  if (json.has("drag")) {
    const JsonReader drag = json.at("drag");
    if (!drag.value().is_object()) drag.fail("expected an object, handle name to motion");
    for (const auto& item : drag.value().items()) out.drag[item.key()] = read_motion(drag.at(item.key()));
  }
  out.seconds = json.number_or("seconds", out.drag.empty() ? 0 : 1);
  if (!(out.seconds >= 0 && out.seconds <= 600)) json.at("seconds").fail("expected 0 to 600");
  return out;
}

double rate_of(const JsonReader& root, double otherwise) {
  const double rate = root.number_or("fps", otherwise);
  if (!(rate >= 1 && rate <= 240)) root.at("fps").fail("expected 1 to 240");
  return rate;
}

}  // namespace

ScriptFile read_script(const std::filesystem::path& file) {
  const JsonFile json(file);
  const JsonReader root = json.root();
  root.expect_only({"about", "mode", "refine", "fps", "view", "up", "steps"});
  ScriptFile out;
  const std::string mode = root.string_or("mode", "smooth");
  if (mode != "smooth" && mode != "paper") root.at("mode").fail("expected \"smooth\" or \"paper\"");
  out.paper = mode == "paper";
  out.refine = root.boolean_or("refine", false);
  out.frame_rate = rate_of(root, 24);
  if (root.has("view")) out.view = point_of(root.at("view"));
  if (root.has("up")) out.up = point_of(root.at("up"));
  const JsonReader steps = root.at("steps");
  for (size_t i = 0; i < steps.size(); ++i) out.steps.push_back(read_step(steps.at(i), false));
  if (out.steps.empty()) steps.fail("a script has at least one step");
  return out;
}

RigFile read_rig(const std::filesystem::path& file) {
  const JsonFile json(file);
  const JsonReader root = json.root();
  root.expect_only({"about", "bands", "fps", "handles", "clips"});
  RigFile out;
  out.bands = static_cast<uint32_t>(root.integer_or("bands", 0, 64, 0));
  out.frame_rate = rate_of(root, 30);
  const JsonReader handles = root.at("handles");
  for (size_t i = 0; i < handles.size(); ++i) {
    out.handles.push_back(read_handle(handles.at(i)));
    if (out.handles.back().layer != 0)
      handles.at(i).fail("a rig has one layer; what higher layers make is no blend of joints");
  }
  if (out.handles.empty()) handles.fail("a rig has at least one handle");
  if (!root.has("clips")) return out;
  const JsonReader clips = root.at("clips");
  for (size_t i = 0; i < clips.size(); ++i) {
    clips.at(i).expect_only({"name", "steps"});
    ClipEntry clip;
    clip.name = clips.at(i).at("name").string();
    const JsonReader steps = clips.at(i).at("steps");
    for (size_t k = 0; k < steps.size(); ++k) clip.steps.push_back(read_step(steps.at(k), true));
    if (clip.steps.empty()) steps.fail("a clip has at least one step");
    out.clips.push_back(clip);
  }
  return out;
}

}  // namespace samples

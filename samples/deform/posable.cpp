// See posable.h.
#include "deform/posable.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <stdexcept>

#include "common/limits.h"
#include "common/links.h"
#include "common/peers.h"
#include "common/rigid_parts.h"
#include "gltf/file_kind.h"
#include "gltf/gltf_read.h"

namespace samples {

using namespace hf_gltf;
namespace {

constexpr double pi = 3.14159265358979323846;

}  // namespace

void expect_ok(hf_result result, const std::string& what) {
  if (result == HF_OK) return;
  hf_error_detail detail;
  hf_error_get_detail(&detail);
  throw std::runtime_error(what + ": " + detail.message);
}

PosableMesh read_posable(const std::filesystem::path& file) {
  PosableMesh out;
  if (is_model(kind_of_file(file))) {
    out.model = read_gltf(file);
    out.flat = flatten(out.model);
    out.surface = to_surface_mesh(out.flat);
  } else {
    out.surface = read_mesh_file(file);
    out.flat = to_flat_mesh(out.surface);
    out.model = make_model(file.stem().string(), out.surface.positions, out.surface.triangles);
  }
  for (const std::string& note : out.model.notes) std::fprintf(stderr, "note: %s\n", note.c_str());
  for (const std::string& warning : out.model.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
  if (out.flat.triangles.empty()) throw std::runtime_error(file.string() + " holds no triangle to pose");
  return out;
}

Posable::Posable(const FlatMesh& mesh, const Options& options) : mesh_(mesh) {
  const SurfaceBox box(mesh);
  lower_ = box.low;
  upper_ = box.high;
  diagonal_ = box.diagonal();
  own_ = !options.on;
  frees_ = !options.given_rotations && !options.paper;
  following_ = options.following;
  if (options.paper && !following_) following_ = 1;  // the paper's scheme has no following
  limb_refine_ = options.limb_refine;
  if (own_)
    make_surface(mesh, options);
  else
    surface_ = options.on->surface_;
  hf_pose_desc pose = HF_INIT(hf_pose_desc);
  pose.band_count = options.bands;
  const hf_result result = create_pose(options.paper, surface_, pose, &pose_);
  if (result != HF_OK) {
    if (own_) hf_surface_destroy(surface_);
    expect_ok(result, "the pose");
  }
  if (options.rigid) keep_rigid(mesh, options.model);
}

void Posable::keep_rigid(const FlatMesh& mesh, const Model* model) {
  if (!model) return;
  rigid_ = rigid_parts(mesh, *model, ModelLinks(model, mesh));
  const std::vector<uint32_t> vertices = rigid_vertices(mesh, rigid_);
  const hf_result result = hf_pose_set_rigid_pieces(pose_, static_cast<uint32_t>(vertices.size()), vertices.data());
  std::printf("%zu rigid pieces\n", vertices.size());
  if (result == HF_OK) return;
  hf_pose_destroy(pose_);
  if (own_) hf_surface_destroy(surface_);
  expect_ok(result, "the rigid pieces");
}

void Posable::make_surface(const FlatMesh& mesh, const Options& options) {
  const std::vector<double> positions = double_positions(mesh.positions);
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.positions = HF_ARRAY(positions.data(), mesh.vertex_count());
  desc.triangles = HF_ARRAY(mesh.triangles.data(), mesh.triangle_count());
  desc.thread_count = options.threads;
  if (options.paper) desc.operator_kind = HF_OPERATOR_COTANGENT;
  const ModelLinks links(options.model, mesh);
  if (options.links) desc.links = &links.desc;
  limit_surface(desc);
  expect_ok(hf_surface_create(&desc, &surface_), "the surface");
}

Posable::~Posable() {
  hf_pose_destroy(pose_);
  if (own_) hf_surface_destroy(surface_);
}

std::vector<uint32_t> Posable::vertices_of(const HandleEntry& entry, const std::string& name) const {
  if (!entry.has_box && !entry.has_point) return entry.vertices;
  std::vector<uint32_t> out;
  const std::set<uint32_t> used(mesh_.triangles.begin(), mesh_.triangles.end());
  if (entry.has_point) {
    const glm::dvec3 centre = at(entry.point);
    for (const uint32_t v : used) {
      if (glm::distance(mesh_.positions[v], centre) <= entry.radius * diagonal_) out.push_back(v);
    }
    if (out.empty()) throw std::runtime_error(name + ": no vertex lies within its radius");
    return out;
  }
  const glm::dvec3 lower = at(entry.lower), upper = at(entry.upper);
  const double slack = 1e-9 * diagonal_;
  for (const uint32_t v : used) {
    const glm::dvec3& p = mesh_.positions[v];
    bool inside = true;
    for (int c = 0; c < 3; ++c) inside = inside && p[c] >= lower[c] - slack && p[c] <= upper[c] + slack;
    if (inside != entry.outside) out.push_back(v);
  }
  if (out.empty()) throw std::runtime_error(name + ": no vertex lies in its box");
  return out;
}

void Posable::stiffen(const std::vector<StiffEntry>& regions) {
  for (const StiffEntry& region : regions) {
    const std::vector<uint32_t> vertices = vertices_of(region.region, "a stiff region");
    const std::vector<double> stiffness(vertices.size(), region.stiffness);
    hf_surface_edit_desc desc = HF_INIT(hf_surface_edit_desc);
    desc.vertex_count = static_cast<uint32_t>(vertices.size());
    desc.vertices = vertices.data();
    desc.stiffness = stiffness.data();
    hf_surface edited = nullptr;
    expect_ok(hf_surface_edit(surface_, &desc, &edited), "a stiff region");
    const hf_result result = hf_pose_move_to(pose_, edited);
    if (result != HF_OK) hf_surface_destroy(edited);
    expect_ok(result, "a stiff region");
    if (own_) hf_surface_destroy(surface_);
    own_ = true;
    surface_ = edited;
  }
}

// The library counts handles; the script names them.
void Posable::expect_added(hf_result result, const std::string& name) const {
  if (result == HF_OK) return;
  hf_error_detail detail;
  hf_error_get_detail(&detail);
  std::string message = detail.message;
  for (const Live& live : live_) {
    const std::string number = "belongs to handle " + std::to_string(live.number) + " ";
    const size_t at = message.find(number);
    if (at == std::string::npos) continue;
    message.replace(at, number.size(), "belongs to handle \"" + live.name + "\" ");
    break;
  }
  throw std::runtime_error("handle \"" + name + "\": " + message);
}

void Posable::add(const std::vector<HandleEntry>& handles) {
  for (const HandleEntry& entry : handles) {
    for (const Live& live : live_) {
      if (live.name == entry.name) throw std::runtime_error("there is a handle \"" + entry.name + "\" already");
    }
    Live live;
    live.name = entry.name;
    live.entry = entry;
    hf_handles_desc desc = HF_INIT(hf_handles_desc);
    desc.handle_count = 1;
    desc.layer = entry.layer;
    const glm::dvec3 point = at(entry.point);
    const double xyz[3] = {point.x, point.y, point.z}, radius = entry.radius * diagonal_;
    uint32_t count = 0;
    if (entry.has_point) {
      desc.points = xyz;
      desc.radii = &radius;
    } else {
      live.vertices = vertices_of(entry, "handle \"" + entry.name + "\"");
      count = static_cast<uint32_t>(live.vertices.size());
      desc.region_counts = &count;
      desc.region_vertices = live.vertices.data();
    }
    expect_added(hf_pose_add_handles(pose_, &desc, &live.number), entry.name);
    hf_handle_info info = HF_INIT(hf_handle_info);
    expect_ok(hf_pose_get_handle(pose_, live.number, &info), "handle \"" + entry.name + "\"");
    live.centroid = {info.centroid[0], info.centroid[1], info.centroid[2]};
    live_.push_back(live);
  }
}

void Posable::remove(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const auto found = std::find_if(live_.begin(), live_.end(), [&](const Live& live) { return live.name == name; });
    if (found == live_.end()) throw std::runtime_error("there is no handle \"" + name + "\" to remove");
    expect_ok(hf_pose_remove_handles(pose_, 1, &found->number), "removing \"" + name + "\"");
    live_.erase(found);
  }
}

HandlePlace Posable::place(const Live& live, const MotionEntry& motion, double amount) const {
  const double angle = amount * motion.degrees * pi / 180;
  HandlePlace out;
  out.rotation = glm::angleAxis(angle, motion.axis);
  if (motion.bend) {
    const glm::dvec3 from = at(motion.bend_from), to = at(motion.bend_to);
    const double length = glm::length(to - from);
    if (!(length > 0)) throw std::runtime_error("handle \"" + live.name + "\": bend_from and bend_to are one point");
    const glm::dvec3 along = (to - from) / length, side = glm::cross(motion.axis, along);
    glm::dvec3 end = to;
    if (std::abs(angle) > 1e-9) end = from + length / angle * (std::sin(angle) * along + (1 - std::cos(angle)) * side);
    out.translation = out.rotation * (live.centroid - to) + end - live.centroid;
  } else if (motion.has_pivot) {
    const glm::dvec3 pivot = at(motion.pivot);
    out.translation = out.rotation * (live.centroid - pivot) + pivot - live.centroid;
  }
  out.translation += amount * diagonal_ * motion.move;
  return out;
}

void Posable::begin(const Step& step) {
  for (Live& live : live_) live.moving = false;
  for (const auto& [name, motion] : step.drag) {
    const auto found = std::find_if(live_.begin(), live_.end(), [&](const Live& live) { return live.name == name; });
    if (found == live_.end()) throw std::runtime_error("there is no handle \"" + name + "\" to drag");
    found->before = found->motion;
    found->motion = motion;
    found->from = found->now;
    found->moving = true;
    found->from_place = false;
    if (!found->dragged && found->entry.layer == 0) {
      const std::string what = "dragging \"" + name + "\"";
      const double following = following_.value_or(found->entry.following);
      if (following < 1) expect_ok(hf_pose_set_following(pose_, 1, &found->number, following), what);
      if (limb_refine_ > 0)
        expect_ok(hf_pose_set_limb_refine(pose_, 1, &found->number, static_cast<int32_t>(limb_refine_)), what);
      found->dragged = true;
    }
    const bool free = frees_ && motion.degrees == 0 && !motion.bend;
    if (free == found->free_rotation) continue;
    expect_ok(hf_pose_set_free_rotations(pose_, 1, &found->number, free), "dragging \"" + name + "\"");
    found->free_rotation = free;
    if (free) continue;
    // the given rotation begins as the handle stands
    hf_handle_info info = HF_INIT(hf_handle_info);
    expect_ok(hf_pose_get_handle(pose_, found->number, &info), "dragging \"" + name + "\"");
    found->from.rotation = glm::dquat(info.rotation[3], info.rotation[0], info.rotation[1], info.rotation[2]);
    found->from_rest = false;
    found->from_place = true;
  }
}

void Posable::drag(double t) {
  for (Live& live : live_) {
    if (!live.moving) continue;
    const MotionEntry &a = live.before, &b = live.motion;
    if (live.from_rest) {
      live.now = place(live, b, t);
    } else if (!live.from_place && a.axis == b.axis && a.bend == b.bend && a.has_pivot == b.has_pivot &&
               a.pivot == b.pivot) {
      MotionEntry between = b;
      between.degrees = (1 - t) * a.degrees + t * b.degrees;
      between.move = (1 - t) * a.move + t * b.move;
      live.now = place(live, between, 1);
    } else {
      const HandlePlace to = place(live, b, 1);
      live.now = {glm::slerp(live.from.rotation, to.rotation, t), (1 - t) * live.from.translation + t * to.translation};
    }
    if (t >= 1) live.from_rest = false;
    hf_transform transform;
    const glm::dquat& q = live.now.rotation;
    const glm::dvec3& m = live.now.translation;
    const double rotation[4] = {q.x, q.y, q.z, q.w}, translation[3] = {m.x, m.y, m.z};
    std::copy_n(rotation, 4, transform.rotation);
    std::copy_n(translation, 3, transform.translation);
    expect_ok(hf_pose_set_transforms(pose_, 1, &live.number, &transform), "moving \"" + live.name + "\"");
  }
}

void Posable::deform(Refine refine, std::vector<double>& positions, std::vector<float>& normals, uint32_t iterations) {
  positions.resize(3 * mesh_.positions.size());
  normals.resize(positions.size());
  hf_deform_desc desc = HF_INIT(hf_deform_desc);
  desc.positions = HF_ARRAY_OUT(positions.data(), mesh_.positions.size());
  desc.normals = HF_ARRAY_OUT(normals.data(), mesh_.positions.size());
  desc.refine = refine != Refine::none;
  desc.refine_from_last = refine == Refine::from_last;
  desc.iteration_count = iterations;
  expect_ok(hf_pose_deform(pose_, &desc, nullptr), "a frame");
}

std::vector<uint32_t> Posable::region_of(const Live& live) const {
  if (!live.vertices.empty()) return live.vertices;
  std::vector<float> field(mesh_.positions.size());
  const hf_array_out wanted = HF_ARRAY_OUT(field.data(), field.size());
  expect_ok(hf_pose_get_field(pose_, live.number, &wanted), "handle \"" + live.name + "\"");
  std::vector<uint32_t> out;
  for (uint32_t v = 0; v < field.size(); ++v) {
    if (field[v] == 1.0f) out.push_back(v);
  }
  return out;
}

std::vector<std::string> Posable::remarks() const {
  std::vector<std::string> out;
  std::vector<uint32_t> all;
  for (const Live& live : live_) {
    const std::vector<uint32_t> region = region_of(live);
    all.insert(all.end(), region.begin(), region.end());
    if (std::string light = light_sentence(surface_, region, live.name); !light.empty())
      out.push_back(std::move(light));
  }
  std::string unreached = unreached_sentence(surface_, all, "handle", "stay at rest");
  if (!live_.empty() && !unreached.empty()) out.push_back(std::move(unreached));
  return out;
}

}  // namespace samples

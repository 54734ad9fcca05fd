// What hf_link_figures and hf_link_pictures share: a model as one mesh, and its surface with or without links.
#pragma once
#include <cmath>
#include <stdexcept>

#include "common/links.h"
#include "common/mesh_file.h"
#include "gltf/animate.h"
#include "gltf/gltf_read.h"
#include "hf/hf.h"

namespace bench {

using namespace samples;
using namespace hf_gltf;

inline void ok(hf_result result) {
  if (result == HF_OK) return;
  hf_error_detail detail;
  hf_error_get_detail(&detail);
  throw std::runtime_error(std::string(detail.function) + ": " + detail.message);
}

struct LinkScene {
  Model model;
  FlatMesh flat;
  std::vector<double> xyz;
  double diagonal = 1;
  bool has_model = false;       // the file is a .glb
  std::vector<uint32_t> piece;  // by vertex, where the caller fills it in
};

inline LinkScene read_scene(const std::string& file) {
  LinkScene out;
  if (file.size() > 4 && file.substr(file.size() - 4) == ".glb") {
    out.model = read_gltf(file);
    out.flat = flatten(out.model);
    out.has_model = true;
  } else {
    out.flat = to_flat_mesh(read_mesh_file(file));
  }
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::dvec3& p : out.flat.positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  out.diagonal = glm::length(high - low);
  out.xyz = double_positions(out.flat.positions);
  return out;
}

// links: NULL for none. Copies within 1e-5 of the box are one vertex.
inline hf_surface make_linked(const LinkScene& scene, const hf_links_desc* links) {
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.positions = HF_ARRAY(scene.xyz.data(), scene.flat.vertex_count());
  desc.triangles = HF_ARRAY(scene.flat.triangles.data(), scene.flat.triangle_count());
  desc.weld = HF_WELD_TOLERANCE;
  desc.weld_tolerance = 1e-5 * scene.diagonal;
  desc.links = links;
  hf_surface surface = nullptr;
  ok(hf_surface_create(&desc, &surface));
  return surface;
}

// A turn about an axis of length 1 through p.
inline glm::dmat4 turn_about(const glm::dvec3& p, const glm::dvec3& axis, double degrees) {
  const double half = degrees / 360 * 3.14159265358979323846;
  const glm::dmat4 rotation = glm::mat4_cast(
      glm::dquat(std::cos(half), std::sin(half) * axis.x, std::sin(half) * axis.y, std::sin(half) * axis.z));
  glm::dmat4 to(1), from(1);
  to[3] = glm::dvec4(p, 1);
  from[3] = glm::dvec4(-p, 1);
  return to * rotation * from;
}

// The model at rest, with one joint moved by `turn`.
inline std::vector<double> turned_by_skin(const LinkScene& scene, int joint, const glm::dmat4& turn) {
  Pose pose = rest_pose(scene.model);
  const std::vector<glm::dmat4> world = global_matrices(scene.model, pose);
  const int parent = scene.model.nodes[size_t(joint)].parent;
  NodePose& moved = pose[size_t(joint)];
  moved.fixed = true;
  moved.matrix = (parent < 0 ? glm::dmat4(1) : glm::inverse(world[size_t(parent)])) * turn * world[size_t(joint)];
  return double_positions(posed_positions(scene.model, scene.flat, pose));
}

}  // namespace bench

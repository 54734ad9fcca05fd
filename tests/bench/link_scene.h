// What hf_link_figures and hf_link_pictures share: a model as one mesh, and its surface with or without links.
#pragma once
#include <stdexcept>

#include "common/links.h"
#include "common/mesh_file.h"
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
    out.model = read_gltf(file), out.flat = flatten(out.model), out.has_model = true;
  } else {
    out.flat = to_flat_mesh(read_mesh_file(file));
  }
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::dvec3& p : out.flat.positions) low = glm::min(low, p), high = glm::max(high, p);
  out.diagonal = glm::length(high - low);
  out.xyz = double_positions(out.flat.positions);
  return out;
}

// links: NULL for none. Copies within 1e-5 of the box are one vertex.
inline hf_surface make_linked(const LinkScene& scene, const hf_links_desc* links) {
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.vertex_count = scene.flat.vertex_count(), desc.triangle_count = scene.flat.triangle_count();
  desc.positions_f64 = scene.xyz.data(), desc.triangles = scene.flat.triangles.data();
  desc.weld = HF_WELD_TOLERANCE, desc.weld_tolerance = static_cast<float>(1e-5 * scene.diagonal);
  desc.links = links;
  hf_surface surface = nullptr;
  ok(hf_surface_create(&desc, &surface));
  return surface;
}

}  // namespace bench

// The calls of skin weights that reliability_cancel cancels.
#include <algorithm>
#include <memory>

#include "cancel.h"

namespace reliability {
namespace {

// Bones across the mesh, and the weights they give. Every call works on one surface.
struct Rig {
  Rig(hf_surface given, const Mesh& mesh) : surface(given), vertices(mesh.vertex_count()) {
    for (std::uint32_t b = 0; b < joint_count; ++b) {
      for (std::size_t k = 0; k < 3; ++k) {
        heads.push_back(static_cast<double>(mesh.positions[3 * (vertices / joint_count * b) + k]));
        tails.push_back(0.9 * heads.back());
      }
    }
    const hf_joints_desc d = bones(nullptr);
    must(hf_weights_create(surface, &d, 4, &weights), "hf_weights_create");
    hf_weights_out out = desc<hf_weights_out>();
    joints.resize(4 * std::size_t{vertices});
    shares.resize(joints.size());
    out.vertex_capacity = vertices;
    out.joints = joints.data();
    out.weights = shares.data();
    must(hf_weights_get(weights, &out), "hf_weights_get");
    // a third of the vertices has none, which a field fills in
    std::fill_n(shares.begin(), shares.size() / 3, 0.0f);
  }
  ~Rig() { hf_weights_destroy(weights); }
  Rig(const Rig&) = delete;
  Rig& operator=(const Rig&) = delete;

  hf_joints_desc bones(hf_progress progress) const {
    hf_joints_desc d = desc<hf_joints_desc>();
    d.joint_count = joint_count;
    d.heads = heads.data();
    d.tails = tails.data();
    d.progress = progress;
    return d;
  }
  template <class Desc>
  Desc given(hf_progress progress) const {
    Desc d = desc<Desc>();
    d.source_influence_count = 4;
    d.joints = joints.data();
    d.weights = shares.data();
    d.progress = progress;
    return d;
  }

  static constexpr std::uint32_t joint_count = 40;
  hf_surface surface;
  std::uint32_t vertices;
  std::vector<double> heads, tails;
  hf_weights weights = nullptr;
  std::vector<std::uint32_t> joints;  // 4 a vertex
  std::vector<float> shares;
};

hf_result make(Rig& rig, hf_progress progress) {
  const hf_joints_desc d = rig.bones(progress);
  hf_weights made = nullptr;
  const hf_result result = hf_weights_create(rig.surface, &d, 4, &made);
  hf_weights_destroy(made);
  return result;
}

hf_result move_bones(Rig& rig, hf_progress progress) {
  for (double& x : rig.tails) x *= 0.999;  // the same bones would cost nothing
  const hf_joints_desc d = rig.bones(progress);
  return hf_weights_set_joints(rig.weights, &d);
}

hf_result pin(Rig& rig, hf_progress progress) {
  const std::uint32_t places[2] = {rig.vertices / 3, 0}, joints[2] = {0, 1};
  const double radii[2] = {0.5, 0.5};
  const float shares[2] = {1, 1};
  hf_pins_desc d = desc<hf_pins_desc>();
  must(hf_weights_set_pins(rig.weights, &d), "hf_weights_set_pins");  // the same pins would cost no path
  d.pin_count = 2;
  d.influence_count = 1;
  d.vertices = places;
  d.radii = radii;
  d.joints = joints;
  d.weights = shares;
  d.progress = progress;
  return hf_weights_set_pins(rig.weights, &d);
}

hf_result carry(Rig& rig, hf_progress progress) {
  const auto d = rig.given<hf_weights_transfer_desc>(progress);
  hf_weights_out out = desc<hf_weights_out>();
  hf_weights_transfer_info info = desc<hf_weights_transfer_info>();
  return hf_weights_transfer(rig.surface, rig.surface, &d, &out, &info);
}

hf_result mirror(Rig& rig, hf_progress progress) {
  const double plane[6] = {0, 0, 0, 1, 0, 0};
  auto d = rig.given<hf_weights_mirror_desc>(progress);
  d.joint_count = Rig::joint_count;
  d.heads = rig.heads.data();
  d.plane = plane;
  hf_weights_out out = desc<hf_weights_out>();
  hf_weights_mirror_info info = desc<hf_weights_mirror_info>();
  return hf_weights_mirror(rig.surface, &d, &out, nullptr, nullptr, &info, nullptr);
}

}  // namespace

void add_weights_cases(hf_surface surface, const Mesh& mesh, std::vector<Case>& cases) {
  const auto rig = std::make_shared<Rig>(surface, mesh);
  const auto memory = [=] { return memory_of(rig->surface); };
  const auto counts = [=] {
    hf_weights_statistics info = desc<hf_weights_statistics>();
    must(hf_weights_get_statistics(rig->weights, &info), "hf_weights_get_info");
    return mixed(mixed(info.factorisation_count, info.path_solve_count), memory_of(rig->surface));
  };
  cases.push_back({"weights", [=](hf_progress p) { return make(*rig, p); }, memory});
  cases.push_back({"weights_bones", [=](hf_progress p) { return move_bones(*rig, p); }, counts});
  cases.push_back({"weights_pins", [=](hf_progress p) { return pin(*rig, p); }, {}});
  cases.push_back({"weights_carry", [=](hf_progress p) { return carry(*rig, p); }, memory});
  cases.push_back({"weights_mirror", [=](hf_progress p) { return mirror(*rig, p); }, memory});
}

}  // namespace reliability

// A generated creature with a pose on it, whose handles are at the places of its joints.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>

#include "assets/creature.h"
#include "base/error.h"
#include "cases.h"
#include "deform/pose_stack.h"
#include "support/creature.h"

namespace deform_test {

using namespace hf_inner;
using namespace hf_inner::deform;
using Surface = std::vector<Vec3>;
using Region = std::vector<std::int32_t>;

inline bool same_bits(const Surface& a, const Surface& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

// A generated creature; its places are those of its joints.
struct Creature {
  std::shared_ptr<const surface::Core> core;
  std::map<std::string, Vec3> joints;
  double box = 0;
};

inline Creature make_body(const char* name, std::uint32_t vertices = 2500) {
  const samples::Creature& creature = hf_test::creature(name, vertices);
  Creature out;
  hf_test::PlainMesh mesh;
  mesh.positions.assign(creature.positions.begin(), creature.positions.end());
  mesh.triangles = creature.triangles;
  out.core = hf_test::make_core(mesh);
  out.box = out.core->mesh.scale;
  const std::vector<double> world = samples::rest_pose(creature);
  for (std::size_t j = 0; j < creature.skeleton.size(); ++j)
    out.joints[creature.skeleton[j].name] = {world[16 * j + 12], world[16 * j + 13], world[16 * j + 14]};
  return out;
}
inline const Creature& biped() {
  static const Creature made = make_body("biped");
  return made;
}

struct Body {
  explicit Body(const Creature& on = biped()) : creature(on) {}
  const Creature& creature;
  std::shared_ptr<PoseStack> pose = PoseStack::make(creature.core, {});
  double box = creature.box;
  std::uint32_t add(const char* joint, const HandleKind& kind = {}, double radius = 0.05) {
    const Region region = region_at(joint, radius);
    const std::uint32_t start[2] = {0, static_cast<std::uint32_t>(region.size())};
    std::uint32_t number = 0;
    pose->add_handles({start, 2}, region, 0, {&number, 1}, kind);
    return number;
  }
  Region region_at(const char* joint, double radius = 0.05) const {
    const mesh::Mesh& mesh = creature.core->mesh;
    const Vector<std::int32_t> found =
        RegionSearch(*creature.core).near(mesh.to_inner(creature.joints.at(joint)), radius);
    return {found.begin(), found.end()};
  }
  void put(std::uint32_t handle, const HandleTransform& t) { pose->set_transforms({&handle, 1}, {&t, 1}); }
  void follow(std::uint32_t handle, double share) { pose->set_following({&handle, 1}, share); }
  Surface frame(bool restart = false) {
    DeformRequest request;
    request.restart = restart;
    const DeformReport report = pose->deform(request);
    return {report.positions.begin(), report.positions.end()};
  }
  Surface settle() {
    Surface x = frame();
    for (int i = 0; i < 40; ++i) x = frame();
    return x;
  }
  // In 25 steps; a jump may end in another pose.
  Surface drag(std::uint32_t handle, Vec3 way) {
    for (int k = 1; k < 25; ++k) {
      put(handle, {{}, (k / 25.0) * way});
      frame();
    }
    put(handle, {{}, way});
    return settle();
  }
};
constexpr HandleKind free_kind{false, true};

// A setter for handles of layer 0 refuses the second of two handles, which is on a layer.
template <class Setter>
void expect_layers_refuse(Body& body, const Setter& set) {
  body.add("foot_L");
  const Region region = body.region_at("hand_L");
  const std::uint32_t start[2] = {0, static_cast<std::uint32_t>(region.size())};
  std::uint32_t numbers[2] = {0, 0};
  body.pose->add_handles({start, 2}, region, 1, {&numbers[1], 1});
  try {
    set(Span<const std::uint32_t>{numbers, 2});
    FAIL() << "a layer took it";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), HF_ERROR_UNSUPPORTED);
    EXPECT_EQ(error.index(), 1u);
  }
}

inline double moved(const Surface& x, const Surface& y, const Region& region) {
  double largest = 0;
  for (const std::int32_t v : region) largest = std::max(largest, norm(x[v] - y[v]));
  return largest;
}

}  // namespace deform_test

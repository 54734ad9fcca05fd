#include "weights/carried.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "common/limits.h"
#include "gltf/flat_mesh.h"
#include "gltf/node_match.h"

namespace samples {

using namespace hf_gltf;
namespace {

RigWeights taken(hf::WeightsOut found) {
  return {found.influence_count, std::move(found.joints), std::move(found.weights)};
}

const char* const pairing_names[] = {"alone", "named", "placed", "centre", "given"};
const char* const plane_names[] = {"given", "joints", "surface"};

}  // namespace

hf::Surface surface_of(const Rig& rig, const std::vector<glm::dvec3>& points) {
  const std::vector<double> positions = double_positions(points);
  auto desc = hf::make<hf_surface_desc>();
  desc.vertex_count = static_cast<uint32_t>(points.size());
  desc.triangle_count = static_cast<uint32_t>(rig.triangles.size() / 3);
  desc.positions_f64 = positions.data();
  desc.triangles = rig.triangles.data();
  limit_surface(desc);
  return hf::Surface(desc);
}

CarriedWeights carry_from(const Model& from, const Model& model, const Rig& rig, uint32_t influence_count) {
  // World space at rest: the bind spaces of two files can differ.
  const auto at_rest = [](const Model& whose, const Rig& own) {
    return surface_of(own, pose_rig(own, global_matrices(whose, rest_pose(whose)), own.given));
  };
  const Rig source = read_rig(from);
  const NodeMatch match = match_nodes(from, source.joints, model);
  std::vector<uint32_t> number;
  for (size_t j = 0; j < source.names.size(); ++j) {
    const auto there =
        std::find(rig.joints.begin(), rig.joints.end(), match.there[static_cast<size_t>(source.joints[j])]);
    if (there == rig.joints.end() && source.bones.deforms[j])
      throw std::runtime_error("the model has no joint \"" + source.names[j] + "\", which has weights in " + from.name);
    number.push_back(static_cast<uint32_t>(there - rig.joints.begin()));
  }
  hf::WeightsTransferOptions options;
  options.joints = source.given.joints;
  options.weights = source.given.weights;
  for (size_t i = 0; i < options.joints.size(); ++i)
    options.joints[i] = options.weights[i] > 0 ? number[options.joints[i]] : 0;
  options.influence_count = influence_count;
  auto info = hf::make<hf_weights_transfer_info>();
  CarriedWeights out;
  out.weights = taken(hf::Weights::transfer(at_rest(from, source), at_rest(model, rig), options, &info));
  out.report = {{"from", from.name},
                {"matched", info.matched_count},
                {"solved", info.solved_count},
                {"carried", info.nearest_count},
                {"rigid", info.rigid_count},
                {"isolated", info.isolated_count},
                {"pieces", info.guessed_piece_count}};
  char line[200];
  std::snprintf(line, sizeof line, "carried      %u matched, %u filled in; guessed: %u carried, %u rigid, %u isolated",
                info.matched_count, info.solved_count, info.nearest_count, info.rigid_count, info.isolated_count);
  out.line = line;
  return out;
}

CarriedWeights mirror_given(const hf::Surface& surface, const Rig& rig, int32_t to, uint32_t influence_count) {
  hf::WeightsMirrorOptions options;
  options.joints = rig.given.joints;
  options.weights = rig.given.weights;
  options.heads = rig.bones.heads;
  options.names = rig.names;
  options.influence_count = influence_count;
  options.to = to;
  auto info = hf::make<hf_weights_mirror_info>();
  auto off = hf::make<hf_weights_mirror_statistics>();
  CarriedWeights out;
  auto [found, partners, pairings] = hf::Weights::mirror(surface, options, &info, &off);
  out.weights = taken(std::move(found));
  const double unit = 100 / rig.diagonal;
  out.report = {{"plane", plane_names[info.plane_from]},
                {"point", {info.point[0], info.point[1], info.point[2]}},
                {"normal", {info.normal[0], info.normal[1], info.normal[2]}},
                {"joints_off", {{"mean", unit * off.joint_off}, {"worst", unit * off.worst_joint_off}}},
                {"vertices_off", {{"mean", unit * off.vertex_off}, {"worst", unit * off.worst_vertex_off}}},
                {"kept", info.kept_count},
                {"matched", info.matched_count},
                {"solved", info.solved_count},
                {"carried", info.nearest_count},
                {"rigid", info.rigid_count}};
  out.report["pairs"] = nlohmann::json::array();
  for (size_t b = 0; b < partners.size(); ++b)
    out.report["pairs"].push_back(
        {{"joint", rig.names[b]}, {"partner", rig.names[partners[b]]}, {"by", pairing_names[pairings[b]]}});
  char line[300];
  std::snprintf(
      line, sizeof line,
      "mirrored     plane of the %s; joints: %u by name, %u by place, %u in the middle, %u alone, worst %.2f %% "
      "off\nvertices     %u kept, %u matched, %u filled in, %u guessed; off the surface: mean %.3f %%, worst "
      "%.2f %%",
      plane_names[info.plane_from], info.named_count, info.placed_count, info.centre_count, info.alone_count,
      unit * off.worst_joint_off, info.kept_count, info.matched_count, info.solved_count,
      info.nearest_count + info.rigid_count, unit * off.vertex_off, unit * off.worst_vertex_off);
  out.line = line;
  return out;
}

}  // namespace samples

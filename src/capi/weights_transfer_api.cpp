// Implements hf/weights.h: helper bones, carried and mirrored weights.
#include <algorithm>

#include "capi/weights_object.h"
#include "capi/weights_out.h"
#include "weights/carry_intake.h"
#include "weights/helper_bones.h"

namespace hf_inner::capi {
namespace {

void write_filled(const weights::FilledWeights& filled, const mesh::Mesh& mesh, const hf_weights_out& out) {
  check_joints_fit(out, *std::max_element(filled.joints.begin(), filled.joints.end()));
  write_weights(filled, mesh, out);
}

template <class Info>
void count_vertices(const weights::FilledWeights& filled, Info& info) {
  info.matched_count = filled.by_origin[HF_WEIGHTS_MATCHED];
  info.solved_count = filled.by_origin[HF_WEIGHTS_SOLVED];
  info.nearest_count = filled.by_origin[HF_WEIGHTS_NEAREST];
  info.rigid_count = filled.by_origin[HF_WEIGHTS_RIGID];
  info.isolated_count = filled.by_origin[HF_WEIGHTS_ISOLATED];
}

void write_mirror_info(const weights::MirroredWeights& made, const mesh::Mesh& mesh, hf_weights_mirror_info* out_info) {
  hf_weights_mirror_info info{};
  info.vertex_count = mesh.report.vertex_count;
  info.plane_from = static_cast<std::int32_t>(made.plane.from);
  const weights::BoneMisses bones = weights::bone_misses(made.pairs, mesh.scale);
  info.alone_count = bones.by[HF_MIRROR_JOINT_ALONE];
  info.named_count = bones.by[HF_MIRROR_JOINT_NAMED];
  info.placed_count = bones.by[HF_MIRROR_JOINT_PLACED];
  info.centre_count = bones.by[HF_MIRROR_JOINT_CENTRE];
  info.given_count = bones.by[HF_MIRROR_JOINT_GIVEN];
  count_vertices(made.filled, info);
  info.kept_count = made.filled.by_origin[HF_WEIGHTS_KEPT];
  const Vec3 point = mesh.to_given(made.plane.offset * made.plane.normal), normal = made.plane.normal;
  info.point[0] = point.x;
  info.point[1] = point.y;
  info.point[2] = point.z;
  info.normal[0] = normal.x;
  info.normal[1] = normal.y;
  info.normal[2] = normal.z;
  write_struct(out_info, info);
}

void write_mirror_statistics(const weights::MirroredWeights& made, const mesh::Mesh& mesh,
                             hf_weights_mirror_statistics* out_statistics) {
  hf_weights_mirror_statistics statistics{};
  const weights::BoneMisses bones = weights::bone_misses(made.pairs, mesh.scale);
  statistics.worst_joint = bones.worst_joint;
  statistics.worst_vertex = mesh::given_vertex(mesh, made.worst);
  statistics.joint_off = bones.mean;
  statistics.worst_joint_off = bones.worst;
  statistics.vertex_off = mesh.scale * made.mean_off;
  statistics.worst_vertex_off = mesh.scale * made.worst_off;
  write_struct(out_statistics, statistics);
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_weights_get_helpers(hf_weights handle, const char* names, uint32_t capacity, uint32_t* out_reasons,
                                 uint32_t* out_count) {
  return guarded("hf_weights_get_helpers", [&] {
    const auto object = get<WeightsObject>(handle, "weights");
    if (!out_reasons) require(out_count, "out_reasons and out_count");
    const Reading reading(*object);
    const weights::WeightState& state = object->weights.state();
    const weights::Bones& bones = state.inputs->bones;
    write_count(out_count, bones.head.size());
    check_capacity(out_reasons != nullptr, capacity, bones.head.size(), "capacity");
    const Span<const char> text = weights::read_bone_names(names, bones.head.size(), *object->memory);
    if (!out_reasons) return;
    const Vector<std::uint32_t> found = weights::helper_reasons(bones, state.solution->faults, text, *object->memory);
    std::copy(found.begin(), found.end(), out_reasons);
  });
}

hf_result hf_weights_transfer(hf_surface source, hf_surface target, const hf_weights_transfer_desc* given,
                              hf_weights_out* inout_weights, hf_weights_transfer_info* out_info) {
  return guarded("hf_weights_transfer", [&] {
    const auto from = mesh_surface(source, "carried weights", "source");
    const auto to = mesh_surface(target, "carried weights", "target");
    const hf_weights_transfer_desc desc = read_struct(given, "desc");
    if (out_info) check_struct(out_info, "out_info");
    const mesh::Mesh& shape = from->surface.geometry().unlinked().mesh;
    const weights::MatchOptions options = weights::read_carry(desc, shape);
    const weights::GivenWeights weights = weights::read_carried(desc, shape);
    const hf_weights_out out = read_weights_out(inout_weights, to->surface.geometry().mesh, options.influences);
    if (!wants_weights(out) && !out_info) return;
    const weights::FilledWeights filled = with_progress(desc.progress, [&] {
      const auto core = skin_core(*to);
      const ProgressRange range(progress_core, 1.0f);
      const mesh::SkinShape skin(shape, *to->memory);
      return weights::transfer_weights(shape, skin, weights, core, options, &to->surface);
    });
    write_filled(filled, to->surface.geometry().mesh, out);
    if (!out_info) return;
    hf_weights_transfer_info info{};
    info.vertex_count = out.vertex_count;
    info.guessed_piece_count = filled.pieces_guessed;
    count_vertices(filled, info);
    write_struct(out_info, info);
  });
}

hf_result hf_weights_mirror(hf_surface handle, const hf_weights_mirror_desc* given, hf_weights_out* inout_weights,
                            uint32_t* out_partners, uint32_t* out_pairings, hf_weights_mirror_info* out_info,
                            hf_weights_mirror_statistics* out_statistics) {
  return guarded("hf_weights_mirror", [&] {
    const auto surface = mesh_surface(handle, "mirrored weights");
    const hf_weights_mirror_desc desc = read_struct(given, "desc");
    if (out_info) check_struct(out_info, "out_info");
    if (out_statistics) check_struct(out_statistics, "out_statistics");
    const mesh::Mesh& mesh = surface->surface.geometry().mesh;
    const weights::MirrorOptions options = weights::read_mirror(desc, mesh);
    const weights::MirrorBones bones = weights::read_mirror_bones(desc, mesh, *surface->memory);
    const weights::GivenWeights weights = weights::read_mirrored(desc, mesh);
    const hf_weights_out out = read_weights_out(inout_weights, mesh, options.carry.influences);
    if (!wants_weights(out) && !out_partners && !out_pairings && !out_info && !out_statistics) return;
    const weights::MirroredWeights made = with_progress(desc.progress, [&] {
      const auto core = skin_core(*surface);
      const ProgressRange range(progress_core, 1.0f);
      const auto skin = make_owner_in<weights::SkinSurface>(core->memory, core);
      return weights::mirror_weights(*skin, weights, bones, options, &surface->surface);
    });
    write_filled(made.filled, mesh, out);
    for (std::size_t b = 0; b < made.pairs.partner.size(); ++b) {
      if (out_partners) out_partners[b] = static_cast<std::uint32_t>(made.pairs.partner[b]);
      if (out_pairings) out_pairings[b] = static_cast<std::uint32_t>(made.pairs.by[b]);
    }
    if (out_info) write_mirror_info(made, mesh, out_info);
    if (out_statistics) write_mirror_statistics(made, mesh, out_statistics);
  });
}

}  // extern "C"

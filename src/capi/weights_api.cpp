// Implements hf/weights.h: skin weights from bones.
#include "base/arguments.h"
#include "capi/weights_object.h"
#include "capi/weights_out.h"
#include "weights/intake.h"

namespace hf_inner::capi {
namespace {

std::uint32_t joint_count(const WeightsObject& object) {
  return static_cast<std::uint32_t>(object.weights.state().inputs->bones.head.size());
}

template <class Work>
hf_result change(const char* function, hf_weights handle, Work&& work) {
  return guarded(function, [&] {
    const auto object = get<WeightsObject>(handle, "weights");
    const Changing changing(*object);
    work(*object);
  });
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_weights_create(hf_surface handle, const hf_joints_desc* given, uint32_t influence_count,
                            hf_weights* out_weights) {
  return create("hf_weights_create", out_weights, "out_weights", [&] {
    const auto surface = mesh_surface(handle, "skin weights");
    const hf_joints_desc desc = read_struct(given, "joints");
    const std::int32_t influences = weights_per_vertex(influence_count);
    weights::Bones bones(*surface->memory);
    weights::read_first_bones(desc, bones, *surface->memory);
    return with_progress(desc.progress, [&] {
      const auto core = skin_core(*surface);
      const ProgressRange range(progress_core, 1.0f);
      return make_owner_in<WeightsObject>(core->memory, make_owner_in<weights::SkinSurface>(core->memory, core),
                                          influences, bones);
    });
  });
}

hf_result hf_weights_clone(hf_weights handle, hf_weights* out_weights) {
  return clone_object<WeightsObject>("hf_weights_clone", handle, "weights", out_weights, "out_weights");
}

void hf_weights_destroy(hf_weights weights) { destroy<WeightsObject>(weights); }

hf_result hf_weights_set_joints(hf_weights handle, const hf_joints_desc* given) {
  return change("hf_weights_set_joints", handle, [&](WeightsObject& object) {
    const hf_joints_desc desc = read_struct(given, "joints");
    weights::Bones bones(*object.memory);
    weights::read_bones(desc, bones, *object.memory);
    const Vector<Index> sources = weights::read_sources(desc, joint_count(object), *object.memory);
    with_progress(desc.progress, [&] { object.weights.set_joints(bones, sources); });
  });
}

hf_result hf_weights_set_pins(hf_weights handle, const hf_pins_desc* given) {
  return change("hf_weights_set_pins", handle, [&](WeightsObject& object) {
    const hf_pins_desc desc = read_struct(given, "pins");
    weights::Pins pins(*object.memory);
    weights::read_pins(desc, object.weights.surface().core->mesh, joint_count(object), pins, *object.memory);
    with_progress(desc.progress, [&] { object.weights.set_pins(pins); });
  });
}

hf_result hf_weights_set_locks(hf_weights handle, uint32_t lock_count, const uint32_t* bones, const float* values) {
  return change("hf_weights_set_locks", handle, [&](WeightsObject& object) {
    const weights::LockInput locks = weights::read_locks(object.weights.surface().core->mesh, joint_count(object),
                                                         lock_count, bones, values, *object.memory);
    object.weights.set_locks(locks.bones, locks.values.empty() ? nullptr : locks.values.data());
  });
}

hf_result hf_weights_get(hf_weights handle, hf_weights_out* inout) {
  return guarded("hf_weights_get", [&] {
    const auto object = get<WeightsObject>(handle, "weights");
    check_struct(inout, "inout_weights");
    const Reading reading(*object);
    const mesh::Mesh& mesh = object->weights.surface().core->mesh;
    const hf_weights_out out = read_weights_out(inout, mesh, object->weights.influences());
    check_joints_fit(out, joint_count(*object) - 1);
    write_weights(object->weights.state(), mesh, out);
  });
}

hf_result hf_weights_get_joints(hf_weights handle, uint32_t capacity, uint32_t* out_flags, uint32_t* out_vertex_counts,
                                uint32_t* out_count) {
  return guarded("hf_weights_get_joints", [&] {
    const auto object = get<WeightsObject>(handle, "weights");
    if (!out_flags && !out_vertex_counts) require(out_count, "out_flags, out_vertex_counts and out_count");
    const Reading reading(*object);
    const weights::Solution& solution = *object->weights.state().solution;
    write_count(out_count, solution.faults.size());
    check_capacity(out_flags || out_vertex_counts, capacity, solution.faults.size(), "capacity");
    for (std::size_t b = 0; b < solution.faults.size(); ++b) {
      if (out_flags) out_flags[b] = weights::bone_flags(solution.faults[b]);
      if (out_vertex_counts) out_vertex_counts[b] = solution.informs[b];
    }
  });
}

hf_result hf_weights_get_info(hf_weights handle, hf_weights_info* out_info) {
  return guarded("hf_weights_get_info", [&] {
    const auto object = get<WeightsObject>(handle, "weights");
    check_struct(out_info, "out_info");
    const Reading reading(*object);
    const weights::WeightState& state = object->weights.state();
    const weights::WeightCounts& counts = state.counts;
    hf_weights_info info{};
    info.vertex_count = object->weights.surface().core->mesh.report.vertex_count;
    info.joint_count = joint_count(*object);
    info.pin_count = static_cast<std::uint32_t>(state.inputs->pins.count());
    info.lock_count = state.inputs->locks ? static_cast<std::uint32_t>(state.inputs->locks->bones.size()) : 0;
    info.informed_count = counts.by_origin[HF_WEIGHTS_INFORMED];
    info.solved_count = counts.by_origin[HF_WEIGHTS_SOLVED];
    info.pinned_count = counts.by_origin[HF_WEIGHTS_PINNED];
    info.nearest_count = counts.by_origin[HF_WEIGHTS_NEAREST];
    info.rigid_count = counts.by_origin[HF_WEIGHTS_RIGID];
    info.isolated_count = counts.by_origin[HF_WEIGHTS_ISOLATED];
    write_struct(out_info, info);
  });
}

hf_result hf_weights_get_statistics(hf_weights handle, hf_weights_statistics* out_statistics) {
  return guarded("hf_weights_get_statistics", [&] {
    const auto object = get<WeightsObject>(handle, "weights");
    check_struct(out_statistics, "out_statistics");
    const Reading reading(*object);
    const weights::WeightState& state = object->weights.state();
    const weights::WeightCounts& counts = state.counts;
    hf_weights_statistics statistics{};
    statistics.nearest_piece_count = counts.pieces_carried + counts.pieces_rigid;
    statistics.rigid_piece_count = counts.pieces_rigid;
    statistics.blind = counts.blind;
    const weights::BoneFlagCounts bones = weights::count_bone_flags(state.solution->faults);
    statistics.no_length_count = bones.no_length;
    statistics.coincident_count = bones.coincident;
    statistics.informs_none_count = bones.informs_none;
    statistics.outside_count = bones.outside;
    statistics.helper_count = bones.helper;
    statistics.factorisation_count = counts.factorisations;
    statistics.path_solve_count = counts.path_solves;
    write_struct(out_statistics, statistics);
  });
}

}  // extern "C"

// Steps of poses and transfers.
#include "golden_scene.h"
#include "support/arrays.h"

namespace golden {

using hf::check;
using hf::make;

Result Scene::run_posing(const Json& step, const std::string& what) {
  Result result;
  Object& on = objects_[step["on"]];
  hf_pose pose = on.pose.get();
  const auto handles = numbers(step, "handles");
  if (what == "add_handles") {
    auto desc = make<hf_handles_desc>();
    const auto lists = regions(step, "regions");
    const auto points = doubles(step, "points");
    const auto radii = points ? doubles(step, "radii", points->size() / 3) : std::nullopt;
    desc.layer = step.value("layer", 0u);
    desc.in_place = step.value("in_place", 0);
    if (points) {
      desc.handle_count = static_cast<uint32_t>(points->size() / 3);
      desc.points = data(points);
      desc.radii = data(radii);
    } else {
      desc.handle_count = lists ? static_cast<uint32_t>(lists->first.size()) : 1u;
      if (lists && !lists->first.empty()) {
        desc.region_counts = lists->first.data();
        desc.region_vertices = lists->second.data();
      }
    }
    result.numbers.emplace(desc.handle_count);
    check(hf_pose_add_handles(pose, &desc, result.numbers->data()));
  } else if (what == "remove_handles") {
    check(hf_pose_remove_handles(pose, count(handles), data(handles)));
  } else if (what == "set_transforms") {
    const size_t k = count(handles);
    const auto turns = doubles(step, "rotations", 4 * k), shifts = doubles(step, "translations", 3 * k);
    std::vector<hf_transform> transforms(k ? k : 1);
    for (size_t i = 0; i < k; ++i) {
      for (size_t c = 0; turns && c < 4; ++c) transforms[i].rotation[c] = (*turns)[4 * i + c];
      for (size_t c = 0; shifts && c < 3; ++c) transforms[i].translation[c] = (*shifts)[3 * i + c];
    }
    check(hf_pose_set_transforms(pose, count(handles), data(handles), transforms.data()));
  } else if (what == "add_handle_at") {
    const auto point = doubles(step, "point", 3);
    result.numbers.emplace(1);
    check(hf_pose_add_handle_at(pose, data(point), number(step["radius"]), result.numbers->data()));
  } else if (what == "set_transform") {
    const auto turn = doubles(step, "rotation", 4), shift = doubles(step, "translation", 3);
    hf_transform transform{};
    if (turn) std::copy_n(turn->data(), 4, transform.rotation);
    if (shift) std::copy_n(shift->data(), 3, transform.translation);
    check(hf_pose_set_transform(pose, step["handle"], &transform));
  } else if (what == "pose_info") {
    auto info = make<hf_pose_info>();
    check(hf_pose_get_info(pose, &info));
    result.fields = {{"band_count", info.band_count},
                     {"iteration_count", info.iteration_count},
                     {"group_count", info.group_count},
                     {"handle_count", info.handle_count},
                     {"vertex_count", info.vertex_count}};
  } else if (what == "deform_f32") {
    std::vector<float> positions(3 * on.vertex_count);
    check(hf_deform(pose, positions.data(), nullptr));
    result.array.emplace(positions.begin(), positions.end());
  } else if (what == "deform") {
    auto desc = make<hf_deform_desc>();
    set_options(step, {{"restart", &desc.restart},
                       {"iteration_count", &desc.iteration_count},
                       {"refine", &desc.refine},
                       {"refine_from_last", &desc.refine_from_last}});
    result.array.emplace(3 * on.vertex_count);
    desc.positions = ROWS_OUT(result.array->data());
    check(hf_pose_deform(pose, &desc, nullptr));
  } else if (what == "handle_field") {
    std::vector<float> field(on.vertex_count);
    check(hf_pose_get_field(pose, step["handle"], OUT(field.data())));
    result.array.emplace(field.begin(), field.end());
  } else if (what == "handle_info") {
    auto info = make<hf_handle_info>();
    check(hf_pose_get_handle(pose, step["handle"], &info));
    result.fields["layer"] = info.layer;
  } else if (what == "handle_place") {
    auto info = make<hf_handle_info>();
    check(hf_pose_get_handle(pose, step["handle"], &info));
    result.array.emplace(info.rotation, info.rotation + 4);
    result.array->insert(result.array->end(), info.translation, info.translation + 3);
  } else if (what == "skin") {
    auto info = make<hf_skin_info>();
    info.influence_count = step["influence_count"];
    std::vector<float> weights(on.vertex_count * info.influence_count);
    info.vertex_capacity = static_cast<uint32_t>(on.vertex_count);
    info.vertex_weights = weights.data();
    check(hf_pose_get_skin(pose, &info));
    result.array.emplace(weights.begin(), weights.end());
  } else if (what == "add_pairs") {
    const auto source = regions(step, "source_regions"), target = regions(step, "target_regions");
    const auto flags = numbers(step, "flags");
    if (source->first.size() != target->first.size()) fail("regions of one length");
    auto desc = make<hf_pairs_desc>();
    desc.pair_count = static_cast<uint32_t>(source->first.size());
    if (desc.pair_count) {
      desc.source_counts = source->first.data();
      desc.source_vertices = source->second.data();
      desc.target_counts = target->first.data();
      desc.target_vertices = target->second.data();
    }
    desc.flags = data(flags);
    result.numbers.emplace(desc.pair_count);
    check(hf_transfer_add_pairs(on.transfer.get(), &desc, result.numbers->data()));
  } else if (what == "remove_pairs") {
    const auto pairs = numbers(step, "pairs");
    check(hf_transfer_remove_pairs(on.transfer.get(), count(pairs), data(pairs)));
  } else if (what == "set_dials") {
    auto dials = make<hf_transfer_dials>();
    set_options(step, {{"stride", &dials.stride},
                       {"hip_height_share", &dials.hip_height_share},
                       {"neck_follow", &dials.neck_follow},
                       {"tail_follow", &dials.tail_follow},
                       {"arm_space", &dials.arm_space},
                       {"long_follow", &dials.long_follow}});
    check(hf_transfer_set_dials(on.transfer.get(), &dials));
  } else if (what == "dials") {
    auto dials = make<hf_transfer_dials>();
    check(hf_transfer_get_dials(on.transfer.get(), &dials));
    result.fields = {{"stride", dials.stride},           {"hip_height_share", dials.hip_height_share},
                     {"neck_follow", dials.neck_follow}, {"tail_follow", dials.tail_follow},
                     {"arm_space", dials.arm_space},     {"long_follow", dials.long_follow}};
  } else if (what == "transfer_info") {
    auto info = make<hf_transfer_info>();
    check(hf_transfer_get_info(on.transfer.get(), &info));
    result.fields = {{"pair_count", info.pair_count}, {"scale", info.scale}};
  } else if (what == "apply") {
    const auto posed = doubles(step, "positions", 3 * on.source_vertex_count);
    result.array.emplace(3 * on.vertex_count);
    auto frame = make<hf_transfer_frame>();
    frame.source_positions = HF_ARRAY(data(posed), posed ? on.source_vertex_count : 0);
    frame.target_positions = ROWS_OUT(result.array->data());
    check(hf_transfer_apply(on.transfer.get(), &frame));
  } else {
    throw std::runtime_error("unknown step " + what);
  }
  return result;
}

}  // namespace golden

// Poses, transfers, quads, streamlines, regions and their detail, skin weights.
#include "support/arrays.h"
#include "whole_api_run.h"

namespace reliability {

void Run::pose_and_transfer() {
  const hf_surface surface = make(surface_desc());
  for (int mode = 0; mode < 2; ++mode) {
    hf_pose pose = nullptr, copy = nullptr;
    call(create_pose_with(mode, surface, nullptr, &pose), "hf_pose_create");
    const std::uint32_t counts[2] = {2 * s.around, 2 * s.around};
    hf_handles_desc regions = desc<hf_handles_desc>();
    regions.handle_count = 2;
    regions.region_counts = counts;
    regions.region_vertices = s.ends.data();
    std::uint32_t handles[2], layered = 0;
    call(hf_pose_add_handles(pose, &regions, handles), "hf_pose_add_handles");
    const hf_transform turned = {{0, 0.5, 0, 0.8660254037844386}, {1, 2, 0.5}};
    call(hf_pose_set_transforms(pose, 1, &handles[1], &turned), "hf_pose_set_transforms");
    call(hf_pose_set_matrices(pose, 1, &handles[0], s.matrices.data()), "hf_pose_set_matrices");
    std::vector<float> normals(3 * std::size_t{n});
    hf_deform_desc deform = desc<hf_deform_desc>();
    deform.positions = ROWS_OUT(floats.data());
    deform.normals = ROWS_OUT(normals.data());
    deform.refine = mode == POSE_SMOOTH;
    call(hf_pose_deform(pose, &deform, nullptr), "hf_pose_deform");
    take_floats();
    take(normals.data(), normals.size());
    call(hf_pose_get_field(pose, handles[0], OUT_ROWS(floats.data(), 12)), "hf_pose_get_field");
    take_floats();
    hf_handle_info info = desc<hf_handle_info>();
    call(hf_pose_get_handle(pose, handles[1], &info), "hf_pose_get_handle");
    take(&info, 1);
    hf_skin_info skin = desc<hf_skin_info>();
    call(hf_pose_get_skin(pose, &skin), "hf_pose_get_skin");
    std::vector<float> weights(4 * std::size_t{n});
    Numbers rotations(4 * std::size_t{skin.joint_count});
    skin.joint_capacity = skin.joint_count;
    skin.vertex_capacity = skin.vertex_count;
    skin.vertex_weights = weights.data();
    skin.rotations = rotations.data();
    call(hf_pose_get_skin(pose, &skin), "hf_pose_get_skin, written");
    take(weights.data(), weights.size());
    take(rotations.data(), rotations.size());
    call(hf_pose_clone(pose, &copy), "hf_pose_clone");
    regions = desc<hf_handles_desc>();
    const double radius = 0.5;
    regions.handle_count = 1;
    regions.points = doubles.data();
    regions.radii = &radius;
    regions.layer = 1;
    std::memcpy(doubles.data(), s.positions_f64.data() + 3 * std::size_t{n / 2}, 3 * sizeof(double));
    call(hf_pose_add_handles(copy, &regions, &layered), "hf_pose_add_handles, layer");
    call(hf_pose_deform(copy, &deform, nullptr), "hf_pose_deform, layers");
    take_floats();
    call(hf_pose_remove_handles(copy, 1, &layered), "hf_pose_remove_handles");
    const std::uint32_t count = hf_pose_get_handle_count(copy);
    take(&count, 1);
    const bool smooth = mode == POSE_SMOOTH;
    call(hf_pose_set_free_rotations(copy, 1, &handles[1], 1), "hf_pose_set_free_rotations",
         smooth ? HF_OK : HF_ERROR_UNSUPPORTED);
    call(hf_pose_deform(copy, &deform, nullptr), "hf_pose_deform, a free rotation");
    call(hf_pose_set_rigid_pieces(copy, 0, nullptr), "hf_pose_set_rigid_pieces");
    call(hf_pose_set_following(copy, 1, &handles[1], 0.3), "hf_pose_set_following",
         smooth ? HF_OK : HF_ERROR_UNSUPPORTED);
    call(hf_pose_deform(copy, &deform, nullptr), "hf_pose_deform, a limb that follows alone");
    call(hf_pose_set_limb_refine(copy, 1, &handles[1], 2), "hf_pose_set_limb_refine");
    call(hf_pose_deform(copy, &deform, nullptr), "hf_pose_deform, a limb that keeps its lengths");
    hf_pose_destroy(pose);
    hf_pose_destroy(copy);
  }
  for (int mode = 0; mode < 2; ++mode) {
    hf_transfer transfer = nullptr;
    call(create_transfer_with(mode, surface, surface, nullptr, &transfer), "hf_transfer_create");
    const std::uint32_t counts[2] = {2 * s.around, 2 * s.around};
    hf_pairs_desc pairs = desc<hf_pairs_desc>();
    pairs.pair_count = 2;
    pairs.source_counts = pairs.target_counts = counts;
    pairs.source_vertices = pairs.target_vertices = s.ends.data();
    std::uint32_t numbers[2];
    call(hf_transfer_add_pairs(transfer, &pairs, numbers), "hf_transfer_add_pairs");
    hf_transfer_frame frame = desc<hf_transfer_frame>();
    frame.source_positions = HF_ARRAY(s.posed.data(), s.posed.size() / 3);
    frame.target_positions = ROWS_OUT(floats.data());
    call(hf_transfer_apply(transfer, &frame), "hf_transfer_apply");
    take_floats();
    hf_transfer_dials dials = desc<hf_transfer_dials>();
    dials.stride = 1.2;
    dials.hip_height_share = 0.1;
    dials.arm_space = 0.2;
    call(hf_transfer_set_dials(transfer, &dials), "hf_transfer_set_dials");
    call(hf_transfer_apply(transfer, &frame), "hf_transfer_apply, dials");
    take_floats();
    call(hf_transfer_get_dials(transfer, &dials), "hf_transfer_get_dials");
    take(&dials, 1);
    std::vector<std::uint8_t> sinking(n);
    call(hf_transfer_get_sinking(transfer, sinking.data()), "hf_transfer_get_sinking");
    take(sinking.data(), sinking.size());
    hf_pair_info pair = desc<hf_pair_info>();
    call(hf_transfer_get_pair(transfer, numbers[0], &pair), "hf_transfer_get_pair");
    take(&pair, 1);
    hf_transfer_info info = desc<hf_transfer_info>();
    call(hf_transfer_get_info(transfer, &info), "hf_transfer_get_info");
    take(&info, 1);
    hf_transfer_statistics work = desc<hf_transfer_statistics>();
    call(hf_transfer_get_statistics(transfer, &work), "hf_transfer_get_statistics");
    take(&work, 1);
    hf_skin_info skin = desc<hf_skin_info>();
    call(hf_transfer_get_skin(transfer, &skin), "hf_transfer_get_skin");
    take(&skin.joint_count, 1);
    const std::uint32_t piece = 0;
    call(hf_transfer_set_rigid_pieces(transfer, 1, &piece), "hf_transfer_set_rigid_pieces");
    call(hf_transfer_apply(transfer, &frame), "hf_transfer_apply, a rigid piece");
    take_floats();
    call(hf_transfer_remove_pairs(transfer, 1, numbers), "hf_transfer_remove_pairs");
    hf_transfer_destroy(transfer);
  }
  hf_surface_destroy(surface);
}

void Run::quads_and_flow() {
  const hf_surface surface = make(surface_desc());
  hf_quads_desc wanted = desc<hf_quads_desc>();
  wanted.edge_length = 0.5;
  hf_quads quads = nullptr;
  call(hf_quads_create(surface, &wanted, &quads), "hf_quads_create");
  hf_quads_info info = desc<hf_quads_info>();
  call(hf_quads_get_info(quads, &info), "hf_quads_get_info");
  take(&info, 1);
  Numbers positions(3 * std::size_t{info.vertex_count});
  std::vector<std::uint32_t> corners(4 * std::size_t{info.face_count});
  hf_quads_mesh mesh = desc<hf_quads_mesh>();
  mesh.vertex_capacity = info.vertex_count;
  mesh.face_capacity = info.face_count;
  mesh.positions = positions.data();
  mesh.faces = corners.data();
  call(hf_quads_get_mesh(quads, &mesh), "hf_quads_get_mesh");
  take(positions.data(), positions.size());
  take(corners.data(), corners.size());
  wanted.relax_count = HF_NO_INDEX;
  call(hf_quads_update(quads, &wanted), "hf_quads_update");
  call(hf_quads_get_info(quads, &info), "hf_quads_get_info");
  take(&info, 1);
  hf_quads_destroy(quads);
  hf_flow flow = nullptr;
  call(hf_flow_create(surface, &flow), "hf_flow_create");
  hf_surface_destroy(surface);
  const hf_array field = HF_ARRAY(s.height.data(), n);
  hf_streamlines lines = desc<hf_streamlines>();
  lines.wanted_count = 12;
  call(hf_flow_trace(flow, &field, &lines), "hf_flow_trace");
  positions.resize(3 * std::size_t{lines.point_count});
  lines.point_capacity = lines.point_count;
  lines.line_capacity = lines.line_count;
  lines.positions = positions.data();
  call(hf_flow_trace(flow, &field, &lines), "hf_flow_trace, written");
  take(positions.data(), positions.size());
  hf_flow_destroy(flow);
}

void Run::regions() {
  const hf_surface surface = make(surface_desc());
  hf_region_desc wanted = desc<hf_region_desc>();
  wanted.positions = HF_ARRAY(s.positions.data(), s.positions.size() / 3);
  hf_region source = nullptr, target = nullptr;
  call(hf_region_create(surface, &wanted, &source), "hf_region_create");
  // A patch of four by five vertices, and one seven rings higher.
  std::vector<std::uint32_t> patch, list(n);
  for (std::uint32_t ring = 5; ring < 9; ++ring)
    for (std::uint32_t i = 3; i < 8; ++i) patch.push_back(ring * s.around + i);
  hf_region_edit_desc edit = desc<hf_region_edit_desc>();
  edit.add_count = static_cast<std::uint32_t>(patch.size());
  edit.add_vertices = patch.data();
  call(hf_region_edit(source, &edit), "hf_region_edit");
  hf_surface_destroy(surface);
  call(hf_region_clone(source, &target), "hf_region_clone");
  hf_region_edit_desc grow = desc<hf_region_edit_desc>();
  grow.ring_count = 1;
  call(hf_region_edit(source, &grow), "hf_region_edit, grown");
  for (std::uint32_t& v : patch) v += 7 * s.around;
  hf_region_edit_desc there = desc<hf_region_edit_desc>();
  std::vector<std::uint32_t> old;
  for (const std::uint32_t v : patch) old.push_back(v - 7 * s.around);
  there.remove_count = there.add_count = static_cast<std::uint32_t>(patch.size());
  there.remove_vertices = old.data();
  there.add_vertices = patch.data();
  call(hf_region_edit(target, &there), "hf_region_edit, moved");
  hf_region_info info = desc<hf_region_info>();
  call(hf_region_get_info(target, &info), "hf_region_get_info");
  take(&info, 1);
  hf_region_statistics work = desc<hf_region_statistics>();
  call(hf_region_get_statistics(target, &work), "hf_region_get_statistics");
  take(&work, 1);
  call(hf_region_get_vertices(target, HF_REGION_RIM, n, list.data(), nullptr), "hf_region_get_vertices");
  std::uint32_t corner_count = 0;
  call(hf_region_get_curve(target, 0, nullptr, &corner_count), "hf_region_get_curve");
  take(list.data(), info.rim_count);
  hf_morph_desc morph = desc<hf_morph_desc>();
  morph.weight = 0.5;
  morph.positions = ROWS_OUT(doubles.data());
  morph.normals = ROWS_OUT(floats.data());
  call(hf_region_morph(source, &morph), "hf_region_morph");
  take_doubles();
  take_floats();
  hf_detail detail = nullptr;
  call(hf_detail_create(source, target, nullptr, &detail), "hf_detail_create");
  hf_region_destroy(source);
  hf_region_destroy(target);
  call(hf_detail_morph(detail, &morph), "hf_detail_morph");
  take_doubles();
  hf_detail_destroy(detail);
}

// Two bones from the first vertex over the middle to the last.
void Run::skin_weights() {
  const hf_surface surface = make(surface_desc()), second = make(surface_desc());
  Numbers heads;
  for (const std::uint32_t v : {0u, n / 2, n - 1}) {
    for (std::uint32_t k = 0; k < 3; ++k) heads.push_back(static_cast<double>(s.positions[3 * v + k]));
  }
  const std::uint32_t parents[3] = {HF_NO_INDEX, 0, 1}, lock = 1, pinned = n / 3;
  hf_joints_desc bones = desc<hf_joints_desc>();
  bones.joint_count = 3;
  bones.heads = heads.data();
  bones.parents = parents;
  hf_weights weights = nullptr, copy = nullptr;
  call(hf_weights_create(surface, &bones, 4, &weights), "hf_weights_create");
  hf_surface_destroy(surface);
  call(hf_weights_clone(weights, &copy), "hf_weights_clone");
  hf_weights_destroy(copy);
  const float share = 1;
  hf_pins_desc pins = desc<hf_pins_desc>();
  pins.pin_count = pins.influence_count = 1;
  pins.vertices = &pinned;
  pins.joints = &lock;
  pins.weights = &share;
  call(hf_weights_set_pins(weights, &pins), "hf_weights_set_pins");
  call(hf_weights_set_locks(weights, 1, &lock, nullptr), "hf_weights_set_locks");
  heads[1] += 0.25;
  call(hf_weights_set_joints(weights, &bones), "hf_weights_set_joints");
  std::vector<std::uint32_t> joints(4 * std::size_t{n}), flags(3);
  std::vector<float> shares(joints.size());
  hf_weights_out out = desc<hf_weights_out>();
  out.vertex_capacity = n;
  out.joints = joints.data();
  out.weights = shares.data();
  call(hf_weights_get(weights, &out), "hf_weights_get");
  take(joints.data(), joints.size());
  take(shares.data(), shares.size());
  call(hf_weights_get_joints(weights, 3, flags.data(), nullptr, nullptr), "hf_weights_get_joints");
  take(flags.data(), flags.size());
  hf_weights_info info = desc<hf_weights_info>();
  call(hf_weights_get_info(weights, &info), "hf_weights_get_info");
  take(&info, 1);
  hf_weights_statistics found = desc<hf_weights_statistics>();
  call(hf_weights_get_statistics(weights, &found), "hf_weights_get_statistics");
  take(&found, 1);
  call(hf_weights_get_helpers(weights, "root\narm.L\narm.R\n", 3, flags.data(), nullptr), "hf_weights_get_helpers");
  take(flags.data(), flags.size());
  hf_weights_destroy(weights);
  carried_weights(second, heads, joints, shares);
  hf_surface_destroy(second);
}

// The weights on the same surface, and on its other side.
void Run::carried_weights(hf_surface surface, const Numbers& heads, const std::vector<std::uint32_t>& joints,
                          const std::vector<float>& shares) {
  std::vector<std::uint32_t> bones(joints.size());
  std::vector<float> weights(shares.size());
  hf_weights_out out = desc<hf_weights_out>();
  out.vertex_capacity = n;
  out.joints = bones.data();
  out.weights = weights.data();
  hf_weights_transfer_desc carry = desc<hf_weights_transfer_desc>();
  carry.source_influence_count = 4;
  carry.joints = joints.data();
  carry.weights = shares.data();
  hf_weights_transfer_info carried = desc<hf_weights_transfer_info>();
  call(hf_weights_transfer(surface, surface, &carry, &out, &carried), "hf_weights_transfer");
  take(bones.data(), bones.size());
  take(weights.data(), weights.size());
  take(&carried, 1);
  hf_weights_mirror_desc mirror = desc<hf_weights_mirror_desc>();
  mirror.joint_count = 3;
  mirror.heads = heads.data();
  mirror.source_influence_count = 4;
  mirror.joints = joints.data();
  mirror.weights = shares.data();
  hf_weights_mirror_info mirrored = desc<hf_weights_mirror_info>();
  call(hf_weights_mirror(surface, &mirror, &out, nullptr, nullptr, &mirrored, nullptr), "hf_weights_mirror");
  take(bones.data(), bones.size());
  take(weights.data(), weights.size());
  take(&mirrored, 1);
}

}  // namespace reliability

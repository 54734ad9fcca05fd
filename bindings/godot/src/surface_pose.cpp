// Methods of the pose and of the transfer: handles, deform, skins, motion on another surface (hf/pose.h, transfer.h).
#include "arguments.h"

namespace hf_godot {

hf_pose pose_of(Surface& s) {
  return make_once(s.pose, [&](hf_pose* out) { return hf_pose_create(s.get(), nullptr, out); });
}

namespace {

// The rows of a blend, as hf_blend_rows has them. The lists are asked for one by one.
struct BlendRows {
  hf_blend_rows rows = make<hf_blend_rows>();
  explicit BlendRows(Surface& s) : pose(pose_of(s)) { check(hf_pose_get_blend_rows(pose, &rows)); }
  void read() {
    rows.vertex_capacity = rows.vertex_count;
    rows.entry_capacity = rows.entry_count;
    check(hf_pose_get_blend_rows(pose, &rows));
  }

 private:
  hf_pose pose;
};

// blend_rows(): of each vertex the number of its first entry, and the count of its entries
Value blend_rows(Surface& s, const Arguments&) {
  BlendRows blend(s);
  Numbers made(2 * size_t{blend.rows.vertex_count});
  blend.rows.rows = made.data();
  blend.read();
  return numbers(std::move(made));
}

// blend_clusters(): of each entry the number of its cluster
Value blend_clusters(Surface& s, const Arguments&) {
  BlendRows blend(s);
  std::vector<uint16_t> made(blend.rows.entry_count);
  blend.rows.clusters = made.data();
  blend.read();
  return numbers(Numbers(made.begin(), made.end()));
}

// blend_entries(): of each entry the gradient and the weight, four numbers
Value blend_entries(Surface& s, const Arguments&) {
  BlendRows blend(s);
  std::vector<float> weights(blend.rows.entry_count), gradients(3 * weights.size());
  blend.rows.weights = weights.data();
  blend.rows.gradients = gradients.data();
  blend.read();
  Value value;
  value.kind = Value::reals;
  for (size_t e = 0; e < weights.size(); ++e) {
    value.floats.insert(value.floats.end(), &gradients[3 * e], &gradients[3 * e] + 3);
    value.floats.push_back(weights[e]);
  }
  return value;
}

// blend_positions(), blend_normals(), blend_offsets(): at rest
template <float* hf_blend_rows::*array>
Value blend_vectors(Surface& s, const Arguments&) {
  BlendRows blend(s);
  Value value;
  value.kind = Value::vectors;
  value.floats.resize(3 * size_t{blend.rows.vertex_count});
  blend.rows.*array = value.floats.data();
  blend.read();
  return value;
}

// blend_centre(): one vector, to which positions of the blend are relative
Value blend_centre(Surface& s, const Arguments&) {
  auto info = make<hf_blend_info>();
  check(hf_pose_get_blend_info(pose_of(s), &info));
  return vectors(Doubles(info.centre, info.centre + 3));
}

// blend_box(): the lowest and the highest corner of a box that holds the last frame, in the frame of the mesh, for culling
Value blend_box(Surface& s, const Arguments&) {
  auto info = make<hf_blend_info>();
  check(hf_pose_get_blend_info(pose_of(s), &info));
  Doubles corners(6);
  for (int k = 0; k < 3; ++k) {
    corners[k] = info.centre[k] + info.low[k];
    corners[3 + k] = info.centre[k] + info.high[k];
  }
  return vectors(corners);
}

// pose_solve(iteration_count = 0): a frame without vertices
Value pose_solve(Surface& s, const Arguments& a) {
  check(hf_pose_solve(pose_of(s), whole(at(a, 0).number, "iteration_count"), 0, nullptr));
  return done();
}

// blend_transforms(): twelve numbers for each cluster, a 3 x 4 matrix row by row
Value blend_transforms(Surface& s, const Arguments&) {
  uint32_t count = 0;
  check(hf_pose_get_blend_transforms(pose_of(s), 0, nullptr, &count));
  Value value;
  value.kind = Value::reals;
  value.floats.resize(12 * size_t{count});
  check(hf_pose_get_blend_transforms(pose_of(s), count, value.floats.data(), nullptr));
  return value;
}

// pose_create(options = {}): replaces the pose; without it the first call makes one of defaults
Value pose_create(Surface& s, const Arguments& a) {
  auto desc = make<hf_pose_desc>();
  read_options(at(a, 0), {{"band_count", &desc.band_count},
                          {"iteration_count", &desc.iteration_count},
                          {"group_count", &desc.group_count}});
  make_again(s.pose, [&](hf_pose* out) { return hf_pose_create(s.get(), &desc, out); });
  return done();
}

// add_handles(regions, layer = 0, in_place = false, free_rotation = false). in_place: the handles start where the posed
// surface stands, not at rest. free_rotation: the pose finds their rotations. add_handles_at takes points and radii,
// then the same.
Value add_handles(Surface& s, const Arguments& a) {
  const Regions regions(at(a, 0), "regions");
  auto desc = make<hf_handles_desc>();
  desc.handle_count = regions.count();
  desc.layer = whole(at(a, 1).number, "layer");
  desc.in_place = signed_whole(at(a, 2).number, "in_place");
  desc.free_rotation = signed_whole(at(a, 3).number, "free_rotation");
  if (!regions.counts.empty()) {
    desc.region_counts = regions.counts.data();
    desc.region_vertices = regions.vertices.data();
  }
  Numbers made(desc.handle_count + 1);
  check(hf_pose_add_handles(pose_of(s), &desc, made.data()));
  made.resize(desc.handle_count);
  return numbers(made);
}

Value add_handles_at(Surface& s, const Arguments& a) {
  const size_t count = at(a, 0).list.size() / 3;
  auto desc = make<hf_handles_desc>();
  desc.handle_count = static_cast<uint32_t>(count);
  desc.points = doubles(at(a, 0), 3 * count, "points");
  desc.radii = doubles(at(a, 1), count, "radii");
  desc.layer = whole(at(a, 2).number, "layer");
  desc.in_place = signed_whole(at(a, 3).number, "in_place");
  desc.free_rotation = signed_whole(at(a, 4).number, "free_rotation");
  Numbers made(count + 1);
  check(hf_pose_add_handles(pose_of(s), &desc, made.data()));
  made.resize(count);
  return numbers(made);
}

// add_handle_at(point, radius): one handle on layer 0; returns its number
Value add_handle_at(Surface& s, const Arguments& a) {
  uint32_t made = 0;
  check(hf_pose_add_handle_at(pose_of(s), doubles(at(a, 0), 3, "point"), at(a, 1).number, &made));
  return number(made);
}

// handles, quaternions x y z w flat or null, translations flat or null
Value set_transforms(Surface& s, const Arguments& a) {
  const List handles = integers(at(a, 0), "handles");
  const size_t count = handles.count();
  const double *turns = doubles(at(a, 1), 4 * count, "rotations"),
               *shifts = doubles(at(a, 2), 3 * count, "translations");
  std::vector<hf_transform> transforms(count + 1);
  for (size_t i = 0; i < count; ++i) {
    for (size_t c = 0; turns && c < 4; ++c) transforms[i].rotation[c] = turns[4 * i + c];
    for (size_t c = 0; shifts && c < 3; ++c) transforms[i].translation[c] = shifts[3 * i + c];
  }
  check(hf_pose_set_transforms(pose_of(s), handles.count(), handles.data(), transforms.data()));
  return done();
}

// set_transform(handle, Quat or null, Vector3 or null)
Value set_transform(Surface& s, const Arguments& a) {
  hf_transform transform{};
  const double *turn = doubles(at(a, 1), 4, "rotation"), *shift = doubles(at(a, 2), 3, "translation");
  for (size_t c = 0; turn && c < 4; ++c) transform.rotation[c] = turn[c];
  for (size_t c = 0; shift && c < 3; ++c) transform.translation[c] = shift[c];
  check(hf_pose_set_transform(pose_of(s), whole(at(a, 0).number, "handle"), &transform));
  return done();
}

// x, y, z: the centroid at rest. The last frame took the handle to rotation (p - centroid) + centroid + translation.
Value handle_info(Surface& s, const Arguments& a) {
  auto info = make<hf_handle_info>();
  check(hf_pose_get_handle(pose_of(s), whole(at(a, 0).number, "handle"), &info));
  return named({{"x", info.centroid[0]},
                {"y", info.centroid[1]},
                {"z", info.centroid[2]},
                {"rotation_x", info.rotation[0]},
                {"rotation_y", info.rotation[1]},
                {"rotation_z", info.rotation[2]},
                {"rotation_w", info.rotation[3]},
                {"translation_x", info.translation[0]},
                {"translation_y", info.translation[1]},
                {"translation_z", info.translation[2]},
                {"layer", info.layer},
                {"free_rotation", info.free_rotation},
                {"following", info.following},
                {"limb_refine", info.limb_refine}});
}

Value handle_field(Surface& s, const Arguments& a) {
  Value value;
  value.kind = Value::reals;
  value.floats.resize(s.vertex_count + 1);
  const hf_array_out out = HF_ARRAY_OUT(value.floats.data(), s.vertex_count);
  check(hf_pose_get_field(pose_of(s), whole(at(a, 0).number, "handle"), &out));
  value.floats.resize(s.vertex_count);
  return value;
}

Value deform(Surface& s, const Arguments& a) {
  auto desc = make<hf_deform_desc>();
  read_options(at(a, 0), {{"iteration_count", &desc.iteration_count},
                          {"restart", &desc.restart},
                          {"refine", &desc.refine},
                          {"refine_from_last", &desc.refine_from_last}});
  Value value;
  value.kind = Value::vectors;
  value.floats.resize(3 * s.vertex_count + 1);
  std::vector<float> normals(3 * s.vertex_count + 1);
  desc.positions = HF_ARRAY_OUT(value.floats.data(), s.vertex_count);
  desc.normals = HF_ARRAY_OUT(normals.data(), s.vertex_count);
  check(hf_pose_deform(pose_of(s), &desc, nullptr));
  value.floats.resize(3 * s.vertex_count);
  normals.resize(3 * s.vertex_count);
  s.normals = std::move(normals);
  return value;
}

Value normals_of(Surface& s, const Arguments&) {
  if (s.normals.empty()) fail("deform first", HF_ERROR_EMPTY);
  Value value;
  value.kind = Value::vectors;
  value.floats = s.normals;
  return value;
}

// The pose as a skin. skin_joints(): a row for every joint; p goes to rotation (p - pivot) + translation.
Value skin_joints(Surface& s, const Arguments&) {
  auto info = make<hf_skin_info>();
  check(hf_pose_get_skin(pose_of(s), &info));
  info.joint_capacity = info.joint_count;
  Doubles pivots(3 * size_t{info.joint_count}), rotations(4 * size_t{info.joint_count}), places(pivots.size());
  info.pivots = pivots.data();
  info.rotations = rotations.data();
  info.translations = places.data();
  check(hf_pose_get_skin(pose_of(s), &info));
  Value value;
  value.kind = Value::rows;
  for (size_t j = 0; j < info.joint_count; ++j) {
    const double *p = &pivots[3 * j], *q = &rotations[4 * j], *t = &places[3 * j];
    value.table.push_back({{"pivot_x", p[0]},
                           {"pivot_y", p[1]},
                           {"pivot_z", p[2]},
                           {"x", q[0]},
                           {"y", q[1]},
                           {"z", q[2]},
                           {"w", q[3]},
                           {"translation_x", t[0]},
                           {"translation_y", t[1]},
                           {"translation_z", t[2]}});
  }
  return value;
}

// The joints and weights of the vertices as Mesh.ARRAY_BONES and ARRAY_WEIGHTS want them: influence_count (4 or 8; 0 =
// 4) a vertex, the heaviest first.
void skin_of(Surface& s, const Arguments& a, Numbers* joints, std::vector<float>* weights) {
  auto info = make<hf_skin_info>();
  info.influence_count = whole(at(a, 0).number, "influence_count");
  info.vertex_capacity = static_cast<uint32_t>(s.vertex_count);
  const size_t count = s.vertex_count * (info.influence_count == 8 ? 8 : 4);
  if (joints) {
    joints->resize(count);
    info.vertex_joints = joints->data();
  }
  if (weights) {
    weights->resize(count);
    info.vertex_weights = weights->data();
  }
  check(hf_pose_get_skin(pose_of(s), &info));
}
Value skin_bones(Surface& s, const Arguments& a) {
  Numbers joints;
  skin_of(s, a, &joints, nullptr);
  return numbers(joints);
}
Value skin_weights(Surface& s, const Arguments& a) {
  Value value;
  value.kind = Value::reals;
  skin_of(s, a, nullptr, &value.floats);
  return value;
}

// transfer_to(target, source regions, target regions, flags = null, scale = 0): plays the motion of this surface on
// another
Value transfer_to(Surface& s, const Arguments& a) {
  if (!at(a, 0).surface) fail("transfer_to needs a target surface");
  auto desc = make<hf_transfer_desc>();
  desc.scale = static_cast<float>(at(a, 4).number);
  hf_transfer raw = nullptr;
  check(hf_transfer_create(s.get(), a[0].surface->get(), &desc, &raw));
  hf::Handle<hf_transfer, hf_transfer_destroy> made(raw);
  const Regions source(at(a, 1), "source regions"), target(at(a, 2), "target regions");
  if (source.counts.size() != target.counts.size()) fail("source and target regions must be of one length");
  const List flags = integers(at(a, 3), "flags");
  if (!flags.null && flags.values.size() != source.counts.size()) fail("flags must be as many as regions");
  auto pairs = make<hf_pairs_desc>();
  pairs.pair_count = static_cast<uint32_t>(source.counts.size());
  pairs.flags = flags.data();
  pairs.source_counts = source.counts.data();
  pairs.source_vertices = source.vertices.data();
  pairs.target_counts = target.counts.data();
  pairs.target_vertices = target.vertices.data();
  check(hf_transfer_add_pairs(raw, &pairs, nullptr));
  s.transfer = std::move(made);
  s.target_count = a[0].surface->vertex_count;
  return done();
}

// transfer_set_dials(stride = 1, hip height = 0, neck follow = 0, tail follow = 0, arm space = 0, long follow = 0)
Value transfer_set_dials(Surface& s, const Arguments& a) {
  auto dials = make<hf_transfer_dials>();
  double* const fields[] = {&dials.stride,      &dials.hip_height_share, &dials.neck_follow,
                            &dials.tail_follow, &dials.arm_space,        &dials.long_follow};
  for (size_t i = 0; i < a.size(); ++i) *fields[i] = a[i].number;
  check(hf_transfer_set_dials(s.transfer.get(), &dials));
  return done();
}

// A number for every vertex of the target: 1 where it may sink into the ground.
Value transfer_sinking(Surface& s, const Arguments&) {
  std::vector<uint8_t> sinking(s.target_count + 1);
  check(hf_transfer_get_sinking(s.transfer.get(), sinking.data()));
  return numbers(Numbers(sinking.begin(), sinking.end() - 1));
}

Value transfer_apply(Surface& s, const Arguments& a) {
  auto frame = make<hf_transfer_frame>();
  frame.source_positions = rows_of(at(a, 0), 3, s.vertex_count, "positions");
  Value value;
  value.kind = Value::vectors;
  value.floats.resize(3 * s.target_count + 1);
  frame.target_positions = HF_ARRAY_OUT(value.floats.data(), s.target_count);
  check(hf_transfer_apply(s.transfer.get(), &frame));
  value.floats.resize(3 * s.target_count);
  return value;
}

}  // namespace

const std::vector<Entry>& pose_methods() {
  static const std::vector<Entry> all = {
      {"blend_rows", 0, 0, blend_rows},
      {"blend_clusters", 0, 0, blend_clusters},
      {"blend_entries", 0, 0, blend_entries},
      {"blend_positions", 0, 0, blend_vectors<&hf_blend_rows::positions>},
      {"blend_normals", 0, 0, blend_vectors<&hf_blend_rows::normals>},
      {"blend_offsets", 0, 0, blend_vectors<&hf_blend_rows::offsets>},
      {"blend_centre", 0, 0, blend_centre},
      {"blend_box", 0, 0, blend_box},
      {"blend_transforms", 0, 0, blend_transforms},
      {"pose_create", 0, 1, pose_create},
      {"pose_solve", 0, 1, pose_solve},
      {"add_handles", 1, 4, add_handles},
      {"add_handles_at", 2, 5, add_handles_at},
      {"add_handle_at", 2, 2, add_handle_at},
      {"set_transforms", 3, 3, set_transforms},
      {"set_transform", 2, 3, set_transform},
      {"handle_info", 1, 1, handle_info},
      {"handle_field", 1, 1, handle_field},
      {"deform", 0, 1, deform},
      {"normals", 0, 0, normals_of},
      {"skin_joints", 0, 0, skin_joints},
      {"skin_bones", 0, 1, skin_bones},
      {"skin_weights", 0, 1, skin_weights},
      {"transfer_to", 3, 5, transfer_to},
      {"transfer_set_dials", 0, 6, transfer_set_dials},
      {"transfer_sinking", 0, 0, transfer_sinking},
      {"transfer_apply", 1, 1, transfer_apply},
  };
  return all;
}

}  // namespace hf_godot

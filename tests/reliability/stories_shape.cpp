// Stories of analysis, directions, poses, transfers, quads, regions and skin weights.
#include "stories.h"
#include "support/arrays.h"
#include "support/peers.h"

namespace refusal {
namespace {

hf_surface made(Story& s, const Tube& tube, Allocator& memory) {
  const hf_surface_desc desc = tube.desc(memory);
  hf_surface surface = nullptr;
  s.make_factor("hf_surface_create", surface, [&] { return hf_surface_create(&desc, &surface); });
  return surface;
}

void lines(Story& s, const Tube& tube, Allocator& memory) {
  const hf_surface surface = made(s, tube, memory);
  const hf_array field = HF_ARRAY(tube.height.data(), tube.height.size());
  double levels[4] = {0, 0, 0, 0};
  s.call("hf_surface_space_levels",
         [&] { return hf_surface_space_levels(surface, &field, HF_LEVELS_LENGTH, 4, levels); });
  s.take(levels, 4);
  std::vector<double> positions(3 * 400);
  hf_isolines out = HF_INIT(hf_isolines);
  out.point_capacity = 400;
  out.line_capacity = 40;
  out.positions = positions.data();
  s.call("hf_surface_trace_isolines", [&] { return hf_surface_trace_isolines(surface, &field, 4, levels, &out); });
  s.take(positions.data(), positions.size());
  std::vector<hf_critical_point> points(Tube::vertices);
  hf_critical_info info = HF_INIT(hf_critical_info);
  s.call("hf_surface_find_critical_points",
         [&] { return hf_surface_find_critical_points(surface, &field, Tube::vertices, points.data(), &info); });
  s.take(info.point_count);
  hf_surface_destroy(surface);
}

void distances(Story& s, const Tube& tube, Allocator& memory) {
  const hf_surface surface = made(s, tube, memory);
  hf_geodesics geodesics = nullptr;
  s.make("hf_geodesics_create", geodesics, [&] { return hf_geodesics_create(surface, nullptr, &geodesics); });
  const std::uint32_t sources[2] = {3, 60};
  std::vector<double> distance(Tube::vertices);
  s.call("hf_geodesics_solve", [&] { return hf_geodesics_solve(geodesics, 2, sources, OUT(distance.data())); });
  s.take(distance.data(), distance.size());
  for (const int kind : {HF_EXTREMITIES_POISSON, HF_EXTREMITIES_GEODESIC}) {
    hf_extremities_desc wanted = HF_INIT(hf_extremities_desc);
    wanted.kind = kind;
    wanted.source_count = 8;
    hf_extremity found[16];
    std::uint32_t count = 0;
    s.call("hf_surface_find_extremities",
           [&] { return hf_surface_find_extremities(surface, &wanted, 16, found, &count); });
    s.take(count);
    if (count > 0) s.take(found[0].length);
  }
  hf_geodesics_destroy(geodesics);
  hf_surface_destroy(surface);
}

void directions(Story& s, const Tube& tube, Allocator& memory) {
  const hf_surface surface = made(s, tube, memory);
  hf_direction direction = nullptr, before = nullptr, copy = nullptr;
  hf_direction_desc desc = HF_INIT(hf_direction_desc);
  desc.degree = 2;
  s.make("hf_direction_create", direction, [&] { return hf_direction_create(surface, &desc, &direction); });
  hf_surface_destroy(surface);
  const std::uint32_t places[3] = {9, 40, 70}, to = 22;
  const double vectors[9] = {0, 1, 0, 0, -1, 0.5, 0.3, 2, 0}, angle = 1;
  std::uint32_t numbers[3] = {0, 0, 0};
  s.call("hf_direction_add_sites", [&] { return hf_direction_add_sites(direction, 3, places, vectors, numbers); });
  s.make("hf_direction_clone", before, [&] { return hf_direction_clone(direction, &before); });
  s.call("hf_direction_move_sites", [&] { return hf_direction_move_sites(direction, 1, numbers, &to); });
  s.call("hf_direction_set_vectors", [&] { return hf_direction_set_vectors(direction, 1, numbers + 1, vectors); });
  s.call("hf_direction_rotate_sites", [&] { return hf_direction_rotate_sites(direction, 1, numbers + 2, &angle); });
  s.make("hf_direction_clone", copy, [&] { return hf_direction_clone(direction, &copy); });
  s.call("hf_direction_remove_sites", [&] { return hf_direction_remove_sites(copy, 1, numbers); });
  std::vector<double> field(3 * Tube::vertices);
  for (const hf_direction d : {direction, before, copy}) {
    s.call("hf_direction_solve", [&] { return hf_direction_solve(d, OUT(field.data()), nullptr); });
    s.take(field.data(), field.size());
  }
  std::uint32_t count = 0;
  s.call("hf_direction_get_singularities",
         [&] { return hf_direction_get_singularities(direction, 0, nullptr, &count); });
  s.take(count);
  hf_direction_destroy(direction);
  hf_direction_destroy(before);
  hf_direction_destroy(copy);
}

void poses(Story& s, const Tube& tube, Allocator& memory, int mode) {
  const hf_surface surface = made(s, tube, memory);
  hf_pose pose = nullptr, copy = nullptr;
  s.make_factor(mode == POSE_SMOOTH ? "hf_pose_create" : "hf_peer_pose_create", pose,
                [&] { return create_pose_with(mode, surface, nullptr, &pose); });
  hf_surface_destroy(surface);
  const std::uint32_t counts[2] = {2 * Tube::around, 2 * Tube::around};
  hf_handles_desc handles = HF_INIT(hf_handles_desc), layer = HF_INIT(hf_handles_desc);
  handles.handle_count = 2;
  handles.region_counts = counts;
  handles.region_vertices = tube.ends.data();
  std::uint32_t numbers[2] = {0, 0}, above = 0;
  s.call("hf_pose_add_handles", [&] { return hf_pose_add_handles(pose, &handles, numbers); });
  const hf_transform turned = {{0, 0.5, 0, 0.8660254037844386}, {1, 2, 0.5}};
  s.call("hf_pose_set_transforms", [&] { return hf_pose_set_transforms(pose, 1, &numbers[1], &turned); });
  std::vector<double> posed(3 * Tube::vertices);
  std::vector<float> normals(3 * Tube::vertices);
  hf_deform_desc deform = HF_INIT(hf_deform_desc);
  deform.positions = ROWS_OUT(posed.data());
  deform.normals = ROWS_OUT(normals.data());
  deform.restart = 1;
  deform.refine = mode == POSE_SMOOTH;
  s.call("hf_pose_deform", [&] { return hf_pose_deform(pose, &deform, nullptr); });
  s.take(posed.data(), posed.size());
  s.make("hf_pose_clone", copy, [&] { return hf_pose_clone(pose, &copy); });
  const double radius = 0.2;  // one vertex
  layer.handle_count = 1;
  layer.points = tube.positions.data() + 3 * 4 * Tube::around;
  layer.radii = &radius;
  layer.layer = 1;
  s.call("hf_pose_add_handles", [&] { return hf_pose_add_handles(copy, &layer, &above); });
  s.call("hf_pose_deform", [&] { return hf_pose_deform(copy, &deform, nullptr); });
  s.take(posed.data(), posed.size());
  s.call("hf_pose_remove_handles", [&] { return hf_pose_remove_handles(copy, 1, &above); });
  hf_skin_info skin = HF_INIT(hf_skin_info);
  s.call("hf_pose_get_skin", [&] { return hf_pose_get_skin(pose, &skin); });
  s.take(skin.joint_count);
  hf_pose_destroy(pose);
  hf_pose_destroy(copy);
}
void smooth_pose(Story& s, const Tube& tube, Allocator& memory) { poses(s, tube, memory, POSE_SMOOTH); }
void paper_pose(Story& s, const Tube& tube, Allocator& memory) { poses(s, tube, memory, POSE_PAPER); }

// The tube and a second one beside it, which is a rigid piece: a handle takes all of it. On the first tube a handle is
// held back.
struct TwoTubes {
  std::vector<double> positions;
  std::vector<std::uint32_t> triangles;
  explicit TwoTubes(const Tube& tube) : positions(tube.positions), triangles(tube.triangles) {
    for (std::size_t i = 0; i < tube.positions.size(); ++i) positions.push_back(tube.positions[i] + 3.0 * (i % 3 == 0));
    for (const std::uint32_t v : tube.triangles) triangles.push_back(v + Tube::vertices);
  }
};

void held_poses(Story& s, const Tube& tube, Allocator& memory) {
  const TwoTubes two(tube);
  hf_surface_desc desc = tube.desc(memory);
  desc.positions = HF_ARRAY(two.positions.data(), 2 * Tube::vertices);
  desc.triangles = HF_ARRAY(two.triangles.data(), two.triangles.size() / 3);
  hf_surface surface = nullptr;
  hf_pose pose = nullptr, copy = nullptr;
  s.make_factor("hf_surface_create", surface, [&] { return hf_surface_create(&desc, &surface); });
  s.make_factor("hf_pose_create", pose, [&] { return hf_pose_create(surface, nullptr, &pose); });
  hf_surface_destroy(surface);
  const std::uint32_t piece = Tube::vertices + 5;
  s.call("hf_pose_set_rigid_pieces", [&] { return hf_pose_set_rigid_pieces(pose, 1, &piece); });
  std::vector<std::uint32_t> regions(tube.ends);
  regions.push_back(piece);
  regions.push_back(4 * Tube::around);
  const std::uint32_t counts[4] = {2 * Tube::around, 2 * Tube::around, 1, 1};
  hf_handles_desc handles = HF_INIT(hf_handles_desc);
  handles.handle_count = 4;
  handles.region_counts = counts;
  handles.region_vertices = regions.data();
  std::uint32_t numbers[4] = {0, 0, 0, 0};
  s.call("hf_pose_add_handles", [&] { return hf_pose_add_handles(pose, &handles, numbers); });
  hf_handle_info info = HF_INIT(hf_handle_info);
  s.call("hf_pose_get_handle", [&] { return hf_pose_get_handle(pose, numbers[2], &info); });
  s.take(info.vertex_count);
  const std::uint32_t held[2] = {numbers[1], numbers[3]};
  const auto follows = [&](double wanted) {
    return hf_pose_get_handle(pose, held[0], &info) == HF_OK && info.following == wanted;
  };
  s.call(
      "hf_pose_set_following", [&] { return hf_pose_set_following(pose, 2, held, 0.3); }, [&] { return follows(1); });
  const auto refines = [&](std::int32_t wanted) {
    return hf_pose_get_handle(pose, held[0], &info) == HF_OK && info.limb_refine == wanted;
  };
  s.call(
      "hf_pose_set_limb_refine", [&] { return hf_pose_set_limb_refine(pose, 2, held, 2); }, [&] { return refines(0); });
  const hf_transform turned = {{0, 0.5, 0, 0.8660254037844386}, {1, 2, 0.5}};
  for (const std::uint32_t number : {numbers[1], numbers[2]})
    s.call("hf_pose_set_transforms", [&] { return hf_pose_set_transforms(pose, 1, &number, &turned); });
  std::vector<double> posed(6 * Tube::vertices);
  hf_deform_desc deform = HF_INIT(hf_deform_desc);
  deform.positions = HF_ARRAY_OUT(posed.data(), 2 * Tube::vertices);
  deform.restart = deform.refine = 1;
  const auto frame = [&](hf_pose of) {
    s.call("hf_pose_deform", [&] { return hf_pose_deform(of, &deform, nullptr); });
    s.take(posed.data(), posed.size());
  };
  frame(pose);
  s.make("hf_pose_clone", copy, [&] { return hf_pose_clone(pose, &copy); });
  deform.restart = 0;
  s.call("hf_pose_set_free_rotations", [&] { return hf_pose_set_free_rotations(copy, 1, &numbers[3], 1); });
  frame(copy);
  s.call("hf_pose_remove_handles", [&] { return hf_pose_remove_handles(copy, 1, &numbers[3]); });
  s.call("hf_pose_set_rigid_pieces", [&] { return hf_pose_set_rigid_pieces(copy, 0, nullptr); });
  frame(copy);
  s.call(
      "hf_pose_set_following", [&] { return hf_pose_set_following(pose, 2, held, 1); }, [&] { return follows(0.3); });
  frame(pose);
  hf_pose_destroy(pose);
  hf_pose_destroy(copy);
}

void transfer(Story& s, const Tube& tube, Allocator& memory) {
  // the target lacks the harmonic factor that transfers use
  hf_surface_desc bent = tube.desc(memory);
  bent.field_kind = HF_FIELD_BIHARMONIC;
  const hf_surface source = made(s, tube, memory);
  hf_surface target = nullptr;
  s.make_factor("hf_surface_create", target, [&] { return hf_surface_create(&bent, &target); });
  hf_transfer motion = nullptr;
  s.make_factor("hf_transfer_create", motion, [&] { return hf_transfer_create(source, target, nullptr, &motion); });
  hf_surface_destroy(source);
  hf_surface_destroy(target);
  const std::uint32_t counts[2] = {2 * Tube::around, 2 * Tube::around};
  hf_pairs_desc pairs = HF_INIT(hf_pairs_desc);
  pairs.pair_count = 2;
  pairs.source_counts = pairs.target_counts = counts;
  pairs.source_vertices = pairs.target_vertices = tube.ends.data();
  std::uint32_t numbers[2] = {0, 0};
  s.call("hf_transfer_add_pairs", [&] { return hf_transfer_add_pairs(motion, &pairs, numbers); });
  hf_pair_info pair = HF_INIT(hf_pair_info);  // solves the fields of the pairs
  s.call("hf_transfer_get_pair", [&] { return hf_transfer_get_pair(motion, numbers[1], &pair); });
  s.take(pair.confidence);
  std::vector<double> posed(tube.positions), out(3 * Tube::vertices);
  for (std::size_t v = 0; v < Tube::vertices; ++v) posed[3 * v] += 0.03 * posed[3 * v + 1] * posed[3 * v + 1];
  hf_transfer_frame frame = HF_INIT(hf_transfer_frame);
  frame.source_positions = HF_ARRAY(posed.data(), posed.size() / 3);
  frame.target_positions = ROWS_OUT(out.data());
  s.call("hf_transfer_apply", [&] { return hf_transfer_apply(motion, &frame); });
  s.take(out.data(), out.size());
  hf_transfer_dials dials = HF_INIT(hf_transfer_dials);
  dials.stride = 1.2;
  dials.hip_height_share = 0.1;
  s.call("hf_transfer_set_dials", [&] { return hf_transfer_set_dials(motion, &dials); });
  const std::uint32_t piece = 0;
  s.call("hf_transfer_set_rigid_pieces", [&] { return hf_transfer_set_rigid_pieces(motion, 1, &piece); });
  s.call("hf_transfer_apply", [&] { return hf_transfer_apply(motion, &frame); });
  s.call("hf_transfer_set_rigid_pieces", [&] { return hf_transfer_set_rigid_pieces(motion, 0, nullptr); });
  s.call("hf_transfer_apply", [&] { return hf_transfer_apply(motion, &frame); });
  s.take(out.data(), out.size());
  hf_transfer_info info = HF_INIT(hf_transfer_info);
  s.call("hf_transfer_get_info", [&] { return hf_transfer_get_info(motion, &info); });
  hf_skin_info skin = HF_INIT(hf_skin_info);
  s.call("hf_transfer_get_skin", [&] { return hf_transfer_get_skin(motion, &skin); });
  s.take(skin.joint_count);
  std::vector<double> pivots(3 * std::size_t{skin.joint_count});
  skin.joint_capacity = skin.joint_count;
  skin.pivots = pivots.data();
  s.call("hf_transfer_get_skin", [&] { return hf_transfer_get_skin(motion, &skin); });
  s.take(pivots.data(), pivots.size());
  s.call("hf_transfer_remove_pairs", [&] { return hf_transfer_remove_pairs(motion, 1, numbers); });
  s.call("hf_transfer_apply", [&] { return hf_transfer_apply(motion, &frame); });
  s.take(out.data(), out.size());
  hf_transfer_destroy(motion);
}

void quads(Story& s, const Tube& tube, Allocator& memory) {
  const hf_surface surface = made(s, tube, memory);
  hf_quads_desc desc = HF_INIT(hf_quads_desc);
  desc.edge_length = 2;
  desc.relax_count = 3;
  hf_quads mesh = nullptr;
  s.make("hf_quads_create", mesh, [&] { return hf_quads_create(surface, &desc, &mesh); });
  hf_quads_info info = HF_INIT(hf_quads_info);
  s.call("hf_quads_get_info", [&] { return hf_quads_get_info(mesh, &info); });
  s.take(info.vertex_count);
  s.take(info.face_count);
  std::vector<double> positions(3 * std::size_t{info.vertex_count});
  hf_quads_mesh out = HF_INIT(hf_quads_mesh);
  out.vertex_capacity = info.vertex_count;
  out.positions = positions.data();
  s.call("hf_quads_get_mesh", [&] { return hf_quads_get_mesh(mesh, &out); });
  s.take(positions.data(), positions.size());
  hf_quads_destroy(mesh);
  hf_surface_destroy(surface);
}

// The first update makes what later ones keep.
void updates(Story& s, const Tube& tube, Allocator& memory) {
  const hf_surface surface = made(s, tube, memory);
  hf_quads_desc desc = HF_INIT(hf_quads_desc);
  desc.face_count = 40;
  desc.relax_count = HF_NO_INDEX;
  hf_quads mesh = nullptr;
  hf_quads_info info = HF_INIT(hf_quads_info);
  s.make("hf_quads_create", mesh, [&] { return hf_quads_create(surface, &desc, &mesh); });
  for (const double z : {0.0, 1.0}) {
    desc.symmetry_plane[2] = z;
    s.call("hf_quads_update", [&] { return hf_quads_update(mesh, &desc); });
    s.call("hf_quads_get_info", [&] { return hf_quads_get_info(mesh, &info); });
    s.take(info.vertex_count);
    s.take(info.face_count);
  }
  hf_quads_destroy(mesh);
  hf_surface_destroy(surface);
}

void flow(Story& s, const Tube& tube, Allocator& memory) {
  const hf_surface surface = made(s, tube, memory);
  hf_flow flow = nullptr;
  s.make("hf_flow_create", flow, [&] { return hf_flow_create(surface, &flow); });
  hf_surface_destroy(surface);
  const hf_array field = HF_ARRAY(tube.height.data(), tube.height.size());
  std::vector<double> positions(3 * 2000);
  hf_streamlines lines = HF_INIT(hf_streamlines);
  lines.wanted_count = 6;
  lines.point_capacity = 2000;
  lines.line_capacity = 100;
  lines.positions = positions.data();
  s.call("hf_flow_trace", [&] { return hf_flow_trace(flow, &field, &lines); });
  s.take(lines.point_count);
  s.take(positions.data(), positions.size());
  hf_flow_destroy(flow);
}

void regions(Story& s, const Tube& tube, Allocator& memory) {
  const hf_surface surface = made(s, tube, memory);
  hf_region region = nullptr, copy = nullptr;
  s.make_factor("hf_region_create", region, [&] { return hf_region_create(surface, nullptr, &region); });
  hf_surface_destroy(surface);
  const std::uint32_t a = 4 * Tube::around, inside[6] = {a, a + 1, a + 2, a + 8, a + 9, a + 10};
  hf_region_edit_desc edit = HF_INIT(hf_region_edit_desc), grow = HF_INIT(hf_region_edit_desc);
  edit.add_count = 6;
  edit.add_vertices = inside;
  grow.ring_count = 1;
  s.call("hf_region_edit", [&] { return hf_region_edit(region, &edit); });
  s.make("hf_region_clone", copy, [&] { return hf_region_clone(region, &copy); });
  s.call("hf_region_edit", [&] { return hf_region_edit(region, &grow); });
  std::vector<double> out(3 * Tube::vertices);
  hf_morph_desc morph = HF_INIT(hf_morph_desc);
  morph.weight = 0.5;
  morph.positions = ROWS_OUT(out.data());
  s.call("hf_region_morph", [&] { return hf_region_morph(region, &morph); });
  s.take(out.data(), out.size());
  hf_detail detail = nullptr;
  s.make("hf_detail_create", detail, [&] { return hf_detail_create(region, copy, nullptr, &detail); });
  s.call("hf_detail_morph", [&] { return hf_detail_morph(detail, &morph); });
  s.take(out.data(), out.size());
  // a curve round the tube that cuts through triangles
  const std::uint32_t round[4] = {a, a + Tube::around + 2, a + 4, a + Tube::around + 6};
  hf_curve_desc curve = HF_INIT(hf_curve_desc);
  curve.point_count = 4;
  curve.vertices = round;
  hf_region_edit_desc enclose = HF_INIT(hf_region_edit_desc);
  enclose.curve = &curve;
  s.call("hf_region_edit", [&] { return hf_region_edit(copy, &enclose); });
  s.call("hf_region_morph", [&] { return hf_region_morph(copy, &morph); });
  s.take(out.data(), out.size());
  hf_region_destroy(region);
  hf_region_destroy(copy);
  hf_detail_destroy(detail);
}

// Reads weights whole. A refused call wrote nothing.
struct WeightsRead {
  std::vector<std::uint32_t> joints = std::vector<std::uint32_t>(4 * Tube::vertices, 77);
  std::vector<float> weights = std::vector<float>(4 * Tube::vertices, 77.0f);
  hf_weights_out desc() {
    hf_weights_out out = HF_INIT(hf_weights_out);
    out.vertex_capacity = Tube::vertices;
    out.joints = joints.data();
    out.weights = weights.data();
    return out;
  }
  bool untouched() const { return joints == WeightsRead().joints && weights == WeightsRead().weights; }
  void take(Story& s) const {
    s.take(weights.data(), weights.size());
    for (const std::uint32_t joint : joints) s.take(joint);
  }
};

void skin_weights(Story& s, const Tube& tube, Allocator& memory) {
  hf_surface_desc bent = tube.desc(memory);  // without the harmonic factor that weights use
  bent.field_kind = HF_FIELD_BIHARMONIC;
  hf_surface surface = nullptr;
  s.make_factor("hf_surface_create", surface, [&] { return hf_surface_create(&bent, &surface); });
  double heads[9] = {0, 0.5, 0, 0, 3, 0, 0, 6, 0}, tails[9] = {0, 3, 0, 0, 6, 0, 0, 8, 0};
  const std::uint32_t parents[3] = {HF_NO_INDEX, 0, 1}, sources[3] = {1, 0, 2};
  hf_joints_desc bones = HF_INIT(hf_joints_desc);
  bones.joint_count = 3;
  bones.heads = heads;
  bones.tails = tails;
  bones.parents = parents;
  hf_weights weights = nullptr, before = nullptr, copy = nullptr;
  s.make("hf_weights_create", weights, [&] { return hf_weights_create(surface, &bones, 4, &weights); });
  s.make("hf_weights_clone", before, [&] { return hf_weights_clone(weights, &before); });
  const std::uint32_t places[3] = {9, 44, 70}, joints[6] = {0, 1, 1, 2, 2, 0}, locks[2] = {1, 2};
  const float shares[6] = {0.25f, 0.75f, 1, 0, 0.5f, 0.5f};
  const double radii[3] = {0, 0.9, 0};
  hf_pins_desc pins = HF_INIT(hf_pins_desc);
  pins.pin_count = 3;
  pins.vertices = places;
  pins.radii = radii;
  pins.influence_count = 2;
  pins.joints = joints;
  pins.weights = shares;
  const auto read = [&](hf_weights handle) {
    WeightsRead seen;
    hf_weights_out out = seen.desc();
    s.call("hf_weights_get", [&] { return hf_weights_get(handle, &out); });
    seen.take(s);
    return seen;
  };
  s.call("hf_weights_set_pins", [&] { return hf_weights_set_pins(weights, &pins); });
  read(weights);
  s.make("hf_weights_clone", copy, [&] { return hf_weights_clone(weights, &copy); });
  s.call("hf_weights_set_locks", [&] { return hf_weights_set_locks(copy, 2, locks, nullptr); });
  heads[7] = 5;
  bones.sources = sources;
  s.call("hf_weights_set_joints", [&] { return hf_weights_set_joints(copy, &bones); });
  const WeightsRead given = read(copy);
  read(before);
  std::uint32_t flags[3] = {77, 77, 77};
  s.call(
      "hf_weights_get_helpers",
      [&] { return hf_weights_get_helpers(weights, "root\narm.L\narm.R\n", 3, flags, nullptr); },
      [&] { return flags[0] == 77; });
  s.call("hf_weights_get_joints", [&] { return hf_weights_get_joints(weights, 3, flags, nullptr, nullptr); });
  hf_weights_destroy(weights);
  hf_weights_destroy(before);
  hf_weights_destroy(copy);

  WeightsRead carried, mirrored;
  hf_weights_out out = carried.desc(), turned = mirrored.desc();
  hf_weights_transfer_desc carry = HF_INIT(hf_weights_transfer_desc);
  carry.source_influence_count = 4;
  carry.joints = given.joints.data();
  carry.weights = given.weights.data();
  s.call(
      "hf_weights_transfer", [&] { return hf_weights_transfer(surface, surface, &carry, &out, nullptr); },
      [&] { return carried.untouched(); });
  carried.take(s);
  hf_weights_mirror_desc mirror = HF_INIT(hf_weights_mirror_desc);
  mirror.joint_count = 3;
  mirror.heads = heads;
  mirror.names = "spine\narm.L\narm.R\n";
  mirror.source_influence_count = 4;
  mirror.joints = given.joints.data();
  mirror.weights = given.weights.data();
  mirror.distance = 0.05;
  mirror.angle = 0.2;  // few vertices match, so that a field fills in the others
  s.call(
      "hf_weights_mirror",
      [&] { return hf_weights_mirror(surface, &mirror, &turned, flags, nullptr, nullptr, nullptr); },
      [&] { return mirrored.untouched(); });
  mirrored.take(s);
  hf_surface_destroy(surface);
}

}  // namespace

std::vector<Chapter> shape_chapters() {
  return {{"lines", lines},           {"distances", distances},
          {"directions", directions}, {"smooth_pose", smooth_pose},
          {"paper_pose", paper_pose}, {"held_poses", held_poses},
          {"transfer", transfer},     {"quads", quads},
          {"updates", updates},       {"flow", flow},
          {"regions", regions},       {"weights", skin_weights}};
}

}  // namespace refusal

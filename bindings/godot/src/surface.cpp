#include "arguments.h"

namespace hf_godot {

hf_pose pose_of(Surface& s) {
  if (!s.pose) {
    hf_pose raw = nullptr;
    check(hf_pose_create(s.solver.get(), nullptr, &raw));
    s.pose = hf::Handle<hf_pose, hf_pose_destroy>(raw);
  }
  return s.pose.get();
}

namespace {

Value create(Surface& s, const Arguments& a) {
  auto desc = make<hf_create_desc>();
  const std::map<std::string, int32_t*> whole_options = {{"weld", &desc.weld},
                                                         {"operator_kind", &desc.operator_kind},
                                                         {"engine", &desc.engine},
                                                         {"ordering", &desc.ordering},
                                                         {"field_kind", &desc.field_kind}};
  const std::map<std::string, uint32_t*> counts = {{"channel_count", &desc.channel_count},
                                                   {"thread_count", &desc.thread_count},
                                                   {"vertex_limit", &desc.vertex_limit},
                                                   {"site_limit", &desc.site_limit}};
  for (const auto& [name, value] : at(a, 2).named) {
    if (auto i = whole_options.find(name); i != whole_options.end())
      *i->second = static_cast<int32_t>(value);
    else if (auto c = counts.find(name); c != counts.end())
      *c->second = whole(value, name.c_str());
    else if (name == "penalty")
      desc.penalty = value;
    else
      fail("no option '" + name + "'");
  }
  if (at(a, 0).null) fail("positions are null", HF_ERROR_NULL_POINTER);
  const Doubles& positions = at(a, 0).list;
  const List triangles = integers(at(a, 1), "triangles");
  if (positions.size() % 3 || triangles.values.size() % 3) fail("positions and triangles hold three numbers each");
  desc.vertex_count = static_cast<uint32_t>(positions.size() / 3), desc.positions_f64 = positions.data();
  desc.triangle_count = static_cast<uint32_t>(triangles.values.size() / 3), desc.triangles = triangles.data();
  auto factor = make<hf_factor_desc>();
  if (!at(a, 3).bytes.empty()) {
    factor.bytes = a[3].bytes.data(), factor.byte_count = a[3].bytes.size();
    desc.saved_factor = &factor;
  }
  hf_solver raw = nullptr;
  check(hf_create(&desc, &raw));
  s.forget();
  s.solver = hf::Handle<hf_solver, hf_solver_destroy>(raw), s.vertex_count = desc.vertex_count;
  return done();
}

Value clone_from(Surface& s, const Arguments& a) {
  if (!at(a, 0).surface) fail("clone_from needs a surface");
  hf_solver raw = nullptr;
  check(hf_solver_clone(a[0].surface->solver.get(), &raw));
  s.forget();
  s.solver = hf::Handle<hf_solver, hf_solver_destroy>(raw), s.vertex_count = a[0].surface->vertex_count;
  return done();
}

Value dispose(Surface& s, const Arguments&) {
  s.forget();
  s.solver = {};
  return done();
}

Value add_sites(Surface& s, const Arguments& a) {
  const List vertices = integers(at(a, 0), "vertices"), triangles = integers(at(a, 4), "triangles");
  const size_t count = (vertices.null ? triangles : vertices).count();
  auto desc = make<hf_sites_desc>();
  desc.site_count = static_cast<uint32_t>(count), desc.vertices = vertices.data(), desc.triangles = triangles.data();
  desc.values = doubles(at(a, 1), count, "values"), desc.stiffness = doubles(at(a, 2), count, "stiffness"),
  desc.radii = doubles(at(a, 3), count, "radii");
  desc.barycentrics = doubles(at(a, 5), 3 * count, "barycentrics");
  Numbers made(count + 1);
  check(hf_add_sites(s.solver.get(), &desc, made.data()));
  made.resize(count);
  return numbers(made);
}

Value remove_sites(Surface& s, const Arguments& a) {
  const List sites = integers(at(a, 0), "sites");
  check(hf_remove_sites(s.solver.get(), sites.count(), sites.data()));
  return done();
}

Value move_sites(Surface& s, const Arguments& a) {
  const List sites = integers(at(a, 0), "sites"), vertices = integers(at(a, 1), "vertices");
  auto to = make<hf_sites_desc>();
  to.site_count = vertices.count(), to.vertices = vertices.data();
  check(hf_solver_move_sites(s.solver.get(), sites.count(), sites.data(), &to));
  return done();
}

Value set_site_values(Surface& s, const Arguments& a) {
  const List sites = integers(at(a, 0), "sites");
  check(hf_solver_set_values(s.solver.get(), sites.count(), sites.data(), doubles(at(a, 1), sites.count(), "values")));
  return done();
}

Value record(Surface& s, const Arguments&) { return check(hf_solver_record(s.solver.get())), done(); }
Value undo(Surface& s, const Arguments&) { return check(hf_solver_undo(s.solver.get())), done(); }
Value redo(Surface& s, const Arguments&) { return check(hf_solver_redo(s.solver.get())), done(); }

Value solve(Surface& s, const Arguments&) {
  Value value;
  value.kind = Value::reals, value.floats.resize(s.vertex_count + 1);
  check(hf_solve(s.solver.get(), value.floats.data(), 0, nullptr));
  value.floats.resize(s.vertex_count);
  return value;
}

Value solve_at(Surface& s, const Arguments& a) {
  const List vertices = integers(at(a, 0), "vertices");
  Doubles found(vertices.count() + 1);
  check(hf_solver_solve_at(s.solver.get(), vertices.count(), vertices.data(), found.data()));
  Value value;
  value.kind = Value::reals, value.floats.assign(found.begin(), found.end() - 1);
  return value;
}

// edit_sites(remove, move, move_to, set, set_values, add, add_values): one batch, all or nothing; lists may be null.
// Returns the numbers of the sites added.
Value edit_sites(Surface& s, const Arguments& a) {
  const List remove = integers(at(a, 0), "remove"), move = integers(at(a, 1), "move"),
             move_to = integers(at(a, 2), "move_to"), set = integers(at(a, 3), "set"), add = integers(at(a, 5), "add");
  if (move.values.size() != move_to.values.size()) fail("move and move_to must be of one length");
  auto edit = make<hf_edit_desc>();
  auto places = make<hf_sites_desc>(), added = make<hf_sites_desc>();
  edit.remove_count = static_cast<uint32_t>(remove.values.size()), edit.remove_sites = remove.data();
  edit.move_count = static_cast<uint32_t>(move.values.size()), edit.move_sites = move.data(), edit.move_to = &places;
  places.site_count = edit.move_count, places.vertices = move_to.data();
  edit.set_count = static_cast<uint32_t>(set.values.size()), edit.set_sites = set.data();
  edit.set_values = doubles(at(a, 4), set.values.size(), "set_values");
  added.site_count = static_cast<uint32_t>(add.values.size()), added.vertices = add.data();
  added.values = doubles(at(a, 6), add.values.size(), "add_values");
  if (!add.values.empty()) edit.add = &added;
  Numbers made(add.values.size() + 1);
  check(hf_solver_edit_sites(s.solver.get(), &edit, made.data()));
  made.pop_back();
  return numbers(made);
}

// certify(tolerance = 0): how right the field is; fails with HF_ERROR_INACCURATE when it is not
Value certify(Surface& s, const Arguments& a) {
  auto found = make<hf_certificate>();
  found.tolerance = at(a, 0).number;
  check(hf_solver_certify(s.solver.get(), &found));
  return named({{"tolerance", found.tolerance},
                {"value_range", found.value_range},
                {"residual", found.residual},
                {"site_error", found.site_error},
                {"overshoot", found.overshoot},
                {"overshoot_checked", found.overshoot_checked},
                {"worst_vertex", found.worst_vertex}});
}

Value statistics(Surface& s, const Arguments&) {
  auto figures = make<hf_solver_statistics>();
  check(hf_solver_get_statistics(s.solver.get(), &figures));
  Value value;
  value.kind = Value::named;
  value.fields = {{"factorisation_count", figures.factorisation_count},
                  {"site_count", figures.site_count},
                  {"factor_loaded", figures.factor_loaded},
                  {"memory_bytes", figures.memory_bytes}};
  return value;
}

Value report(Surface& s, const Arguments&) {
  auto found = make<hf_surface_report>();
  check(hf_surface_get_report(s.solver.get(), &found));
  Value value;
  value.kind = Value::named;
  value.fields = {{"vertex_count", found.vertex_count},
                  {"component_count", found.component_count},
                  {"boundary_edge_count", found.boundary_edge_count},
                  {"isolated_vertex_count", found.isolated_vertex_count},
                  {"non_manifold_edge_count", found.non_manifold_edge_count}};
  return value;
}

Value save_factor(Surface& s, const Arguments&) {
  size_t size = 0;
  check(hf_get_factor_size(s.solver.get(), &size));
  Value value;
  value.kind = Value::bytes, value.octets.resize(size);
  check(hf_surface_save(s.solver.get(), value.octets.data(), size));
  return value;
}

Value add_handles(Surface& s, const Arguments& a) {
  const Regions regions(at(a, 0), "regions");
  auto desc = make<hf_handles_desc>();
  desc.handle_count = regions.count(), desc.layer = whole(at(a, 1).number, "layer");
  if (!regions.counts.empty())
    desc.region_counts = regions.counts.data(), desc.region_vertices = regions.vertices.data();
  Numbers made(desc.handle_count + 1);
  check(hf_pose_add_handles(pose_of(s), &desc, made.data()));
  made.resize(desc.handle_count);
  return numbers(made);
}

Value add_handles_at(Surface& s, const Arguments& a) {
  const size_t count = at(a, 0).list.size() / 3;
  auto desc = make<hf_handles_desc>();
  desc.handle_count = static_cast<uint32_t>(count), desc.points = doubles(at(a, 0), 3 * count, "points"),
  desc.radii = doubles(at(a, 1), count, "radii");
  desc.layer = whole(at(a, 2).number, "layer");
  Numbers made(count + 1);
  check(hf_pose_add_handles(pose_of(s), &desc, made.data()));
  made.resize(count);
  return numbers(made);
}

Value remove_handles(Surface& s, const Arguments& a) {
  const List handles = integers(at(a, 0), "handles");
  check(hf_pose_remove_handles(pose_of(s), handles.count(), handles.data()));
  return done();
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

Value handle_centroid(Surface& s, const Arguments& a) {
  auto info = make<hf_handle_info>();
  check(hf_pose_get_handle(pose_of(s), whole(at(a, 0).number, "handle"), &info));
  Value value;
  value.kind = Value::named;
  value.fields = {{"x", info.centroid[0]}, {"y", info.centroid[1]}, {"z", info.centroid[2]}, {"layer", info.layer}};
  return value;
}

Value handle_field(Surface& s, const Arguments& a) {
  Value value;
  value.kind = Value::reals, value.floats.resize(s.vertex_count + 1);
  check(hf_pose_get_field(pose_of(s), whole(at(a, 0).number, "handle"), value.floats.data(), 0));
  value.floats.resize(s.vertex_count);
  return value;
}

Value deform(Surface& s, const Arguments& a) {
  auto desc = make<hf_deform_desc>();
  for (const auto& [name, number] : at(a, 0).named) {
    if (name == "iteration_count")
      desc.iteration_count = whole(number, "iteration_count");
    else if (name == "restart")
      desc.restart = number != 0;
    else if (name == "refine")
      desc.refine = number != 0;
    else
      fail("no option '" + name + "'");
  }
  Value value;
  value.kind = Value::vectors, value.floats.resize(3 * s.vertex_count + 1);
  std::vector<float> normals(3 * s.vertex_count + 1);
  desc.positions = value.floats.data(), desc.normals = normals.data();
  check(hf_pose_deform(pose_of(s), &desc, nullptr));
  value.floats.resize(3 * s.vertex_count), normals.resize(3 * s.vertex_count);
  s.normals = std::move(normals);
  return value;
}

Value normals_of(Surface& s, const Arguments&) {
  if (s.normals.empty()) fail("deform first", HF_ERROR_EMPTY);
  Value value;
  value.kind = Value::vectors, value.floats = s.normals;
  return value;
}

// The pose as a skin. skin_joints(): a row for every joint; p goes to rotation (p - pivot) + translation.
Value skin_joints(Surface& s, const Arguments&) {
  auto info = make<hf_skin_info>();
  check(hf_pose_get_skin(pose_of(s), &info));
  Doubles pivots(3 * size_t{info.joint_count}), rotations(4 * size_t{info.joint_count}), places(pivots.size());
  info.pivots = pivots.data(), info.rotations = rotations.data(), info.translations = places.data();
  check(hf_pose_get_skin(pose_of(s), &info));
  Value value;
  value.kind = Value::rows;
  for (size_t j = 0; j < info.joint_count; ++j) {
    const double *p = &pivots[3 * j], *q = &rotations[4 * j], *t = &places[3 * j];
    value.table.push_back({{"pivot_x", p[0]}, {"pivot_y", p[1]}, {"pivot_z", p[2]},
                           {"x", q[0]}, {"y", q[1]}, {"z", q[2]}, {"w", q[3]},
                           {"translation_x", t[0]}, {"translation_y", t[1]}, {"translation_z", t[2]}});
  }
  return value;
}

// The joints and weights of the vertices as Mesh.ARRAY_BONES and ARRAY_WEIGHTS want them: weight_count (4 or 8; 0 = 4)
// a vertex, the heaviest first.
void skin_of(Surface& s, const Arguments& a, Numbers* joints, std::vector<float>* weights) {
  auto info = make<hf_skin_info>();
  info.weight_count = whole(at(a, 0).number, "weight_count");
  const size_t count = s.vertex_count * (info.weight_count == 8 ? 8 : 4);
  if (joints) joints->resize(count), info.vertex_joints = joints->data();
  if (weights) weights->resize(count), info.vertex_weights = weights->data();
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

// The motion of this surface played on another: transfer_to(target, source regions, target regions, flags or null,
// scale).
Value transfer_to(Surface& s, const Arguments& a) {
  if (!at(a, 0).surface) fail("transfer_to needs a target surface");
  auto desc = make<hf_transfer_desc>();
  desc.scale = static_cast<float>(at(a, 4).number);
  hf_transfer raw = nullptr;
  check(hf_transfer_create(s.solver.get(), a[0].surface->solver.get(), &desc, &raw));
  hf::Handle<hf_transfer, hf_transfer_destroy> made(raw);
  const Regions source(at(a, 1), "source regions"), target(at(a, 2), "target regions");
  if (source.counts.size() != target.counts.size()) fail("source and target regions must be of one length");
  const List flags = integers(at(a, 3), "flags");
  if (!flags.null && flags.values.size() != source.counts.size()) fail("flags must be as many as regions");
  auto pairs = make<hf_pairs_desc>();
  pairs.pair_count = static_cast<uint32_t>(source.counts.size()), pairs.flags = flags.data();
  pairs.source_counts = source.counts.data(), pairs.source_vertices = source.vertices.data();
  pairs.target_counts = target.counts.data(), pairs.target_vertices = target.vertices.data();
  check(hf_transfer_add_pairs(raw, &pairs, nullptr));
  s.transfer = std::move(made), s.target_count = a[0].surface->vertex_count;
  return done();
}

Value transfer_apply(Surface& s, const Arguments& a) {
  auto frame = make<hf_transfer_frame>();
  frame.source_positions_f64 = doubles(at(a, 0), 3 * s.vertex_count, "positions");
  Value value;
  value.kind = Value::vectors, value.floats.resize(3 * s.target_count + 1);
  frame.target_positions = value.floats.data();
  check(hf_transfer_apply(s.transfer.get(), &frame));
  value.floats.resize(3 * s.target_count);
  return value;
}

}  // namespace

namespace {

std::vector<Entry> all_methods() {
  std::vector<Entry> all = {{"create", 2, 4, create},
                            {"clone_from", 1, 1, clone_from},
                            {"dispose", 0, 0, dispose},
                            {"add_sites", 2, 6, add_sites},
                            {"remove_sites", 1, 1, remove_sites},
                            {"move_sites", 2, 2, move_sites},
                            {"set_site_values", 2, 2, set_site_values},
                            {"record", 0, 0, record},
                            {"undo", 0, 0, undo},
                            {"redo", 0, 0, redo},
                            {"solve", 0, 0, solve},
                            {"solve_at", 1, 1, solve_at},
                            {"edit_sites", 7, 7, edit_sites},
                            {"certify", 0, 1, certify},
                            {"statistics", 0, 0, statistics},
                            {"report", 0, 0, report},
                            {"save_factor", 0, 0, save_factor},
                            {"add_handles", 1, 2, add_handles},
                            {"add_handles_at", 2, 3, add_handles_at},
                            {"remove_handles", 1, 1, remove_handles},
                            {"set_transforms", 3, 3, set_transforms},
                            {"handle_info", 1, 1, handle_centroid},
                            {"handle_field", 1, 1, handle_field},
                            {"deform", 0, 1, deform},
                            {"normals", 0, 0, normals_of},
                            {"skin_joints", 0, 0, skin_joints},
                            {"skin_bones", 0, 1, skin_bones},
                            {"skin_weights", 0, 1, skin_weights},
                            {"transfer_to", 3, 5, transfer_to},
                            {"transfer_apply", 1, 1, transfer_apply}};
  all.insert(all.end(), field_methods().begin(), field_methods().end());
  all.insert(all.end(), region_methods().begin(), region_methods().end());
  return all;
}

}  // namespace

const std::vector<Entry>& methods() {
  static const std::vector<Entry> all = all_methods();
  return all;
}

Value call(Surface& surface, const Entry& entry, const Arguments& arguments) noexcept {
  surface.error_name.clear(), surface.error_message.clear(), surface.error_index = -1;
  try {
    const int count = static_cast<int>(arguments.size());
    if (count < entry.least || count > entry.most)
      fail(std::string(entry.name) + " takes " + std::to_string(entry.least) + " to " + std::to_string(entry.most) +
           " arguments");
    return entry.method(surface, arguments);
  } catch (const hf::Error& error) {
    surface.error_name = hf_result_get_name(error.code()), surface.error_message = error.what();
    surface.error_index = error.index() == HF_NO_INDEX ? -1.0 : error.index();
  } catch (const std::exception& error) {
    surface.error_name = "HF_ERROR_INTERNAL", surface.error_message = error.what();
  }
  return {};
}

}  // namespace hf_godot

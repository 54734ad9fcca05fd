// Steps of solvers, and which step goes where.
#include "golden_scene.h"
#include "support/arrays.h"

namespace golden {

using hf::check;
using hf::make;

namespace {
const std::set<std::string> direction_steps = {"add_vectors",   "remove_vectors", "move_vectors", "set_vectors",
                                               "rotate",        "record_vectors", "undo_vectors", "redo_vectors",
                                               "clone_vectors", "vectors",        "directions",   "singularities"};
const std::set<std::string> mesh_steps = {"report", "surface_statistics", "surface_info", "components",
                                          "save",   "edit_surface",       "cuts",         "cut_surface"};
const std::set<std::string> region_steps = {"region",          "region_edit",  "region_info",
                                            "region_vertices", "region_curve", "record_region",
                                            "undo_region",     "redo_region",  "morph"};
const std::set<std::string> weight_steps = {
    "weights",       "set_joints",   "set_pins",    "set_locks", "record_weights", "undo_weights",     "redo_weights",
    "clone_weights", "skin_weights", "joint_flags", "helpers",   "weights_info",   "transfer_weights", "mirror"};

// [vertex], or three corners and three barycentrics
hf_place place_of(const Json& step, const char* key) {
  const Json& list = step[key];
  hf_place point = {};
  for (size_t k = 0; k < 3; ++k) {
    point.corners[k] = list[list.size() == 1 ? 0 : k].get<uint32_t>();
    point.barycentrics[k] = list.size() == 1 ? (k == 0 ? 1.0 : 0.0) : list[3 + k].get<double>();
  }
  return point;
}
}  // namespace

std::vector<hf_place> places_of(const Json& step) {
  std::vector<hf_place> list;
  if (!step.contains("places")) return list;
  const Json& flat = step["places"];
  for (size_t i = 0; i + 6 <= flat.size(); i += 6) {
    hf_place place = {};
    for (size_t k = 0; k < 3; ++k) {
      place.corners[k] = flat[i + k].get<uint32_t>();
      place.barycentrics[k] = number(flat[i + 3 + k]);
    }
    list.push_back(place);
  }
  return list;
}

Result Scene::run_solver(const Json& step) {
  auto desc = make<hf_solver_desc>();
  set_options(
      step,
      {{"field_kind", &desc.field_kind}, {"channel_count", &desc.channel_count}, {"site_limit", &desc.site_limit}});
  Object& on = objects_[step["on"]];
  hf_solver raw = nullptr;
  check(hf_create(on.surface.get(), &desc, &raw));
  const size_t n = on.vertex_count;
  Object& object = objects_[step["as"]];
  object.solver = hf::Handle<hf_solver, hf_solver_destroy>(raw);
  object.vertex_count = n;
  return {};
}

Result Scene::run(const Json& step) {
  const std::string what = step["do"];
  if (what == "surface") return run_surface(step);
  if (what == "graph") return run_graph(step);
  if (what == "solver") return run_solver(step);
  Result result;
  if (what == "detail") return run_region(step, what);
  if (what == "transfer") {
    const Object &source = objects_[step["source"]], &target = objects_[step["target"]];
    auto desc = make<hf_transfer_desc>();
    set_options(step, {{"mode", &desc.mode}, {"scale", &desc.scale}});
    hf_transfer raw = nullptr;
    check(hf_transfer_create(source.surface.get(), target.surface.get(), &desc, &raw));
    const size_t sources = source.vertex_count, targets = target.vertex_count;
    Object& made = objects_[step["as"]];
    made.transfer = hf::Handle<hf_transfer, hf_transfer_destroy>(raw);
    made.source_vertex_count = sources;
    made.vertex_count = targets;
    return result;
  }
  Object& on = objects_[step["on"]];
  hf_solver solver = on.solver.get();
  const size_t n = on.vertex_count;
  const auto sites = numbers(step, "sites"), vertices = numbers(step, "vertices");
  const auto places = [&](const std::optional<Numbers>& at) {
    auto desc = make<hf_sites_desc>();
    desc.site_count = count(at);
    desc.vertices = data(at);
    return desc;
  };
  if (what == "dispose") {
    on.surface = {};
    on.solver = {};
    on.pose = {};
    on.transfer = {};
    on.geodesics = {};
    on.direction = {};
    on.quads = {};
    on.flow = {};
    on.region = {};
    on.detail = {};
    on.weights = {};
  } else if (what == "move_to") {
    const Object& to = objects_[step["to"]];
    check(on.pose.get() ? hf_pose_move_to(on.pose.get(), to.surface.get())
                        : hf_solver_move_to(solver, to.surface.get()));
    on.vertex_count = to.vertex_count;
  } else if (what == "clone") {
    hf_solver raw = nullptr;
    check(hf_solver_clone(solver, &raw));
    Object& made = objects_[step["as"]];
    made.solver = hf::Handle<hf_solver, hf_solver_destroy>(raw);
    made.vertex_count = n;
  } else if (what == "add_sites") {
    const auto inside = places_of(step);
    const size_t k = inside.empty() ? count(vertices) : inside.size();
    const auto values = doubles(step, "values", k), stiffness = doubles(step, "stiffness", k),
               radii = doubles(step, "radii", k);
    auto desc = places(vertices);
    desc.site_count = static_cast<uint32_t>(k);
    if (!inside.empty()) desc.places = inside.data();
    desc.values = data(values);
    desc.stiffness = data(stiffness);
    desc.radii = data(radii);
    result.numbers.emplace(k);
    check(hf_add_sites(solver, &desc, result.numbers->data()));
  } else if (what == "add_site") {
    const double value = step.contains("value") ? number(step["value"]) : 0.0;
    result.numbers.emplace(1);
    check(
        hf_solver_add_site(solver, step["vertex"], step.contains("value") ? &value : nullptr, result.numbers->data()));
  } else if (what == "remove_sites") {
    check(hf_remove_sites(solver, count(sites), data(sites)));
  } else if (what == "move_sites") {
    const auto desc = places(vertices);
    check(hf_solver_move_sites(solver, count(sites), data(sites), &desc));
  } else if (what == "set_values") {
    const auto values = doubles(step, "values", count(sites));
    check(hf_solver_set_values(solver, count(sites), data(sites), data(values)));
  } else if (what == "edit") {
    const auto removed = numbers(step, "remove"), moved = numbers(step, "move"), to = numbers(step, "move_to"),
               changed = numbers(step, "set"), added = numbers(step, "add");
    const auto values = doubles(step, "set_values"), more = doubles(step, "add_values");
    auto edit = make<hf_edit_desc>();
    const auto move_to = places(to);
    auto add = places(added);
    add.values = data(more);
    if (removed) {
      edit.remove_count = count(removed);
      edit.remove_sites = data(removed);
    }
    if (moved) {
      edit.move_count = count(moved);
      edit.move_sites = data(moved);
      edit.move_to = &move_to;
    }
    if (changed) {
      edit.set_count = count(changed);
      edit.set_sites = data(changed);
      edit.set_values = data(values);
    }
    if (added) edit.add = &add;
    result.numbers.emplace(count(added));
    check(hf_solver_edit_sites(solver, &edit, result.numbers->data()));
  } else if (what == "record") {
    on.solver_history.record(hf::clone_of(on.solver, hf_solver_clone));
  } else if (what == "undo") {
    on.solver_history.undo(on.solver);
  } else if (what == "redo") {
    on.solver_history.redo(on.solver);
  } else if (what == "solve") {
    result.array.emplace(n);
    check(hf_solver_solve(solver, OUT(result.array->data()), nullptr));
  } else if (what == "solve_f32") {
    std::vector<float> field(n);
    check(hf_solve(solver, field.data(), 0, nullptr));
    result.array.emplace(field.begin(), field.end());
  } else if (what == "preview") {
    result.array.emplace(n);
    check(hf_solver_solve_preview(solver, OUT(result.array->data()), step.value("correction_count", 0u), nullptr));
  } else if (what == "solve_at") {
    result.array.emplace(count(vertices));
    check(hf_solver_solve_at(solver, count(vertices), data(vertices), result.array->data()));
  } else if (what == "statistics") {
    auto figures = make<hf_solver_statistics>();
    check(hf_solver_get_statistics(solver, &figures));
    result.fields = {{"factorisation_count", figures.factorisation_count}, {"site_count", figures.site_count}};
  } else if (what == "solver_info") {
    auto info = make<hf_solver_info>();
    check(hf_solver_get_info(solver, &info));
    result.fields = {{"field_kind", info.field_kind},
                     {"channel_count", info.channel_count},
                     {"site_limit", info.site_limit},
                     {"site_count", info.site_count},
                     {"vertex_count", info.vertex_count}};
  } else if (what == "certify") {
    auto certificate = make<hf_certificate>();
    certificate.tolerance = step.contains("tolerance") ? number(step["tolerance"]) : 0.0;
    check(hf_solver_certify(solver, &certificate));
    result.fields = {{"residual", certificate.residual},
                     {"site_error", certificate.site_error},
                     {"overshoot_checked", certificate.overshoot_checked}};
  } else if (what == "levels" || what == "isolines" || what == "critical" || what == "extremities" ||
             what == "propose") {
    return run_looking(step, what, on.surface.get(), n);
  } else if (what == "cast_ray" || what == "find_vertex") {
    return run_picking(step, what, on.surface.get(), n);
  } else if (mesh_steps.count(what)) {
    return run_mesh(step, what, on.surface.get());
  } else if (what == "distance") {
    const auto sources = numbers(step, "sources");
    result.array.emplace(n);
    check(hf_geodesics_solve(on.geodesics.get(), count(sources), data(sources), OUT(result.array->data())));
  } else if (what == "path" || what == "map") {
    const hf_place from = place_of(step, what == "path" ? "from" : "centre");
    if (what == "map") {
      result.array.emplace(2 * n);
      const double radius = step.contains("radius") ? number(step["radius"]) : 0;
      check(hf_geodesics_get_map(on.geodesics.get(), &from, radius, result.array->data(), nullptr));
    } else {
      const hf_place to = place_of(step, "to");
      auto path = make<hf_path>();
      check(hf_geodesics_find_path(on.geodesics.get(), &from, &to, &path));
      result.array.emplace(3 * size_t{path.point_count});
      path.point_capacity = path.point_count;
      path.positions = result.array->data();
      check(hf_geodesics_find_path(on.geodesics.get(), &from, &to, &path));
    }
  } else if (what == "pose" || what == "geodesics" || what == "direction" || what == "quads" || what == "flow") {
    make_object(step, what);
  } else if (direction_steps.count(what)) {
    return run_direction(step, what);
  } else if (region_steps.count(what)) {
    return run_region(step, what);
  } else if (weight_steps.count(what)) {
    return run_weights(step, what);
  } else if (what == "update_quads" || what == "quads_info" || what == "quad_mesh" || what == "streamlines") {
    return run_quads(step, what);
  } else {
    return run_posing(step, what);
  }
  return result;
}

}  // namespace golden

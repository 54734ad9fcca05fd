// Steps of solvers, and which step goes where.
#include "golden_scene.h"

namespace golden {

using hf::check;
using hf::make;

namespace {
const std::set<std::string> direction_steps = {"add_vectors",   "remove_vectors", "move_vectors", "set_vectors",
                                               "rotate",        "record_vectors", "undo_vectors", "redo_vectors",
                                               "clone_vectors", "vectors",        "directions",   "singularities"};
const std::set<std::string> region_steps = {"region",        "region_edit", "region_info", "region_vertices",
                                            "record_region", "undo_region", "redo_region", "morph"};
}  // namespace

Result Scene::run_solver(const Json& step) {
  auto desc = make<hf_create_desc>();
  set_options(step, desc,
              {{"weld", &desc.weld},
               {"operator_kind", &desc.operator_kind},
               {"engine", &desc.engine},
               {"ordering", &desc.ordering},
               {"channel_count", &desc.channel_count},
               {"vertex_limit", &desc.vertex_limit},
               {"field_kind", &desc.field_kind},
               {"penalty", &desc.penalty}},
              {{"penalty", true}});
  if (step["mesh"].is_null()) fail("no positions", HF_ERROR_NULL_POINTER);
  const Json& mesh = meshes_.at(step["mesh"]);
  Doubles positions = mesh["positions"].get<Doubles>();
  Numbers triangles = mesh["triangles"].get<Numbers>();
  if (step.contains("positions"))
    for (const auto& [key, value] : step["positions"].items()) positions[std::stoul(key)] = number(value);
  if (step.contains("triangles"))
    for (const auto& [key, value] : step["triangles"].items()) triangles[std::stoul(key)] = value.get<uint32_t>();
  desc.vertex_count = static_cast<uint32_t>(positions.size() / 3), desc.positions_f64 = positions.data();
  desc.triangle_count = step.contains("no_triangles") ? 0 : static_cast<uint32_t>(triangles.size() / 3);
  desc.triangles = desc.triangle_count ? triangles.data() : nullptr;
  auto factor = make<hf_factor_desc>();
  std::vector<uint8_t> bytes;
  if (step.contains("factor")) {
    bytes = bytes_.at(step["factor"]);
    if (step.contains("damage")) bytes[step["damage"].get<size_t>()] ^= 1;
    factor.bytes = bytes.data(), factor.byte_count = bytes.size(), desc.saved_factor = &factor;
  }
  hf_solver raw = nullptr;
  check(hf_create(&desc, &raw));
  Object& object = objects_[step["as"]];
  object.solver = hf::Handle<hf_solver, hf_solver_destroy>(raw), object.vertex_count = desc.vertex_count;
  return {};
}

Result Scene::run_looking(const Json& step, const std::string& what, hf_solver solver, size_t n) {
  Result result;
  if (what == "extremities") {
    std::vector<hf_extremity> found(64);
    uint32_t size = 0;
    check(hf_surface_find_extremities(solver, nullptr, 64, found.data(), &size));
    result.array.emplace();
    for (uint32_t i = 0; i < size; ++i) result.array->push_back(found[i].vertex);
    std::sort(result.array->begin(), result.array->end());
    return result;
  }
  const auto field = doubles(step, "field", n);
  auto scalars = make<hf_scalars>();
  scalars.values_f64 = data(field);
  if (what == "levels") {
    const uint32_t wanted = step["count"];
    const int32_t spacing = step["spacing"] == "HF_LEVELS_AREA"     ? HF_LEVELS_AREA
                            : step["spacing"] == "HF_LEVELS_LENGTH" ? HF_LEVELS_LENGTH
                                                                    : HF_LEVELS_VALUE;
    result.array.emplace(std::max(1u, wanted));
    check(hf_surface_space_levels(solver, &scalars, spacing, wanted, result.array->data()));
  } else if (what == "isolines") {
    const auto levels = doubles(step, "levels");
    auto lines = make<hf_isolines>();
    check(hf_surface_trace_isolines(solver, &scalars, count(levels), data(levels), &lines));
    result.array.emplace(3 * size_t{lines.point_count});
    std::vector<int32_t> closed(lines.line_count);
    lines.point_capacity = lines.point_count, lines.line_capacity = lines.line_count;
    lines.positions = result.array->data(), lines.line_closed = closed.data();
    check(hf_surface_trace_isolines(solver, &scalars, count(levels), data(levels), &lines));
    if (step.contains("lines")) {
      int32_t sum = 0;
      for (int32_t one : closed) sum += one;
      expect(step["lines"] == lines.line_count && step["closed"] == sum, "lines");
    }
  } else {
    std::vector<hf_critical_point> points(1000);
    auto info = make<hf_critical_info>();
    check(hf_surface_find_critical_points(solver, &scalars, 1000, points.data(), &info));
    result.array.emplace();
    for (uint32_t i = 0; i < info.point_count; ++i) result.array->push_back(points[i].index);
  }
  return result;
}

Result Scene::run(const Json& step) {
  const std::string what = step["do"];
  if (what == "solver") return run_solver(step);
  Result result;
  if (what == "detail") return run_region(step, what);
  if (what == "transfer") {
    const Object &source = objects_[step["source"]], &target = objects_[step["target"]];
    auto desc = make<hf_transfer_desc>();
    set_options(step, desc, {{"mode", &desc.mode}, {"scale", &desc.scale}}, {{"scale", false}});
    hf_transfer raw = nullptr;
    check(hf_transfer_create(source.solver.get(), target.solver.get(), &desc, &raw));
    const size_t sources = source.vertex_count, targets = target.vertex_count;
    Object& made = objects_[step["as"]];
    made.transfer = hf::Handle<hf_transfer, hf_transfer_destroy>(raw), made.source_vertex_count = sources,
    made.vertex_count = targets;
    return result;
  }
  Object& on = objects_[step["on"]];
  hf_solver solver = on.solver.get();
  const size_t n = on.vertex_count;
  const auto sites = numbers(step, "sites"), vertices = numbers(step, "vertices"),
             triangles = numbers(step, "triangles");
  const auto places = [&](const std::optional<Numbers>& at) {
    auto desc = make<hf_sites_desc>();
    desc.site_count = count(at), desc.vertices = data(at);
    return desc;
  };
  if (what == "dispose") {
    on.solver = {}, on.pose = {}, on.transfer = {}, on.geodesics = {}, on.direction = {};
    on.quads = {}, on.flow = {}, on.region = {}, on.detail = {};
  } else if (what == "clone") {
    hf_solver raw = nullptr;
    check(hf_solver_clone(solver, &raw));
    Object& made = objects_[step["as"]];
    made.solver = hf::Handle<hf_solver, hf_solver_destroy>(raw), made.vertex_count = n;
  } else if (what == "add_sites") {
    const size_t k = count(vertices ? vertices : triangles);
    const auto weights = doubles(step, "barycentrics", 3 * k), values = doubles(step, "values", k),
               stiffness = doubles(step, "stiffness", k), radii = doubles(step, "radii", k);
    auto desc = places(vertices ? vertices : triangles);
    desc.vertices = data(vertices), desc.triangles = data(triangles), desc.barycentrics = data(weights);
    desc.values = data(values), desc.stiffness = data(stiffness), desc.radii = data(radii);
    result.numbers.emplace(k);
    check(hf_add_sites(solver, &desc, result.numbers->data()));
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
    if (removed) edit.remove_count = count(removed), edit.remove_sites = data(removed);
    if (moved) edit.move_count = count(moved), edit.move_sites = data(moved), edit.move_to = &move_to;
    if (changed) edit.set_count = count(changed), edit.set_sites = data(changed), edit.set_values = data(values);
    if (added) edit.add = &add;
    result.numbers.emplace(count(added));
    check(hf_solver_edit_sites(solver, &edit, result.numbers->data()));
  } else if (what == "record") {
    check(hf_solver_record(solver));
  } else if (what == "undo") {
    check(hf_solver_undo(solver));
  } else if (what == "redo") {
    check(hf_solver_redo(solver));
  } else if (what == "solve") {
    result.array.emplace(n);
    check(hf_solver_solve_f64(solver, result.array->data(), 0, nullptr));
  } else if (what == "solve_f32") {
    std::vector<float> field(n);
    check(hf_solve(solver, field.data(), 0, nullptr));
    result.array.emplace(field.begin(), field.end());
  } else if (what == "preview") {
    result.array.emplace(n);
    check(hf_solver_solve_preview_f64(solver, result.array->data(), 0, step.value("correction_count", 0u), nullptr));
  } else if (what == "solve_at") {
    result.array.emplace(count(vertices));
    check(hf_solver_solve_at(solver, count(vertices), data(vertices), result.array->data()));
  } else if (what == "report") {
    auto report = make<hf_surface_report>();
    check(hf_surface_get_report(solver, &report));
    result.fields = {{"vertex_count", report.vertex_count},
                     {"component_count", report.component_count},
                     {"boundary_edge_count", report.boundary_edge_count}};
  } else if (what == "statistics") {
    auto figures = make<hf_solver_statistics>();
    check(hf_solver_get_statistics(solver, &figures));
    result.fields = {{"factorisation_count", figures.factorisation_count},
                     {"site_count", figures.site_count},
                     {"factor_loaded", figures.factor_loaded}};
  } else if (what == "certify") {
    auto certificate = make<hf_certificate>();
    certificate.tolerance = step.contains("tolerance") ? number(step["tolerance"]) : 0.0;
    check(hf_solver_certify(solver, &certificate));
    result.fields = {{"residual", certificate.residual},
                     {"site_error", certificate.site_error},
                     {"overshoot_checked", certificate.overshoot_checked}};
  } else if (what == "save_factor") {
    size_t size = 0;
    check(hf_get_factor_size(solver, &size));
    auto& bytes = bytes_[step["as"]];
    bytes.resize(size);
    check(hf_surface_save(solver, bytes.data(), size));
  } else if (what == "levels" || what == "isolines" || what == "critical" || what == "extremities") {
    return run_looking(step, what, solver, n);
  } else if (what == "distance") {
    const auto sources = numbers(step, "sources");
    result.array.emplace(n);
    check(hf_geodesics_solve_f64(on.geodesics.get(), count(sources), data(sources), result.array->data(), 0));
  } else if (what == "pose" || what == "geodesics" || what == "direction" || what == "quads" || what == "flow") {
    make_object(step, what);
  } else if (direction_steps.count(what)) {
    return run_direction(step, what);
  } else if (region_steps.count(what)) {
    return run_region(step, what);
  } else if (what == "quads_info" || what == "quad_mesh" || what == "flow_lines") {
    return run_quads(step, what);
  } else {
    return run_posing(step, what);
  }
  return result;
}

}  // namespace golden

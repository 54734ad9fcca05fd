// The golden scenes (bindings/golden/README.md) through hf.hpp's handles and the C functions.
//
//   golden MESHES FILE...            runs the scenes of each file
//   golden MESHES FILE --fill OUT    also writes the scenes to OUT with the figures of every "agree" filled in: those are what
//                                    the other languages, run on the same library, must agree with
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <hf/hf.hpp>
#include <iostream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

namespace {

using Json = nlohmann::ordered_json;
using Doubles = std::vector<double>;
using Numbers = std::vector<uint32_t>;

struct Mismatch : std::runtime_error {
  using std::runtime_error::runtime_error;
};
void expect(bool condition, const std::string& what) {
  if (!condition) throw Mismatch(what);
}

[[noreturn]] void fail(const std::string& message, hf_result code = HF_ERROR_INVALID_ARGUMENT) {
  hf_error_detail detail{};
  detail.code = code, detail.index = HF_NO_INDEX;
  message.copy(detail.message, sizeof detail.message - 1);
  throw hfpp::Error(detail);
}

double number(const Json& value) {
  if (!value.is_string()) return value.get<double>();
  const std::string text = value;
  return text == "nan" ? std::nan("") : text == "inf" ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
}

struct Object {
  hfpp::Handle<hf_solver, hf_destroy> solver;
  hfpp::Handle<hf_pose, hf_pose_destroy> pose;
  hfpp::Handle<hf_transfer, hf_transfer_destroy> transfer;
  hfpp::Handle<hf_geodesics, hf_geodesics_destroy> geodesics;
  hfpp::Handle<hf_direction, hf_direction_destroy> direction;
  size_t vertex_count = 0, source_vertex_count = 0;
};

struct Result {
  std::optional<Doubles> array;
  std::optional<Numbers> numbers;
  std::map<std::string, double> fields;
};

// Option names and the places they stand for.
template <class Desc>
void set_options(const Json& step, Desc& desc, const std::map<std::string, void*>& places, const std::map<std::string, bool>& is_float) {

  const Json options = step.value("options", Json::object());
  for (const auto& [key, value] : options.items()) {
    const auto found = places.find(key);
    if (found == places.end()) fail("no option " + key);
    const auto kind = is_float.find(key);
    if (kind == is_float.end()) {
      if (value.is_string() && value != "HF_OPERATOR_COTANGENT") throw std::runtime_error("unknown constant " + value.dump());
      const int32_t whole = value.is_string() ? HF_OPERATOR_COTANGENT : value.template get<int32_t>();
      std::memcpy(found->second, &whole, sizeof whole);
    } else if (kind->second) {
      const double real = value.template get<double>();
      std::memcpy(found->second, &real, sizeof real);
    } else {
      const float real = value.template get<float>();
      std::memcpy(found->second, &real, sizeof real);
    }
  }
  (void)desc;
}

class Scene {
 public:
  explicit Scene(const std::map<std::string, Json>& meshes) : meshes_(meshes) {}

  void step(Json& step, bool fill) {
    Result result;
    try {
      result = run(step);
    } catch (const hfpp::Error& error) {
      expect(step.contains("error") && step["error"] == hf_result_name(error.code()), std::string("raised ") + error.what());
      expect(!step.contains("index") || step["index"] == error.index(), "index " + std::to_string(error.index()));
      return;
    }
    expect(!step.contains("error"), "did not fail");
    if (result.array) {
      if (step.contains("expect")) compare(*result.array, step["expect"], fill);
      if (step.contains("same_as")) {
        const Doubles& kept = kept_.at(step["same_as"]);
        expect(kept.size() == result.array->size() && !std::memcmp(kept.data(), result.array->data(), kept.size() * sizeof(double)), "differs from " + step["same_as"].get<std::string>());
      }
      if (step.contains("keep")) kept_[step["keep"]] = *result.array;
    } else if (result.numbers && step.contains("numbers")) {
      expect(step["numbers"].get<Numbers>() == *result.numbers, "numbers");
    } else if (step.contains("expect")) {
      for (const auto& [key, value] : step["expect"].items()) {
        if (key == "tolerance") continue;
        expect(result.fields.count(key) && std::abs(result.fields[key] - value.get<double>()) <= step["expect"].value("tolerance", 0.0), key + " is " + std::to_string(result.fields[key]));
      }
    }
  }

 private:
  static void compare(const Doubles& a, Json& wanted, bool fill) {
    double sum = 0, weighted = 0, least = a.empty() ? 0 : a[0], most = least;
    for (size_t i = 0; i < a.size(); ++i) {
      expect(std::isfinite(a[i]), "not finite");
      sum += a[i], weighted += a[i] * static_cast<double>(i % 7 + 1);
      least = std::min(least, a[i]), most = std::max(most, a[i]);
    }
    if (fill && wanted.contains("agree")) {
      Json at = Json::array(), values = Json::array();
      for (size_t i = 0; i < a.size(); i += a.size() / 20 + 1) at.push_back(i), values.push_back(a[i]);
      const Json tolerance = wanted["tolerance"];
      wanted = {{"count", a.size()}, {"sum", sum}, {"weighted", weighted}, {"min", least}, {"max", most}, {"at", at}, {"values", values}, {"tolerance", tolerance}};
    }
    const double tolerance = wanted.value("tolerance", 0.0), n = static_cast<double>(a.size());
    const auto near = [&](const char* key, double found, double room) {
      if (wanted.contains(key)) expect(std::abs(found - wanted[key].get<double>()) <= room, std::string(key) + " is " + std::to_string(found));
    };
    near("count", n, 0), near("sum", sum, tolerance * n + 1e-9), near("weighted", weighted, 7 * tolerance * n + 1e-9), near("min", least, tolerance), near("max", most, tolerance);
    const Json places = wanted.value("at", Json::array());
    for (size_t k = 0; k < places.size(); ++k)
      expect(std::abs(a[places[k].get<size_t>()] - wanted["values"][k].get<double>()) <= tolerance, "value at " + places[k].dump());
  }

  std::optional<Doubles> doubles(const Json& step, const char* key, std::optional<size_t> count = {}) const {
    if (!step.contains(key) || step[key].is_null()) return {};
    Doubles found;
    if (step[key].is_string()) found = kept_.at(step[key]);
    else
      for (const Json& value : step[key]) found.push_back(number(value));
    if (count && found.size() != *count) fail(std::string(key) + " must hold " + std::to_string(*count) + " numbers");
    return found;
  }
  static std::optional<Numbers> numbers(const Json& step, const char* key) {
    if (!step.contains(key) || step[key].is_null()) return {};
    return step[key].get<Numbers>();
  }
  template <class T>
  static const T* data(const std::optional<std::vector<T>>& list) {
    return list && !list->empty() ? list->data() : nullptr;
  }
  template <class T>
  static uint32_t count(const std::optional<std::vector<T>>& list) {
    return list ? static_cast<uint32_t>(list->size()) : 1u;
  }
  static std::optional<std::pair<Numbers, Numbers>> regions(const Json& step, const char* key) {
    if (!step.contains(key) || step[key].is_null()) return {};
    std::pair<Numbers, Numbers> both;
    for (const Json& region : step[key]) {
      const Numbers vertices = region.get<Numbers>();
      both.first.push_back(static_cast<uint32_t>(vertices.size()));
      both.second.insert(both.second.end(), vertices.begin(), vertices.end());
    }
    return both;
  }

  Result run(const Json& step);
  Result run_solver(const Json& step);
  Result run_looking(const Json& step, const std::string& what, hf_solver solver, size_t n);
  Result run_posing(const Json& step, const std::string& what);

  const std::map<std::string, Json>& meshes_;
  std::map<std::string, Object> objects_;
  std::map<std::string, Doubles> kept_;
  std::map<std::string, std::vector<uint8_t>> bytes_;
};

using hfpp::check;
using hfpp::make;

Result Scene::run_solver(const Json& step) {
  auto desc = make<hf_create_desc>();
  set_options(step, desc,
              {{"weld", &desc.weld}, {"operator_kind", &desc.operator_kind}, {"engine", &desc.engine}, {"ordering", &desc.ordering}, {"channel_count", &desc.channel_count},
               {"vertex_limit", &desc.vertex_limit}, {"field_kind", &desc.field_kind}, {"penalty", &desc.penalty}},
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
  object.solver = hfpp::Handle<hf_solver, hf_destroy>(raw), object.vertex_count = desc.vertex_count;
  return {};
}

Result Scene::run_looking(const Json& step, const std::string& what, hf_solver solver, size_t n) {
  Result result;
  if (what == "extremities") {
    std::vector<hf_extremity> found(64);
    uint32_t size = 0;
    check(hf_find_extremities(solver, nullptr, 64, found.data(), &size));
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
    const int32_t spacing = step["spacing"] == "HF_LEVELS_AREA" ? HF_LEVELS_AREA : step["spacing"] == "HF_LEVELS_LENGTH" ? HF_LEVELS_LENGTH : HF_LEVELS_VALUE;
    result.array.emplace(std::max(1u, wanted));
    check(hf_space_levels(solver, &scalars, spacing, wanted, result.array->data()));
  } else if (what == "isolines") {
    const auto levels = doubles(step, "levels");
    auto lines = make<hf_isolines>();
    check(hf_trace_isolines(solver, &scalars, count(levels), data(levels), &lines));
    result.array.emplace(3 * size_t{lines.point_count});
    std::vector<int32_t> closed(lines.line_count);
    lines.point_capacity = lines.point_count, lines.line_capacity = lines.line_count;
    lines.positions = result.array->data(), lines.line_closed = closed.data();
    check(hf_trace_isolines(solver, &scalars, count(levels), data(levels), &lines));
    if (step.contains("lines")) {
      int32_t sum = 0;
      for (int32_t one : closed) sum += one;
      expect(step["lines"] == lines.line_count && step["closed"] == sum, "lines");
    }
  } else {
    std::vector<hf_critical_point> points(1000);
    auto info = make<hf_critical_info>();
    check(hf_find_critical_points(solver, &scalars, 1000, points.data(), &info));
    result.array.emplace();
    for (uint32_t i = 0; i < info.point_count; ++i) result.array->push_back(points[i].index);
  }
  return result;
}

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
    if (points) desc.handle_count = static_cast<uint32_t>(points->size() / 3), desc.points = data(points), desc.radii = data(radii);
    else {
      desc.handle_count = lists ? static_cast<uint32_t>(lists->first.size()) : 1u;
      if (lists && !lists->first.empty()) desc.region_counts = lists->first.data(), desc.region_vertices = lists->second.data();
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
  } else if (what == "deform") {
    auto desc = make<hf_deform_desc>();
    set_options(step, desc, {{"restart", &desc.restart}, {"iteration_count", &desc.iteration_count}, {"refine", &desc.refine}}, {});
    result.array.emplace(3 * on.vertex_count);
    desc.positions_f64 = result.array->data();
    check(hf_deform(pose, &desc, nullptr));
  } else if (what == "handle_field") {
    std::vector<float> field(on.vertex_count);
    check(hf_pose_get_field(pose, step["handle"], field.data(), 0));
    result.array.emplace(field.begin(), field.end());
  } else if (what == "handle_info") {
    auto info = make<hf_handle_info>();
    check(hf_pose_get_handle(pose, step["handle"], &info));
    result.fields["layer"] = info.layer;
  } else if (what == "skin") {
    auto info = make<hf_skin_info>();
    info.weight_count = step["weight_count"];
    std::vector<float> weights(on.vertex_count * info.weight_count);
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
      desc.source_counts = source->first.data(), desc.source_vertices = source->second.data();
      desc.target_counts = target->first.data(), desc.target_vertices = target->second.data();
    }
    desc.flags = data(flags);
    result.numbers.emplace(desc.pair_count);
    check(hf_transfer_add_pairs(on.transfer.get(), &desc, result.numbers->data()));
  } else if (what == "remove_pairs") {
    const auto pairs = numbers(step, "pairs");
    check(hf_transfer_remove_pairs(on.transfer.get(), count(pairs), data(pairs)));
  } else if (what == "transfer_info") {
    auto info = make<hf_transfer_info>();
    check(hf_transfer_get_info(on.transfer.get(), &info));
    result.fields = {{"pair_count", info.pair_count}, {"scale", info.scale}};
  } else if (what == "apply") {
    const auto posed = doubles(step, "positions", 3 * on.source_vertex_count);
    result.array.emplace(3 * on.vertex_count);
    auto frame = make<hf_transfer_frame>();
    frame.source_positions_f64 = data(posed), frame.target_positions_f64 = result.array->data();
    check(hf_transfer_apply(on.transfer.get(), &frame));
  } else {
    throw std::runtime_error("unknown step " + what);
  }
  return result;
}

Result Scene::run(const Json& step) {
  const std::string what = step["do"];
  if (what == "solver") return run_solver(step);
  Result result;
  if (what == "transfer") {
    const Object &source = objects_[step["source"]], &target = objects_[step["target"]];
    auto desc = make<hf_transfer_desc>();
    set_options(step, desc, {{"mode", &desc.mode}, {"scale", &desc.scale}}, {{"scale", false}});
    hf_transfer raw = nullptr;
    check(hf_transfer_create(source.solver.get(), target.solver.get(), &desc, &raw));
    const size_t sources = source.vertex_count, targets = target.vertex_count;
    Object& made = objects_[step["as"]];
    made.transfer = hfpp::Handle<hf_transfer, hf_transfer_destroy>(raw), made.source_vertex_count = sources, made.vertex_count = targets;
    return result;
  }
  Object& on = objects_[step["on"]];
  hf_solver solver = on.solver.get();
  const size_t n = on.vertex_count;
  const auto sites = numbers(step, "sites"), vertices = numbers(step, "vertices"), triangles = numbers(step, "triangles");
  const auto places = [&](const std::optional<Numbers>& at) {
    auto desc = make<hf_sites_desc>();
    desc.site_count = count(at), desc.vertices = data(at);
    return desc;
  };
  if (what == "dispose") {
    on.solver = {}, on.pose = {}, on.transfer = {}, on.geodesics = {}, on.direction = {};
  } else if (what == "clone") {
    hf_solver raw = nullptr;
    check(hf_clone(solver, &raw));
    Object& made = objects_[step["as"]];
    made.solver = hfpp::Handle<hf_solver, hf_destroy>(raw), made.vertex_count = n;
  } else if (what == "pose") {
    auto desc = make<hf_pose_desc>();
    set_options(step, desc, {{"mode", &desc.mode}, {"band_count", &desc.band_count}}, {});
    hf_pose raw = nullptr;
    check(hf_pose_create(solver, &desc, &raw));
    Object& made = objects_[step["as"]];
    made.pose = hfpp::Handle<hf_pose, hf_pose_destroy>(raw), made.vertex_count = n;
  } else if (what == "geodesics") {
    hf_geodesics raw = nullptr;
    check(hf_geodesics_create(solver, nullptr, &raw));
    Object& made = objects_[step["as"]];
    made.geodesics = hfpp::Handle<hf_geodesics, hf_geodesics_destroy>(raw), made.vertex_count = n;
  } else if (what == "direction") {
    auto desc = make<hf_direction_desc>();
    set_options(step, desc, {{"degree", &desc.degree}}, {});
    hf_direction raw = nullptr;
    check(hf_direction_create(solver, &desc, &raw));
    Object& made = objects_[step["as"]];
    made.direction = hfpp::Handle<hf_direction, hf_direction_destroy>(raw), made.vertex_count = n;
  } else if (what == "add_sites") {
    const size_t k = count(vertices ? vertices : triangles);
    const auto weights = doubles(step, "barycentrics", 3 * k), values = doubles(step, "values", k), stiffness = doubles(step, "stiffness", k), radii = doubles(step, "radii", k);
    auto desc = places(vertices ? vertices : triangles);
    desc.vertices = data(vertices), desc.triangles = data(triangles), desc.barycentrics = data(weights);
    desc.values = data(values), desc.stiffness = data(stiffness), desc.radii = data(radii);
    result.numbers.emplace(k);
    check(hf_add_sites(solver, &desc, result.numbers->data()));
  } else if (what == "remove_sites") {
    check(hf_remove_sites(solver, count(sites), data(sites)));
  } else if (what == "move_sites") {
    const auto desc = places(vertices);
    check(hf_move_sites(solver, count(sites), data(sites), &desc));
  } else if (what == "set_values") {
    const auto values = doubles(step, "values", count(sites));
    check(hf_set_site_values(solver, count(sites), data(sites), data(values)));
  } else if (what == "edit") {
    const auto removed = numbers(step, "remove"), moved = numbers(step, "move"), to = numbers(step, "move_to"), changed = numbers(step, "set"), added = numbers(step, "add");
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
    check(hf_edit_sites(solver, &edit, result.numbers->data()));
  } else if (what == "record") {
    check(hf_record(solver));
  } else if (what == "undo") {
    check(hf_undo(solver));
  } else if (what == "redo") {
    check(hf_redo(solver));
  } else if (what == "solve") {
    result.array.emplace(n);
    check(hf_solve_f64(solver, result.array->data(), 0, nullptr));
  } else if (what == "solve_f32") {
    std::vector<float> field(n);
    check(hf_solve(solver, field.data(), 0, nullptr));
    result.array.emplace(field.begin(), field.end());
  } else if (what == "preview") {
    result.array.emplace(n);
    check(hf_solve_preview_f64(solver, result.array->data(), 0, step.value("correction_count", 0u), nullptr));
  } else if (what == "solve_at") {
    result.array.emplace(count(vertices));
    check(hf_solve_at(solver, count(vertices), data(vertices), result.array->data()));
  } else if (what == "report") {
    auto report = make<hf_mesh_report>();
    check(hf_get_mesh_report(solver, &report));
    result.fields = {{"vertex_count", report.vertex_count}, {"component_count", report.component_count}, {"boundary_edge_count", report.boundary_edge_count}};
  } else if (what == "statistics") {
    auto figures = make<hf_statistics>();
    check(hf_get_statistics(solver, &figures));
    result.fields = {{"factorisation_count", figures.factorisation_count}, {"site_count", figures.site_count}, {"factor_loaded", figures.factor_loaded}};
  } else if (what == "save_factor") {
    size_t size = 0;
    check(hf_get_factor_size(solver, &size));
    auto& bytes = bytes_[step["as"]];
    bytes.resize(size);
    check(hf_save_factor(solver, bytes.data(), size));
  } else if (what == "levels" || what == "isolines" || what == "critical" || what == "extremities") {
    return run_looking(step, what, solver, n);
  } else if (what == "distance") {
    const auto sources = numbers(step, "sources");
    result.array.emplace(n);
    check(hf_geodesics_distance_f64(on.geodesics.get(), count(sources), data(sources), result.array->data(), 0));
  } else if (what == "add_vectors") {
    const auto vectors = doubles(step, "vectors", 3 * count(vertices));
    result.numbers.emplace(count(vertices));
    check(hf_direction_add_sites(on.direction.get(), count(vertices), data(vertices), data(vectors), result.numbers->data()));
  } else if (what == "rotate") {
    const auto angles = doubles(step, "angles", count(sites));
    check(hf_direction_rotate_sites(on.direction.get(), count(sites), data(sites), data(angles)));
  } else if (what == "directions") {
    result.array.emplace(3 * n);
    check(hf_direction_solve_f64(on.direction.get(), result.array->data(), 0, nullptr));
  } else if (what == "singularities") {
    std::vector<hf_singularity> found(1000);
    uint32_t size = 0;
    check(hf_direction_get_singularities(on.direction.get(), 1000, found.data(), &size));
    result.array.emplace();
    for (uint32_t i = 0; i < size; ++i) result.array->push_back(found[i].index);
  } else {
    return run_posing(step, what);
  }
  return result;
}

Json read(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  return Json::parse(file);
}

}  // namespace

int main(int argc, char** argv) try {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() < 2) return 2;
  std::map<std::string, Json> meshes;
  for (const auto& entry : std::filesystem::directory_iterator(arguments[0])) meshes[entry.path().stem().string()] = read(entry.path());
  const bool fill = arguments.size() == 4 && arguments[2] == "--fill";
  int failures = 0;
  for (size_t i = 1; i < (fill ? 2 : arguments.size()); ++i) {
    Json file = read(arguments[i]);
    for (Json& scene : file["scenes"]) {
      Scene runner(meshes);
      size_t place = 0;
      for (Json& step : scene["steps"]) {
        try {
          runner.step(step, fill);
        } catch (const Mismatch& mismatch) {
          std::cout << "FAILED " << scene["name"] << ", step " << place << " " << step["do"] << ": " << mismatch.what() << "\n", ++failures;
        }
        ++place;
      }
      std::cout << scene["name"].get<std::string>() << ": " << place << " steps\n";
    }
    if (fill) std::ofstream(arguments[3]) << file.dump();
  }
  return failures ? 1 : 0;
} catch (const std::exception& error) {
  std::cerr << "error: " << error.what() << "\n";
  return 1;
}

// Steps of direction fields, quad meshes and streamlines, and of everything that is made on a surface.
#include "golden_scene.h"
#include "support/arrays.h"

namespace golden {

using hf::check;
using hf::make;

// Reads the options of quads and calls with them. They point into arrays that live until the call is over.
void Scene::with_quad_options(const Json& step, const std::function<void(const hf_quads_desc&)>& call) {
  auto desc = make<hf_quads_desc>();
  set_options(
      step,
      {{"relax_count", &desc.relax_count}, {"face_count", &desc.face_count}, {"crease_angle", &desc.crease_angle}});
  if (step.contains("edge_length")) desc.edge_length = number(step["edge_length"]);
  const auto edges = numbers(step, "crease_edges"), guided = numbers(step, "guide_vertices");
  const size_t guides = guided ? guided->size() : 0;
  const auto vectors = doubles(step, "guide_vectors", 3 * guides), given = doubles(step, "guide_weights", guides);
  const auto poles = numbers(step, "irregular_valences");
  const size_t irregular_count = poles ? poles->size() : 0;
  const auto places = doubles(step, "irregular_points", 3 * irregular_count),
             ways = doubles(step, "irregular_directions", 3 * irregular_count);
  const auto plane = doubles(step, "symmetry_plane", 4);
  if (edges && edges->size() % 2) fail("crease_edges must hold two vertices each");
  const std::vector<float> weights = given ? std::vector<float>(given->begin(), given->end()) : std::vector<float>();
  if (edges) {
    desc.crease_count = count(edges) / 2;
    desc.crease_edges = data(edges);
  }
  if (guided) {
    desc.guide_count = count(guided);
    desc.guide_vertices = data(guided);
  }
  if (vectors) desc.guide_vectors = vectors->data();
  if (given) desc.guide_weights = weights.data();
  if (poles) {
    desc.irregular_count = count(poles);
    desc.irregular_valences = data(poles);
  }
  if (places) desc.irregular_points = places->data();
  if (ways) desc.irregular_directions = ways->data();
  if (plane) std::copy(plane->begin(), plane->end(), desc.symmetry_plane);
  call(desc);
}

void Scene::make_object(const Json& step, const std::string& what) {
  hf_surface surface = objects_[step["on"]].surface.get();
  const size_t n = objects_[step["on"]].vertex_count;
  Object object;
  object.vertex_count = n;
  if (what == "pose") {
    auto desc = make<hf_pose_desc>();
    set_options(step, {{"band_count", &desc.band_count}});
    hf_pose raw = nullptr;
    check(hf_pose_create(surface, &desc, &raw));
    object.pose = hf::Handle<hf_pose, hf_pose_destroy>(raw);
  } else if (what == "geodesics") {
    auto desc = make<hf_geodesics_desc>();
    set_options(step, {{"method", &desc.method}, {"smoothing", &desc.smoothing}});
    hf_geodesics raw = nullptr;
    check(hf_geodesics_create(surface, &desc, &raw));
    object.geodesics = hf::Handle<hf_geodesics, hf_geodesics_destroy>(raw);
  } else if (what == "direction") {
    auto desc = make<hf_direction_desc>();
    set_options(step, {{"degree", &desc.degree}});
    hf_direction raw = nullptr;
    check(hf_direction_create(surface, &desc, &raw));
    object.direction = hf::Handle<hf_direction, hf_direction_destroy>(raw);
  } else if (what == "quads") {
    hf_quads raw = nullptr;
    with_quad_options(step, [&](const hf_quads_desc& desc) { check(hf_quads_create(surface, &desc, &raw)); });
    object.quads = hf::Handle<hf_quads, hf_quads_destroy>(raw);
  } else {
    hf_flow raw = nullptr;
    check(hf_flow_create(surface, &raw));
    object.flow = hf::Handle<hf_flow, hf_flow_destroy>(raw);
  }
  objects_[step["as"]] = std::move(object);
}

Result Scene::run_direction(const Json& step, const std::string& what) {
  Result result;
  Object& on = objects_[step["on"]];
  hf_direction direction = on.direction.get();
  const auto sites = numbers(step, "sites"), vertices = numbers(step, "vertices");
  if (what == "add_vectors") {
    const auto vectors = doubles(step, "vectors", 3 * count(vertices));
    result.numbers.emplace(count(vertices));
    check(hf_direction_add_sites(direction, count(vertices), data(vertices), data(vectors), result.numbers->data()));
  } else if (what == "remove_vectors") {
    check(hf_direction_remove_sites(direction, count(sites), data(sites)));
  } else if (what == "move_vectors") {
    if (count(sites) != count(vertices)) fail("sites and vertices must be of one length");
    check(hf_direction_move_sites(direction, count(sites), data(sites), data(vertices)));
  } else if (what == "set_vectors") {
    const auto vectors = doubles(step, "vectors", 3 * count(sites));
    check(hf_direction_set_vectors(direction, count(sites), data(sites), data(vectors)));
  } else if (what == "rotate") {
    const auto angles = doubles(step, "angles", count(sites));
    check(hf_direction_rotate_sites(direction, count(sites), data(sites), data(angles)));
  } else if (what == "record_vectors") {
    on.direction_history.record(hf::clone_of(on.direction, hf_direction_clone));
  } else if (what == "undo_vectors") {
    on.direction_history.undo(on.direction);
  } else if (what == "redo_vectors") {
    on.direction_history.redo(on.direction);
  } else if (what == "clone_vectors") {
    const size_t n = on.vertex_count;
    hf_direction raw = nullptr;
    check(hf_direction_clone(direction, &raw));
    Object& made = objects_[step["as"]];
    made.direction = hf::Handle<hf_direction, hf_direction_destroy>(raw);
    made.vertex_count = n;
  } else if (what == "vectors") {
    const uint32_t k = hf_direction_get_site_count(direction);
    result.array.emplace(3 * size_t{k});
    check(hf_direction_get_sites(direction, k, nullptr, nullptr, result.array->data(), nullptr));
  } else if (what == "directions") {
    result.array.emplace(3 * on.vertex_count);
    check(hf_direction_solve(direction, OUT(result.array->data()), nullptr));
  } else {
    std::vector<hf_singularity> found(1000);
    uint32_t size = 0;
    check(hf_direction_get_singularities(direction, 1000, found.data(), &size));
    result.array.emplace();
    for (uint32_t i = 0; i < size; ++i) result.array->push_back(found[i].index);
  }
  return result;
}

Result Scene::run_quads(const Json& step, const std::string& what) {
  Result result;
  Object& on = objects_[step["on"]];
  if (what == "streamlines") {
    const auto field = doubles(step, "field", on.vertex_count);
    const auto seeds = numbers(step, "seeds");
    const hf_array scalars = HF_ARRAY(data(field), field ? on.vertex_count : 0);
    auto lines = make<hf_streamlines>();
    lines.wanted_count = step.value("count", 0u);
    if (seeds) {
      lines.seed_count = count(seeds);
      lines.seeds = data(seeds);
    }
    lines.point_capacity = lines.line_capacity = 100000;
    result.array.emplace(300000);
    lines.positions = result.array->data();
    check(hf_flow_trace(on.flow.get(), &scalars, &lines));
    result.array->resize(3 * size_t{lines.point_count});
    if (step.contains("lines")) expect(step["lines"] == lines.line_count, "lines: " + std::to_string(lines.line_count));
    return result;
  }
  if (what == "update_quads")
    with_quad_options(step, [&](const hf_quads_desc& desc) { check(hf_quads_update(on.quads.get(), &desc)); });
  auto info = make<hf_quads_info>();
  check(hf_quads_get_info(on.quads.get(), &info));
  if (what == "quads_info") {
    result.fields = {{"euler_characteristic", info.euler_characteristic},
                     {"vertex_count", info.vertex_count},
                     {"face_count", info.face_count}};
    return result;
  }
  result.array.emplace(3 * size_t{info.vertex_count});
  auto mesh = make<hf_quads_mesh>();
  mesh.vertex_capacity = info.vertex_count;
  mesh.positions = result.array->data();
  check(hf_quads_get_mesh(on.quads.get(), &mesh));
  return result;
}

}  // namespace golden

// Steps of surfaces: made from a mesh, asked about it, picked, and looked at with a field.
#include "golden_scene.h"

namespace golden {

using hf::check;
using hf::make;

namespace {

// Triangles in the layout that a step asks for; what lies between them is 255 in every byte.
std::vector<uint8_t> lay_out(const Numbers& corners, size_t width, size_t stride) {
  std::vector<uint8_t> bytes(corners.size() / 3 * stride + 4, 255);
  for (size_t i = 0; i < corners.size(); ++i) {
    uint8_t* place = &bytes[i / 3 * stride + i % 3 * width];
    const auto half = static_cast<uint16_t>(corners[i]);
    if (width == sizeof half)
      std::memcpy(place, &half, width);
    else
      std::memcpy(place, &corners[i], width);
  }
  return bytes;
}

}  // namespace

Result Scene::run_surface(const Json& step) {
  auto desc = make<hf_surface_desc>();
  auto links = make<hf_links_desc>();
  set_options(step, {{"weld", &desc.weld},
                     {"operator_kind", &desc.operator_kind},
                     {"field_kind", &desc.field_kind},
                     {"ordering", &desc.ordering},
                     {"thread_count", &desc.thread_count},
                     {"vertex_limit", &desc.vertex_limit},
                     {"triangle_limit", &desc.triangle_limit},
                     {"link_pieces", &links.mode}});
  desc.links = &links;
  if (step["mesh"].is_null()) fail("no positions", HF_ERROR_NULL_POINTER);
  const Json& mesh = meshes_.at(step["mesh"]);
  Doubles positions = mesh["positions"].get<Doubles>();
  Numbers triangles = mesh["triangles"].get<Numbers>();
  if (step.contains("positions"))
    for (const auto& [key, value] : step["positions"].items()) positions[std::stoul(key)] = number(value);
  if (step.contains("triangles"))
    for (const auto& [key, value] : step["triangles"].items()) triangles[std::stoul(key)] = value.get<uint32_t>();
  desc.positions = HF_ARRAY(positions.data(), positions.size() / 3);
  const size_t width = step.value("index_bits", 32u) / 8;
  const uint32_t stride = step.value("triangle_stride", 0u);
  const auto laid = lay_out(triangles, width, stride ? stride : 3 * width);
  const size_t triangle_count = step.contains("no_triangles") ? 0 : triangles.size() / 3;
  if (triangle_count > 0) {
    desc.triangles.data = laid.data();
    desc.triangles.count = static_cast<uint32_t>(triangle_count);
    desc.triangles.stride = stride;
    desc.triangles.type = width == sizeof(uint16_t) ? HF_TYPE_UINT16 : HF_TYPE_PLAIN;
  }
  Numbers offsets, corners, tags;
  auto faces = make<hf_faces_desc>();
  if (step.contains("faces")) {
    offsets = step["faces"]["offsets"].get<Numbers>();
    corners = step["faces"]["corners"].get<Numbers>();
    desc.triangles = {};
    faces.starts = HF_ARRAY(offsets.data(), offsets.size());
    faces.corners = HF_ARRAY(corners.data(), corners.size());
    desc.faces = &faces;
  }
  if (step.contains("tags")) {
    tags = step["tags"].get<Numbers>();
    links.tags = tags.data();
  }
  auto factor = make<hf_factor_desc>();
  std::vector<uint8_t> bytes;
  if (step.contains("factor")) {
    bytes = bytes_.at(step["factor"]);
    if (step.contains("damage")) bytes[step["damage"].get<size_t>()] ^= 1;
    factor.bytes = bytes.data();
    factor.byte_count = bytes.size();
    desc.saved_factor = &factor;
  }
  hf_surface raw = nullptr;
  check(hf_surface_create(&desc, &raw));
  Object& object = objects_[step["as"]];
  object.surface = hf::Handle<hf_surface, hf_surface_destroy>(raw);
  object.vertex_count = desc.positions.count;
  return {};
}

Result Scene::run_graph(const Json& step) {
  auto desc = make<hf_graph_desc>();
  set_options(step, {{"allow_negative", &desc.allow_negative},
                     {"field_kind", &desc.field_kind},
                     {"ordering", &desc.ordering},
                     {"thread_count", &desc.thread_count},
                     {"vertex_limit", &desc.vertex_limit},
                     {"edge_limit", &desc.edge_limit}});
  const auto edges = numbers(step, "edges");
  const auto weights = doubles(step, "weights"), masses = doubles(step, "masses", step["vertex_count"].get<size_t>());
  if (edges && weights && edges->size() != 2 * weights->size()) fail("edges must hold two vertices for each weight");
  desc.vertex_count = step["vertex_count"];
  desc.edges = HF_ARRAY(data(edges), count(weights));
  desc.weights = HF_ARRAY(data(weights), count(weights));
  if (masses) desc.masses = HF_ARRAY(data(masses), masses->size());
  hf_surface raw = nullptr;
  check(hf_surface_create_graph(&desc, &raw));
  Object& object = objects_[step["as"]];
  object.surface = hf::Handle<hf_surface, hf_surface_destroy>(raw);
  object.vertex_count = desc.vertex_count;
  return {};
}

Result Scene::run_picking(const Json& step, const std::string& what, hf_surface surface, size_t n) {
  Result result;
  auto desc = make<hf_pick_desc>();
  const auto positions = doubles(step, "positions", 3 * n);
  if (positions) desc.positions = HF_ARRAY(data(positions), n);
  desc.front_only = step.value("front_only", 0);
  if (what == "find_vertex") {
    const auto point = doubles(step, "point", 3);
    uint32_t vertex = 0;
    double distance = 0;
    check(hf_surface_find_vertex(surface, data(point), &desc, &vertex, &distance));
    result.array = Doubles{static_cast<double>(vertex), distance};
    return result;
  }
  const auto origin = doubles(step, "origin", 3), direction = doubles(step, "direction", 3);
  auto hit = make<hf_hit>();
  check(hf_surface_cast_ray(surface, data(origin), data(direction), &desc, &hit));
  result.array = Doubles{static_cast<double>(hit.found)};
  if (!hit.found) return result;
  result.array->push_back(hit.triangle);
  result.array->push_back(hit.vertex);
  result.array->insert(result.array->end(), hit.place.barycentrics, hit.place.barycentrics + 3);
  result.array->insert(result.array->end(), hit.position, hit.position + 3);
  result.array->push_back(hit.distance);
  return result;
}

void Scene::edit_surface(const Json& step, hf_surface surface) {
  const auto vertices = numbers(step, "vertices"), removed = numbers(step, "removed_links");
  const auto stiffness = doubles(step, "stiffness");
  const size_t link_count = step.contains("links") ? step["links"].size() / 8 : 0;
  const auto rows = doubles(step, "links", 8 * link_count);
  std::vector<hf_link> links(link_count);
  for (size_t i = 0; i < link_count; ++i) {
    const double* row = rows->data() + 8 * i;
    links[i] = {};
    links[i].vertex = static_cast<uint32_t>(row[0]);
    for (int k = 0; k < 3; ++k) links[i].corners[k] = static_cast<uint32_t>(row[1 + k]);
    std::copy_n(row + 4, 3, links[i].barycentrics);
    links[i].weight = row[7];
  }
  auto desc = make<hf_surface_edit_desc>();
  if (vertices) {
    desc.vertex_count = count(vertices);
    desc.vertices = data(vertices);
    desc.stiffness = data(stiffness);
  }
  desc.link_count = static_cast<uint32_t>(link_count);
  if (link_count) desc.links = links.data();
  if (removed) {
    desc.removed_link_count = count(removed);
    desc.removed_links = data(removed);
  }
  const auto gone = numbers(step, "removed_triangles"), corners = numbers(step, "new_triangles"),
             edges = numbers(step, "cut_edges");
  const auto positions = doubles(step, "new_positions");
  auto patch = make<hf_patch_desc>();
  if (gone || corners || positions || edges) desc.patch = &patch;
  if (gone) patch.removed_triangle_count = count(gone);
  if (corners) patch.new_triangle_count = count(corners) / 3;
  if (positions) patch.new_vertex_count = count(positions) / 3;
  if (edges) patch.cut_edge_count = count(edges) / 2;
  patch.removed_triangles = data(gone);
  patch.new_triangles = data(corners);
  patch.new_positions = data(positions);
  patch.cut_edges = data(edges);
  hf_surface raw = nullptr;
  check(hf_surface_edit(surface, &desc, &raw));
  auto info = make<hf_surface_info>();
  check(hf_surface_get_info(raw, &info));
  const size_t n = info.vertex_count;
  Object& object = objects_[step["as"]];
  object = {};
  object.surface = hf::Handle<hf_surface, hf_surface_destroy>(raw);
  object.vertex_count = n;
}

Result Scene::run_mesh(const Json& step, const std::string& what, hf_surface surface) {
  Result result;
  if (what == "report") {
    auto report = make<hf_surface_report>();
    check(hf_surface_get_report(surface, &report));
    result.fields = {{"vertex_count", report.vertex_count},
                     {"component_count", report.component_count},
                     {"boundary_edge_count", report.boundary_edge_count}};
  } else if (what == "surface_statistics") {
    auto figures = make<hf_surface_statistics>();
    check(hf_surface_get_statistics(surface, &figures));
    result.fields = {{"factor_loaded", figures.factor_loaded}, {"unknown_count", figures.unknown_count}};
  } else if (what == "surface_info") {
    auto info = make<hf_surface_info>();
    check(hf_surface_get_info(surface, &info));
    result.fields = {{"vertex_count", info.vertex_count},   {"triangle_count", info.triangle_count},
                     {"operator_kind", info.operator_kind}, {"field_kind", info.field_kind},
                     {"thread_count", info.thread_count},   {"vertex_limit", info.vertex_limit},
                     {"face_count", info.face_count}};
  } else if (what == "components") {
    uint32_t size = 0;
    check(hf_surface_get_components(surface, 0, nullptr, &size));
    Numbers components(size);
    check(hf_surface_get_components(surface, size, components.data(), &size));
    result.array.emplace(components.begin(), components.end());
  } else if (what == "edit_surface") {
    edit_surface(step, surface);
  } else if (what == "cut_surface") {
    const auto places = places_of(step);
    auto line = make<hf_cut_desc>();
    line.point_count = static_cast<uint32_t>(places.size());
    line.places = places.data();
    auto cut = make<hf_cut>();
    check(hf_surface_trace_cut(surface, &line, &cut));
    Numbers gone(cut.removed_triangle_count), corners(3 * cut.new_triangle_count), sources(cut.new_triangle_count);
    Doubles positions(3 * cut.new_vertex_count), weights(9 * cut.new_triangle_count);
    cut.removed_triangle_capacity = cut.removed_triangle_count;
    cut.new_vertex_capacity = cut.new_vertex_count;
    cut.new_triangle_capacity = cut.new_triangle_count;
    cut.removed_triangles = gone.data();
    cut.new_positions = positions.data();
    cut.new_triangles = corners.data();
    cut.corner_barycentrics = weights.data();
    cut.source_triangles = sources.data();
    check(hf_surface_trace_cut(surface, &line, &cut));
    edit_surface(
        {{"as", step["as"]}, {"removed_triangles", gone}, {"new_positions", positions}, {"new_triangles", corners}},
        surface);
    result.array.emplace();
    for (size_t t = 0; t < sources.size(); ++t) {
      result.array->push_back(sources[t]);
      result.array->insert(result.array->end(), &corners[3 * t], &corners[3 * t] + 3);
      result.array->insert(result.array->end(), &weights[9 * t], &weights[9 * t] + 9);
    }
  } else if (what == "cuts") {
    uint32_t size = 0;
    check(hf_surface_get_cuts(surface, 0, nullptr, &size));
    std::vector<hf_cut_corner> cuts(size);
    check(hf_surface_get_cuts(surface, size, cuts.data(), &size));
    result.array.emplace();
    for (const hf_cut_corner& cut : cuts)
      for (const uint32_t x : {cut.triangle, cut.corner, cut.vertex, cut.copied}) result.array->push_back(x);
  } else {  // save
    const int32_t kind = step.value("field_kind", 0);
    size_t size = 0;
    check(hf_surface_save(surface, kind, nullptr, 0, nullptr, &size));
    auto& bytes = bytes_[step["as"]];
    bytes.resize(size);
    check(hf_surface_save(surface, kind, nullptr, size, bytes.data(), &size));
  }
  return result;
}

Result Scene::run_looking(const Json& step, const std::string& what, hf_surface surface, size_t n) {
  Result result;
  if (what == "propose") {
    std::vector<hf_handle_proposal> found(HF_HANDLE_LIMIT);
    uint32_t size = 0;
    check(hf_surface_propose_handles(surface, nullptr, HF_HANDLE_LIMIT, found.data(), &size));
    result.array.emplace();
    for (uint32_t i = 0; i < size; ++i) result.array->push_back(found[i].vertex);
    std::sort(result.array->begin(), result.array->end());
    return result;
  }
  if (what == "extremities") {
    std::vector<hf_extremity> found(64);
    uint32_t size = 0;
    check(hf_surface_find_extremities(surface, nullptr, 64, found.data(), &size));
    result.array.emplace();
    for (uint32_t i = 0; i < size; ++i) result.array->push_back(found[i].vertex);
    std::sort(result.array->begin(), result.array->end());
    return result;
  }
  const auto field = doubles(step, "field", n);
  const hf_array scalars = HF_ARRAY(data(field), field ? n : 0);
  if (what == "levels") {
    const uint32_t wanted = step["count"];
    const int32_t spacing = step["spacing"] == "HF_LEVELS_AREA"     ? HF_LEVELS_AREA
                            : step["spacing"] == "HF_LEVELS_LENGTH" ? HF_LEVELS_LENGTH
                                                                    : HF_LEVELS_VALUE;
    result.array.emplace(std::max(1u, wanted));
    check(hf_surface_space_levels(surface, &scalars, spacing, wanted, result.array->data()));
  } else if (what == "isolines") {
    const auto levels = doubles(step, "levels");
    auto lines = make<hf_isolines>();
    check(hf_surface_trace_isolines(surface, &scalars, count(levels), data(levels), &lines));
    result.array.emplace(3 * size_t{lines.point_count});
    std::vector<int32_t> closed(lines.line_count);
    lines.point_capacity = lines.point_count;
    lines.line_capacity = lines.line_count;
    lines.positions = result.array->data();
    lines.line_closed = closed.data();
    check(hf_surface_trace_isolines(surface, &scalars, count(levels), data(levels), &lines));
    if (step.contains("lines")) {
      int32_t sum = 0;
      for (int32_t one : closed) sum += one;
      expect(step["lines"] == lines.line_count && step["closed"] == sum, "lines");
    }
  } else {
    std::vector<hf_critical_point> points(1000);
    auto info = make<hf_critical_info>();
    check(hf_surface_find_critical_points(surface, &scalars, 1000, points.data(), &info));
    result.array.emplace();
    for (uint32_t i = 0; i < info.point_count; ++i) result.array->push_back(points[i].index);
  }
  return result;
}

}  // namespace golden

// Methods of the surface itself: making, sharing, saving and picking it (hf/surface.h).
#include "surface.h"

#include "arguments.h"

namespace hf_godot {
namespace {

// Makes the surface of a desc that holds the triangles or the faces. links: HF_LINK_NONE or HF_LINK_PIECES.
Value create_of(Surface& s, hf_surface_desc& desc, const Argument& positions_given, const Argument& options,
                const Argument& saved) {
  auto links = make<hf_links_desc>();
  read_options(options, {{"link_pieces", &links.mode},
                         {"weld", &desc.weld},
                         {"weld_tolerance", &desc.weld_tolerance},
                         {"operator_kind", &desc.operator_kind},
                         {"field_kind", &desc.field_kind},
                         {"ordering", &desc.ordering},
                         {"thread_count", &desc.thread_count},
                         {"vertex_limit", &desc.vertex_limit},
                         {"triangle_limit", &desc.triangle_limit},
                         {"memory_limit_mb", &desc.memory_limit_mb}});
  if (links.mode != HF_LINK_NONE && links.mode != HF_LINK_PIECES) fail("link_pieces must be 0 or 1");
  desc.links = &links;
  if (positions_given.null) fail("positions are null", HF_ERROR_NULL_POINTER);
  const Doubles& positions = positions_given.list;
  if (positions.size() % 3) fail("positions hold three numbers each");
  desc.positions = HF_ARRAY(positions.data(), positions.size() / 3);
  auto factor = make<hf_factor_desc>();
  if (!saved.bytes.empty()) {
    factor.bytes = saved.bytes.data();
    factor.byte_count = saved.bytes.size();
    desc.saved_factor = &factor;
  }
  hf_surface raw = nullptr;
  check(hf_surface_create(&desc, &raw));
  s.forget();
  s.mesh = std::make_shared<hf::Handle<hf_surface, hf_surface_destroy>>(raw);
  s.vertex_count = desc.positions.count;
  return done();
}

// create(positions, triangles, options = {}, saved factor = null): forgets what was made on the mesh before
Value create(Surface& s, const Arguments& a) {
  auto desc = make<hf_surface_desc>();
  const List triangles = integers(at(a, 1), "triangles");
  if (triangles.values.size() % 3) fail("triangles hold three numbers each");
  desc.triangles = HF_ARRAY(triangles.data(), triangles.values.size() / 3);
  return create_of(s, desc, at(a, 0), at(a, 2), at(a, 3));
}

// create_faces(positions, offsets, corners, options = {}, saved factor = null): faces of any number of corners; those
// of face f are corners[offsets[f]] to corners[offsets[f + 1] - 1]
Value create_faces(Surface& s, const Arguments& a) {
  auto desc = make<hf_surface_desc>();
  const List offsets = integers(at(a, 1), "offsets"), corners = integers(at(a, 2), "corners");
  auto faces = make<hf_faces_desc>();
  faces.starts = HF_ARRAY(offsets.data(), offsets.values.size());
  faces.corners = HF_ARRAY(corners.data(), corners.values.size());
  desc.faces = &faces;
  return create_of(s, desc, at(a, 0), at(a, 3), at(a, 4));
}

// share_from(surface): the same mesh and factor, with nothing made on it yet
Value share_from(Surface& s, const Arguments& a) {
  if (!at(a, 0).surface) fail("share_from needs a surface");
  const Surface& other = *a[0].surface;
  if (!other.get()) fail("the surface was disposed or not created", HF_ERROR_INVALID_OBJECT);
  const auto mesh = other.mesh;
  const size_t vertex_count = other.vertex_count;
  s.forget();
  s.mesh = mesh;
  s.vertex_count = vertex_count;
  return done();
}

// clone_from(surface): the same mesh and factor, and a copy of its sites
Value clone_from(Surface& s, const Arguments& a) {
  if (!at(a, 0).surface) fail("clone_from needs a surface");
  hf_solver raw = nullptr;
  check(hf_solver_clone(solver_of(*a[0].surface), &raw));
  hf::Handle<hf_solver, hf_solver_destroy> made(raw);
  share_from(s, a);
  s.solver = std::move(made);
  return done();
}

Value dispose(Surface& s, const Arguments&) {
  s.forget();
  s.mesh.reset();
  return done();
}

Value report(Surface& s, const Arguments&) {
  auto found = make<hf_surface_report>();
  check(hf_surface_get_report(s.get(), &found));
  auto links = make<hf_links_info>();
  check(hf_surface_get_links_info(s.get(), &links));
  auto mesh = make<hf_mesh_statistics>();
  check(hf_surface_get_mesh_statistics(s.get(), &mesh));
  return named({{"vertex_count", found.vertex_count},
                {"component_count", found.component_count},
                {"piece_count", links.piece_count},
                {"link_count", links.link_count},
                {"polygon_count", mesh.polygon_count},
                {"boundary_edge_count", found.boundary_edge_count},
                {"isolated_vertex_count", found.isolated_vertex_count},
                {"non_manifold_edge_count", found.non_manifold_edge_count}});
}

// components(): of every vertex; -1 for isolated ones
Value components(Surface& s, const Arguments&) {
  Numbers found(s.vertex_count);
  check(hf_surface_get_components(s.get(), static_cast<uint32_t>(found.size()), found.data(), nullptr));
  return numbers(std::move(found));
}

// save(field_kind = 0): the factor as bytes, for create
Value save(Surface& s, const Arguments& a) {
  const int32_t kind = signed_whole(at(a, 0).number, "field_kind");
  size_t size = 0;
  check(hf_surface_save(s.get(), kind, nullptr, 0, nullptr, &size));
  Value value;
  value.kind = Value::bytes;
  value.octets.resize(size);
  check(hf_surface_save(s.get(), kind, nullptr, size, value.octets.data(), nullptr));
  return value;
}

hf_pick_desc pick_of(const Surface& s, const Argument& positions) {
  auto desc = make<hf_pick_desc>();
  desc.positions = rows_of(positions, 3, s.vertex_count, "positions");
  return desc;
}

// cast_ray(origin, direction, posed positions = null, front only = false): the first triangle on a ray, {} for none
Value cast_ray(Surface& s, const Arguments& a) {
  hf_pick_desc desc = pick_of(s, at(a, 2));
  desc.front_only = signed_whole(at(a, 3).number, "front only");
  auto hit = make<hf_hit>();
  const double *origin = doubles(at(a, 0), 3, "origin"), *direction = doubles(at(a, 1), 3, "direction");
  check(hf_surface_cast_ray(s.get(), origin, direction, &desc, &hit));
  if (!hit.found) return named({});
  return named({{"triangle", hit.triangle},
                {"vertex", hit.vertex},
                {"corner_0", hit.place.corners[0]},
                {"corner_1", hit.place.corners[1]},
                {"corner_2", hit.place.corners[2]},
                {"weight_0", hit.place.barycentrics[0]},
                {"weight_1", hit.place.barycentrics[1]},
                {"weight_2", hit.place.barycentrics[2]},
                {"x", hit.position[0]},
                {"y", hit.position[1]},
                {"z", hit.position[2]},
                {"distance", hit.distance}});
}

// find_vertex(point, posed positions = null): { vertex, distance } of the nearest vertex
Value find_vertex(Surface& s, const Arguments& a) {
  const hf_pick_desc desc = pick_of(s, at(a, 1));
  uint32_t vertex = 0;
  double distance = 0;
  check(hf_surface_find_vertex(s.get(), doubles(at(a, 0), 3, "point"), &desc, &vertex, &distance));
  return named({{"vertex", vertex}, {"distance", distance}});
}

std::vector<Entry> all_methods() {
  std::vector<Entry> all = {{"create", 2, 4, create},         {"create_faces", 3, 5, create_faces},
                            {"share_from", 1, 1, share_from}, {"clone_from", 1, 1, clone_from},
                            {"dispose", 0, 0, dispose},       {"report", 0, 0, report},
                            {"components", 0, 0, components}, {"save", 0, 1, save},
                            {"cast_ray", 2, 4, cast_ray},     {"find_vertex", 1, 2, find_vertex}};
  for (const auto& more : {solver_methods(), pose_methods(), field_methods(), region_methods(), edit_methods(),
                           retarget_methods(), made_methods()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace

const std::vector<Entry>& methods() {
  static const std::vector<Entry> all = all_methods();
  return all;
}

Value call(Surface& surface, const Entry& entry, const Arguments& arguments) noexcept {
  surface.error_name.clear();
  surface.error_message.clear();
  surface.error_index = -1;
  try {
    const int count = static_cast<int>(arguments.size());
    if (count < entry.least || count > entry.most)
      fail(std::string(entry.name) + " takes " + std::to_string(entry.least) + " to " + std::to_string(entry.most) +
           " arguments");
    return entry.method(surface, arguments);
  } catch (const hf::Error& error) {
    surface.error_name = hf_result_get_name(error.code());
    surface.error_message = error.what();
    surface.error_index = error.index() == HF_NO_INDEX ? -1.0 : error.index();
  } catch (const std::exception& error) {
    surface.error_name = "HF_ERROR_INTERNAL";
    surface.error_message = error.what();
  }
  return {};
}

}  // namespace hf_godot

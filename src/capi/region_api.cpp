// hf/detail.h: regions.
#include <algorithm>
#include <cmath>

#include "capi/morph_out.h"
#include "capi/region_object.h"

namespace hf_inner::capi {
namespace {

// Positions of the vertices as given: the caller's, or the solver's own.
Vector<Vec3> read_positions(const Core& core, const hf_region_desc& desc) {
  if (desc.positions && desc.positions_f64)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "positions and positions_f64 are both set; set one");
  const Mesh& mesh = core.mesh;
  const std::size_t count = mesh.report.vertex_count;
  Vector<Vec3> positions(count, core.memory.get());
  if (desc.positions || desc.positions_f64) {
    const ConstRows rows =
        desc.positions_f64
            ? ConstRows(desc.positions_f64, stride_of(desc.position_stride, 3 * sizeof(double), "position_stride"))
            : ConstRows(desc.positions, stride_of(desc.position_stride, 3 * sizeof(float), "position_stride"));
    for (std::size_t v = 0; v < count; ++v) {
      const Vec3 p{rows.get(v, 0), rows.get(v, 1), rows.get(v, 2)};
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        fail(HF_ERROR_NON_FINITE, static_cast<std::uint32_t>(v), "the position of vertex %zu is not finite", v);
      positions[v] = p;
    }
    return positions;
  }
  for (std::size_t v = 0; v < count; ++v) {
    const std::int32_t inner = mesh.inner_of_given[v];
    if (inner != Mesh::none) positions[v] = mesh.to_given(mesh.positions[static_cast<std::size_t>(inner)]);
  }
  for (const Mesh::Isolated& entry : mesh.isolated) positions[static_cast<std::size_t>(entry.given)] = entry.position;
  return positions;
}

void check_count(const Mesh& mesh, std::uint32_t count, const char* name) {
  if (count > mesh.report.vertex_count)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%s is %u; the mesh has %u vertices", name, count, mesh.report.vertex_count);
}

void need_triangle(const Vector<std::int32_t>& inner, const std::uint32_t* vertices, const char* name) {
  for (std::size_t i = 0; i < inner.size(); ++i)
    if (inner[i] == Mesh::none)
      fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(i),
           "entry %zu of %s: vertex %u is in no usable triangle", i, name, vertices[i]);
}

// The corner that a point on a triangle stands for.
std::int32_t corner_of(const Mesh& mesh, const hf_curve_desc& desc, std::uint32_t i) {
  const std::uint32_t triangle = desc.triangles[i];
  if (triangle >= mesh.report.triangle_count)
    fail(HF_ERROR_OUT_OF_RANGE, i, "entry %u of triangles: triangle %u, but there are %u triangles", i, triangle,
         mesh.report.triangle_count);
  const std::int32_t t = mesh.triangle_of_given[triangle];
  if (t == Mesh::none)
    fail(HF_ERROR_INVALID_ARGUMENT, i, "entry %u of triangles: triangle %u is collapsed or a duplicate", i, triangle);
  const double* w = desc.barycentrics + 3 * std::size_t{i};
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(w[k])) fail(HF_ERROR_NON_FINITE, i, "barycentrics %u: not finite", i);
    if (w[k] < 0) fail(HF_ERROR_INVALID_ARGUMENT, i, "barycentrics %u: %g is below 0", i, w[k]);
  }
  const double sum = w[0] + w[1] + w[2];
  if (!(std::fabs(sum - 1) <= 1e-6))
    fail(HF_ERROR_INVALID_ARGUMENT, i, "barycentrics %u sum to %g; they must sum to 1", i, sum);
  return mesh.triangle(t)[std::max_element(w, w + 3) - w];
}

// Reads a curve into points and the edit's side.
void read_curve(const Mesh& mesh, const hf_curve_desc* given, Vector<std::int32_t>& points, RegionEdit& edit) {
  const hf_curve_desc desc = read_struct(given, "curve");
  check_choice(desc.side, 3, "side");
  if (desc.vertices && (desc.triangles || desc.barycentrics))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "vertices and triangles are both set; set one");
  if (!desc.vertices) require(desc.triangles, "vertices and triangles"), require(desc.barycentrics, "barycentrics");
  constexpr std::uint32_t least = 3;
  if (desc.point_count < least)
    fail(HF_ERROR_EMPTY, desc.point_count, "a closed curve takes %u points or more; %u are given", least,
         desc.point_count);
  check_count(mesh, desc.point_count, "point_count");
  if (desc.vertices) {
    append_inner(mesh, desc.point_count, desc.vertices, "vertices", points);
    need_triangle(points, desc.vertices, "vertices");
  } else {
    for (std::uint32_t i = 0; i < desc.point_count; ++i) points.push_back(corner_of(mesh, desc, i));
  }
  for (std::uint32_t i = 0; i < desc.point_count; ++i) {
    if (mesh.component[static_cast<std::size_t>(points[i])] != mesh.component[static_cast<std::size_t>(points[0])])
      fail(HF_ERROR_INVALID_ARGUMENT, i, "point %u of the curve is in another component than point 0", i);
  }
  edit.curve = points, edit.side = static_cast<CurveSide>(desc.side);
  if (edit.side != CurveSide::seed) return;
  if (desc.seed_vertex >= mesh.report.vertex_count)
    fail(HF_ERROR_OUT_OF_RANGE, desc.seed_vertex, "seed_vertex is %u, but there are %u vertices", desc.seed_vertex,
         mesh.report.vertex_count);
  edit.seed = mesh.inner_of_given[desc.seed_vertex];
  if (edit.seed == Mesh::none)
    fail(HF_ERROR_INVALID_ARGUMENT, desc.seed_vertex, "seed vertex %u is in no usable triangle", desc.seed_vertex);
}

void read_list(const Mesh& mesh, std::uint32_t count, const std::uint32_t* vertices, const char* name,
               Vector<std::int32_t>& out) {
  if (count == 0) return;
  require(vertices, name);
  check_count(mesh, count, name);
  append_inner(mesh, count, vertices, name, out);
  need_triangle(out, vertices, name);
}

void edit_region(hf_region handle, const hf_region_edit_desc* given) {
  const auto object = get<RegionObject>(handle, Kind::region, "region");
  const hf_region_edit_desc desc = read_struct(given, "edit");
  std::shared_ptr<ProgressObject> progress;
  if (desc.progress) progress = get<ProgressObject>(desc.progress, Kind::progress, "progress");
  const Changing changing(*object);
  const Mesh& mesh = object->region.core().mesh;
  Memory* const memory = object->memory.get();
  Vector<std::int32_t> points(memory), remove(memory), add(memory);
  RegionEdit edit;
  if (desc.curve) read_curve(mesh, desc.curve, points, edit);
  read_list(mesh, desc.remove_count, desc.remove_vertices, "remove_vertices", remove);
  read_list(mesh, desc.add_count, desc.add_vertices, "add_vertices", add);
  edit.rings = desc.ring_count, edit.remove = remove, edit.add = add;
  edit.progress = progress ? &progress->progress : nullptr;
  try {
    object->region.edit(edit);
  } catch (const Error& error) {
    if (error.code() == HF_ERROR_CANCELLED && progress) progress->progress.reset();  // one cancel stops one call
    throw;
  }
}

hf_region_info info_of(const Region& region) {
  const RegionState& state = *region.state();
  const EngineCounters counters = state.engine->counters();
  hf_region_info info{};
  info.thin_plate = region.core().refinements > 0;
  info.vertex_count = static_cast<std::uint32_t>(state.shape->inside.size());
  info.rim_count = static_cast<std::uint32_t>(state.shape->rim.size());
  info.site_count = static_cast<std::uint32_t>(state.shape->sites.size());
  info.inserted_count = state.inserted, info.removed_count = state.removed, info.kept_count = state.kept;
  info.factorisation_count = counters.factorisations - 1;  // the core's counts as one
  info.path_solve_count = counters.path_solves;
  info.last_route = static_cast<std::uint32_t>(counters.last_route);
  info.whole_sweep = state.whole_sweep;
  const double scale = region.core().mesh.scale;
  info.area = state.area * scale * scale, info.base_area = state.base_area * scale * scale;
  return info;
}

void get_vertices(hf_region handle, std::int32_t list, std::uint32_t capacity, std::uint32_t* out_vertices) {
  const auto object = get<RegionObject>(handle, Kind::region, "region");
  check_choice(list, 3, "list");
  require(out_vertices, "out_vertices");
  const Reading reading(*object);
  const RegionShape& shape = *object->region.state()->shape;
  const Vector<std::int32_t>& vertices = list == HF_REGION_INSIDE ? shape.inside
                                         : list == HF_REGION_RIM  ? shape.rim
                                                                  : shape.sites;
  if (capacity < vertices.size())
    fail(HF_ERROR_TOO_SMALL, HF_NO_INDEX, "capacity is %u; %zu are needed", capacity, vertices.size());
  const Mesh& mesh = object->region.core().mesh;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    out_vertices[i] = static_cast<std::uint32_t>(mesh.given_of_inner[static_cast<std::size_t>(vertices[i])]);
  std::sort(out_vertices, out_vertices + vertices.size());
}

void morph(hf_region handle, const hf_morph_desc* given) {
  const auto object = get<RegionObject>(handle, Kind::region, "region");
  const MorphOut out = read_morph(given);
  const Reading reading(*object);
  const RegionSurface& surface = *object->region.surface();
  const RegionState& state = *object->region.state();
  write_morph(surface, state, out,
              [&](std::size_t v, std::size_t i) { return morphed(surface.positions[v], state.base[i], out.weight); });
}

template <class Work>
hf_result change(const char* function, hf_region handle, Work&& work) {
  return guarded(function, [&] {
    const auto object = get<RegionObject>(handle, Kind::region, "region");
    const Changing changing(*object);
    work(object->region);
  });
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_region_create(hf_solver handle, const hf_region_desc* given, hf_region* out_region) {
  return guarded("hf_region_create", [&] {
    require(out_region, "out_region");
    *out_region = nullptr;
    const auto solver = get<SolverObject>(handle, Kind::solver, "solver");
    hf_region_desc desc{};
    if (given) desc = read_struct(given, "desc");
    const Reading reading(*solver);
    if (solver->field.engine().kind() != EngineKind::green)
      fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX, "regions need a solver with HF_ENGINE_GREEN");
    const std::shared_ptr<const Core>& core = solver->field.shared_core();
    auto surface = make_owner_in<RegionSurface>(solver->memory, core, read_positions(*core, desc));
    *out_region = reinterpret_cast<hf_region>(insert(make_owner_in<RegionObject>(solver->memory, std::move(surface))));
  });
}

hf_result hf_region_clone(hf_region handle, hf_region* out_region) {
  return guarded("hf_region_clone", [&] {
    require(out_region, "out_region");
    *out_region = nullptr;
    const auto object = get<RegionObject>(handle, Kind::region, "region");
    const Reading reading(*object);
    *out_region = reinterpret_cast<hf_region>(insert(make_owner_in<RegionObject>(object->memory, *object)));
  });
}

void hf_region_destroy(hf_region region) {
  const FloatEnvironment environment;
  remove(reinterpret_cast<std::uintptr_t>(region), Kind::region);
}

hf_result hf_region_edit(hf_region region, const hf_region_edit_desc* edit) {
  return guarded("hf_region_edit", [&] { edit_region(region, edit); });
}

hf_result hf_region_record(hf_region region) {
  return change("hf_region_record", region, [](Region& r) { r.record(); });
}

hf_result hf_region_undo(hf_region region) {
  return change("hf_region_undo", region, [](Region& r) { r.undo(); });
}

hf_result hf_region_redo(hf_region region) {
  return change("hf_region_redo", region, [](Region& r) { r.redo(); });
}

hf_result hf_region_get_info(hf_region region, hf_region_info* out_info) {
  return guarded("hf_region_get_info", [&] {
    const auto object = get<RegionObject>(region, Kind::region, "region");
    check_struct(out_info, "out_info");
    const Reading reading(*object);
    write_struct(out_info, info_of(object->region));
  });
}

hf_result hf_region_get_vertices(hf_region region, int32_t list, uint32_t capacity, uint32_t* out_vertices) {
  return guarded("hf_region_get_vertices", [&] { get_vertices(region, list, capacity, out_vertices); });
}

hf_result hf_region_morph(hf_region region, const hf_morph_desc* desc) {
  return guarded("hf_region_morph", [&] { morph(region, desc); });
}

}  // extern "C"

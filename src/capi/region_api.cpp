// hf/region.h: regions.
#include <algorithm>
#include <cmath>

#include "capi/morph_out.h"
#include "capi/region_object.h"

namespace hf_inner::capi {
namespace {

// Positions of the vertices as given: the caller's, or the solver's own.
Vector<Vec3> read_positions(const Core& core, const hf_region_desc& desc) {
  check_one(desc.positions, desc.positions_f64, "positions");
  const Mesh& mesh = core.mesh;
  const std::size_t count = mesh.report.vertex_count;
  Vector<Vec3> positions(count, core.memory.get());
  if (desc.positions || desc.positions_f64) {
    const ConstRows rows = rows_of(desc.positions, desc.positions_f64, 3, desc.position_stride, "position_stride");
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
  check_vertex_count(mesh, desc.point_count, "point_count");
  if (desc.vertices) {
    append_usable(mesh, desc.point_count, desc.vertices, "vertices", points);
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
  check_vertex_count(mesh, count, name);
  append_usable(mesh, count, vertices, name, out);
}

hf_region_info info_of(const Region& region) {
  const RegionState& state = *region.state();
  const EngineCounters counters = state.engine->counters();
  hf_region_info info{};
  info.field_kind = static_cast<std::int32_t>(region.core().field_kind);
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

template <class Work>
hf_result change(const char* function, hf_region handle, Work&& work) {
  return guarded(function, [&] {
    const auto object = get<RegionObject>(handle, "region");
    const Changing changing(*object);
    work(object->region);
  });
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_region_create(hf_surface handle, const hf_region_desc* given, hf_region* out_region) {
  return guarded("hf_region_create", [&] {
    create(out_region, "out_region", [&] {
      const auto surface = get<SurfaceObject>(handle, "surface");
      const hf_region_desc desc = read_optional(given, "desc");
      check_choice(desc.field_kind, 3, "field_kind");
      require_zero(desc.reserved);
      return with_progress(desc.progress, [&](Progress* progress) {
        const auto core = surface->surface.core(static_cast<FieldKind>(desc.field_kind), progress);
        return make_owner_in<RegionObject>(
            core->memory, make_owner_in<RegionSurface>(core->memory, core, read_positions(*core, desc)));
      });
    });
  });
}

hf_result hf_region_clone(hf_region handle, hf_region* out_region) {
  return guarded("hf_region_clone", [&] {
    create(out_region, "out_region", [&] {
      const auto object = get<RegionObject>(handle, "region");
      const Reading reading(*object);
      return make_owner_in<RegionObject>(object->memory, *object);
    });
  });
}

void hf_region_destroy(hf_region region) { destroy<RegionObject>(region); }

hf_result hf_region_edit(hf_region handle, const hf_region_edit_desc* given) {
  return guarded("hf_region_edit", [&] {
    const auto object = get<RegionObject>(handle, "region");
    const hf_region_edit_desc desc = read_struct(given, "edit");
    const Changing changing(*object);
    const Mesh& mesh = object->region.core().mesh;
    Memory* const memory = object->memory.get();
    Vector<std::int32_t> points(memory), remove(memory), add(memory);
    RegionEdit edit;
    if (desc.curve) read_curve(mesh, desc.curve, points, edit);
    read_list(mesh, desc.remove_count, desc.remove_vertices, "remove_vertices", remove);
    read_list(mesh, desc.add_count, desc.add_vertices, "add_vertices", add);
    edit.rings = desc.ring_count, edit.remove = remove, edit.add = add;
    with_progress(desc.progress, [&](Progress* progress) {
      edit.progress = progress;
      object->region.edit(edit);
    });
  });
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
    const auto object = get<RegionObject>(region, "region");
    check_struct(out_info, "out_info");
    const Reading reading(*object);
    write_struct(out_info, info_of(object->region));
  });
}

hf_result hf_region_get_vertices(hf_region handle, int32_t list, uint32_t capacity, uint32_t* out_vertices,
                                 uint32_t* out_count) {
  return guarded("hf_region_get_vertices", [&] {
    const auto object = get<RegionObject>(handle, "region");
    check_choice(list, 3, "list");
    if (!out_vertices && !out_count)
      fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "out_vertices and out_count are both NULL");
    const Reading reading(*object);
    const RegionShape& shape = *object->region.state()->shape;
    const Vector<std::int32_t>& vertices = list == HF_REGION_INSIDE ? shape.inside
                                           : list == HF_REGION_RIM  ? shape.rim
                                                                    : shape.sites;
    write_count(out_count, vertices.size());
    check_capacity(out_vertices, capacity, vertices.size(), "capacity");
    if (!out_vertices) return;
    const Mesh& mesh = object->region.core().mesh;
    for (std::size_t i = 0; i < vertices.size(); ++i)
      out_vertices[i] = static_cast<std::uint32_t>(mesh.given_of_inner[static_cast<std::size_t>(vertices[i])]);
    std::sort(out_vertices, out_vertices + vertices.size());
  });
}

hf_result hf_region_morph(hf_region handle, const hf_morph_desc* given) {
  return guarded("hf_region_morph", [&] {
    const auto object = get<RegionObject>(handle, "region");
    const MorphOut out = read_morph(given);
    const Reading reading(*object);
    const RegionSurface& surface = *object->region.surface();
    const RegionState& state = *object->region.state();
    write_morph(surface, state, out,
                [&](std::size_t v, std::size_t i) { return morphed(surface.positions[v], state.base[i], out.weight); });
  });
}

}  // extern "C"

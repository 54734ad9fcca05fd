#include "surface/surface_intake.h"

#include <algorithm>
#include <cmath>

#include "base/arguments.h"
#include "factor/factor_bytes.h"
#include "factor/ordering.h"
#include "mesh/cut_edges.h"
#include "mesh/link_intake.h"
#include "mesh/places.h"
#include "surface/link_change.h"

namespace hf_inner::surface {
namespace {

// Bounds and defaults that hf/surface.h states. They bound what the mistake of a host can cost; no result depends on
// them. A closed mesh has two triangles per vertex.
constexpr std::uint32_t most_threads = 256, default_vertex_limit = 20000000, triangles_per_vertex = 8;
// Stiffness of a vertex. With 1e4 a region is rigid to four digits and fields are right to 1e-11. With 1e6 rounding in
// a diagonal shows in the ninth digit.
constexpr double least_vertex_stiffness = 1e-4, largest_vertex_stiffness = 1e4;
// An hour of one core.
constexpr std::uint32_t default_work_limit_gflop = 100000;
// Most edges per vertex of the vertex limit without an edge_limit. Tetrahedra have 7, neighbours of points 5 to 10.
constexpr std::uint32_t edges_per_vertex = 16;

factor::Ordering ordering_of(std::int32_t given) noexcept {
  return given == HF_ORDERING_METIS            ? factor::Ordering::metis
         : given == HF_ORDERING_MINIMUM_DEGREE ? factor::Ordering::minimum_degree
                                               : factor::Ordering::nested_dissection;
}

void check_limit(std::uint32_t count, std::uint32_t limit, const char* noun, const char* name) {
  if (count > limit) fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%u %s; the %s is %u", count, noun, name, limit);
}

void check_sum(std::uint32_t there, std::uint32_t more, std::uint32_t limit, const char* noun, const char* name) {
  if (more > limit || there > limit - more)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%u %s and %u new ones; the %s is %u", there, noun, more, name, limit);
}

}  // namespace

hf_surface_desc options_of(const hf_graph_desc& desc) {
  hf_surface_desc out{};
  out.positions.count = desc.vertex_count;
  out.weld = HF_WELD_NONE;
  out.field_kind = desc.field_kind;
  out.ordering = desc.ordering;
  out.thread_count = desc.thread_count;
  out.vertex_limit = desc.vertex_limit;
  out.memory_limit_mb = desc.memory_limit_mb;
  out.work_limit_gflop = desc.work_limit_gflop;
  out.allocator = desc.allocator;
  out.job_runner = desc.job_runner;
  out.progress = desc.progress;
  out.saved_factor = desc.saved_factor;
  return out;
}

mesh::FieldKind read_field_kind(std::int32_t given) {
  check_choice(given, 3, "field_kind");
  return static_cast<mesh::FieldKind>(given);
}

hf_surface_info read_info(const hf_surface_desc& desc) {
  hf_surface_info info{};
  check_choice(desc.weld, 3, "weld");
  check_choice(desc.operator_kind, 4, "operator_kind");
  read_field_kind(desc.field_kind);
  check_choice(desc.ordering, 3, "ordering");
  factor::require_ordering(ordering_of(desc.ordering));
  info.vertex_count = desc.positions.count;
  info.triangle_count = desc.triangles.count;
  info.weld = desc.weld;
  info.weld_tolerance = desc.weld_tolerance;
  info.operator_kind = desc.operator_kind;
  info.field_kind = desc.field_kind;
  info.ordering = desc.ordering;
  info.thread_count = count_of(desc.thread_count, 1, 1, most_threads, "thread_count");
  info.vertex_limit = desc.vertex_limit ? desc.vertex_limit : default_vertex_limit;
  info.triangle_limit = desc.triangle_limit;
  info.memory_limit_mb = desc.memory_limit_mb;
  info.work_limit_gflop = desc.work_limit_gflop ? desc.work_limit_gflop : default_work_limit_gflop;
  check_allocator(desc.allocator);
  return info;
}

void check_mesh_limits(const hf_surface_info& info) {
  check_limit(info.vertex_count, info.vertex_limit, "vertices", "vertex_limit");
  if (info.triangle_limit != 0) check_limit(info.triangle_count, info.triangle_limit, "triangles", "triangle_limit");
  if (info.triangle_limit == 0 && info.triangle_count / triangles_per_vertex > info.vertex_limit)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX,
         "%u triangles; without a triangle_limit at most eight per vertex of the vertex_limit %u are taken",
         info.triangle_count, info.vertex_limit);
}

void check_graph_limits(const hf_surface_info& info) {
  check_limit(info.vertex_count, info.vertex_limit, "vertices", "vertex_limit");
  if (info.edge_limit != 0) check_limit(info.edge_count, info.edge_limit, "edges", "edge_limit");
  if (info.edge_limit == 0 && info.edge_count / edges_per_vertex > info.vertex_limit)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX,
         "%u edges; without an edge_limit at most sixteen per vertex of the vertex_limit %u are taken", info.edge_count,
         info.vertex_limit);
}

CoreOptions core_options(const hf_surface_info& info) {
  CoreOptions options;
  options.flop_limit = 1e9 * static_cast<double>(info.work_limit_gflop);
  options.operator_kind = static_cast<mesh::OperatorKind>(info.operator_kind);
  options.field_kind = static_cast<mesh::FieldKind>(info.field_kind);
  options.ordering = static_cast<factor::Ordering>(info.ordering);
  return options;
}

CoreOptions options_like(const Surface& other) {
  CoreOptions options;
  options.operator_kind = other.own().geometry->operator_kind;
  options.field_kind = other.field_kind();
  options.ordering = other.own().ordering;
  options.flop_limit = other.own().flop_limit;
  options.like = &other.own();
  return options;
}

void read_saved_factor(const hf_factor_desc& saved, std::int32_t ordering, CoreOptions& options) {
  require(saved.bytes, "saved_factor->bytes");
  check_flag(saved.borrow, "saved_factor->borrow");
  if (saved.byte_count == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "saved_factor->byte_count is 0");
  options.saved_factor = {static_cast<const std::uint8_t*>(saved.bytes), saved.byte_count};
  options.borrow_factor = saved.borrow != 0;
  const factor::Ordering found = factor::check_saved_factor(options.saved_factor);
  if (ordering != 0 && options.ordering != found)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "ordering is %d, but the saved factor has ordering %d; set it to 0 to take the factor's", ordering,
         static_cast<int>(found));
  options.ordering = found;
}

namespace {

std::shared_ptr<const Vector<double>> read_stiffness(const hf_surface_edit_desc& desc, const Surface& before) {
  const mesh::Mesh& mesh = before.geometry().mesh;
  const std::uint32_t given = mesh.report.vertex_count;
  require_list(desc.vertex_count, desc.stiffness, "vertex_count", "stiffness");
  if (!desc.vertices && desc.vertex_count != given)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "vertex_count is %u; without a list of vertices it must be the vertex count of the surface, %u",
         desc.vertex_count, given);
  Memory& memory = *before.geometry().memory;
  auto stiffness = make_shared_in<Vector<double>>(memory, mesh.positions.size(), 1.0);
  if (before.stiffness()) *stiffness = *before.stiffness();
  Vector<std::uint8_t> named(mesh.positions.size(), 0, &memory);
  for (std::uint32_t i = 0; i < desc.vertex_count; ++i) {
    const std::uint32_t vertex = desc.vertices ? desc.vertices[i] : i;
    const double s = desc.stiffness[i];
    if (vertex >= given)
      fail(HF_ERROR_OUT_OF_RANGE, i, "entry %u of vertices is %u; the surface has %u vertices", i, vertex, given);
    if (!std::isfinite(s)) fail(HF_ERROR_NON_FINITE, i, "entry %u of stiffness is not finite", i);
    if (!(s >= least_vertex_stiffness && s <= largest_vertex_stiffness))
      fail(HF_ERROR_INVALID_ARGUMENT, i, "entry %u of stiffness is %g; it must be %g to %g", i, s,
           least_vertex_stiffness, largest_vertex_stiffness);
    const std::int32_t v = mesh.inner_of_given[vertex];
    if (v == mesh::Mesh::none) continue;
    double& out = (*stiffness)[static_cast<std::size_t>(v)];
    if (named[static_cast<std::size_t>(v)] && out != s)
      fail(HF_ERROR_CONFLICT, i, "entry %u: vertex %u, or a welded copy of it, is listed before with stiffness %g", i,
           vertex, out);
    named[static_cast<std::size_t>(v)] = 1;
    out = s;
  }
  const bool plain = std::all_of(stiffness->begin(), stiffness->end(), [](double s) { return s == 1; });
  return plain ? nullptr : stiffness;
}

// Marks the links that go out.
Vector<std::uint8_t> read_removed_links(const hf_surface_edit_desc& desc, const mesh::Links* links, Memory& memory) {
  Vector<std::uint8_t> removed(links ? links->links.size() : 0, 0, &memory);
  if (desc.removed_link_count > 0) require(desc.removed_links, "removed_links");
  for (std::uint32_t i = 0; i < desc.removed_link_count; ++i) {
    const std::uint32_t link = desc.removed_links[i];
    if (link >= removed.size())
      fail(HF_ERROR_NOT_FOUND, i, "entry %u of removed_links is %u; the surface has %zu links", i, link,
           removed.size());
    if (removed[link]) fail(HF_ERROR_CONFLICT, i, "entry %u: link %u is listed twice", i, link);
    removed[link] = 1;
  }
  return removed;
}

std::shared_ptr<const Geometry> read_link_edit(const hf_surface_edit_desc& desc, const Surface& before) {
  const Geometry& geometry = before.geometry();
  const mesh::Mesh& mesh = geometry.unlinked().mesh;
  mesh::require_triangles(mesh, "links", HF_NO_INDEX);
  Memory& memory = *geometry.memory;
  const Vector<std::uint8_t> removed = read_removed_links(desc, geometry.links.get(), memory);
  Vector<mesh::Link> added(&memory);
  mesh::read_link_list(desc.link_count, desc.links, mesh, added);
  return before.geometry_of(edited_links(mesh, geometry.links.get(), removed, added, memory));
}

// Reads the triangles that go and come. Vertices keep their stiffness, a copy has the stiffness of the copied vertex,
// and new vertices have the stiffness 1.
SurfaceEdit read_patch(const hf_patch_desc& desc, const Surface& before, const hf_surface_info& info) {
  require_zero(desc.reserved);
  const bool exchanges = desc.removed_triangle_count > 0 || desc.new_vertex_count > 0 || desc.new_triangle_count > 0;
  if (desc.cut_edge_count > 0 && exchanges)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "one patch cuts, or exchanges triangles; make two edits");
  if (desc.cut_edge_count == 0 && !exchanges) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "the patch is empty");
  if (desc.cut_edge_count > 0) require(desc.cut_edges, "patch->cut_edges");
  if (desc.removed_triangle_count > 0) require(desc.removed_triangles, "patch->removed_triangles");
  if (desc.new_vertex_count > 0) require(desc.new_positions, "patch->new_positions");
  if (desc.new_triangle_count > 0) require(desc.new_triangles, "patch->new_triangles");
  const Geometry& old = before.geometry();
  check_sum(old.mesh.report.vertex_count, desc.new_vertex_count, info.vertex_limit, "vertices", "vertex_limit");
  if (info.triangle_limit != 0)
    check_sum(old.mesh.report.triangle_count, desc.new_triangle_count, info.triangle_limit, "triangles",
              "triangle_limit");
  else if ((std::size_t{old.mesh.report.triangle_count} + desc.new_triangle_count) / triangles_per_vertex >
           info.vertex_limit)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX,
         "%u triangles and %u new ones; without a triangle_limit at most eight per vertex of the vertex_limit %u are "
         "taken",
         old.mesh.report.triangle_count, desc.new_triangle_count, info.vertex_limit);
  Vector<Vec3> positions(old.memory.get());
  for (std::uint32_t v = 0; v < desc.new_vertex_count; ++v) {
    const double* const p = desc.new_positions + std::size_t{3} * v;
    positions.push_back({p[0], p[1], p[2]});
  }
  mesh::MeshPatch patch;
  patch.removed = {desc.removed_triangles, desc.removed_triangle_count};
  patch.positions = positions;
  patch.triangles = {desc.new_triangles, std::size_t{3} * desc.new_triangle_count};
  Vector<mesh::Mesh::CutCorner> cuts(old.memory.get());
  if (desc.cut_edge_count > 0)
    cuts = mesh::cut_edges(old.mesh, {desc.cut_edges, std::size_t{2} * desc.cut_edge_count}, *old.memory);
  patch.cuts = cuts;
  const std::uint32_t count = old.mesh.report.vertex_count;
  if (!cuts.empty())
    check_sum(count, static_cast<std::uint32_t>(cuts.back().vertex) + 1 - count, info.vertex_limit, "vertices",
              "vertex_limit");
  SurfaceEdit edit;
  edit.geometry = before.patched(patch);
  if (!before.stiffness()) return edit;
  const mesh::Mesh &mesh = edit.geometry->mesh, &from = old.mesh;
  auto stiffness = make_shared_in<Vector<double>>(*old.memory, mesh.positions.size(), 1.0);
  for (std::size_t v = 0; v < stiffness->size(); ++v) {
    const auto given = static_cast<std::size_t>(mesh.given_of_inner[v]);
    const std::int32_t there = given < from.inner_of_given.size() ? from.inner_of_given[given] : mesh::Mesh::none;
    if (there != mesh::Mesh::none) (*stiffness)[v] = (*before.stiffness())[static_cast<std::size_t>(there)];
  }
  for (const mesh::Mesh::CutCorner& cut : cuts) {
    const auto copied = static_cast<std::size_t>(from.inner_of_given[static_cast<std::size_t>(cut.copied)]),
               copy = static_cast<std::size_t>(mesh.inner_of_given[static_cast<std::size_t>(cut.vertex)]);
    (*stiffness)[copy] = (*before.stiffness())[copied];
  }
  edit.stiffness = stiffness;
  return edit;
}

}  // namespace

SurfaceEdit read_surface_edit(const hf_surface_edit_desc& desc, const hf_patch_desc* patch, const Surface& before,
                              const hf_surface_info& info) {
  if (patch) {
    if (desc.stiffness || desc.vertices || desc.vertex_count > 0 || desc.link_count > 0 || desc.removed_link_count > 0)
      fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
           "one edit takes a patch, or changes stiffness and links; make two edits");
    return read_patch(*patch, before, info);
  }
  SurfaceEdit edit;
  const bool links = desc.link_count > 0 || desc.removed_link_count > 0;
  if (desc.stiffness || desc.vertices || desc.vertex_count > 0 || !links)
    edit.stiffness = read_stiffness(desc, before);
  else if (before.stiffness())
    edit.stiffness = before.own().stiffness;
  if (links) edit.geometry = read_link_edit(desc, before);
  return edit;
}

}  // namespace hf_inner::surface

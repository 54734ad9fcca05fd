#include "surface/geometry.h"

#include <algorithm>

#include "base/error.h"
#include "base/index.h"
#include "base/timer.h"
#include "mesh/face_intake.h"
#include "mesh/orientation.h"

namespace hf_inner::surface {
namespace {

constexpr float welded = 0.1f, weighted = 0.15f;  // reported progress, by the usual share of time

void count_inside_out(const mesh::Mesh& mesh, mesh::MeshReport& report, Memory& memory) {
  report.inside_out_count = 0;
  const Vector<std::int8_t> sides = mesh::component_sides(mesh, memory);
  for (const std::int8_t side : sides) report.inside_out_count += side < 0;
  report.first_inside_out = mesh.first_of_given([&](Index v) { return sides[at(mesh.component[at(v)])] < 0; });
}

double box_diagonal(Span<const Vec3> positions) noexcept {
  Vec3 low = positions[0], high = low;
  for (const Vec3 p : positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return norm(high - low);
}

// Sums up the areas of vertices with other triangles again.
void sum_areas(const mesh::PatchedMesh& made, SharedVector<double>& areas) {
  const mesh::Mesh& mesh = made.mesh;
  for (const Index v : made.touched) areas[at(v)] = 0;
  for (const Index t : made.around) {
    const Index* const v = mesh.triangle(t);
    const Vec3 a = mesh.positions[at(v[0])];
    const double third = norm(cross(mesh.positions[at(v[1])] - a, mesh.positions[at(v[2])] - a)) / 6.0;
    for (int k = 0; k < 3; ++k)
      if (std::binary_search(made.touched.begin(), made.touched.end(), v[k])) areas[at(v[k])] += third;
  }
}

void count_given(Geometry& shape) {
  shape.given_count.assign(shape.mesh.report.component_count, 0);
  for (const Index v : shape.mesh.inner_of_given) {
    if (v != mesh::Mesh::none) ++shape.given_count[at(shape.mesh.component[at(v)])];
  }
}

mesh::MeshReport count_patched(const Geometry& shape) {
  const mesh::Mesh& mesh = shape.mesh;
  Memory& memory = *shape.memory;
  const mesh::Topology& edges = shape.topology();
  mesh::MeshReport counted = mesh.report;
  counted.degenerate_triangle_count = 0;
  counted.bounding_box_diagonal = mesh.scale * box_diagonal(mesh.positions);
  mesh::measure_triangles(mesh, counted, shape.jobs.get(), memory);
  mesh::count_edges(edges, counted);
  counted.negative_edge_count =
      mesh::count_negative(mesh::edge_weights(mesh, edges, mesh::OperatorKind::cotangent, memory, shape.jobs.get()));
  count_inside_out(mesh, counted, memory);
  return counted;
}

}  // namespace

Geometry::Geometry(std::shared_ptr<Memory> owner, std::shared_ptr<JobRunner> runner)
    : memory(std::move(owner)),
      jobs(std::move(runner)),
      mesh(*memory),
      areas(*memory),
      given_count(memory.get()),
      weight_units(memory.get()),
      limited(memory.get()),
      workspaces(*memory),
      zeroed_workspaces(*memory, true),
      edges_(*memory) {}

const mesh::MeshReport& Geometry::mesh_report() const {
  if (!count_report) return mesh.report;
  if (report_made_.load(std::memory_order_acquire)) return report_;
  const mesh::MeshReport counted = count_report(*this);
  const std::lock_guard<std::mutex> lock(edges_guard_);
  if (report_made_.load(std::memory_order_relaxed)) return report_;
  report_ = counted;
  report_made_.store(true, std::memory_order_release);
  return report_;
}

std::shared_ptr<const Geometry> Geometry::make(const mesh::MeshInput& input, mesh::OperatorKind operator_kind,
                                               std::shared_ptr<Memory> memory, std::shared_ptr<JobRunner> jobs) {
  Memory& pool = *memory;
  const std::shared_ptr<Geometry> shape = make_owner_in<Geometry>(memory, memory, std::move(jobs));
  shape->family = make_shared_in<char>(pool, '\0');
  JobRunner* const runner = shape->jobs.get();
  shape->operator_kind = operator_kind;
  report(0.0f);
  Timer weld_timer;
  {
    const ProgressRange range(0.0f, welded);
    shape->mesh = mesh::Mesh::make(input, pool, runner);
  }
  shape->weld_ms = weld_timer.milliseconds();
  report(welded);
  Timer weights_timer;
  shape->edges_.topology = mesh::Topology::make(shape->mesh, pool, runner);
  shape->areas = mesh::vertex_areas(shape->mesh, pool, runner);
  shape->edges_.weights =
      mesh::edge_weights(shape->mesh, shape->edges_.topology, mesh::OperatorKind::cotangent, pool, runner);
  mesh::MeshReport& found = shape->mesh.report;
  found.negative_edge_count = mesh::count_negative(shape->edges_.weights);
  if (operator_kind == mesh::OperatorKind::clamped || operator_kind == mesh::OperatorKind::uniform)
    shape->edges_.weights = mesh::edge_weights(shape->mesh, shape->edges_.topology, operator_kind, pool, runner);
  shape->jobs->for_each(3, [&](std::uint32_t i) {  // they write different members
    if (i == 0) {
      count_inside_out(shape->mesh, shape->mesh.report, pool);
    } else if (i == 1) {
      if (shape->mesh.faces.empty())
        mesh::count_edges(shape->edges_.topology, found);
      else
        mesh::count_face_sides(shape->mesh.faces, shape->edges_.topology, found, pool);
    } else {
      count_given(*shape);
    }
  });
  shape->edges_made_ = true;
  shape->weights_ms = weights_timer.milliseconds();
  report(weighted);
  return shape;
}

std::shared_ptr<const Geometry> Geometry::make(const mesh::GraphInput& input, std::shared_ptr<Memory> memory,
                                               std::shared_ptr<JobRunner> jobs) {
  const std::shared_ptr<Geometry> shape = make_owner_in<Geometry>(memory, memory, std::move(jobs));
  shape->family = make_shared_in<char>(*memory, '\0');
  shape->operator_kind = mesh::OperatorKind::graph;
  report(0.0f);
  Timer timer;
  mesh::WeightedGraph graph = mesh::WeightedGraph::make(input, *memory);
  shape->mesh = std::move(graph.mesh);
  shape->edges_.topology = std::move(graph.topology);
  shape->areas = std::move(graph.masses);
  shape->edges_.weights = std::move(graph.weights);
  shape->weight_units = std::move(graph.weight_unit);
  shape->limited = std::move(graph.limited);
  count_given(*shape);
  shape->edges_made_ = true;
  shape->weights_ms = timer.milliseconds();
  report(weighted);
  return shape;
}

std::shared_ptr<const Geometry> Geometry::linked(std::shared_ptr<const Geometry> plain,
                                                 const mesh::LinkOptions& options) {
  Memory& pool = *plain->memory;
  Timer timer;
  std::shared_ptr<const mesh::Links> links =
      mesh::make_links(plain->mesh, plain->areas, options, pool, plain->jobs.get());
  if (links->links.empty()) return plain;
  const std::shared_ptr<Geometry> shape = make_owner_in<Geometry>(plain->memory, plain->memory, plain->jobs);
  shape->operator_kind = plain->operator_kind;
  shape->family = plain->family;
  shape->count_report = plain->count_report;
  shape->mesh = mesh::linked_mesh(plain->mesh, *links, pool);
  shape->areas = plain->areas;
  count_given(*shape);
  shape->weld_ms = plain->weld_ms;
  shape->weights_ms = plain->weights_ms;
  shape->links = std::move(links);
  shape->plain = std::move(plain);
  shape->edges();
  shape->links_ms = timer.milliseconds();
  return shape;
}

std::shared_ptr<const Geometry> Geometry::relinked(std::shared_ptr<const Geometry> from,
                                                   std::shared_ptr<const mesh::Links> links) {
  const std::shared_ptr<Geometry> shape = make_owner_in<Geometry>(from->memory, from->memory, from->jobs);
  shape->operator_kind = from->operator_kind;
  shape->family = from->family;
  shape->count_report = from->count_report;
  shape->areas = from->areas;
  shape->plain = from->plain ? from->plain : from;
  const auto groups_of = [](const Geometry& geometry, const mesh::Links& of) {
    return geometry.links && geometry.links->group == of.group;
  };
  if (groups_of(*from, *links)) {
    shape->mesh = from->mesh;
    shape->given_count.assign(from->given_count.begin(), from->given_count.end());
  } else {
    shape->mesh = mesh::linked_mesh(shape->plain->mesh, *links, *shape->memory);
    shape->given_count.assign(static_cast<std::size_t>(links->group_count), 0);
    for (std::size_t piece = 0; piece < links->group.size(); ++piece)
      shape->given_count[at(links->group[piece])] += shape->plain->given_count[piece];
  }
  shape->weld_ms = from->weld_ms;
  shape->weights_ms = from->weights_ms;
  shape->links = std::move(links);
  return shape;
}

std::shared_ptr<const Geometry> Geometry::patched(std::shared_ptr<const Geometry> from, const mesh::MeshPatch& patch) {
  if (from->links && !from->links->links.empty())
    fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX,
         "triangles of a surface with links cannot be exchanged; take its links out, and put them in again after it");
  if (from->plain) from = from->plain;
  Timer timer;
  const std::shared_ptr<Geometry> shape = make_owner_in<Geometry>(from->memory, from->memory, from->jobs);
  mesh::PatchedMesh made =
      mesh::patched_mesh(from->mesh, from->known_topology(), patch, *shape->memory, shape->jobs.get());
  shape->operator_kind = from->operator_kind;
  shape->family = from->family;
  shape->is_patched = true;
  shape->count_report = &count_patched;
  const std::size_t count = made.mesh.positions.size();
  shape->areas.reserve(count);
  shape->areas.assign(from->areas.begin(), from->areas.end());
  for (std::size_t v = 0; v < made.number.size(); ++v)
    if (made.number[v] != mesh::Mesh::none) shape->areas[at(made.number[v])] = from->areas[v];
  shape->areas.resize(count);
  sum_areas(made, shape->areas);
  const bool kept = made.same_components && made.went.empty();
  shape->mesh = std::move(made.mesh);
  if (kept) {
    shape->given_count.assign(from->given_count.begin(), from->given_count.end());
    for (const Index g : made.came)
      ++shape->given_count[at(shape->mesh.component[at(shape->mesh.inner_of_given[at(g)])])];
  } else {
    count_given(*shape);
  }
  shape->weld_ms = from->weld_ms + timer.milliseconds();
  return shape;
}

std::shared_ptr<const Geometry> Geometry::moved(const Geometry& from, Span<const Vec3> positions) {
  const std::shared_ptr<Geometry> shape = make_shared_in<Geometry>(*from.memory, from.memory, from.jobs);
  shape->mesh = from.mesh;
  shape->mesh.positions = SharedVector<Vec3>(*from.memory);
  shape->mesh.positions.assign(positions.begin(), positions.end());
  shape->areas = from.areas;
  shape->operator_kind = from.operator_kind;
  shape->family = from.family;
  shape->is_patched = from.is_patched;
  shape->count_report = from.count_report;
  shape->edges_.topology = from.topology();
  shape->edges_.weights = from.weights();
  shape->edges_made_ = true;
  return shape;
}

const Geometry::Edges& Geometry::edges() const {
  if (edges_made_.load(std::memory_order_acquire)) return edges_;
  const std::lock_guard<std::mutex> lock(edges_guard_);
  if (edges_made_.load(std::memory_order_relaxed)) return edges_;
  Edges made(*memory);
  if (!plain) {  // a patched mesh
    made.topology = mesh::Topology::make(mesh, *memory, jobs.get());
    made.weights = mesh::edge_weights(
        mesh, made.topology,
        operator_kind == mesh::OperatorKind::intrinsic_delaunay ? mesh::OperatorKind::cotangent : operator_kind,
        *memory, jobs.get());
    edges_ = std::move(made);
    edges_made_.store(true, std::memory_order_release);
    return edges_;
  }
  made.weights.assign(plain->weights().begin(), plain->weights().end());
  made.topology = mesh::linked_topology(plain->topology(), *links, mesh::link_edges(*links, operator_kind, *memory),
                                        made.weights, *memory);
  edges_ = std::move(made);
  edges_made_.store(true, std::memory_order_release);
  return edges_;
}

}  // namespace hf_inner::surface

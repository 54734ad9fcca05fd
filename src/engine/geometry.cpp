#include "engine/geometry.h"

#include "base/index.h"
#include "base/timer.h"
#include "mesh/face_intake.h"
#include "mesh/orientation.h"

namespace hf_inner {

Geometry::Geometry(std::shared_ptr<Memory> owner, std::shared_ptr<JobRunner> runner)
    : memory(std::move(owner)),
      jobs(std::move(runner)),
      mesh(*memory),
      topology(*memory),
      areas(memory.get()),
      weights(memory.get()),
      given_count(memory.get()),
      weight_units(memory.get()),
      limited(memory.get()),
      workspaces(*memory),
      zeroed_workspaces(*memory, true) {}

namespace {

constexpr float welded = 0.1f, weighted = 0.15f;  // reported progress, by the usual share of time

void count_inside_out(Mesh& mesh, Memory& memory) {
  const Vector<std::int8_t> sides = component_sides(mesh, memory);
  for (const std::int8_t side : sides) mesh.report.inside_out_count += side < 0;
  mesh.report.first_inside_out = mesh.first_of_given([&](Index v) { return sides[at(mesh.component[at(v)])] < 0; });
}

void count_given(Geometry& shape) {
  shape.given_count.assign(shape.mesh.report.component_count, 0);
  for (const Index v : shape.mesh.inner_of_given) {
    if (v != Mesh::none) ++shape.given_count[at(shape.mesh.component[at(v)])];
  }
}

}  // namespace

std::shared_ptr<const Geometry> Geometry::make(const MeshInput& input, OperatorKind operator_kind,
                                               std::shared_ptr<Memory> memory, std::shared_ptr<JobRunner> jobs) {
  Memory& pool = *memory;
  const std::shared_ptr<Geometry> shape = make_owner_in<Geometry>(memory, memory, std::move(jobs));
  JobRunner* const runner = shape->jobs.get();
  shape->operator_kind = operator_kind;
  report(0.0f);
  Timer weld_timer;
  {
    const ProgressRange range(0.0f, welded);
    shape->mesh = Mesh::make(input, pool, runner);
  }
  shape->weld_ms = weld_timer.milliseconds();
  report(welded);
  Timer weights_timer;
  shape->topology = Topology::make(shape->mesh, pool, runner);
  shape->areas = vertex_areas(shape->mesh, pool, runner);
  shape->weights = edge_weights(shape->mesh, shape->topology, OperatorKind::cotangent, pool, runner);
  MeshReport& found = shape->mesh.report;
  found.negative_edge_count = count_negative(shape->weights);
  if (operator_kind == OperatorKind::clamped || operator_kind == OperatorKind::uniform)
    shape->weights = edge_weights(shape->mesh, shape->topology, operator_kind, pool, runner);
  shape->jobs->for_each(3, [&](std::uint32_t i) {  // they write different members
    if (i == 0) {
      count_inside_out(shape->mesh, pool);
    } else if (i == 1) {
      if (shape->mesh.faces.empty())
        count_edges(shape->topology, found);
      else
        count_face_sides(shape->mesh.faces, shape->topology, found, pool);
    } else {
      count_given(*shape);
    }
  });
  shape->weights_ms = weights_timer.milliseconds();
  report(weighted);
  return shape;
}

std::shared_ptr<const Geometry> Geometry::make(const GraphInput& input, std::shared_ptr<Memory> memory,
                                               std::shared_ptr<JobRunner> jobs) {
  const std::shared_ptr<Geometry> shape = make_owner_in<Geometry>(memory, memory, std::move(jobs));
  shape->operator_kind = OperatorKind::graph;
  report(0.0f);
  Timer timer;
  WeightedGraph graph = WeightedGraph::make(input, *memory);
  shape->mesh = std::move(graph.mesh);
  shape->topology = std::move(graph.topology);
  shape->areas = std::move(graph.masses);
  shape->weights = std::move(graph.weights);
  shape->weight_units = std::move(graph.weight_unit);
  shape->limited = std::move(graph.limited);
  count_given(*shape);
  shape->weights_ms = timer.milliseconds();
  report(weighted);
  return shape;
}

std::shared_ptr<const Geometry> Geometry::linked(std::shared_ptr<const Geometry> plain, const LinkOptions& options) {
  Memory& pool = *plain->memory;
  Timer timer;
  std::shared_ptr<const Links> links = make_links(plain->mesh, plain->areas, options, pool, plain->jobs.get());
  if (links->links.empty()) return plain;
  const std::shared_ptr<Geometry> shape = make_owner_in<Geometry>(plain->memory, plain->memory, plain->jobs);
  shape->operator_kind = plain->operator_kind;
  shape->mesh = linked_mesh(plain->mesh, *links, pool);
  shape->weights.assign(plain->weights.begin(), plain->weights.end());
  shape->areas.assign(plain->areas.begin(), plain->areas.end());
  shape->topology =
      linked_topology(plain->topology, *links, link_edges(*links, plain->operator_kind, pool), shape->weights, pool);
  count_given(*shape);
  shape->weld_ms = plain->weld_ms;
  shape->weights_ms = plain->weights_ms;
  shape->links_ms = timer.milliseconds();
  shape->links = std::move(links);
  shape->plain = std::move(plain);
  return shape;
}

}  // namespace hf_inner

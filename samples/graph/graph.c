/* Fields on graphs of your own: tetrahedra against exact solutions, and a cloud of points beside its mesh. */
#include "graph.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void* need(void* block) {
  if (!block) {
    fprintf(stderr, "out of memory\n");
    exit(2);
  }
  return block;
}

void ok(hf_result result) {
  hf_error_detail detail;
  if (result == HF_OK) return;
  hf_error_get_detail(&detail);
  fprintf(stderr, "%s: %s\n", detail.function, detail.message);
  exit(1);
}

double noise(uint32_t number) {
  uint32_t x = number * 2654435761u + 1u;
  for (int k = 0; k < 3; ++k) {
    x ^= x << 13;
    x ^= x >> 17;
    x ^= x << 5;
  }
  return (double)x / 4294967296.0 - 0.5;
}

void graph_add(Graph* graph, uint32_t a, uint32_t b, double weight) {
  if (graph->edge_count == graph->edge_capacity) {
    graph->edge_capacity = graph->edge_capacity ? 2 * graph->edge_capacity : 1024;
    graph->edges = need(realloc(graph->edges, sizeof(uint32_t) * 2 * graph->edge_capacity));
    graph->weights = need(realloc(graph->weights, sizeof(double) * graph->edge_capacity));
  }
  const size_t e = graph->edge_count++;
  graph->edges[2 * e] = a;
  graph->edges[2 * e + 1] = b;
  graph->weights[e] = weight;
}

void graph_free(Graph* graph) {
  free(graph->edges);
  free(graph->weights);
}

void graph_field(const Graph* graph, uint32_t vertex_count, int allow_negative, uint32_t site_count,
                 const uint32_t* sites, const double* values, double* out_field) {
  hf_graph_desc desc = HF_INIT(hf_graph_desc);
  desc.vertex_count = vertex_count;
  desc.edges = HF_ARRAY(graph->edges, graph->edge_count);
  desc.weights = HF_ARRAY(graph->weights, graph->edge_count);
  desc.allow_negative = allow_negative;
  hf_surface surface;
  ok(hf_surface_create_graph(&desc, &surface));

  hf_solver solver;
  hf_sites_desc held = HF_INIT(hf_sites_desc);
  held.site_count = site_count;
  held.vertices = sites;
  held.values = values;
  ok(hf_create(surface, NULL, &solver));
  ok(hf_add_sites(solver, &held, NULL));
  ok(hf_solver_solve(solver, &HF_ARRAY_OUT(out_field, vertex_count), NULL));

  hf_certificate certificate = HF_INIT(hf_certificate);
  ok(hf_solver_certify(solver, &certificate));
  hf_solver_destroy(solver);
  hf_surface_destroy(surface);
}

/* hf_graph [FOLDER]: with a folder it also draws tetrahedra.png and points.png there. */
int main(int argc, char** argv) {
  Dots cells = {0, NULL, NULL}, cloud = {0, NULL, NULL};
  int failed = tetrahedra(&cells) | points(&cloud);
  if (argc > 1) {
    char path[1024];
    snprintf(path, sizeof path, "%s/tetrahedra.png", argv[1]);
    failed |= draw_dots(path, &cells, 0.006);
    snprintf(path, sizeof path, "%s/points.png", argv[1]);
    failed |= draw_dots(path, &cloud, 0.004);
  }
  free(cells.positions);
  free(cells.values);
  free(cloud.positions);
  free(cloud.values);
  return failed;
}

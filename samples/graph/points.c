/* A cloud of points beside its mesh. The points lie on a mesh at random. A point is joined with all points within three
 * spacings. The weight of two points at distance d is
 *
 *     w_ij = exp(-d^2 / (2 h^2)) / (q_i q_j),     q_i = sum_j exp(-d_ij^2 / (2 h^2)),
 *
 * with the spacing h = sqrt(area / points). The factors q make the field independent of how dense the points are
 * (Coifman and Lafon 2006). All weights are above 0, so the field keeps to the range of its sites. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "graph.h"

enum { AROUND = 144, RINGS = 361 };        /* of the mesh, which is finer than the clouds */
static const double length = 4, reach = 3; /* of the leg; of an edge, in spacings */

typedef struct Cloud {
  uint32_t count;
  double spacing;
  double* positions; /* [count][3] */
  double* mesh;      /* [count] the field of the mesh at the points */
} Cloud;

/* A leg along y, thicker in the middle. */
static void leg(float* positions, uint32_t* triangles) {
  for (uint32_t v = 0; v < AROUND * RINGS; ++v) {
    const double y = length * (v / AROUND) / (RINGS - 1), angle = 6.283185307179586 * (v % AROUND) / AROUND;
    const double radius = 0.35 + 0.15 * sin(0.8 * y);
    float* p = positions + 3 * (size_t)v;
    p[0] = (float)(radius * cos(angle));
    p[1] = (float)y;
    p[2] = (float)(radius * sin(angle));
  }
  for (uint32_t q = 0; q < AROUND * (RINGS - 1); ++q) {
    const uint32_t ring = q / AROUND * AROUND, next = ring + (q + 1) % AROUND;
    const uint32_t corner[6] = {q, q + AROUND, next, next, q + AROUND, next + AROUND};
    for (int k = 0; k < 6; ++k) triangles[6 * (size_t)q + (size_t)k] = corner[k];
  }
}

/* The field of the mesh: x at the lower end, 1 at the upper end. */
static void mesh_field(const float* positions, const uint32_t* triangles, double* out_field) {
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.positions = HF_ARRAY(positions, AROUND * RINGS);
  desc.triangles = HF_ARRAY(triangles, 2 * AROUND * (RINGS - 1));
  hf_surface surface;
  hf_solver solver;
  ok(hf_surface_create(&desc, &surface));
  ok(hf_create(surface, NULL, &solver));
  for (uint32_t i = 0; i < AROUND; ++i) {
    const double low = (double)positions[3 * (size_t)i], high = 1;
    ok(hf_solver_add_site(solver, i, &low, NULL));
    ok(hf_solver_add_site(solver, AROUND * (RINGS - 1) + i, &high, NULL));
  }
  ok(hf_solver_solve(solver, &HF_ARRAY_OUT(out_field, AROUND * RINGS), NULL));
  hf_solver_destroy(solver);
  hf_surface_destroy(surface);
}

static double area_of(const float* a, const float* b, const float* c) {
  double u[3], v[3];
  for (int k = 0; k < 3; ++k) {
    u[k] = (double)b[k] - (double)a[k];
    v[k] = (double)c[k] - (double)a[k];
  }
  const double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  return 0.5 * sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
}

/* Puts points on the mesh at random, as many per area everywhere, with the mesh's field at each. */
static Cloud sample(const float* positions, const uint32_t* triangles, const double* field, uint32_t count) {
  Cloud cloud = {0, 0, need(malloc(sizeof(double) * 3 * count)), need(malloc(sizeof(double) * count))};
  double area = 0, done = 0;
  for (int pass = 0; pass < 2; ++pass) {
    for (uint32_t t = 0; t < 2 * AROUND * (RINGS - 1); ++t) {
      const uint32_t* corner = triangles + 3 * (size_t)t;
      const float *a = positions + 3 * (size_t)corner[0], *b = positions + 3 * (size_t)corner[1],
                  *c = positions + 3 * (size_t)corner[2];
      if (pass == 0) {
        area += area_of(a, b, c);
        continue;
      }
      done += area_of(a, b, c);
      while (cloud.count < count && (cloud.count + 0.5) / count * area <= done) {
        double s = noise(2 * cloud.count) + 0.5, r = noise(2 * cloud.count + 1) + 0.5;
        if (s + r > 1) {
          s = 1 - s;
          r = 1 - r;
        }
        const size_t i = cloud.count++;
        for (int k = 0; k < 3; ++k)
          cloud.positions[3 * i + (size_t)k] = (1 - s - r) * (double)a[k] + s * (double)b[k] + r * (double)c[k];
        cloud.mesh[i] = (1 - s - r) * field[corner[0]] + s * field[corner[1]] + r * field[corner[2]];
      }
    }
  }
  cloud.spacing = sqrt(area / count);
  return cloud;
}

/* Adds an edge of weight exp(-d^2 / (2 h^2)) for every two points within reach. The points ascend along y, but for the
 * height of a ring, so only points near in the list are near in space. */
static Graph near_graph(const Cloud* cloud) {
  const double most = reach * cloud->spacing, ring = length / (RINGS - 1);
  Graph graph = {0, 0, NULL, NULL};
  for (uint32_t i = 0; i < cloud->count; ++i) {
    const double* p = cloud->positions + 3 * (size_t)i;
    for (uint32_t j = i + 1; j < cloud->count; ++j) {
      const double* q = cloud->positions + 3 * (size_t)j;
      if (q[1] - p[1] > most + ring) break;
      const double d2 = (p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]) + (p[2] - q[2]) * (p[2] - q[2]);
      if (d2 <= most * most) graph_add(&graph, i, j, exp(-d2 / (2 * cloud->spacing * cloud->spacing)));
    }
  }
  return graph;
}

/* Divides the weights by the densities at both ends. */
static void divide_by_density(const Cloud* cloud, Graph* graph) {
  double* density = need(malloc(sizeof(double) * cloud->count));
  for (uint32_t i = 0; i < cloud->count; ++i) density[i] = 1; /* the point itself */
  for (size_t e = 0; e < graph->edge_count; ++e) {
    for (size_t k = 0; k < 2; ++k) density[graph->edges[2 * e + k]] += graph->weights[e];
  }
  for (size_t e = 0; e < graph->edge_count; ++e)
    graph->weights[e] /= density[graph->edges[2 * e]] * density[graph->edges[2 * e + 1]];
  free(density);
}

/* The field of the cloud: its points near both ends hold the mesh's field. Returns the mean difference between the two
 * fields over the other points, and the largest in *out_largest. */
static double difference(const Cloud* cloud, const Graph* graph, double* field, double* out_largest) {
  uint32_t count = 0, free_count = 0;
  uint32_t* sites = need(malloc(sizeof(uint32_t) * cloud->count));
  double* values = need(malloc(sizeof(double) * cloud->count));
  for (uint32_t i = 0; i < cloud->count; ++i) {
    const double y = cloud->positions[3 * (size_t)i + 1], band = reach * cloud->spacing;
    if (y < band || y > length - band) {
      sites[count] = i;
      values[count++] = cloud->mesh[i];
    }
  }
  graph_field(graph, cloud->count, 0, count, sites, values, field);
  free(sites);
  free(values);
  double sum = 0;
  *out_largest = 0;
  for (uint32_t i = 0; i < cloud->count; ++i) {
    const double apart = fabs(field[i] - cloud->mesh[i]);
    sum += apart;
    free_count += apart > 0;
    *out_largest = fmax(*out_largest, apart);
  }
  return sum / free_count;
}

int points(Dots* out_dots) {
  static const uint32_t counts[3] = {2000, 8000, 32000};
  float* positions = need(malloc(sizeof(float) * 3 * AROUND * RINGS));
  uint32_t* triangles = need(malloc(sizeof(uint32_t) * 6 * AROUND * (RINGS - 1)));
  double* field = need(malloc(sizeof(double) * AROUND * RINGS));
  leg(positions, triangles);
  mesh_field(positions, triangles, field);
  double mean = 0, largest = 0;
  for (int s = 0; s < 3; ++s) {
    Cloud cloud = sample(positions, triangles, field, counts[s]);
    Graph graph = near_graph(&cloud);
    divide_by_density(&cloud, &graph);
    double* values = need(malloc(sizeof(double) * cloud.count));
    mean = difference(&cloud, &graph, values, &largest);
    printf("points %9u: %u edges, %.4f from the field of the mesh in the mean, %.4f at most\n", cloud.count,
           graph.edge_count, mean, largest);
    graph_free(&graph);
    free(cloud.mesh);
    if (s == 2 && out_dots) {
      out_dots->count = cloud.count;
      out_dots->positions = cloud.positions;
      out_dots->values = values;
      continue;
    }
    free(cloud.positions);
    free(values);
  }
  free(positions);
  free(triangles);
  free(field);
  return !(mean <= 0.002 && largest <= 0.02);
}

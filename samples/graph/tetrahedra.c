/* A field inside a box of tetrahedra. The cotangent weight of the edge ij is the sum over its tetrahedra ijkl of
 *
 *     w_ij = |kl| cot(angle between the two faces at the edge kl) / 6,
 *
 * the exact stiffness of linear elements. Weights can be below 0; the matrix stays positive semi-definite. The boundary
 * holds a harmonic polynomial. A linear one must come out exactly, x^2 - y^2 with an error of order h^2 (root of the
 * mean square). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "graph.h"

typedef struct Box {
  uint32_t side; /* cubes along an edge; each is six tetrahedra */
  uint32_t vertex_count;
  double* positions;
} Box;

static void subtract(const double* a, const double* b, double* out) {
  for (int k = 0; k < 3; ++k) out[k] = a[k] - b[k];
}
static double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static void cross(const double* a, const double* b, double* out) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

/* The weight that the tetrahedron ijkl adds to its edge ij. */
static double cotangent_weight(const double* i, const double* j, const double* k, const double* l) {
  double edge[3], to_i[3], to_j[3], normal_i[3], normal_j[3], sine[3];
  subtract(l, k, edge);
  subtract(i, k, to_i);
  subtract(j, k, to_j);
  cross(edge, to_i, normal_i);
  cross(edge, to_j, normal_j);
  cross(normal_i, normal_j, sine);
  return sqrt(dot(edge, edge)) * dot(normal_i, normal_j) / sqrt(dot(sine, sine)) / 6;
}

static int on_boundary(const Box* box, uint32_t v) {
  const uint32_t n = box->side + 1, x = v % n, y = v / n % n, z = v / n / n;
  return x == 0 || y == 0 || z == 0 || x == box->side || y == box->side || z == box->side;
}

/* The unit box. Vertices inside it are moved by up to a fifth of a cube, so that no symmetry helps. */
static Box make_box(uint32_t side) {
  Box box = {side, (side + 1) * (side + 1) * (side + 1), NULL};
  box.positions = need(malloc(sizeof(double) * 3 * box.vertex_count));
  for (uint32_t v = 0; v < box.vertex_count; ++v) {
    const uint32_t n = side + 1, grid[3] = {v % n, v / n % n, v / n / n};
    for (uint32_t k = 0; k < 3; ++k) {
      const double moved = on_boundary(&box, v) ? 0 : 0.4 * noise(3 * v + k);
      box.positions[3 * (size_t)v + k] = (grid[k] + moved) / side;
    }
  }
  return box;
}

static void add_tetrahedron(const Box* box, const uint32_t* corner, Graph* graph) {
  static const int edges[6][4] = {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}};
  const double* p[4];
  for (int k = 0; k < 4; ++k) p[k] = box->positions + 3 * (size_t)corner[k];
  for (int e = 0; e < 6; ++e) {
    const int* at = edges[e];
    graph_add(graph, corner[at[0]], corner[at[1]], cotangent_weight(p[at[0]], p[at[1]], p[at[2]], p[at[3]]));
  }
}

/* Cuts every cube along its diagonal into the six tetrahedra that walk along x, y and z in some order. */
static Graph cotangent_graph(const Box* box) {
  static const int walks[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  const uint32_t n = box->side + 1, step[3] = {1, n, n * n};
  Graph graph = {0, 0, NULL, NULL};
  for (uint32_t v = 0; v < box->vertex_count; ++v) {
    if (v % n == box->side || v / n % n == box->side || v / n / n == box->side) continue;
    for (int w = 0; w < 6; ++w) {
      uint32_t corner[4] = {v, 0, 0, 0};
      for (int k = 0; k < 3; ++k) corner[k + 1] = corner[k] + step[walks[w][k]];
      add_tetrahedron(box, corner, &graph);
    }
  }
  return graph;
}

static double linear(const double* p) { return 1 + 2 * p[0] - 3 * p[1] + 0.5 * p[2]; }
static double saddle(const double* p) { return p[0] * p[0] - p[1] * p[1]; }

/* The error of the field that holds a polynomial on the boundary: the largest, and the root of the mean square inside
 * in *out_mean. out_field: vertex_count values. */
static double error_of(const Box* box, const Graph* graph, double (*exact)(const double*), double* out_field,
                       double* out_mean) {
  uint32_t count = 0;
  uint32_t* sites = need(malloc(sizeof(uint32_t) * box->vertex_count));
  double* values = need(malloc(sizeof(double) * box->vertex_count));
  for (uint32_t v = 0; v < box->vertex_count; ++v) {
    if (on_boundary(box, v)) {
      sites[count] = v;
      values[count++] = exact(box->positions + 3 * (size_t)v);
    }
  }
  graph_field(graph, box->vertex_count, 1, count, sites, values, out_field);
  free(sites);
  free(values);
  double largest = 0, squares = 0;
  for (uint32_t v = 0; v < box->vertex_count; ++v) {
    const double error = out_field[v] - exact(box->positions + 3 * (size_t)v);
    largest = fmax(largest, fabs(error));
    squares += error * error;
  }
  *out_mean = sqrt(squares / (box->vertex_count - count));
  return largest;
}

int tetrahedra(Dots* out_dots) {
  static const uint32_t sides[3] = {5, 10, 20};
  double before = 0, order = 0, mean = 0;
  int failed = 0;
  for (int s = 0; s < 3; ++s) {
    Box box = make_box(sides[s]);
    Graph graph = cotangent_graph(&box);
    double* field = need(malloc(sizeof(double) * box.vertex_count));
    const double exact = error_of(&box, &graph, linear, field, &mean);
    const double error = error_of(&box, &graph, saddle, field, &mean);
    order = before > 0 ? log2(before / mean) : 0;
    before = mean;
    printf("tetrahedra %5u: linear field off by %.1e, x^2 - y^2 by %.1e, %.1e in the mean",
           6 * sides[s] * sides[s] * sides[s], exact, error, mean);
    if (s > 0) printf(", order %.2f", order);
    printf("\n");
    failed |= !(exact <= 1e-12);
    graph_free(&graph);
    if (s == 2 && out_dots) {
      out_dots->count = box.vertex_count;
      out_dots->positions = box.positions;
      out_dots->values = field;
      continue;
    }
    free(box.positions);
    free(field);
  }
  return failed | !(order >= 1.7);
}

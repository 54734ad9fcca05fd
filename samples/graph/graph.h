/* Shared by the two parts of this sample: both make a surface of a graph and solve a field on it. */
#ifndef HF_SAMPLES_GRAPH_H
#define HF_SAMPLES_GRAPH_H

#include <hf/hf.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Edges and weights that grow. The library adds the weights of parallel edges, so edges may come in any order. */
typedef struct Graph {
  uint32_t edge_count, edge_capacity;
  uint32_t* edges; /* [edge_count][2] */
  double* weights; /* [edge_count] */
} Graph;

void graph_add(Graph* graph, uint32_t a, uint32_t b, double weight);
void graph_free(Graph* graph);
/* Makes a surface of a graph, holds `values` at `sites`, and writes the field of all vertices. Ends the program with
 * the library's sentence when a call fails. */
void graph_field(const Graph* graph, uint32_t vertex_count, int allow_negative, uint32_t site_count,
                 const uint32_t* sites, const double* values, double* out_field);

void* need(void* block); /* ends the program when memory ran out */
void ok(hf_result result);
double noise(uint32_t number); /* the same number in -0.5 .. 0.5 for the same input */

/* Positions and a value for each of them, for a picture. The caller frees both arrays. */
typedef struct Dots {
  uint32_t count;
  double* positions; /* [count][3] */
  double* values;    /* [count] */
} Dots;

/* The two parts. Each prints its figures and returns 0 if they are as good as they must be. out_dots: NULL, or receives
 * what to draw. */
int tetrahedra(Dots* out_dots);
int points(Dots* out_dots);

/* Draws dots, coloured from the lowest to the highest value, as PNG. Returns 0, or 1 if the file cannot be written. */
int draw_dots(const char* path, const Dots* dots, double dot_radius);

#ifdef __cplusplus
}
#endif
#endif

/* What the tests of the public ABI share: small surfaces, solvers on them, an allocator that counts and refuses, and
 * the check that a failing call reports what the headers promise. C99, over include/hf only. */
#ifndef HF_API_SUPPORT_H
#define HF_API_SUPPORT_H

/* cmocka.h needs what stands before it */
/* clang-format off */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>
/* clang-format on */

#include "hf/hf.h"
#include "support/arrays.h"
#include "support/peers.h"

#define COUNT_OF(array) (sizeof(array) / sizeof((array)[0]))
#define NO_INDEX HF_NO_INDEX
#define assert_ok(call) assert_code(HF_OK, call)
#define assert_code(expected, call) assert_string_equal(hf_result_get_name(call), hf_result_get_name(expected))

/* A surface owned by the test; freed with surface_free. */
typedef struct Surface {
  uint32_t vertex_count, triangle_count;
  float* positions;
  uint32_t* triangles;
} Surface;

/* A bumpy sheet of columns x rows quads over [0, columns] x [0, rows]. Vertex (i, j) is j * (columns + 1) + i. */
Surface surface_sheet(uint32_t columns, uint32_t rows);
/* An open tube of unit radius along y: `around` vertices on each of `rings` rings, one unit apart. Vertex (i, ring) is
 * ring * around + i. */
Surface surface_tube(uint32_t around, uint32_t rings);
/* Triangles around vertex 0 in a plane; the others are its rim. */
Surface surface_fan(uint32_t triangles);
/* The cut sheet: two sheets of 4 x 4 quads that share a seam of 5 stored copies (component 0), a piece of 2 x 2 quads
 * (component 1), one vertex in no triangle, and one triangle of equal corners. 60 vertices, 73 triangles. */
Surface surface_cut(void);
enum {
  CUT_VERTICES = 60,
  CUT_TRIANGLES = 73,
  CUT_SEAM_LEFT = 4,   /* a seam vertex of the left sheet ... */
  CUT_SEAM_RIGHT = 25, /* ... and its copy in the right one */
  CUT_LEFT = 0,        /* a corner of component 0 */
  CUT_RIGHT = 49,      /* the opposite corner of component 0 */
  CUT_ISLAND = 50,     /* the first of 9 vertices of component 1 */
  CUT_ISOLATED = 59,
  CUT_COLLAPSED = 72 /* the triangle of equal corners */
};
void surface_free(Surface* surface);

/* How a test makes a surface and a solver on it. */
typedef struct Options {
  hf_surface_desc surface;
  hf_solver_desc solver;
  int32_t engine; /* ENGINE_* */
} Options;
Options options_of(const Surface* surface);
/* Makes both, the solver of the surface's kind of field if its own is 0. out_surface: NULL to destroy the surface at
 * once, which the solver outlives. Both are NULL on failure. */
hf_result make(const Options* options, hf_surface* out_surface, hf_solver* out_solver);
/* A surface with the defaults, and a solver on it. */
hf_surface surface_on(const Surface* surface);
hf_solver surface_solver(const Surface* surface);
/* A solver with the defaults on a surface. */
hf_solver solver_on(hf_surface surface);
/* The factor of a surface as bytes, freed by the test. */
unsigned char* saved_bytes(hf_surface surface, int32_t field_kind, size_t* out_size);
/* Adds one hard site to a solver of one channel and returns its number. */
uint32_t add_site(hf_solver solver, uint32_t vertex, double value);
hf_sites_desc sites_at(uint32_t count, const uint32_t* vertices, const double* values);
/* The field of a solver of one channel, in double; freed by the test. */
double* field_of(hf_solver solver, uint32_t vertex_count);
int same_bits(const void* a, const void* b, size_t size);

/* A pose on a tube with a handle of two rings at either end. */
hf_pose tube_pose(hf_surface surface, uint32_t around, uint32_t rings, uint32_t out_handles[2]);
/* The indices of the first and the last two rings of a tube, one list after the other. */
uint32_t* tube_ends(uint32_t around, uint32_t rings);
/* Adds two pairs of a surface with itself: region k has counts[k] vertices, one list after the other. */
void add_own_pairs(hf_transfer transfer, const uint32_t counts[2], const uint32_t* vertices);
/* Adds the ends of a tube as pairs. */
void add_tube_pairs(hf_transfer transfer, uint32_t around, uint32_t rings);

/* An allocator on malloc that counts, and refuses allocation number `refuse_at` (1-based; 0 = never), and all later
 * ones when refuse_on is set. peak_bytes: the most at once since a test set it to 0. Not thread safe. */
typedef struct CountingAllocator {
  size_t live_blocks, live_bytes, peak_bytes, calls, refuse_at;
  int refuse_on, mismatches;
} CountingAllocator;
hf_allocator counting_hooks(CountingAllocator* allocator);
/* hf_surface_statistics::memory_bytes. The host's count has the blocks that are kept for the next call on top. */
double memory_in_use(hf_surface surface);
/* Has the kept blocks given back: they go with any object of the surface that is destroyed. */
void give_kept_back(hf_surface surface);

/* One row of a bad-input table: checks code, index and that the detail names the function and says something on one
 * line. call: the text of the call, whose first word is the function. Failures are printed and counted. */
void check_row(int line, const char* what, const char* call, hf_result got, hf_result expected, uint32_t index);
typedef struct Rows {
  unsigned count, failures;
} Rows;
extern Rows rows;
/* Ends a table: prints the number of rows and fails the test when any of them failed. */
void finish_rows(const char* table);
/* Marks the last row as failed when a condition does not hold. */
void row_holds(int line, const char* what, const char* condition, int holds);

#endif

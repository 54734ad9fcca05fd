/* A field: click the surface, hold the clicked places at values, follow a value that is dragged. */
#include "mesh.h"

int main(int argc, char** argv) {
  Mesh mesh = mesh_load(argc, argv);
  hf_surface surface = mesh_surface(&mesh);
  hf_solver solver;
  ok(hf_create(surface, NULL, &solver)); /* no site yet; the factor is the surface's */

  /* two clicks: rays along -z at the lower and the upper end */
  double low[3], high[3];
  const double down[3] = {0, 0, -1};
  mesh_ends(&mesh, low, high);
  low[2] += 100;
  high[2] += 100;
  low[1] += 0.01;
  high[1] -= 0.01;
  hf_hit first = HF_INIT(hf_hit), second = HF_INIT(hf_hit);
  ok(hf_surface_cast_ray(surface, low, down, NULL, &first));
  ok(hf_surface_cast_ray(surface, high, down, NULL, &second));
  if (!first.found || !second.found) return fprintf(stderr, "a ray missed\n"), 1;

  const double cold = 0, warm = 1;
  uint32_t site;
  ok(hf_solver_add_site(solver, first.vertex, &cold, NULL));
  ok(hf_solver_add_site(solver, second.vertex, &warm, &site));

  /* a third site in the middle of a triangle: soft, so it pulls without being exact */
  hf_sites_desc third = HF_INIT(hf_sites_desc);
  const uint32_t* corners = mesh.triangles + 3 * (size_t)(mesh.triangle_count / 2);
  const hf_place middle = {{corners[0], corners[1], corners[2]}, 0, {1.0 / 3, 1.0 / 3, 1.0 / 3}};
  const double half = 0.5, stiffness = 0.1;
  third.site_count = 1;
  third.places = &middle;
  third.values = &half;
  third.stiffness = &stiffness;
  ok(hf_add_sites(solver, &third, NULL));

  float* field = malloc(sizeof(float) * mesh.vertex_count);
  for (int step = 0; step <= 4; ++step) { /* dragging a value: one sweep a frame, nothing is factorised */
    const double value = 1 + 0.25 * step;
    ok(hf_solver_set_values(solver, 1, &site, &value));
    ok(hf_solve(solver, field, 0, NULL));
    printf("site at %.2f: vertex %u has %.4f\n", value, mesh.vertex_count / 2, (double)field[mesh.vertex_count / 2]);
  }

  /* five lines of equal spacing, as polylines on the surface */
  hf_scalars scalars = HF_INIT(hf_scalars);
  hf_isolines lines = HF_INIT(hf_isolines);
  double levels[5];
  scalars.values = field;
  ok(hf_surface_space_levels(surface, &scalars, HF_LEVELS_LENGTH, 5, levels));
  ok(hf_surface_trace_isolines(surface, &scalars, 5, levels, &lines)); /* NULL arrays: the counts alone */
  printf("%u lines of %u points\n", lines.line_count, lines.point_count);

  free(field);
  mesh_free(&mesh);
  hf_solver_destroy(solver);
  hf_surface_destroy(surface);
  return 0;
}

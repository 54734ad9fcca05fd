#include <hf/hf.h>
#include <stdio.h>

int main(void) {
  const float positions[] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0, 2, 1, 0};
  const uint32_t triangles[] = {0, 2, 1, 1, 2, 3, 2, 4, 3, 3, 4, 5}, ends[] = {0, 1, 4, 5};
  const double values[] = {0, 0, 1, 1};
  float field[6];
  hf_surface surface;
  hf_solver solver;
  hf_surface_desc mesh = HF_INIT(hf_surface_desc);
  mesh.positions = HF_ARRAY(positions, 6);
  mesh.triangles = HF_ARRAY(triangles, 4);
  if (hf_surface_create(&mesh, &surface) != HF_OK || hf_create(surface, NULL, &solver) != HF_OK) return 1;
  for (int i = 0; i < 4; ++i)
    if (hf_solver_add_site(solver, ends[i], &values[i], NULL) != HF_OK) return 1;
  if (hf_solve(solver, field, 0, NULL) != HF_OK) return 1;
  for (int v = 0; v < 6; ++v) printf("%.3f%c", (double)field[v], v < 5 ? ' ' : '\n');
  hf_solver_destroy(solver);
  hf_surface_destroy(surface);
}

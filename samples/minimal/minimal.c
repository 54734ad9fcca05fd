#include <hf/hf.h>
#include <stdio.h>

int main(void) {
  /* a strip of four triangles along x */
  const float positions[] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0, 2, 1, 0};
  const uint32_t triangles[] = {0, 2, 1, 1, 2, 3, 2, 4, 3, 3, 4, 5};
  const uint32_t vertices[] = {0, 1, 4, 5};
  const double values[] = {0, 0, 1, 1};
  float field[6];
  hf_surface surface;
  hf_solver solver;

  hf_surface_desc mesh = HF_INIT(hf_surface_desc);
  mesh.positions = HF_ARRAY(positions, 6);
  mesh.triangles = HF_ARRAY(triangles, 4);
  if (hf_surface_create(&mesh, &surface) != HF_OK) return 1;
  if (hf_create(surface, NULL, &solver) != HF_OK) return 1;

  hf_sites_desc sites = HF_INIT(hf_sites_desc);
  sites.site_count = 4;
  sites.vertices = vertices;
  sites.values = values;
  if (hf_add_sites(solver, &sites, NULL) != HF_OK) return 1;
  if (hf_solve(solver, field, 0, NULL) != HF_OK) return 1;
  for (int v = 0; v < 6; ++v) printf("%.3f\n", (double)field[v]);
  hf_solver_destroy(solver);
  hf_surface_destroy(surface);
  return 0;
}

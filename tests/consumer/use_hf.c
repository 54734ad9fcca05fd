/* What a newcomer's first program does; built by each of the three consumer projects. */
#include <hf/hf.h>
#include <stdio.h>

int main(void) {
  const float positions[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  const uint32_t triangles[] = {0, 1, 2, 0, 2, 3}, vertices[] = {0, 2};
  const double values[] = {0, 1};
  float field[4];
  hf_surface surface;
  hf_solver solver;
  hf_surface_desc mesh = HF_INIT(hf_surface_desc);
  hf_sites_desc sites = HF_INIT(hf_sites_desc);
  mesh.positions = HF_ARRAY(positions, 4);
  mesh.triangles = HF_ARRAY(triangles, 2);
  sites.site_count = 2;
  sites.vertices = vertices;
  sites.values = values;
  if (hf_surface_create(&mesh, &surface) != HF_OK || hf_create(surface, NULL, &solver) != HF_OK ||
      hf_add_sites(solver, &sites, NULL) != HF_OK || hf_solve(solver, field, 0, NULL) != HF_OK)
    return 1;
  printf("hf %u: %.3f %.3f %.3f %.3f\n", hf_version_get(), (double)field[0], (double)field[1], (double)field[2],
         (double)field[3]);
  hf_solver_destroy(solver);
  hf_surface_destroy(surface);
  return field[1] > 0.49f && field[1] < 0.51f ? 0 : 1;
}

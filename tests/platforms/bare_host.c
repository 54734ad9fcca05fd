/* A host without a C library, for a compiler whose headers and libraries are not to be had: MSVC's rules of calls and
 * structs, through clang in MSVC mode. Solves samples/minimal; ends with 0 when the field is right. */
#include "hf/hf.h"

__declspec(dllimport) void __stdcall ExitProcess(unsigned code);
int _fltused = 0; /* the linker asks for it where numbers float */

void start(void) {
  static const float positions[] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0, 2, 1, 0};
  static const uint32_t triangles[] = {0, 2, 1, 1, 2, 3, 2, 4, 3, 3, 4, 5}, vertices[] = {0, 1, 4, 5};
  static const double values[] = {0, 0, 1, 1};
  static hf_surface_desc mesh;
  static hf_sites_desc sites;
  float field[6];
  hf_surface surface;
  hf_solver solver;
  mesh.struct_size = sizeof mesh;
  mesh.positions = HF_ARRAY(positions, 6);
  mesh.triangles = HF_ARRAY(triangles, 4);
  if (hf_surface_create(&mesh, &surface) != HF_OK) ExitProcess(2);
  if (hf_create(surface, NULL, &solver) != HF_OK) ExitProcess(3);
  sites.struct_size = sizeof sites;
  sites.site_count = 4;
  sites.vertices = vertices;
  sites.values = values;
  if (hf_add_sites(solver, &sites, NULL) != HF_OK) ExitProcess(4);
  if (hf_solve(solver, field, 0, NULL) != HF_OK) ExitProcess(5);
  hf_solver_destroy(solver);
  hf_surface_destroy(surface);
  ExitProcess(field[0] == 0 && field[2] == 0.5f && field[5] == 1 ? 0 : 6);
}

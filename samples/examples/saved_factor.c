/* A saved factor: an authoring tool factorises once, the game reads the bytes beside the mesh. */
#include "mesh.h"

int main(int argc, char** argv) {
  Mesh mesh = mesh_load(argc, argv);

  /* in the tool */
  hf_surface made = mesh_surface(&mesh);
  size_t size = 0;
  ok(hf_surface_save(made, HF_FIELD_HARMONIC, NULL, 0, NULL, &size)); /* NULL bytes: the size alone */
  void* bytes = malloc(size);
  ok(hf_surface_save(made, HF_FIELD_HARMONIC, NULL, size, bytes, NULL));
  FILE* file = fopen("factor.hf", "wb");
  if (!file || fwrite(bytes, 1, size, file) != size || fclose(file) != 0) return fprintf(stderr, "cannot write\n"), 1;
  free(bytes);

  /* in the game */
  void* read = malloc(size);
  file = fopen("factor.hf", "rb");
  if (!file || fread(read, 1, size, file) != size) return fprintf(stderr, "cannot read\n"), 1;
  fclose(file);
  hf_factor_desc saved = HF_INIT(hf_factor_desc);
  saved.bytes = read;
  saved.byte_count = size; /* copied; borrow = 1 reads a mapped file in place */
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.positions = HF_ARRAY(mesh.positions, mesh.vertex_count);
  desc.triangles = HF_ARRAY(mesh.triangles, mesh.triangle_count);
  desc.saved_factor = &saved;
  hf_surface loaded;
  ok(hf_surface_create(&desc, &loaded)); /* refuses bytes of another mesh */

  hf_surface_statistics before = HF_INIT(hf_surface_statistics), after = HF_INIT(hf_surface_statistics);
  ok(hf_surface_get_statistics(made, &before));
  ok(hf_surface_get_statistics(loaded, &after));
  printf("%.1f MB; made in %.2f ms, loaded in %.2f ms\n", 1e-6 * (double)size,
         before.ordering_ms + before.symbolic_ms + before.numeric_ms, after.load_ms);

  /* the same field, bit for bit */
  const uint32_t vertices[2] = {0, mesh.vertex_count - 1};
  const double values[2] = {0, 1};
  float* fields[2];
  for (int k = 0; k < 2; ++k) {
    hf_solver solver;
    ok(hf_create(k ? loaded : made, NULL, &solver));
    for (int s = 0; s < 2; ++s) ok(hf_solver_add_site(solver, vertices[s], &values[s], NULL));
    fields[k] = malloc(sizeof(float) * mesh.vertex_count);
    ok(hf_solve(solver, fields[k], 0, NULL));
    hf_solver_destroy(solver);
  }
  const int same = memcmp(fields[0], fields[1], sizeof(float) * mesh.vertex_count) == 0;
  printf("the fields are %s\n", same ? "the same bits" : "different");

  free(fields[0]);
  free(fields[1]);
  free(read);
  mesh_free(&mesh);
  hf_surface_destroy(made);
  hf_surface_destroy(loaded);
  return same ? 0 : 1;
}

/* A region: smooth it, exaggerate it, grow it; carry its detail to another region. */
#include "mesh.h"

/* A region that holds the vertices between two heights, as shares of the whole height. */
static hf_region band(hf_surface surface, const Mesh* mesh, double from, double to) {
  double low[3], high[3];
  uint32_t count = 0, *vertices = malloc(sizeof(uint32_t) * mesh->vertex_count);
  mesh_ends(mesh, low, high);
  for (uint32_t v = 0; v < mesh->vertex_count; ++v) {
    const double height = ((double)mesh->positions[3 * v + 1] - low[1]) / (high[1] - low[1]);
    if (height > from && height < to) vertices[count++] = v;
  }
  hf_region region;
  hf_region_desc desc = HF_INIT(hf_region_desc);
  hf_region_edit_desc edit = HF_INIT(hf_region_edit_desc);
  desc.positions = mesh->positions; /* weight 0 gives these back, bit for bit */
  ok(hf_region_create(surface, &desc, &region));
  edit.add_count = count;
  edit.add_vertices = vertices;
  ok(hf_region_edit(region, &edit));
  free(vertices);
  return region;
}

int main(int argc, char** argv) {
  Mesh mesh = mesh_load(argc, argv);
  hf_surface surface = mesh_surface(&mesh);
  hf_region region = band(surface, &mesh, 0.4, 0.6);
  hf_region_info info = HF_INIT(hf_region_info);
  float* out = malloc(sizeof(float) * 3 * mesh.vertex_count);
  hf_morph_desc morph = HF_INIT(hf_morph_desc);
  morph.positions = out;

  morph.weight = 1; /* the smooth base: a thin plate that leaves its rims smoothly */
  ok(hf_region_morph(region, &morph));
  mesh_save(&mesh, out, "region_smooth.obj");
  morph.weight = -1; /* detail twice as strong */
  ok(hf_region_morph(region, &morph));
  mesh_save(&mesh, out, "region_strong.obj");

  hf_region_edit_desc grow = HF_INIT(hf_region_edit_desc);
  grow.ring_count = 3;
  hf_region before; /* for undo */
  ok(hf_region_clone(region, &before));
  ok(hf_region_edit(region, &grow)); /* sites on the rim come and go; nothing is factorised */
  ok(hf_region_get_info(region, &info));
  hf_region_statistics work = HF_INIT(hf_region_statistics);
  ok(hf_region_get_statistics(region, &work));
  printf("%u vertices, rim of %u, %u factorisations\n", info.vertex_count, info.rim_count, work.factorisation_count);
  hf_region_destroy(region);
  region = before;

  /* a membrane has the least area between its rims and meets them with a crease */
  hf_region_desc desc = HF_INIT(hf_region_desc);
  hf_region membrane;
  desc.base = HF_BASE_MEMBRANE;
  ok(hf_region_create(surface, &desc, &membrane));

  free(out);
  mesh_free(&mesh);
  hf_region_destroy(membrane);
  hf_region_destroy(region);
  hf_surface_destroy(surface);
  return 0;
}

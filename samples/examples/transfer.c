/* Transfer: the motion of one mesh played on another of different shape. */
#include "mesh.h"

/* Bends a mesh about z: what stands at height y turns by amount * y. */
static void bend(const Mesh* mesh, float amount, float* out) {
  for (size_t v = 0; v < mesh->vertex_count; ++v) {
    const float *p = mesh->positions + 3 * v, angle = amount * p[1], c = cosf(angle), s = sinf(angle);
    const float x = amount == 0.0f ? 0.0f : (1 - c) / amount, y = amount == 0.0f ? p[1] : s / amount;
    out[3 * v] = x + c * p[0];
    out[3 * v + 1] = y - s * p[0];
    out[3 * v + 2] = p[2];
  }
}

int main(int argc, char** argv) {
  Mesh source = mesh_leg(), target = mesh_load(argc, argv);
  if (argc < 2) { /* twice as tall, half as thick: lengths differ, joints do not */
    for (size_t v = 0; v < target.vertex_count; ++v) {
      target.positions[3 * v] *= 0.5f;
      target.positions[3 * v + 1] *= 2;
      target.positions[3 * v + 2] *= 0.5f;
    }
  }
  hf_surface from = mesh_surface(&source), to = mesh_surface(&target);
  hf_transfer transfer;
  ok(hf_transfer_create(from, to, NULL, &transfer));

  /* a pair of regions at either end: the vertices within a tenth of the height */
  for (int end = 0; end < 2; ++end) {
    const Mesh* meshes[2] = {&source, &target};
    uint32_t *lists[2], counts[2] = {0, 0}, flags = end == 0 ? HF_PAIR_ANCHOR : 0;
    for (int m = 0; m < 2; ++m) {
      double low[3], high[3];
      mesh_ends(meshes[m], low, high);
      lists[m] = malloc(sizeof(uint32_t) * meshes[m]->vertex_count);
      for (uint32_t v = 0; v < meshes[m]->vertex_count; ++v) {
        const double height = ((double)meshes[m]->positions[3 * v + 1] - low[1]) / (high[1] - low[1]);
        if (end == 0 ? height < 0.1 : height > 0.9) lists[m][counts[m]++] = v;
      }
    }
    hf_pairs_desc pair = HF_INIT(hf_pairs_desc);
    pair.pair_count = 1;
    pair.flags = &flags;
    pair.source_counts = &counts[0];
    pair.source_vertices = lists[0];
    pair.target_counts = &counts[1];
    pair.target_vertices = lists[1];
    ok(hf_transfer_add_pairs(transfer, &pair, NULL)); /* no factorisation on either side */
    free(lists[0]);
    free(lists[1]);
  }

  float* posed = malloc(sizeof(float) * 3 * source.vertex_count);
  float* played = malloc(sizeof(float) * 3 * target.vertex_count);
  hf_transfer_frame frame = HF_INIT(hf_transfer_frame);
  frame.source_positions = HF_ARRAY(posed, source.vertex_count);
  frame.target_positions = HF_ARRAY_OUT(played, target.vertex_count);
  for (int f = 0; f <= 20; ++f) {
    bend(&source, 0.02f * (float)f, posed);
    ok(hf_transfer_apply(transfer, &frame));
  }
  mesh_save(&source, posed, "transfer_source.obj");
  mesh_save(&target, played, "transfer_target.obj");

  free(posed);
  free(played);
  mesh_free(&source);
  mesh_free(&target);
  hf_transfer_destroy(transfer);
  hf_surface_destroy(from);
  hf_surface_destroy(to);
  return 0;
}

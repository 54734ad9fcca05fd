/* live_transfer: frame by frame, as an engine would call it, with a pair of handles added while it runs.
 * A tube of 12 x 40 vertices sways; another, longer and thicker one follows. Prints where its tip is. */
#include <hf/hf.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { AROUND = 12, RINGS = 40, VERTICES = AROUND * RINGS, TRIANGLES = 2 * AROUND * (RINGS - 1) };

static void ok(hf_result result) {
  if (result == HF_OK) return;
  hf_error_detail detail;
  hf_error_get_detail(&detail);
  fprintf(stderr, "live_transfer: %s\n", detail.message);
  exit(1);
}
static void tube(float* p, float length, float radius, float sway) {
  for (int v = 0; v < VERTICES; ++v, p += 3) {
    const float t = (float)(v / AROUND) / (RINGS - 1), a = 6.2831853f * (float)(v % AROUND) / AROUND;
    p[0] = radius * cosf(a) + sway * t * t * length;
    p[1] = t * length;
    p[2] = radius * sinf(a);
  }
}
static hf_surface surface_of(const float* positions) {
  static uint32_t triangles[3 * TRIANGLES];
  uint32_t* t = triangles;
  for (uint32_t r = 0; r + 1 < RINGS; ++r)
    for (uint32_t k = 0; k < AROUND; ++k) {
      const uint32_t a = r * AROUND + k, b = r * AROUND + (k + 1) % AROUND;
      *t++ = a;
      *t++ = a + AROUND;
      *t++ = b;
      *t++ = b;
      *t++ = a + AROUND;
      *t++ = b + AROUND;
    }
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.positions = HF_ARRAY(positions, VERTICES);
  desc.triangles = HF_ARRAY(triangles, TRIANGLES);
  hf_surface surface;
  return ok(hf_surface_create(&desc, &surface)), surface;
}
static void add_ring(hf_transfer transfer, uint32_t ring, uint32_t flags) {
  uint32_t vertices[AROUND];
  const uint32_t count = AROUND;
  for (uint32_t k = 0; k < AROUND; ++k) vertices[k] = ring * AROUND + k;
  hf_pairs_desc pairs = HF_INIT(hf_pairs_desc);
  pairs.pair_count = 1;
  pairs.source_counts = pairs.target_counts = &count;
  pairs.flags = &flags;
  pairs.source_vertices = pairs.target_vertices = vertices; /* the tubes have the same rings */
  ok(hf_transfer_add_pairs(transfer, &pairs, NULL));
}
int main(void) {
  static float rest[3 * VERTICES], posed[3 * VERTICES], shape[3 * VERTICES], out[3 * VERTICES];
  tube(rest, 1, 0.1f, 0);
  tube(shape, 2, 0.3f, 0);
  hf_surface source = surface_of(rest), target = surface_of(shape);
  hf_transfer transfer;
  ok(hf_transfer_create(source, target, NULL, &transfer));
  add_ring(transfer, 0, HF_PAIR_ANCHOR);
  add_ring(transfer, RINGS - 1, 0);
  for (int f = 0; f < 60; ++f) {
    if (f == 30) add_ring(transfer, RINGS / 2, 0); /* no factorisation on either side */
    tube(posed, 1, 0.1f, 0.4f * sinf(0.2f * (float)f));
    hf_transfer_frame frame = HF_INIT(hf_transfer_frame);
    frame.source_positions = HF_ARRAY(posed, VERTICES);
    frame.target_positions = HF_ARRAY_OUT(out, VERTICES);
    ok(hf_transfer_apply(transfer, &frame));
    if (f % 10 == 5)
      printf("frame %2d: the tip of the source is at x %6.3f, that of the target at x %6.3f\n", f,
             (double)(posed[3 * VERTICES - 3] - rest[3 * VERTICES - 3]),
             (double)(out[3 * VERTICES - 3] - shape[3 * VERTICES - 3]));
  }
  return hf_transfer_destroy(transfer), hf_surface_destroy(source), hf_surface_destroy(target), 0;
}

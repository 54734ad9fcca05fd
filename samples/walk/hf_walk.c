/* hf_walk SOURCE.glb TARGET.glb OUT.glb: the first clip of one model played on another, in C with both libraries. */
#include <hf/hf.h>
#include <hf_gltf/gltf.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { FRAMES_A_SECOND = 30, TIPS = 256 };

static void end(const hf_error_detail* detail) {
  fprintf(stderr, "hf_walk: %s: %s\n", detail->function, detail->message);
  exit(1);
}
static void ok(hf_result result) { /* of hf */
  hf_error_detail detail;
  if (result != HF_OK) {
    hf_error_get_detail(&detail);
    end(&detail);
  }
}
static void good(hf_result result) { /* of hf_gltf */
  hf_error_detail detail;
  if (result != HF_OK) {
    hf_gltf_error_get_detail(&detail);
    end(&detail);
  }
}
static void* space(size_t bytes) {
  void* block = malloc(bytes + 1);
  if (!block) exit(2);
  return block;
}

typedef struct Body {
  hf_gltf_model model;
  hf_gltf_model_info info;
  hf_surface surface;
  double* rest;
  uint32_t tips[TIPS], tip_count;
  double diagonal;
} Body;

/* Reads a model, and makes a surface of it: pieces are linked, with the skin as a hint. */
static Body body_of(const char* file) {
  Body body;
  hf_gltf_read_desc read = HF_INIT(hf_gltf_read_desc);
  read.file = file;
  good(hf_gltf_model_read(&read, &body.model));
  body.info = HF_INIT(hf_gltf_model_info);
  good(hf_gltf_model_get_info(body.model, &body.info));
  const size_t vertices = body.info.vertex_count;
  hf_gltf_surface shape = HF_INIT(hf_gltf_surface);
  body.rest = shape.positions = space(sizeof(double) * 3 * vertices);
  shape.triangles = space(sizeof(uint32_t) * 3 * body.info.triangle_count);
  shape.joints = space(sizeof(uint16_t) * 8 * vertices);
  shape.weights = space(sizeof(float) * 8 * vertices);
  good(hf_gltf_model_get_surface(body.model, &shape));

  double low[3] = {1e300, 1e300, 1e300}, high[3] = {-1e300, -1e300, -1e300}, sum = 0;
  for (size_t i = 0; i < 9 * (size_t)body.info.triangle_count; ++i) { /* a vertex without a triangle does not count */
    const double x = body.rest[3 * (size_t)shape.triangles[i / 3] + i % 3];
    if (x < low[i % 3]) low[i % 3] = x;
    if (x > high[i % 3]) high[i % 3] = x;
  }
  for (int c = 0; c < 3; ++c) sum += (high[c] - low[c]) * (high[c] - low[c]);
  body.diagonal = sqrt(sum);
  hf_links_desc links = HF_INIT(hf_links_desc);
  hf_gltf_skeleton skeleton = HF_INIT(hf_gltf_skeleton);
  skeleton.parents = space(sizeof(uint32_t) * body.info.joint_count);
  if (body.info.has_skin) {
    good(hf_gltf_model_get_skeleton(body.model, &skeleton));
    links.joint_count = body.info.joint_count;
    links.joint_parents = skeleton.parents;
    links.influence_count = 8;
    links.joints = shape.joints;
    links.weights = shape.weights;
  }
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.positions = HF_ARRAY(body.rest, body.info.vertex_count);
  desc.triangles = HF_ARRAY(shape.triangles, body.info.triangle_count);
  desc.links = &links;
  desc.weld = HF_WELD_TOLERANCE;
  desc.weld_tolerance = (float)(1e-6 * body.diagonal);
  ok(hf_surface_create(&desc, &body.surface));

  hf_extremity found[TIPS];
  hf_extremities_desc far = HF_INIT(hf_extremities_desc);
  far.kind = HF_EXTREMITIES_GEODESIC;
  ok(hf_surface_find_extremities(body.surface, &far, TIPS, found, &body.tip_count));
  for (uint32_t i = 0; i < body.tip_count; ++i) body.tips[i] = found[i].vertex;
  free(skeleton.parents);
  free(shape.triangles);
  free(shape.joints);
  free(shape.weights);
  return body;
}

static void body_free(Body* body) {
  hf_surface_destroy(body->surface);
  hf_gltf_model_destroy(body->model);
  free(body->rest);
}

/* Takes the proposed pairs into a transfer. */
static hf_transfer transfer_of(const Body* source, const Body* target) {
  hf_gltf_pairs pairs;
  hf_gltf_propose_desc propose = HF_INIT(hf_gltf_propose_desc);
  propose.source_tips = source->tips;
  propose.source_tip_count = source->tip_count;
  propose.target_tips = target->tips;
  propose.target_tip_count = target->tip_count;
  good(hf_gltf_pairs_propose(source->model, target->model, &propose, &pairs));
  hf_gltf_pairs_info info = HF_INIT(hf_gltf_pairs_info);
  good(hf_gltf_pairs_get_info(pairs, &info));
  hf_transfer_desc desc = HF_INIT(hf_transfer_desc);
  for (int i = 0; i < 9; ++i) {
    desc.source_axes[i] = info.source_axes[i];
    desc.target_axes[i] = info.target_axes[i];
  }
  desc.scale = info.scale;
  desc.ground = info.ground;
  hf_transfer transfer;
  ok(hf_transfer_create(source->surface, target->surface, &desc, &transfer));
  for (uint32_t p = 0; p < info.pair_count; ++p) {
    hf_gltf_pair pair = HF_INIT(hf_gltf_pair);
    good(hf_gltf_pairs_get_pair(pairs, p, &pair));
    uint32_t *from = space(sizeof(uint32_t) * pair.source_count), *to = space(sizeof(uint32_t) * pair.target_count);
    good(hf_gltf_pairs_get_regions(pairs, p, pair.source_count, from, pair.target_count, to));
    hf_pairs_desc add = HF_INIT(hf_pairs_desc);
    add.pair_count = 1;
    add.flags = &pair.flags;
    add.source_counts = &pair.source_count;
    add.source_vertices = from;
    add.target_counts = &pair.target_count;
    add.target_vertices = to;
    ok(hf_transfer_add_pairs(transfer, &add, NULL));
    printf("pair %-18s confidence %.2f\n", pair.name, pair.confidence);
    free(from);
    free(to);
  }
  hf_gltf_pairs_destroy(pairs);
  return transfer;
}

int main(int argc, char** argv) {
  if (argc != 4) return fprintf(stderr, "usage: hf_walk SOURCE.glb TARGET.glb OUT.glb\n"), 1;
  Body source = body_of(argv[1]), target = body_of(argv[2]);
  hf_gltf_clip_info clip = HF_INIT(hf_gltf_clip_info);
  good(hf_gltf_model_get_clip(source.model, 0, &clip));
  hf_transfer transfer = transfer_of(&source, &target);

  const size_t frames = (size_t)(clip.duration * FRAMES_A_SECOND) + 2, row = 3 * (size_t)target.info.vertex_count;
  double* times = space(sizeof(double) * frames);
  double *posed = space(sizeof(double) * 3 * source.info.vertex_count), *played = space(sizeof(double) * row * frames);
  for (size_t f = 0; f < frames; ++f) {
    times[f] = clip.duration * (double)f / (double)(frames - 1);
    good(hf_gltf_model_pose(source.model, 0, times[f], posed));
    hf_transfer_frame frame = HF_INIT(hf_transfer_frame);
    frame.source_positions = HF_ARRAY(posed, source.info.vertex_count);
    frame.target_positions = HF_ARRAY_OUT(played + row * f, target.info.vertex_count);
    ok(hf_transfer_apply(transfer, &frame));
  }
  hf_gltf_frames_desc motion = HF_INIT(hf_gltf_frames_desc);
  motion.name = clip.name;
  motion.frame_count = (uint32_t)frames;
  motion.times = times;
  motion.positions = played;
  hf_gltf_fit_info fit = HF_INIT(hf_gltf_fit_info);
  good(hf_gltf_model_add_clip(target.model, &motion, &fit));
  good(hf_gltf_model_get_clip(target.model, 0, &clip));
  const uint32_t all_keys = clip.key_count;
  good(hf_gltf_model_remove_keys(target.model, 0, 5e-4 * target.diagonal, NULL));
  good(hf_gltf_model_get_clip(target.model, 0, &clip));
  printf("clip \"%s\": %zu frames on %u joints, %u of %u keys, %.4f of the box off (root mean square)\n", clip.name,
         frames, fit.joint_count, clip.key_count, all_keys, fit.rms / target.diagonal);

  good(hf_gltf_model_save(target.model, argv[3]));
  free(times);
  free(posed);
  free(played);
  hf_transfer_destroy(transfer);
  body_free(&source);
  body_free(&target);
  return 0;
}

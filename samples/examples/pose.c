/* A pose: two handles by point and radius, one dragged; a third one added in mid-session on a finer layer. */
#include "mesh.h"

int main(int argc, char** argv) {
  Mesh mesh = mesh_load(argc, argv);
  hf_surface surface = mesh_surface(&mesh);
  hf_pose pose;
  ok(hf_pose_create(surface, NULL, &pose));

  double foot[3], knee[3], hip[3];
  uint32_t at_foot, at_knee, at_hip;
  mesh_ends(&mesh, foot, hip);
  const double size = hip[1] - foot[1];
  ok(hf_pose_add_handle_at(pose, foot, 0.15 * size, &at_foot));
  ok(hf_pose_add_handle_at(pose, hip, 0.15 * size, &at_hip));

  float* posed = malloc(sizeof(float) * 3 * mesh.vertex_count);
  const double quarter = 0.70710678118654752;
  hf_transform turned = {{0, 0, 0, 1}, {0, 0, 0}};
  turned.rotation[2] = -quarter;
  turned.rotation[3] = quarter; /* 90 degrees about z */
  turned.translation[0] = 0.5 * size;
  turned.translation[1] = -0.4 * size;
  ok(hf_pose_set_transform(pose, at_hip, &turned));
  hf_deform_info info = HF_INIT(hf_deform_info);
  ok(hf_deform(pose, posed, &info));
  hf_pose_statistics work = HF_INIT(hf_pose_statistics);
  ok(hf_pose_get_statistics(pose, &work));
  printf("%u clusters, solved in %.2f ms, vertices in %.2f ms\n", work.cluster_count, work.solve_ms, work.blend_ms);
  mesh_save(&mesh, posed, "pose.obj");

  /* a finer handle in the middle: nothing moves when it comes, then it bulges */
  for (int k = 0; k < 3; ++k) knee[k] = 0.5 * (foot[k] + hip[k]);
  hf_handles_desc finer = HF_INIT(hf_handles_desc);
  const double radius = 0.05 * size;
  finer.handle_count = 1;
  finer.points = knee;
  finer.radii = &radius;
  finer.layer = 1;
  ok(hf_pose_add_handles(pose, &finer, &at_knee));
  hf_transform pulled = {{0, 0, 0, 1}, {0, 0, 0}};
  pulled.translation[0] = 0.1 * size;
  ok(hf_pose_set_transform(pose, at_knee, &pulled));
  ok(hf_deform(pose, posed, NULL));
  mesh_save(&mesh, posed, "pose_bulged.obj");

  /* taking it away gives the pose before, bit for bit */
  ok(hf_pose_remove_handles(pose, 1, &at_knee));
  ok(hf_deform(pose, posed, NULL));

  free(posed);
  mesh_free(&mesh);
  hf_pose_destroy(pose);
  hf_surface_destroy(surface);
  return 0;
}

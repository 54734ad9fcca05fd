/* Skin export: a posed surface as joints and weights, for an engine that knows linear blend skinning only. */
#include "mesh.h"

/* p -> R (p - pivot) + place, R of a unit quaternion x, y, z, w. */
static void move(const double* q, const double* pivot, const double* place, const float* p, double weight,
                 double* sum) {
  const double v[3] = {(double)p[0] - pivot[0], (double)p[1] - pivot[1], (double)p[2] - pivot[2]};
  const double t[3] = {2 * (q[1] * v[2] - q[2] * v[1]), 2 * (q[2] * v[0] - q[0] * v[2]),
                       2 * (q[0] * v[1] - q[1] * v[0])};
  sum[0] += weight * (v[0] + q[3] * t[0] + q[1] * t[2] - q[2] * t[1] + place[0]);
  sum[1] += weight * (v[1] + q[3] * t[1] + q[2] * t[0] - q[0] * t[2] + place[1]);
  sum[2] += weight * (v[2] + q[3] * t[2] + q[0] * t[1] - q[1] * t[0] + place[2]);
}

int main(int argc, char** argv) {
  Mesh mesh = mesh_load(argc, argv);
  hf_surface surface = mesh_surface(&mesh);
  hf_pose pose;
  double low[3], high[3];
  uint32_t bottom, top;
  ok(hf_pose_create(surface, NULL, &pose));
  mesh_ends(&mesh, low, high);
  const double size = high[1] - low[1];
  ok(hf_pose_add_handle_at(pose, low, 0.15 * size, &bottom));
  ok(hf_pose_add_handle_at(pose, high, 0.15 * size, &top));
  const hf_transform bent = {{0, 0, -0.38268343, 0.92387953}, {0.3 * size, -0.1 * size, 0}};
  float* posed = malloc(sizeof(float) * 3 * mesh.vertex_count);
  ok(hf_pose_set_transform(pose, top, &bent));
  ok(hf_deform(pose, posed, NULL));

  hf_skin_info skin = HF_INIT(hf_skin_info);
  ok(hf_pose_get_skin(pose, &skin)); /* NULL arrays: the counts alone */
  skin.joint_capacity = skin.joint_count;
  skin.vertex_capacity = skin.vertex_count;
  skin.influence_count = 4;
  skin.pivots = malloc(sizeof(double) * 3 * skin.joint_count);
  skin.rotations = malloc(sizeof(double) * 4 * skin.joint_count);
  skin.translations = malloc(sizeof(double) * 3 * skin.joint_count);
  skin.vertex_joints = malloc(sizeof(uint32_t) * 4 * skin.vertex_count);
  skin.vertex_weights = malloc(sizeof(float) * 4 * skin.vertex_count);
  ok(hf_pose_get_skin(pose, &skin));

  double worst = 0; /* replayed as an engine does it, beside the pose itself */
  for (size_t v = 0; v < mesh.vertex_count; ++v) {
    double sum[3] = {0, 0, 0};
    for (size_t k = 4 * v; k < 4 * v + 4; ++k) {
      const size_t j = skin.vertex_joints[k];
      move(skin.rotations + 4 * j, skin.pivots + 3 * j, skin.translations + 3 * j, mesh.positions + 3 * v,
           (double)skin.vertex_weights[k], sum);
    }
    for (size_t c = 0; c < 3; ++c) worst = fmax(worst, fabs(sum[c] - (double)posed[3 * v + c]));
  }
  printf("%u joints; the skin is at most %.2f %% of the height off the pose\n", skin.joint_count, 100 * worst / size);

  free(skin.pivots);
  free(skin.rotations);
  free(skin.translations);
  free(skin.vertex_joints);
  free(skin.vertex_weights);
  free(posed);
  mesh_free(&mesh);
  hf_pose_destroy(pose);
  hf_surface_destroy(surface);
  return worst < 0.05 * size ? 0 : 1;
}

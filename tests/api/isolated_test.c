/* Vertices that no triangle has: they are left over in many files, and change nothing. */
#include "api_support.h"

/* What is found on a tube: tips, proposals, quads of a share of the box, distances, a pose. */
typedef struct Found {
  hf_surface_report report;
  uint32_t tip_count, proposal_count, face_count;
  hf_extremity tips[16];
  hf_handle_proposal proposals[16];
  double *field, *posed;
} Found;

static Found found_on(const Surface* body, uint32_t vertex_count) {
  Found out;
  memset(&out, 0, sizeof out);
  const hf_surface surface = surface_on(body);
  out.report = HF_INIT(hf_surface_report);
  assert_ok(hf_surface_get_report(surface, &out.report));
  hf_extremities_desc tips = HF_INIT(hf_extremities_desc);
  assert_ok(hf_surface_find_extremities(surface, &tips, 16, out.tips, &out.tip_count));
  assert_ok(hf_surface_propose_handles(surface, NULL, 16, out.proposals, &out.proposal_count));
  hf_quads_desc desc = HF_INIT(hf_quads_desc);
  hf_quads quads;
  hf_quads_info info = HF_INIT(hf_quads_info);
  desc.edge_length = 0.05 * out.report.bounding_box_diagonal;
  assert_ok(hf_quads_create(surface, &desc, &quads));
  assert_ok(hf_quads_get_info(quads, &info));
  out.face_count = info.face_count;
  hf_quads_destroy(quads);
  const hf_solver solver = solver_on(surface);
  add_site(solver, 0, 1);
  add_site(solver, 50, 2);
  double* field = field_of(solver, body->vertex_count);
  out.field = calloc(vertex_count, sizeof *out.field);
  memcpy(out.field, field, vertex_count * sizeof *field);
  free(field);
  hf_solver_destroy(solver);
  hf_pose pose;
  assert_ok(hf_pose_create(surface, NULL, &pose));
  for (uint32_t i = 0; i < out.proposal_count; ++i)
    assert_ok(hf_pose_add_handle_at(pose, out.proposals[i].position, out.proposals[i].radius, NULL));
  const hf_transform turn = {{0, 0.3, 0.1, 0.9}, {0.5, 0.2, 0}};
  assert_ok(hf_pose_set_transform(pose, 0, &turn));
  out.posed = calloc(3 * body->vertex_count, sizeof *out.posed);
  hf_deform_desc deform = HF_INIT(hf_deform_desc);
  deform.positions = ROWS_OUT(out.posed);
  deform.refine = 2;
  assert_ok(hf_pose_deform(pose, &deform, NULL));
  hf_pose_destroy(pose);
  hf_surface_destroy(surface);
  return out;
}

/* Far away or near: it stays where it is, and everything else is as without it. */
static void a_vertex_in_no_triangle_changes_no_result(void** state) {
  (void)state;
  Surface tube = surface_tube(12, 20);
  const uint32_t count = tube.vertex_count;
  const Found plain = found_on(&tube, count);
  assert_true(plain.tip_count > 0 && plain.proposal_count > 0 && plain.face_count > 100);
  tube.positions = realloc(tube.positions, 3 * sizeof(float) * (count + 1));
  tube.vertex_count = count + 1;
  const float places[] = {1e5f, 3e30f, 1.01f};
  for (size_t i = 0; i < COUNT_OF(places); ++i) {
    for (int k = 0; k < 3; ++k) tube.positions[3 * count + (uint32_t)k] = places[i];
    const Found found = found_on(&tube, count);
    assert_int_equal(found.report.isolated_vertex_count, 1);
    assert_true(found.report.bounding_box_diagonal == plain.report.bounding_box_diagonal);
    assert_int_equal(found.tip_count, plain.tip_count);
    assert_true(same_bits(found.tips, plain.tips, sizeof found.tips));
    assert_int_equal(found.proposal_count, plain.proposal_count);
    assert_true(same_bits(found.proposals, plain.proposals, sizeof found.proposals));
    assert_int_equal(found.face_count, plain.face_count);
    assert_true(same_bits(found.field, plain.field, count * sizeof *found.field));
    assert_true(same_bits(found.posed, plain.posed, 3 * count * sizeof *found.posed));
    for (int k = 0; k < 3; ++k) assert_true(found.posed[3 * count + (uint32_t)k] == (double)places[i]);
    free(found.field);
    free(found.posed);
  }
  free(plain.field);
  free(plain.posed);
  surface_free(&tube);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_vertex_in_no_triangle_changes_no_result),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

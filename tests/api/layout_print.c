/* Prints size and offsets of every public struct and the value of every constant. CTest compares the output with
 * layout.txt, which was pinned for 64-bit hosts: what stands there must never change, new fields only go to the end. */
#include <stddef.h>
#include <stdio.h>

#include "hf/hf.h"

#define STRUCT(type) printf("%s size %u\n", #type, (unsigned)sizeof(type))
#define FIELD(type, field) \
  printf("  %s at %u, %u bytes\n", #field, (unsigned)offsetof(type, field), (unsigned)sizeof(((type*)0)->field))
#define CONSTANT(name) printf("%s = %ld\n", #name, (long)name)

static void print_error_detail(void) {
  STRUCT(hf_error_detail);
  FIELD(hf_error_detail, code);
  FIELD(hf_error_detail, index);
  FIELD(hf_error_detail, function);
  FIELD(hf_error_detail, message);
}

static void print_allocator(void) {
  STRUCT(hf_allocator);
  FIELD(hf_allocator, allocate);
  FIELD(hf_allocator, release);
  FIELD(hf_allocator, user);
}

static void print_job_runner(void) {
  STRUCT(hf_job_runner);
  FIELD(hf_job_runner, run);
  FIELD(hf_job_runner, user);
}

static void print_create_desc(void) {
  STRUCT(hf_create_desc);
  FIELD(hf_create_desc, struct_size);
  FIELD(hf_create_desc, vertex_count);
  FIELD(hf_create_desc, triangle_count);
  FIELD(hf_create_desc, position_stride);
  FIELD(hf_create_desc, positions);
  FIELD(hf_create_desc, positions_f64);
  FIELD(hf_create_desc, triangles);
  FIELD(hf_create_desc, weld);
  FIELD(hf_create_desc, weld_tolerance);
  FIELD(hf_create_desc, operator_kind);
  FIELD(hf_create_desc, engine);
  FIELD(hf_create_desc, ordering);
  FIELD(hf_create_desc, channel_count);
  FIELD(hf_create_desc, thread_count);
  FIELD(hf_create_desc, site_limit);
  FIELD(hf_create_desc, vertex_limit);
  FIELD(hf_create_desc, memory_limit_mb);
  FIELD(hf_create_desc, penalty);
  FIELD(hf_create_desc, allocator);
  FIELD(hf_create_desc, job_runner);
  FIELD(hf_create_desc, progress);
}

static void print_mesh_report(void) {
  STRUCT(hf_mesh_report);
  FIELD(hf_mesh_report, struct_size);
  FIELD(hf_mesh_report, vertex_count);
  FIELD(hf_mesh_report, triangle_count);
  FIELD(hf_mesh_report, welded_vertex_count);
  FIELD(hf_mesh_report, component_count);
  FIELD(hf_mesh_report, isolated_vertex_count);
  FIELD(hf_mesh_report, degenerate_triangle_count);
  FIELD(hf_mesh_report, collapsed_triangle_count);
  FIELD(hf_mesh_report, duplicate_triangle_count);
  FIELD(hf_mesh_report, non_manifold_edge_count);
  FIELD(hf_mesh_report, flipped_edge_count);
  FIELD(hf_mesh_report, boundary_edge_count);
  FIELD(hf_mesh_report, negative_edge_count);
  FIELD(hf_mesh_report, smallest_angle);
  FIELD(hf_mesh_report, bounding_box_diagonal);
}

static void print_sites_desc(void) {
  STRUCT(hf_sites_desc);
  FIELD(hf_sites_desc, struct_size);
  FIELD(hf_sites_desc, site_count);
  FIELD(hf_sites_desc, vertices);
  FIELD(hf_sites_desc, triangles);
  FIELD(hf_sites_desc, barycentrics);
  FIELD(hf_sites_desc, values);
  FIELD(hf_sites_desc, stiffness);
}

static void print_edit_desc(void) {
  STRUCT(hf_edit_desc);
  FIELD(hf_edit_desc, struct_size);
  FIELD(hf_edit_desc, remove_count);
  FIELD(hf_edit_desc, remove_sites);
  FIELD(hf_edit_desc, move_count);
  FIELD(hf_edit_desc, set_count);
  FIELD(hf_edit_desc, move_sites);
  FIELD(hf_edit_desc, move_to);
  FIELD(hf_edit_desc, set_sites);
  FIELD(hf_edit_desc, set_values);
  FIELD(hf_edit_desc, add);
}

static void print_site_info(void) {
  STRUCT(hf_site_info);
  FIELD(hf_site_info, struct_size);
  FIELD(hf_site_info, capacity);
  FIELD(hf_site_info, sites);
  FIELD(hf_site_info, vertices);
  FIELD(hf_site_info, components);
  FIELD(hf_site_info, values);
  FIELD(hf_site_info, stiffness);
  FIELD(hf_site_info, flux);
}

static void print_solve_info(void) {
  STRUCT(hf_solve_info);
  FIELD(hf_solve_info, struct_size);
  FIELD(hf_solve_info, unreached_component_count);
  FIELD(hf_solve_info, first_unreached_component);
  FIELD(hf_solve_info, unreached_vertex_count);
}

static void print_statistics(void) {
  STRUCT(hf_statistics);
  FIELD(hf_statistics, struct_size);
  FIELD(hf_statistics, unknown_count);
  FIELD(hf_statistics, weld_ms);
  FIELD(hf_statistics, operator_ms);
  FIELD(hf_statistics, ordering_ms);
  FIELD(hf_statistics, symbolic_ms);
  FIELD(hf_statistics, numeric_ms);
  FIELD(hf_statistics, factor_entries);
  FIELD(hf_statistics, factor_bytes);
  FIELD(hf_statistics, factor_flops);
  FIELD(hf_statistics, memory_bytes);
  FIELD(hf_statistics, peak_memory_bytes);
  FIELD(hf_statistics, site_memory_bytes);
  FIELD(hf_statistics, site_count);
  FIELD(hf_statistics, factorisation_count);
  FIELD(hf_statistics, path_solve_count);
  FIELD(hf_statistics, sweep_count);
  FIELD(hf_statistics, engine);
  FIELD(hf_statistics, thread_count);
}

static void print_pose_desc(void) {
  STRUCT(hf_pose_desc);
  FIELD(hf_pose_desc, struct_size);
  FIELD(hf_pose_desc, mode);
  FIELD(hf_pose_desc, band_count);
  FIELD(hf_pose_desc, iteration_count);
  FIELD(hf_pose_desc, samples_per_ring);
  FIELD(hf_pose_desc, group_count);
}

static void print_handles_desc(void) {
  STRUCT(hf_handles_desc);
  FIELD(hf_handles_desc, struct_size);
  FIELD(hf_handles_desc, handle_count);
  FIELD(hf_handles_desc, region_counts);
  FIELD(hf_handles_desc, region_vertices);
}

static void print_transform(void) {
  STRUCT(hf_transform);
  FIELD(hf_transform, rotation);
  FIELD(hf_transform, translation);
}

static void print_handle_info(void) {
  STRUCT(hf_handle_info);
  FIELD(hf_handle_info, struct_size);
  FIELD(hf_handle_info, vertex_count);
  FIELD(hf_handle_info, site_count);
  FIELD(hf_handle_info, component);
  FIELD(hf_handle_info, centroid);
  FIELD(hf_handle_info, leak);
}

static void print_deform_desc(void) {
  STRUCT(hf_deform_desc);
  FIELD(hf_deform_desc, struct_size);
  FIELD(hf_deform_desc, position_stride);
  FIELD(hf_deform_desc, positions);
  FIELD(hf_deform_desc, positions_f64);
  FIELD(hf_deform_desc, normals);
  FIELD(hf_deform_desc, normal_stride);
  FIELD(hf_deform_desc, iteration_count);
  FIELD(hf_deform_desc, restart);
  FIELD(hf_deform_desc, reserved);
}

static void print_deform_info(void) {
  STRUCT(hf_deform_info);
  FIELD(hf_deform_info, struct_size);
  FIELD(hf_deform_info, iteration_count);
  FIELD(hf_deform_info, cluster_count);
  FIELD(hf_deform_info, unreached_vertex_count);
  FIELD(hf_deform_info, last_change);
  FIELD(hf_deform_info, solve_ms);
  FIELD(hf_deform_info, blend_ms);
  FIELD(hf_deform_info, normal_ms);
}

static void print_transfer_desc(void) {
  STRUCT(hf_transfer_desc);
  FIELD(hf_transfer_desc, struct_size);
  FIELD(hf_transfer_desc, mode);
  FIELD(hf_transfer_desc, cluster_count);
  FIELD(hf_transfer_desc, kernel_width);
  FIELD(hf_transfer_desc, scale);
  FIELD(hf_transfer_desc, alignment_angle);
  FIELD(hf_transfer_desc, source_axes);
  FIELD(hf_transfer_desc, target_axes);
}

static void print_pairs_desc(void) {
  STRUCT(hf_pairs_desc);
  FIELD(hf_pairs_desc, struct_size);
  FIELD(hf_pairs_desc, pair_count);
  FIELD(hf_pairs_desc, source_counts);
  FIELD(hf_pairs_desc, source_vertices);
  FIELD(hf_pairs_desc, target_counts);
  FIELD(hf_pairs_desc, target_vertices);
  FIELD(hf_pairs_desc, flags);
}

static void print_pair_info(void) {
  STRUCT(hf_pair_info);
  FIELD(hf_pair_info, struct_size);
  FIELD(hf_pair_info, flags);
  FIELD(hf_pair_info, source_leak);
  FIELD(hf_pair_info, target_leak);
  FIELD(hf_pair_info, alignment_angle);
  FIELD(hf_pair_info, confidence);
  FIELD(hf_pair_info, aligned);
  FIELD(hf_pair_info, reserved);
}

static void print_transfer_frame(void) {
  STRUCT(hf_transfer_frame);
  FIELD(hf_transfer_frame, struct_size);
  FIELD(hf_transfer_frame, source_stride);
  FIELD(hf_transfer_frame, source_positions);
  FIELD(hf_transfer_frame, source_positions_f64);
  FIELD(hf_transfer_frame, target_stride);
  FIELD(hf_transfer_frame, normal_stride);
  FIELD(hf_transfer_frame, target_positions);
  FIELD(hf_transfer_frame, target_positions_f64);
  FIELD(hf_transfer_frame, target_normals);
}

static void print_skin_info(void) {
  STRUCT(hf_skin_info);
  FIELD(hf_skin_info, struct_size);
  FIELD(hf_skin_info, joint_count);
  FIELD(hf_skin_info, weight_count);
  FIELD(hf_skin_info, reserved);
  FIELD(hf_skin_info, pivots);
  FIELD(hf_skin_info, rotations);
  FIELD(hf_skin_info, translations);
  FIELD(hf_skin_info, vertex_joints);
  FIELD(hf_skin_info, vertex_weights);
}

static void print_constants(void) {
  CONSTANT(HF_OK);
  CONSTANT(HF_ERROR_INVALID_ARGUMENT);
  CONSTANT(HF_ERROR_NULL_POINTER);
  CONSTANT(HF_ERROR_INVALID_HANDLE);
  CONSTANT(HF_ERROR_INVALID_DESC);
  CONSTANT(HF_ERROR_OUT_OF_RANGE);
  CONSTANT(HF_ERROR_NON_FINITE);
  CONSTANT(HF_ERROR_EMPTY);
  CONSTANT(HF_ERROR_DUPLICATE_SITE);
  CONSTANT(HF_ERROR_NO_SUCH_SITE);
  CONSTANT(HF_ERROR_CONFLICT);
  CONSTANT(HF_ERROR_NO_SITES);
  CONSTANT(HF_ERROR_NO_SUCH_HANDLE);
  CONSTANT(HF_ERROR_NO_SUCH_PAIR);
  CONSTANT(HF_ERROR_OVERLAP);
  CONSTANT(HF_ERROR_UNSUPPORTED);
  CONSTANT(HF_ERROR_BUSY);
  CONSTANT(HF_ERROR_REENTRANT);
  CONSTANT(HF_ERROR_TOO_SMALL);
  CONSTANT(HF_ERROR_NO_RECORD);
  CONSTANT(HF_ERROR_OUT_OF_MEMORY);
  CONSTANT(HF_ERROR_TOO_LARGE);
  CONSTANT(HF_ERROR_CANCELLED);
  CONSTANT(HF_ERROR_NOT_POSITIVE_DEFINITE);
  CONSTANT(HF_ERROR_INACCURATE);
  CONSTANT(HF_ERROR_INTERNAL);
  CONSTANT(HF_WELD_EXACT);
  CONSTANT(HF_WELD_NONE);
  CONSTANT(HF_WELD_TOLERANCE);
  CONSTANT(HF_OPERATOR_COTANGENT);
  CONSTANT(HF_OPERATOR_CLAMPED);
  CONSTANT(HF_OPERATOR_UNIFORM);
  CONSTANT(HF_ENGINE_GREEN);
  CONSTANT(HF_ENGINE_UPDOWN);
  CONSTANT(HF_ENGINE_REFACTOR);
  CONSTANT(HF_ORDERING_NESTED_DISSECTION);
  CONSTANT(HF_ORDERING_MINIMUM_DEGREE);
  CONSTANT(HF_ORDERING_METIS);
  CONSTANT(HF_DEFORM_SMOOTH);
  CONSTANT(HF_DEFORM_PAPER);
  CONSTANT(HF_TRANSFER_FIELDS);
  CONSTANT(HF_TRANSFER_PAPER);
  CONSTANT(HF_PAIR_ANCHOR);
  CONSTANT(HF_PAIR_FOOT);
  CONSTANT(HF_PAIR_TRUNK);
  CONSTANT(HF_PAIR_NO_ALIGNMENT);
  CONSTANT(HF_NO_INDEX);
  CONSTANT(HF_MESSAGE_SIZE);
}

int main(void) {
  print_error_detail();
  print_allocator();
  print_job_runner();
  print_create_desc();
  print_mesh_report();
  print_sites_desc();
  print_edit_desc();
  print_site_info();
  print_solve_info();
  print_statistics();
  print_pose_desc();
  print_handles_desc();
  print_transform();
  print_handle_info();
  print_deform_desc();
  print_deform_info();
  print_transfer_desc();
  print_pairs_desc();
  print_pair_info();
  print_transfer_frame();
  print_skin_info();
  print_constants();
  return 0;
}

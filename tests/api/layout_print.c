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
  FIELD(hf_create_desc, saved_factor);
  FIELD(hf_create_desc, field_kind);
  FIELD(hf_create_desc, triangle_limit);
}

static void print_preview_info(void) {
  STRUCT(hf_preview_info);
  FIELD(hf_preview_info, struct_size);
  FIELD(hf_preview_info, exact);
  FIELD(hf_preview_info, correction_count);
  FIELD(hf_preview_info, unreached_component_count);
  FIELD(hf_preview_info, value_range);
  FIELD(hf_preview_info, largest_correction);
  FIELD(hf_preview_info, error_estimate);
  FIELD(hf_preview_info, preview_bytes);
}

static void print_factor_desc(void) {
  STRUCT(hf_factor_desc);
  FIELD(hf_factor_desc, struct_size);
  FIELD(hf_factor_desc, borrow);
  FIELD(hf_factor_desc, bytes);
  FIELD(hf_factor_desc, byte_count);
}

static void print_mesh_report(void) {
  STRUCT(hf_surface_report);
  FIELD(hf_surface_report, struct_size);
  FIELD(hf_surface_report, vertex_count);
  FIELD(hf_surface_report, triangle_count);
  FIELD(hf_surface_report, welded_vertex_count);
  FIELD(hf_surface_report, component_count);
  FIELD(hf_surface_report, isolated_vertex_count);
  FIELD(hf_surface_report, degenerate_triangle_count);
  FIELD(hf_surface_report, collapsed_triangle_count);
  FIELD(hf_surface_report, duplicate_triangle_count);
  FIELD(hf_surface_report, non_manifold_edge_count);
  FIELD(hf_surface_report, flipped_edge_count);
  FIELD(hf_surface_report, boundary_edge_count);
  FIELD(hf_surface_report, negative_edge_count);
  FIELD(hf_surface_report, smallest_angle);
  FIELD(hf_surface_report, bounding_box_diagonal);
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
  FIELD(hf_sites_desc, radii);
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
  STRUCT(hf_sites_info);
  FIELD(hf_sites_info, struct_size);
  FIELD(hf_sites_info, capacity);
  FIELD(hf_sites_info, sites);
  FIELD(hf_sites_info, vertices);
  FIELD(hf_sites_info, components);
  FIELD(hf_sites_info, values);
  FIELD(hf_sites_info, stiffness);
  FIELD(hf_sites_info, flux);
  FIELD(hf_sites_info, radii);
}

static void print_solve_info(void) {
  STRUCT(hf_solve_info);
  FIELD(hf_solve_info, struct_size);
  FIELD(hf_solve_info, unreached_component_count);
  FIELD(hf_solve_info, first_unreached_component);
  FIELD(hf_solve_info, unreached_vertex_count);
}

static void print_certificate(void) {
  STRUCT(hf_certificate);
  FIELD(hf_certificate, struct_size);
  FIELD(hf_certificate, overshoot_checked);
  FIELD(hf_certificate, tolerance);
  FIELD(hf_certificate, value_range);
  FIELD(hf_certificate, residual);
  FIELD(hf_certificate, site_error);
  FIELD(hf_certificate, overshoot);
  FIELD(hf_certificate, worst_vertex);
  FIELD(hf_certificate, reserved);
}

static void print_statistics(void) {
  STRUCT(hf_solver_statistics);
  FIELD(hf_solver_statistics, struct_size);
  FIELD(hf_solver_statistics, unknown_count);
  FIELD(hf_solver_statistics, weld_ms);
  FIELD(hf_solver_statistics, operator_ms);
  FIELD(hf_solver_statistics, ordering_ms);
  FIELD(hf_solver_statistics, symbolic_ms);
  FIELD(hf_solver_statistics, numeric_ms);
  FIELD(hf_solver_statistics, factor_entries);
  FIELD(hf_solver_statistics, factor_bytes);
  FIELD(hf_solver_statistics, factor_flops);
  FIELD(hf_solver_statistics, memory_bytes);
  FIELD(hf_solver_statistics, peak_memory_bytes);
  FIELD(hf_solver_statistics, site_memory_bytes);
  FIELD(hf_solver_statistics, site_count);
  FIELD(hf_solver_statistics, factorisation_count);
  FIELD(hf_solver_statistics, path_solve_count);
  FIELD(hf_solver_statistics, sweep_count);
  FIELD(hf_solver_statistics, engine);
  FIELD(hf_solver_statistics, thread_count);
  FIELD(hf_solver_statistics, load_ms);
  FIELD(hf_solver_statistics, factor_loaded);
  FIELD(hf_solver_statistics, factor_borrowed);
  FIELD(hf_solver_statistics, last_route);
  FIELD(hf_solver_statistics, rebase_count);
  FIELD(hf_solver_statistics, dense_edit_count);
  FIELD(hf_solver_statistics, dense_row_count);
  FIELD(hf_solver_statistics, eliminated_count);
  FIELD(hf_solver_statistics, rebase_advised);
  FIELD(hf_solver_statistics, predicted_dense_ms);
  FIELD(hf_solver_statistics, predicted_rebase_ms);
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
  FIELD(hf_handles_desc, points);
  FIELD(hf_handles_desc, radii);
  FIELD(hf_handles_desc, layer);
  FIELD(hf_handles_desc, reserved);
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
  FIELD(hf_handle_info, rotation);
  FIELD(hf_handle_info, translation);
  FIELD(hf_handle_info, layer);
  FIELD(hf_handle_info, reserved);
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
  FIELD(hf_deform_desc, refine);
  FIELD(hf_deform_desc, first_vertex);
  FIELD(hf_deform_desc, vertex_count);
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
  FIELD(hf_deform_info, refine_ms);
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
  FIELD(hf_pair_info, crossed);
  STRUCT(hf_transfer_info);
  FIELD(hf_transfer_info, struct_size);
  FIELD(hf_transfer_info, pair_count);
  FIELD(hf_transfer_info, cluster_count);
  FIELD(hf_transfer_info, aligned_count);
  FIELD(hf_transfer_info, crossed_count);
  FIELD(hf_transfer_info, scale_found);
  FIELD(hf_transfer_info, scale);
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
  FIELD(hf_transfer_frame, hold_count);
  FIELD(hf_transfer_frame, reserved);
  FIELD(hf_transfer_frame, hold_pairs);
  FIELD(hf_transfer_frame, hold_positions);
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
  FIELD(hf_skin_info, axes);
  FIELD(hf_skin_info, scales);
}

static void print_scalars(void) {
  STRUCT(hf_scalars);
  FIELD(hf_scalars, struct_size);
  FIELD(hf_scalars, value_stride);
  FIELD(hf_scalars, values);
  FIELD(hf_scalars, values_f64);
}

static void print_isolines(void) {
  STRUCT(hf_isolines);
  FIELD(hf_isolines, struct_size);
  FIELD(hf_isolines, point_capacity);
  FIELD(hf_isolines, line_capacity);
  FIELD(hf_isolines, point_count);
  FIELD(hf_isolines, line_count);
  FIELD(hf_isolines, reserved);
  FIELD(hf_isolines, point_edges);
  FIELD(hf_isolines, parameters);
  FIELD(hf_isolines, positions);
  FIELD(hf_isolines, line_starts);
  FIELD(hf_isolines, line_levels);
  FIELD(hf_isolines, line_closed);
}

static void print_critical_point(void) {
  STRUCT(hf_critical_point);
  FIELD(hf_critical_point, vertex);
  FIELD(hf_critical_point, kind);
  FIELD(hf_critical_point, index);
  FIELD(hf_critical_point, component);
  FIELD(hf_critical_point, value);
}

static void print_critical_info(void) {
  STRUCT(hf_critical_info);
  FIELD(hf_critical_info, struct_size);
  FIELD(hf_critical_info, point_count);
  FIELD(hf_critical_info, minimum_count);
  FIELD(hf_critical_info, maximum_count);
  FIELD(hf_critical_info, saddle_count);
  FIELD(hf_critical_info, index_sum);
  FIELD(hf_critical_info, euler_characteristic);
  FIELD(hf_critical_info, reserved);
}

static void print_geodesics_desc(void) {
  STRUCT(hf_geodesics_desc);
  FIELD(hf_geodesics_desc, struct_size);
  FIELD(hf_geodesics_desc, smoothing);
}

static void print_extremities_desc(void) {
  STRUCT(hf_extremities_desc);
  FIELD(hf_extremities_desc, struct_size);
  FIELD(hf_extremities_desc, kind);
  FIELD(hf_extremities_desc, least_length);
  FIELD(hf_extremities_desc, source_count);
  FIELD(hf_extremities_desc, geodesics);
  FIELD(hf_extremities_desc, progress);
  FIELD(hf_extremities_desc, out_field);
}

static void print_extremity(void) {
  STRUCT(hf_extremity);
  FIELD(hf_extremity, vertex);
  FIELD(hf_extremity, component);
  FIELD(hf_extremity, length);
  FIELD(hf_extremity, position);
}

static void print_direction_desc(void) {
  STRUCT(hf_direction_desc);
  FIELD(hf_direction_desc, struct_size);
  FIELD(hf_direction_desc, degree);
  FIELD(hf_direction_desc, site_limit);
  FIELD(hf_direction_desc, reserved);
}

static void print_singularity(void) {
  STRUCT(hf_singularity);
  FIELD(hf_singularity, triangle);
  FIELD(hf_singularity, vertex);
  FIELD(hf_singularity, index);
}

static void print_direction_statistics(void) {
  STRUCT(hf_direction_statistics);
  FIELD(hf_direction_statistics, struct_size);
  FIELD(hf_direction_statistics, unknown_count);
  FIELD(hf_direction_statistics, site_count);
  FIELD(hf_direction_statistics, factorisation_count);
  FIELD(hf_direction_statistics, path_solve_count);
  FIELD(hf_direction_statistics, sweep_count);
  FIELD(hf_direction_statistics, irregular_vertex_count);
  FIELD(hf_direction_statistics, sites_eliminated);
  FIELD(hf_direction_statistics, operator_ms);
  FIELD(hf_direction_statistics, numeric_ms);
  FIELD(hf_direction_statistics, factor_entries);
  FIELD(hf_direction_statistics, factor_bytes);
  FIELD(hf_direction_statistics, site_memory_bytes);
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
  CONSTANT(HF_OPERATOR_INTRINSIC_DELAUNAY);
  CONSTANT(HF_OPERATOR_CLAMPED);
  CONSTANT(HF_OPERATOR_UNIFORM);
  CONSTANT(HF_OPERATOR_COTANGENT);
  CONSTANT(HF_FIELD_HARMONIC);
  CONSTANT(HF_FIELD_BIHARMONIC);
  CONSTANT(HF_FIELD_BIHARMONIC_GRAPH);
  CONSTANT(HF_ENGINE_GREEN);
  CONSTANT(HF_ENGINE_UPDOWN);
  CONSTANT(HF_ENGINE_REFACTOR);
  CONSTANT(HF_ORDERING_NESTED_DISSECTION);
  CONSTANT(HF_ORDERING_MINIMUM_DEGREE);
  CONSTANT(HF_ORDERING_METIS);
  CONSTANT(HF_FACTOR_ALIGNMENT);
  CONSTANT(HF_DEFORM_SMOOTH);
  CONSTANT(HF_DEFORM_PAPER);
  CONSTANT(HF_LAYER_COUNT);
  CONSTANT(HF_TRANSFER_FIELDS);
  CONSTANT(HF_TRANSFER_PAPER);
  CONSTANT(HF_PAIR_ANCHOR);
  CONSTANT(HF_PAIR_FOOT);
  CONSTANT(HF_PAIR_TRUNK);
  CONSTANT(HF_PAIR_NO_ALIGNMENT);
  CONSTANT(HF_LEVELS_VALUE);
  CONSTANT(HF_LEVELS_AREA);
  CONSTANT(HF_LEVELS_LENGTH);
  CONSTANT(HF_CRITICAL_MINIMUM);
  CONSTANT(HF_CRITICAL_MAXIMUM);
  CONSTANT(HF_CRITICAL_SADDLE);
  CONSTANT(HF_EXTREMITIES_POISSON);
  CONSTANT(HF_EXTREMITIES_GEODESIC);
  CONSTANT(HF_QUADS_UNIFORM);
  CONSTANT(HF_QUADS_PURE);
  CONSTANT(HF_SIDE_SMALLER);
  CONSTANT(HF_SIDE_LARGER);
  CONSTANT(HF_SIDE_SEED);
  CONSTANT(HF_REGION_INSIDE);
  CONSTANT(HF_REGION_RIM);
  CONSTANT(HF_REGION_SITES);
  CONSTANT(HF_NO_INDEX);
  CONSTANT(HF_MESSAGE_SIZE);
}

static void print_quads_desc(void) {
  STRUCT(hf_quads_desc);
  FIELD(hf_quads_desc, struct_size);
  FIELD(hf_quads_desc, kind);
  FIELD(hf_quads_desc, edge_length);
  FIELD(hf_quads_desc, site_count);
  FIELD(hf_quads_desc, site_vertices);
  FIELD(hf_quads_desc, site_lines);
  FIELD(hf_quads_desc, keep_polygons);
  FIELD(hf_quads_desc, relax_count);
  FIELD(hf_quads_desc, progress);
}

static void print_quads_info(void) {
  STRUCT(hf_quads_info);
  FIELD(hf_quads_info, struct_size);
  FIELD(hf_quads_info, vertex_count);
  FIELD(hf_quads_info, face_count);
  FIELD(hf_quads_info, corner_count);
  FIELD(hf_quads_info, quad_count);
  FIELD(hf_quads_info, polygon_count);
  FIELD(hf_quads_info, polygon_quad_count);
  FIELD(hf_quads_info, site_count);
  FIELD(hf_quads_info, saddle_count);
  FIELD(hf_quads_info, euler_characteristic);
  FIELD(hf_quads_info, edge_length);
  FIELD(hf_quads_info, reserved);
}

static void print_quads_mesh(void) {
  STRUCT(hf_quads_mesh);
  FIELD(hf_quads_mesh, struct_size);
  FIELD(hf_quads_mesh, vertex_capacity);
  FIELD(hf_quads_mesh, face_capacity);
  FIELD(hf_quads_mesh, corner_capacity);
  FIELD(hf_quads_mesh, site_capacity);
  FIELD(hf_quads_mesh, reserved);
  FIELD(hf_quads_mesh, positions);
  FIELD(hf_quads_mesh, triangles);
  FIELD(hf_quads_mesh, barycentrics);
  FIELD(hf_quads_mesh, face_starts);
  FIELD(hf_quads_mesh, face_corners);
  FIELD(hf_quads_mesh, site_vertices);
  FIELD(hf_quads_mesh, site_lines);
}

static void print_flow_lines(void) {
  STRUCT(hf_flow_lines);
  FIELD(hf_flow_lines, struct_size);
  FIELD(hf_flow_lines, wanted_count);
  FIELD(hf_flow_lines, seed_count);
  FIELD(hf_flow_lines, point_capacity);
  FIELD(hf_flow_lines, line_capacity);
  FIELD(hf_flow_lines, point_count);
  FIELD(hf_flow_lines, line_count);
  FIELD(hf_flow_lines, reserved);
  FIELD(hf_flow_lines, seeds);
  FIELD(hf_flow_lines, positions);
  FIELD(hf_flow_lines, values);
  FIELD(hf_flow_lines, line_starts);
  FIELD(hf_flow_lines, line_ends);
}

static void print_region_desc(void) {
  STRUCT(hf_region_desc);
  FIELD(hf_region_desc, struct_size);
  FIELD(hf_region_desc, position_stride);
  FIELD(hf_region_desc, positions);
  FIELD(hf_region_desc, positions_f64);
}

static void print_curve_desc(void) {
  STRUCT(hf_curve_desc);
  FIELD(hf_curve_desc, struct_size);
  FIELD(hf_curve_desc, point_count);
  FIELD(hf_curve_desc, vertices);
  FIELD(hf_curve_desc, triangles);
  FIELD(hf_curve_desc, barycentrics);
  FIELD(hf_curve_desc, side);
  FIELD(hf_curve_desc, seed_vertex);
}

static void print_region_edit_desc(void) {
  STRUCT(hf_region_edit_desc);
  FIELD(hf_region_edit_desc, struct_size);
  FIELD(hf_region_edit_desc, ring_count);
  FIELD(hf_region_edit_desc, curve);
  FIELD(hf_region_edit_desc, remove_count);
  FIELD(hf_region_edit_desc, add_count);
  FIELD(hf_region_edit_desc, remove_vertices);
  FIELD(hf_region_edit_desc, add_vertices);
  FIELD(hf_region_edit_desc, progress);
}

static void print_region_info(void) {
  STRUCT(hf_region_info);
  FIELD(hf_region_info, struct_size);
  FIELD(hf_region_info, thin_plate);
  FIELD(hf_region_info, vertex_count);
  FIELD(hf_region_info, rim_count);
  FIELD(hf_region_info, site_count);
  FIELD(hf_region_info, inserted_count);
  FIELD(hf_region_info, removed_count);
  FIELD(hf_region_info, kept_count);
  FIELD(hf_region_info, factorisation_count);
  FIELD(hf_region_info, path_solve_count);
  FIELD(hf_region_info, last_route);
  FIELD(hf_region_info, whole_sweep);
  FIELD(hf_region_info, area);
  FIELD(hf_region_info, base_area);
}

static void print_morph_desc(void) {
  STRUCT(hf_morph_desc);
  FIELD(hf_morph_desc, struct_size);
  FIELD(hf_morph_desc, position_stride);
  FIELD(hf_morph_desc, weight);
  FIELD(hf_morph_desc, positions);
  FIELD(hf_morph_desc, positions_f64);
  FIELD(hf_morph_desc, normals);
  FIELD(hf_morph_desc, normal_stride);
  FIELD(hf_morph_desc, reserved);
}

static void print_detail_desc(void) {
  STRUCT(hf_detail_desc);
  FIELD(hf_detail_desc, struct_size);
  FIELD(hf_detail_desc, pair_count);
  FIELD(hf_detail_desc, source_vertices);
  FIELD(hf_detail_desc, target_vertices);
  FIELD(hf_detail_desc, scale);
  FIELD(hf_detail_desc, progress);
}

int main(void) {
  print_error_detail();
  print_allocator();
  print_job_runner();
  print_create_desc();
  print_factor_desc();
  print_preview_info();
  print_mesh_report();
  print_sites_desc();
  print_edit_desc();
  print_site_info();
  print_solve_info();
  print_certificate();
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
  print_scalars();
  print_isolines();
  print_critical_point();
  print_critical_info();
  print_geodesics_desc();
  print_extremities_desc();
  print_extremity();
  print_direction_desc();
  print_singularity();
  print_direction_statistics();
  print_quads_desc();
  print_quads_info();
  print_quads_mesh();
  print_flow_lines();
  print_region_desc();
  print_curve_desc();
  print_region_edit_desc();
  print_region_info();
  print_morph_desc();
  print_detail_desc();
  print_constants();
  return 0;
}

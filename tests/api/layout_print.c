/* Prints size and offsets of every public struct and the value of every constant. CTest compares the output with
 * layout.txt, which was pinned for 64-bit hosts: what stands there must never change after a release, new fields only
 * go to the end. check_layout.sh sees that no struct and no constant of the headers is missing here. */
#include <stddef.h>
#include <stdio.h>

#include "hf/hf.h"

#define STRUCT(type) printf("%s size %u\n", #type, (unsigned)sizeof(type))
#define FIELD(type, field) \
  printf("  %s at %u, %u bytes\n", #field, (unsigned)offsetof(type, field), (unsigned)sizeof(((type*)0)->field))
#define CONSTANT(name) printf("%s = %lld\n", #name, (long long)name)
#define F(field) FIELD(T, field)

static void print_base(void) {
#define T hf_error_detail
  STRUCT(hf_error_detail);
  F(code), F(index), F(function), F(message);
#undef T
#define T hf_allocator
  STRUCT(hf_allocator);
  F(allocate), F(release), F(user);
#undef T
#define T hf_job_runner
  STRUCT(hf_job_runner);
  F(run), F(user);
#undef T
  CONSTANT(HF_OK), CONSTANT(HF_ERROR_INVALID_ARGUMENT), CONSTANT(HF_ERROR_NULL_POINTER),
      CONSTANT(HF_ERROR_INVALID_HANDLE), CONSTANT(HF_ERROR_INVALID_DESC), CONSTANT(HF_ERROR_OUT_OF_RANGE),
      CONSTANT(HF_ERROR_NON_FINITE), CONSTANT(HF_ERROR_EMPTY), CONSTANT(HF_ERROR_DUPLICATE_SITE),
      CONSTANT(HF_ERROR_NO_SUCH_SITE), CONSTANT(HF_ERROR_CONFLICT), CONSTANT(HF_ERROR_NO_SITES),
      CONSTANT(HF_ERROR_NO_SUCH_HANDLE), CONSTANT(HF_ERROR_NO_SUCH_PAIR), CONSTANT(HF_ERROR_OVERLAP),
      CONSTANT(HF_ERROR_UNSUPPORTED), CONSTANT(HF_ERROR_BUSY), CONSTANT(HF_ERROR_REENTRANT),
      CONSTANT(HF_ERROR_TOO_SMALL), CONSTANT(HF_ERROR_NO_RECORD), CONSTANT(HF_ERROR_OUT_OF_MEMORY),
      CONSTANT(HF_ERROR_TOO_LARGE), CONSTANT(HF_ERROR_CANCELLED), CONSTANT(HF_ERROR_NOT_POSITIVE_DEFINITE),
      CONSTANT(HF_ERROR_INACCURATE), CONSTANT(HF_ERROR_INTERNAL), CONSTANT(HF_VERSION_MAJOR),
      CONSTANT(HF_VERSION_MINOR), CONSTANT(HF_VERSION_PATCH), CONSTANT(HF_NO_INDEX), CONSTANT(HF_MESSAGE_SIZE);
}

static void print_surface(void) {
#define T hf_factor_desc
  STRUCT(hf_factor_desc);
  F(struct_size), F(borrow), F(bytes), F(byte_count);
#undef T
#define T hf_surface_desc
  STRUCT(hf_surface_desc);
  F(struct_size), F(vertex_count), F(triangle_count), F(position_stride), F(positions), F(positions_f64), F(triangles),
      F(triangles_u16), F(triangle_stride), F(weld), F(weld_tolerance), F(operator_kind), F(field_kind), F(ordering),
      F(thread_count), F(vertex_limit), F(triangle_limit), F(memory_limit_mb), F(work_limit_gflop), F(reserved),
      F(allocator), F(job_runner), F(progress), F(saved_factor), F(links), F(face_count), F(corner_count),
      F(face_starts), F(face_sizes), F(corners), F(face_stride), F(corner_stride);
#undef T
#define T hf_link
  STRUCT(hf_link);
  F(vertex), F(corners), F(barycentrics), F(length), F(weight), F(in_tree);
#undef T
#define T hf_links_desc
  STRUCT(hf_links_desc);
  F(struct_size), F(mode), F(distance), F(stiffness), F(overlay_distance), F(influence_count), F(joints), F(weights),
      F(tags), F(link_count), F(light_count), F(heavy_count), F(reserved), F(links), F(light_vertices),
      F(heavy_vertices);
#undef T
#define T hf_gaps_desc
  STRUCT(hf_gaps_desc);
  F(struct_size), F(position_stride), F(positions), F(positions_f64);
#undef T
#define T hf_gaps_info
  STRUCT(hf_gaps_info);
  F(struct_size), F(link_count), F(percentile_95), F(worst), F(worst_link), F(reserved);
#undef T
#define T hf_surface_info
  STRUCT(hf_surface_info);
  F(struct_size), F(vertex_count), F(triangle_count), F(weld), F(weld_tolerance), F(operator_kind), F(field_kind),
      F(ordering), F(thread_count), F(vertex_limit), F(triangle_limit), F(memory_limit_mb), F(work_limit_gflop),
      F(edge_count), F(edge_limit), F(face_count), F(corner_count);
#undef T
#define T hf_graph_desc
  STRUCT(hf_graph_desc);
  F(struct_size), F(vertex_count), F(edge_count), F(allow_negative), F(edges), F(weights), F(masses), F(field_kind),
      F(ordering), F(thread_count), F(vertex_limit), F(edge_limit), F(memory_limit_mb), F(work_limit_gflop),
      F(reserved), F(allocator), F(job_runner), F(progress), F(saved_factor);
#undef T
#define T hf_surface_report
  STRUCT(hf_surface_report);
  F(struct_size), F(vertex_count), F(triangle_count), F(welded_vertex_count), F(component_count),
      F(isolated_vertex_count), F(degenerate_triangle_count), F(collapsed_triangle_count), F(duplicate_triangle_count),
      F(non_manifold_edge_count), F(flipped_edge_count), F(boundary_edge_count), F(negative_edge_count),
      F(smallest_angle), F(bounding_box_diagonal), F(changed_vertex_count), F(first_changed_vertex), F(piece_count),
      F(link_count), F(light_piece_count), F(lone_piece_count), F(longest_tree_link), F(face_count), F(polygon_count),
      F(non_planar_count), F(largest_face), F(inside_out_count), F(first_inside_out_vertex);
#undef T
#define T hf_surface_statistics
  STRUCT(hf_surface_statistics);
  F(struct_size), F(unknown_count), F(weld_ms), F(operator_ms), F(ordering_ms), F(symbolic_ms), F(numeric_ms),
      F(factor_entries), F(factor_bytes), F(factor_flops), F(memory_bytes), F(peak_memory_bytes), F(load_ms),
      F(factor_loaded), F(factor_borrowed), F(links_ms);
#undef T
#define T hf_pick_desc
  STRUCT(hf_pick_desc);
  F(struct_size), F(position_stride), F(positions), F(positions_f64), F(front_only), F(reserved);
#undef T
#define T hf_hit
  STRUCT(hf_hit);
  F(struct_size), F(found), F(triangle), F(vertex), F(barycentrics), F(position), F(distance), F(corners), F(reserved);
#undef T
  CONSTANT(HF_WELD_EXACT), CONSTANT(HF_WELD_NONE), CONSTANT(HF_WELD_TOLERANCE),
      CONSTANT(HF_OPERATOR_INTRINSIC_DELAUNAY), CONSTANT(HF_OPERATOR_CLAMPED), CONSTANT(HF_OPERATOR_UNIFORM),
      CONSTANT(HF_OPERATOR_COTANGENT), CONSTANT(HF_OPERATOR_GRAPH), CONSTANT(HF_FIELD_HARMONIC),
      CONSTANT(HF_FIELD_BIHARMONIC), CONSTANT(HF_FIELD_BIHARMONIC_GRAPH), CONSTANT(HF_ORDERING_NESTED_DISSECTION),
      CONSTANT(HF_ORDERING_MINIMUM_DEGREE), CONSTANT(HF_ORDERING_METIS), CONSTANT(HF_LINK_NONE),
      CONSTANT(HF_LINK_PIECES), CONSTANT(HF_LINK_LIST), CONSTANT(HF_FACTOR_ALIGNMENT);
}

static void print_solver(void) {
#define T hf_solver_desc
  STRUCT(hf_solver_desc);
  F(struct_size), F(field_kind), F(engine), F(channel_count), F(site_limit), F(reserved), F(penalty), F(progress);
#undef T
#define T hf_solver_info
  STRUCT(hf_solver_info);
  F(struct_size), F(field_kind), F(engine), F(channel_count), F(site_limit), F(site_count), F(penalty), F(vertex_count),
      F(reserved);
#undef T
#define T hf_sites_desc
  STRUCT(hf_sites_desc);
  F(struct_size), F(site_count), F(vertices), F(triangles), F(barycentrics), F(values), F(stiffness), F(radii),
      F(corners);
#undef T
#define T hf_edit_desc
  STRUCT(hf_edit_desc);
  F(struct_size), F(remove_count), F(remove_sites), F(move_count), F(set_count), F(move_sites), F(move_to),
      F(set_sites), F(set_values), F(add);
#undef T
#define T hf_sites_info
  STRUCT(hf_sites_info);
  F(struct_size), F(capacity), F(count), F(reserved), F(sites), F(vertices), F(components), F(values), F(stiffness),
      F(flux), F(radii);
#undef T
#define T hf_solve_info
  STRUCT(hf_solve_info);
  F(struct_size), F(unreached_component_count), F(first_unreached_component), F(unreached_vertex_count);
#undef T
#define T hf_preview_info
  STRUCT(hf_preview_info);
  F(struct_size), F(exact), F(correction_count), F(unreached_component_count), F(value_range), F(largest_correction),
      F(error_estimate), F(preview_bytes);
#undef T
#define T hf_certificate
  STRUCT(hf_certificate);
  F(struct_size), F(overshoot_checked), F(tolerance), F(value_range), F(residual), F(site_error), F(overshoot),
      F(worst_vertex), F(changed_vertex_count), F(error_estimate);
#undef T
#define T hf_solver_statistics
  STRUCT(hf_solver_statistics);
  F(struct_size), F(site_count), F(factorisation_count), F(path_solve_count), F(sweep_count), F(last_route),
      F(rebase_count), F(dense_edit_count), F(dense_row_count), F(eliminated_count), F(rebase_advised), F(reserved),
      F(site_memory_bytes), F(predicted_dense_ms), F(predicted_rebase_ms);
#undef T
  CONSTANT(HF_ENGINE_GREEN), CONSTANT(HF_ENGINE_UPDOWN), CONSTANT(HF_ENGINE_REFACTOR), CONSTANT(HF_ROUTE_NONE),
      CONSTANT(HF_ROUTE_DENSE), CONSTANT(HF_ROUTE_FRESH), CONSTANT(HF_ROUTE_REBASE);
}

static void print_pose(void) {
#define T hf_pose_desc
  STRUCT(hf_pose_desc);
  F(struct_size), F(mode), F(band_count), F(iteration_count), F(samples_per_ring), F(group_count);
#undef T
#define T hf_pose_info
  STRUCT(hf_pose_info);
  F(struct_size), F(mode), F(band_count), F(iteration_count), F(samples_per_ring), F(group_count), F(handle_count),
      F(vertex_count);
#undef T
#define T hf_handles_desc
  STRUCT(hf_handles_desc);
  F(struct_size), F(handle_count), F(region_counts), F(region_vertices), F(points), F(radii), F(layer), F(in_place),
      F(progress);
#undef T
#define T hf_transform
  STRUCT(hf_transform);
  F(rotation), F(translation);
#undef T
#define T hf_handle_info
  STRUCT(hf_handle_info);
  F(struct_size), F(vertex_count), F(site_count), F(component), F(centroid), F(leak), F(rotation), F(translation),
      F(layer), F(reserved);
#undef T
#define T hf_deform_info
  STRUCT(hf_deform_info);
  F(struct_size), F(iteration_count), F(cluster_count), F(unreached_vertex_count), F(last_change), F(solve_ms),
      F(blend_ms), F(normal_ms), F(refine_ms);
#undef T
#define T hf_deform_desc
  STRUCT(hf_deform_desc);
  F(struct_size), F(position_stride), F(positions), F(positions_f64), F(normals), F(normal_stride), F(iteration_count),
      F(restart), F(refine), F(refine_from_last), F(first_vertex), F(vertex_count), F(reserved);
#undef T
#define T hf_skin_info
  STRUCT(hf_skin_info);
  F(struct_size), F(joint_capacity), F(vertex_capacity), F(weight_count), F(joint_count), F(vertex_count), F(pivots),
      F(rotations), F(translations), F(axes), F(scales), F(vertex_joints), F(vertex_weights);
#undef T
#define T hf_propose_desc
  STRUCT(hf_propose_desc);
  F(struct_size), F(joint_count), F(joints), F(parents), F(up), F(least_length), F(limit), F(progress);
#undef T
#define T hf_handle_proposal
  STRUCT(hf_handle_proposal);
  F(vertex), F(component), F(reason), F(pinned), F(joint), F(reserved), F(position), F(radius), F(length);
#undef T
  CONSTANT(HF_HANDLE_REASON_FOOT), CONSTANT(HF_HANDLE_REASON_TIP), CONSTANT(HF_HANDLE_REASON_END),
      CONSTANT(HF_HANDLE_REASON_JOINT), CONSTANT(HF_HANDLE_REASON_MIDDLE);
  CONSTANT(HF_DEFORM_SMOOTH), CONSTANT(HF_DEFORM_PAPER), CONSTANT(HF_LAYER_COUNT), CONSTANT(HF_HANDLE_LIMIT);
}

static void print_direction(void) {
#define T hf_direction_desc
  STRUCT(hf_direction_desc);
  F(struct_size), F(degree), F(site_limit), F(reserved), F(progress);
#undef T
#define T hf_singularity
  STRUCT(hf_singularity);
  F(triangle), F(vertex), F(index);
#undef T
#define T hf_direction_statistics
  STRUCT(hf_direction_statistics);
  F(struct_size), F(degree), F(site_limit), F(unknown_count), F(site_count), F(factorisation_count),
      F(path_solve_count), F(sweep_count), F(irregular_vertex_count), F(eliminated_count), F(operator_ms),
      F(numeric_ms), F(factor_entries), F(factor_bytes), F(site_memory_bytes);
#undef T
}

static void print_analysis(void) {
#define T hf_scalars
  STRUCT(hf_scalars);
  F(struct_size), F(value_stride), F(values), F(values_f64);
#undef T
#define T hf_isolines
  STRUCT(hf_isolines);
  F(struct_size), F(point_capacity), F(line_capacity), F(point_count), F(line_count), F(reserved), F(point_edges),
      F(parameters), F(positions), F(line_starts), F(line_levels), F(line_closed);
#undef T
#define T hf_critical_point
  STRUCT(hf_critical_point);
  F(vertex), F(kind), F(index), F(component), F(value);
#undef T
#define T hf_critical_info
  STRUCT(hf_critical_info);
  F(struct_size), F(point_count), F(minimum_count), F(maximum_count), F(saddle_count), F(index_sum),
      F(euler_characteristic), F(reserved);
#undef T
#define T hf_geodesics_desc
  STRUCT(hf_geodesics_desc);
  F(struct_size), F(smoothing), F(progress), F(method), F(reserved);
#undef T
#define T hf_surface_point
  STRUCT(hf_surface_point);
  F(corners), F(reserved), F(barycentrics);
#undef T
#define T hf_path
  STRUCT(hf_path);
  F(struct_size), F(point_capacity), F(point_count), F(reserved), F(length), F(point_edges), F(parameters),
      F(positions);
#undef T
#define T hf_extremities_desc
  STRUCT(hf_extremities_desc);
  F(struct_size), F(kind), F(least_length), F(source_count), F(geodesics), F(progress), F(out_field);
#undef T
#define T hf_extremity
  STRUCT(hf_extremity);
  F(vertex), F(component), F(length), F(position);
#undef T
  CONSTANT(HF_LEVELS_VALUE), CONSTANT(HF_LEVELS_AREA), CONSTANT(HF_LEVELS_LENGTH), CONSTANT(HF_CRITICAL_MINIMUM),
      CONSTANT(HF_CRITICAL_MAXIMUM), CONSTANT(HF_CRITICAL_SADDLE), CONSTANT(HF_EXTREMITIES_POISSON),
      CONSTANT(HF_EXTREMITIES_GEODESIC), CONSTANT(HF_GEODESICS_AUTO), CONSTANT(HF_GEODESICS_FRONT),
      CONSTANT(HF_GEODESICS_EXACT), CONSTANT(HF_GEODESICS_HEAT);
}

static void print_region(void) {
#define T hf_region_desc
  STRUCT(hf_region_desc);
  F(struct_size), F(base), F(positions), F(positions_f64), F(position_stride), F(reserved), F(progress);
#undef T
#define T hf_curve_desc
  STRUCT(hf_curve_desc);
  F(struct_size), F(point_count), F(vertices), F(triangles), F(barycentrics), F(side), F(seed_vertex), F(corners),
      F(kind), F(reserved);
#undef T
#define T hf_region_edit_desc
  STRUCT(hf_region_edit_desc);
  F(struct_size), F(ring_count), F(curve), F(remove_count), F(add_count), F(remove_vertices), F(add_vertices),
      F(progress);
#undef T
#define T hf_region_info
  STRUCT(hf_region_info);
  F(struct_size), F(field_kind), F(vertex_count), F(rim_count), F(site_count), F(inserted_count), F(removed_count),
      F(kept_count), F(factorisation_count), F(path_solve_count), F(last_route), F(whole_sweep), F(area), F(base_area);
#undef T
#define T hf_morph_desc
  STRUCT(hf_morph_desc);
  F(struct_size), F(position_stride), F(weight), F(positions), F(positions_f64), F(normals), F(normal_stride),
      F(reserved);
#undef T
#define T hf_detail_desc
  STRUCT(hf_detail_desc);
  F(struct_size), F(pair_count), F(source_vertices), F(target_vertices), F(scale), F(progress);
#undef T
  CONSTANT(HF_BASE_DEFAULT), CONSTANT(HF_BASE_MEMBRANE), CONSTANT(HF_BASE_THIN_PLATE),
      CONSTANT(HF_BASE_THIN_PLATE_GRAPH), CONSTANT(HF_CURVE_STRAIGHT), CONSTANT(HF_CURVE_EDGES),
      CONSTANT(HF_SIDE_SMALLER), CONSTANT(HF_SIDE_LARGER), CONSTANT(HF_SIDE_SEED), CONSTANT(HF_REGION_INSIDE),
      CONSTANT(HF_REGION_RIM), CONSTANT(HF_REGION_SITES);
}

static void print_quads(void) {
#define T hf_quads_desc
  STRUCT(hf_quads_desc);
  F(struct_size), F(face_count), F(edge_length), F(crease_angle), F(relax_count), F(crease_count), F(guide_count),
      F(pole_count), F(symmetry_plane), F(crease_edges), F(guide_vertices), F(guide_vectors), F(guide_weights),
      F(pole_points), F(pole_quads), F(pole_directions), F(progress);
#undef T
#define T hf_quads_info
  STRUCT(hf_quads_info);
  F(struct_size), F(vertex_count), F(face_count), F(euler_characteristic), F(edge_length);
#undef T
#define T hf_quads_mesh
  STRUCT(hf_quads_mesh);
  F(struct_size), F(vertex_capacity), F(face_capacity), F(vertex_count), F(face_count), F(reserved), F(positions),
      F(faces), F(triangles), F(barycentrics), F(corners);
#undef T
#define T hf_flow_lines
  STRUCT(hf_flow_lines);
  F(struct_size), F(wanted_count), F(seed_count), F(point_capacity), F(line_capacity), F(point_count), F(line_count),
      F(reserved), F(seeds), F(positions), F(values), F(line_starts), F(line_ends);
#undef T
}

static void print_transfer(void) {
#define T hf_transfer_desc
  STRUCT(hf_transfer_desc);
  F(struct_size), F(mode), F(cluster_count), F(kernel_width), F(scale), F(alignment_angle), F(source_axes),
      F(target_axes), F(ground), F(reserved), F(source_rest), F(target_rest);
#undef T
#define T hf_pairs_desc
  STRUCT(hf_pairs_desc);
  F(struct_size), F(pair_count), F(source_counts), F(source_vertices), F(target_counts), F(target_vertices), F(flags),
      F(progress);
#undef T
#define T hf_pair_info
  STRUCT(hf_pair_info);
  F(struct_size), F(flags), F(source_leak), F(target_leak), F(alignment_angle), F(confidence), F(alignment_share),
      F(aligned), F(crossed);
#undef T
#define T hf_transfer_info
  STRUCT(hf_transfer_info);
  F(struct_size), F(pair_count), F(cluster_count), F(aligned_count), F(crossed_count), F(scale_found),
      F(source_factorisation_count), F(target_factorisation_count), F(scale);
#undef T
#define T hf_transfer_frame
  STRUCT(hf_transfer_frame);
  F(struct_size), F(source_stride), F(source_positions), F(source_positions_f64), F(target_stride), F(normal_stride),
      F(target_positions), F(target_positions_f64), F(target_normals), F(hold_count), F(reserved), F(hold_pairs),
      F(hold_positions);
#undef T
#define T hf_transfer_dials
  STRUCT(hf_transfer_dials);
  F(struct_size), F(stride), F(hip_height), F(neck_follow), F(tail_follow), F(arm_space), F(long_follow);
#undef T
  CONSTANT(HF_TRANSFER_FIELDS), CONSTANT(HF_TRANSFER_PAPER), CONSTANT(HF_TRANSFER_STRETCH), CONSTANT(HF_PAIR_ANCHOR),
      CONSTANT(HF_PAIR_FOOT), CONSTANT(HF_PAIR_TRUNK), CONSTANT(HF_PAIR_NO_ALIGNMENT), CONSTANT(HF_PAIR_CONTACT),
      CONSTANT(HF_PAIR_SINKS), CONSTANT(HF_PAIR_NECK), CONSTANT(HF_PAIR_TAIL), CONSTANT(HF_PAIR_ARM),
      CONSTANT(HF_PAIR_LIMIT), CONSTANT(HF_GROUND_KEEP), CONSTANT(HF_GROUND_OFF);
}

static void print_weights(void) {
#define T hf_bones_desc
  STRUCT(hf_bones_desc);
  F(struct_size), F(bone_count), F(heads), F(tails), F(axes), F(parents), F(deforms), F(sources), F(progress);
#undef T
#define T hf_pins_desc
  STRUCT(hf_pins_desc);
  F(struct_size), F(pin_count), F(vertices), F(triangles), F(barycentrics), F(radii), F(joint_count), F(reserved),
      F(joints), F(weights), F(progress);
#undef T
#define T hf_weights_out
  STRUCT(hf_weights_out);
  F(struct_size), F(vertex_capacity), F(vertex_count), F(weight_count), F(joints), F(joints_u16), F(weights),
      F(origins);
#undef T
#define T hf_weights_info
  STRUCT(hf_weights_info);
  F(struct_size), F(vertex_count), F(bone_count), F(pin_count), F(lock_count), F(informed_count), F(solved_count),
      F(pinned_count), F(carried_count), F(rigid_count), F(isolated_count), F(carried_island_count),
      F(rigid_island_count), F(blind), F(no_length_count), F(coincident_count), F(informs_none_count), F(outside_count),
      F(helper_count), F(factorisation_count), F(path_solve_count), F(reserved);
#undef T
#define T hf_carry_desc
  STRUCT(hf_carry_desc);
  F(struct_size), F(influence_count), F(joints), F(weights), F(distance), F(angle), F(weight_count), F(reserved),
      F(progress);
#undef T
#define T hf_carry_info
  STRUCT(hf_carry_info);
  F(struct_size), F(vertex_count), F(matched_count), F(solved_count), F(carried_count), F(rigid_count),
      F(isolated_count), F(guessed_island_count);
#undef T
#define T hf_mirror_desc
  STRUCT(hf_mirror_desc);
  F(struct_size), F(bone_count), F(heads), F(names), F(partners), F(plane), F(influence_count), F(to), F(joints),
      F(weights), F(distance), F(angle), F(weight_count), F(reserved), F(progress);
#undef T
#define T hf_mirror_info
  STRUCT(hf_mirror_info);
  F(struct_size), F(vertex_count), F(plane_from), F(named_count), F(placed_count), F(centre_count), F(given_count),
      F(alone_count), F(kept_count), F(matched_count), F(solved_count), F(carried_count), F(rigid_count),
      F(isolated_count), F(worst_bone), F(worst_vertex), F(point), F(normal), F(bone_off), F(worst_bone_off),
      F(vertex_off), F(worst_vertex_off);
#undef T
  CONSTANT(HF_WEIGHTS_INFORMED), CONSTANT(HF_WEIGHTS_SOLVED), CONSTANT(HF_WEIGHTS_PINNED), CONSTANT(HF_WEIGHTS_CARRIED),
      CONSTANT(HF_WEIGHTS_RIGID), CONSTANT(HF_WEIGHTS_ISOLATED), CONSTANT(HF_BONE_NO_LENGTH),
      CONSTANT(HF_BONE_COINCIDENT), CONSTANT(HF_BONE_INFORMS_NONE), CONSTANT(HF_BONE_OUTSIDE), CONSTANT(HF_BONE_HELPER);
  CONSTANT(HF_WEIGHTS_MATCHED);
  CONSTANT(HF_WEIGHTS_KEPT);
  CONSTANT(HF_HELPER_PROPOSED);
  CONSTANT(HF_HELPER_NAME_ROOT);
  CONSTANT(HF_HELPER_NAME_CONTROL);
  CONSTANT(HF_HELPER_NAME_END);
  CONSTANT(HF_HELPER_ROOT);
  CONSTANT(HF_HELPER_APART);
  CONSTANT(HF_HELPER_NO_LENGTH);
  CONSTANT(HF_HELPER_COINCIDENT);
  CONSTANT(HF_HELPER_OUTSIDE);
  CONSTANT(HF_HELPER_INFORMS_NONE);
  CONSTANT(HF_MIRROR_TO_NEGATIVE);
  CONSTANT(HF_MIRROR_TO_POSITIVE);
  CONSTANT(HF_MIRROR_BOTH);
  CONSTANT(HF_MIRROR_PLANE_GIVEN);
  CONSTANT(HF_MIRROR_PLANE_BONES);
  CONSTANT(HF_MIRROR_PLANE_SURFACE);
  CONSTANT(HF_MIRROR_BONE_ALONE);
  CONSTANT(HF_MIRROR_BONE_NAMED);
  CONSTANT(HF_MIRROR_BONE_PLACED);
  CONSTANT(HF_MIRROR_BONE_CENTRE);
  CONSTANT(HF_MIRROR_BONE_GIVEN);
}

int main(void) {
  print_base();
  print_surface();
  print_solver();
  print_pose();
  print_direction();
  print_analysis();
  print_region();
  print_quads();
  print_transfer();
  print_weights();
  return 0;
}

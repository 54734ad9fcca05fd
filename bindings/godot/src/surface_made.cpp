// Generated from include/hf/*.h by bindings/generate; do not edit. Methods of lists and numbers, and figures.
// clang-format off
#include "arguments.h"

namespace hf_godot {
namespace {

// surface_info()
Value surface_info(Surface& s, const Arguments&) {
  auto info = make<hf_surface_info>();
  check(hf_surface_get_info(s.get(), &info));
  return named({{"vertex_count", info.vertex_count}, {"triangle_count", info.triangle_count}, {"weld", info.weld},
      {"weld_tolerance", info.weld_tolerance}, {"operator_kind", info.operator_kind}, {"field_kind", info.field_kind},
      {"ordering", info.ordering}, {"thread_count", info.thread_count}, {"vertex_limit", info.vertex_limit},
      {"triangle_limit", info.triangle_limit}, {"memory_limit_mb", info.memory_limit_mb}, {"work_limit_gflop",
      info.work_limit_gflop}, {"edge_count", info.edge_count}, {"edge_limit", info.edge_limit}, {"face_count",
      info.face_count}, {"corner_count", info.corner_count}});
}

// surface_report()
Value surface_report(Surface& s, const Arguments&) {
  auto info = make<hf_surface_report>();
  check(hf_surface_get_report(s.get(), &info));
  return named({{"vertex_count", info.vertex_count}, {"triangle_count", info.triangle_count}, {"welded_vertex_count",
      info.welded_vertex_count}, {"component_count", info.component_count}, {"isolated_vertex_count",
      info.isolated_vertex_count}, {"degenerate_triangle_count", info.degenerate_triangle_count},
      {"collapsed_triangle_count", info.collapsed_triangle_count}, {"duplicate_triangle_count",
      info.duplicate_triangle_count}, {"non_manifold_edge_count", info.non_manifold_edge_count}, {"flipped_edge_count",
      info.flipped_edge_count}, {"boundary_edge_count", info.boundary_edge_count}, {"inside_out_count",
      info.inside_out_count}, {"first_inside_out_vertex", info.first_inside_out_vertex}, {"bounding_box_diagonal",
      info.bounding_box_diagonal}});
}

// surface_mesh_statistics()
Value surface_mesh_statistics(Surface& s, const Arguments&) {
  auto info = make<hf_mesh_statistics>();
  check(hf_surface_get_mesh_statistics(s.get(), &info));
  return named({{"polygon_count", info.polygon_count}, {"non_planar_count", info.non_planar_count}, {"largest_face",
      info.largest_face}, {"negative_edge_count", info.negative_edge_count}, {"changed_vertex_count",
      info.changed_vertex_count}, {"first_changed_vertex", info.first_changed_vertex}, {"smallest_angle",
      info.smallest_angle}});
}

// surface_links_info()
Value surface_links_info(Surface& s, const Arguments&) {
  auto info = make<hf_links_info>();
  check(hf_surface_get_links_info(s.get(), &info));
  return named({{"piece_count", info.piece_count}, {"link_count", info.link_count}, {"light_piece_count",
      info.light_piece_count}, {"lone_piece_count", info.lone_piece_count}, {"contact_count", info.contact_count},
      {"longest_tree_link", info.longest_tree_link}});
}

// surface_statistics()
Value surface_statistics(Surface& s, const Arguments&) {
  auto info = make<hf_surface_statistics>();
  check(hf_surface_get_statistics(s.get(), &info));
  return named({{"unknown_count", info.unknown_count}, {"weld_ms", info.weld_ms}, {"operator_ms", info.operator_ms},
      {"ordering_ms", info.ordering_ms}, {"symbolic_ms", info.symbolic_ms}, {"numeric_ms", info.numeric_ms},
      {"factor_entries", info.factor_entries}, {"factor_bytes", info.factor_bytes}, {"factor_flops", info.factor_flops},
      {"memory_bytes", info.memory_bytes}, {"peak_memory_bytes", info.peak_memory_bytes}, {"load_ms", info.load_ms},
      {"factor_loaded", info.factor_loaded}, {"factor_borrowed", info.factor_borrowed}, {"links_ms", info.links_ms}});
}

// solver_info()
Value solver_info(Surface& s, const Arguments&) {
  auto info = make<hf_solver_info>();
  check(hf_solver_get_info(solver_of(s), &info));
  return named({{"field_kind", info.field_kind}, {"channel_count", info.channel_count}, {"site_limit", info.site_limit},
      {"site_count", info.site_count}, {"vertex_count", info.vertex_count}});
}

// remove_sites(sites)
Value remove_sites(Surface& s, const Arguments& a) {
  const List sites = integers(at(a, 0), "sites");
  check(hf_remove_sites(solver_of(s), sites.count(), sites.data()));
  return done();
}

// set_values(sites, values)
Value set_values(Surface& s, const Arguments& a) {
  const List sites = integers(at(a, 0), "sites");
  check(hf_solver_set_values(solver_of(s), sites.count(), sites.data(), doubles(at(a, 1), size_t{sites.count()},
      "values")));
  return done();
}

// set_screening(screening, targets)
Value set_screening(Surface& s, const Arguments& a) {
  check(hf_solver_set_screening(solver_of(s), doubles(at(a, 0), size_t{s.vertex_count}, "screening"), doubles(at(a, 1),
      size_t{s.vertex_count}, "targets")));
  return done();
}

// statistics()
Value statistics(Surface& s, const Arguments&) {
  auto info = make<hf_solver_statistics>();
  check(hf_solver_get_statistics(solver_of(s), &info));
  return named({{"site_count", info.site_count}, {"factorisation_count", info.factorisation_count}, {"path_solve_count",
      info.path_solve_count}, {"sweep_count", info.sweep_count}, {"last_route", info.last_route}, {"rebase_count",
      info.rebase_count}, {"dense_edit_count", info.dense_edit_count}, {"dense_row_count", info.dense_row_count},
      {"eliminated_count", info.eliminated_count}, {"rebase_advised", info.rebase_advised}, {"site_memory_bytes",
      info.site_memory_bytes}, {"predicted_dense_ms", info.predicted_dense_ms}, {"predicted_rebase_ms",
      info.predicted_rebase_ms}});
}

// direction_remove_sites(sites)
Value direction_remove_sites(Surface& s, const Arguments& a) {
  const List sites = integers(at(a, 0), "sites");
  check(hf_direction_remove_sites(s.direction.get(), sites.count(), sites.data()));
  return done();
}

// direction_move_sites(sites, vertices)
Value direction_move_sites(Surface& s, const Arguments& a) {
  const List sites = integers(at(a, 0), "sites");
  const List vertices = integers(at(a, 1), "vertices");
  if (vertices.count() != sites.count()) fail("sites and vertices must be of one length");
  check(hf_direction_move_sites(s.direction.get(), sites.count(), sites.data(), vertices.data()));
  return done();
}

// direction_set_vectors(sites, vectors)
Value direction_set_vectors(Surface& s, const Arguments& a) {
  const List sites = integers(at(a, 0), "sites");
  check(hf_direction_set_vectors(s.direction.get(), sites.count(), sites.data(), doubles(at(a, 1),
      size_t{sites.count()} * 3, "vectors")));
  return done();
}

// direction_rotate_sites(sites, angles)
Value direction_rotate_sites(Surface& s, const Arguments& a) {
  const List sites = integers(at(a, 0), "sites");
  check(hf_direction_rotate_sites(s.direction.get(), sites.count(), sites.data(), doubles(at(a, 1),
      size_t{sites.count()}, "angles")));
  return done();
}

// direction_statistics()
Value direction_statistics(Surface& s, const Arguments&) {
  auto info = make<hf_direction_statistics>();
  check(hf_direction_get_statistics(s.direction.get(), &info));
  return named({{"degree", info.degree}, {"site_limit", info.site_limit}, {"unknown_count", info.unknown_count},
      {"site_count", info.site_count}, {"factorisation_count", info.factorisation_count}, {"path_solve_count",
      info.path_solve_count}, {"sweep_count", info.sweep_count}, {"irregular_vertex_count",
      info.irregular_vertex_count}, {"eliminated_count", info.eliminated_count}, {"operator_ms", info.operator_ms},
      {"numeric_ms", info.numeric_ms}, {"factor_entries", info.factor_entries}, {"factor_bytes", info.factor_bytes},
      {"site_memory_bytes", info.site_memory_bytes}});
}

// pose_info()
Value pose_info(Surface& s, const Arguments&) {
  auto info = make<hf_pose_info>();
  check(hf_pose_get_info(pose_of(s), &info));
  return named({{"band_count", info.band_count}, {"iteration_count", info.iteration_count}, {"group_count",
      info.group_count}, {"handle_count", info.handle_count}, {"vertex_count", info.vertex_count}});
}

// remove_handles(handles)
Value remove_handles(Surface& s, const Arguments& a) {
  const List handles = integers(at(a, 0), "handles");
  check(hf_pose_remove_handles(pose_of(s), handles.count(), handles.data()));
  return done();
}

// set_free_rotations(handles, free_rotation)
Value set_free_rotations(Surface& s, const Arguments& a) {
  const List handles = integers(at(a, 0), "handles");
  check(hf_pose_set_free_rotations(pose_of(s), handles.count(), handles.data(), signed_whole(at(a, 1).number,
      "free_rotation")));
  return done();
}

// set_following(handles, following)
Value set_following(Surface& s, const Arguments& a) {
  const List handles = integers(at(a, 0), "handles");
  check(hf_pose_set_following(pose_of(s), handles.count(), handles.data(), at(a, 1).number));
  return done();
}

// set_limb_refine(handles, refine)
Value set_limb_refine(Surface& s, const Arguments& a) {
  const List handles = integers(at(a, 0), "handles");
  check(hf_pose_set_limb_refine(pose_of(s), handles.count(), handles.data(), signed_whole(at(a, 1).number, "refine")));
  return done();
}

// set_rigid_pieces(vertices)
Value set_rigid_pieces(Surface& s, const Arguments& a) {
  const List vertices = integers(at(a, 0), "vertices");
  check(hf_pose_set_rigid_pieces(pose_of(s), vertices.count(), vertices.data()));
  return done();
}

// set_matrices(handles, matrices)
Value set_matrices(Surface& s, const Arguments& a) {
  const List handles = integers(at(a, 0), "handles");
  check(hf_pose_set_matrices(pose_of(s), handles.count(), handles.data(), doubles(at(a, 1),
      size_t{handles.count()} * 16, "matrices")));
  return done();
}

// pose_statistics()
Value pose_statistics(Surface& s, const Arguments&) {
  auto info = make<hf_pose_statistics>();
  check(hf_pose_get_statistics(pose_of(s), &info));
  return named({{"cluster_count", info.cluster_count}, {"solve_ms", info.solve_ms}, {"blend_ms", info.blend_ms},
      {"normal_ms", info.normal_ms}, {"refine_ms", info.refine_ms}});
}

// pose_blend_info()
Value pose_blend_info(Surface& s, const Arguments&) {
  auto info = make<hf_blend_info>();
  check(hf_pose_get_blend_info(pose_of(s), &info));
  return named({{"cluster_count", info.cluster_count}, {"revision", info.revision}, {"offset_share",
      info.offset_share}});
}

// quads_info()
Value quads_info(Surface& s, const Arguments&) {
  auto info = make<hf_quads_info>();
  check(hf_quads_get_info(s.quads.get(), &info));
  return named({{"vertex_count", info.vertex_count}, {"face_count", info.face_count}, {"euler_characteristic",
      info.euler_characteristic}, {"edge_length", info.edge_length}});
}

// region_statistics()
Value region_statistics(Surface& s, const Arguments&) {
  auto info = make<hf_region_statistics>();
  check(hf_region_get_statistics(s.region.get(), &info));
  return named({{"inserted_count", info.inserted_count}, {"removed_count", info.removed_count}, {"kept_count",
      info.kept_count}, {"factorisation_count", info.factorisation_count}, {"path_solve_count", info.path_solve_count},
      {"last_route", info.last_route}, {"whole_sweep", info.whole_sweep}});
}

// transfer_remove_pairs(pairs)
Value transfer_remove_pairs(Surface& s, const Arguments& a) {
  const List pairs = integers(at(a, 0), "pairs");
  check(hf_transfer_remove_pairs(s.transfer.get(), pairs.count(), pairs.data()));
  return done();
}

// transfer_info()
Value transfer_info(Surface& s, const Arguments&) {
  auto info = make<hf_transfer_info>();
  check(hf_transfer_get_info(s.transfer.get(), &info));
  return named({{"pair_count", info.pair_count}, {"cluster_count", info.cluster_count}, {"aligned_count",
      info.aligned_count}, {"crossed_count", info.crossed_count}, {"scale_found", info.scale_found}, {"scale",
      info.scale}});
}

// transfer_statistics()
Value transfer_statistics(Surface& s, const Arguments&) {
  auto info = make<hf_transfer_statistics>();
  check(hf_transfer_get_statistics(s.transfer.get(), &info));
  return named({{"source_factorisation_count", info.source_factorisation_count}, {"target_factorisation_count",
      info.target_factorisation_count}});
}

// transfer_dials()
Value transfer_dials(Surface& s, const Arguments&) {
  auto info = make<hf_transfer_dials>();
  check(hf_transfer_get_dials(s.transfer.get(), &info));
  return named({{"stride", info.stride}, {"hip_height_share", info.hip_height_share}, {"neck_follow", info.neck_follow},
      {"tail_follow", info.tail_follow}, {"arm_space", info.arm_space}, {"long_follow", info.long_follow}});
}

// transfer_set_rigid_pieces(vertices)
Value transfer_set_rigid_pieces(Surface& s, const Arguments& a) {
  const List vertices = integers(at(a, 0), "vertices");
  check(hf_transfer_set_rigid_pieces(s.transfer.get(), vertices.count(), vertices.data()));
  return done();
}

}  // namespace

const std::vector<Entry>& made_methods() {
  static const std::vector<Entry> all = {
      {"surface_info", 0, 0, surface_info},
      {"surface_report", 0, 0, surface_report},
      {"surface_mesh_statistics", 0, 0, surface_mesh_statistics},
      {"surface_links_info", 0, 0, surface_links_info},
      {"surface_statistics", 0, 0, surface_statistics},
      {"solver_info", 0, 0, solver_info},
      {"remove_sites", 1, 1, remove_sites},
      {"set_values", 2, 2, set_values},
      {"set_screening", 0, 2, set_screening},
      {"statistics", 0, 0, statistics},
      {"direction_remove_sites", 1, 1, direction_remove_sites},
      {"direction_move_sites", 2, 2, direction_move_sites},
      {"direction_set_vectors", 2, 2, direction_set_vectors},
      {"direction_rotate_sites", 2, 2, direction_rotate_sites},
      {"direction_statistics", 0, 0, direction_statistics},
      {"pose_info", 0, 0, pose_info},
      {"remove_handles", 1, 1, remove_handles},
      {"set_free_rotations", 1, 2, set_free_rotations},
      {"set_following", 1, 2, set_following},
      {"set_limb_refine", 1, 2, set_limb_refine},
      {"set_rigid_pieces", 1, 1, set_rigid_pieces},
      {"set_matrices", 2, 2, set_matrices},
      {"pose_statistics", 0, 0, pose_statistics},
      {"pose_blend_info", 0, 0, pose_blend_info},
      {"quads_info", 0, 0, quads_info},
      {"region_statistics", 0, 0, region_statistics},
      {"transfer_remove_pairs", 1, 1, transfer_remove_pairs},
      {"transfer_info", 0, 0, transfer_info},
      {"transfer_statistics", 0, 0, transfer_statistics},
      {"transfer_dials", 0, 0, transfer_dials},
      {"transfer_set_rigid_pieces", 1, 1, transfer_set_rigid_pieces},
  };
  return all;
}

}  // namespace hf_godot

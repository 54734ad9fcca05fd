#include <array>

#include "../support/place_in.h"
#include "../support/stick_man.h"
#include "support/arrays.h"
#include "whole_api_run.h"

namespace reliability {

// A stiff stroke, and what moves to the surface that has it.
void Run::edits(hf_surface surface) {
  const std::uint32_t stroke[3] = {5, 6, 222};
  const double stiffness[3] = {30, 30, 0.2};
  hf_surface_edit_desc edit = desc<hf_surface_edit_desc>();
  edit.vertex_count = 3;
  edit.vertices = stroke;
  edit.stiffness = stiffness;
  hf_surface stiff = nullptr;
  hf_solver solver = nullptr;
  hf_pose pose = nullptr;
  call(hf_create(surface, nullptr, &solver), "hf_create");
  call(hf_solver_add_site(solver, 5, s.values.data(), nullptr), "hf_solver_add_site");
  call(hf_solver_add_site(solver, 111, s.values.data() + 1, nullptr), "hf_solver_add_site");
  call(hf_pose_create(surface, nullptr, &pose), "hf_pose_create");
  call(hf_surface_edit(surface, &edit, &stiff), "hf_surface_edit");
  call(hf_solver_move_to(solver, stiff), "hf_solver_move_to");
  call(hf_pose_move_to(pose, stiff), "hf_pose_move_to");
  Numbers field(n), whole(n);
  call(hf_solver_solve(solver, OUT(field.data()), nullptr), "hf_solver_solve");
  take(field.data(), field.size());
  std::uint32_t count = 0;
  call(hf_surface_get_stiffness(stiff, n, whole.data(), &count), "hf_surface_get_stiffness");
  take(whole.data(), count);
  hf_patch_desc patch = desc<hf_patch_desc>();
  const std::uint32_t slit[4] = {s.triangles[0], s.triangles[1], s.triangles[1], s.triangles[2]};
  patch.cut_edge_count = 2;
  patch.cut_edges = slit;
  hf_surface_edit_desc knife = desc<hf_surface_edit_desc>();
  knife.patch = &patch;
  hf_surface open = nullptr;
  call(hf_surface_edit(stiff, &knife, &open), "hf_surface_edit");
  std::array<hf_cut_corner, 16> corners{};
  call(hf_surface_get_cuts(open, 16, corners.data(), &count), "hf_surface_get_cuts");
  for (std::uint32_t i = 0; i < count; ++i) {
    const double row[2] = {static_cast<double>(corners[i].triangle), static_cast<double>(corners[i].vertex)};
    take(row, 2);
  }
  hf_cut_desc line = desc<hf_cut_desc>();
  const std::uint32_t ends[2] = {s.triangles[0], s.triangles[3 * (s.triangles.size() / 6)]};
  line.point_count = 2;
  line.vertices = ends;
  hf_cut cut = desc<hf_cut>();
  call(hf_surface_trace_cut(surface, &line, &cut), "hf_surface_trace_cut");
  Numbers places(3 * cut.new_vertex_count);
  cut.new_vertex_capacity = cut.new_vertex_count;
  cut.new_positions = places.data();
  call(hf_surface_trace_cut(surface, &line, &cut), "hf_surface_trace_cut");
  take(places.data(), places.size());
  hf_surface_destroy(open);
  hf_surface_destroy(stiff);
  hf_solver_destroy(solver);
  hf_pose_destroy(pose);
}

void Run::surface_and_picking() {
  hf_progress progress = nullptr;
  call(hf_progress_create(&progress), "hf_progress_create");
  hf_surface_desc d = surface_desc();
  d.progress = progress;
  const hf_surface surface = make(d);
  double fraction = 0;
  call(hf_progress_get_fraction(progress, &fraction), "hf_progress_get_fraction");
  take(&fraction, 1);
  hf_surface none = nullptr;
  call(hf_progress_cancel(progress), "hf_progress_cancel");
  call(hf_surface_create(&d, &none), "hf_surface_create, cancelled", HF_ERROR_CANCELLED);
  hf_progress_destroy(progress);

  hf_surface_info info = desc<hf_surface_info>();
  call(hf_surface_get_info(surface, &info), "hf_surface_get_info");
  info.thread_count = 0;
  take(&info, 1);
  hf_surface_report report = desc<hf_surface_report>();
  call(hf_surface_get_report(surface, &report), "hf_surface_get_report");
  take(&report, 1);
  hf_mesh_statistics mesh = desc<hf_mesh_statistics>();
  call(hf_surface_get_mesh_statistics(surface, &mesh), "hf_surface_get_mesh_statistics");
  take(&mesh, 1);
  std::vector<std::uint32_t> components(n);
  std::uint32_t count = 0;
  call(hf_surface_get_components(surface, n, components.data(), &count), "hf_surface_get_components");
  take(components.data(), count);
  hf_surface_statistics statistics = desc<hf_surface_statistics>();
  call(hf_surface_get_statistics(surface, &statistics), "hf_surface_get_statistics");
  take(&statistics.unknown_count, 1);
  take(&statistics.factor_entries, 1);

  const double* const origin = s.points.data();
  hf_hit hit = desc<hf_hit>();
  call(hf_surface_cast_ray(surface, s.ray.data(), s.ray.data() + 3, nullptr, &hit), "hf_surface_cast_ray");
  take(&hit, 1);
  hf_pick_desc posed = desc<hf_pick_desc>();
  posed.positions = HF_ARRAY(s.posed.data(), s.posed.size() / 3);
  std::uint32_t vertex = 0;
  double distance = 0;
  call(hf_surface_find_vertex(surface, origin, &posed, &vertex, &distance), "hf_surface_find_vertex");
  take(&vertex, 1);
  take(&distance, 1);
  uint32_t link_count = 0, pieces_count = 0;
  std::vector<std::uint32_t> pieces(n);
  std::vector<std::int32_t> light(n);
  hf_links_desc links = desc<hf_links_desc>();
  links.mode = HF_LINK_PIECES;
  hf_surface linked = nullptr;
  call(hf_surface_relink(surface, &links, nullptr, &linked), "hf_surface_relink");
  hf_links_info linked_info = desc<hf_links_info>();
  call(hf_surface_get_links_info(linked, &linked_info), "hf_surface_get_links_info");
  take(&linked_info, 1);
  call(hf_surface_get_links(linked, 0, nullptr, &link_count), "hf_surface_get_links");
  take(&link_count, 1);
  call(hf_surface_get_pieces(linked, n, pieces.data(), light.data(), &pieces_count), "hf_surface_get_pieces");
  take(pieces.data(), pieces_count);
  take(light.data(), pieces_count);
  const hf_array gaps = HF_ARRAY(s.posed.data(), s.posed.size() / 3);
  hf_gaps_info opened = desc<hf_gaps_info>();
  call(hf_surface_measure_gaps(linked, &gaps, 0, nullptr, &opened), "hf_surface_measure_gaps");
  take(&opened, 1);
  hf_surface_destroy(linked);
  edits(surface);
  hf_surface_destroy(surface);
}

void Run::solver_and_sites() {
  const hf_surface surface = make(surface_desc());
  const hf_solver solver = make_solver(surface);
  hf_surface_destroy(surface);
  std::vector<std::uint32_t> numbers(8);
  hf_sites_desc sites = sites_at(6, 50);
  sites.stiffness = s.stiffness.data();
  call(hf_add_sites(solver, &sites, numbers.data()), "hf_add_sites");
  take(numbers.data(), 6);
  sites = sites_at(2, 30, 10, 7);
  sites.radii = s.radii.data();
  call(hf_add_sites(solver, &sites, nullptr), "hf_add_sites, discs");
  const hf_place inside[2] = {place_in(s.triangles.data(), s.triangle_count, 33, s.barycentrics.data()),
                              place_in(s.triangles.data(), s.triangle_count, 400, s.barycentrics.data() + 3)};
  sites = sites_at(2, 1, 20);
  sites.vertices = nullptr;
  sites.places = inside;
  call(hf_add_sites(solver, &sites, numbers.data() + 6), "hf_add_sites, points");
  take_field(solver);
  call(hf_solve(solver, floats.data(), 12, nullptr), "hf_solve");
  take_floats();

  call(hf_solver_add_site(solver, 311, s.values.data() + 17, nullptr), "hf_solver_add_site");
  hf_solver before = nullptr;
  call(hf_solver_clone(solver, &before), "hf_solver_clone");
  sites = sites_at(1, 1, 0, 111);
  sites.values = nullptr;
  call(hf_solver_move_sites(solver, 1, &numbers[1], &sites), "hf_solver_move_sites");
  call(hf_solver_set_values(solver, 2, &numbers[2], s.values.data() + 40), "hf_solver_set_values");
  call(hf_remove_sites(solver, 1, &numbers[6]), "hf_remove_sites");
  hf_sites_desc add = sites_at(2, 9, 60, 222);
  hf_edit_desc edit = desc<hf_edit_desc>();
  edit.remove_count = 1;
  edit.remove_sites = &numbers[4];
  edit.add = &add;
  call(hf_solver_edit_sites(solver, &edit, nullptr), "hf_solver_edit_sites");
  take_field(solver);
  const std::uint32_t asked[3] = {5, 100, 222};
  double at[3];
  call(hf_solver_solve_at(solver, 3, asked, at), "hf_solver_solve_at");
  take(at, 3);
  take_field(before);
  hf_solver_destroy(before);
  take_field(solver);
  const Numbers screening(std::size_t{n}, 0.5), targets(8 * std::size_t{n}, 2.0);
  call(hf_solver_set_screening(solver, screening.data(), targets.data()), "hf_solver_set_screening");
  take_field(solver);
  call(hf_solver_set_screening(solver, nullptr, nullptr), "hf_solver_set_screening, none");

  sites = sites_at(40, 8, 80, 3);
  sites.stiffness = nullptr;
  call(hf_add_sites(solver, &sites, nullptr), "hf_add_sites, many");
  call(hf_solver_prepare_rebase(solver), "hf_solver_prepare_rebase");
  call(hf_solver_set_values(solver, 1, &numbers[2], s.values.data() + 45), "hf_solver_set_values, after the rebase");
  call(hf_remove_sites(solver, 2, &numbers[2]), "hf_remove_sites, in the factor");
  take_field(solver);
  hf_certificate certificate = desc<hf_certificate>();
  call(hf_solver_certify(solver, &certificate), "hf_solver_certify");
  const std::uint32_t count = hf_solver_get_site_count(solver);
  std::vector<std::uint32_t> site(count), vertex(count), component(count);
  Numbers value(count), stiffness(count), flux(count), radius(count);
  hf_sites_info info = desc<hf_sites_info>();
  info.capacity = count;
  info.sites = site.data();
  info.vertices = vertex.data();
  info.components = component.data();
  info.values = value.data();
  info.stiffness = stiffness.data();
  info.flux = flux.data();
  info.radii = radius.data();
  call(hf_solver_get_sites(solver, &info), "hf_solver_get_sites");
  take(site.data(), count);
  take(vertex.data(), count);
  take(value.data(), count);
  take(flux.data(), count);
  hf_solver_statistics statistics = desc<hf_solver_statistics>();
  call(hf_solver_get_statistics(solver, &statistics), "hf_solver_get_statistics");
  take(&statistics.site_count, 1);
  take(&statistics.eliminated_count, 1);
  hf_solver_info made = desc<hf_solver_info>();
  call(hf_solver_get_info(solver, &made), "hf_solver_get_info");
  take(&made, 1);
  hf_solver_destroy(solver);
}

// One surface: solvers of three kinds of field, a pose and a region share it and outlive it.
void Run::other_kinds() {
  hf_surface_desc d = surface_desc();
  d.field_kind = HF_FIELD_BIHARMONIC;
  const hf_surface surface = make(d);
  hf_solver solvers[3];
  for (int kind = 0; kind < 3; ++kind) {
    hf_solver_desc wanted = desc<hf_solver_desc>();
    wanted.field_kind = kind;
    call(hf_create(surface, &wanted, &solvers[kind]), "hf_create, kinds");
  }
  hf_pose pose = nullptr;
  call(hf_pose_create(surface, nullptr, &pose), "hf_pose_create, bi-harmonic surface");
  hf_surface_destroy(surface);
  for (const hf_solver solver : solvers) {
    const hf_sites_desc sites = sites_at(5, 60);
    call(hf_add_sites(solver, &sites, nullptr), "hf_add_sites, kinds");
    take_field(solver);
    hf_solver_destroy(solver);
  }
  std::uint32_t handle = 0;
  call(hf_pose_add_handle_at(pose, s.points.data(), 0.5, &handle), "hf_pose_add_handle_at");
  const hf_transform turned = {{0, 0.5, 0, 0.8660254037844386}, {1, 2, 0.5}};
  call(hf_pose_set_transform(pose, handle, &turned), "hf_pose_set_transform");
  call(hf_deform(pose, floats.data(), nullptr), "hf_deform");
  take_floats();
  call(hf_pose_solve(pose, 0, 0, nullptr), "hf_pose_solve");
  hf_blend_info blend = desc<hf_blend_info>();
  call(hf_pose_get_blend_info(pose, &blend), "hf_pose_get_blend_info");
  hf_blend_rows rows = desc<hf_blend_rows>();
  call(hf_pose_get_blend_rows(pose, &rows), "hf_pose_get_blend_rows");
  hf_blend_influences influences = desc<hf_blend_influences>();
  call(hf_pose_get_blend_influences(pose, &influences), "hf_pose_get_blend_influences");
  call(hf_pose_get_blend_transforms(pose, static_cast<std::uint32_t>(floats.size() / 12), floats.data(), nullptr),
       "hf_pose_get_blend_transforms");
  take_floats();
  hf_pose_info info = desc<hf_pose_info>();
  call(hf_pose_get_info(pose, &info), "hf_pose_get_info");
  take(&info, 1);
  hf_pose_statistics figures = desc<hf_pose_statistics>();
  call(hf_pose_get_statistics(pose, &figures), "hf_pose_get_statistics");
  take(&figures.cluster_count, 1);
  hf_pose_destroy(pose);
}

void Run::other_engines() {
  for (int engine = 0; engine < 3; ++engine) {
    for (int field = 0; field < 3; ++field) {
      hf_surface_desc d = surface_desc();
      hf_solver_desc wanted = desc<hf_solver_desc>();
      wanted.channel_count = 2;
      d.field_kind = wanted.field_kind = field;
      d.operator_kind = (engine + field) % 4;
      d.ordering = engine == ENGINE_REFACTOR ? HF_ORDERING_MINIMUM_DEGREE : HF_ORDERING_NESTED_DISSECTION;
      if (engine == ENGINE_UPDOWN) {
        if (!options_.paper_engine) continue;
        d.ordering = HF_ORDERING_METIS;
      }
      hf_surface surface = nullptr;
      hf_solver solver = nullptr, copy = nullptr;
      hf_result made = hf_surface_create(&d, &surface);
      if (made == HF_OK) made = create_with(engine, surface, &wanted, &solver);
      hf_surface_destroy(surface);
      if (made == HF_ERROR_UNSUPPORTED) continue;
      call(made, "hf_create, engines");
      const hf_sites_desc sites = sites_at(5, 60);
      std::uint32_t numbers[5];
      call(hf_add_sites(solver, &sites, numbers), "hf_add_sites, engines");
      call(hf_solver_clone(solver, &copy), "hf_solver_clone");
      call(hf_remove_sites(copy, 2, numbers), "hf_remove_sites, engines");
      take_field(solver);
      take_field(copy);
      hf_solver_destroy(solver);
      hf_solver_destroy(copy);
    }
  }
}

void Run::vectors() {
  const hf_surface surface = make(surface_desc());
  const hf_solver solver = make_solver(surface, 3);
  hf_surface_destroy(surface);
  hf_sites_desc sites = sites_at(4, 70);
  std::uint32_t numbers[4];
  call(hf_add_sites(solver, &sites, numbers), "hf_add_sites, vectors");
  const std::uint32_t to[1] = {133};
  call(hf_solver_move_vectors(solver, 1, &numbers[1], to), "hf_solver_move_vectors");
  call(hf_solver_rotate_vectors(solver, 2, numbers, s.angles.data()), "hf_solver_rotate_vectors");
  Numbers normals(3 * std::size_t{n});
  call(hf_solver_solve_vectors(solver, OUT(doubles.data()), normals.data(), nullptr), "hf_solver_solve_vectors");
  take_doubles();
  take(normals.data(), normals.size());
  call(hf_solver_solve_vectors(solver, OUT(floats.data()), nullptr, nullptr), "hf_solver_solve_vectors");
  take_floats();
  hf_solver_destroy(solver);
}

void Run::factor_and_preview() {
  const hf_surface surface = make(surface_desc());
  hf_surface_desc d = surface_desc();
  std::vector<unsigned char> bytes;
  for (const int kind : {HF_FIELD_BIHARMONIC, HF_FIELD_HARMONIC}) {
    std::size_t size = 0;
    call(hf_surface_save(surface, kind, nullptr, 0, nullptr, &size), "hf_surface_save, size");
    bytes.resize(size);
    call(hf_surface_save(surface, kind, nullptr, size, bytes.data(), nullptr), "hf_surface_save");
    take(bytes.data(), size);
  }
  hf_surface_destroy(surface);
  hf_factor_desc saved = desc<hf_factor_desc>();
  saved.bytes = bytes.data();
  saved.byte_count = bytes.size();
  d.saved_factor = &saved;
  const hf_surface again = make(d);
  const hf_solver loaded = make_solver(again);
  hf_surface_destroy(again);
  const hf_sites_desc sites = sites_at(5, 55);
  call(hf_add_sites(loaded, &sites, nullptr), "hf_add_sites, loaded");
  take_field(loaded);
  hf_preview_info info = desc<hf_preview_info>();
  call(hf_solver_solve_preview(loaded, OUT(floats.data()), 0, &info), "hf_solver_solve_preview");
  take_floats();
  call(hf_solver_solve_preview(loaded, OUT(doubles.data()), 2, &info), "hf_solver_solve_preview");
  take_doubles();
  call(hf_solver_release_preview(loaded), "hf_solver_release_preview");
  hf_solver_destroy(loaded);
}

void Run::analysis() {
  hf_surface_desc d = surface_desc();
  d.positions = HF_ARRAY(s.positions_f64.data(), n);
  const hf_surface surface = make(d);
  const hf_array field = HF_ARRAY(s.height.data(), n);
  Numbers levels(6);
  for (int spacing = 0; spacing < 3; ++spacing) {
    call(hf_surface_space_levels(surface, &field, spacing, 6, levels.data()), "hf_surface_space_levels");
    take(levels.data(), 6);
  }
  hf_isolines lines = desc<hf_isolines>();
  call(hf_surface_trace_isolines(surface, &field, 7, s.levels.data(), &lines), "hf_surface_trace_isolines");
  std::vector<std::uint32_t> edges(2 * std::size_t{lines.point_count}), starts(lines.line_count + 1u);
  Numbers parameters(lines.point_count), positions(3 * std::size_t{lines.point_count});
  lines.point_capacity = lines.point_count;
  lines.line_capacity = lines.line_count;
  lines.point_edges = edges.data();
  lines.parameters = parameters.data();
  lines.positions = positions.data();
  lines.line_starts = starts.data();
  call(hf_surface_trace_isolines(surface, &field, 7, s.levels.data(), &lines), "hf_surface_trace_isolines, written");
  take(edges.data(), edges.size());
  take(positions.data(), positions.size());
  take(starts.data(), starts.size());
  std::vector<hf_critical_point> points(n);
  hf_critical_info info = desc<hf_critical_info>();
  call(hf_surface_find_critical_points(surface, &field, n, points.data(), &info), "hf_surface_find_critical_points");
  take(points.data(), info.point_count);
  take(&info, 1);
  hf_geodesics geodesics = nullptr;
  call(hf_geodesics_create(surface, nullptr, &geodesics), "hf_geodesics_create");
  const std::uint32_t sources[2] = {3, 200};
  Numbers distance(n);
  call(hf_geodesics_solve(geodesics, 2, sources, OUT(distance.data())), "hf_geodesics_solve");
  call(hf_geodesics_solve(geodesics, 1, sources, OUT_ROWS(floats.data(), 12)), "hf_geodesics_solve");
  take(distance.data(), n);
  take_floats();
  const hf_place from = {{3, HF_NO_INDEX, HF_NO_INDEX}, 0, {1, 0, 0}},
                 to = {{HF_NO_INDEX, 200, HF_NO_INDEX}, 0, {0, 1, 0}};
  hf_path path = desc<hf_path>();
  call(hf_geodesics_find_path(geodesics, &from, &to, &path), "hf_geodesics_find_path");
  Numbers map(2 * n), corners(3 * path.point_count);
  path.point_capacity = path.point_count;
  path.positions = corners.data();
  call(hf_geodesics_find_path(geodesics, &from, &to, &path), "hf_geodesics_find_path");
  call(hf_geodesics_get_map(geodesics, &to, 0, map.data(), nullptr), "hf_geodesics_get_map");
  take(&path.length, 1);
  take(corners.data(), corners.size());
  take(map.data(), map.size());
  for (int kind = 0; kind < 2; ++kind) {
    hf_extremities_desc wanted = desc<hf_extremities_desc>();
    wanted.kind = kind;
    wanted.geodesics = kind == HF_EXTREMITIES_GEODESIC ? geodesics : nullptr;
    wanted.out_field = distance.data();
    std::vector<hf_extremity> found(n);
    std::uint32_t count = 0;
    call(hf_surface_find_extremities(surface, &wanted, n, found.data(), &count), "hf_surface_find_extremities");
    take(distance.data(), n);
    take(found.data(), count);
  }
  hf_handle_proposals_desc places = desc<hf_handle_proposals_desc>();
  const double joints[6] = {0, 0, 0, 0, 1, 0};
  const std::uint32_t parents[2] = {HF_NO_INDEX, 0};
  places.joint_count = 2;
  places.joints = joints;
  places.parents = parents;
  std::vector<hf_handle_proposal> proposed(HF_HANDLE_LIMIT);
  std::uint32_t proposed_count = 0;
  call(hf_surface_propose_handles(surface, &places, HF_HANDLE_LIMIT, proposed.data(), &proposed_count),
       "hf_surface_propose_handles");
  take(proposed.data(), proposed_count);
  std::vector<std::uint32_t> regions(n);
  places.out_regions = regions.data();
  call(hf_surface_propose_handles(surface, &places, 0, nullptr, &proposed_count),
       "hf_surface_propose_handles, regions");
  take(regions.data(), n);
  hf_geodesics_destroy(geodesics);
  hf_surface_destroy(surface);
}

void Run::directions() {
  const hf_surface surface = make(surface_desc());
  hf_direction_desc wanted = desc<hf_direction_desc>();
  wanted.degree = 4;
  hf_direction direction = nullptr, copy = nullptr;
  call(hf_direction_create(surface, &wanted, &direction), "hf_direction_create");
  hf_surface_destroy(surface);
  const std::uint32_t vertices[4] = {20, 90, 150, 250}, to[1] = {40};
  std::uint32_t sites[4], count = 0;
  call(hf_direction_add_sites(direction, 4, vertices, s.vectors.data(), sites), "hf_direction_add_sites");
  call(hf_direction_move_sites(direction, 1, sites, to), "hf_direction_move_sites");
  call(hf_direction_set_vectors(direction, 1, sites + 1, s.vectors.data() + 9), "hf_direction_set_vectors");
  call(hf_direction_rotate_sites(direction, 2, sites, s.angles.data()), "hf_direction_rotate_sites");
  call(hf_direction_remove_sites(direction, 1, sites + 3), "hf_direction_remove_sites");
  call(hf_direction_clone(direction, &copy), "hf_direction_clone");
  call(hf_direction_solve(copy, OUT(floats.data()), nullptr), "hf_direction_solve");
  take_floats();
  call(hf_direction_solve(direction, OUT(doubles.data()), nullptr), "hf_direction_solve");
  take_doubles();
  std::vector<hf_singularity> found(s.triangle_count);
  call(hf_direction_get_singularities(direction, s.triangle_count, found.data(), &count),
       "hf_direction_get_singularities");
  take(found.data(), count);
  count = hf_direction_get_site_count(direction);
  Numbers held(3 * std::size_t{count});
  call(hf_direction_get_sites(direction, count, sites, places.data(), held.data(), nullptr), "hf_direction_get_sites");
  take(held.data(), held.size());
  hf_direction_statistics statistics = desc<hf_direction_statistics>();
  call(hf_direction_get_statistics(direction, &statistics), "hf_direction_get_statistics");
  take(&statistics.unknown_count, 1);
  hf_direction_destroy(direction);
  hf_direction_destroy(copy);
}

void Run::graph() {
  hf_graph_desc d = desc<hf_graph_desc>();
  const double weights[4] = {1, 0.5, 2, 3};
  const std::uint32_t edges[8] = {0, 1, 1, 2, 2, 3, 0, 3};
  d.vertex_count = n;
  d.edges = HF_ARRAY(edges, 4);
  d.weights = HF_ARRAY(weights, 4);
  d.thread_count = options_.threads;
  if (options_.runner) d.job_runner = *options_.runner;
  if (options_.allocator) d.allocator = *options_.allocator;
  hf_surface surface = nullptr;
  call(hf_surface_create_graph(&d, &surface), "hf_surface_create_graph");
  const hf_solver solver = make_solver(surface);
  const hf_sites_desc sites = sites_at(2, 2);
  call(hf_add_sites(solver, &sites, nullptr), "hf_add_sites on a graph");
  take_field(solver);
  hf_pose pose = nullptr;
  call(hf_pose_create(surface, nullptr, &pose), "hf_pose_create on a graph", HF_ERROR_UNSUPPORTED);
  hf_solver_destroy(solver);
  hf_surface_destroy(surface);
}

void Run::skeletons() {
  // Made once: the sines of the C library follow the rounding that a host may set.
  static const StickMan man = stick_man(1, 0), other = stick_man(1.3f, 35);
  const auto make_man = [&](const StickMan& of) {
    const hf_skin_desc skin = man_skin(&of);
    hf_skeleton_desc d = man_desc(&of, &skin);
    if (options_.allocator) d.allocator = *options_.allocator;
    hf_skeleton skeleton = nullptr;
    call(hf_skeleton_create(&d, &skeleton), "hf_skeleton_create");
    return skeleton;
  };
  const hf_skeleton source = make_man(man), target = make_man(other);
  hf_skeleton_info known = desc<hf_skeleton_info>();
  call(hf_skeleton_get_info(target, &known), "hf_skeleton_get_info");
  take(&known, 1);
  hf_joint_info joints[MAN_JOINTS];
  call(hf_skeleton_get_joints(target, MAN_JOINTS, joints, nullptr), "hf_skeleton_get_joints");
  take(joints, MAN_JOINTS);
  std::uint32_t chain_count = 0, count = 0;
  call(hf_skeleton_get_chains(target, 0, nullptr, &chain_count), "hf_skeleton_get_chains");
  take(&chain_count, 1);
  call(hf_skeleton_get_chain_joints(target, 0, nullptr, &count), "hf_skeleton_get_chain_joints");
  take(&count, 1);
  std::size_t size = 0;
  call(hf_skeleton_get_reasons(target, 0, nullptr, &size), "hf_skeleton_get_reasons");
  take(&size, 1);
  using Pose = std::array<float[10], MAN_JOINTS>;
  static const std::array<Pose, 4> poses = [] {
    std::array<Pose, 4> made{};
    for (int f = 0; f < 4; ++f) man_walk(&man, 0.2f * static_cast<float>(f), made[static_cast<std::size_t>(f)].data());
    return made;
  }();
  float posed[MAN_JOINTS][10];
  double velocity[3];
  call(hf_skeleton_get_ground_velocity(source, 4, poses[0][0], 0.1, velocity), "hf_skeleton_get_ground_velocity");
  take(velocity, 3);
  hf_retarget retarget = nullptr, clone = nullptr;
  call(hf_retarget_create(source, target, nullptr, &retarget), "hf_retarget_create");
  hf_skeleton_destroy(source);
  hf_skeleton_destroy(target);
  for (std::size_t f = 0; f < 3; ++f)
    call(hf_retarget_solve(retarget, poses[f][0], 0.1, posed[0]), "hf_retarget_solve");
  call(hf_retarget_clone(retarget, &clone), "hf_retarget_clone");
  call(hf_retarget_reset(retarget), "hf_retarget_reset");
  call(hf_retarget_solve(clone, poses[3][0], 0.1, posed[0]), "hf_retarget_solve");
  take(posed[0], 10 * MAN_JOINTS);
  hf_retarget_info info = desc<hf_retarget_info>();
  call(hf_retarget_get_info(clone, &info), "hf_retarget_get_info");
  take(&info, 1);
  call(hf_retarget_get_chains(clone, 0, nullptr, &count), "hf_retarget_get_chains");
  take(&count, 1);
  std::uint32_t partners[MAN_JOINTS];
  call(hf_retarget_get_partners(clone, MAN_JOINTS, partners, nullptr), "hf_retarget_get_partners");
  take(partners, MAN_JOINTS);
  hf_retarget_destroy(clone);
  hf_retarget_destroy(retarget);
}

void Run::errors() {
  const std::uint32_t version = hf_version_get();
  take(&version, 1);
  for (hf_result code = -400; code <= 0; ++code) {
    const char* name = hf_result_get_name(code);
    take(name, std::strlen(name));
  }
  call(hf_surface_create(nullptr, nullptr), "hf_surface_create, nothing", HF_ERROR_NULL_POINTER);
  call(hf_create(nullptr, nullptr, nullptr), "hf_create, nothing", HF_ERROR_NULL_POINTER);
  call(hf_solve(nullptr, nullptr, 0, nullptr), "hf_solve, nothing", HF_ERROR_INVALID_OBJECT);
  hf_error_detail detail;
  call(hf_error_get_detail(&detail), "hf_error_get_detail");
  take(&detail.code, 1);
  take(&detail.index, 1);
}

Outcome run_whole_api(const Scene& scene, const Options& options) {
  Run run(scene, options);
  run.outcome.hash = 14695981039346656037u;
  run.surface_and_picking();
  run.solver_and_sites();
  run.other_kinds();
  run.other_engines();
  run.vectors();
  run.factor_and_preview();
  run.analysis();
  run.directions();
  run.pose_and_transfer();
  run.quads_and_flow();
  run.regions();
  run.skin_weights();
  run.graph();
  run.skeletons();
  run.errors();
  return run.outcome;
}

}  // namespace reliability

// hf.hpp: the thin C++ wrapper.
#include <gtest/gtest.h>

#include <cmath>

#include "hf/hf.hpp"

namespace {

struct Strip {
  std::vector<float> positions;
  std::vector<uint32_t> triangles;
  explicit Strip(uint32_t n) {
    for (uint32_t i = 0; i <= n; ++i) positions.insert(positions.end(), {float(i), 0, 0, float(i), 1, 0});
    for (uint32_t i = 0; i < n; ++i)
      triangles.insert(triangles.end(), {2 * i, 2 * i + 2, 2 * i + 1, 2 * i + 1, 2 * i + 2, 2 * i + 3});
  }
};

TEST(Wrapper, solves_edits_and_undoes) {
  const Strip strip(8);
  const hf::Surface surface(strip.positions, strip.triangles);
  hf::Solver solver(surface);
  const auto sites = solver.add_sites({0, 1, 16, 17}, {0, 0, 1, 1});
  EXPECT_FLOAT_EQ(solver.solve()[8], 0.5f);
  EXPECT_DOUBLE_EQ(solver.solve_at({8})[0], solver.solve_f64()[8]);
  hf::History<hf::Solver> history;
  history.record(solver.clone());
  solver.set_values({sites[2], sites[3]}, {2, 2});
  EXPECT_FLOAT_EQ(solver.solve()[8], 1.0f);
  history.undo(solver);
  EXPECT_FLOAT_EQ(solver.solve()[8], 0.5f);
  solver.move_sites({sites[0]}, {2});
  solver.remove_sites({sites[1]});
  EXPECT_EQ(solver.site_count(), 3u);
  EXPECT_EQ(solver.statistics().factorisation_count, 0u);
}

TEST(Wrapper, saves_and_loads_a_factor_and_previews_with_it) {
  const Strip strip(40);
  const hf::Surface surface(strip.positions, strip.triangles);
  hf::Solver made(surface);
  const std::vector<uint8_t> bytes = surface.save();
  auto saved = hf::make<hf_factor_desc>();
  saved.bytes = bytes.data();
  saved.byte_count = bytes.size();
  auto desc = hf::make<hf_surface_desc>();
  desc.positions = HF_ARRAY(strip.positions.data(), strip.positions.size() / 3);
  desc.triangles = HF_ARRAY(strip.triangles.data(), strip.triangles.size() / 3);
  desc.saved_factor = &saved;
  const hf::Surface again(desc);
  EXPECT_EQ(again.statistics().factor_loaded, 1);
  hf::Solver loaded(again);
  made.add_sites({0, 80}, {0, 1});
  loaded.add_sites({0, 80}, {0, 1});
  EXPECT_EQ(made.solve_f64(), loaded.solve_f64());
  auto info = hf::make<hf_preview_info>();
  EXPECT_NEAR(loaded.solve_preview(1, &info)[40], loaded.solve()[40], 1e-6f);
  EXPECT_EQ(info.correction_count, 1u);
  loaded.release_preview();
}

TEST(Wrapper, edits_a_list_of_vertices) {
  const Strip strip(8);
  const hf::Surface surface(strip.positions, strip.triangles);
  hf::Solver solver(surface);
  solver.add_sites({0, 1, 16, 17}, {0, 0, 1, 1});
  hf::SurfaceEdit stroke;
  stroke.vertices = {4, 5};
  stroke.stiffness = {1e4, 1e4};
  const hf::Surface edited = surface.edit(stroke);
  std::vector<double> expected(18, 1.0);
  expected[4] = expected[5] = 1e4;
  EXPECT_EQ(edited.stiffness(), expected);
  stroke.vertices = {4, 5, 6};
  stroke.stiffness = {1, 1, 1};
  EXPECT_EQ(edited.edit(stroke).stiffness(), std::vector<double>(18, 1.0));
  solver.move_to(edited);
  EXPECT_EQ(solver.solve().size(), 18u);
  EXPECT_LT(solver.solve()[4], 0.23f);  // 0.25 before: the field changes less where the surface is stiff
  stroke.stiffness = {1};
  EXPECT_THROW(surface.edit(stroke), std::invalid_argument);
}

TEST(Wrapper, solves_on_a_graph_and_says_what_needs_triangles) {
  hf::GraphOptions graph;
  graph.vertex_count = 4;
  const std::vector<uint32_t> edges = {0, 1, 1, 2, 2, 3};
  const hf::Surface surface = hf::Surface::from_graph(edges, std::vector<double>{1, 1, 2}, graph);
  hf::Solver solver(surface);
  solver.add_sites({0, 3}, {0, 5});
  EXPECT_NEAR(solver.solve_f64()[2], 4, 1e-12);
  EXPECT_EQ(surface.info().operator_kind, HF_OPERATOR_GRAPH);
  EXPECT_EQ(surface.report().component_count, 1u);
  EXPECT_THROW(hf::Surface::from_graph(std::vector<uint32_t>{0, 1, 1}, std::vector<double>{1, 1}, graph),
               std::invalid_argument);
  try {
    const hf::Pose pose(surface);
    FAIL();
  } catch (const hf::Error& error) {
    EXPECT_EQ(error.code(), HF_ERROR_UNSUPPORTED);
  }
}

TEST(Wrapper, directions_follow_their_constraints) {
  const Strip strip(8);
  const hf::Surface surface(strip.positions, strip.triangles);
  hf::Direction direction(surface);
  const auto sites = direction.add_sites({4}, {1, 2, 0});
  std::vector<float> field = direction.solve();  // flat: parallel everywhere
  EXPECT_NEAR(field[3 * 15], 1, 1e-6);
  EXPECT_NEAR(field[3 * 15 + 1], 2, 1e-6);
  EXPECT_TRUE(direction.singularities().empty());
  direction.rotate_sites({sites[0]}, {std::acos(0.0)});
  direction.move_sites({sites[0]}, {9});
  field = direction.solve();
  EXPECT_NEAR(field[3 * 15], -2, 1e-6);
  direction.set_vectors(sites, {3, 0, 0});
  EXPECT_NEAR(direction.solve()[3 * 2], 3, 1e-6);
  EXPECT_THROW(direction.add_sites({1}, {1, 0}), std::invalid_argument);
  direction.remove_sites(sites);
  EXPECT_EQ(direction.site_count(), 0u);
}

TEST(Wrapper, picks_and_reports) {
  const Strip strip(8);
  const hf::Surface surface(strip.positions, strip.triangles);
  EXPECT_EQ(surface.report().component_count, 1u);
  EXPECT_EQ(surface.components(), std::vector<uint32_t>(18, 0));
  const hf_hit hit = surface.cast_ray({3.1, 0.2, 5}, {0, 0, -1});
  EXPECT_EQ(hit.found, 1);
  EXPECT_EQ(hit.vertex, 6u);
  EXPECT_NEAR(hit.distance, 5, 1e-9);
  EXPECT_EQ(surface.cast_ray({3.1, 2, 5}, {0, 0, -1}).found, 0);
  EXPECT_EQ(std::get<0>(surface.find_vertex({8.2, 1.1, 0.3})), 17u);
}

TEST(Wrapper, throws_with_code_and_index) {
  const Strip strip(2);
  const hf::Surface surface(strip.positions, strip.triangles);
  hf::Solver solver(surface);
  try {
    solver.add_sites({0, 99}, {0, 1});
    FAIL();
  } catch (const hf::Error& error) {
    EXPECT_EQ(error.code(), HF_ERROR_OUT_OF_RANGE);
    EXPECT_EQ(error.index(), 1u);
    EXPECT_NE(std::string(error.what()).find("hf_add_sites"), std::string::npos);
  }
  EXPECT_THROW(solver.add_sites({0}, {0, 1}), std::invalid_argument);
  EXPECT_EQ(solver.site_count(), 0u);
}

TEST(Wrapper, handles_move_and_children_outlive_parents) {
  const Strip strip(8);
  auto surface = std::make_unique<hf::Surface>(strip.positions, strip.triangles);
  auto solver = std::make_unique<hf::Solver>(*surface);
  hf::Solver clone = solver->clone();
  hf::Pose pose(*surface);
  hf::Transfer transfer(*surface, *surface);
  surface.reset();
  solver.reset();
  hf::Solver moved = std::move(clone);
  moved.add_sites({0, 17}, {0, 1});
  EXPECT_EQ(moved.solve().size(), 18u);

  const auto handles = pose.add_handles({{0, 1}, {16, 17}});
  const auto rest = pose.deform();
  for (size_t i = 0; i < rest.size(); ++i) EXPECT_NEAR(rest[i], strip.positions[i], 1e-6);
  pose.set_transform(handles[1], {}, {{0, 0, 2}});
  EXPECT_NEAR(pose.clone().deform()[3 * 17 + 2], 2, 1e-6);

  pose.set_transform(handles[0], {}, {{0, 0, 2}});
  pose.deform();
  hf::HandlesOptions in_place;
  in_place.in_place = true;
  const auto still = pose.add_handles({{8, 9}}, in_place);
  EXPECT_NEAR(pose.handle(still[0]).translation[2], 2, 1e-6);
  in_place.points = {6, 0.5, 0};
  in_place.radii = {0.6};
  EXPECT_NEAR(pose.handle(pose.add_handles({}, in_place)[0]).translation[2], 2, 1e-6);
  EXPECT_NEAR(pose.deform()[3 * 8 + 2], 2, 1e-6);

  transfer.add_pairs({{0, 1}, {16, 17}}, {{0, 1}, {16, 17}});
  const auto played = transfer.apply(strip.positions);
  for (size_t i = 0; i < played.size(); ++i) EXPECT_NEAR(played[i], strip.positions[i], 1e-5);
}

TEST(Wrapper, reads_lines_points_distances_and_tips_of_a_strip) {
  const Strip strip(8);
  const hf::Surface surface(strip.positions, strip.triangles);
  hf::Solver solver(surface);
  solver.add_sites({0, 1, 16, 17}, {0, 0, 1, 1});
  const auto field = solver.solve_f64();
  const auto levels = surface.space_levels(field, 3, HF_LEVELS_LENGTH);
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_NEAR(levels[1], 0.5, 1e-9);
  const auto lines = surface.trace_isolines(field, levels);
  EXPECT_EQ(lines.line_levels, (std::vector<uint32_t>{0, 1, 2}));
  EXPECT_EQ(lines.line_closed, (std::vector<int32_t>{0, 0, 0}));
  EXPECT_EQ(lines.positions.size(), 3 * lines.parameters.size());
  int index = 0;
  for (const auto& point : surface.find_critical_points(field)) index += point.index;
  EXPECT_EQ(index, 1);  // a disk
  const hf::Geodesics geodesics(surface);
  const auto distance = geodesics.solve_f64({0, 1});
  EXPECT_NEAR(distance[16], 8, 0.8);
  hf_place from{}, to{};
  to.corners[0] = 16;
  from.barycentrics[0] = to.barycentrics[0] = 1;
  EXPECT_GE(geodesics.find_path(from, to).length, 7.9);  // figures come with the arrays
  const auto tips = surface.find_extremities();
  ASSERT_EQ(tips.size(), 2u);
  EXPECT_NEAR(std::fabs(tips[0].position[0] - tips[1].position[0]), 8, 0.01);
}

// A sheet of 12 x 12 squares with a bump.
struct Sheet {
  std::vector<float> positions;
  std::vector<uint32_t> triangles;
  Sheet() {
    for (uint32_t j = 0; j < 13; ++j)
      for (uint32_t i = 0; i < 13; ++i)
        positions.insert(positions.end(), {float(i), float(j), i > 4 && i < 8 && j > 4 && j < 8 ? 1.0f : 0.0f});
    for (uint32_t j = 0; j < 12; ++j)
      for (uint32_t i = 0; i < 12; ++i) {
        const uint32_t v = 13 * j + i;
        triangles.insert(triangles.end(), {v, v + 1, v + 14, v, v + 14, v + 13});
      }
  }
};

TEST(Wrapper, quads_are_made_again_along_a_stroke_and_around_a_pole) {
  const Sheet sheet;
  const hf::Surface surface(sheet.positions, sheet.triangles);
  auto desc = hf::make<hf_quads_desc>();
  desc.face_count = 100;
  hf::Quads quads(surface, desc);
  const hf::QuadsMesh plain = quads.mesh();
  EXPECT_EQ(plain.positions, hf::Quads(surface, desc).mesh().positions);
  const uint32_t place = 13 * 2 + 6;
  const double along[3] = {1, 1, 0};
  auto stroke = desc;
  stroke.guide_count = 1;
  stroke.guide_vertices = &place;
  stroke.guide_vectors = along;
  stroke.relax_count = HF_NO_INDEX;
  quads.update(stroke);
  EXPECT_NE(quads.mesh().positions, plain.positions);
  EXPECT_EQ(quads.mesh().faces.size(), size_t{4} * quads.info().face_count);
  stroke.relax_count = 0;
  quads.update(stroke);
  const hf::QuadsMesh guided = quads.mesh();
  EXPECT_EQ(guided.positions, hf::Quads(surface, stroke).mesh().positions);
  stroke.relax_count = 1001;
  EXPECT_THROW(quads.update(stroke), hf::Error);
  EXPECT_EQ(quads.mesh().positions, guided.positions);
  auto pole = desc;
  const double at[3] = {9, 9, 0};
  const uint32_t three = 3, four = 4;
  pole.irregular_count = 1;
  pole.irregular_points = at;
  pole.irregular_valences = &three;
  quads.update(pole);
  EXPECT_EQ(quads.mesh().positions, hf::Quads(surface, pole).mesh().positions);
  EXPECT_NE(quads.mesh().positions, plain.positions);
  pole.irregular_valences = &four;
  EXPECT_THROW(quads.update(pole), hf::Error);
  quads.update(desc);
  EXPECT_EQ(quads.mesh().positions, plain.positions);
}

TEST(Wrapper, regions_morph_and_hand_their_detail_on) {
  const Sheet sheet;
  const std::vector<float>& positions = sheet.positions;
  const hf::Surface surface(positions, sheet.triangles);
  hf::RegionOptions membrane;
  membrane.positions = positions;
  membrane.base = HF_BASE_MEMBRANE;
  hf::Region region(surface, membrane);
  hf::RegionEditOptions enclose;
  enclose.curve = hf::Curve{{13 * 3 + 3, 13 * 3 + 9, 13 * 9 + 9, 13 * 9 + 3}};
  region.edit(enclose);
  EXPECT_EQ(region.info().vertex_count, 25u);
  EXPECT_GT(region.curve().size(), 3u * 4u);
  EXPECT_EQ(region.vertices(HF_REGION_RIM).size(), region.info().rim_count);
  EXPECT_EQ(region.morph(0), positions);
  std::vector<float> normals;
  const std::vector<float> flat = region.morph(1, &normals);
  const size_t middle = 3 * (13 * 6 + 6);
  EXPECT_NEAR(flat[middle + 2], 0, 1e-6f);
  EXPECT_NEAR(normals[middle + 2], 1, 1e-6f);
  const hf::Detail detail(region, region);
  const std::vector<float> back = detail.morph(1);
  for (size_t i = 0; i < back.size(); ++i) EXPECT_NEAR(back[i], positions[i], 1e-5f);
  hf::History<hf::Region> edits;
  edits.record(region.clone());
  hf::RegionEditOptions grow;
  grow.ring_count = 1;
  region.edit(grow);
  EXPECT_EQ(region.statistics().factorisation_count, 0u);
  const hf::Region grown = region.clone();
  edits.undo(region);
  EXPECT_LT(region.info().vertex_count, grown.info().vertex_count);
  edits.redo(region);
  hf::RegionEditOptions remove, add;
  remove.remove_vertices = {13 * 6 + 6};
  region.edit(remove);
  add.add_vertices = {13 * 6 + 6};
  region.edit(add);
  EXPECT_EQ(region.info().vertex_count, grown.info().vertex_count);
  enclose.curve = hf::Curve{{0, 1}};
  EXPECT_THROW(region.edit(enclose), hf::Error);
}

}  // namespace

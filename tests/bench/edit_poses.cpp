// Strokes of stiffness with a pose drawn: hf_surface_edit of 30 vertices, hf_pose_move_to and hf_deform, 50K vertices
// and eight handles, one of them dragged. Dabs are at another place of the surface as made every time. A line goes on:
// each of its dabs edits the surface of the dab before.
#include <cmath>
#include <cstdio>

#include "bench/bench_mesh.h"
#include "bench/commands.h"
#include "bench/strokes.h"

namespace bench {
namespace {

constexpr double half_turn = 3.14159265358979323846;
constexpr uint32_t dab = 30, handle_count = 8;

// Eight handles: discs round the outer equator of the torus, proposed ones on the creature.
hf_pose pose_on(const Mesh& mesh, hf_surface surface, Family family) {
  double points[handle_count][3], radii[handle_count];
  uint32_t count = handle_count;
  if (family == Family::torus) {
    for (uint32_t i = 0; i < count; ++i) {
      const double turn = 2 * half_turn * i / count;
      points[i][0] = 1.4 * std::cos(turn);
      points[i][1] = 0;
      points[i][2] = 1.4 * std::sin(turn);
      radii[i] = 0.13;
    }
  } else {
    hf_handle_proposals_desc desc = HF_INIT(hf_handle_proposals_desc);
    desc.limit = count;
    hf_handle_proposal proposals[handle_count];
    check(hf_surface_propose_handles(surface, &desc, count, proposals, &count));
    count = std::min(count, handle_count);
    for (uint32_t i = 0; i < count; ++i) {
      std::copy_n(proposals[i].position, 3, points[i]);
      radii[i] = proposals[i].radius;
    }
  }
  hf_pose pose = nullptr;
  check(hf_pose_create(surface, nullptr, &pose));
  hf_handles_desc handles = HF_INIT(hf_handles_desc);
  handles.handle_count = count;
  handles.points = points[0];
  handles.radii = radii;
  uint32_t numbers[handle_count];
  check(hf_pose_add_handles(pose, &handles, numbers));
  const hf_transform lifted = {{std::sin(0.15), 0, 0, std::cos(0.15)}, {0, 0.1, 0}};
  check(hf_pose_set_transform(pose, numbers[1], &lifted));
  std::vector<float> positions(3 * static_cast<size_t>(mesh.vertex_count()));
  for (int frame = 0; frame < 30; ++frame) check(hf_deform(pose, positions.data(), nullptr));
  return pose;
}

struct StrokeTimes {
  std::vector<double> edit, move, frame, all;
  // hf_surface_edit, hf_pose_move_to and hf_deform of one dab.
  hf_surface take(hf_surface surface, hf_pose pose, const std::vector<uint32_t>& vertices, std::vector<float>& out) {
    hf_surface stiff = nullptr;
    edit.push_back(time_ms([&] { stiff = stiffened(surface, vertices, 50); }));
    move.push_back(time_ms([&] { check(hf_pose_move_to(pose, stiff)); }));
    frame.push_back(time_ms([&] { check(hf_deform(pose, out.data(), nullptr)); }));
    all.push_back(edit.back() + move.back() + frame.back());
    return stiff;
  }
};

nlohmann::json poses_on(const Mesh& mesh, Family family, const Run& run, Report& report) {
  const auto neighbours = neighbours_of(mesh);
  const Solver solver(mesh, own_defaults(run.threads));
  const hf_pose pose = pose_on(mesh, solver.surface(), family);
  std::vector<float> positions(3 * static_cast<size_t>(mesh.vertex_count()));
  StrokeTimes dabs, line;
  for (uint32_t r = 0; r < 6 * run.repetitions; ++r) {
    const uint32_t centre = scattered_vertices(mesh.vertex_count(), 1, 100 + r)[0];
    hf_surface_destroy(dabs.take(solver.surface(), pose, patch(neighbours, centre, dab), positions));
  }
  // along edges, from a dab to the vertex of it that was reached last
  hf_surface surface = solver.surface();
  uint32_t centre = scattered_vertices(mesh.vertex_count(), 1, 7)[0];
  for (uint32_t r = 0; r < 6 * run.repetitions; ++r) {
    const std::vector<uint32_t> stroke = patch(neighbours, centre, dab);
    const hf_surface next = line.take(surface, pose, stroke, positions);
    if (surface != solver.surface()) hf_surface_destroy(surface);
    surface = next;
    centre = stroke.back();
  }
  if (surface != solver.surface()) hf_surface_destroy(surface);
  hf_pose_destroy(pose);
  for (const auto& [name, times] : {std::pair<const char*, StrokeTimes*>{"dabs", &dabs}, {"a line", &line}})
    std::printf("%-16s %s: edit %6.2f ms, move %6.2f, frame %6.2f, in all %6.2f = %5.1f strokes a second\n",
                mesh.name.c_str(), name, median(times->edit), median(times->move), median(times->frame),
                median(times->all), 1000 / median(times->all));
  report.measure("strokes_posed", mesh.name, run.threads, 1000 / median(dabs.all));
  return {{"name", mesh.name + " posed"},
          {"n", mesh.vertex_count()},
          {"stroke_edit_ms", median(dabs.edit)},
          {"stroke_move_ms", median(dabs.move)},
          {"stroke_frame_ms", median(dabs.frame)},
          {"strokes_a_second", 1000 / median(dabs.all)},
          {"line_strokes_a_second", 1000 / median(line.all)}};
}

}  // namespace

void run_edit_poses(const Run& run, Report& report, Rows& rows) {
  for (const Family family : families) {
    const auto mesh = make_mesh(family, run.small ? 3000u : 50000u);
    if (run.wants(mesh->name)) rows.push_back(poses_on(*mesh, family, run, report));
  }
}

}  // namespace bench

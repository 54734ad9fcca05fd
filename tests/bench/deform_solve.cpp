// A frame for a shader beside a frame of hf_deform: hf_pose_solve and hf_pose_get_blend_transforms write transforms of
// clusters and no vertex. Both poses are dragged alike, in turns, so that a noisy minute of the machine falls on both.
// Times are processor time of the process: what a game has less of.
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>

#include "bench/commands.h"

namespace bench {
namespace {

struct Box {
  double low[3], high[3];
  explicit Box(const Mesh& mesh) {
    for (int c = 0; c < 3; ++c) {
      low[c] = std::numeric_limits<double>::max();
      high[c] = -low[c];
    }
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
      low[i % 3] = std::min(low[i % 3], mesh.positions[i]);
      high[i % 3] = std::max(high[i % 3], mesh.positions[i]);
    }
  }
  double diagonal() const { return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]); }
};

// Vertices far apart: each is the farthest from those before it. On a creature they are its feet, tail and head.
std::vector<double> far_places(const Mesh& mesh, uint32_t count) {
  std::vector<double> away(mesh.vertex_count(), std::numeric_limits<double>::max()), places;
  uint32_t last = 0;
  for (uint32_t i = 0; i <= count; ++i) {
    const double* from = &mesh.positions[3 * static_cast<size_t>(last)];
    if (i > 0) places.insert(places.end(), from, from + 3);
    uint32_t farthest = 0;
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
      const double* p = &mesh.positions[3 * static_cast<size_t>(v)];
      const double d = std::hypot(p[0] - from[0], p[1] - from[1], p[2] - from[2]);
      away[v] = i > 0 ? std::min(away[v], d) : d;  // vertex 0 only shows where to begin
      if (away[v] > away[farthest]) farthest = v;
    }
    last = farthest;
  }
  return places;
}

template <class Work>
double processor_ms(Work&& work) {
  const std::clock_t before = std::clock();
  work();
  return 1e3 * static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
}

hf_pose pose_of(const Mesh& mesh, const Solver& solver, uint32_t count, std::vector<uint32_t>& handles) {
  constexpr double disc = 0.03;  // radius of a handle, as a share of the box
  const std::vector<double> places = far_places(mesh, count), radii(count, disc * Box(mesh).diagonal());
  hf_pose pose = nullptr;
  check(hf_pose_create(solver.surface(), nullptr, &pose));
  hf_handles_desc desc = HF_INIT(hf_handles_desc);
  desc.handle_count = count;
  desc.points = places.data();
  desc.radii = radii.data();
  handles.resize(count);
  check(hf_pose_add_handles(pose, &desc, handles.data()));
  return pose;
}

}  // namespace

nlohmann::json solve_without_vertices(const Mesh& mesh, const Run& run, Report& report) {
  constexpr uint32_t frames = 200, handle_count = 8;
  const Solver solver(mesh, own_defaults(run.threads));
  std::vector<uint32_t> handles;
  hf_pose solved = pose_of(mesh, solver, handle_count, handles), deformed = nullptr, hurried = nullptr;
  check(hf_pose_clone(solved, &deformed));
  check(hf_pose_clone(solved, &hurried));
  hf_blend_info blend = HF_INIT(hf_blend_info);
  check(hf_pose_get_blend_info(solved, &blend));
  std::vector<float> transforms(12 * static_cast<size_t>(blend.cluster_count)), positions(mesh.positions.size());
  const double reach = 0.1 * Box(mesh).diagonal();
  std::vector<double> solve, deform, short_solve, iterations;
  for (uint32_t f = 0; f < frames; ++f) {
    const double t = std::sin(0.1 * (f + 1));
    const hf_transform to = {{std::sin(0.3 * t), 0, 0, std::cos(0.3 * t)}, {0, reach * t, 0}};
    hf_deform_info info = HF_INIT(hf_deform_info);
    solve.push_back(processor_ms([&] {
      check(hf_pose_set_transform(solved, handles[1], &to));
      check(hf_pose_solve(solved, 0, 0, &info));
      check(hf_pose_get_blend_transforms(solved, blend.cluster_count, transforms.data(), nullptr));
    }));
    deform.push_back(processor_ms([&] {
      check(hf_pose_set_transform(deformed, handles[1], &to));
      check(hf_deform(deformed, positions.data(), nullptr));
    }));
    short_solve.push_back(processor_ms([&] {
      check(hf_pose_set_transform(hurried, handles[1], &to));
      check(hf_pose_solve(hurried, 2, 0, nullptr));
      check(hf_pose_get_blend_transforms(hurried, blend.cluster_count, transforms.data(), nullptr));
    }));
    iterations.push_back(info.iteration_count);
  }
  hf_pose_destroy(solved);
  hf_pose_destroy(deformed);
  hf_pose_destroy(hurried);
  std::printf(
      "%-13s %u handles: solve without vertices %6.3f ms, with 2 iterations %6.3f ms, hf_deform %6.3f ms; %.0f "
      "iterations, %u clusters = %.1f kB a frame\n",
      mesh.name.c_str(), handle_count, median(solve), median(short_solve), median(deform), median(iterations),
      blend.cluster_count, 0.048 * blend.cluster_count);
  std::fflush(stdout);
  if (mesh.name == "50K_torus") {
    report.measure("solve_frame", mesh.name, run.threads, median(solve));
    report.measure("solve_bytes", mesh.name, run.threads, 0.048 * blend.cluster_count);
  }
  return {{"solve_without_vertices_ms", median(solve)},
          {"two_iterations_ms", median(short_solve)},
          {"hf_deform_ms", median(deform)},
          {"clusters", blend.cluster_count}};
}

}  // namespace bench

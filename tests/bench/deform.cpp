// Posing: what a drag frame, a new handle and a refined frame cost, beside one as-rigid-as-possible iteration of the
// full mesh with a prefactored system and beside making fields and bands anew; allocations while dragging; exactness.
//
// The surface is the jittered torus with handles round it; a drag turns and lifts one of them. Times are user visible:
// hf_pose_deform with positions in single precision and normals, the default ten iterations a frame.
#include <cmath>
#include <cstdio>

#include "bench/bench_mesh.h"
#include "bench/commands.h"
#include "bench/svg_plot.h"
#include "deform/pose_stack.h"
#include "support/arap_oracle.h"
#include "support/arrays.h"
#include "support/meshes.h"
#include "support/pose_modes.h"

namespace bench {
namespace {

constexpr double pi = 3.14159265358979323846;

// Discs round the outer equator of the torus, a sixth of its tube's diameter across.
std::vector<std::vector<uint32_t>> regions_of(const Mesh& mesh, uint32_t count) {
  std::vector<std::vector<uint32_t>> regions(count);
  for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const double* p = &mesh.positions[3 * static_cast<size_t>(v)];
    for (uint32_t i = 0; i < count; ++i) {
      const double turn = 2 * pi * i / count;
      if (std::hypot(p[0] - 1.4 * std::cos(turn), p[1], p[2] - 1.4 * std::sin(turn)) < 0.13) regions[i].push_back(v);
    }
  }
  return regions;
}

// Bands right round the tube, at the same places: their rings are long, hundreds of sites each.
std::vector<std::vector<uint32_t>> bands_of(const Mesh& mesh, uint32_t count) {
  std::vector<std::vector<uint32_t>> regions(count);
  for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const double* p = &mesh.positions[3 * static_cast<size_t>(v)];
    for (uint32_t i = 0; i < count; ++i) {
      if (std::fabs(std::remainder(std::atan2(p[2], p[0]) - 2 * pi * i / count, 2 * pi)) < 0.06)
        regions[i].push_back(v);
    }
  }
  return regions;
}

class Rig {
 public:
  Rig(const Mesh& mesh, const Solver& solver, const std::vector<std::vector<uint32_t>>& regions, int mode = 0)
      : positions(3 * static_cast<size_t>(mesh.vertex_count())), normals(positions.size()) {
    check(create_pose_with(mode, solver.surface(), nullptr, &pose));
    handles = add(regions, 0);
  }
  ~Rig() { hf_pose_destroy(pose); }
  Rig(const Rig&) = delete;
  Rig& operator=(const Rig&) = delete;

  std::vector<uint32_t> add(const std::vector<std::vector<uint32_t>>& regions, uint32_t layer) {
    std::vector<uint32_t> counts, vertices, out(regions.size());
    for (const auto& region : regions) {
      counts.push_back(static_cast<uint32_t>(region.size()));
      vertices.insert(vertices.end(), region.begin(), region.end());
    }
    hf_handles_desc desc = HF_INIT(hf_handles_desc);
    desc.handle_count = static_cast<uint32_t>(regions.size());
    desc.layer = layer;
    desc.region_counts = counts.data();
    desc.region_vertices = vertices.data();
    check(hf_pose_add_handles(pose, &desc, out.data()));
    return out;
  }
  void move(uint32_t handle, double t) {
    hf_transform transform = {{std::sin(0.3 * t), 0, 0, std::cos(0.3 * t)}, {0, 0.2 * t, 0}};
    check(hf_pose_set_transforms(pose, 1, &handle, &transform));
  }
  hf_pose_statistics deform(bool refine = false) {
    hf_deform_desc desc = HF_INIT(hf_deform_desc);
    desc.positions = ROWS_OUT(positions.data());
    desc.normals = ROWS_OUT(normals.data());
    desc.refine = refine;
    check(hf_pose_deform(pose, &desc, nullptr));
    hf_pose_statistics times = HF_INIT(hf_pose_statistics);
    check(hf_pose_get_statistics(pose, &times));
    return times;
  }

  hf_pose pose = nullptr;
  std::vector<uint32_t> handles;
  std::vector<float> positions, normals;
};

struct FrameTimes {
  std::vector<double> frame, solve, blend, normal, refine;
};

FrameTimes drag(Rig& rig, uint32_t frames, bool refine) {
  FrameTimes out;
  for (uint32_t f = 0; f < frames; ++f) {
    hf_pose_statistics info;
    out.frame.push_back(time_ms([&] {
      rig.move(rig.handles[1], std::sin(0.1 * (f + 1)));
      info = rig.deform(refine);
    }));
    out.solve.push_back(info.solve_ms);
    out.blend.push_back(info.blend_ms);
    out.normal.push_back(info.normal_ms);
    out.refine.push_back(info.refine_ms);
  }
  return out;
}

std::shared_ptr<const hf_inner::surface::Core> core_of(const Mesh& mesh, uint32_t threads) {
  return hf_test::make_core({mesh.positions, mesh.triangles}, threads);
}

double arap_iteration_ms(const Mesh& mesh, const std::vector<std::vector<uint32_t>>& regions, const Run& run) {
  hf_inner::surface::CoreOptions own_edges;  // the oracle's energy is that of the mesh's own edges
  own_edges.operator_kind = hf_inner::mesh::OperatorKind::cotangent;
  const auto core = hf_test::make_core({mesh.positions, mesh.triangles}, run.threads, own_edges);
  std::vector<uint8_t> fixed(static_cast<size_t>(core->size()), 0);
  for (const auto& region : regions) {
    for (const uint32_t v : region) fixed[static_cast<size_t>(core->mesh.inner_of_given[v])] = 1;
  }
  hf_test::ArapOracle oracle(*core, fixed);
  std::vector<hf_inner::Vec3> x(core->mesh.positions.begin(), core->mesh.positions.end());
  for (size_t v = 0; v < x.size(); ++v) {
    if (fixed[v]) x[v].y += 0.02 * x[v].x;
  }
  oracle.iterate(x);
  return median_ms(std::max(3u, run.repetitions), [&] { oracle.iterate(x); });
}

// From nothing: operator, factor, fields, bands, first frame, with the handle there.
double scratch_ms(const Mesh& mesh, const std::vector<std::vector<uint32_t>>& regions, const Run& run) {
  return median_ms(std::min(3u, run.repetitions), [&] {
    const Solver solver(mesh, own_defaults(run.threads));
    Rig rig(mesh, solver, regions);
    rig.move(rig.handles[1], 0.5);
    rig.deform();
  });
}

struct Added {
  double first_frame = 0, on_layer = 0;
};

Added add_ms(const Mesh& mesh, const Solver& solver, std::vector<std::vector<uint32_t>> regions, const Run& run,
             int mode = POSE_SMOOTH) {
  const std::vector<std::vector<uint32_t>> last{regions.back()};
  regions.pop_back();
  Rig rig(mesh, solver, regions, mode);
  rig.move(rig.handles[1], 0.5);
  for (int i = 0; i < 10; ++i) rig.deform();
  std::vector<double> base, layer;
  for (uint32_t r = 0; r < std::max(3u, run.repetitions); ++r) {
    for (const uint32_t to : {0u, 1u}) {
      std::vector<uint32_t> added;
      (to == 0 ? base : layer).push_back(time_ms([&] {
        added = rig.add(last, to);
        rig.deform();
      }));
      check(hf_pose_remove_handles(rig.pose, 1, added.data()));
      rig.deform();
    }
  }
  return {median(base), median(layer)};
}

// ---- exactness, on the inner pose, whose memory counts allocations ----

struct Exactness {
  double target = 0, jump = 0, rigid = 0;
  uint64_t allocations = 0;
};

Exactness exactness(const Mesh& mesh, const std::vector<std::vector<uint32_t>>& regions, uint32_t threads,
                    hf_test::DeformMode mode = hf_test::DeformMode::smooth) {
  using hf_inner::Vec3;
  const auto core = core_of(mesh, threads);
  hf_inner::deform::PoseOptions options;
  options.scheme = hf_test::scheme_of(mode);
  const auto pose = hf_inner::deform::PoseStack::make(core, options);
  const auto add = [&](size_t first, size_t last, uint32_t layer) {
    std::vector<uint32_t> start{0}, numbers(last - first);
    std::vector<int32_t> vertices;
    for (size_t r = first; r < last; ++r) {
      for (const uint32_t v : regions[r]) vertices.push_back(core->mesh.inner_of_given[v]);
      start.push_back(static_cast<uint32_t>(vertices.size()));
    }
    pose->add_handles(start, vertices, layer, numbers);
    return numbers;
  };
  const std::vector<uint32_t> handles = add(0, regions.size() - 1, 0);
  const auto put = [&](uint32_t handle, const hf_inner::deform::HandleTransform& t) {
    pose->set_transforms({&handle, 1}, {&t, 1});
  };
  const double diagonal = core->mesh.scale;
  Exactness out;
  const hf_inner::deform::HandleTransform moved{hf_inner::deform::exponential({0.4, 0.2, 0}), {0.1, 0.3, 0}};
  put(handles[1], moved);
  hf_inner::deform::DeformRequest request;
  request.normals = true;
  hf_inner::deform::DeformReport report = pose->deform(request);
  const Vec3 centroid = pose->handle(handles[1]).centroid;
  for (const uint32_t v : regions[1]) {
    const int32_t i = core->mesh.inner_of_given[v];
    const Vec3 p = core->mesh.to_given(core->mesh.positions[i]);
    const Vec3 target = hf_inner::deform::rotate(moved.rotation, p - centroid) + centroid + moved.translation;
    out.target = std::max(out.target, hf_inner::norm(report.positions[i] - target) / diagonal);
  }
  const uint64_t before = core->memory->allocation_count();
  for (int frame = 0; frame < 1000; ++frame) {
    const double t = std::sin(0.02 * frame);
    put(handles[1], {hf_inner::deform::exponential({0.4 * t, 0.2, 0}), {0.1, 0.3 * t, 0}});
    request.iteration_count = 1;
    pose->deform(request);
  }
  out.allocations = core->memory->allocation_count() - before;
  request.iteration_count = 0;
  for (int i = 0; i < 30; ++i) report = pose->deform(request);
  const std::vector<Vec3> settled(report.positions.begin(), report.positions.end());
  const std::vector<uint32_t> fine = add(regions.size() - 1, regions.size(), 1);
  report = pose->deform(request);
  for (size_t v = 0; v < settled.size(); ++v)
    out.jump = std::max(out.jump, hf_inner::norm(report.positions[v] - settled[v]) / diagonal);
  pose->remove_handles(fine);
  const hf_inner::deform::Quaternion turn = hf_inner::deform::exponential({0.3, 0.9, -0.5});
  for (const uint32_t h : handles) {
    const Vec3 c = pose->handle(h).centroid;
    put(h, {turn, hf_inner::deform::rotate(turn, c) - c + Vec3{1, 2, 3}});
  }
  request.restart = true;  // every handle has turned as far as the others
  report = pose->deform(request);
  for (int32_t v = 0; v < core->size(); ++v) {
    const Vec3 p = core->mesh.to_given(core->mesh.positions[v]);
    out.rigid = std::max(
        out.rigid, hf_inner::norm(report.positions[v] - hf_inner::deform::rotate(turn, p) - Vec3{1, 2, 3}) / diagonal);
  }
  return out;
}

// The same figures by the paper's scheme, which has no bars: 200 iterations a frame, all that it takes to arrive.
nlohmann::json run_paper_mode(const Mesh& mesh, const Solver& solver, const std::vector<std::vector<uint32_t>>& regions,
                              const Run& run, double arap) {
  Rig rig(mesh, solver, regions, POSE_PAPER);
  rig.deform();
  const FrameTimes frames = drag(rig, 2 * run.repetitions, false);
  const Added added = add_ms(mesh, solver, regions, run, POSE_PAPER);
  const Exactness exact = exactness(mesh, regions, run.threads, hf_test::DeformMode::paper);
  const double frame = median(frames.frame);
  std::printf(
      "%-12s the paper's scheme, 4 handles: frame %6.2f ms (solve %5.2f), one ARAP iteration = %.1f frames; a handle "
      "more and the first frame %6.1f ms; off target %.1e, jump %.1e, rigid motion %.1e; %llu allocations\n",
      mesh.name.c_str(), frame, median(frames.solve), arap / frame, added.first_frame, exact.target, exact.jump,
      exact.rigid, static_cast<unsigned long long>(exact.allocations));
  std::fflush(stdout);
  return {{"frame_ms", frame},
          {"solve_ms", median(frames.solve)},
          {"add_ms", added.first_frame},
          {"target", exact.target},
          {"jump", exact.jump},
          {"rigid", exact.rigid},
          {"allocations", exact.allocations}};
}

}  // namespace

Rows run_deform(const Run& run, Report& report) {
  Rows rows = Rows::array();
  for (const Size size : {Size::k42, Size::k84, Size::k304}) {
    if (run.small && size != Size::k84) continue;
    const auto mesh = make_mesh(Family::torus, size, run.small);
    if (!run.wants(mesh->name)) continue;
    const Solver solver(*mesh, own_defaults(run.threads));
    nlohmann::json row = {{"name", mesh->name}, {"n", mesh->vertex_count()}};
    for (const uint32_t handles : {2u, 4u}) {
      const auto regions = regions_of(*mesh, handles);
      Rig rig(*mesh, solver, regions);
      rig.deform(true);
      const FrameTimes plain = drag(rig, 20 * run.repetitions, false), refined = drag(rig, 2 * run.repetitions, true);
      check(hf_pose_set_free_rotations(rig.pose, 1, &rig.handles[1], 1));
      const FrameTimes free = drag(rig, 20 * run.repetitions, false);
      const double n = mesh->vertex_count(), frame = median(plain.frame);
      std::printf(
          "%-12s %u handles: frame %6.2f ms (solve %5.2f, blend %5.2f = %4.1f ns a vertex, normals %5.2f), refined "
          "%6.2f ms (%.2f us a vertex), with a free rotation %6.2f ms (solve %5.2f)\n",
          mesh->name.c_str(), handles, frame, median(plain.solve), median(plain.blend), 1e6 * median(plain.blend) / n,
          median(plain.normal), median(refined.frame), 1e3 * median(refined.refine) / n, median(free.frame),
          median(free.solve));
      std::fflush(stdout);
      const std::string key = "handles_" + std::to_string(handles);
      row[key] = {{"frame_ms", frame},
                  {"solve_ms", median(plain.solve)},
                  {"blend_ms", median(plain.blend)},
                  {"normal_ms", median(plain.normal)},
                  {"refined_frame_ms", median(refined.frame)},
                  {"refine_ms", median(refined.refine)},
                  {"free_frame_ms", median(free.frame)}};
      if (handles == 2) continue;
      const bool counted = size == Size::k84 ? run.threads == 1 : size == Size::k304 && run.threads == 2;
      char note[64];
      std::snprintf(note, sizeof note, "refined %.1f ms", median(refined.frame));
      if (counted) report.measure("deform_frame", mesh->name, run.threads, frame, note);
      if (size == Size::k304) continue;
      const double arap = arap_iteration_ms(*mesh, regions, run);
      const Added added = add_ms(*mesh, solver, regions, run);
      const double scratch = scratch_ms(*mesh, regions, run);
      std::printf(
          "%-12s one ARAP iteration %6.1f ms = %.0f frames; a handle more and the first frame %6.1f ms, on a layer "
          "%6.1f ms, all from scratch %6.1f ms = %.1fx\n",
          mesh->name.c_str(), arap, arap / frame, added.first_frame, added.on_layer, scratch,
          scratch / added.first_frame);
      std::fflush(stdout);
      row["arap_iteration_ms"] = arap;
      row["add_ms"] = added.first_frame;
      row["add_on_layer_ms"] = added.on_layer;
      row["scratch_ms"] = scratch;
      if (size != Size::k84) continue;
      report.measure("deform_arap", mesh->name, run.threads, arap / frame);
      report.measure("deform_add", mesh->name, run.threads, scratch / added.first_frame);
      const auto bands = bands_of(*mesh, handles);
      const double band_added = add_ms(*mesh, solver, bands, run).first_frame,
                   band_scratch = scratch_ms(*mesh, bands, run);
      std::printf(
          "%-12s handles right round the tube: one more and the first frame %6.1f ms, all from scratch %6.1f ms = "
          "%.1fx\n",
          mesh->name.c_str(), band_added, band_scratch, band_scratch / band_added);
      std::fflush(stdout);
      report.measure("deform_add", mesh->name + ", bands", run.threads, band_scratch / band_added);
      row["bands_add_ms"] = band_added;
      row["bands_scratch_ms"] = band_scratch;
      const Exactness exact = exactness(*mesh, regions, run.threads);
      std::printf(
          "%-12s handles off target %.1e, insertion jump %.1e, common rigid motion %.1e of the box; %llu "
          "allocations in 1,000 frames\n",
          mesh->name.c_str(), exact.target, exact.jump, exact.rigid,
          static_cast<unsigned long long>(exact.allocations));
      report.measure("deform_target", mesh->name, run.threads, exact.target);
      report.measure("deform_jump", mesh->name, run.threads, exact.jump);
      report.measure("deform_rigid", mesh->name, run.threads, exact.rigid);
      report.measure("deform_allocations", mesh->name, run.threads, static_cast<double>(exact.allocations));
      row["target"] = exact.target;
      row["jump"] = exact.jump;
      row["rigid"] = exact.rigid;
      row["allocations"] = exact.allocations;
      row["paper"] = run_paper_mode(*mesh, solver, regions, run, arap);
    }
    rows.push_back(row);
  }
  std::vector<std::shared_ptr<const Mesh>> meshes;
  for (const uint32_t vertices : {5000u, 50000u, 300000u}) meshes.push_back(make_mesh(Family::torus, vertices));
  meshes.push_back(make_mesh(Family::creature, 50000));
  if (run.small) meshes = {make_mesh(Family::torus, Size::k84, true)};
  for (const auto& mesh : meshes) {
    if (!run.wants(mesh->name)) continue;
    nlohmann::json row = {{"name", mesh->name + ", no vertices"}, {"n", mesh->vertex_count()}};
    row["handles_8"] = solve_without_vertices(*mesh, run, report);
    rows.push_back(row);
  }
  return rows;
}

void plot_deform(const Runs& runs, const std::string& file) {
  CurvePlot plot;
  plot.text = {"A drag frame", "jittered tori, four handles, positions and normals, medians", "vertices", "ms"};
  for (const nlohmann::json& run : runs) {
    Curve frame{"frame, " + threads_text(run.at("threads")), {}},
        refined{"refined, " + threads_text(run.at("threads")), {}};
    for (const nlohmann::json& row : run.at("rows")) {
      frame.points.emplace_back(number_of(row, "/n"), number_of(row, "/handles_4/frame_ms"));
      refined.points.emplace_back(number_of(row, "/n"), number_of(row, "/handles_4/refined_frame_ms"));
    }
    plot.curves.push_back(frame);
    plot.curves.push_back(refined);
  }
  write_svg(file, plot);
}

}  // namespace bench

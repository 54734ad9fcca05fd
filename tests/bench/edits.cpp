// A stroke that makes a patch of vertices stiff, and the field of ten sites after it, beside a fresh surface that does
// the same. The stroke: hf_surface_edit, hf_solver_move_to and the field, at another place every time.
#include <algorithm>
#include <cstdio>

#include "bench/bench_mesh.h"
#include "bench/commands.h"
#include "bench/svg_plot.h"

namespace bench {
namespace {

// The first `count` vertices around one, ring by ring.
std::vector<uint32_t> patch(const std::vector<std::vector<uint32_t>>& neighbours, uint32_t centre, uint32_t count) {
  std::vector<uint32_t> list(1, centre);
  std::vector<bool> seen(neighbours.size(), false);
  seen[centre] = true;
  for (std::size_t i = 0; i < list.size() && list.size() < count; ++i) {
    for (const uint32_t v : neighbours[list[i]]) {
      if (seen[v] || list.size() >= count) continue;
      seen[v] = true;
      list.push_back(v);
    }
  }
  return list;
}

std::vector<std::vector<uint32_t>> neighbours_of(const Mesh& mesh) {
  std::vector<std::vector<uint32_t>> out(mesh.vertex_count());
  for (std::size_t c = 0; c < mesh.triangles.size(); ++c)
    out[mesh.triangles[c]].push_back(mesh.triangles[c % 3 == 2 ? c - 2 : c + 1]);
  return out;
}

hf_surface edited(hf_surface surface, const std::vector<uint32_t>& vertices, double s) {
  const std::vector<double> stiffness(vertices.size(), s);
  hf_surface_edit_desc desc = HF_INIT(hf_surface_edit_desc);
  desc.vertex_count = static_cast<uint32_t>(vertices.size());
  desc.vertices = vertices.data();
  desc.stiffness = stiffness.data();
  hf_surface out = nullptr;
  check(hf_surface_edit(surface, &desc, &out));
  return out;
}

nlohmann::json run_edits_on(const Mesh& mesh, const Run& run, Report* report) {
  const auto neighbours = neighbours_of(mesh);
  const Solver solver(mesh, own_defaults(run.threads));
  std::vector<float> field;
  Sites(solver).edit(scattered_vertices(mesh.vertex_count(), 10, 21), {});
  std::vector<double> fresh;
  for (uint32_t r = 0; r < run.repetitions; ++r) {
    fresh.push_back(time_ms([&] {
      const Solver again(mesh, own_defaults(run.threads));
      Sites(again).edit(scattered_vertices(mesh.vertex_count(), 10, 21), {});
      again.solve(field);
    }));
  }
  nlohmann::json row = {{"name", mesh.name}, {"n", mesh.vertex_count()}, {"fresh_ms", median(fresh)}};
  for (const uint32_t count : {30u, 100u, 300u, 1000u, 3000u, 10000u}) {
    std::vector<double> edits, moves, fields, wholes, bytes;
    hf_solver moved = nullptr;
    check(hf_solver_clone(solver.handle(), &moved));
    for (uint32_t r = 0; r < 3 * run.repetitions; ++r) {
      const uint32_t centre = scattered_vertices(mesh.vertex_count(), 1, 100 + r)[0];
      const std::vector<uint32_t> stroke = patch(neighbours, centre, count);
      const double before = solver.surface_statistics().memory_bytes;
      hf_surface stiff = nullptr;
      edits.push_back(time_ms([&] { stiff = edited(solver.surface(), stroke, 50); }));
      bytes.push_back(solver.surface_statistics().memory_bytes - before);
      moves.push_back(time_ms([&] { check(hf_solver_move_to(moved, stiff)); }));
      fields.push_back(time_ms([&] { check(hf_solve(moved, field.data(), 0, nullptr)); }));
      wholes.push_back(edits.back() + moves.back() + fields.back());
      hf_surface_destroy(stiff);
    }
    hf_solver_destroy(moved);
    const double share = median(bytes) / solver.surface_statistics().memory_bytes;
    std::printf(
        "%-16s %5u vertices: edit %7.2f ms, sites %6.2f, field %6.2f, in all %7.2f; fresh %8.1f = %5.1fx; "
        "memory %4.1f %%\n",
        mesh.name.c_str(), count, median(edits), median(moves), median(fields), median(wholes), median(fresh),
        median(fresh) / median(wholes), 100 * share);
    std::fflush(stdout);
    const std::string key = std::to_string(count);
    row["edit_ms"][key] = median(edits);
    row["move_ms"][key] = median(moves);
    row["field_ms"][key] = median(fields);
    row["all_ms"][key] = median(wholes);
    row["memory_share"][key] = share;
    if (!report || count != 100) continue;
    report->measure("edit_100", mesh.name, run.threads, median(wholes));
    report->measure("edit_100_fresh", mesh.name, run.threads, median(fresh) / median(wholes));
    report->measure("edit_100_memory", mesh.name, run.threads, share);
  }
  return row;
}

}  // namespace

Rows run_edits(const Run& run, Report& report) { return run_meshes(run, report, run_edits_on); }

void plot_edits(const Runs& runs, const std::string& file) {
  BarPlot plot;
  plot.text = {"A stroke of stiffness and the field",
               "patches of 30 to 10,000 vertices beside a fresh surface, medians", "", "ms"};
  plot.format = "%.3g";
  write_rows(plot,
             {{"30 vertices", "/all_ms/30"},
              {"100", "/all_ms/100"},
              {"300", "/all_ms/300"},
              {"1000", "/all_ms/1000"},
              {"3000", "/all_ms/3000"},
              {"10000", "/all_ms/10000"},
              {"fresh surface", "/fresh_ms"}},
             runs, file);
}

}  // namespace bench

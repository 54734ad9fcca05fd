// Edits of a surface and the field of ten sites after them, beside a fresh surface that does the same. An edit:
// hf_surface_edit, hf_solver_move_to and the field, at another place every time. Strokes make a patch of vertices
// stiff. Links join a small piece to the mesh and let it go again; they stand beside a site more and the field.
#include <algorithm>
#include <cstdio>

#include "bench/bench_mesh.h"
#include "bench/commands.h"
#include "bench/strokes.h"
#include "bench/svg_plot.h"

namespace bench {

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

hf_surface stiffened(hf_surface surface, const std::vector<uint32_t>& vertices, double s) {
  const std::vector<double> stiffness(vertices.size(), s);
  hf_surface_edit_desc desc = HF_INIT(hf_surface_edit_desc);
  desc.vertex_count = static_cast<uint32_t>(vertices.size());
  desc.vertices = vertices.data();
  desc.stiffness = stiffness.data();
  hf_surface out = nullptr;
  check(hf_surface_edit(surface, &desc, &out));
  return out;
}

namespace {

hf_surface linked(hf_surface surface, const hf_link* in, const uint32_t* out_number) {
  hf_surface_edit_desc desc = HF_INIT(hf_surface_edit_desc);
  desc.link_count = in ? 1 : 0;
  desc.links = in;
  desc.removed_link_count = out_number ? 1 : 0;
  desc.removed_links = out_number;
  hf_surface out = nullptr;
  check(hf_surface_edit(surface, &desc, &out));
  return out;
}

// The mesh with a square of 21 x 21 vertices beside it.
Mesh with_square(const Mesh& mesh) {
  constexpr uint32_t side = 21;
  Mesh out = mesh;
  const uint32_t first = mesh.vertex_count();
  for (uint32_t v = 0; v < side * side; ++v)
    for (const double x : {3 + 0.01 * (v % side), 0.01 * (v / side), 0.0})
      out.positions.push_back(static_cast<decltype(out.positions)::value_type>(x));
  for (uint32_t y = 0; y + 1 < side; ++y) {
    for (uint32_t x = 0; x + 1 < side; ++x) {
      const uint32_t a = first + y * side + x, b = a + 1, c = a + side, d = c + 1;
      out.triangles.insert(out.triangles.end(), {a, b, d, a, d, c});
    }
  }
  return out;
}

void run_links_on(const Mesh& mesh, const Run& run, Report* report, nlohmann::json& row) {
  const Solver solver(with_square(mesh), own_defaults(run.threads));
  const uint32_t count = mesh.vertex_count(), none = HF_NO_INDEX;
  Sites(solver).edit(scattered_vertices(count, 10, 21), {});
  std::vector<float> field;
  solver.solve(field);
  std::vector<double> more, in, out, bytes;
  const hf_link made_with = {count, {0, none, none}, {1, 0, 0}, 0, 1, 0, 0};
  hf_links_desc list = HF_INIT(hf_links_desc);
  list.mode = HF_LINK_LIST;
  list.link_count = 1;
  list.links = &made_with;
  hf_surface whole = nullptr;
  check(hf_surface_relink(solver.surface(), &list, nullptr, &whole));
  hf_solver on_whole = nullptr;
  check(hf_solver_clone(solver.handle(), &on_whole));
  check(hf_solver_move_to(on_whole, whole));
  for (uint32_t r = 0; r < 5 * run.repetitions; ++r) {
    const uint32_t there = scattered_vertices(count, 1, 100 + r)[0];
    hf_solver copy = nullptr;
    check(hf_solver_clone(solver.handle(), &copy));
    const double value = 0.5;
    hf_sites_desc site = HF_INIT(hf_sites_desc);
    site.site_count = 1;
    site.vertices = &there;
    site.values = &value;
    uint32_t number = 0;
    more.push_back(time_ms([&] {
      check(hf_add_sites(copy, &site, &number));
      check(hf_solve(copy, field.data(), 0, nullptr));
    }));
    hf_solver_destroy(copy);
    check(hf_solver_clone(solver.handle(), &copy));
    const hf_link link = {count + r, {there, none, none}, {1, 0, 0}, 0, 1, 0, 0};
    hf_surface held = nullptr, dropped = nullptr;
    const double before = solver.surface_statistics().memory_bytes;
    const double edit_ms = time_ms([&] { held = linked(solver.surface(), &link, nullptr); });
    bytes.push_back(solver.surface_statistics().memory_bytes - before);
    in.push_back(edit_ms + time_ms([&] {
                   check(hf_solver_move_to(copy, held));
                   check(hf_solve(copy, field.data(), 0, nullptr));
                 }));
    hf_solver_destroy(copy);
    check(hf_solver_clone(on_whole, &copy));
    const uint32_t first = 0;
    out.push_back(time_ms([&] {
      dropped = linked(whole, nullptr, &first);
      check(hf_solver_move_to(copy, dropped));
      check(hf_solve(copy, field.data(), 0, nullptr));
    }));
    hf_solver_destroy(copy);
    hf_surface_destroy(held);
    hf_surface_destroy(dropped);
  }
  hf_solver_destroy(on_whole);
  hf_surface_destroy(whole);
  const double share = median(bytes) / solver.surface_statistics().memory_bytes;
  std::printf("%-16s a site more and the field %6.2f ms, a link in %6.2f = %.2fx, out %6.2f = %.2fx; memory %4.1f %%\n",
              mesh.name.c_str(), median(more), median(in), median(in) / median(more), median(out),
              median(out) / median(more), 100 * share);
  row["site_ms"] = median(more);
  row["link_in_ms"] = median(in);
  row["link_out_ms"] = median(out);
  if (!report) return;
  report->measure("link_in", mesh.name, run.threads, median(in) / median(more));
  report->measure("link_out", mesh.name, run.threads, median(out) / median(more));
  report->measure("link_memory", mesh.name, run.threads, share);
}

// A patch of 600 triangles that 900 replace: a fourth of them get a vertex in the middle.
struct Patch {
  std::vector<uint32_t> removed, added;
  std::vector<double> positions;
};
Patch patch_at(const Mesh& mesh, const std::vector<std::vector<uint32_t>>& neighbours, uint32_t centre) {
  constexpr std::size_t size = 600;
  Patch out;
  std::vector<std::vector<uint32_t>> of_vertex(mesh.vertex_count());
  const std::vector<uint32_t> near = patch(neighbours, centre, 2 * size);
  std::vector<bool> is_near(mesh.vertex_count(), false), taken(mesh.triangles.size() / 3, false);
  for (const uint32_t v : near) is_near[v] = true;
  for (uint32_t c = 0; c < mesh.triangles.size(); ++c)
    if (is_near[mesh.triangles[c]]) of_vertex[mesh.triangles[c]].push_back(c / 3);
  for (const uint32_t v : near) {
    for (const uint32_t t : of_vertex[v]) {
      if (taken[t] || out.removed.size() == size) continue;
      taken[t] = true;
      out.removed.push_back(t);
    }
  }
  for (std::size_t i = 0; i < out.removed.size(); ++i) {
    const uint32_t* const v = &mesh.triangles[3 * std::size_t{out.removed[i]}];
    if (i % 4 != 0) {
      out.added.insert(out.added.end(), v, v + 3);
      continue;
    }
    const uint32_t middle = mesh.vertex_count() + static_cast<uint32_t>(out.positions.size() / 3);
    for (std::size_t x = 0; x < 3; ++x) {
      double sum = 0;
      for (int k = 0; k < 3; ++k) sum += static_cast<double>(mesh.positions[3 * std::size_t{v[k]} + x]);
      out.positions.push_back(sum / 3);
    }
    for (int k = 0; k < 3; ++k) out.added.insert(out.added.end(), {v[k], v[(k + 1) % 3], middle});
  }
  return out;
}

// The two ends of every edge on a shortest way of 50 edges from a vertex.
std::vector<uint32_t> cut_at(const std::vector<std::vector<uint32_t>>& neighbours, uint32_t from) {
  constexpr int length = 50;
  std::vector<uint32_t> before(neighbours.size(), HF_NO_INDEX), ring(1, from), edges;
  before[from] = from;
  for (int step = 0; step < length; ++step) {
    std::vector<uint32_t> next;
    for (const uint32_t v : ring) {
      for (const uint32_t u : neighbours[v]) {
        if (before[u] != HF_NO_INDEX) continue;
        before[u] = v;
        next.push_back(u);
      }
    }
    ring = next;
  }
  for (uint32_t v = ring.front(); v != from; v = before[v]) edges.insert(edges.end(), {v, before[v]});
  return edges;
}

void run_patches_on(const Mesh& mesh, const Run& run, const Solver& solver, double fresh_ms, Report* report,
                    nlohmann::json& row) {
  const auto neighbours = neighbours_of(mesh);
  hf_solver moved = nullptr;
  check(hf_solver_clone(solver.handle(), &moved));
  for (const bool cuts : {false, true}) {
    std::vector<double> edits, moves, fields, wholes, bytes;
    for (uint32_t r = 0; r < 3 * run.repetitions; ++r) {
      const uint32_t centre = scattered_vertices(mesh.vertex_count(), 1, 100 + r)[0];
      const Patch change = cuts ? Patch() : patch_at(mesh, neighbours, centre);
      const std::vector<uint32_t> edges = cuts ? cut_at(neighbours, centre) : std::vector<uint32_t>();
      hf_patch_desc patch = HF_INIT(hf_patch_desc);
      patch.removed_triangle_count = static_cast<uint32_t>(change.removed.size());
      patch.new_vertex_count = static_cast<uint32_t>(change.positions.size() / 3);
      patch.new_triangle_count = static_cast<uint32_t>(change.added.size() / 3);
      patch.removed_triangles = change.removed.data();
      patch.new_positions = change.positions.data();
      patch.new_triangles = change.added.data();
      patch.cut_edge_count = static_cast<uint32_t>(edges.size() / 2);
      patch.cut_edges = edges.data();
      hf_surface_edit_desc desc = HF_INIT(hf_surface_edit_desc);
      desc.patch = &patch;
      hf_surface made = nullptr;
      std::vector<float> field(mesh.vertex_count() + 1000);
      const double before = solver.surface_statistics().memory_bytes;
      edits.push_back(time_ms([&] { check(hf_surface_edit(solver.surface(), &desc, &made)); }));
      bytes.push_back(solver.surface_statistics().memory_bytes - before);
      moves.push_back(time_ms([&] { check(hf_solver_move_to(moved, made)); }));
      fields.push_back(time_ms([&] { check(hf_solve(moved, field.data(), 0, nullptr)); }));
      wholes.push_back(edits.back() + moves.back() + fields.back());
      check(hf_solver_move_to(moved, solver.surface()));  // undone: every edit finds the same state
      hf_surface_destroy(made);
    }
    const double share = median(bytes) / solver.surface_statistics().memory_bytes;
    std::printf("%-16s %s: edit %7.2f ms, sites %6.2f, field %6.2f, in all %7.2f; fresh = %5.1fx; memory %4.1f %%\n",
                mesh.name.c_str(), cuts ? "cut of 50 edges " : "600 by 900      ", median(edits), median(moves),
                median(fields), median(wholes), fresh_ms / median(wholes), 100 * share);
    std::fflush(stdout);
    const std::string key = cuts ? "cut" : "patch";
    row[key + "_ms"] = median(wholes);
    if (!report) continue;
    report->measure(key, mesh.name, run.threads, median(wholes));
    report->measure(key + "_fresh", mesh.name, run.threads, fresh_ms / median(wholes));
    report->measure(key + "_memory", mesh.name, run.threads, share);
  }
  hf_solver_destroy(moved);
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
      edits.push_back(time_ms([&] { stiff = stiffened(solver.surface(), stroke, 50); }));
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
  run_patches_on(mesh, run, solver, median(fresh), report, row);
  run_links_on(mesh, run, report, row);
  return row;
}

}  // namespace

Rows run_edits(const Run& run, Report& report) {
  Rows rows = run_meshes(run, report, run_edits_on);
  run_edit_poses(run, report, rows);
  return rows;
}

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

// Constraint vectors that are turned or rewritten, and the field after it, beside factorising again and solving: on a
// mesh of 120,000 vertices, the size of the largest vector field of Xu, Zhang, Cohen-Or and Xiong (2009), with forty
// constraints. Both ways of the library: three channels projected on the tangent planes (the paper's), against CHOLMOD
// on the cotangent Laplacian, three right-hand sides; and the connection Laplacian, against CHOLMOD on its matrix of
// two unknowns a vertex. The peer keeps its ordering and symbolic analysis: numeric factorisation and solve only.
//
// Beside a thousand constraints of the connection, one more is added and taken out again, each with the field after it.
// No edit factorises.
#include <cmath>
#include <cstdio>

#include "bench/bench_mesh.h"
#include "bench/commands.h"
#include "bench/inner_factor.h"
#include "bench/peer_cholmod.h"
#include "bench/svg_plot.h"
#include "field/direction_solver.h"
#include "support/arrays.h"

namespace bench {
namespace {

constexpr uint32_t site_count = 40, many_sites = 1000;

// The connection's matrix as the peer takes it, and the unknowns of the constrained vertices.
struct ConnectionSystem {
  PeerMatrix matrix;
  std::vector<uint32_t> constrained;
};
ConnectionSystem connection_system(const Mesh& mesh, const std::vector<uint32_t>& sites) {
  const auto memory = std::make_shared<hf_inner::Memory>();
  hf_inner::mesh::MeshInput input;
  input.vertex_count = mesh.vertex_count();
  input.triangle_count = static_cast<uint32_t>(mesh.triangles.size() / 3);
  input.positions = {mesh.positions.data(), 3 * sizeof(double)};
  input.triangles = hf_inner::IndexRows(mesh.triangles.data(), 3);
  const auto core = hf_inner::surface::Core::make(input, {}, memory, std::make_shared<hf_inner::JobRunner>(1));
  const hf_inner::field::DirectionSolver solver(core, 1);
  const hf_inner::SymmetricMatrix& a = solver.matrix();
  ConnectionSystem out;
  for (int32_t v = 0; v < a.size(); ++v) {
    out.matrix.start.push_back(static_cast<int>(out.matrix.row.size()));
    for (int32_t i = a.column_start[v]; i < a.column_start[v + 1]; ++i) {
      if (a.row[i] < v) continue;
      out.matrix.row.push_back(a.row[i]);
      out.matrix.value.push_back(a.value[i]);
    }
  }
  out.matrix.start.push_back(static_cast<int>(out.matrix.row.size()));
  for (const uint32_t v : sites) {
    const int32_t position = core->factor->position()[core->mesh.inner_of_given[v]];
    for (int32_t part = 0; part < 2; ++part) out.constrained.push_back(static_cast<uint32_t>(2 * position + part));
  }
  return out;
}

std::vector<double> vectors_of(uint32_t count) {
  std::vector<double> vectors;
  for (uint32_t i = 0; i < count; ++i)
    vectors.insert(vectors.end(), {std::cos(1.7 * i), std::sin(1.7 * i), 0.4 + 0.3 * std::sin(0.9 * i)});
  return vectors;
}

// Milliseconds of numeric factorisation and of a solve with so many right-hand sides.
std::pair<double, double> peer_ms(PeerMatrix matrix, const std::vector<uint32_t>& constrained, uint32_t columns,
                                  const Run& run) {
  const auto peer = CholmodPeer::make(std::move(matrix), run.threads);
  if (!peer) return {0, 0};
  peer->analyse_ms();
  peer->set_sites(constrained);
  std::vector<double> factorise, solve;
  for (uint32_t r = 0; r < run.repetitions; ++r) {
    factorise.push_back(peer->factorise_ms());
    solve.push_back(peer->solve_kept_ms(columns));
  }
  return {median(factorise), median(solve)};
}

struct Way {
  const char* name;
  double turn, rewrite;  // edit + field
  double own_numeric;    // our own numeric factorisation
  std::pair<double, double> peer;
};

void report_way(const Way& way, const Mesh& mesh, const Run& run, Report& report, nlohmann::json& row) {
  const double worst = std::max(way.turn, way.rewrite), again = way.peer.first + way.peer.second;
  std::printf(
      "%-14s %-10s turn + field %6.2f ms   new vector + field %6.2f ms   our factorisation %7.1f = %5.1fx   CHOLMOD "
      "again + solve %7.1f + %5.1f = %5.1fx\n",
      mesh.name.c_str(), way.name, way.turn, way.rewrite, way.own_numeric, (way.own_numeric + worst) / worst,
      way.peer.first, way.peer.second, again / worst);
  std::fflush(stdout);
  row[way.name] = {{"turn_ms", way.turn},
                   {"rewrite_ms", way.rewrite},
                   {"own_numeric_ms", way.own_numeric},
                   {"peer_factorise_ms", way.peer.first},
                   {"peer_solve_ms", way.peer.second}};
  if (again > 0 && !run.small) report.measure(std::string("turn_") + way.name, mesh.name, run.threads, again / worst);
}

Way by_channels(const Mesh& mesh, const std::vector<uint32_t>& sites, const Run& run) {
  SolverOptions options;
  options.threads = run.threads;
  options.channels = 3;
  const Solver solver(mesh, options);
  std::vector<double> vectors = vectors_of(site_count);
  std::vector<uint32_t> numbers(site_count);
  hf_sites_desc batch = HF_INIT(hf_sites_desc);
  batch.site_count = site_count;
  batch.vertices = sites.data();
  batch.values = vectors.data();
  check(hf_add_sites(solver.handle(), &batch, numbers.data()));
  std::vector<float> field(size_t{3} * mesh.vertex_count());
  const auto solve = [&] { check(hf_solver_solve_vectors(solver.handle(), OUT(field.data()), nullptr, nullptr)); };
  const uint32_t before = solver.statistics().factorisation_count;
  double angle = 0.3;
  uint32_t next = 0;
  auto times = take_turns(
      {{"turn",
        [&] {
          return time_ms([&] {
            check(hf_solver_rotate_vectors(solver.handle(), 1, &numbers[next++ % site_count], &angle));
            solve();
          });
        }},
       {"rewrite",
        [&] {
          return time_ms([&] {
            check(hf_solver_set_values(solver.handle(), 1, &numbers[next % site_count], &vectors[3 * (next % 7)]));
            ++next;
            solve();
          });
        }}},
      run.repetitions);
  if (solver.statistics().factorisation_count != before) throw std::runtime_error("turning a vector has factorised");
  return {"channels", times["turn"], times["rewrite"], solver.surface_statistics().numeric_ms,
          peer_ms(cotangent_matrix(mesh), sites, 3, run)};
}

Way by_connection(const Mesh& mesh, const std::vector<uint32_t>& sites, const Run& run) {
  const Solver solver(mesh, own_defaults(run.threads));
  hf_direction direction = nullptr;
  check(hf_direction_create(solver.surface(), nullptr, &direction));
  std::vector<double> vectors = vectors_of(site_count);
  std::vector<uint32_t> numbers(site_count);
  check(hf_direction_add_sites(direction, site_count, sites.data(), vectors.data(), numbers.data()));
  std::vector<float> field(size_t{3} * mesh.vertex_count());
  const auto solve = [&] { check(hf_direction_solve(direction, OUT(field.data()), nullptr)); };
  double angle = 0.3;
  uint32_t next = 0;
  auto times = take_turns({{"turn",
                            [&] {
                              return time_ms([&] {
                                check(hf_direction_rotate_sites(direction, 1, &numbers[next++ % site_count], &angle));
                                solve();
                              });
                            }},
                           {"rewrite",
                            [&] {
                              return time_ms([&] {
                                check(hf_direction_set_vectors(direction, 1, &numbers[next % site_count],
                                                               &vectors[3 * (next % site_count)]));
                                ++next;
                                solve();
                              });
                            }}},
                          run.repetitions);
  hf_direction_statistics statistics = HF_INIT(hf_direction_statistics);
  check(hf_direction_get_statistics(direction, &statistics));
  hf_direction_destroy(direction);
  if (statistics.factorisation_count != 1) throw std::runtime_error("turning a vector has factorised");
  ConnectionSystem system = connection_system(mesh, sites);
  return {"connection", times["turn"], times["rewrite"], statistics.numeric_ms,
          peer_ms(std::move(system.matrix), system.constrained, 1, run)};
}

// One constraint more and one fewer, each with the field after it, beside many_sites of them.
void report_edits(const Mesh& mesh, const Run& run, Report& report, nlohmann::json& row) {
  const Solver solver(mesh, own_defaults(run.threads));
  hf_direction direction = nullptr;
  check(hf_direction_create(solver.surface(), nullptr, &direction));
  const uint32_t count = std::min(many_sites, mesh.vertex_count() / 8);
  std::vector<uint32_t> sites = scattered_vertices(mesh.vertex_count(), count + 1, 11);
  const uint32_t more = sites.back();
  sites.pop_back();
  const std::vector<double> vectors = vectors_of(count + 1);
  check(hf_direction_add_sites(direction, count, sites.data(), vectors.data(), nullptr));
  std::vector<float> field(size_t{3} * mesh.vertex_count());
  const auto solve = [&] { check(hf_direction_solve(direction, OUT(field.data()), nullptr)); };
  solve();
  const auto statistics_now = [&] {
    hf_direction_statistics statistics = HF_INIT(hf_direction_statistics);
    check(hf_direction_get_statistics(direction, &statistics));
    return statistics;
  };
  const uint32_t before = statistics_now().factorisation_count;
  std::vector<double> added, removed;
  for (uint32_t r = 0; r < run.repetitions; ++r) {
    uint32_t number = 0;
    added.push_back(time_ms([&] {
      check(hf_direction_add_sites(direction, 1, &more, &vectors[size_t{3} * count], &number));
      solve();
    }));
    removed.push_back(time_ms([&] {
      check(hf_direction_remove_sites(direction, 1, &number));
      solve();
    }));
  }
  const hf_direction_statistics after = statistics_now();
  hf_direction_destroy(direction);
  if (after.factorisation_count != before) throw std::runtime_error("an edit of one constraint has factorised");
  ConnectionSystem system = connection_system(mesh, sites);
  const std::pair<double, double> peer = peer_ms(std::move(system.matrix), system.constrained, 1, run);
  const double add = median(added), remove = median(removed), worst = std::max(add, remove);
  const double again = peer.first + peer.second;
  std::printf(
      "%-14s %4u sites  one more + field %6.2f ms   one fewer + field %6.2f ms   our factorisation %7.1f = %5.1fx   "
      "CHOLMOD again + solve %7.1f + %5.1f = %5.1fx\n",
      mesh.name.c_str(), count, add, remove, after.numeric_ms, (after.numeric_ms + worst) / worst, peer.first,
      peer.second, again / worst);
  std::fflush(stdout);
  row["edit"] = {{"sites", count},
                 {"add_ms", add},
                 {"remove_ms", remove},
                 {"own_numeric_ms", after.numeric_ms},
                 {"peer_factorise_ms", peer.first},
                 {"peer_solve_ms", peer.second}};
  if (again > 0 && !run.small) report.measure("edit_connection", mesh.name, run.threads, again / worst);
}

}  // namespace

Rows run_directions(const Run& run, Report& report) {
  Rows rows = Rows::array();
  for (const Family family : families) {
    const auto mesh = make_mesh(family, run.small ? 4000u : 120000u);
    if (!run.wants(mesh->name)) continue;
    const std::vector<uint32_t> sites = scattered_vertices(mesh->vertex_count(), site_count, 11);
    nlohmann::json row = {{"name", mesh->name}, {"n", mesh->vertex_count()}};
    report_way(by_channels(*mesh, sites, run), *mesh, run, report, row);
    report_way(by_connection(*mesh, sites, run), *mesh, run, report, row);
    report_edits(*mesh, run, report, row);
    rows.push_back(row);
  }
  return rows;
}

void plot_directions(const Runs& runs, const std::string& file) {
  CurvePlot plot;
  plot.text = {"A constraint vector turned, and the field", "120,000 vertices, forty constraints, medians", "threads",
               "times faster than factorising again (CHOLMOD where it is built in, else ours)"};
  for (const char* way : {"channels", "connection"}) {
    for (const std::string& name : row_names(runs)) {
      Curve curve{name + ", " + way, {}};
      for (const nlohmann::json& run : runs) {
        const nlohmann::json* row = find_row(run, name);
        if (!row) continue;
        const nlohmann::json& own = row->at(way);
        const double peer = number_of(own, "/peer_factorise_ms") + number_of(own, "/peer_solve_ms");
        const double again = peer > 0 ? peer : number_of(own, "/own_numeric_ms");
        curve.points.emplace_back(run.at("threads").get<double>(),
                                  again / std::max(number_of(own, "/turn_ms"), number_of(own, "/rewrite_ms")));
      }
      plot.curves.push_back(curve);
    }
  }
  write_svg(file, plot);
}

}  // namespace bench

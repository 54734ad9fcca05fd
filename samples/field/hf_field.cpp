// hf_field: the harmonic field of a mesh file under an edit script. See README.md beside this file, or --help.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>

#include "common/links.h"
#include "common/program.h"
#include "field/field_options.h"
#include "field/field_output.h"
#include "field/field_session.h"
#include "hf/hf.h"

namespace samples {
namespace {

class Clock {
 public:
  double milliseconds() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void describe(hf_surface surface, double create_ms) {
  hf_surface_report report = HF_INIT(hf_surface_report);
  check(hf_surface_get_report(surface, &report));
  hf_mesh_statistics mesh = HF_INIT(hf_mesh_statistics);
  check(hf_surface_get_mesh_statistics(surface, &mesh));
  hf_surface_info info = HF_INIT(hf_surface_info);
  check(hf_surface_get_info(surface, &info));
  hf_surface_statistics statistics = HF_INIT(hf_surface_statistics);
  check(hf_surface_get_statistics(surface, &statistics));
  std::printf("mesh        %u vertices (%u welded), %u triangles, %u components\n", report.vertex_count,
              report.welded_vertex_count, report.triangle_count, report.component_count);
  if (info.face_count)
    std::printf("            %u faces, %u of more than three corners\n", info.face_count, mesh.polygon_count);
  const struct {
    uint32_t count;
    const char* name;
  } dirt[] = {{report.isolated_vertex_count, "isolated vertices"},
              {report.degenerate_triangle_count, "zero-area triangles"},
              {report.collapsed_triangle_count, "collapsed triangles"},
              {report.duplicate_triangle_count, "duplicate triangles"},
              {report.non_manifold_edge_count, "non-manifold edges"},
              {report.flipped_edge_count, "flipped edges"},
              {report.boundary_edge_count, "boundary edges"},
              {mesh.negative_edge_count, "edges of negative weight"},
              {mesh.non_planar_count, "faces that are not planar"},
              {report.inside_out_count, "closed pieces that are inside out"}};
  for (const auto& entry : dirt) {
    if (entry.count) std::printf("            %u %s\n", entry.count, entry.name);
  }
  if (const std::string sentence = links_sentence(surface); !sentence.empty())
    std::printf("links       %s\n", sentence.c_str());
  std::printf("create      %.1f ms (ordering %.1f, symbolic %.1f, factorisation %.1f; factor %.1f MB)\n", create_ms,
              statistics.ordering_ms, statistics.symbolic_ms, statistics.numeric_ms, statistics.factor_bytes / 1e6);
}

// What is shown of the present field: NaN where no site reaches, levels, lines, critical points as asked for.
FieldView view_of(const Session& session, const SurfaceMesh& mesh, const std::vector<double>& field,
                  const FieldOptions& options) {
  FieldView view;
  view.mesh = &mesh;
  view.values = field;
  view.components = session.components();
  view.direction = options.direction;
  view.sites = session.positions(mesh);
  view.singular = session.singularities();
  if (options.kind == FieldType::direction) {
    // only where it points matters: the length fades away between the sites
    for (size_t i = 0; i + 2 < view.values.size(); i += 3) {
      const double length = std::hypot(view.values[i], view.values[i + 1], view.values[i + 2]);
      for (size_t k = 0; k < 3; ++k) view.values[i + k] = length > 0 ? view.values[i + k] / length : 0;
    }
  }
  const std::vector<bool> reached = session.reached(field);
  for (size_t i = 0; i < field.size(); ++i) {
    if (!reached[i / session.components()]) view.values[i] = std::nan("");
  }
  if (session.components() != 1) return view;
  double low = INFINITY, high = -INFINITY;
  for (const double value : view.values) {
    if (std::isfinite(value)) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (!(high > low)) return view;  // one strip
  if (options.strips > 1) view.levels = session.levels(view.values, options.levels, options.strips - 1);
  if (options.isolines > 0) {
    view.lines = session.isolines(view.values, session.levels(view.values, options.levels, options.isolines));
  }
  if (options.critical_points) {
    hf_critical_info info;
    view.critical = session.critical_points(view.values, info);
  }
  return view;
}

void list_extremities(const SurfaceMesh& mesh, const FieldOptions& options) {
  FieldOptions plain = options;  // extremities need the factor of a Laplacian
  plain.kind = FieldType::harmonic;
  const Session session(mesh, plain);
  const Clock clock;
  const std::vector<hf_extremity> found = session.extremities(options.extremities);
  std::printf("extremities %zu, %.1f ms (twice: count, then list)\n", found.size(), clock.milliseconds());
  for (const hf_extremity& tip : found) {
    std::printf("            vertex %-8u component %-4u protrudes %-12.6g at %.6g %.6g %.6g\n", tip.vertex,
                tip.component, tip.length, tip.position[0], tip.position[1], tip.position[2]);
  }
}

void list_critical_points(const Session& session, const FieldView& view) {
  hf_critical_info info;
  session.critical_points(view.values, info);
  std::printf("critical    %u minima, %u maxima, %u saddles; indices sum to %d, Euler characteristic %d\n",
              info.minimum_count, info.maximum_count, info.saddle_count, info.index_sum, info.euler_characteristic);
  const char* const names[] = {"minimum", "maximum", "saddle"};
  size_t listed = 0;
  for (const hf_critical_point& point : view.critical) {
    if (++listed > 40) {
      std::printf("            and %zu more\n", view.critical.size() - 40);
      break;
    }
    std::printf("            %-8s vertex %-8u index %2d  value %.9g\n", names[point.kind], point.vertex, point.index,
                point.value);
  }
}

// The sites of the command line, those of the script, or the extremities when there are neither.
std::vector<Edit> edits_of(const FieldOptions& options, const SurfaceMesh& mesh, const Session& session) {
  std::vector<Edit> edits;
  // vertices and points go in as two batches
  for (const bool vertices : {true, false}) {
    Edit first;
    for (const SiteArgument& site : options.sites) {
      if (site.place.is_vertex() == vertices) first.sites.push_back(site);
    }
    first.text =
        "add " + std::to_string(first.sites.size()) + (vertices ? " vertex sites" : " points") + " of the command line";
    if (!first.sites.empty()) edits.push_back(first);
  }
  if (!options.script.empty()) {
    for (Edit& edit : read_edit_script(options.script, session.components())) edits.push_back(std::move(edit));
  }
  if (edits.empty() && options.extremities >= 0) {
    Edit proposed;
    proposed.sites = propose_sites(mesh, session, options.extremities);
    proposed.text = "add " + std::to_string(proposed.sites.size()) + " extremities as sites";
    edits.push_back(proposed);
  }
  if (edits.empty()) throw std::runtime_error("no sites given; use --site, --script or --extremities");
  return edits;
}

int run_one(const FieldOptions& options) {
  const SurfaceMesh mesh = read_mesh_file(file_named(options.mesh));
  for (const std::string& warning : mesh.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
  const Clock create_clock;
  Session session(mesh, options);
  describe(session.surface(), create_clock.milliseconds());
  if (options.extremities >= 0) list_extremities(mesh, options);

  std::vector<double> field;
  hf_solve_info info;
  for (const Edit& edit : edits_of(options, mesh, session)) {
    const Clock edit_clock;
    session.apply(edit);
    const double edit_ms = edit_clock.milliseconds();
    if (session.site_count() == 0) {
      field.clear();
      std::printf("%-40.60s edit %8.3f ms, no sites left\n", edit.text.c_str(), edit_ms);
      continue;
    }
    const Clock solve_clock;
    field = session.solve(info);
    std::printf("%-40.60s edit %8.3f ms, field %8.3f ms, %u sites\n", edit.text.c_str(), edit_ms,
                solve_clock.milliseconds(), session.site_count());
  }
  if (field.empty()) throw std::runtime_error("the script ends without a site; there is no field to write");
  if (info.unreached_vertex_count) {
    std::fprintf(stderr,
                 "warning: %u vertices are reached by no site (%u components without one, or isolated); they are "
                 "written as 0 and hatched in pictures\n",
                 info.unreached_vertex_count, info.unreached_component_count);
  }
  if (!options.out.empty()) write_field_text(options.out, field, session.components());
  const bool listed = options.critical_points || options.kind == FieldType::direction;
  if (options.glb.empty() && options.png.empty() && !listed) return 0;
  const FieldView view = view_of(session, mesh, field, options);
  if (options.critical_points) list_critical_points(session, view);
  if (options.kind == FieldType::direction) {
    int sum = 0;
    for (const hf_singularity& point : view.singular) sum += point.index;
    std::printf("singular    %zu triangles; indices sum to %d\n", view.singular.size(), sum);
  }
  if (!options.glb.empty()) write_field_glb(options.glb, view);
  if (!options.png.empty()) write_png(options.png, field_picture(view));
  return 0;
}

// One picture of a sheet: sites at the extremities, the field, everything finite.
Picture sheet_tile(const SurfaceMesh& mesh, const FieldOptions& options, const std::string& name) {
  Session session(mesh, options);
  Edit edit;
  edit.sites = propose_sites(mesh, session, options.extremities);
  session.apply(edit);
  hf_solve_info info;
  const std::vector<double> field = session.solve(info);
  for (size_t i = 0; i < field.size(); ++i) {
    if (!std::isfinite(field[i]))
      throw std::runtime_error(name + ": the field is not finite at vertex " +
                               std::to_string(i / session.components()));
  }
  FieldView view = view_of(session, mesh, field, options);
  view.width = 300;
  view.height = 250;
  return field_picture(view);
}

int run_sheet(const FieldOptions& given) {
  struct Kind {
    const char* name;
    FieldType type;
    int extremities, levels, strips, isolines;
    bool critical;
  };
  const Kind kinds[] = {
      {"harmonic", FieldType::harmonic, 0, 0, 24, 0, false}, {"biharmonic", FieldType::biharmonic, 0, 0, 24, 0, false},
      {"vector", FieldType::vector, 0, 0, 1, 0, false},      {"direction", FieldType::direction, 0, 0, 1, 0, false},
      {"isolines", FieldType::harmonic, 1, 2, 1, 24, false}, {"critical", FieldType::harmonic, 1, 1, 12, 0, true}};
  for (const Kind& kind : kinds) {
    FieldOptions options = given;
    options.kind = kind.type;
    options.extremities = kind.extremities;
    options.levels = kind.levels;
    options.strips = kind.strips;
    options.isolines = kind.isolines;
    options.critical_points = kind.critical;
    std::vector<Picture> tiles;
    std::vector<std::string> labels;
    for (const std::string& file : given.sheet) {
      labels.push_back(file_named(file).stem().string());
      const Clock clock;
      tiles.push_back(sheet_tile(read_mesh_file(file_named(file)), options, file));
      std::printf("%-12s %-36s %8.0f ms\n", kind.name, labels.back().c_str(), clock.milliseconds());
      std::fflush(stdout);
    }
    write_png(given.png + "_" + kind.name + ".png", contact_sheet(tiles, 6, labels, kind.name));
  }
  return 0;
}

int run(int argc, char** argv) {
  const FieldOptions options = read_field_options(argc, argv);
  if (options.help) {
    std::fputs(field_usage, stdout);
    return 0;
  }
  return options.sheet.empty() ? run_one(options) : run_sheet(options);
}

}  // namespace
}  // namespace samples

int main(int argc, char** argv) {
  try {
    samples::CommandLine line(argc, argv);
    return samples::run(line.count(), line.words());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "hf_field: %s\n", samples::with_limit_option(error.what()).c_str());
    return 1;
  }
}

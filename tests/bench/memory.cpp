// Memory of a solver: the peak of hf_create, ten sites and one field over the bytes of the stored factor, 10,000 to a
// million vertices. The library counts every allocation it makes (hf_surface_statistics); beside it stands what the
// operating system saw, the largest resident set of the process less what was there before (Linux; includes the C
// library).
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "bench/bench_mesh.h"
#include "bench/commands.h"
#include "bench/svg_plot.h"

namespace bench {
namespace {

// Kilobytes of a line of /proc/self/status; 0 where there is none.
double status_bytes(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind(name, 0) == 0) return 1024 * std::atof(line.c_str() + name.size() + 1);
  }
  return 0;
}

// Starts a new peak of the resident set; false where the system does not offer it.
bool reset_resident_peak() {
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;
  return file.good();
}

nlohmann::json run_mesh(const Mesh& mesh, const Run& run, Report& report, bool judged) {
#ifdef __GLIBC__
  malloc_trim(0);  // what earlier solvers left in the heap would hide what this one takes
#endif
  const bool watched = reset_resident_peak();
  const double before = status_bytes("VmRSS");
  std::vector<float> field(mesh.vertex_count());
  const Solver solver(mesh, {ENGINE_GREEN, run.threads});
  Sites(solver).edit(scattered_vertices(mesh.vertex_count(), 10, 5), {});
  solver.solve(field);
  const hf_surface_statistics statistics = solver.surface_statistics();
  const double resident = watched ? status_bytes("VmHWM") - before : 0;
  const double ratio = statistics.peak_memory_bytes / statistics.factor_bytes;
  std::printf("%-16s factor %8.1f MB, peak %8.1f MB = %.2fx, kept %8.1f MB = %.2fx, of the process %8.1f MB = %.2fx\n",
              mesh.name.c_str(), 1e-6 * statistics.factor_bytes, 1e-6 * statistics.peak_memory_bytes, ratio,
              1e-6 * statistics.memory_bytes, statistics.memory_bytes / statistics.factor_bytes, 1e-6 * resident,
              resident / statistics.factor_bytes);
  std::fflush(stdout);
  if (judged) report.measure("memory", mesh.name, run.threads, ratio);
  return {{"name", mesh.name},
          {"n", mesh.vertex_count()},
          {"factor_bytes", statistics.factor_bytes},
          {"peak_bytes", statistics.peak_memory_bytes},
          {"live_bytes", statistics.memory_bytes},
          {"resident_bytes", resident},
          {"ratio", ratio}};
}

}  // namespace

Rows run_memory(const Run& run, Report& report) {
  Rows rows = Rows::array();
  for (const Family family : families) {
    for (const uint32_t n : {10000u, 30000u, 100000u, 304000u, 1000000u}) {
      const bool judged = n == 304000;
      if (run.small && !judged) continue;
      const auto mesh = judged ? make_mesh(family, Size::k304, run.small) : make_mesh(family, n);
      if (run.wants(mesh->name)) rows.push_back(run_mesh(*mesh, run, report, judged));
    }
  }
  return rows;
}

void plot_memory(const Runs& runs, const std::string& file) {
  CurvePlot plot;
  plot.text = {"Memory of create + 10 sites + one field", "bytes over the bytes of the stored factor", "vertices",
               "times the factor"};
  plot.log_y = false;
  for (const nlohmann::json& run : runs) {
    for (const char* family : {"torus", "creature"}) {
      Curve peak{std::string("peak, ") + family + ", " + threads_text(run.at("threads")), {}},
          resident{std::string("process, ") + family + ", " + threads_text(run.at("threads")), {}};
      for (const nlohmann::json& row : run.at("rows")) {
        if (row.at("name").get<std::string>().find(family) == std::string::npos) continue;
        const double factor = number_of(row, "/factor_bytes");
        peak.points.emplace_back(number_of(row, "/n"), number_of(row, "/peak_bytes") / factor);
        resident.points.emplace_back(number_of(row, "/n"), number_of(row, "/resident_bytes") / factor);
      }
      if (peak.points.empty()) continue;
      resident.dashed = true;
      peak.colour = resident.colour = static_cast<int>(plot.curves.size() / 2);
      plot.curves.push_back(peak);
      plot.curves.push_back(resident);
    }
  }
  write_svg(file, plot);
}

}  // namespace bench

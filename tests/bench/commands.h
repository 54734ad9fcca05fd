// The commands of hf_bench. Each runs at one number of threads, prints as it goes, enters its figures in the report and
// returns its rows as JSON; each draws the rows of its runs (one per number of threads) as one SVG.
#ifndef HF_BENCH_COMMANDS_H
#define HF_BENCH_COMMANDS_H

#include <initializer_list>
#include <string>
#include <vector>

#include "bench/bench_mesh.h"
#include "bench/bench_support.h"
#include "bench/figures.h"
#include "bench/svg_plot.h"

namespace bench {

struct Run {
  uint32_t threads = 1, repetitions = 5;
  bool small = false;  // meshes of a few thousand vertices: does everything run?
  std::string rows;    // keep rows whose names contain this
  bool wants(const std::string& name) const { return name.find(rows) != std::string::npos; }
};

using Rows = nlohmann::json;  // an array of objects with a "name"
// The runs of one command: objects with "threads" and "rows".
using Runs = std::vector<nlohmann::json>;

struct Command {
  const char* name;
  const char* help;
  Rows (*run)(const Run& run, Report& report);
  void (*plot)(const Runs& runs, const std::string& file);
};

Rows run_first_field(const Run& run, Report& report);
void plot_first_field(const Runs& runs, const std::string& file);
Rows run_factor(const Run& run, Report& report);
void plot_factor(const Runs& runs, const std::string& file);
Rows run_sweep(const Run& run, Report& report);
void plot_sweep(const Runs& runs, const std::string& file);
Rows run_table1(const Run& run, Report& report);
void plot_table1(const Runs& runs, const std::string& file);
Rows run_large_sites(const Run& run, Report& report);
void plot_large_sites(const Runs& runs, const std::string& file);
Rows run_edits(const Run& run, Report& report);
void plot_edits(const Runs& runs, const std::string& file);
// Rows of strokes with a pose drawn; run_edits calls it.
void run_edit_poses(const Run& run, Report& report, Rows& rows);
Rows run_memory(const Run& run, Report& report);
void plot_memory(const Runs& runs, const std::string& file);
Rows run_accuracy(const Run& run, Report& report);
void plot_accuracy(const Runs& runs, const std::string& file);
Rows run_scaling(const Run& run, Report& report);
void plot_scaling(const Runs& runs, const std::string& file);
Rows run_paths(const Run& run, Report& report);
void plot_paths(const Runs& runs, const std::string& file);
Rows run_partial(const Run& run, Report& report);
void plot_partial(const Runs& runs, const std::string& file);
Rows run_analysis(const Run& run, Report& report);
void plot_analysis(const Runs& runs, const std::string& file);
Rows run_flow(const Run& run, Report& report);
void plot_flow(const Runs& runs, const std::string& file);
Rows run_directions(const Run& run, Report& report);
void plot_directions(const Runs& runs, const std::string& file);
// A frame without vertices beside a frame of hf_deform, eight handles; run_deform calls it.
nlohmann::json solve_without_vertices(const Mesh& mesh, const Run& run, Report& report);
Rows run_deform(const Run& run, Report& report);
void plot_deform(const Runs& runs, const std::string& file);
Rows run_deform_quality(const Run& run, Report& report);
void plot_deform_quality(const Runs& runs, const std::string& file);
Rows run_detail(const Run& run, Report& report);
void plot_detail(const Runs& runs, const std::string& file);
Rows run_transfer(const Run& run, Report& report);
void plot_transfer(const Runs& runs, const std::string& file);
Rows run_weights(const Run& run, Report& report);
void plot_weights(const Runs& runs, const std::string& file);

// "2 threads".
std::string threads_text(uint32_t threads);
// A number of a row by its path of keys, NaN where it is missing.
double number_of(const nlohmann::json& row, const char* pointer);
// A bar plot of numbers of rows: one group per row of every run, named with its threads; one bar per series, its number
// at the JSON pointer `key`.
struct Series {
  const char *name, *key;
};
void write_rows(BarPlot plot, std::initializer_list<Series> series, const Runs& runs, const std::string& file);
// Rows of the 304K meshes, entered in the report, and unless small those of the real meshes beside, which are not
// judged.
Rows run_meshes(const Run& run, Report& report, nlohmann::json (*run_mesh)(const Mesh&, const Run&, Report*));
// The distinct row names of several runs, in order.
std::vector<std::string> row_names(const Runs& runs);
// The row of that name, or null.
const nlohmann::json* find_row(const nlohmann::json& run, const std::string& name);

}  // namespace bench

#endif

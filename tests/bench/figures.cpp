#include "bench/figures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

namespace bench {
namespace {

constexpr double no_bar = std::numeric_limits<double>::quiet_NaN();
constexpr Bar both(double value) { return {value, value}; }

std::string print(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

double bar_of(const Bar& bar, uint32_t threads) { return threads == 1 ? bar.one_thread : bar.two_threads; }

bool reached(const Figure& figure, double value, double bar) {
  return figure.larger_is_better ? value >= bar : value <= bar;
}

std::string bar_text(const Figure& figure, const Bar& bar) {
  const std::string sign = figure.larger_is_better ? ">= " : "<= ";
  const auto one = [&](double value) { return std::isnan(value) ? std::string("-") : print(figure.format, value); };
  return sign +
         (bar.one_thread == bar.two_threads ? one(bar.one_thread) : one(bar.one_thread) + " / " + one(bar.two_threads));
}

const char* verdict(const Figure& figure, double value, uint32_t threads) {
  const double must = bar_of(figure.must, threads), aim = bar_of(figure.aim, threads);
  if (std::isnan(must)) return "-";
  return reached(figure, value, aim) ? "aim" : reached(figure, value, must) ? "must" : "MISSED";
}

}  // namespace

const std::vector<Figure>& all_figures() {
  static const std::vector<Figure> figures = {
      {"ordering_time", "ordering: METIS time over ours", true, {2, 3}, {3, 5}, "%.2fx"},
      {"ordering_fill", "ordering: fill against METIS", false, both(1.10), both(1.0), "%.3fx"},
      {"ordering_flops", "ordering: flops against METIS", false, both(1.20), both(1.0), "%.3fx"},
      {"numeric",
       "numeric factorisation, CHOLMOD supernodal over ours, METIS's permutation for both",
       true,
       {2.5, 3.5},
       {3.5, 6},
       "%.2fx"},
      {"first_field", "create + 10 sites + first field, METIS + CHOLMOD over ours", true, {2, 3.5}, {4, 8}, "%.2fx"},
      {"sweep_solve", "one field, cholmod_solve over ours", true, {3.5, 5.5}, {5, 9}, "%.2fx"},
      {"sweep_read", "one field against reading the stored factor once", false, {2.8, 2.2}, {1.5, 1.2}, "%.2fx"},
      {"channels_3", "3 fields against one", false, both(2.2), both(1.6), "%.2fx"},
      {"channels_8", "8 fields against one", false, both(2.8), both(2.0), "%.2fx"},
      {"float32", "float32 sweep against double", false, both(0.7), both(0.55), "%.2fx"},
      {"table1_torus",
       "Table 1, rows with >= 40 edits, torus: cholmod_updown + solve over ours, worst row",
       true,
       {4.5, 8},
       {8, 15},
       "%.2fx"},
      {"table1_creature",
       "Table 1, rows with >= 40 edits, creature: cholmod_updown + solve over ours, worst row",
       true,
       {4, 6},
       {7, 12},
       "%.2fx"},
      {"table1_single",
       "Table 1, +1/-1, median over >= 50 sites: cholmod_updown + solve over ours",
       true,
       {3, 4.5},
       {5, 9},
       "%.2fx"},
      {"table1_clear_torus",
       "Table 1, 173K 0/-300, torus: cholmod_updown + solve over ours",
       true,
       {no_bar, 40},
       {no_bar, 80},
       "%.1fx"},
      {"table1_clear_creature",
       "Table 1, 173K 0/-300, creature: cholmod_updown + solve over ours",
       true,
       {no_bar, 15},
       {no_bar, 30},
       "%.1fx"},
      {"table1_recompute",
       "Table 1, any row: CHOLMOD numeric refactorisation + solve over ours, worst row",
       true,
       {10, 15},
       {20, 35},
       "%.1fx"},
      {"edit_100", "100 vertices made stiff and the field", false, both(15), both(8), "%.1f ms"},
      {"edit_100_fresh", "the same by a fresh surface over it", true, both(15), both(40), "%.1fx"},
      {"edit_100_memory", "memory that it adds to a surface", false, both(0.1), both(0.03), "%.3f"},
      {"patch", "600 triangles replaced by 900 and the field", false, both(20), both(12), "%.1f ms"},
      {"patch_fresh", "the same by a fresh surface over it", true, both(15), both(40), "%.1fx"},
      {"patch_memory", "memory that it adds to a surface", false, both(0.1), both(0.03), "%.3f"},
      {"cut", "a cut of 50 edges and the field", false, both(15), both(8), "%.1f ms"},
      {"cut_fresh", "the same by a fresh surface over it", true, both(15), both(40), "%.1fx"},
      {"cut_memory", "memory that it adds to a surface", false, both(0.1), both(0.03), "%.3f"},
      {"link_in", "a link more and the field over a site more and the field", false, both(1.2), both(1.05), "%.2fx"},
      {"link_out", "a link less and the field over a site more and the field", false, both(1.2), both(1.05), "%.2fx"},
      {"strokes_posed", "strokes of 30 vertices a second, with a pose of 8 handles", true, both(60), both(200), "%.0f"},
      {"link_memory", "memory that a link adds to a surface", false, both(0.1), both(0.03), "%.3f"},
      {"sites_1000", "1,000 sites at once against our own refactorisation + sweeps", false, both(1.15), both(1.0),
       "%.2fx"},
      {"sites_10000", "10,000 sites at once against our own refactorisation + sweeps", false, both(1.15), both(1.0),
       "%.2fx"},
      {"memory", "peak memory of create + solve over the factor's bytes", false, both(4.0), both(2.5), "%.2fx"},
      {"load", "loading the stored factor against making it", false, both(0.10), both(0.05), "%.3fx"},
      {"site_error", "hard sites: site error", false, both(1e-12), both(1e-13), "%.1e"},
      {"residual", "hard sites: residual over mean diagonal", false, both(1e-10), both(1e-11), "%.1e"},
      {"biharmonic_change", "bi-harmonic: field change by a second refinement", false, both(1e-12), both(1e-14),
       "%.1e"},
      {"edits_error", "error against exact elimination after 10,000 random edits, values offset by 1e4", false,
       both(1e-10), both(1e-12), "%.1e"},
      {"deform_frame",
       "pose: drag frame with normals, ms (84K on one thread, 304K on two)",
       false,
       {5, 15},
       {2, 6},
       "%.2f"},
      {"solve_frame", "pose: a frame without vertices, eight handles, ms", false, both(0.25), both(0.1), "%.3f"},
      {"solve_bytes", "pose: kB of transforms a frame, eight handles", false, both(12), both(6), "%.1f"},
      {"deform_arap", "pose: one ARAP iteration of the full mesh over a drag frame", true, both(15), both(50), "%.0fx"},
      {"deform_add", "pose: all from scratch over a handle more and its first frame", true, both(5), both(20), "%.1fx"},
      {"deform_allocations", "pose: allocations in 1,000 drag frames", false, both(0), both(0), "%.0f"},
      {"deform_target", "pose: handles off target, over the box", false, both(1e-12), both(1e-14), "%.1e"},
      {"deform_jump", "pose: insertion jump, over the box", false, both(1e-9), both(1e-14), "%.1e"},
      {"deform_rigid", "pose: common rigid motion, over the box", false, both(1e-8), both(1e-12), "%.1e"},
      {"extremities_poisson", "extremities of a Poisson field, in fields", false, both(5), both(3), "%.1f"},
      {"extremities_geodesic", "extremities of 40 geodesic distances, in fields", false, both(60), both(30), "%.1f"},
      {"flow_live", "site moved, streamlines re-traced, times fresh", true, both(3), both(10), "%.1f"},
      {"region_grown",
       "region grown by 284 sites, with its membrane: CHOLMOD numeric refactorisation + solve over ours", true, both(5),
       both(15), "%.1fx"},
      {"turn_channels", "vector by three channels, one turned or rewritten: CHOLMOD again + solve over ours", true,
       both(15), both(30), "%.1fx"},
      {"turn_connection", "vector by the connection, one turned or rewritten: CHOLMOD again + solve over ours", true,
       both(15), both(30), "%.1fx"},
      {"edit_connection", "1,000 vectors by the connection, one more or fewer: CHOLMOD again + solve over ours", true,
       both(5), both(15), "%.1fx"},
      {"weights_whole", "skin weights: 3.3K vertices, 50 bones, surface to weights, ms", false, both(25), both(12),
       "%.1f"},
      {"weights_bone", "skin weights: 13K vertices, a bone moved, new weights out, ms", false, both(30), both(12),
       "%.1f"},
      {"weights_pin", "skin weights: 13K vertices, a pin, new weights out, ms", false, both(10), both(4), "%.1f"},
      {"deform_quality", "pose: bars of quality missed", false, both(0), both(0), "%.0f"},
  };
  return figures;
}

void Report::measure(const std::string& key, const std::string& where, uint32_t threads, double value,
                     const std::string& note) {
  const auto& figures = all_figures();
  const auto figure = std::find_if(figures.begin(), figures.end(), [&](const Figure& f) { return key == f.key; });
  if (figure == figures.end()) throw std::logic_error("no figure is called " + key);
  auto line = std::find_if(lines_.begin(), lines_.end(),
                           [&](const Line& l) { return l.figure == &*figure && l.where == where; });
  if (line == lines_.end()) line = lines_.insert(lines_.end(), Line{&*figure, where, {}});
  line->values[threads] = {value, note};
}

std::vector<const Report::Line*> Report::ordered() const {
  std::vector<const Line*> lines;
  for (const Line& line : lines_) lines.push_back(&line);
  std::stable_sort(lines.begin(), lines.end(), [](const Line* a, const Line* b) { return a->figure < b->figure; });
  return lines;
}

std::vector<std::vector<std::string>> Report::cells() const {
  std::vector<std::vector<std::string>> rows = {{"figure", "mesh", "measured", "must", "aim", "reached", "note"}};
  for (const Line* line : ordered()) {
    const Figure& figure = *line->figure;
    std::string measured, result, note;
    for (const auto& [threads, value] : line->values) {
      const std::string between = measured.empty() ? "" : " / ";
      measured += between + print(figure.format, value.value);
      result += between + verdict(figure, value.value, threads);
      if (!value.note.empty() && note.find(value.note) == std::string::npos)
        note += (note.empty() ? "" : " / ") + value.note;
    }
    rows.push_back({figure.label, line->where, measured, bar_text(figure, figure.must), bar_text(figure, figure.aim),
                    result, note});
  }
  return rows;
}

std::string Report::text() const {
  const std::vector<std::vector<std::string>> rows = cells();
  std::vector<size_t> width(rows[0].size(), 0);
  for (const auto& row : rows) {
    for (size_t c = 0; c < row.size(); ++c) width[c] = std::max(width[c], row[c].size());
  }
  std::string out;
  for (const auto& row : rows) {
    std::string line;
    for (size_t c = 0; c < row.size(); ++c) line += row[c] + std::string(width[c] - row[c].size() + 2, ' ');
    out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return out;
}

std::string Report::markdown() const {
  std::string out;
  bool head = true;
  for (const auto& row : cells()) {
    out += "|";
    for (const std::string& cell : row) out += " " + cell + " |";
    out += "\n";
    if (head) out += "|---|---|---|---|---|---|---|\n";
    head = false;
  }
  return out;
}

nlohmann::json Report::json() const {
  nlohmann::json out = nlohmann::json::array();
  const auto number = [](double value) { return std::isnan(value) ? nlohmann::json() : nlohmann::json(value); };
  for (const Line* line : ordered()) {
    const Figure& figure = *line->figure;
    for (const auto& [threads, value] : line->values) {
      out.push_back({{"figure", figure.key},
                     {"label", figure.label},
                     {"mesh", line->where},
                     {"threads", threads},
                     {"measured", value.value},
                     {"must", number(bar_of(figure.must, threads))},
                     {"aim", number(bar_of(figure.aim, threads))},
                     {"larger_is_better", figure.larger_is_better},
                     {"reached", verdict(figure, value.value, threads)},
                     {"note", value.note}});
    }
  }
  return out;
}

}  // namespace bench

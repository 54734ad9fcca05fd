#include "bench/markdown.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "bench/machine.h"
#include "gltf/file_write.h"

namespace bench {
namespace {

using json = nlohmann::json;

// A number of a row; "-" where there is none.
std::string print(const char* format, const json& row, const char* pointer) {
  const double value = number_of(row, pointer);
  if (std::isnan(value)) return "-";
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string line(const std::vector<std::string>& cells) {
  std::string out = "|";
  for (const std::string& cell : cells) out += " " + cell + " |";
  return out + "\n";
}

std::string head(const std::vector<std::string>& cells) {
  std::string rule = "|";
  for (size_t i = 0; i < cells.size(); ++i) rule += "---|";
  return line(cells) + rule + "\n";
}

std::string edit_and_solve(const json& row, const std::string& engine) {
  if (!row.contains(engine)) return "-";
  return print("%.1f", row, ("/" + engine + "/edit_ms").c_str()) + " + " +
         print("%.1f", row, ("/" + engine + "/solve_ms").c_str());
}

std::string table1_rows(const json& run) {
  std::string out = "\nTable 1, " + threads_text(run.at("threads")) + ", milliseconds, edit + field:\n\n";
  out += head({"row", "n", "green", "cholmod_updown + solve", "over green", "at most", "CHOLMOD again + solve",
               "over green", "our refactorisation", "over green", "error of green", "of cholmod_updown"});
  for (const json& row : run.at("rows")) {
    out += line({row.at("name"), print("%.0f", row, "/n"), edit_and_solve(row, "green"),
                 edit_and_solve(row, "cholmod_updown"), print("%.1fx", row, "/ratio_updown"),
                 print("%.1fx", row, "/ratio_bound"), edit_and_solve(row, "cholmod_refactor"),
                 print("%.1fx", row, "/ratio_cholmod_refactor"), edit_and_solve(row, "refactor"),
                 print("%.1fx", row, "/ratio_refactor"), print("%.0e", row, "/max_error_vs_exact/green"),
                 print("%.0e", row, "/max_error_vs_exact/cholmod_updown")});
  }
  return out;
}

std::string scaling_rows(const json& run) {
  std::string out = "\nGrowth, " + threads_text(run.at("threads")) + ", and per unit of theory:\n\n";
  out += head({"mesh", "ordering, ms", "ns / n log n", "numeric, ms", "ns / n^1.5", "field, ms", "ns / n log n",
               "+1/-1 edit, ms", "ns / n", "factor, MB", "bytes / n log n", "peak, MB", "bytes / n log n"});
  for (const json& source : run.at("rows")) {
    json row = source;
    row["factor_mb"] = 1e-6 * number_of(row, "/factor_bytes");
    row["peak_mb"] = 1e-6 * number_of(row, "/peak_bytes");
    out += line({row.at("name"), print("%.0f", row, "/ordering_ms"), print("%.0f", row, "/constants/ordering_ms"),
                 print("%.1f", row, "/numeric_ms"), print("%.2f", row, "/constants/numeric_ms"),
                 print("%.2f", row, "/field_ms"), print("%.2f", row, "/constants/field_ms"),
                 print("%.2f", row, "/edit_ms"), print("%.2f", row, "/constants/edit_ms"),
                 print("%.0f", row, "/factor_mb"), print("%.1f", row, "/constants/factor_bytes"),
                 print("%.0f", row, "/peak_mb"), print("%.1f", row, "/constants/peak_bytes")});
  }
  return out;
}

}  // namespace

std::string markdown(const Report& report, const Runs& runs, uint32_t repetitions) {
  std::string threads;
  for (const json& run : runs) {
    const std::string one = threads_text(run.at("threads"));
    if (threads.find(one) == std::string::npos) threads += (threads.empty() ? "" : " / ") + one;
  }
  std::string out = "Measured with " + threads + "; medians of " + std::to_string(repetitions) + " or more.\n\n";
  out += report.markdown();
  for (const json& run : runs) {
    if (run.at("command") == "table1") out += table1_rows(run);
    if (run.at("command") == "scaling") out += scaling_rows(run);
  }
  out += "\n" + head({"machine", ""});
  for (const auto& [name, value] : machine_facts()) out += line({name, value});
  return out;
}

void write_markdown(const std::string& file, const std::string& text) {
  const std::string begin = "<!-- hf_bench: begin -->\n", end = "<!-- hf_bench: end -->";
  std::ifstream stream(file);
  std::stringstream present;
  present << stream.rdbuf();
  const std::string old = present.str();
  const size_t from = old.find(begin), to = old.find(end);
  if (from == std::string::npos || to == std::string::npos || to < from) return write_text(file, text);
  write_text(file, old.substr(0, from + begin.size()) + "\n" + text + "\n" + old.substr(to));
}

void write_text(const std::string& file, const std::string& text) { hf_gltf::write_bytes(file, text); }

}  // namespace bench

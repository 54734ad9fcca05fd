#include "bench/commands.h"

#include <algorithm>
#include <limits>

namespace bench {

std::string threads_text(uint32_t threads) { return std::to_string(threads) + (threads == 1 ? " thread" : " threads"); }

double number_of(const nlohmann::json& row, const char* pointer) {
  const nlohmann::json::json_pointer path(pointer);
  return row.contains(path) && row.at(path).is_number() ? row.at(path).get<double>()
                                                        : std::numeric_limits<double>::quiet_NaN();
}

void write_rows(BarPlot plot, std::initializer_list<Series> series, const Runs& runs, const std::string& file) {
  for (const nlohmann::json& run : runs) {
    for (const nlohmann::json& row : run.at("rows"))
      plot.groups.push_back(row.at("name").get<std::string>() + ", " + threads_text(run.at("threads")));
  }
  for (const Series& one : series) {
    Bars bars{one.name, {}};
    for (const nlohmann::json& run : runs) {
      for (const nlohmann::json& row : run.at("rows")) bars.values.push_back(number_of(row, one.key));
    }
    plot.bars.push_back(std::move(bars));
  }
  write_svg(file, plot);
}

Rows run_meshes(const Run& run, Report& report, nlohmann::json (*run_mesh)(const Mesh&, const Run&, Report*)) {
  Rows rows = Rows::array();
  for (const Family family : families) {
    const auto mesh = make_mesh(family, Size::k304, run.small);
    if (run.wants(mesh->name)) rows.push_back(run_mesh(*mesh, run, &report));
  }
  if (run.small) return rows;
  for (const auto& mesh : real_meshes()) {
    if (run.wants(mesh->name)) rows.push_back(run_mesh(*mesh, run, nullptr));
  }
  return rows;
}

std::vector<std::string> row_names(const Runs& runs) {
  std::vector<std::string> names;
  for (const nlohmann::json& run : runs) {
    for (const nlohmann::json& row : run.at("rows")) {
      const std::string name = row.at("name");
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

const nlohmann::json* find_row(const nlohmann::json& run, const std::string& name) {
  for (const nlohmann::json& row : run.at("rows")) {
    if (row.at("name") == name) return &row;
  }
  return nullptr;
}

}  // namespace bench

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

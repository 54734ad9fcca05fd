#include "bench/machine.h"

#include <cmath>
#include <fstream>
#include <thread>

#include "bench/peer_cholmod.h"
#include "factor/kernels.h"

namespace bench {
namespace {

// The value of a "name : value" line of a file of /proc; empty when there is none.
std::string proc_value(const char* file, const std::string& name) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (line.rfind(name, 0) != 0) continue;
    const size_t begin = line.find_first_not_of(" \t", line.find(':') + 1);
    return begin == std::string::npos ? "" : line.substr(begin);
  }
  return "";
}

std::string first_line(const std::string& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

std::string caches() {
  std::string text;
  for (int i = 0; i < 8; ++i) {
    const std::string folder = "/sys/devices/system/cpu/cpu0/cache/index" + std::to_string(i) + "/";
    const std::string level = first_line(folder + "level"), type = first_line(folder + "type");
    if (level.empty() || type == "Instruction") continue;
    text += (text.empty() ? "L" : ", L") + level + " " + first_line(folder + "size");
  }
  return text.empty() ? "unknown" : text;
}

}  // namespace

std::string machine_name() {
  const std::string name = proc_value("/proc/cpuinfo", "model name");
  return (name.empty() ? "unknown processor" : name) + ", " + std::to_string(std::thread::hardware_concurrency()) +
         " cores";
}

std::vector<std::pair<std::string, std::string>> machine_facts() {
  std::vector<std::pair<std::string, std::string>> facts = {
      {"processor", machine_name()},
      {"family, model, stepping", proc_value("/proc/cpuinfo", "cpu family") + ", " +
                                      proc_value("/proc/cpuinfo", "model\t") + ", " +
                                      proc_value("/proc/cpuinfo", "stepping")},
      {"caches of one core", caches()},
      {"memory",
       std::to_string(std::lround(std::atof(proc_value("/proc/meminfo", "MemTotal").c_str()) / 1048576)) + " GiB"},
      {"huge pages", first_line("/sys/kernel/mm/transparent_hugepage/enabled")},
      {"system", "Linux " + first_line("/proc/sys/kernel/osrelease")},
#ifdef __VERSION__
      {"compiler", __VERSION__},
#endif
      {"kernels chosen", hf_inner::factor::choose_kernels().name},
  };
  for (auto& fact : peer_versions()) facts.push_back(std::move(fact));
  return facts;
}

}  // namespace bench

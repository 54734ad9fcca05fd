#include "bench/bench_support.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <numeric>
#include <set>
#include <stdexcept>
#include <thread>

#include "assets/shapes.h"

namespace bench {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

std::string machine_name() {
  std::ifstream cpu("/proc/cpuinfo");
  std::string line, name = "unknown processor";
  while (std::getline(cpu, line)) {
    if (line.rfind("model name", 0) == 0) {
      name = line.substr(line.find(':') + 2);
      break;
    }
  }
  return name + ", " + std::to_string(std::thread::hardware_concurrency()) + " cores";
}

void check(hf_result result) {
  if (result == HF_OK) return;
  hf_error_detail detail;
  hf_get_error_detail(&detail);
  throw std::runtime_error(std::string(detail.function) + ": " + detail.message);
}

Solver::Solver(const Mesh& mesh, int engine, uint32_t threads, int ordering) {
  hf_create_desc desc;
  HF_INIT(desc);
  desc.vertex_count = mesh.vertex_count();
  desc.triangle_count = static_cast<uint32_t>(mesh.triangles.size() / 3);
  desc.positions_f64 = mesh.positions.data(), desc.triangles = mesh.triangles.data();
  desc.engine = engine, desc.thread_count = threads, desc.ordering = ordering;
  const Clock clock;
  check(hf_create(&desc, &handle_));
  create_ms_ = clock.milliseconds();
}

hf_statistics Solver::statistics() const {
  hf_statistics statistics;
  HF_INIT(statistics);
  check(hf_get_statistics(handle_, &statistics));
  return statistics;
}

double stream_ms(double bytes, uint32_t threads) {
  const size_t count = std::max<size_t>(1, static_cast<size_t>(bytes / 8));
  std::vector<double> data(count, 1.0);
  std::vector<double> times;
  volatile double sink = 0;
  for (int repetition = 0; repetition < 7; ++repetition) {
    const Clock clock;
    std::vector<std::thread> helpers;
    std::vector<double> sums(threads, 0.0);
    const auto read = [&](uint32_t t) {
      const size_t begin = count * t / threads, end = count * (t + 1) / threads;
      double s[8] = {0, 0, 0, 0, 0, 0, 0, 0};
      size_t i = begin;
      for (; i + 8 <= end; i += 8) {
        for (size_t k = 0; k < 8; ++k) s[k] += data[i + k];
      }
      sums[t] = std::accumulate(s, s + 8, 0.0);
    };
    for (uint32_t t = 1; t < threads; ++t) helpers.emplace_back(read, t);
    read(0);
    for (std::thread& helper : helpers) helper.join();
    times.push_back(clock.milliseconds());
    sink = sink + std::accumulate(sums.begin(), sums.end(), 0.0);
  }
  return median(times);
}

std::vector<uint32_t> scattered_vertices(uint32_t vertex_count, uint32_t count, uint64_t seed) {
  std::set<uint32_t> seen;
  std::vector<uint32_t> vertices;
  for (uint64_t i = 0; vertices.size() < count; ++i) {
    const uint32_t v = static_cast<uint32_t>(samples::hash_to_unit(seed, i) * vertex_count);
    if (v < vertex_count && seen.insert(v).second) vertices.push_back(v);
  }
  return vertices;
}

void write_json(const std::string& file, const nlohmann::json& value) {
  if (file.empty()) return;
  std::ofstream stream(file + ".part");
  stream << value.dump(1) << "\n";
  stream.close();
  if (!stream || std::rename((file + ".part").c_str(), file.c_str()) != 0)
    throw std::runtime_error(file + ": cannot be written");
}

double value_of(uint32_t vertex) { return samples::hash_to_unit(77, vertex); }

}  // namespace bench

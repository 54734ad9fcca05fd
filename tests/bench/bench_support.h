// What the benchmarks share: timing, medians, the machine's name, solvers made through the C ABI. Every figure is taken
// from outside, as a host program would see it.
#ifndef HF_BENCH_SUPPORT_H
#define HF_BENCH_SUPPORT_H

#include <chrono>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hf/hf.h"

namespace bench {

class Clock {
 public:
  double milliseconds() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

double median(std::vector<double> values);
std::string machine_name();
// Throws with the detail of the failing call.
void check(hf_result result);

struct Mesh {
  std::string name;
  std::vector<double> positions;
  std::vector<uint32_t> triangles;
  uint32_t vertex_count() const { return static_cast<uint32_t>(positions.size() / 3); }
};

// A solver of the C ABI that is destroyed with its scope.
class Solver {
 public:
  Solver(const Mesh& mesh, int engine, uint32_t threads, int ordering = HF_ORDERING_NESTED_DISSECTION);
  ~Solver() { hf_destroy(handle_); }
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;
  hf_solver handle() const { return handle_; }
  double create_ms() const { return create_ms_; }
  hf_statistics statistics() const;

 private:
  hf_solver handle_ = nullptr;
  double create_ms_ = 0;
};

// Milliseconds to read this many bytes once from memory with this many threads: the floor under every sweep.
double stream_ms(double bytes, uint32_t threads);

// Deterministic: different vertices, spread by a hash.
std::vector<uint32_t> scattered_vertices(uint32_t vertex_count, uint32_t count, uint64_t seed);
// Deterministic value in [0, 1) of a vertex.
double value_of(uint32_t vertex);

struct Arguments {
  uint32_t threads = 1, repetitions = 5;
  std::string json_file, rows;
};
// Writes a JSON file by a temporary name; nothing when the name is empty.
void write_json(const std::string& file, const nlohmann::json& value);

int table1(const Arguments& arguments);
int large_sites(const Arguments& arguments);
int partial(const Arguments& arguments);

}  // namespace bench

#endif

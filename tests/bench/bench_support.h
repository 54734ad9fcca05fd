// What the benchmarks share: timing, medians, solvers made through the C ABI, sites chosen by a hash.
//
// Every figure is taken from outside, as a host program would see it; what the ABI cannot show (the ordering alone, one
// permutation for us and the peer, the single-precision sweep) goes through inner_factor.h.
#ifndef HF_BENCH_SUPPORT_H
#define HF_BENCH_SUPPORT_H

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hf/hf.h"
#include "support/peers.h"

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
// Milliseconds of one call of `work`.
double time_ms(const std::function<void()>& work);
// Median of `count` calls.
double median_ms(uint32_t count, const std::function<void()>& work);

// Candidates and baselines in turns, so that a noisy minute of the machine falls on all of them: `rounds` times, each
// runs once untimed and three times timed. A candidate returns its own milliseconds. Medians by name.
using Candidate = std::pair<std::string, std::function<double()>>;
std::map<std::string, double> take_turns(const std::vector<Candidate>& candidates, uint32_t rounds);

// Throws with the detail of the failing call.
void check(hf_result result);

struct Mesh {
  std::string name;
  std::vector<double> positions;
  std::vector<uint32_t> triangles;
  uint32_t vertex_count() const { return static_cast<uint32_t>(positions.size() / 3); }
};

struct SolverOptions {
  int engine = ENGINE_GREEN;  // of support/peers.h
  uint32_t threads = 1;
  int ordering = HF_ORDERING_NESTED_DISSECTION;
  uint32_t channels = 1;
  int operator_kind = HF_OPERATOR_COTANGENT;  // what the peers factorise; not the library's default
  int field_kind = HF_FIELD_HARMONIC;
  const hf_factor_desc* saved_factor = nullptr;
};

// The library as it comes, for figures without a peer that factorises the same matrix.
inline SolverOptions own_defaults(uint32_t threads) {
  SolverOptions options;
  options.threads = threads;
  options.operator_kind = HF_OPERATOR_INTRINSIC_DELAUNAY;
  return options;
}

// A surface of the C ABI and a solver on it, destroyed with their scope.
class Solver {
 public:
  Solver(const Mesh& mesh, const SolverOptions& options);
  ~Solver() {
    hf_solver_destroy(handle_);
    hf_surface_destroy(surface_);
  }
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;
  hf_solver handle() const { return handle_; }
  hf_surface surface() const { return surface_; }
  double create_ms() const { return create_ms_; }
  hf_solver_statistics statistics() const;
  hf_surface_statistics surface_statistics() const;
  uint32_t vertex_count() const { return vertex_count_; }
  uint32_t channels() const { return channels_; }

  // Whole field in single precision, as a host draws it; and in double.
  void solve(std::vector<float>& field) const;
  void solve(std::vector<double>& field) const;

 private:
  hf_surface surface_ = nullptr;
  hf_solver handle_ = nullptr;
  uint32_t vertex_count_, channels_;
  double create_ms_ = 0;
};

// The vertex sites of a solver by vertex. Channel c of a site holds value_of(vertex) + c + offset.
class Sites {
 public:
  explicit Sites(const Solver& solver, double offset = 0) : solver_(solver), offset_(offset) {}
  // One batch through hf_solver_edit_sites; milliseconds of that call.
  double edit(const std::vector<uint32_t>& insert, const std::vector<uint32_t>& remove);
  double clear();
  // Moves the site of one vertex to another.
  void move(uint32_t from, uint32_t to);
  void set_value(uint32_t vertex, double value);
  bool has(uint32_t vertex) const { return number_.count(vertex) != 0; }
  const std::map<uint32_t, uint32_t>& numbers() const { return number_; }

 private:
  const Solver& solver_;
  double offset_;
  std::map<uint32_t, uint32_t> number_;  // vertex -> site
};

// Deterministic: different vertices, spread by a hash.
std::vector<uint32_t> scattered_vertices(uint32_t vertex_count, uint32_t count, uint64_t seed);
// Deterministic value in [0, 1) of a vertex.
double value_of(uint32_t vertex);

double largest_difference(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace bench

#endif

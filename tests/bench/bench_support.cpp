#include "bench/bench_support.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "assets/shapes.h"
#include "support/arrays.h"

namespace bench {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

double time_ms(const std::function<void()>& work) {
  const Clock clock;
  work();
  return clock.milliseconds();
}

double median_ms(uint32_t count, const std::function<void()>& work) {
  std::vector<double> times;
  for (uint32_t i = 0; i < count; ++i) times.push_back(time_ms(work));
  return median(times);
}

std::map<std::string, double> take_turns(const std::vector<Candidate>& candidates, uint32_t rounds) {
  std::map<std::string, std::vector<double>> times;
  for (uint32_t round = 0; round < rounds; ++round) {
    for (const auto& [name, once] : candidates) {
      once();
      for (int i = 0; i < 3; ++i) times[name].push_back(once());
    }
  }
  std::map<std::string, double> medians;
  for (const auto& [name, values] : times) medians[name] = median(values);
  return medians;
}

void check(hf_result result) {
  if (result == HF_OK) return;
  hf_error_detail detail;
  hf_error_get_detail(&detail);
  throw std::runtime_error(std::string(detail.function) + ": " + detail.message);
}

Solver::Solver(const Mesh& mesh, const SolverOptions& options)
    : vertex_count_(mesh.vertex_count()), channels_(options.channels) {
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.positions = HF_ARRAY(mesh.positions.data(), mesh.vertex_count());
  desc.triangles = HF_ARRAY(mesh.triangles.data(), mesh.triangles.size() / 3);
  desc.thread_count = options.threads;
  desc.ordering = options.ordering;
  desc.operator_kind = options.operator_kind;
  desc.field_kind = options.field_kind;
  desc.saved_factor = options.saved_factor;
  hf_solver_desc sites = HF_INIT(hf_solver_desc);
  sites.channel_count = options.channels;
  sites.field_kind = options.field_kind;
  create_ms_ = time_ms([&] {
    check(hf_surface_create(&desc, &surface_));
    check(create_with(options.engine, surface_, &sites, &handle_));
  });
}

hf_solver_statistics Solver::statistics() const {
  hf_solver_statistics statistics = HF_INIT(hf_solver_statistics);
  check(hf_solver_get_statistics(handle_, &statistics));
  return statistics;
}

hf_surface_statistics Solver::surface_statistics() const {
  hf_surface_statistics statistics = HF_INIT(hf_surface_statistics);
  check(hf_surface_get_statistics(surface_, &statistics));
  return statistics;
}

void Solver::solve(std::vector<float>& field) const {
  field.resize(size_t{vertex_count_} * channels_);
  check(hf_solve(handle_, field.data(), 0, nullptr));
}

void Solver::solve(std::vector<double>& field) const {
  field.resize(size_t{vertex_count_} * channels_);
  check(hf_solver_solve(handle_, OUT(field.data()), nullptr));
}

double Sites::edit(const std::vector<uint32_t>& insert, const std::vector<uint32_t>& remove) {
  if (insert.empty() && remove.empty()) return 0;
  std::vector<uint32_t> leaving, numbers(insert.size());
  std::vector<double> values;
  for (const uint32_t v : remove) leaving.push_back(number_.at(v));
  for (const uint32_t v : insert) {
    for (uint32_t c = 0; c < solver_.channels(); ++c) values.push_back(value_of(v) + c + offset_);
  }
  hf_sites_desc add = HF_INIT(hf_sites_desc);
  add.site_count = static_cast<uint32_t>(insert.size());
  add.vertices = insert.data();
  add.values = values.data();
  hf_edit_desc edit = HF_INIT(hf_edit_desc);
  edit.remove_count = static_cast<uint32_t>(leaving.size());
  edit.remove_sites = leaving.data();
  if (!insert.empty()) edit.add = &add;
  const double ms = time_ms([&] { check(hf_solver_edit_sites(solver_.handle(), &edit, numbers.data())); });
  for (const uint32_t v : remove) number_.erase(v);
  for (size_t i = 0; i < insert.size(); ++i) number_[insert[i]] = numbers[i];
  return ms;
}

double Sites::clear() {
  std::vector<uint32_t> all;
  for (const auto& [vertex, number] : number_) all.push_back(vertex);
  return edit({}, all);
}

void Sites::move(uint32_t from, uint32_t to) {
  const uint32_t number = number_.at(from);
  hf_sites_desc place = HF_INIT(hf_sites_desc);
  place.site_count = 1;
  place.vertices = &to;
  check(hf_solver_move_sites(solver_.handle(), 1, &number, &place));
  number_.erase(from);
  number_[to] = number;
}

void Sites::set_value(uint32_t vertex, double value) {
  const std::vector<double> values(solver_.channels(), value + offset_);
  check(hf_solver_set_values(solver_.handle(), 1, &number_.at(vertex), values.data()));
}

std::vector<uint32_t> scattered_vertices(uint32_t vertex_count, uint32_t count, uint64_t seed) {
  if (count > vertex_count / 2)
    throw std::runtime_error("a mesh of " + std::to_string(vertex_count) + " vertices is too small for " +
                             std::to_string(count) + " scattered sites");
  std::set<uint32_t> seen;
  std::vector<uint32_t> vertices;
  for (uint64_t i = 0; vertices.size() < count; ++i) {
    const uint32_t v = static_cast<uint32_t>(samples::hash_to_unit(seed, i) * vertex_count);
    if (v < vertex_count && seen.insert(v).second) vertices.push_back(v);
  }
  return vertices;
}

double value_of(uint32_t vertex) { return samples::hash_to_unit(77, vertex); }

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = 0;
  for (size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::fabs(a[i] - b[i]));
  return worst;
}

}  // namespace bench

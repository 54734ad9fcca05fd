// One field and what bounds it. A field is taken as a host takes it: 100 sites, one value changed, hf_solve; 1, 3 and 8
// channels. Beside it: cholmod_solve (as called, and with kept workspace, which is the stricter peer), one read of the
// stored factor with the same threads, and the bare backward sweep of the factor in double and in single precision.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bench/bench_mesh.h"
#include "bench/commands.h"
#include "bench/inner_factor.h"
#include "bench/peer_cholmod.h"
#include "bench/read_once.h"
#include "bench/svg_plot.h"
#include "factor/preview.h"

namespace bench {
namespace {

using json = nlohmann::json;

// A solver with sites of which one changes its value before every field.
class FieldSource {
 public:
  FieldSource(const Mesh& mesh, const std::vector<uint32_t>& vertices, uint32_t threads, uint32_t channels)
      : solver_(mesh, {ENGINE_GREEN, threads, HF_ORDERING_NESTED_DISSECTION, channels}),
        sites_(solver_),
        vertices_(vertices) {
    sites_.edit(vertices, {});
  }
  double ms() {
    ++turn_;
    sites_.set_value(vertices_[turn_ % vertices_.size()], value_of(turn_));
    return time_ms([&] { solver_.solve(field_); });
  }
  double factor_bytes() const { return solver_.surface_statistics().factor_bytes; }

 private:
  Solver solver_;
  Sites sites_;
  const std::vector<uint32_t>& vertices_;
  std::vector<float> field_;
  uint32_t turn_ = 0;
};

// The bare backward sweep of the factor in double and in single precision.
class BareSweep {
 public:
  BareSweep(const Mesh& mesh, uint32_t threads)
      : system_(mesh, threads),
        factor_(hf_inner::factor::Factor::make(system_.matrix(), system_.coordinates(), {}, system_.memory(),
                                               system_.jobs())),
        preview_(hf_inner::factor::PreviewFactor::make(*factor_, system_.memory(), system_.jobs())),
        wide_(system_.memory(), static_cast<size_t>(factor_->size())),
        narrow_(system_.memory(), wide_.size()) {}
  double double_ms() {
    for (size_t i = 0; i < wide_.size(); ++i) wide_[i] = right(i);
    return time_ms([&] { factor_->backward(wide_.data(), 1, system_.jobs()); });
  }
  double float32_ms() {
    for (size_t i = 0; i < narrow_.size(); ++i) narrow_[i] = static_cast<float>(right(i));
    return time_ms([&] { preview_->backward(narrow_.data(), 1, system_.jobs()); });
  }
  // Largest difference of the last two results over the largest value.
  double difference() const {
    double size = 0, error = 0;
    for (size_t i = 0; i < wide_.size(); ++i) {
      size = std::max(size, std::fabs(wide_[i]));
      error = std::max(error, std::fabs(wide_[i] - double{narrow_[i]}));
    }
    return error / size;
  }

 private:
  static double right(size_t i) { return std::sin(0.1 * static_cast<double>(i)); }
  InnerSystem system_;
  std::shared_ptr<const hf_inner::factor::Factor> factor_;
  std::shared_ptr<const hf_inner::factor::PreviewFactor> preview_;
  hf_inner::Buffer<double> wide_;
  hf_inner::Buffer<float> narrow_;
};

void print(const json& row) {
  const auto value = [&](const char* key) { return number_of(row, key); };
  const double one = value("/field_ms"), read = value("/read_once_ms"), bare = value("/sweep_ms");
  std::printf(
      "%-14s field %6.2f ms, 3 channels %.2f (%.2fx), 8 channels %.2f (%.2fx); factor %.1f MB read once in %.2f ms: "
      "field %.2fx of it, bare sweep %.2f ms (%.2fx)\n",
      row.at("name").get<std::string>().c_str(), one, value("/field_3_ms"), value("/field_3_ms") / one,
      value("/field_8_ms"), value("/field_8_ms") / one, 1e-6 * value("/factor_bytes"), read, one / read, bare,
      bare / read);
  std::printf("%-14s float32 sweep %.2f ms, %.2fx of double, relative difference %.1e\n", "",
              value("/sweep_float32_ms"), value("/sweep_float32_ms") / bare, value("/float32_difference"));
  if (!row.contains("cholmod_solve_ms")) return;
  std::printf(
      "%-14s cholmod_solve %.2f ms (%.2fx); kept workspace, 1 / 3 / 8 columns %.2f (%.2fx) / %.2f (%.2fx) / %.2f "
      "(%.2fx)\n",
      "", value("/cholmod_solve_ms"), value("/cholmod_solve_ms") / one, value("/cholmod_solve2_ms"),
      value("/cholmod_solve2_ms") / one, value("/cholmod_solve2_3_ms"),
      value("/cholmod_solve2_3_ms") / value("/field_3_ms"), value("/cholmod_solve2_8_ms"),
      value("/cholmod_solve2_8_ms") / value("/field_8_ms"));
}

json sweep_mesh(const Mesh& mesh, const Run& run, Report* report) {
  const std::vector<uint32_t> vertices = scattered_vertices(mesh.vertex_count(), 100, 3);
  FieldSource one(mesh, vertices, run.threads, 1), three(mesh, vertices, run.threads, 3),
      eight(mesh, vertices, run.threads, 8);
  Reader reader(one.factor_bytes(), run.threads);
  BareSweep bare(mesh, run.threads);
  const auto peer = CholmodPeer::make(cotangent_matrix(mesh), run.threads);
  std::vector<Candidate> candidates = {
      {"read_once_ms", [&] { return reader.ms(); }},  {"field_ms", [&] { return one.ms(); }},
      {"field_3_ms", [&] { return three.ms(); }},     {"field_8_ms", [&] { return eight.ms(); }},
      {"sweep_ms", [&] { return bare.double_ms(); }}, {"sweep_float32_ms", [&] { return bare.float32_ms(); }}};
  if (peer) {
    peer->analyse_ms();
    peer->set_sites(vertices);
    peer->factorise_ms();
    candidates.insert(candidates.end(), {{"cholmod_solve_ms", [&] { return peer->solve_ms(); }},
                                         {"cholmod_solve_serial_ms", [&] { return peer->solve_ms(1); }},
                                         {"cholmod_solve2_ms", [&] { return peer->solve_kept_ms(1); }},
                                         {"cholmod_solve2_3_ms", [&] { return peer->solve_kept_ms(3); }},
                                         {"cholmod_solve2_8_ms", [&] { return peer->solve_kept_ms(8); }}});
  }
  json row = {{"name", mesh.name}, {"n", mesh.vertex_count()}, {"factor_bytes", one.factor_bytes()}};
  for (const auto& [name, ms] : take_turns(candidates, run.repetitions)) row[name] = ms;
  row["float32_difference"] = bare.difference();
  // should more threads of BLAS not help the peer, it gets one
  if (peer) row["cholmod_solve_ms"] = std::min(row["cholmod_solve_ms"], row["cholmod_solve_serial_ms"]);
  print(row);
  std::fflush(stdout);
  if (!report) return row;
  const auto ratio = [&](const char* figure, const char* over, const char* under) {
    report->measure(figure, mesh.name, run.threads, number_of(row, over) / number_of(row, under));
  };
  ratio("sweep_read", "/field_ms", "/read_once_ms");
  ratio("channels_3", "/field_3_ms", "/field_ms");
  ratio("channels_8", "/field_8_ms", "/field_ms");
  ratio("float32", "/sweep_float32_ms", "/sweep_ms");
  if (peer) ratio("sweep_solve", "/cholmod_solve_ms", "/field_ms");
  return row;
}

}  // namespace

Rows run_sweep(const Run& run, Report& report) { return run_meshes(run, report, sweep_mesh); }

void plot_sweep(const Runs& runs, const std::string& file) {
  BarPlot plot;
  plot.text = {"One field", "median milliseconds; the floor is one read of the stored factor", "", "ms (logarithmic)"};
  plot.log_y = true;
  plot.format = "%.1f";
  write_rows(plot,
             {{"reading the factor once", "/read_once_ms"},
              {"bare float32 sweep", "/sweep_float32_ms"},
              {"bare double sweep", "/sweep_ms"},
              {"hf_solve, 1 channel", "/field_ms"},
              {"hf_solve, 3 channels", "/field_3_ms"},
              {"hf_solve, 8 channels", "/field_8_ms"},
              {"cholmod_solve, 1 column", "/cholmod_solve_ms"}},
             runs, file);
}

}  // namespace bench

// hf_bench: see --help. Figures are medians; compare ratios, machines are noisy.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iterator>
#include <stdexcept>

#include "bench/commands.h"
#include "bench/machine.h"
#include "bench/markdown.h"
#include "bench/peer_cholmod.h"

namespace {

using bench::Command;

constexpr Command commands[] = {
    {"first-field", "create + 10 sites + first field, against METIS + CHOLMOD doing the same", bench::run_first_field,
     bench::plot_first_field},
    {"factor", "ordering, symbolic analysis, numeric factorisation, loading, in parts, against METIS and CHOLMOD",
     bench::run_factor, bench::plot_factor},
    {"sweep", "one field against cholmod_solve and against reading the factor once; 3 and 8 fields; float32",
     bench::run_sweep, bench::plot_sweep},
    {"table1", "Table 1 of Xu, Zhang, Cohen-Or and Xiong (2009): edit and full field, all engines and CHOLMOD",
     bench::run_table1, bench::plot_table1},
    {"large-sites", "100 to 10,000 sites at once, against our own refactorisation", bench::run_large_sites,
     bench::plot_large_sites},
    {"edits", "30 to 1,000 vertices made stiff and the field, against a fresh surface", bench::run_edits,
     bench::plot_edits},
    {"memory", "peak of create + solve over the bytes of the factor, 10K to 1M vertices", bench::run_memory,
     bench::plot_memory},
    {"accuracy", "site error, residual, error after 10,000 random edits, bi-harmonic refinement", bench::run_accuracy,
     bench::plot_accuracy},
    {"scaling", "time and memory from 10K to 1M vertices, divided by theory", bench::run_scaling, bench::plot_scaling},
    {"paths", "path solves and Gram matrix of 1 to 300 sites: what an insertion costs inside", bench::run_paths,
     bench::plot_paths},
    {"partial", "the field at ten vertices against the whole field, 4K to 304K vertices", bench::run_partial,
     bench::plot_partial},
    {"analysis", "extremities from a Poisson field and from 40 geodesic distances, in sweeps of one field",
     bench::run_analysis, bench::plot_analysis},
    {"flow", "streamlines that follow a dragged site, against tracing on a fresh factorisation", bench::run_flow,
     bench::plot_flow},
    {"directions", "a constraint vector turned or rewritten, and the field, against factorising again, 120K vertices",
     bench::run_directions, bench::plot_directions},
    {"deform", "a drag frame, a new handle, a refined frame, against ARAP iterations and from scratch; exactness",
     bench::run_deform, bench::plot_deform},
    {"deform-quality", "classic poses and a scan beside the paper's scheme and converged ARAP",
     bench::run_deform_quality, bench::plot_deform_quality},
    {"detail", "a region grown by 284 boundary sites and its membrane, 115K vertices, against solving afresh",
     bench::run_detail, bench::plot_detail},
    {"transfer", "frames a second from one source to one target and to a crowd of eight clones", bench::run_transfer,
     bench::plot_transfer},
    {"weights", "skin weights from bones, a moved bone, a pin, weights carried, 3K to 70K vertices", bench::run_weights,
     bench::plot_weights},
};

constexpr size_t engine_commands = 9;  // first-field to scaling: the factor and the engines, without the rest

void print_usage() {
  std::fputs(
      "usage: hf_bench COMMAND [options]\n"
      "  Measures the library beside CHOLMOD, METIS and itself; prints rows as it goes, then the table of figures:\n"
      "  figure | mesh | measured | must | aim | reached. Times are milliseconds, figures ratios of medians of one "
      "run.\n"
      "  Meshes: 304,152-vertex jittered torus and a generated horse unless a row names another size; real scans "
      "where\n"
      "  the shared data folder is present. Without HF_WITH_GPL there is no peer, and its figures are left out.\n"
      "\n"
      "commands\n",
      stdout);
  for (const Command& command : commands) std::printf("  %-14s %s\n", command.name, command.help);
  std::fputs(
      "  all            every command, one after the other\n"
      "  engines        first-field to scaling: the factor and the engines only\n"
      "\n"
      "options\n"
      "  --threads N[,M]   threads for us and for the peer's BLAS; with a list, one run each (default 1; for all and "
      "engines: 1,2)\n"
      "  --repeat N        repetitions of every measurement (default 5)\n"
      "  --rows TEXT       only rows whose names contain TEXT, such as creature, 304K or +1/-1\n"
      "  --json FILE       everything measured, with the machine and the figures\n"
      "  --markdown FILE   the tables and the machine; a file with the marks of docs/benchmarks.md keeps the rest\n"
      "  --plot PATH       SVG pictures: a file for one command, or a folder that gets COMMAND.svg\n"
      "  --small           meshes of a few thousand vertices: a smoke test, its figures mean nothing\n",
      stdout);
}

struct Arguments {
  std::vector<const Command*> commands;
  std::vector<uint32_t> threads;
  bench::Run run;
  std::string json_file, markdown_file, plot_path;
};

uint32_t read_number(const std::string& text) {
  char* end = nullptr;
  const unsigned long value = std::strtoul(text.c_str(), &end, 10);
  if (text.empty() || *end != '\0' || text[0] < '0' || text[0] > '9' || value < 1 || value > 10000)
    throw std::runtime_error("\"" + text + "\" is not a whole number from 1 to 10000");
  return static_cast<uint32_t>(value);
}

std::vector<uint32_t> read_thread_list(const std::string& text) {
  std::vector<uint32_t> threads;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    threads.push_back(read_number(text.substr(begin, end - begin)));
    if (threads.back() > 256) throw std::runtime_error("--threads takes 1 to 256");
    begin = end + 1;
  }
  return threads;
}

Arguments read_arguments(const std::vector<std::string>& words) {
  Arguments arguments;
  const bool all = words[0] == "all" || words[0] == "engines";
  const size_t count = std::size(commands);
  for (size_t i = 0; i < count; ++i) {
    if (words[0] == "all" || words[0] == commands[i].name || (words[0] == "engines" && i < engine_commands))
      arguments.commands.push_back(&commands[i]);
  }
  if (arguments.commands.empty()) throw std::runtime_error("unknown command " + words[0] + "; see --help");
  arguments.threads = all ? std::vector<uint32_t>{1, 2} : std::vector<uint32_t>{1};
  for (size_t i = 1; i < words.size(); ++i) {
    const std::string& option = words[i];
    const auto next = [&] {
      if (i + 1 == words.size()) throw std::runtime_error(option + " needs a value; see --help");
      return words[++i];
    };
    if (option == "--small")
      arguments.run.small = true;
    else if (option == "--threads")
      arguments.threads = read_thread_list(next());
    else if (option == "--repeat")
      arguments.run.repetitions = read_number(next());
    else if (option == "--rows")
      arguments.run.rows = next();
    else if (option == "--json")
      arguments.json_file = next();
    else if (option == "--markdown")
      arguments.markdown_file = next();
    else if (option == "--plot")
      arguments.plot_path = next();
    else
      throw std::runtime_error("unknown option " + option + "; see --help");
  }
  const bool file = std::filesystem::path(arguments.plot_path).extension() == ".svg";
  if (file && arguments.commands.size() > 1)
    throw std::runtime_error("--plot needs a folder when there are several commands");
  return arguments;
}

void draw(const Arguments& arguments, const Command& command, const bench::Runs& runs) {
  if (arguments.plot_path.empty()) return;
  for (const nlohmann::json& run : runs) {
    if (run.at("rows").empty()) return;
  }
  const std::filesystem::path path(arguments.plot_path);
  if (path.extension() == ".svg") return command.plot(runs, path.string());
  std::filesystem::create_directories(path);
  command.plot(runs, (path / (std::string(command.name) + ".svg")).string());
}

// One command at one number of threads: the object --json writes. Several: {machine, figures, runs: [those objects]}.
int run(const Arguments& arguments) {
  bench::Report report;
  bench::Runs all;
  for (const Command* command : arguments.commands) {
    bench::Runs runs;
    for (const uint32_t threads : arguments.threads) {
      std::printf("== %s: %s, %s\n", command->name, bench::machine_name().c_str(),
                  bench::threads_text(threads).c_str());
      std::fflush(stdout);
      bench::Run one = arguments.run;
      one.threads = threads;
      runs.push_back({{"command", command->name},
                      {"machine", bench::machine_name()},
                      {"threads", threads},
                      {"rows", command->run(one, report)}});
      all.push_back(runs.back());
    }
    draw(arguments, *command, runs);
  }
  if (!report.empty()) std::printf("\n%s", report.text().c_str());
  if (arguments.run.small) std::printf("(--small: these figures mean nothing)\n");
  nlohmann::json out = all.size() == 1 ? all[0] : nlohmann::json{{"machine", bench::machine_name()}, {"runs", all}};
  for (const auto& [name, value] : bench::machine_facts()) out["machine_facts"][name] = value;
  out["figures"] = report.json();
  if (!arguments.json_file.empty()) bench::write_text(arguments.json_file, out.dump(1) + "\n");
  if (!arguments.markdown_file.empty())
    bench::write_markdown(arguments.markdown_file, bench::markdown(report, all, arguments.run.repetitions));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.empty() || words[0] == "--help" || words[0] == "-h") {
    print_usage();
    return words.empty() ? 1 : 0;
  }
  bench::give_peer_fitting_blas(argv);
  try {
    return run(read_arguments(words));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "hf_bench: %s\n", error.what());
  }
  return 1;
}

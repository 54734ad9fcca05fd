// reliability_growth [--full] [--only TEXT] [FOLDER]: time and memory of every structure at four sizes, and the slope.
// The quick form takes the least and the largest of the four.
// FOLDER holds the sample programs; with it, hostile files of 1 MB are given to each of them.
//
// The full form allows a slope of 1.25, or what theory says. Other programs share the processor with the quick form:
// its sizes are large enough to tell 1 from 2, and it allows 0.35 more.
#include "growth.h"

#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <new>
#include <random>

#include "report.h"

namespace {

std::atomic<std::size_t> held{0}, most{0};

void* counted(std::size_t size, std::size_t alignment) {
  void* const block = alignment > 16 ? std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment)
                                     : std::malloc(size ? size : 1);
  if (!block) throw std::bad_alloc();
  const std::size_t now = held += malloc_usable_size(block);
  for (std::size_t seen = most; seen < now && !most.compare_exchange_weak(seen, now);) {
  }
  return block;
}

void uncounted(void* block) noexcept {
  if (!block) return;
  held -= malloc_usable_size(block);
  std::free(block);
}

}  // namespace

void* operator new(std::size_t size) { return counted(size, 0); }
void* operator new[](std::size_t size) { return counted(size, 0); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* block) noexcept { uncounted(block); }
void operator delete[](void* block) noexcept { uncounted(block); }
void operator delete(void* block, std::size_t) noexcept { uncounted(block); }
void operator delete[](void* block, std::size_t) noexcept { uncounted(block); }
void operator delete(void* block, std::align_val_t) noexcept { uncounted(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { uncounted(block); }

namespace growth {

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}
std::size_t held_bytes() { return held; }
std::size_t most_bytes() { return most; }
void reset_most_bytes() { most = held.load(); }

double slope(const std::vector<std::size_t>& sizes, const std::vector<double>& values) {
  double x = 0, y = 0, xx = 0, xy = 0;
  const auto n = static_cast<double>(sizes.size());
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const double a = std::log(static_cast<double>(sizes[i])), b = std::log(values[i]);
    x += a;
    y += b;
    xx += a * a;
    xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

}  // namespace growth

namespace {

using namespace growth;

void measure(const Structure& structure, const std::vector<std::size_t>& sizes, int repetitions, std::vector<double>& seconds, std::vector<double>& bytes) {
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    for (int k = 0; k < repetitions; ++k) {
      const auto work = structure.run(sizes[i]);
      const std::size_t before = held_bytes();
      reset_most_bytes();
      const double begin = thread_seconds();
      work();
      // a clock tick at least, so that the logarithm exists
      seconds[i] = std::min(seconds[i], std::max(thread_seconds() - begin, 1e-6));
      bytes[i] = std::max(bytes[i], static_cast<double>(most_bytes() - before));
    }
  }
}

void judge(const Structure& structure, bool full) {
  const double steepest = structure.steepest + (full ? 0 : 0.35);
  std::vector<std::size_t> sizes = structure.sizes;
  if (!full) sizes = {sizes.front(), sizes.back()};
  std::vector<double> seconds(sizes.size(), 1e9), bytes(sizes.size(), 1);
  // a noisy machine: what is too steep is measured again, and the least of all repetitions counts
  double time_slope = 0, each = 0;
  for (int attempt = 0; attempt < 4; ++attempt) {
    measure(structure, sizes, full ? 3 : 1, seconds, bytes);
    time_slope = slope(sizes, seconds);
    each = 1e6 * seconds.back() / static_cast<double>(sizes.back());
    if (time_slope <= steepest && (structure.most_microseconds <= 0 || each <= structure.most_microseconds)) break;
  }
  const double memory_slope = slope(sizes, bytes);
  std::printf("# %-24s", structure.name.c_str());
  for (std::size_t i = 0; i < sizes.size(); ++i)
    std::printf(" %zu: %.4f s %.1f MB;", sizes[i], seconds[i], bytes[i] / 1e6);
  std::printf("\n");
  report_at_most(("growth_" + structure.name + "_time").c_str(), time_slope, steepest);
  if (structure.most_microseconds > 0)
    report_at_most(("growth_" + structure.name + "_microseconds").c_str(), each, structure.most_microseconds);
  // small blocks and doubling tables make steps; below a megabyte they are all there is
  if (bytes.back() > 1e6) report_at_most(("growth_" + structure.name + "_memory").c_str(), memory_slope, steepest);
}

// ---- files of 1 MB given to the programs ----

// A program takes at most 2 s for such a file: that is promised, and the full form judges by it. The quick form takes
// files of half the size, whose times and memory are half as large where they grow as they should. It allows more, like
// for slopes, since it runs on machines of any speed beside any other work: 1.75 s, twice what the slowest program
// takes on a slow EPYC. Without limits the first soup took 29.6 s for 1 MB.
constexpr double most_seconds = 2, most_quick_seconds = 1.75, most_megabytes = 200, most_quick_megabytes = 110;

struct Cost {
  double seconds = 0, megabytes = 0;
  bool ended = false;  // by itself, with or without an error
};

Cost cost_of(const std::vector<std::string>& command) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    const rlimit limit{20, 20};
    setrlimit(RLIMIT_CPU, &limit);
    if (!std::freopen("/dev/null", "w", stdout) || !std::freopen("/dev/null", "w", stderr)) _exit(126);
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    execv(arguments[0], arguments.data());
    _exit(126);
  }
  int status = 0;
  rusage used{};
  wait4(child, &status, 0, &used);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return {seconds(used.ru_utime) + seconds(used.ru_stime), static_cast<double>(used.ru_maxrss) / 1024,
          WIFEXITED(status) && WEXITSTATUS(status) < 126};
}

struct Program {
  const char* name;
  std::vector<std::string> arguments;  // "FILE" stands for the file
};

// Every program that reads models. joints: a command that makes no surface, for all kinds of files in the quick form.
std::vector<Program> programs_that_read(const std::string& folder) {
  const auto at = [&](const char* name) { return folder + "/" + name; };
  std::ofstream(at("pose.json"))
      << R"({"steps": [{"add": [{"name": "low", "box": [[0, 0, 0], [0.4, 0.4, 1]]}, {"name": "high", "box": [[0.6, 0, 0], [1, 1, 1]]}]},
                       {"drag": {"high": {"move": [0.1, 0, 0]}}, "seconds": 0.5}]})";
  std::ofstream(at("rig.json"))
      << R"({"handles": [{"name": "low", "box": [[0, 0, 0], [0.4, 0.4, 1]]}, {"name": "high", "box": [[0.6, 0, 0], [1, 1, 1]]}],
            "clips": [{"name": "nod", "steps": [{"drag": {"high": {"move": [0.1, 0, 0]}}, "seconds": 0.5}]}]})";
  std::ofstream(at("curve.json")) << R"({"points": [{"vertex": 0}, {"vertex": 1}, {"vertex": 2}], "side": "smaller"})";
  return {
      {"hf_transfer", {"--joints", "FILE"}},
      {"hf_transfer", {"FILE", "FILE", "--suggest-pairs", at("pairs.json")}},
      {"hf_transfer", {"FILE", "FILE", "-o", at("out.glb"), "--quiet"}},
      {"hf_field", {"FILE", "--site", "0=0", "--out", at("out.txt")}},
      {"hf_field", {"FILE", "--kind", "biharmonic", "--site", "0=0", "--out", at("out.txt")}},
      {"hf_field", {"FILE", "--kind", "direction", "--site", "0=1,0,0", "--out", at("out.txt")}},
      {"hf_deform_script", {"FILE", "--script", at("pose.json"), "-o", at("out.glb"), "--quiet"}},
      {"hf_deform_script", {"FILE", "--propose", "--quiet"}},
      {"hf_rig", {"FILE", "--handles", at("rig.json"), "-o", at("out.glb"), "--quiet"}},
      {"hf_quads", {"FILE", "-o", at("out.obj")}},
      {"hf_detail", {"FILE", "--curve", at("curve.json"), "--weight", "0.5", "-o", at("out.glb")}},
      {"hf_detail", {"FILE", "--curve", at("curve.json"), "-o", at("out.glb")}},
      {"hf_weights", {"FILE", "-o", at("out.glb")}},
  };
}

void measure_files(const std::string& programs, const std::string& folder, bool full, const std::string& only) {
  const std::vector<Program> list = programs_that_read(folder);
  const double bar = full ? most_seconds : most_quick_seconds;
  // the quick form gives a kind to every sixth program, and other ones to the next kind
  std::size_t turn = 0;
  for (const std::string& kind : file_kinds()) {
    ++turn;
    if (kind.find(only) == std::string::npos) continue;
    const std::string text = file_of_bytes(kind, full ? 1000000 : 500000);
    const std::string file = folder + "/" + kind + file_ending(text);
    std::ofstream(file, std::ios::binary) << text;
    const bool all = full || kind.rfind("soup", 0) == 0 || kind.rfind("polygon", 0) == 0;
    Cost worst;
    worst.ended = true;
    // One polygon is a sound mesh of 45,000 vertices and more. The quick form takes the programs that do little but
    // read it, since other programs share the processor.
    const bool sound = kind.rfind("polygon_", 0) == 0;
    for (const Program& program : list) {
      if (!all && &program != list.data()) continue;
      const std::string name = program.name;
      if (sound && !full && name != "hf_field" && name != "hf_rig") continue;
      if (all && !full && only.empty() && (static_cast<std::size_t>(&program - list.data()) + turn) % 6 != 0) continue;
      std::vector<std::string> command = {programs + "/" + program.name};
      std::string said = name;
      for (const std::string& word : program.arguments) {
        command.push_back(word == "FILE" ? file : word);
        if (word.rfind("--", 0) == 0) said += " " + word;
      }
      Cost cost = cost_of(command);
      if (cost.seconds > bar) cost.seconds = std::min(cost.seconds, cost_of(command).seconds);
      std::printf("# %-20s %-40s %.2f s %.0f MB\n", kind.c_str(), said.c_str(), cost.seconds, cost.megabytes);
      worst.seconds = std::max(worst.seconds, cost.seconds);
      worst.megabytes = std::max(worst.megabytes, cost.megabytes);
      worst.ended = worst.ended && cost.ended;
    }
    report_at_most(("growth_bytes_" + kind + "_seconds").c_str(), worst.ended ? worst.seconds : NAN, bar);
    report_at_most(("growth_bytes_" + kind + "_megabytes").c_str(), worst.megabytes,
                   full ? most_megabytes : most_quick_megabytes);
    std::filesystem::remove(file);
  }
}

// What a factor takes, before it is made.
void measure_work(bool full) {
  const std::size_t n = full ? 80000 : 20000;
  const std::vector<std::size_t> sizes = {n, 2 * n, 4 * n, 8 * n};
  const TorusWork work = torus_work(sizes);
  std::printf("# %-24s", "factor_work");
  for (std::size_t i = 0; i < sizes.size(); ++i) std::printf(" %zu: %.3g GFlop;", sizes[i], 1e-9 * work.flops[i]);
  std::printf(" 20,000,000: %.0f\n", work.largest_gflop);
  report_at_most("growth_factor_work_flops", work.slope, 1.6);  // n^1.5 and a logarithm
  report_at_most("growth_factor_work_20_million_gflop", work.largest_gflop, work.limit_gflop);
  if (!full) return;
  const DefaultRefusal refusal = default_refusal(100000);
  std::printf("# default_refusal: %.0f GFlop of %.0f, %.1f s\n", refusal.gflop, refusal.limit_gflop, refusal.seconds);
  report_at_most("growth_default_refusal_seconds", refusal.refused ? refusal.seconds : NAN, 60);
}

}  // namespace

int main(int count, char** arguments) {
  const bool full = report_full(count, arguments) != 0;
  // freed memory stays with the process: the kernel's work for fresh pages is not what is measured
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  mallopt(M_MMAP_THRESHOLD, 1 << 25);
  std::string only, programs;
  for (int i = 1; i < count; ++i) {
    const std::string word = arguments[i];
    if (word == "--only" && i + 1 < count) {
      only = arguments[++i];
    } else if (word != "--full") {
      programs = word;
    }
  }
  // first, since a child's memory counts from what this process holds when it is forked
  if (!programs.empty()) {
    std::string folder = (std::filesystem::temp_directory_path() / "hf_growth_XXXXXX").string();
    if (!mkdtemp(folder.data())) return 1;
    measure_files(programs, folder, full, only);
    std::filesystem::remove_all(folder);
  }
  for (const auto& structures : {weld_structures(full), library_structures(full), file_structures(full)}) {
    for (const Structure& structure : structures) {
      if (structure.name.find(only) != std::string::npos) judge(structure, full);
    }
  }
  if (std::string("factor_work").find(only) != std::string::npos) measure_work(full);
  if (std::string("biharmonic_fan").find(only) != std::string::npos) {
    const HighValence found = high_valence_fan();
    std::printf("# biharmonic_fan 100000: %.2f s\n", found.seconds);
    report_at_most("growth_biharmonic_fan_error", found.error, 1e-8);
    report_at_most("growth_biharmonic_fan_megabytes", found.megabytes, 1000);
  }
  return report_status();
}

// A refused call leaves every kind of object as it was (unchanged.h). Usage: reliability_unchanged [--full]
// [--kind NAME] [--calls N] [--first I] [--count N] [--trace I]. A failing sequence is made smaller and printed.
#include "unchanged.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>

#include "report.h"

namespace {

using namespace unchanged;

// The fewest steps that still fail.
std::vector<bool> smaller(const Kind& kind, std::uint64_t number) {
  std::vector<bool> steps(step_count(number), true);
  Tally ignored;
  for (bool less = true; less;) {
    less = false;
    for (std::size_t i = steps.size(); i-- > 0;) {
      if (!steps[i]) continue;
      steps[i] = false;
      if (play(kind, number, steps, ignored).empty())
        steps[i] = true;
      else
        less = true;
    }
  }
  return steps;
}

void complain(const Kind& kind, std::uint64_t number, const std::string& fault) {
  std::fprintf(stderr, "%s, sequence %llu: %s\n", kind.name, static_cast<unsigned long long>(number), fault.c_str());
  Tally ignored;
  std::string log;
  const std::string least = play(kind, number, smaller(kind, number), ignored, &log);
  std::fprintf(stderr, "  the least:\n%s    %s\n", log.c_str(), least.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  const bool full = report_full(argc, argv) != 0;
  std::uint64_t calls = full ? 1000000 : 7000, first = 1, count = ~std::uint64_t{0};
  std::string only;
  bool trace = false;
  for (int i = 1; i + 1 < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--calls") calls = std::stoull(argv[i + 1]);
    if (option == "--kind") only = argv[i + 1];
    if (option == "--first") first = std::stoull(argv[i + 1]);
    if (option == "--count") count = std::stoull(argv[i + 1]);
    if (option == "--trace") {
      first = std::stoull(argv[i + 1]);
      count = 1;
      trace = true;
    }
  }
  const bool few = count != ~std::uint64_t{0};
  Tally all;
  for (const Kind& kind : kinds()) {
    if (!only.empty() && only != kind.name) continue;
    const auto start = std::chrono::steady_clock::now();
    Tally tally;
    const auto share =
        static_cast<std::uint64_t>(std::ceil(static_cast<double>(calls) * (only.empty() ? kind.share : 1)));
    for (std::uint64_t i = first; i - first < count && tally.calls < share && tally.failures < 5; ++i) {
      std::string log;
      const std::string fault = play(kind, i, {}, tally, trace ? &log : nullptr);
      if (trace) std::fprintf(stderr, "%s", log.c_str());
      if (fault.empty()) continue;
      ++tally.failures;
      complain(kind, i, fault);
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::printf("%s: %llu calls, %llu done, refused: %llu arguments, %llu memory, %llu cancelled; %llu fresh, %.1f s\n",
                kind.name, static_cast<unsigned long long>(tally.calls), static_cast<unsigned long long>(tally.done),
                static_cast<unsigned long long>(tally.invalid), static_cast<unsigned long long>(tally.memory),
                static_cast<unsigned long long>(tally.cancelled), static_cast<unsigned long long>(tally.fresh),
                seconds);
    std::fflush(stdout);
    all.calls += tally.calls;
    all.failures += tally.failures;
    all.memory += tally.memory;
    all.invalid += tally.invalid;
    all.cancelled += tally.cancelled;
    all.internal += tally.internal;
  }
  report_at_least("unchanged_calls", static_cast<double>(all.calls), few ? 1 : static_cast<double>(calls));
  report_at_least("unchanged_refused", static_cast<double>(all.memory + all.invalid + all.cancelled),
                  static_cast<double>(all.calls) / 5);
  report_at_most("unchanged_internal_errors", static_cast<double>(all.internal), 0);
  report_at_most("unchanged_differences", static_cast<double>(all.failures), 0);
  return report_status();
}

// Small meshes with random damage, and quads, regions, transfers, weights and links of them. Usage: reliability_shapes
// [--full] [--count N] [--first I] [--hex BYTES]: plays inputs from number I on, or a given one. A failing one is made
// smaller and printed as hex.
#include <chrono>
#include <cinttypes>
#include <string>
#include <vector>

#include "byte_inputs.h"
#include "report.h"
#include "shape_player.h"

int main(int argc, char** argv) {
  const auto [given, count, first] = play::Arguments(argc, argv, report_full(argc, argv) ? 50000 : 100,
                                                     HF_SOURCE_DIR "/tests/reliability/inputs/shapes.hex");
  const char* const names[] = {"quads", "region", "transfer", "weights", "links"};
  std::uint64_t calls[shapes::kind_count] = {}, results[shapes::kind_count] = {}, failures = 0;
  double slowest = 0;
  for (std::uint64_t i = 0; i < given.size() + count; ++i) {
    const play::Input input = i < given.size() ? given[i] : play::random_input(first + i - given.size());
    const auto start = std::chrono::steady_clock::now();
    const shapes::Outcome outcome = shapes::play(input.data(), input.size());
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (seconds > slowest) {
      slowest = seconds;
      std::printf("slowest so far: %s, %.2f s\n", play::hex_of(input).c_str(), seconds);
    }
    for (std::size_t k = 0; k < shapes::kind_count; ++k) {
      calls[k] += outcome.calls[k];
      results[k] += outcome.results[k];
    }
    if (outcome.passed) continue;
    std::fprintf(stderr, "%s %" PRIu64 ": %s\n", i < given.size() ? "kept input" : "input",
                 i < given.size() ? i : first + i - given.size(), outcome.failure.c_str());
    if (++failures > 10) break;
    // another fault that a smaller input meets is another input's
    const auto fault = [](const shapes::Outcome& o) { return o.failure.substr(0, o.failure.find(" (last detail")); };
    const play::Input least = play::smaller(input, [&](const play::Input& bytes) {
      const shapes::Outcome now = shapes::play(bytes.data(), bytes.size());
      return now.passed || fault(now) != fault(outcome);
    });
    std::fprintf(stderr, "  --hex %s: %s\n", play::hex_of(least).c_str(),
                 shapes::play(least.data(), least.size()).failure.c_str());
  }
  for (std::size_t k = 0; k < shapes::kind_count; ++k) {
    std::printf("%s: %" PRIu64 " calls\n", names[k], calls[k]);
    // random arguments are mostly good
    const double share = static_cast<double>(results[k]) / static_cast<double>(calls[k] > 0 ? calls[k] : 1);
    report_at_least((std::string("shapes_") + names[k] + "_results").c_str(), count >= 100 ? share : 1, 0.2);
  }
  report_at_most("shapes_failed", static_cast<double>(failures), 0);
  return report_status();
}

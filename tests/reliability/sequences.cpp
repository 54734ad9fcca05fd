// Random sequences of API calls against a dense oracle. Usage: reliability_sequences [--full] [--count N] [--first I]
// [--hex BYTES]: plays the sequences from number I on, or a given one. A failing one is made smaller and printed as
// hex.
#include <algorithm>
#include <chrono>
#include <cinttypes>
#include <string>
#include <vector>

#include "byte_inputs.h"
#include "report.h"
#include "sequence_player.h"
#include "support/peers.h"

int main(int argc, char** argv) {
  const auto [given, count, first] = play::Arguments(argc, argv, report_full(argc, argv) ? 1000000 : 30000,
                                                     HF_SOURCE_DIR "/tests/reliability/inputs/sequences.hex");
  double worst[3] = {0, 0, 0};
  std::uint64_t calls = 0, on_surfaces = 0, edits = 0, refused = 0, failures = 0, executions = 0;
  const auto start = std::chrono::steady_clock::now();
  for (std::uint64_t i = 0; i < given.size() + count; ++i) {
    const play::Input input = i < given.size() ? given[i] : play::random_input(first + i - given.size());
    const sequences::Outcome outcome = sequences::play(input.data(), input.size());
    ++executions;
    for (std::size_t e = 0; e < 3; ++e) worst[e] = std::max(worst[e], outcome.worst[e]);
    for (const unsigned n : outcome.calls) calls += n;
    for (std::size_t k = sequences::first_surface_call; k < outcome.calls.size(); ++k) on_surfaces += outcome.calls[k];
    refused += outcome.edits[0];
    edits += outcome.edits[1];
    if (outcome.passed) continue;
    if (i < given.size())
      std::fprintf(stderr, "kept input %" PRIu64 ": %s\n", i, outcome.failure.c_str());
    else
      std::fprintf(stderr, "sequence %" PRIu64 ": %s\n", first + i - given.size(), outcome.failure.c_str());
    if (++failures > 10) break;
    const play::Input least = play::smaller(
        input, [](const play::Input& bytes) { return sequences::play(bytes.data(), bytes.size()).passed; });
    std::fprintf(stderr, "  --hex %s: %s\n", play::hex_of(least).c_str(),
                 sequences::play(least.data(), least.size()).failure.c_str());
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("%" PRIu64 " calls, %" PRIu64 " edits done, %" PRIu64 " refused, %.0f s\n", calls, edits, refused,
              seconds);
  report_at_least("sequences_executed", static_cast<double>(executions), static_cast<double>(count));
  report_at_least("sequences_calls_on_surfaces", static_cast<double>(on_surfaces), static_cast<double>(count) / 10);
  report_at_most("sequences_failed", static_cast<double>(failures), 0);
  report_at_most("sequences_error_green", worst[0], sequences::exact_tolerance);
  report_at_most("sequences_error_refactor", worst[2], sequences::baseline_tolerance);
  if (has_gpl()) report_at_most("sequences_error_penalty", worst[1], sequences::penalty_tolerance);
  return report_status();
}

// Random sequences of edits of surfaces against fresh surfaces. Usage: reliability_edits [--full] [--count N] [--first
// I]
// [--hex BYTES]: plays the sequences from number I on, or a given one. A failing one is made smaller and printed as
// hex.
#include <algorithm>
#include <cinttypes>

#include "byte_inputs.h"
#include "edit_player.h"
#include "report.h"

int main(int argc, char** argv) {
  // a sequence has 9 edits in the mean: the long form has more than a million
  const auto [given, count, first] = play::Arguments(argc, argv, report_full(argc, argv) ? 120000 : 400,
                                                     HF_SOURCE_DIR "/tests/reliability/inputs/edits.hex");
  double worst = 0, distance = 0;
  std::uint64_t poses = 0, poses_off = 0;
  std::uint64_t done[9] = {}, refused = 0, failures = 0, all = 0;
  for (std::uint64_t i = 0; i < given.size() + count && failures < 10; ++i) {
    const play::Input input = i < given.size() ? given[i] : play::random_input(first + i - given.size());
    const edits::Outcome outcome = edits::play(input.data(), input.size());
    worst = std::max(worst, outcome.worst);
    distance = std::max(distance, outcome.distance);
    poses += outcome.poses;
    poses_off += outcome.poses_off;
    refused += outcome.refused;
    for (std::size_t k = 0; k < 9; ++k) {
      done[k] += outcome.done[k];
      all += outcome.done[k];
    }
    if (outcome.passed) continue;
    std::fprintf(stderr, "sequence %" PRIu64 " of %zu kept and more: %s\n", i, given.size(), outcome.failure.c_str());
    ++failures;
    const play::Input least =
        play::smaller(input, [](const play::Input& bytes) { return edits::play(bytes.data(), bytes.size()).passed; });
    std::fprintf(stderr, "  --hex %s: %s\n", play::hex_of(least).c_str(),
                 edits::play(least.data(), least.size()).failure.c_str());
  }
  std::printf("strokes %" PRIu64 ", refined %" PRIu64 ", holes %" PRIu64 ", filled %" PRIu64 ", vertices %" PRIu64
              ", cuts %" PRIu64 ", links %" PRIu64 " and out %" PRIu64 ", states and sites %" PRIu64
              "; refused %" PRIu64 "\n",
              done[0], done[1], done[2], done[3], done[4], done[5], done[6], done[7], done[8], refused);
  report_at_least("edits_done", static_cast<double>(all), static_cast<double>(count) * 5);
  report_at_most("edits_failed", static_cast<double>(failures), 0);
  report_at_most("edits_error", worst, edits::tolerance);
  report_at_most("edits_distance_error", distance, edits::tolerance);
  report_at_most("edits_poses_off", static_cast<double>(poses_off) / static_cast<double>(poses), edits::most_poses_off);
  return report_status();
}

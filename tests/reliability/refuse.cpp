// Refuses every allocation of every story, alone and with all later ones. The call must report it, nothing may leak,
// the objects must stay usable, and the answer of the story must be the same.
// Usage: reliability_refuse [--full | --quick] [--story NAME]. Without --full every sixth allocation is refused, from
// another one on in each story, alone and with all later ones. With --quick, for emulators, every 101st.
#include <cmath>
#include <cstdio>
#include <string>

#include "report.h"
#include "stories.h"

namespace {

using namespace refusal;

struct Tally {
  unsigned stories = 0, faults = 0, reported = 0, leaks = 0, problems = 0;
  double difference = 0;
};

void complain(Tally& tally, const Chapter& chapter, std::size_t n, bool on, const std::string& what) {
  if (++tally.problems <= 20)
    std::fprintf(stderr, "%s, allocation %zu%s: %s\n", chapter.name, n, on ? " and on" : "", what.c_str());
}

// Largest difference over the largest answer of both; infinity when they differ in number.
double difference(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return HUGE_VAL;
  double most = 0, scale = 1e-300;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!(std::fabs(a[i] - b[i]) <= 1e300)) return HUGE_VAL;
    most = std::fmax(most, std::fabs(a[i] - b[i]));
    scale = std::fmax(scale, std::fabs(a[i]));
  }
  return most / scale;
}

// step: how far the refused allocations lie apart.
void tell(const Chapter& chapter, const Tube& tube, std::size_t step, Tally& tally) {
  Allocator untouched;
  Story good(untouched);
  chapter.tell(good, tube, untouched);
  for (const std::string& problem : good.problems) complain(tally, chapter, 0, false, problem);
  if (good.failed() || good.answer.empty()) return complain(tally, chapter, 0, false, "the story does not work at all");
  ++tally.stories;
  for (const bool on : {false, true}) {
    for (std::size_t n = 1 + (tally.stories + 2 * on) % step;; n += step) {
      Allocator memory;
      memory.refuse_at = n;
      memory.refuse_on = on;
      Story story(memory);
      chapter.tell(story, tube, memory);
      if (memory.refused == 0) break;  // the story makes fewer allocations
      ++tally.faults;
      tally.reported += story.reported;
      for (const std::string& problem : story.problems) complain(tally, chapter, n, on, problem);
      if (memory.live_blocks != 0 || memory.live_bytes != 0 || memory.mismatches != 0) {
        ++tally.leaks;
        complain(tally, chapter, n, on,
                 std::to_string(memory.live_blocks) + " blocks are still there, or were given back wrongly");
      }
      if (story.failed()) continue;
      const double off = difference(good.answer, story.answer);
      tally.difference = std::fmax(tally.difference, off);
      if (!(off <= 1e-9)) complain(tally, chapter, n, on, "what comes out differs by " + std::to_string(off));
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::string only;
  for (int i = 1; i + 1 < argc; ++i)
    if (std::string(argv[i]) == "--story") only = argv[i + 1];
  const bool quick = argc > 1 && std::string(argv[1]) == "--quick";
  const std::size_t step = quick ? 101 : report_full(argc, argv) || !only.empty() ? 1 : 6;
  const Tube tube;
  Tally tally;
  for (const auto& chapters : {field_chapters(), shape_chapters()}) {
    for (const Chapter& chapter : chapters) {
      if (!only.empty() && only != chapter.name) continue;
      const unsigned before = tally.faults;
      tell(chapter, tube, step, tally);
      std::printf("%s: %u faults\n", chapter.name, tally.faults - before);
    }
  }
  // a call need not report memory that it can do without (a rebase that is not made)
  std::printf("%u faults reported, %u done without\n", tally.reported, tally.faults - tally.reported);
  if (!only.empty()) return tally.problems > 0;
  report_at_least("refuse_stories", tally.stories, 16);
  // blocks that earlier calls freed are taken without asking, so not every allocation can be refused
  report_at_least("refuse_faults", tally.faults, 18000.0 / static_cast<double>(step));
  report_at_most("refuse_problems", tally.problems, 0);
  report_at_most("refuse_leaks", tally.leaks, 0);
  report_at_most("refuse_difference", tally.difference, 1e-9);
  return report_status();
}

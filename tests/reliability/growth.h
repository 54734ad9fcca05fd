// Time and memory against size: what reliability_growth measures and how it judges.
//
// Time is that of the thread, the least of some repetitions; memory is what operator new and the library's hooks hold
// at most. The slope is that of the least-squares line in log-log.
#ifndef HF_TESTS_RELIABILITY_GROWTH_H
#define HF_TESTS_RELIABILITY_GROWTH_H

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace growth {

double thread_seconds();

// Bytes held now, and the most since the last reset.
std::size_t held_bytes();
std::size_t most_bytes();
void reset_most_bytes();

// One run at a size: prepares what is not measured and returns the work.
using Run = std::function<std::function<void()>(std::size_t size)>;

struct Structure {
  std::string name;
  std::vector<std::size_t> sizes;  // four of them
  double steepest;                 // of time and memory; 0: measured and printed, not judged
  Run run;
};

std::vector<Structure> weld_structures(bool full);
std::vector<Structure> library_structures(bool full);
std::vector<Structure> file_structures(bool full);

// The bi-harmonic field of a fan of 100,000 triangles, certified: its error over the range of the sites, and its cost.
struct HighValence {
  double error = 0, megabytes = 0, seconds = 0;
};
HighValence high_valence_fan();

// The text of a file with so many elements of a kind; the kinds are those of file_kinds(). It is glTF, or OFF where it
// does not begin with a brace.
std::vector<std::string> file_kinds();
std::string file_of(const std::string& kind, std::size_t count);
// The largest of at most so many bytes.
std::string file_of_bytes(const std::string& kind, std::size_t bytes);

}  // namespace growth

#endif

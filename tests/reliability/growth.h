// Time and memory against size: what reliability_growth measures and how it judges.
//
// Time is that of the thread, the least of some repetitions; memory is what operator new and the library's hooks hold
// at most. The slope is that of the least-squares line in log-log.
#ifndef HF_TESTS_RELIABILITY_GROWTH_H
#define HF_TESTS_RELIABILITY_GROWTH_H

#include <cstddef>
#include <cstdint>
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
  double most_microseconds = 0;  // of an element, at the largest size; 0: not judged
};

// The slope of the least-squares line in log-log.
double slope(const std::vector<std::size_t>& sizes, const std::vector<double>& values);

std::vector<Structure> weld_structures(bool full);
std::vector<Structure> library_structures(bool full);
std::vector<Structure> file_structures(bool full);

// The bi-harmonic field of a fan of 100,000 triangles, certified: its error over the range of the sites, and its cost.
struct HighValence {
  double error = 0, megabytes = 0, seconds = 0;
};
HighValence high_valence_fan();

// Operations of factors of tori, their slope, and what it says about the largest mesh that is taken by default.
struct TorusWork {
  std::vector<double> flops;
  double slope = 0, largest_gflop = 0, limit_gflop = 0;
};
TorusWork torus_work(const std::vector<std::size_t>& sizes);

// A soup with six triangles at random a vertex, made with a desc that sets no limit. Refused by the work it needs:
// only the ordering and the analysis ran.
struct DefaultRefusal {
  bool refused = false;
  double gflop = 0, limit_gflop = 0, seconds = 0;
};
DefaultRefusal default_refusal(std::uint32_t vertices);

// The text of a file with so many elements of a kind; the kinds are those of file_kinds(). It is glTF, GLB or OFF, as
// file_ending says.
std::vector<std::string> file_kinds();
std::string file_of(const std::string& kind, std::size_t count);
const char* file_ending(const std::string& text);
// The largest of at most so many bytes.
std::string file_of_bytes(const std::string& kind, std::size_t bytes);

}  // namespace growth

#endif

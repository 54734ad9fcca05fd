// The figures hf_bench is measured by: one list with what must be reached and what is aimed at, on one thread and on
// two; what was measured; and the table of both.
#ifndef HF_BENCH_FIGURES_H
#define HF_BENCH_FIGURES_H

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace bench {

struct Bar {
  double one_thread, two_threads;  // none: no bar for that many threads
};

struct Figure {
  const char* key;
  const char* label;
  bool larger_is_better;
  Bar must, aim;
  const char* format;  // of a value, printf
};

// All figures, in the order of the table.
const std::vector<Figure>& all_figures();

class Report {
 public:
  // `where`: the mesh or family; a figure has one line per place. note: shown behind the value, may be empty.
  void measure(const std::string& key, const std::string& where, uint32_t threads, double value,
               const std::string& note = "");
  bool empty() const { return lines_.empty(); }
  // figure | measured | must | aim | reached, as plain text and as Markdown.
  std::string text() const;
  std::string markdown() const;
  nlohmann::json json() const;

 private:
  struct Value {
    double value = 0;
    std::string note;
  };
  struct Line {
    const Figure* figure;
    std::string where;
    std::map<uint32_t, Value> values;  // by threads
  };
  std::vector<std::vector<std::string>> cells() const;
  std::vector<const Line*> ordered() const;
  std::vector<Line> lines_;
};

}  // namespace bench

#endif

// hf_bench: see --help. Figures are medians; compare ratios, machines are noisy.
#include <cstdio>
#include <exception>

#include "bench/bench_support.h"

namespace {

const char* const usage =
    "usage: hf_bench COMMAND [--threads N] [--repeat N] [--json FILE]\n"
    "  table1   the rows of Table 1 of Xu, Zhang, Cohen-Or and Xiong (2009) on jittered tori of their sizes: edit and full field,\n"
    "           engines green, updown (the paper's) and refactor, and CHOLMOD's numeric refactorisation beside them\n";

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.empty() || arguments[0] == "--help" || arguments[0] == "-h") {
    std::fputs(usage, stdout);
    return arguments.empty() ? 1 : 0;
  }
  try {
    if (arguments[0] == "table1") return bench::table1({arguments.begin() + 1, arguments.end()});
    std::fprintf(stderr, "hf_bench: unknown command %s; see --help\n", arguments[0].c_str());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "hf_bench: %s\n", error.what());
  }
  return 1;
}

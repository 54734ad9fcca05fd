// hf_bench: see --help. Figures are medians; compare ratios, machines are noisy.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>

#include "bench/bench_support.h"

namespace {

const char* const usage =
    "usage: hf_bench COMMAND [--threads N] [--repeat N] [--rows TEXT] [--json FILE]\n"
    "  table1       the rows of Table 1 of Xu, Zhang, Cohen-Or and Xiong (2009) on jittered tori of their sizes: edit "
    "and full field,\n"
    "               engines green, updown (the paper's) and refactor, and CHOLMOD's numeric refactorisation beside "
    "them;\n"
    "               --rows keeps those whose names contain TEXT\n"
    "  large-sites  100 to 10,000 sites at once on 304,152 vertices, against our own refactorisation\n"
    "  partial      the field at ten vertices against the whole field, 4,290 to 304,152 vertices: grows with the "
    "elimination path\n";

bench::Arguments read_arguments(const std::vector<std::string>& words) {
  bench::Arguments arguments;
  for (size_t i = 1; i < words.size(); ++i) {
    const auto next = [&] {
      if (i + 1 == words.size()) throw std::runtime_error(words[i] + " needs a value");
      return words[++i];
    };
    const auto number = [&] {
      const std::string text = next();
      char* end = nullptr;
      const unsigned long value = std::strtoul(text.c_str(), &end, 10);
      if (text.empty() || *end != '\0' || value < 1 || value > 10000)
        throw std::runtime_error("\"" + text + "\" is not a whole number from 1 to 10000");
      return static_cast<uint32_t>(value);
    };
    if (words[i] == "--threads")
      arguments.threads = number();
    else if (words[i] == "--repeat")
      arguments.repetitions = number();
    else if (words[i] == "--rows")
      arguments.rows = next();
    else if (words[i] == "--json")
      arguments.json_file = next();
    else
      throw std::runtime_error("unknown option " + words[i] + "; see --help");
  }
  return arguments;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.empty() || arguments[0] == "--help" || arguments[0] == "-h") {
    std::fputs(usage, stdout);
    return arguments.empty() ? 1 : 0;
  }
  try {
    if (arguments[0] == "table1") return bench::table1(read_arguments(arguments));
    if (arguments[0] == "large-sites") return bench::large_sites(read_arguments(arguments));
    if (arguments[0] == "partial") return bench::partial(read_arguments(arguments));
    std::fprintf(stderr, "hf_bench: unknown command %s; see --help\n", arguments[0].c_str());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "hf_bench: %s\n", error.what());
  }
  return 1;
}

// What --markdown writes: the table of figures, the rows of Table 1 and of the growth, the machine.
#ifndef HF_BENCH_MARKDOWN_H
#define HF_BENCH_MARKDOWN_H

#include <string>

#include "bench/commands.h"

namespace bench {

// runs: every command at every number of threads, as --json writes them.
std::string markdown(const Report& report, const Runs& runs, uint32_t repetitions);

// Writes the text to a file. A file that holds the lines "<!-- hf_bench: begin -->" and "<!-- hf_bench: end -->" keeps
// everything else: only what stands between them is replaced.
void write_markdown(const std::string& file, const std::string& text);

// Writes a file by a temporary name. Throws when it cannot.
void write_text(const std::string& file, const std::string& text);

}  // namespace bench

#endif

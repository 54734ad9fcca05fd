// hf_transfer --batch LIST: many transfers in one call, each in a process of its own, a process a core.
#ifndef HF_SAMPLES_TRANSFER_BATCH_H
#define HF_SAMPLES_TRANSFER_BATCH_H

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace samples {

// One line of the list: the words after "hf_transfer".
struct BatchLine {
  size_t number = 0;  // in the file, from 1
  std::vector<std::string> words;
};

// Words stand between blanks. One with blanks stands in double quotes; a backslash before a quote or a backslash keeps
// it. Empty lines and lines that start with # say nothing. Throws std::runtime_error that names the line.
std::vector<BatchLine> read_batch(const std::filesystem::path& list);

// Runs the lines, `jobs` at a time (0: one for each core), with this program. Prints a line of JSON for each when it
// ends: {"line", "exit", "seconds", "report"} or {..., "error"}. A line that fails stops no other. Returns the largest
// exit code.
int run_batch(const std::string& program, const std::vector<BatchLine>& lines, unsigned jobs);

}  // namespace samples

#endif

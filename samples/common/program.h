// What the programs have in common: reading the words of a command line, and a main() that reports what
// went wrong in one line.
#ifndef HF_SAMPLES_COMMON_PROGRAM_H
#define HF_SAMPLES_COMMON_PROGRAM_H

#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "common/limits.h"
#include "gltf/file_name.h"

namespace samples {

using namespace hf_gltf;

// The command line in UTF-8. Windows hands main() words in the code page of the system, which lacks most letters, so
// they are asked for once more.
class CommandLine {
 public:
  CommandLine(int count, char** arguments);
  int count() const { return static_cast<int>(pointers_.size()); }
  char** words() { return pointers_.data(); }

 private:
  std::vector<std::string> kept_;
  std::vector<char*> pointers_;
};

// The words of a command line, one after the other. Throws std::runtime_error naming the word that does not fit.
class Words {
 public:
  Words(int count, char** arguments) : count_(count), arguments_(arguments) {}
  bool next();  // false: there is none left
  bool is(const char* name, const char* other = nullptr) const;
  // What follows the option at hand.
  std::string value();
  std::filesystem::path file();
  double number(double low, double high);
  uint32_t whole(uint32_t low, uint32_t high);
  int32_t integer(int32_t low, int32_t high);
  // Takes --work-limit or --memory-limit (limits.h), if the word at hand is one of them.
  bool take_limit() {
    return samples::take_limit(word_, [this] { return value(); });
  }
  // The word at hand is no option of the program: the mesh, once.
  void take_mesh(std::filesystem::path& mesh) const;

 private:
  double whole_number(double low, double high);

  int count_, at_ = 0;
  char** arguments_;
  std::string word_;
};

// parse(words) gives a command with a member `help`; run(command) does it. Returns what main() is to return.
template <class Parse, class Run>
int run_program(const char* name, const char* usage, int count, char** arguments, Parse&& parse, Run&& run) {
  try {
    CommandLine line(count, arguments);
    const auto command = parse(Words(line.count(), line.words()));
    if (command.help) {
      std::fputs(usage, stdout);
      return 0;
    }
    run(command);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, with_limit_option(error.what()).c_str());
    return 1;
  }
  return 0;
}

}  // namespace samples

#endif

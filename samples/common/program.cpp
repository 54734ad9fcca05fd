// See program.h.
#include "common/program.h"

#ifdef _WIN32
#ifndef NOMINMAX
#define NOMINMAX
#endif
#include <windows.h>
// shellapi.h needs what stands before it
#include <shellapi.h>
#endif

#include <cmath>
#include <cstdlib>
#include <stdexcept>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "gltf/file_write.h"

namespace samples {
namespace {

// 8 as "8", 0.5 as "0.5".
std::string text_of(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", number);
  return text;
}

}  // namespace

CommandLine::CommandLine(int count, char** arguments) {
  remove_unfinished_on_signals();
#ifdef __GLIBC__
  // Freed blocks of this size go back to the system at once. By default glibc keeps them: its threshold rises to the
  // largest block freed, up to 32 MB. hf_quads on a comb of 64,000 corners then takes 300 MB for 172 in use. With 1 MB
  // it takes no less, with 16 MB 200 to 280; the times are the same.
  ::mallopt(M_MMAP_THRESHOLD, 4 << 20);
#endif
#ifdef _WIN32
  int found = 0;
  if (wchar_t** wide = ::CommandLineToArgvW(::GetCommandLineW(), &found)) {
    for (int i = 0; i < found; ++i) {
      const int bytes = ::WideCharToMultiByte(CP_UTF8, 0, wide[i], -1, nullptr, 0, nullptr, nullptr);
      std::string word(static_cast<size_t>(bytes > 0 ? bytes : 1), '\0');
      ::WideCharToMultiByte(CP_UTF8, 0, wide[i], -1, word.data(), bytes, nullptr, nullptr);
      word.pop_back();  // the zero at the end
      kept_.push_back(word);
    }
    ::LocalFree(wide);
    for (std::string& word : kept_) pointers_.push_back(word.data());
    return;
  }
#endif
  pointers_.assign(arguments, arguments + count);
}

bool Words::next() {
  if (at_ + 1 >= count_) return false;
  word_ = arguments_[++at_];
  return true;
}

bool Words::is(const char* name, const char* other) const { return word_ == name || (other && word_ == other); }

std::string Words::value() {
  if (at_ + 1 >= count_) throw std::runtime_error(word_ + " needs a value; see --help");
  return arguments_[++at_];
}

std::filesystem::path Words::file() { return file_named(value()); }

double Words::number(double low, double high) {
  const std::string text = value();
  char* end = nullptr;
  const double n = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != 0 || !(n >= low && n <= high))
    throw std::runtime_error(word_ + " takes a number from " + text_of(low) + " to " + text_of(high) + ", not \"" +
                             text + "\"");
  return n;
}

double Words::whole_number(double low, double high) {
  const double n = number(low, high);
  if (n != std::floor(n)) throw std::runtime_error(word_ + " takes a whole number, not \"" + text_of(n) + "\"");
  return n;
}

uint32_t Words::whole(uint32_t low, uint32_t high) { return static_cast<uint32_t>(whole_number(low, high)); }

int32_t Words::integer(int32_t low, int32_t high) { return static_cast<int32_t>(whole_number(low, high)); }

void Words::take_mesh(std::filesystem::path& mesh) const {
  if (!word_.empty() && word_[0] == '-') throw std::runtime_error("unknown option " + word_ + "; see --help");
  if (!mesh.empty()) throw std::runtime_error("one mesh only, not also " + word_);
  mesh = file_named(word_);
}

}  // namespace samples

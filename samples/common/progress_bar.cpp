// See progress_bar.h.
#include "common/progress_bar.h"

#ifdef _WIN32
#include <io.h>
#else
#include <unistd.h>
#endif

#include <algorithm>
#include <cstdio>

namespace samples {
namespace {

bool stderr_is_a_terminal() {
#ifdef _WIN32
  return _isatty(_fileno(stderr)) != 0;
#else
  return isatty(STDERR_FILENO) == 1;
#endif
}

}  // namespace

ProgressBar::ProgressBar(bool quiet) : quiet_(quiet), terminal_(!quiet && stderr_is_a_terminal()) {}

ProgressBar::~ProgressBar() {
  // a step left open by an exception: leave the cursor on a fresh line
  if (open_ && terminal_) std::fputc('\n', stderr);
}

void ProgressBar::begin(const std::string& step) {
  if (open_) end();
  open_ = true;
  step_ = step;
  start_ = drawn_ = std::chrono::steady_clock::now();
  if (terminal_) {
    draw(0, true);
  } else if (!quiet_) {
    std::fprintf(stderr, "%s ...\n", step_.c_str());
  }
}

void ProgressBar::update(double fraction) {
  if (open_ && terminal_) draw(fraction, false);
}

void ProgressBar::end(const std::string& note) {
  if (!open_) return;
  open_ = false;
  if (quiet_) return;
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  std::fprintf(stderr, "%s%s: %.2f s%s%s\n", terminal_ ? "\r\033[K" : "", step_.c_str(), seconds,
               note.empty() ? "" : ", ", note.c_str());
}

void ProgressBar::draw(double fraction, bool force) {
  const auto now = std::chrono::steady_clock::now();
  if (!force && now - drawn_ < std::chrono::milliseconds(100)) return;
  drawn_ = now;
  constexpr int width = 32;
  if (!(fraction > 0)) fraction = 0;
  fraction = std::min(fraction, 1.0);
  const int filled = static_cast<int>(fraction * width);
  const std::string bar =
      std::string(static_cast<size_t>(filled), '#') + std::string(static_cast<size_t>(width - filled), '.');
  std::fprintf(stderr, "\r\033[K%s [%s] %3d %%", step_.c_str(), bar.c_str(), static_cast<int>(fraction * 100));
  std::fflush(stderr);
}

}  // namespace samples

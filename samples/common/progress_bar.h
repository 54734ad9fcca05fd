// A one-line progress bar on standard error for the sample programs.
//
// On a terminal the line is redrawn in place, at most ten times a second; otherwise (a file, a pipe, a build log) only
// the start and the end of each step are written, one plain line each. Standard output is never touched.
#ifndef HF_SAMPLES_COMMON_PROGRESS_BAR_H
#define HF_SAMPLES_COMMON_PROGRESS_BAR_H

#include <chrono>
#include <string>

namespace samples {

class ProgressBar {
 public:
  // quiet: nothing is written at all.
  explicit ProgressBar(bool quiet = false);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // Ends the step before, if one is open, and opens the next.
  void begin(const std::string& step);
  // fraction is clamped to 0..1; NaN counts as 0.
  void update(double fraction);
  // Ends the open step; note stands behind it, e.g. "4400 vertices".
  void end(const std::string& note = "");

 private:
  void draw(double fraction, bool force);

  bool quiet_ = false;
  bool terminal_ = false;
  bool open_ = false;
  std::string step_;
  std::chrono::steady_clock::time_point start_, drawn_;
};

}  // namespace samples

#endif

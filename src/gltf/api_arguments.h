// Checks of arguments, and names of joints, for the files of the C interface.
#ifndef HF_GLTF_API_ARGUMENTS_H
#define HF_GLTF_API_ARGUMENTS_H

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "gltf/api_objects.h"

namespace hf_gltf {

// One line for each node. A line break in a name becomes a space.
std::string joint_names(const Model& model);

inline size_t numbered(uint32_t index, size_t count, const char* what) {
  if (index >= count)
    throw Failure(HF_ERROR_OUT_OF_RANGE,
                  std::string(what) + " " + std::to_string(index) + " of " + std::to_string(count), index);
  return index;
}

// Finite, and no larger than the floats of a file.
template <class Real>
void need_finite(const Real* values, size_t count, size_t row, const char* what) {
  constexpr double most = std::numeric_limits<float>::max();
  for (size_t i = 0; i < count; ++i) {
    const double value = static_cast<double>(values[i]);
    if (std::fabs(value) <= most) continue;
    const bool finite = std::isfinite(value);
    throw Failure(finite ? HF_ERROR_TOO_LARGE : HF_ERROR_NON_FINITE,
                  std::string(what) + " " + std::to_string(i / row) +
                      (finite ? " holds a number that is no float, as files have it; scale it down" : " is not finite"),
                  static_cast<uint32_t>(i / row));
  }
}

// The times of a clip: finite, increasing, from 0 on.
inline std::vector<double> times_of(const double* times, uint32_t count) {
  need(times, "times");
  if (count == 0) throw Failure(HF_ERROR_EMPTY, "frame_count is 0");
  need_finite(times, count, 1, "time");
  for (uint32_t f = 0; f < count; ++f)
    if (times[f] < 0 || (f > 0 && !(times[f] > times[f - 1])))
      throw Failure(HF_ERROR_INVALID_ARGUMENT, "times must increase, from 0 on: look at frame " + std::to_string(f), f);
  return {times, times + count};
}

}  // namespace hf_gltf

#endif

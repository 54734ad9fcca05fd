// Checks of what a caller passes: pointers, flags, choices, counts, strides, points. Each option is checked in one
// place: in the room that takes it.
#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/error.h"
#include "base/span.h"

namespace hf_inner {

inline void require(const void* pointer, const char* name) {
  if (!pointer) fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "%s is NULL", name);
}

inline void check_allocator(const hf_allocator& allocator) {
  if ((allocator.allocate == nullptr) != (allocator.release == nullptr))
    fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "allocator: set both allocate and release, or neither");
}

// Two ways to give one thing; at least one is set.
inline void require_either(const void* a, const void* b, const char* names) {
  if (!a && !b) fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "%s are both NULL", names);
}

inline void check_finite(double value, const char* name) {
  if (!std::isfinite(value)) fail(HF_ERROR_NON_FINITE, HF_NO_INDEX, "%s is not finite", name);
}

inline bool is_finite_point(const double* p) noexcept {
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

template <class T>
void require_zero(T reserved) {
  if (reserved != 0)
    fail(HF_ERROR_INVALID_DESC, HF_NO_INDEX, "reserved is %lld; set it to 0", static_cast<long long>(reserved));
}

// Refuses a list of the caller that is NULL or has no entries.
inline void require_list(std::uint32_t count, const void* list, const char* count_name, const char* name) {
  if (count == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "%s is 0", count_name);
  require(list, name);
}

inline void check_flag(std::int32_t value, const char* name) {
  if (value != 0 && value != 1)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "%s is %d; it must be 0 or 1", name, value);
}

inline void check_choice(std::int32_t value, std::int32_t count, const char* name) {
  if (value < 0 || value >= count)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "%s is %d; it must be 0 to %d", name, value, count - 1);
}

// Returns a count of the caller, or the default for 0. Refuses counts outside least .. most.
inline std::uint32_t count_of(std::uint32_t value, std::uint32_t standard, std::uint32_t least, std::uint32_t most,
                              const char* name) {
  if (value == 0) return standard;
  if (value < least || value > most)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "%s is %u; it must be %u to %u, or 0 for %u", name, value, least, most,
         standard);
  return value;
}

// Returns a byte stride. 0 means packed; any other stride must be at least the bytes of one row.
inline std::size_t stride_of(std::uint32_t stride, std::size_t row, const char* name) {
  if (stride == 0) return row;
  if (stride < row) fail(HF_ERROR_TOO_SMALL, HF_NO_INDEX, "%s is %u bytes; a row has %zu", name, stride, row);
  return stride;
}

// check_one refuses two arrays at once. rows_of views the array that is given as rows of `width` numbers, or returns
// null rows when none is given.
inline void check_one(const void* f32, const void* f64, const char* name) {
  if (f32 && f64) fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "%s and %s_f64 are both set; set one", name, name);
}
inline ConstRows rows_of(const float* f32, const double* f64, std::size_t width, std::uint32_t stride,
                         const char* stride_name) {
  if (f64) return {f64, stride_of(stride, width * sizeof(double), stride_name)};
  if (f32) return {f32, stride_of(stride, width * sizeof(float), stride_name)};
  return {};
}
inline Rows rows_of(float* f32, double* f64, std::size_t width, std::uint32_t stride, const char* stride_name) {
  if (f64) return {f64, stride_of(stride, width * sizeof(double), stride_name)};
  if (f32) return {f32, stride_of(stride, width * sizeof(float), stride_name)};
  return {};
}

// Returns the weights of a vertex that a caller asks for: 4 or 8; 0 stands for 4.
inline std::int32_t weights_per_vertex(std::uint32_t given) {
  if (given != 0 && given != 4 && given != 8)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "influence_count is %u; it must be 4 or 8, or 0 for 4", given);
  return given == 8 ? 8 : 4;
}

}  // namespace hf_inner

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

// ---- arrays of the caller: hf_array and hf_array_out ----

// Checks an array of rows of `width` numbers, which are plain or of the type `other`, and returns its stride in bytes.
template <class Array>
std::size_t check_array(const Array& array, std::int32_t other, std::size_t width, const char* name) {
  if (array.reserved != 0)
    fail(HF_ERROR_INVALID_DESC, HF_NO_INDEX, "%s.reserved is %u; set it to 0", name, array.reserved);
  if (!array.data)
    fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "%s.data is NULL, but its count is %u; set both or neither", name,
         array.count);
  if (array.type != HF_TYPE_PLAIN && array.type != other) {
    const char* const allowed = other == HF_TYPE_DOUBLE   ? "0 for float or HF_TYPE_DOUBLE"
                                : other == HF_TYPE_UINT16 ? "0 for uint32_t or HF_TYPE_UINT16"
                                                          : "0 for uint32_t";
    const char* const hint = array.type == -1 ? " (HF_ARRAY needs a pointer to numbers, such as rows[0])" : "";
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "%s.type is %d; it must be %s%s", name, array.type, allowed, hint);
  }
  const std::size_t number = array.type == HF_TYPE_DOUBLE ? 8 : array.type == HF_TYPE_UINT16 ? 2 : 4;
  const std::size_t row = width * number;
  if (array.stride != 0 && array.stride < row)
    fail(HF_ERROR_TOO_SMALL, HF_NO_INDEX, "%s.stride is %u bytes; a row has %zu bytes, and 0 means packed rows", name,
         array.stride, row);
  return array.stride == 0 ? row : array.stride;
}

template <class Array>
bool is_given(const Array& array) noexcept {
  return array.data || array.count > 0;
}

// The rows of an array that belong to something of the library, such as "vertices of the mesh".
template <class Array>
void check_rows(const Array& array, std::size_t rows, const char* noun, const char* name) {
  if (array.count != rows)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "%s.count is %u, but there are %zu %s", name, array.count, rows, noun);
}

// An array to write has as many rows as will be written, or more.
template <class Array>
void check_room(const Array& array, std::size_t rows, const char* noun, const char* name) {
  if (array.count < rows)
    fail(HF_ERROR_TOO_SMALL, HF_NO_INDEX, "%s.count is %u, but there are %zu %s", name, array.count, rows, noun);
}

// View an array of float or double; null rows where there is none. The second forms check the number of rows, too.
inline ConstRows read_reals(const hf_array& array, std::size_t width, const char* name) {
  if (!is_given(array)) return {};
  return {array.data, check_array(array, HF_TYPE_DOUBLE, width, name), array.type == HF_TYPE_DOUBLE};
}
inline ConstRows read_reals(const hf_array& array, std::size_t width, std::size_t rows, const char* noun,
                            const char* name) {
  const ConstRows view = read_reals(array, width, name);
  if (view) check_rows(array, rows, noun, name);
  return view;
}
inline Rows write_reals(const hf_array_out& array, std::size_t width, std::size_t rows, const char* noun,
                        const char* name) {
  if (!is_given(array)) return {};
  const Rows view(array.data, check_array(array, HF_TYPE_DOUBLE, width, name), array.type == HF_TYPE_DOUBLE);
  check_room(array, rows, noun, name);
  return view;
}
// The same of an array that a call cannot do without, given by its address.
template <class View>
View need(const View& view, const char* name) {
  if (!view) fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "%s.data is NULL", name);
  return view;
}
inline ConstRows need_reals(const hf_array* array, std::size_t width, std::size_t rows, const char* noun,
                            const char* name) {
  require(array, name);
  return need(read_reals(*array, width, rows, noun, name), name);
}
inline Rows need_reals(const hf_array_out* array, std::size_t width, std::size_t rows, const char* noun,
                       const char* name) {
  require(array, name);
  return need(write_reals(*array, width, rows, noun, name), name);
}
// Views an array of indices.
inline IndexRows read_indices(const hf_array& array, std::int32_t other, std::size_t width, const char* name) {
  if (!is_given(array)) return {};
  return {array.data, check_array(array, other, width, name), array.type == HF_TYPE_UINT16};
}

// Returns the weights of a vertex that a caller asks for: 4 or 8; 0 stands for 4.
inline std::int32_t weights_per_vertex(std::uint32_t given) {
  if (given != 0 && given != 4 && given != 8)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "influence_count is %u; it must be 4 or 8, or 0 for 4", given);
  return given == 8 ? 8 : 4;
}

}  // namespace hf_inner

// The boundary of the library: every exported function runs inside guarded(), which owns the float environment, catches
// everything and fills the thread's error detail. Descs are read and written here by struct_size.
#pragma once
#include <cstddef>
#include <cstring>
#include <new>
#include <type_traits>

#include "base/error.h"
#include "base/float_environment.h"
#include "base/memory.h"
#include "base/span.h"

namespace hf_inner::capi {

// Stores the detail of a failure for hf_error_get_detail and returns the code.
hf_result record_failure(hf_result code, std::uint32_t index, const char* function, const char* message) noexcept;
// The same for memory_limit_mb, with the limit and what the call needed.
hf_result record_memory_limit(const MemoryLimitReached& reached, const char* function) noexcept;

template <class Work>
hf_result guarded(const char* function, Work&& work) noexcept {
  const FloatEnvironment environment;
  try {
    work();
    return HF_OK;
  } catch (const Error& error) {
    return record_failure(error.code(), error.index(), function, error.what());
  } catch (const MemoryLimitReached& reached) {
    return record_memory_limit(reached, function);
  } catch (const std::bad_alloc&) {
    return record_failure(HF_ERROR_OUT_OF_MEMORY, HF_NO_INDEX, function,
                          "memory ran out; the object is as it was before the call");
  } catch (const std::exception& error) {
    return record_failure(HF_ERROR_INTERNAL, HF_NO_INDEX, function, error.what());
  } catch (...) {
    return record_failure(HF_ERROR_INTERNAL, HF_NO_INDEX, function, "an unknown exception reached the boundary");
  }
}

inline void require(const void* pointer, const char* name) {
  if (!pointer) fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "%s is NULL", name);
}

// The size of a struct in the first release that had it. A field appended after a release gets a specialisation here,
// offsetof the first new field, so that programs built before go on working.
template <class T>
inline constexpr std::size_t released_size = sizeof(T);

// Checks struct_size: the released size or more, and zero in every byte this version does not know.
template <class T>
void check_struct(const T* given, const char* name) {
  require(given, name);
  constexpr std::uint32_t most = 4096;  // bytes of the caller that are read: no struct will ever be that long
  if (given->struct_size < released_size<T> || given->struct_size > most) {
    fail(HF_ERROR_INVALID_DESC, HF_NO_INDEX, "%s: struct_size is %u; set it to sizeof (%zu here), as HF_INIT does",
         name, given->struct_size, sizeof(T));
  }
  const unsigned char* bytes = reinterpret_cast<const unsigned char*>(given);
  for (std::size_t i = sizeof(T); i < given->struct_size; ++i) {
    if (bytes[i])
      fail(HF_ERROR_INVALID_DESC, HF_NO_INDEX,
           "%s: byte %zu is set, which this version does not know; the header is newer than the library", name, i);
  }
}

// A copy of a desc with what the caller's version lacks at zero.
template <class T>
T read_struct(const T* given, const char* name) {
  check_struct(given, name);
  T copy;
  std::memset(static_cast<void*>(&copy), 0, sizeof copy);
  std::memcpy(static_cast<void*>(&copy), given, given->struct_size < sizeof(T) ? given->struct_size : sizeof(T));
  return copy;
}

// As read_struct; NULL gives a struct of defaults.
template <class T>
T read_optional(const T* given, const char* name) {
  if (given) return read_struct(given, name);
  T defaults;
  std::memset(static_cast<void*>(&defaults), 0, sizeof defaults);
  return defaults;
}

template <class T>
void require_zero(T reserved) {
  if (reserved != 0)
    fail(HF_ERROR_INVALID_DESC, HF_NO_INDEX, "reserved is %lld; set it to 0", static_cast<long long>(reserved));
}

// Writes an output struct as far as the caller's version goes; its struct_size stays.
template <class T>
void write_struct(T* out, T value) {
  value.struct_size = out->struct_size;
  std::memcpy(static_cast<void*>(out), &value, out->struct_size < sizeof(T) ? out->struct_size : sizeof(T));
}

// A byte stride: 0 is packed, otherwise at least one row.
inline std::size_t stride_of(std::uint32_t stride, std::size_t row, const char* name) {
  if (stride == 0) return row;
  if (stride < row) fail(HF_ERROR_TOO_SMALL, HF_NO_INDEX, "%s is %u bytes; a row has %zu", name, stride, row);
  return stride;
}

// Refuses an array out that cannot take what there is. Counts are written before this is called.
inline void check_capacity(bool given, std::size_t capacity, std::size_t count, const char* name) {
  if (given && capacity < count)
    fail(HF_ERROR_TOO_SMALL, HF_NO_INDEX, "%s is %zu; %zu are needed", name, capacity, count);
}

inline void write_count(std::uint32_t* out_count, std::size_t count) noexcept {
  if (out_count) *out_count = static_cast<std::uint32_t>(count);
}

// A list of the caller: at least one entry.
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

// A count with a default for 0.
inline std::uint32_t count_of(std::uint32_t value, std::uint32_t standard, std::uint32_t least, std::uint32_t most,
                              const char* name) {
  if (value == 0) return standard;
  if (value < least || value > most)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "%s is %u; it must be %u to %u, or 0 for %u", name, value, least, most,
         standard);
  return value;
}

// Rows of `width` floats or doubles of the caller; null when neither is given, refused when both are.
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

}  // namespace hf_inner::capi

// The C boundary of the library. Every exported function runs inside guarded(). guarded() sets the float environment,
// catches all exceptions and fills the thread's error detail. This header also reads and writes structs of the caller,
// whose length is their struct_size.
#pragma once
#include <cstddef>
#include <cstring>
#include <new>
#include <type_traits>

#include "base/arguments.h"
#include "base/error.h"
#include "base/float_environment.h"
#include "base/memory.h"

namespace hf_inner::capi {

// Stores the detail of a failure, which hf_error_get_detail returns, and returns the code.
hf_result record_failure(hf_result code, std::uint32_t index, const char* function, const char* message) noexcept;
// The same for memory_limit_mb, with the limit and the memory that the call needed.
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

// The size of a struct in the first release that had it. If a later release appends a field, specialise this with
// offsetof the first new field. Programs built with the older header then keep working.
template <class T>
inline constexpr std::size_t released_size = sizeof(T);

// Checks struct_size: it must be at least the released size. Every byte that this version does not know must be zero.
template <class T>
void check_struct(const T* given, const char* name) {
  require(given, name);
  constexpr std::uint32_t most = 4096;  // longer structs are refused: none will ever have so many bytes
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

// Returns a copy of a desc. Fields that the caller's older version lacks are zero in the copy.
template <class T>
T read_struct(const T* given, const char* name) {
  check_struct(given, name);
  T copy;
  std::memset(static_cast<void*>(&copy), 0, sizeof copy);
  std::memcpy(static_cast<void*>(&copy), given, given->struct_size < sizeof(T) ? given->struct_size : sizeof(T));
  return copy;
}

// Same as read_struct, but a NULL pointer gives a struct of defaults.
template <class T>
T read_optional(const T* given, const char* name) {
  if (given) return read_struct(given, name);
  T defaults;
  std::memset(static_cast<void*>(&defaults), 0, sizeof defaults);
  return defaults;
}

// Writes an output struct up to the length that the caller's version has. The caller's struct_size stays as it is.
template <class T>
void write_struct(T* out, T value) {
  value.struct_size = out->struct_size;
  std::memcpy(static_cast<void*>(out), &value, out->struct_size < sizeof(T) ? out->struct_size : sizeof(T));
}

// Refuses an output array that is too small for `count` entries. Call it after the counts were written.
inline void check_capacity(bool given, std::size_t capacity, std::size_t count, const char* name) {
  if (given && capacity < count)
    fail(HF_ERROR_TOO_SMALL, HF_NO_INDEX, "%s is %zu; %zu are needed", name, capacity, count);
}

inline void write_count(std::uint32_t* out_count, std::size_t count) noexcept {
  if (out_count) *out_count = static_cast<std::uint32_t>(count);
}

// Where hf_deform_desc and hf_morph_desc want positions and normals.
struct PointsOut {
  Rows positions, normals;
};
template <class Desc>
PointsOut read_points_out(const Desc& desc, std::size_t rows) {
  if (!is_given(desc.positions) && !is_given(desc.normals))
    fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "positions.data and normals.data are both NULL; nothing to write");
  return {write_reals(desc.positions, 3, rows, "vertices to write", "positions"),
          write_reals(desc.normals, 3, rows, "vertices to write", "normals")};
}

}  // namespace hf_inner::capi

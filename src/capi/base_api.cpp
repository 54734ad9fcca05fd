// Implements hf/base.h: versions, error detail, progress objects.
#include <cstdio>

#include "base/version.h"
#include "capi/boundary.h"
#include "capi/objects.h"

namespace hf_inner::capi {
namespace {

// The detail of this thread's last failure. It is plain data without constructor or destructor and never allocates.
thread_local hf_error_detail last_failure;

}  // namespace

hf_result record_failure(hf_result code, std::uint32_t index, const char* function, const char* message) noexcept {
  last_failure.code = code;
  last_failure.index = index;
  std::snprintf(last_failure.function, sizeof last_failure.function, "%s", function);
  std::snprintf(last_failure.message, sizeof last_failure.message, "%s", message);
  return code;
}

hf_result record_memory_limit(const MemoryLimitReached& reached, const char* function) noexcept {
  constexpr double mib = 1 << 20;
  char message[HF_MESSAGE_SIZE];
  std::snprintf(
      message, sizeof message,
      "memory_limit_mb is %.0f, but at least %.2f MiB are needed: %.2f MiB are in use, and one block of %.2f MiB "
      "was asked for; raise the limit. The object is as it was before the call",
      static_cast<double>(reached.limit) / mib, static_cast<double>(reached.needed) / mib,
      static_cast<double>(reached.used) / mib, static_cast<double>(reached.needed - reached.used) / mib);
  return record_failure(HF_ERROR_OUT_OF_MEMORY, HF_NO_INDEX, function, message);
}

}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_error_get_detail(hf_error_detail* out_detail) {
  if (!out_detail) return HF_ERROR_NULL_POINTER;
  *out_detail = last_failure;
  return HF_OK;
}

const char* hf_result_get_name(hf_result result) {
  struct Name {
    hf_result code;
    const char* name;
  };
  constexpr Name names[] = {
      {HF_OK, "HF_OK"},
      {HF_ERROR_INVALID_ARGUMENT, "HF_ERROR_INVALID_ARGUMENT"},
      {HF_ERROR_NULL_POINTER, "HF_ERROR_NULL_POINTER"},
      {HF_ERROR_INVALID_OBJECT, "HF_ERROR_INVALID_OBJECT"},
      {HF_ERROR_INVALID_DESC, "HF_ERROR_INVALID_DESC"},
      {HF_ERROR_OUT_OF_RANGE, "HF_ERROR_OUT_OF_RANGE"},
      {HF_ERROR_NON_FINITE, "HF_ERROR_NON_FINITE"},
      {HF_ERROR_EMPTY, "HF_ERROR_EMPTY"},
      {HF_ERROR_DUPLICATE, "HF_ERROR_DUPLICATE"},
      {HF_ERROR_NOT_FOUND, "HF_ERROR_NOT_FOUND"},
      {HF_ERROR_CONFLICT, "HF_ERROR_CONFLICT"},
      {HF_ERROR_UNSUPPORTED, "HF_ERROR_UNSUPPORTED"},
      {HF_ERROR_BUSY, "HF_ERROR_BUSY"},
      {HF_ERROR_REENTRANT, "HF_ERROR_REENTRANT"},
      {HF_ERROR_TOO_SMALL, "HF_ERROR_TOO_SMALL"},
      {HF_ERROR_OUT_OF_MEMORY, "HF_ERROR_OUT_OF_MEMORY"},
      {HF_ERROR_TOO_LARGE, "HF_ERROR_TOO_LARGE"},
      {HF_ERROR_CANCELLED, "HF_ERROR_CANCELLED"},
      {HF_ERROR_NOT_POSITIVE_DEFINITE, "HF_ERROR_NOT_POSITIVE_DEFINITE"},
      {HF_ERROR_INACCURATE, "HF_ERROR_INACCURATE"},
      {HF_ERROR_INTERNAL, "HF_ERROR_INTERNAL"},
  };

  for (const Name& entry : names) {
    if (entry.code == result) return entry.name;
  }
  return "unknown";
}

uint32_t hf_version_get(void) {
  static_assert(HF_VERSION_MAJOR == HF_VERSION_NUMBER_MAJOR && HF_VERSION_MINOR == HF_VERSION_NUMBER_MINOR &&
                    HF_VERSION_PATCH == HF_VERSION_NUMBER_PATCH,
                "hf/base.h and CMakeLists.txt name different versions");
  return HF_VERSION_MAJOR * 1000000u + HF_VERSION_MINOR * 1000u + HF_VERSION_PATCH;
}

hf_result hf_progress_create(hf_progress* out_progress) {
  return create("hf_progress_create", out_progress, "out_progress", [] { return std::make_shared<ProgressObject>(); });
}

void hf_progress_destroy(hf_progress progress) { destroy<ProgressObject>(progress); }

hf_result hf_progress_get_fraction(hf_progress progress, double* out_fraction) {
  return guarded("hf_progress_get_fraction", [&] {
    const auto object = get<ProgressObject>(progress, "progress");
    require(out_fraction, "out_fraction");
    *out_fraction = static_cast<double>(object->progress.fraction());
  });
}

hf_result hf_progress_cancel(hf_progress progress) {
  return guarded("hf_progress_cancel", [&] { get<ProgressObject>(progress, "progress")->progress.cancel(); });
}

}  // extern "C"

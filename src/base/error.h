// The one exception type of the library. Code in src throws it. src/capi catches it at the C boundary, stores code,
// index and message in the thread's error detail, and returns the code. The message is in a fixed buffer, so throwing
// needs no memory for it.
#pragma once
#include <cstdint>
#include <exception>

#include "base/compiler.h"
#include "hf/base.h"

namespace hf_inner {

class Error final : public std::exception {
 public:
  Error(hf_result code, std::uint32_t index) noexcept : code_(code), index_(index) { message_[0] = '\0'; }
  const char* what() const noexcept override { return message_; }
  char* message() noexcept { return message_; }
  hf_result code() const noexcept { return code_; }
  std::uint32_t index() const noexcept { return index_; }
  static constexpr unsigned message_size = HF_MESSAGE_SIZE;

 private:
  hf_result code_;
  std::uint32_t index_;
  char message_[message_size];
};

// Throws Error. `index` is the vertex, triangle, site, handle or component that the message is about, or HF_NO_INDEX.
// The message has one line and tells the caller what to do.
[[noreturn]] void fail(hf_result code, std::uint32_t index, const char* format, ...) HF_LIKE_PRINTF(3, 4);

}  // namespace hf_inner

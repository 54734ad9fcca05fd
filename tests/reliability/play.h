// What players of bytes share: bytes as arguments, and faults of the library as exceptions.
#pragma once
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "hf/hf.h"

namespace play {

struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

[[noreturn]] inline void fail(const std::string& what) {
  hf_error_detail detail;
  hf_error_get_detail(&detail);
  throw Failure(what + " (last detail: " + detail.function + ": " + detail.message + ")");
}

inline void expect(hf_result expected, hf_result got, const char* call) {
  if (got != expected)
    fail(std::string(call) + ": expected " + hf_result_get_name(expected) + ", got " + hf_result_get_name(got));
}
inline void hold(bool condition, const std::string& what) {
  if (!condition) fail(what);
}

// Bytes that are not there read as 0.
class Bytes {
 public:
  Bytes(const std::uint8_t* bytes, std::size_t size) : next_(bytes), end_(bytes + size) {}
  bool done() const { return next_ == end_; }
  unsigned take() { return done() ? 0u : *next_++; }
  unsigned peek() const { return done() ? 0u : *next_; }

 private:
  const std::uint8_t *next_, *end_;
};

}  // namespace play

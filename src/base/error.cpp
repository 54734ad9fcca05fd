#include "base/error.h"

#include <cstdarg>
#include <cstdio>

namespace hf_inner {

void fail(hf_result code, std::uint32_t index, const char* format, ...) {
  Error error(code, index);
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(error.message(), Error::message_size, format, arguments);
  va_end(arguments);
  throw error;
}

}  // namespace hf_inner

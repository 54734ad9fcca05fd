// Every file the process opens by name, seen from inside: open, openat and fopen of the C library are stood in for
// here, in the program itself, and passed on.
#pragma once
#include <string>
#include <vector>

namespace hostile {

// Names opened since the last call, links resolved, in order. Watching is off until the first call.
std::vector<std::string> opened();

}  // namespace hostile

// Lists the files that the process opens by name. The program replaces open, openat and fopen of the C library by
// functions that note the name and pass the call on.
#pragma once
#include <string>
#include <vector>

namespace hostile {

// The names opened since the last call, in order, with links resolved. The first call starts the list.
std::vector<std::string> opened();

}  // namespace hostile

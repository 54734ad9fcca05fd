// The table as a page: nouns down, changes across.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <stdexcept>

#include "table.h"

namespace invariance {
void write_page(const Table&, const std::vector<Body>&, const std::string&) {}
}  // namespace invariance

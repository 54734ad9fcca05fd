// What is promised of a noun under a change, and what was measured.
#pragma once
#include <string>
#include <vector>

#include "setting.h"

namespace invariance {

// A cell of the table that is not held to the tolerance of its noun.
struct Exception {
  const char* change;  // nullptr: every change
  const char* noun;
  double tolerance;    // infinity: it may differ
  const char* reason;  // "by design: ...", or "until ROW: ..." for a fault that is being mended
};
const std::vector<Exception>& exceptions();

// The tolerance of a cell; `why` names an exception, or is null.
double tolerance_of(const Change& change, const Noun& noun, const Exception** why);

struct Cell {
  double worst = -1;    // below 0: no body has this cell
  std::string where;    // the body and the row that is off most
  std::string refused;  // a body whose copy was refused, with the sentence
  int bodies = 0;
};

using Table = std::vector<std::vector<Cell>>;  // by noun and change

// Prints cells that miss; returns their number.
int judge(const Table& table);
// Writes the table as the page docs/invariance.md.
void write_page(const Table& table, const std::vector<Body>& bodies, const std::string& file);

}  // namespace invariance
